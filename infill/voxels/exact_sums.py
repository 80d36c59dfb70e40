"""Sums without rounding: those of the parts of a volume add up to that of the whole, in any order."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

LARGEST_ITEM = 4  # bytes of whole numbers whose sum over a slab of cells fits into 64 bits
BIAS = 1075  # the exponent of a double whose mantissa, as a whole number, is its value


def sums_by_side(values: NDArray[Any], side: NDArray[np.bool_]) -> tuple[Fraction, Fraction]:
    """Return the sums of the values where `side` is False, and where it is True, exactly.

    Parameters
    ----------
    values : (...) numbers
        Up to 2^31 of them, finite; 64-bit whole numbers are rounded to double precision first.
    side : (...) bool

    >>> sums_by_side(np.array([0.1, 1e300, 0.1, -1e300]), np.array([True, True, False, True]))[1] == Fraction(0.1)
    True
    """
    if values.dtype.kind in "iub" and values.dtype.itemsize <= LARGEST_ITEM:
        whole, above = values.sum(dtype=np.int64), values.sum(where=side, dtype=np.int64)
        return Fraction(int(whole - above)), Fraction(int(above))
    from infill.kernels.chunk_sums import EXPONENTS, MANTISSA_LOW_BITS, add_by_exponent

    numbers = np.ascontiguousarray(values, dtype=np.float64).reshape(-1)
    tables = np.zeros((2, EXPONENTS, 2), dtype=np.int64)
    add_by_exponent(numbers.view(np.int64), np.ascontiguousarray(side).reshape(-1).view(np.uint8), tables)
    totals = []
    for table in tables:
        used = np.flatnonzero(table.any(axis=1)).tolist()
        parts = ((table[n].tolist(), max(n, 1)) for n in used)  # exponent 0 is that of subnormal numbers
        total = sum(((high << MANTISSA_LOW_BITS) + low) << exponent for (high, low), exponent in parts)
        totals.append(Fraction(total, 1 << BIAS))
    return totals[0], totals[1]


def exact_sum(values: NDArray[Any]) -> Fraction:
    """Return the sum of values (...), exactly: see `sums_by_side`."""
    return sums_by_side(values, np.ones(values.shape, dtype=bool))[1]
