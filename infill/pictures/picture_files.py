"""Names of files that show a result: pictures, and pages for a browser."""

from __future__ import annotations

import os
from pathlib import Path

from infill.errors import FormatError

SUFFIXES = (".png",)
PAGES = (".html",)


def is_picture(path: str | os.PathLike[str]) -> bool:
    """Tell whether a path ends in .png, the only picture format that is written.

    >>> is_picture("block.PNG"), is_picture("block.stl")
    (True, False)
    """
    return Path(path).suffix.lower() in SUFFIXES


def is_page(path: str | os.PathLike[str]) -> bool:
    """Tell whether a path ends in .html: a page that shows a result in a browser.

    >>> is_page("view.HTML"), is_page("view.png")
    (True, False)
    """
    return Path(path).suffix.lower() in PAGES


def check_preview(path: str | os.PathLike[str], *, pages: bool = False) -> Path:
    """Return the path; raise FormatError if it does not have the suffix of a format that can be written.

    Parameters
    ----------
    path : str or Path
    pages : bool
        Whether a page is possible as well as a picture.
    """
    target = Path(path)
    suffixes = (*SUFFIXES, *PAGES) if pages else SUFFIXES
    if target.suffix.lower() not in suffixes:
        raise FormatError(
            f"a preview cannot be written as {target.name!r}; use a name that ends in {' or '.join(suffixes)}"
        )
    return target
