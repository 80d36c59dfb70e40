"""Cubes on their corners that are small at the skin of a print, or below its roofs, and large elsewhere.

The cubes are those of `patterns.octree`. At one height, their faces are lines in three directions of which pieces are
missing: inside of cubes that are not split. So a line ends on a face of a larger cube, and lies on the layer below as
far as that face does.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.paths.families.family import TOUCH, Bounds, Family, Path, PathSpec
from infill.paths.families.infill_space import InfillSpace
from infill.paths.families.junctions import SIN
from infill.paths.families.triangle_lattice import (
    KINDS,
    LONG_A,
    LONG_B,
    LONG_C,
    SHORT_A,
    SHORT_B,
    SHORT_C,
    TriangleLattice,
)
from infill.paths.families.waves import solve_cell_for_density
from patterns.octree import Octree, divide_cubes
from patterns.planes import ON_A_CORNER

TURN = np.array(ON_A_CORNER)
SIDE = math.sqrt(2 / 3)  # of a cube, over the distance of its lines
MARGIN, BEYOND = 2, 0.5  # cubes that are drawn beyond a box, on each side, and cells that lines reach beyond it
TURN_SEGMENTS = 4
Levels = NDArray[np.uint8]


@dataclass(frozen=True, kw_only=True, eq=False)
class PrintCubes:
    """Cubes in a print.

    Parameters
    ----------
    doubled : (N, M, K) uint8
        For each of the smallest cubes, how often the cube around it is doubled.
    first : (3,) int64
        The number of the first of these, along each axis of the pattern.
    """

    doubled: Levels
    first: NDArray[np.int64]

    def at(self, cubes: NDArray[np.int64]) -> Levels:
        """Return how often the cubes around some of the smallest, (..., 3), are doubled."""
        inside = (cubes - self.first).clip(0, np.array(self.doubled.shape) - 1)
        doubled: Levels = self.doubled[tuple(np.moveaxis(inside, -1, 0))]
        return doubled


@dataclass(frozen=True, kw_only=True)
class OctreePaths(Family):
    """Faces of cubes; `cell` is the distance between parallel lines of the smallest.

    Without a print, all cubes are the smallest.
    """

    prismatic: bool = False
    roofs: bool = False
    levels: int = 2
    space: InfillSpace | None = None
    corner_share: ClassVar[float] = 0.25
    least_spacing: ClassVar[float] = TOUCH

    def in_print(self, space: InfillSpace) -> OctreePaths:
        """Return the family in a print."""
        return replace(self, space=space)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius at which strands that turn off by 60° touch at the middle of their arc, mm."""
        gap = PathSpec(cell=cell, line_width=line_width).gap
        return min(self.corner_share * cell, gap / 2 / (1 / math.cos(math.radians(30)) - 1))

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell at which the smallest cubes fill a density: strands are shorter where they turn off."""
        gap = PathSpec(cell=1.0, line_width=line_width).gap
        # A period of 2 / √3 cells² has two crossings at 60° and one at 120°, of two strands each.
        lost = 4 * (2 - 2 * SIN) + 2 * (1 / SIN - 1 / math.sqrt(3))
        return solve_cell_for_density(lambda cell: (3 - SIN * lost * gap / cell) / cell, density, line_width)

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return lines along the faces of cubes."""
        side, middle = SIDE * spec.cell, self._pattern.middle
        total = TURN[:, 2].sum() * spec.z / side + 3 * middle
        number = math.floor(total)
        part = total - number
        corners = np.array([[x, y, spec.z] for x in bounds[::2] for y in bounds[1::2]]) @ TURN.T / side + middle
        low, high = corners.min(axis=0).astype(np.int64) - MARGIN - 1, corners.max(axis=0).astype(np.int64) + MARGIN + 1
        i, j = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1), indexing="ij")
        k = number - i - j
        # Places with u_0 = i and u_1 = j at this height, from the three coordinates along the axes of the cubes.
        axes = np.stack([i, j, total - i - j], axis=-1) - middle
        places = side * (axes @ TURN)[..., :2]
        present = self._present(i, j, k, spec.cell)
        near = (k >= low[2] - 1) & (k <= high[2] + 1)
        lattice = TriangleLattice(corners=places, height=part * spec.cell, cell=spec.cell, present=present & near)
        return _cut_off(lattice.paths(spec.gap), bounds, BEYOND * spec.cell)

    @property
    def _pattern(self) -> Octree:
        """The cubes."""
        return Octree(name=self.name, summary=self.summary, roofs=self.roofs, levels=self.levels)

    def _present(self, i: NDArray[np.int64], j: NDArray[np.int64], k: NDArray[np.int64], cell: float) -> Flags:
        """Tell which pieces of lines there are, (6, I, J), by their kind: those between two cubes."""
        present = np.ones((KINDS, *i.shape), dtype=bool)
        if self.space is None:
            return present
        tree = self._tree(cell)
        # A piece lies on the face below a cube; a short one has the triangle beside it.
        cube, lower, previous = (tree.at(np.stack([i, j - dj, k - dk], axis=-1)) for dj, dk in ((0, 0), (0, 1), (1, 0)))
        on_i, on_j, on_k = (_doublings(axis, self.levels) for axis in (i, j, k))
        present[SHORT_A], present[LONG_A] = cube <= on_k, previous <= on_k
        present[SHORT_B], present[LONG_B] = cube <= on_j, lower <= on_j
        present[SHORT_C], present[LONG_C] = cube <= on_i, lower <= on_i
        return present

    def _tree(self, cell: float) -> PrintCubes:
        """Return the cubes of a print, built once for each cell."""
        assert self.space is not None
        key = self.roofs, self.levels, cell
        if key not in self.space.cache:
            self.space.cache[key] = _build_tree(self.space, self._pattern, SIDE * cell)
        tree: PrintCubes = self.space.cache[key]
        return tree


def _cut_off(paths: Sequence[Path], bounds: Bounds, beyond: float) -> list[Path]:
    """Cut off what lies beyond a box with a margin, mm: there, the last cubes lack their neighbours.

    Segments stay unsplit, and so do turns of a few segments just outside.
    """
    import shapely

    x0, y0, x1, y1 = bounds
    box = shapely.box(x0 - beyond, y0 - beyond, x1 + beyond, y1 + beyond)
    shapely.prepare(box)
    cut: list[Path] = []
    for path in paths:
        reaches = shapely.intersects(box, shapely.linestrings(np.stack([path[:-1], path[1:]], axis=1)))
        segments = np.flatnonzero(reaches)
        runs = np.split(segments, np.flatnonzero(np.diff(segments) > TURN_SEGMENTS) + 1)
        cut += [path[run[0] : run[-1] + 2] for run in runs if len(run)]
    return cut


def _doublings(numbers: NDArray[np.int64], most: int) -> Levels:
    """Return how often the largest cubes are doubled that have a face on the planes of some numbers."""
    lowest = numbers & -numbers
    return np.where(lowest == 0, most, np.log2(np.maximum(lowest, 1))).astype(np.uint8)


def _build_tree(space: InfillSpace, pattern: Octree, side: float) -> PrintCubes:
    """Divide a print into cubes that are smaller the nearer they lie to its skin, or to its roofs."""
    from scipy.spatial import cKDTree

    surface = space.roofs if pattern.roofs else space.skin
    tree = cKDTree(surface) if len(surface) else None

    def look(cubes: Floats, farthest: float) -> tuple[Floats, Flags]:
        points: Floats = side * (cubes - pattern.middle) @ TURN
        distances: Floats = np.full(len(points), np.inf)
        if tree is not None:
            distances = np.asarray(tree.query(points, distance_upper_bound=farthest)[0])
        return distances, space.contains(points)

    doubled, corner = divide_cubes(pattern, space.box @ TURN.T / side + pattern.middle, side, look)
    return PrintCubes(doubled=doubled, first=corner)


ADAPTIVE_CUBIC = OctreePaths(
    name="adaptive-cubic", summary="cubes on a corner, small at walls, roofs and floors and large inside"
)
SUPPORT_CUBIC = OctreePaths(
    name="support-cubic", summary="cubes on a corner, small below roofs and large elsewhere", roofs=True
)
