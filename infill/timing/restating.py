"""The planned time of a print, written into its own statements of time; every other byte stays."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from infill.files.whole_files import atomic_file, check_target, copy_mode
from infill.gcode.estimates import find_estimates, restate_times, states_time
from infill.gcode.sliced_file import SlicedFile, SlicedText
from infill.gcode.stream import batches, edited_text


@dataclass(frozen=True, kw_only=True)
class TimeStatements:
    """Lines of a print that state its time or progress.

    Parameters
    ----------
    places : tuple of int
        Begin of each line in the text, bytes.
    lines : tuple of bytes
        Without line ends.
    """

    places: tuple[int, ...] = ()
    lines: tuple[bytes, ...] = ()


@dataclass(frozen=True, kw_only=True)
class TimeEdits:
    """New statements of time of one print.

    Parameters
    ----------
    text : binary file
        The old text.
    edits : tuple of (place, length, text)
        Replacements in it, in order.
    metadata : mapping
        New values outside the text.
    statements : int
        Number of all statements, those outside the text included.
    """

    text: BinaryIO
    edits: tuple[tuple[int, int, bytes], ...]
    metadata: Mapping[str, str]
    statements: int


def check_written(source: Path, target: Path, *, overwrite: bool) -> Path:
    """Return the path to write to, or raise OutputError; a link to the print itself is followed."""
    check_target(target, overwrite=overwrite)
    same = target.exists() and source.exists() and target.samefile(source)
    return Path(os.path.realpath(target)) if same else target


def find_time_statements(text: BinaryIO) -> TimeStatements:
    """Find the lines of a text that state time or progress."""
    places, lines, begin = list[int](), list[bytes](), 0
    text.seek(0)
    for data in batches(text):
        for first, last in find_estimates(data):
            if states_time(data[first:last]):
                places.append(begin + first)
                lines.append(data[first:last])
        begin += len(data)
    return TimeStatements(places=tuple(places), lines=tuple(lines))


def edit_times(
    sliced: SlicedText, statements: TimeStatements, seconds: float, first_layer: float, elapsed: Sequence[float]
) -> TimeEdits:
    """Return the new statements of a print.

    Parameters
    ----------
    sliced : SlicedText
    statements : TimeStatements
        Of its text.
    seconds, first_layer : float
        As planned, of the entire print and up to the end of its first layer.
    elapsed : sequence of float
        Seconds up to each statement.
    """
    new = restate_times(statements.lines, sliced.metadata, seconds, first_layer, elapsed)
    rows = zip(statements.places, statements.lines, new.lines, strict=True)
    return TimeEdits(
        text=sliced.text,
        edits=tuple((place, len(old), line) for place, old, line in rows),
        metadata=new.metadata,
        statements=len(new.lines) + len(new.metadata),
    )


def write_times(source: Path, file: SlicedFile, target: Path, edits: Mapping[int | None, TimeEdits]) -> None:
    """Write a print with new statements of time, in its own form, complete or not at all.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    texts: dict[int | None, Iterable[bytes]] = {
        part: edited_text(part_edits.text, part_edits.edits) for part, part_edits in edits.items()
    }
    metadata = {name: value for part_edits in edits.values() for name, value in part_edits.metadata.items()}
    with atomic_file(target) as new:
        copy_mode(source, new)
        file.rewrite(new, texts, metadata)
