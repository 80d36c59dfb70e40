"""Families of paths: centre lines over a plane, one layer at a time, that never cross.

Centre lines of two beads that touch are `TOUCH` line widths apart, the spacing of beads with rounded
sides: w − h (1 − π / 4) for a width w and a layer height h, which is 0.905 w for 0.45 and 0.2 mm.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Path = NDArray[np.float64]  # (N, 2), mm; a closed one ends where it begins
Bounds = tuple[float, float, float, float]

TOUCH = 0.905
STRETCHED_TOUCH = 0.98  # line widths between beads that touch where cells change: stretching moves some by 2 %
CLEAR = 0.95  # of the distance of touching beads: beads overlap by at most 5 %


@dataclass(frozen=True, kw_only=True)
class PathSpec:
    """Sizes and place of the lines of a layer.

    Parameters
    ----------
    cell : float
        Size of the pattern, mm; each family documents its meaning.
    line_width : float
        mm. Where the pattern has a wall in common, two lines run `TOUCH` line widths apart.
    z : float
        Height of the layer, mm.
    layer : int
        Its number.
    radius : float
        Upper limit for the rounding of corners, mm. The lines are returned with their corners, but placed so that
        they still touch after rounding; a radius above `Family.largest_radius` counts as that one.
    """

    cell: float
    line_width: float
    z: float = 0.0
    layer: int = 0
    radius: float = 0.0

    @property
    def gap(self) -> float:
        """Distance of lines that touch, mm."""
        return TOUCH * self.line_width


@dataclass(frozen=True, kw_only=True, eq=False)
class NominalStrand:
    """A centre line as if beads that touch lay on one another, so that it can be stretched before they move apart.

    Parameters
    ----------
    points : (N, 2) float64, mm
    sides : (N,) float64
        How far each point lies off, in halves of the distance of touching beads.
    across : (2,) float64
        The direction in which it does, of length 1.
    """

    points: Path
    sides: NDArray[np.float64]
    across: NDArray[np.float64]

    def offset(self, half_gap: float) -> Path:
        """Return the centre line with beads that touch moved apart by twice `half_gap`, mm."""
        return self.points + half_gap * self.sides[:, None] * self.across


@dataclass(frozen=True, kw_only=True, eq=False)
class Family(ABC):
    """Centre lines over a box, at one layer.

    Parameters
    ----------
    name : str
        The name to type on the command line.
    summary : str
        Purpose of the family, in one phrase.
    prismatic : bool
        True if every layer is equal, so that each bead lies on the one below, however it is rounded.
    wide : bool
        True if its corners move outwards where there is room: its lines stand alone, and tear off no other.

    Attributes
    ----------
    length_in_cell : float
        Length of the lines in a square of side `cell`, in cells, in the mean over heights.
    corner_share : float
        Largest radius of corners, in cells.
    stretches : bool
        True if its cells may change from place to place: lines keep their distances when they are stretched.
    touches : bool
        True if its nominal strands touch, and move apart after they are stretched.
    fills : bool
        False if its cell does not decide how much filament it takes.
    least_spacing : float
        Line widths that a join along a wall keeps from other lines.
    """

    name: str
    summary: str
    prismatic: bool = True
    wide: bool = False
    length_in_cell: ClassVar[float] = 1.0
    corner_share: ClassVar[float] = math.inf
    stretches: ClassVar[bool] = False
    touches: ClassVar[bool] = False
    fills: ClassVar[bool] = True
    least_spacing: ClassVar[float] = CLEAR * TOUCH

    @abstractmethod
    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return centre lines that cover a box; they may extend beyond it.

        Parameters
        ----------
        bounds : (x0, y0, x1, y1)
            mm. The position of lines does not depend on the box, so that regions and layers fit each other.
        spec : PathSpec

        Returns
        -------
        list of (N, 2) float64, mm
            No line crosses itself or another, before rounding or after it.
        """

    def nominal_strands(self, bounds: Bounds, spec: PathSpec) -> list[NominalStrand]:
        """Return the same lines as `strands`, as if beads that touch lay on one another."""
        across = np.array([0.0, 1.0])
        return [
            NominalStrand(points=path, sides=np.zeros(len(path)), across=across) for path in self.strands(bounds, spec)
        ]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell, mm, at which beads fill about `density` (0 to 1) of the plane.

        Density is the length of lines times `TOUCH` line widths per area, as slicers count it.
        """
        return self.length_in_cell * TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002 - some families need it
        """Return the largest radius of corners, mm, at which lines with a wall in common still touch."""
        return self.corner_share * cell

    def radii_at(self, points: NDArray[np.float64], cell: float, line_width: float) -> NDArray[np.float64] | None:  # noqa: ARG002
        """Return the largest radius of corners, mm, at points (N, 2), mm: (N,); None if it is the same everywhere."""
        return None

    def at(self, z: float) -> Family:  # noqa: ARG002 - some families change with height
        """Return the family at a height, mm."""
        return self


@runtime_checkable
class RegionFamily(Protocol):
    """Protocol of a family that follows the outline of the region: its lines need no clipping."""

    def strands_inside(self, region: Polygon | MultiPolygon, spec: PathSpec) -> list[Path]:
        """Return lines inside `region`, (N, 2) float64 each, mm."""
        ...


@dataclass(frozen=True, kw_only=True)
class CentredFamily(Family):
    """Lines about `middle`, mm, which should be that of the entire part in every layer; by default, that of the box."""

    middle: tuple[float, float] | None = None
    angle: float = 0.0

    def middle_of(self, bounds: Bounds) -> Path:
        """Return the point that the lines lie about, (2,), mm."""
        return (
            np.array(bounds, dtype=np.float64).reshape(2, 2).mean(axis=0)
            if self.middle is None
            else np.array(self.middle)
        )


@dataclass(frozen=True, kw_only=True)
class TurnedFamily(Family):
    """The lines of another family, turned by `angle` degrees about (0, 0), then shifted by `phase`, mm."""

    family: Family
    angle: float
    phase: tuple[float, float]

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the lines of the family in the turned box, turned and then shifted."""
        from patterns.linework import turn

        return [turn(path, self.angle) + self.phase for path in self.family.strands(self._turned_bounds(bounds), spec)]

    def nominal_strands(self, bounds: Bounds, spec: PathSpec) -> list[NominalStrand]:
        """Return the nominal strands of the family in the turned box, turned and then shifted."""
        from patterns.linework import turn

        return [
            NominalStrand(
                points=turn(strand.points, self.angle) + self.phase,
                sides=strand.sides,
                across=turn(strand.across[None], self.angle)[0],
            )
            for strand in self.family.nominal_strands(self._turned_bounds(bounds), spec)
        ]

    def _turned_bounds(self, bounds: Bounds) -> Bounds:
        """Return the box around a box that is shifted and turned back."""
        from patterns.linework import turn

        corners = np.array([[x, y] for x in bounds[::2] for y in bounds[1::2]], dtype=np.float64)
        turned_corners = turn(corners - self.phase, -self.angle)
        (x0, y0), (x1, y1) = turned_corners.min(axis=0).tolist(), turned_corners.max(axis=0).tolist()
        return x0, y0, x1, y1

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell of the family."""
        return self.family.cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius of the family."""
        return self.family.largest_radius(cell, line_width)


def turn_family(family: Family, angle: float, phase: tuple[float, float]) -> Family:
    """Return a family turned by an angle, in degrees, and then shifted, mm."""
    if not angle and not any(phase):
        return family
    return TurnedFamily(
        name=family.name,
        summary=family.summary,
        prismatic=family.prismatic,
        wide=family.wide,
        family=family,
        angle=angle,
        phase=phase,
    )
