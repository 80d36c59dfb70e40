"""How much of each leg of a path lies near walls: the specification is tests/plain_touch.py, in NumPy."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.point_grids import find_distance


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _wall_distance(low, cell, shape, begins, walls, x, y, slot, pitch, box, seen):
    """Return the distance of a place from the walls of its layer, up to `seen`."""
    if slot < 0 or not (box[0] - seen < x < box[2] + seen and box[1] - seen < y < box[3] + seen):
        return seen
    return min(find_distance(low, cell, shape, begins, walls, x + slot * pitch, y, seen), seen)


@njit(nogil=True, cache=True, error_model="numpy")
def measure_touch(
    low,
    cell,
    shape,
    begins,
    walls,
    points,
    is_last,
    length,
    slot,
    pitch,
    box,
    step,
    seen,
    reach,
    amount,
    first,
    end,
    near,
):
    """Measure how much of each leg lies near walls, its distance from both ends, and that of walls from the start.

    A leg is cut into equal pieces, at most `step` long, and the distance from walls is linear along a piece.

    Parameters
    ----------
    low, cell, shape, begins, walls
        The walls of all layers side by side, see `infill.kernels.point_grids`.
    points : (N, 2) float64, mm
        Of paths.
    is_last : (N,) bool
        Ends a path: its leg has no length.
    length : (N,) float64, mm
        Of the leg that begins at each point.
    slot : (N,) int64
        Place of the walls of its layer; -1 without any.
    pitch : float, mm
        From one layer to the next.
    box : (4,) float64, mm
        Bounds of the walls: the least x and y, and the largest.
    step, seen, reach : float, mm
    amount, first, end, near : (N,) float64, mm
        Written: see `infill.paths.touch`.
    """
    count = len(points)
    for leg in range(count):
        near[leg] = _wall_distance(
            low, cell, shape, begins, walls, points[leg, 0], points[leg, 1], slot[leg], pitch, box, seen
        )
    for leg in range(count):
        amount[leg], first[leg], end[leg] = 0.0, math.inf, math.inf
        x, y, way_x, way_y = points[leg, 0], points[leg, 1], 0.0, 0.0
        if not is_last[leg]:
            way_x, way_y = points[leg + 1, 0] - x, points[leg + 1, 1] - y
        pieces = max(1, math.ceil(length[leg] / step))
        piece, distance = length[leg] / pieces, near[leg]
        for number in range(pieces):
            # Each piece goes from its place to the next; the last place of all has none.
            if number + 1 < pieces:
                share = (number + 1) / pieces
                next_distance = _wall_distance(
                    low, cell, shape, begins, walls, x + share * way_x, y + share * way_y, slot[leg], pitch, box, seen
                )
            else:
                next_distance = near[leg + 1] if leg + 1 < count else seen
            inside, next_inside = distance <= reach, next_distance <= reach
            if (inside or next_inside) and length[leg] > 0:
                span = next_distance - distance
                crossing = min(max((reach - distance) / (1.0 if span == 0 else span), 0.0), 1.0)
                lower, upper = (0.0 if inside else crossing), (1.0 if next_inside else crossing)
                position = number / pieces * length[leg]
                amount[leg] += (upper - lower) * piece
                first[leg] = min(first[leg], position + lower * piece)
                end[leg] = min(end[leg], length[leg] - position - upper * piece)
            distance = next_distance
