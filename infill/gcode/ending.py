"""The line with which each slicer ends a file: without it, the file was cut off."""

from __future__ import annotations

import re

_CONFIG_END = rb"^; \w+_config = end"
# Settings stand at the end of a file, or at its beginning, where moves follow.
_BLOCK_END = rb"^; EXECUTABLE_BLOCK_END|^; CONFIG_BLOCK_END(?!(?s:.)*^G[0-3] )"
# By the name of a slicer, in lower case: the first version that writes its mark, as far as that is known, and the mark.
ENDS = {
    "prusaslicer": ((2, 4), _CONFIG_END),
    "superslicer": ((2, 4), _CONFIG_END),
    "orcaslicer": ((), _BLOCK_END),
    "bambustudio": ((), _BLOCK_END),
    "cura": ((), rb"^;End of Gcode"),
}
WORDS = {
    "prusaslicer": "; prusaslicer_config = end",
    "superslicer": "; SuperSlicer_config = end",
    "orcaslicer": "; CONFIG_BLOCK_END",
    "bambustudio": "; EXECUTABLE_BLOCK_END",
    "cura": ";End of Gcode",
}


def find_missing_end(slicer: str, tail: bytes) -> str:
    """Return the line that a slicer ends its files with if this end lacks it, or "".

    Parameters
    ----------
    slicer : str
        Its name and version, as it names itself; files of unknown ones lack nothing.
    tail : bytes
        The last 128 kB of the file, or all of it.

    >>> find_missing_end("PrusaSlicer 2.9.6", b"G1 X1"), find_missing_end("PrusaSlicer 2.3.0", b"G1 X1")
    ('; prusaslicer_config = end', '')
    """
    compact = slicer.lower().replace(" ", "").replace("_steamengine", "")
    name = next((name for name in ENDS if compact.startswith(name)), None)
    if name is None:
        return ""
    first, mark = ENDS[name]
    numbers = re.search(r"(\d+)\.(\d+)", slicer)
    if first and (numbers is None or (int(numbers[1]), int(numbers[2])) < first):
        return ""
    return "" if re.search(mark, tail, flags=re.MULTILINE) else WORDS[name]


def describe_missing_end(missing: str) -> str:
    """Say that a file lacks its end."""
    return f"the file ends without the line {missing!r} that its slicer writes last: it was cut off; slice it again"
