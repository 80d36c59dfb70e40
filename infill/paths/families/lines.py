"""Paths along the lines of any pattern: the paths of plug-ins and of patterns of users.

A line that meets no other is one path. Lines that meet or come too near have a path on either side, half a bead away,
so that nothing crosses and no bead is laid twice::

    ──┼──    becomes    ══╝╚══
                        ══╗╔══
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from infill.paths.families.family import TOUCH, Bounds, CentredFamily, Path, PathSpec
from patterns.protocol import LEVEL_SET, Pattern, draw_lines, gives, with_cell

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon

GROWTH = 1.5  # between the squares in which lines are drawn: regions of a print that differ little have the same one
STEPS = 4  # along a side, at least: the borders of boxes around which lines become paths lie at whole steps
SNAP = 1e-6  # of a cell: lines that are nearer than this meet
NEARER = 0.95  # of the distance of touching beads, below which lines count as too near
SIMPLER = 0.002  # mm
ARC = 16  # chords in a quarter of a circle
SAMPLE = 12.0  # cells along a side of the square in which a density is measured
ROUNDS = 3  # of the guess of a cell


@dataclass(frozen=True, kw_only=True)
class LinePaths(CentredFamily):
    """Paths along the lines of a pattern, whose origin lies at `middle`, mm; `cell` is the cell of the pattern.

    Some patterns follow the middle of the region that they are given, so lines are drawn in a square about the middle,
    and become paths around the box that is to be covered. A level set is the same in every region, and finding its
    lines takes long, so it is drawn around that box alone.
    """

    pattern: Pattern
    corner_share: ClassVar[float] = 0.25  # cells keep their shape; paths that are offset together touch at any radius

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the paths that reach into the box, drawn at least a cell beyond it."""
        middle = np.array(self.middle or (0.0, 0.0))
        low, high = np.array(bounds, dtype=np.float64).reshape(2, 2) - middle
        box = box_around(low - spec.cell, high + spec.cell)
        paths = self._draw(spec.cell, box, 0.0 if self.prismatic else spec.z, spec.line_width)
        return [path + middle for path in paths if (path.max(axis=0) >= low).all() and (path.min(axis=0) <= high).all()]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, as measured in a few cells."""
        cell = 10 * line_width
        for _ in range(ROUNDS):
            half = SAMPLE / 2 * cell
            paths = self._draw(cell, (-half, -half, half, half), 0.0, line_width)
            length = sum(float(np.hypot(*np.diff(path, axis=0).T).sum()) for path in paths)
            cell *= max(TOUCH * line_width * length / (2 * half) ** 2, 1e-3) / density
        return cell

    def _draw(self, cell: float, bounds: Bounds, z: float, line_width: float) -> list[Path]:
        """Draw the paths in a box, mm from the middle; cached if the pattern can be hashed."""
        pattern = with_cell(self.pattern, cell)
        if isinstance(pattern, Hashable):
            return _paths_in_box(pattern, bounds, z, line_width)
        return _paths_in_box.__wrapped__(pattern, bounds, z, line_width)


@dataclass(frozen=True, kw_only=True)
class FollowingPaths(LinePaths):
    """Paths along the lines of a pattern that follows the outline of the region."""

    def strands_inside(self, region: Polygon | MultiPolygon, spec: PathSpec) -> list[Path]:
        """Return the paths inside the region; see `RegionFamily`."""
        lines = draw_lines(with_cell(self.pattern, spec.cell), region)
        return separate_lines(lines, cell=spec.cell, line_width=spec.line_width)


def line_paths(pattern: Pattern) -> LinePaths:
    """Return the family of paths along the lines of a pattern."""
    kind = FollowingPaths if getattr(pattern, "follows", False) else LinePaths
    return kind(name=pattern.name, summary=pattern.summary, prismatic=pattern.prismatic, pattern=pattern)


def is_level_set(pattern: Pattern) -> bool:
    """Tell whether the lines of a pattern are those of its level set: the same in every region, and disjoint."""
    return gives(pattern) == (LEVEL_SET,)


def square_around(low: NDArray[np.float64], high: NDArray[np.float64]) -> Bounds:
    """Return the smallest square about (0, 0), of sizes a factor of `GROWTH` apart, around a box, mm.

    >>> [round(side, 3) for side in square_around(np.array([-1.0, 2.0]), np.array([4.0, 5.0]))]
    [-5.062, -5.062, 5.062, 5.062]
    """
    reach = max(float(np.abs([low, high]).max()), 1.0)
    half = GROWTH ** math.ceil(math.log(reach, GROWTH))
    return -half, -half, half, half


def box_around(low: NDArray[np.float64], high: NDArray[np.float64]) -> Bounds:
    """Return a box around a box, mm, with sides at whole steps, so that boxes that differ little have the same one.

    >>> box_around(np.array([10.1, -3.0]), np.array([21.5, 4.0]))
    (10.0, -3.0, 22.0, 4.0)
    """
    steps = 2.0 ** np.floor(np.log2(np.maximum(high - low, 1.0) / STEPS))
    (x0, y0), (x1, y1) = (np.floor(low / steps) * steps).tolist(), (np.ceil(high / steps) * steps).tolist()
    return x0, y0, x1, y1


@lru_cache(maxsize=16)
def _paths_in_box(pattern: Any, bounds: Bounds, z: float, line_width: float) -> list[Path]:  # noqa: ANN401 - a Pattern
    """Draw the paths along the lines of a pattern in a box, mm from the middle."""
    import shapely

    from patterns.linework import clip

    cell, box = float(getattr(pattern, "cell", 1.0)), shapely.box(*bounds)
    if is_level_set(pattern):  # dozens of points for each wave; they meet nowhere
        lines = shapely.simplify(draw_lines(pattern, box, z), SIMPLER)
    else:
        square = shapely.box(*square_around(np.array(bounds[:2]), np.array(bounds[2:])))
        lines = clip(draw_lines(pattern, square, z).geoms, box)
    inside = shapely.buffer(box, -cell, join_style="mitre")
    return separate_lines(lines, cell=cell, line_width=line_width, inside=inside)


def separate_lines(
    lines: MultiLineString, *, cell: float, line_width: float, inside: Polygon | None = None
) -> list[Path]:
    """Return paths along lines, of which no two cross or come nearer than touching beads.

    Parameters
    ----------
    lines : MultiLineString, mm
    cell, line_width : float, mm
    inside : Polygon, optional
        Where lines count as too near: where the border of a region cuts a wave at its crest, the ends of the pieces are
        near each other, and nothing else of them is.

    >>> import shapely
    >>> cross = shapely.MultiLineString([[(-5, 0), (5, 0)], [(0, -5), (0, 5)]])
    >>> len(separate_lines(cross, cell=5, line_width=0.4)), len(separate_lines(cross.geoms[0], cell=5, line_width=0.4))
    (1, 1)
    """
    import shapely

    touch = TOUCH * line_width
    parts = shapely.get_parts(shapely.line_merge(shapely.union_all([lines], grid_size=SNAP * cell)))
    alone = _meet_no_other(parts)
    judged = parts if inside is None else shapely.intersection(parts, inside)
    near = shapely.STRtree(judged).query(judged, predicate="dwithin", distance=NEARER * touch)
    alone[near[0][near[0] != near[1]]] = False
    while not alone.all():
        walls = shapely.buffer(shapely.union_all(parts[~alone]), touch, quad_segs=ARC)
        walls = shapely.buffer(walls, -touch / 2, quad_segs=ARC)  # gaps that are too narrow for a bead have gone
        shapely.prepare(walls)
        too_near = alone & shapely.dwithin(walls, judged, NEARER * touch)
        if not too_near.any():
            rings = shapely.get_rings(shapely.get_parts(shapely.simplify(walls, SIMPLER)))
            return [shapely.get_coordinates(path) for path in (*parts[alone], *rings)]
        alone &= ~too_near
    return [shapely.get_coordinates(path) for path in parts]


def _meet_no_other(parts: NDArray[np.object_]) -> NDArray[np.bool_]:
    """Tell which lines, merged where two meet, share no end with another."""
    import shapely

    ends = np.array([line.coords[end] for line in parts for end in (0, -1)]).reshape(-1, 2)
    _, places, counts = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    shared: NDArray[np.intp] = counts[places.ravel()].reshape(-1, 2)
    alone: NDArray[np.bool_] = (shared == 1).all(axis=1) | (shapely.is_closed(parts) & (shared[:, 0] == 2))
    return alone
