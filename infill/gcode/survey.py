"""Overview of a print: its slicer, its settings, and some of its layers, sampled across the file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import BinaryIO

from infill.errors import FormatError
from infill.gcode.ending import find_missing_end
from infill.gcode.limits import is_valid_limit
from infill.gcode.machine_state import MachineState
from infill.gcode.slicer_settings import extrusion_rule, filament_units
from infill.gcode.stream import LAYER_TAG, MAX_LINE_BYTES
from infill.gcode.table import read_table

HEAD = 1 << 18  # bytes read for the header and the modes
TAIL = 1 << 17  # bytes read for the settings
WINDOW = 1 << 18  # bytes read at each sampled place
MAX_WINDOW = 16 << 20
NEAREST = 1 << 12  # bytes before a place that are read first for a height
LAYERS_PER_WINDOW = 3  # layers at each place
WINDOWS, MORE_WINDOWS = 6, 16  # places
SMALL_FILE, ALL_WINDOWS = 1 << 19, 24  # bytes: nearly every layer of a smaller file is read
STAMP = b"; refilled by phasefill"
_SETTING = re.compile(rb"^; ([a-z][a-z0-9_]*) = (.*?)\r?$", re.MULTILINE)
_SLICER = re.compile(
    rb"(?:generated (?:by|with) |Sliced by |^; (?=BambuStudio ))([A-Za-z][\w.+-]*(?: (?!on\b)[\w.+-]+){0,3})",
    re.IGNORECASE | re.MULTILINE,
)
_HEIGHT = re.compile(rb"^G0?[0-3] [^;\n]*Z(\d*\.?\d+)", re.MULTILINE)
_ARC = re.compile(rb"^G0?[23] [^;\n]*[IJR][^;\n]*E", re.MULTILINE)
# First bytes of other kinds of files.
OTHER_FORMATS = {
    b"PK\x03\x04": "a zip or 3MF file",
    b"\x89PNG": "a picture",
    b"\xff\xd8\xff": "a picture",
    b"%PDF": "a PDF file",
    b"solid ": "an STL file",
}


@dataclass(frozen=True, kw_only=True)
class Survey:
    """Facts about a print before it is read completely.

    Parameters
    ----------
    size : int
        Bytes.
    slicer : str
        Its name for itself; "" if there is none.
    settings : dict
        Its settings by its own names, as far as the file states them.
    begin : MachineState
        Modes at the first layer, with the position unknown.
    stamp : bytes
        The line that an earlier refill wrote; empty if there was none.
    resets_filament : bool
        The file itself sets its counter of filament by G92.
    windows : tuple of (bytes, float)
        Whole layers at several places of the file, and the height before each, mm; NaN where nothing gives it.
    layers : float
        Approximate number of layers.
    small : bool
        True if nearly every layer was read.
    missing_end : str
        The line with which its slicer ends a file, if it lacks that; else "".
    has_arcs : bool
        It prints arcs, G2 or G3.
    """

    size: int
    slicer: str
    settings: dict[str, str]
    begin: MachineState
    stamp: bytes
    resets_filament: bool
    windows: tuple[tuple[bytes, float], ...]
    layers: float
    small: bool
    missing_end: str = ""
    has_arcs: bool = False

    def number(self, *names: str, limit: str = "") -> float | None:
        """Return the first of several settings that is present, as a number; the first item of a list.

        With the name of a `limit`, return only a number that a machine may have.
        """
        for name in names:
            try:
                number = float(self.settings[name].split(",")[0].rstrip("%"))
            except (KeyError, ValueError):
                continue
            if math.isfinite(number):
                return number if not limit or is_valid_limit(number, limit) else None
        return None


def survey_print(file: BinaryIO, *, more: bool = False, settings: Mapping[str, str] | None = None) -> Survey:
    """Sample a print; leave the file at its beginning.

    Parameters
    ----------
    file : binary file
    more : bool
        Read more places: where layers differ, a few do not show the amount of infill.
    settings : mapping, optional
        Settings of the slicer from outside the text.

    Raises
    ------
    FormatError
        If the file is not G-code, or has no marked layers.
    """
    size = file.seek(0, os.SEEK_END)
    file.seek(0)
    head = file.read(HEAD)
    _check_is_gcode(head, size)
    file.seek(max(0, size - TAIL))
    tail = file.read(TAIL)
    file_settings = {
        name.decode(): value.decode("utf-8", "replace").strip()
        for text in (head, tail if size > HEAD else b"")
        for name, value in _SETTING.findall(text)
    }
    slicer = _SLICER.search(head[:8192])
    first_tag = LAYER_TAG.search(head)
    all_settings = {**file_settings, **(settings or {})}
    volumetric, diameters = filament_units(head, all_settings)
    unmoved = MachineState(volumetric=volumetric, diameters=diameters, firmware=extrusion_rule(head, all_settings))
    before = read_table(head[: first_tag.start()] if first_tag else head[: head.rfind(b"\n") + 1], unmoved).after
    begin = MachineState(
        relative=before.relative,
        relative_e=before.relative_e,
        absolute_e=before.absolute_e,
        firmware=before.firmware,
        inches=before.inches,
        tool=before.tool,
        retracted=before.retracted,
        f=before.f,
        volumetric=before.volumetric,
        diameters=before.diameters,
    )
    windows = ALL_WINDOWS if size <= SMALL_FILE else MORE_WINDOWS if more else WINDOWS
    samples = [_read_window(file, size, (k + 0.5) / windows) for k in range(windows)]
    samples = list({text: (text, z) for text, z in samples if text}.values())
    slicer_name = slicer[1].decode("latin-1").strip() if slicer else ""
    tags = sum(len(LAYER_TAG.findall(text)) for text, _ in samples)
    file.seek(0)
    return Survey(
        size=size,
        slicer=slicer_name,
        settings=all_settings,
        begin=begin,
        stamp=head[head.find(STAMP) :].partition(b"\n")[0] if STAMP in head else b"",
        resets_filament=b"G92 E" in head or any(b"G92 E" in text for text, _ in samples),
        windows=tuple(samples),
        layers=size * tags / max(1, sum(len(text) for text, _ in samples)),
        small=size <= SMALL_FILE,
        missing_end="" if settings else find_missing_end(slicer_name, tail),
        has_arcs=any(_ARC.search(text) is not None for text in (head, *(text for text, _ in samples))),
    )


def merge_surveys(surveys: Sequence[Survey]) -> Survey:
    """Combine the surveys of several prints: the sum of their bytes, and their common settings."""
    base = surveys[0]
    shared = set.intersection(*(set(member.settings.items()) for member in surveys))
    settings = {name: value for name, value in base.settings.items() if (name, value) in shared}
    has_arcs = any(member.has_arcs for member in surveys)
    return replace(base, size=sum(member.size for member in surveys), settings=settings, has_arcs=has_arcs)


def _check_is_gcode(head: bytes, size: int) -> None:
    """Raise FormatError if a file with this beginning is not G-code text."""
    if not size:
        raise FormatError("the file is empty; give the G-code that a slicer wrote")
    for magic, name in OTHER_FORMATS.items():
        if head.startswith(magic):
            raise FormatError(f"the file is {name}; give the G-code that a slicer wrote, as text")
    if b"\0" in head:
        raise FormatError("the file holds bytes that no text has; give the G-code that a slicer wrote, as text")
    if b"\n" not in head and size > MAX_LINE_BYTES:
        raise FormatError("the file has no lines; give the G-code that a slicer wrote")
    if not re.search(rb"^\s*(?:N\d+ ?)?[GgMm]\d", head, re.MULTILINE):
        raise FormatError("the file has no line of G-code in it; give the G-code that a slicer wrote")


def _read_window(file: BinaryIO, size: int, share: float) -> tuple[bytes, float]:
    """Return up to three whole layers around a place, and the height before them, mm; no text if there is no layer."""
    begin = int(size * share)
    file.seek(begin)
    text = file.read(WINDOW)
    while len(text) < MAX_WINDOW:
        tags = [match.start() for match in islice(LAYER_TAG.finditer(text), LAYERS_PER_WINDOW + 1)]
        if len(tags) > LAYERS_PER_WINDOW:
            return text[tags[0] : tags[-1]], _height_before(file, begin + tags[0])
        more = file.read(len(text))
        if not more:
            break
        text += more
    tags = [match.start() for match in LAYER_TAG.finditer(text)]
    if len(tags) < 2:
        return b"", math.nan
    return text[tags[0] : tags[-1]], _height_before(file, begin + tags[0])


def _height_before(file: BinaryIO, place: int) -> float:
    """Return the height that the last move before a place of a file gives, mm; NaN if none near it does."""
    length = min(place, NEAREST)
    while True:
        file.seek(place - length)
        heights = _HEIGHT.findall(file.read(length))
        if heights or length == min(place, WINDOW):
            return float(heights[-1]) if heights else math.nan
        length = min(place, WINDOW, 4 * length)
