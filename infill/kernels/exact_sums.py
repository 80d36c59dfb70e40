"""Sums of floating-point numbers without rounding, compiled: see `infill.voxels.exact_sums`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

EXPONENTS = 2048  # of double precision
MANTISSA_BITS = 52
LOW_BITS = 26  # of the mantissa; its parts, of 27 and 26 bits, add up without overflow for 2^36 numbers
MANTISSA, LOW = np.int64(2**MANTISSA_BITS - 1), np.int64(2**LOW_BITS - 1)


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
        high, low = mantissa >> LOW_BITS, mantissa & LOW
        if bits[t] < 0:
            high, low = -high, -low
        sums[side[t], exponent, 0] += high
        sums[side[t], exponent, 1] += low
