"""Write a print in the form of its input: text, binary or archive."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

from infill.errors import GeometryError
from infill.gcode.estimates import EstimateChange, find_estimates, update_estimate
from infill.gcode.sliced_file import SlicedFile

AT_ONCE = 1 << 20  # bytes


def write_print(
    sliced: SlicedFile, file: BinaryIO, texts: Mapping[int | None, Iterable[bytes]], metadata: Mapping[str, str]
) -> None:
    """Write a print with new text.

    Parameters
    ----------
    sliced : SlicedFile
    file : binary file
        To write to.
    texts : mapping from part to iterable of bytes
        The new text of each part that changes, in pieces.
    metadata : mapping
        New values of the metadata outside the text of binary G-code.
    """
    sliced.file.seek(0)
    if sliced.form == "archive":
        from infill.gcode.bambu_archive import rewrite_archive

        rewrite_archive(sliced.file, file, {plate: text for plate, text in texts.items() if plate is not None})
    elif sliced.form == "binary":
        from infill.gcode.binary import rewritten

        rewritten(sliced.file, file, texts[None], metadata)
    else:
        file.writelines(texts[None])


def update_metadata(metadata: Iterable[tuple[bytes, bytes]], change: EstimateChange) -> dict[str, str]:
    """Update the metadata that state time or filament; return the new values by name.

    Parameters
    ----------
    metadata : iterable of (name, value)
    change : EstimateChange
    """
    updated = {}
    for name, value in metadata:
        line = b"; %s = %s" % (name, value)
        if any(find_estimates(line)):
            new = update_estimate(line, 0.0, change).partition(b" = ")[2]
            updated[name.decode("utf-8", "surrogateescape")] = new.decode("utf-8", "surrogateescape")
    return updated


def read_pieces(draft: BinaryIO, begin: int, end: int) -> Iterator[bytes]:
    """Yield the bytes of a file between two places, in pieces."""
    draft.seek(begin)
    while begin < end:
        text = draft.read(min(AT_ONCE, end - begin))
        if not text:
            raise GeometryError("a temporary file ended early; free some space on the disk and try again")
        yield text
        begin += len(text)


def copy_mode(source: Path, file: BinaryIO) -> None:
    """Give a new file the permissions of the old one, where the system has them."""
    if hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):
            os.fchmod(file.fileno(), source.stat().st_mode & 0o7777)
