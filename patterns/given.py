"""Parameters as users enter and read them: words or plain values, angles in degrees."""

from __future__ import annotations

import dataclasses
import difflib
import math
from collections.abc import Iterable, Mapping
from numbers import Real
from typing import Any

from patterns.declared import Described, Named, Parameter, checked, numbers_of, parameters, shown
from patterns.errors import PatternError, PatternUsageError

BOOLEANS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
NONE = "none"


def nearest(name: str, known: Iterable[str], *, others: Iterable[str] = ()) -> str:
    """Return advice for an unknown name: the nearest known one, including `others`, or a list of all known names.

    >>> nearest("wavs", ["cell", "waves"]), nearest("qq", ["cell"]), nearest("qq", [])
    ("did you mean 'waves'?", 'it has cell', 'it has none')
    """
    names = list(known)
    near = difflib.get_close_matches(name, [*others, *names], n=1)
    return f"did you mean {near[0]!r}?" if near else f"it has {', '.join(names) or 'none'}"


def assigned(kind: Named, text: str) -> tuple[str, Any]:
    """Return the name and the value in a text such as ``waves=7.5``, or raise PatternError.

    Dashes and underscores are equivalent; several numbers are separated by commas; a flag is true, yes, on, 1,
    false, no, off or 0. Angles are given and returned in degrees.

    >>> from patterns import Zigzag
    >>> assigned(Zigzag, "phase=1,2"), assigned(Zigzag, "waves=none"), assigned(Zigzag, "frame=off")
    (('phase', (1.0, 2.0)), ('waves', None), ('frame', False))
    """
    word, sign, value = text.partition("=")
    name = word.strip().replace("-", "_")
    if not sign or not name:
        raise PatternUsageError("give a name and a value with = between, such as cell=5")
    found = parameters(kind)
    if name not in found:
        raise PatternError(f"{kind.name} has no parameter {word.strip()!r}; {nearest(name, found)}")
    return name, value_of(kind, name, _plain(value.strip(), *found[name]))


def value_of(kind: Named, name: str, value: object) -> Any:  # noqa: ANN401 - of the kind of the parameter
    """Return `value` as a plain bool, number, tuple or None, or raise PatternError if the parameter cannot have it.

    Angles are given and returned in degrees.
    """
    field, described = parameters(kind)[name]
    if described.unit == "rad" and _is_number(value):
        checked(kind.name, (field, described), math.radians(value))  # type: ignore[arg-type]
        return value
    return checked(kind.name, (field, described), value)


def from_degrees(kind: Named, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return parameters as a pattern takes them: like `value_of`, but with angles in radians."""
    turn = {name for name, (_, described) in parameters(kind).items() if described.unit == "rad"}
    return {
        name: math.radians(value) if name in turn and _is_number(value) else value for name, value in values.items()
    }


def in_degrees(pattern: object) -> dict[str, Any]:
    """Return the parameters of a pattern that are not overridden, by name, angles in degrees."""
    found = parameters(pattern)
    values = {name: getattr(pattern, name) for name in found}
    replaced = {described.replaces for name, (_, described) in found.items() if values[name] is not None}
    turn = {name for name, (_, described) in found.items() if described.unit == "rad" and values[name] is not None}
    return {
        name: round(math.degrees(value), 9) if name in turn else _listed(value)
        for name, value in values.items()
        if name not in replaced
    }


def descriptions(kind: Named) -> dict[str, dict[str, Any]]:
    """Return the parameters of a pattern by name, as plain values: help, unit, default, and the limits low and high.

    Angles are in degrees.
    """
    found = {}
    for name, (field, each) in parameters(kind).items():
        limits = {end: value for end, value in zip(("low", "high"), each.limits, strict=True) if math.isfinite(value)}
        default: Any = field.default
        turned = each.unit == "rad" and default is not None
        found[name] = {
            "help": each.help,
            "unit": each.shown_unit,
            "default": round(math.degrees(default), 9) if turned else _listed(default),
            **limits,
        }
    return found


def default_text(described: Described) -> str:
    """Return the default of a parameter as users enter it, with its unit: "6 mm", "0,0 mm", "true", "none"."""
    default = described[0].default
    if default is None or isinstance(default, bool):
        return str(default).lower()
    return shown(default, described[1])


def _plain(text: str, field: dataclasses.Field[Any], described: Parameter) -> object:
    """Return the value that a text stands for, or the text itself if it stands for none of the type of the default."""
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


def _is_number(value: object) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _listed(value: object) -> object:
    """Return a list for a tuple, as JSON and TOML give back."""
    return list(value) if isinstance(value, tuple) else value
