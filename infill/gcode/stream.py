"""A print as batches of whole layers, so that memory does not grow with the file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import BinaryIO

from infill.errors import FormatError

BATCH = 1 << 19  # bytes of text taken at a time, up to the next layer
LONGEST_LINE = 8 << 20  # bytes; no slicer comes near
LARGEST_LAYER = 64 << 20  # bytes; a larger one is cut between two lines
LAYER_TAG = re.compile(rb"^(?:;LAYER_CHANGE|; CHANGE_LAYER|;LAYER:)", re.MULTILINE)


def batches(file: BinaryIO, size: int = BATCH) -> Iterator[bytes]:
    """Yield the text of a print in batches that begin at layers.

    Parameters
    ----------
    file : binary file
        Read from where it stands to its end.
    size : int
        Bytes to take at a time; a batch is longer where a layer is.

    Raises
    ------
    FormatError
        If a line is longer than 8 MiB.
    """
    held = b""
    asked = size
    while True:
        more = file.read(asked)
        held += more
        if not more:
            break
        cut = _last_layer(held)
        if cut <= 0 and len(held) < LARGEST_LAYER:
            asked = max(size, len(held))  # twice as much, so that a large layer is not searched again and again
            _check_line(held)
            continue
        asked = size
        cut = cut if cut > 0 else held.rfind(b"\n") + 1
        _check_line(held)
        if cut > 0:
            yield held[:cut]
            held = held[cut:]
    if held:
        _check_line(held)
        yield held


def _last_layer(text: bytes) -> int:
    """Return where the last layer of some text begins, -1 if none does."""
    return max(text.rfind(b"\n" + tag) + 1 for tag in (b";LAYER_CHANGE", b"; CHANGE_LAYER", b";LAYER:")) or -1


def _check_line(text: bytes) -> None:
    begin = 0
    while len(text) - begin > LONGEST_LINE:  # in steps of as many lines as fit
        end = text.rfind(b"\n", begin, begin + LONGEST_LINE + 1)
        if end < 0:
            raise FormatError(
                f"a line of more than {LONGEST_LINE >> 20} MiB is no G-code; give the file that the slicer wrote"
            )
        begin = end + 1
