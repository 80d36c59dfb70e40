"""Patterns that repeat in space: walls along a minimal surface or planes, one side of it, or bars along edges.

They are given for one unit cell, of side 1, that repeats along x, y and z; whoever fills a part scales and turns it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from patterns.polyhedra import Polyhedra

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

STEPS, AGAIN = 3, 2  # of Newton's method, from near the surface to it, and from nearer
SHEET, SHIFT = 40, 0.0093  # nodes along a cell, between which the surface is looked for; where they begin
JUMPS = (16, 8, 4, 2, 1, 1)  # nodes away, where others are asked: half a cell at first, the next ones twice
ROUNDS = 3  # in which the point of the surface that is nearest is looked for
NEAR = 1e-3  # values that count as 0
DIFFERENCE = 1e-6  # of a cell, for slopes
LONGEST, MOVED = 0.2, 2e-3  # steps, in cells: the longest, and what changes nothing
STEEPEST = 0.5  # of a cell: distances beyond this are cut off
REACH = 0.8  # of a period: further from the unit cell, no bar is the nearest of any point in it
FURTHEST = 1.5  # cells: nor is one this far
DEEPEST = 48  # points along a cell, among which the deepest is looked for
ROUNDING = 1e-9
BINS, BINS_PER_CELL = 12, 6  # along a period, in each of which the edges that may be the nearest are known, at least


@dataclass(frozen=True, kw_only=True)
class Surfaces:
    """Walls along a surface that repeats, with void on both sides: a sheet.

    Parameters
    ----------
    name, summary : str
    value : callable
        Takes x, y and z, of one shape, in radians: 2 pi is a cell. Its zeros are the surface.
    """

    bars: ClassVar[bool] = False
    cells: ClassVar[int] = 1

    name: str
    summary: str
    value: Callable[[Floats, Floats, Floats], Floats]

    def distance(self, points: Floats) -> Floats:
        """Return how far points (N, 3), in cells, lie from the surface: (N,) in cells, above 0 where the value is.

        Cut off half a cell away from it. From the nearest of many points of the surface, the nearest of all is near.

        >>> from patterns.tpms import SCHWARZ_P
        >>> import numpy as np
        >>> SCHWARZ_P.distance(np.array([[0.25, 0.25, 0.25], [0.25, 0.25, 0.26]])).round(3).tolist()
        [0.0, -0.006]
        """
        import numpy as np

        points = np.asarray(points, dtype=np.float64)
        foot = points + self._towards(points)
        away = np.minimum(np.linalg.norm(points - foot, axis=1), STEEPEST)
        some = np.flatnonzero(away < STEEPEST)
        foot = foot[some]
        for _ in range(ROUNDS):
            # To where the plane across the slope at the foot is nearest to the point, and back to the surface.
            beside, normal = points[some] - foot, _unit(self._slope(foot, self._at(foot)))
            across = beside - (beside * normal).sum(axis=1, keepdims=True) * normal
            moving = np.linalg.norm(across, axis=1) > MOVED
            some, foot = some[moving], foot[moving]
            foot, value = self._on_surface(foot + across[moving], AGAIN)
            there = np.linalg.norm(points[some] - foot, axis=1)
            away[some] = np.where(np.abs(value) < NEAR, np.minimum(away[some], there), away[some])
        signed: Floats = np.where(self._at(points) < 0, -1.0, 1.0) * away
        return signed

    def _towards(self, points: Floats) -> Floats:
        """Return the way from points (N, 3) to the nearest of those that the nodes around them know, (N, 3)."""
        import numpy as np

        ways, places = feet_of(self), (points - SHIFT) * SHEET
        low = np.floor(places).astype(np.int64)
        best = np.full(points.shape, np.inf)
        for corner in itertools.product((0, 1), repeat=3):
            node = low + corner
            way = ways[tuple((node % SHEET).T)] + (node - places) / SHEET
            nearer = (way**2).sum(axis=1) < (best**2).sum(axis=1)
            best[nearer] = way[nearer]
        return best

    def _on_surface(self, points: Floats, steps: int) -> tuple[Floats, Floats]:
        """Return points (N, 3) moved to the surface by Newton's method, and what values are left there."""
        import numpy as np

        foot, value = points.copy(), self._at(points)
        for _ in range(steps):
            slope = self._slope(foot, value)
            step = (value / np.maximum((slope**2).sum(axis=1), 1e-12))[:, None] * slope
            far = np.linalg.norm(step, axis=1, keepdims=True)
            foot -= step * np.minimum(1, LONGEST / np.maximum(far, 1e-12))
            value = self._at(foot)
        return foot, value

    def _at(self, points: Floats) -> Floats:
        import numpy as np

        x, y, z = (2 * np.pi * points).T
        found: Floats = self.value(x, y, z)
        return found

    def _slope(self, points: Floats, value: Floats) -> Floats:
        """Return how the value at points (N, 3), which is known, changes along x, y and z: (N, 3)."""
        import numpy as np

        out = np.empty_like(points)
        for axis, step in enumerate(DIFFERENCE * np.eye(3)):
            out[:, axis] = (self._at(points + step) - value) / DIFFERENCE
        return out


@cache
def feet_of(surfaces: Surfaces) -> Floats:
    """Return the way from each node of a period to about the nearest point of the surface, (n, n, n, 3), in cells.

    Where the value changes sign between two nodes, there is such a point; from these on, nodes ask others further and
    nearer away for theirs: jump flooding (Rong and Tan 2006, doi:10.1145/1111411.1111431). Infinite if there is none.
    """
    import numpy as np

    line = np.arange(SHEET) / SHEET + SHIFT
    nodes = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1)
    value = surfaces._at(nodes.reshape(-1, 3)).reshape(nodes.shape[:3])
    ways, least = np.full(nodes.shape, np.inf), np.full(value.shape, np.inf)

    def nearer(found: Floats) -> None:
        squared = np.einsum("...i,...i", found, found)
        better = squared < least
        ways[better], least[better] = found[better], squared[better]

    for axis, step in enumerate(np.eye(3) / SHEET):
        beyond = np.roll(value, -1, axis=axis)
        crossed = (value < 0) != (beyond < 0)
        share = value[crossed] / (value[crossed] - beyond[crossed])
        foot, left = surfaces._on_surface(nodes[crossed] + share[:, None] * step, STEPS)
        found = np.full(nodes.shape, np.inf)
        found[crossed] = np.where((np.abs(left) < NEAR)[:, None], foot - nodes[crossed], np.inf)
        nearer(found)
        nearer(np.roll(found - step, 1, axis=axis))
    around = [np.array(each) for each in itertools.product((-1, 0, 1), repeat=3) if any(each)]
    for jump in JUMPS:
        for each in around:
            nearer(np.roll(ways, tuple(-jump * each), axis=(0, 1, 2)) + jump * each / SHEET)
    return ways


def _unit(vectors: Floats) -> Floats:
    import numpy as np

    found: Floats = vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
    return found


@dataclass(frozen=True, kw_only=True)
class Network:
    """One side of a surface that repeats: solid where it is deepest, with one void around all of it.

    What is called its width is twice how far the void is from the deepest places: how thick it is where it is thickest.

    Parameters
    ----------
    name, summary : str
    surfaces : Surfaces
    side : {1, -1}
        Where the value is above 0, or below.
    thinnest : float
        Density at which its bars break.
    """

    bars: ClassVar[bool] = True
    cells: ClassVar[int] = 1

    name: str
    summary: str
    surfaces: Surfaces
    side: int
    thinnest: float

    def distance(self, points: Floats) -> Floats:
        """Return how much less deep points (N, 3), in cells, lie than the deepest of a grid: (N,), in cells."""
        import numpy as np

        line = np.arange(DEEPEST) / DEEPEST
        grid = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        found: Floats = self._deep(grid).max() - self._deep(np.asarray(points, dtype=np.float64))
        return found

    def _deep(self, points: Floats) -> Floats:
        return self.side * self.surfaces.distance(points)


class Binned(NamedTuple):
    """Edges, and which of them may be the nearest of a point in each of equal cubes that make up a period.

    Parameters
    ----------
    edges : (E, 2, 3) float64
        In periods.
    first : (n³ + 1,) int32
        Where the numbers of the edges of each cube begin.
    which : (M,) int32
    """

    edges: Floats
    first: NDArray[np.int32]
    which: NDArray[np.int32]


@dataclass(frozen=True, kw_only=True)
class Bars:
    """Round bars along edges that repeat, with one void around all of them.

    Parameters
    ----------
    name, summary : str
    edges : tuple of ((x, y, z), (x, y, z))
        In periods; each repeats along x, y and z.
    cells : int
        How many cells lie along a period.
    """

    bars: ClassVar[bool] = True

    name: str
    summary: str
    edges: tuple[tuple[tuple[float, float, float], tuple[float, float, float]], ...]
    cells: int = 1

    def axes(self) -> Floats:
        """Return the edges: (E, 2, 3), in periods."""
        import numpy as np

        return np.array(self.edges, dtype=np.float64)

    def around_cell(self) -> Binned:
        """Return the edges, and copies of them, that may be the nearest of some point in the unit cell.

        >>> from patterns.struts import CUBIC
        >>> len(CUBIC.around_cell().edges)
        36
        """
        import numpy as np

        shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), dtype=np.float64)
        axes = self.axes()
        axes = axes - np.floor(axes.mean(axis=1, keepdims=True))  # to where their middles lie in the unit cell
        every = (axes[None] + shifts[:, None, None]).reshape(-1, 2, 3)
        reach = min(REACH, FURTHEST / self.cells)
        near = ((every.max(axis=1) > -reach) & (every.min(axis=1) < 1 + reach)).all(axis=1)
        every = every[near]
        bins = max(BINS, BINS_PER_CELL * self.cells)
        line = (np.arange(bins) + 0.5) / bins
        centres = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        away = np.sqrt([_squared(centres, edge) for edge in every])
        # From the centre to a corner of a cube, and once more as much, may speak for an edge further away.
        close = away <= away.min(axis=0) + math.sqrt(3) / bins + ROUNDING
        used = close.any(axis=1)
        cube, which = np.nonzero(close[used].T)
        first = np.searchsorted(cube, np.arange(len(centres) + 1))
        return Binned(edges=every[used], first=first.astype(np.int32), which=which.astype(np.int32))


def _squared(points: Floats, edge: Floats) -> Floats:
    """Return the squared distance of points (N, 3) from an edge (2, 3)."""
    import numpy as np

    along, beside = edge[1] - edge[0], points - edge[0]
    share = np.clip(beside @ along / (along @ along), 0, 1)
    found: Floats = ((beside - share[:, None] * along) ** 2).sum(axis=1)
    return found


@dataclass(frozen=True, kw_only=True)
class Planes:
    """Walls along families of parallel planes that cross, and leave closed cells with flat faces.

    Parameters
    ----------
    name, summary : str
    normals : tuple of (x, y, z)
        The planes of a family are those where normal . point + offset is a whole number; points are in cells.
    offsets : tuple of float
        0 for all of them unless given.
    upright : three rows of (x, y, z)
        How the pattern stands in a part: a rotation from the part to the pattern.
    """

    bars: ClassVar[bool] = False
    cells: ClassVar[int] = 1

    name: str
    summary: str
    normals: tuple[tuple[float, float, float], ...]
    offsets: tuple[float, ...] = ()
    upright: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

    @property
    def classes(self) -> int:
        """How many classes of cells there are: cells of one class do not touch, not even at a corner."""
        return 1 << len(self.normals)

    def families(self) -> tuple[Floats, Floats]:
        """Return the normals (F, 3) and the offsets (F,)."""
        import numpy as np

        offsets = self.offsets or (0.0,) * len(self.normals)
        return np.array(self.normals, dtype=np.float64), np.array(offsets, dtype=np.float64)

    def distance(self, points: Floats) -> Floats:
        """Return how far points (N, 3), in cells, lie from the nearest plane: (N,), in cells.

        >>> from patterns.planes import CUBIC
        >>> import numpy as np
        >>> CUBIC.distance(np.array([[0.5, 0.5, 0.5], [0.5, 0.1, 0.5]])).tolist()
        [0.5, 0.1]
        """
        found: Floats = abs(self._beside(points)[0]).min(axis=1)
        return found

    def depth(self, points: Floats, which: int) -> Floats:
        """Return how deep points (N, 3), in cells, lie in the cells of a class: (N,) in cells, below 0 outside.

        Bit f of the number of a class says on which side of the planes of family f its cells lie, in turn. Outside,
        a point may be further away than this.
        """
        import numpy as np

        away, slab = self._beside(points)
        bits = which >> np.arange(len(self.normals)) & 1
        found: Floats = np.where(slab % 2 == bits, away, -away).min(axis=1)
        return found

    def _beside(self, points: Floats) -> tuple[Floats, NDArray[np.int64]]:
        """Return how far points (N, 3) lie from the nearest plane of each family, and between which: (N, F) each."""
        import numpy as np

        normals, offsets = self.families()
        at = np.asarray(points, dtype=np.float64) @ normals.T + offsets
        away: Floats = np.abs(at - np.round(at)) / np.linalg.norm(normals, axis=1)
        return away, np.floor(at).astype(np.int64)


Cellular = Surfaces | Planes | Polyhedra | Network | Bars
