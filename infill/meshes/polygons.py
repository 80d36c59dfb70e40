"""Split polygons of three corners and more into triangles, without adding vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers

AT_ONCE = 100_000  # polygons split at a time
MOST_FANS = 16  # corners: in a polygon of at most this many, each is tried as the start of a fan
FLAT = 1e-12  # a triangle of a fan that holds less than this share of its polygon counts as having no area
CORNERS = 3  # of a triangle


def split_polygons(
    vertices: NDArray[np.floating], corners: NDArray[np.integer], counts: NDArray[np.integer]
) -> Integers:
    """Split polygons into triangles that cover each polygon once; return them, (T, 3), in the order of the polygons.

    Parameters
    ----------
    vertices : (V, 3) float
    corners : (C,) int
        The vertices of all polygons, one polygon after another.
    counts : (P,) int
        How many corners each polygon has. Polygons of fewer than three are left out: they have no area.

    Returns
    -------
    (T, 3) int64
        A polygon of n corners becomes n - 2 triangles, all of whose outer edges are edges of the polygon. So polygons
        that close a solid become triangles that close it, also where they are not flat.

    Notes
    -----
    A polygon becomes a fan from its first corner if all triangles of the fan face as the polygon does; else a fan from
    another corner, or the triangles that ear clipping by manifold3d finds in the plane in which the polygon is largest.
    A polygon that crosses itself or has no area becomes a fan.

    >>> notched = np.array([[2.0, 1, 0], [1, 1, 0], [1, 3, 0], [0, 3, 0], [0, 0, 0], [2, 0, 0]])
    >>> split_polygons(notched, np.arange(6), np.array([6])).tolist()  # a fan from 0 would leave the polygon
    [[1, 2, 3], [1, 3, 4], [1, 4, 5], [1, 5, 0]]
    """
    corner_start = np.cumsum(counts) - counts
    triangle_counts = np.maximum(counts - 2, 0)
    face_start = np.cumsum(triangle_counts) - triangle_counts
    faces = np.empty((int(triangle_counts.sum()), CORNERS), dtype=np.int64)
    for count in np.unique(counts[counts >= CORNERS]).tolist():
        same_count = np.flatnonzero(counts == count)
        for low in range(0, len(same_count), AT_ONCE):
            chunk = same_count[low : low + AT_ONCE]
            rings = corners[corner_start[chunk, None] + np.arange(count)]
            triangles = rings[:, None] if count == CORNERS else _split_same_count(vertices, rings)
            faces[face_start[chunk, None] + np.arange(count - 2)] = triangles
    if (counts > CORNERS).any():
        _turn_shared_diagonals(vertices, corners, counts, faces)
    return faces


def _turn_shared_diagonals(
    vertices: NDArray[np.floating], corners: NDArray[np.integer], counts: NDArray[np.integer], faces: Integers
) -> None:
    """Turn fans whose diagonals are also edges, or diagonals of other fans: such an edge would have four faces.

    This happens where polygons share corners that are not neighbours in one of them: two faces of a tetrahedron as one
    quadrilateral beside the other two, or the polygons around a vertex that has two edges.
    """
    corner_start = np.cumsum(counts) - counts
    face_start = np.cumsum(np.maximum(counts - 2, 0)) - np.maximum(counts - 2, 0)
    inner = np.maximum(counts - CORNERS, 0)
    diagonal_start = np.cumsum(inner) - inner
    owner = np.repeat(np.arange(len(counts)), inner)
    triangle = face_start[owner] + np.arange(len(owner)) - diagonal_start[owner]  # the last of a fan adds no diagonal
    diagonals = _pair_numbers(faces[triangle, 0], faces[triangle, 2])
    hub = faces[face_start[owner], 0]
    clipped = np.zeros(len(counts), dtype=bool)  # polygons that are not fans stay as they are
    clipped[owner[(faces[triangle, 0] != hub) | (faces[triangle + 1, 0] != hub)]] = True
    diagonals[clipped[owner]] = -1
    next_corner = np.arange(1, len(corners) + 1)
    next_corner[(corner_start + counts - 1)[counts > 0]] = corner_start[counts > 0]
    edges = np.sort(_pair_numbers(corners, corners[next_corner]))
    uses = np.sort(diagonals[diagonals >= 0])
    if len(uses) == 0:
        return
    position = np.minimum(np.searchsorted(edges, uses), len(edges) - 1)
    crowded = np.union1d(uses[1:][uses[1:] == uses[:-1]], uses[edges[position] == uses])
    if len(crowded) == 0:
        return
    turned: set[int] = set()  # diagonals of the fans turned so far

    def is_free(pairs: Integers, polygon: int) -> bool:
        """Tell whether pairs that a polygon would have as diagonals are neither edges nor diagonals of others."""
        low, high = np.searchsorted(edges, pairs), np.searchsorted(edges, pairs, side="right")
        own_diagonals = diagonals[diagonal_start[polygon] : diagonal_start[polygon] + inner[polygon]]
        used = np.searchsorted(uses, pairs, side="right") - np.searchsorted(uses, pairs) - np.isin(pairs, own_diagonals)
        return bool((low == high).all() and (used == 0).all()) and turned.isdisjoint(pairs.tolist())

    for polygon in np.unique(owner[np.isin(diagonals, crowded)]).tolist():
        count = int(counts[polygon])
        ring = corners[corner_start[polygon] : corner_start[polygon] + count].astype(np.int64)
        fans = (np.roll(ring, -start) for start in range(count if count <= MOST_FANS else 0))
        free = (fan for fan in fans if is_free(_pair_numbers(fan[:1].repeat(count - CORNERS), fan[2:-1]), polygon))
        chosen = next((fan for fan in free if _fans_cover(vertices, fan[None])[0]), None)
        if chosen is not None:
            faces[face_start[polygon] : face_start[polygon] + count - 2] = split_fan(chosen)
            turned.update(_pair_numbers(chosen[:1].repeat(count - CORNERS), chosen[2:-1]).tolist())


def _pair_numbers(start: NDArray[np.integer], end: NDArray[np.integer]) -> Integers:
    """Return one number for each pair of vertices, the same in either order."""
    low, high = np.minimum(start, end).astype(np.int64), np.maximum(start, end).astype(np.int64)
    numbers: Integers = (low << 32) + high
    return numbers


def split_strips(corners: NDArray[np.integer], counts: NDArray[np.integer]) -> Integers:
    """Split triangle strips into triangles (T, 3), every second one reversed; drop those with two equal corners.

    Parameters
    ----------
    corners : (C,) int
        The vertices of all strips, one strip after another; -1 ends a strip before its end.
    counts : (S,) int
        How many corners each strip has.

    Notes
    -----
    Programs repeat corners to join two strips: triangles with two equal corners do not belong to the surface.

    >>> split_strips(np.array([0, 1, 2, 3, -1, 3, 2, 4]), np.array([8])).tolist()
    [[0, 1, 2], [2, 1, 3], [3, 2, 4]]
    """
    corners = corners.astype(np.int64, copy=False)
    begins = np.cumsum(counts) - counts
    starts = np.zeros(len(corners), dtype=bool)
    starts[begins[counts > 0]] = True
    starts[1:] |= corners[:-1] == -1
    strip_start = np.maximum.accumulate(np.where(starts, np.arange(len(corners)), 0))
    if len(corners) < CORNERS:
        return np.empty((0, CORNERS), dtype=np.int64)
    triangles = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    same_strip = strip_start[:-2] == strip_start[2:]
    turned = (np.arange(len(triangles)) - strip_start[:-2]) % 2 == 1
    triangles[turned] = triangles[turned][:, [1, 0, 2]]
    different = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1) & (triangles != -1).all(axis=1)
    strip: Integers = triangles[same_strip & different]
    return strip


def split_fan(corners: NDArray[np.integer]) -> Integers:
    """Split a triangle fan (C,) into triangles (T, 3) that share its first corner.

    >>> split_fan(np.array([5, 0, 1, 2])).tolist()
    [[5, 0, 1], [5, 1, 2]]
    """
    hub = np.full(max(len(corners) - 2, 0), corners[0] if len(corners) else 0)
    return np.stack([hub, corners[1:-1], corners[2:]], axis=1).astype(np.int64)


def _split_same_count(vertices: NDArray[np.floating], rings: NDArray[np.integer]) -> Integers:
    """Split polygons (m, n) that all have n corners; return the triangles of each, (m, n - 2, 3)."""
    rings = rings.astype(np.int64, copy=False)
    count = rings.shape[1]
    starts = np.zeros(len(rings), dtype=np.int64)
    pending = np.arange(len(rings))
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates may be as large as numbers get
        # A quadrilateral has two fans, and a polygon as many as it has corners.
        for start in range(2 if count == CORNERS + 1 else count if count <= MOST_FANS else 1):
            covered = _fans_cover(vertices, np.roll(rings[pending], -start, axis=1))
            starts[pending[covered]] = start
            pending = pending[~covered]
            if len(pending) == 0:
                break
    turned = rings
    if starts.any():
        turned = np.take_along_axis(rings, (starts[:, None] + np.arange(count)) % count, axis=1)
    fans = np.stack([np.broadcast_to(turned[:, :1], (len(rings), count - 2)), turned[:, 1:-1], turned[:, 2:]], axis=2)
    if count > CORNERS + 1:
        for index in pending.tolist():
            clipped = _clip_ears(np.asarray(vertices[rings[index]], dtype=np.float64))
            if clipped is not None:
                fans[index] = rings[index][clipped]
    return fans


def _fans_cover(vertices: NDArray[np.floating], rings: Integers) -> NDArray[np.bool_]:
    """Mark the polygons (m, n) whose fan from the first corner has only triangles that face as the polygon does."""
    corners = vertices[rings] - vertices[rings[:, :1]]
    x, y, z = np.moveaxis(corners[:, 1:], 2, 0)
    normals = np.stack(
        [
            y[:, :-1] * z[:, 1:] - z[:, :-1] * y[:, 1:],
            z[:, :-1] * x[:, 1:] - x[:, :-1] * z[:, 1:],
            x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:],
        ]
    )
    polygon_normal = normals.sum(axis=2)
    along = np.einsum("kmi,km->mi", normals, polygon_normal)
    covered: NDArray[np.bool_] = (along > FLAT * (polygon_normal**2).sum(axis=0)[:, None]).all(axis=1)
    return covered


def _clip_ears(ring: Floats) -> Integers | None:
    """Split a polygon (n, 3) in the coordinate plane in which it is largest; return None if it has no area."""
    from manifold3d import triangulate

    corners = ring - ring[0]
    with np.errstate(over="ignore", invalid="ignore"):
        normal = np.cross(corners[1:-1], corners[2:]).sum(axis=0)
    if not np.isfinite(normal).all() or not normal.any():
        return None
    axis = int(np.abs(normal).argmax())
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    flat = corners[:, plane if normal[axis] > 0 else plane[::-1]]
    triangles = np.asarray(triangulate([np.ascontiguousarray(flat)]), dtype=np.int64)
    return triangles if triangles.shape == (len(ring) - 2, CORNERS) else None
