"""A majority vote among neighbours, compiled: see `infill.voxels.noise`."""
# mypy: disable-error-code="no-untyped-def, assignment"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

VOTERS = 27  # a cell and its neighbours
OVERLAP_LAYERS = 2  # layers at either end of a slab without known neighbours


@njit(from_python=False, nogil=True, cache=True)
def count_votes(solid, rows, planes, counts):
    """Count the set cells among the 27 around each of `solid`, 0 or 1; cells beyond the edge repeat those at it.

    `rows` is work space for a layer, `planes` for all of them: sums along one axis, and along two.
    """
    n0, n1, n2 = solid.shape
    for i in range(n0):
        for j in range(n1):
            line, out = solid[i, j], rows[j]
            out[0] = 2 * line[0] + line[min(1, n2 - 1)]
            for k in range(1, n2 - 1):
                out[k] = line[k - 1] + line[k] + line[k + 1]
            if n2 > 1:
                out[n2 - 1] = line[n2 - 2] + 2 * line[n2 - 1]
        for j in range(n1):
            before, line, after, out = rows[max(j - 1, 0)], rows[j], rows[min(j + 1, n1 - 1)], planes[i, j]
            for k in range(n2):
                out[k] = before[k] + line[k] + after[k]
    for i in range(n0):
        for j in range(n1):
            before, line, after = planes[max(i - 1, 0), j], planes[i, j], planes[min(i + 1, n0 - 1), j]
            out = counts[i, j]
            for k in range(n2):
                out[k] = before[k] + line[k] + after[k]


@njit(nogil=True, cache=True)
def count_overruled(slab, room, inner, counts):
    """Add the numbers of 1s and of 0s that a majority overrules, and of the cells at the resulting surface.

    `room` is work space for three slabs and a layer, (3 n0 + 1, n1, n2) uint8, shared by many slabs. Only cells in the
    rows and columns `inner` (j0, j1, k0, k1) are counted.
    """
    j0, j1, k0, k1 = inner
    n0 = len(slab)
    planes, majority, again, rows = room[:n0], room[n0 : 2 * n0], room[2 * n0 : 3 * n0], room[3 * n0]
    count_votes(slab, rows, planes, majority)
    flat = majority.reshape(-1)
    for t in range(len(flat)):
        flat[t] = flat[t] > VOTERS // 2
    count_votes(majority, rows, planes, again)
    begin, end = (OVERLAP_LAYERS, n0 - OVERLAP_LAYERS) if n0 > 2 * OVERLAP_LAYERS else (0, n0)
    taken = added = surface = 0
    for i in range(begin, end):
        for j in range(j0, j1):  # row by row: vector code
            line, majority_line, vote_line = slab[i, j, k0:k1], majority[i, j, k0:k1], again[i, j, k0:k1]
            for k in range(k1 - k0):
                taken += line[k] > majority_line[k]
                added += line[k] < majority_line[k]
                surface += np.uint8(vote_line[k] - np.uint8(1)) < np.uint8(VOTERS - 1)
    counts[0] += taken
    counts[1] += added
    counts[2] += surface
