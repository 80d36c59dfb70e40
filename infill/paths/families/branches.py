"""Branches below the roofs of a print, which lean to its walls: see `patterns.lightning`.

The trees of `infill.paths.branches`, as paths: of all branches that meet, the straightest goes on to the wall, and the
others end beside it, where they touch.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from infill.arrays import Floats
from infill.paths.branches import LayerWalls, Twigs, grow_branches, lattice_twigs
from infill.paths.families.family import TOUCH, Bounds, Family, Path, PathSpec
from infill.paths.families.infill_space import InfillSpace
from infill.paths.forest import NONE, Forest
from patterns.lightning import Lightning

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

DEEPER = 2.0  # nodes by which feet stand in the wall, so that branches reach it
SHORTEST = 2.0  # line widths of a branch
ARC = 16  # chords in a quarter of a circle
RADIUS = 0.3  # of corners, in line widths
OVERLAP = 1e-6  # of the distance of beads that touch


@dataclass(frozen=True, kw_only=True)
class LightningPaths(Family):
    """Branches below roofs, about a `cell` apart there. Without a print, there are none."""

    name: str = "lightning"
    summary: str = "branches below roofs alone, which lean to the walls: the least filament"
    prismatic: bool = False
    overhang: float = 45.0
    space: InfillSpace | None = None
    fills: ClassVar[bool] = False
    least_spacing: ClassVar[float] = TOUCH

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius of corners, mm, at which branches still touch that end beside them."""
        return min(cell / 4, RADIUS * line_width)

    def in_print(self, space: InfillSpace) -> LightningPaths:
        """Return the family in a print."""
        return replace(self, space=space)

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the branches of the nearest layer."""
        if self.space is None:
            return []
        layer = int(np.argmin(np.abs(self.space.heights - spec.z)))
        paths = _separate(self._paths(spec.cell)[layer], spec.gap, SHORTEST * spec.line_width)
        low, high = np.array(bounds).reshape(2, 2)
        return [path for path in paths if (path.max(axis=0) >= low).all() and (path.min(axis=0) <= high).all()]

    def _paths(self, cell: float) -> list[list[Path]]:
        """Return the branches of all layers, in the pattern, grown once for each cell."""
        assert self.space is not None
        key = self.overhang, cell
        if key not in self.space.cache:
            self.space.cache[key] = _grow(self.space, cell, math.tan(math.radians(self.overhang)))
        paths: list[list[Path]] = self.space.cache[key]
        return paths


def _grow(space: InfillSpace, cell: float, lean: float) -> list[list[Path]]:
    """Grow branches in all layers of a print, from its top; return their paths in each layer, from the lowest on.

    Parameters
    ----------
    space : InfillSpace
    cell : float, mm
    lean : float
        Tangent of the angle from upright by which lower edges lean.
    """
    size = float(space.steps[0])
    nodes = np.rint((space.heights - space.corner[2]) / space.steps[2]).astype(np.intp)
    inside = space.inside[:, :, nodes.clip(0, space.inside.shape[2] - 1)]
    rises = np.append(np.diff(space.heights), 0.0)
    walls = LayerWalls(
        depth=np.where(inside, np.int8(1), np.int8(-1)),
        step=lean * float(np.median(rises[:-1], axis=0) if len(rises) > 1 else space.steps[2]) / size,
        deeper=DEEPER,
    )
    steps = (lean * rises / size).tolist()
    twigs = _twigs_of(space, cell, size)
    layers = [
        [_on_pattern(space, size, path) for path in tree_paths(forest)]
        for forest, _ in grow_branches(walls, twigs, reach=cell / 2 / size, steps=steps)
    ]
    return layers[::-1]


def _twigs_of(space: InfillSpace, cell: float, size: float) -> Twigs:
    """Find the places of twigs on the grid of a print."""
    first = cell * np.array([[*Lightning().first], [1.0, 0.0], [0.0, 1.0]])
    first[1:] += cell * np.array(Lightning().first)
    places = space.to_bed(np.column_stack([first, np.zeros(3)]))[:, :2]
    place = (places[0] - space.corner[:2]) / size
    nx, ny, _ = space.inside.shape
    return lattice_twigs((nx, ny), place, (places[1:] - places[0]) / size, Lightning.cells)


def _on_pattern(space: InfillSpace, size: float, path: Path) -> Path:
    """Move a path from the grid of a print to the pattern, mm."""
    on_bed = space.corner[:2] + size * path
    moved: Path = space.to_pattern(np.column_stack([on_bed, np.zeros(len(path))]))[:, :2]
    return moved


def tree_paths(forest: Forest) -> list[Path]:
    """Return the paths of trees, each from a tip towards the foot: the longest first, others up to where they meet one.

    Where branches meet, the straightest goes on.

    >>> at = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [9.0, 0.0]])
    >>> forest = Forest(at=at, to=np.array([1, 3, 1, NONE]), inside=np.ones(4, dtype=bool))
    >>> [path.tolist() for path in tree_paths(forest)]
    [[[0.0, 0.0], [5.0, 0.0], [9.0, 0.0]], [[5.0, 3.0], [5.0, 0.0]]]
    """
    following = forest.to.tolist()
    before: dict[int, list[int]] = {}
    for node, after in enumerate(following):
        before.setdefault(after, []).append(node)
    straightest = {
        node: min(nodes, key=lambda previous, node=node: _turn_at(forest.at, previous, node, following[node]))  # type: ignore[misc]
        for node, nodes in before.items()
        if node != NONE
    }
    paths = []
    for tip in (node for node in range(len(following)) if node not in before and following[node] != NONE):
        chain = [tip]
        while following[chain[-1]] != NONE:
            chain.append(following[chain[-1]])
            if straightest[chain[-1]] != chain[-2]:
                break
        paths.append(forest.at[chain])
    return sorted(paths, key=lambda path: -_length(path))


def _turn_at(at: Floats, previous: int, node: int, after: int) -> float:
    """Return the turn of a branch at a node, as the negative cosine; the length decides at a foot."""
    arriving = at[node] - at[previous]
    if after == NONE:
        return -float(np.hypot(*arriving))
    leaving = at[after] - at[node]
    return -float(arriving @ leaving) / max(float(np.hypot(*arriving) * np.hypot(*leaving)), 1e-12)


def _separate(paths: Sequence[Path], gap: float, shortest: float) -> list[Path]:
    """Cut every path where it comes nearer to those before it than beads that touch, `gap` mm; drop short pieces."""
    import shapely

    separate: list[Path] = []
    taken: list[Polygon | MultiPolygon] = []
    for path in paths:
        line = shapely.linestrings(path)
        near = [area for area in taken if area.intersects(line)]
        pieces = shapely.get_parts(shapely.difference(line, shapely.union_all(near)) if near else line)
        long = [piece for piece in pieces if piece.length >= shortest]
        separate += [shapely.get_coordinates(piece) for piece in long]
        taken += [shapely.buffer(piece, gap * (1 - OVERLAP), quad_segs=ARC) for piece in long]
    return separate


def _length(points: Floats) -> float:
    """Return the length of a path."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
