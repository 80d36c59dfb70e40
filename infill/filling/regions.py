"""Where a slicer may print its infill: what its other beads leave free, as polygons.

Step 1. On a grid, take the distance d from every node to the nearest other bead of the layer.
Step 2. The slicer's infill keeps a distance d0 from them: its own paths along the walls tell it.
Step 3. The outlines of {d > d0} are followed; those that hold some of the slicer's infill are the region.

A layer whose beads agree with the region of the layer before it has that region.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.filling.surroundings import Walls

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Floats = NDArray[np.float64]

STEP = 0.15  # mm between the points on beads
INFILL_STEP = 0.2  # mm between the points on infill
NODES = 0.2  # mm between the nodes of the grid
REACH = 1.2  # mm: distances above this do not matter
ALONG_WALLS = 0.7  # mm: infill nearer than this to another bead runs along it
SHARE_BESIDE = 0.1  # of the points beside walls that may lie nearer than d0: where infill is anchored in skins
LEAST_DISTANCE, USUAL_DISTANCE = 0.15, 0.36  # mm
AROUND = 0.1  # mm
SOME = 3  # one of so many points on infill is enough to know a region again
SAME_WITHIN = 0.02  # mm
LEAST_AREA = 0.5  # mm²
STRAIGHTENED = 0.5  # mm: narrower dents in an outline, such as between the ends of lines, are left out
ARM = 0.3  # mm²: an arm as large as this stays, however narrow
MOST_NODES = 20_000_000  # of a grid: a square of 900 mm; a region beyond that is not looked for


@dataclass(frozen=True, kw_only=True)
class Region:
    """The free areas of a layer that hold infill.

    Parameters
    ----------
    polygons : tuple of Polygon
        mm, for centre lines.
    distance : float, mm
        How far they keep from other beads.
    """

    polygons: tuple[Polygon, ...]
    distance: float

    @cached_property
    def outline(self) -> Floats:
        """The points of its outlines, (N, 2), mm."""
        import shapely

        return np.asarray(shapely.get_coordinates(np.array(self.polygons, dtype=object)))

    @cached_property
    def around(self) -> Polygon | MultiPolygon:
        """The region and what is very near, ready for questions."""
        import shapely

        whole = shapely.union_all([polygon.buffer(AROUND) for polygon in self.polygons])
        shapely.prepare(whole)
        return whole


def region_of(walls: Walls, infill: Floats, before: Region | None = None) -> Region:
    """Return the region of a layer.

    Parameters
    ----------
    walls : Walls
        The other beads of the layer, points at most `STEP` apart, as layer 0.
    infill : (M, 2) float64, mm
        Points on the slicer's infill.
    before : Region, optional
        Of the layer before; returned if it fits.
    """
    if not len(walls.points) or not len(infill):
        return Region(polygons=(), distance=USUAL_DISTANCE)
    distance = _kept_distance(walls.near(infill, 0, ALONG_WALLS))
    if before is not None and _fits(before, walls, infill, distance):
        return before
    low, high = infill.min(axis=0) - REACH, infill.max(axis=0) + REACH
    wide, deep = ((high - low) / NODES).tolist()
    if wide * deep > MOST_NODES:
        return Region(polygons=(), distance=distance)
    x, y = (np.arange(low[axis], high[axis] + NODES, NODES) for axis in (0, 1))
    nodes = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    field = np.minimum(walls.near(nodes.reshape(-1, 2), 0, REACH), REACH).reshape(nodes.shape[:2])
    # Points stand half a step to either side of the nearest place on their bead.
    field = np.sqrt(np.maximum(field**2 - (STEP / 4) ** 2, 0.0))
    return Region(polygons=_outlines(field, x[0], y[0], distance, infill), distance=distance)


def _kept_distance(near: Floats) -> float:
    """Return the distance that infill keeps from other beads."""
    beside = near[np.isfinite(near) & (near > LEAST_DISTANCE)]
    if len(beside) < 10:
        return USUAL_DISTANCE
    return float(np.quantile(beside, SHARE_BESIDE))


def _fits(region: Region, walls: Walls, infill: Floats, distance: float) -> bool:
    """Return whether the region of another layer is that of this one too."""
    import shapely

    if not region.polygons or abs(region.distance - distance) > SAME_WITHIN:
        return False
    near = walls.near(region.outline, 0, REACH)
    # At corners, an outline keeps further away.
    if near.min() < region.distance - SAME_WITHIN / 2 or near.max() > region.distance + STRAIGHTENED:
        return False
    if abs(float(np.median(near)) - region.distance) > SAME_WITHIN / 2:
        return False
    # A hole that begins in this layer may be far from every outline.
    if shapely.contains_xy(region.around, walls.points[:, 0], walls.points[:, 1]).any():
        return False
    some = infill[::SOME]
    inside = shapely.contains_xy(region.around, some[:, 0], some[:, 1])
    return bool(inside.mean() > 0.99)


def _outlines(field: Floats, x0: float, y0: float, distance: float, infill: Floats) -> tuple[Polygon, ...]:
    """Return the polygons in which the field is above `distance` and which hold some of the infill."""
    import shapely
    from skimage.measure import find_contours

    padded = np.pad(field, 1, constant_values=0.0)
    contours = find_contours(padded, distance)  # type: ignore[no-untyped-call]
    rings = [shapely.linearrings((line - 1) * NODES + (x0, y0)) for line in contours if len(line) > 3]
    if not rings:
        return ()
    free = shapely.build_area(shapely.GeometryCollection([shapely.LineString(ring.coords) for ring in rings]))
    parts = shapely.get_parts(free)
    parts = parts[shapely.area(parts) > LEAST_AREA]
    shapely.prepare(parts)
    held = [bool(shapely.contains_xy(part, infill[:, 0], infill[:, 1]).any()) for part in parts]
    kept = parts[held]
    return tuple(area for part in kept for area in _straightened(part))


def _straightened(area: Polygon) -> list[Polygon]:
    """Return an area without the dents along skins, where lines end one beside the other; narrow arms stay."""
    import shapely

    smooth = shapely.buffer(shapely.buffer(area, -STRAIGHTENED, quad_segs=4), STRAIGHTENED, quad_segs=4)
    rest = shapely.get_parts(shapely.difference(area, smooth))
    arms = rest[shapely.area(rest) > ARM]
    whole = shapely.union_all([smooth, *shapely.buffer(arms, 1e-3)]) if len(arms) else smooth
    whole = shapely.intersection(shapely.simplify(whole, SAME_WITHIN / 2), shapely.buffer(area, SAME_WITHIN / 4))
    parts = shapely.get_parts(whole)
    kept = parts[(shapely.get_type_id(parts) == 3) & (shapely.area(parts) > LEAST_AREA)]
    return list(kept) or [shapely.simplify(area, SAME_WITHIN / 4)]
