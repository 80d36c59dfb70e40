"""Some cells of a pattern of lines: how far apart lines are, how sharp their corners, how wide for a density."""

from __future__ import annotations

import dataclasses
import math
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.interior.root_finding import root
from infill.lattices.fillets import between_lines, sharpest
from patterns.errors import PatternError
from patterns.protocol import Pattern, lines_of

SAMPLE = 12.0  # cells of the pattern along a side of what is measured to tell how width and density go together
SNAP = 1e-6  # of a cell: lines that are nearer than this meet
NEAR, TRIES = 0.01, 12  # of the density of that: when it is near enough
# Half a diagonal of what is filled, in which lines are drawn: hearts that are the largest to fit into that reach
# beyond the part.
WIDER = 1.7


@dataclasses.dataclass(frozen=True, kw_only=True)
class LineSample:
    """What a pattern of lines is like far from any skin, at height 0.

    Parameters
    ----------
    pattern : Pattern
        Its cell does not matter.
    """

    pattern: Pattern

    @cached_property
    def apart(self) -> float:
        """How far lines are apart on average, as those of a grid would be, in cells; at most one."""
        region, lines = self._drawn
        return min(1.0, float(2 * region.area / lines.length))

    @cached_property
    def sharpest(self) -> float:
        """See `Voids`."""
        region, lines = self._drawn
        return sharpest(corners(lines, region))

    def widths(self, density: float) -> float:
        """See `Voids`."""
        region, lines = self._drawn

        def off(times: float) -> float:
            walls = shapely.buffer(lines, times * self.apart * density / 4, quad_segs=1)
            return math.log(shapely.intersection(walls, region).area / (density * region.area))

        # Lines a cell apart in one direction would be as wide as the density; most run in two.
        return self.apart * density / 2 * root(off, NEAR, TRIES)

    @cached_property
    def _drawn(self) -> tuple[shapely.Polygon, shapely.Geometry]:
        """Return some cells of a pattern whose cell is 1, and the lines in them."""
        side = SAMPLE / 2
        region = square(side)
        wider = region if follows(self.pattern) else square(WIDER * side * 2**0.5)
        lines = shapely.intersection(lines_of(sized(self.pattern, 1.0), wider), region)
        if not lines.length:
            raise PatternError(f"the pattern {self.pattern.name} has no lines; draw some")
        return region, lines


def sized(pattern: Pattern, cell: float) -> Pattern:
    """Return a pattern with a cell, mm, and without a frame."""
    changed: dict[str, Any] = {"cell": cell} if hasattr(pattern, "cell") else {}
    if hasattr(pattern, "frame"):
        changed["frame"] = False
    return dataclasses.replace(pattern, **changed)  # type: ignore[type-var]


def follows(pattern: Pattern) -> bool:
    """Return whether the lines of a pattern follow the outline of their region; a plug-in need not say so."""
    return getattr(pattern, "follows", False)


def square(half: float) -> shapely.Polygon:
    """Return the square about (0, 0) whose sides are twice as long."""
    return shapely.box(-half, -half, half, half)


def segments_of(lines: NDArray[np.object_], start: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """Return the segments (S, 2, 2) of lines, mm, in cells of a size from where the first one lies.

    >>> segments_of(shapely.linestrings([[(1, 1), (3, 1), (3, 5)]]), np.array([1.0, 1.0]), 2.0).tolist()
    [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [1.0, 2.0]]]
    """
    points, line = shapely.get_coordinates(lines, return_index=True)
    points = (points - start) / size
    joined = np.flatnonzero(line[1:] == line[:-1])
    return np.stack([points[joined], points[joined + 1]], axis=1)


def corners(lines: shapely.Geometry, region: shapely.Polygon, *, cell: float = 1.0) -> NDArray[np.float64]:
    """Return the angles between lines inside of a region, where they meet or bend, degrees.

    Parameters
    ----------
    lines, region
    cell : float
        Of the pattern, in the unit of the lines.

    >>> corners(shapely.LineString([(-1 / 3, 0), (0, 0), (0, 1 / 3)]), square(1 / 3)).round(6).tolist()
    [90.0]
    """
    places, angles = between_lines(faces_between(lines, region, cell=cell))
    off_border = shapely.distance(shapely.points(places), region.boundary) > 2 * SNAP * cell
    inside: NDArray[np.float64] = angles[off_border]
    return inside


def faces_between(lines: shapely.Geometry, region: shapely.Polygon, *, cell: float = 1.0) -> NDArray[np.object_]:
    """Return the polygons between lines, and between them and the border of their region.

    Lines that meet but for rounding do so here: what is nearer than a millionth of a cell is in one place.

    Parameters
    ----------
    lines, region
    cell : float
        Of the pattern, in the unit of the lines.

    >>> upright, level = shapely.LineString([(0, -1), (0, 1)]), shapely.LineString([(1e-9, 0), (1, 0)])
    >>> [face.area for face in faces_between(shapely.MultiLineString([upright, level]), square(1.0))]
    [1.0, 2.0, 1.0]
    """
    noded = shapely.union_all([lines, region.boundary], grid_size=SNAP * cell)
    faces: NDArray[np.object_] = shapely.get_parts(shapely.polygonize([noded]))
    return faces
