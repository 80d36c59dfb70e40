"""Zigzag: two tall sine waves that cross, in a frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import parameter
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon

SAMPLES_PER_WAVE = 512


@dataclass(frozen=True, kw_only=True)
class Zigzag(Pattern):
    """Sine waves turned by +45 and by -45 degrees about the middle of the region, in a frame.

    The paper draws y = 1.5 sin(5 pi x) for -1.5 <= x <= 1.5 and crops both waves to the largest
    upright square inside them: 7.5 waves along the diagonal, each as tall as the diagonal is
    long. Here the waves run along the diagonals of the region and reach its corners; their
    strokes are nearly straight and lie `cell` apart. Source: Wang et al. 2020, Fig. 17(b).
    """

    name: ClassVar[str] = "zigzag"
    summary: ClassVar[str] = "two crossing waves, drawn in long, nearly straight strokes"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter()
    waves: float | None = parameter(
        None,
        "waves along the diagonal, instead of cell (the paper draws 7.5)",
        unit="",
        low=0.5,
        high=1e4,
        replaces="cell",
    )
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the two waves, clipped, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, bounds_centre, clip, turn

        waves = []
        for direction in (45, -45):
            along, across = self._reach(region, self.angle + direction)
            period = 2 * self._stroke_distance(along)
            samples = math.ceil(2 * along / period * SAMPLES_PER_WAVE) + 1
            x = np.linspace(-along, along, samples)
            wave = np.stack([x, across * np.sin(2 * math.pi * x / period)], axis=-1)
            waves.append(shapely.linestrings(turn(wave, self.angle + direction) + bounds_centre(region) + self.phase))
        lines = clip(waves, region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:
        """Return the distance of strokes along the diagonal, mm: the cell, or by `waves` that of the region."""
        return min(self._stroke_distance(self._reach(region, self.angle + direction)[0]) for direction in (45, -45))

    def _stroke_distance(self, along: float) -> float:
        """Return the distance of strokes: the cell, or the block divided by the number of waves."""
        return self.cell if self.waves is None else along / self.waves

    def _reach(self, region: Polygon | MultiPolygon, direction: float) -> tuple[float, float]:
        """Return the extent of the region from the middle of the wave, along and across it."""
        import numpy as np
        import shapely

        from patterns.linework import bounds_centre, turn

        corners = shapely.get_coordinates(shapely.envelope(region)) - bounds_centre(region) - self.phase
        along, across = np.abs(turn(corners, -direction)).max(axis=0)
        return float(along), float(across)
