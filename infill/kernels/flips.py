"""Cells that change sign one by one, compiled: see `infill.inspection.sign_changes`.

The 27 cells around one are numbered 9 (i + 1) + 3 (j + 1) + k + 1; number 13 is the cell itself.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.sparse import B0, B1, B2, SOLID_BRICK

AROUND, MIDDLE = 27, 13


@njit(cache=True)
def is_set(slots, bits, x, y, z):
    """Return True if a cell of the lattice is solid."""
    p, q, r = x // B0, y // B1, z // B2
    if x < 0 or y < 0 or z < 0 or p >= slots.shape[0] or q >= slots.shape[1] or r >= slots.shape[2]:
        return False
    slot = slots[p, q, r]
    if slot < 0:
        return slot == SOLID_BRICK
    return (bits[slot, (x % B0) * B1 + y % B1] >> np.uint16(z % B2)) & np.uint16(1) != 0


@njit(from_python=False, cache=True)
def steps_apart(cell_a, cell_b):
    """Count the axes along which two of the 27 cells differ by one; return 4 if they differ by more."""
    steps = 0
    for size in (9, 3, 1):
        distance = abs(cell_a // size % 3 - cell_b // size % 3)
        if distance > 1:
            return 4
        steps += distance
    return steps


@njit(from_python=False, cache=True)
def parts_beside(cells, max_steps):
    """Count the parts of the set cells, of 27, that touch the middle; cells touch if at most `max_steps` apart."""
    seen, stack, count = np.zeros(AROUND, dtype=np.bool_), np.empty(AROUND, dtype=np.int64), 0
    for seed in range(AROUND):
        if not cells[seed] or seen[seed] or seed == MIDDLE or steps_apart(seed, np.int64(MIDDLE)) > max_steps:
            continue
        count += 1
        stack[0], depth = seed, 1
        seen[seed] = True
        while depth:
            depth -= 1
            at = stack[depth]
            for n in range(AROUND):
                if n != MIDDLE and cells[n] and not seen[n] and steps_apart(at, n) <= max_steps:
                    seen[n] = True
                    stack[depth] = n
                    depth += 1
    return count


@njit(makes_arrays=True, cache=True)
def simple(cells):
    """Return True if the middle of 27 cells may change sign without a change of connections.

    Solid touches by faces, void by faces and edges.
    """
    return parts_beside(cells, np.int64(1)) == 1 and parts_beside(~cells, np.int64(2)) == 1


@njit(nogil=True, cache=True)
def flip_simple(slots, bits, places):
    """Flip the cells (N, 3) of the lattice that are simple, until none is; return the number that remains."""
    cells = np.empty(AROUND, dtype=np.bool_)
    remaining = len(places)
    waiting = np.ones(remaining, dtype=np.bool_)
    going_on = True
    while going_on and remaining:
        going_on = False
        for n in range(len(places)):
            if not waiting[n]:
                continue
            x, y, z = places[n]
            for t in range(AROUND):
                cells[t] = is_set(slots, bits, x + t // 9 - 1, y + t // 3 % 3 - 1, z + t % 3 - 1)
            if simple(cells):
                bits[slots[x // B0, y // B1, z // B2], (x % B0) * B1 + y % B1] ^= np.uint16(1 << (z % B2))
                waiting[n] = False
                remaining -= 1
                going_on = True
    return remaining


@njit(nogil=True, cache=True)
def count_lonely(slots, bits, places):
    """Count the cells (N, 3) of the lattice without a solid cell among the 27 around them."""
    count = 0
    for n in range(len(places)):
        x, y, z = places[n]
        has_solid = False
        for t in range(AROUND):
            has_solid |= is_set(slots, bits, x + t // 9 - 1, y + t // 3 % 3 - 1, z + t % 3 - 1)
        count += not has_solid
    return count


@njit(nogil=True, cache=True)
def mark_faces_in(vertices, faces, spacing, slots, bits, is_inside, thread, threads):
    """Mark the triangles in cubes whose `bits` are set, by their lowest corners on the lattice."""
    for f in range(thread, len(faces), threads):
        a, b, c = faces[f]
        x = int(np.floor((vertices[a, 0] + vertices[b, 0] + vertices[c, 0]) / (3 * spacing[0]) + 0.5))
        y = int(np.floor((vertices[a, 1] + vertices[b, 1] + vertices[c, 1]) / (3 * spacing[1]) + 0.5))
        z = int(np.floor((vertices[a, 2] + vertices[b, 2] + vertices[c, 2]) / (3 * spacing[2]) + 0.5))
        slot = slots[x // B0, y // B1, z // B2]
        is_inside[f] = slot >= 0 and (bits[slot, (x % B0) * B1 + y % B1] >> np.uint16(z % B2)) & np.uint16(1) != 0


@njit(nogil=True, cache=True)
def mark_points_near(points, origin, turn, slots, bits, reach, is_near, thread, threads):
    """Mark the points for which a cube within reach is set, by its lowest corner on the lattice.

    Parameters
    ----------
    points : (N, 3) float64, mm
    origin, turn : (3,), (3, 3) float64
        The lower corner of the grid, and the rows that turn a distance from it into cells.
    slots : (m0, m1, m2) int32
    bits : (n, 64) uint16
    reach : float
        Cells along each axis.
    is_near : (N,) bool
    """
    size = (len(points) + threads - 1) // threads
    begin, end = np.empty(3, dtype=np.int64), np.empty(3, dtype=np.int64)
    cells = (slots.shape[0] * B0, slots.shape[1] * B1, slots.shape[2] * B2)
    for n in range(thread * size, min(len(points), (thread + 1) * size)):
        dx, dy, dz = points[n, 0] - origin[0], points[n, 1] - origin[1], points[n, 2] - origin[2]
        for axis in range(3):
            at = turn[axis, 0] * dx + turn[axis, 1] * dy + turn[axis, 2] * dz + 0.5
            begin[axis] = max(0, int(np.floor(at - reach)))
            end[axis] = min(cells[axis] - 1, int(np.floor(at + reach)))
        near = False
        for x in range(begin[0], end[0] + 1):
            for y in range(begin[1], end[1] + 1):
                for z in range(begin[2], end[2] + 1):
                    slot = slots[x // B0, y // B1, z // B2]
                    if slot >= 0:
                        near |= (bits[slot, (x % B0) * B1 + y % B1] >> np.uint16(z % B2)) & np.uint16(1) != 0
        is_near[n] = near
