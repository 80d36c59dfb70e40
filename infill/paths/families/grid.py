"""Square cells with every crossing resolved: rows of zigzags whose crests touch."""

from __future__ import annotations

import math
from dataclasses import dataclass

from infill.paths.families.protocol import TOUCH, Bounds, Path
from infill.paths.families.waves import Rows, Wave, crest_length, draw_rows, solve_cell_for_density

TURN = math.radians(45)  # at each end of a crest
SHARE = 0.3  # of a cell that a radius may have, so that cells stay nearly square


@dataclass(frozen=True, kw_only=True)
class Zigzags:
    """Flanks at 45° to the rows, which run at `angle` degrees; `cell` is the distance between parallel flanks.

    >>> rows = Zigzags(name="zigzag", summary="").rows(4.0, 0.45, 1.0)
    >>> round(rows.waves[0].height, 3), round(rows.pitch, 3)
    (2.828, 3.236)
    """

    name: str
    summary: str
    angle: float = 0.0
    prismatic: bool = True
    wide: bool = False

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
        """Return one zigzag per row; see `Family`."""
        return draw_rows(self.rows(cell, line_width, radius), bounds)

    def rows(self, cell: float, line_width: float, radius: float) -> Rows:
        """Return the rows of zigzags."""
        height = cell / math.sqrt(2)
        crest = crest_length(line_width, min(radius, self.largest_radius(cell, line_width)), TURN)
        wave = Wave(period=2 * (height + crest), bottom=crest, top=crest, height=height)
        return Rows(waves=[wave], pitch=height + TOUCH * line_width, slip=wave.period / 2, angle=self.angle)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return solve_cell_for_density(lambda cell: self.rows(cell, line_width, 0).length_per_area, density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which cells are still nearly square, mm; crests touch at any."""
        return SHARE * cell


ZIGZAG = Zigzags(name="zigzag", summary="the paper's crossing strokes, resolved into zigzags that touch")
GRID = Zigzags(name="grid", summary="squares; every crossing resolved, so that no bead runs over another", angle=45.0)
