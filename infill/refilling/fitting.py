"""Fit smooth paths into one area of a layer, at a cell that gives them the target length."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats
from infill.paths.clipping import is_closed
from infill.paths.corners import UNIT, RoundedPaths
from infill.paths.covering import cover, total_length
from infill.paths.families.family import TOUCH
from infill.paths.joining import SHORTEST, SLACK
from infill.paths.layer_below import LayerBelow
from infill.paths.neighbours import BeadIndex
from infill.paths.rounding import round_paths
from infill.paths.trimming import trim_ends
from infill.paths.wall_joins import round_wall_joins
from infill.ragged import concatenate_rows, split_rows
from infill.refilling.planning import RefillPlan

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Paths = list[Floats]

REGION_TOLERANCE = 0.01  # mm that a path may leave its region
ROUNDING_TRIES = 3  # rounds of rounding until all paths stay inside
SHARP_RADIUS = 1.5  # mm from the place where a path leaves its region to the corners that cause it
COLUMN_TOLERANCE = 0.25  # the same before a column changes its cell, so that its layers no longer lie on one another
TRIES = 4
SEARCH_TOLERANCE = 0.02  # relative error of the length that ends the search
SMALL_LENGTH = 300.0  # mm of lines, below which the search always scans cells around too: the length jumps there
SPREAD, SCANNED = 0.35, 30
LEAST_LENGTH = 5.0  # mm: areas with less keep the cell of their column
NEWEST_WEIGHT = 0.2  # weight of the last layer in the density of a column


@dataclass(frozen=True, kw_only=True)
class Column:
    """Areas that stand on one another.

    Parameters
    ----------
    area : Polygon
        The topmost.
    cell : float, mm
    density : float
        mm of the slicer's infill per mm², averaged over the last layers: it varies from layer to layer.
    fresh : bool
        True if no area stands below, so that its cell is still free.
    """

    area: Polygon
    cell: float
    density: float
    fresh: bool

    @property
    def length(self) -> float:
        """Target length of its paths, mm."""
        return self.density * float(self.area.area)


def continue_column(area: Polygon, length: float, plan: RefillPlan, below: Sequence[Column], z: float) -> Column:
    """Continue the column below an area, or begin a new one.

    Parameters
    ----------
    area : Polygon
    length : float, mm
        Of the slicer's infill in it.
    plan : RefillPlan
    below : sequence of Column
        Of the layer below.
    z : float, mm
    """
    best, largest_overlap = None, 0.0
    for candidate in below:
        if candidate.area is area:
            best = candidate
            break
        if candidate.area.envelope.intersects(area):
            overlap = candidate.area.intersection(area).area
            if overlap > max(largest_overlap, area.area / 2):
                best, largest_overlap = candidate, overlap
    requested = plan.density_in(area, z if plan.height is None else plan.height)
    density = length / area.area if requested is None else requested
    if best is None:
        return Column(area=area, cell=plan.cell, density=density, fresh=True)
    if plan.graded is not None:
        return Column(area=area, cell=best.cell, density=density, fresh=False)
    return Column(
        area=area, cell=best.cell, density=(1 - NEWEST_WEIGHT) * best.density + NEWEST_WEIGHT * density, fresh=False
    )


@dataclass(frozen=True, kw_only=True)
class AreaSetting:
    """Plan, neighbours and motion for the paths of an area.

    Parameters
    ----------
    plan : RefillPlan
    walls : BeadIndex
        The other beads of the layer, as layer 0.
    z : float, mm
    layer : int
    speed, acceleration : float
        mm/s and mm/s².
    ground : LayerBelow, optional
        The layer below, if paths should lie on it.
    """

    plan: RefillPlan
    walls: BeadIndex
    z: float
    layer: int
    speed: float
    acceleration: float
    ground: LayerBelow | None = None


@dataclass(frozen=True, kw_only=True)
class FittedPaths:
    """Paths in an area.

    Parameters
    ----------
    paths : list of (N, 2) float64, mm
    radii : (C,) float64, mm
        Of the arcs; 0 or infinite at corners without an arc.
    cell : float, mm
    """

    paths: Paths
    radii: Floats
    cell: float

    @property
    def length(self) -> float:
        """Total length, mm."""
        return total_length(self.paths)


def fit_paths(column: Column, setting: AreaSetting) -> FittedPaths:
    """Draw paths in the area of a column, at its cell or at one that gives them the target length.

    The length jumps with the cell in small areas: the closest of a few is the result. A requested cell stays.
    """
    target = column.length
    best = _cover_smoothly(column.area, column.cell, setting)
    # A pattern that varies with the height has one cell everywhere, or its layers would not fit one another.
    plan = setting.plan
    if not plan.has_own_cells or target <= LEAST_LENGTH:
        return best
    error = best.length / target - 1
    if abs(error) <= (plan.tolerance if column.fresh else COLUMN_TOLERANCE):
        return best
    nearby_cells, cell = (
        _nearby_cells(column, plan) if target < SMALL_LENGTH or column.fresh else np.empty(0),
        column.cell,
    )
    for attempt in range(TRIES + len(nearby_cells)):
        if attempt >= TRIES and target >= SMALL_LENGTH and abs(best.length / target - 1) <= plan.tolerance:
            break
        cell = cell * float(np.clip(1 + error, 0.6, 1.6)) if attempt < TRIES else float(nearby_cells[attempt - TRIES])
        cell = max(cell, TOUCH * plan.line_width)
        candidate = _cover_smoothly(column.area, cell, setting)
        error = candidate.length / target - 1
        if abs(error) < abs(best.length / target - 1):
            best = candidate
        if abs(error) < min(SEARCH_TOLERANCE, plan.tolerance):
            break
    return best


def _nearby_cells(column: Column, plan: RefillPlan) -> Floats:
    """Return cells around that of a column, mm; for a column with a free cell, those around that of the plan first."""
    steps = np.exp(np.linspace(-SPREAD, SPREAD, SCANNED))
    nearest = steps[np.argsort(np.abs(np.log(steps)), kind="stable")]
    if not column.fresh or column.cell == plan.cell:
        return column.cell * nearest
    return np.concatenate([plan.cell * nearest, column.cell * nearest])


def _cover_smoothly(area: Polygon, cell: float, setting: AreaSetting) -> FittedPaths:
    """Cover an area with rounded paths; where one would leave it, its corners stay sharp."""
    import shapely

    plan = setting.plan
    strands = cover(
        area,
        plan.family,
        cell=cell,
        line_width=plan.line_width,
        z=setting.z,
        layer=setting.layer,
        radius=plan.radius,
        ground=setting.ground,
    )
    strands = [path for path in strands if len(path) > 1]
    if not strands:
        return FittedPaths(paths=[], radii=np.empty(0), cell=cell)
    tolerance_area = shapely.buffer(area, REGION_TOLERANCE)
    shapely.prepare(tolerance_area)
    strands = _curve_into_walls(strands, tolerance_area, cell, setting)
    corners = np.concatenate(strands)
    hard = np.zeros(len(corners), dtype=bool)
    largest_radii = plan.radii_at(strands, cell)
    for _ in range(ROUNDING_TRIES):
        smooth_paths, radii = round_paths(
            strands,
            walls=setting.walls,
            acceleration=setting.acceleration,
            speed=setting.speed,
            rounding=plan.rounding_of(cell),
            line_width=plan.line_width,
            hard=hard,
            wide=plan.family.wide,
            radii=largest_radii,
            kept_turn=plan.kept_turn,
        )
        lines = np.array([shapely.linestrings(path) for path in smooth_paths])
        inside = shapely.covers(tolerance_area, lines)
        if inside.all():
            break
        outside = shapely.union_all(shapely.difference(lines[~inside], tolerance_area))
        hard |= shapely.dwithin(shapely.points(corners), outside, SHARP_RADIUS)
    paths = list(smooth_paths)
    if inside.all():
        return FittedPaths(paths=_trim_free_ends(paths, plan), radii=radii, cell=cell)
    points, first = concatenate_rows(strands)
    sharp_paths = RoundedPaths(
        points=np.rint(points / UNIT) * UNIT,
        first=first,
        source=np.arange(len(points)),
        radius=np.full(len(points), 0.0),
    )
    merged = plan.rounding.merge_segments(sharp_paths, speed=setting.speed, acceleration=setting.acceleration)
    whole, plain = split_rows(sharp_paths.points, first), split_rows(merged.points, merged.first)
    for number in np.flatnonzero(~inside).tolist():  # merging may take a path out of its area too
        fits = shapely.covers(tolerance_area, shapely.linestrings(plain[number]))
        paths[number] = plain[number] if fits else whole[number]
    return FittedPaths(paths=_trim_free_ends(paths, plan), radii=radii, cell=cell)


def _curve_into_walls(strands: Paths, area: Polygon | MultiPolygon, cell: float, setting: AreaSetting) -> Paths:
    """Round the corners at which strands run into the walls of an area."""
    plan = setting.plan
    return round_wall_joins(
        strands,
        setting.walls,
        area,
        line_width=plan.line_width,
        largest=plan.rounding_of(cell).radius,
        spacing=plan.family.least_spacing * plan.line_width,
    )


def _trim_free_ends(paths: Paths, plan: RefillPlan) -> Paths:
    """Shorten ends away from walls that came too near to lines whose corners were rounded; drop dots."""
    if not plan.follows_print:
        return paths
    may_trim = [(not is_closed(path),) * 2 for path in paths]
    spacing = (plan.family.least_spacing - SLACK) * plan.line_width
    trimmed = trim_ends(paths, may_trim, spacing, plan.line_width, share=0.5)
    even = [np.rint(path / UNIT) * UNIT for path in trimmed]
    return [path for path in even if total_length([path]) >= SHORTEST * plan.line_width]
