"""Points on the triangles of a mesh to measure its distance from another mesh, dense only where that may be far.

A piece of a triangle whose corners are all near the same triangle is near it everywhere, since the distance from a
triangle is convex; so is a piece that two triangles share. All other pieces are cut in two, down to a size.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.distances import STACK_SIZE, nearest_triangle, squared_distance
from infill.kernels.quadrics import normal_and_shape, squared_length
from infill.kernels.rows import copy_row

MAX_CUTS = 18  # largest number of cuts of a triangle
# Ratio of the length of a piece that is barely near to the distance by which its corners are nearer than necessary.
# At the square root of three, every place on it is near enough, even if the meshes meet at a right angle.
SLOPE = 10.0
SLENDER = 0.02  # shape of a triangle whose normal says nothing of its neighbours
FOLD = 0.5  # of a length: twice the share by which a piece may leave two planes that meet below it
PIECE_COSINE = 0.995  # the same for a piece of a triangle, of which no edge is sampled: 6 degrees
HALVINGS = 4  # of a side of a piece, to find the place on it where the nearest triangle changes
ALIGNED_COSINE = 0.866  # cosine of the angle, 30 degrees, up to which neighbouring triangles count as aligned


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_covered_by_one(piece, owners, corners, squared_tolerance):
    """Return True if all corners of a piece are near the same triangle, one of their nearest triangles."""
    for k in range(3):
        at, all_near = owners[k], True
        for j in range(3):
            if all_near and owners[j] != at:
                a, b, c = corners[at, 0], corners[at, 1], corners[at, 2]
                all_near = squared_distance(piece[j, 0], piece[j, 1], piece[j, 2], a, b, c) <= squared_tolerance
        if all_near:
            return True
    return False


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_near(x, y, z, at, corners, squared_tolerance):
    """Return True if a place lies within a tolerance, given squared, of triangle `at`."""
    return squared_distance(x, y, z, corners[at, 0], corners[at, 1], corners[at, 2]) <= squared_tolerance


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_side_shared(p, q, near_p, near_q, corners, squared_tolerance):
    """Return True if a place between p and q is near both a triangle that p is near and one that q is near."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        share = (low + high) / 2
        x, y, z = p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])
        is_near_p = _is_near(x, y, z, near_p, corners, squared_tolerance)
        if is_near_p == _is_near(x, y, z, near_q, corners, squared_tolerance):
            return is_near_p
        if is_near_p:
            low = share
        else:
            high = share
    return False


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_covered_by_two(piece, owners, corners, squared_tolerance):
    """Return True if one of their nearest triangles is near two corners of a piece, and another the rest of it.

    A place on either side to the third corner is near both triangles: these places part the piece into a quadrangle
    and a triangle, each with all corners near the same triangle.
    """
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        at, beyond = owners[i], owners[k]
        if at == beyond:
            continue
        if owners[j] != at and not _is_near(piece[j, 0], piece[j, 1], piece[j, 2], at, corners, squared_tolerance):
            continue
        if not _is_side_shared(piece[i], piece[k], at, beyond, corners, squared_tolerance):
            continue
        if _is_side_shared(piece[j], piece[k], at, beyond, corners, squared_tolerance):
            return True
    return False


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_covered(piece, owners, squared, corners, squared_tolerance):
    """Return True if all of a piece is near one or two of the triangles nearest to its corners."""
    if squared[0] > squared_tolerance or squared[1] > squared_tolerance or squared[2] > squared_tolerance:
        return False
    one = _is_covered_by_one(piece, owners, corners, squared_tolerance)
    return one or _is_covered_by_two(piece, owners, corners, squared_tolerance)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_over_a_fold(owners, farthest, corners, squared_tolerance, squared_length):
    """Return True if the nearest triangles of a piece's corners fold so little that all of the piece is near them.

    Between its corners, a piece of a length moves away from two planes by at most a quarter of it, times the sine of
    the angle between them: where the planes meet in the middle.
    """
    room = math.sqrt(squared_tolerance) - math.sqrt(farthest)
    if room <= 0:
        return False
    least, normals = 1.0, np.empty((3, 3))
    for k in range(3):
        triangle = corners[owners[k]]
        nx, ny, nz, shape = normal_and_shape(triangle[0], triangle[1], triangle[2])
        if shape < SLENDER:
            return False
        twice = math.sqrt(nx * nx + ny * ny + nz * nz)
        normals[k, 0], normals[k, 1], normals[k, 2] = nx / twice, ny / twice, nz / twice
    for k in range(3):
        j = (k + 1) % 3
        cosine = normals[k, 0] * normals[j, 0] + normals[k, 1] * normals[j, 1] + normals[k, 2] * normals[j, 2]
        least = min(least, cosine)
    return least >= ALIGNED_COSINE and FOLD * math.sqrt(squared_length) * math.sqrt(max(0.0, 1 - least * least)) <= room


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _are_separated(triangle, second_triangle, normal, reach):
    """Return True if a triangle lies `reach` beyond the plane of another, or beyond a plane upright on a side of it.

    Parameters
    ----------
    triangle, second_triangle : (3, 3) float64
    normal : (3,) float64
        Of `triangle`, of length 1.
    """
    a = triangle[0]
    lowest, highest = math.inf, -math.inf
    for k in range(3):
        p = second_triangle[k]
        height = (p[0] - a[0]) * normal[0] + (p[1] - a[1]) * normal[1] + (p[2] - a[2]) * normal[2]
        lowest, highest = min(lowest, height), max(highest, height)
    if lowest >= reach or highest <= -reach:
        return True
    for side in range(3):
        a, b = triangle[side], triangle[(side + 1) % 3]
        ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        ox, oy, oz = uy * normal[2] - uz * normal[1], uz * normal[0] - ux * normal[2], ux * normal[1] - uy * normal[0]
        length = math.sqrt(ox * ox + oy * oy + oz * oz)
        nearest = math.inf
        for k in range(3):
            p = second_triangle[k]
            nearest = min(nearest, (p[0] - a[0]) * ox + (p[1] - a[1]) * oy + (p[2] - a[2]) * oz)
        if nearest >= reach * length:
            return True
    return False


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_aligned(triangle, normal, corners, normals, low, high, leaf, reach, cosine, stack):
    """Return True if all triangles of a mesh within `reach` of a triangle face the same way, up to a cosine."""
    first_leaf = (len(low) - 1) // 2
    stack[0], count = 0, 1
    while count > 0:
        count -= 1
        box, overlaps = stack[count], True
        for axis in range(3):
            lower = min(triangle[0, axis], triangle[1, axis], triangle[2, axis]) - reach
            upper = max(triangle[0, axis], triangle[1, axis], triangle[2, axis]) + reach
            overlaps = overlaps and low[box, axis] <= upper and high[box, axis] >= lower
        if not overlaps:
            continue
        if box < first_leaf:
            stack[count], stack[count + 1], count = 2 * box + 1, 2 * box + 2, count + 2
            continue
        begin = (box - first_leaf) * leaf
        for at in range(begin, min(begin + leaf, len(corners))):
            to = normals[at]
            if normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2] >= cosine:
                continue
            if _are_separated(triangle, corners[at], normal, reach) or _are_separated(corners[at], triangle, to, reach):
                continue
            return False
    return True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_piece_aligned(piece, own, leaf, reach, normal, stack):
    """Return True if all triangles of its own mesh within `reach` of a piece face the same way as the piece.

    False if `own`, that mesh as for `mark_aligned_faces`, is without triangles: then pieces are to be sampled.
    """
    if not len(own[0]):
        return False
    nx, ny, nz, shape = normal_and_shape(piece[0], piece[1], piece[2])
    if not shape > 0:
        return False
    twice = math.sqrt(nx * nx + ny * ny + nz * nz)
    normal[0], normal[1], normal[2] = nx / twice, ny / twice, nz / twice
    return _is_aligned(piece, normal, own[0], own[1], own[2], own[3], leaf, reach, PIECE_COSINE, stack)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _sample_in_order(
    surface,
    nearest,
    squared,
    tree,
    squared_tolerance,
    squared_enough,
    lengths,
    own,
    reach,
    squared_minimum,
    begin,
    results,
    space,
    thread,
    threads,
):
    """Set points as `sample_faces` does, with all arrays at hand; return the number that fit."""
    vertices, faces = surface
    corners, low, high, leaf = tree
    coarse, fine, folds = lengths
    points, face, owner, squares = results
    stack, waiting, pieces, owners, offs, depths, normal, piece, ends, off = space
    count = 0
    for f in range(begin[thread], len(faces), threads):
        before = count
        for k in range(3):
            v = faces[f, k]
            copy_row(pieces[0, k], vertices[v])
            owners[0, k], offs[0, k] = nearest[v], squared[v]
        depths[0], stack_size = 0, 1
        while stack_size > 0:
            stack_size -= 1
            depth = depths[stack_size]
            for k in range(3):
                copy_row(piece[k], pieces[stack_size, k])
                ends[k], off[k] = owners[stack_size, k], offs[stack_size, k]
            if depth == MAX_CUTS or _is_covered(piece, ends, off, corners, squared_tolerance):
                continue
            k, longest = 0, 0.0
            for side in range(3):
                side_length = squared_length(piece[side], piece[(side + 1) % 3])
                if side_length > longest:
                    k, longest = side, side_length
            limit, farthest = coarse, max(off[0], off[1], off[2])
            if farthest > squared_enough:
                limit = min(coarse, max(fine, SLOPE * (math.sqrt(squared_tolerance) - math.sqrt(farthest))))
            if longest <= limit * limit and (
                longest <= fine * fine or _is_over_a_fold(ends, farthest, corners, squared_tolerance, longest)
            ):
                continue
            if depth >= 2 and depth % 2 == 0 and _is_piece_aligned(piece[:3], own, leaf, reach, normal, stack):
                continue
            if longest <= folds * folds and _is_over_a_fold(ends, farthest, corners, squared_tolerance, longest):
                continue
            j = (k + 1) % 3
            for axis in range(3):
                piece[3, axis] = (piece[k, axis] + piece[j, axis]) / 2
            off[3], ends[3] = nearest_triangle(
                piece[3, 0], piece[3, 1], piece[3, 2], ends[k], corners, low, high, leaf, squared_enough, stack, waiting
            )
            if off[3] > squared_minimum:
                if count == points.shape[1]:
                    begin[thread] = f
                    return before
                copy_row(points[thread, count], piece[3])
                face[thread, count] = f
                owner[thread, count], squares[thread, count] = ends[3], off[3]
                count += 1
            for half in range(2):  # the middle of the longest side takes the place of one of its ends
                for corner in range(3):
                    at = 3 if corner == (j if half == 0 else k) else corner
                    copy_row(pieces[stack_size, corner], piece[at])
                    owners[stack_size, corner], offs[stack_size, corner] = ends[at], off[at]
                depths[stack_size] = depth + 1
                stack_size += 1
    begin[thread] = len(faces)
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def sample_faces(
    vertices,
    faces,
    nearest,
    squared,
    corners,
    low,
    high,
    leaf,
    squared_tolerance,
    squared_enough,
    coarse,
    fine,
    folds,
    own,
    reach,
    squared_minimum,
    begin,
    points,
    face,
    owner,
    squares,
    thread,
    threads,
):
    """Set points on every `threads`-th triangle, and their nearest triangles; return the number that fit.

    Parameters
    ----------
    vertices, faces : (V, 3) float64, (F, 3) int
    nearest, squared : (V,) int64, (V,) float64
        The triangle of the other mesh nearest to each vertex, and its squared distance.
    corners, low, high, leaf
        The other mesh: see `infill.kernels.distances.nearest_triangles`.
    squared_tolerance, squared_enough : float
        Squared distances: the limit of near points, and the one below which the exact distance does not matter.
    coarse, fine : float
        Lengths to which pieces are cut: all of them, and those with a corner that is barely near.
    folds : float
        Length up to which a piece counts as near where its nearest triangles fold little; 0 where triangles of the
        other mesh may lie between its corners.
    own : tuple of arrays
        Triangles of this mesh as for `mark_aligned_faces`, with their normals: pieces with aligned ones alone within
        `reach` are near. Without rows, if such pieces are to be sampled.
    reach : float
    squared_minimum : float
        Only points further away than this, a squared distance, are kept.
    begin : (threads,) int64
        The first face of each thread; becomes the first one whose points did not fit, or the number of faces.
    points, face, owner, squares : (threads, P, 3) float64, (threads, P) int32, (threads, P) int64, (threads, P) float64
        Results: the face that each point lies on, the triangle of the other mesh nearest to it, or any within
        `squared_enough`, and the squared distance from that triangle.
    """
    room = MAX_CUTS + 2
    space = (
        np.empty(STACK_SIZE, dtype=np.int64),
        np.empty(STACK_SIZE),
        np.empty((room, 3, 3)),
        np.empty((room, 3), dtype=np.int64),
        np.empty((room, 3)),
        np.empty(room, dtype=np.int64),
        np.empty(3),
        np.empty((4, 3)),
        np.empty(4, dtype=np.int64),
        np.empty(4),
    )
    return _sample_in_order(
        (vertices, faces),
        nearest,
        squared,
        (corners, low, high, leaf),
        squared_tolerance,
        squared_enough,
        (coarse, fine, folds),
        own,
        reach,
        squared_minimum,
        begin,
        (points, face, owner, squares),
        space,
        thread,
        threads,
    )


@njit(nogil=True, cache=True, error_model="numpy")
def mark_aligned_faces(corners, normals, low, high, leaf, reach, chosen, aligned, thread, threads):
    """Set True if all triangles within `reach` of every `threads`-th chosen triangle face nearly the same way.

    Parameters
    ----------
    corners, low, high, leaf
        A mesh: see `infill.kernels.distances.nearest_triangles`.
    normals : (F, 3) float64
        Of length 1, or of length 0 where a triangle has no area: neither it nor its neighbours are aligned.
    reach : float
        Triangles that are clearly further away, by planes of either triangle, do not count; all others do.
    chosen : (N,) int64
        Triangles.
    aligned : (N,) bool
        The result.
    """
    stack = np.empty(STACK_SIZE, dtype=np.int64)
    for n in range(thread, len(chosen), threads):
        f = chosen[n]
        aligned[n] = _is_aligned(
            corners[f], normals[f], corners, normals, low, high, leaf, reach, ALIGNED_COSINE, stack
        )
