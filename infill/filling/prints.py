"""The file of a print: text, or binary G-code with text inside."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from infill.errors import FormatError, GeometryError
from infill.formats.whole_files import told
from infill.gcode.estimates import Change, estimates, told_anew

AT_ONCE = 1 << 20  # bytes
MAGIC = b"GCDE"  # what binary G-code begins with


@dataclass(frozen=True, kw_only=True)
class Given:
    """A print that was opened.

    Parameters
    ----------
    text : binary file
        Its G-code as text.
    binary : binary file, optional
        The file itself, if it is binary G-code.
    settings : mapping
        Of the slicer, if they stand outside the text.
    metadata : tuple of (name, value)
        Of the print, likewise.
    """

    text: BinaryIO
    binary: BinaryIO | None = None
    settings: Mapping[str, str] = field(default_factory=dict)
    metadata: tuple[tuple[bytes, bytes], ...] = ()


@contextlib.contextmanager
def opened(source: Path, folder: Path | None) -> Iterator[Given]:
    """Open a print; text that is packed is unpacked to a file without a name in `folder`.

    Raises
    ------
    FormatError
        If it cannot be read. What is raised while it is open gets the name of the file.
    """
    try:
        file = source.open("rb")
    except OSError as error:
        said = error.strerror or str(error)
        raise FormatError(f"cannot read {source}: {said[:1].lower()}{said[1:]}") from error
    try:
        with file:
            head = file.read(len(MAGIC))
            file.seek(0)
            if head != MAGIC:
                yield Given(text=file)
                return
            from infill.gcode.binary import Kind, blocks, metadata, text_pieces

            with scratch(folder) as text:
                for piece in text_pieces(file):
                    text.write(piece)
                file.seek(0)
                settings: dict[str, str] = {}
                values: dict[str, str] = {}
                for block in blocks(file):
                    if block.kind == Kind.SLICER_METADATA:
                        settings.update(metadata(block))
                    elif block.kind in (Kind.PRINT_METADATA, Kind.PRINTER_METADATA):
                        values.update(metadata(block))
                yield Given(
                    text=text,
                    binary=file,
                    settings=settings,
                    metadata=tuple((_bytes(name), _bytes(value)) for name, value in values.items()),
                )
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from error


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")


@contextlib.contextmanager
def scratch(folder: Path | None) -> Iterator[BinaryIO]:
    """Yield a file without a name, in the folder where the result will be, so that the same disk holds both."""
    with told(folder or Path("a temporary file")), tempfile.TemporaryFile(dir=folder) as file:
        yield file


def write_print(given: Given, file: BinaryIO, text: Iterable[bytes], change: Change, said: float) -> None:
    """Write new text in the form of the print that was given."""
    if given.binary is None:
        file.writelines(text)
        return
    from infill.gcode.binary import rewritten

    changes = {}
    for name, value in given.metadata:
        line = b"; %s = %s" % (name, value)
        if any(estimates(line)):
            anew = told_anew(line, 0.0, change, said).partition(b" = ")[2]
            changes[name.decode("utf-8", "surrogateescape")] = anew.decode("utf-8", "surrogateescape")
    given.binary.seek(0)
    rewritten(given.binary, file, text, changes)


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
