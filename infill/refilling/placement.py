"""The parameters of the patterns of a refill, and the family of lines of a pattern with its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, ClassVar

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import excerpt
from patterns.cellular import Cells
from patterns.declared import HasName, check_parameters, given_parameters, parameter, parameter_values
from patterns.declared import parameters as declared
from patterns.errors import PatternError
from patterns.given import suggest_name
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, levels_parameter, overhang_parameter, phase_parameter, seed_parameter

if TYPE_CHECKING:
    from infill.paths.families.family import Family

LineSource = Pattern | type[Pattern]
FRAME = "frame"


@dataclass(frozen=True, kw_only=True)
class PatternParameters:
    """A pattern without parameters: the slicer's own.

    Parameters
    ----------
    name : str
        Of the pattern, or of the file of a drawing.
    """

    name: str

    def __post_init__(self) -> None:
        """Check the parameters, or raise PatternError."""
        check_parameters(self)

    of_family: ClassVar[tuple[str, ...]] = ()  # names of those that the family has too

    def apply_to(self, family: Family) -> Family:
        """Return a family with these parameters."""
        return replace(family, **{name: getattr(self, name) for name in self.of_family})


@dataclass(frozen=True, kw_only=True)
class SizedParameters(PatternParameters):
    """A pattern that follows the region: only the size of its cells can be set."""

    cell: float | None = parameter(
        None, "distance between lines, period, or width of a drawing, in place of a density", low=0.1, high=1000
    )


@dataclass(frozen=True, kw_only=True)
class PlacedParameters(SizedParameters):
    """A pattern that covers the bed, wherever the parts stand on it."""

    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()

    def apply_to(self, family: Family) -> Family:
        """Return a family with these parameters."""
        from infill.paths.families.family import turn_family

        return turn_family(super().apply_to(family), self.angle, self.phase)


@dataclass(frozen=True, kw_only=True)
class HoneycombParameters(PlacedParameters):
    """A honeycomb."""

    of_family = ("flats",)
    flats: float = parameter(1.0, "length of the walls that touch, over that of the others", unit="", low=0.25, high=4)


@dataclass(frozen=True, kw_only=True)
class VoronoiParameters(PlacedParameters):
    """Cells about points at random."""

    of_family = ("seed",)
    seed: int = seed_parameter()


@dataclass(frozen=True, kw_only=True)
class CentredParameters(SizedParameters):
    """Outlines or turns about a point."""

    of_family = ("angle", "middle")
    angle: float = angle_parameter()
    middle: tuple[float, float] | None = parameter(
        None,
        "the point on the bed that they lie about; by default, the middle of all infill",
        count=2,
        low=-1e4,
        high=1e4,
    )


@dataclass(frozen=True, kw_only=True)
class OctreeParameters(PlacedParameters):
    """Cubes that are split where they are needed."""

    of_family = ("levels",)
    levels: int = levels_parameter()


@dataclass(frozen=True, kw_only=True)
class LightningParameters(PlacedParameters):
    """Branches below roofs."""

    of_family = ("overhang",)
    overhang: float = overhang_parameter()


KINDS: Mapping[str, type[PatternParameters]] = {
    "keep": PatternParameters,
    "concentric": SizedParameters,
    "concentric-heart": CentredParameters,
    "archimedean-chords": CentredParameters,
    "octagram-spiral": CentredParameters,
    "voronoi": VoronoiParameters,
    "honeycomb": HoneycombParameters,
    "adaptive-cubic": OctreeParameters,
    "support-cubic": OctreeParameters,
    "lightning": LightningParameters,
}


def resolve_paths(pattern: object, parameters: Mapping[str, Any]) -> tuple[str, Mapping[str, Any], LineSource | None]:
    """Find the paths of a pattern; return its name, its parameters, and itself if paths are to follow its lines.

    Parameters
    ----------
    pattern : str, Path, Pattern or Cells
        A name; the path of a drawing; "module.py:name"; or a pattern, or a class of patterns.
    parameters : mapping
        Beside those that a pattern is made with.

    Raises
    ------
    PatternError, ParameterError
        If there is no such pattern, or it offers no paths, lines or level set; if a parameter is given twice.
    """
    from infill.options.modules import names_code
    from infill.options.resolve_pattern import is_drawing, refuse_file, resolve_pattern
    from infill.paths.families.catalogue import FAMILIES
    from patterns import PATTERNS

    if isinstance(pattern, (str, PurePath)):
        name = pattern = PATTERNS.spelled(str(pattern))
        if name in FAMILIES or is_drawing(name):
            return name, parameters, None
        if name not in PATTERNS and not names_code(name):
            refuse_file(name)
            meant = PATTERNS.nearest(name, FAMILIES)
            advice = f"give keep, or one of {', '.join(FAMILIES)}" if meant is None else f"did you mean {meant!r}?"
            raise ParameterError(f"there is no pattern {name!r}; {advice}")
    kind, name = resolve_pattern(pattern, "refill")
    own = {} if isinstance(kind, type) else given_parameters(kind)
    own.pop(FRAME, None)  # a print has walls
    for parameter_name, value in own.items():
        if parameters.get(parameter_name, value) != value:
            raise UsageError.about(
                parameter_name, f"is {parameters[parameter_name]}, and {name} is made with {value}; give one of them"
            )
    made_class = kind if isinstance(kind, type) else type(kind)
    if kind.name in FAMILIES and PATTERNS[kind.name] is made_class:
        return kind.name, {**own, **parameters}, None
    if isinstance(kind, Cells):  # a subclass of one that has paths
        raise PatternError(f"{name} offers cells, and refill needs paths, lines or a level set; choose another pattern")
    return name, {**own, **parameters}, kind


def default_parameters(pattern: str, lines: LineSource | None = None) -> HasName:
    """Return the parameters of a pattern, by its name, or of a drawing, by its path, with their defaults.

    Those of a pattern whose lines are drawn are its own.
    """
    return KINDS.get(pattern, PlacedParameters)(name=excerpt(PurePath(pattern).name)) if lines is None else lines


def check_pattern_parameters(
    pattern: str, parameters: Mapping[str, Any], lines: LineSource | None = None
) -> PatternParameters | Pattern:
    """Return the checked parameters of a pattern; of one whose lines are drawn, the pattern itself.

    Raises
    ------
    PatternError
        If one is unknown or out of range.
    """
    kind = default_parameters(pattern, lines)
    names = [name for name in declared(kind) if name != FRAME]
    for name in parameters:
        if name not in names:
            raise PatternError(f"{kind.name} has no parameter {name!r}; {suggest_name(name, names)}")
    if lines is not None:
        from infill.options.resolve_pattern import with_parameters

        return with_parameters(lines, dict(parameters))
    assert isinstance(kind, PatternParameters)
    return replace(kind, **parameters)


def parameter_facts(pattern: str, parameters: Mapping[str, Any], lines: LineSource | None = None) -> dict[str, Any]:
    """Return all parameters of a pattern as the report has them; the cell is none if none was given."""
    if KINDS.get(pattern) is PatternParameters:
        return {}
    values = parameter_values(check_pattern_parameters(pattern, parameters, lines))
    return {name: parameters.get(name) if name == "cell" else value for name, value in values.items() if name != FRAME}


def family_of(pattern: str, parameters: Mapping[str, Any], lines: LineSource | None = None) -> Family:
    """Return the family of a pattern, by its name, or of a drawing, by its path, with its parameters.

    Parameters
    ----------
    pattern : str
    parameters : mapping
        By name; angles in degrees.
    lines : Pattern or class of patterns, optional
        The pattern itself, if paths are to follow its lines.
    """
    made = check_pattern_parameters(pattern, parameters, lines)
    if not isinstance(made, PatternParameters):
        from infill.paths.families.lines import line_paths

        return line_paths(made)
    from infill.paths.families.catalogue import FAMILIES

    if pattern in FAMILIES:
        family = FAMILIES[pattern]
    else:
        from infill.drawings.drawing_files import read_tile_family

        family = read_tile_family(pattern)
    return made.apply_to(family)
