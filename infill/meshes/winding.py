"""Winding numbers of a surface: the points inside it, and the faces that bound its solid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.kernels.threads import in_threads, thread_count
from infill.surface import Surface

MOST_TRIANGLE_TESTS = 500_000_000  # most triangles examined to tell which points are hidden: half a second


def winding_numbers(
    points: NDArray[np.floating],
    surface: Surface,
    *,
    sign: NDArray[np.int64] | None = None,
    threads: int | None = None,
) -> NDArray[np.int64]:
    """Count the windings of a surface around each point, (N,).

    Parameters
    ----------
    points : (N, 3) float, mm
    surface : Surface, mm
        Closed; for an open surface, the number is right where no hole lies straight above a point.
    sign : (F,) int64, optional
        -1 for a face that counts as if it were turned, else 1.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> solid = Surface(vertices=corners, faces=np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> winding_numbers(np.array([[1.0, 0.5, 0.7], [3, 3, 3]]), solid).tolist()
    [1, 0]
    """
    from infill.kernels.distances import count_windings

    windings = np.zeros(len(points), dtype=np.int64)
    if len(points) == 0:
        return windings
    corners = np.ascontiguousarray(np.asarray(surface.vertices, dtype=np.float64)[surface.faces])
    queries = np.ascontiguousarray(points, dtype=np.float64)
    sign = np.ones(len(corners), dtype=np.int64) if sign is None else sign
    in_threads(count_windings, queries, corners, sign, windings, threads=thread_count(threads))
    return windings


def is_solid_boundary(
    points: Floats, faces: NDArray[np.integer], surface: Surface, aside: float, *, threads: int | None = None
) -> NDArray[np.bool_]:
    """Mark the points (N, 3) on faces (N,) of a surface that have solid on one side only.

    Other points lie inside the solid, as where bodies overlap, and are invisible; or they lie on a sheet that bounds no
    solid, and do not matter.

    Parameters
    ----------
    points : (N, 3) float64, mm
    faces : (N,) int
    surface : Surface, mm
    aside : float, mm
        Distance from the face at which both sides are examined.

    Notes
    -----
    If there are very many points, only every n-th is examined, and the next ones get the same answer.
    """
    if len(points) == 0:
        return np.zeros(0, dtype=bool)
    a, b, c = (np.asarray(surface.vertices, dtype=np.float64)[surface.faces[faces, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    stride = -(-2 * len(points) * len(surface.faces) // MOST_TRIANGLE_TESTS)
    offset = aside * np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    outer_solid, inner_solid = (
        winding_numbers((points + sign * offset)[::stride], surface, threads=threads) != 0 for sign in (1, -1)
    )
    bounding: NDArray[np.bool_] = np.repeat(outer_solid != inner_solid, stride)[: len(points)]
    return bounding
