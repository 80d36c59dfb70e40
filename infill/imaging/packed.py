"""Read cells from a file, plain or packed by zlib, gzip or bzip2, and check their number and checksum.

A lenient reader would make half a body of a truncated file. Here a stream must reach its end, its checksum must fit,
and it must hold exactly the announced number of bytes.
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
from infill.files.broken import SMALLER_VOLUME_ADVICE, error_text
from infill.imaging.assumed import warn
from infill.machine import require_memory

CHUNK = 2**20  # bytes read, or unpacked, in one go
MOST_PADDING = 512  # empty bytes that may follow the cells: files are padded to blocks
SILENT_PADDING = 2  # bytes that need no warning
BLANK_BYTES = b"\0 \t\r\n"
# Most bytes per packed byte: RFC 1951 gives 1032 for deflate; bzip2 packs 45,899,235 zeros into 46.
MOST_RATIOS = {"zlib": 1032, "gzip": 1032, "bzip2": 10**6}
ZLIB_OR_GZIP = 32 + zlib.MAX_WBITS  # zlib's own way to ask for either, told apart by the first bytes
GZIP = 16 + zlib.MAX_WBITS


class _Stream(Protocol):
    """One packed stream: the common interface of `zlib.decompressobj` and `bz2.BZ2Decompressor`."""

    @property
    def eof(self) -> bool:
        """True once the end, with the checksum, is reached."""

    @property
    def unused_data(self) -> bytes:
        """Bytes behind the end."""

    def unpack(self, data: bytes) -> bytes:
        """Return up to CHUNK bytes more; an empty result asks for more data."""


class _DeflateStream:
    """A stream of zlib or gzip."""

    def __init__(self, bits: int) -> None:
        self.stream = zlib.decompressobj(bits)

    @property
    def eof(self) -> bool:
        """Whether the compressed data has ended."""
        return self.stream.eof

    @property
    def unused_data(self) -> bytes:
        """The bytes after the end of the compressed data."""
        return self.stream.unused_data

    def unpack(self, data: bytes) -> bytes:
        """Decompress further data, into at most one chunk."""
        return self.stream.decompress(self.stream.unconsumed_tail + data, CHUNK)


class _Bzip2Stream:
    """A stream of bzip2."""

    def __init__(self) -> None:
        self.stream = bz2.BZ2Decompressor()

    @property
    def eof(self) -> bool:
        """Whether the compressed data has ended."""
        return self.stream.eof

    @property
    def unused_data(self) -> bytes:
        """The bytes after the end of the compressed data."""
        return self.stream.unused_data

    def unpack(self, data: bytes) -> bytes:
        """Decompress further data, into at most one chunk; nothing after the end."""
        return b"" if self.stream.eof else self.stream.decompress(data, CHUNK)


STREAMS: dict[str, Callable[[], _Stream]] = {
    "zlib": lambda: _DeflateStream(ZLIB_OR_GZIP),
    "gzip": lambda: _DeflateStream(GZIP),
    "bzip2": _Bzip2Stream,
}


def read_bytes(
    source: str,
    file: BinaryIO,
    count: int,
    *,
    packing: str = "",
    packed_bytes: int | None = None,
    skip: int = 0,
    total: int | None = None,
) -> NDArray[np.uint8]:
    """Read bytes from the position of a file, and check that the file holds as many as announced.

    Parameters
    ----------
    source : str
        The file, for messages: a path, or "a.mhd, with its cells in a.zraw,".
    file : BinaryIO
        Positioned at the first byte.
    count : int
        Number of bytes to return.
    packing : {"", "zlib", "gzip", "bzip2"}
    packed_bytes : int, optional
        Number of packed bytes; all to the end of the file if left out.
    skip : int
        Number of unpacked bytes before the first that is returned.
    total : int, optional
        Number of all unpacked bytes; `skip + count` if left out.

    Returns
    -------
    (count,) uint8

    Raises
    ------
    FormatError
        If the number of bytes is wrong, the packed data are damaged, or their checksum does not fit.
    MemoryLimitError
        If the bytes need too much memory.
    """
    total = skip + count if total is None else total
    begin = file.tell()
    available = max(0, os.fstat(file.fileno()).st_size - begin)
    if not packing:
        if available < total:
            raise cut_off_error(source, available, total)
        require_memory(count, None, SMALLER_VOLUME_ADVICE)
        file.seek(begin + total)
        _require_nothing(source, file.read(MOST_PADDING + 1), available - total)
        file.seek(begin + skip)
        return _read_plain(source, file, count)
    if packed_bytes is not None and available < packed_bytes:
        raise cut_off_error(source, available, packed_bytes, "packed bytes")
    packed_size = available if packed_bytes is None else packed_bytes
    if total > MOST_RATIOS[packing] * packed_size:
        raise FormatError(
            f"{source} is cut off, or its sizes are wrong: {packed_size} bytes packed by {packing} cannot hold the "
            f"{total} that its header announces; copy or save it again"
        )
    require_memory(count, None, SMALLER_VOLUME_ADVICE)
    cells = np.empty(count, dtype=np.uint8)
    target, position = cells.data, 0
    try:
        for piece in _unpack(file, packing, packed_size):
            start, stop = max(position, skip), min(position + len(piece), skip + count)
            if start < stop:
                target[start - skip : stop - skip] = memoryview(piece)[start - position : stop - position]
            position += len(piece)
            if position > total + MOST_PADDING:
                break
            if position > total:
                _require_nothing(source, piece[total - position :], position - total)
    except (zlib.error, OSError, ValueError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(
            f"{source} is damaged: what is packed in it by {packing} does not unpack ({error_text(error)}); "
            "copy or save it again"
        ) from error
    except EOFError as error:
        raise cut_off_error(source, position, total, f"bytes, unpacked from {packed_size} by {packing}") from error
    if position > total:
        raise _surplus_error(source, position - total)
    if position < total:
        raise cut_off_error(source, position, total, "bytes")
    if packed_bytes is not None:
        file.seek(begin + packed_bytes)
        _require_nothing(source, file.read(MOST_PADDING + 1), available - packed_bytes)
    return cells


def _unpack(file: BinaryIO, packing: str, remaining: int) -> Iterator[bytes]:
    """Yield the content of up to `remaining` packed bytes, in pieces; raise EOFError if a stream lacks its end.

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
            while not data and remaining and (data := file.read(min(CHUNK, remaining))):
                remaining -= len(data)
                data = data.lstrip(b"\0")
            if not data:
                return
            if packing == "zlib" and not data.strip(BLANK_BYTES):
                return
            stream = STREAMS[packing]()
        else:
            data = file.read(min(CHUNK, remaining)) if remaining else b""
            remaining -= len(data)
            if not data:
                raise EOFError


def _read_plain(source: str, file: BinaryIO, count: int) -> NDArray[np.uint8]:
    """Read `count` bytes of a file without a copy."""
    cells = np.empty(count, dtype=np.uint8)
    target, position = cells.data, 0
    while position < count:
        count_read = file.readinto(target[position:])  # type: ignore[attr-defined]
        if not count_read:
            raise cut_off_error(source, position, count)  # another program truncated it
        position += count_read
    return cells


def _require_nothing(source: str, after: bytes, surplus: int) -> None:
    """Raise FormatError if more than padding follows the cells: `surplus` bytes, of which `after` are known."""
    if surplus > MOST_PADDING or after.strip(BLANK_BYTES):
        raise _surplus_error(source, surplus)
    if surplus > SILENT_PADDING:
        warn(
            "%s holds %d bytes more than its header announces, with nothing in them; they are left out", source, surplus
        )


def _surplus_error(source: str, count: int) -> FormatError:
    """Return the error for a file with too many bytes."""
    what = f"{count} bytes more" if count <= MOST_PADDING else "more bytes"
    return FormatError(f"{source} holds {what} than its header announces; check the sizes in it, or save it again")


def cut_off_error(source: str, available: int, needed: int, what: str = "bytes") -> FormatError:
    """Return the error for a file that ends too early."""
    return FormatError(f"{source} is cut off: it holds {available} {what}, of {needed}; copy or save it again")
