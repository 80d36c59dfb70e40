"""Distances to a pattern at the centres of cells: from a table of one period, planes, polyhedra, bars, lines."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy", inline="always")
def interpolate_ratio(ratio, step, i, j, k):
    """Interpolate the number at a cell linearly, from nodes that are `step` cells apart.

    Parameters
    ----------
    ratio : (n, m, l) float32
        A single node holds for all cells.
    """
    n, m, l = ratio.shape  # noqa: E741
    if n == 1 and m == 1 and l == 1:
        return ratio[0, 0, 0]
    x, y, z = i / step, j / step, k / step
    a, b, c = min(int(x), n - 1), min(int(y), m - 1), min(int(z), l - 1)
    d, e, f = min(a + 1, n - 1), min(b + 1, m - 1), min(c + 1, l - 1)
    x, y, z = min(x - a, 1.0), min(y - b, 1.0), min(z - c, 1.0)
    low = (ratio[a, b, c] * (1 - z) + ratio[a, b, f] * z) * (1 - y) + (
        ratio[a, e, c] * (1 - z) + ratio[a, e, f] * z
    ) * y
    high = (ratio[d, b, c] * (1 - z) + ratio[d, b, f] * z) * (1 - y) + (
        ratio[d, e, c] * (1 - z) + ratio[d, e, f] * z
    ) * y
    return low * (1 - x) + high * x


@njit(nogil=True, cache=True, error_model="numpy")
def from_period(depth, threshold, table, turn, start, period, sign, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into the void beside a periodic surface, in cells.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        Cells below the wall. A depth of at most `threshold` is copied.
    threshold : float
    table : (n, n, n) float32
        Distances from the surface in one period, in periods; the nodes are at i / n.
    turn : (3, 3) float64
        From the part to the pattern.
    start : (3,) float64
        Of cell (0, 0, 0), in the pattern, in cells.
    period : float
        Of one period, in cells.
    sign : float
        1 for the side where the table is above 0, -1 for the other.
    half : float
        Of the width of the walls, in cells.
    ratio, step
        Ratio of the local width of the walls to that one: see `interpolate_ratio`.
    out : (nx, ny, nz) float32
    thread, threads : int
        This call fills every `threads`-th layer, and returns the volume of its void, in cells.
    """
    nx, ny, nz = depth.shape
    n = len(table)
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= threshold:
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
                value = min(
                    sign * (low * (1 - x) + high * x) * period - half * interpolate_ratio(ratio, step, i, j, k), deep
                )
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_bars(depth, threshold, edges, bar_start, which, turn, start, period, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of depth and distance outside the bars; return the volume of this void, in cells.

    Parameters
    ----------
    edges : (E, 2, 3) float64
        Axes of the bars that may be the nearest in one period, in periods.
    bar_start : (n³ + 1,) int32
    which : (M,) int32
        The bars that may be the nearest in each of n³ equal cubes: those of cube c are which[first[c]:first[c + 1]].
    depth, threshold, turn, start, period, half, ratio, step, out, thread, threads
        As in `from_period`.
    """
    nx, ny, nz = depth.shape
    n = round((len(bar_start) - 1) ** (1 / 3))
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= threshold:
                    out[i, j, k] = deep
                    continue
                x = (start[0] + turn[0, 0] * i + turn[0, 1] * j + turn[0, 2] * k) / period
                y = (start[1] + turn[1, 0] * i + turn[1, 1] * j + turn[1, 2] * k) / period
                z = (start[2] + turn[2, 0] * i + turn[2, 1] * j + turn[2, 2] * k) / period
                x, y, z = x - math.floor(x), y - math.floor(y), z - math.floor(z)
                cube = (min(int(x * n), n - 1) * n + min(int(y * n), n - 1)) * n + min(int(z * n), n - 1)
                nearest = np.inf
                for at in range(bar_start[cube], bar_start[cube + 1]):
                    e = which[at]
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
                value = min(math.sqrt(nearest) * period - half * interpolate_ratio(ratio, step, i, j, k), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_planes(depth, threshold, slopes, start, apart, bits, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into every other slab between planes, in cells.

    Parameters
    ----------
    slopes : (F, 3) float64
        Planes of each family crossed in a step of one cell along x, y and z.
    start : (F,) float64
        Planes of each family before cell (0, 0, 0).
    apart : (F,) float64
        Distance between the planes of a family, in cells.
    bits : int
        Bit f selects the slabs of family f: 0 those between planes 0 and 1, 2 and 3, and so on.
    depth, threshold, half, ratio, step, out, thread, threads
        As in `from_period`.
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
                nearest = np.inf
                for f in range(len(apart)):
                    at = start[f] + slopes[f, 0] * i + slopes[f, 1] * j + slopes[f, 2] * k
                    slab = math.floor(at)
                    to_plane = at - slab
                    to_plane = min(to_plane, 1.0 - to_plane) * apart[f]
                    if (int(slab) ^ (bits >> f)) & 1:
                        to_plane = -to_plane
                    nearest = min(nearest, to_plane)
                value = min(nearest - half * interpolate_ratio(ratio, step, i, j, k), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_polyhedra(
    depth, threshold, turn, start, normals, halves, period, middles, half, ratio, step, out, thread, threads
):
    """Fill `out` with the lesser of depth and distance into polyhedra; return the volume of this void, in cells.

    Parameters
    ----------
    turn : (3, 3) float64
        From the part to the pattern.
    start : (3,) float64
        Of cell (0, 0, 0), in the pattern, in cells.
    normals, halves : (F, 3), (F,) float64
        Of the faces in pairs, and their distance from the middle, in cells.
    period : (3,) float64
        In cells.
    middles : (K, 3) float64
        In cells; each repeats.
    depth, threshold, half, ratio, step, out, thread, threads
        As in `from_period`.
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
                x = start[0] + turn[0, 0] * i + turn[0, 1] * j + turn[0, 2] * k
                y = start[1] + turn[1, 0] * i + turn[1, 1] * j + turn[1, 2] * k
                z = start[2] + turn[2, 0] * i + turn[2, 1] * j + turn[2, 2] * k
                inside = -np.inf
                for m in range(len(middles)):
                    a, b, c = x - middles[m, 0], y - middles[m, 1], z - middles[m, 2]
                    a -= period[0] * math.floor(a / period[0] + 0.5)
                    b -= period[1] * math.floor(b / period[1] + 0.5)
                    c -= period[2] * math.floor(c / period[2] + 0.5)
                    nearest = np.inf
                    for f in range(len(halves)):
                        to_face = halves[f] - abs(normals[f, 0] * a + normals[f, 1] * b + normals[f, 2] * c)
                        nearest = min(nearest, to_face)
                    inside = max(inside, nearest)
                value = min(inside - half * interpolate_ratio(ratio, step, i, j, k), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled


@njit(nogil=True, cache=True, error_model="numpy")
def from_plane(depth, plane, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and a distance that does not depend on height, in cells.

    Parameters
    ----------
    depth, out : (nx, ny, nz) float32
    plane : (nx, ny) float32
        From the lines.
    half, ratio, step
        As in `from_period`.
    thread, threads : int
        This call fills every `threads`-th layer, and returns the volume of its void, in cells.
    """
    nx, ny, nz = depth.shape
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            to_lines = plane[i, j]
            for k in range(nz):
                value = min(to_lines - half * interpolate_ratio(ratio, step, i, j, k), depth[i, j, k])
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


@njit(nogil=True, cache=True, error_model="numpy", inline="always")
def colour_of_cube(level, a, b, c):
    """Return the number, 0 to 15, of the colour of cube (a, b, c) of a level: cubes of one colour do not touch.

    Those of a level do not, since all their numbers have the same parity; nor do those of two levels, if cubes that
    touch differ by at most one level.
    """
    return (level & 1) << 3 | ((a >> level) & 1) << 2 | ((b >> level) & 1) << 1 | (c >> level) & 1


@njit(nogil=True, cache=True, error_model="numpy")
def colours_of_cubes(depth, doubled, turn, start, thread, threads):
    """Find the colours of the cubes that hold the centre of a cell below the wall, (16,) bool.

    Parameters
    ----------
    depth, doubled, turn, start, thread, threads
        As in `from_cubes`.
    """
    nx, ny, nz = depth.shape
    seen = np.zeros(16, dtype=np.bool_)
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                if depth[i, j, k] > 0:
                    a = math.floor(start[0] + turn[0, 0] * i + turn[0, 1] * j + turn[0, 2] * k)
                    b = math.floor(start[1] + turn[1, 0] * i + turn[1, 1] * j + turn[1, 2] * k)
                    c = math.floor(start[2] + turn[2, 0] * i + turn[2, 1] * j + turn[2, 2] * k)
                    seen[colour_of_cube(doubled[a, b, c], a, b, c)] = True
    return seen


@njit(nogil=True, cache=True, error_model="numpy")
def from_cubes(depth, threshold, doubled, turn, start, period, reach, colour, half, ratio, step, out, thread, threads):
    """Fill `out` with the lesser of the depth and the distance into the cubes of a colour, in cells.

    The cubes are of several sizes, and fill space. Outside them, the distance is the largest of those along the
    three axes, up to `reach`.

    Parameters
    ----------
    doubled : (n, m, l) uint8
        Number of doublings of the cube around each of the smallest ones, to one of these beyond the grid; a cube
        lies at a multiple of its side.
    turn : (3, 3) float64
        From the part to the pattern, in the smallest cubes for each cell.
    start : (3,) float64
        Of cell (0, 0, 0), in the pattern, in the smallest cubes.
    period : float
        Side of the smallest cubes, in cells.
    reach : float
        In the smallest cubes; at most half of the side of any.
    colour : int
        See `colour_of_cube`.
    depth, threshold, half, ratio, step, out, thread, threads
        As in `from_period`.
    """
    nx, ny, nz = depth.shape
    at, low, high = np.empty(3), np.empty(3, dtype=np.int64), np.empty(3, dtype=np.int64)
    filled = 0.0
    for i in range(thread, nx, threads):
        for j in range(ny):
            for k in range(nz):
                deep = depth[i, j, k]
                if deep <= threshold:
                    out[i, j, k] = deep
                    continue
                for axis in range(3):
                    at[axis] = start[axis] + turn[axis, 0] * i + turn[axis, 1] * j + turn[axis, 2] * k
                    low[axis] = math.floor(at[axis])
                level = doubled[low[0], low[1], low[2]]
                side = 1 << level
                inside = np.inf
                for axis in range(3):
                    from_side = at[axis] - ((low[axis] >> level) << level)
                    inside = min(inside, from_side, side - from_side)
                if colour_of_cube(level, low[0], low[1], low[2]) != colour:
                    outside = reach
                    if inside < reach:
                        # At most two of the smallest cubes within reach follow one another along an axis.
                        for axis in range(3):
                            low[axis], high[axis] = math.floor(at[axis] - reach), math.floor(at[axis] + reach)
                        for a in range(low[0], high[0] + 1):
                            for b in range(low[1], high[1] + 1):
                                for c in range(low[2], high[2] + 1):
                                    level = doubled[a, b, c]
                                    if colour_of_cube(level, a, b, c) == colour:
                                        side = 1 << level
                                        x = at[0] - ((a >> level) << level)
                                        y = at[1] - ((b >> level) << level)
                                        z = at[2] - ((c >> level) << level)
                                        outside = min(outside, max(-x, x - side, -y, y - side, -z, z - side, 0.0))
                    inside = -outside
                value = min(inside * period - half * interpolate_ratio(ratio, step, i, j, k), deep)
                out[i, j, k] = value
                filled += min(1.0, max(0.0, 0.5 + value))
    return filled
