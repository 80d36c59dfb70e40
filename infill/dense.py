"""The scheme of `infill.allen_cahn` in place, in float32, without a compiler.

The same three sub-steps, rearranged so that a step is ten passes over a block of cells that stays
in the cache. With E = decay, p = pull, w the weight of the first axis and u = c phi:

    v     = sum of (w_axis / w) u over the neighbours + k / w u     k = 1 - sum of their weights
    u new = v / sqrt(B + v^2) + c p / (1 + p) f

The scale c = sqrt(1 - E) (1 + p) and B = E (1 + p)^2 / w^2 make every other factor of the scheme
vanish. A neighbour that does not exist (beyond the grid or the mask) holds 0 and is left out of k:
that is zero Neumann.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from infill.allen_cahn import Smoothing
from infill.grid import spacing_of
from infill.machine import usable_cores

Flat = NDArray[np.float32]

BLOCK = 131072  # cells handled at once: long enough that threads seldom wait for the interpreter


def smooth_dense(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> NDArray[np.float32]:
    """Return what `smooth_reference` returns, to 2e-5, in float32 and 15 or more times faster in 2D."""
    weights = smoothing.weights(spacing_of(spacing, f.ndim))
    start = f if initial is None else initial
    if smoothing.steps == 0:
        return start.astype(np.float32)
    pull, decay = smoothing.pull, smoothing.decay
    scale = math.sqrt(1 - decay) * (1 + pull)
    interior = (slice(1, -1),) * f.ndim
    exists = _padded(np.ones(f.shape, dtype=np.float32) if mask is None else mask, interior)
    field = _padded(start, interior, scale)
    data = _padded(f, interior, scale * pull / (1 + pull))
    if mask is not None:
        field *= exists

    axes = list(zip(weights, [stride // field.itemsize for stride in field.strides], strict=True))
    margin = sum(shift for _, shift in axes)
    first, last = margin, field.size - margin  # from the first cell of the grid to the last
    here, there = exists.ravel()[first:last], exists.ravel()
    keep = np.full_like(here, 1 / weights[0])
    for weight, shift in axes:
        for neighbour in (there[first - shift : last - shift], there[first + shift : last + shift]):
            keep -= np.float32(weight / weights[0]) * neighbour

    missing = first + np.flatnonzero(here == 0)
    u, known = field.ravel(), data.ravel()
    new = np.zeros_like(u)
    floor = np.float32(decay * ((1 + pull) / weights[0]) ** 2)
    shares = [(None if weight == weights[0] else np.float32(weight / weights[0]), shift) for weight, shift in axes]

    def advance(u: Flat, new: Flat, low: int, high: int, buffers: tuple[Flat, Flat]) -> None:
        v, t = buffers[0][: high - low], buffers[1][: high - low]
        np.multiply(u[low:high], keep[low - first : high - first], out=v)
        for share, shift in shares:
            np.add(u[low - shift : high - shift], u[low + shift : high + shift], out=t)
            if share is not None:
                t *= share
            v += t
        np.multiply(v, v, out=t)
        t += floor
        np.sqrt(t, out=t)
        v /= t
        np.add(v, known[low:high], out=new[low:high])
        new[missing[slice(*np.searchsorted(missing, (low, high)))]] = 0

    u = _march(u, new, smoothing.steps, (first, last), advance)
    result: NDArray[np.float32] = u.reshape(field.shape)[interior] * np.float32(1 / scale)
    return result if mask is None else np.where(mask, result, start).astype(np.float32)


def _march(
    u: Flat,
    new: Flat,
    steps: int,
    span: tuple[int, int],
    advance: Callable[[Flat, Flat, int, int, tuple[Flat, Flat]], None],
) -> Flat:
    """Return `u` after `steps`; each thread advances its own part of the span, and all meet after a step."""
    threads = max(1, min(usable_cores(), (span[1] - span[0]) // (BLOCK // 2)))
    cuts = np.linspace(*span, threads + 1).astype(int).tolist()
    barrier = threading.Barrier(threads)

    def sweep(part: int) -> None:
        source, target = u, new
        buffers = np.empty(BLOCK, dtype=np.float32), np.empty(BLOCK, dtype=np.float32)
        done = False
        try:
            for _ in range(steps):
                for low in range(cuts[part], cuts[part + 1], BLOCK):
                    advance(source, target, low, min(low + BLOCK, cuts[part + 1]), buffers)
                barrier.wait()
                source, target = target, source
            done = True
        finally:
            if not done:
                barrier.abort()  # nobody waits for a thread that failed or was interrupted

    with ThreadPoolExecutor(threads) as pool:
        helpers = [pool.submit(sweep, part) for part in range(1, threads)]
        try:
            sweep(0)
        except threading.BrokenBarrierError:
            for helper in helpers:
                helper.result()  # one of them says why
            raise
    return u if steps % 2 == 0 else new


def _padded(values: NDArray[np.generic], interior: tuple[slice, ...], factor: float = 1.0) -> NDArray[np.float32]:
    """Return `values` times `factor` as float32 in a shell of zeros one cell thick."""
    padded = np.zeros(tuple(count + 2 for count in values.shape), dtype=np.float32)
    np.multiply(values, np.float32(factor), out=padded[interior], casting="unsafe")
    return padded
