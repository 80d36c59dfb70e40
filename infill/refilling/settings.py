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

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from infill.options.declaration import by_field, declared_options, read_options
from infill.options.keyword_options import parse_word
from infill.refilling.request import KEEP, Request


def resolve(
    typed: Mapping[str, Any], config: Path | None = None, assigned: Sequence[str] = (), *, trust: bool = False
) -> dict[str, Any]:
    """Resolve the arguments of `refill`, angles in degrees: the command line takes precedence over the file.

    Parameters
    ----------
    typed : mapping
        Options by their names on the command line.
    config : Path, optional
        A TOML file.
    assigned : sequence of str
        Parameters of the pattern as ``name=value``, angles in degrees.
    trust : bool
        Whether the file may name code to run and files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError
        If a name is unknown, a parameter is given twice, or a value cannot be read.
    FormatError
        If the file is missing or not TOML, or names files that it is not trusted with.
    """
    typed = {name: value for name, value in typed.items() if value is not None}
    if config is None and not assigned:
        return _arguments(typed)
    from infill.options.assignments import collect_parameters, pop_table
    from infill.options.toml import read_toml
    from infill.options.trust import check_trusted
    from infill.refilling.placement import default_parameters, resolve_paths

    file_options = read_toml(config, example='pattern = "gyroid"') if config else {}
    if config:
        check_trusted(
            {name: value for name, value in file_options.items() if name not in typed},
            config,
            trust=trust,
        )
    table = pop_table(file_options)
    pattern = parse_word("pattern", typed.get("pattern", file_options.get("pattern", KEEP)))
    pattern, _, lines = (KEEP, {}, None) if pattern == KEEP else resolve_paths(pattern, {})
    kind = default_parameters(pattern, lines)
    pattern_arguments = collect_parameters(
        kind, declared_options(Request), flags=typed, assigned=assigned, filed=file_options, table=table
    )
    declared = declared_options(Request)
    options = {name: value for name, value in (file_options | typed).items() if name in declared}
    return {**_arguments(options), **pattern_arguments}


def _arguments(options: Mapping[str, Any]) -> dict[str, Any]:
    """Convert options to arguments of `refill`."""
    return by_field(Request, read_options("refill", Request, options))
