r"""The scripts of a print profile of PrusaSlicer and SuperSlicer: the key `post_process` of an .ini file.

Its value is a list of texts with semicolons between them. A text with blanks, quotes or backslashes stands in double
quotes, where a backslash comes before a quote or a backslash, and line breaks are `\n` and `\r`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from infill.errors import FormatError

_ENTRY = re.compile(r"^([ \t]*post_process[ \t]*=)([^\r\n]*)", re.MULTILINE)
_BLANKS = " \t"
_ESCAPES = {"n": "\n", "r": "\r"}
_QUOTED = re.compile(r"""[ \t\\"\r\n;]""")


def read_ini_scripts(text: str) -> list[str]:
    r"""Read the scripts of a profile; none if it does not have the key.

    Raises
    ------
    FormatError
        If the list cannot be read.

    >>> read_ini_scripts('perimeters = 2\npost_process = "/my tools/a\\nb -c";d\n')
    ['/my tools/a\nb -c', 'd']
    """
    entry = _ENTRY.search(text)
    return [] if entry is None else _read_list(entry[2].strip(_BLANKS))


def write_ini_scripts(text: str, scripts: Sequence[str]) -> str:
    r"""Write scripts into the text of a profile, and change nothing else.

    >>> write_ini_scripts("post_process = \nperimeters = 2\n", ["/my tools/a", "d"])
    'post_process = "/my tools/a";d\nperimeters = 2\n'
    """
    value = " " + ";".join(_write_text(script, single=len(scripts) == 1) for script in scripts)
    entry = _ENTRY.search(text)
    if entry is not None:
        return f"{text[: entry.end(1)]}{value}{text[entry.end() :]}"
    line_end = "\r\n" if "\r\n" in text else "\n"
    separator = "" if not text or text.endswith("\n") else line_end
    return f"{text}{separator}post_process ={value}{line_end}"


def _read_list(value: str) -> list[str]:
    """Read a list of texts with semicolons between them."""
    if not value:
        return []
    scripts, place = [], 0
    while True:
        while value[place : place + 1] in (" ", "\t"):
            place += 1
        if value[place : place + 1] == '"':
            script, place = _read_quoted(value, place + 1)
        else:
            end = value.find(";", place)
            end = len(value) if end < 0 else end
            script, place = value[place:end], end
        scripts.append(script)
        rest = value[place:].lstrip(_BLANKS)
        if not rest:
            return scripts
        if rest[0] != ";":
            raise FormatError("post_process has text after a closing quote; correct it in the slicer")
        place = len(value) - len(rest) + 1


def _read_quoted(value: str, place: int) -> tuple[str, int]:
    """Read a text up to its closing quote; return it, and the place after the quote."""
    letters: list[str] = []
    while place < len(value):
        letter = value[place]
        place += 1
        if letter == '"':
            return "".join(letters), place
        if letter == "\\" and place < len(value):
            letter = _ESCAPES.get(value[place], value[place])
            place += 1
        letters.append(letter)
    raise FormatError("post_process has a quote that nothing closes; correct it in the slicer")


def _write_text(script: str, *, single: bool) -> str:
    """Write a text as an item of a list, in quotes if it needs them."""
    if not _QUOTED.search(script) and (script or not single):
        return script
    escaped = script.replace("\\", "\\\\").replace('"', '\\"').replace("\r", "\\r").replace("\n", "\\n")
    return f'"{escaped}"'
