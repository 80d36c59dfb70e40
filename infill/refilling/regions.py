"""Regions of a slicer's infill: the area that its other beads leave free, as polygons.

Step 1. On a grid, take the distance d from every node to the nearest other bead of the layer.
Step 2. Measure the distance d0 that the slicer's infill keeps from walls, by those of its lines that run along them,
        and another distance from skins. Lines that end at a wall reach into it: where none runs along, d0 is the usual
        one or more.
Step 3. Trace the outlines of {d > d0}; the areas that hold some of the slicer's infill are the region.

A layer whose beads agree with the region of the layer before it has that region.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.paths.contact import Samples
from infill.paths.neighbours import BeadIndex, index_beads, project_to_beads

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon


NO_REGION = "no room found between walls"  # reason for which a section keeps its paths
BEAD_STEP = 0.15  # mm between the points on beads
INFILL_STEP = 0.2  # mm between the points on infill
NODES = 0.2  # mm between the nodes of the grid
REACH = 1.2  # mm: distances above this do not matter
ACROSS = 1.5 * NODES  # mm: largest distance of an outline from the two nodes that it passes between
ALONG_WALLS = 0.7  # mm: infill nearer than this to another bead runs along it
SHARE_BESIDE, SHARE_BESIDE_SKINS = 0.1, 0.2  # of the points beside them that may lie nearer: anchors of the infill
ALONG_COSINE = 0.26  # largest one between a line and the way to the nearest bead if it runs along that: 15° of turn
ALIKE = 0.03  # mm: distances of lines along walls differ less, and those of lines that end there more
SHARE_ALONG = 0.25  # share of the points near walls that run along them, if the slicer joins its lines there
USUAL_WIDTHS = 0.85  # line widths from walls, where no line runs along them
SKINS_FARTHER = 0.05  # mm: largest difference between the distances from skins and from walls
LEAST_DISTANCE = 0.15  # mm
AROUND = 0.1  # mm
CHECK_STRIDE = 3  # stride of the points on infill that are tested to recognise a region
SAME_WITHIN = 0.02  # mm
OUTLINE_STEP = 0.5  # mm
NEARER = 0.005  # mm that an outline may come nearer to other beads, to have fewer points
LEAST_AREA = 0.5  # mm²
MOST_OFF = 0.12  # mm: largest error of a contour between nodes
LEAST_INFILL = 4  # points on infill in an area that the slicer fills
FEWEST = 10  # points beside other beads that tell a distance
POLYGON = 3  # type number in Shapely
DENT_RADIUS = 0.5  # mm: dents in an outline that are narrower than twice this are filled
ARM = 0.3  # mm²: an arm as large as this stays, however narrow
CROSSING_GRID = 1e-4  # mm between the points of the grid on which outlines are divided that cross themselves
BORDER = 1.5 * NODES  # mm: an area that comes as near to a side of its grid may go on beyond it
GROWTH = 0.5  # share of its size by which a grid grows then
MOST_NODES = 20_000_000  # of a grid: a square of 900 mm; larger regions are not searched


@dataclass(frozen=True, kw_only=True)
class LayerBeads:
    """Points on the other beads of a layer.

    Parameters
    ----------
    points : (N, 2) float64, mm
    skin : (N,) bool
        True on solid infill.
    half : (N, 2) float64, mm, optional
        From each, the middle of a piece of a bead, to the end of its piece; without it, beads are points.
    wall : (N,) bool, optional
        True on perimeters; without it, all beads count as such.
    """

    points: Floats
    skin: NDArray[np.bool_]
    half: Floats | None = None
    wall: NDArray[np.bool_] | None = None

    @cached_property
    def enclosing(self) -> Floats:
        """Points on beads that enclose infill, (K, 2), mm: no skirt, support or tower."""
        return self.points if self.wall is None else self.points[self.wall | self.skin]

    @cached_property
    def all(self) -> BeadIndex:
        """All of them, indexed as layer 0."""
        return index_beads(self.points, half=self.half)

    @cached_property
    def walls(self) -> BeadIndex:
        """Index of the beads that do not belong to skins."""
        return index_beads(self.points[~self.skin], half=None if self.half is None else self.half[~self.skin])

    @cached_property
    def skins(self) -> BeadIndex:
        """The skins."""
        return index_beads(self.points[self.skin], half=None if self.half is None else self.half[self.skin])


@dataclass(frozen=True, kw_only=True)
class FreeAreas:
    """The free areas of a layer that hold infill.

    Parameters
    ----------
    polygons : tuple of Polygon
        mm, for centre lines.
    distance, skin_distance : float, mm
        Their distances from other beads, and from skins.
    """

    polygons: tuple[Polygon, ...]
    distance: float
    skin_distance: float

    def keep_apart(self, spacing: float) -> FreeAreas:
        """Cut the smaller one of two areas that are nearer to each other than lines may be, mm; return the areas."""
        import shapely

        kept: list[Polygon] = []
        for polygon in sorted(self.polygons, key=lambda polygon: -polygon.area):
            near = [other for other in kept if shapely.dwithin(polygon, other, spacing)]
            if not near:
                kept.append(polygon)
                continue
            kept += _large_parts(shapely.difference(polygon, shapely.buffer(shapely.union_all(near), spacing)))
        unchanged = len(kept) == len(self.polygons) and {id(one) for one in kept} == {id(one) for one in self.polygons}
        return self if unchanged else replace(self, polygons=tuple(kept))

    def keep_off(self, lines: Sequence[Floats], spacing: float, own: Collection[int] = ()) -> FreeAreas:
        """Cut areas along lines (N, 2), mm, that stay in the layer, except the areas `own`; return the areas."""
        import shapely

        taken = shapely.union_all([shapely.linestrings(line) for line in lines])
        polygons: list[Polygon] = []
        for number, polygon in enumerate(self.polygons):
            if number in own or not shapely.dwithin(polygon, taken, spacing):
                polygons.append(polygon)
            else:
                polygons += _large_parts(shapely.difference(polygon, shapely.buffer(taken, spacing)))
        unchanged = [id(polygon) for polygon in polygons] == [id(polygon) for polygon in self.polygons]
        return self if unchanged else replace(self, polygons=tuple(polygons))

    @cached_property
    def outline(self) -> Floats:
        """Points of its outlines, at most `OUTLINE_STEP` apart, (N, 2), mm."""
        import shapely

        lines = shapely.segmentize(np.array(self.polygons, dtype=object), OUTLINE_STEP)
        return np.asarray(shapely.get_coordinates(lines))

    @cached_property
    def grown_areas(self) -> NDArray[np.object_]:
        """Each of its areas with a narrow margin, prepared for queries, (A,)."""
        import shapely

        grown: NDArray[np.object_] = shapely.buffer(np.array(self.polygons, dtype=object), AROUND)
        shapely.prepare(grown)
        return grown

    @cached_property
    def around(self) -> Polygon | MultiPolygon:
        """The region with a narrow margin, prepared for queries."""
        import shapely

        grown = shapely.union_all([polygon.buffer(AROUND) for polygon in self.polygons])
        shapely.prepare(grown)
        return grown


def find_region(
    around: LayerBeads, infill: Samples, before: FreeAreas | None = None, *, line_width: float
) -> FreeAreas:
    """Find the region of a layer.

    Parameters
    ----------
    around : LayerBeads
        Points on the other beads of the layer, at most `BEAD_STEP` apart.
    infill : Samples
        Points on the slicer's infill.
    before : FreeAreas, optional
        Of the previous layer; returned if it fits.
    line_width : float, mm
    """
    points = infill.points
    if not len(around.points) or not len(points):
        usual = USUAL_WIDTHS * line_width
        return FreeAreas(polygons=(), distance=usual, skin_distance=usual)
    wall_distance = _wall_distance(around.walls, infill, line_width)
    skin_distance = _kept_distance(around.skins.distances(points, 0, ALONG_WALLS), SHARE_BESIDE_SKINS, wall_distance)
    skin_distance = float(np.clip(skin_distance, wall_distance, wall_distance + SKINS_FARTHER))
    if before is not None and _is_same_region(before, around, points, wall_distance, skin_distance):
        return before
    kinds = [kind for kind in ((around.walls, wall_distance), (around.skins, skin_distance)) if len(kind[0].points)]
    polygons = _enclosed_areas(kinds, points, around.enclosing)
    return FreeAreas(polygons=polygons, distance=wall_distance, skin_distance=skin_distance)


def _enclosed_areas(kinds: Sequence[tuple[BeadIndex, float]], infill: Floats, walls: Floats) -> tuple[Polygon, ...]:
    """Find the areas that hold infill: in the box around it, or in a larger one while they reach its sides.

    Sparse infill may end far from a wall, as a slicer's lightning does. Areas that no walls enclose, points (K, 2), mm,
    end beside the infill.
    """
    low, high = infill.min(axis=0) - REACH, infill.max(axis=0) + REACH
    areas_beside = areas = _areas_in_box(kinds, infill, low, high)
    if not areas or not len(walls):
        return areas_beside
    lowest, highest = np.minimum(low, walls.min(axis=0) - REACH), np.maximum(high, walls.max(axis=0) + REACH)
    while areas:
        bounds = np.array([area.bounds for area in areas])
        is_open = np.stack([bounds[:, :2].min(axis=0) < low + BORDER, bounds[:, 2:].max(axis=0) > high - BORDER])
        if not is_open.any():
            return areas
        grown = np.maximum(GROWTH * (high - low), REACH)
        new_low = np.where(is_open[0], np.maximum(low - grown, lowest), low)
        new_high = np.where(is_open[1], np.minimum(high + grown, highest), high)
        if (new_low == low).all() and (new_high == high).all():
            break
        low, high = new_low, new_high
        areas = _areas_in_box(kinds, infill, low, high)
    return areas_beside


def _areas_in_box(
    kinds: Sequence[tuple[BeadIndex, float]], infill: Floats, low: Floats, high: Floats
) -> tuple[Polygon, ...]:
    """Find the areas in a box, (2,) and (2,), mm, that hold infill; none if it is too large."""
    wide, deep = ((high - low) / NODES).tolist()
    if wide * deep > MOST_NODES:
        return ()
    x, y = (np.arange(low[axis], high[axis] + NODES, NODES) for axis in (0, 1))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    return _parts_with_infill(_fill_dents(_free_area(kinds, grid)), infill)


def _wall_distance(walls: BeadIndex, infill: Samples, line_width: float) -> float:
    """Estimate the distance that infill keeps from walls, mm: that of lines along them, all of which are as far away.

    A line that ends at a wall reaches into it by up to half a width, and one that happens to run beside it may be at
    any distance. If there are only such lines, the distance is at least the usual one.
    """
    usual = USUAL_WIDTHS * line_width
    distance = _kept_distance(walls.distances(infill.points, 0, ALONG_WALLS), SHARE_BESIDE, usual)
    places, apart = project_to_beads(infill.points, walls, ALONG_WALLS)
    close = np.flatnonzero(np.isfinite(apart) & (apart > LEAST_DISTANCE))
    across, half = infill.points[close] - places[close], infill.half[close]
    lengths = np.hypot(*across.T) * np.hypot(*half.T)
    is_along = np.abs((across * half).sum(axis=1)) <= ALONG_COSINE * lengths
    if (is_along & (np.abs(apart[close] - distance) < ALIKE)).sum() < SHARE_ALONG * len(close):
        return max(distance, usual)
    return distance


def _kept_distance(distances: Floats, share: float, usual: float) -> float:
    """Estimate the distance that infill keeps from other beads, mm; `usual` if it has few points beside them."""
    close_distances = distances[np.isfinite(distances) & (distances > LEAST_DISTANCE)]
    if len(close_distances) < FEWEST:
        return usual
    return float(np.quantile(close_distances, share))


def _is_same_region(
    region: FreeAreas, around: LayerBeads, infill: Floats, wall_distance: float, skin_distance: float
) -> bool:
    """Tell whether the region of the previous layer is that of this one too."""
    import shapely

    if not region.polygons or abs(region.distance - wall_distance) > SAME_WITHIN:
        return False
    if len(around.skins.points) and abs(region.skin_distance - skin_distance) > SAME_WITHIN:
        return False
    beside_walls = around.walls.distances(region.outline, 0, REACH) - region.distance
    beside_skins = around.skins.distances(region.outline, 0, REACH) - region.skin_distance
    excess = np.minimum(beside_walls, beside_skins)
    # At corners, an outline keeps further away.
    if excess.min() < -SAME_WITHIN / 2 or excess.max() > DENT_RADIUS:
        return False
    if abs(float(np.median(excess))) > SAME_WITHIN / 2:
        return False
    # A hole that begins in this layer may be far from every outline.
    if shapely.contains_xy(region.around, around.points[:, 0], around.points[:, 1]).any():
        return False
    checked_points = infill[::CHECK_STRIDE]
    inside = shapely.contains_xy(region.around, checked_points[:, 0], checked_points[:, 1])
    return bool(inside.mean() > 0.99)


def _free_area(kinds: Sequence[tuple[BeadIndex, float]], grid: Floats) -> Polygon | MultiPolygon:
    """Find the area farther from other beads than their distance, within a grid of nodes, (X, Y, 2), mm."""
    import shapely
    from skimage.measure import find_contours

    nodes = grid.reshape(-1, 2)
    field = np.full(len(nodes), ACROSS)
    for walls, distance in kinds:
        np.minimum(field, walls.distances(nodes, 0, distance + ACROSS) - distance, out=field)
    padded = np.pad(field.reshape(grid.shape[:2]), 1, constant_values=-ACROSS)
    contours = find_contours(padded, 0.0)  # type: ignore[no-untyped-call]
    lines = [shapely.LineString((line - 1) * NODES + grid[0, 0]) for line in contours if len(line) > 3]
    area = shapely.segmentize(shapely.build_area(shapely.GeometryCollection(lines)), NODES / 2)
    free = _simplify(shapely.transform(area, partial(_move_off_beads, kinds)), NEARER / 2)
    if not shapely.is_valid(free):
        free = _repair_crossings(free, kinds)
    return free


def _repair_crossings(free: Polygon | MultiPolygon, kinds: Sequence[tuple[BeadIndex, float]]) -> Polygon | MultiPolygon:
    """Repair a free area whose outlines cross, as they may after points were moved.

    On a grid, lines can always be divided where they cross; a face between them is free if it keeps its distance from
    other beads.
    """
    import shapely

    lines = shapely.union_all([shapely.boundary(free)], grid_size=CROSSING_GRID)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    clear = np.ones(len(faces), dtype=bool)
    for walls, distance in kinds:
        clear &= project_to_beads(inside, walls, distance)[1] > distance
    union: Polygon | MultiPolygon = shapely.union_all(faces[clear])
    return union


def _move_off_beads(kinds: Sequence[tuple[BeadIndex, float]], points: Floats) -> Floats:
    """Move points near a contour to their distance from other beads: between nodes, a contour cuts across curves."""
    largest_lack = np.full(len(points), -np.inf)
    move = np.zeros(points.shape)
    for walls, distance in kinds:
        nearest, apart = project_to_beads(points, walls, distance + MOST_OFF)
        lacks = distance - apart
        binding = lacks > largest_lack
        direction = (points[binding] - nearest[binding]) / np.maximum(apart[binding], 1e-9)[:, None]
        move[binding] = direction * lacks[binding, None]
        largest_lack = np.maximum(largest_lack, lacks)
    move[np.abs(largest_lack) > MOST_OFF] = 0.0  # at the border of the grid
    moved: Floats = points + move
    return moved


def _parts_with_infill(free: Polygon | MultiPolygon, infill: Floats) -> tuple[Polygon, ...]:
    """Keep the parts of a free area that hold some of the infill."""
    import shapely

    parts = _large_parts(free)
    shapely.prepare(parts)
    return tuple(part for part in parts if shapely.contains_xy(part, infill[:, 0], infill[:, 1]).sum() >= LEAST_INFILL)


def _large_parts(area: Polygon | MultiPolygon) -> list[Polygon]:
    """Return the polygons of an area that are large enough for a line."""
    import shapely

    parts = shapely.get_parts(area)
    large: list[Polygon] = parts[(shapely.get_type_id(parts) == POLYGON) & (shapely.area(parts) > LEAST_AREA)].tolist()
    return large


def _fill_dents(area: Polygon | MultiPolygon) -> Polygon | MultiPolygon:
    """Remove the dents along skins, where lines end side by side; narrow arms stay."""
    import shapely

    smooth = shapely.buffer(shapely.buffer(area, -DENT_RADIUS, quad_segs=4), DENT_RADIUS, quad_segs=4)
    rest = shapely.get_parts(shapely.difference(area, smooth))
    arms = rest[shapely.area(rest) > ARM]
    union = shapely.union_all([smooth, *shapely.buffer(arms, 1e-3)]) if len(arms) else smooth
    union = _simplify(union, SAME_WITHIN / 2)
    # Where the two outlines cross repeatedly, they leave points a few hundredths of a millimetre apart.
    return _simplify(shapely.intersection(union, shapely.buffer(area, NEARER / 2)), NEARER / 2)


def _simplify(area: Polygon | MultiPolygon, tolerance: float) -> Polygon | MultiPolygon:
    """Reduce the points of an area; a valid area stays valid.

    Preserving its topology takes time with the square of its holes, so it is done only where necessary.
    """
    import shapely

    simple: Polygon | MultiPolygon = shapely.simplify(area, tolerance, preserve_topology=False)
    if not shapely.is_valid(simple) and shapely.is_valid(area):
        simple = shapely.simplify(area, tolerance)
    return simple
