"""How much of each leg of a path lies near walls, in NumPy: what `infill.kernels.wall_touch` does place by place."""

from __future__ import annotations

import numpy as np

from infill.arrays import Floats, Places
from infill.paths.neighbours import BeadIndex
from infill.paths.touch import SEEN, STEP


def measure_plainly(
    points: Floats, offsets: Places, layer: Places, walls: BeadIndex, reach: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """Measure how much of each leg lies near walls, its distance from both ends, and that of walls from the start.

    Near is within `reach`.

    Returns
    -------
    amount : (N,) float64, mm
        Of the leg that begins at each point; 0 for the last of a path.
    begins, ends : (N,) float64, mm
        Distance of that part from the leg's beginning, and from its end; infinite where the leg touches no wall.
    near : (N,) float64, mm
        Up to `SEEN`.
    """
    count = len(points)
    length = np.append(np.hypot(*np.diff(points, axis=0).T), 0.0)
    length[offsets[1:] - 1] = 0.0
    pieces = np.maximum(1, np.ceil(length / STEP)).astype(np.intp)
    leg_of = np.repeat(np.arange(count), pieces)
    share = (np.arange(len(leg_of)) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[leg_of]
    leg_ends = np.append(points[1:], points[-1:], axis=0)
    leg_ends[offsets[1:] - 1] = points[offsets[1:] - 1]
    places = points[leg_of] + share[:, None] * (leg_ends - points)[leg_of]
    distance = np.minimum(walls.distances(places, layer[leg_of], SEEN), SEEN)
    # Each piece goes from its place to the next; the last place of a path has none.
    next_distance = np.append(distance[1:], SEEN)
    span = next_distance - distance
    steep = np.where(span == 0, 1.0, span)
    crossing = np.clip((reach - distance) / steep, 0.0, 1.0)
    inside, next_inside = distance <= reach, next_distance <= reach
    low = np.where(inside, 0.0, np.where(next_inside, crossing, np.inf))
    high = np.where(next_inside, 1.0, np.where(inside, crossing, -np.inf))
    touches = np.flatnonzero((inside | next_inside) & (length[leg_of] > 0))
    owner, piece = leg_of[touches], (length / pieces)[leg_of[touches]]
    position = share[touches] * length[owner]
    amount = np.zeros(count)
    np.add.at(amount, owner, (high - low)[touches] * piece)
    begins, ends = np.full(count, np.inf), np.full(count, np.inf)
    np.minimum.at(begins, owner, position + low[touches] * piece)
    np.minimum.at(ends, owner, length[owner] - position - high[touches] * piece)
    return amount, begins, ends, distance[np.cumsum(pieces) - pieces]
