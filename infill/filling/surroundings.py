"""The other beads of a layer: where a corner of the infill lies beside one of them, so that it may hardly move."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import sampled
from infill.gcode.sections import Strokes
from infill.gcode.table import Table

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

STEP = 0.2  # mm between points on other beads
BESIDE = 1.3  # line widths between the centre lines of a corner and of a bead that it lies beside
ANCHORED = 1 / 3  # line widths that a corner beside a bead may move away from it
TOWARDS = 0.02  # mm that it may move towards it


def beads(table: Table, infill: Strokes, layer: NDArray[np.bool_], step: float = STEP) -> Floats:
    """Return points on the beads of a layer that are not among the strokes of its infill: (N, 2) float64, mm.

    Parameters
    ----------
    layer : (N,) bool
        The lines of the table that belong to the layer.
    """
    drawn = layer & (table.extruded > 0) & table.given[:, :2].any(axis=1)
    drawn[_moves(infill)] = False
    line = np.flatnonzero(drawn)
    back = line - 1
    x = np.where(back >= 0, table.x[back], table.before.x)
    y = np.where(back >= 0, table.y[back], table.before.y)
    ends = np.stack([x, y, table.x[line], table.y[line]], axis=1).reshape(-1, 2, 2)
    ends = ends[np.isfinite(ends).all(axis=(1, 2))]
    return sampled(ends.reshape(-1, 2), np.arange(len(ends) + 1) * 2, step).points


def _moves(infill: Strokes) -> Places:
    """Return the lines of the table that are moves of strokes."""
    inner = np.ones(len(infill.line), dtype=bool)
    inner[infill.first[:-1]] = False
    return infill.line[inner]


def bounded_deviation(
    points: Floats, first: Places, walls: Floats, *, deviation: float, line_width: float
) -> float | Floats:
    """Return how far each corner of some paths may move, mm: `deviation`, less where it lies beside another bead.

    A corner beside a bead anchors the infill there: it moves away by a third of the line width at most. One that
    would be cut towards the bead, as on a path around a boss, stays.
    """
    from scipy.spatial import cKDTree

    if not len(walls) or not len(points):
        return deviation
    tree = cKDTree(walls)
    near, _ = tree.query(points, distance_upper_bound=BESIDE * line_width)
    beside = np.flatnonzero(np.isfinite(near))
    allowed = np.full(len(points), deviation)
    least = min(deviation, ANCHORED * line_width)
    allowed[beside] = least
    ends = np.zeros(len(points), dtype=bool)
    ends[first[:-1]] = ends[first[1:] - 1] = True
    beside = beside[~ends[beside]]
    inward = _inward(points, beside) * least
    then, _ = tree.query(points[beside] + inward, distance_upper_bound=math.inf)
    allowed[beside[then < near[beside] - TOWARDS]] = min(deviation, TOWARDS)
    return allowed


def _inward(points: Floats, here: Places) -> Floats:
    """Return the direction in which rounding moves each corner: between its two legs."""
    legs = (points[here - 1] - points[here], points[here + 1] - points[here])
    before, after = (leg / np.maximum(np.hypot(*leg.T), 1e-12)[:, None] for leg in legs)
    middle = before + after
    direction: Floats = middle / np.maximum(np.hypot(*middle.T), 1e-12)[:, None]
    return direction
