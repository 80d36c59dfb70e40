"""The scheme of `infill.phasefield.allen_cahn` compiled: one fused pass per step, in float32.

Every formula is arranged so that phi = f = +-1 among equal neighbours is a fixed point to the last bit:

    v = phi + sum of w (differences)            zero where neighbours are equal
    v = v / sqrt(E + (1 - E) v v)               divides by 1 where v = +-1: see `split_one`
    phi = v + p / (1 + p) (f - v)               adds zero where v = f

A kernel may therefore leave such cells out (`infill.phasefield.sparse`) with a result identical to the last bit.
Importing this module loads numba; each function is compiled when it is first called and then kept on disk.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Field
from infill.grid import spacing_of
from infill.kernels.dense import sweep
from infill.phasefield.allen_cahn import Smoothing

Data = NDArray[np.float32] | NDArray[np.int8]
StepCoefficients = tuple[np.float32, np.float32, np.float32, np.float32, np.float32, np.float32]


def smooth_dense(
    f: NDArray[np.generic],
    smoothing: Smoothing,
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: NDArray[np.generic] | None = None,
    mask: NDArray[np.bool_] | None = None,
) -> Field:
    """Smooth like `smooth_reference`, to 2e-5, on up to three axes, with every cell in every step."""
    coefficients = step_coefficients(smoothing, spacing, f.ndim)
    is_integer = np.issubdtype(f.dtype, np.integer)
    data = on_three_axes(f).astype(np.int8 if is_integer else np.float32, copy=False)
    old = on_three_axes(f if initial is None else initial).astype(np.float32)
    inside = np.ones((0, 0, 0), dtype=bool) if mask is None else on_three_axes(mask)
    new = old.copy()
    for _ in range(smoothing.steps):
        sweep(old, data, inside, new, coefficients)
        old, new = new, old
    return old.reshape(f.shape)


def on_three_axes(field: NDArray[Any]) -> NDArray[Any]:
    """Return the field as (n0, n1, n2), contiguous, with axes of one cell prepended."""
    return np.ascontiguousarray(field.reshape((1,) * (3 - field.ndim) + field.shape))


def step_coefficients(smoothing: Smoothing, spacing: float | tuple[float, ...], dimensions: int) -> StepCoefficients:
    """Return three weights, decay E, 1 - E and p / (1 + p) of pull p, as float32; 0 for a missing axis."""
    weights = smoothing.weights(spacing_of(spacing, dimensions))
    w0, w1, w2 = (np.float32(weight) for weight in (0.0,) * (3 - dimensions) + weights)
    hold = np.float32(smoothing.pull / (1 + smoothing.pull))
    return (w0, w1, w2, *split_one(smoothing.decay), hold)


def split_one(decay: float) -> tuple[np.float32, np.float32]:
    """Return E and 1 - E in float32 such that their sum is 1 to the last bit.

    >>> decay, rest = split_one(0.7337)
    >>> bool(decay + rest == 1)
    True
    """
    one = np.float32(1)
    if decay >= 0.5:
        return np.float32(decay), one - np.float32(decay)
    rest = np.float32(1 - decay)
    # A decay too small to register next to 1 still matters where phi is near 0.
    return max(one - rest, np.float32(decay)), rest
