"""The scheme of `infill.allen_cahn` compiled: one fused pass a step, in float32.

Every formula is arranged so that phi = f = +-1 among equal neighbours is a fixed point to the last bit:

    v = phi + sum of w (differences)            zero where neighbours are equal
    v = v / sqrt(E + (1 - E) v v)               divides by 1 where v = +-1: see `parts_of_one`
    phi = v + p / (1 + p) (f - v)               adds zero where v = f

So a kernel may leave such cells out (`infill.sparse`) and give the same bits as one that does not. Importing
this module loads numba; each function is compiled when it is first called and then kept on disk.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import prange
from numpy.typing import NDArray

from infill.allen_cahn import Smoothing
from infill.compiling import njit
from infill.grid import spacing_of

Field = NDArray[np.float32]
Data = NDArray[np.float32] | NDArray[np.int8]
Numbers = tuple[np.float32, np.float32, np.float32, np.float32, np.float32, np.float32]


def smooth_dense(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> Field:
    """Return what `smooth_reference` returns, to 2e-5, for up to three axes, every cell in every step."""
    numbers = numbers_of(smoothing, spacing, f.ndim)
    small = np.issubdtype(f.dtype, np.integer)
    data = on_three_axes(f).astype(np.int8 if small else np.float32, copy=False)
    old = on_three_axes(f if initial is None else initial).astype(np.float32)
    inside = np.ones((0, 0, 0), dtype=bool) if mask is None else on_three_axes(mask)
    new = old.copy()
    for _ in range(smoothing.steps):
        sweep(old, data, inside, new, numbers)
        old, new = new, old
    return old.reshape(f.shape)


def on_three_axes(field: NDArray[Any]) -> NDArray[Any]:
    """Return the field as (n0, n1, n2), with axes of one cell in front, contiguous."""
    return np.ascontiguousarray(field.reshape((1,) * (3 - field.ndim) + field.shape))


def numbers_of(smoothing: Smoothing, spacing: float | tuple[float, ...], dimensions: int) -> Numbers:
    """Return the weights of the three axes, E, 1 - E and p / (1 + p)."""
    weights = smoothing.weights(spacing_of(spacing, dimensions))
    w0, w1, w2 = (np.float32(weight) for weight in (0.0,) * (3 - dimensions) + weights)
    hold = np.float32(smoothing.pull / (1 + smoothing.pull))
    return (w0, w1, w2, *parts_of_one(smoothing.decay), hold)


def parts_of_one(decay: float) -> tuple[np.float32, np.float32]:
    """Return E and 1 - E in float32 such that their sum is 1 to the last bit.

    >>> decay, rest = parts_of_one(0.7337)
    >>> bool(decay + rest == 1)
    True
    """
    one = np.float32(1)
    if decay >= 0.5:
        return np.float32(decay), one - np.float32(decay)
    rest = np.float32(1 - decay)
    # Next to 1 a decay too small to be the difference still counts, where phi is near 0.
    return max(one - rest, np.float32(decay)), rest


@njit(inline="always", cache=True, error_model="numpy")
def advanced(c, a, b, d, e, g, h, f, numbers):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201  # pragma: no cover
    """Return the value of one cell after a step, from its own, its six neighbours' and its datum."""
    w0, w1, w2, decay, rest, hold = numbers
    v = c + (w0 * ((a - c) + (b - c)) + w1 * ((d - c) + (e - c)) + w2 * ((g - c) + (h - c)))
    v = v / math.sqrt(decay + rest * (v * v))
    return v + hold * (f - v)


@njit(parallel=True, cache=True, error_model="numpy")
def sweep(u, f, inside, new, numbers):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN201  # pragma: no cover
    """Do one step from `u` to `new`, (n0, n1, n2); a neighbour that does not exist has the cell's own value."""
    n0, n1, n2 = u.shape
    masked = inside.size > 0
    for row in prange(n0 * n1):
        i, j = row // n1, row % n1
        below, above = max(i - 1, 0), min(i + 1, n0 - 1)
        left, right = max(j - 1, 0), min(j + 1, n1 - 1)
        if masked:
            for k in range(n2):
                if not inside[i, j, k]:
                    continue
                c = u[i, j, k]
                before, after = max(k - 1, 0), min(k + 1, n2 - 1)
                new[i, j, k] = advanced(
                    c,
                    u[below, j, k] if inside[below, j, k] else c,
                    u[above, j, k] if inside[above, j, k] else c,
                    u[i, left, k] if inside[i, left, k] else c,
                    u[i, right, k] if inside[i, right, k] else c,
                    u[i, j, before] if inside[i, j, before] else c,
                    u[i, j, after] if inside[i, j, after] else c,
                    np.float32(f[i, j, k]),
                    numbers,
                )
        else:
            own, data, out = u[i, j], f[i, j], new[i, j]
            a, b, d, e = u[below, j], u[above, j], u[i, left], u[i, right]
            last = n2 - 1
            for k in range(1, last):
                out[k] = advanced(own[k], a[k], b[k], d[k], e[k], own[k - 1], own[k + 1], np.float32(data[k]), numbers)
            for k in (0, last):
                before, after = max(k - 1, 0), min(k + 1, last)
                out[k] = advanced(own[k], a[k], b[k], d[k], e[k], own[before], own[after], np.float32(data[k]), numbers)
