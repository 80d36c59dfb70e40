"""Names of picture files, and the formats that are written."""

from __future__ import annotations

import os
from pathlib import Path

from infill.errors import FormatError

SUFFIXES = (".png",)


def is_picture(path: str | os.PathLike[str]) -> bool:
    """Tell whether a path ends in .png, the only picture format that is written.

    >>> is_picture("block.PNG"), is_picture("block.stl")
    (True, False)
    """
    return Path(path).suffix.lower() in SUFFIXES


def check_preview(path: str | os.PathLike[str]) -> Path:
    """Return the path; raise FormatError if it does not have the suffix of a picture format that can be written."""
    target = Path(path)
    if not is_picture(target):
        raise FormatError(f"a preview cannot be written as {target.name!r}; use a name that ends in {SUFFIXES[0]}")
    return target
