"""Files that hold several arrays, one of which is named behind the file: "results.vtu:name"."""

from __future__ import annotations

import re
from pathlib import Path

SIMULATIONS = (".vtu", ".frd")  # results of simulations
NAMED = re.compile(rf"(?i)(.*(?:{'|'.join(map(re.escape, SIMULATIONS))})):(.+)", re.DOTALL)


def split_array_name(text: str) -> tuple[Path, str | None]:
    """Split "results.vtu:name" into the file and the name of an array, None without one.

    >>> [str(part) for part in split_array_name("part.frd:SXX")]
    ['part.frd', 'SXX']
    >>> split_array_name("field.csv")[1] is None
    True
    """
    named = NAMED.fullmatch(text)
    return (Path(named[1]), named[2]) if named else (Path(text), None)
