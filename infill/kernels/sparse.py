"""What `infill.phasefield.sparse` does to bricks, compiled.

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

    surround    fills six arrays of equal length, in which cell t finds its neighbours at t: the brick between the
                planes of its neighbours along i (`tall`), and four copies shifted by a row or a cell (`left`,
                `right`, `before`, `after`) with the neighbours' faces inserted at their ends
    advanced    is one loop over 1024 cells without a branch: vector code
    emit        copies the six faces, and notes for each whether it is +1 or -1 throughout (`flat`)

A brick of one value (`uniform`) between neighbours of that value is a fixed point and is left out. A brick that is not
kept starts to be kept when a flat face next to it has a different value (`wanted`).
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.dense import advanced

BRICK = (8, 8, 16)  # cells; the last axis is contiguous
B0, B1, B2 = BRICK
CELLS = B0 * B1 * B2
PLANE = B1 * B2
FACE_I, FACE_J, FACE_K = B1 * B2, B0 * B2, B0 * B1
# Where the faces begin in their copy: low and high along i, j, k.
SECOND, THIRD = 2 * FACE_I, 2 * (FACE_I + FACE_J)
FACES = THIRD + 2 * FACE_K

# What the lattice holds for a brick that is not kept.
VOID_BRICK, SOLID_BRICK, OUTSIDE = -1, -2, -3
CHUNK = 32  # bricks that a thread takes at a time, mostly neighbours; with their data, 160 to 256 KiB
MIXED, OUTER = 0, -3  # states of a brick: containing both phases, and without a cell of the grid


@njit(inline="always", cache=True)
def uniform_value(face, bits, at, size):
    """Return +1 or -1 if all values of a face are equal to it, else 0; `bits` are the values viewed as integers."""
    first = bits[at]
    others = np.int32(0)
    for t in range(size):
        others |= bits[at + t] ^ first
    if others != 0 or abs(face[at]) != 1:
        return 0
    return 1 if face[at] > 0 else -1


@njit(cache=True)
def emit(brick, faces, flat):
    """Copy the six faces of a brick, and note which of them are +1 or -1 throughout."""
    bits = faces.view(np.int32)
    for up in range(2):
        at, to = (CELLS - PLANE) * up, FACE_I * up
        for t in range(FACE_I):
            faces[to + t] = brick[at + t]
        flat[up] = uniform_value(faces, bits, to, FACE_I)
        at, to = (PLANE - B2) * up, SECOND + FACE_J * up
        for i in range(B0):
            for k in range(B2):
                faces[to + i * B2 + k] = brick[at + i * PLANE + k]
        flat[2 + up] = uniform_value(faces, bits, to, FACE_J)
        at, to = (B2 - 1) * up, THIRD + FACE_K * up
        for t in range(FACE_K):
            faces[to + t] = brick[at + t * B2]
        flat[4 + up] = uniform_value(faces, bits, to, FACE_K)


@njit(nogil=True, cache=True)
def emit_all(bricks, faces, flat, count, thread, threads):
    """Copy the faces of all bricks."""
    for s in range(thread, count, threads):
        emit(bricks[s], faces[s], flat[s])


@njit(cache=True)
def place_beside(place, side):
    """Return the place next to a brick: low and high along i, j, k."""
    a, b, c = place[0], place[1], place[2]
    way = 1 if side % 2 else -1
    if side < 2:
        return a + way, b, c
    return (a, b + way, c) if side < 4 else (a, b, c + way)


@njit(cache=True)
def find_neighbours(slots, where, beside, first, count):
    """Set what lies next to the bricks from `first` on, and that they lie next to those."""
    for s in range(first, count):
        for side in range(6):
            a, b, c = place_beside(where[s], side)
            inside = 0 <= a < slots.shape[0] and 0 <= b < slots.shape[1] and 0 <= c < slots.shape[2]
            other = slots[a, b, c] if inside else OUTSIDE
            beside[s, side] = other
            if other >= 0:
                beside[other, side ^ 1] = s


@njit(cache=True)
def wanted(slots, where, beside, flat, count, found):
    """Set `found` to the places next to faces whose value differs from theirs, each once; return how many there are."""
    many = 0
    for s in range(count):
        for side in range(6):
            other = beside[s, side]
            if other != VOID_BRICK and other != SOLID_BRICK:
                continue
            if flat[s, side] == (1 if other == SOLID_BRICK else -1):
                continue
            a, b, c = place_beside(where[s], side)
            if slots[a, b, c] == other:
                slots[a, b, c] = other - 10  # already found
                found[many, 0], found[many, 1], found[many, 2] = a, b, c
                many += 1
    for n in range(many):
        slots[found[n, 0], found[n, 1], found[n, 2]] += 10
    return many


@njit(nogil=True, cache=True)
def fill(phi, held, flat, next_flat, uniform, first, count, thread, threads):
    """Set the bricks from `first` on to the value they are uniform in; nobody reads faces that are flat."""
    for s in range(first + thread, count, threads):
        value = uniform[s]
        for t in range(CELLS):
            phi[s, t] = value
            held[s, t] = value
        for side in range(6):
            flat[s, side] = value
            next_flat[s, side] = value


@njit(inline="always", cache=True)
def unmoved(value, beside, flat):
    """Return whether a brick of one value has only neighbours of that value."""
    for side in range(6):
        other = beside[side]
        if other >= 0:
            if flat[other, side ^ 1] != value:
                return False
        elif other != OUTSIDE and value != (1 if other == SOLID_BRICK else -1):
            return False
    return True


@njit(nogil=True, cache=True, error_model="numpy")
def step(
    phi,
    held,
    faces,
    next_faces,
    flat,
    next_flat,
    uniform,
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
    tall = np.empty(CELLS + 2 * PLANE, dtype=np.float32)
    left, right, before, after = (
        np.empty(CELLS, dtype=np.float32),
        np.empty(CELLS, dtype=np.float32),
        np.empty(CELLS, dtype=np.float32),
        np.empty(CELLS, dtype=np.float32),
    )
    for chunk in range(thread * CHUNK, count, threads * CHUNK):
        for s in range(chunk, min(chunk + CHUNK, count)):
            if uniform[s] != 0:
                if unmoved(uniform[s], beside[s], flat):
                    continue
                uniform[s] = 0
            own, data = phi[s], held[s]
            surround(own, faces, flat, beside[s], tall, left, right, before, after)
            if domain is not None:  # decided at compile time
                step_masked(own, data, tall, left, right, before, after, domain, where[s], numbers)
            else:
                for t in range(CELLS):
                    own[t] = advanced(
                        tall[t + PLANE],
                        tall[t],
                        tall[t + 2 * PLANE],
                        left[t],
                        right[t],
                        before[t],
                        after[t],
                        np.float32(data[t]),
                        numbers,
                    )
            repeat_edges(own, where[s], shape)
            emit(own, next_faces[s], next_flat[s])


@njit(cache=True)
def surround(own, faces, flat, beside, tall, left, right, before, after):
    """Set the six neighbours of every cell: the brick between two planes, and four shifted copies."""
    for t in range(CELLS):
        tall[t + PLANE] = own[t]
    for t in range(CELLS - B2):
        left[t + B2] = own[t]
    for t in range(CELLS - B2):
        right[t] = own[t + B2]
    for t in range(CELLS - 1):
        before[t + 1] = own[t]
    for t in range(CELLS - 1):
        after[t] = own[t + 1]
    for up in range(2):
        other = seen(beside[up], flat, up)
        at, to, edge = FACE_I * (1 - up), (CELLS + PLANE) * up, (CELLS - PLANE) * up
        if other >= 0:
            face = faces[other]
            for t in range(PLANE):
                tall[to + t] = face[at + t]
        else:
            for t in range(PLANE):
                tall[to + t] = beyond(other, own[edge + t])
        other = seen(beside[2 + up], flat, 2 + up)
        at, to = SECOND + FACE_J * (1 - up), (PLANE - B2) * up
        shifted = right if up else left
        for i in range(B0):
            if other >= 0:
                face = faces[other]
                for k in range(B2):
                    shifted[to + i * PLANE + k] = face[at + i * B2 + k]
            else:
                for k in range(B2):
                    shifted[to + i * PLANE + k] = beyond(other, own[to + i * PLANE + k])
        other = seen(beside[4 + up], flat, 4 + up)
        at, to = THIRD + FACE_K * (1 - up), (B2 - 1) * up
        shifted = after if up else before
        if other >= 0:
            face = faces[other]
            for t in range(FACE_K):
                shifted[to + t * B2] = face[at + t]
        else:
            for t in range(FACE_K):
                shifted[to + t * B2] = beyond(other, own[to + t * B2])


@njit(inline="always", cache=True)
def seen(other, flat, side):
    """Return the brick next to a face, or the stand-in for it if its own face there has one value."""
    if other < 0 or flat[other, side ^ 1] == 0:
        return other
    return SOLID_BRICK if flat[other, side ^ 1] == 1 else VOID_BRICK


@njit(inline="always", cache=True)
def beyond(other, own):
    """Return the value next to a face where no brick is kept: beyond the grid, it is the face's own."""
    if other == OUTSIDE:
        return own
    return np.float32(1) if other == SOLID_BRICK else np.float32(-1)


@njit(cache=True, error_model="numpy")
def step_masked(own, data, tall, left, right, before, after, domain, where, numbers):
    """Do one step of the cells in the domain; a neighbour outside it has the cell's own value."""
    n0, n1, n2 = domain.shape
    for t in range(CELLS):
        x = where[0] * B0 - 1 + t // PLANE
        y = where[1] * B1 - 1 + t // B2 % B1
        z = where[2] * B2 - 1 + t % B2
        if x < 0 or y < 0 or z < 0 or x >= n0 or y >= n1 or z >= n2 or not domain[x, y, z]:
            continue
        c = tall[t + PLANE]
        own[t] = advanced(
            c,
            tall[t] if domain[max(x - 1, 0), y, z] else c,
            tall[t + 2 * PLANE] if domain[min(x + 1, n0 - 1), y, z] else c,
            left[t] if domain[x, max(y - 1, 0), z] else c,
            right[t] if domain[x, min(y + 1, n1 - 1), z] else c,
            before[t] if domain[x, y, max(z - 1, 0)] else c,
            after[t] if domain[x, y, min(z + 1, n2 - 1)] else c,
            np.float32(data[t]),
            numbers,
        )


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
