"""Words on the command line that stand for numbers."""

from __future__ import annotations

import math
import re
from typing import Literal

from infill.errors import ParameterError

ENDLESS = 10**9  # layers
BYTES = {"": 1, "K": 2**10, "M": 2**20, "G": 2**30, "T": 2**40}


def parse_bytes(text: str) -> int:
    """Return the number of bytes in ``2G``, ``500MB`` or ``1.5 GiB``.

    >>> parse_bytes("2G")
    2147483648
    """
    found = re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*([KMGT]?)(?:i?B)?\s*", text, re.IGNORECASE)
    if not found or float(found[1]) <= 0:
        raise ParameterError(f"the memory limit is {text!r}; give a number above 0 with K, M, G or T, such as 2G")
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
    if len(numbers) not in counts or not all(math.isfinite(number) for number in numbers):
        wanted = " or ".join(map(str, counts))
        raise ParameterError(f"{name} is {text!r}; give {wanted} number(s), with commas between")
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
        raise ParameterError(f"level is {text!r}; give volume, or a number between -1 and 1") from None


def parse_radius(text: str) -> str | float:
    """Return "auto" or a number of mm, or raise ParameterError.

    >>> parse_radius("1.5")
    1.5
    """
    if text == "auto":
        return text
    try:
        return float(text)
    except ValueError:
        raise ParameterError(f"smooth radius is {text!r}; give auto, or a number in mm") from None


def parse_share(text: str) -> str | float:
    """Return "same", or the share in ``20%`` or ``0.2``, or raise ParameterError.

    >>> parse_share("20%"), parse_share("same")
    (0.2, 'same')
    """
    if text == "same":
        return text
    found = re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*(%?)\s*", text)
    share = float(found[1]) / (100 if found[2] else 1) if found else 0.0
    if not 0 < share <= 1:
        raise ParameterError(f"density is {text!r}; give same, or a share such as 20%")
    return share


def parse_range(name: str, text: str) -> tuple[int, int]:
    """Return the first and the last of ``5-20``, ``5-`` or ``5``, or raise ParameterError.

    >>> parse_range("layers", "5-20")
    (5, 20)
    """
    found = re.fullmatch(r"\s*(\d+)\s*(?:(-)\s*(\d*)\s*)?", text)
    if not found:
        raise ParameterError(f"{name} is {text!r}; give a range such as 5-20, or 5-")
    first = int(found[1])
    return first, int(found[3]) if found[3] else ENDLESS if found[2] else first
