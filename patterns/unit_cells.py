"""Patterns that repeat in space: walls along a minimal surface, or round bars along the edges of a unit cell.

Both are given for one unit cell, of side 1, that repeats along x, y and z; whoever fills a part scales and turns it.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

STEPS, AGAIN = 5, 2  # of Newton's method, from a point to the surface, and from near it
ROUNDS = 8  # in which the point of the surface that is nearest is looked for
NEAR = 1e-3  # values that count as 0
DIFFERENCE = 1e-6  # of a cell, for slopes
LONGEST, MOVED = 0.2, 2e-3  # steps, in cells: the longest, and what changes nothing
STEEPEST = 0.5  # of a cell: distances beyond this are cut off
REACH = 0.8  # of a cell: further from the unit cell, no bar is the nearest of any point in it
SAMPLES, TIE = 24, 1e-12  # points along a cell that are looked at, and what counts as equally near


@dataclass(frozen=True, kw_only=True)
class Surfaces:
    """Walls along a surface that repeats, with void on both sides: a sheet.

    Parameters
    ----------
    name, summary : str
    value : callable
        Takes x, y and z, of one shape, in radians: 2 pi is a cell. Its zeros are the surface.
    """

    name: str
    summary: str
    value: Callable[[Floats, Floats, Floats], Floats]

    def distance(self, points: Floats) -> Floats:
        """Return how far points (N, 3), in cells, lie from the surface: (N,) in cells, above 0 where the value is.

        Cut off half a cell away from it. The nearest point is found where no other sheet comes between.

        >>> from patterns.tpms import SCHWARZ_P
        >>> import numpy as np
        >>> SCHWARZ_P.distance(np.array([[0.25, 0.25, 0.25], [0.25, 0.25, 0.26]])).round(3).tolist()
        [0.0, -0.006]
        """
        import numpy as np

        points = np.asarray(points, dtype=np.float64)
        foot, value = self._on_surface(points, STEPS)
        away = np.linalg.norm(points - foot, axis=1)
        some = np.arange(len(points))
        for _ in range(ROUNDS):
            # To where the plane across the slope at the foot is nearest to the point, and back to the surface.
            beside, normal = points[some] - foot, _unit(self._slope(foot, value))
            across = beside - (beside * normal).sum(axis=1, keepdims=True) * normal
            moving = np.linalg.norm(across, axis=1) > MOVED
            some, foot, across = some[moving], foot[moving], across[moving]
            foot, value = self._on_surface(foot + across, AGAIN)
            there = np.linalg.norm(points[some] - foot, axis=1)
            away[some] = np.where(np.abs(value) < NEAR, np.minimum(away[some], there), away[some])
        signed: Floats = np.where(self._at(points) < 0, -1.0, 1.0) * np.minimum(away, STEEPEST)
        return signed

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


def _unit(vectors: Floats) -> Floats:
    import numpy as np

    found: Floats = vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
    return found


@dataclass(frozen=True, kw_only=True)
class Bars:
    """Round bars along edges that repeat, with one void around all of them.

    Parameters
    ----------
    name, summary : str
    edges : tuple of ((x, y, z), (x, y, z))
        In cells; each repeats along x, y and z.
    """

    name: str
    summary: str
    edges: tuple[tuple[tuple[float, float, float], tuple[float, float, float]], ...]

    def around_cell(self) -> Floats:
        """Return the edges, and copies of them, that are the nearest of some point in the unit cell: (E, 2, 3).

        >>> from patterns.struts import CUBIC
        >>> len(CUBIC.around_cell())
        12
        """
        import numpy as np

        shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), dtype=np.float64)
        every = (np.array(self.edges)[None] + shifts[:, None, None]).reshape(-1, 2, 3)
        near = ((every.max(axis=1) > -REACH) & (every.min(axis=1) < 1 + REACH)).all(axis=1)
        every = every[near]
        line = (np.arange(SAMPLES) + 0.5) / SAMPLES
        points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        nearest, which = np.full(len(points), np.inf), np.zeros(len(points), dtype=np.intp)
        for number, edge in enumerate(every):
            away = _squared(points, edge)
            nearer = away < nearest - TIE
            nearest[nearer], which[nearer] = away[nearer], number
        chosen: Floats = every[np.unique(which)]
        return chosen


def _squared(points: Floats, edge: Floats) -> Floats:
    """Return the squared distance of points (N, 3) from an edge (2, 3)."""
    import numpy as np

    along, beside = edge[1] - edge[0], points - edge[0]
    share = np.clip(beside @ along / (along @ along), 0, 1)
    found: Floats = ((beside - share[:, None] * along) ** 2).sum(axis=1)
    return found


Cellular = Surfaces | Bars
