"""Closed lines, one inside another: insets of the region, and hearts about one point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from infill.paths.families.curves import SAGITTA
from infill.paths.families.family import Bounds, CentredFamily, Family, Path, PathSpec
from patterns.concentric import ARC, insets

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

SIMPLER = 0.002  # mm
SMALLEST = 3.0  # line widths that the side of the innermost heart has, at least
FEWEST, MOST = 9, 513  # points on a lobe


@dataclass(frozen=True, kw_only=True)
class ConcentricPaths(Family):
    """Closed lines at (k + 1/2) `cell` from the outline; where two sides of one would overlap, it draws back."""

    name: str = "concentric"
    summary: str = "lines that follow the outline of the region"
    corner_share: ClassVar[float] = 1.0  # larger arcs would leave the corners empty

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the insets of the box."""
        from shapely import box

        return self.strands_inside(box(*bounds), spec)

    def strands_inside(self, region: Polygon | MultiPolygon, spec: PathSpec) -> list[Path]:
        """Return the insets of the region; see `RegionFamily`."""
        import shapely

        paths: list[Path] = []
        for inner in insets(region, spec.cell / 2, spec.cell):
            open_area = shapely.simplify(_without_necks(inner, spec.gap / 2), SIMPLER)
            paths.extend(shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(open_area)))
        return paths


def _without_necks(inner: Polygon | MultiPolygon, half: float) -> Polygon | MultiPolygon:
    """Cut the necks out of an area, so that it holds discs of radius `half` everywhere.

    The ends at a neck are as far apart as the neck is wide.
    """
    opened = inner.buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)
    necks = opened.buffer(half, quad_segs=ARC).buffer(-half, quad_segs=ARC).difference(opened)
    if necks.area < (half / 8) ** 2:  # of fillets between chords of arcs, not of a neck
        return opened
    return opened.difference(necks.buffer(half)).buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)


@dataclass(frozen=True, kw_only=True)
class ConcentricHeartPaths(CentredFamily):
    """Hearts inside one another, `cell` apart at their straight sides and up to twice that at their lobes.

    They are turned by `angle` degrees.
    """

    name: str = "concentric-heart"
    summary: str = "nested hearts; lines that follow an outline and never cross"
    length_in_cell: ClassVar[float] = 0.83  # as measured in a square, whose corners see straight sides most
    corner_share: ClassVar[float] = 1.0  # larger arcs would leave the tip

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one closed line per heart."""
        from patterns.heart import heart_outline
        from patterns.linework import turn

        middle = self.middle_of(bounds)
        # The heart on a square of side s contains the disc of radius s / 2 about the middle of the square.
        reach = np.abs(np.array(bounds).reshape(2, 2) - middle).max(axis=0)
        sides = spec.cell * (2 * np.arange(math.ceil(math.hypot(*reach) / spec.cell) + 1) + 1)
        return [
            turn(side * (heart_outline(_lobe_points(side / 2)) - 0.5), self.angle) + middle
            for side in sides
            if side >= SMALLEST * spec.line_width
        ]


def _lobe_points(radius: float) -> int:
    """Return the number of points, an odd one, on a half circle."""
    exact_count = math.pi / 2 / math.acos(max(0.0, 1 - SAGITTA / radius))
    return min(MOST, max(FEWEST, 2 * math.ceil(exact_count / 2) + 1))
