"""Patterns that repeat in space: walls along a minimal surface or planes, one side of it, or bars along edges.

They are defined for one unit cell, of side 1, that repeats along x, y and z; to fill a part, it is scaled and turned.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from patterns.cellular import Cells
from patterns.polyhedra import Polyhedra

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

NEWTON_STEPS, NEWTON_STEPS_AGAIN = 3, 2  # of Newton's method, from near the surface to it, and from nearer
NODES_PER_CELL, SHIFT = 40, 0.0093  # nodes along a cell, between which the surface is looked for; where they begin
JUMPS = (16, 8, 4, 2, 1, 1)  # distances of jump flooding, in nodes: from half a cell to direct neighbours, twice
SEARCH_ROUNDS = 3  # of the search for the nearest point of the surface
ZERO_TOLERANCE = 1e-3  # values that count as 0
DIFFERENCE = 1e-6  # of a cell, for slopes
LONGEST_STEP, SHORTEST_STEP = 0.2, 2e-3  # steps, in cells: the longest, and the shortest that matters
MAX_DISTANCE = 0.5  # of a cell: distances beyond this are cut off
REACH = 0.8  # of a period: further from the unit cell, no bar is the nearest of any point in it
FURTHEST = 1.5  # cells: such a bar is not the nearest either
DEEPEST = 48  # points along a cell, among which the deepest is looked for
ROUNDING = 1e-9
BINS, BINS_PER_CELL = 12, 6  # along a period, in each of which the edges that may be the nearest are known, at least


@dataclass(frozen=True, kw_only=True)
class Surfaces(Cells):
    """Walls along a surface that repeats, with void on both sides: a sheet.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    value : callable
        Takes x, y and z, of one shape, in radians: 2 pi is a cell. Its zeros are the surface.
    """

    cells: ClassVar[int] = 1

    value: Callable[[Floats, Floats, Floats], Floats]

    def distance(self, points: Floats) -> Floats:
        """Return the distance of points (N, 3), in cells, from the surface: (N,) in cells, with the sign of the value.

        It is cut off half a cell away. The search begins at the nearest of many sample points of the surface.

        >>> from patterns import SchwarzP
        >>> import numpy as np
        >>> SchwarzP().distance(np.array([[0.25, 0.25, 0.25], [0.25, 0.25, 0.26]])).round(3).tolist()
        [0.0, -0.006]
        """
        import numpy as np

        points = np.asarray(points, dtype=np.float64)
        foot = points + self._offsets_to_surface(points)
        nearest = np.minimum(np.linalg.norm(points - foot, axis=1), MAX_DISTANCE)
        active = np.flatnonzero(nearest < MAX_DISTANCE)
        foot = foot[active]
        for _ in range(SEARCH_ROUNDS):
            # Project the point onto the tangent plane at the foot, and return to the surface.
            offset, normal = points[active] - foot, _unit(self._slope(foot, self._at(foot)))
            across = offset - (offset * normal).sum(axis=1, keepdims=True) * normal
            moving = np.linalg.norm(across, axis=1) > SHORTEST_STEP
            active, foot = active[moving], foot[moving]
            foot, value = self._on_surface(foot + across[moving], NEWTON_STEPS_AGAIN)
            foot_distance = np.linalg.norm(points[active] - foot, axis=1)
            nearest[active] = np.where(
                np.abs(value) < ZERO_TOLERANCE, np.minimum(nearest[active], foot_distance), nearest[active]
            )
        signed: Floats = np.where(self._at(points) < 0, -1.0, 1.0) * nearest
        return signed

    def _offsets_to_surface(self, points: Floats) -> Floats:
        """Return the offset from points (N, 3) to the nearest surface point of the nodes around them, (N, 3)."""
        import numpy as np

        offsets, position = surface_offsets(self), (points - SHIFT) * NODES_PER_CELL
        low = np.floor(position).astype(np.int64)
        best = np.full(points.shape, np.inf)
        for corner in itertools.product((0, 1), repeat=3):
            node = low + corner
            offset = offsets[tuple((node % NODES_PER_CELL).T)] + (node - position) / NODES_PER_CELL
            nearer = (offset**2).sum(axis=1) < (best**2).sum(axis=1)
            best[nearer] = offset[nearer]
        return best

    def _on_surface(self, points: Floats, steps: int) -> tuple[Floats, Floats]:
        """Move points (N, 3) to the surface by Newton's method; return them and the values there."""
        import numpy as np

        foot, value = points.copy(), self._at(points)
        for _ in range(steps):
            slope = self._slope(foot, value)
            step = (value / np.maximum((slope**2).sum(axis=1), 1e-12))[:, None] * slope
            length = np.linalg.norm(step, axis=1, keepdims=True)
            foot -= step * np.minimum(1, LONGEST_STEP / np.maximum(length, 1e-12))
            value = self._at(foot)
        return foot, value

    def _at(self, points: Floats) -> Floats:
        """Evaluate the level set at points (N, 3), in cells."""
        import numpy as np

        x, y, z = (2 * np.pi * points).T
        value: Floats = self.value(x, y, z)
        return value

    def _slope(self, points: Floats, value: Floats) -> Floats:
        """Return the gradient of the value at points (N, 3), where the value is given: (N, 3)."""
        import numpy as np

        out = np.empty_like(points)
        for axis, step in enumerate(DIFFERENCE * np.eye(3)):
            out[:, axis] = (self._at(points + step) - value) / DIFFERENCE
        return out


@cache
def surface_offsets(surfaces: Surfaces) -> Floats:
    """Return the offset from each node of a period to about the nearest point of the surface, (n, n, n, 3), in cells.

    Where the value changes sign between two nodes, there is such a point; from there, nodes take over the points of
    other nodes at several distances: jump flooding (Rong and Tan 2006, doi:10.1145/1111411.1111431). Without any
    such point, the offsets are infinite.
    """
    import numpy as np

    line = np.arange(NODES_PER_CELL) / NODES_PER_CELL + SHIFT
    nodes = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1)
    value = surfaces._at(nodes.reshape(-1, 3)).reshape(nodes.shape[:3])
    offsets, least_squared = np.full(nodes.shape, np.inf), np.full(value.shape, np.inf)

    def keep_nearer(candidate: Floats) -> None:
        """Keep the candidates that are nearer than the offsets so far."""
        squared = np.einsum("...i,...i", candidate, candidate)
        better = squared < least_squared
        offsets[better], least_squared[better] = candidate[better], squared[better]

    for axis, step in enumerate(np.eye(3) / NODES_PER_CELL):
        next_value = np.roll(value, -1, axis=axis)
        crossed = (value < 0) != (next_value < 0)
        share = value[crossed] / (value[crossed] - next_value[crossed])
        foot, residual = surfaces._on_surface(nodes[crossed] + share[:, None] * step, NEWTON_STEPS)
        candidate = np.full(nodes.shape, np.inf)
        candidate[crossed] = np.where((np.abs(residual) < ZERO_TOLERANCE)[:, None], foot - nodes[crossed], np.inf)
        keep_nearer(candidate)
        keep_nearer(np.roll(candidate - step, 1, axis=axis))
    directions = [np.array(direction) for direction in itertools.product((-1, 0, 1), repeat=3) if any(direction)]
    for jump in JUMPS:
        for direction in directions:
            keep_nearer(np.roll(offsets, tuple(-jump * direction), axis=(0, 1, 2)) + jump * direction / NODES_PER_CELL)
    return offsets


def _unit(vectors: Floats) -> Floats:
    """Return vectors (N, 3) scaled to length 1."""
    import numpy as np

    unit_vectors: Floats = vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
    return unit_vectors


@dataclass(frozen=True, kw_only=True)
class Network(Cells):
    """One side of a periodic surface: solid where it is deepest, with one void around all of it.

    Its width is twice the distance of the void from the deepest places: the largest thickness.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    surfaces : Surfaces
    side : {1, -1}
        Where the value is above 0, or below.
    thinnest : float
        Density at which its bars break.
    """

    bars: ClassVar[bool] = True
    cells: ClassVar[int] = 1

    surfaces: Surfaces
    side: int = 1
    thinnest: float

    def distance(self, points: Floats) -> Floats:
        """Return the depth of the deepest point of a grid minus that of points (N, 3), in cells: (N,), in cells."""
        import numpy as np

        line = np.arange(DEEPEST) / DEEPEST
        grid = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        shortfall: Floats = self._depth(grid).max() - self._depth(np.asarray(points, dtype=np.float64))
        return shortfall

    def _depth(self, points: Floats) -> Floats:
        """Return the depth of points on the chosen side of the surfaces, in cells; negative on the other side."""
        return self.side * self.surfaces.distance(points)


class BinnedEdges(NamedTuple):
    """Edges, and for each of the equal cubes of a period those that may be the nearest to a point in it.

    Parameters
    ----------
    edges : (E, 2, 3) float64
        In periods.
    first : (n³ + 1,) int32
        Start of the edge numbers of each cube in `which`.
    which : (M,) int32
    """

    edges: Floats
    first: NDArray[np.int32]
    which: NDArray[np.int32]


@dataclass(frozen=True, kw_only=True)
class Bars(Cells):
    """Round bars along edges that repeat, with one void around all of them.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    edges : tuple of ((x, y, z), (x, y, z))
        In periods; each repeats along x, y and z.
    cells : int
        Number of cells along a period.
    """

    bars: ClassVar[bool] = True

    edges: tuple[tuple[tuple[float, float, float], tuple[float, float, float]], ...]
    cells: int = 1

    def axes(self) -> Floats:
        """Return the edges: (E, 2, 3), in periods."""
        import numpy as np

        return np.array(self.edges, dtype=np.float64)

    def around_cell(self) -> BinnedEdges:
        """Return the edges, and copies of them, that may be the nearest of some point in the unit cell.

        >>> from patterns import CubicBars
        >>> len(CubicBars().around_cell().edges)
        36
        """
        import numpy as np

        shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), dtype=np.float64)
        axes = self.axes()
        axes = axes - np.floor(axes.mean(axis=1, keepdims=True))  # move their middles into the unit cell
        edges = (axes[None] + shifts[:, None, None]).reshape(-1, 2, 3)
        reach = min(REACH, FURTHEST / self.cells)
        is_near = ((edges.max(axis=1) > -reach) & (edges.min(axis=1) < 1 + reach)).all(axis=1)
        edges = edges[is_near]
        bins = max(BINS, BINS_PER_CELL * self.cells)
        line = (np.arange(bins) + 0.5) / bins
        centres = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        edge_distance = np.sqrt([_squared_distance(centres, edge) for edge in edges])
        # An edge may be further from the centre than the nearest by twice the distance from the centre to a corner.
        is_close = edge_distance <= edge_distance.min(axis=0) + math.sqrt(3) / bins + ROUNDING
        is_used = is_close.any(axis=1)
        cube, edge_number = np.nonzero(is_close[is_used].T)
        first = np.searchsorted(cube, np.arange(len(centres) + 1))
        return BinnedEdges(edges=edges[is_used], first=first.astype(np.int32), which=edge_number.astype(np.int32))


def _squared_distance(points: Floats, edge: Floats) -> Floats:
    """Return the squared distance of points (N, 3) from an edge (2, 3)."""
    import numpy as np

    along, offset = edge[1] - edge[0], points - edge[0]
    share = np.clip(offset @ along / (along @ along), 0, 1)
    squared: Floats = ((offset - share[:, None] * along) ** 2).sum(axis=1)
    return squared


@dataclass(frozen=True, kw_only=True)
class Planes(Cells):
    """Walls along families of parallel planes that cross, and leave closed cells with flat faces.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    normals : tuple of (x, y, z)
        The planes of a family are those where normal . point + offset is a whole number; points are in cells.
    offsets : tuple of float
        0 for all of them unless given.
    upright : three rows of (x, y, z)
        Rotation from the part to the pattern.
    """

    cells: ClassVar[int] = 1

    normals: tuple[tuple[float, float, float], ...]
    offsets: tuple[float, ...] = ()
    upright: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

    @property
    def classes(self) -> int:
        """Number of classes of cells: cells of one class do not touch, not even at a corner."""
        return 1 << len(self.normals)

    def families(self) -> tuple[Floats, Floats]:
        """Return the normals (F, 3) and the offsets (F,)."""
        import numpy as np

        offsets = self.offsets or (0.0,) * len(self.normals)
        return np.array(self.normals, dtype=np.float64), np.array(offsets, dtype=np.float64)

    def distance(self, points: Floats) -> Floats:
        """Return the distance of points (N, 3), in cells, from the nearest plane: (N,), in cells.

        >>> from patterns import Cubic
        >>> import numpy as np
        >>> Cubic().distance(np.array([[0.5, 0.5, 0.5], [0.5, 0.1, 0.5]])).tolist()
        [0.5, 0.1]
        """
        nearest: Floats = abs(self._beside(points)[0]).min(axis=1)
        return nearest

    def depth(self, points: Floats, which: int) -> Floats:
        """Return the signed distance of points (N, 3) into the cells of a class, above 0 inside, all in cell lengths.

        Bit f of the number of a class is the side of the planes of family f on which its cells lie, alternately.
        Outside, a point may be further away than this.
        """
        import numpy as np

        plane_distance, slab = self._beside(points)
        bits = which >> np.arange(len(self.normals)) & 1
        inside_distance: Floats = np.where(slab % 2 == bits, plane_distance, -plane_distance).min(axis=1)
        return inside_distance

    def _beside(self, points: Floats) -> tuple[Floats, NDArray[np.int64]]:
        """Return the distance of points (N, 3) from the nearest plane of each family, and their slab: (N, F) each."""
        import numpy as np

        normals, offsets = self.families()
        level = np.asarray(points, dtype=np.float64) @ normals.T + offsets
        plane_distance: Floats = np.abs(level - np.round(level)) / np.linalg.norm(normals, axis=1)
        return plane_distance, np.floor(level).astype(np.int64)


Cellular = Surfaces | Planes | Polyhedra | Network | Bars
