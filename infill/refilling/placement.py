"""The parameters of the patterns of a refill, and the family of lines of a pattern with its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from infill.files.excerpts import excerpt
from patterns.declared import check_parameters, parameter
from patterns.declared import parameters as declared
from patterns.errors import PatternError
from patterns.given import suggest_name
from patterns.shared import angle_parameter, phase_parameter, seed_parameter

if TYPE_CHECKING:
    from infill.paths.families.protocol import Family


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

    def placed(self, family: Family) -> Family:
        """Return a family with these parameters."""
        return family


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

    def placed(self, family: Family) -> Family:
        """Return a family with these parameters."""
        if not self.angle and not any(self.phase):
            return family
        from infill.paths.families.turned import TurnedFamily

        return TurnedFamily(family=family, angle=self.angle, phase=self.phase)


@dataclass(frozen=True, kw_only=True)
class HoneycombParameters(PlacedParameters):
    """A honeycomb."""

    flats: float = parameter(1.0, "length of the walls that touch, over that of the others", unit="", low=0.25, high=4)

    def placed(self, family: Family) -> Family:
        """Return a family with these parameters."""
        from infill.paths.families.honeycomb import Honeycomb

        assert isinstance(family, Honeycomb)
        return super().placed(replace(family, flats=self.flats))


@dataclass(frozen=True, kw_only=True)
class VoronoiParameters(PlacedParameters):
    """Cells about points at random."""

    seed: int = seed_parameter()

    def placed(self, family: Family) -> Family:
        """Return a family with these parameters."""
        from infill.paths.families.voronoi import Voronoi

        assert isinstance(family, Voronoi)
        return super().placed(replace(family, seed=self.seed))


@dataclass(frozen=True, kw_only=True)
class CentredParameters(SizedParameters):
    """Outlines or turns about a point."""

    angle: float = angle_parameter()
    middle: tuple[float, float] | None = parameter(
        None,
        "the point on the bed that they lie about; by default, the middle of all infill",
        count=2,
        low=-1e4,
        high=1e4,
    )

    def placed(self, family: Family) -> Family:
        """Return a family with these parameters."""
        from infill.paths.families.heart import ConcentricHeart
        from infill.paths.families.spirals import Spirals

        assert isinstance(family, ConcentricHeart | Spirals)
        return replace(family, angle=self.angle, middle=self.middle)


KINDS: Mapping[str, type[PatternParameters]] = {
    "keep": PatternParameters,
    "concentric": SizedParameters,
    "concentric-heart": CentredParameters,
    "archimedean-chords": CentredParameters,
    "octagram-spiral": CentredParameters,
    "voronoi": VoronoiParameters,
    "honeycomb": HoneycombParameters,
}


def default_parameters(pattern: str) -> PatternParameters:
    """Return the parameters of a pattern, by its name, or of a drawing, by its path, with their defaults."""
    return KINDS.get(pattern, PlacedParameters)(name=excerpt(PurePath(pattern).name))


def pattern_parameters(pattern: str, parameters: Mapping[str, Any]) -> PatternParameters:
    """Return the checked parameters of a pattern.

    Raises
    ------
    PatternError
        If one is unknown or out of range.
    """
    kind = default_parameters(pattern)
    names = declared(kind)
    for name in parameters:
        if name not in names:
            raise PatternError(f"{kind.name} has no parameter {name!r}; {suggest_name(name, names)}")
    return replace(kind, **parameters)


def family_of(pattern: str, parameters: Mapping[str, Any]) -> Family:
    """Return the family of a pattern, by its name, or of a drawing, by its path, with its parameters.

    Parameters
    ----------
    pattern : str
    parameters : mapping
        By name; angles in degrees.
    """
    from infill.paths.families.catalogue import FAMILIES

    if pattern in FAMILIES:
        family = FAMILIES[pattern]
    else:
        from infill.drawings.drawing_files import read_tile_family

        family = read_tile_family(pattern)
    return pattern_parameters(pattern, parameters).placed(family)
