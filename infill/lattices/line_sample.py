"""A few cells of a pattern of lines: the spacing of lines, the sharpness of corners, and widths for densities."""

from __future__ import annotations

import dataclasses
import math
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.drawings.tiled import TooManyCopiesError
from infill.lattices.fillets import find_polygon_corners
from infill.lattices.root_finding import find_root
from patterns.errors import PatternError
from patterns.protocol import Pattern, draw_lines, with_cell

SAMPLE = 12.0  # cells of the pattern along a side of the square in which density is measured
MOST_SAMPLED = 500_000  # points in that square; a drawing of more is measured in fewer cells
SNAP = 1e-6  # of a cell: lines that are nearer than this meet
NEAR, TRIES = 0.01, 12  # of the density: error that is good enough, and tries at most
# Lines are drawn in a square of this many half diagonals of the filled region, as the largest hearts that fit into a
# smaller one do not cover the part.
WIDER = 1.7


@dataclasses.dataclass(frozen=True, kw_only=True)
class LineSample:
    """The lines of a pattern far from any skin, at height 0.

    Parameters
    ----------
    pattern : Pattern
        Its cell does not matter.
    """

    pattern: Pattern

    @cached_property
    def spacing(self) -> float:
        """Average spacing of lines, as if they formed a grid, in cells; at most one."""
        region, lines = self._lines_in_square
        return min(1.0, float(2 * region.area / lines.length))

    def widths(self, density: float) -> float:
        """Return the width of lines, in cells, that gives a density in the sample."""
        region, lines = self._lines_in_square

        def log_error(times: float) -> float:
            walls = shapely.buffer(lines, times * self.spacing * density / 4, quad_segs=1)
            return math.log(shapely.intersection(walls, region).area / (density * region.area))

        # Lines a cell apart in one direction would be as wide as the density; most run in two.
        return self.spacing * density / 2 * find_root(log_error, NEAR, TRIES)

    @cached_property
    def _lines_in_square(self) -> tuple[shapely.Polygon, shapely.Geometry]:
        """A few cells of a pattern whose cell is 1, and the lines in them."""
        pattern, side = with_cell(self.pattern, 1.0), SAMPLE / 2
        points_of_cell = shapely.get_num_coordinates(draw_lines(pattern, centred_square(0.5)))
        if points_of_cell * (WIDER * SAMPLE * 2**0.5) ** 2 > MOST_SAMPLED:
            side = 1.0
        region = centred_square(side)
        wider = region if follows_outline(self.pattern) else centred_square(WIDER * side * 2**0.5)
        try:
            lines = shapely.intersection(draw_lines(pattern, wider), region)
        except TooManyCopiesError as error:  # whatever the cell of the part
            raise PatternError(
                f"the density is measured in a few cells: {error.excess}; simplify the drawing"
            ) from error
        if not lines.length:
            raise PatternError(f"the pattern {self.pattern.name} has no lines; draw some")
        return region, lines


def follows_outline(pattern: Pattern) -> bool:
    """Tell whether the lines of a pattern follow the outline of their region; a plug-in need not declare it."""
    return getattr(pattern, "follows", False)


def centred_square(half: float) -> shapely.Polygon:
    """Return the square about (0, 0) with a half side."""
    return shapely.box(-half, -half, half, half)


def line_segments(lines: NDArray[np.object_], start: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """Return the segments of lines, (S, 2, 2), with `start` as origin and `size` as unit.

    >>> line_segments(shapely.linestrings([[(1, 1), (3, 1), (3, 5)]]), np.array([1.0, 1.0]), 2.0).tolist()
    [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [1.0, 2.0]]]
    """
    points, line = shapely.get_coordinates(lines, return_index=True)
    points = (points - start) / size
    within_line = np.flatnonzero(line[1:] == line[:-1])
    return np.stack([points[within_line], points[within_line + 1]], axis=1)


def corner_angles(lines: shapely.Geometry, region: shapely.Polygon, *, cell: float = 1.0) -> NDArray[np.float64]:
    """Return the angles between lines inside a region, where they meet or bend, degrees.

    Parameters
    ----------
    lines, region
    cell : float
        Of the pattern, in the unit of the lines.

    >>> corner_angles(shapely.LineString([(-1 / 3, 0), (0, 0), (0, 1 / 3)]), centred_square(1 / 3)).round(6).tolist()
    [90.0]
    """
    places, angles = find_polygon_corners(faces_between(lines, region, cell=cell))
    off_border = shapely.distance(shapely.points(places), region.boundary) > 2 * SNAP * cell
    inside: NDArray[np.float64] = angles[off_border]
    return inside


def faces_between(lines: shapely.Geometry, region: shapely.Polygon, *, cell: float = 1.0) -> NDArray[np.object_]:
    """Return the polygons between lines, and between them and the border of their region.

    Points that are nearer to each other than a millionth of a cell coincide, so that rounding does not part lines.

    Parameters
    ----------
    lines, region
    cell : float
        Of the pattern, in the unit of the lines.

    >>> upright, level = shapely.LineString([(0, -1), (0, 1)]), shapely.LineString([(1e-9, 0), (1, 0)])
    >>> [face.area for face in faces_between(shapely.MultiLineString([upright, level]), centred_square(1.0))]
    [1.0, 2.0, 1.0]
    """
    noded = shapely.union_all([lines, region.boundary], grid_size=SNAP * cell)
    faces: NDArray[np.object_] = shapely.get_parts(shapely.polygonize([noded]))
    return faces
