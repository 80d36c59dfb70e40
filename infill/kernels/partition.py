"""Loops of `infill.partition.walls`, compiled: the complex of walls between labels.

The lattice has one point for each cell, at its centre, and one more beyond each end of each axis, on the side of the
box, with the value of the cell next to it: n + 2 points along an axis of n cells. Cell i has number i + 1, which is
also its place in the bricks of `infill.phasefield.sparse`.

Rows of the lattice run along the last axis. Of each row only the bases of points are kept (`bases`), with one bit for
each point that they own (`masks`) and the number of the first (`starts`): so any cube finds its points, including
those of neighbouring rows, without a table of the grid.
"""
# mypy: disable-error-code="no-untyped-def, call-arg, var-annotated"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.lanes import count_ones
from infill.kernels.rows import copy_row
from infill.kernels.sparse import B0, B1, B2
from infill.kernels.winners import INSIDE, place_hash

NONE = -1  # no label: beyond the lattice
ABSENT = -2  # slot of a label that is void throughout a brick
LEAST_SHARE = 1e-3  # of an edge: points lie no nearer to its ends
HIGH, LOW = 2.0**16, 2.0**36  # parts of a cell, and of one of these: sums in whole numbers are exact in any order
LEAST_WEIGHT = 0.02  # of a corner of a face or a tetrahedron in a point inside it


@njit(inline="always", cache=True)
def label_at(winners, i, j, k):
    """Return the label of a point of the lattice, NONE beyond it."""
    n0, n1, n2 = winners.shape
    if i > n0 + 1 or j > n1 + 1 or k > n2 + 1:
        return NONE
    i, j, k = min(max(i, 1), n0) - 1, min(max(j, 1), n1) - 1, min(max(k, 1), n2) - 1
    return np.int64(winners[i, j, k])


@njit(inline="always", cache=True)
def is_side(winners, i, j, k):
    """Tell whether a point of the lattice lies on a side of the box."""
    n0, n1, n2 = winners.shape
    return i == 0 or j == 0 or k == 0 or i == n0 + 1 or j == n1 + 1 or k == n2 + 1


@njit(inline="always", cache=True)
def fill_corners(winners, i, j, k, steps, corner):
    """Write the labels of the eight corners of a cube; return whether they are not all alike."""
    differs = False
    for d in range(8):
        corner[d] = label_at(winners, i + steps[d, 0], j + steps[d, 1], k + steps[d, 2])
        differs |= corner[d] != corner[0] and corner[d] != NONE
    return differs


@njit(nogil=True, cache=True)
def fill_row(winners, i, j, row):
    """Write the labels of a row of the lattice and one NONE after it; NONE alone if it lies beyond the lattice."""
    n0, n1, n2 = winners.shape
    if i > n0 + 1 or j > n1 + 1:
        for k in range(len(row)):
            row[k] = NONE
        return
    source = winners[min(max(i, 1), n0) - 1, min(max(j, 1), n1) - 1]
    row[0] = source[0]
    for k in range(n2):
        row[k + 1] = source[k]
    row[n2 + 1], row[n2 + 2] = source[n2 - 1], NONE


@njit(nogil=True, cache=True)
def mark_bases(rows, on_side, marks):
    """Mark the cubes of a row that may own points: where corners differ, or that lie on a side of the box."""
    row_0, row_1, row_2, row_3 = rows[0], rows[1], rows[2], rows[3]
    count = len(marks)
    for k in range(count if not on_side else 0):
        label = row_0[k]
        marks[k] = (
            (row_1[k] != label)
            | (row_2[k] != label)
            | (row_3[k] != label)
            | (row_0[k + 1] != label)
            | (row_1[k + 1] != label)
            | (row_2[k + 1] != label)
            | (row_3[k + 1] != label)
        )
    for k in range(count if on_side else 0):
        marks[k] = 1
    marks[0] = marks[count - 1] = 1


@njit(nogil=True, cache=True)
def mark_next_row(winners, i, j, rows, marks):
    """Write the four rows of the cubes of a row of the lattice, from those of the row before; mark possible bases."""
    if j == 0:
        fill_row(winners, i, j, rows[0])
        fill_row(winners, i + 1, j, rows[1])
    else:
        copy_row(rows[0], rows[2])
        copy_row(rows[1], rows[3])
    fill_row(winners, i, j + 1, rows[2])
    fill_row(winners, i + 1, j + 1, rows[3])
    mark_bases(rows, is_side(winners, i, j, 1), marks)


@njit(inline="always", cache=True)
def owned_points(rows, k, on_side, faces, tetrahedra, slots, corner):
    """Write the labels of the corners of a cube; return the points that its base owns, one bit for each.

    Parameters
    ----------
    rows : (4, m2 + 1) int32
        Of the lattice: step d from the base leads to `rows[d & 3, k + (d >> 2)]`.
    """
    label = np.int64(rows[0, k])
    corner[0] = label
    rival, several = label, False
    mask = 1 if label != 0 and on_side else 0
    for d in range(1, 8):
        at = np.int64(rows[d & 3, k + (d >> 2)])
        corner[d] = at
        if at != NONE and at != label:
            mask |= 1 << d
            several |= rival != label and at != rival
            rival = at
    if not several:
        return mask
    for f in range(len(faces)):
        b, c = corner[faces[f, 0]], corner[faces[f, 1]]
        if c != NONE and b != label and c != label and b != c:
            mask |= 1 << (slots[0] + f)
    end = corner[7]
    if end != NONE and end != label:
        for t in range(len(tetrahedra)):
            b, c = corner[tetrahedra[t, 0]], corner[tetrahedra[t, 1]]
            if b != label and c != label and b != c and b != end and c != end:
                mask |= 1 << (slots[1] + t)
    return mask


@njit(inline="always", cache=True)
def code_of_four(a, b, c, d):
    """Return the code of which of four labels are alike: see `infill.partition.tetrahedra.pattern_code`."""
    second = 0 if b == a else 1
    third = 0 if c == a else second if c == b else second + 1
    largest = max(second, third)
    fourth = 0 if d == a else second if d == b else third if d == c else largest + 1
    return (second * 3 + third) * 4 + fourth


@njit(inline="always", cache=True)
def code_of_three(a, b, c):
    """Return the code of which of three labels are alike."""
    second = 0 if b == a else 1
    third = 0 if c == a else second if c == b else second + 1
    return second * 3 + third


@njit(nogil=True, cache=True)
def count_rows(winners, faces, tetrahedra, slots, counts, flat_counts, flat_table, sizes, thread, threads):
    """Count the bases, points and triangles of every row of the lattice: sizes (m0, m1, 3) int64."""
    m0, m1, m2 = winners.shape[0] + 2, winners.shape[1] + 2, winners.shape[2] + 2
    corner = np.empty(8, dtype=np.int64)
    rows, marks = np.empty((4, m2 + 1), dtype=np.int32), np.empty(m2, dtype=np.uint8)
    for i in range(thread, m0, threads):
        for j in range(m1):
            mark_next_row(winners, i, j, rows, marks)
            bases = points = triangles = 0
            for k in range(m2):
                if not marks[k]:
                    continue
                on_side = is_side(winners, i, j, k)
                mask = owned_points(rows, k, on_side, faces, tetrahedra, slots, corner)
                if mask:
                    bases += 1
                    points += count_ones(mask)
                    triangles += count_triangles(
                        corner, i, j, k, (m0, m1, m2), on_side, faces, tetrahedra, counts, flat_counts, flat_table
                    )
            sizes[i, j, 0], sizes[i, j, 1], sizes[i, j, 2] = bases, points, triangles


@njit(inline="always", cache=True)
def count_triangles(corner, i, j, k, shape, on_side, faces, tetrahedra, counts, flat_counts, flat_table):
    """Return the number of triangles of a cube, and of the faces on the sides of the box that a base owns."""
    triangles = 0
    if corner[7] != NONE:
        for t in range(len(tetrahedra)):
            code = code_of_four(corner[0], corner[tetrahedra[t, 0]], corner[tetrahedra[t, 1]], corner[7])
            triangles += counts[t, code]
    if not on_side:
        return triangles
    for f in range(len(faces)):
        if corner[faces[f, 1]] == NONE or faces[f, 1] == 7:
            continue
        if side_of_face(faces[f, 1], i, j, k, shape) == 0:
            continue
        code = code_of_three(corner[0], corner[faces[f, 0]], corner[faces[f, 1]])
        for n in range(flat_counts[f, code]):
            at = flat_table[f, code, n, 3]
            label = corner[0] if at == 0 else corner[faces[f, at - 1]]
            triangles += label != 0
    return triangles


@njit(inline="always", cache=True)
def side_of_face(step, i, j, k, shape):
    """Return -1 or 1 if the face of a base with this last step lies on a low or high side of the box, else 0."""
    at, largest = (i, shape[0] - 1) if step == 6 else (j, shape[1] - 1) if step == 5 else (k, shape[2] - 1)
    return -1 if at == 0 else 1 if at == largest else 0


@njit(nogil=True, cache=True)
def fill_rows(winners, faces, tetrahedra, slots, row_starts, bases, masks, starts, thread, threads):
    """Write the bases of every row, their points as bits, and the number of the first of these.

    Parameters
    ----------
    row_starts : (m0, m1, 6) int64
        Bases, points and triangles before each row, and before the next one.
    """
    m0, m1, m2 = winners.shape[0] + 2, winners.shape[1] + 2, winners.shape[2] + 2
    corner = np.empty(8, dtype=np.int64)
    rows, marks = np.empty((4, m2 + 1), dtype=np.int32), np.empty(m2, dtype=np.uint8)
    for i in range(thread, m0, threads):
        for j in range(m1):
            mark_next_row(winners, i, j, rows, marks)
            at, point = row_starts[i, j, 0], row_starts[i, j, 1]
            for k in range(m2):
                if not marks[k]:
                    continue
                mask = owned_points(rows, k, is_side(winners, i, j, k), faces, tetrahedra, slots, corner)
                if mask:
                    bases[at], masks[at], starts[at] = k, mask, point
                    at += 1
                    point += count_ones(mask)


@njit(inline="always", cache=True)
def nearest_cell(i, count):
    """Return the point of the lattice along an axis that has a cell, 1 to `count`, nearest to another."""
    return min(max(i, 1), count)


@njit(inline="always", cache=True)
def find_slot(label, begin, end, labels, slots):
    """Return the slot of a label among the entries of a brick, `ABSENT` if it is not there."""
    for entry in range(begin, end):
        if labels[entry] == label:
            return np.int64(slots[entry])
    return np.int64(ABSENT)


@njit(inline="always", cache=True)
def value_in_brick(slot, cell, values):
    """Return the value of a cell of a brick."""
    if slot >= 0:
        return values[slot, cell]
    return np.float32(1.0) if slot == INSIDE else np.float32(-1.0)


@njit(inline="always", cache=True)
def value_at(label, i, j, k, shape, entries, labels, slots, values, offsets):
    """Return the value plus offset of a label at a point of the lattice."""
    i, j, k = nearest_cell(i, shape[0]), nearest_cell(j, shape[1]), nearest_cell(k, shape[2])
    p, q, r = i // B0, j // B1, k // B2
    slot = find_slot(label, entries[p, q, r, 0], entries[p, q, r, 1], labels, slots)
    return value_in_brick(slot, ((i - p * B0) * B1 + j - q * B1) * B2 + k - r * B2, values) + offsets[label]


@njit(inline="always", cache=True)
def axis_place(i, count):
    """Return the place of a point of the whole lattice along an axis, cells."""
    return np.float64(0.0) if i == 0 else np.float64(count) if i == count + 1 else i - 0.5


@njit(from_python=False, nogil=True, cache=True)
def chain_of_slot(slot, slots_at, faces, tetrahedra, chain):
    """Write the corners of a cube between which a point lies, and return their number: an end, edge, face or inside."""
    chain[0] = 0
    if slot == 0:
        return 1
    if slot < slots_at[0]:
        chain[1] = slot
        return 2
    if slot < slots_at[1]:
        chain[1], chain[2] = faces[slot - slots_at[0], 0], faces[slot - slots_at[0], 1]
        return 3
    t = slot - slots_at[1]
    chain[1], chain[2], chain[3] = tetrahedra[t, 0], tetrahedra[t, 1], 7
    return 4


@njit(nogil=True, cache=True)
def place_points(
    winners, steps, faces, tetrahedra, slots_at, row_starts, bases, masks, starts,
    entries, labels, slots, values, offsets, place, points, thread, threads,
):  # fmt: skip
    """Write the place of every point, (P, 3), in cells of the whole grid.

    Parameters
    ----------
    place : (2, 3) int64
        The first cell of this part of the grid, and the cells of the whole.
    """
    shape = winners.shape
    m0, m1 = shape[0] + 2, shape[1] + 2
    corner = np.empty(8, dtype=np.int64)
    chain, weight = np.empty(4, dtype=np.int64), np.empty(4, dtype=np.float64)
    matrix = np.empty((4, 4), dtype=np.float64)
    for i in range(thread, m0, threads):
        for j in range(m1):
            # Along both axes across, the points of the cubes of a row, and whether they lie in the same bricks.
            i0, i1 = nearest_cell(i, shape[0]), nearest_cell(i + 1, shape[0])
            j0, j1 = nearest_cell(j, shape[1]), nearest_cell(j + 1, shape[1])
            p, q = i0 // B0, j0 // B1
            is_row_in_brick = i1 // B0 == p and j1 // B1 == q
            step_i, step_j = (i1 - i0) * B1 * B2, (j1 - j0) * B2
            for at in range(row_starts[i, j, 0], row_starts[i, j, 3]):
                k, mask, point = np.int64(bases[at]), np.int64(masks[at]), starts[at]
                fill_corners(winners, i, j, k, steps, corner)
                k0, k1 = nearest_cell(k, shape[2]), nearest_cell(k + 1, shape[2])
                r = k0 // B2
                in_brick = is_row_in_brick and k1 // B2 == r
                label, rival = corner[0], np.int64(NONE)
                slot_of_base = slot_of_rival = begin = end = first = np.int64(0)
                if in_brick:
                    begin, end = entries[p, q, r, 0], entries[p, q, r, 1]
                    slot_of_base = find_slot(label, begin, end, labels, slots)
                    first = ((i0 - p * B0) * B1 + j0 - q * B1) * B2 + k0 - r * B2
                for slot in range(slots_at[1] + len(tetrahedra)):
                    if not (mask >> slot) & 1:
                        continue
                    count, weight[0] = chain_of_slot(slot, slots_at, faces, tetrahedra, chain), 1.0
                    if count == 2 and in_brick:
                        # The usual case: both labels are looked up once for all points between them.
                        if corner[slot] != rival:
                            rival = corner[slot]
                            slot_of_rival = find_slot(rival, begin, end, labels, slots)
                        cell = first + steps[slot, 0] * step_i + steps[slot, 1] * step_j + steps[slot, 2] * (k1 - k0)
                        matrix[0, 0] = value_in_brick(slot_of_base, first, values) + offsets[label]
                        matrix[1, 0] = value_in_brick(slot_of_rival, first, values) + offsets[rival]
                        matrix[0, 1] = value_in_brick(slot_of_base, cell, values) + offsets[label]
                        matrix[1, 1] = value_in_brick(slot_of_rival, cell, values) + offsets[rival]
                        weigh_ends(matrix, weight)
                    elif count > 1:
                        for corner_at in range(count):
                            d = chain[corner_at]
                            ci, cj, ck = i + steps[d, 0], j + steps[d, 1], k + steps[d, 2]
                            for other in range(count):
                                matrix[other, corner_at] = value_at(
                                    corner[chain[other]], ci, cj, ck, shape, entries, labels, slots, values, offsets
                                )
                        weigh_corners(matrix, count, weight)
                    for axis in range(3):
                        at_base = (i, j, k)[axis] + place[0, axis]
                        total = 0.0
                        low = high = axis_place(at_base, place[1, axis])
                        for corner_at in range(count):
                            corner_place = axis_place(at_base + steps[chain[corner_at], axis], place[1, axis])
                            total += weight[corner_at] * corner_place
                            low, high = min(low, corner_place), max(high, corner_place)
                        # Rounding must not move a point off the side of the box.
                        points[point, axis] = min(max(total, low), high)
                    point += 1


@njit(inline="always", cache=True)
def weigh_ends(matrix, weight):
    """Write the weights of the ends of an edge: see `weigh_corners`."""
    gain_at_start, gain_at_end = matrix[0, 0] - matrix[1, 0], matrix[1, 1] - matrix[0, 1]
    share = 0.5 if gain_at_start + gain_at_end <= 0.0 else gain_at_start / (gain_at_start + gain_at_end)
    share = min(max(share, LEAST_SHARE), 1.0 - LEAST_SHARE)
    weight[0], weight[1] = 1.0 - share, share


@njit(cache=True)
def weigh_corners(matrix, count, weight):
    """Write the weights of the corners of a simplex at the point at which all labels have the same value.

    Parameters
    ----------
    matrix : (4, 4) float64
        Value of the label of each corner (rows) at each corner (columns); each wins at its own.
    count : int
        Corners: 2, 3 or 4.
    weight : (4,) float64
        Written; at least `LEAST_SHARE` or `LEAST_WEIGHT` each, and 1 together.
    """
    if count == 2:
        weigh_ends(matrix, weight)
        return
    # Solve sum_c w_c (row_r - row_0)[c] = 0 for r > 0, sum w = 1, by elimination with pivots.
    system = np.zeros((4, 5), dtype=np.float64)
    for row in range(1, count):
        for column in range(count):
            system[row - 1, column] = matrix[row, column] - matrix[0, column]
    for column in range(count):
        system[count - 1, column] = 1.0
    system[count - 1, 4] = 1.0
    singular = False
    for column in range(count):
        pivot = column
        for row in range(column + 1, count):
            if abs(system[row, column]) > abs(system[pivot, column]):
                pivot = row
        if abs(system[pivot, column]) < 1e-9:
            singular = True
            break
        if pivot != column:
            for entry in range(5):
                system[column, entry], system[pivot, entry] = system[pivot, entry], system[column, entry]
        for row in range(count):
            if row != column:
                factor = system[row, column] / system[column, column]
                for entry in range(5):
                    system[row, entry] -= factor * system[column, entry]
    total = 0.0
    for corner in range(count):
        share = 1.0 / count if singular else system[corner, 4] / system[corner, corner]
        weight[corner] = min(max(share, LEAST_WEIGHT), 1.0)
        total += weight[corner]
    for corner in range(count):
        weight[corner] /= total


@njit(inline="always", cache=True)
def point_number(cursor, bases, masks, starts, row, k, slot):
    """Return the number of a point by its base, at or after the cursor of its row."""
    at = cursor[row]
    while bases[at] < k:
        at += 1
    return starts[at] + count_ones(masks[at] & ((1 << slot) - 1))


@njit(nogil=True, cache=True)
def write_triangles(
    winners, steps, faces, tetrahedra, places, counts, table, flat_places, flat_counts, flat_table,
    row_starts, bases, masks, starts, triangles, sides, thread, threads,
):  # fmt: skip
    """Write the triangles of all walls, (T, 3), and the labels behind and before each, (T, 2); NONE outside the box."""
    m0, m1, m2 = winners.shape[0] + 2, winners.shape[1] + 2, winners.shape[2] + 2
    corner, four = np.empty(8, dtype=np.int64), np.empty(4, dtype=np.int64)
    cursor, ends = np.empty(4, dtype=np.int64), np.empty(4, dtype=np.int64)
    for i in range(thread, m0, threads):
        for j in range(m1):
            write = row_starts[i, j, 2]
            if write == row_starts[i, j, 5]:
                continue
            for row in range(4):
                a, b = min(i + (row & 1), m0 - 1), min(j + (row >> 1), m1 - 1)
                cursor[row], ends[row] = row_starts[a, b, 0], row_starts[a, b, 3]
            for base in range(row_starts[i, j, 0], row_starts[i, j, 3]):
                k = np.int64(bases[base])
                differs = fill_corners(winners, i, j, k, steps, corner)
                for row in range(4):
                    while cursor[row] < ends[row] and bases[cursor[row]] < k:
                        cursor[row] += 1
                if differs and corner[7] != NONE:
                    for t in range(len(tetrahedra)):
                        four[0], four[3] = corner[0], corner[7]
                        four[1], four[2] = corner[tetrahedra[t, 0]], corner[tetrahedra[t, 1]]
                        code = code_of_four(four[0], four[1], four[2], four[3])
                        for n in range(counts[t, code]):
                            for side in range(3):
                                step, slot = (
                                    places[t, table[t, code, n, side], 0],
                                    places[t, table[t, code, n, side], 1],
                                )
                                triangles[write, side] = point_number(
                                    cursor, bases, masks, starts, step & 3, k + (step >> 2), slot
                                )
                            sides[write, 0], sides[write, 1] = four[table[t, code, n, 3]], four[table[t, code, n, 4]]
                            write += 1
                if not is_side(winners, i, j, k):
                    continue
                for f in range(len(faces)):
                    if corner[faces[f, 1]] == NONE or faces[f, 1] == 7:
                        continue
                    facing = side_of_face(faces[f, 1], i, j, k, (m0, m1, m2))
                    if facing == 0:
                        continue
                    four[0], four[1], four[2] = corner[0], corner[faces[f, 0]], corner[faces[f, 1]]
                    code = code_of_three(four[0], four[1], four[2])
                    for n in range(flat_counts[f, code]):
                        label = four[flat_table[f, code, n, 3]]
                        if label == 0:
                            continue
                        for side in range(3):
                            # Tables face up; on a low side the order is turned round.
                            of = flat_table[f, code, n, side if facing > 0 else 2 - side]
                            step, slot = flat_places[f, of, 0], flat_places[f, of, 1]
                            triangles[write, side] = point_number(
                                cursor, bases, masks, starts, step & 3, k + (step >> 2), slot
                            )
                        sides[write, 0], sides[write, 1] = label, NONE
                        write += 1


@njit(nogil=True, cache=True)
def name_points(masks, starts, names):
    """Write the slot of every point, (P,) int8."""
    for base in range(len(masks)):
        mask, point, slot = masks[base], starts[base], 0
        while mask:
            if mask & 1:
                names[point] = slot
                point += 1
            mask >>= 1
            slot += 1


@njit(nogil=True, cache=True)
def add_volumes(points, triangles, sides, scale, volumes, thread, threads):
    """Add six times the volume of every label in whole parts, `HIGH` and `LOW`: volumes (threads, labels, 2) int64."""
    count = len(triangles)
    for t in range(count * thread // threads, count * (thread + 1) // threads):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, ay, az = points[a, 0] * scale[0], points[a, 1] * scale[1], points[a, 2] * scale[2]
        bx, by, bz = points[b, 0] * scale[0], points[b, 1] * scale[1], points[b, 2] * scale[2]
        cx, cy, cz = points[c, 0] * scale[0], points[c, 1] * scale[1], points[c, 2] * scale[2]
        six = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        whole = np.rint(six * HIGH)
        high, low = np.int64(whole), np.int64(np.rint((six * HIGH - whole) * LOW))
        behind, before = sides[t, 0], sides[t, 1]
        volumes[thread, behind, 0] += high
        volumes[thread, behind, 1] += low
        if before != NONE:
            volumes[thread, before, 0] -= high
            volumes[thread, before, 1] -= low


@njit(nogil=True, cache=True)
def sample_triangles(bits, triangles, stride, sample):
    """List one of `stride` triangles, by the place of their first point, whose bits are (P, 3) uint32; count them."""
    count = 0
    for t in range(len(triangles)):
        point = triangles[t, 0]
        if place_hash(bits[point, 0], bits[point, 1], bits[point, 2]) % stride == 0 and count < len(sample):
            sample[count] = t
            count += 1
    return count
