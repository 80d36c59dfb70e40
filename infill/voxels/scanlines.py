"""Intersect the rows of a grid with triangles, exactly enough that closed meshes have no leaks.

The rows run along z through the cell centres. Each of the two edges of a triangle that a plane y = j cuts
is cut by the same arithmetic for both triangles that share it, so whatever one triangle gains through rounding
its neighbour loses: over a closed mesh, the signs along every row always add up to 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.ragged import expand_rows

AT_ONCE = 2**17  # crossings processed at a time: some ten arrays of this length
SLAB = 2**21  # cells filled at a time
SAMPLES = 9  # crossings of a component that are examined to find the components around it


@dataclass(frozen=True, kw_only=True)
class RowCrossings:
    """Crossings of rows with triangles, sorted by row.

    Parameters
    ----------
    row : (N,) int
        x * ny + y of the row.
    place : (N,) int
        First cell of the row whose centre is not before the crossing; nz if there is none.
    face : (N,) int
        The triangle crossed.
    sign : (N,) int
        +1 where the row enters the solid that the triangle bounds, -1 where it leaves.
    depth : (N,) float
        Exact position on the row, in cells: the centre of the first cell is 0.
    """

    row: NDArray[np.int32]
    place: NDArray[np.int32]
    face: NDArray[np.int32]
    sign: NDArray[np.int8]
    depth: NDArray[np.float32]


def intersect_rows(vertices: Floats, faces: NDArray[np.integer], shape: tuple[int, ...]) -> RowCrossings:
    """Intersect the rows of a grid along z with triangles.

    Parameters
    ----------
    vertices : (V, 3) float64
        In cells: the centre of the first cell is 0, that of the next 1. What lies beyond the grid crosses no row.
    faces : (F, 3) int, counter-clockwise seen from outside
    shape : (nx, ny, nz)

    Notes
    -----
    The plane y = j cuts a triangle in the span between two of its edges; an edge is cut if
    y_low <= j < y_high. A row passes through if x_left <= i < x_right. So ties go the same way for every triangle.

    >>> square = np.array([[0, 0, 0.5], [1, 0, 0.5], [1, 1, 0.5], [0, 1, 0.5]])
    >>> crossed = intersect_rows(square, np.array([[0, 2, 1], [0, 3, 2]]), (2, 2, 2))
    >>> crossed.row.tolist(), crossed.place.tolist(), crossed.sign.tolist()
    ([0], [1], [1])
    """
    x, y, _ = vertices.T
    high_y = np.ceil(y).astype(np.int64)[faces]
    high_x = np.ceil(x).astype(np.int64)[faces]
    low_plane = np.maximum(high_y.min(axis=1), 0)
    count = np.maximum(np.minimum(high_y.max(axis=1), shape[1]) - low_plane, 0)
    count[high_x.min(axis=1) == high_x.max(axis=1)] = 0
    order = np.argsort(y[faces], axis=1, kind="stable")
    low, middle, high = np.take_along_axis(faces, order, axis=1).T
    is_even = (order[:, 1] - order[:, 0]) % 3 == 1
    parts = []
    for triangle, step in expand_rows(count, AT_ONCE):
        plane = low_plane[triangle] + step
        upper = plane >= y[middle[triangle]]
        x_long, z_long = _cut_edges(vertices, low[triangle], high[triangle], plane)
        x_short, z_short = _cut_edges(
            vertices,
            np.where(upper, middle[triangle], low[triangle]),
            np.where(upper, high[triangle], middle[triangle]),
            plane,
        )
        leftwards = x_short < x_long
        x_left, x_right = np.minimum(x_long, x_short), np.maximum(x_long, x_short)
        z_left, z_right = np.where(leftwards, z_short, z_long), np.where(leftwards, z_long, z_short)
        begin = np.maximum(np.ceil(x_left).astype(np.int64), 0)
        end = np.minimum(np.ceil(x_right).astype(np.int64), shape[0])
        for crossed, along in expand_rows(np.maximum(end - begin, 0), AT_ONCE):
            column = begin[crossed] + along
            share = (column - x_left[crossed]) / (x_right[crossed] - x_left[crossed])
            depth = z_left[crossed] + share * (z_right[crossed] - z_left[crossed])
            parts.append(
                (
                    (column * shape[1] + plane[crossed]).astype(np.int32),
                    np.clip(np.ceil(depth), 0, shape[2]).astype(np.int32),
                    triangle[crossed].astype(np.int32),
                    np.where(is_even[triangle[crossed]] == leftwards[crossed], 1, -1).astype(np.int8),
                    depth.astype(np.float32),
                )
            )
    if not parts:
        nothing = np.empty(0, dtype=np.int32)
        return RowCrossings(
            row=nothing, place=nothing, face=nothing, sign=nothing.astype(np.int8), depth=nothing.astype(np.float32)
        )
    row, place, face, sign, depth = (np.concatenate(column_parts) for column_parts in zip(*parts, strict=True))
    order = np.argsort(row, kind="stable")
    return RowCrossings(row=row[order], place=place[order], face=face[order], sign=sign[order], depth=depth[order])


def _cut_edges(
    vertices: Floats, start: NDArray[np.integer], end: NDArray[np.integer], plane: NDArray[np.integer]
) -> tuple[Floats, Floats]:
    """Return x and z where edges from a lower to a higher y pass through planes of that y."""
    (x0, y0, z0), (x1, y1, z1) = vertices[start].T, vertices[end].T
    part = (plane - y0) / (y1 - y0)
    # Clipped to the ends: rounded beyond them, x could lie in a column that the box of the triangle leaves out.
    x = np.clip(x0 + part * (x1 - x0), np.minimum(x0, x1), np.maximum(x0, x1))
    return x, z0 + part * (z1 - z0)


def fill_rows(crossed: RowCrossings, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Fill rows: mark the cells (nx, ny, nz) where the sum of the signs up to their centre is not 0."""
    return fill_rows_and_count(crossed, shape)[0]


def fill_rows_and_count(crossed: RowCrossings, shape: tuple[int, ...]) -> tuple[NDArray[np.bool_], int]:
    """Fill rows as `fill_rows` does; return the marked cells, and the largest absolute sum of signs."""
    nx, ny, nz = shape
    largest = 0
    inside = np.zeros(shape, dtype=bool)
    thick = max(1, SLAB // (ny * nz))
    for low in range(0, nx, thick):
        slab = inside[low : low + thick]
        begin, end = np.searchsorted(crossed.row, [low * ny, (low + len(slab)) * ny])
        if begin == end:
            continue
        winding = np.zeros(slab.shape, dtype=np.int32)
        place = crossed.place[begin:end].astype(np.int64)
        on_row = place < nz
        index = (crossed.row[begin:end].astype(np.int64) - low * ny) * nz + place
        np.add.at(winding.reshape(-1), index[on_row], crossed.sign[begin:end][on_row].astype(np.int32))
        np.not_equal(np.cumsum(winding, axis=2, out=winding), 0, out=slab)
        largest = max(largest, int(winding.max()), -int(winding.min()))
    return inside, largest


def is_inside_out(crossings: RowCrossings, component: NDArray[np.integer], volumes: Floats) -> NDArray[np.bool_]:
    """Mark the components to reverse: those that face inwards outside all others, and everything inside them.

    Parameters
    ----------
    crossings : RowCrossings
    component : (F,) int
        Component of every face.
    volumes : (B,) float64
        Signed volume of each component.

    Returns
    -------
    (B,) bool

    Notes
    -----
    A component lies in another if the rows wind around it at every one of the crossings examined. One that faces
    the opposite way from the component it lies in is a cavity of it, and turns with it.
    """
    turned = np.zeros(len(volumes), dtype=bool)
    if (volumes >= 0).all() or (volumes <= 0).all():
        return turned
    owner = component[crossings.face]
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner, np.arange(len(volumes) + 1), sorter=order)
    for number in np.flatnonzero(volumes):
        own_crossings = order[bounds[number] : bounds[number + 1]]
        if len(own_crossings) == 0:
            continue
        holders: set[int] | None = None
        for i in own_crossings[np.linspace(0, len(own_crossings) - 1, SAMPLES).astype(np.int64)]:
            begin, end = np.searchsorted(crossings.row, [crossings.row[i], crossings.row[i] + 1])
            owners, signs, places = owner[begin:end], crossings.sign[begin:end], crossings.place[begin:end]
            enclosing: set[int] = set()
            for before in (places < crossings.place[i], places <= crossings.place[i]):
                winding = np.bincount(owners[before], weights=signs[before])
                enclosing.update(np.flatnonzero(winding).tolist())
            holders = enclosing if holders is None else holders & enclosing
        larger = [holder for holder in holders or () if abs(volumes[holder]) > abs(volumes[number])]
        outermost = max(larger, key=lambda index: abs(volumes[index]), default=number)
        turned[number] = volumes[outermost] < 0
    return turned
