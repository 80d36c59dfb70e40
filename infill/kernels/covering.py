"""Points on the triangles of a mesh at which to see how far another mesh lies, dense only where that may be far.

A piece of a triangle whose corners are near one and the same triangle is near it everywhere, since the distance from a
triangle is convex. All other pieces are cut in two, down to a size.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.distances import DEEPEST, nearest_triangle, squared_distance
from infill.kernels.quadrics import squared_length

DEPTH = 18  # times that a triangle is cut in two, at most
# How long a piece that is hardly near may be, over the distance by which its corners are nearer than they have to be.
# At the square root of three, no place on it could be too far away, even if the meshes met at a right angle.
SLOPE = 10.0
LEVEL = 0.866  # cosine of the angle, 30 degrees, up to which triangles near one another count as level


@njit(nogil=True, cache=True, error_model="numpy")
def _covered(piece, owners, away, corners, near):
    """Return whether the corners of a piece are all near one and the same of the triangles that they are nearest to."""
    if away[0] > near or away[1] > near or away[2] > near:
        return False
    for k in range(3):
        at, all_near = owners[k], True
        for j in range(3):
            if all_near and owners[j] != at:
                a, b, c = corners[at, 0], corners[at, 1], corners[at, 2]
                all_near = squared_distance(piece[j, 0], piece[j, 1], piece[j, 2], a, b, c) <= near
        if all_near:
            return True
    return False


@njit(nogil=True, cache=True, error_model="numpy")
def cover(
    vertices,
    faces,
    nearest,
    squared,
    corners,
    low,
    high,
    leaf,
    near,
    enough,
    coarse,
    fine,
    least,
    begin,
    points,
    face,
    owner,
    away,
    thread,
    threads,
):
    """Set points on every `threads`-th triangle, and what they are nearest to; return how many fit.

    Parameters
    ----------
    vertices, faces : (V, 3) float64, (F, 3) int
    nearest, squared : (V,) int64, (V,) float64
        The triangle of the other mesh that each vertex is nearest to, and its squared distance.
    corners, low, high, leaf
        The other mesh: see `infill.kernels.distances.nearest_triangles`.
    near, enough : float
        Squared distances: of what is near, and of what is so near that it does not matter how near.
    coarse, fine : float
        Lengths to which pieces are cut: all of them, and those of which a corner is hardly near any more.
    least : float
        Only points further away than this, a squared distance, are kept.
    begin : (threads,) int64
        The first face of each thread; becomes the first one whose points did not fit, or how many faces there are.
    points, face, owner, away : (threads, P, 3) float64, (threads, P) int32, (threads, P) int64, (threads, P) float64
        What is found: the face that each point lies on, the triangle of the other mesh that it is nearest to, or any
        within `enough`, and the squared distance from that.
    """
    stack, waiting = np.empty(DEEPEST, dtype=np.int64), np.empty(DEEPEST)
    room = DEPTH + 2
    pieces, owners, offs = np.empty((room, 3, 3)), np.empty((room, 3), dtype=np.int64), np.empty((room, 3))
    depths = np.empty(room, dtype=np.int64)
    piece, ends, off = np.empty((4, 3)), np.empty(4, dtype=np.int64), np.empty(4)
    count = 0
    for f in range(begin[thread], len(faces), threads):
        before = count
        for k in range(3):
            v = faces[f, k]
            pieces[0, k] = vertices[v]
            owners[0, k], offs[0, k] = nearest[v], squared[v]
        depths[0], left = 0, 1
        while left > 0:
            left -= 1
            depth = depths[left]
            piece[:3], ends[:3], off[:3] = pieces[left], owners[left], offs[left]
            if depth == DEPTH or _covered(piece, ends, off, corners, near):
                continue
            k, longest = 0, 0.0
            for side in range(3):
                found = squared_length(piece[side], piece[(side + 1) % 3])
                if found > longest:
                    k, longest = side, found
            limit, farthest = coarse, max(off[0], off[1], off[2])
            if farthest > enough:
                limit = min(coarse, max(fine, SLOPE * (math.sqrt(near) - math.sqrt(farthest))))
            if longest <= limit * limit:
                continue
            j = (k + 1) % 3
            for axis in range(3):
                piece[3, axis] = (piece[k, axis] + piece[j, axis]) / 2
            x, y, z = piece[3, 0], piece[3, 1], piece[3, 2]
            off[3], ends[3] = nearest_triangle(x, y, z, ends[k], corners, low, high, leaf, enough, stack, waiting)
            if off[3] > least:
                if count == points.shape[1]:
                    begin[thread] = f
                    return before
                points[thread, count], face[thread, count] = piece[3], f
                owner[thread, count], away[thread, count] = ends[3], off[3]
                count += 1
            for half in range(2):  # the middle of the longest side takes the place of one of its ends
                for corner in range(3):
                    at = 3 if corner == (j if half == 0 else k) else corner
                    pieces[left, corner] = piece[at]
                    owners[left, corner], offs[left, corner] = ends[at], off[at]
                depths[left] = depth + 1
                left += 1
    begin[thread] = len(faces)
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def _parted(one, other, normal, reach):
    """Return whether a triangle lies `reach` beyond the plane of another, or beyond one upright on a side of it.

    Parameters
    ----------
    one, other : (3, 3) float64
    normal : (3,) float64
        Of `one`, of length 1.
    """
    a = one[0]
    lowest, highest = math.inf, -math.inf
    for k in range(3):
        p = other[k]
        height = (p[0] - a[0]) * normal[0] + (p[1] - a[1]) * normal[1] + (p[2] - a[2]) * normal[2]
        lowest, highest = min(lowest, height), max(highest, height)
    if lowest >= reach or highest <= -reach:
        return True
    for side in range(3):
        a, b = one[side], one[(side + 1) % 3]
        ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        ox, oy, oz = uy * normal[2] - uz * normal[1], uz * normal[0] - ux * normal[2], ux * normal[1] - uy * normal[0]
        length = math.sqrt(ox * ox + oy * oy + oz * oz)
        nearest = math.inf
        for k in range(3):
            p = other[k]
            nearest = min(nearest, (p[0] - a[0]) * ox + (p[1] - a[1]) * oy + (p[2] - a[2]) * oz)
        if nearest >= reach * length:
            return True
    return False


@njit(nogil=True, cache=True, error_model="numpy")
def level_around(corners, normals, low, high, leaf, reach, level, thread, threads):
    """Set whether all triangles within `reach` of every `threads`-th triangle face nearly where it faces.

    Parameters
    ----------
    corners, low, high, leaf
        A mesh: see `infill.kernels.distances.nearest_triangles`.
    normals : (F, 3) float64
        Of length 1, or of length 0 where a triangle has no area: such a triangle is never level, nor what is near it.
    reach : float
        What is seen to be further away, on planes of either triangle, does not count; what is not, does.
    level : (F,) bool
        What is found.
    """
    first = (len(low) - 1) // 2
    stack = np.empty(DEEPEST, dtype=np.int64)
    for f in range(thread, len(corners), threads):
        one, normal = corners[f], normals[f]
        level[f] = True
        stack[0], count = 0, 1
        while count > 0 and level[f]:
            count -= 1
            box, near = stack[count], True
            for axis in range(3):
                least = min(one[0, axis], one[1, axis], one[2, axis]) - reach
                most = max(one[0, axis], one[1, axis], one[2, axis]) + reach
                near = near and low[box, axis] <= most and high[box, axis] >= least
            if not near:
                continue
            if box < first:
                stack[count], stack[count + 1], count = 2 * box + 1, 2 * box + 2, count + 2
                continue
            begin = (box - first) * leaf
            for at in range(begin, min(begin + leaf, len(corners))):
                to = normals[at]
                if normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2] >= LEVEL:
                    continue
                if _parted(one, corners[at], normal, reach) or _parted(corners[at], one, to, reach):
                    continue
                level[f] = False
                break
