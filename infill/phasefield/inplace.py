"""The scheme of `infill.phasefield.allen_cahn` in place, in float32, without a compiler.

The same three sub-steps are rearranged so that a step is ten passes over a block of cells that stays
in the cache. With E = decay, p = pull, w the weight of the first axis and u = c phi:

    v     = sum of (w_axis / w) u over the neighbours + k / w u     k = 1 - sum of their weights
    u new = v / sqrt(B + v^2) + c p / (1 + p) f

The scale c = sqrt(1 - E) (1 + p) and B = E (1 + p)^2 / w^2 make every other factor of the scheme
disappear. A neighbour that does not exist (beyond the grid or the mask) holds 0 and is left out of k,
which is exactly zero Neumann.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from infill.grid import spacing_of
from infill.kernels.threads import in_threads, thread_count
from infill.phasefield.allen_cahn import Smoothing

Flat = NDArray[np.float32]

CELLS_PER_BLOCK = 180000  # cells handled at once: enough that threads seldom wait for the GIL
STEPS_AT_ONCE = 8  # steps that a thread does alone: fewer barriers in exchange for a wider halo


def smooth_inplace(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
    threads: int | None = None,
) -> NDArray[np.float32]:
    """Return a field smoothed as by `smooth_reference`, to 2e-5, in float32; `f` itself is not changed."""
    weights = smoothing.weights(spacing_of(spacing, f.ndim))
    start = f if initial is None else initial
    if smoothing.steps == 0:
        return start.astype(np.float32)
    pull, decay = smoothing.pull, smoothing.decay
    scale = math.sqrt(1 - decay) * (1 + pull)
    interior = (slice(1, -1),) * f.ndim
    field = _pad(start if mask is None else np.where(mask, start, 0), interior, scale)
    data = _pad(f, interior, scale * pull / (1 + pull))
    inside_mask = np.zeros(field.shape, dtype=bool)
    inside_mask[interior] = True if mask is None else mask

    axes = list(zip(weights, [stride // field.itemsize for stride in field.strides], strict=True))
    margin = sum(shift for _, shift in axes)
    first_cell, end_cell = margin, field.size - margin  # range from the first cell of the grid to the last
    is_cell = inside_mask.ravel()
    missing_in_range = first_cell + np.flatnonzero(~is_cell[first_cell:end_cell])
    self_weight = np.full(end_cell - first_cell, np.float32(1 / weights[0] - 2 * sum(weights) / weights[0]))
    missing_cells = np.flatnonzero(~is_cell)
    for weight, shift in axes:
        for step in (-shift, shift):  # a cell keeps its share for a missing neighbour
            cells = missing_cells + step - first_cell
            self_weight[cells[(cells >= 0) & (cells < end_cell - first_cell)]] += np.float32(weight / weights[0])
    u, pull_term = field.ravel(), data.ravel()
    floor = np.float32(decay * ((1 + pull) / weights[0]) ** 2)
    shares = [(None if weight == weights[0] else np.float32(weight / weights[0]), shift) for weight, shift in axes]

    def advance(u: Flat, new: Flat, base: int, low: int, high: int, buffers: tuple[Flat, Flat]) -> None:
        """Advance the cells from `low` to `high` by one step, from `u` to `new`, which begin at cell `base`."""
        v, t = buffers[0][: high - low], buffers[1][: high - low]
        at, to = low - base, high - base
        np.multiply(u[at:to], self_weight[low - first_cell : high - first_cell], out=v)
        for share, shift in shares:
            np.add(u[at - shift : to - shift], u[at + shift : to + shift], out=t)
            if share is not None:
                t *= share
            v += t
        np.multiply(v, v, out=t)
        t += floor
        np.sqrt(t, out=t)
        v /= t
        np.add(v, pull_term[low:high], out=new[at:to])
        new[missing_in_range[slice(*np.searchsorted(missing_in_range, (low, high)))] - base] = 0

    u = _run_steps(u, smoothing.steps, margin, thread_count(threads), advance)
    result: NDArray[np.float32] = u.reshape(field.shape)[interior] * np.float32(1 / scale)
    np.clip(result, -1, 1, out=result)  # rounding can exceed it by the last bit; the result must be a phase field again
    return result if mask is None else np.where(mask, result, start).astype(np.float32)


def _run_steps(
    u: Flat,
    steps: int,
    margin: int,
    threads: int,
    advance: Callable[[Flat, Flat, int, int, int, tuple[Flat, Flat]], None],
) -> Flat:
    """Return `u` after `steps` steps, its cells divided among threads; `u` itself may be overwritten.

    A thread takes its cells plus a halo of `count` times `margin` cells on both sides, and does that many steps
    alone: the error at the edge of the halo moves one margin closer with each step and never reaches the thread's own
    cells. Then all threads synchronise.
    """
    first_cell, end_cell = margin, len(u) - margin
    threads = max(1, min(threads, (end_cell - first_cell) // (CELLS_PER_BLOCK // 2)))
    cuts = np.linspace(first_cell, end_cell, threads + 1).astype(int).tolist()
    at_once = steps if threads == 1 else max(1, min(STEPS_AT_ONCE, (cuts[1] - cuts[0]) // (8 * margin)))
    buffers = [
        (np.empty(CELLS_PER_BLOCK, dtype=np.float32), np.empty(CELLS_PER_BLOCK, dtype=np.float32))
        for _ in range(threads)
    ]

    def sweep(source_field: Flat, result: Flat, count: int, part: int, _: int) -> None:
        part_first, part_end = cuts[part], cuts[part + 1]
        low, high = max(first_cell, part_first - count * margin), min(end_cell, part_end + count * margin)
        base = low - margin
        source = source_field[base : high + margin].copy()
        target = source.copy()
        for _ in range(count):
            for at in range(low, high, CELLS_PER_BLOCK):
                advance(source, target, base, at, min(at + CELLS_PER_BLOCK, high), buffers[part])
            source, target = target, source
        result[part_first:part_end] = source[part_first - base : part_end - base]

    new = np.zeros_like(u)
    for begin in range(0, steps, at_once):
        in_threads(sweep, u, new, min(at_once, steps - begin), threads=threads)
        u, new = new, u
    return u


def _pad(values: NDArray[np.generic], interior: tuple[slice, ...], factor: float = 1.0) -> NDArray[np.float32]:
    """Scale `values` by `factor` and pad them with zeros, one cell thick, as float32."""
    padded = np.zeros(tuple(count + 2 for count in values.shape), dtype=np.float32)
    padded[interior] = values
    padded *= np.float32(factor)
    return padded
