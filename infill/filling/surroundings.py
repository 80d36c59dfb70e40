"""The other beads of a layer: where a corner of the infill lies beside one of them, so that it may hardly move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import STEP as FINE
from infill.filling.contact import Samples, sampled
from infill.gcode.sections import Marks, Strokes
from infill.gcode.table import Table

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

STEP = 0.2  # mm between points on other beads
BESIDE = 1.3  # line widths between the centre lines of a corner and of a bead that it lies beside
ANCHORED = 1 / 3  # line widths that a corner beside a bead may move away from it
TOWARDS = 0.02  # mm that it may move towards it
MOST_SQUARES = 4096  # to a side of a plane of squares: 2.4 m of them


@dataclass(frozen=True, kw_only=True)
class Beads:
    """The moves of a table that extrude and are not among the strokes of its infill.

    Parameters
    ----------
    ends : (N, 2, 2) float64, mm
        Where each begins and ends.
    layer : (N,) int, ascending
    """

    ends: Floats
    layer: Places

    def of(self, number: int, step: float = STEP) -> Floats:
        """Return points on the beads of a layer, at most `step` apart: (N, 2) float64, mm."""
        return self.samples_of(number, step).points

    def samples_of(self, number: int, step: float = FINE) -> Samples:
        """Return samples of the beads of a layer, at most `step` apart, mm."""
        low, high = np.searchsorted(self.layer, [number, number + 1])
        some = self.ends[low:high]
        return sampled(some.reshape(-1, 2), np.arange(len(some) + 1) * 2, step)


def beads(table: Table, marks: Marks, infill: Strokes) -> Beads:
    """Return the beads that are not among some strokes."""
    drawn = (table.extruded > 0) & (table.given[:, 0] | table.given[:, 1])
    drawn[infill.moves] = False
    line = np.flatnonzero(drawn)
    back = line - 1
    x = np.where(back >= 0, table.x[back], table.before.x)
    y = np.where(back >= 0, table.y[back], table.before.y)
    ends = np.stack([x, y, table.x[line], table.y[line]], axis=1).reshape(-1, 2, 2)
    known = np.isfinite(ends).all(axis=(1, 2))
    return Beads(ends=ends[known], layer=marks.layer[line][known])


def beside(points: Floats, walls: Floats, distance: float) -> tuple[Places, Floats]:
    """Return which points lie within `distance` of other beads, and how near.

    Parameters
    ----------
    points : (N, 2) float64, mm
    walls : (K, 2) float64, mm
        Points on the other beads.
    distance : float, mm
    """
    from scipy.spatial import cKDTree

    if not len(points) or not len(walls):
        return np.empty(0, dtype=np.intp), np.empty(0)
    some = _around(points, walls, distance)
    near, _ = cKDTree(walls).query(points[some], distance_upper_bound=distance)
    found = np.isfinite(near)
    return some[found], near[found]


def _around(points: Floats, walls: Floats, distance: float) -> Places:
    """Return the points that are worth a closer look: those in squares around a wall, as wide as the distance."""
    # Axis by axis: NumPy is slow along the short axis of an array.
    low = np.array([min(walls[:, k].min(), points[:, k].min()) for k in (0, 1)]) - 2 * distance
    high = np.array([max(walls[:, k].max(), points[:, k].max()) for k in (0, 1)])
    if ((high - low) / distance).max() > MOST_SQUARES:
        return np.arange(len(points))
    square = ((walls - low) / distance).astype(np.intp)
    own = ((points - low) / distance).astype(np.intp)
    taken = np.zeros(((high - low) / distance).astype(np.intp) + 3, dtype=bool)
    for right in (-1, 0, 1):
        for up in (-1, 0, 1):
            taken[square[:, 0] + right, square[:, 1] + up] = True
    return np.flatnonzero(taken[own[:, 0], own[:, 1]])


def bounded_deviation(points: Floats, corners: Places, walls: Floats, *, deviation: float, line_width: float) -> Floats:
    """Return how far some corners of paths may move, mm: `deviation`, less where one lies beside another bead.

    A corner beside a bead anchors the infill there: it moves away by a third of the line width at most. One that
    would be cut towards the bead, as on a path around a boss, stays.
    """
    from scipy.spatial import cKDTree

    allowed = np.full(len(corners), deviation)
    some, near = beside(points[corners], walls, BESIDE * line_width)
    if not len(some):
        return allowed
    least = min(deviation, ANCHORED * line_width)
    allowed[some] = least
    then, _ = cKDTree(walls).query(points[corners[some]] + _inward(points, corners[some]) * least)
    allowed[some[then < near - TOWARDS]] = min(deviation, TOWARDS)
    return allowed


def _inward(points: Floats, here: Places) -> Floats:
    """Return the direction in which rounding moves each corner: between its two legs."""
    legs = (points[here - 1] - points[here], points[here + 1] - points[here])
    before, after = (leg / np.maximum(np.hypot(*leg.T), 1e-12)[:, None] for leg in legs)
    middle = before + after
    direction: Floats = middle / np.maximum(np.hypot(*middle.T), 1e-12)[:, None]
    return direction
