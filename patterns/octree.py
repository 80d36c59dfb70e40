"""Cubes that are split into eight where the skin of a part is near: an octree, small at the skin and large inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import check_parameters, parameter
from patterns.planes import ON_A_CORNER

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    Flags = NDArray[np.bool_]

Rows = tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, kw_only=True)
class Octree:
    """Walls around cubes, of which the larger have sides twice, four times ... those of the smallest: `cell`.

    A cube is split into eight, down to the smallest, as long as what the pattern follows comes nearer to its middle
    than half its side, or than half its diagonal, if its middle is not inside the walls. Cubes that touch, if only at a
    corner, differ by one level at most.

    Parameters
    ----------
    name, summary : str
    roofs : bool
        Whether it follows only what is above, flatter than 45 degrees, and not all of the inner side of the walls.
    upright : three rows of (x, y, z)
        How the pattern stands in a part: a rotation from the part to the pattern.
    levels : int
        How often a cube may be larger by twice.
    """

    bars: ClassVar[bool] = False

    name: str
    summary: str
    roofs: bool = False
    upright: Rows = ON_A_CORNER
    levels: int = parameter(
        2, "how often cubes are doubled where they may be larger", unit="", low=1, high=4, whole=True
    )

    def __post_init__(self) -> None:
        """Check the parameters."""
        check_parameters(self)

    @property
    def cells(self) -> int:
        """How many of the smallest cubes lie along the largest."""
        return 1 << self.levels

    @property
    def middle(self) -> int:
        """Where the pattern begins, along each axis, in the smallest cubes from a corner of one of the largest.

        In the middle of a cube of twice the side of the smallest, and far from the faces of all larger ones.
        """
        return round(self.cells / 3)


def doubled(whole: Sequence[Flags]) -> NDArray[np.uint8]:
    """Return how often the cube is doubled in which each of the smallest ones lies, (n, m, k).

    Parameters
    ----------
    whole : sequence of (n / 2**level, m / 2**level, k / 2**level) bool
        For each level from 1 on, which cubes need not be split for what the pattern follows.

    Notes
    -----
    From the smallest upwards: eight cubes become one that is whole, if neither they nor the 56 of their size around
    them are split themselves. So no cube touches one less than half as large.

    >>> import numpy as np
    >>> fine, coarse = np.ones((6, 2, 2), dtype=bool), np.ones((3, 1, 1), dtype=bool)
    >>> fine[0] = coarse[0] = False
    >>> doubled([fine, coarse])[:, 0, 0].tolist()
    [0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2]
    """
    import numpy as np

    found = np.zeros(tuple(2 * n for n in whole[0].shape), dtype=np.uint8)
    free = np.ones(found.shape, dtype=bool)
    for level, own in enumerate(whole, start=1):
        free = np.pad(free, 1, constant_values=True)
        for axis in range(3):
            along = np.moveaxis(free, axis, 0)
            free = np.moveaxis(along[:-3:2] & along[1:-2:2] & along[2:-1:2] & along[3::2], 0, axis)
        free &= own
        fine = free
        for axis in range(3):
            fine = fine.repeat(1 << level, axis=axis)
        found[fine] = level
    return found


ADAPTIVE_CUBIC = Octree(
    name="adaptive-cubic",
    summary="cubes on their corners, small at the walls and large inside: light where little is needed",
)
SUPPORT_CUBIC = Octree(
    name="support-cubic",
    summary="cubes on their corners, small below roofs and large elsewhere: carries tops, and little else",
    roofs=True,
)

OCTREES = (ADAPTIVE_CUBIC, SUPPORT_CUBIC)
