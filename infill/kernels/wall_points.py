"""Loops over the points of walls and the corners between which they lie, compiled: middles, marks, counts."""
# mypy: disable-error-code="no-untyped-def, no-untyped-call"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.lanes import count_ones
from infill.kernels.partition import (
    NONE,
    axis_place,
    chain_of_slot,
    code_of_four,
    code_of_three,
    is_side,
    mark_next_row,
    nearest_cell,
    owned_points,
    side_of_face,
)

SOLID, VOID = 1, 2  # kinds of blocks of 2 x 2 x 2 cells that are all alike

MOST_CORNERS = 4  # of a simplex


@njit(inline="always", cache=True)
def write_middle(i, j, k, count, chain, steps, shape, origin, middle):
    """Write the middle of a simplex, (3,), in cells: see `place_middles`."""
    for axis in range(3):
        total = 0.0
        for corner in range(count):
            place = (i, j, k)[axis] + steps[chain[corner], axis] + origin[axis]
            total += axis_place(place, shape[axis])
        middle[axis] = total / count


@njit(nogil=True, cache=True)
def place_middles(steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts, shape, origin, middles):
    """Write the middles of the simplices in which the points of walls lie.

    Parameters
    ----------
    steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts
        As for `infill.kernels.partition.place_points`.
    shape : (3,) int64
        Cells of the whole grid.
    origin : (3,) int64
        The cell of the whole grid at which that of the walls begins.
    middles : (P, 3) float64
        Written, in cells of the whole grid.
    """
    chain = np.empty(MOST_CORNERS, dtype=np.int64)
    for i in range(row_starts.shape[0]):
        for j in range(row_starts.shape[1]):
            for at in range(row_starts[i, j, 0], row_starts[i, j, 3]):
                point = starts[at]
                for slot in range(slots_at[1] + len(tetrahedra)):
                    if (masks[at] >> slot) & 1:
                        count = chain_of_slot(slot, slots_at, faces, tetrahedra, chain)
                        write_middle(i, j, np.int64(bases[at]), count, chain, steps, shape, origin, middles[point])
                        point += 1


@njit(nogil=True, cache=True)
def mark_far(
    steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts, points, cell_size, limit, far, thread, threads
):
    """Mark the cells at the corners of simplices whose point lies far from their middle.

    Parameters
    ----------
    steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts
        As for `infill.kernels.partition.place_points`.
    points : (P, 3) float32
        In cells.
    cell_size : (3,) float64, mm
    limit : float, mm
        Points further away are far.
    far : (n0, n1, n2) bool
        Cells; written.
    """
    n0, n1, n2 = far.shape
    chain, middle = np.empty(MOST_CORNERS, dtype=np.int64), np.empty(3)
    shape, origin = np.array([n0, n1, n2]), np.zeros(3, dtype=np.int64)
    for i in range(thread, row_starts.shape[0], threads):
        for j in range(row_starts.shape[1]):
            for at in range(row_starts[i, j, 0], row_starts[i, j, 3]):
                point, k = starts[at], np.int64(bases[at])
                for slot in range(slots_at[1] + len(tetrahedra)):
                    if not (masks[at] >> slot) & 1:
                        continue
                    count = chain_of_slot(slot, slots_at, faces, tetrahedra, chain)
                    write_middle(i, j, k, count, chain, steps, shape, origin, middle)
                    squared = 0.0
                    for axis in range(3):
                        squared += ((points[point, axis] - middle[axis]) * cell_size[axis]) ** 2
                    if math.sqrt(squared) > limit:
                        for corner in range(count):
                            step = steps[chain[corner]]
                            far[
                                nearest_cell(i + step[0], n0) - 1,
                                nearest_cell(j + step[1], n1) - 1,
                                nearest_cell(k + step[2], n2) - 1,
                            ] = True
                    point += 1


@njit(nogil=True, cache=True)
def mark_beside(
    steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts, cells, is_beside, thread, threads
):
    """Mark the points of walls whose simplex has a corner in a marked cell.

    Parameters
    ----------
    steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts
        As for `infill.kernels.partition.place_points`.
    cells : (n0, n1, n2) bool
    is_beside : (P,) bool
        Written.
    """
    n0, n1, n2 = cells.shape
    chain = np.empty(MOST_CORNERS, dtype=np.int64)
    for i in range(thread, row_starts.shape[0], threads):
        for j in range(row_starts.shape[1]):
            for at in range(row_starts[i, j, 0], row_starts[i, j, 3]):
                point, k = starts[at], np.int64(bases[at])
                for slot in range(slots_at[1] + len(tetrahedra)):
                    if not (masks[at] >> slot) & 1:
                        continue
                    beside = False
                    for corner in range(chain_of_slot(slot, slots_at, faces, tetrahedra, chain)):
                        step = steps[chain[corner]]
                        beside |= cells[
                            nearest_cell(i + step[0], n0) - 1,
                            nearest_cell(j + step[1], n1) - 1,
                            nearest_cell(k + step[2], n2) - 1,
                        ]
                    is_beside[point] = beside
                    point += 1


@njit(nogil=True, cache=True)
def mark_labels(triangles, sides, is_marked, labels, thread, threads):
    """Mark the labels of triangles with a marked corner.

    Parameters
    ----------
    triangles : (T, 3) int
    sides : (T, 2) int32
    is_marked : (P,) bool
    labels : (threads, labels) bool
        Written.
    """
    count = len(triangles)
    for t in range(count * thread // threads, count * (thread + 1) // threads):
        if is_marked[triangles[t, 0]] or is_marked[triangles[t, 1]] or is_marked[triangles[t, 2]]:
            labels[thread, sides[t, 0]] = True
            if sides[t, 1] != NONE:
                labels[thread, sides[t, 1]] = True


@njit(nogil=True, cache=True)
def count_parts(
    winners, faces, tetrahedra, slots, counts, table, flat_counts, flat_table, points, triangles, thread, threads
):
    """Count the points and triangles of the walls of every label.

    Parameters
    ----------
    winners : (n0, n1, n2) uint16
    faces, tetrahedra, slots, counts, flat_counts, flat_table
        As for `infill.kernels.partition.count_rows`.
    table : (6, PATTERNS, 12, 5) int64
        See `infill.partition.tetrahedra.Tables.triangles`.
    points, triangles : (threads, labels) int64
        Added to.
    """
    m0, m1, m2 = winners.shape[0] + 2, winners.shape[1] + 2, winners.shape[2] + 2
    corner, four = np.empty(8, dtype=np.int64), np.empty(4, dtype=np.int64)
    rows, marks = np.empty((4, m2 + 1), dtype=np.int32), np.empty(m2, dtype=np.uint8)
    points_of, triangles_of = points[thread], triangles[thread]
    for i in range(thread, m0, threads):
        for j in range(m1):
            mark_next_row(winners, i, j, rows, marks)
            for k in range(m2):
                if not marks[k]:
                    continue
                on_side = is_side(winners, i, j, k)
                mask = owned_points(rows, k, on_side, faces, tetrahedra, slots, corner)
                if not mask:
                    continue
                label = corner[0]
                points_of[label] += count_ones(mask)
                for d in range(1, 8):
                    if (mask >> d) & 1:
                        points_of[corner[d]] += 1
                for f in range(len(faces) if mask >> slots[0] else 0):
                    if (mask >> (slots[0] + f)) & 1:
                        points_of[corner[faces[f, 0]]] += 1
                        points_of[corner[faces[f, 1]]] += 1
                for t in range(len(tetrahedra) if mask >> slots[1] else 0):
                    if (mask >> (slots[1] + t)) & 1:
                        points_of[corner[tetrahedra[t, 0]]] += 1
                        points_of[corner[tetrahedra[t, 1]]] += 1
                        points_of[corner[7]] += 1
                if corner[7] != NONE:
                    four[0], four[3] = label, corner[7]
                    for t in range(len(tetrahedra)):
                        four[1], four[2] = corner[tetrahedra[t, 0]], corner[tetrahedra[t, 1]]
                        code = code_of_four(four[0], four[1], four[2], four[3])
                        for n in range(counts[t, code]):
                            triangles_of[four[table[t, code, n, 3]]] += 1
                            triangles_of[four[table[t, code, n, 4]]] += 1
                if not on_side:
                    continue
                for f in range(len(faces)):
                    if corner[faces[f, 1]] == NONE or faces[f, 1] == 7:
                        continue
                    if side_of_face(faces[f, 1], i, j, k, (m0, m1, m2)) == 0:
                        continue
                    four[0], four[1], four[2] = label, corner[faces[f, 0]], corner[faces[f, 1]]
                    code = code_of_three(four[0], four[1], four[2])
                    for n in range(flat_counts[f, code]):
                        at = four[flat_table[f, code, n, 3]]
                        if at != 0:
                            triangles_of[at] += 1


@njit(from_python=False, nogil=True, cache=True)
def _kind_of_block(numbers, number, i, j, k):
    """Return SOLID or VOID if all cells of a block are in a label or outside it, else 0."""
    n0, n1, n2 = numbers.shape
    solid = 0
    for a in range(2):
        for b in range(2):
            for c in range(2):
                x, y, z = min(max(i + a, 0), n0 - 1), min(max(j + b, 0), n1 - 1), min(max(k + c, 0), n2 - 1)
                solid += numbers[x, y, z] == number
    return SOLID if solid == 8 else VOID if solid == 0 else 0


@njit(nogil=True, cache=True)
def find_thick(places, numbers, number, is_thick):
    """Tell whether both the cells of a label and those outside it are more than one cell thick beside places.

    The specification is a binary opening by a block of 2 x 2 x 2 cells.

    Parameters
    ----------
    places : (N, 3) float64
        In cells.
    numbers : (n0, n1, n2) uint16
        The label of every cell.
    number : int
    is_thick : (N,) bool
        Written.
    """
    for n in range(len(places)):
        i, j, k = (
            np.int64(math.floor(places[n, 0] - 0.5)),
            np.int64(math.floor(places[n, 1] - 0.5)),
            np.int64(math.floor(places[n, 2] - 0.5)),
        )
        # A cell beside the place lies in a thick part if one of the eight blocks that hold it is alike.
        kinds = 0
        for a in range(-1, 2):
            for b in range(-1, 2):
                for c in range(-1, 2):
                    if kinds != SOLID | VOID:
                        kinds |= _kind_of_block(numbers, number, i + a, j + b, k + c)
        is_thick[n] = kinds == SOLID | VOID
