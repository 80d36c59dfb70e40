"""Paths in one area of a layer, at a cell that gives them the length they should have, and smooth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.paths.corners import UNIT
from infill.paths.covering import cover, total_length
from infill.paths.families.protocol import TOUCH
from infill.paths.layer_below import Ground
from infill.paths.neighbours import Walls
from infill.paths.rounding import rounded_paths
from infill.refilling.planning import Plan

if TYPE_CHECKING:
    from shapely import Polygon

Floats = NDArray[np.float64]
Paths = list[Floats]

INSIDE = 0.01  # mm that a path may leave its region
AGAIN = 3  # times that paths are rounded, until all of them stay inside
REACHED = 1.5  # mm from where a path leaves its region to the corners that made it leave
OFF = 0.08  # of the length that an area should have, which beads cannot make up for, before it gets a cell of its own
FAR_OFF = 0.25  # of it, before a column changes its cell, so that its layers no longer lie on one another
TRIES = 4
NEAR = 0.02  # of the length: near enough
SMALL = 300.0  # mm of lines, below which cells around are always tried too: the length jumps there
SPREAD, SCANNED = 0.35, 30
LEAST_LENGTH = 5.0  # mm: areas with less keep the cell of their column
NEWEST = 0.2  # how much the last layer counts in the density of a column


@dataclass(frozen=True, kw_only=True)
class Column:
    """Areas that stand on one another.

    Parameters
    ----------
    area : Polygon
        The topmost.
    cell : float, mm
    density : float
        mm of the slicer's infill per mm², over the last layers: it varies from layer to layer.
    fresh : bool
        Nothing stands below the area, so that its cell is still free.
    """

    area: Polygon
    cell: float
    density: float
    fresh: bool

    @property
    def length(self) -> float:
        """What its paths should have, mm."""
        return self.density * float(self.area.area)


def column(area: Polygon, length: float, plan: Plan, below: Sequence[Column]) -> Column:
    """Return the column that an area continues, or begins.

    Parameters
    ----------
    area : Polygon
    length : float, mm
        Of the slicer's infill in it.
    plan : Plan
    below : sequence of Column
        Of the layer below.
    """
    density = length / area.area if plan.density is None else plan.density
    best, most = None, 0.0
    for each in below:
        if each.area is area:
            best = each
            break
        if each.area.envelope.intersects(area):
            shared = each.area.intersection(area).area
            if shared > max(most, area.area / 2):
                best, most = each, shared
    if best is None:
        return Column(area=area, cell=plan.cell, density=density, fresh=True)
    return Column(area=area, cell=best.cell, density=(1 - NEWEST) * best.density + NEWEST * density, fresh=False)


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where and how paths are drawn.

    Parameters
    ----------
    plan : Plan
    walls : Walls
        The other beads of the layer, as layer 0.
    z : float, mm
    layer : int
    speed, acceleration : float
        mm/s and mm/s².
    ground : Ground, optional
        The layer below, if paths should lie on it.
    """

    plan: Plan
    walls: Walls
    z: float
    layer: int
    speed: float
    acceleration: float
    ground: Ground | None = None


@dataclass(frozen=True, kw_only=True)
class Fitted:
    """Paths in an area.

    Parameters
    ----------
    paths : list of (N, 2) float64, mm
    radii : (C,) float64, mm
        Of the arcs; 0 or infinite where there is none.
    cell : float, mm
    """

    paths: Paths
    radii: Floats
    cell: float

    @property
    def length(self) -> float:
        """Mm."""
        return total_length(self.paths)


def fitted(stack: Column, place: Place) -> Fitted:
    """Return paths in the area of a column, at its cell, or at one that gives them the length they should have.

    The length jumps with the cell in small areas: the nearest of a few is taken. A cell that was asked for stays.
    """
    wanted = stack.length
    best = _covered(stack.area, stack.cell, place)
    # What varies with the height has one cell everywhere, or its layers would not fit one another.
    if place.plan.fixed or not place.plan.family.prismatic or wanted <= LEAST_LENGTH:
        return best
    error = best.length / wanted - 1
    if abs(error) <= (OFF if stack.fresh else FAR_OFF):
        return best
    around, cell = _around(stack, place.plan) if wanted < SMALL or stack.fresh else np.empty(0), stack.cell
    for tried in range(TRIES + len(around)):
        if tried >= TRIES and wanted >= SMALL and abs(best.length / wanted - 1) <= OFF:
            break
        cell = cell * float(np.clip(1 + error, 0.6, 1.6)) if tried < TRIES else float(around[tried - TRIES])
        cell = max(cell, TOUCH * place.plan.line_width)
        other = _covered(stack.area, cell, place)
        error = other.length / wanted - 1
        if abs(error) < abs(best.length / wanted - 1):
            best = other
        if abs(error) < NEAR:
            break
    return best


def _around(stack: Column, plan: Plan) -> Floats:
    """Return cells around that of a column, mm; of one whose cell is free, those around that of the plan first."""
    steps = np.exp(np.linspace(-SPREAD, SPREAD, SCANNED))
    nearest = steps[np.argsort(np.abs(np.log(steps)), kind="stable")]
    if not stack.fresh or stack.cell == plan.cell:
        return stack.cell * nearest
    return np.concatenate([plan.cell * nearest, stack.cell * nearest])


def _covered(area: Polygon, cell: float, place: Place) -> Fitted:
    """Return rounded paths in an area; where one would leave it, its corners stay."""
    import shapely

    plan = place.plan
    strands = cover(
        area,
        plan.family,
        cell=cell,
        line_width=plan.line_width,
        z=place.z,
        layer=place.layer,
        radius=plan.radius,
        ground=place.ground,
    )
    strands = [path for path in strands if len(path) > 1]
    if not strands:
        return Fitted(paths=[], radii=np.empty(0), cell=cell)
    near = shapely.buffer(area, INSIDE)
    shapely.prepare(near)
    corners = shapely.points(np.concatenate(strands))
    hard = np.zeros(len(corners), dtype=bool)
    for _ in range(AGAIN):
        done, radii = rounded_paths(
            strands,
            walls=place.walls,
            acceleration=place.acceleration,
            speed=place.speed,
            rounding=plan.rounding_of(cell),
            line_width=plan.line_width,
            hard=hard,
            wide=plan.family.wide,
        )
        lines = np.array([shapely.linestrings(path) for path in done])
        inside = shapely.covers(near, lines)
        if inside.all():
            break
        hard |= shapely.dwithin(corners, shapely.union_all(shapely.difference(lines[~inside], near)), REACHED)
    plain = [np.rint(path / UNIT) * UNIT for path in strands]
    paths = [one if fits else other for one, other, fits in zip(done, plain, inside.tolist(), strict=True)]
    return Fitted(paths=paths, radii=radii, cell=cell)
