"""Pairs of triangles of a mesh that pass through each other."""

from __future__ import annotations

import sys
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.meshes.distance import LEAF, TriangleTree
from infill.ragged import expand_rows
from infill.surface import Surface

ROOM = 1 << 10  # pairs of each thread, at first
PAIRS_AT_ONCE = 1_000_000
ENTRIES_PER_TRIANGLE = 8  # cells that a triangle may occupy on average before the cells are made larger
GROWTH = 1.5


def count_self_intersections(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> int:
    """Count the pairs of triangles that pass through each other: see `intersecting_pairs`.

    By a kernel, which is faster than NumPy, if Numba is loaded: `infill check` starts without it.
    """
    if "numba" not in sys.modules:
        return len(intersecting_pairs_reference(vertices, faces))
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


def intersecting_pairs_reference(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return the pairs of triangles that pass through each other, (N, 2), by NumPy: see `intersecting_pairs`.

    In any order; candidates come from a uniform grid.
    """
    corners = vertices[faces].astype(np.float64)
    corners -= corners.reshape(-1, 3).mean(axis=0)
    low, high = corners.min(axis=1), corners.max(axis=1)
    pairs = [np.empty((0, 2), dtype=np.int64)]
    for first_triangle, second_triangle in _candidate_pairs(low, high):
        adjacent = (faces[first_triangle][:, :, None] == faces[second_triangle][:, None, :]).any(axis=(1, 2))
        first_triangle, second_triangle = first_triangle[~adjacent], second_triangle[~adjacent]
        crossing = _edge_pierces(corners[first_triangle], corners[second_triangle]) | _edge_pierces(
            corners[second_triangle], corners[first_triangle]
        )
        pairs.append(np.stack([first_triangle[crossing], second_triangle[crossing]], axis=1))
    return np.concatenate(pairs)


def _candidate_pairs(
    low: NDArray[np.float64], high: NDArray[np.float64]
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Yield arrays of triangle pairs whose bounding boxes meet, each pair once."""
    size = np.maximum(1.5 * (high - low).mean(axis=0), (high.max(axis=0) - low.min(axis=0)) / 1000) + 1e-300
    lower = low.min(axis=0)
    while True:
        low_cell, high_cell = (
            np.floor((low - lower) / size).astype(np.int64),
            np.floor((high - lower) / size).astype(np.int64),
        )
        cells_across = high_cell - low_cell + 1
        counts = cells_across.prod(axis=1)
        if counts.sum() <= ENTRIES_PER_TRIANGLE * len(low):
            break
        size = size * GROWTH
    triangle, step = next(expand_rows(counts))
    depth_z, depth_y = cells_across[triangle, 2], cells_across[triangle, 1]
    cell = low_cell[triangle] + np.stack(
        [step // (depth_z * depth_y), step // depth_z % depth_y, step % depth_z], axis=-1
    )
    shape = high_cell.max(axis=0) + 1
    key = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    order = np.argsort(key, kind="stable")
    triangle, key, cell = triangle[order], key[order], cell[order]
    # An entry pairs with all later entries in the same cell.
    ends = np.searchsorted(key, key, side="right")
    later_entries = ends - np.arange(len(key)) - 1
    for entry, place in expand_rows(later_entries, PAIRS_AT_ONCE):
        first_triangle, second_triangle = triangle[entry], triangle[entry + 1 + place]
        for axis in range(3):
            # Two boxes may share many cells: the pair belongs to the lowest one.
            lowest = np.maximum(low_cell[first_triangle, axis], low_cell[second_triangle, axis]) == cell[entry, axis]
            meets = (low[first_triangle, axis] <= high[second_triangle, axis]) & (
                low[second_triangle, axis] <= high[first_triangle, axis]
            )
            chosen = np.flatnonzero(lowest & meets)
            first_triangle, second_triangle, entry = first_triangle[chosen], second_triangle[chosen], entry[chosen]
        yield first_triangle, second_triangle


def _edge_pierces(triangles: NDArray[np.float64], targets: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell whether an edge of each of the `triangles` (n, 3, 3) crosses the interior of its partner in `targets`."""
    a, b, c = targets[:, 0], targets[:, 1], targets[:, 2]
    normal = np.cross(b - a, c - a)
    scale = np.abs(triangles - a[:, None]).max(axis=(1, 2)) * np.linalg.norm(normal, axis=1)
    side = np.einsum("nij,nj->ni", triangles - a[:, None], normal)
    side[np.abs(side) <= 1e-9 * scale[:, None]] = 0
    pierces = np.zeros(len(triangles), dtype=bool)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        crossing = np.flatnonzero(side[:, start] * side[:, end] < 0)
        if len(crossing) == 0:
            continue
        from_side, to_side = side[crossing, start], side[crossing, end]
        part = (from_side / (from_side - to_side))[:, None]
        point = triangles[crossing, start] + part * (triangles[crossing, end] - triangles[crossing, start])
        inside = np.ones(len(crossing), dtype=bool)
        for p, q in ((a, b), (b, c), (c, a)):
            edge = q[crossing] - p[crossing]
            turn = np.einsum("ni,ni->n", np.cross(edge, point - p[crossing]), normal[crossing])
            inside &= turn > 1e-9 * scale[crossing] * np.linalg.norm(normal[crossing], axis=1)
        pierces[crossing[inside]] = True
    return pierces
