"""Arcs of a print, G2 and G3, in the plane of its layers: their circles, their lengths, and points on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats, Places
from infill.gcode.chords import arc_turns, centres_by_radius, stated_circles
from infill.gcode.lines import ARC, ODD
from infill.gcode.table import OFF_CIRCLE, GcodeTable

SMALLEST_RADIUS, LARGEST_RADIUS = 1e-3, 1e5  # mm
LEAST_STEP = 0.02  # mm between points on an arc
XY_PLANE = 17  # as G17 selects it
DECIMALS = 3  # of a position in G-code


@dataclass(frozen=True, kw_only=True)
class PlaneArcs:
    """Arcs in the plane of the layers.

    Parameters
    ----------
    line : (N,) int, ascending
    start, end, centre : (N, 2) float64, mm
    turn : (N,) float64
        Radians, positive counterclockwise.
    """

    line: Places
    start: Floats
    end: Floats
    centre: Floats
    turn: Floats

    def __len__(self) -> int:
        return len(self.line)

    @property
    def radius(self) -> Floats:
        """Mean distance of both ends from the centre, (N,), mm."""
        ends = np.hypot(*(self.start - self.centre).T), np.hypot(*(self.end - self.centre).T)
        return np.asarray(sum(ends) / 2)

    @property
    def length(self) -> Floats:
        """Length along the circle, (N,), mm."""
        return np.asarray(np.abs(self.turn) * self.radius)

    def select(self, chosen: Flags) -> PlaneArcs:
        """Return some of them."""
        return PlaneArcs(
            line=self.line[chosen],
            start=self.start[chosen],
            end=self.end[chosen],
            centre=self.centre[chosen],
            turn=self.turn[chosen],
        )

    def chord_ends(self, sagitta: float) -> tuple[Places, Floats]:
        """Cut the arcs into equal chords that lie within `sagitta`, mm, of them.

        Returns
        -------
        arc : (K,) int
            Number of the arc of each chord.
        end : (K, 2) float64, mm
            Its end: whole micrometres, except for the last one of an arc, which is `end`.
        """
        radius = self.radius
        largest = 2 * np.arccos(1 - np.minimum(sagitta / np.maximum(radius, SMALLEST_RADIUS), 1.0))
        largest = np.maximum(largest, LEAST_STEP / np.maximum(radius, SMALLEST_RADIUS))
        count = np.maximum(np.ceil(np.abs(self.turn) / largest - 1e-9), 1).astype(np.intp)
        arc = np.repeat(np.arange(len(count)), count)
        share = (np.arange(len(arc)) - np.repeat(np.cumsum(count) - count, count) + 1) / count[arc]
        offset = self.start - self.centre
        inner, outer = np.hypot(*offset.T), np.hypot(*(self.end - self.centre).T)
        angle = np.arctan2(offset[:, 1], offset[:, 0])[arc] + share * self.turn[arc]
        reach = inner[arc] + share * (outer - inner)[arc]
        points = self.centre[arc] + reach[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        points = np.round(points, DECIMALS)
        last = np.cumsum(count) - 1
        points[last] = self.end
        return arc, points

    def chords(self, sagitta: float) -> tuple[Floats, Places]:
        """Cut the arcs as `chord_ends` does; return both ends of each chord, (K, 2, 2), mm, and its line, (K,)."""
        arc, end = self.chord_ends(sagitta)
        begin = np.concatenate([self.start[:1], end[:-1]])
        opens = np.flatnonzero(np.diff(arc, prepend=-1))
        begin[opens] = self.start
        return np.stack([begin, end], axis=1), self.line[arc]


def find_arcs(table: GcodeTable) -> PlaneArcs:
    """Find the arcs of a table that lie in the plane of the layers, on the circle that their words state.

    Arcs that climb, of several turns, of no radius, or whose ends lie on two circles are left out.
    """
    odd = (table.kind == ODD) & (table.code > 1) & ~table.unread
    lines = np.flatnonzero(((table.kind == ARC) | odd) & (table.plane == XY_PLANE))
    previous = lines - 1

    def start_values(name: str) -> Floats:
        """Return a coordinate where each arc begins."""
        values, before = getattr(table, name), getattr(table.before, name)
        return np.asarray(np.where(previous >= 0, values[np.maximum(previous, 0)], before))

    start = np.column_stack([start_values("x"), start_values("y")])
    end = np.column_stack([table.x[lines], table.y[lines]])
    offset, stated, turns = stated_circles(table, lines)
    clockwise = table.code[lines] == 2
    centre = start + offset[:, :2]
    by_radius = ~np.isnan(stated)
    if by_radius.any():
        centre[by_radius] = centres_by_radius(start[by_radius], end[by_radius], stated[by_radius], clockwise[by_radius])
    first, last = start - centre, end - centre
    turn = arc_turns(first, last, clockwise)
    arcs = PlaneArcs(line=lines, start=start, end=end, centre=centre, turn=turn)
    height = start_values("z")
    level = (table.z[lines] == height) | ~table.given[lines, 2]
    once = (turns <= 1) & (offset[:, 2] == 0)
    inner, outer = np.hypot(*first.T), np.hypot(*last.T)
    with np.errstate(invalid="ignore"):
        sound = (np.abs(outer - inner) <= OFF_CIRCLE) & (inner > SMALLEST_RADIUS) & (inner < LARGEST_RADIUS)
    return arcs.select(sound & level & once)


def path_steps(table: GcodeTable) -> Floats:
    """Measure the path of each line in the plane of the layers, (N,), mm: of arcs, along their circles."""
    x = np.diff(table.x, prepend=table.before.x)
    y = np.diff(table.y, prepend=table.before.y)
    steps = np.hypot(x, y)
    arcs = find_arcs(table)
    steps[arcs.line] = arcs.length
    return steps


def mark_arc_lines(arcs: PlaneArcs, count: int) -> NDArray[np.bool_]:
    """Mark the lines, of `count` in all, that are one of these arcs: (count,)."""
    marked = np.zeros(count, dtype=bool)
    marked[arcs.line] = True
    return marked
