"""What the numbers of a segmentation mean: names and colours, from the tables that other programs write.

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

LARGEST = 10 * 2**20  # bytes of a table, or of the header of an image
SNAP = re.compile(r'(-?\d+)\s+(\d+)\s+(\d+)\s+(\d+)\s+[\d.]+\s+\d+\s+\d+\s+"([^"]*)"')
LUT = re.compile(r"(-?\d+)\s+(.*?\S)\s+(\d+)\s+(\d+)\s+(\d+)(?:\s+\d+)?")
FIELD = re.compile(r"Segment(\d+)_(Name|LabelValue|Layer|Color):=(.*)")
HIGHEST = 255
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
        What it is called; empty if nobody says.
    colour : (red, green, blue), optional
        From 0 to 1, sRGB.
    layer : int
        Which of the volumes of the segmentation it lies in, counted from 0.
    """

    value: int
    name: str = ""
    colour: Colour | None = None
    layer: int = 0


def read_labels(path: str | os.PathLike[str]) -> tuple[Segment, ...]:
    """Return the labels of a table, in the order of the file; where a number stands twice, the last line counts.

    Parameters
    ----------
    path : str or Path
        Label descriptions of ITK-SNAP, a lookup table of FreeSurfer, or a colour table (.ctbl) of 3D Slicer.

    Raises
    ------
    FormatError
        If there is no such file, it is none of these, or it holds no label.
    """
    source = Path(path)
    text = _text(source)
    found: dict[int, Segment] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.strip()
        if not words or words.startswith("#"):
            continue
        segment = _described(words)
        if segment is None:
            raise FormatError(
                f"{source} has no label in line {number}; give label descriptions of ITK-SNAP, a lookup table of "
                "FreeSurfer or a .ctbl of 3D Slicer"
            )
        found[segment.value] = segment
    if not found:
        raise FormatError(f"{source} names no label; check that it is the right file")
    return tuple(found.values())


def _described(line: str) -> Segment | None:
    """Return the label that a line describes, or None."""
    if snap := SNAP.fullmatch(line):
        value, *colour, name = snap.groups()
    elif lut := LUT.fullmatch(line):
        value, name, *colour = lut.groups()
    else:
        return None
    if any(int(each) > HIGHEST for each in colour):
        return None
    red, green, blue = (int(each) / HIGHEST for each in colour)
    return Segment(value=int(value), name=name.strip(), colour=(red, green, blue))


def segments_of_nrrd(path: str | os.PathLike[str]) -> tuple[Segment, ...]:
    """Return the segments that 3D Slicer named in the header of a .nrrd; none if there are none.

    Raises
    ------
    FormatError
        If a field of a segment holds something other than it should.
    """
    source = Path(path)
    fields = [
        (int(found[1]), found[2], found[3].strip())
        for line in _nrrd_header(source)
        if (found := FIELD.fullmatch(line)) is not None
    ]
    segments = []
    for number, each in groupby(sorted(fields), key=lambda field: field[0]):
        known = {key: value for _, key, value in each}
        try:
            # Before layers could be shared, every segment had one of its own, of zeros and ones.
            segment = Segment(
                value=int(known.get("LabelValue", "1")),
                name=known.get("Name", "").replace("\\n", " ").replace("\\\\", "\\"),
                colour=_shares(known["Color"]) if "Color" in known else None,
                layer=int(known.get("Layer", "0" if "LabelValue" in known else str(number))),
            )
        except ValueError as error:
            raise FormatError(f"{source} describes segment {number} wrongly ({error}); save it again") from error
        segments.append(segment)
    return tuple(segments)


def _shares(text: str) -> Colour:
    red, green, blue = (min(1.0, max(0.0, float(word))) for word in text.split())
    return red, green, blue


def _nrrd_header(path: Path) -> list[str]:
    """Return the lines before the first empty one; none if the file is no NRRD."""
    try:
        with path.open("rb") as file:
            head = file.read(LARGEST)
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    if not head.startswith(NRRD.encode()):
        return []
    ends = re.search(rb"\r?\n\r?\n", head)
    return _decoded(head if ends is None else head[: ends.start()]).splitlines()


def _text(path: Path) -> str:
    if not path.is_file():
        raise FormatError(f"there is no file {path}; check the name")
    try:
        with path.open("rb") as file:
            held = file.read(LARGEST + 1)
    except OSError as error:
        raise FormatError(f"cannot read {path}: {error.strerror or error}; check the file") from error
    if len(held) > LARGEST or b"\0" in held:
        raise FormatError(f"{path} is no table of labels; give a text file with one label a line")
    return _decoded(held)


def _decoded(held: bytes) -> str:
    try:
        return held.decode("utf-8-sig")
    except UnicodeDecodeError:
        return held.decode("latin-1")
