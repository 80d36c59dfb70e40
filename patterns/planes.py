"""Closed cells between parallel planes that cross: cubes, octahedra and tetrahedra; and tubes on their side."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from patterns.declared import format_decimal, parameter
from patterns.errors import PatternError
from patterns.unit_cells import Planes

Vector = tuple[float, float, float]

# A cube stands on one corner: its diagonal is upright, so that all planes have the same slope.
UP, ACROSS = 1 / math.sqrt(3), (1 / math.sqrt(2), 1 / math.sqrt(6))
ON_A_CORNER = (
    (ACROSS[0], ACROSS[1], UP),
    (-ACROSS[0], ACROSS[1], UP),
    (0.0, -2 * ACROSS[1], UP),
)
TETRAHEDRON = ((1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0))

MIN_ANGLE_BETWEEN = 15.0  # degrees: walls that cross at less leave slivers


@dataclass(frozen=True, kw_only=True)
class Cubic(Planes):
    """Walls of cubes that stand on a corner."""

    paths: ClassVar[bool] = True

    name: str = "cubic"
    summary: str = "cubes on their corners: strong in every direction, prints without support"
    normals: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    upright: tuple[Vector, ...] = ON_A_CORNER


@dataclass(frozen=True, kw_only=True)
class QuarterCubic(Planes):
    """Walls of tetrahedra, with and without corners."""

    paths: ClassVar[bool] = True

    name: str = "quarter-cubic"
    summary: str = "tetrahedra, with and without corners: very stiff for its weight"
    normals: tuple[Vector, ...] = TETRAHEDRON
    offsets: tuple[float, ...] = (0.0, 0.0, 0.0, 0.5)


@dataclass(frozen=True, kw_only=True)
class Tetrahedral(Planes):
    """Walls of octahedra and tetrahedra."""

    name: str = "tetrahedral"
    summary: str = "octahedra and tetrahedra with closed faces: very stiff for its weight"
    normals: tuple[Vector, ...] = TETRAHEDRON


@dataclass(frozen=True, kw_only=True)
class LateralLattice(Planes):
    """Walls that lean to both sides, around tubes along x; `cell` is the horizontal distance within a family.

    A wing or a blade is printed standing: such walls run across it, and meet its skin at a chosen angle.
    """

    name: str = "lateral-lattice"
    summary: str = "walls that lean this way and that, around tubes along x; for ribs, wings and blades"
    normals: tuple[Vector, ...] = ()
    first: float = parameter(-45.0, "how far walls one way lean from upright", unit="deg", low=-75.0, high=75.0)
    second: float = parameter(45.0, "how far those the other way lean", unit="deg", low=-75.0, high=75.0)

    def __post_init__(self) -> None:
        """Check the parameters, and derive the normals of the planes."""
        super().__post_init__()
        if abs(self.first - self.second) < MIN_ANGLE_BETWEEN:
            raise PatternError.about(
                ("first", "second"),
                f"of {self.name} are {format_decimal(self.first)} and {format_decimal(self.second)} degrees; they "
                "must be at "
                f"least {format_decimal(MIN_ANGLE_BETWEEN)} degrees apart",
            )
        angles = (self.first, self.second)
        normals = tuple((0.0, 1.0, round(math.tan(math.radians(angle)), 12)) for angle in angles)
        object.__setattr__(self, "normals", normals)
