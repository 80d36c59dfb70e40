"""Readers of option values from a TOML file or the command line: each checks values of one kind."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Literal

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import quote_value
from patterns.quantities import parse_quantity

LONGEST_WORD = 1000  # signs of a name, also of a file
LARGEST_WHOLE = 2**53  # as floating-point numbers count without gaps
MOST_DIGITS = 18  # of a number in a range
Reader = Callable[[str, object], Any]


def parse_word(name: str, value: object) -> str:
    """Return a value that must be a word, or raise UsageError."""
    if not isinstance(value, str) or not value.strip():
        raise UsageError.about(name, f"is {quote_value(value)}; it must be a word")
    if len(value) > LONGEST_WORD:
        raise ParameterError.about(name, f"is {quote_value(value)}, of {len(value):,} signs; give a name")
    return value


def parse_share(name: str, value: object, advice: str = "give a share such as 20%") -> float:
    """Parse a share in percent, as ``20%`` or 20, or up to 1 as 0.2; raise UsageError, or ParameterError off range.

    >>> [parse_share("density", value) for value in ("20%", "20", 20, "0,2", 0.2, 1)]
    [0.2, 0.2, 0.2, 0.2, 0.2, 1.0]
    """
    if isinstance(value, str):
        bare = value.strip().removesuffix("%")
        number = parse_quantity(bare)
        if number is None:
            raise UsageError.about(name, f"is {quote_value(value)}; {advice}")
        share = to_share(number) if bare == value.strip() else number / 100
    else:
        share = to_share(parse_number(name, value))
    if not 0 < share <= 1:
        raise ParameterError.about(name, f"is {quote_value(value)}; {advice}")
    return float(share)


def to_share(value: float) -> float:
    """Return a share from a share of 1 or less, or from a percentage above 1.

    >>> to_share(0.2), to_share(20), to_share(1)
    (0.2, 0.2, 1)
    """
    return value / 100 if value > 1 else value


def parse_flag(name: str, value: object) -> bool:
    """Check true or false, or raise UsageError."""
    if not isinstance(value, bool):
        raise UsageError.about(name, f"is {quote_value(value)}; it must be true or false")
    return value


def parse_number(name: str, value: object) -> float:
    """Check a number, or raise UsageError."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise UsageError.about(name, f"is {quote_value(value)}; it must be a number")
    return check_fits_float(name, value)


def check_fits_float(name: str, value: float) -> float:
    """Return a number unchanged, or raise ParameterError if it is too large for a float."""
    try:
        float(value)
    except OverflowError:
        raise ParameterError.about(name, f"is {quote_value(value)}; give a number below 1e308") from None
    return value


def read_number(name: str, value: object, unit: str = "") -> float:
    """Read a number, or a text with one and perhaps a unit; raise ValueError for another text, or as `parse_number`.

    >>> read_number("radius", "0,5"), read_number("radius", "2 mm", "mm"), read_number("radius", 3)
    (0.5, 2.0, 3.0)
    """
    if not isinstance(value, str):
        return float(parse_number(name, value))
    number = parse_quantity(value, unit)
    if number is None:
        raise ValueError(value)
    return number


def check_whole(name: str, value: object) -> int:
    """Return an int unchanged, or raise UsageError; 5.0, True and text are refused."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise UsageError.about(name, f"is {quote_value(value)}; it must be a whole number")
    if abs(value) > LARGEST_WHOLE:
        raise ParameterError.about(name, f"is {quote_value(value)}; give a whole number up to {LARGEST_WHOLE:,}")
    return value


def parse_wholes(name: str, value: object) -> tuple[int, ...]:
    """Return an integer, or a list or tuple of integers, as a tuple, or raise UsageError.

    >>> parse_wholes("label", [3, 4]), parse_wholes("label", 3)
    ((3, 4), (3,))
    """
    values = value if isinstance(value, (list, tuple)) else (value,)
    if not values:
        raise UsageError.about(name, "is empty; give a whole number, or several")
    return tuple(check_whole(name, number) for number in values)


def parse_ranges(name: str, value: object) -> tuple[tuple[int, int | None], ...]:
    """Parse numbers from 1 on and ranges of them, as text or as a list; return the first and last number of each.

    The last is None where a range goes on to the end.

    Raises
    ------
    UsageError
        If the value is not such text.
    ParameterError
        If a number is 0, or a range ends before it begins.

    >>> parse_ranges("keep_components", "1, 3-5,8-"), parse_ranges("keep_components", [1, 3])
    (((1, 1), (3, 5), (8, None)), ((1, 1), (3, 3)))
    """
    words = value.split(",") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
    problem = f"is {quote_value(value)}; give numbers from 1 on and ranges: 1,3-5 or 2-"
    ranges = []
    for word in words or [""]:
        first, dash, last = str(word).strip().partition("-")
        if not all(end.isascii() and end.isdecimal() and len(end) < MOST_DIGITS for end in (first, last or first)):
            raise UsageError.about(name, problem)
        low = int(first)
        high = int(last) if last else None if dash else low
        if low < 1 or (high is not None and high < low):
            raise ParameterError.about(name, problem)
        ranges.append((low, high))
    return tuple(ranges)


def parse_range_text(name: str, value: object) -> str:
    """Return numbers and ranges as `parse_ranges` takes them, as text.

    >>> parse_range_text("keep_components", [1, 3]), parse_range_text("keep_components", "1, 3-5")
    ('1,3', '1,3-5')
    """
    words = [
        f"{low}" if low == high else f"{low}-{'' if high is None else high}" for low, high in parse_ranges(name, value)
    ]
    return ",".join(words)


def parse_numbers(name: str, value: object, counts: tuple[int, ...]) -> tuple[float, ...]:
    """Parse numbers with commas between, or in a list; raise UsageError if their count is not in `counts`.

    >>> parse_numbers("range", "200, 900", (2,)), parse_numbers("spacing", 0.5, (1, 3))
    ((200.0, 900.0), (0.5,))
    """
    parts: Sequence[Any] = (
        value.split(",") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
    )
    try:
        numbers = tuple(read_number(name, part) for part in parts)
    except (ValueError, ParameterError):
        numbers = ()
    if len(numbers) not in counts:
        expected = " or ".join(map(str, counts))
        noun = "number" if counts == (1,) else "numbers"
        raise UsageError.about(name, f"is {quote_value(value)}; give {expected} {noun}, with commas between")
    if not all(map(math.isfinite, numbers)):
        raise ParameterError.about(name, f"is {quote_value(value)}; give finite numbers")
    return numbers


def parse_level(name: str, value: object) -> Literal["volume"] | float:
    """Parse the level of a surface, by name or number, or raise UsageError.

    >>> parse_level("level", "0")
    0.0
    """
    if value == "volume":
        return "volume"
    try:
        return read_number(name, value)
    except ValueError:
        raise UsageError.about(name, f"is {quote_value(value)}; give volume, or a number between -1 and 1") from None
