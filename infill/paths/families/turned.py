"""A family of lines, turned about the vertical axis and shifted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.paths.families.protocol import Bounds, Family, Path


@dataclass(frozen=True, kw_only=True)
class TurnedFamily:
    """The lines of another family, turned by `angle` degrees about (0, 0), then shifted by `phase`, mm."""

    family: Family
    angle: float = 0.0
    phase: tuple[float, float] = (0.0, 0.0)

    @property
    def name(self) -> str:
        """The name of the family."""
        return self.family.name

    @property
    def summary(self) -> str:
        """Purpose of the family."""
        return self.family.summary

    @property
    def prismatic(self) -> bool:
        """True if every layer is equal."""
        return self.family.prismatic

    @property
    def wide(self) -> bool:
        """True if its corners move outwards before rounding."""
        return self.family.wide

    def strands(
        self, bounds: Bounds, *, cell: float, line_width: float, z: float, layer: int, radius: float
    ) -> list[Path]:
        """Return the lines of the family in the box, turned by `angle` and then shifted by `phase`."""
        from patterns.linework import turn

        corners = np.array([[x, y] for x in bounds[::2] for y in bounds[1::2]], dtype=np.float64)
        turned_corners = turn(corners - self.phase, -self.angle)
        (x0, y0), (x1, y1) = turned_corners.min(axis=0).tolist(), turned_corners.max(axis=0).tolist()
        paths = self.family.strands((x0, y0, x1, y1), cell=cell, line_width=line_width, z=z, layer=layer, radius=radius)
        return [turn(path, self.angle) + self.phase for path in paths]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return self.family.cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the largest radius of corners, mm; see `Family`."""
        return self.family.largest_radius(cell, line_width)
