"""Paths as the moves of a print: straight ones, and arcs where the machine takes them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.arrays import Flags, Floats, Places
from infill.gcode.numbers import TextRows, write_words

ARC_DEVIATION = 0.0125  # mm of an arc from the points for which it stands, as slicers' own arc fitting


@dataclass(frozen=True, kw_only=True)
class PathMoves:
    """The moves along some paths.

    Parameters
    ----------
    points : (N, 2) float64, mm
        Of the paths.
    first : (M + 1,) int
        Path i has the moves `first[i]` to `first[i + 1]`.
    end : (R,) int
        The point at which each move ends.
    centre : (R, 2) float64, mm
        Of arcs; NaN for straight moves.
    turn : (R,) float64
        Radians of arcs, positive counterclockwise; 0 for straight moves.
    """

    points: Floats
    first: Places
    end: Places
    centre: Floats
    turn: Floats

    @property
    def start(self) -> Places:
        """The point at which each move begins, (R,)."""
        begins = np.append(0, self.end[:-1])[: len(self.end)]
        opens = self.first[:-1][np.diff(self.first) > 0]
        begins[opens] += 1
        if len(opens):
            begins[opens[0]] = 0
        return np.asarray(begins)

    @property
    def owner(self) -> Places:
        """The path of each move, (R,)."""
        return np.repeat(np.arange(len(self.first) - 1), np.diff(self.first))

    @property
    def length(self) -> Floats:
        """Length of each move, (R,), mm."""
        begin, finish = self.points[self.start], self.points[self.end]
        straight = np.hypot(*(finish - begin).T)
        arc = self.turn != 0
        straight[arc] = np.abs(self.turn[arc]) * np.hypot(*(begin[arc] - self.centre[arc]).T)
        return np.asarray(straight)

    def write(self, words: Floats, feed: Floats, line_end: bytes) -> TextRows:
        """Write the moves with their E words, and their feed rates, mm/min, where these are not NaN."""
        codes = np.where(self.turn == 0, ord("1"), np.where(self.turn < 0, ord("2"), ord("3"))).astype(np.uint8)
        offset = self.centre - self.points[self.start]
        columns = [
            (b" X", self.points[self.end, 0], 3),
            (b" Y", self.points[self.end, 1], 3),
            (b" I", offset[:, 0], 3),
            (b" J", offset[:, 1], 3),
            (b" E", words, 5),
            (b" F", feed, 3),
        ]
        if not self.turn.any():
            columns = [column for column in columns if column[0] not in (b" I", b" J")]
        return write_words(columns, b"G", line_end, codes=codes)


def plan_moves(points: Floats, first: Places, *, arc_deviation: float = 0.0, stops: Flags | None = None) -> PathMoves:
    """Plan the moves along some paths.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
        Where each path begins; each has two points or more.
    arc_deviation : float, mm
        Largest distance of an arc from the points for which it stands; from the segments between them, half as much
        again. 0 for straight moves alone.
    stops : (N,) bool, optional
        Points that no arc passes.
    """
    if arc_deviation <= 0 or not len(points):
        inner = np.ones(len(points), dtype=bool)
        inner[first[:-1]] = False
        end = np.flatnonzero(inner)
        counts = np.diff(first) - 1
        return PathMoves(
            points=points,
            first=np.append(0, np.cumsum(counts)),
            end=end,
            centre=np.full((len(end), 2), np.nan),
            turn=np.zeros(len(end)),
        )
    from infill.kernels.arc_fitting import fit_arcs
    from infill.kernels.compiling import log_compilation

    end, centre, turn = np.empty(len(points), dtype=np.int64), np.empty((len(points), 2)), np.empty(len(points))
    halts = np.zeros(len(points), dtype=bool) if stops is None else stops
    with log_compilation("arcs"):
        count = fit_arcs(
            np.ascontiguousarray(points), np.asarray(first, dtype=np.int64), halts, arc_deviation, end, centre, turn
        )
    end, centre, turn = end[:count], centre[:count], turn[:count]
    centre[turn == 0] = np.nan
    return PathMoves(points=points, first=np.searchsorted(end, first), end=end, centre=centre, turn=turn)
