"""Pairs of triangles of a mesh that pass through each other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.meshes.distance import LEAF, TriangleTree
from infill.surface import Surface

ROOM = 1 << 10  # pairs of each thread, at first


def count_self_intersections(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> int:
    """Count the pairs of triangles that pass through each other: see `intersecting_pairs`."""
    return len(intersecting_pairs(Surface(vertices=vertices, faces=faces)))


def intersecting_pairs(
    surface: Surface, *, tree: TriangleTree | None = None, threads: int | None = None
) -> NDArray[np.int64]:
    """Return the pairs of triangles that pass through each other, (N, 2), in order, the lower index first.

    Parameters
    ----------
    surface : Surface
    tree : TriangleTree, optional
        Of the surface, if it is known.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    Pairs that share a vertex do not count, nor do triangles that only touch or that overlap in one plane.
    A pair counts if an edge of one crosses the interior of the other.

    >>> upright = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 1]])
    >>> intersecting_pairs(Surface(vertices=upright, faces=np.arange(6).reshape(2, 3))).tolist()
    [[0, 1]]
    """
    from infill.kernels.crossings import crossing_pairs

    if not len(surface.faces):
        return np.empty((0, 2), dtype=np.int64)
    tree, threads = tree or TriangleTree.of(surface), thread_count(threads)
    faces = np.ascontiguousarray(surface.faces[tree.order], dtype=np.int64)
    room = ROOM
    while True:
        buffer = np.empty((threads, room, 2), dtype=np.int64)
        counts = in_threads(crossing_pairs, tree.corners, faces, tree.low, tree.high, LEAF, buffer, threads=threads)
        if max(counts) <= room:
            break
        room = max(counts)
    pairs = np.sort(tree.order[np.concatenate([buffer[n, :count] for n, count in enumerate(counts)])], axis=1)
    return pairs[np.lexsort(pairs.T[::-1])]
