"""Strokes drawn anew in the text of a print, and the proof that nothing else changed.

The new moves of a stroke stand where its old ones stood: they begin and end where those did, at their feed rate, with
their filament per mm. Every other line is copied. In files with absolute E, the counter is set to what the following
lines expect, as slicers themselves do with G92.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.gcode.lines import MOVE
from infill.gcode.numbers import write_words
from infill.gcode.sections import FILAMENT_UNIT, Strokes
from infill.gcode.table import Table, read
from infill.paths.corners import UNIT

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

RATE_TOLERANCE = 0.005  # of the filament per mm, beyond what decimals cost


@dataclass(frozen=True, kw_only=True)
class Redrawn:
    """New paths for some strokes.

    Parameters
    ----------
    which : (S,) int
        Numbers of the strokes, ascending.
    points : (K, 2) float64, mm
        Multiples of `UNIT`, one stroke after another, each from the first to the last point of the old one.
    first : (S + 1,) int
        Where each begins.
    source : (K,) int
        The old point, in the numbering of `Strokes.points`, that each stands for; ascending.
    filament : (S,) float64, mm
        That each extrudes.
    """

    which: Places
    points: Floats
    first: Places
    source: Places
    filament: Floats


@dataclass(frozen=True, kw_only=True)
class Spliced:
    """Text with strokes drawn anew.

    Parameters
    ----------
    text : bytes
    shift : (N + 1,) int
        How many lines more there are before each old line; for lines that were replaced, it means nothing.
    same : (N,) bool
        The lines that were copied and are not between the moves of a stroke that was drawn anew.
    """

    text: bytes
    shift: Places
    same: NDArray[np.bool_]


def spliced(table: Table, strokes: Strokes, new: Redrawn) -> Spliced:
    """Return the text of a table with some of its strokes drawn anew."""
    ends = _line_end(table)
    starts = np.zeros(len(new.points), dtype=bool)
    starts[new.first[:-1]] = True
    row = np.flatnonzero(~starts)
    owner = np.repeat(np.arange(len(new.which)), np.diff(new.first))
    begin_line = strokes.line[strokes.first[new.which]]  # the line before the first move
    first_line, last_line = begin_line + 1, strokes.line[strokes.first[new.which + 1] - 1]
    counter, words = _filament_words(table, new, row, owner, begin_line)
    feed = np.full(len(row), np.nan)
    # The first move tells the feed rate where the old one did.
    opens = np.concatenate([[0], np.cumsum(np.diff(new.first) - 1)])
    moves = strokes.line[strokes.first[new.which] + 1]
    feed[opens[:-1]] = np.where(table.given[moves, 4], table.f[moves], np.nan)
    columns = [(b" X", new.points[row, 0], 3), (b" Y", new.points[row, 1], 3), (b" E", words, 5), (b" F", feed, 3)]
    rows = write_words(columns, b"G1", ends)
    expected = table.e[last_line]
    reset = ~table.relative_e[last_line] & (np.abs(counter - expected) >= FILAMENT_UNIT / 2)
    pieces: list[bytes] = []
    done = 0  # old lines
    same = np.ones(len(table), dtype=bool)
    change = np.zeros(len(table) + 1, dtype=np.intp)
    for k in range(len(new.which)):
        first, last = int(first_line[k]), int(last_line[k])
        pieces.append(table.text(done, first))
        low, high = int(opens[k]), int(opens[k + 1])
        old = int(strokes.first[new.which[k] + 1] - strokes.first[new.which[k]]) - 1
        if last + 1 - first == old:
            pieces.append(rows.text[rows.start[low] : rows.start[high]])
        else:
            _mixed(pieces, table, strokes, new, k, row[low:high], low, rows.text, rows.start)
        if reset[k]:
            pieces.append(b"G92 E%s%s" % (_shortest(float(expected[k])), ends))
        same[first : last + 1] = False
        change[last + 1] += high - low - old + bool(reset[k])
        done = last + 1
    pieces.append(table.text(done, len(table)))
    return Spliced(text=b"".join(pieces), shift=np.cumsum(change), same=same)


def _mixed(
    pieces: list[bytes],
    table: Table,
    strokes: Strokes,
    new: Redrawn,
    k: int,
    row: Places,
    low: int,
    text: bytes,
    start: NDArray[np.int64],
) -> None:
    """Append the rows of a stroke with the lines that stood between its old moves, in their order."""
    at = slice(int(strokes.first[new.which[k]]), int(strokes.first[new.which[k] + 1]))
    lines = strokes.line[at]
    source = new.source[row]
    done = 0
    for place in range(1, len(lines)):
        upto = len(row) if place == len(lines) - 1 else int(np.searchsorted(source, at.start + place, side="right"))
        pieces.append(text[start[low + done] : start[low + upto]])
        done = upto
        if place < len(lines) - 1:
            pieces.append(table.text(int(lines[place]) + 1, int(lines[place + 1])))
    between = table.text(int(lines[0]) + 1, int(lines[1]))
    if between:  # nothing stands before the first move
        raise AssertionError("a stroke begins with something other than a move")


def _filament_words(
    table: Table, new: Redrawn, row: Places, owner: Places, begin_line: Places
) -> tuple[Floats, Floats]:
    """Return what the counter shows after each stroke, and the E word of every row."""
    length = np.hypot(*(new.points[row] - new.points[row - 1]).T)
    owner = owner[row]
    total = np.bincount(owner, weights=length, minlength=len(new.which))
    rate = new.filament / total
    along = np.cumsum(length)
    base = np.concatenate([[0.0], np.cumsum(total)])[:-1]
    pushed = (along - base[owner]) * rate[owner]  # since the stroke began
    before = np.where(begin_line >= 0, table.e[np.maximum(begin_line, 0)], table.before.e)
    relative = table.relative_e[np.maximum(begin_line + 1, 0)]
    steps = np.rint(pushed / FILAMENT_UNIT)
    first = np.concatenate([[True], np.diff(owner) != 0])[: len(owner)]
    step = np.diff(steps, prepend=0.0)
    step[first] = steps[first]
    absolute = np.rint((before[owner] + pushed) / FILAMENT_UNIT) * FILAMENT_UNIT
    words = np.where(relative[owner], step * FILAMENT_UNIT, absolute)
    last = np.concatenate([first[1:], [True]])[: len(owner)]
    return words[last], words


def _line_end(table: Table) -> bytes:
    return b"\r\n" if table.data[:4096].count(b"\r\n") > table.data[:4096].count(b"\n") / 2 else b"\n"


def _shortest(value: float) -> bytes:
    text = f"{value:.5f}".rstrip("0").rstrip(".")
    return text.encode() if text not in ("", "-", "-0") else b"0"


def unlike(table: Table, strokes: Strokes, new: Redrawn, done: Spliced) -> str:
    """Replay old and new text from the same state, and say how they differ where they must not; nothing if they agree.

    Compared are every line that was copied (kind, position, feed rate, filament), the state at the end, and the new
    moves: each extrudes what its stroke extrudes per mm, above 0, at its feed rate, without a move of z.
    """
    other = read(done.text, table.before)
    return differing(table, other, done) or _wrong_moves(table, strokes, new, done, other)


def differing(table: Table, other: Table, done: Spliced) -> str:
    """Say how the lines that were copied, or the state at the end, differ between old and new text."""
    if len(other) != len(table) + int(done.shift[-1]):
        return "the number of lines"
    old = np.flatnonzero(done.same)
    now = old + done.shift[old]
    if not (table.kind[old] == other.kind[now]).all():
        return "what a line is"
    for name in ("x", "y", "z", "f"):
        if not np.array_equal(getattr(table, name)[old], getattr(other, name)[now], equal_nan=True):
            return f"{name.upper()} after a line that was copied"
    near = 2.1 * FILAMENT_UNIT
    if np.abs(table.extruded[old] - other.extruded[now]).max(initial=0) > near:
        return "the filament of a line that was copied"
    absolute = ~table.relative_e[old]
    if np.abs(table.e[old] - other.e[now])[absolute].max(initial=0) > near:
        return "the counter of filament"
    return "" if _alike(other.after, table.after) else "the state at the end"


def _alike(one: object, other: object) -> bool:
    for name, value in vars(one).items():
        second = vars(other)[name]
        if name == "e" and vars(one)["relative_e"]:
            continue
        if isinstance(value, str | tuple):
            if value != second:
                return False
            continue
        if value != second and not (math.isnan(value) and math.isnan(second)) and abs(value - second) > 1e-4:
            return False
    return True


def _wrong_moves(table: Table, strokes: Strokes, new: Redrawn, done: Spliced, other: Table) -> str:
    """Say what is wrong with the new moves, if anything is."""
    fresh = np.ones(len(other), dtype=bool)
    old = np.flatnonzero(done.same)
    fresh[old + done.shift[old]] = False
    move = np.flatnonzero(fresh & (other.kind == MOVE) & (other.given[:, 0] | other.given[:, 1]))
    owner = np.repeat(np.arange(len(new.which)), np.diff(new.first) - 1)
    if len(move) != len(owner):
        return "the number of new moves"
    back = move - 1
    x = np.where(back >= 0, other.x[back], other.before.x)
    y = np.where(back >= 0, other.y[back], other.before.y)
    z = np.where(back >= 0, other.z[back], other.before.z)
    length = np.hypot(other.x[move] - x, other.y[move] - y)
    if not (other.z[move] == z).all():
        return "a new move in z"
    extruded = other.extruded[move]
    if not (extruded > 0).all():
        return "a new move without filament"
    feed = table.f[strokes.line[strokes.first[new.which] + 1]]
    if (np.abs(other.f[move] - feed[owner]) > UNIT).any():
        return "the feed rate of a new move"
    rate = new.filament / np.bincount(owner, weights=length, minlength=len(new.which))
    if (np.abs(extruded - rate[owner] * length) > RATE_TOLERANCE * rate[owner] * length + 2 * FILAMENT_UNIT).any():
        return "the filament per mm of a new move"
    ends = strokes.points[strokes.first[new.which + 1] - 1]
    last = move[np.append(np.flatnonzero(np.diff(owner)), len(owner) - 1)] if len(move) else move
    reached = np.stack([other.x[last], other.y[last]], axis=1)
    return "" if np.abs(reached - ends).max(initial=0) <= UNIT else "the end of a stroke"
