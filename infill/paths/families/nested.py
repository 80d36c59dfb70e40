"""Closed lines, one inside another: insets of the region, and hearts about one point."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from infill.arrays import Floats
from infill.paths.families.curves import SAGITTA
from infill.paths.families.family import STRETCHED_TOUCH, Bounds, CentredFamily, Family, Path, PathSpec
from infill.paths.travel_times import TravelTimes, find_travel_times
from patterns.concentric import ARC, insets

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

SIMPLER = 0.002  # mm
SMALLEST = 3.0  # line widths that the side of the innermost heart has, at least
FEWEST, MOST = 9, 513  # points on a lobe
GRID_STEPS = 3.0  # of the grid of travel times, in a line width
MOST_NODES = 2_000_000
CUTS = 4  # rounds in which necks are cut out: a cut may leave others
NECK = 1.3  # line widths between two sides of a line that crowds, as rounding its corners moves them together


@dataclass(frozen=True, kw_only=True)
class ConcentricPaths(Family):
    """Closed lines at (k + 1/2) `cell` from the outline; where two sides of one would overlap, it draws back."""

    name: str = "concentric"
    summary: str = "lines that follow the outline of the region"
    corner_share: ClassVar[float] = 1.0  # larger arcs would leave the corners empty
    stretches: ClassVar[bool] = True

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the lines in the box."""
        from shapely import box

        return self.strands_inside(box(*bounds), spec)

    def strands_inside(self, region: Polygon | MultiPolygon, spec: PathSpec) -> list[Path]:
        """Return the insets of the region; see `RegionFamily`."""
        return _outlines(insets(region, spec.cell / 2, spec.cell), spec.gap)


@dataclass(frozen=True, kw_only=True, eq=False)
class RatioMap:
    """Ratios at the nodes of a grid, and between them.

    Parameters
    ----------
    corner : (2,) float64, mm
        The first node.
    step : float, mm
    values : (N, M) float64
        Of the density to the middle one.
    """

    corner: Floats
    step: float
    values: Floats

    def at(self, points: Floats) -> Floats:
        """Return the ratios at points (N, 2), mm: (N,)."""
        from scipy.ndimage import map_coordinates

        places = (points - self.corner) / self.step
        ratios: Floats = map_coordinates(self.values, places.T, order=1, mode="nearest")
        return ratios


@dataclass(frozen=True, kw_only=True)
class GradedRings(ConcentricPaths):
    """Closed lines that follow the outline and crowd where the density is higher.

    They lie where a front from the outline arrives at times k + 1/2. It crosses a cell of the size at hand in a unit of
    time, |∇t| = r / `cell` with the ratio r of the density to the middle one, so that a line is one such cell from the
    next, and the length of lines in an area is what the density integrates to (the coarea formula).
    """

    ratios: RatioMap
    least_spacing: ClassVar[float] = STRETCHED_TOUCH

    def strands_inside(self, region: Polygon | MultiPolygon, spec: PathSpec) -> list[Path]:
        """Return the lines inside the region; see `RegionFamily`."""
        unit = _unit_times(region, self.ratios, spec.line_width / GRID_STEPS)
        count = max(0, math.ceil(float(unit.times.max()) / spec.cell - 0.5))
        areas = (unit.area_beyond((number + 0.5) * spec.cell) for number in range(count))
        return _outlines(areas, NECK * spec.line_width, least_spacing=self.least_spacing * spec.line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius where cells are largest."""
        return super().largest_radius(cell, line_width) / float(self.ratios.values.min())

    def radii_at(self, points: Floats, cell: float, line_width: float) -> Floats:
        """Return the largest radius of corners, mm, at points, (N, 2): (N,)."""
        return super().largest_radius(cell, line_width) / self.ratios.at(points)


@lru_cache(maxsize=8)
def _unit_times(region: Polygon | MultiPolygon, ratios: RatioMap, step: float) -> TravelTimes:
    """Return the travel times in a region for a cell of 1 mm."""
    x0, y0, x1, y1 = region.bounds
    return find_travel_times(region, ratios.at, max(step, math.sqrt((x1 - x0) * (y1 - y0) / MOST_NODES)))


def _outlines(areas: Iterable[Polygon | MultiPolygon], gap: float, least_spacing: float = 0.0) -> list[Path]:
    """Return the outlines of areas, each inside the one before: closed lines, (N, 2), mm.

    Parameters
    ----------
    areas : iterable of Polygon or MultiPolygon
        Largest first.
    gap : float, mm
        Where two sides of an outline would be less apart, it draws back.
    least_spacing : float, mm
        Between one outline and the next, also where the outer one draws back.
    """
    import shapely

    paths: list[Path] = []
    room = None
    for area in areas:
        open_area = _without_necks(area if room is None else area.intersection(room), gap / 2)
        if least_spacing:
            room = open_area.buffer(-least_spacing, quad_segs=ARC)
        rings = shapely.get_rings(shapely.get_parts(shapely.simplify(open_area, SIMPLER)))
        paths.extend(shapely.get_coordinates(ring) for ring in rings)
    return paths


def _without_necks(inner: Polygon | MultiPolygon, half: float) -> Polygon | MultiPolygon:
    """Cut the necks out of an area, so that it holds discs of radius `half` everywhere.

    The ends at a neck are as far apart as the neck is wide.
    """
    import shapely

    opened = inner.buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)
    for _ in range(CUTS):
        gaps = opened.buffer(half, quad_segs=ARC).buffer(-half, quad_segs=ARC).difference(opened)
        parts = shapely.get_parts(gaps)
        necks = parts[shapely.area(parts) > (half / 8) ** 2]  # others are fillets between the chords of arcs
        if not len(necks):
            break
        cut = opened.difference(shapely.buffer(shapely.union_all(necks), half))
        opened = cut.buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)
    return opened


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
