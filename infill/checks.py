"""Checks of single numbers, so that one wrong number reads the same everywhere."""

from __future__ import annotations

import math

from infill.errors import ParameterError


def positive(name: str, value: float, unit: str = "mm") -> float:
    """Return `value` as a float, or raise ParameterError if it is not a finite number above 0.

    >>> positive("height", 6)
    6.0
    """
    number = float(value)
    if not math.isfinite(number) or number <= 0:
        raise ParameterError(f"{name} is {number:g} {unit}".rstrip() + "; it must be a finite number above 0")
    return number


def whole(name: str, value: float, low: int) -> int:
    """Return `value` as an int, or raise ParameterError if it is no whole number of at least `low`."""
    if isinstance(value, bool) or not math.isfinite(value) or value != int(value) or value < low:
        raise ParameterError(f"{name} is {value:g}; it must be a whole number of at least {low}")
    return int(value)
