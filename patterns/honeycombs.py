"""Honeycombs in space: truncated octahedra, and hexagonal tubes that lie on their side."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import parameter
from patterns.polyhedra import Polyhedra, Vector

if TYPE_CHECKING:
    from patterns.polyhedra import Floats

SLANTED = 1 / math.sqrt(3)

NORMALS = (
    (1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (0.0, 0.0, 1.0),
    (SLANTED, SLANTED, SLANTED),
    (SLANTED, SLANTED, -SLANTED),
    (SLANTED, -SLANTED, SLANTED),
    (-SLANTED, SLANTED, SLANTED),
)
# In half cells, the middles are the points whose coordinates are all even, or all odd: a body-centred lattice. For two
# cells that touch, the sums of these coordinates differ by 1, 2 or 3.
MIDDLES = tuple(
    tuple(
        (x / 2, y / 2, z / 2)
        for x, y, z in itertools.product(range(4), repeat=3)
        if x % 2 == y % 2 == z % 2 and (x + y + z) % 4 == which
    )
    for which in range(4)
)


@dataclass(frozen=True, kw_only=True)
class Honeycomb3D(Polyhedra):
    """Walls of truncated octahedra."""

    paths: ClassVar[bool] = True

    name: str = "honeycomb-3d"
    summary: str = "truncated octahedra: closed cells, about as stiff in every direction"
    normals: tuple[Vector, ...] = NORMALS
    halves: tuple[float, ...] = (0.5, 0.5, 0.5, *(0.75 * SLANTED,) * 4)  # |x| + |y| + |z| <= 3/4
    period: Vector = (2.0, 2.0, 2.0)
    middles: tuple[tuple[Vector, ...], ...] = MIDDLES


@dataclass(frozen=True, kw_only=True)
class LateralHoneycomb(Polyhedra):
    """Hexagonal tubes along x, one upon another; `cell` is the distance between upright walls.

    All walls of a tube have the same width; those between upright ones lean by `overhang`, and 60 degrees make regular
    hexagons.
    """

    paths: ClassVar[bool] = True

    name: str = "lateral-honeycomb"
    summary: str = "hexagonal tubes on their side, along x; leaning walls print without support"
    overhang: float = parameter(
        45.0, "how far walls lean from upright; 60 makes hexagons regular", unit="deg", low=30.0, high=75.0
    )

    def faces(self) -> tuple[Floats, Floats]:
        """Return a normal for each pair of faces, and its distance from the middle, in cells."""
        import numpy as np

        width, rise = self._wall()
        leaning = math.radians(self.overhang)
        cosine, sine = math.cos(leaning), math.sin(leaning)
        normals = np.array([(0.0, 1.0, 0.0), (0.0, cosine, sine), (0.0, -cosine, sine)])
        half = sine * (width / 2 + rise)
        return normals, np.array([0.5, half, half])

    def lattice(self) -> tuple[Floats, Floats]:
        """Return the period of the tubes and their middles by class, in cells: every third of a row is of one class."""
        import numpy as np

        pitch = sum(self._wall())
        middles = [[(0.0, which, 0.0), (0.0, which + 1.5, pitch)] for which in range(3)]
        return np.array([1.0, 3.0, 2 * pitch]), np.array(middles, dtype=np.float64)

    def _wall(self) -> tuple[float, float]:
        """Return the width of a wall, and the rise of a leaning one, in cells."""
        leaning = math.radians(self.overhang)
        return 0.5 / math.sin(leaning), 0.5 / math.tan(leaning)
