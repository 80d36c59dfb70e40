"""The voids between lines that are the same at every height: polygons; those of one field are far from each other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.drawings.tiled import Tiled, is_drawn_once
from infill.errors import GeometryError
from infill.interior.interior import BAND, Interior
from infill.lattices.fillets import find_polygon_corners, sharpest_angle
from infill.lattices.line_sample import WIDER, LineSample, centred_square, faces_between, follows_outline, line_segments
from infill.lattices.voids import Layout, VoidFields
from infill.paths.ties import Ties, has_islands, tie_islands
from infill.plain_numbers import plain_argument
from patterns.protocol import Pattern, draw_lines, with_cell

LOW = 0.1  # cells: where no cell of a column lies deeper, rounding decides whether one lies inside
SIMPLER = 0.05  # cells
ACROSS_TIE = 3.0  # cells of the grid: a narrower bar in the middle of one void is smoothed away
MITRE = 5.0  # largest move of a sharp corner, over that of its sides

APART = 3.0  # cells of the grid: voids that are nearer to each other get separate fields
THINNER, WIDER_LINES = 0.8, 1.5  # range of line widths for which fields suffice, over the width they were made for
ROUND = 16  # segments in a quarter of a circle


@dataclass(frozen=True, kw_only=True)
class Prismatic:
    """Lines of a pattern that are the same at every height.

    Parameters
    ----------
    pattern : Pattern
        Its cell does not matter.
    anchor : (3,) float64
        The point of the part that is (0, 0) of the pattern, mm; its height does not matter.
    share : float
        Width of the lines over the cell, roughly: it places lines that follow the part.
    ties : bool
        True to tie islands of lines, which neither floor nor roof holds, to the nearest wall or line.
    """

    pattern: Pattern
    anchor: NDArray[np.float64]
    share: float
    ties: bool = False

    @cached_property
    def sample(self) -> LineSample:
        """A sample of such lines far from any skin; of a single drawing, as if it were repeated."""
        pattern = self.pattern
        return LineSample(pattern=replace(pattern, repeat=True) if isinstance(pattern, Tiled) else pattern)

    def leaves_islands(self, bounds: NDArray[np.floating], *, cell: float, width: float, wall: float) -> bool:
        """Tell whether islands that need ties are likely in a part with these bounds, (2, 3) mm."""
        if not self.ties:
            return False
        (x0, y0), (x1, y1) = np.asarray(bounds, dtype=np.float64)[:, :2] - self.anchor[:2]
        room = shapely.box(x0 + wall, y0 + wall, x1 - wall, y1 - wall)
        lines = shapely.intersection(draw_lines(with_cell(self.pattern, cell), room), room.buffer(width))
        return has_islands(lines, room, width=width, walled=wall > 0)

    def widths(self, density: float) -> float:
        """Return the width of lines, in cells, that gives a density far from any skin, as measured on a sample."""
        return self.sample.widths(density)

    def draw(self, layout: Layout, known: VoidFields | None = None) -> VoidFields:
        """Draw a field for each colour of the faces between lines; known faces do for lines of a similar width."""
        from infill.kernels.cells import from_plane

        ratio, _ = layout.ratio
        reach = float(ratio.max()) * layout.width / 2 / layout.space.size + 2 * BAND
        thinnest = float(ratio.min()) * layout.width
        faces = layout.basis_of(known)
        if not (isinstance(faces, _Faces) and reach <= faces.reach and thinnest >= THINNER * faces.width):
            faces = self._make_faces(layout.space, layout.cell, thinnest, WIDER_LINES * reach)
        return VoidFields(
            layout=layout,
            kernels=tuple((from_plane, (plane, layout.half, *layout.ratio)) for plane in faces.colours),
            find_sharpest=lambda: faces.sharpest,
            basis=faces,
            ties=faces.ties,
        )

    def _room(self, space: Interior, cell: float) -> shapely.Geometry:
        """Return the region to draw in for lines that follow it; lines half a cell inside leave room at the wall."""
        room = shapely.transform(silhouette(space), lambda points: points - self.anchor[:2])
        return shapely.buffer(room, (self.share - 1) / 2 * cell, quad_segs=ROUND)

    def _miss_error(self, space: Interior, cell: float) -> GeometryError:
        """Return the error that a single drawing lies beside the part."""
        everywhere = centred_square(WIDER * float(np.abs(np.asarray(space.part.bounds) - [*self.anchor]).max() + cell))
        drawn = shapely.bounds(draw_lines(with_cell(self.pattern, cell), everywhere)) + np.tile(self.anchor[:2], 2)
        spans = [
            ", ".join(
                f"{axis} {plain_argument(low, 4)} to {plain_argument(high, 4)}"
                for axis, low, high in zip("xy", box[:2], box[2:], strict=True)
            )
            for box in (drawn.tolist(), np.asarray(space.part.bounds)[:, :2].ravel().tolist())
        ]
        return GeometryError.about(
            "phase", f"puts the drawing at {spans[0]} mm, and the part spans {spans[1]} mm; give another"
        )

    def _make_faces(self, space: Interior, cell: float, width: float, reach: float) -> _Faces:
        """Draw the lines in and around a part, tie their islands, and divide the plane into faces between them."""
        lower, upper = (np.array([side.min() - 1, side.max() + 1]) for side in np.nonzero(space.column_depths > -BAND))
        low = space.origin[:2] + np.array([lower[0], upper[0]]) * space.size - self.anchor[:2]
        high = space.origin[:2] + np.array([lower[1], upper[1]]) * space.size - self.anchor[:2]
        box = shapely.box(*low, *high)
        region = box.buffer(cell, join_style="mitre")
        if follows_outline(self.pattern):
            room = self._room(space, cell)
        else:
            room = centred_square(WIDER * float(np.linalg.norm(np.abs([low, high]).max(axis=0))))
        lines = shapely.intersection(draw_lines(with_cell(self.pattern, cell), room), region)
        if is_drawn_once(self.pattern) and not shapely.intersects(lines, box):
            raise self._miss_error(space, cell)
        ties = Ties.none()
        if self.ties:
            ties = tie_islands(lines, self._room_of_islands(space), width=width, walled=space.opening is not None)
            ties = ties.widen(width, ACROSS_TIE * space.size)
            lines = shapely.union_all([lines, *shapely.linestrings(ties.drawn)])
        polygons = faces_between(lines, region, cell=cell)
        polygons = polygons[shapely.intersects(polygons, box)]
        nx, ny, _ = space.shape
        x, y = (space.origin[i] + space.size * np.arange(n) - self.anchor[i] for i, n in enumerate((nx, ny)))
        start = space.origin[:2] - self.anchor[:2]
        distance = _distance_to_lines(shapely.get_parts(lines), start, space.size, reach, (nx, ny))
        planes = []
        for colour in _colour_apart(polygons, max(0.0, APART * space.size - width)):
            union = shapely.union_all(polygons[colour])
            shapely.prepare(union)
            inside = shapely.contains_xy(union, x[:, None], y[None, :])
            to_border = _distance_to_lines(
                shapely.get_parts(shapely.boundary(polygons[colour])), start, space.size, reach, (nx, ny)
            )
            planes.append(np.where(inside, distance, -to_border))
        corners, angles = find_polygon_corners(polygons)
        at = np.round((corners - start) / space.size).astype(np.int64)
        # There is no room at the rim of the grid.
        with_room = space.column_depths[tuple(np.clip(at, 0, (nx - 1, ny - 1)).T)] > 0
        return _Faces(
            colours=tuple(planes),
            sharpest=sharpest_angle(angles[with_room]),
            reach=reach,
            width=width,
            ties=ties.shift(self.anchor[:2]),
        )

    def _room_of_islands(self, space: Interior) -> shapely.Geometry:
        """Return the region where lines hold nothing but each other: without walls above or below it."""
        room = silhouette(space) if space.opening is None else open_columns(space)
        return shapely.transform(room, lambda points: points - self.anchor[:2])


@dataclass(frozen=True, kw_only=True, eq=False)
class _Faces:
    """The faces between lines, in colours: depth of the points of a layer in them, in cells of the grid.

    Parameters
    ----------
    colours : tuple of (nx, ny) float32
    sharpest : float
        Degrees, at corners: few are sharper.
    reach : float
        Cells; depths are cut off here.
    width : float
        Of the lines for which the faces were made, mm: between thinner lines, fields might touch.
    ties : Ties
        Of islands, in the part.
    """

    colours: tuple[NDArray[np.float32], ...]
    sharpest: float
    reach: float
    width: float
    ties: Ties


def _distance_to_lines(
    lines: NDArray[np.object_], start: NDArray[np.float64], size: float, reach: float, shape: tuple[int, int]
) -> NDArray[np.float32]:
    """Return the distance of the points of a layer from lines, in cells, cut off at `reach`."""
    from infill.kernels.cells import lower_to_segments

    squared = np.full(shape, np.float32(reach**2))
    lower_to_segments(line_segments(lines, start, size), reach, squared)
    return np.sqrt(squared)


def _colour_apart(polygons: NDArray[np.object_], apart: float) -> list[NDArray[np.intp]]:
    """Colour polygons; return the numbers of each colour. Polygons of one colour are further apart than this, mm."""
    tree = shapely.STRtree(polygons)
    polygon, neighbour = tree.query(polygons, predicate="dwithin", distance=apart)
    beside: list[list[int]] = [[] for _ in polygons]
    for a, b in zip(polygon.tolist(), neighbour.tolist(), strict=True):
        if a != b:
            beside[a].append(b)
    colours = np.full(len(polygons), -1)
    for number in sorted(range(len(polygons)), key=lambda k: -len(beside[k])):
        taken = {int(colours[adjacent]) for adjacent in beside[number]}
        colours[number] = next(colour for colour in range(len(polygons)) if colour not in taken)
    return [np.flatnonzero(colours == colour) for colour in range(int(colours.max(initial=-1)) + 1)]


def silhouette(space: Interior) -> shapely.Geometry:
    """Draw the polygons, mm, of the columns with a cell inside the walls, smooth between the cells.

    Where voids reach through the walls, the walls still count.
    """
    return _outline_columns(space, space.column_depths - np.float32(space.through))


def open_columns(space: Interior) -> shapely.Geometry:
    """Draw the polygons, mm, of the columns that are inside the walls at every height between the open sides."""
    shallowest = np.minimum.reduce(
        [
            slab[:, :, inside].min(axis=2)
            for first, slab in space.layers.read_slabs()
            if (inside := space.layer_shares[first : first + slab.shape[2]] > 0).any()
        ]
    )
    return _outline_columns(space, shallowest - np.float32(space.through))


def _outline_columns(space: Interior, depths: NDArray[np.float32]) -> shapely.Geometry:
    """Draw the polygons, mm, of the columns with a positive depth, smooth between the cells."""
    from skimage.measure import find_contours

    deepest = np.pad(depths, 1, constant_values=-BAND)
    rings = find_contours(deepest, LOW)  # type: ignore[no-untyped-call]
    area = shapely.build_area(shapely.MultiLineString([ring - 1 for ring in rings]))
    # Away from an upright wall, depths rise by one per cell.
    area = shapely.simplify(shapely.buffer(area, LOW, join_style="mitre", mitre_limit=MITRE), SIMPLER)
    return shapely.transform(area, lambda cells: space.origin[:2] + space.size * cells)
