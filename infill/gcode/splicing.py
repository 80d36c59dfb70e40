"""New paths for strokes in the text of a print, and the proof that everything else is unchanged.

The new moves of a stroke replace its old ones: they begin and end at the same points, at the same feed rate, with
the same filament per mm. Every other line is copied. In files with absolute E, the counter is set to the value that
the next lines expect, as slicers themselves do with G92.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.gcode.arcs import find_arcs, mark_arc_lines, path_steps
from infill.gcode.lines import ARC
from infill.gcode.numbers import format_word
from infill.gcode.path_moves import PathMoves, plan_moves
from infill.gcode.strokes import FILAMENT_UNIT, InfillStrokes
from infill.gcode.table import GcodeTable, read_table
from infill.paths.corners import UNIT

RATE_TOLERANCE = 0.005  # of the filament per mm, in addition to rounding


@dataclass(frozen=True, kw_only=True)
class NewPaths:
    """New paths for some strokes.

    Parameters
    ----------
    which : (S,) int
        Numbers of the strokes, ascending.
    points : (K, 2) float64, mm
        Multiples of `UNIT`, one stroke after another, each from the first to the last point of the old one.
    first : (S + 1,) int
        Start of each path.
    source : (K,) int
        The old point, in the numbering of `InfillStrokes.points`, for which each point stands; ascending.
    filament : (S,) float64, mm
        Filament of each path.
    arc_deviation : float, mm
        As for `plan_moves`.
    """

    which: Places
    points: Floats
    first: Places
    source: Places
    filament: Floats
    arc_deviation: float = 0.0

    def plan(self, strokes: InfillStrokes) -> PathMoves:
        """Plan the moves of the paths; no arc passes a line that stands between the old moves."""
        if not self.arc_deviation:
            return plan_moves(self.points, self.first)
        interrupted = np.flatnonzero(np.diff(strokes.line) > 1)  # after these old points, or a stroke ends there
        stops = np.zeros(len(self.points) + 1, dtype=bool)
        stops[np.searchsorted(self.source, interrupted, side="right") - 1] = True
        return plan_moves(self.points, self.first, arc_deviation=self.arc_deviation, stops=stops[:-1])


@dataclass(frozen=True, kw_only=True)
class SplicedText:
    """Text with new paths for some strokes.

    Parameters
    ----------
    text : bytes
    shift : (N + 1,) int
        Number of lines added before each old line; invalid for lines that were replaced.
    same : (N,) bool
        The lines that were copied and do not stand between the moves of a replaced stroke.
    owner : (R,) int
        Of new paths: the number of the path of each move.
    """

    text: bytes
    shift: Places
    same: NDArray[np.bool_]
    owner: Places = field(default_factory=lambda: np.empty(0, dtype=np.intp))

    def new_lines(self, count: int) -> NDArray[np.bool_]:
        """Mark the lines of the new text, `count` in all, that are not copies of old ones."""
        new = np.ones(count, dtype=bool)
        old = np.flatnonzero(self.same)
        new[old + self.shift[old]] = False
        return new


def splice_paths(table: GcodeTable, strokes: InfillStrokes, new: NewPaths) -> SplicedText:
    """Replace strokes of a table by new paths; return the new text."""
    ends = _line_end(table)
    planned = new.plan(strokes)
    begin_line = strokes.line[strokes.first[new.which]]  # the line before the first move
    first_line, last_line = begin_line + 1, strokes.line[strokes.first[new.which + 1] - 1]
    counter, words = _filament_words(table, new, planned, begin_line)
    feed = np.full(len(planned.end), np.nan)
    # The first move states the feed rate where the old one did.
    opens = planned.first
    moves = strokes.line[strokes.first[new.which] + 1]
    feed[opens[:-1]] = np.where(table.given[moves, 4], table.f[moves], np.nan)
    rows = planned.write(words, feed, ends)
    expected = table.e[last_line]
    reset = ~table.relative_e[last_line] & (np.abs(counter - expected) >= FILAMENT_UNIT / 2)
    pieces: list[bytes] = []
    copied_lines = 0  # old lines
    same = np.ones(len(table), dtype=bool)
    change = np.zeros(len(table) + 1, dtype=np.intp)
    for k in range(len(new.which)):
        first_old, last_old = int(first_line[k]), int(last_line[k])
        pieces.append(table.text(copied_lines, first_old))
        low, high = int(opens[k]), int(opens[k + 1])
        old = len(strokes.moves_between(first_old, last_old))
        if last_old + 1 - first_old == old:
            pieces.append(rows.text[rows.start[low] : rows.start[high]])
        else:
            _append_mixed(pieces, table, strokes, new, k, planned.end[low:high], low, rows.text, rows.start)
        if reset[k]:
            pieces.append(b"G92 E%s%s" % (format_word(float(expected[k]), 5), ends))
        same[first_old : last_old + 1] = False
        change[last_old + 1] += high - low - old + bool(reset[k])
        copied_lines = last_old + 1
    pieces.append(table.text(copied_lines, len(table)))
    return SplicedText(text=b"".join(pieces), shift=np.cumsum(change), same=same, owner=planned.owner)


def _append_mixed(
    pieces: list[bytes],
    table: GcodeTable,
    strokes: InfillStrokes,
    new: NewPaths,
    k: int,
    row: Places,
    low: int,
    text: bytes,
    start: NDArray[np.int64],
) -> None:
    """Append the rows of a stroke with the lines that stood between its old moves, in order."""
    at = slice(int(strokes.first[new.which[k]]), int(strokes.first[new.which[k] + 1]))
    lines = strokes.line[at]
    source = new.source[row]
    copied_rows = 0
    for place in range(1, len(lines)):
        upto = len(row) if place == len(lines) - 1 else int(np.searchsorted(source, at.start + place, side="right"))
        pieces.append(text[start[low + copied_rows] : start[low + upto]])
        copied_rows = upto
        if place < len(lines) - 1:
            pieces.append(table.text(int(lines[place]) + 1, int(lines[place + 1])))
    between = table.text(int(lines[0]) + 1, int(lines[1]))
    if between:  # no line stands before the first move
        raise AssertionError("a stroke begins with something other than a move")


def _filament_words(table: GcodeTable, new: NewPaths, planned: PathMoves, begin_line: Places) -> tuple[Floats, Floats]:
    """Return the counter after each stroke, and the E word of every move."""
    length, owner = planned.length, planned.owner
    total = np.bincount(owner, weights=length, minlength=len(new.which))
    rate = new.filament / total
    along = np.cumsum(length)
    base = np.concatenate([[0.0], np.cumsum(total)])[:-1]
    pushed = (along - base[owner]) * rate[owner]  # since the start of the stroke
    before = np.where(begin_line >= 0, table.e[np.maximum(begin_line, 0)], table.before.e)
    relative = table.relative_e[np.maximum(begin_line + 1, 0)]
    steps = np.rint(pushed / FILAMENT_UNIT)
    is_first = np.concatenate([[True], np.diff(owner) != 0])[: len(owner)]
    step = np.diff(steps, prepend=0.0)
    step[is_first] = steps[is_first]
    absolute = np.rint((before[owner] + pushed) / FILAMENT_UNIT) * FILAMENT_UNIT
    words = np.where(relative[owner], step * FILAMENT_UNIT, absolute)
    is_last = np.concatenate([is_first[1:], [True]])[: len(owner)]
    return words[is_last], words


def _line_end(table: GcodeTable) -> bytes:
    """Return the line end that is more frequent at the beginning of a file."""
    return b"\r\n" if table.data[:4096].count(b"\r\n") > table.data[:4096].count(b"\n") / 2 else b"\n"


def verify_replay(table: GcodeTable, strokes: InfillStrokes, new: NewPaths, spliced_text: SplicedText) -> str:
    """Replay old and new text from the same state; describe the first forbidden difference, "" if there is none.

    Compare every copied line (kind, position, feed rate, filament), the state at the end, and the new moves: each has
    the filament per mm of its stroke, above 0, its feed rate, and no move of z.
    """
    new_table = read_table(spliced_text.text, table.before)
    return find_difference(table, new_table, spliced_text) or _find_wrong_move(
        table, strokes, new, spliced_text, new_table
    )


def find_difference(table: GcodeTable, new_table: GcodeTable, spliced_text: SplicedText) -> str:
    """Describe the first difference in copied lines, or in the state at the end, of two texts; "" without one."""
    if len(new_table) != len(table) + int(spliced_text.shift[-1]):
        return "the number of lines"
    old_rows = np.flatnonzero(spliced_text.same)
    new_rows = old_rows + spliced_text.shift[old_rows]
    if not (table.kind[old_rows] == new_table.kind[new_rows]).all():
        return "what a line is"
    for name in ("x", "y", "z", "f"):
        if not np.array_equal(getattr(table, name)[old_rows], getattr(new_table, name)[new_rows], equal_nan=True):
            return f"{name.upper()} after a line that was copied"
    tolerance = 2.1 * FILAMENT_UNIT
    if np.abs(table.extruded[old_rows] - new_table.extruded[new_rows]).max(initial=0) > tolerance:
        return "the filament of a line that was copied"
    absolute = ~table.relative_e[old_rows]
    if np.abs(table.e[old_rows] - new_table.e[new_rows])[absolute].max(initial=0) > tolerance:
        return "the counter of filament"
    return "" if _states_agree(new_table.after, table.after) else "the state at the end"


def _states_agree(state: object, expected: object) -> bool:
    """Tell whether two machine states are equal to 1e-4; e counts only where it is absolute."""
    for name, value in vars(state).items():
        second = vars(expected)[name]
        if name == "e" and vars(state)["relative_e"]:
            continue
        if isinstance(value, str | tuple):
            if value != second:
                return False
            continue
        if value != second and not (math.isnan(value) and math.isnan(second)) and abs(value - second) > 1e-4:
            return False
    return True


def _find_wrong_move(
    table: GcodeTable, strokes: InfillStrokes, new: NewPaths, spliced_text: SplicedText, new_table: GcodeTable
) -> str:
    """Describe the first fault of the new moves; "" if there is none."""
    fresh = spliced_text.new_lines(len(new_table))
    move = np.flatnonzero(fresh & (new_table.code >= 0) & (new_table.given[:, 0] | new_table.given[:, 1]))
    owner = spliced_text.owner
    if len(move) != len(owner):
        return "the number of new moves"
    if not mark_arc_lines(find_arcs(new_table), len(new_table))[move[new_table.kind[move] == ARC]].all():
        return "a new arc that closes on no circle"
    z = np.where(move >= 1, new_table.z[move - 1], new_table.before.z)
    length = path_steps(new_table)[move]
    if not (new_table.z[move] == z).all():
        return "a new move in z"
    extruded = new_table.extruded[move]
    if not (extruded > 0).all():
        return "a new move without filament"
    feed = table.f[strokes.line[strokes.first[new.which] + 1]]
    if (np.abs(new_table.f[move] - feed[owner]) > UNIT).any():
        return "the feed rate of a new move"
    rate = new.filament / np.bincount(owner, weights=length, minlength=len(new.which))
    if (np.abs(extruded - rate[owner] * length) > RATE_TOLERANCE * rate[owner] * length + 2 * FILAMENT_UNIT).any():
        return "the filament per mm of a new move"
    ends = strokes.points[strokes.first[new.which + 1] - 1]
    last_move = move[np.append(np.flatnonzero(np.diff(owner)), len(owner) - 1)] if len(move) else move
    end_points = np.stack([new_table.x[last_move], new_table.y[last_move]], axis=1)
    return "" if np.abs(end_points - ends).max(initial=0) <= UNIT else "the end of a stroke"
