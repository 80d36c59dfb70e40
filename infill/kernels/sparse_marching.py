"""Loops of `infill.isosurfaces.sparse_marching` over bricks, compiled.

A row of sixteen cells along k is one number of sixteen bits, set where a cell is above the level. A row of cubes lies
between four rows of 17 cells each: the last cell is taken from the next brick. Bricks own the cubes whose lowest
corner they hold, and the edges that begin in their cells.

    c ─── d      a, b, c, d: rows (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1), seen from their ends
    │     │      cube k: their bits k and k + 1; its corner (x, y, z) has number x + 2 y + 4 z
    a ─── b      crossed edges: a ^ b along i, a ^ c along j, a ^ (a shifted by one) along k
                 crossed cubes: those whose eight bits are not all equal (`crossed_cubes`)

All sixteen are decided by a few operations; loops then visit only the set bits, from the lowest up (`lowest_bit`).

Vertices are numbered without a table of edges: those of a brick begin at `offsets`, those of a row and an axis at
`starts` after that, and within the row an edge is preceded by as many vertices as there are bits set below its own in
`masks`. So any cube finds the vertices on its twelve edges, including those of its neighbours, without synchronisation.

There are two passes: `count_output` counts the output of every brick, cumulative sums give its place, `write_surface`
writes. A cube's eight signs choose its triangles from a table of 256 (`infill.isosurfaces.sparse_marching.cube_table`);
where signs do not decide (`UNDECIDED`: a face with a saddle, or opposite corners), its corner values are returned.
"""
# mypy: disable-error-code="no-untyped-def, call-arg, var-annotated"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.lanes import count_ones, lowest_bit, mask_above
from infill.kernels.sparse import B0, B1, B2, OUTSIDE, SOLID_BRICK

ROWS = B0 * B1
UNDECIDED = -128  # in a table of triangles: the signs do not decide; the smallest int8, far from any count
FULL = (1 << B2) - 1  # all bits of a row
EDGES = 12  # of a cube
BLOCK = 4096  # faces whose volumes make one sum


@njit(nogil=True, cache=True)
def bits_above(values, where, level, shape, bits, thread, threads):
    """Set the bits of the cells above the level, in every row of every kept brick; cells beyond the grid have none."""
    for s in range(thread, len(values), threads):
        brick = values[s]
        for row in range(ROWS):
            row_bits = mask_above(brick, row * B2, level)
            bits[s, row] = row_bits & grid_cells_of_row(where[s, 0], where[s, 1], where[s, 2], row, shape)


@njit(inline="always", cache=True)
def grid_cells_of_row(p, q, r, row, shape):
    """Return the cells of a row of a brick that lie on the grid, as bits."""
    i, j = p * B0 + row // B1, q * B1 + row % B1
    if i < 1 or j < 1 or i > shape[0] or j > shape[1]:
        return np.uint16(0)
    row_bits = FULL
    if r == 0:
        row_bits &= ~1
    over = (r + 1) * B2 - (shape[2] + 1)  # cells after the last one
    if over > 0:
        row_bits = row_bits & (FULL >> over) if over < B2 else 0
    return np.uint16(row_bits)


@njit(inline="always", cache=True)
def slot_at(slots, p, q, r):
    """Return the slot of the lattice at a place, OUTSIDE beyond its upper end."""
    if p >= slots.shape[0] or q >= slots.shape[1] or r >= slots.shape[2]:
        return OUTSIDE
    return slots[p, q, r]


@njit(from_python=False, cache=True)
def rows_around(slots, p, q, r, bits, shape, rows):
    """Set the rows of a brick and the first ones after it, 17 cells each, (9, 9); return True if any two cells differ.

    Everything beyond the lattice is void.
    """
    any_set, all_set = np.uint32(0), np.uint32(2 * FULL + 1)
    for side in range(4):
        up, right = side & 1, side >> 1
        a, b = p + up, q + right
        slot, next_slot = slot_at(slots, a, b, r), slot_at(slots, a, b, r + 1)
        for x in range(1 if up else B0):
            for y in range(1 if right else B1):
                row = x * B1 + y
                row_bits = np.uint32(0)
                if slot >= 0:
                    row_bits = np.uint32(bits[slot, row])
                elif slot == SOLID_BRICK:
                    row_bits = np.uint32(grid_cells_of_row(a, b, r, row, shape))
                if next_slot >= 0:
                    row_bits |= (np.uint32(bits[next_slot, row]) & np.uint32(1)) << np.uint32(B2)
                elif next_slot == SOLID_BRICK:
                    row_bits |= (np.uint32(grid_cells_of_row(a, b, r + 1, row, shape)) & np.uint32(1)) << np.uint32(B2)
                rows[x + B0 * up, y + B1 * right] = row_bits
                any_set |= row_bits
                all_set &= row_bits
    return any_set != 0 and all_set != np.uint32(2 * FULL + 1)


@njit(inline="always", cache=True)
def crossed_cubes(a, b, c, d):
    """Return the cubes, of 16, with corners of both signs, from their four rows of 17 cells."""
    any_set, all_set = a | b | c | d, a & b & c & d
    one_bit = np.uint32(1)
    return (any_set | (any_set >> one_bit)) & ~(all_set & (all_set >> one_bit)) & np.uint32(FULL)


@njit(inline="always", cache=True)
def signs_of(a, b, c, d, k):
    """Return the signs of the corners of a cube in a row as 8 bits: bit di + 2 dj + 4 dk is 1 where it is solid."""
    shift = np.uint32(k)
    one_bit = np.uint32(1)
    two = np.uint32(3)
    a, b, c, d = (a >> shift) & two, (b >> shift) & two, (c >> shift) & two, (d >> shift) & two
    low = (a & one_bit) | (b & one_bit) << one_bit | (c & one_bit) << np.uint32(2) | (d & one_bit) << np.uint32(3)
    a, b, c, d = a >> one_bit, b >> one_bit, c >> one_bit, d >> one_bit
    return np.int64(low | (a | b << one_bit | c << np.uint32(2) | d << np.uint32(3)) << np.uint32(4))


@njit(nogil=True, cache=True)
def mark_differing(slots, places, bits, shape, differs, thread, threads):
    """Mark the bricks in which, or between which and the next ones, any two cells differ."""
    rows = np.empty((B0 + 1, B1 + 1), dtype=np.uint32)
    for n in range(thread, len(places), threads):
        differs[n] = rows_around(slots, places[n, 0], places[n, 1], places[n, 2], bits, shape, rows)


@njit(nogil=True, cache=True)
def count_output(slots, places, bits, shape, triangles, masks, starts, counts, thread, threads):
    """Set the crossed edges of every row along i, j, k, the begin of its vertices, and each brick's output size."""
    rows = np.empty((B0 + 1, B1 + 1), dtype=np.uint32)
    for n in range(thread, len(places), threads):
        rows_around(slots, places[n, 0], places[n, 1], places[n, 2], bits, shape, rows)
        vertices, faces, undecided = 0, 0, 0
        for i in range(B0):
            for j in range(B1):
                row = i * B1 + j
                a, b, c, d = rows[i, j], rows[i + 1, j], rows[i, j + 1], rows[i + 1, j + 1]
                masks[n, row, 0] = np.uint16(a ^ b)
                masks[n, row, 1] = np.uint16(a ^ c)
                masks[n, row, 2] = np.uint16(a ^ (a >> np.uint32(1)))
                for axis in range(3):
                    starts[n, row, axis] = vertices
                    vertices += count_ones(masks[n, row, axis])
                remaining = np.int64(crossed_cubes(a, b, c, d))
                while remaining:
                    triangle_count = triangles[signs_of(a, b, c, d, lowest_bit(remaining))]
                    remaining &= remaining - 1
                    if triangle_count == UNDECIDED:
                        undecided += 1
                    else:
                        faces += triangle_count
        counts[n, 0], counts[n, 1], counts[n, 2] = vertices, faces, undecided


@njit(from_python=False, cache=True)
def values_around(slots, p, q, r, values, shape, numbers, around):
    """Set the values minus the level for a brick and the first cells after it: (9, 9, 17)."""
    level, clearance, tie = numbers
    low, high = 1 - r * B2, shape[2] - r * B2  # the cells of the grid
    for i in range(B0 + 1):
        a, x = (p, i) if i < B0 else (p + 1, 0)
        for j in range(B1 + 1):
            b, y = (q, j) if j < B1 else (q + 1, 0)
            inside = 1 <= a * B0 + x <= shape[0] and 1 <= b * B1 + y <= shape[1]
            slot, next_slot = OUTSIDE, OUTSIDE
            if inside:
                slot, next_slot = slot_at(slots, a, b, r), slot_at(slots, a, b, r + 1)
            line, at = around[i, j], (x * B1 + y) * B2
            if slot >= 0:
                brick = values[slot]
                for k in range(B2):
                    line[k] = keep_clear_of_zero(brick[at + k] - level, clearance, tie)
            else:
                value = keep_clear_of_zero(
                    (np.float32(1) if slot == SOLID_BRICK else np.float32(-1)) - level, clearance, tie
                )
                for k in range(B2):
                    line[k] = value
            value = np.float32(1) if next_slot == SOLID_BRICK else np.float32(-1)
            line[B2] = keep_clear_of_zero((values[next_slot, at] if next_slot >= 0 else value) - level, clearance, tie)
            for k in range(max(low, 0)):
                line[k] = keep_clear_of_zero(np.float32(-1) - level, clearance, tie)
            for k in range(max(high + 1, 0), B2 + 1):
                line[k] = keep_clear_of_zero(np.float32(-1) - level, clearance, tie)


@njit(inline="always", cache=True)
def keep_clear_of_zero(value, clearance, tie):
    """Return a value, moved away from 0 to the allowed distance."""
    above_it, below_it = max(value, clearance) * tie, min(value, -clearance)
    return above_it if value > 0 else below_it


@njit(from_python=False, cache=True)
def write_first_numbers(slots, index, p, q, r, masks, starts, offsets, begin, behind, crossing):
    """Write the number of the first vertex on each row of a brick, and on the rows just after it: see below.

    Parameters
    ----------
    begin : (9, 9, 3)
        Of the first vertex on the edges of row i, j along an axis, in the brick itself; written.
    behind : (9, 9, 3)
        The same in the next brick along k; written.
    crossing : (9, 9, 3)
        The edges of a row that have a vertex, as bits; written.
    """
    for side in range(4):
        up, right = side & 1, side >> 1
        if p + up >= slots.shape[0] or q + right >= slots.shape[1]:
            continue  # void: no edge there has a vertex
        brick = index[p + up, q + right, r]
        next_brick = index[p + up, q + right, r + 1] if r + 1 < slots.shape[2] else np.int32(-1)
        for x in range(1 if up else B0):
            for y in range(1 if right else B1):
                row, i, j = x * B1 + y, x + B0 * up, y + B1 * right
                for axis in range(3):
                    if brick >= 0:
                        begin[i, j, axis] = offsets[brick, 0] + starts[brick, row, axis]
                        crossing[i, j, axis] = masks[brick, row, axis]
                    if next_brick >= 0:
                        behind[i, j, axis] = offsets[next_brick, 0] + starts[next_brick, row, axis]


@njit(inline="always", cache=True)
def vertex_number(i, j, k, axis, begin, behind, crossing):
    """Return the number of the vertex on an edge that begins in a brick or in the first cells after it."""
    if k == B2:
        return behind[i, j, axis]
    return begin[i, j, axis] + count_ones(crossing[i, j, axis] & ((1 << k) - 1))


@njit(nogil=True, cache=True, error_model="numpy")
def write_surface(
    slots,
    places,
    index,
    values,
    bits,
    shape,
    numbers,
    triangle_counts,
    triangles,
    crossings,
    masks,
    starts,
    offsets,
    edges,
    vertices,
    rate,
    faces,
    corners,
    corner_edges,
    places_of,
    first,
    thread,
    threads,
):
    """Write vertices in cells from the first cell's centre, triangles, and the data of undecided cubes.

    The field begins at the cell `first` of the grid: vertices of a part of a grid are those of the whole.
    """
    rows = np.empty((B0 + 1, B1 + 1), dtype=np.uint32)
    around = np.empty((B0 + 1, B1 + 1, B2 + 1), dtype=np.float32)
    numbered = np.empty(EDGES, dtype=np.int32)
    begin, behind = np.zeros((B0 + 1, B1 + 1, 3), dtype=np.int32), np.zeros((B0 + 1, B1 + 1, 3), dtype=np.int32)
    crossing = np.zeros((B0 + 1, B1 + 1, 3), dtype=np.int64)
    for n in range(thread, len(places), threads):
        written, todo = offsets[n], offsets[n + 1]
        if written[0] == todo[0] and written[1] == todo[1] and written[2] == todo[2]:
            continue
        p, q, r = places[n, 0], places[n, 1], places[n, 2]
        rows_around(slots, p, q, r, bits, shape, rows)
        values_around(slots, p, q, r, values, shape, numbers, around)
        write_first_numbers(slots, index, p, q, r, masks, starts, offsets, begin, behind, crossing)
        v, f, u = offsets[n, 0], offsets[n, 1], offsets[n, 2]
        for i in range(B0):
            for j in range(B1):
                row = i * B1 + j
                for axis in range(3):
                    di, dj, dk = axis == 0, axis == 1, axis == 2
                    remaining = np.int64(masks[n, row, axis])
                    while remaining:
                        k = lowest_bit(remaining)
                        remaining &= remaining - 1
                        value, next_value = np.float64(around[i, j, k]), np.float64(around[i + di, j + dj, k + dk])
                        vertices[v, 0] = first[0] + p * B0 + i - 1
                        vertices[v, 1] = first[1] + q * B1 + j - 1
                        vertices[v, 2] = first[2] + r * B2 + k - 1
                        vertices[v, axis] += value / (value - next_value)
                        rate[v, axis] = 1 / (next_value - value)
                        v += 1
                a, b, c, d = rows[i, j], rows[i + 1, j], rows[i, j + 1], rows[i + 1, j + 1]
                remaining = np.int64(crossed_cubes(a, b, c, d))
                while remaining:
                    k = lowest_bit(remaining)
                    remaining &= remaining - 1
                    signs = signs_of(a, b, c, d, k)
                    if triangle_counts[signs] != UNDECIDED:
                        for m in range(crossings[signs, EDGES]):
                            e = crossings[signs, m]
                            axis, at = int(edges[e, 0]), int(edges[e, 1])
                            x, y, z = i + (at & 1), j + (at >> 1 & 1), k + (at >> 2)
                            numbered[e] = vertex_number(x, y, z, axis, begin, behind, crossing)
                        for t in range(triangle_counts[signs]):
                            for corner in range(3):
                                faces[f, corner] = numbered[triangles[signs, t, corner]]
                            f += 1
                        continue
                    places_of[u, 0] = first[0] + p * B0 + i - 1
                    places_of[u, 1] = first[1] + q * B1 + j - 1
                    places_of[u, 2] = first[2] + r * B2 + k - 1
                    for corner in range(8):
                        corners[u, corner] = around[i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)]
                    for e in range(len(edges)):
                        axis, at = edges[e]
                        opposite = at | 1 << axis
                        corner_edges[u, e] = -1
                        if (signs >> at & 1) != (signs >> opposite & 1):
                            x, y, z = i + (at & 1), j + (at >> 1 & 1), k + (at >> 2)
                            corner_edges[u, e] = vertex_number(x, y, z, axis, begin, behind, crossing)
                    u += 1


@njit(nogil=True, cache=True)
def scale_to_mm(vertices, rate, spacing, origin, thread, threads):
    """Convert cells from the first cell's centre to mm."""
    size = (len(vertices) + threads - 1) // threads  # each thread has its own stretch of memory
    for v in range(thread * size, min(len(vertices), (thread + 1) * size)):
        for axis in range(3):
            vertices[v, axis] = (vertices[v, axis] + 0.5) * spacing[axis] + origin[axis]
            rate[v, axis] *= spacing[axis]


@njit(nogil=True, cache=True)
def face_volumes(vertices, rate, faces, middle, volume, change, thread, threads):
    """Set for every face the volume between it and the central point, and its change when the level rises by one."""
    size = (len(faces) + threads - 1) // threads
    for f in range(thread * size, min(len(faces), (thread + 1) * size)):
        six, more = sixfold_volume(vertices, rate, faces[f], middle)
        volume[f] = six / 6
        change[f] = more / 6


@njit(nogil=True, cache=True)
def sum_volumes(vertices, rate, faces, middle, sums, thread, threads):
    """Set six times the volume between a block of faces and the central point, and its change with the level, (n, 2).

    Sums do not depend on the number of threads.
    """
    for block in range(thread, len(sums), threads):
        volume, slope = 0.0, 0.0
        for f in range(block * BLOCK, min(len(faces), (block + 1) * BLOCK)):
            face_volume, change = sixfold_volume(vertices, rate, faces[f], middle)
            volume += face_volume
            slope += change
        sums[block, 0], sums[block, 1] = volume, slope


@njit(inline="always", cache=True)
def sixfold_volume(vertices, rate, face, middle):
    """Return six times the volume between a face and the central point, and its change when the level rises by one.

    The change is that of all faces together: in a closed surface, the contributions of the three products of two
    corners to the face's own normal cancel out around every vertex.
    """
    i, j, k = face[0], face[1], face[2]
    ax, ay, az = vertices[i, 0], vertices[i, 1], vertices[i, 2]
    bx, by, bz = vertices[j, 0] - ax, vertices[j, 1] - ay, vertices[j, 2] - az
    cx, cy, cz = vertices[k, 0] - ax, vertices[k, 1] - ay, vertices[k, 2] - az
    nx, ny, nz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
    volume = (ax - middle[0]) * nx + (ay - middle[1]) * ny + (az - middle[2]) * nz
    slope = (
        (rate[i, 0] + rate[j, 0] + rate[k, 0]) * nx
        + (rate[i, 1] + rate[j, 1] + rate[k, 1]) * ny
        + (rate[i, 2] + rate[j, 2] + rate[k, 2]) * nz
    )
    return volume, slope


@njit(nogil=True, cache=True, error_model="numpy")
def measure(
    slots, places, bits, values, shape, numbers, triangle_counts, triangles, crossings, edges, middle, thread, threads
):
    """Return six times the volume of the surface, cells, its slope over the level, and the undecided cubes' number.

    The sums of bricks are added with the rounding error of the last addition carried along (Kahan 1965): rounding would
    otherwise depend on the number of threads, and show in the level of a large volume.
    """
    rows = np.empty((B0 + 1, B1 + 1), dtype=np.uint32)
    around = np.empty((B0 + 1, B1 + 1, B2 + 1), dtype=np.float32)
    points, moves = np.empty((EDGES, 3)), np.empty(EDGES)
    total_volume, total_slope, volume_error, slope_error, undecided = 0.0, 0.0, 0.0, 0.0, 0
    for n in range(thread, len(places), threads):
        p, q, r = places[n, 0], places[n, 1], places[n, 2]
        rows_around(slots, p, q, r, bits, shape, rows)
        seen = False
        volume, slope = 0.0, 0.0
        for i in range(B0):
            for j in range(B1):
                a, b, c, d = rows[i, j], rows[i + 1, j], rows[i, j + 1], rows[i + 1, j + 1]
                remaining = np.int64(crossed_cubes(a, b, c, d))
                if remaining and not seen:
                    values_around(slots, p, q, r, values, shape, numbers, around)
                    seen = True
                x, y = p * B0 + i - 0.5 - middle[0], q * B1 + j - 0.5 - middle[1]
                while remaining:
                    k = lowest_bit(remaining)
                    remaining &= remaining - 1
                    signs = signs_of(a, b, c, d, k)
                    if triangle_counts[signs] == UNDECIDED:
                        undecided += 1
                        continue
                    z = r * B2 + k - 0.5 - middle[2]
                    for m in range(crossings[signs, EDGES]):
                        e = crossings[signs, m]
                        axis, at = int(edges[e, 0]), int(edges[e, 1])
                        to = at | 1 << axis
                        di, dj, dk = at & 1, at >> 1 & 1, at >> 2
                        value = np.float64(around[i + di, j + dj, k + dk])
                        next_value = np.float64(around[i + (to & 1), j + (to >> 1 & 1), k + (to >> 2)])
                        move = 1 / (next_value - value)
                        moves[e] = move
                        points[e, 0], points[e, 1], points[e, 2] = x + di, y + dj, z + dk
                        points[e, axis] -= value * move
                    for t in range(triangle_counts[signs]):
                        edge_a, edge_b, edge_c = triangles[signs, t, 0], triangles[signs, t, 1], triangles[signs, t, 2]
                        ax, ay, az = points[edge_a, 0], points[edge_a, 1], points[edge_a, 2]
                        bx, by, bz = points[edge_b, 0] - ax, points[edge_b, 1] - ay, points[edge_b, 2] - az
                        cx, cy, cz = points[edge_c, 0] - ax, points[edge_c, 1] - ay, points[edge_c, 2] - az
                        nx, ny, nz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
                        volume += ax * nx + ay * ny + az * nz
                        for e in (edge_a, edge_b, edge_c):
                            slope += moves[e] * (nx if e < 4 else (ny if e < 8 else nz))
        volume -= volume_error
        larger = total_volume + volume
        volume_error = (larger - total_volume) - volume
        total_volume = larger
        slope -= slope_error
        larger = total_slope + slope
        slope_error = (larger - total_slope) - slope
        total_slope = larger
    return total_volume, total_slope, undecided
