"""Honeycomb in three dimensions: sections of truncated octahedra, drawn as pairs of waves that never cross.

In units of half a cell, the octahedra |x|, |y|, |z| <= 1, |x| + |y| + |z| <= 3/2 about the points of a
body-centred lattice fill space. At a height |z| <= 1/2 the section is of squares that stand on a corner, with half
a diagonal d = 1/2 + |z|, and of straight walls between their corners. A pair of waves passes above and below every
row of squares and touches along the straight walls. Half a cell higher the rows run across; both
directions draw the same squares there, so that each layer lies on the one below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from infill.paths.families.protocol import TOUCH, Bounds, Path
from infill.paths.families.waves import Rows, Wave, draw_rows, solve_cell_for_density

SECTIONS = 24  # in which the mean over heights is taken
SHARE = 0.25  # of a cell that a radius may have: half of the shortest flank


@dataclass(frozen=True, kw_only=True)
class Honeycomb3DPaths:
    """Truncated octahedra; `cell` is the distance between neighbours side by side, and of equal layers.

    >>> low, high = Honeycomb3DPaths().rows(8.0, 0.45, 0.0).waves
    >>> round(high.height, 3), round(high.bottom, 3), round(high.base - low.base - low.height, 3)
    (1.796, 4.407, 0.407)
    """

    name: str = "honeycomb-3d"
    summary: str = "truncated octahedra; closed cells that are stiff in height as well"
    prismatic: bool = False
    wide: bool = False

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float,
        layer: int,  # noqa: ARG002 - the height decides
        radius: float,  # noqa: ARG002 - walls in common are long
    ) -> list[Path]:
        """Return two waves a row; see `Family`."""
        rows = self.rows(cell, line_width, z)
        if not _runs_along_y(cell, z):
            return draw_rows(rows, bounds)
        x0, y0, x1, y1 = bounds
        return [path[:, ::-1] for path in draw_rows(rows, (y0, x0, y1, x1))]

    def rows(self, cell: float, line_width: float, z: float) -> Rows:
        """Return the rows of waves at height `z`, as if they ran along x."""
        gap = TOUCH * line_width
        part = 2 * z / cell % 1
        half = 0.5 + min(part, 1 - part)
        height = half * (cell / 2 - gap)
        wall = cell - 2 * height
        place = cell / 2 if _runs_along_y(cell, z) else 0.0
        high = Wave(period=cell, bottom=wall, top=0, height=height, base=place + gap / 2, shift=place)
        low = Wave(
            period=cell, bottom=0, top=wall, height=height, base=place - gap / 2 - height, shift=place + cell / 2
        )
        return Rows(waves=[low, high], pitch=cell, slip=0)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, in the mean over heights; see `Family`."""

        def length_per_area(cell: float) -> float:
            heights = [cell / 2 * part / SECTIONS for part in range(SECTIONS)]
            return sum(self.rows(cell, line_width, z).length_per_area for z in heights) / SECTIONS

        return solve_cell_for_density(length_per_area, density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which the arcs of a flank meet in the lowest section, mm."""
        return SHARE * cell


def _runs_along_y(cell: float, z: float) -> bool:
    """Tell whether rows run along y at height `z`."""
    return math.floor(2 * z / cell + 0.5) % 2 == 1
