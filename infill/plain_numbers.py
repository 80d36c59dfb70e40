"""Numbers and counts as a person writes them: 1,940 mm², 0.00004 mm, 1 component, 2 components."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import SupportsFloat

SMALLEST, LARGEST = 1e-9, 1e15  # beyond these, a message names the bound instead of a row of zeros
UNITS = {"nm": 1e-6, "µm": 1e-3, "mm": 1.0, "m": 1e3, "km": 1e6}  # mm
FEWEST_UNITS = 0.001  # of a length, an area or a volume: for less, the next smaller unit is used
MOST_UNITS = {1: 1e5, 2: 1e8, 3: 1e9}  # for as many, the next larger one
POWERS = {1: "", 2: "²", 3: "³"}
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


def choose_unit(*values: SupportsFloat, power: int = 1) -> str:
    """Choose the unit of lengths, areas or volumes by the largest: mm where a person would, else nm, µm, m or km.

    Parameters
    ----------
    *values : float
        mm, mm² or mm³.
    power : int
        1 for lengths, 2 for areas, 3 for volumes.

    >>> choose_unit(12.345), choose_unit(1.234e-4), choose_unit(1.234e-4, 0.1), choose_unit(2e-9, power=3)
    ('mm', 'µm', 'mm', 'µm')
    """
    numbers = [float(value) for value in values]
    largest = max((abs(number) for number in numbers if math.isfinite(number)), default=0.0)
    names, unit = list(UNITS), "mm"
    while 0 < largest * UNITS[unit] ** -power < FEWEST_UNITS and unit != names[0]:
        unit = names[names.index(unit) - 1]
    while largest * UNITS[unit] ** -power >= MOST_UNITS[power] and unit != names[-1]:
        unit = names[names.index(unit) + 1]
    return unit


def list_some(items: Sequence[object], most: int) -> str:
    """List the first items of a sequence; "…" stands for more.

    >>> list_some(["liver", "spleen"], 2), list_some([1, 2, 3], 2)
    ('liver, spleen', '1, 2, …')
    """
    return ", ".join(map(str, items[:most])) + (", …" if len(items) > most else "")


def plain_size(
    *values: SupportsFloat, digits: int = 3, power: int = 1, separator: str = ",", unit: str | None = None
) -> str:
    """Write lengths, areas or volumes with their unit.

    Parameters
    ----------
    *values : float
        mm, mm² or mm³. Several, such as the sides of a part, share the unit of the largest.
    digits : int
    power : int
        1 for lengths, 2 for areas, 3 for volumes.
    separator : str
        Between thousands.
    unit : str, optional
        One of `UNITS`, such as that of another size in the same message; the choice of `choose_unit` by default.

    >>> plain_size(12.345), plain_size(1.234e-4), plain_size(123456789), plain_size(2e-9, power=3)
    ('12.3 mm', '0.123 µm', '123 km', '2 µm³')
    >>> plain_size(0.002, 0.0004), plain_size(8834810, power=3, digits=6), plain_size(0)
    ('0.002 x 0.0004 mm', '8,834,810 mm³', '0 mm')
    >>> plain_size(1.234e-4, unit="mm")
    '0.000123 mm'
    """
    unit = choose_unit(*values, power=power) if unit is None else unit
    scaled = (float(value) * UNITS[unit] ** -power for value in values)
    return f"{' x '.join(plain_number(number, digits, separator=separator) for number in scaled)} {unit}{POWERS[power]}"


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


def plain_clock(seconds: float) -> str:
    """Write a time, s, as hours, minutes and seconds.

    >>> plain_clock(8287.2), plain_clock(59.94)
    ('2:18:07', '0:01:00')
    """
    total = round(seconds)
    return f"{total // 3600}:{total // 60 % 60:02}:{total % 60:02}"


def count_noun(count: int, noun: str, plural: str | None = None) -> str:
    """Write a count with its noun in the right number; the plural ends in s unless it is given.

    >>> count_noun(1, "component"), count_noun(2110, "component"), count_noun(2, "branch", "branches")
    ('1 component', '2,110 components', '2 branches')
    """
    return f"{count:,} {noun if count == 1 else plural or f'{noun}s'}"
