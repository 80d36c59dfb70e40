"""Octagons with squares between them: the truncated tiling of squares, an octagon centred on (0, 0)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon

HALF_WIDTH = 0.5  # of an octagon's width
HALF_SIDE = HALF_WIDTH * (math.sqrt(2) - 1)  # half a side
# Of an octagon of width 1 about (0, 0): the side to the right, the one on top, and the four that it shares with
# squares. Together, those of all octagons are all walls, each once.
SIDES = (
    ((HALF_WIDTH, -HALF_SIDE), (HALF_WIDTH, HALF_SIDE)),
    ((-HALF_SIDE, HALF_WIDTH), (HALF_SIDE, HALF_WIDTH)),
    ((HALF_WIDTH, HALF_SIDE), (HALF_SIDE, HALF_WIDTH)),
    ((-HALF_SIDE, HALF_WIDTH), (-HALF_WIDTH, HALF_SIDE)),
    ((-HALF_WIDTH, -HALF_SIDE), (-HALF_SIDE, -HALF_WIDTH)),
    ((HALF_SIDE, -HALF_WIDTH), (HALF_WIDTH, -HALF_SIDE)),
)


@dataclass(frozen=True, kw_only=True)
class Octagons(Pattern):
    """Regular octagons, `cell` wide, and squares, in a frame.

    There are 6 (sqrt(2) - 1) / `cell` mm of wall per square millimetre.
    """

    name: ClassVar[str] = "octagons"
    summary: ClassVar[str] = "octagons and squares: round cells, three walls at every corner"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter(7.0)
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the walls as segments from node to node, clipped to the region, and the frame if there is one."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, clip, drop_distant, turn

        corners = shapely.get_coordinates(shapely.envelope(region)) - self.phase
        low, high = (limit(turn(corners, -self.angle), axis=0) for limit in (np.min, np.max))
        low_cell, high_cell = np.floor(low / self.cell) - 1, np.ceil(high / self.cell) + 1
        column, row = np.meshgrid(
            np.arange(low_cell[0], high_cell[0] + 1), np.arange(low_cell[1], high_cell[1] + 1), indexing="ij"
        )
        centres = np.stack([column, row], axis=-1) * self.cell
        centres = drop_distant(centres, region, angle=self.angle, phase=self.phase, reach=2 * self.cell)[:, None, None]
        cell_walls = np.array(SIDES) * self.cell
        walls = turn((centres + cell_walls).reshape(-1, 2, 2), self.angle) + np.array(self.phase)
        lines = clip(shapely.linestrings(walls), region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between opposite walls of an octagon, mm."""
        return self.cell
