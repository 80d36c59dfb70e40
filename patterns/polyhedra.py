"""Walls around congruent closed cells that fill space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.cellular import Cells

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Polyhedra(Cells):
    """Walls around shifted copies of one polyhedron, whose faces are parallel in pairs.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    normals : tuple of (x, y, z)
        Unit vectors, one for each pair of faces.
    halves : tuple of float
        Distance of the faces of each pair from the middle, in cells.
    period : (x, y, z)
        The sides of a box that repeats, in cells; a polyhedron fits into it.
    middles : tuple of tuple of (x, y, z)
        Middles of the polyhedra of each class in the box, the same number in every class, in cells. Polyhedra of one
        class do not touch, not even at a corner.
    """

    cells: ClassVar[int] = 1

    normals: tuple[Vector, ...] = ()
    halves: tuple[float, ...] = ()
    period: Vector = (1.0, 1.0, 1.0)
    middles: tuple[tuple[Vector, ...], ...] = ()

    @property
    def classes(self) -> int:
        """Number of classes of cells."""
        return len(self.lattice()[1])

    def faces(self) -> tuple[Floats, Floats]:
        """Return the normals (F, 3), and the distances of the faces from the middle (F,), in cells."""
        import numpy as np

        return np.array(self.normals, dtype=np.float64), np.array(self.halves, dtype=np.float64)

    def lattice(self) -> tuple[Floats, Floats]:
        """Return the period (3,), and the middles of each class (C, K, 3), in cells."""
        import numpy as np

        return np.array(self.period, dtype=np.float64), np.array(self.middles, dtype=np.float64)

    def distance(self, points: Floats) -> Floats:
        """Return the distance of points (N, 3), in cells, from the nearest wall: (N,), in cells.

        >>> from patterns import Honeycomb3D
        >>> import numpy as np
        >>> Honeycomb3D().distance(np.array([[0.0, 0.0, 0.0], [0.5, 0.1, 0.0]])).round(3).tolist()
        [0.433, 0.0]
        """
        import numpy as np

        nearest: Floats = np.max([self.depth(points, which) for which in range(self.classes)], axis=0)
        return nearest

    def depth(self, points: Floats, which: int) -> Floats:
        """Return the depth of points (N, 3), in cells, in the polyhedra of a class: (N,) in cells, below 0 outside.

        Outside, a point may be further away than this.
        """
        import numpy as np

        points = np.asarray(points, dtype=np.float64)
        (normals, halves), (period, middles) = self.faces(), self.lattice()
        deepest = np.full(len(points), -np.inf)
        for middle in middles[which]:
            offset = points - middle
            offset = offset - period * np.floor(offset / period + 0.5)
            deepest = np.maximum(deepest, (halves - np.abs(offset @ normals.T)).min(axis=1))
        return deepest
