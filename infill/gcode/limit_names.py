"""Names of a printer's limits: plain ones, those of Klipper's printer.cfg and of Marlin's commands, in one table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.gcode.limits import FIELDS_BY_MODEL, Limits, Model, describe_valid, is_valid_limit
from patterns.given import suggest_name
from patterns.quantities import parse_quantity

SPEED, ACCELERATION = "mm/s", "mm/s2"


@dataclass(frozen=True, kw_only=True)
class LimitName:
    """A limit that a user can give.

    Parameters
    ----------
    name : str
    unit : str
        "mm/s", "mm/s2", "mm" or "".
    fields : tuple of str
        Of `Limits`.
    axes : tuple of int, optional
        The axes that it sets, of x, y, z and e; none for fields without axes.
    klipper : tuple of (section, option), optional
        Its place in Klipper's printer.cfg.
    others : tuple of str
        Other names.
    """

    name: str
    unit: str
    fields: tuple[str, ...]
    axes: tuple[int, ...] = ()
    klipper: tuple[str, str] | None = None
    others: tuple[str, ...] = ()


def _per_axis(name: str, unit: str, field: str, code: str, klipper: Mapping[str, tuple[str, str]]) -> list[LimitName]:
    """Return the names of a limit of each axis."""
    return [
        LimitName(
            name=f"{name}_{axis}",
            unit=unit,
            fields=(field,),
            axes=(number,),
            klipper=klipper.get(axis),
            others=(f"{code} {axis.upper()}", *((klipper[axis][1],) if axis in klipper else ())),
        )
        for number, axis in enumerate("xyze")
    ]


RATIO: Final = "minimum_cruise_ratio"
TO_DECEL: Final = "max_accel_to_decel"
NAMES: Final[tuple[LimitName, ...]] = (
    LimitName(
        name="velocity",
        unit=SPEED,
        fields=("feedrate",),
        axes=(0, 1),
        klipper=("printer", "max_velocity"),
        others=("max_velocity",),
    ),
    *_per_axis(
        "velocity",
        SPEED,
        "feedrate",
        "M203",
        {"z": ("printer", "max_z_velocity"), "e": ("extruder", "max_extrude_only_velocity")},
    ),
    LimitName(
        name="acceleration",
        unit=ACCELERATION,
        fields=("acceleration", "travel_acceleration"),
        klipper=("printer", "max_accel"),
        others=("max_accel", "accel", "M204 S"),
    ),
    LimitName(name="print_acceleration", unit=ACCELERATION, fields=("acceleration",), others=("M204 P",)),
    LimitName(name="travel_acceleration", unit=ACCELERATION, fields=("travel_acceleration",), others=("M204 T",)),
    LimitName(name="retract_acceleration", unit=ACCELERATION, fields=("retract_acceleration",), others=("M204 R",)),
    *_per_axis(
        "acceleration",
        ACCELERATION,
        "axis_acceleration",
        "M201",
        {"z": ("printer", "max_z_accel"), "e": ("extruder", "max_extrude_only_accel")},
    ),
    LimitName(name="jerk", unit=SPEED, fields=("jerk",), axes=(0, 1)),
    *_per_axis("jerk", SPEED, "jerk", "M205", {}),
    LimitName(name="junction_deviation", unit="mm", fields=("junction_deviation",), others=("M205 J",)),
    LimitName(
        name="square_corner_velocity",
        unit=SPEED,
        fields=("square_corner_velocity",),
        klipper=("printer", "square_corner_velocity"),
        others=("scv",),
    ),
    LimitName(name=RATIO, unit="", fields=(RATIO,), klipper=("printer", RATIO)),
    LimitName(name=TO_DECEL, unit=ACCELERATION, fields=(RATIO,), klipper=("printer", TO_DECEL)),
    LimitName(
        name="corner_extrusion_velocity",
        unit=SPEED,
        fields=("corner_extrusion_velocity",),
        klipper=("extruder", "instantaneous_corner_velocity"),
        others=("instantaneous_corner_velocity",),
    ),
    LimitName(name="minimum_feedrate", unit=SPEED, fields=("minimum_feedrate",), others=("M205 S",)),
    LimitName(name="minimum_travel_feedrate", unit=SPEED, fields=("minimum_travel_feedrate",), others=("M205 T",)),
)
LIMIT_NAMES: Final = {limit.name: limit for limit in NAMES}
_SEPARATORS: Final = re.compile(r"[\s_.-]+")
_BY_WORD: Final = {_SEPARATORS.sub("", word).lower(): limit for limit in NAMES for word in (limit.name, *limit.others)}
_BETWEEN: Final = re.compile(r"[,;](?=\s*[A-Za-z][\w .-]*=)")  # not the comma of 0,5
# Fields that every model works with, though none of them is reported.
_ALWAYS_USED: Final = frozenset(
    {"travel_acceleration", "retract_acceleration", "minimum_feedrate", "minimum_travel_feedrate"}
)
# The fields that not all models work with, and the first model that does.
MODEL_OF_FIELD: Final[dict[str, Model]] = {
    field: next(model for model, known in FIELDS_BY_MODEL.items() if field in known)
    for fields in FIELDS_BY_MODEL.values()
    for field in fields
    if not all(field in other for other in FIELDS_BY_MODEL.values())
}


def split_assignments(text: str) -> list[str]:
    """Split a list of assignments at its commas; those of numbers stay.

    >>> split_assignments("max_accel=3000, scv=8,5,jerk=8")
    ['max_accel=3000', ' scv=8,5', 'jerk=8']
    """
    return _BETWEEN.split(text)


def parse_limits(name: str, value: object) -> dict[str, float]:
    """Parse limits of a printer by name, from a mapping or from texts such as ``max_accel=3000,M205 J=0.02``.

    Parameters
    ----------
    name : str
        Of the argument, for messages.
    value : mapping, str or sequence of str

    Returns
    -------
    dict of str to float
        By the names of `LIMIT_NAMES`.

    Raises
    ------
    UsageError
        If a text has no name or no value, or a value is not a number.
    ParameterError
        If a name is unknown or stands twice, or no machine has the limit.

    >>> parse_limits("limits", "max_accel=3000mm/s2,M205 J=0.02"), parse_limits("limits", {"scv": 8})
    ({'acceleration': 3000.0, 'junction_deviation': 0.02}, {'square_corner_velocity': 8.0})
    """
    limits: dict[str, float] = {}
    for word, text in read_assignments(name, value, "max_accel=3000"):
        limit = _BY_WORD.get(_SEPARATORS.sub("", word).lower())
        if limit is None:
            raise ParameterError.about(name, f"has {quote_value(word)}, which is not a limit; {_suggest(word)}")
        if limit.name in limits:
            raise ParameterError.about(name, f"has {limit.name} twice; leave one out")
        limits[limit.name] = _read_limit(name, word, limit, text)
    return limits


def read_assignments(name: str, value: object, example: str) -> list[tuple[str, object]]:
    """Read names and values from a mapping, a text with = and commas, or a sequence of such texts.

    Raises
    ------
    UsageError
        If a text has no name or no value.
    """
    if isinstance(value, Mapping):
        return [(str(word), item) for word, item in value.items()]
    texts = [value] if isinstance(value, str) else value
    if not isinstance(texts, Iterable):
        raise UsageError.about(name, f"is {quote_value(value)}; give {example}")
    assignments: list[tuple[str, object]] = []
    for text in (part for item in texts for part in split_assignments(str(item))):
        word, equals, number = text.partition("=")
        if not equals or not word.strip() or not number.strip():
            raise UsageError.about(name, f"is {quote_value(text.strip())}; give a name and a value, as {example}")
        assignments.append((word.strip(), number.strip()))
    return assignments


def _suggest(word: str) -> str:
    """Return the nearest name for an unknown one, or all names."""
    advice = suggest_name(word, [other for limit in NAMES for other in (limit.name, *limit.others)])
    return advice if advice.startswith("did") else f"the names are {', '.join(LIMIT_NAMES)}"


def _read_limit(name: str, word: str, limit: LimitName, value: object) -> float:
    """Return a number that a printer can have as a limit; raise ParameterError for another value."""
    number: float | None = None
    if isinstance(value, str):
        number = parse_quantity(value, limit.unit)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        number = float(value)
    field = "acceleration" if limit.name == TO_DECEL else limit.fields[0]
    unit = f" in {limit.unit.replace('s2', 's²')}" if limit.unit else ""
    problem = f"has {word} = {quote_value(value)}; give {describe_valid(field)}{unit}"
    if number is None:
        raise UsageError.about(name, problem)
    if not is_valid_limit(number, field):
        raise ParameterError.about(name, problem)
    return number


def model_of_limits(limits: Iterable[str], before: Model) -> Model:
    """Return the model that limits by name belong to, or the one before if they fit it or belong to none.

    Raises
    ------
    ParameterError
        If they belong to two models.
    """
    meant = {
        MODEL_OF_FIELD[field]: name for name in limits for field in LIMIT_NAMES[name].fields if field in MODEL_OF_FIELD
    }
    if len(meant) > 1:
        names = " and ".join(meant.values())
        raise ParameterError.about("limits", f"has {names}, which belong to two models; leave one out, or give model")
    if before == "vector-jerk" and "jerk" in meant:
        return before
    return next(iter(meant), before)


def set_limits(limits: Limits, values: Mapping[str, float]) -> Limits:
    """Return limits with others by name.

    >>> set_limits(Limits(), {"velocity_z": 12.0, "acceleration": 900.0}).feedrate
    (300.0, 300.0, 12.0, 25.0)
    """
    changed: dict[str, Any] = {}
    for limit in NAMES:  # in this order: jerk of x and y before that of y, accelerations before their ratio
        if limit.name not in values:
            continue
        value = values[limit.name]
        for field in limit.fields:
            before = changed.get(field, getattr(limits, field))
            if limit.axes:
                changed[field] = tuple(value if axis in limit.axes else old for axis, old in enumerate(before))
            elif limit.name == TO_DECEL:
                changed[field] = cruise_ratio(value, changed.get("acceleration", limits.acceleration))
            else:
                changed[field] = value
    return replace(limits, **changed) if changed else limits


def cruise_ratio(to_decel: float, acceleration: float) -> float:
    """Return the minimum cruise ratio for Klipper's earlier max_accel_to_decel.

    >>> cruise_ratio(1500.0, 3000.0), cruise_ratio(9000.0, 3000.0)
    (0.5, 0.0)
    """
    return min(1 - min(to_decel / acceleration, 1.0), 1 - 1e-9)  # a ratio of 1 by rounding is none


def is_used(name: str, model: Model) -> bool:
    """Tell whether a model works with a limit of `LIMIT_NAMES`.

    >>> is_used("jerk", "klipper"), is_used("velocity_z", "klipper"), is_used("acceleration_x", "klipper")
    (False, True, False)
    """
    limit = LIMIT_NAMES[name]
    if model == "klipper":
        return limit.klipper is not None
    return not _ALWAYS_USED.union(FIELDS_BY_MODEL[model]).isdisjoint(limit.fields)


def changed_fields(values: Iterable[str]) -> set[str]:
    """Return the fields of `Limits` that limits by name set."""
    return {field for name in values for field in LIMIT_NAMES[name].fields}
