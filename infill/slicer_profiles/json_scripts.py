"""The scripts of a process of OrcaSlicer and Bambu Studio: the key `post_process` of a .json file, a list of texts.

A process has only the keys in which it differs from the one that it inherits from. Only the value of the key is
written, so that everything else in the file stays byte for byte.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any

from infill.errors import FormatError

KEY = "post_process"
_BYTE_ORDER_MARK = "\ufeff"
_SPACE = re.compile(r"[ \t\r\n]*")


def read_json_scripts(text: str) -> list[str] | None:
    """Read the scripts of a process; None if it does not have the key.

    Raises
    ------
    FormatError
        If the file is not an object of JSON, or its scripts are not texts.

    >>> read_json_scripts('{"name": "a", "post_process": ["b", "c"]}')
    ['b', 'c']
    """
    value = _read_object(text).get(KEY)
    if value is None:
        return None
    scripts = [value] if isinstance(value, str) else value
    if not isinstance(scripts, list) or not all(isinstance(script, str) for script in scripts):
        raise FormatError(f"{KEY} is not a list of texts; correct it in the slicer")
    return scripts


def read_parent(text: str) -> str:
    """Read the name of the process from which one inherits; empty for none.

    >>> read_parent('{"inherits": "0.20mm Standard"}')
    '0.20mm Standard'
    """
    parent = _read_object(text).get("inherits")
    return parent if isinstance(parent, str) else ""


def write_json_scripts(text: str, scripts: Sequence[str]) -> str:
    r"""Write scripts into the text of a process, and change nothing else.

    >>> print(write_json_scripts('{\n    "name": "a"\n}', ["b"]))
    {
        "name": "a",
        "post_process": [
            "b"
        ]
    }
    """
    line_end = "\r\n" if "\r\n" in text else "\n"
    value = json.dumps(list(scripts), indent=4).replace("\n", f"{line_end}    ")
    start, end, inside = _find_value(text)
    if start < 0:
        value = f'{"," if inside else ""}{line_end}    "{KEY}": {value}{"" if inside else line_end}'
        start = end
    return f"{text[:start]}{value}{text[end:]}"


def _read_object(text: str) -> dict[str, Any]:
    """Read a text as an object of JSON."""
    try:
        value = json.loads(text.removeprefix(_BYTE_ORDER_MARK))
    except (ValueError, RecursionError):
        raise FormatError("it is not valid JSON; save it again in the slicer") from None
    if not isinstance(value, dict):
        raise FormatError("it is not an object of JSON; save it again in the slicer")
    return value


def _find_value(text: str) -> tuple[int, int, bool]:
    """Find the value of the key in an object of valid JSON.

    Returns
    -------
    start, end : int
        Of the last value of the key; without one, start is -1, and end is the end of the last member.
    inside : bool
        Whether the object has a member.
    """
    decoder = json.JSONDecoder()
    place = _skip(text, text.index("{") + 1)
    found, last, inside = (-1, -1), place, False
    while text[place] != "}":
        key, place = decoder.raw_decode(text, place)
        start = _skip(text, _skip(text, place) + 1)  # after the colon
        _, last = decoder.raw_decode(text, start)
        inside = True
        if key == KEY:
            found = (start, last)
        place = _skip(text, last)
        if text[place] == ",":
            place = _skip(text, place + 1)
    return (*found, inside) if found[0] >= 0 else (-1, last, inside)


def _skip(text: str, place: int) -> int:
    """Return the place of the next character that is not a blank."""
    blank = _SPACE.match(text, place)
    return place if blank is None else blank.end()
