"""Sections of infill that can get new paths, each with all lines from its first to its last move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.arrays import Floats, Places
from infill.gcode.lines import ARC, ODD, GcodeCommand
from infill.gcode.machine_state import sets_counter
from infill.gcode.sections import LineMarks, is_printing
from infill.gcode.strokes import InfillStrokes
from infill.gcode.table import GcodeTable

SECTION_RATE_VARIATION = 0.03  # strokes of one section have equal filament per mm up to this share
ODD_ARCS = "arcs that climb or close on no circle"
LONG_STROKE = 2.0  # mm: where a section has strokes this long, shorter ones do not count
# Commands that may be sent at the end of a section as well as in the middle.
HARMLESS_COMMANDS = {"M73", "M117", "M118", "M106", "M107", "M204", "M205", "M900", "M572", "M70", "G10", "G11"}
HARMLESS_WORDS = {"SET_VELOCITY_LIMIT", "SET_PRESSURE_ADVANCE"}


@dataclass(frozen=True, kw_only=True)
class InfillSection:
    """The lines from the first to the last move of a section, inclusive.

    Parameters
    ----------
    section : int
    first, last : int
        Lines of the table.
    strokes : (S,) int
        Strokes of the section.
    start, end : (2,) float64, mm
        Nozzle before the first move, and after the last one.
    z : float, mm
    layer : int
    rate : float
        mm of filament per mm.
    filament, length : float, mm
        Of all strokes.
    feed, feed_after : float, mm/min
        Of the moves, and in force at the end.
    """

    section: int
    first: int
    last: int
    strokes: Places
    start: Floats
    end: Floats
    z: float
    layer: int
    rate: float
    filament: float
    length: float
    feed: float
    feed_after: float


def find_sections(
    table: GcodeTable, marks: LineMarks, infill: InfillStrokes
) -> tuple[list[InfillSection], dict[str, list[int]]]:
    """Find the sections that can get new paths; return them, and the numbers of the other sections by reason."""
    editable: list[InfillSection] = []
    odd: dict[str, list[int]] = {}
    opens, closes = infill.opens, infill.closes
    section = marks.section[opens]
    commands = {command.line: command for command in table.commands}
    for number in np.unique(section):
        stroke_rows = np.flatnonzero(section == number)
        reason = _refusal_reason(
            table, marks, infill, stroke_rows, int(opens[stroke_rows[0]]), int(closes[stroke_rows[-1]]), commands
        )
        if reason:
            odd.setdefault(reason, []).append(int(number))
            continue
        length, filament = infill.length[stroke_rows], infill.filament[stroke_rows]
        feeds, which = np.unique(table.f[opens[stroke_rows]], return_inverse=True)
        last_line = int(closes[stroke_rows[-1]])
        editable.append(
            InfillSection(
                section=int(number),
                first=int(opens[stroke_rows[0]]),
                last=last_line,
                strokes=stroke_rows,
                start=infill.points[infill.first[stroke_rows[0]]],
                end=infill.points[infill.first[stroke_rows[-1] + 1] - 1],
                z=float(table.z[opens[stroke_rows[0]]]),
                layer=int(marks.layer[opens[stroke_rows[0]]]),
                rate=float(filament.sum() / length.sum()),
                filament=float(filament.sum()),
                length=float(length.sum()),
                feed=float(feeds[np.argmax(np.bincount(which, length))]),
                feed_after=float(table.f[last_line]),
            )
        )
    return editable, odd


def _refusal_reason(
    table: GcodeTable,
    marks: LineMarks,
    infill: InfillStrokes,
    stroke_rows: Places,
    first_line: int,
    last_line: int,
    commands: dict[int, GcodeCommand],
) -> str:
    """Name the reason why a section cannot get new paths; "" if it can."""
    inside = slice(first_line, last_line + 1)
    drawn = np.zeros(last_line + 1 - first_line, dtype=bool)
    drawn[infill.moves_between(first_line, last_line) - first_line] = True
    if ((table.kind[inside] == ODD) & ~drawn).any():
        return "a line that cannot be read"
    if ((table.kind[inside] == ARC) & ~drawn & ~(table.extruded[inside] <= 0)).any():  # wipes may be arcs too
        return ODD_ARCS
    if table.numbered[inside].any():
        return "line numbers"
    rate = infill.filament[stroke_rows] / infill.length[stroke_rows]
    if np.ptp(rate) > SECTION_RATE_VARIATION * rate.mean():
        long = infill.length[stroke_rows] > LONG_STROKE
        if np.ptp(rate[long] if long.any() else rate) > SECTION_RATE_VARIATION * rate.mean():
            return "lines of different widths"
    if np.isnan(table.z[first_line]) or np.ptp(table.z[infill.opens[stroke_rows]]) > 0:
        return "lines at different heights"
    for line in range(first_line, last_line + 1):
        command = commands.get(line)
        if command is not None and not _is_harmless(command):
            return f"a {command.code or 'strange'} command in between"
    # Everything that extrudes between the first and the last move of the section must be a stroke.
    moving = np.flatnonzero(is_printing(table)[inside]) + first_line
    return (
        ""
        if drawn[moving - first_line].all() and (marks.section[inside] == marks.section[first_line]).all()
        else "extrusion of another kind"
    )


def _is_harmless(command: GcodeCommand) -> bool:
    """Return True if a command may stand between moves that get new paths."""
    return command.code in HARMLESS_COMMANDS or command.code in HARMLESS_WORDS or sets_counter(command)
