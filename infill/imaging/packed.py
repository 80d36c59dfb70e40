"""Cells of a volume from a file: plain, or packed by zlib, gzip or bzip2, and exactly as many as are announced.

A reader that takes what there is makes half a body of a file that is cut off. Here a stream has to reach its end, its
checksum has to fit, and it has to hold the announced number of bytes, neither fewer nor more.
"""

from __future__ import annotations

import bz2
import os
import zlib
from collections.abc import Callable, Iterator
from typing import BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER, one_line
from infill.imaging.assumed import warn
from infill.machine import require_memory

CHUNK = 2**20  # bytes read, or unpacked, in one go
PADDING = 512  # bytes of nothing that may follow the cells: files are filled up to whole blocks
LINE_END = 2  # bytes that nobody is told of
NOTHING = b"\0 \t\r\n"
# How many bytes one packed byte can stand for: RFC 1951 gives 1032 for deflate; bzip2 packs 45,899,235 zeros into 46.
RATIOS = {"zlib": 1032, "gzip": 1032, "bzip2": 10**6}
ZLIB_OR_GZIP = 32 + zlib.MAX_WBITS  # zlib's own way to ask for either, told apart by the first bytes
GZIP = 16 + zlib.MAX_WBITS


class _Stream(Protocol):
    """One packed stream: what `zlib.decompressobj` and `bz2.BZ2Decompressor` have in common."""

    @property
    def eof(self) -> bool:
        """Whether its end, with the checksum, was reached."""

    @property
    def unused_data(self) -> bytes:
        """What follows its end."""

    def unpack(self, data: bytes) -> bytes:
        """Return up to CHUNK bytes more; nothing if more data is needed."""


class _Deflated:
    """A stream of zlib or gzip."""

    def __init__(self, bits: int) -> None:
        self.stream = zlib.decompressobj(bits)

    @property
    def eof(self) -> bool:
        return self.stream.eof

    @property
    def unused_data(self) -> bytes:
        return self.stream.unused_data

    def unpack(self, data: bytes) -> bytes:
        return self.stream.decompress(self.stream.unconsumed_tail + data, CHUNK)


class _Bzip2:
    """A stream of bzip2."""

    def __init__(self) -> None:
        self.stream = bz2.BZ2Decompressor()

    @property
    def eof(self) -> bool:
        return self.stream.eof

    @property
    def unused_data(self) -> bytes:
        return self.stream.unused_data

    def unpack(self, data: bytes) -> bytes:
        return b"" if self.stream.eof else self.stream.decompress(data, CHUNK)


STREAMS: dict[str, Callable[[], _Stream]] = {
    "zlib": lambda: _Deflated(ZLIB_OR_GZIP),
    "gzip": lambda: _Deflated(GZIP),
    "bzip2": _Bzip2,
}


def read_bytes(
    said: str,
    file: BinaryIO,
    count: int,
    *,
    packing: str = "",
    packed_bytes: int | None = None,
    skip: int = 0,
    total: int | None = None,
) -> NDArray[np.uint8]:
    """Return bytes that begin where a file stands, after checking that it holds as many as are announced.

    Parameters
    ----------
    said : str
        What announces them, for messages: a path, or "a.mhd, with its cells in a.zraw,".
    file : BinaryIO
        Where they are; it stands at the first one.
    count : int
        How many to return.
    packing : {"", "zlib", "gzip", "bzip2"}
    packed_bytes : int, optional
        How many packed bytes there are; all to the end of the file if left out.
    skip : int
        How many to leave out before the first that is returned, after unpacking.
    total : int, optional
        How many there are altogether, after unpacking; `skip + count` if left out.

    Returns
    -------
    (count,) uint8

    Raises
    ------
    FormatError
        If there are fewer or more, the packed data are damaged, or their checksum does not fit.
    MemoryLimitError
        If there is no room for them.
    """
    total = skip + count if total is None else total
    begin = file.tell()
    left = max(0, os.fstat(file.fileno()).st_size - begin)
    if not packing:
        if left < total:
            raise cut_off(said, left, total)
        require_memory(count, None, SMALLER)
        file.seek(begin + total)
        _require_nothing(said, file.read(PADDING + 1), left - total)
        file.seek(begin + skip)
        return _filled(said, file, count)
    if packed_bytes is not None and left < packed_bytes:
        raise cut_off(said, left, packed_bytes, "packed bytes")
    held = left if packed_bytes is None else packed_bytes
    if total > RATIOS[packing] * held:
        raise FormatError(
            f"{said} is cut off, or its sizes are wrong: {held} bytes packed by {packing} cannot hold the {total} that "
            "its header announces; copy or save it again"
        )
    require_memory(count, None, SMALLER)
    cells = np.empty(count, dtype=np.uint8)
    target, at = cells.data, 0
    try:
        for piece in _unpack(file, packing, held):
            low, high = max(at, skip), min(at + len(piece), skip + count)
            if low < high:
                target[low - skip : high - skip] = memoryview(piece)[low - at : high - at]
            at += len(piece)
            if at > total + PADDING:
                break
            if at > total:
                _require_nothing(said, piece[total - at :], at - total)
    except (zlib.error, OSError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(
            f"{said} is damaged: what is packed in it by {packing} does not unpack ({one_line(error)}); "
            "copy or save it again"
        ) from error
    except EOFError as error:
        raise cut_off(said, at, total, f"bytes, unpacked from {held} by {packing}") from error
    if at > total:
        raise _surplus(said, at - total)
    if at < total:
        raise cut_off(said, at, total, "bytes")
    if packed_bytes is not None:
        file.seek(begin + packed_bytes)
        _require_nothing(said, file.read(PADDING + 1), left - packed_bytes)
    return cells


def _unpack(file: BinaryIO, packing: str, left: int) -> Iterator[bytes]:
    """Yield what up to `left` packed bytes hold, in pieces; raise EOFError where a stream lacks its end.

    Files of gzip and bzip2 may be made of several streams, and zeros may follow them.
    """
    stream, data = STREAMS[packing](), b""
    while True:
        piece = stream.unpack(data)
        data = b""
        if piece:
            yield piece
        elif stream.eof:
            data = stream.unused_data.lstrip(b"\0")
            while not data and left and (data := file.read(min(CHUNK, left))):
                left -= len(data)
                data = data.lstrip(b"\0")
            if not data:
                return
            if packing == "zlib" and not data.strip(NOTHING):
                return
            stream = STREAMS[packing]()
        else:
            data = file.read(min(CHUNK, left)) if left else b""
            left -= len(data)
            if not data:
                raise EOFError


def _filled(said: str, file: BinaryIO, count: int) -> NDArray[np.uint8]:
    """Return so many bytes of a file, read without a copy."""
    cells = np.empty(count, dtype=np.uint8)
    target, at = cells.data, 0
    while at < count:
        some = file.readinto(target[at:])  # type: ignore[attr-defined]
        if not some:
            raise cut_off(said, at, count)  # it was truncated meanwhile
        at += some
    return cells


def _require_nothing(said: str, after: bytes, surplus: int) -> None:
    """Raise FormatError if something follows the cells that is more than padding."""
    if surplus > PADDING or after.strip(NOTHING):
        raise _surplus(said, surplus)
    if surplus > LINE_END:
        warn("%s holds %d bytes more than its header announces, with nothing in them; they are left out", said, surplus)


def _surplus(said: str, count: int) -> FormatError:
    what = f"{count} bytes more" if count <= PADDING else "more bytes"
    return FormatError(f"{said} holds {what} than its header announces; check the sizes in it, or save it again")


def cut_off(said: str, held: int, needed: int, what: str = "bytes") -> FormatError:
    """Return the error for a file that ends too early."""
    return FormatError(f"{said} is cut off: it holds {held} {what}, of {needed}; copy or save it again")
