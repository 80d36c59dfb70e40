"""Distances to lines that change from layer to layer, at the centres of cells."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.cells import interpolate_ratio, lower_to_segments
from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def distances_to_lines(segments, layer_start, reach, distances, thread, threads) -> None:
    """Write the distance of each point of a layer from the nearest segment of this layer, cut off at `reach`.

    Parameters
    ----------
    segments : (S, 2, 2) float64
        In cells; the centre of cell (0, 0) is the origin.
    layer_start : (nz + 1,) int64
        The first segment of each layer, and the total number.
    reach : float
        Cells.
    distances : (nx, ny, nz) float32
    thread, threads : int
        This call writes every `threads`-th layer.
    """
    nx, ny, nz = distances.shape
    plane = np.empty((nx, ny), dtype=np.float32)
    for k in range(thread, nz, threads):
        plane[:] = reach**2
        lower_to_segments(segments[layer_start[k] : layer_start[k + 1]], reach, plane)
        for i in range(nx):
            for j in range(ny):
                distances[i, j, k] = math.sqrt(plane[i, j])


@njit(nogil=True, cache=True, error_model="numpy")
def from_layers(depth, threshold, distances, reach, steepest, sign, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into the void beside walls that lean, in cells.

    Along a layer, a leaning wall is further away than in space; the slope of the distance over layers corrects this.

    Parameters
    ----------
    depth, threshold, half, ratio, step, out, thread, threads
        As in `from_period`.
    distances : (nx, ny, nz) float32
        Along the layer, in cells: see `distances_to_lines`. If walls have two sides, it is negative on one of them.
    reach : float
        Cut-off distance.
    sign : float
        1 for the positive side, -1 for the other.
    steepest : float
        Cells per layer. Larger changes are not slopes: lines begin or end there.
    """
    nx, ny, nz = depth.shape
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= threshold:
                    out[i, j, k] = deep
                    continue
                distance, slope = distances[i, j, k], 0.0
                if abs(distance) < reach:
                    for next_layer in (k - 1, k + 1):
                        if 0 <= next_layer < nz:
                            change = abs(distances[i, j, next_layer] - distance)
                            if change <= steepest:
                                slope = max(slope, change)
                value = min(
                    sign * distance / math.sqrt(1 + slope * slope) - half * interpolate_ratio(ratio, step, i, j, k),
                    deep,
                )
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled
