"""Patterns of one line: Hilbert's curve, Sierpinski's curve, and spirals."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from infill.errors import ParameterError
from infill.paths.families.family import Bounds, CentredFamily, Family, Path, PathSpec
from infill.plain_numbers import plain_argument
from patterns.cross import ORIGIN, SIDE, curve_segments
from patterns.errors import PatternError
from patterns.hilbert import hilbert_curve

if TYPE_CHECKING:
    from patterns.spirals import Spiral

MARGIN = 2  # octagons, beyond the box, whose steps are drawn


@dataclass(frozen=True, kw_only=True)
class HilbertPaths(Family):
    """The one curve of order 24 about (0, 0), in squares of side `cell`, as far as the box reaches."""

    name: str = "hilbert"
    summary: str = "one line that folds itself through the region, equally stiff in both directions"
    wide: bool = True
    corner_share: ClassVar[float] = 1.0  # where the arcs of a step meet, of corners taken wide

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the parts of the curve in the box."""
        try:
            return hilbert_curve(np.array(bounds), spec.cell)
        except PatternError as error:
            raise ParameterError.like(error) from error


@dataclass(frozen=True, kw_only=True)
class CrossPaths(Family):
    """The one curve of order 24 about (0, 0), with steps `cell` long: lines are nowhere nearer to one another."""

    name: str = "cross"
    summary: str = "one line around a tree of crosses; soft in every direction"
    wide: bool = True
    length_in_cell: ClassVar[float] = 4 * SIDE**2  # each octagon has four steps

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the parts of the curve in the box."""
        import shapely

        pitch = spec.cell / SIDE
        corners = np.array(bounds, dtype=np.float64).reshape(2, 2) / pitch
        low, high = np.floor(corners[0]) - MARGIN, np.ceil(corners[1]) + MARGIN
        if max(-low.min(), high.max()) > ORIGIN:
            raise ParameterError(
                f"the cell is {plain_argument(spec.cell)} mm; the curve reaches {ORIGIN} octagons: give a larger one"
            )
        merged = shapely.line_merge(shapely.multilinestrings(curve_segments(low, high)))
        return [shapely.get_coordinates(part) * pitch for part in shapely.get_parts(merged)]

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which the arcs of a step that turns by 45° at both ends meet, mm."""
        return cell / 2 / math.tan(math.pi / 8)


@dataclass(frozen=True, kw_only=True)
class Spirals(CentredFamily):
    """A spiral of `patterns.spirals`, its turns `cell` apart, turned by `angle` degrees.

    It goes from its middle as far as the box reaches.
    """

    corner_share: ClassVar[float] = 1.0  # larger arcs would take the tips off the stars

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the spiral."""
        from patterns.linework import turn
        from patterns.spirals import ArchimedeanChords, OctagramSpiral

        kinds: tuple[type[Spiral], ...] = (ArchimedeanChords, OctagramSpiral)
        pattern = {kind.name: kind for kind in kinds}[self.name]()
        middle = self.middle_of(bounds)
        corner = np.abs(np.array(bounds, dtype=np.float64).reshape(2, 2) - middle).max(axis=0)
        return [turn(pattern.draw_turns(float(np.hypot(*corner)) / spec.cell) * spec.cell, self.angle) + middle]


ARCHIMEDEAN_CHORDS = Spirals(
    name="archimedean-chords", summary="a round spiral about the middle of the part; one line without a corner"
)
OCTAGRAM_SPIRAL = Spirals(
    name="octagram-spiral", summary="a spiral of eight-pointed stars: walls in four directions, in one line", wide=True
)
