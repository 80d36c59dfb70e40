"""Honeycomb as touching waves: one per row, every second one mirrored, so that flats of neighbours touch."""

from __future__ import annotations

import math
from dataclasses import dataclass

from infill.paths.families.protocol import TOUCH, Bounds, Path
from infill.paths.families.waves import Rows, Wave, draw_rows, solve_cell_for_density

TURN = math.radians(60)


@dataclass(frozen=True, kw_only=True)
class HoneycombPaths:
    """Hexagons whose walls across the rows are single and whose walls along them are double.

    `cell` is the distance between the walls along the rows. Flats are `flats` times as long as flanks, and what
    rounding takes from them: at any radius, about flats / (1 + flats) of the lines touches a neighbour.

    >>> rows = HoneycombPaths().rows(6.0, 0.45, 0.0)
    >>> round(rows.pitch, 3), round(rows.waves[0].top, 3)
    (3.407, 3.464)
    """

    name: str = "honeycomb"
    summary: str = "hexagons drawn as touching waves; stiff in every direction for little material"
    prismatic: bool = True
    wide: bool = False
    flats: float = 1.0

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float,  # noqa: ARG002 - every layer is equal
        layer: int,  # noqa: ARG002
        radius: float,
    ) -> list[Path]:
        """Return one wave per row; see `Family`."""
        return draw_rows(self.rows(cell, line_width, radius), bounds)

    def rows(self, cell: float, line_width: float, radius: float) -> Rows:
        """Return the rows of waves."""
        side, height = cell / math.sqrt(3), cell / 2
        flat = self.flats * side + 2 * min(radius, self.largest_radius(cell, line_width)) * math.tan(TURN / 2)
        wave = Wave(period=2 * flat + side, bottom=flat, top=flat, height=height)
        return Rows(waves=[wave], pitch=height + TOUCH * line_width, slip=wave.period / 2)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return solve_cell_for_density(lambda cell: self.rows(cell, line_width, 0).length_per_area, density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002 - flanks alone are the limit
        """Return the radius at which the arcs of a flank meet, mm."""
        return cell / 2
