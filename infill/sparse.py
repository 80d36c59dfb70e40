"""The compiled scheme on blocks around the surface only; everywhere else nothing moves.

Where phi = f = +-1 among equal neighbours, a cell is a fixed point (see `infill.compiled`), and what happens
at the surface travels one cell a step. So after n steps only blocks within n cells of the surface differ from the
data, and in step k only those within k cells need work. The result is that of the dense kernel to the last bit.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit, prange
from numpy.typing import NDArray

from infill.allen_cahn import Smoothing
from infill.compiled import Data, Field, advanced, prepared

BLOCK = (12, 12, 16)  # cells; the last axis is contiguous
MIXED = np.int8(0)  # the state of a block that is neither all solid nor all void
EDGE = -3  # a neighbour beyond the grid; -1 and -2 stand for blocks of -1 and +1 that are left alone


def smooth_sparse(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> Field:
    """Return what `infill.compiled.smooth_dense` returns, to the last bit, for up to three axes.

    Cost and extra memory grow with the surface. Grey data are all surface: there it does what the dense
    kernel does, with a little more overhead.
    """
    data, start, inside, numbers = prepared(f, smoothing, spacing, initial, mask)
    if smoothing.steps == 0:
        return start.reshape(f.shape)
    block = tuple(min(size, count) for size, count in zip(BLOCK, start.shape, strict=True))
    level = levels(block_states(start, data, block), steps=smoothing.steps, smallest=_smallest(block, start.shape))
    where = np.argwhere(level >= 0)
    where = where[np.argsort(level[tuple(where.T)], kind="stable")]
    reached = level[tuple(where.T)]
    number = np.full(level.shape, -1, dtype=np.int32)
    number[tuple(where.T)] = np.arange(len(where))
    beside = neighbours(where, number, start, block)
    old, held, open_cells = gathered(where, start, data, inside, block)
    new = old.copy()
    extents = np.minimum(np.array(start.shape) - where * block, block)
    for step in range(smoothing.steps):
        count = np.searchsorted(reached, step // _smallest(block, start.shape) + 1, side="right")
        sweep_blocks(old, held, open_cells, new, beside[:count], extents[:count], numbers)
        old, new = new, old
    scatter(where, old, extents, start)
    return start.reshape(f.shape)


def _smallest(block: tuple[int, ...], shape: tuple[int, ...]) -> int:
    """Return the fewest steps in which news can cross a block: along an axis with more than one of them."""
    return min((size for size, count in zip(block, shape, strict=True) if count > size), default=max(block))


def levels(state: NDArray[np.int8], *, steps: int, smallest: int) -> NDArray[np.int32]:
    """Return for every block how many blocks it lies from the surface, -1 if `steps` do not reach it.

    Parameters
    ----------
    state : (m0, m1, m2) int8
        +1 and -1 for blocks of one value, `MIXED` for others.
    steps, smallest : int
        Steps to do, and steps in which news cross a block.
    """
    from scipy import ndimage

    padded = np.pad(state, 1, mode="edge")
    around = (slice(1, -1),) * 3
    differs = ndimage.maximum_filter(padded, 3)[around] != ndimage.minimum_filter(padded, 3)[around]
    reached = (state == MIXED) | differs
    level = np.where(reached, 0, -1).astype(np.int32)
    for distance in range(1, (steps - 1) // smallest + 2):
        grown = ndimage.binary_dilation(reached, np.ones((3, 3, 3), dtype=bool))
        if (grown == reached).all():
            break
        level[grown & ~reached] = distance
        reached = grown
    return level


def neighbours(
    where: NDArray[np.intp], number: NDArray[np.int32], start: Field, block: tuple[int, ...]
) -> NDArray[np.int32]:
    """Return for each block its six neighbours: their number, or what stands for them, (n, 6) int32."""
    found = np.empty((len(where), 6), dtype=np.int32)
    for side in range(6):
        place = where.copy()
        place[:, side // 2] += 1 if side % 2 else -1
        beyond: NDArray[np.bool_] = np.any((place < 0) | (place >= number.shape), axis=1)
        place = np.where(beyond[:, None], 0, place)
        found[:, side] = number[tuple(place.T)]
        alone = found[:, side] < 0
        sign = start[tuple((place * block).T)]
        found[:, side] = np.where(alone, np.where(sign > 0, -2, -1), found[:, side])
        found[beyond, side] = EDGE
    return found


def block_states(start: Field, data: Data, block: tuple[int, ...]) -> NDArray[np.int8]:
    """Return +1 or -1 for blocks in which start and data have that value throughout, else `MIXED`."""
    shape = tuple(math.ceil(count / size) for count, size in zip(start.shape, block, strict=True))
    state = np.empty(shape, dtype=np.int8)
    _fill_states(start, data, np.array(block), state)
    return state


def gathered(
    where: NDArray[np.intp], start: Field, data: Data, inside: NDArray[np.bool_], block: tuple[int, ...]
) -> tuple[Field, Data, NDArray[np.bool_]]:
    """Return start, data and mask (empty for none) of the given blocks, (n, *block) each."""
    field = np.zeros((len(where), *block), dtype=np.float32)
    held = np.zeros((len(where), *block), dtype=data.dtype)
    open_cells = np.zeros((len(where), *block) if inside.size else (0, 0, 0, 0), dtype=bool)
    _gather(where, start, field)
    _gather(where, data, held)
    if inside.size:
        _gather(where, inside, open_cells)
    return field, held, open_cells


# What follows is compiled, so that no tool sees its lines run.


@njit(parallel=True, cache=True)
def _fill_states(start, data, block, state):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202  # pragma: no cover
    m0, m1, m2 = state.shape
    for row in prange(m0 * m1):
        p, q = row // m1, row % m1
        for r in range(m2):
            first = start[p * block[0], q * block[1], r * block[2]]
            same = first == 1 or first == -1
            for i in range(p * block[0], min((p + 1) * block[0], start.shape[0])):
                for j in range(q * block[1], min((q + 1) * block[1], start.shape[1])):
                    if not same:
                        break
                    for k in range(r * block[2], min((r + 1) * block[2], start.shape[2])):
                        if start[i, j, k] != first or data[i, j, k] != first:
                            same = False
            state[p, q, r] = np.int8(first) if same else MIXED


@njit(parallel=True, cache=True)
def _gather(where, whole, blocks):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202  # pragma: no cover
    _, b0, b1, b2 = blocks.shape
    for n in prange(len(where)):
        i0, j0, k0 = where[n, 0] * b0, where[n, 1] * b1, where[n, 2] * b2
        for i in range(min(b0, whole.shape[0] - i0)):
            for j in range(min(b1, whole.shape[1] - j0)):
                for k in range(min(b2, whole.shape[2] - k0)):
                    blocks[n, i, j, k] = whole[i0 + i, j0 + j, k0 + k]


@njit(parallel=True, cache=True)
def scatter(where, blocks, extents, whole):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201  # pragma: no cover
    """Write blocks back into the whole field."""
    _, b0, b1, b2 = blocks.shape
    for n in prange(len(where)):
        i0, j0, k0 = where[n, 0] * b0, where[n, 1] * b1, where[n, 2] * b2
        for i in range(extents[n, 0]):
            for j in range(extents[n, 1]):
                for k in range(extents[n, 2]):
                    whole[i0 + i, j0 + j, k0 + k] = blocks[n, i, j, k]


@njit(cache=True)
def _surrounded(n, fields, beside, sizes, alone):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202  # pragma: no cover
    """Return block `n` in a shell one cell thick of what its neighbours hold.

    Beyond the grid the shell repeats the block's own cells; for blocks left alone it is `alone[0]` for
    blocks of -1 and `alone[1]` for blocks of +1.
    """
    e0, e1, e2 = sizes
    _, b0, b1, b2 = fields.shape
    own = fields[n]
    shell = np.empty((e0 + 2, e1 + 2, e2 + 2), dtype=fields.dtype)
    for i in range(e0):
        for j in range(e1):
            for k in range(e2):
                shell[i + 1, j + 1, k + 1] = own[i, j, k]
    for up in range(2):
        other = beside[n, up]
        place, last, first = (e0 + 1 if up else 0), (e0 - 1 if up else 0), (0 if up else b0 - 1)
        for j in range(e1):
            for k in range(e2):
                if other >= 0:
                    shell[place, j + 1, k + 1] = fields[other, first, j, k]
                else:
                    shell[place, j + 1, k + 1] = own[last, j, k] if other == EDGE else alone[-other - 1]
        other = beside[n, 2 + up]
        place, last, first = (e1 + 1 if up else 0), (e1 - 1 if up else 0), (0 if up else b1 - 1)
        for i in range(e0):
            for k in range(e2):
                if other >= 0:
                    shell[i + 1, place, k + 1] = fields[other, i, first, k]
                else:
                    shell[i + 1, place, k + 1] = own[i, last, k] if other == EDGE else alone[-other - 1]
        other = beside[n, 4 + up]
        place, last, first = (e2 + 1 if up else 0), (e2 - 1 if up else 0), (0 if up else b2 - 1)
        for i in range(e0):
            for j in range(e1):
                if other >= 0:
                    shell[i + 1, j + 1, place] = fields[other, i, j, first]
                else:
                    shell[i + 1, j + 1, place] = own[i, j, last] if other == EDGE else alone[-other - 1]
    return shell


@njit(parallel=True, cache=True)
def sweep_blocks(old, held, open_cells, new, beside, extents, numbers):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201  # pragma: no cover
    """Do one step from `old` to `new` for the first blocks, as many as `beside` has rows."""
    masked = open_cells.size > 0
    phases, cells = np.array([-1, 1], dtype=np.float32), np.array([True, True])
    for n in prange(len(beside)):
        e0, e1, e2 = extents[n]
        u = _surrounded(n, old, beside, (e0, e1, e2), phases)
        if masked:
            there = _surrounded(n, open_cells, beside, (e0, e1, e2), cells)
            for i in range(e0):
                for j in range(e1):
                    for k in range(e2):
                        x, y, z = i + 1, j + 1, k + 1
                        if not there[x, y, z]:
                            continue
                        c = u[x, y, z]
                        new[n, i, j, k] = advanced(
                            c,
                            u[x - 1, y, z] if there[x - 1, y, z] else c,
                            u[x + 1, y, z] if there[x + 1, y, z] else c,
                            u[x, y - 1, z] if there[x, y - 1, z] else c,
                            u[x, y + 1, z] if there[x, y + 1, z] else c,
                            u[x, y, z - 1] if there[x, y, z - 1] else c,
                            u[x, y, z + 1] if there[x, y, z + 1] else c,
                            np.float32(held[n, i, j, k]),
                            numbers,
                        )
        else:
            for i in range(e0):
                for j in range(e1):
                    own, a, b = u[i + 1, j + 1], u[i, j + 1], u[i + 2, j + 1]
                    d, e, data, out = u[i + 1, j], u[i + 1, j + 2], held[n, i, j], new[n, i, j]
                    for k in range(e2):
                        z = k + 1
                        out[k] = advanced(
                            own[z], a[z], b[z], d[z], e[z], own[k], own[k + 2], np.float32(data[k]), numbers
                        )
