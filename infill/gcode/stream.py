"""A print in pieces, so that memory does not grow with the file: batches of whole layers, and a text with edits."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from typing import BinaryIO

from infill.errors import FormatError, GeometryError

BATCH = 1 << 19  # bytes of text read at a time, up to the next layer
AT_ONCE = 1 << 20  # bytes of an edited text that are read at once
MAX_CHUNK_BYTES = 65_536  # bytes; libbgcode and PrusaSlicer put as many into a block of binary G-code
MAX_LINE_BYTES = 8 << 20  # bytes; slicers stay far below
MAX_LAYER_BYTES = 64 << 20  # bytes; a larger one is cut between two lines
LAYER_TAG = re.compile(rb"^(?:;LAYER_CHANGE|; CHANGE_LAYER|;LAYER:)", re.MULTILINE)


def batches(file: BinaryIO, size: int = BATCH) -> Iterator[bytes]:
    """Yield the text of a print in batches that begin at layers.

    Parameters
    ----------
    file : binary file
        Read from its current position to its end.
    size : int
        Bytes to read at a time; a batch is longer where a layer is.

    Raises
    ------
    FormatError
        If a line is longer than 8 MiB.
    """
    pending = b""
    wanted_bytes = size
    while True:
        more = file.read(wanted_bytes)
        pending += more
        if not more:
            break
        cut = _find_last_layer(pending)
        if cut <= 0 and len(pending) < MAX_LAYER_BYTES:
            wanted_bytes = max(size, len(pending))  # twice as much, so that a large layer is searched only a few times
            _check_line(pending)
            continue
        wanted_bytes = size
        cut = cut if cut > 0 else pending.rfind(b"\n") + 1
        _check_line(pending)
        if cut > 0:
            yield pending[:cut]
            pending = pending[cut:]
    if pending:
        _check_line(pending)
        yield pending


def _find_last_layer(text: bytes) -> int:
    """Return the begin of the last layer of a text, -1 if there is none."""
    return max(text.rfind(b"\n" + tag) + 1 for tag in (b";LAYER_CHANGE", b"; CHANGE_LAYER", b";LAYER:")) or -1


def _check_line(text: bytes) -> None:
    """Raise if a line is longer than any line of G-code."""
    begin = 0
    while len(text) - begin > MAX_LINE_BYTES:  # in steps of as many lines as fit
        end = text.rfind(b"\n", begin, begin + MAX_LINE_BYTES + 1)
        if end < 0:
            raise FormatError(
                f"a line of more than {MAX_LINE_BYTES >> 20} MiB is not G-code; give the file that the slicer wrote"
            )
        begin = end + 1


def whole_lines(texts: Iterable[bytes]) -> Iterator[bytes]:
    r"""Join texts and cut them at line ends, as late as MAX_CHUNK_BYTES allows; a longer line is a piece of its own.

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


def edited_text(file: BinaryIO, edits: Iterable[tuple[int, int, bytes]]) -> Iterator[bytes]:
    """Yield the text of a file with edits, in pieces.

    Parameters
    ----------
    file : binary file
    edits : iterable of (place, length, text)
        Replacements, in order.

    Raises
    ------
    GeometryError
        If the file ends before an edit.

    >>> import io
    >>> b"".join(edited_text(io.BytesIO(b"abcdef"), [(1, 2, b"X"), (6, 0, b"!")]))
    b'aXdef!'
    """
    position = 0
    for place, length, text in (*edits, (file.seek(0, os.SEEK_END), 0, b"")):
        file.seek(position)
        while position < place:
            piece = file.read(min(AT_ONCE, place - position))
            if not piece:
                raise GeometryError("a temporary file ended early; free some space on the disk and try again")
            yield piece
            position += len(piece)
        yield text
        position = place + length
