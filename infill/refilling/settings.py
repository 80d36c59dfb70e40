"""The settings of `infill refill`: a TOML file, overridden by the command line.

In the file, the options are at the top level, by their names on the command line; the pattern's parameters go next to
them, or in a table; angles are in degrees::

    pattern = "honeycomb"
    density = "20%"
    layers = [5, 20]

    [set]
    angle = 30
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.options.keyword_options import parse_number, parse_share, parse_word
from infill.refilling.request import AUTO, KEEP, SAME

ENDLESS = 10**9  # layers


def resolve(
    flags: Mapping[str, Any], config: Path | None = None, assigned: Sequence[str] = (), *, trust: bool = False
) -> dict[str, Any]:
    """Resolve the arguments of `refill`, angles in degrees: the command line takes precedence over the file.

    Parameters
    ----------
    flags : mapping
        Options by their names on the command line, as typed; None for an option that is absent.
    config : Path, optional
        A TOML file.
    assigned : sequence of str
        Parameters of the pattern as ``name=value``, angles in degrees.
    trust : bool
        Whether the file may name files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError
        If a name is unknown, a parameter is given twice, or a value cannot be read.
    FormatError
        If the file is missing or not TOML, or names files that it is not trusted with.
    """
    present = {name: value for name, value in flags.items() if value is not None}
    if config is None and not assigned:
        return _arguments(present)
    from infill.options.assignments import collect_parameters, pop_table
    from infill.options.toml import read_toml
    from infill.options.trust import check_trusted
    from infill.refilling.placement import default_parameters

    file_options = read_toml(config, example='pattern = "gyroid"') if config else {}
    if config:
        check_trusted(
            {name: value for name, value in file_options.items() if name not in present},
            config,
            trust=trust,
            code=False,
        )
    table = pop_table(file_options)
    kind = default_parameters(parse_word("pattern", present.get("pattern", file_options.get("pattern", KEEP))))
    pattern_arguments = collect_parameters(
        kind, READERS, flags=present, assigned=assigned, filed=file_options, table=table
    )
    return {
        **_arguments({name: value for name, value in (file_options | present).items() if name in READERS}),
        **pattern_arguments,
    }


def _arguments(options: Mapping[str, Any]) -> dict[str, Any]:
    """Convert options to arguments of `refill`."""
    return {"part" if name == "object" else name: READERS[name](name, value) for name, value in options.items()}


def parse_radius(name: str, value: object) -> str | float:
    """Parse "auto" or a number of mm, or raise ParameterError.

    >>> parse_radius("smooth_radius", "1.5")
    1.5
    """
    if value == AUTO:
        return AUTO
    try:
        return float(value) if isinstance(value, str) else parse_number(name, value)
    except ValueError:
        raise UsageError(f"{name} is {quote_value(value)}; give auto, or a number in mm") from None


def parse_share_or_same(name: str, value: object) -> str | float:
    """Parse "same", or the share in ``20%`` or 0.2, or raise ParameterError.

    >>> parse_share_or_same("density", "20%"), parse_share_or_same("density", "same")
    (0.2, 'same')
    """
    return SAME if value == SAME else parse_share(name, value, "give same, or a share such as 20%")


def parse_range(name: str, value: object) -> tuple[int, int]:
    """Parse the first and the last of ``5-20``, ``5-`` or ``5``, 5 or [5, 20], or raise ParameterError.

    >>> parse_range("layers", "5-20")
    (5, 20)
    """
    parts = value if isinstance(value, (list, tuple)) and len(value) == 2 else [value]
    numbers = [part for part in parts if isinstance(part, int) and not isinstance(part, bool)]
    if len(numbers) == len(parts):
        return numbers[0], numbers[-1]
    match = re.fullmatch(r"\s*(\d{1,9})\s*(?:(-)\s*(\d{0,9})\s*)?", value) if isinstance(value, str) else None
    if not match:
        raise UsageError(f"{name} is {quote_value(value)}; give a range such as 5-20, or 5-")
    lowest = int(match[1])
    return lowest, int(match[3]) if match[3] else ENDLESS if match[2] else lowest


READERS: Mapping[str, Callable[[str, object], Any]] = {
    "pattern": parse_word,
    "density": parse_share_or_same,
    "smooth_radius": parse_radius,
    "max_deviation": parse_number,
    "layers": parse_range,
    "object": parse_word,
}
