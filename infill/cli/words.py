"""Words on the command line that stand for numbers."""

from __future__ import annotations

import math
import re
from typing import Literal

from infill.errors import ParameterError, UsageError

BYTES = {"": 1, "K": 2**10, "M": 2**20, "G": 2**30, "T": 2**40}


def parse_bytes(text: str) -> int:
    """Return the number of bytes in ``2G``, ``500MB`` or ``1.5 GiB``.

    >>> parse_bytes("2G")
    2147483648
    """
    advice = "give a number above 0 with K, M, G or T, such as 2G"
    found = re.fullmatch(r"\s*(-?\d+(?:\.\d+)?|nan)\s*([KMGT]?)(?:i?B)?\s*", text, re.IGNORECASE)
    if not found:
        raise UsageError(f"max_memory is {text!r}; {advice}")
    if not float(found[1]) > 0:
        raise ParameterError(f"max_memory is {text!r}; {advice}")
    return int(float(found[1]) * BYTES[found[2].upper()])


def parse_numbers(name: str, text: str, counts: tuple[int, ...]) -> tuple[float, ...]:
    """Return the numbers in a text such as "0.9,0.9,1.5", or raise ParameterError if their count is not in `counts`.

    >>> parse_numbers("range", "200, 900", (2,))
    (200.0, 900.0)
    """
    try:
        numbers = tuple(float(part) for part in text.split(","))
    except ValueError:
        numbers = ()
    if len(numbers) not in counts:
        wanted = " or ".join(map(str, counts))
        raise UsageError(f"{name} is {text!r}; give {wanted} number(s), with commas between")
    if not all(map(math.isfinite, numbers)):
        raise ParameterError(f"{name} is {text!r}; give finite numbers")
    return numbers


def parse_level(text: str) -> Literal["volume"] | float:
    """Return the level of a surface, by name or number, or raise ParameterError.

    >>> parse_level("0")
    0.0
    """
    if text == "volume":
        return "volume"
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"level is {text!r}; give volume, or a number between -1 and 1") from None
