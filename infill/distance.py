"""How far points lie from a surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.ragged import spread
from infill.surface import Surface

Floats = NDArray[np.float64]

NEAREST = 6  # samples whose triangles are looked at for every point
SAMPLES = 400_000  # of a surface, about, at most


def distances(points: NDArray[np.floating], surface: Surface) -> Floats:
    """Return the distance of each point from the nearest triangle, (N,) mm.

    Parameters
    ----------
    points : (N, 3) float, mm
    surface : Surface, mm

    Notes
    -----
    Triangles are found by the samples on them that lie nearest; large triangles have many samples.
    """
    from scipy.spatial import cKDTree

    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    sample, face = _samples(corners)
    _, near = cKDTree(sample).query(points, k=min(NEAREST, len(sample)), workers=-1)
    near = near.reshape(len(points), -1)
    best = np.full(len(points), np.inf)
    for column in near.T:
        best = np.minimum(best, _squared(np.asarray(points, dtype=np.float64), corners[face[column]]))
    found: Floats = np.sqrt(best)
    return found


def _samples(corners: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Return points on the triangles, closer to one another than the median edge or so, and their triangles."""
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    area = float(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum())
    pitch = max(float(np.median(edges)), (area / SAMPLES) ** 0.5, 1e-300)
    parts = np.maximum(1, np.ceil(edges / pitch)).astype(np.int64)  # of each side
    face, place = next(spread(parts * (parts + 1) // 2))
    n = parts[face]
    # Row by row along the triangle: row r has n - r samples.
    row = np.floor(n + 0.5 - np.sqrt((n + 0.5) ** 2 - 2 * place)).astype(np.int64)
    column = place - (row * n - row * (row - 1) // 2)
    u, v = (row + 1 / 3) / n, (column + 1 / 3) / n
    a, b, c = (corners[face, i] for i in range(3))
    return a + u[:, None] * (b - a) + v[:, None] * (c - a), face


def _squared(p: Floats, triangles: Floats) -> Floats:
    """Return the squared distance of point i from triangle i."""
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
