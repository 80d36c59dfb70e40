"""The parameters of a pattern: meaning, unit, range and check.

A pattern is a frozen, keyword-only dataclass whose fields are its parameters. Fields made with
`parameter` are offered to users, with their range and unit; patterns.given reads what users enter.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from numbers import Real
from typing import Any, Literal, Protocol, get_args

from patterns.errors import PatternError, PatternUsageError

Unit = Literal["mm", "deg", ""]
UNITS = get_args(Unit)
MAX_SHOWN_LENGTH = 60  # signs of a value in a message
SHOWN_UNITS = {"mm": " mm", "deg": " degrees", "": ""}


class DefaultLength(float):
    """A length that nobody gave, unlike the same number: a product may choose another in its place."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """Range, unit and meaning of one field of a pattern.

    Attributes
    ----------
    help : str
        One phrase for users.
    unit : {"mm", "deg", ""}
        Lengths are in millimetres, angles in degrees.
    low, high : float
        Both ends belong to the range.
    whole : bool
        True for whole numbers.
    replaces : str
        The parameter that is ignored if this one is given.
    count : int
        Number of values if the default is none; otherwise the default determines it.
    """

    help: str
    unit: Unit = "mm"
    low: float = -math.inf
    high: float = math.inf
    whole: bool = False
    replaces: str = ""
    count: int = 1

    @property
    def shown_unit(self) -> str:
        """The unit as users read it: mm, degrees, or nothing."""
        return SHOWN_UNITS[self.unit].strip()

    @property
    def range(self) -> str:
        """The range in words, with its unit; empty if every number is allowed.

        >>> Parameter(help="", low=1, high=9).range, Parameter(help="", unit="", low=2).range
        ('from 1 to 9 mm', 'of at least 2')
        """
        low, high = self.low, self.high
        unit = SHOWN_UNITS[self.unit]
        if math.isfinite(low) and math.isfinite(high):
            return f"from {format_decimal(low)} to {format_decimal(high)}{unit}"
        if math.isfinite(low):
            return f"of at least {format_decimal(low)}{unit}"
        if math.isfinite(high):
            return f"of at most {format_decimal(high)}{unit}"
        return ""


def parameter(
    default: bool | float | tuple[float, ...] | None,
    help: str,  # noqa: A002 - the word the command line uses
    *,
    unit: Unit = "mm",
    low: float = -math.inf,
    high: float = math.inf,
    whole: bool = False,
    replaces: str = "",
    count: int = 1,
) -> Any:  # noqa: ANN401 - stands for a field of any type, as dataclasses.field does
    """Return a dataclass field that carries its `Parameter`.

    Raises
    ------
    PatternError
        If the unit or the default is of an unsupported kind.
    """
    numbers = default if isinstance(default, tuple) else (default,)
    if unit not in UNITS or not all(number is None or isinstance(number, (bool, Real)) for number in numbers):
        raise PatternError(
            f"a parameter has the default {default!r} and the unit {unit!r}; give a number, a tuple of numbers, "
            f"True, False or None, and one of the units {', '.join(map(repr, UNITS))}"
        )
    declaration = Parameter(help=help, unit=unit, low=low, high=high, whole=whole, replaces=replaces, count=count)
    return dataclasses.field(default=default, metadata={"parameter": declaration})


DescribedField = tuple["dataclasses.Field[Any]", Parameter]


def parameters(pattern: object) -> dict[str, DescribedField]:
    """Return the described fields of a pattern, or of a class of patterns, by name, in the order of the class."""
    if not dataclasses.is_dataclass(pattern):
        return {}
    return {
        field.name: (field, field.metadata["parameter"])
        for field in dataclasses.fields(pattern)
        if "parameter" in field.metadata
    }


def parameter_values(pattern: object) -> dict[str, Any]:
    """Return the parameters of a pattern by name, as JSON and TOML values, without those that another replaces.

    >>> from patterns import Zigzag
    >>> parameter_values(Zigzag(waves=3, angle=30))
    {'waves': 3.0, 'angle': 30.0, 'phase': [0.0, 0.0], 'frame': True}
    """
    declared = parameters(pattern)
    values = {name: getattr(pattern, name) for name in declared}
    replaced = {declaration.replaces for name, (_, declaration) in declared.items() if values[name] is not None}
    return {name: as_json_value(value) for name, value in values.items() if name not in replaced}


def given_parameters(pattern: object) -> dict[str, Any]:
    """Return the parameters that were given when a pattern was made, by name: those that are not their defaults.

    >>> from patterns import Honeycomb
    >>> given_parameters(Honeycomb()), given_parameters(Honeycomb(cell=6, angle=0))
    ({}, {'cell': 6.0})
    """
    values = {name: (getattr(pattern, name), field.default) for name, (field, _) in parameters(pattern).items()}
    return {
        name: value
        for name, (value, default) in values.items()
        if value != default or isinstance(default, DefaultLength) > isinstance(value, DefaultLength)
    }


def as_json_value(value: object) -> object:
    """Convert a tuple to a list, as JSON and TOML return it."""
    return list(value) if isinstance(value, tuple) else value


class HasName(Protocol):
    """Any object with parameters that messages name: a pattern, a class of patterns, and others."""

    @property
    def name(self) -> str:
        """The name to type on the command line."""
        ...


def describe_values(default: object, declaration: Parameter) -> str:
    """Describe the values of a parameter in words, with range and unit.

    >>> describe_values(None, Parameter(help="", unit="", low=1, high=9, whole=True))
    'a whole number from 1 to 9, or none'
    """
    if isinstance(default, bool):
        return "true or false"
    kind = "whole number" if declaration.whole else "number"
    count = value_count(default, declaration)
    quantity = f"a {kind}" if count is None else f"{count} {kind}s"
    return f"{quantity} {declaration.range}".rstrip() + (", or none" if default is None else "")


def value_count(default: object, declaration: Parameter) -> int | None:
    """Return the number of values of a parameter, or None if it is a single one."""
    if isinstance(default, tuple):
        return len(default)
    return declaration.count if default is None and declaration.count != 1 else None


def check_parameters(pattern: HasName) -> None:
    """Turn the described fields of a pattern into plain numbers, or raise PatternError.

    A number must be finite and in its range, a flag True or False, a tuple as long as its default.
    """
    for name, declaration in parameters(pattern).items():
        object.__setattr__(pattern, name, check_value(pattern.name, declaration, getattr(pattern, name)))


def check_value(pattern: str, described: DescribedField, value: object) -> Any:  # noqa: ANN401 - of the kind of the field
    """Return `value` as a plain bool, number, tuple or None, or raise PatternError if the parameter cannot have it.

    Parameters
    ----------
    pattern : str
        Name of the pattern, for the message.
    described : (Field, Parameter)
        From `parameters`.
    value : object
        Lengths in mm, angles in degrees.
    """
    field, parameter = described
    default = field.default
    if value is None and default is None:
        return None
    plain: bool | float | tuple[float, ...] | None
    if isinstance(default, bool):
        plain = value if isinstance(value, bool) else None
    elif (count := value_count(default, parameter)) is not None:
        plain = _numbers(value, parameter, count)
    else:
        plain = _number(value, parameter)
    if plain is None:
        kind = PatternUsageError if isinstance(value, str) else PatternError
        raise kind.about(
            field.name,
            f"of {pattern} is {format_value(value, parameter)}; it must be {describe_values(default, parameter)}",
        )
    return plain


def _numbers(value: object, declaration: Parameter, count: int) -> tuple[float, ...] | None:
    """Return `count` plain numbers, or None if the parameter cannot have them."""
    if not isinstance(value, Sequence) and not hasattr(value, "tolist"):
        return None
    items = value if isinstance(value, Sequence) else value.tolist()
    numbers = [_number(item, declaration) for item in items] if isinstance(items, Sequence) else []
    plain_numbers = tuple(number for number in numbers if number is not None)
    return plain_numbers if len(plain_numbers) == len(numbers) == count else None


def _number(value: object, declaration: Parameter) -> float | None:
    """Return a number as a plain int or float, or None if the parameter cannot have it."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        number = float(value)
    except OverflowError:  # an integer with more digits than any limit
        return None
    if not math.isfinite(number) or not declaration.low <= number <= declaration.high:
        return None
    if isinstance(value, DefaultLength):
        return value
    if declaration.whole:
        return int(number) if number == round(number) else None
    return number


def format_decimal(number: float) -> str:
    """Format a number as a person writes it, without an exponent.

    >>> format_decimal(0.0000001), format_decimal(2.50), format_decimal(float("nan"))
    ('0.0000001', '2.5', 'nan')
    """
    text = f"{number:.10g}"
    text = f"{Decimal(text):f}" if "e" in text else text
    return text if len(text) <= MAX_SHOWN_LENGTH else text[:MAX_SHOWN_LENGTH] + "…"


def format_value(value: object, declaration: Parameter) -> str:
    """Format a value as users enter it, with its unit; numbers of a tuple are separated by commas."""
    items = value if isinstance(value, (tuple, list)) else (value,)
    try:
        if items and all(isinstance(item, Real) and not isinstance(item, bool) for item in items):
            return ",".join(format_decimal(float(item)) for item in items) + SHOWN_UNITS[declaration.unit]
        text = repr(value)
    except (OverflowError, ValueError):
        return "a number of hundreds of digits"
    return text if len(text) <= MAX_SHOWN_LENGTH else text[:MAX_SHOWN_LENGTH] + "…"
