"""Numbers and counts as a person writes them: 1,940 mm², 0.00004 mm, 1 component, 2 components."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import SupportsFloat

SMALLEST, LARGEST = 1e-9, 1e15  # beyond these, a message names the bound instead of a row of zeros
LEAST_SHARE = 0.001  # a smaller share is not worth its digits


def plain_number(value: SupportsFloat, digits: int = 3, *, separator: str = ",") -> str:
    """Write a number to some significant digits, with commas between thousands and without an exponent.

    >>> plain_number(5049.7), plain_number(5.884), plain_number(1.22e-5), plain_number(2.5, 6), plain_number(1e300)
    ('5,050', '5.88', '0.0000122', '2.5', 'over 1,000,000,000,000,000')
    """
    number = float(value)
    if number == 0 or not math.isfinite(number):
        return "0" if number == 0 else str(number)
    sign = "-" if number < 0 else ""
    if abs(number) > LARGEST:
        return f"{'under' if sign else 'over'} {sign}{LARGEST:{separator}.0f}"
    if abs(number) < SMALLEST:
        return f"{'over' if sign else 'under'} {sign}{SMALLEST:.9f}"
    rounded = f"{number:.{digits - 1}e}"
    decimals = max(digits - 1 - int(rounded.partition("e")[2]), 0)
    text = f"{float(rounded):{separator}.{decimals}f}"
    return text.rstrip("0").rstrip(".") if decimals else text


def plain_argument(value: SupportsFloat, digits: int = 6) -> str:
    """Write a number as one types it, such as the value of an option: without commas.

    >>> plain_argument(1944.6), plain_argument(1e-7), plain_argument(-0.0)
    ('1944.6', '0.0000001', '0')
    """
    return plain_number(value, digits, separator="")


def plain_place(at: Iterable[SupportsFloat], digits: int = 4) -> str:
    """Write the coordinates of a place, without an exponent and without commas within a number.

    >>> plain_place((100000.0, -45.846, 0.0))
    '(100000, -45.85, 0)'
    """
    return f"({', '.join(plain_argument(coordinate, digits) for coordinate in at)})"


def plain_share(share: float) -> str:
    """Write a share as a percentage: a tiny one as less than a thousandth.

    >>> plain_share(0.262), plain_share(0.0127), plain_share(0.00002)
    ('26%', '1.3%', 'under 0.1%')
    """
    if share < LEAST_SHARE:
        return f"under {LEAST_SHARE:.1%}"
    return f"{share:.0%}" if share >= 0.1 else f"{share:.1%}"


def count_noun(count: int, noun: str, plural: str | None = None) -> str:
    """Write a count with its noun in the right number; the plural ends in s unless it is given.

    >>> count_noun(1, "component"), count_noun(2110, "component"), count_noun(2, "branch", "branches")
    ('1 component', '2,110 components', '2 branches')
    """
    return f"{count:,} {noun if count == 1 else plural or f'{noun}s'}"
