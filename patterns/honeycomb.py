"""Honeycomb: a tessellation of regular hexagons, one of them centred on (0, 0)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon


@dataclass(frozen=True, kw_only=True)
class Honeycomb(Pattern):
    """Regular hexagons, each wall shared by two cells, in a frame.

    Two sides of every hexagon are vertical at angle 0. There are 2 / `cell` mm of wall per
    square millimetre. Source: Wang et al. 2020, Fig. 17(c).

    >>> from shapely import box
    >>> len(Honeycomb(cell=6, frame=False).lines(box(-3.1, -3.6, 3.1, 3.6)).geoms)
    12
    """

    name: ClassVar[str] = "honeycomb"
    summary: ClassVar[str] = "hexagons: stiff from above, equally soft from all sides"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter()
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the walls as segments from node to node, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, clip, drop_distant, turn

        corners = shapely.get_coordinates(shapely.envelope(region)) - self.phase
        low, high = (limit(turn(corners, -self.angle), axis=0) for limit in (np.min, np.max))
        pitch = np.array([self.cell, self.cell * math.sqrt(3) / 2])
        low_cell, high_cell = np.floor(low / pitch) - 1, np.ceil(high / pitch) + 1
        column, row = np.meshgrid(
            np.arange(low_cell[0], high_cell[0] + 1), np.arange(low_cell[1], high_cell[1] + 1), indexing="ij"
        )
        half, radius = self.cell / 2, self.cell / math.sqrt(3)
        centres = np.stack([column + (row % 2) / 2, row], axis=-1) * pitch
        centres = drop_distant(centres, region, angle=self.angle, phase=self.phase, reach=2 * radius)[:, None, None]
        right_low, right_high, top, left_high = (
            (half, -radius / 2),
            (half, radius / 2),
            (0.0, radius),
            (-half, radius / 2),
        )
        cell_walls = np.array([[right_low, right_high], [right_high, top], [top, left_high]])
        walls = turn((centres + cell_walls).reshape(-1, 2, 2), self.angle) + np.array(self.phase)
        lines = clip(shapely.linestrings(walls), region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between opposite walls, mm."""
        return self.cell
