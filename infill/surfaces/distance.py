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
    _, near = cKDTree(sample).query(points, k=min(NEAREST, len(sample)), workers=thread_count(threads))
    near = near.reshape(len(points), -1)
    best = np.full(len(points), np.inf)
    for column in near.T:
        best = np.minimum(best, squared(np.asarray(points, dtype=np.float64), corners[face[column]]))
    found: Floats = np.sqrt(best)
    return found


def _samples(corners: Floats, count: int) -> tuple[Floats, NDArray[np.int64]]:
    """Return points all over the triangles, and their triangles; a needle has one row of them, on its longest side."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    order = (sides.argmax(axis=1)[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(corners, order[:, :, None], axis=1)  # the longest side comes first
    a, b, c = (corners[:, i] for i in range(3))
    longest = sides.max(axis=1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)  # twice the area
    height = np.divide(area, longest, out=np.zeros_like(area), where=longest > 0)
    pitch = max(float(area.sum() / count) ** 0.5, float(longest.sum()) / count, 1e-300)
    along, across = (np.maximum(1, np.ceil(each / pitch)).astype(np.int64) for each in (longest, height))
    face, place = next(spread(along * across))
    u, v = (place % along[face] + 0.5) / along[face], place // along[face] / across[face]
    u *= 1 - v  # the row of points parallel to the longest side is as long as the triangle is wide there
    return a[face] + u[:, None] * (b - a)[face] + v[:, None] * (c - a)[face], face


def squared(p: Floats, triangles: Floats) -> Floats:
    """Return the squared distance of point i from triangle i.

    The same as trimesh.triangles.closest_point, without the time it takes to load trimesh, which is longer than
    computing the distances.
    """
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    length = (normal**2).sum(axis=1)
    best = np.full(len(p), np.inf)
    inside = length > 0
    for one, other in ((a, b), (b, c), (c, a)):
        along, off = other - one, p - one
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.nan_to_num((off * along).sum(axis=1) / (along**2).sum(axis=1)).clip(0, 1)
        best = np.minimum(best, ((off - t[:, None] * along) ** 2).sum(axis=1))
        inside &= (np.cross(along, off) * normal).sum(axis=1) >= 0
    with np.errstate(divide="ignore", invalid="ignore"):
        flat = ((p - a) * normal).sum(axis=1) ** 2 / length
    return np.where(inside, flat, best)
