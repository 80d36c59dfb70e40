"""Distances to a surface that repeats in the coordinates given by a cubic spline."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.cells import interpolate_ratio
from infill.kernels.compiling import njit

MIN_SLOPE = 0.05  # of a distance: on the ridge between two walls it has none


@njit(nogil=True, cache=True, error_model="numpy", inline="always")
def spline_weights(at, value, slope):
    """Write the weights of the four nodes around a place between the second and third, and their slopes."""
    value[0] = (1 - at) ** 3 / 6
    value[1] = (3 * at**3 - 6 * at**2 + 4) / 6
    value[2] = (-3 * at**3 + 3 * at**2 + 3 * at + 1) / 6
    value[3] = at**3 / 6
    slope[0] = -((1 - at) ** 2) / 2
    slope[1] = (3 * at**2 - 4 * at) / 2
    slope[2] = (-3 * at**2 + 2 * at + 1) / 2
    slope[3] = at**2 / 2


@njit(nogil=True, cache=True, error_model="numpy")
def from_stretched_period(
    depth, threshold, table, turn, start, period, sign, half, ratio, step, spline, out, thread, threads
):
    """Fill `out` with the lesser of the depth and the distance into the void beside a stretched surface, in cells.

    To first order: the distance in the coordinates of the pattern, divided by the stretch of a step across the wall.
    So walls have the requested width, however their cells are stretched.

    Parameters
    ----------
    spline : (n, m, l, 3) float64
        Position of cells in the pattern before it is turned, in units of `step` cells: coefficients of a cubic spline
        over nodes that are `step` cells apart, of which the second along each axis is at cell 0.
    start : (3,) float64
        Position of the zero of the spline, in the pattern, in cells.
    depth, threshold, table, turn, period, sign, half, ratio, step, out, thread, threads
        As in `cells.from_period`.
    """
    nx, ny, nz = depth.shape
    n = len(table)
    inner = spline.shape[2]
    # Of the spline over one row of cells: coordinates, and their slopes along x and y.
    rows = np.empty((inner, 9))
    xs, ys, zs = np.empty(4), np.empty(4), np.empty(4)
    xd, yd, zd = np.empty(4), np.empty(4), np.empty(4)
    flat = np.empty(9)
    up = np.empty(3)
    filled = 0.0
    for i in range(thread, nx, threads):
        node_i = min(int(i / step), spline.shape[0] - 4)
        spline_weights(i / step - node_i, xs, xd)
        for j in range(ny):
            second = min(int(j / step), spline.shape[1] - 4)
            spline_weights(j / step - second, ys, yd)
            has_row = False
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= threshold:
                    out[i, j, k] = deep
                    continue
                if not has_row:
                    has_row = True
                    for c in range(inner):
                        for d in range(9):
                            rows[c, d] = 0.0
                        for a in range(4):
                            for b in range(4):
                                for d in range(3):
                                    node = spline[node_i + a, second + b, c, d]
                                    rows[c, d] += xs[a] * ys[b] * node
                                    rows[c, 3 + d] += xd[a] * ys[b] * node
                                    rows[c, 6 + d] += xs[a] * yd[b] * node
                third = min(int(k / step), inner - 4)
                spline_weights(k / step - third, zs, zd)
                for d in range(9):
                    flat[d] = (
                        zs[0] * rows[third, d]
                        + zs[1] * rows[third + 1, d]
                        + zs[2] * rows[third + 2, d]
                        + zs[3] * rows[third + 3, d]
                    )
                for d in range(3):
                    up[d] = (
                        zd[0] * rows[third, d]
                        + zd[1] * rows[third + 1, d]
                        + zd[2] * rows[third + 2, d]
                        + zd[3] * rows[third + 3, d]
                    )
                u, v, w = flat[0] * step, flat[1] * step, flat[2] * step
                x = (start[0] + turn[0, 0] * u + turn[0, 1] * v + turn[0, 2] * w) / period
                y = (start[1] + turn[1, 0] * u + turn[1, 1] * v + turn[1, 2] * w) / period
                z = (start[2] + turn[2, 0] * u + turn[2, 1] * v + turn[2, 2] * w) / period
                x, y, z = (x - math.floor(x)) * n, (y - math.floor(y)) * n, (z - math.floor(z)) * n
                a, b, c = int(x), int(y), int(z)
                x, y, z = x - a, y - b, z - c
                a, b, c = a % n, b % n, c % n
                d, e, f = (a + 1) % n, (b + 1) % n, (c + 1) % n
                t000, t001, t010, t011 = table[a, b, c], table[a, b, f], table[a, e, c], table[a, e, f]
                t100, t101, t110, t111 = table[d, b, c], table[d, b, f], table[d, e, c], table[d, e, f]
                low0, low1 = t000 * (1 - z) + t001 * z, t010 * (1 - z) + t011 * z
                high0, high1 = t100 * (1 - z) + t101 * z, t110 * (1 - z) + t111 * z
                low, high = low0 * (1 - y) + low1 * y, high0 * (1 - y) + high1 * y
                value = low * (1 - x) + high * x
                # The slope of the distance in the pattern, turned back, and stretched.
                gx = (high - low) * n
                gy = ((low1 - low0) * (1 - x) + (high1 - high0) * x) * n
                gz = (
                    ((t001 - t000) * (1 - y) + (t011 - t010) * y) * (1 - x)
                    + ((t101 - t100) * (1 - y) + (t111 - t110) * y) * x
                ) * n
                p = turn[0, 0] * gx + turn[1, 0] * gy + turn[2, 0] * gz
                q = turn[0, 1] * gx + turn[1, 1] * gy + turn[2, 1] * gz
                r = turn[0, 2] * gx + turn[1, 2] * gy + turn[2, 2] * gz
                long = math.sqrt(p * p + q * q + r * r)
                p, q, r = p / max(long, MIN_SLOPE), q / max(long, MIN_SLOPE), r / max(long, MIN_SLOPE)
                across = math.sqrt(
                    (flat[3] * p + flat[4] * q + flat[5] * r) ** 2
                    + (flat[6] * p + flat[7] * q + flat[8] * r) ** 2
                    + (up[0] * p + up[1] * q + up[2] * r) ** 2
                )
                distance = sign * value * period / max(across, MIN_SLOPE)
                distance = min(distance - half * interpolate_ratio(ratio, step, i, j, k), deep)
                out[i, j, k] = distance
                filled += min(1.0, max(0.0, 0.5 + distance))
    return filled
