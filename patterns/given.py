"""Parameters as users enter and read them: words or plain values."""

from __future__ import annotations

import dataclasses
import difflib
import math
from collections.abc import Iterable
from typing import Any

from patterns.declared import Described, Named, Parameter, checked, listed, numbers_of, parameters, shown
from patterns.errors import PatternError, PatternUsageError

BOOLEANS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
NONE = "none"


def nearest(name: str, known: Iterable[str], *, others: Iterable[str] = ()) -> str:
    """Return advice for an unknown name: the nearest one of `known` and `others`, or a list of all known names.

    >>> nearest("wavs", ["cell", "waves"]), nearest("qq", ["cell"]), nearest("qq", [])
    ("did you mean 'waves'?", 'it has cell', 'it has none')
    """
    names = list(known)
    matches = difflib.get_close_matches(name, [*others, *names], n=1)
    return f"did you mean {matches[0]!r}?" if matches else f"it has {', '.join(names) or 'none'}"


def assigned(kind: Named, text: str) -> tuple[str, Any]:
    """Parse a text such as ``waves=7.5``; return the name and the value, or raise PatternError.

    Dashes and underscores are equivalent; several numbers are separated by commas; a flag is true, yes, on, 1,
    false, no, off or 0.

    >>> from patterns import Zigzag
    >>> assigned(Zigzag, "phase=1,2"), assigned(Zigzag, "waves=none"), assigned(Zigzag, "frame=off")
    (('phase', (1.0, 2.0)), ('waves', None), ('frame', False))
    """
    word, equals, value = text.partition("=")
    name = word.strip().replace("-", "_")
    if not equals or not name:
        raise PatternUsageError("give a name and a value with = between, such as cell=5")
    declared = parameters(kind)
    if name not in declared:
        raise PatternError(f"{kind.name} has no parameter {word.strip()!r}; {nearest(name, declared)}")
    return name, value_of(kind, name, _parse_value(value.strip(), *declared[name]))


def value_of(kind: Named, name: str, value: object) -> Any:  # noqa: ANN401 - of the kind of the parameter
    """Return `value` as a plain bool, number, tuple or None, or raise PatternError if the parameter cannot have it."""
    return checked(kind.name, parameters(kind)[name], value)


def descriptions(kind: Named) -> dict[str, dict[str, Any]]:
    """Return the parameters of a pattern by name, as plain values: help, unit, default, and the limits low and high."""
    described = {}
    for name, (field, declaration) in parameters(kind).items():
        limits = {
            end: value for end, value in (("low", declaration.low), ("high", declaration.high)) if math.isfinite(value)
        }
        described[name] = {
            "help": declaration.help,
            "unit": declaration.shown_unit,
            "default": listed(field.default),
            **limits,
        }
    return described


def default_text(described: Described) -> str:
    """Return the default of a parameter as users enter it, with its unit: "6 mm", "0,0 mm", "true", "none"."""
    default = described[0].default
    if default is None or isinstance(default, bool):
        return str(default).lower()
    return shown(default, described[1])


def _parse_value(text: str, field: dataclasses.Field[Any], described: Parameter) -> object:
    """Parse a text as a value of the type of the default; return the text itself if that fails."""
    word, default = text.lower(), field.default
    if default is None and word == NONE:
        return None
    if isinstance(default, bool):
        return BOOLEANS.get(word, text)
    try:
        if numbers_of(default, described) is not None:
            return tuple(float(part) for part in text.split(","))
        return float(text)
    except ValueError:
        return text
