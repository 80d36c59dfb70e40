"""Checks of single numbers, so that the same mistake gets the same message everywhere."""

from __future__ import annotations

import math
from collections.abc import Collection

from infill.errors import ParameterError
from infill.plain_numbers import plain_argument

SHORTEST, LONGEST = 1e-6, 1e6  # of a length in mm; beyond these, files of 32-bit numbers lose it
OTHER_NAMES = {  # of choices, in lower case
    "inch": "in",
    "inches": "in",
    "millimetre": "mm",
    "millimeter": "mm",
    "µm": "um",
    "micron": "um",
    "prusa": "prusaslicer",
    "orca": "orcaslicer",
    "bambu": "bambustudio",
    "ultimaker": "cura",
}
FARTHEST = 1e5  # mm: no machine is larger


def check_positive(name: str, value: float, unit: str = "") -> float:
    """Return `value` as a float, or raise ParameterError if it is not a finite number above 0.

    >>> check_positive("alpha", 1)
    1.0
    """
    number = _to_float(name, value)
    if not math.isfinite(number) or number <= 0:
        raise ParameterError.about(
            name, f"is {plain_argument(number)} {unit}".rstrip() + "; it must be a finite number above 0"
        )
    return number


def check_length(name: str, value: float) -> float:
    """Return `value` as a float in mm, or raise ParameterError if no mesh can have that length.

    >>> check_length("height", 6)
    6.0
    """
    number = check_positive(name, value, "mm")
    return check_range(name, number, SHORTEST, LONGEST, "mm")


def check_range(name: str, value: float, low: float, high: float, unit: str = "") -> float:
    """Return `value` as a float, or raise ParameterError if it does not lie between `low` and `high`."""
    number = _to_float(name, value)
    if not low <= number <= high:
        raise ParameterError.about(
            name,
            f"is {plain_argument(number, 10)}; it must be a number from {plain_argument(low)} to "
            f"{plain_argument(high)} {unit}".rstrip(),
        )
    return number


def check_whole_number(name: str, value: float, low: int) -> int:
    """Return `value` as an int, or raise ParameterError if it is not a whole number of at least `low`."""
    number = _to_float(name, value)
    if not math.isfinite(number) or number != int(number) or number < low:
        raise ParameterError.about(
            name, f"is {plain_argument(number, 10)}; it must be a whole number of at least {low}"
        )
    return int(value)


def _to_float(name: str, value: float) -> float:
    """Convert a number to float, or raise ParameterError for anything else."""
    if isinstance(value, bool | str | bytes):  # float() would take True for 1 and "6" for 6
        raise ParameterError.about(name, f"is {value!r}; it must be a number")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ParameterError.about(name, f"is {value!r}; it must be a number") from None
    except OverflowError:
        return math.inf


def choose_word(word: str, choices: Collection[str]) -> str:
    """Return the choice that a word means: itself, whatever its case, or another name of it; else the word.

    >>> choose_word("Prusa", ["prusaslicer", "cura"]), choose_word("inch", ["mm", "in"]), choose_word("x", ["mm"])
    ('prusaslicer', 'in', 'x')
    """
    lower = word.strip().lower()
    meant = OTHER_NAMES.get(lower, lower)
    return word if word in choices or meant not in choices else meant
