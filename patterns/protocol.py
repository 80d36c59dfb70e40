"""What a pattern is: lines in a plane at height z, and points along them.

A pattern is a frozen, keyword-only dataclass whose fields are its parameters. Fields made with
`parameter` become options of the command line, with their range and unit in ``--help``.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Protocol, get_args

from patterns.errors import PatternError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

Unit = Literal["mm", "rad", ""]


UNITS = get_args(Unit)


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """Range, unit and meaning of one field of a pattern.

    Attributes
    ----------
    help : str
        One phrase for ``--help``.
    unit : {"mm", "rad", ""}
        Lengths are millimetres; angles are radians here and degrees at the command line.
    low, high : float
        Both ends belong to the range.
    whole : bool
        True for whole numbers.
    replaces : str
        The parameter that counts for nothing once this one is given.
    """

    help: str
    unit: Unit = "mm"
    low: float = -math.inf
    high: float = math.inf
    whole: bool = False
    replaces: str = ""


def parameter(
    default: bool | float | tuple[float, ...] | None,
    help: str,  # noqa: A002 - the word the command line uses
    *,
    unit: Unit = "mm",
    low: float = -math.inf,
    high: float = math.inf,
    whole: bool = False,
    replaces: str = "",
) -> Any:  # noqa: ANN401 - stands for a field of any type, as dataclasses.field does
    """Return a dataclass field that carries its `Parameter`.

    Raises
    ------
    PatternError
        For a unit or a default that the command line could not offer.
    """
    numbers = default if isinstance(default, tuple) else (default,)
    if (
        unit not in UNITS
        or (unit == "rad" and isinstance(default, tuple))
        or not all(each is None or isinstance(each, (bool, Real)) for each in numbers)
    ):
        raise PatternError(
            f"a parameter has the default {default!r} and the unit {unit!r}; give a number, a tuple of numbers, "
            f"True, False or None, and one of the units {', '.join(map(repr, UNITS))} (a tuple in rad cannot be)"
        )
    described = Parameter(help=help, unit=unit, low=low, high=high, whole=whole, replaces=replaces)
    return dataclasses.field(default=default, metadata={"parameter": described})


def parameters(pattern: type[Pattern] | Pattern) -> dict[str, tuple[dataclasses.Field[Any], Parameter]]:
    """Return the described fields of a pattern by name, in the order of the class."""
    if not dataclasses.is_dataclass(pattern):
        return {}
    return {
        field.name: (field, field.metadata["parameter"])
        for field in dataclasses.fields(pattern)
        if "parameter" in field.metadata
    }


def check_parameters(pattern: Pattern) -> None:
    """Turn the described fields of a pattern into plain numbers, or raise PatternError.

    A number must be finite and in its range, a flag True or False, a tuple as long as its default.
    """
    for name, (field, described) in parameters(pattern).items():
        value = getattr(pattern, name)
        if value is None and field.default is None:
            continue
        if isinstance(field.default, bool):
            if not isinstance(value, bool):
                raise PatternError(f"{name} of {pattern.name} is {value!r}; it must be True or False")
            continue
        wanted = len(field.default) if isinstance(field.default, tuple) else 1
        several = list(value) if isinstance(field.default, tuple) and hasattr(value, "__len__") else [value]
        if len(several) != wanted:
            raise PatternError(f"{name} of {pattern.name} is {value!r}; it must be {wanted} numbers")
        numbers = tuple(_checked(pattern, name, described, number) for number in several)
        object.__setattr__(pattern, name, numbers if isinstance(field.default, tuple) else numbers[0])


def _checked(pattern: Pattern, name: str, described: Parameter, number: object) -> float:
    """Return a number as a plain int or float, or raise PatternError if it is out of its range."""
    if isinstance(number, bool) or not isinstance(number, Real):
        raise PatternError(f"{name} of {pattern.name} is {number!r}; it must be a number")
    value = float(number)
    if not described.low <= value <= described.high or (described.whole and value != round(value)):
        in_degrees = math.degrees if described.unit == "rad" else float
        unit = {"rad": " degrees", "mm": " mm", "": ""}[described.unit]
        low, high = in_degrees(described.low), in_degrees(described.high)
        kind = "whole number" if described.whole else "number"
        raise PatternError(
            f"{name} of {pattern.name} is {in_degrees(value):.10g}{unit}; "
            f"it must be a {kind} from {low:g} to {high:g}{unit}"
        )
    return int(value) if described.whole else value


NEEDED = ("name", "summary", "prismatic", "lines", "points", "line_spacing")


def lacking(pattern: object) -> list[str]:
    """Return what a pattern, or a class of patterns, would need and does not have.

    >>> lacking("honeycomb")[:2]
    ['name', 'summary']
    """
    return [word for word in NEEDED if not hasattr(pattern, word)]


class Pattern(Protocol):
    """Lines in a plane at height z, in millimetres.

    Subclass it (a frozen, keyword-only dataclass is best), give `name`, `summary`, `lines` and
    `line_spacing`; `points` and the range check of the parameters come for free.

    Attributes
    ----------
    name : str
        The word at the command line.
    summary : str
        What the pattern is for, in one phrase.
    prismatic : bool
        True if the lines do not depend on z.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    prismatic: ClassVar[bool] = True

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:
        """Return the centre lines of the walls at height `z`, clipped to `region`.

        Parameters
        ----------
        region : Polygon or MultiPolygon
            Where lines may lie, mm. Walls reach half a line width beyond it.
        z : float
            Height, mm; a prismatic pattern does not look at it.
        """
        ...

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:
        """Return the distance, mm, at which neighbouring lines are designed to lie in `region`."""
        ...

    def points(self, region: Polygon | MultiPolygon, spacing: float, z: float = 0.0) -> NDArray[np.float64]:
        """Return points on the lines, neighbours at most `spacing` apart.

        Parameters
        ----------
        region : Polygon or MultiPolygon
            As for `lines`, mm.
        spacing : float
            Largest distance between neighbours on a line, mm. Half a grid cell or less makes
            neighbouring stamps overlap.
        z : float
            Height, mm.

        Returns
        -------
        (N, 2) float64, mm
        """
        from patterns.linework import sample

        return sample(self.lines(region, z), spacing)

    def __post_init__(self) -> None:
        """Check the parameters; a subclass with a `__post_init__` of its own calls this first."""
        check_parameters(self)


def in_degrees(pattern: Pattern) -> dict[str, Any]:
    """Return the parameters of a pattern that count, by name, angles in degrees."""
    found = parameters(pattern)
    values = {name: getattr(pattern, name) for name in found}
    replaced = {described.replaces for name, (_, described) in found.items() if values[name] is not None}
    turn = {name for name, (_, described) in found.items() if described.unit == "rad" and values[name] is not None}
    return {
        name: round(math.degrees(value), 9) if name in turn else _plain(value)
        for name, value in values.items()
        if name not in replaced
    }


def _plain(value: object) -> object:
    """Return a list for a tuple: what JSON and TOML give back."""
    return list(value) if isinstance(value, tuple) else value
