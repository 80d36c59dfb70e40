"""Quadrics: distance of a point from many planes at once, and the point where it is smallest.

A quadric holds the sum of planes n x + d = 0 with weights w, for squared distances (Garland and Heckbert 1997): w nn
(xx, xy, xz, yy, yz, zz), w d n (three), w d d, and w itself.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.rows import copy_row

NARROW = 1e-6  # of squared lengths: a ring whose faces cancel out has no side on which volume is gained
PULL = 1e-5  # of the trace of a quadric: pull towards a point, where planes leave the place undetermined


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def squared_length(a, b):
    """Return the squared distance of two points."""
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def normal_and_shape(a, b, c):
    """Return the normal of a triangle, twice its area long, and its shape: 1 for equal sides, 0 for a line."""
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    sides = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz
    sides += (ux - vx) ** 2 + (uy - vy) ** 2 + (uz - vz) ** 2
    twice = math.sqrt(nx * nx + ny * ny + nz * nz)
    return nx, ny, nz, (2 * math.sqrt(3.0) * twice / sides if sides > 0 else 0.0)


@njit(nogil=True, cache=True, error_model="numpy")
def add_planes(vertices, start, quadric):
    """Add to the quadric of each vertex the planes of its faces, weighed by a third of their areas.

    Parameters
    ----------
    vertices : (V, 3) float64
    start : (3 F,) int32
    quadric : (V, 11) float64
        For a sum of planes n x + d = 0 with weights w: w nn (xx, xy, xz, yy, yz, zz), w d n, w d d, and w.
    """
    for f in range(len(start) // 3):
        a, b, c = vertices[start[3 * f]], vertices[start[3 * f + 1]], vertices[start[3 * f + 2]]
        nx, ny, nz, _ = normal_and_shape(a, b, c)
        twice = math.sqrt(nx * nx + ny * ny + nz * nz)
        if twice == 0:
            continue
        nx, ny, nz, w = nx / twice, ny / twice, nz / twice, twice / 6
        d = -(nx * a[0] + ny * a[1] + nz * a[2])
        for k in range(3):
            q = quadric[start[3 * f + k]]
            q[0] += w * nx * nx
            q[1] += w * nx * ny
            q[2] += w * nx * nz
            q[3] += w * ny * ny
            q[4] += w * ny * nz
            q[5] += w * nz * nz
            q[6] += w * d * nx
            q[7] += w * d * ny
            q[8] += w * d * nz
            q[9] += w * d * d
            q[10] += w


@njit(nogil=True, cache=True, error_model="numpy")
def evaluate_quadric(q, x, y, z):
    """Return the weighted sum of squared distances from the planes of a quadric, never below zero."""
    value = q[0] * x * x + q[3] * y * y + q[5] * z * z + 2 * (q[1] * x * y + q[2] * x * z + q[4] * y * z)
    return max(0.0, value + 2 * (q[6] * x + q[7] * y + q[8] * z) + q[9])


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def solve_quadric(s, mx, my, mz, rx, ry, rz):
    """Solve (A + pull) p = r, with A the matrix of a quadric; return the solution, and True if there is one.

    With r = pull m - b the solution is the minimum of the quadric, drawn a little towards m: on a plane or along a
    crease, the point of it nearest to m.
    """
    pull = PULL * (s[0] + s[3] + s[5])
    a, b, c, d, e, f = s[0] + pull, s[1], s[2], s[3] + pull, s[4], s[5] + pull
    xx, xy, xz = d * f - e * e, c * e - b * f, b * e - c * d
    determinant = a * xx + b * xy + c * xz
    if not determinant > 0:
        return 0.0, 0.0, 0.0, False
    yy, yz, zz = a * f - c * c, b * c - a * e, a * d - b * b
    rx, ry, rz = rx + pull * mx, ry + pull * my, rz + pull * mz
    x = (xx * rx + xy * ry + xz * rz) / determinant
    y = (xy * rx + yy * ry + yz * rz) / determinant
    z = (xz * rx + yz * ry + zz * rz) / determinant
    return x, y, z, True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def move_into_plane(s, gx, gy, gz, off, farthest, place):
    """Move a place along the valley of a quadric until it has moved by `off` along (gx, gy, gz), times its length.

    Where the quadric has no valley, or the place would move further than `farthest`, a squared length, it stays.
    """
    dx, dy, dz, is_solved = solve_quadric(s, 0.0, 0.0, 0.0, gx, gy, gz)
    if not is_solved:
        return
    rise = gx * dx + gy * dy + gz * dz
    if not rise > 0 or gx * gx + gy * gy + gz * gz < NARROW * farthest * farthest:
        return
    by = off / rise
    if by * by * (dx * dx + dy * dy + dz * dz) <= farthest:
        place[0], place[1], place[2] = place[0] + by * dx, place[1] + by * dy, place[2] + by * dz


@njit(nogil=True, cache=True, error_model="numpy")
def best_place(u, v, p, q, s, place):
    """Set `place` to the minimum of quadrics p + q near edge u-v, and `s` to their sum; return its value there.

    Where the planes do not determine a point, or one further away than the edge is long, the best of both ends and the
    middle is used. `s` is set to the sum.
    """
    for k in range(11):
        s[k] = p[k] + q[k]
    mx, my, mz = (u[0] + v[0]) / 2, (u[1] + v[1]) / 2, (u[2] + v[2]) / 2
    x, y, z, is_solved = solve_quadric(s, mx, my, mz, -s[6], -s[7], -s[8])
    if is_solved and (x - mx) ** 2 + (y - my) ** 2 + (z - mz) ** 2 <= squared_length(u, v):
        place[0], place[1], place[2] = x, y, z
        return evaluate_quadric(s, x, y, z)
    place[0], place[1], place[2] = mx, my, mz
    best = evaluate_quadric(s, mx, my, mz)
    for end in range(2):
        w = u if end == 0 else v
        value = evaluate_quadric(s, w[0], w[1], w[2])
        if value < best:
            best = value
            copy_row(place, w)
    return best
