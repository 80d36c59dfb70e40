"""Loops of `infill.phasefield.refining` over bricks, compiled.

Loops run over whole bricks, so that they are compiled to vector code.

`step` is a step with momentum: it also needs the field before the previous step, kept in `before`, where each cell is
read and replaced while its brick is being processed.

A gate weights averages over a Gaussian of `size` cells. They are taken on coarse cells of `size` cells along each axis,
(n, 3, 8/size, 8/size, 16/size): the means of w, of w r and of w r², 0 where no brick is kept.

    fine       . . . . . . . .      average   1  means over `size` cells: a box, variance size²/12
    coarse     |---o---|---o---|    blur      2  TAPS over five coarse cells: variance 3 size²/4
    fine       . . x . . . . .      blend     3  interpolated between coarse centres: a tent, variance size²/6
                                              together size², as the Gaussian's

For the blur, a brick needs two coarse cells around it, for the interpolation one: `gather_coarse_cells` copies them
from the 26 bricks around it. `blend` interpolates along i for a plane, then along j for a row, then along k for cells.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.rows import copy_row
from infill.kernels.sparse import (
    ALL,
    B0,
    B1,
    B2,
    CELLS,
    NONE,
    ORIGIN,
    WIDE,
    WIDE_I,
    WIDE_J,
    at_edge,
    bit,
    copy_surroundings,
    movable_rows,
    repeat_edges,
    update_faces,
)

SUMS = 3  # w, w r, w r²
# Twice (3, 10, 3) / 16. Together with the coarse cell's own width, size²/12, and that of the interpolation,
# size²/6, its variance, 3 size²/4, gives that of a Gaussian of `size` cells.
TAPS = (9 / 256, 60 / 256, 118 / 256)


@njit(nogil=True, cache=True, error_model="numpy")
def step(
    phi,
    before,
    faces,
    next_faces,
    flat,
    next_flat,
    rows,
    next_rows,
    beside,
    where,
    count,
    numbers,
    momentum,
    shape,
    number,
    needed,
    thread,
    threads,
):
    """Do one step of all bricks in place, as `infill.kernels.sparse.step` does, leaving the old values in `before`.

    The step has a number, from 0 on; bricks are left out of which `needed` (n,) says that they need no more steps.
    """
    w0, w1, w2, decay, rest, _ = numbers
    wide = np.zeros(WIDE, dtype=np.float32)
    for s in range(thread, count, threads):
        if number >= needed[s]:
            continue
        edge = at_edge(where[s], shape)
        # What was noted two steps ago, and is about to be replaced, is what is known of the field before the last step.
        changing = ALL if edge else movable_rows(s, rows, next_rows, beside[s])
        copy_row(next_rows[s], rows[s])
        if changing == NONE:
            copy_row(next_flat[s], flat[s])
            continue
        brick, old = phi[s], before[s]
        copy_surroundings(brick, faces, flat, beside[s], wide)
        for i in range(B0):
            for j in range(B1):
                if not changing & bit(i * B1 + j):
                    continue
                at, m = (i * B1 + j) * B2, ORIGIN + i * WIDE_I + j * WIDE_J
                for k in range(B2):
                    c = wide[m + k]
                    a, b, d, e = wide[m - WIDE_I + k], wide[m + WIDE_I + k], wide[m - WIDE_J + k], wide[m + WIDE_J + k]
                    g, h = wide[m - 1 + k], wide[m + 1 + k]
                    change = w0 * ((a - c) + (b - c)) + w1 * ((d - c) + (e - c)) + w2 * ((g - c) + (h - c))
                    v = c + (momentum * (c - old[at + k]) + change)
                    brick[at + k] = v / math.sqrt(decay + rest * (v * v))
                    old[at + k] = c
        if edge:
            repeat_edges(brick, where[s], shape)
        update_faces(brick, next_faces[s], next_flat[s], next_rows[s], changing)


@njit(nogil=True, cache=True)
def add_snapshot(phi, data, total, weight, known_count, so_far, count, thread, threads):
    """Add weight times phi to `total`; bricks from `known_count` on were always uniform, like their data."""
    for s in range(thread, count, threads):
        brick, out = phi[s], total[s]
        if s < known_count:
            for t in range(CELLS):
                out[t] += weight * brick[t]
        else:
            for t in range(CELLS):
                out[t] = so_far * np.float32(data[s, t]) + weight * brick[t]


@njit(nogil=True, cache=True)
def average(low, high, phase, unit, size, sums, thread, threads):
    """Write the means over coarse cells of w = 1 - phase², w r and w r² with r = unit (high - low) to `sums`."""
    n1, n2 = B1 // size, B2 // size
    share = np.float32(1 / size**3)
    weight, moment = np.empty(CELLS, dtype=np.float32), np.empty(CELLS, dtype=np.float32)
    for s in range(thread, len(low), threads):
        for t in range(CELLS):
            weight[t] = max(np.float32(1) - phase[s, t] * phase[s, t], np.float32(0)) * share
            moment[t] = (high[s, t] - low[s, t]) * unit
        out = sums[s].reshape(SUMS, -1)
        out[:] = 0
        for i in range(B0):
            for j in range(B1):
                at = ((i // size) * n1 + j // size) * n2
                line = (i * B1 + j) * B2
                for k in range(B2):
                    w, r = weight[line + k], moment[line + k]
                    out[0, at + k // size] += w
                    out[1, at + k // size] += w * r
                    out[2, at + k // size] += w * r * r


@njit(cache=True)
def gather_coarse_cells(sums, slots, place, rim, out):
    """Copy the coarse cells of the brick at `place` and of those around it, `rim` deep, into `out`."""
    _, _, n0, n1, n2 = sums.shape
    a0, a1, a2 = place[0] * n0 - rim, place[1] * n1 - rim, place[2] * n2 - rim
    for i in range(n0 + 2 * rim):
        p, x = (a0 + i) // n0, (a0 + i) % n0
        for j in range(n1 + 2 * rim):
            q, y = (a1 + j) // n1, (a1 + j) % n1
            inside = 0 <= p < slots.shape[0] and 0 <= q < slots.shape[1]
            for k in range(n2 + 2 * rim):
                r, z = (a2 + k) // n2, (a2 + k) % n2
                slot = slots[p, q, r] if inside and 0 <= r < slots.shape[2] else -1
                for m in range(SUMS):
                    out[m, i, j, k] = sums[slot, m, x, y, z] if slot >= 0 else np.float32(0)


@njit(nogil=True, cache=True)
def blur(sums, slots, where, out, thread, threads):
    """Average the coarse cells with those around them, using `TAPS` along each axis."""
    _, _, n0, n1, n2 = sums.shape
    outer_tap, inner_tap, centre_tap = np.float32(TAPS[0]), np.float32(TAPS[1]), np.float32(TAPS[2])
    block = np.empty((SUMS, n0 + 4, n1 + 4, n2 + 4), dtype=np.float32)
    for s in range(thread, len(sums), threads):
        gather_coarse_cells(sums, slots, where[s], np.int64(2), block)
        for m in range(SUMS):
            u = block[m]
            for i in range(n0):  # in place: what is written is not read again
                for j in range(n1 + 4):
                    for k in range(n2 + 4):
                        outer = outer_tap * (u[i, j, k] + u[i + 4, j, k])
                        u[i, j, k] = outer + inner_tap * (u[i + 1, j, k] + u[i + 3, j, k]) + centre_tap * u[i + 2, j, k]
            for i in range(n0):
                for j in range(n1):
                    for k in range(n2 + 4):
                        outer = outer_tap * (u[i, j, k] + u[i, j + 4, k])
                        u[i, j, k] = outer + inner_tap * (u[i, j + 1, k] + u[i, j + 3, k]) + centre_tap * u[i, j + 2, k]
            for i in range(n0):
                for j in range(n1):
                    for k in range(n2):
                        outer = outer_tap * (u[i, j, k] + u[i, j, k + 4])
                        out[s, m, i, j, k] = (
                            outer + inner_tap * (u[i, j, k + 1] + u[i, j, k + 3]) + centre_tap * u[i, j, k + 2]
                        )


@njit(inline="always", cache=True)
def coarse_cell_before(cell, size):
    """Return the first coarse cell around a cell, counted from one before the brick, and the share of the next one."""
    place = np.float32((cell + 0.5) / size + 0.5)
    cell_before = int(place)
    return cell_before, place - np.float32(cell_before)


@njit(nogil=True, cache=True, error_model="numpy")
def blend(low, high, sums, slots, where, shape, signed, unsigned, tiny, thread, threads):
    """Move `low` towards `high` as far as the gate permits: see `infill.phasefield.refining.blend_by_gate`."""
    _, _, n0, n1, n2 = sums.shape
    size = B0 // n0
    block = np.empty((SUMS, n0 + 2, n1 + 2, n2 + 2), dtype=np.float32)
    line = np.empty((SUMS, n1 + 2, n2 + 2), dtype=np.float32)
    row = np.empty((SUMS, n2 + 2), dtype=np.float32)
    mean = np.empty((SUMS, B2), dtype=np.float32)
    ends, parts = np.empty(B2, dtype=np.int64), np.empty(B2, dtype=np.float32)
    for k in range(B2):
        ends[k], parts[k] = coarse_cell_before(k, size)
    bias, spread = signed**4, unsigned**8
    for s in range(thread, len(low), threads):
        gather_coarse_cells(sums, slots, where[s], np.int64(1), block)
        low_brick, high_brick = low[s], high[s]
        for i in range(B0):
            at, part = coarse_cell_before(i, size)
            for m in range(SUMS):
                for j in range(n1 + 2):
                    for k in range(n2 + 2):
                        line[m, j, k] = block[m, at, j, k] + part * (block[m, at + 1, j, k] - block[m, at, j, k])
            for j in range(B1):
                at, part = coarse_cell_before(j, size)
                for m in range(SUMS):
                    for k in range(n2 + 2):
                        row[m, k] = line[m, at, k] + part * (line[m, at + 1, k] - line[m, at, k])
                    for k in range(B2):
                        mean[m, k] = row[m, ends[k]] + parts[k] * (row[m, ends[k] + 1] - row[m, ends[k]])
                row_start = (i * B1 + j) * B2
                for k in range(B2):
                    weight = mean[0, k] + tiny
                    m = (mean[1, k] / weight) ** 2
                    v = (mean[2, k] / weight) ** 2
                    m, v = m * m, v * v
                    open_ = max(m / (m + bias), v / (v + spread))
                    low_brick[row_start + k] += open_ * (high_brick[row_start + k] - low_brick[row_start + k])
        repeat_edges(low_brick, where[s], shape)


@njit(nogil=True, cache=True, error_model="numpy")
def clamp_to_data(values, data, bound, thread, threads):
    """Keep `values` within a bound of the data, both distances; where those are cut off, on one side only."""
    bound = np.float32(bound)
    for s in range(thread, len(values), threads):
        brick, datum = values[s], data[s]
        for t in range(CELLS):
            if datum[t] < 1:
                brick[t] = min(brick[t], datum[t] + bound)
            if datum[t] > -1:
                brick[t] = max(brick[t], datum[t] - bound)
