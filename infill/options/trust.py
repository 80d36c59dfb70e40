"""Trust in options from a file: without it, they may not run code, or read files from elsewhere.

Typed options are the user's own. A config file or a project may come from somebody else, and names in it decide which
code is run and which files are read; so readers of options from a file call `check_trusted` first.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from infill.errors import FormatError
from infill.files.array_names import split_array_name
from infill.files.excerpts import excerpt
from infill.options.modules import names_code

FILES = ("pattern", "by", "labels", "region")  # options whose value may be the name of a file
PATTERN_KEY = re.compile(r"[:,]\s*pattern\s*=\s*")  # before the pattern of a region
SETTING = re.compile(r"[:,]\s*\w+\s*=")  # before another setting of it
ELSEWHERE = re.compile(r"[\\/]{2}|[A-Za-z]:|~")  # another machine, another drive, another home


def check_trusted(options: Mapping[str, Any], source: Path, *, trust: bool = False, code: bool = True) -> None:
    """Raise FormatError if options from a file ask to run code, or to read a file that is not beside it.

    Parameters
    ----------
    options : mapping
        By name, as the file has them, without those that typed options replace.
    source : Path
        The file. Options may name files below its folder, or below the current one.
    trust : bool
        True if the user trusts the file: everything is allowed.
    code : bool
        True if the command runs code at all; otherwise ``module.py:name`` is just a wrong name.

    Examples
    --------
    >>> check_trusted({"pattern": "gyroid", "density": "20%"}, Path("theirs.3mf"))
    """
    if trust:
        return
    for name, text in _split_regions(_texts(options)):
        word = name.replace("_", "-")
        if code and names_code(text):
            raise FormatError(
                f"{source} asks to run code: {word} = '{excerpt(text)}'; look at that code, then give --trust, or "
                f"type --{word} yourself"
            )
        if name in FILES and _leads_elsewhere(str(split_array_name(text)[0]), source):
            raise FormatError(
                f"{source} asks to read a file from elsewhere: {word} = '{excerpt(text)}'; give --trust, or type "
                f"--{word} yourself"
            )


def _texts(value: object, name: str = "") -> Iterator[tuple[str, str]]:
    """Yield every text among values, in lists and tables too, with the name of its option."""
    if isinstance(value, str):
        yield name, value
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from _texts(item, name or excerpt(str(key)))
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from _texts(item, name)


def _split_regions(texts: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Yield texts as they are, and of regions, which may hold the names of two files, each of these too."""
    for name, text in texts:
        yield name, text
        if name == "region":
            yield from ((name, SETTING.split(word)[0]) for word in PATTERN_KEY.split(text))


def _leads_elsewhere(text: str, source: Path) -> bool:
    """Tell whether a text names a file outside the folder of a source and the current folder."""
    if ELSEWHERE.match(text):
        return True
    if "/" not in text and "\\" not in text and not Path(text).suffix:
        return False  # the name of a pattern
    if "\0" in text:
        return True
    # Compare the letters first, as following links may contact another machine.
    folders = [Path.cwd(), Path(os.path.abspath(source)).parent]  # noqa: PTH100
    if not any(Path(os.path.abspath(text)).is_relative_to(folder) for folder in folders):  # noqa: PTH100
        return True
    real = Path(os.path.realpath(text))
    return not any(real.is_relative_to(os.path.realpath(folder)) for folder in folders)
