"""Triangles of a mesh that pass through each other: an edge of one crosses the interior of another."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.distances import STACK_SIZE
from infill.kernels.rows import copy_row

ROUNDING = 1e-9  # of lengths and areas: places nearer to a plane or an edge than this touch it


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _turn(p, q, x, y, z, normal):
    """Return how far a place lies to the left of the line from p to q, times its length and that of the normal."""
    ex, ey, ez = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    px, py, pz = x - p[0], y - p[1], z - p[2]
    return (ey * pz - ez * py) * normal[0] + (ez * px - ex * pz) * normal[1] + (ex * py - ey * px) * normal[2]


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def does_edge_pierce(triangle, target, normal, side):
    """Return True if an edge of a triangle (3, 3) crosses the interior of another; `normal`, `side` are work space."""
    a, b, c = target[0], target[1], target[2]
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    normal[0], normal[1], normal[2] = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    size, farthest = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2), 0.0
    for k in range(3):
        x, y, z = triangle[k, 0] - a[0], triangle[k, 1] - a[1], triangle[k, 2] - a[2]
        farthest = max(farthest, abs(x), abs(y), abs(z))
        side[k] = x * normal[0] + y * normal[1] + z * normal[2]
    scale = ROUNDING * farthest * size
    for k in range(3):
        if abs(side[k]) <= scale:
            side[k] = 0.0
    for k in range(3):
        j = (k + 1) % 3
        if not side[k] * side[j] < 0:
            continue
        share = side[k] / (side[k] - side[j])
        x = triangle[k, 0] + share * (triangle[j, 0] - triangle[k, 0])
        y = triangle[k, 1] + share * (triangle[j, 1] - triangle[k, 1])
        z = triangle[k, 2] + share * (triangle[j, 2] - triangle[k, 2])
        limit = scale * size
        if not _turn(a, b, x, y, z, normal) > limit or not _turn(b, c, x, y, z, normal) > limit:
            continue
        if _turn(c, a, x, y, z, normal) > limit:
            return True
    return False


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def share_vertex(faces, f, g):
    """Return True if two faces share a vertex."""
    shared = False
    for k in range(3):
        v = faces[f, k]
        shared = shared or v == faces[g, 0] or v == faces[g, 1] or v == faces[g, 2]
    return shared


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_outside(triangle, lower, upper):
    """Return True if all corners of a triangle lie beyond the same side of a box."""
    for axis in range(3):
        a, b, c = triangle[0, axis], triangle[1, axis], triangle[2, axis]
        if (a > upper[axis] and b > upper[axis] and c > upper[axis]) or (
            a < lower[axis] and b < lower[axis] and c < lower[axis]
        ):
            return True
    return False


@njit(nogil=True, cache=True, error_model="numpy")
def crossing_pairs(corners, faces, low, high, leaf, pairs, thread, threads):
    """List the pairs of every `threads`-th triangle with later ones through which it passes; return their number.

    Parameters
    ----------
    corners, low, high, leaf
        A mesh: see `infill.kernels.distances.nearest_triangles`.
    faces : (F, 3) int
        The vertices of these triangles: those that share one do not count.
    pairs : (threads, P, 2) int64
        The results of each thread, as far as there is room; others are only counted.
    """
    stack, normal, side = np.empty(STACK_SIZE, dtype=np.int64), np.empty(3), np.empty(3)
    lower, upper = np.empty(3), np.empty(3)
    first_leaf, count = (len(low) - 1) // 2, 0
    for f in range(thread, len(corners), threads):
        copy_row(lower, corners[f, 0])
        copy_row(upper, corners[f, 0])
        for k in range(1, 3):
            for axis in range(3):
                lower[axis], upper[axis] = min(lower[axis], corners[f, k, axis]), max(upper[axis], corners[f, k, axis])
        stack[0], height = 0, 1
        while height > 0:
            height -= 1
            box, meets = stack[height], True
            for axis in range(3):
                meets = meets and low[box, axis] <= upper[axis] and high[box, axis] >= lower[axis]
            if not meets:
                continue
            if box < first_leaf:
                stack[height], stack[height + 1], height = 2 * box + 1, 2 * box + 2, height + 2
                continue
            begin = (box - first_leaf) * leaf
            for g in range(max(begin, f + 1), min(begin + leaf, len(corners))):
                if _is_outside(corners[g], lower, upper) or share_vertex(faces, f, g):
                    continue
                if not (
                    does_edge_pierce(corners[f], corners[g], normal, side)
                    or does_edge_pierce(corners[g], corners[f], normal, side)
                ):
                    continue
                if count < pairs.shape[1]:
                    pairs[thread, count, 0], pairs[thread, count, 1] = f, g
                count += 1
    return count
