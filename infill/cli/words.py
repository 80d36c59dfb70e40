"""Words on the command line that stand for numbers."""

from __future__ import annotations

import re

from infill.errors import ParameterError

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
