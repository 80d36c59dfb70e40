"""Concentric hearts: nested copies of one outline around a common centre."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import parameter
from patterns.errors import PatternError
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

ARC_POINTS = 257  # odd, so that the tip of a lobe is a point


def heart_outline(arc_points: int = ARC_POINTS) -> NDArray[np.float64]:
    r"""Return the closed outline of a heart on the square 0 <= x, y <= 1: (N, 2), first = last.

    The straight sides lie on the axes, half discs of radius 1/2 on the right and top sides, the tip
    at (0, 0). As in the paper, one half is given as points, `arc_points` (an odd number) of them on its
    half disc, and mirrored about y = x.

            .--.
           /    |
          |     .--.
          |    '    \      notch at (1, 1)
          |         |
          o--------/       tip at (0, 0)
    """
    import numpy as np

    angle = np.linspace(-math.pi / 2, math.pi / 2, arc_points)
    lobe = np.stack([1 + np.cos(angle) / 2, 0.5 + np.sin(angle) / 2], axis=-1)
    half = np.concatenate([[(0.0, 0.0)], lobe])
    half[-1] = (1.0, 1.0)  # the notch, on the mirror line exactly
    mirrored = half[::-1, ::-1]
    return np.concatenate([half, mirrored[1:]])


@dataclass(frozen=True, kw_only=True)
class ConcentricHeart(Pattern):
    """Hearts inside one another, as large as the region allows, with the tip at the lower left.

    Copies are scaled about the middle of the square they occupy, in even steps. The gap between
    neighbours is `cell` at the straight sides and at the notch, and twice that at the tips of the
    lobes; no other centre makes it more even. In a region that is not square, the hearts lie in
    its middle; parts that `phase` shifts out of the region are cut off. Source: Wang et al. 2020, Fig. 17(a).
    """

    name: ClassVar[str] = "concentric-heart"
    summary: ClassVar[str] = "nested hearts; lines that follow an outline and never cross"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter()
    hearts: int | None = parameter(
        None, "number of hearts, instead of cell", unit="", low=1, high=1000, whole=True, replaces="cell"
    )
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=False)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return one closed line per heart, the largest first, and the frame if there is one."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, bounds_centre, clip, turn

        largest, gap = self._side(region), self.line_spacing(region)
        # A heart is left out if its interior would be narrower than a gap.
        count = self.hearts or max(1, math.floor((largest - gap) / (2 * gap)) + 1)
        sides = largest - 2 * gap * np.arange(count)
        hearts = turn(sides[:, None, None] * (heart_outline() - 0.5), self.angle)
        placed_hearts = (
            hearts - (hearts[0].min(axis=0) + hearts[0].max(axis=0)) / 2 + bounds_centre(region) + self.phase
        )
        lines = clip(shapely.linestrings(placed_hearts), region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:
        """Return the gap between neighbours at the straight sides, mm."""
        return self.cell if self.hearts is None else self._side(region) / (2 * self.hearts)

    def _side(self, region: Polygon | MultiPolygon) -> float:
        """Return the side of the square under the largest heart that fits the bounding box."""
        from patterns.linework import turn

        x0, y0, x1, y1 = region.bounds
        shape = turn(heart_outline(), self.angle)
        width, depth = shape.max(axis=0) - shape.min(axis=0)
        side = float(min((x1 - x0) / width, (y1 - y0) / depth))
        if side <= 0:
            raise PatternError("the region has no area; give a larger one")
        return side
