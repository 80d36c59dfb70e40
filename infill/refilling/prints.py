"""Writing a print: in the form in which it was given."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

from infill.errors import GeometryError
from infill.gcode.estimates import Change, estimates, told_anew
from infill.gcode.sliced_file import SlicedFile

AT_ONCE = 1 << 20  # bytes


def write_print(
    given: SlicedFile, file: BinaryIO, texts: Mapping[int | None, Iterable[bytes]], metadata: Mapping[str, str]
) -> None:
    """Write a print anew.

    Parameters
    ----------
    given : SlicedFile
    file : binary file
        To write to.
    texts : mapping from part to iterable of bytes
        The new text of each part that changes, in pieces.
    metadata : mapping
        New values of what binary G-code tells outside its text.
    """
    given.file.seek(0)
    if given.form == "archive":
        from infill.gcode.bambu_archive import rewritten_archive

        rewritten_archive(given.file, file, {plate: text for plate, text in texts.items() if plate is not None})
    elif given.form == "binary":
        from infill.gcode.binary import rewritten

        rewritten(given.file, file, texts[None], metadata)
    else:
        file.writelines(texts[None])


def retold(metadata: Iterable[tuple[bytes, bytes]], change: Change) -> dict[str, str]:
    """Return the values of metadata that tell time or filament as they hold after a change.

    Parameters
    ----------
    metadata : iterable of (name, value)
    change : Change
    """
    anew = {}
    for name, value in metadata:
        line = b"; %s = %s" % (name, value)
        if any(estimates(line)):
            new = told_anew(line, 0.0, change).partition(b" = ")[2]
            anew[name.decode("utf-8", "surrogateescape")] = new.decode("utf-8", "surrogateescape")
    return anew


def pieces(draft: BinaryIO, first: int, last: int) -> Iterator[bytes]:
    """Yield what stands between two places of a file."""
    draft.seek(first)
    while first < last:
        text = draft.read(min(AT_ONCE, last - first))
        if not text:
            raise GeometryError("a temporary file ended early; free some space on the disk and try again")
        yield text
        first += len(text)


def copy_mode(source: Path, file: BinaryIO) -> None:
    """Give a new file the permissions of the old one, where the system has them."""
    if hasattr(os, "fchmod"):
        with contextlib.suppress(OSError):
            os.fchmod(file.fileno(), source.stat().st_mode & 0o7777)
