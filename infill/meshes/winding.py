"""How often a surface winds around points: what lies inside it, and which of its faces bound its solid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.surface import Surface

Floats = NDArray[np.float64]

LOOKED = 500_000_000  # triangles looked at, at most, to tell which points are hidden: half a second


def winding(
    points: NDArray[np.floating],
    surface: Surface,
    *,
    sign: NDArray[np.int64] | None = None,
    threads: int | None = None,
) -> NDArray[np.int64]:
    """Return how often a surface winds around each point, (N,).

    Parameters
    ----------
    points : (N, 3) float, mm
    surface : Surface, mm
        Closed: for an open one, the number is right where no hole lies straight above a point.
    sign : (F,) int64, optional
        -1 for a face that counts as if it were turned, else 1.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> solid = Surface(vertices=corners, faces=np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> winding(np.array([[1.0, 0.5, 0.7], [3, 3, 3]]), solid).tolist()
    [1, 0]
    """
    from infill.kernels.distances import wind

    found = np.zeros(len(points), dtype=np.int64)
    if len(points) == 0:
        return found
    corners = np.ascontiguousarray(np.asarray(surface.vertices, dtype=np.float64)[surface.faces])
    given = np.ascontiguousarray(points, dtype=np.float64)
    sign = np.ones(len(corners), dtype=np.int64) if sign is None else sign
    in_threads(wind, given, corners, sign, found, threads=thread_count(threads))
    return found


def bounds_solid(
    points: Floats, faces: NDArray[np.integer], surface: Surface, aside: float, *, threads: int | None = None
) -> NDArray[np.bool_]:
    """Return which points (N, 3) on faces (N,) of a surface have its solid on one side only.

    The others lie inside the solid, as where bodies overlap, or on a sheet that bounds none: nobody sees the first, and
    nobody misses the second.

    Parameters
    ----------
    points : (N, 3) float64, mm
    faces : (N,) int
    surface : Surface, mm
    aside : float, mm
        How far from the face it is looked, on both sides.

    Notes
    -----
    If the points are very many, some are looked at, and those after them taken to be alike.
    """
    if len(points) == 0:
        return np.zeros(0, dtype=bool)
    a, b, c = (np.asarray(surface.vertices, dtype=np.float64)[surface.faces[faces, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    step = -(-2 * len(points) * len(surface.faces) // LOOKED)
    away = aside * np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    one, other = (winding((points + way * away)[::step], surface, threads=threads) != 0 for way in (1, -1))
    found: NDArray[np.bool_] = np.repeat(one != other, step)[: len(points)]
    return found
