"""Sums over triangles that do not depend on their order, compiled: volumes, and a number for a set of triangles.

A sum of floating-point numbers depends on their order, so that pieces of a surface would not add up to the whole.
Every number is therefore rounded to whole parts of 2^-52 first, in two integers (`HIGH` and `LOW` bits after the
point), and integers are summed: this is exact in any order.
"""
# mypy: disable-error-code="no-untyped-def, call-arg"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.sparse import B2
from infill.kernels.sparse_marching import ROWS, sixfold_volume

HIGH, LOW = 16, 36  # bits
FIRST, SECOND, THIRD = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
EXPONENTS = 2048  # of double precision
MANTISSA_BITS = 52
MANTISSA_LOW_BITS = 26  # of the mantissa; its parts, of 27 and 26 bits, add up without overflow for 2^36 numbers
MANTISSA, MANTISSA_LOW = np.int64(2**MANTISSA_BITS - 1), np.int64(2**MANTISSA_LOW_BITS - 1)


@njit(nogil=True, cache=True)
def sum_shells(vertices, rate, faces, shells, middle, cell_volume, sums):
    """Add six times the volume of each face, in cells, and its slope over the level, to those of its shell (s, 4)."""
    high, low = np.float64(2**HIGH), np.float64(2**LOW)
    for f in range(len(faces)):
        volume, slope = sixfold_volume(vertices, rate, faces[f], middle)
        shell = shells[faces[f, 0]]
        for n in range(2):
            value = (volume if n == 0 else slope) / cell_volume * high
            whole = np.rint(value)
            sums[shell, 2 * n] += np.int64(whole)
            sums[shell, 2 * n + 1] += np.int64(np.rint((value - whole) * low))


@njit(inline="always", cache=True)
def mix(number):
    """Return a number of 64 bits in which every bit depends on all bits of another (SplitMix64)."""
    number += FIRST
    number = (number ^ (number >> np.uint64(30))) * SECOND
    number = (number ^ (number >> np.uint64(27))) * THIRD
    return number ^ (number >> np.uint64(31))


@njit(nogil=True, cache=True)
def sum_faces(vertices, bits, faces, unit, sums):
    """Add to `sums` (4,) the hashes of all triangles, of their edges, and their area over `unit` in two integers.

    The number of a triangle depends on the coordinates, whose bits are `bits` (V, 3) uint64, and on the orientation,
    not on which corner is first. An edge counts with its number from end to end minus that the other way round: all
    edges of a closed surface add up to 0.
    """
    total, edges = np.uint64(0), np.uint64(0)
    high, low = np.float64(2**HIGH), np.float64(2**LOW)
    corners = np.empty(3, dtype=np.uint64)
    for f in range(len(faces)):
        for c in range(3):
            number = np.uint64(0)
            for axis in range(3):
                number = mix(number ^ bits[faces[f, c], axis])
            corners[c] = number
        least = 0
        for c in range(1, 3):
            if corners[c] < corners[least]:
                least = c
        number = np.uint64(0)
        for c in range(3):
            number = mix(number ^ corners[(least + c) % 3])
            a, b = corners[c], corners[(c + 1) % 3]
            edges += mix(mix(a) ^ b) - mix(mix(b) ^ a)
        total += number
        i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
        ax, ay, az = vertices[i, 0], vertices[i, 1], vertices[i, 2]
        bx, by, bz = vertices[j, 0] - ax, vertices[j, 1] - ay, vertices[j, 2] - az
        cx, cy, cz = vertices[k, 0] - ax, vertices[k, 1] - ay, vertices[k, 2] - az
        nx, ny, nz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
        area = np.sqrt(nx * nx + ny * ny + nz * nz) / 2 / unit * high
        whole = np.rint(area)
        sums[2] += np.int64(whole)
        sums[3] += np.int64(np.rint((area - whole) * low))
    sums[0] += np.int64(total)
    sums[1] += np.int64(edges)


@njit(nogil=True, cache=True)
def find_first_cells(where, chosen, bits, bricks, starts, names, lattice, first):
    """Set for every component the least number of its cells in chosen bricks: by brick, row and place in the row."""
    for s in range(len(where)):
        if not chosen[s]:
            continue
        p, q, r = np.int64(where[s, 0]), np.int64(where[s, 1]), np.int64(where[s, 2])
        brick = (p * lattice[1] + q) * lattice[2] + r
        for row in range(ROWS):
            row_bits = np.int64(bits[s, row])
            run = 0
            for k in range(B2):
                if row_bits >> k & 1 and not (k and row_bits >> (k - 1) & 1):
                    name = names[bricks[s] + starts[s, row] + run]
                    run += 1
                    number = (brick * ROWS + row) * B2 + k
                    if first[name] < 0 or number < first[name]:
                        first[name] = number


@njit(nogil=True, cache=True)
def count_cells_of(where, chosen, bits, bricks, starts, names, cells):
    """Add the cells of chosen bricks to the count of their component."""
    for s in range(len(where)):
        if not chosen[s]:
            continue
        for row in range(ROWS):
            row_bits = np.int64(bits[s, row])
            run = -1
            for k in range(B2):
                if row_bits >> k & 1:
                    if not (k and row_bits >> (k - 1) & 1):
                        run += 1
                    cells[names[bricks[s] + starts[s, row] + run]] += 1


@njit(nogil=True, cache=True)
def add_by_exponent(bits, side, sums):
    """Add the mantissas of numbers to those of their side and exponent: `sums` (2, EXPONENTS, 2), high and low parts.

    `bits` (n,) are float64 seen as int64, finite; `side` (n,) is 0 or 1.
    """
    for t in range(len(bits)):
        exponent = (bits[t] >> MANTISSA_BITS) & (EXPONENTS - 1)
        mantissa = bits[t] & MANTISSA
        if exponent > 0:
            mantissa |= MANTISSA + 1
        high, low = mantissa >> MANTISSA_LOW_BITS, mantissa & MANTISSA_LOW
        if bits[t] < 0:
            high, low = -high, -low
        sums[side[t], exponent, 0] += high
        sums[side[t], exponent, 1] += low
