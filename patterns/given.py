"""Parameters as users enter and read them: words or plain values."""

from __future__ import annotations

import dataclasses
import difflib
import math
from collections.abc import Iterable
from typing import Any

from patterns.declared import (
    DescribedField,
    HasName,
    Parameter,
    as_json_value,
    check_value,
    format_value,
    parameters,
    value_count,
)
from patterns.errors import PatternError, PatternUsageError
from patterns.quantities import parse_quantity

BOOLEANS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
NONE = "none"


def suggest_name(name: str, known: Iterable[str], *, others: Iterable[str] = ()) -> str:
    """Return advice for an unknown name: the nearest one of `known` and `others`, or a list of all known names.

    >>> suggest_name("wavs", ["cell", "waves"]), suggest_name("qq", ["cell"]), suggest_name("qq", [])
    ("did you mean 'waves'?", 'it has cell', 'it has none')
    """
    names = list(known)
    matches = difflib.get_close_matches(name, [*others, *names], n=1)
    return f"did you mean {matches[0]!r}?" if matches else f"it has {', '.join(names) or 'none'}"


def parse_assignment(kind: HasName, text: str) -> tuple[str, Any]:
    """Parse a text such as ``waves=7.5``; return the name and the value, or raise PatternError.

    Dashes and underscores are equivalent; several numbers are separated by commas; a flag is true, yes, on, 1,
    false, no, off or 0.

    >>> from patterns import Zigzag
    >>> tuple(parse_assignment(Zigzag, words) for words in ("phase=1,2", "waves=none", "frame=off"))
    (('phase', (1.0, 2.0)), ('waves', None), ('frame', False))
    """
    word, equals, value = text.partition("=")
    name = word.strip().replace("-", "_")
    if not equals or not name:
        raise PatternUsageError("give a name and a value with = between, such as cell=5")
    declared = parameters(kind)
    if name not in declared:
        raise PatternError(f"{kind.name} has no parameter {word.strip()!r}; {suggest_name(name, declared)}")
    return name, check_named_value(kind, name, _parse_value(value.strip(), *declared[name]))


def check_named_value(kind: HasName, name: str, value: object) -> Any:  # noqa: ANN401 - of the kind of the parameter
    """Return `value` as a plain bool, number, tuple or None, or raise PatternError if the parameter cannot have it."""
    return check_value(kind.name, parameters(kind)[name], value)


def describe_parameters(kind: HasName) -> dict[str, dict[str, Any]]:
    """Return the parameters of a pattern by name, as plain values: help, unit, default, and the limits low and high."""
    described = {}
    for name, (field, declaration) in parameters(kind).items():
        limits = {
            end: value for end, value in (("low", declaration.low), ("high", declaration.high)) if math.isfinite(value)
        }
        described[name] = {
            "help": declaration.help,
            "unit": declaration.shown_unit,
            "default": as_json_value(field.default),
            **limits,
        }
    return described


def default_text(described: DescribedField) -> str:
    """Return the default of a parameter as users enter it, with its unit: "6 mm", "0,0 mm", "true", "none"."""
    default = described[0].default
    if default is None or isinstance(default, bool):
        return str(default).lower()
    return format_value(default, described[1])


def _parse_value(text: str, field: dataclasses.Field[Any], described: Parameter) -> object:
    """Parse a text as a value of the type of the default; return the text itself if that fails."""
    word, default = text.lower(), field.default
    if default is None and word == NONE:
        return None
    if isinstance(default, bool):
        return BOOLEANS.get(word, text)
    is_single = value_count(default, described) is None
    numbers = tuple(parse_quantity(part, described.unit) for part in ([text] if is_single else text.split(",")))
    if None in numbers:
        return text
    return numbers[0] if is_single else numbers
