"""Where the rows of a grid pass through triangles, exactly enough that closed meshes have no leaks.

The rows run along z through the cell centres. Each of the two edges of a triangle that a plane y = j cuts
is cut by the same arithmetic for both triangles that share it, so whatever one triangle gains through rounding
its neighbour loses: over a closed mesh, the signs along every row always add up to 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.ragged import spread

AT_ONCE = 2**17  # crossings processed at a time: some ten arrays of this length
SLAB = 2**21  # cells filled at a time

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Crossings:
    """Where rows pass through triangles, sorted by row.

    Parameters
    ----------
    row : (N,) int
        x * ny + y of the row.
    place : (N,) int
        First cell of the row whose centre is not before the crossing; nz if there is none.
    face : (N,) int
        The triangle crossed.
    sign : (N,) int
        +1 where the row enters what the triangle bounds, -1 where it leaves it.
    depth : (N,) float
        Where exactly on the row, in cells: the centre of the first cell is 0.
    """

    row: NDArray[np.int32]
    place: NDArray[np.int32]
    face: NDArray[np.int32]
    sign: NDArray[np.int8]
    depth: NDArray[np.float32]


def crossings(vertices: Floats, faces: NDArray[np.integer], shape: tuple[int, ...]) -> Crossings:
    """Return where the rows of a grid along z pass through triangles.

    Parameters
    ----------
    vertices : (V, 3) float64
        In cells: the centre of the first cell is 0, that of the next 1. All lie within the grid.
    faces : (F, 3) int, counter-clockwise seen from outside
    shape : (nx, ny, nz)

    Notes
    -----
    The plane y = j cuts a triangle in the span between two of its edges; an edge is cut if
    y_low <= j < y_high. A row passes through if x_left <= i < x_right. So ties go the same way for every triangle.

    >>> square = np.array([[0, 0, 0.5], [1, 0, 0.5], [1, 1, 0.5], [0, 1, 0.5]])
    >>> found = crossings(square, np.array([[0, 2, 1], [0, 3, 2]]), (2, 2, 2))
    >>> found.row.tolist(), found.place.tolist(), found.sign.tolist()
    ([0], [1], [1])
    """
    x, y, _ = vertices.T
    above = np.ceil(y).astype(np.int64)[faces]
    beside = np.ceil(x).astype(np.int64)[faces]
    first = above.min(axis=1)
    count = above.max(axis=1) - first
    count[beside.min(axis=1) == beside.max(axis=1)] = 0
    order = np.argsort(y[faces], axis=1, kind="stable")
    low, middle, high = np.take_along_axis(faces, order, axis=1).T
    even = (order[:, 1] - order[:, 0]) % 3 == 1
    parts = []
    for some, step in spread(count, AT_ONCE):
        plane = first[some] + step
        upper = plane >= y[middle[some]]
        x_long, z_long = _cut(vertices, low[some], high[some], plane)
        x_short, z_short = _cut(
            vertices, np.where(upper, middle[some], low[some]), np.where(upper, high[some], middle[some]), plane
        )
        leftwards = x_short < x_long
        left, right = np.minimum(x_long, x_short), np.maximum(x_long, x_short)
        z_left, z_right = np.where(leftwards, z_short, z_long), np.where(leftwards, z_long, z_short)
        begin = np.ceil(left).astype(np.int64)
        for each, along in spread(np.ceil(right).astype(np.int64) - begin, AT_ONCE):
            column = begin[each] + along
            part = (column - left[each]) / (right[each] - left[each])
            depth = z_left[each] + part * (z_right[each] - z_left[each])
            parts.append(
                (
                    (column * shape[1] + plane[each]).astype(np.int32),
                    np.ceil(depth).astype(np.int32),
                    some[each].astype(np.int32),
                    np.where(even[some[each]] == leftwards[each], 1, -1).astype(np.int8),
                    depth.astype(np.float32),
                )
            )
    if not parts:
        nothing = np.empty(0, dtype=np.int32)
        return Crossings(
            row=nothing, place=nothing, face=nothing, sign=nothing.astype(np.int8), depth=nothing.astype(np.float32)
        )
    row, place, face, sign, depth = (np.concatenate(each) for each in zip(*parts, strict=True))
    order = np.argsort(row, kind="stable")
    return Crossings(row=row[order], place=place[order], face=face[order], sign=sign[order], depth=depth[order])


def _cut(
    vertices: Floats, start: NDArray[np.integer], end: NDArray[np.integer], plane: NDArray[np.integer]
) -> tuple[Floats, Floats]:
    """Return x and z where edges from a lower to a higher y pass through planes of that y."""
    (x0, y0, z0), (x1, y1, z1) = vertices[start].T, vertices[end].T
    part = (plane - y0) / (y1 - y0)
    # Kept between the ends: rounded beyond them, it could lie in a column that the box of the triangle leaves out.
    x = np.clip(x0 + part * (x1 - x0), np.minimum(x0, x1), np.maximum(x0, x1))
    return x, z0 + part * (z1 - z0)


def filled(found: Crossings, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Return the cells (nx, ny, nz) where the sum of the signs up to their centre is not 0."""
    return wound(found, shape)[0]


def wound(found: Crossings, shape: tuple[int, ...]) -> tuple[NDArray[np.bool_], int]:
    """Return the cells where the sum of the signs up to their centre is not 0, and the largest sum, signs aside."""
    nx, ny, nz = shape
    most = 0
    inside = np.zeros(shape, dtype=bool)
    thick = max(1, SLAB // (ny * nz))
    for low in range(0, nx, thick):
        slab = inside[low : low + thick]
        begin, end = np.searchsorted(found.row, [low * ny, (low + len(slab)) * ny])
        if begin == end:
            continue
        winding = np.zeros(slab.shape, dtype=np.int32)
        place = found.place[begin:end].astype(np.int64)
        seen = place < nz
        index = (found.row[begin:end].astype(np.int64) - low * ny) * nz + place
        np.add.at(winding.reshape(-1), index[seen], found.sign[begin:end][seen].astype(np.int32))
        np.not_equal(np.cumsum(winding, axis=2, out=winding), 0, out=slab)
        most = max(most, int(winding.max()), -int(winding.min()))
    return inside, most
