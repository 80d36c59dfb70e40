"""How far points lie from a surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import thread_count
from infill.ragged import spread
from infill.surface import Surface

Floats = NDArray[np.float64]

NEAREST = 6  # samples whose triangles are examined for every point
FEW, PER_POINT, MOST = 10_000, 10, 200_000  # samples of a surface, roughly, in addition to one for each triangle


def distances(points: NDArray[np.floating], surface: Surface, *, threads: int | None = None) -> Floats:
    """Return the distance of each point from the nearest triangle, (N,) mm.

    Parameters
    ----------
    points : (N, 3) float, mm
    surface : Surface, mm
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    Triangles are found by the nearest samples on them; large triangles have many samples. Where the nearest triangle
    is not among those found, the distance comes out too large, by less than the distance between samples.
    """
    from scipy.spatial import cKDTree

    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    sample, face = _samples(corners, min(MOST, FEW + PER_POINT * len(points)))
    tree = cKDTree(sample, balanced_tree=False, compact_nodes=False)  # asked once: built in a third of the time
    _, near = tree.query(points, k=min(NEAREST, len(sample)), workers=thread_count(threads))
    near = near.reshape(len(points), -1)
    best = np.full(len(points), np.inf)
    for column in near.T:
        best = np.minimum(best, squared(np.asarray(points, dtype=np.float64), corners[face[column]]))
    found: Floats = np.sqrt(best)
    return found


def _samples(corners: Floats, count: int) -> tuple[Floats, NDArray[np.int64]]:
    """Return points all over the triangles, and their triangles; a needle has one row of them, on its longest side."""
    a, b, c = (_columns(corners[:, i]) for i in range(3))
    lengths = [np.sqrt(_dot(end - start, end - start)) for start, end in ((a, b), (b, c), (c, a))]
    longest = np.maximum(np.maximum(*lengths[:2]), lengths[2])
    # The longest side comes first.
    turns = np.where(lengths[0] == longest, 0, np.where(lengths[1] == longest, 1, 2))
    a, b, c = (np.choose(turns, order) for order in ((a, b, c), (b, c, a), (c, a, b)))
    normal = _cross(b - a, c - a)
    area = np.sqrt(_dot(normal, normal))  # twice the area
    height = np.divide(area, longest, out=np.zeros_like(area), where=longest > 0)
    pitch = max(float(area.sum() / count) ** 0.5, float(longest.sum()) / count, 1e-300)
    along, across = (np.maximum(1, np.ceil(each / pitch)).astype(np.int64) for each in (longest, height))
    face, place = next(spread(along * across))
    rows = along[face]
    u, v = (place % rows + 0.5) / rows, place // rows / across[face]
    u *= 1 - v  # the row of points parallel to the longest side is as long as the triangle is wide there
    points = np.empty((len(face), 3))
    for axis, (start, one, other) in enumerate(zip(a, b - a, c - a, strict=True)):
        points[:, axis] = start[face] + u * one[face] + v * other[face]
    return points, face


def squared(p: Floats, triangles: Floats) -> Floats:
    """Return the squared distance of point i from triangle i.

    The same as trimesh.triangles.closest_point, without the time it takes to load trimesh, which is longer than
    computing the distances.
    """
    point, a, b, c = (_columns(each) for each in (p, triangles[:, 0], triangles[:, 1], triangles[:, 2]))
    normal = _cross(b - a, c - a)
    length = _dot(normal, normal)
    best = np.full(len(p), np.inf)
    inside = length > 0
    for one, other in ((a, b), (b, c), (c, a)):
        along, off = other - one, point - one
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.nan_to_num(_dot(off, along) / _dot(along, along)).clip(0, 1)
        rest = off - t * along
        best = np.minimum(best, _dot(rest, rest))
        inside &= _dot(_cross(along, off), normal) >= 0
    with np.errstate(divide="ignore", invalid="ignore"):
        flat = _dot(point - a, normal) ** 2 / length
    return np.where(inside, flat, best)


def _columns(rows: Floats) -> Floats:
    """Return vectors (N, 3) as (3, N), each coordinate in one piece: three times as fast to compute with."""
    return np.ascontiguousarray(rows.T)


def _dot(one: Floats, other: Floats) -> Floats:
    found: Floats = one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
    return found


def _cross(one: Floats, other: Floats) -> Floats:
    return np.stack(
        [
            one[1] * other[2] - one[2] * other[1],
            one[2] * other[0] - one[0] * other[2],
            one[0] * other[1] - one[1] * other[0],
        ]
    )
