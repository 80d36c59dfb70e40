"""Text in pieces: cut into whole lines, or read as a file."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from typing import BinaryIO, final

MAX_CHUNK_BYTES = 65_536  # bytes; libbgcode and PrusaSlicer put as many into a block of binary G-code


def whole_lines(texts: Iterable[bytes]) -> Iterator[bytes]:
    r"""Join texts and cut them at line ends, as late as LONGEST_TEXT allows; a longer line is a piece of its own.

    Examples
    --------
    >>> list(whole_lines([b"G28\nG1 ", b"X1\n"]))
    [b'G28\nG1 X1\n']
    """
    rest = bytearray()
    for text in texts:
        rest += text
        while len(rest) > MAX_CHUNK_BYTES:
            cut = rest.rfind(b"\n", 0, MAX_CHUNK_BYTES) + 1 or rest.find(b"\n", MAX_CHUNK_BYTES) + 1
            if not cut:
                break
            yield bytes(rest[:cut])
            del rest[:cut]
    if rest:
        yield bytes(rest)


def open_chunks(texts: Iterable[bytes]) -> BinaryIO:
    r"""Return a file that can be read once, from front to back; each text is read when it is needed.

    Examples
    --------
    >>> open_chunks([b"G28\nG1 ", b"X1\n"]).readlines()
    [b'G28\n', b'G1 X1\n']
    """
    return io.BufferedReader(_Texts(iter(texts)), MAX_CHUNK_BYTES)


@final
class _Texts(io.RawIOBase):
    def __init__(self, texts: Iterator[bytes]) -> None:
        self._texts, self._rest = texts, b""

    def readable(self) -> bool:
        """Tell that this can be read, as `io.RawIOBase` asks."""
        return True

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]
        """Fill a buffer with the next bytes of the texts; return their number, 0 at the end."""
        while not self._rest:
            try:
                self._rest = next(self._texts)
            except StopIteration:
                return 0
        count = min(len(buffer), len(self._rest))
        buffer[:count], self._rest = self._rest[:count], self._rest[count:]
        return count
