"""Distances to lines that change from layer to layer, at the centres of cells."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.cells import local, lower_to_segments
from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def beside_lines(segments, first, reach, away, thread, threads) -> None:
    """Write how far each point of a layer lies from the nearest segment of this layer, cut off at `reach`.

    Parameters
    ----------
    segments : (S, 2, 2) float64
        In cells; the centre of cell (0, 0) is the origin.
    first : (nz + 1,) int64
        The first segment of each layer, and the number of all.
    reach : float
        Cells.
    away : (nx, ny, nz) float32
    thread, threads : int
        This call writes every `threads`-th layer.
    """
    nx, ny, nz = away.shape
    plane = np.empty((nx, ny), dtype=np.float32)
    for k in range(thread, nz, threads):
        plane[:] = reach**2
        lower_to_segments(segments[first[k] : first[k + 1]], reach, plane)
        for i in range(nx):
            for j in range(ny):
                away[i, j, k] = math.sqrt(plane[i, j])


@njit(nogil=True, cache=True, error_model="numpy")
def from_layers(depth, least, away, reach, steepest, sign, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into the void beside walls that lean, in cells.

    Along a layer, a wall that leans is further away than it is: by the slope of that distance from layer to layer.

    Parameters
    ----------
    depth, least, half, ratio, step, out, thread, threads
        As in `from_period`.
    away : (nx, ny, nz) float32
        Along the layer, in cells: see `beside_lines`. If walls have two sides, it is below 0 on one of them.
    reach : float
        Where it is cut off.
    sign : float
        1 for the side where it is above 0, -1 for the other.
    steepest : float
        Cells a layer. What changes by more is no slope: there, lines begin or end.
    """
    nx, ny, nz = depth.shape
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= least:
                    out[i, j, k] = deep
                    continue
                here, slope = away[i, j, k], 0.0
                if abs(here) < reach:
                    for other in (k - 1, k + 1):
                        if 0 <= other < nz:
                            change = abs(away[i, j, other] - here)
                            if change <= steepest:
                                slope = max(slope, change)
                value = min(sign * here / math.sqrt(1 + slope * slope) - half * local(ratio, step, i, j, k), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled
