"""Which files are pictures."""

from __future__ import annotations

import os
from pathlib import Path

from infill.errors import FormatError

SUFFIXES = (".png",)


def is_picture(path: str | os.PathLike[str]) -> bool:
    """Return whether a path names a picture format we can write.

    >>> is_picture("block.PNG"), is_picture("block.stl")
    (True, False)
    """
    return Path(path).suffix.lower() in SUFFIXES


def check_preview(path: str | os.PathLike[str]) -> Path:
    """Return the path, or raise FormatError if it does not name a picture format we can write."""
    target = Path(path)
    if not is_picture(target):
        raise FormatError(f"a preview cannot be written as {target.name!r}; use a name that ends in {SUFFIXES[0]}")
    return target
