"""Loops of `infill.partition.junctions`, compiled: points moved to the middle of their neighbours, and crossings."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.crossings import does_edge_pierce, share_vertex


@njit(nogil=True, cache=True)
def mark_triangles(triangles, marked, is_touched, thread, threads):
    """Mark the triangles with a marked corner: is_touched (T,) bool."""
    count = len(triangles)
    for t in range(count * thread // threads, count * (thread + 1) // threads):
        is_touched[t] = marked[triangles[t, 0]] or marked[triangles[t, 1]] or marked[triangles[t, 2]]


@njit(nogil=True, cache=True)
def mark_corners(triangles, chosen, marked):
    """Mark the corners of chosen triangles, (N,) numbers: marked (P,) bool."""
    for n in range(len(chosen)):
        for side in range(3):
            marked[triangles[chosen[n], side]] = True


@njit(nogil=True, cache=True)
def count_neighbours(triangles, chosen, is_junction, place, counts):
    """Count the neighbours of moved points: those on a line have neighbours on lines alone, others have all.

    Parameters
    ----------
    triangles : (T, 3) int
    chosen : (N,) int64
        The triangles to look at.
    is_junction : (P,) bool
        Points on lines.
    place : (P,) int32
        Place of a point among those that are moved, -1 for the others.
    counts : (M,) int64
        Written: a neighbour counts once for each of its triangles.
    """
    for n in range(len(chosen)):
        triangle = triangles[chosen[n]]
        for side in range(3):
            at = place[triangle[side]]
            if at < 0:
                continue
            for step in range(1, 3):
                if is_junction[triangle[(side + step) % 3]] or not is_junction[triangle[side]]:
                    counts[at] += 1


@njit(nogil=True, cache=True)
def list_neighbours(triangles, chosen, is_junction, place, cursor, neighbours):
    """List the neighbours that `count_neighbours` counts: places of moved points, or -1 - the number of another point.

    Parameters
    ----------
    cursor : (M,) int64
        Where the neighbours of each moved point begin; changed.
    neighbours : (K,) int32
        Written.
    """
    for n in range(len(chosen)):
        triangle = triangles[chosen[n]]
        for side in range(3):
            at = place[triangle[side]]
            if at < 0:
                continue
            for step in range(1, 3):
                point = triangle[(side + step) % 3]
                if is_junction[point] or not is_junction[triangle[side]]:
                    neighbours[cursor[at]] = place[point] if place[point] >= 0 else -1 - point
                    cursor[at] += 1


@njit(nogil=True, cache=True)
def move_to_middles(points, starts, neighbours, share, before, after, thread, threads):
    """Move points a share of the way towards the middle of their neighbours.

    Parameters
    ----------
    points : (P, 3) float32
        Of all points; those that are not moved count.
    starts : (M + 1,) int64
        Where the neighbours of each moved point begin.
    neighbours : (K,) int32
        See `list_neighbours`.
    share : float
    before, after : (M, 3) float64
        The moved points; `after` is written.
    """
    count = len(before)
    for n in range(count * thread // threads, count * (thread + 1) // threads):
        x = y = z = 0.0
        for at in range(starts[n], starts[n + 1]):
            other = neighbours[at]
            if other >= 0:
                x, y, z = x + before[other, 0], y + before[other, 1], z + before[other, 2]
            else:
                x, y, z = x + points[-1 - other, 0], y + points[-1 - other, 1], z + points[-1 - other, 2]
        number = max(starts[n + 1] - starts[n], 1)
        after[n, 0] = before[n, 0] + share * (x / number - before[n, 0])
        after[n, 1] = before[n, 1] + share * (y / number - before[n, 1])
        after[n, 2] = before[n, 2] + share * (z / number - before[n, 2])


@njit(nogil=True, cache=True)
def box_triangles(points, triangles, chosen, boxes, widest, thread, threads):
    """Write the box around each chosen triangle; and the largest number of cells that one passes along each axis.

    Parameters
    ----------
    points : (P, 3) float32
        In cells.
    triangles : (T, 3) int
    chosen : (N,) int64
    boxes : (N, 2, 3) float32
        Written: low and high corners.
    widest : (threads, 3) int64
        Written.
    """
    count = len(chosen)
    for n in range(count * thread // threads, count * (thread + 1) // threads):
        for axis in range(3):
            a, b, c = (
                points[triangles[chosen[n], 0], axis],
                points[triangles[chosen[n], 1], axis],
                points[triangles[chosen[n], 2], axis],
            )
            low, high = min(a, b, c), max(a, b, c)
            boxes[n, 0, axis], boxes[n, 1, axis] = low, high
            widest[thread, axis] = max(widest[thread, axis], np.int64(math.floor(high)) - np.int64(math.floor(low)))


@njit(nogil=True, cache=True)
def sort_by_rows(boxes, starts, order):
    """Sort boxes by the row of cells in which their low corners lie.

    Parameters
    ----------
    boxes : (N, 2, 3) float32
        With low corners at 0 or above.
    starts : (n0 * n1 + 1,) int64, as (n0, n1) and one more
        Of 0; written: where each row begins.
    order : (N,) int64
        Written: the numbers of boxes.
    """
    n1 = starts.shape[1]
    flat = starts.reshape(-1)
    for n in range(len(boxes)):
        flat[np.int64(boxes[n, 0, 0]) * n1 + np.int64(boxes[n, 0, 1]) + 2] += 1
    for row in range(2, len(flat)):
        flat[row] += flat[row - 1]
    for n in range(len(boxes)):
        row = np.int64(boxes[n, 0, 0]) * n1 + np.int64(boxes[n, 0, 1]) + 1
        order[flat[row]] = n
        flat[row] += 1


@njit(nogil=True, cache=True)
def sort_rows(boxes, starts, length, order, thread, threads):
    """Sort the boxes of each row by the cell in which their low corners lie, with `length` cells in a row."""
    flat = starts.reshape(-1)
    counts, sorted_row = np.zeros(length + 1, dtype=np.int64), np.empty(16, dtype=np.int64)
    for i in range(thread, starts.shape[0] - 1, threads):
        for j in range(starts.shape[1]):
            row = i * starts.shape[1] + j
            begin, end = flat[row], flat[row + 1]
            if end - begin < 2:
                continue
            if end - begin > len(sorted_row):
                sorted_row = np.empty(2 * (end - begin), dtype=np.int64)
            for k in range(length + 1):
                counts[k] = 0
            for at in range(begin, end):
                counts[np.int64(boxes[order[at], 0, 2]) + 1] += 1
            for k in range(1, length + 1):
                counts[k] += counts[k - 1]
            for at in range(begin, end):
                cell = np.int64(boxes[order[at], 0, 2])
                sorted_row[counts[cell]] = order[at]
                counts[cell] += 1
            for at in range(begin, end):
                order[at] = sorted_row[at - begin]


@njit(nogil=True, cache=True, error_model="numpy")
def cross_rows(points, triangles, chosen, scale, boxes, starts, order, widest, pairs, thread, threads):
    """List the pairs of chosen triangles that pass through each other; return their number.

    Pairs that share a point do not count.

    Parameters
    ----------
    points, triangles, chosen, boxes, starts, order
        As for the functions above.
    scale : (3,) float64
        Sides of a cell.
    widest : (3,) int64
        Cells that a box passes along each axis, at most.
    pairs : (threads, K, 2) int64
        Written, as far as there is room.
    """
    flat, n0, n1 = starts.reshape(-1), starts.shape[0] - 1, starts.shape[1]
    triangle, target = np.empty((3, 3)), np.empty((3, 3))
    normal, side = np.empty(3), np.empty(3)
    rows = (widest[0] + 1) * (2 * widest[1] + 1)
    cursor, ends = np.empty(rows, dtype=np.int64), np.empty(rows, dtype=np.int64)
    count = 0
    for i in range(thread, n0, threads):
        for j in range(n1):
            begin, end = flat[i * n1 + j], flat[i * n1 + j + 1]
            if begin == end:
                continue
            near = 0
            for a in range(i, min(i + widest[0] + 1, n0)):
                for b in range(j if a == i else max(j - widest[1], 0), min(j + widest[1] + 1, n1)):
                    cursor[near], ends[near] = flat[a * n1 + b], flat[a * n1 + b + 1]
                    near += 1
            for at in range(begin, end):
                f = order[at]
                box, cell = boxes[f], np.int64(boxes[f, 0, 2])
                is_loaded = False
                cursor[0] = at + 1
                for row in range(near):
                    while cursor[row] < ends[row] and (
                        row > 0 and np.int64(boxes[order[cursor[row]], 0, 2]) < cell - widest[2]
                    ):
                        cursor[row] += 1
                    for there in range(cursor[row], ends[row]):
                        g = order[there]
                        if np.int64(boxes[g, 0, 2]) > box[1, 2]:
                            break
                        meets = True
                        for axis in range(3):
                            meets = meets and boxes[g, 0, axis] <= box[1, axis] and boxes[g, 1, axis] >= box[0, axis]
                        if not meets:
                            continue
                        if share_vertex(triangles, chosen[f], chosen[g]):
                            continue
                        for corner in range(3):
                            for axis in range(3):
                                target[corner, axis] = points[triangles[chosen[g], corner], axis] * scale[axis]
                        if not is_loaded:
                            for corner in range(3):
                                for axis in range(3):
                                    triangle[corner, axis] = points[triangles[chosen[f], corner], axis] * scale[axis]
                            is_loaded = True
                        if not is_on_both_sides(triangle, target):
                            continue
                        does_pierce = does_edge_pierce(triangle, target, normal, side)
                        if not (does_pierce or does_edge_pierce(target, triangle, normal, side)):
                            continue
                        if count < pairs.shape[1]:
                            pairs[thread, count, 0] = min(chosen[f], chosen[g])
                            pairs[thread, count, 1] = max(chosen[f], chosen[g])
                        count += 1
    return count


@njit(inline="always", cache=True)
def is_on_both_sides(triangle, target):
    """Tell whether the corners of a triangle lie on both sides of the plane of another."""
    ux, uy, uz = triangle[1, 0] - triangle[0, 0], triangle[1, 1] - triangle[0, 1], triangle[1, 2] - triangle[0, 2]
    vx, vy, vz = triangle[2, 0] - triangle[0, 0], triangle[2, 1] - triangle[0, 1], triangle[2, 2] - triangle[0, 2]
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    low = high = 0.0
    for corner in range(3):
        side = (
            (target[corner, 0] - triangle[0, 0]) * nx
            + (target[corner, 1] - triangle[0, 1]) * ny
            + (target[corner, 2] - triangle[0, 2]) * nz
        )
        low, high = min(low, side), max(high, side)
    return low < 0.0 < high
