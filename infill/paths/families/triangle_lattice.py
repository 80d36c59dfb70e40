r"""Lines in three directions of which any piece may be missing, as paths that never cross.

At one height, planes that stand on a corner cut three families of parallel lines. Three of them, one of each direction,
enclose a triangle with a number (i, j): line c number i, line b number j, and the line a for which the numbers add up
to the same sum. Its corners are ab, bc and ac; between triangles run long pieces, along its sides short ones::

      ______ac____ab______ a           a line of each direction has pieces, short and long in turn
             \    /
              \  /
               bc                      the triangle shrinks and grows with height, and turns over
              /  \
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.paths.families.family import Path
from infill.paths.families.junctions import ARMS, NONE, SIN, JunctionTable, junction_table

SMALL = 2.2  # gaps: a triangle with shorter sides is one junction
KINDS = 6  # of pieces: short and long ones of a, b and c
SHORT_A, LONG_A, SHORT_B, LONG_B, SHORT_C, LONG_C = range(KINDS)
SAME = 1e-7  # mm: points nearer than that are one
STRAIGHT = 1e-9  # mm² of area between two pieces of a straight line
Places = NDArray[np.int64]
# For each arm of a junction: the kind of its piece, the triangle of that piece relative to that of the junction.
AT_BC = {1: (SHORT_B, 0, 0), 4: (LONG_B, -1, 0), 2: (SHORT_C, 0, 0), 5: (LONG_C, 0, -1)}
AT_AB = {0: (LONG_A, 0, 0), 3: (SHORT_A, 0, 0), 1: (LONG_B, 0, 0), 4: (SHORT_B, 0, 0)}
AT_AC = {0: (SHORT_A, 0, 0), 3: (LONG_A, -1, 1), 2: (LONG_C, 0, 0), 5: (SHORT_C, 0, 0)}
AROUND = {
    0: (LONG_A, 0, 0),
    3: (LONG_A, -1, 1),
    1: (LONG_B, 0, 0),
    4: (LONG_B, -1, 0),
    2: (LONG_C, 0, 0),
    5: (LONG_C, 0, -1),
}
AROUND_TURNED = {
    0: (SHORT_A, 0, -1),
    3: (SHORT_A, -1, 0),
    1: (SHORT_B, 0, 0),
    4: (SHORT_B, -1, 0),
    2: (SHORT_C, 0, 0),
    5: (SHORT_C, 0, -1),
}
Arms = dict[int, tuple[int, int, int]]


@dataclass(frozen=True, kw_only=True, eq=False)
class TriangleLattice:
    """Pieces of lines at one height.

    Parameters
    ----------
    corners : (I, J, 2) float64, mm
        The corner bc of each triangle.
    height : float, mm
        Of the line a above that corner; between 0 and `cell`.
    cell : float, mm
        Distance of parallel lines.
    present : (6, I, J) bool
        Which pieces there are, by kind.
    """

    corners: Floats
    height: float
    cell: float
    present: Flags

    def paths(self, gap: float) -> list[Path]:
        """Return the paths along all pieces, of which beads that touch lie `gap` mm apart."""
        links = _Links(present=self.present.copy())
        small = min(SMALL * gap * SIN, self.cell / 2)
        turned = self.height - self.cell
        if self.height < small:
            links.present[[SHORT_A, SHORT_B, SHORT_C]] = False
            links.add(AROUND, self.corners, junction_table(self.height, gap))
        elif -turned < small:
            links.present[[LONG_A, LONG_B, LONG_C]] = False
            links.add(AROUND_TURNED, self.corners, junction_table(turned, gap))
        else:
            table = junction_table(0.0, gap)
            side = self.height / SIN
            links.add(AT_BC, self.corners, table)
            links.add(AT_AB, self.corners + np.array([side / 2, self.height]), table)
            links.add(AT_AC, self.corners + np.array([-side / 2, self.height]), table)
        return links.trace()


class _Links:
    """Ends of pieces, numbered by kind, triangle and side, and what they are linked to.

    Arms 0, 1 and 2 of a junction are where a piece begins, 3, 4 and 5 where one ends.
    """

    def __init__(self, present: Flags) -> None:
        self.present = present
        self.partner: Places = np.full(2 * present.size, NONE)
        self.place: Floats = np.full((2 * present.size, 2), np.nan)

    def add(self, arms: Arms, places: Floats, table: JunctionTable) -> None:
        """Link the pieces at one junction of every triangle."""
        ends = self._ends_at(arms)
        is_end = ends != NONE
        code = (is_end << np.arange(ARMS)).sum(axis=1)
        partner, cut = table.partner[code], places.reshape(-1, 1, 2) + table.cut[code]
        linked = np.where(partner == NONE, NONE, np.take_along_axis(ends, np.maximum(partner, 0), axis=1))
        self.partner[ends[is_end]], self.place[ends[is_end]] = linked[is_end], cut[is_end]

    def _ends_at(self, arms: Arms) -> Places:
        """Return the ends of pieces at one junction of every triangle, by arm, (N, 6); `NONE` where there is none."""
        _, rows, columns = self.present.shape
        i, j = np.indices((rows, columns))
        ends: Places = np.full((rows, columns, ARMS), NONE, dtype=np.int64)
        for arm, (kind, di, dj) in arms.items():
            inside = (i + di >= 0) & (i + di < rows) & (j + dj >= 0) & (j + dj < columns)
            row, column = np.clip(i + di, 0, rows - 1), np.clip(j + dj, 0, columns - 1)
            number = 2 * ((kind * rows + row) * columns + column) + (arm >= ARMS // 2)
            ends[..., arm] = np.where(inside & self.present[kind, row, column], number, NONE)
        return ends.reshape(-1, ARMS)

    def trace(self) -> list[Path]:
        """Follow the links from piece to piece; return one path for each chain of them."""
        drawn = self.present.ravel() & np.isfinite(self.place.reshape(-1, 4)).all(axis=1)
        partner = np.where((self.partner != NONE) & drawn[np.maximum(self.partner, 0) // 2], self.partner, NONE)
        numbers = np.flatnonzero(drawn)
        ends = np.stack([2 * numbers, 2 * numbers + 1], axis=1).ravel()
        begins = [*ends[partner[ends] == NONE].tolist(), *ends[::2].tolist()]
        following, seen = partner.tolist(), np.zeros(len(drawn), dtype=bool)
        paths: list[Path] = []
        for begin in begins:
            if seen[begin // 2]:
                continue
            chain, end = [], begin
            while end != NONE and not seen[end // 2]:
                seen[end // 2] = True
                chain += [end, end ^ 1]
                end = following[end ^ 1]
            points = self.place[chain]
            if end == begin:
                points = np.concatenate([points, points[:1]])
            paths.append(drop_straight(points))
        return paths


def drop_straight(points: Floats) -> Path:
    """Drop the points of a path that lie on a straight line between their neighbours, and those that repeat.

    >>> drop_straight(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]])).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]
    """
    kept = np.append(True, np.hypot(*np.diff(points, axis=0).T) > SAME)
    points = points[kept]
    step = np.diff(points, axis=0)
    bends = np.abs(step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]) > STRAIGHT
    return points[np.concatenate([[True], bends, [True]])] if len(points) > 1 else points
