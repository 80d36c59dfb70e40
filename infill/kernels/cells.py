"""Distances to a pattern at the centres of cells: from a table of one period, to bars, and to segments in a plane."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def from_period(depth, least, table, turn, start, period, sign, half, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into the void beside a surface that repeats, in cells.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        Cells below the wall. Where it is at most `least`, it is taken as it is.
    least : float
    table : (n, n, n) float32
        Distances from the surface in one period, in periods; the nodes are at i / n.
    turn : (3, 3) float64
        From the part to the pattern.
    start : (3,) float64
        Of cell (0, 0, 0), in the pattern, in cells.
    period : float
        In cells.
    sign : float
        1 for the side where the table is above 0, -1 for the other.
    half : float
        Of the width of the walls, in cells.
    out : (nx, ny, nz) float32
    thread, threads : int
        This call fills every `threads`-th layer, and returns how many cells the void fills.
    """
    nx, ny, nz = depth.shape
    n = len(table)
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= least:
                    out[i, j, k] = deep
                    continue
                x = (start[0] + turn[0, 0] * i + turn[0, 1] * j + turn[0, 2] * k) / period
                y = (start[1] + turn[1, 0] * i + turn[1, 1] * j + turn[1, 2] * k) / period
                z = (start[2] + turn[2, 0] * i + turn[2, 1] * j + turn[2, 2] * k) / period
                x, y, z = (x - math.floor(x)) * n, (y - math.floor(y)) * n, (z - math.floor(z)) * n
                a, b, c = int(x), int(y), int(z)
                x, y, z = x - a, y - b, z - c
                a, b, c = a % n, b % n, c % n
                d, e, f = (a + 1) % n, (b + 1) % n, (c + 1) % n
                low = (table[a, b, c] * (1 - z) + table[a, b, f] * z) * (1 - y) + (
                    table[a, e, c] * (1 - z) + table[a, e, f] * z
                ) * y
                high = (table[d, b, c] * (1 - z) + table[d, b, f] * z) * (1 - y) + (
                    table[d, e, c] * (1 - z) + table[d, e, f] * z
                ) * y
                value = min(sign * (low * (1 - x) + high * x) * period - half, deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_bars(depth, least, edges, turn, start, period, sign, half, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance from round bars that repeat, in cells.

    Parameters
    ----------
    edges : (E, 2, 3) float64
        The axes of the bars that may be the nearest in one period, in periods.
    depth, least, turn, start, period, sign, half, out, thread, threads
        As in `from_period`.
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
                x = (start[0] + turn[0, 0] * i + turn[0, 1] * j + turn[0, 2] * k) / period
                y = (start[1] + turn[1, 0] * i + turn[1, 1] * j + turn[1, 2] * k) / period
                z = (start[2] + turn[2, 0] * i + turn[2, 1] * j + turn[2, 2] * k) / period
                x, y, z = x - math.floor(x), y - math.floor(y), z - math.floor(z)
                nearest = np.inf
                for e in range(len(edges)):
                    ux, uy, uz = (
                        edges[e, 1, 0] - edges[e, 0, 0],
                        edges[e, 1, 1] - edges[e, 0, 1],
                        edges[e, 1, 2] - edges[e, 0, 2],
                    )
                    vx, vy, vz = x - edges[e, 0, 0], y - edges[e, 0, 1], z - edges[e, 0, 2]
                    along = (ux * vx + uy * vy + uz * vz) / (ux * ux + uy * uy + uz * uz)
                    along = min(1.0, max(0.0, along))
                    vx, vy, vz = vx - along * ux, vy - along * uy, vz - along * uz
                    nearest = min(nearest, vx * vx + vy * vy + vz * vz)
                value = min(sign * (math.sqrt(nearest) * period - half), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_plane(depth, plane, out, thread, threads):
    """Fill `out` with the lesser of the depth and a distance that is the same at every height, in cells.

    Parameters
    ----------
    depth, out : (nx, ny, nz) float32
    plane : (nx, ny) float32
    thread, threads : int
        This call fills every `threads`-th layer, and returns how many cells the void fills.
    """
    nx, ny, nz = depth.shape
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            here = plane[i, j]
            for k in range(nz):
                value = min(here, depth[i, j, k])
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def lower_to_segments(segments, reach, squared) -> None:
    """Lower the squared distance of each point of a plane within `reach` of a segment to that of the nearest one.

    Parameters
    ----------
    segments : (S, 2, 2) float64
        In cells; point (0, 0) of the grid is the origin.
    reach : float
    squared : (nx, ny) float32
    """
    nx, ny = squared.shape
    for s in range(len(segments)):
        ax, ay, bx, by = segments[s, 0, 0], segments[s, 0, 1], segments[s, 1, 0], segments[s, 1, 1]
        ux, uy = bx - ax, by - ay
        long = max(ux * ux + uy * uy, 1e-300)
        for i in range(max(0, math.ceil(min(ax, bx) - reach)), min(nx, math.floor(max(ax, bx) + reach) + 1)):
            for j in range(max(0, math.ceil(min(ay, by) - reach)), min(ny, math.floor(max(ay, by) + reach) + 1)):
                vx, vy = i - ax, j - ay
                along = min(1.0, max(0.0, (ux * vx + uy * vy) / long))
                vx, vy = vx - along * ux, vy - along * uy
                squared[i, j] = min(squared[i, j], np.float32(vx * vx + vy * vy))
