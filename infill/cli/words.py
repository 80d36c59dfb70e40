"""Words on the command line that stand for numbers."""

from __future__ import annotations

import re

from infill.errors import ParameterError, UsageError

BYTES = {"": 1, "K": 2**10, "M": 2**20, "G": 2**30, "T": 2**40}


def parse_bytes(text: str) -> int:
    """Parse the number of bytes in ``2G``, ``500MB`` or ``1.5 GiB``.

    >>> parse_bytes("2G")
    2147483648
    """
    advice = "give a number above 0 with K, M, G or T, such as 2G"
    match = re.fullmatch(r"\s*(-?\d+(?:\.\d+)?|nan)\s*([KMGT]?)(?:i?B)?\s*", text, re.IGNORECASE)
    if not match:
        raise UsageError.about("max_memory", f"is {text!r}; {advice}")
    if not float(match[1]) > 0:
        raise ParameterError.about("max_memory", f"is {text!r}; {advice}")
    return int(float(match[1]) * BYTES[match[2].upper()])
