"""Loops of `infill.isosurfaces.components` over rows of bits, compiled.

A row of a brick is sixteen bits, set where a cell is of the kind to label. Labels belong not to cells but to
runs of set bits, found by a few operations on the entire row:

    bits         0 1 1 1 0 0 1 0 1 1 0 0 0 0 1 1      k ->
    beginnings   0 1 0 0 0 0 1 0 1 0 0 0 0 0 1 0      bits & ~(bits shifted by one)
    run          . 0 0 0 . . 1 . 2 2 . . . . 3 3      beginnings up to here, counted, less one

The number of the run at cell k of a row is therefore `bricks` (runs in earlier bricks) + `starts` (in earlier rows) +
that count minus one: nothing is stored per cell. A brick with a single value is one node (`alone`).

Runs are joined as sets: see `infill.kernels.disjoint_sets`. Two adjacent rows are joined where both have bits set
(`own & theirs`), once for each stretch where they do; along k, a run continues in the next brick if the last bit here
and the first there are set. With `diagonal`, for void, rows one step away along two axes count too, as do bits one
place aside: cells that touch at an edge. Solid is joined by faces only, so where two solid cells touch at an edge, void
runs between them.
"""
# mypy: disable-error-code="no-untyped-def, call-arg"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.disjoint_sets import join
from infill.kernels.lanes import count_ones, lowest_bit
from infill.kernels.sparse import B0, B1, B2, CELLS, OUTSIDE, VOID_BRICK, place_beside
from infill.kernels.sparse_marching import FULL, ROWS, grid_cells_of_row

OUTSIDE_LATTICE = -9  # outside the lattice: neither solid nor void


@njit(cache=True)
def beginnings(bits):
    """Return the bits at which runs begin."""
    return np.uint16(bits & ~(bits << np.uint16(1)))


@njit(cache=True)
def run_length(bits, k):
    """Count the consecutive bits that are set from bit `k` on."""
    gaps = ~(np.int64(bits) >> k)
    return count_ones(((gaps & -gaps) - 1) & FULL)


@njit(nogil=True, cache=True)
def number_runs(bits, bricks, starts):
    """Assign numbers to runs, 1 up (0 is beyond the grid): the first of each brick, and that of each row in it."""
    count = np.int64(1)  # run 0 is everything beyond the grid
    for s in range(len(bits)):
        bricks[s] = count
        inner = 0
        for row in range(ROWS):
            starts[s, row] = inner
            inner += count_ones(beginnings(bits[s, row]))
        count += inner
    return count


@njit(from_python=False, cache=True)
def run_at(bits, bricks, starts, s, row, k):
    """Return the number of the run that contains cell `k` of a row."""
    upto = np.uint16((2 << k) - 1)
    return bricks[s] + starts[s, row] + count_ones(beginnings(bits[s, row]) & upto) - 1


@njit(from_python=False, cache=True)
def node_at(alone, slots, p, q, r, row, k, bits, bricks, starts):
    """Return the node of cell `k` of a row of the brick (p, q, r), or -1 if it is not of the kind to label."""
    slot = np.int64(slots[p, q, r])
    if slot < 0:
        return np.int64(alone[p, q, r])
    if not (bits[slot, row] >> np.uint16(k)) & np.uint16(1):
        return np.int64(-1)
    return np.int64(run_at(bits, bricks, starts, slot, row, k))


@njit(inline="always", cache=True)
def slot_in(slots, p, q, r):
    """Return the slot of the lattice at a place, OUTSIDE_LATTICE beyond its ends."""
    if p < 0 or q < 0 or r < 0 or p >= slots.shape[0] or q >= slots.shape[1] or r >= slots.shape[2]:
        return OUTSIDE_LATTICE
    return slots[p, q, r]


@njit(inline="always", cache=True)
def is_full(rows):
    """Return True if all cells of a brick are set."""
    common = np.uint16(FULL)
    for row in range(ROWS):
        common &= rows[row]
    return common == FULL


@njit(inline="always", cache=True)
def is_mixed(slots, full, p, q, r):
    """Return True if a brick is kept and has unset cells."""
    slot = slot_in(slots, p, q, r)
    return slot >= 0 and not full[slot]


@njit(from_python=False, nogil=True, cache=True)
def join_full(slots, where, bricks, alone, parent, full):
    """Join the runs of fully set bricks, and those bricks with one another and with bricks of one value."""
    for s in range(len(where)):
        if not full[s]:
            continue
        for row in range(1, ROWS):
            join(parent, bricks[s], bricks[s] + row)
        for side in range(6):
            p, q, r = place_beside(where[s], side)
            slot = slot_in(slots, p, q, r)
            if slot == OUTSIDE_LATTICE:
                continue
            if slot >= 0:
                if full[slot]:
                    join(parent, bricks[s], bricks[slot])
            elif alone[p, q, r] >= 0:
                join(parent, bricks[s], np.int64(alone[p, q, r]))


@njit(nogil=True, cache=True)
def join_runs(slots, where, bits, bricks, starts, alone, parent, diagonal):
    """Join all runs that touch by a face, or by an edge if `diagonal`, in all kept bricks."""
    m0, m1, m2 = slots.shape
    full = np.empty(len(where), dtype=np.bool_)
    for s in range(len(where)):
        full[s] = is_full(bits[s])
    join_full(slots, where, bricks, alone, parent, full)
    for s in range(len(where)):
        p, q, r = np.int64(where[s, 0]), np.int64(where[s, 1]), np.int64(where[s, 2])
        settled = full[s] and not diagonal
        open_k = is_mixed(slots, full, p, q, r - 1) or is_mixed(slots, full, p, q, r + 1)
        open_i, open_j = is_mixed(slots, full, p + 1, q, r), is_mixed(slots, full, p, q + 1, r)
        for row in range(ROWS):
            i, j = row // B1, row % B1
            row_bits = bits[s, row]
            if row_bits == 0 or (settled and not (open_k or (open_i and i == B0 - 1) or (open_j and j == B1 - 1))):
                continue
            # Along k, runs end at the brick boundary.
            for step in range(-1, 2, 2):
                c = r + step
                edge = B2 - 1 if step > 0 else 0
                if 0 <= c < m2 and (row_bits >> np.uint16(edge)) & np.uint16(1):
                    if step < 0 and slots[p, q, c] >= 0:
                        continue  # that brick looks ahead at this one
                    node = node_at(alone, slots, p, q, c, row, B2 - 1 - edge, bits, bricks, starts)
                    if node >= 0:
                        join(parent, run_at(bits, bricks, starts, s, row, edge), node)
            for di in range(-1, 2):
                for dj in range(-1, 2):
                    if (di == 0 and dj == 0) or (di != 0 and dj != 0 and not diagonal):
                        continue
                    ahead = di > 0 or (di == 0 and dj > 0)
                    x, y, a, b = i + di, j + dj, p, q
                    if x < 0 or x == B0:
                        a, x = a + di, x - di * B0
                    if y < 0 or y == B1:
                        b, y = b + dj, y - dj * B1
                    if a < 0 or b < 0 or a >= m0 or b >= m1:
                        continue
                    slot = np.int64(slots[a, b, r])
                    if slot < 0:
                        if alone[a, b, r] >= 0:
                            remaining = np.int64(beginnings(row_bits))
                            while remaining:
                                k = lowest_bit(remaining)
                                remaining &= remaining - 1
                                join(parent, run_at(bits, bricks, starts, s, row, k), np.int64(alone[a, b, r]))
                    elif ahead:  # the other brick never looks back at this one
                        theirs = bits[slot, x * B1 + y]
                        remaining = np.int64(beginnings(np.uint16(row_bits & theirs)))
                        while remaining:
                            k = lowest_bit(remaining)
                            remaining &= remaining - 1
                            join(
                                parent,
                                run_at(bits, bricks, starts, s, row, k),
                                run_at(bits, bricks, starts, slot, x * B1 + y, k),
                            )
                        if diagonal and (di == 0 or dj == 0):
                            for shift in range(-1, 2, 2):  # touching at an edge but not by a face
                                if shift > 0:
                                    own_next, theirs_next = row_bits >> np.uint16(1), theirs >> np.uint16(1)
                                else:
                                    own_next, theirs_next = row_bits << np.uint16(1), theirs << np.uint16(1)
                                remaining = np.int64(row_bits & theirs_next & ~theirs & ~own_next) & FULL
                                while remaining:
                                    k = lowest_bit(remaining)
                                    remaining &= remaining - 1
                                    join(
                                        parent,
                                        run_at(bits, bricks, starts, s, row, k),
                                        run_at(bits, bricks, starts, slot, x * B1 + y, k + shift),
                                    )
                    if diagonal and (di == 0 or dj == 0):  # at an edge, into the previous or next brick along k
                        for step in range(-1, 2, 2):
                            c = r + step
                            edge = B2 - 1 if step > 0 else 0
                            if 0 <= c < m2 and (row_bits >> np.uint16(edge)) & np.uint16(1):
                                node = node_at(alone, slots, a, b, c, x * B1 + y, B2 - 1 - edge, bits, bricks, starts)
                                if node >= 0:
                                    join(parent, run_at(bits, bricks, starts, s, row, edge), node)


@njit(nogil=True, cache=True)
def join_alone(alone, parent):
    """Join adjacent bricks of one value."""
    m0, m1, m2 = alone.shape
    for p in range(m0):
        for q in range(m1):
            for r in range(m2):
                node = alone[p, q, r]
                if node < 0:
                    continue
                if p + 1 < m0 and alone[p + 1, q, r] >= 0:
                    join(parent, np.int64(node), np.int64(alone[p + 1, q, r]))
                if q + 1 < m1 and alone[p, q + 1, r] >= 0:
                    join(parent, np.int64(node), np.int64(alone[p, q + 1, r]))
                if r + 1 < m2 and alone[p, q, r + 1] >= 0:
                    join(parent, np.int64(node), np.int64(alone[p, q, r + 1]))


@njit(nogil=True, cache=True)
def join_beyond(where, bits, bricks, starts, shape, parent):
    """Join every run of void that extends beyond the grid with the outside."""
    for s in range(len(where)):
        for row in range(ROWS):
            inside = grid_cells_of_row(where[s, 0], where[s, 1], where[s, 2], row, shape)
            remaining = np.int64(bits[s, row] & ~inside)
            while remaining:
                k = lowest_bit(remaining)
                remaining &= remaining - 1
                join(parent, np.int64(0), np.int64(run_at(bits, bricks, starts, s, row, k)))


@njit(nogil=True, cache=True)
def count_cells(where, bits, bricks, starts, shape, names, cells):
    """Add the cells of every run within the grid to the count of its component."""
    for s in range(len(where)):
        for row in range(ROWS):
            row_bits = bits[s, row] & grid_cells_of_row(where[s, 0], where[s, 1], where[s, 2], row, shape)
            remaining = np.int64(beginnings(row_bits))
            while remaining:
                k = lowest_bit(remaining)
                remaining &= remaining - 1
                cells[names[run_at(bits, bricks, starts, s, row, k)]] += run_length(row_bits, k)


@njit(nogil=True, cache=True)
def mark_runs(bits, bricks, starts, names, chosen, marked):
    """Mark the components that contain `chosen` cells."""
    for s in range(len(bits)):
        for row in range(ROWS):
            remaining = np.int64(beginnings(bits[s, row] & chosen[s, row]))
            while remaining:
                k = lowest_bit(remaining)
                remaining &= remaining - 1
                marked[names[run_at(bits, bricks, starts, s, row, k)]] = True


@njit(nogil=True, cache=True)
def overlaps(bits, bricks, starts, names, other_bits, other_bricks, other_starts, other_names):
    """Return (component, other component, cells) for every stretch of a row that lies in both."""
    count = 0
    for s in range(len(bits)):
        for row in range(ROWS):
            count += count_ones(beginnings(bits[s, row] & other_bits[s, row]))
    stretches = np.empty((count, 3), dtype=np.int64)
    count = 0
    for s in range(len(bits)):
        for row in range(ROWS):
            both = bits[s, row] & other_bits[s, row]
            remaining = np.int64(beginnings(both))
            while remaining:
                k = lowest_bit(remaining)
                remaining &= remaining - 1
                stretches[count, 0] = names[run_at(bits, bricks, starts, s, row, k)]
                stretches[count, 1] = other_names[run_at(other_bits, other_bricks, other_starts, s, row, k)]
                stretches[count, 2] = run_length(both, k)
                count += 1
    return stretches


@njit(from_python=False, nogil=True, cache=True)
def nearest_component(slots, x, y, z, bits, bricks, starts, alone, names, reach):
    """Return the component of a cell of the lattice, else the nearest along the axes within `reach` cells, else -1."""
    node = node_at(alone, slots, x // B0, y // B1, z // B2, (x % B0) * B1 + y % B1, z % B2, bits, bricks, starts)
    if node >= 0:
        return names[node]
    for distance in range(1, reach + 1):
        for side in range(6):
            way = distance if side % 2 else -distance
            a, b, c = x + way * (side < 2), y + way * (side // 2 == 1), z + way * (side > 3)
            if a < 0 or b < 0 or c < 0:
                continue
            p, q, r = a // B0, b // B1, c // B2
            if p >= slots.shape[0] or q >= slots.shape[1] or r >= slots.shape[2]:
                continue
            node = node_at(alone, slots, p, q, r, (a % B0) * B1 + b % B1, c % B2, bits, bricks, starts)
            if node >= 0:
                return names[node]
    return np.int32(-1)


@njit(nogil=True, cache=True)
def label_cells(places, slots, bits, bricks, starts, alone, names, reach, labels):
    """Set the nearest component for cells at places (N, 3) on the lattice of cells, -1 where none is within reach."""
    for n in range(len(places)):
        x, y, z = places[n]
        labels[n] = nearest_component(slots, x, y, z, bits, bricks, starts, alone, names, reach)


@njit(nogil=True, cache=True)
def label_bricks(values, where, slots, bits, bricks, starts, alone, names, reach, labels, thread, threads):
    """Set the nearest component along the axes for every cell of bricks; -1 where there is none, or phi is 1 or -1."""
    for s in range(thread, len(where), threads):
        p, q, r = where[s]
        for t in range(CELLS):
            labels[s, t] = -1
            if values[s, t] == 1 or values[s, t] == -1:
                continue
            x, y, z = p * B0 + t // (B1 * B2), q * B1 + t // B2 % B1, r * B2 + t % B2
            labels[s, t] = nearest_component(slots, x, y, z, bits, bricks, starts, alone, names, reach)


@njit(nogil=True, cache=True)
def lower_to_levels(values, labels, levels, common, out, thread, threads):
    """Subtract from every cell where phi is not 1 or -1 the level of its component, or `common` where it has none."""
    for s in range(thread, len(values), threads):
        for t in range(CELLS):
            value, component = values[s, t], labels[s, t]
            if value != 1 and value != -1:
                value -= levels[component] if component >= 0 else common
            out[s, t] = value


@njit(inline="always", cache=True)
def row_of_slot(slot, row, bits, kind):
    """Return the bits of a row of a slot of the lattice; a brick of one value is full if it is of `kind`."""
    if slot >= 0:
        return np.uint32(bits[slot, row])
    full = slot == kind or (slot == OUTSIDE and kind == VOID_BRICK)
    return np.uint32(FULL) if full else np.uint32(0)


@njit(nogil=True, cache=True)
def meet_or_spread(slots, where, bits, kind, meet, way, out, thread, threads):
    """Set cells where all (`meet`) or any of 2 x 2 x 2 cells are set: from the cell on (`way` 1), or up to it (-1)."""
    pairs = np.empty((B0 + 1, B1 + 1), dtype=np.uint32)  # of cells along k, of the brick's rows and the next ones
    one_bit, last_bit = np.uint32(1), np.uint32(B2 - 1)
    behind = 1 if way < 0 else 0
    for s in range(thread, len(where), threads):
        p, q, r = where[s]
        for side in range(4):
            up, right = side & 1, side >> 1
            slot = slot_in(slots, p + way * up, q + way * right, r)
            next_slot = slot_in(slots, p + way * up, q + way * right, r + way)
            for x in range(1 if up else B0):
                i = (B0 - 1) * behind if up else x
                u = B0 * (1 - behind) if up else x + behind
                for y in range(1 if right else B1):
                    j = (B1 - 1) * behind if right else y
                    v = B1 * (1 - behind) if right else y + behind
                    row_bits, next_bits = (
                        row_of_slot(slot, i * B1 + j, bits, kind),
                        row_of_slot(next_slot, i * B1 + j, bits, kind),
                    )
                    next_to = (
                        row_bits << one_bit | next_bits >> last_bit
                        if behind
                        else row_bits >> one_bit | (next_bits & one_bit) << last_bit
                    )
                    pairs[u, v] = row_bits & next_to if meet else row_bits | next_to
        for i in range(B0):
            for j in range(B1):
                a, b, c, d = pairs[i, j], pairs[i + 1, j], pairs[i, j + 1], pairs[i + 1, j + 1]
                out[s, i * B1 + j] = np.uint16((a & b & c & d if meet else a | b | c | d) & np.uint32(FULL))


@njit(nogil=True, cache=True)
def erase(values, where, bits, bricks, starts, names, marked, void):
    """Make the cells of marked components void in `values`, apart from bricks that are solid throughout."""
    for s in range(len(where)):
        for row in range(ROWS):
            remaining = np.int64(bits[s, row])
            while remaining:
                k = lowest_bit(remaining)
                remaining &= remaining - 1
                if marked[names[run_at(bits, bricks, starts, s, row, k)]]:
                    x, y = where[s, 0] * B0 + row // B1 - 1, where[s, 1] * B1 + row % B1 - 1
                    values[x, y, where[s, 2] * B2 + k - 1] = void
