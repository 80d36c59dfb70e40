"""Triangles of a mesh that pass through each other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from infill.ragged import spread

PAIRS_AT_ONCE = 1_000_000
ENTRIES_PER_TRIANGLE = 8  # cells that a triangle may occupy on average before the cells are made larger
GROWTH = 1.5


def self_intersections(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> int:
    """Return how many pairs of triangles pass through each other: see `intersecting`."""
    return len(intersecting(vertices, faces))


def intersecting(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return the pairs of triangles that pass through each other, (N, 2).

    Parameters
    ----------
    vertices : (V, 3) float
    faces : (F, 3) int

    Notes
    -----
    Pairs that share a vertex do not count, nor do triangles that only touch or that overlap in one plane.
    Candidates come from a uniform grid; a pair counts if an edge of one crosses the interior of the other.
    """
    corners = vertices[faces].astype(np.float64)
    corners -= corners.reshape(-1, 3).mean(axis=0)
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = [np.empty((0, 2), dtype=np.int64)]
    for one, other in _candidates(low, high):
        shared = (faces[one][:, :, None] == faces[other][:, None, :]).any(axis=(1, 2))
        one, other = one[~shared], other[~shared]
        through = _pierces(corners[one], corners[other]) | _pierces(corners[other], corners[one])
        found.append(np.stack([one[through], other[through]], axis=1))
    return np.concatenate(found)


def _candidates(
    low: NDArray[np.float64], high: NDArray[np.float64]
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Yield pairs (one, other) of triangles whose bounding boxes meet, each pair once."""
    size = np.maximum(1.5 * (high - low).mean(axis=0), (high.max(axis=0) - low.min(axis=0)) / 1000) + 1e-300
    lower = low.min(axis=0)
    while True:
        first, last = np.floor((low - lower) / size).astype(np.int64), np.floor((high - lower) / size).astype(np.int64)
        across = last - first + 1
        counts = across.prod(axis=1)
        if counts.sum() <= ENTRIES_PER_TRIANGLE * len(low):
            break
        size = size * GROWTH
    triangle, step = next(spread(counts))
    wide, deep = across[triangle, 2], across[triangle, 1]
    cell = first[triangle] + np.stack([step // (wide * deep), step // wide % deep, step % wide], axis=-1)
    shape = last.max(axis=0) + 1
    key = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    order = np.argsort(key, kind="stable")
    triangle, key, cell = triangle[order], key[order], cell[order]
    # An entry pairs with all later entries in the same cell.
    ends = np.searchsorted(key, key, side="right")
    after = ends - np.arange(len(key)) - 1
    for entry, place in spread(after, PAIRS_AT_ONCE):
        one, other = triangle[entry], triangle[entry + 1 + place]
        for axis in range(3):
            # Two boxes may share many cells: the pair belongs to the lowest one.
            lowest = np.maximum(first[one, axis], first[other, axis]) == cell[entry, axis]
            meets = (low[one, axis] <= high[other, axis]) & (low[other, axis] <= high[one, axis])
            kept = np.flatnonzero(lowest & meets)
            one, other, entry = one[kept], other[kept], entry[kept]
        yield one, other


def _pierces(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return whether an edge of `one` (n, 3, 3) crosses the interior of `other`, pair by pair."""
    a, b, c = other[:, 0], other[:, 1], other[:, 2]
    normal = np.cross(b - a, c - a)
    scale = np.abs(one - a[:, None]).max(axis=(1, 2)) * np.linalg.norm(normal, axis=1)
    side = np.einsum("nij,nj->ni", one - a[:, None], normal)
    side[np.abs(side) <= 1e-9 * scale[:, None]] = 0
    hit = np.zeros(len(one), dtype=bool)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        crossing = np.flatnonzero(side[:, start] * side[:, end] < 0)
        if len(crossing) == 0:
            continue
        from_side, to_side = side[crossing, start], side[crossing, end]
        part = (from_side / (from_side - to_side))[:, None]
        point = one[crossing, start] + part * (one[crossing, end] - one[crossing, start])
        inside = np.ones(len(crossing), dtype=bool)
        for p, q in ((a, b), (b, c), (c, a)):
            edge = q[crossing] - p[crossing]
            turn = np.einsum("ni,ni->n", np.cross(edge, point - p[crossing]), normal[crossing])
            inside &= turn > 1e-9 * scale[crossing] * np.linalg.norm(normal[crossing], axis=1)
        hit[crossing[inside]] = True
    return hit
