"""A majority vote among neighbours, compiled: see `infill.voxels.noise`."""
# mypy: disable-error-code="no-untyped-def, assignment"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

VOTERS = 27  # a cell and its neighbours
EDGE = 2  # layers at either end of a slab that its neighbours do not know


@njit(nogil=True, cache=True)
def votes(solid, rows, planes, found):
    """Set how many of the 27 cells around each of `solid`, 0 or 1, are 1; beyond the edge, cells are those at it.

    `rows` has room for a layer, `planes` for all of them: sums along one axis, and along two.
    """
    n0, n1, n2 = solid.shape
    for i in range(n0):
        for j in range(n1):
            own, out = solid[i, j], rows[j]
            out[0] = 2 * own[0] + own[min(1, n2 - 1)]
            for k in range(1, n2 - 1):
                out[k] = own[k - 1] + own[k] + own[k + 1]
            if n2 > 1:
                out[n2 - 1] = own[n2 - 2] + 2 * own[n2 - 1]
        for j in range(n1):
            before, own, after, out = rows[max(j - 1, 0)], rows[j], rows[min(j + 1, n1 - 1)], planes[i, j]
            for k in range(n2):
                out[k] = before[k] + own[k] + after[k]
    for i in range(n0):
        for j in range(n1):
            before, own, after = planes[max(i - 1, 0), j], planes[i, j], planes[min(i + 1, n0 - 1), j]
            out = found[i, j]
            for k in range(n2):
                out[k] = before[k] + own[k] + after[k]


@njit(nogil=True, cache=True)
def count_overruled(slab, room, counts):
    """Add how many 1s and how many 0s a majority overrules, and how many cells are at the surface that is left then.

    `room` is for three slabs and a layer, (3 n0 + 1, n1, n2) uint8, so that many slabs share it.
    """
    n0, n1, n2 = slab.shape
    planes, most, again, rows = room[:n0], room[n0 : 2 * n0], room[2 * n0 : 3 * n0], room[3 * n0]
    votes(slab, rows, planes, most)
    every = most.reshape(-1)
    for t in range(len(every)):
        every[t] = every[t] > VOTERS // 2
    votes(most, rows, planes, again)
    first, last = (EDGE, n0 - EDGE) if n0 > 2 * EDGE else (0, n0)
    taken = given = surface = 0
    for i in range(first, last):
        for j in range(n1):  # row by row: vector code
            own, kept, beside = slab[i, j], most[i, j], again[i, j]
            for k in range(n2):
                taken += own[k] > kept[k]
                given += own[k] < kept[k]
                surface += np.uint8(beside[k] - np.uint8(1)) < np.uint8(VOTERS - 1)
    counts[0] += taken
    counts[1] += given
    counts[2] += surface
