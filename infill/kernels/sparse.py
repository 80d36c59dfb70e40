"""Loops of `infill.phasefield.sparse` over bricks, compiled.

A brick is (8, 8, 16) cells, flat: cell (i, j, k) is number (i 8 + j) 16 + k.

                 j                 a row: 16 cells along k, one vector of AVX-512
                /                  a plane: 8 rows of one i, 128 cells
        +------------+             a brick: 8 planes, 1024 cells, 4 KiB of float32
       /            /|
      /            / |
     +------------+  |             +-- faces, copied: low and high along i (2 x 128), j (2 x 128), k (2 x 64)
     |            |  +
   i |   8 x 8    | /              slots, the lattice of bricks: the number of a kept brick, or
     |            |/               VOID_BRICK, SOLID_BRICK (one value throughout) or OUTSIDE (no cell of the grid)
     +------------+
          k: 16

A step goes through the bricks in any order and on any thread. Each is stepped in place, so its neighbours may not
read its cells, which may be old or new; they read the copy of its faces from before the step (`faces`), and
the faces after it go to a second copy (`next_faces`). The two are swapped when all bricks are done.

How one brick is stepped:

    moving      the rows, of 64, that may change, as a number of 64 bits
    surround    copies the brick and its neighbours' faces to where every cell finds its six neighbours (`wide`)
    advanced    is a loop over the sixteen cells of a row that may change: vector code
    emit        copies the six faces, and notes which rows and faces are +1 or -1 throughout (`rows`, `flat`)

A row of one value (+1 or -1, in the data as well) among rows of that value is a fixed point to the last bit: it is
skipped, and so is a brick where that holds for all rows. Faces of one value are not copied, as they are never read.
A brick that is not kept starts to be kept when a flat face next to it has a different value (`find_missing_bricks`).

    rows        (n, 6) uint64: the rows that are +1 throughout, those that are -1 throughout; of the low face along k,
                a cell of each row, those that are +1 and those that are -1; the same of the high face. Bit i 8 + j.

    wide        i: 10 planes of 240      j: 10 rows of 24      k: 7 unused, one before, 16 cells, and the one after,
                                                                  which is the first unused one of the next row
"""
# mypy: disable-error-code="no-untyped-def, no-untyped-call, call-arg"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from infill.kernels.compiling import njit
from infill.kernels.dense import advance_cell
from infill.kernels.lanes import copy, lanes_of, load_lanes, mask_equal, same_lanes, spread, store_lanes
from infill.kernels.rows import copy_row

BRICK = (8, 8, 16)  # cells; the last axis is contiguous
B0, B1, B2 = BRICK
CELLS = B0 * B1 * B2
PLANE = B1 * B2
FACE_I, FACE_J, FACE_K = B1 * B2, B0 * B2, B0 * B1
# Where the faces begin in their copy: low and high along i, j, k.
SECOND, THIRD = 2 * FACE_I, 2 * (FACE_I + FACE_J)
FACES = THIRD + 2 * FACE_K

# Slots of the lattice for bricks that are not kept.
VOID_BRICK, SOLID_BRICK, OUTSIDE = -1, -2, -3
CHUNK = 32  # bricks that a thread takes at a time, mostly neighbours; with their data, 160 to 256 KiB
ROWS = B0 * B1
MASKS = 6
ALL, NONE = np.uint64(2**64 - 1), np.uint64(0)  # rows
FIRST_I, FIRST_J = np.uint64(0xFF), np.uint64(0x0101010101010101)
LAST_I, LAST_J = np.uint64(0xFF << 56), np.uint64(0x8080808080808080)
STEP_I, STEP_J = np.uint64(B1), np.uint64(1)  # bits from a row to the next one along i and along j
BACK_I, BACK_J = np.uint64(56), np.uint64(7)  # and from the last one to the first
FULL_ROW = np.uint16(0xFFFF)
WIDE_J, WIDE_I = 24, 240
ORIGIN = WIDE_I + WIDE_J + 8  # where the first cell of a brick lies in `wide`
WIDE = (B0 + 2) * WIDE_I + 8
MIXED, OUTER = 0, -3  # states of a brick: containing both phases, and without a cell of the grid


@njit(inline="always", cache=True)
def bit(row):
    """Return the number in which one row is set."""
    return np.uint64(1) << np.uint64(row)


@njit(from_python=False, cache=True)
def note_rows(brick, moving, rows):
    """Find the rows in `movable_rows` that are +1 or -1 throughout."""
    plus, minus = rows[0] & ~moving, rows[1] & ~moving
    for row in range(ROWS):
        if moving & bit(row):
            value = brick[row * B2]
            if abs(value) == 1 and mask_equal(brick, row * B2, value) == FULL_ROW:
                if value > 0:
                    plus |= bit(row)
                else:
                    minus |= bit(row)
    rows[0], rows[1] = plus, minus


@njit(inline="always", cache=True)
def common_value(plus, minus, part):
    """Return +1 or -1 if all rows of a part have that value, else 0."""
    if plus & part == part:
        return 1
    return -1 if minus & part == part else 0


@njit(cache=True)
def update_faces(brick, faces, flat, rows, moving):
    """Update the notes on the rows in `movable_rows` and on faces of +1 or -1 throughout; copy the other faces."""
    note_rows(brick, moving, rows)
    for up in range(2):
        flat[up] = common_value(rows[0], rows[1], LAST_I if up else FIRST_I)
        if flat[up] == 0:
            at, to = (CELLS - PLANE) * up, FACE_I * up
            for j in range(B1):
                copy(faces, to + j * B2, brick, at + j * B2)
        flat[2 + up] = common_value(rows[0], rows[1], LAST_J if up else FIRST_J)
        if flat[2 + up] == 0:
            at, to = (PLANE - B2) * up, SECOND + FACE_J * up
            for i in range(B0):
                copy(faces, to + i * B2, brick, at + i * PLANE)
        if rows[0] == ALL or rows[1] == ALL:
            rows[2 + 2 * up], rows[3 + 2 * up] = rows[0], rows[1]
        else:
            at, to = (B2 - 1) * up, THIRD + FACE_K * up
            for t in range(FACE_K):
                faces[to + t] = brick[at + t * B2]
            plus, minus = NONE, NONE
            for part in range(FACE_K // B2):
                shift = np.uint64(part * B2)
                plus |= np.uint64(mask_equal(faces, to + part * B2, np.float32(1))) << shift
                minus |= np.uint64(mask_equal(faces, to + part * B2, np.float32(-1))) << shift
            rows[2 + 2 * up], rows[3 + 2 * up] = plus, minus
        flat[4 + up] = common_value(rows[2 + 2 * up], rows[3 + 2 * up], ALL)


@njit(nogil=True, cache=True)
def update_all_faces(bricks, data, copied, faces, flat, rows, next_rows, still, count, thread, threads):
    """Copy the faces of all bricks, and note which of their rows, and of the rows of their data, have one value.

    If `copied`, their values become those of their data.
    """
    for s in range(thread, count, threads):
        if copied:
            brick, datum = bricks[s], data[s]
            for t in range(CELLS):
                brick[t] = datum[t]
        update_faces(bricks[s], faces[s], flat[s], rows[s], ALL)
        copy_row(next_rows[s], rows[s])
        note_rows(data[s], ALL, still[s])


@njit(from_python=False, cache=True)
def place_beside(place, side):
    """Return the place of the brick at a side of another; sides 0 to 5 are low and high along i, j, k."""
    a, b, c = place[0], place[1], place[2]
    way = 1 if side % 2 else -1
    if side < 2:
        return a + way, b, c
    return (a, b + way, c) if side < 4 else (a, b, c + way)


@njit(cache=True)
def find_neighbours(slots, where, beside, begin, count):
    """Set the neighbours of the bricks from `begin` on, in both directions."""
    for s in range(begin, count):
        for side in range(6):
            a, b, c = place_beside(where[s], side)
            inside = 0 <= a < slots.shape[0] and 0 <= b < slots.shape[1] and 0 <= c < slots.shape[2]
            neighbour = slots[a, b, c] if inside else OUTSIDE
            beside[s, side] = neighbour
            if neighbour >= 0:
                beside[neighbour, side ^ 1] = s


@njit(cache=True)
def find_missing_bricks(slots, where, beside, flat, count, new_places):
    """Set `new_places` to the places next to faces whose value differs from theirs, each once; return their number."""
    place_count = 0
    for s in range(count):
        for side in range(6):
            neighbour = beside[s, side]
            if neighbour != VOID_BRICK and neighbour != SOLID_BRICK:
                continue
            if flat[s, side] == (1 if neighbour == SOLID_BRICK else -1):
                continue
            a, b, c = place_beside(where[s], side)
            if slots[a, b, c] == neighbour:
                slots[a, b, c] = neighbour - 10  # already found
                new_places[place_count, 0], new_places[place_count, 1], new_places[place_count, 2] = a, b, c
                place_count += 1
    for n in range(place_count):
        slots[new_places[n, 0], new_places[n, 1], new_places[n, 2]] += 10
    return place_count


@njit(nogil=True, cache=True)
def fill_bricks(phi, data, flat, next_flat, rows, next_rows, still, values, first, count, thread, threads):
    """Set the bricks from `first` on to one value each; flat faces are not written, since they are never read."""
    for s in range(first + thread, count, threads):
        value = values[s - first]
        for t in range(CELLS):
            phi[s, t] = value
            data[s, t] = value
        for side in range(6):
            flat[s, side] = value
            next_flat[s, side] = value
            rows[s, side] = next_rows[s, side] = ALL if (value > 0) == (side % 2 == 0) else NONE
        still[s, 0], still[s, 1] = rows[s, 0], rows[s, 1]


@njit(inline="always", cache=True)
def rows_beside(neighbour, rows, column):
    """Return a column of the notes on the rows next to a brick, +1 and -1 alternately; beyond the grid, all."""
    if neighbour >= 0:
        return rows[neighbour, column]
    if neighbour == OUTSIDE:
        return ALL
    return ALL if (neighbour == SOLID_BRICK) == (column % 2 == 0) else NONE


@njit(from_python=False, cache=True)
def movable_rows(s, rows, still, beside):
    """Return the rows of a brick that may change: all except still rows of one value among cells of that value."""
    movable = ALL
    for sign in range(2):
        uniform_rows = rows[s, sign]
        same = uniform_rows & still[s, sign]
        if same == NONE:
            continue
        same &= (uniform_rows << STEP_I) | (rows_beside(beside[0], rows, sign) >> BACK_I)
        same &= (uniform_rows >> STEP_I) | (rows_beside(beside[1], rows, sign) << BACK_I)
        same &= ((uniform_rows << STEP_J) & ~FIRST_J) | ((rows_beside(beside[2], rows, sign) >> BACK_J) & FIRST_J)
        same &= ((uniform_rows >> STEP_J) & ~LAST_J) | ((rows_beside(beside[3], rows, sign) << BACK_J) & LAST_J)
        same &= rows_beside(beside[4], rows, 4 + sign) & rows_beside(beside[5], rows, 2 + sign)
        movable &= ~same
    return movable


@intrinsic
def advance_row(context, own, data, at, wide, c, numbers):  # noqa: ARG001
    """Set sixteen cells of a brick to the result of `advance_cell`; cell `c` of `wide` is the first of them."""
    formula = lanes_of(advance_cell)

    def code(context, builder, signature, arguments):  # noqa: ANN202
        own_kind, data_kind, _, wide_kind, *_ = signature.args
        out, data_array, begin, around, middle, numbers_tuple = arguments

        def cells(step):  # noqa: ANN202
            return load_lanes(context, builder, wide_kind, around, builder.add(middle, middle.type(step)))

        row = [cells(step) for step in (0, -WIDE_I, WIDE_I, -WIDE_J, WIDE_J, -1, 1)]
        row.append(load_lanes(context, builder, data_kind, data_array, begin))
        weights = [same_lanes(builder, each) for each in cgutils.unpack_tuple(builder, numbers_tuple)]
        store_lanes(context, builder, own_kind, out, begin, formula(*row, weights))
        return context.get_dummy_value()

    return types.void(own, data, types.int64, wide, types.int64, numbers), code


@njit(nogil=True, cache=True, error_model="numpy")
def step(
    phi,
    data_bricks,
    faces,
    next_faces,
    flat,
    next_flat,
    rows,
    next_rows,
    still,
    beside,
    where,
    domain,
    count,
    numbers,
    shape,
    thread,
    threads,
):
    """Do one step of all bricks in place; read neighbours' faces from `faces`, write the new ones to `next_faces`."""
    wide = np.zeros(WIDE, dtype=np.float32)
    for chunk in range(thread * CHUNK, count, threads * CHUNK):
        for s in range(chunk, min(chunk + CHUNK, count)):
            edge = at_edge(where[s], shape)
            changing = ALL if edge else movable_rows(s, rows, still, beside[s])
            copy_row(next_rows[s], rows[s])
            if changing == NONE:
                copy_row(next_flat[s], flat[s])
                continue
            brick, data = phi[s], data_bricks[s]
            copy_surroundings(brick, faces, flat, beside[s], wide)
            if domain is not None:  # decided at compile time
                step_masked(brick, data, wide, domain, where[s], numbers)
                changing = ALL
            else:
                for i in range(B0):
                    for j in range(B1):
                        if not changing & bit(i * B1 + j):
                            continue
                        at, c = (i * B1 + j) * B2, ORIGIN + i * WIDE_I + j * WIDE_J
                        advance_row(brick, data, at, wide, c, numbers)
            if edge:
                repeat_edges(brick, where[s], shape)
            update_faces(brick, next_faces[s], next_flat[s], next_rows[s], changing)


@njit(from_python=False, cache=True)
def copy_surroundings(brick, faces, flat, beside, wide):
    """Copy a brick to `wide`, with its neighbours' faces: +-1 for bricks that are not kept, its own beyond the grid."""
    for i in range(B0):
        for j in range(B1):
            copy(wide, ORIGIN + i * WIDE_I + j * WIDE_J, brick, (i * B1 + j) * B2)
    for side in range(6):
        neighbour = brick_or_value(beside[side], flat, side)
        up = side % 2
        if side < 2:
            put, step, line_count = ORIGIN - WIDE_I + (B0 + 1) * WIDE_I * up, WIDE_J, B1
            at, edge, next_edge = FACE_I * (1 - up), (CELLS - PLANE) * up, B2
        elif side < 4:
            put, step, line_count = ORIGIN - WIDE_J + (B1 + 1) * WIDE_J * up, WIDE_I, B0
            at, edge, next_edge = SECOND + FACE_J * (1 - up), (PLANE - B2) * up, PLANE
        else:
            put, at, edge = ORIGIN - 1 + (B2 + 1) * up, THIRD + FACE_K * (1 - up), (B2 - 1) * up
            if neighbour >= 0:
                face = faces[neighbour]
                for i in range(B0):
                    for j in range(B1):
                        wide[put + i * WIDE_I + j * WIDE_J] = face[at + i * B1 + j]
            else:
                for i in range(B0):
                    for j in range(B1):
                        wide[put + i * WIDE_I + j * WIDE_J] = value_beyond(neighbour, brick[edge + (i * B1 + j) * B2])
            continue
        for n in range(line_count):
            if neighbour >= 0:
                copy(wide, put + n * step, faces[neighbour], at + n * B2)
            elif neighbour == OUTSIDE:
                copy(wide, put + n * step, brick, edge + n * next_edge)
            else:
                spread(wide, put + n * step, value_beyond(neighbour, np.float32(0)))


@njit(inline="always", cache=True)
def brick_or_value(neighbour, flat, side):
    """Return the brick next to a face, or the slot that replaces it if its own face there has one value."""
    if neighbour < 0 or flat[neighbour, side ^ 1] == 0:
        return neighbour
    return SOLID_BRICK if flat[neighbour, side ^ 1] == 1 else VOID_BRICK


@njit(inline="always", cache=True)
def value_beyond(neighbour, face_value):
    """Return the value next to a face without a kept brick; beyond the grid, it is the face's own."""
    if neighbour == OUTSIDE:
        return face_value
    return np.float32(1) if neighbour == SOLID_BRICK else np.float32(-1)


@njit(from_python=False, cache=True, error_model="numpy")
def step_masked(brick, data, wide, domain, where, numbers):
    """Do one step of the cells in the domain; a neighbour outside it has the cell's own value."""
    n0, n1, n2 = domain.shape
    for t in range(CELLS):
        i, j, k = t // PLANE, t // B2 % B1, t % B2
        x, y, z = where[0] * B0 - 1 + i, where[1] * B1 - 1 + j, where[2] * B2 - 1 + k
        if x < 0 or y < 0 or z < 0 or x >= n0 or y >= n1 or z >= n2 or not domain[x, y, z]:
            continue
        at = ORIGIN + i * WIDE_I + j * WIDE_J + k
        c = wide[at]
        brick[t] = advance_cell(
            c,
            wide[at - WIDE_I] if domain[max(x - 1, 0), y, z] else c,
            wide[at + WIDE_I] if domain[min(x + 1, n0 - 1), y, z] else c,
            wide[at - WIDE_J] if domain[x, max(y - 1, 0), z] else c,
            wide[at + WIDE_J] if domain[x, min(y + 1, n1 - 1), z] else c,
            wide[at - 1] if domain[x, y, max(z - 1, 0)] else c,
            wide[at + 1] if domain[x, y, min(z + 1, n2 - 1)] else c,
            np.float32(data[t]),
            numbers,
        )


@njit(inline="always", cache=True)
def at_edge(where, shape):
    """Return True if a brick has cells beyond the grid."""
    low = where[0] == 0 or where[1] == 0 or where[2] == 0
    beyond_i, beyond_j = (where[0] + 1) * B0 > shape[0] + 1, (where[1] + 1) * B1 > shape[1] + 1
    return low or beyond_i or beyond_j or (where[2] + 1) * B2 > shape[2] + 1


@njit(cache=True)
def repeat_edges(brick, where, shape):
    """Give cells beyond the grid the values of the cells at its edge."""
    i0, i1 = max(0, 1 - where[0] * B0), min(B0, shape[0] + 1 - where[0] * B0)
    j0, j1 = max(0, 1 - where[1] * B1), min(B1, shape[1] + 1 - where[1] * B1)
    k0, k1 = max(0, 1 - where[2] * B2), min(B2, shape[2] + 1 - where[2] * B2)
    if i0 == 0 and j0 == 0 and k0 == 0 and i1 == B0 and j1 == B1 and k1 == B2:
        return
    for i in range(B0):
        x = min(max(i, i0), i1 - 1)
        for j in range(B1):
            y = min(max(j, j0), j1 - 1)
            for k in range(B2):
                brick[(i * B1 + j) * B2 + k] = brick[(x * B1 + y) * B2 + min(max(k, k0), k1 - 1)]
