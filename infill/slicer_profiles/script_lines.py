"""The line that a slicer runs after slicing, and lists of such lines.

On Linux and macOS a shell runs the line, so that words are quoted for a shell; on Windows the line is split as the C
library splits it. A field of a profile is a list of texts, each of which may hold several lines.
"""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
import sysconfig
from collections.abc import Sequence
from pathlib import Path

from infill.errors import ParameterError
from infill.files.excerpts import quote_word

# Runs programs outside of a Flatpak.
OUTSIDE = ("/usr/bin/flatpak-spawn", "--host")
PROGRAM_NAMES = ("infill", "phasefill")
_REFILL = re.compile(r"(?:^|[\s/\\'\"])(?:infill(?:\.cli)?|phasefill)(?:\.exe)?['\"]?\s+refill(?![\w-])", re.IGNORECASE)
_CACHED = re.compile(
    r"[/\\](?:uv[/\\](?:cache[/\\])?(?:archive|builds|environments)-v\d|\.cache[/\\]pipx|pipx[/\\]\.?cache)"
)
_BREAK = re.compile(r"\r\n|\r|\n")


def find_program(system: str, argument: str | None = None) -> tuple[str, ...]:
    """Find the absolute path of the running `infill`, or the words that run it with its Python.

    Parameters
    ----------
    system : str
        As `sys.platform`.
    argument : str, optional
        The first word of the command line; by default that of this process.
    """
    suffix = ".exe" if system == "win32" else ""
    started = Path(sys.argv[0] if argument is None else argument).absolute()
    candidates = [started.with_suffix(suffix)] if started.stem in PROGRAM_NAMES else []
    candidates.append(Path(sysconfig.get_path("scripts")) / f"infill{suffix}")
    return next(((str(path),) for path in candidates if path.is_file()), (sys.executable, "-m", "infill"))


def is_temporary(program: str) -> bool:
    """Tell whether a program lies in the cache of `uvx` or `pipx run`, from which it disappears.

    >>> is_temporary("/home/me/.cache/uv/archive-v0/ab12/bin/infill"), is_temporary("/home/me/.local/bin/infill")
    (True, False)
    """
    return bool(_CACHED.search(program))


def write_line(words: Sequence[str], system: str) -> str:
    r"""Write words as a line that the slicers of a system run.

    Raises
    ------
    ParameterError
        If a word has characters that no profile can hold.

    >>> print(write_line(["/home/me/my tools/infill", "refill"], "linux"))
    '/home/me/my tools/infill' refill
    >>> print(write_line(["C:\\Program Files\\infill.exe", "refill"], "win32"))
    "C:\Program Files\infill.exe" refill
    """
    for word in words:
        if not word.isprintable():
            raise ParameterError(f"{quote_word(word)} has characters that a profile cannot hold; leave them out")
    return subprocess.list2cmdline(words) if system == "win32" else shlex.join(words)


def is_refill_line(line: str) -> bool:
    """Tell whether a line runs `infill refill`.

    >>> is_refill_line("'/my tools/infill' refill -q"), is_refill_line("/usr/bin/infill motion --in-place")
    (True, False)
    """
    return bool(_REFILL.search(line))


def list_lines(scripts: Sequence[str]) -> list[str]:
    r"""List the lines of a field that are not blank.

    >>> list_lines(["a\nb", "", " c"])
    ['a', 'b', 'c']
    """
    return [line.strip() for text in scripts for line in _BREAK.split(text) if line.strip()]


def put_line(scripts: Sequence[str], line: str) -> list[str]:
    """Put a refill line in place of the refill line of a field, or before all other lines.

    First, so that scripts which compute checksums or times run on the refilled file.

    >>> put_line(["b", "c"], "infill refill"), put_line(["b", "/old/infill refill"], "infill refill")
    (['infill refill', 'b', 'c'], ['b', 'infill refill'])
    """
    lines = list_lines(scripts)
    if not any(map(is_refill_line, lines)):
        return [line, *(scripts if lines else [])]
    return _replace_lines(scripts, [line])


def drop_lines(scripts: Sequence[str]) -> list[str]:
    r"""Drop the refill lines of a field.

    >>> drop_lines(["b\ninfill refill", "infill refill", "c"])
    ['b', 'c']
    """
    return _replace_lines(scripts, [])


def _replace_lines(scripts: Sequence[str], lines: Sequence[str]) -> list[str]:
    """Replace the first refill lines of a field by lines, and drop those after them."""
    result, queue = [], list(lines)
    for text in scripts:
        parts = _BREAK.split(text)
        if not any(map(is_refill_line, parts)):
            result.append(text)
            continue
        new = [queue.pop(0) if is_refill_line(part) else part for part in parts if queue or not is_refill_line(part)]
        if any(part.strip() for part in new):
            breaks = _BREAK.search(text)
            result.append((breaks[0] if breaks else "\n").join(new))
    return result
