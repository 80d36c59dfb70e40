"""Names and colours of the labels of a segmentation, from the tables of other programs.

    ITK-SNAP         IDX R G B A VIS MSH "LABEL", colours 0 to 255, A from 0 to 1
    FreeSurfer, LUT  No. Name R G B A, colours 0 to 255, A is 255 less the opacity
    3D Slicer, .ctbl number name R G B A, colours 0 to 255

Each is text with one label a line and comments behind #. 3D Slicer also keeps them in the header of .seg.nrrd.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from infill.errors import FormatError
from infill.files.broken import missing_file

LARGEST_TABLE = 10 * 2**20  # bytes of a table, or of the header of an image
SNAP_LINE = re.compile(r'(-?\d+)\s+(\d+)\s+(\d+)\s+(\d+)\s+[\d.]+\s+\d+\s+\d+\s+"([^"]*)"')
LUT_LINE = re.compile(r"(-?\d+)\s+(.*?\S)\s+(\d+)\s+(\d+)\s+(\d+)(?:\s+\d+)?")
SEGMENT_FIELD = re.compile(r"Segment(\d+)_(Name|LabelValue|Layer|Color):=(.*)")
HIGHEST_CHANNEL = 255
NRRD = "NRRD"

Colour = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Segment:
    """One label of a segmentation.

    Parameters
    ----------
    value : int
        Number of its cells.
    name : str
        Empty if unknown.
    colour : (red, green, blue), optional
        From 0 to 1, sRGB.
    layer : int
        Index of its volume in the segmentation, counted from 0.
    """

    value: int
    name: str = ""
    colour: Colour | None = None
    layer: int = 0


def read_labels(path: str | os.PathLike[str]) -> tuple[Segment, ...]:
    """Read the labels of a table, in the order of the file; the last line of a number counts.

    Parameters
    ----------
    path : str or Path
        Label descriptions of ITK-SNAP, a lookup table of FreeSurfer, or a colour table (.ctbl) of 3D Slicer.

    Raises
    ------
    FormatError
        If the file is missing, has another format, or holds no label.
    """
    source = Path(path)
    text = _read_text(source)
    segments: dict[int, Segment] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.strip()
        if not words or words.startswith("#"):
            continue
        segment = _parse_label(words)
        if segment is None:
            raise FormatError(
                f"{source} has no label in line {number}; give label descriptions of ITK-SNAP, a lookup table of "
                "FreeSurfer or a .ctbl of 3D Slicer"
            )
        segments[segment.value] = segment
    if not segments:
        raise FormatError(f"{source} names no label; check that it is the right file")
    return tuple(segments.values())


def _parse_label(line: str) -> Segment | None:
    """Parse the label on a line; return None if the line has none."""
    if snap := SNAP_LINE.fullmatch(line):
        value, *colour, name = snap.groups()
    elif lut := LUT_LINE.fullmatch(line):
        value, name, *colour = lut.groups()
    else:
        return None
    if any(int(channel) > HIGHEST_CHANNEL for channel in colour):
        return None
    red, green, blue = (int(channel) / HIGHEST_CHANNEL for channel in colour)
    return Segment(value=int(value), name=name.strip(), colour=(red, green, blue))


def segments_of_nrrd(path: str | os.PathLike[str]) -> tuple[Segment, ...]:
    """Read the segments that 3D Slicer named in the header of a .nrrd.

    Raises
    ------
    FormatError
        If a field of a segment has a wrong value.
    """
    source = Path(path)
    fields = [
        (int(match[1]), match[2], match[3].strip())
        for line in _read_nrrd_header(source)
        if (match := SEGMENT_FIELD.fullmatch(line)) is not None
    ]
    segments = []
    for number, entries in groupby(sorted(fields), key=lambda field: field[0]):
        values = {key: value for _, key, value in entries}
        try:
            # Before layers could be shared, every segment had one of its own, of zeros and ones.
            segment = Segment(
                value=int(values.get("LabelValue", "1")),
                name=values.get("Name", "").replace("\\n", " ").replace("\\\\", "\\"),
                colour=_parse_colour(values["Color"]) if "Color" in values else None,
                layer=int(values.get("Layer", "0" if "LabelValue" in values else str(number))),
            )
        except ValueError as error:
            raise FormatError(f"{source} describes segment {number} wrongly ({error}); save it again") from error
        segments.append(segment)
    return tuple(segments)


def _parse_colour(text: str) -> Colour:
    """Parse a colour and clip it to the range from 0 to 1."""
    red, green, blue = (min(1.0, max(0.0, float(word))) for word in text.split())
    return red, green, blue


def _read_nrrd_header(path: Path) -> list[str]:
    """Return the header lines of a NRRD, before the first empty line; an empty list for other files."""
    try:
        with path.open("rb") as file:
            head = file.read(LARGEST_TABLE)
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    if not head.startswith(NRRD.encode()):
        return []
    ends = re.search(rb"\r?\n\r?\n", head)
    return _decode(head if ends is None else head[: ends.start()]).splitlines()


def _read_text(path: Path) -> str:
    """Read a text file of limited size."""
    if not path.is_file():
        raise FormatError(missing_file(path))
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_TABLE + 1)
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    if len(content) > LARGEST_TABLE or b"\0" in content:
        raise FormatError(f"{path} is not a table of labels; give a text file with one label a line")
    return _decode(content)


def _decode(content: bytes) -> str:
    """Decode text as UTF-8, or else as Latin-1."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")
