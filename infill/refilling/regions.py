"""Where a slicer may print its infill: what its other beads leave free, as polygons.

Step 1. On a grid, take the distance d from every node to the nearest other bead of the layer.
Step 2. The slicer's infill keeps a distance d0 from them: its own paths along the walls tell it, and another distance
        from skins.
Step 3. The outlines of {d > d0} are followed; those that hold some of the slicer's infill are the region.

A layer whose beads agree with the region of the layer before it has that region.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.paths.neighbours import Around, Walls, foot

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Floats = NDArray[np.float64]

STEP = 0.15  # mm between the points on beads
INFILL_STEP = 0.2  # mm between the points on infill
NODES = 0.2  # mm between the nodes of the grid
REACH = 1.2  # mm: distances above this do not matter
ACROSS = 1.5 * NODES  # mm: an outline passes between two nodes of which neither is farther from it
ALONG_WALLS = 0.7  # mm: infill nearer than this to another bead runs along it
SHARE_BESIDE, SHARE_BESIDE_SKINS = 0.1, 0.2  # of the points beside them that may lie nearer: where infill is anchored
SKINS_FARTHER = 0.05  # mm that infill keeps further from skins, at most
LEAST_DISTANCE, USUAL_DISTANCE = 0.15, 0.36  # mm
AROUND = 0.1  # mm
SOME = 3  # one of so many points on infill is enough to know a region again
SAME_WITHIN = 0.02  # mm
OUTLINE_STEP = 0.5  # mm
NEARER = 0.005  # mm that an outline may come nearer to other beads, to have fewer points
LEAST_AREA = 0.5  # mm²
MOST_OFF = 0.12  # mm that a contour between nodes lies off
LEAST_INFILL = 4  # points on infill in an area that the slicer fills
FEWEST = 10  # points beside other beads that tell a distance
POLYGON = 3  # what Shapely calls it
STRAIGHTENED = 0.5  # mm: dents in an outline that are narrower than twice that are left out
ARM = 0.3  # mm²: an arm as large as this stays, however narrow
CROSSED = 1e-4  # mm between the points of the grid on which outlines are divided that cross themselves
MOST_NODES = 20_000_000  # of a grid: a square of 900 mm; a region beyond that is not looked for


@dataclass(frozen=True, kw_only=True)
class Region:
    """The free areas of a layer that hold infill.

    Parameters
    ----------
    polygons : tuple of Polygon
        mm, for centre lines.
    distance, skin_distance : float, mm
        How far they keep from other beads, and from skins.
    """

    polygons: tuple[Polygon, ...]
    distance: float
    skin_distance: float

    @cached_property
    def outline(self) -> Floats:
        """Points of its outlines, at most `OUTLINE_STEP` apart, (N, 2), mm."""
        import shapely

        lines = shapely.segmentize(np.array(self.polygons, dtype=object), OUTLINE_STEP)
        return np.asarray(shapely.get_coordinates(lines))

    @cached_property
    def around(self) -> Polygon | MultiPolygon:
        """The region and what is very near, ready for questions."""
        import shapely

        whole = shapely.union_all([polygon.buffer(AROUND) for polygon in self.polygons])
        shapely.prepare(whole)
        return whole


def region_of(around: Around, infill: Floats, before: Region | None = None) -> Region:
    """Return the region of a layer.

    Parameters
    ----------
    around : Around
        Points on the other beads of the layer, at most `STEP` apart.
    infill : (M, 2) float64, mm
        Points on the slicer's infill.
    before : Region, optional
        Of the layer before; returned if it fits.
    """
    if not len(around.points) or not len(infill):
        return Region(polygons=(), distance=USUAL_DISTANCE, skin_distance=USUAL_DISTANCE)
    kept = _kept_distance(around.walls.near(infill, 0, ALONG_WALLS), SHARE_BESIDE, USUAL_DISTANCE)
    kept_skins = _kept_distance(around.skins.near(infill, 0, ALONG_WALLS), SHARE_BESIDE_SKINS, kept)
    kept_skins = float(np.clip(kept_skins, kept, kept + SKINS_FARTHER))
    if before is not None and _fits(before, around, infill, kept, kept_skins):
        return before
    region = Region(polygons=(), distance=kept, skin_distance=kept_skins)
    low, high = infill.min(axis=0) - REACH, infill.max(axis=0) + REACH
    wide, deep = ((high - low) / NODES).tolist()
    if wide * deep > MOST_NODES:
        return region
    x, y = (np.arange(low[axis], high[axis] + NODES, NODES) for axis in (0, 1))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    kinds = [kind for kind in ((around.walls, kept), (around.skins, kept_skins)) if len(kind[0].points)]
    return replace(region, polygons=_holding(_opened(_free(kinds, grid)), infill))


def _kept_distance(near: Floats, share: float, usual: float) -> float:
    """Return the distance that infill keeps from other beads."""
    beside = near[np.isfinite(near) & (near > LEAST_DISTANCE)]
    if len(beside) < FEWEST:
        return usual
    return float(np.quantile(beside, share))


def _fits(region: Region, around: Around, infill: Floats, kept: float, kept_skins: float) -> bool:
    """Return whether the region of another layer is that of this one too."""
    import shapely

    if not region.polygons or abs(region.distance - kept) > SAME_WITHIN:
        return False
    if len(around.skins.points) and abs(region.skin_distance - kept_skins) > SAME_WITHIN:
        return False
    beside_walls = around.walls.near(region.outline, 0, REACH) - region.distance
    beside_skins = around.skins.near(region.outline, 0, REACH) - region.skin_distance
    beside = np.minimum(beside_walls, beside_skins)
    # At corners, an outline keeps further away.
    if beside.min() < -SAME_WITHIN / 2 or beside.max() > STRAIGHTENED:
        return False
    if abs(float(np.median(beside))) > SAME_WITHIN / 2:
        return False
    # A hole that begins in this layer may be far from every outline.
    if shapely.contains_xy(region.around, around.points[:, 0], around.points[:, 1]).any():
        return False
    some = infill[::SOME]
    inside = shapely.contains_xy(region.around, some[:, 0], some[:, 1])
    return bool(inside.mean() > 0.99)


def _free(kinds: Sequence[tuple[Walls, float]], grid: Floats) -> Polygon | MultiPolygon:
    """Return where other beads are further than their distance, within a grid of nodes, (X, Y, 2), mm."""
    import shapely
    from skimage.measure import find_contours

    nodes = grid.reshape(-1, 2)
    field = np.full(len(nodes), ACROSS)
    for walls, distance in kinds:
        np.minimum(field, walls.near(nodes, 0, distance + ACROSS) - distance, out=field)
    padded = np.pad(field.reshape(grid.shape[:2]), 1, constant_values=-ACROSS)
    contours = find_contours(padded, 0.0)  # type: ignore[no-untyped-call]
    lines = [shapely.LineString((line - 1) * NODES + grid[0, 0]) for line in contours if len(line) > 3]
    area = shapely.segmentize(shapely.build_area(shapely.GeometryCollection(lines)), NODES / 2)
    free = _simplified(shapely.transform(area, partial(_kept_off, kinds)), NEARER / 2)
    if not shapely.is_valid(free):
        free = _divided(free, kinds)
    return free


def _divided(free: Polygon | MultiPolygon, kinds: Sequence[tuple[Walls, float]]) -> Polygon | MultiPolygon:
    """Return what is free of an area whose outlines cross, as they may where points were moved.

    On a grid, lines can always be divided where they cross; of the faces between them, those are free that are as far
    from other beads as they should be.
    """
    import shapely

    lines = shapely.union_all([shapely.boundary(free)], grid_size=CROSSED)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    clear = np.ones(len(faces), dtype=bool)
    for walls, distance in kinds:
        clear &= foot(inside, walls)[1] > distance
    whole: Polygon | MultiPolygon = shapely.union_all(faces[clear])
    return whole


def _kept_off(kinds: Sequence[tuple[Walls, float]], points: Floats) -> Floats:
    """Move points near a contour to their distance from other beads: between nodes, a contour cuts across curves."""
    most = np.full(len(points), -np.inf)
    move = np.zeros(points.shape)
    for walls, distance in kinds:
        nearest, apart = foot(points, walls)
        lacks = distance - apart
        binding = lacks > most
        away = (points - nearest) / np.maximum(apart, 1e-9)[:, None]
        move[binding] = (away * lacks[:, None])[binding]
        most = np.maximum(most, lacks)
    move[np.abs(most) > MOST_OFF] = 0.0  # at the border of the grid
    moved: Floats = points + move
    return moved


def _holding(free: Polygon | MultiPolygon, infill: Floats) -> tuple[Polygon, ...]:
    """Return the parts of what is free that hold some of the infill."""
    import shapely

    parts = shapely.get_parts(free)
    parts = parts[(shapely.get_type_id(parts) == POLYGON) & (shapely.area(parts) > LEAST_AREA)]
    shapely.prepare(parts)
    return tuple(part for part in parts if shapely.contains_xy(part, infill[:, 0], infill[:, 1]).sum() >= LEAST_INFILL)


def _opened(area: Polygon | MultiPolygon) -> Polygon | MultiPolygon:
    """Return an area without the dents along skins, where lines end one beside the other; narrow arms stay."""
    import shapely

    smooth = shapely.buffer(shapely.buffer(area, -STRAIGHTENED, quad_segs=4), STRAIGHTENED, quad_segs=4)
    rest = shapely.get_parts(shapely.difference(area, smooth))
    arms = rest[shapely.area(rest) > ARM]
    whole = shapely.union_all([smooth, *shapely.buffer(arms, 1e-3)]) if len(arms) else smooth
    whole = _simplified(whole, SAME_WITHIN / 2)
    # Where the two outlines cross to and fro, they leave points a few hundredths of a millimetre apart.
    return _simplified(shapely.intersection(whole, shapely.buffer(area, NEARER / 2)), NEARER / 2)


def _simplified(area: Polygon | MultiPolygon, tolerance: float) -> Polygon | MultiPolygon:
    """Return an area with fewer points; what is valid stays so.

    Looking after its topology takes time with the square of its holes: that is left for where it is in danger.
    """
    import shapely

    simple: Polygon | MultiPolygon = shapely.simplify(area, tolerance, preserve_topology=False)
    if not shapely.is_valid(simple) and shapely.is_valid(area):
        simple = shapely.simplify(area, tolerance)
    return simple
