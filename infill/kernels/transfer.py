"""Copies between an entire field and its bricks, compiled: see `infill.phasefield.sparse`.

Brick (p, q, r) of the lattice holds cells 8 p - 1 … 8 p + 6, 8 q - 1 …, 16 r - 1 … of the grid: the lattice begins
one cell before the grid, so that there is void (or a repetition of the edge) for the surface to close in.

    grid                0 1 2 3 4 5 6 7 8 9 …
    lattice     [ -1 0 1 2 3 4 5 6 ][ 7 8 9 …        bricks of 8 along x

`fill_states` and `fill_grey_states` classify every brick without copying it: the least and largest value of each
row of bricks are collected for all k at once, which is vector code, and then cut into sixteens. Only mixed bricks,
and those next to one of the other phase, are gathered; `scatter` copies back, a row of bricks at a time.
"""
# mypy: disable-error-code="no-untyped-def, call-arg"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.lanes import copy, count_ones, mask_above, mask_equal
from infill.kernels.lanes import spread as spread_out
from infill.kernels.sparse import B0, B1, B2, CELLS, FULL_ROW, MIXED, OUTER, SOLID_BRICK


@njit(nogil=True, cache=True)
def count_solid(cells, thread, threads):
    """Count the cells above 0 in a thread's share of int8 cells, flat."""
    size = -(-len(cells) // (threads * B2)) * B2
    begin, end = min(thread * size, len(cells)), min((thread + 1) * size, len(cells))
    solid_count, limit = 0, np.int8(0)
    vector_end = begin + (end - begin) // B2 * B2
    for t in range(begin, vector_end, B2):
        solid_count += count_ones(mask_above(cells, t, limit))
    for t in range(vector_end, end):
        solid_count += cells[t] > 0
    return solid_count


@njit(nogil=True, cache=True)
def fill_states(data, state, zeros, thread, threads):
    """Set the state of every brick of int8 data, solid above 0, and mark the rows of bricks that contain a zero."""
    m0, m1, m2 = state.shape
    n0, n1, n2 = data.shape
    low, high, zero = np.empty(n2, dtype=np.int8), np.empty(n2, dtype=np.int8), np.empty(n2, dtype=np.int8)
    for row in range(thread, m0 * m1, threads):
        p, q = row // m1, row % m1
        for k in range(n2):
            low[k], high[k], zero[k] = 127, -128, 0
        has_cells = False
        for i in range(max(p * B0 - 1, 0), min((p + 1) * B0 - 1, n0)):
            for j in range(max(q * B1 - 1, 0), min((q + 1) * B1 - 1, n1)):
                has_cells = True
                line = data[i, j]
                for k in range(n2):
                    v = line[k]
                    low[k] = min(low[k], v)
                    high[k] = max(high[k], v)
                    zero[k] |= v == 0
        for k in range(1, n2):
            zero[0] |= zero[k]
        zeros[p, q] = zero[0] != 0
        for r in range(m2):
            begin, end = max(r * B2 - 1, 0), min((r + 1) * B2 - 1, n2)
            smallest, largest = np.int8(127), np.int8(-128)
            for k in range(begin, end):
                smallest, largest = min(smallest, low[k]), max(largest, high[k])
            if not has_cells or begin >= end:
                state[p, q, r] = OUTER
            elif smallest > 0:
                state[p, q, r] = 1
            else:
                state[p, q, r] = -1 if largest <= 0 else MIXED


@njit(nogil=True, cache=True)
def fill_grey_states(data, state, thread, threads):
    """Set the state of every brick of float data: uniform only if all cells are +1 or all are -1."""
    m0, m1, m2 = state.shape
    n0, n1, n2 = data.shape
    low, high = np.empty(n2, dtype=np.float32), np.empty(n2, dtype=np.float32)
    for row in range(thread, m0 * m1, threads):
        p, q = row // m1, row % m1
        for k in range(n2):
            low[k], high[k] = np.inf, -np.inf
        has_cells = False
        for i in range(max(p * B0 - 1, 0), min((p + 1) * B0 - 1, n0)):
            for j in range(max(q * B1 - 1, 0), min((q + 1) * B1 - 1, n1)):
                has_cells = True
                line = data[i, j]
                for k in range(n2):
                    low[k] = min(low[k], line[k])
                    high[k] = max(high[k], line[k])
        for r in range(m2):
            begin, end = max(r * B2 - 1, 0), min((r + 1) * B2 - 1, n2)
            smallest, largest = np.float32(np.inf), np.float32(-np.inf)
            for k in range(begin, end):
                smallest, largest = min(smallest, low[k]), max(largest, high[k])
            if not has_cells or begin >= end:
                state[p, q, r] = OUTER
            elif smallest == 1:
                state[p, q, r] = 1
            else:
                state[p, q, r] = -1 if largest == -1 else MIXED


@njit(nogil=True, cache=True)
def gather(field, where, bricks, count, level, thread, threads):
    """Copy the cells of bricks; cells beyond the grid repeat the edge. With a level, +1 where above it and else -1."""
    n0, n1, n2 = field.shape
    for s in range(thread, count, threads):
        i0, j0, k0 = where[s, 0] * B0 - 1, where[s, 1] * B1 - 1, where[s, 2] * B2 - 1
        brick = bricks[s]
        for i in range(B0):
            x = min(max(i0 + i, 0), n0 - 1)
            for j in range(B1):
                line = field[x, min(max(j0 + j, 0), n1 - 1)]
                at = (i * B1 + j) * B2
                for k in range(B2):
                    value = line[min(max(k0 + k, 0), n2 - 1)]
                    if level is None:  # decided at compile time
                        brick[at + k] = value
                    else:
                        brick[at + k] = 1 if value > level else -1


@njit(nogil=True, cache=True)
def scatter(slots, bricks, field, thread, threads):
    """Write all bricks, kept or not, into the entire field."""
    m0, m1, m2 = slots.shape
    n0, n1, n2 = field.shape
    for row in range(thread, m0 * m1, threads):
        p, q = row // m1, row % m1
        for i in range(max(p * B0 - 1, 0), min((p + 1) * B0 - 1, n0)):
            for j in range(max(q * B1 - 1, 0), min((q + 1) * B1 - 1, n1)):
                at = ((i + 1 - p * B0) * B1 + (j + 1 - q * B1)) * B2
                line = field[i, j]
                for r in range(m2):
                    begin, end = max(r * B2 - 1, 0), min((r + 1) * B2 - 1, n2)
                    slot = slots[p, q, r]
                    if slot >= 0:
                        brick = bricks[slot]
                        shift = at + 1 - r * B2
                        for k in range(begin, end):
                            line[k] = brick[shift + k]
                    else:
                        value = np.float32(1) if slot == SOLID_BRICK else np.float32(-1)
                        for k in range(begin, end):
                            line[k] = value


@njit(nogil=True, cache=True, error_model="numpy")
def artanh_of_values(bricks, clip, scale, out, thread, threads):
    """Set out to artanh of the values, clipped to +-clip, over scale, to 1e-6: as vector code, unlike a log.

    artanh v = ln 2 / 2 log2 x, x = (1 + v) / (1 - v). With x = 2^n m and m in [1/sqrt 2, sqrt 2), log2 x is n plus
    log2 m = 2 / ln 2 (y + y³ / 3 + y⁵ / 5 + y⁷ / 7 + …), y = (m - 1) / (m + 1), |y| < 0.172: the terms left out are
    less than 5e-8. n is read off the bits of x, from which those of 1/sqrt 2, 0x3F3504F3, are subtracted first.
    """
    value, ratio = np.empty(CELLS, dtype=np.float32), np.empty(CELLS, dtype=np.float32)
    power, rows = np.empty(CELLS, dtype=np.int32), np.empty(CELLS // B2, dtype=np.int64)
    bits = ratio.view(np.int32)
    half = np.float32(0.34657359) / scale  # ln 2 / 2
    for s in range(thread, len(bricks), threads):
        brick, line = bricks[s], out[s]
        count = 0  # of rows that are not +1 or -1 throughout: often a half
        for row in range(CELLS // B2):
            row_value = brick[row * B2]
            if abs(row_value) == 1 and mask_equal(brick, row * B2, row_value) == FULL_ROW:
                spread_out(line, row * B2, row_value)
            else:
                copy(value, count * B2, brick, row * B2)
                rows[count] = row * B2
                count += 1
        value_count = count * B2
        for t in range(value_count):
            v = min(max(value[t], -clip), clip)
            ratio[t] = (1 + v) / (1 - v)
        for t in range(value_count):  # the power of two, chosen so that the remainder lies around 1
            power[t] = (bits[t] - 0x3F3504F3) >> 23
        for t in range(value_count):
            bits[t] -= power[t] << 23
        for t in range(value_count):  # log2 of the remainder by the artanh series
            x = (ratio[t] - 1) / (ratio[t] + 1)
            y = x * x
            log = x * (
                np.float32(2.88539008)
                + y * (np.float32(0.96179669) + y * (np.float32(0.57707802) + y * np.float32(0.4121986)))
            )
            v = half * (np.float32(power[t]) + log)
            value[t] = np.float32(1) if value[t] >= clip else (np.float32(-1) if value[t] <= -clip else v)
        for n in range(count):
            copy(line, rows[n], value, n * B2)


@njit(nogil=True, cache=True)
def extend_boxes(numbers, first, low, high, runs, cells):
    """Extend the box of every number to the cells that have it; count these, and its runs along the last axis.

    Parameters
    ----------
    numbers : (n0, n1, n2) int32
        At least 0.
    first : int
        Place of the first layer along the first axis.
    low, high : (L, 3) int64
        The boxes so far, `high` without its end; `low` above `high` for a number without a cell.
    runs, cells : (L,) int64
    """
    n0, n1, n2 = numbers.shape
    for i in range(n0):
        for j in range(n1):
            row, begin = numbers[i, j], 0
            while begin < n2:
                number, end = row[begin], begin + 1
                while end < n2 and row[end] == number:
                    end += 1
                low[number, 0], high[number, 0] = min(low[number, 0], first + i), max(high[number, 0], first + i + 1)
                low[number, 1], high[number, 1] = min(low[number, 1], j), max(high[number, 1], j + 1)
                low[number, 2], high[number, 2] = min(low[number, 2], begin), max(high[number, 2], end)
                runs[number] += 1
                cells[number] += end - begin
                begin = end
