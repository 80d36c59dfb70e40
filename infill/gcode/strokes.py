"""Strokes of the sparse infill of a sliced print."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.gcode.arcs import find_arcs, mark_arc_lines
from infill.gcode.lines import BLANK, COMMENT, MOVE
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import SPARSE, LineMarks, TagState, is_printing, mark_lines
from infill.gcode.stream import batches
from infill.gcode.table import GcodeTable, read_table

RATE_VARIATION = 0.02  # two moves extrude alike if their filament per mm differs by less than this share
CHORD_SAGITTA = 0.004  # mm between an arc and the chords that stand for it
FILAMENT_UNIT = 1e-5  # mm: the last decimal of an E word
# Commands to the display or the host alone: moves before and after them are still one line of plastic.
DISPLAY_COMMANDS = {"M73", "M117", "M118", "M70"}


@dataclass(frozen=True, kw_only=True)
class InfillStrokes:
    """The sparse infill of a table: runs of moves of equal filament per mm without a travel between them.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The strokes one after another, each with its start.
    first : (M + 1,) int
        Stroke k has the points `first[k]` to `first[k + 1]`.
    line : (N,) int
        The line that ends at each point, or the arc on which it lies; for the first point of a stroke, the line before
        its first move.
    filament : (M,) float64, mm
        Filament of each stroke.
    length : (M,) float64, mm
    sections, purged_sections : (S,) and (P,) int, ascending
        All sections that print infill, also those without strokes, and those that take purged filament.
    """

    points: Floats
    first: Places
    line: Places
    filament: Floats
    length: Floats
    sections: Places
    purged_sections: Places

    def __len__(self) -> int:
        return len(self.first) - 1

    @cached_property
    def opens(self) -> Places:
        """The line of the first move of each stroke, (M,)."""
        return self.line[self.first[:-1] + 1]

    @cached_property
    def closes(self) -> Places:
        """The line of the last move of each stroke, (M,)."""
        return self.line[self.first[1:] - 1]

    @cached_property
    def moves(self) -> Places:
        """The lines of all moves of the strokes, ascending."""
        lines = np.delete(self.line, self.first[:-1])
        return np.asarray(lines[np.diff(lines, prepend=-1) > 0])

    def moves_between(self, first_line: int, last_line: int) -> Places:
        """Return the lines of moves from one line to another, inclusive."""
        low, high = np.searchsorted(self.moves, [first_line, last_line + 1])
        return self.moves[low:high]


def read_strokes(
    file: BinaryIO, begin: MachineState | None = None
) -> Iterator[tuple[GcodeTable, LineMarks, InfillStrokes]]:
    """Yield a print in batches of whole layers, from the position of the file to its end, each with its infill.

    Parameters
    ----------
    file : binary file
    begin : MachineState, optional
        The state before.
    """
    state, tags = begin or MachineState(), TagState()
    for text in batches(file):
        table, marks, infill = mark_text(text, state, tags)
        yield table, marks, infill
        state, tags = table.after, marks.after


def mark_text(
    text: bytes, state: MachineState, tags: TagState | None = None
) -> tuple[GcodeTable, LineMarks, InfillStrokes]:
    """Read some text of a print, mark its lines, and find its infill; `state` and `tags` are those before it."""
    table = read_table(text, state)
    marks = mark_lines(table, tags or TagState())
    return table, marks, find_strokes(table, marks)


def find_strokes(table: GcodeTable, marks: LineMarks, role: str = SPARSE) -> InfillStrokes:
    """Find the strokes of `role`.

    A stroke ends where the feed rate or the filament per mm changes, and at every line other than a comment or talk
    to the display. Lines with something odd (line numbers, relative moves, inches, a change of z) are in no stroke.
    An arc lies in the plane of the layers, and its points are those of its chords.
    """
    x0, y0, z0 = (_previous_values(getattr(table, name), getattr(table.before, name)) for name in "xyz")
    arcs = find_arcs(table)
    length = np.hypot(table.x - x0, table.y - y0)
    length[arcs.line] = arcs.length
    on_arc = mark_arc_lines(arcs, len(table))
    with np.errstate(invalid="ignore"):
        drawn = ((table.kind == MOVE) | on_arc) & (table.extruded > 0) & (length > 0) & np.isfinite(length)
    drawn &= (table.z == z0) | ~table.given[:, 2]
    drawn &= marks.is_role(role) & ~marks.wiping & ~table.numbered & ~table.unsure & ~_is_unsupported(table)
    passive = ((table.kind == COMMENT) & ~marks.tagged) | (table.kind == BLANK)
    for command in table.commands:
        passive[command.line] |= command.code in DISPLAY_COMMANDS
    feed = _previous_values(table.f, table.before.f)
    with np.errstate(invalid="ignore"):
        passive |= (table.kind == MOVE) & ~table.moves & (table.f == feed)
    rows = np.flatnonzero(drawn)
    broken = np.cumsum(~(drawn | passive))
    rate = table.extruded[rows] / length[rows]
    unsure = FILAMENT_UNIT / length[rows]
    before_row, after_row = rows[:-1], rows[1:]
    joined = (broken[before_row] == broken[after_row]) & (table.f[before_row] == table.f[after_row])
    joined &= np.abs(np.diff(rate)) <= RATE_VARIATION * rate[:-1] + unsure[:-1] + unsure[1:]
    begins = np.flatnonzero(np.concatenate([[True], ~joined])[: len(rows)])
    # A move has one point, its end, an arc those of its chords; every stroke has one more, its start.
    count = np.ones(len(rows), dtype=np.intp)
    arc, chord_ends = arcs.select(drawn[arcs.line]).chord_ends(CHORD_SAGITTA)
    count[on_arc[rows]] = np.bincount(arc)
    move = np.repeat(np.arange(len(rows)), count)
    ends = np.stack([table.x[rows], table.y[rows]], axis=1)[move]
    ends[on_arc[rows][move]] = chord_ends
    first_end = (np.cumsum(count) - count)[begins]
    line = np.insert(rows[move], first_end, rows[begins] - 1)
    starts = np.stack([x0[rows[begins]], y0[rows[begins]]], axis=1)
    points = np.insert(ends, first_end, starts, axis=0)
    stroke_start = np.append(first_end + np.arange(len(begins)), len(points))
    sums = (np.add.reduceat(v[rows], begins) if len(rows) else np.empty(0) for v in (table.extruded, length))
    filament, total = sums
    return InfillStrokes(
        points=points,
        first=stroke_start,
        line=line,
        filament=filament,
        length=total,
        sections=np.unique(marks.section[(marks.is_role(role) | marks.purged) & is_printing(table)]),
        purged_sections=np.unique(marks.section[marks.purged & is_printing(table)]),
    )


def _previous_values(values: Floats, before: float) -> Floats:
    """Return the value before each line."""
    return np.concatenate([[before], values[:-1]])[: len(values)]


def _is_unsupported(table: GcodeTable) -> NDArray[np.bool_]:
    """Return True for lines whose moves are relative or in inches."""
    strange = np.zeros(len(table), dtype=bool)
    relative, inches = table.before.relative, table.before.inches
    since = 0
    for command in table.commands:
        if command.code in ("G90", "G91", "G20", "G21"):
            strange[since : command.line] = relative or inches
            since = command.line
            relative = command.code == "G91" if command.code in ("G90", "G91") else relative
            inches = command.code == "G20" if command.code in ("G20", "G21") else inches
    strange[since:] = relative or inches
    return strange
