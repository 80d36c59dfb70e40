"""Cubes that are split into eight where the skin of a part is near: an octree, small at the skin and large inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.cellular import Cells
from patterns.planes import ON_A_CORNER
from patterns.shared import levels_parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    Flags = NDArray[np.bool_]
    Floats = NDArray[np.float64]

DIAGONAL = 3**0.5  # of a cube, over its side
FLAT = 0.5**0.5  # cosine of 45 degrees: a roof that is steeper needs nothing below it
Rows = tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, kw_only=True)
class Octree(Cells):
    """Walls around cubes: the smallest have the side `cell`, larger ones twice, four times ... that.

    A cube is split into eight, down to the smallest, if the followed surface is nearer to its middle than half its
    side, or than half its diagonal if its middle is not inside the walls. Cubes that touch, even only at a corner,
    differ by one level at most.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    roofs : bool
        Whether it follows only surfaces above, flatter than 45 degrees, not the entire inner side of the walls.
    upright : three rows of (x, y, z)
        Rotation from the part to the pattern.
    levels : int
        Most doublings of a cube.
    """

    repeats: ClassVar[bool] = False

    roofs: bool = False
    upright: Rows = ON_A_CORNER
    levels: int = levels_parameter()

    @property
    def cells(self) -> int:
        """Number of smallest cubes along the largest."""
        return 1 << self.levels

    @property
    def middle(self) -> int:
        """Origin of the pattern, along each axis, in smallest cubes from a corner of a largest one.

        In the middle of a cube of twice the side of the smallest, and far from the faces of all larger ones.
        """
        return round(self.cells / 3)


@dataclass(frozen=True, kw_only=True)
class AdaptiveCubic(Octree):
    """Cubes that are small at the walls."""

    paths: ClassVar[bool] = True

    name: str = "adaptive-cubic"
    summary: str = "cubes on their corners, small at the walls and large inside: light where little is needed"


@dataclass(frozen=True, kw_only=True)
class SupportCubic(Octree):
    """Cubes that are small below roofs."""

    paths: ClassVar[bool] = True

    name: str = "support-cubic"
    summary: str = "cubes on their corners, small below roofs and large elsewhere: carries tops, and little else"
    roofs: bool = True


def divide_cubes(
    pattern: Octree, ends: Floats, side: float, look: Callable[[Floats, float], tuple[Floats, Flags]]
) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """Divide a box into cubes, split as `Octree` says; return their levels, as `cube_levels`, and the lowest number.

    Parameters
    ----------
    pattern : Octree
    ends : (N, 3) float64
        Corners of the box, in smallest cubes.
    side : float
        Of the smallest cubes, in the unit of distances.
    look : callable
        Takes places, (M, 3), in smallest cubes, and the farthest distance that counts; returns the distances of the
        followed surface, (M,), and which places are inside the walls, (M,).

    Returns
    -------
    levels : (n, m, k) uint8
    corner : (3,) int64
        Number of the lowest cube along each axis.
    """
    import numpy as np

    period = pattern.cells
    corner = (np.floor((ends.min(axis=0) - 1) / period) * period).astype(np.int64)
    counts = (np.floor((ends.max(axis=0) + 1) / period) * period).astype(np.int64) + period - corner
    unsplit = []
    for level in range(1, pattern.levels + 1):
        size = 1 << level
        shape = tuple((counts // size).tolist())
        middles = np.indices(shape).reshape(3, -1).T * size + size / 2 + corner
        reach = size / 2 * side
        distances, inside = look(middles, DIAGONAL * reach)
        unsplit.append((distances >= np.where(inside, reach, DIAGONAL * reach)).reshape(shape))
    return cube_levels(unsplit), corner


def cube_levels(whole: Sequence[Flags]) -> NDArray[np.uint8]:
    """Return the level of the cube that contains each smallest cube, (n, m, k): its number of doublings.

    Parameters
    ----------
    whole : sequence of (n / 2**level, m / 2**level, k / 2**level) bool
        For each level from 1 on, the cubes that need not be split for the followed surface.

    Notes
    -----
    From the smallest upwards: eight cubes become a single one if neither they nor the 56 cubes of their size around
    them are split. So no cube touches one less than half as large.

    >>> import numpy as np
    >>> fine, coarse = np.ones((6, 2, 2), dtype=bool), np.ones((3, 1, 1), dtype=bool)
    >>> fine[0] = coarse[0] = False
    >>> cube_levels([fine, coarse])[:, 0, 0].tolist()
    [0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2]
    """
    import numpy as np

    levels = np.zeros(tuple(2 * n for n in whole[0].shape), dtype=np.uint8)
    unsplit = np.ones(levels.shape, dtype=bool)
    for level, allowed in enumerate(whole, start=1):
        unsplit = np.pad(unsplit, 1, constant_values=True)
        for axis in range(3):
            moved = np.moveaxis(unsplit, axis, 0)
            unsplit = np.moveaxis(moved[:-3:2] & moved[1:-2:2] & moved[2:-1:2] & moved[3::2], 0, axis)
        unsplit &= allowed
        covered = unsplit
        for axis in range(3):
            covered = covered.repeat(1 << level, axis=axis)
        levels[covered] = level
    return levels
