"""Cubes that are split into eight where the skin of a part is near: an octree, small at the skin and large inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import check_parameters, parameter
from patterns.planes import ON_A_CORNER

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Flags = NDArray[np.bool_]

Rows = tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, kw_only=True)
class Octree:
    """Walls around cubes, of which the larger have sides twice, four times ... those of the smallest: `cell`.

    A cube is split into eight as long as what the pattern follows runs through it, and it is not one of the smallest.
    Cubes that touch, if only at a corner, differ by one level at most.

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


def doubled(followed: Flags, levels: int) -> NDArray[np.uint8]:
    """Return how often the cube is doubled in which each of the smallest ones lies, (n, m, k).

    Parameters
    ----------
    followed : (n, m, k) bool
        The smallest cubes through which it runs what the pattern follows; n, m and k are multiples of 2**levels.
    levels : int

    Notes
    -----
    From the smallest upwards: eight cubes become one, if nothing runs through them, and neither they nor the 56 of
    their size around them are split themselves. So no cube touches one less than half as large.

    >>> import numpy as np
    >>> doubled(np.arange(12).reshape(12, 1, 1).repeat(4, 1).repeat(4, 2) == 0, 2)[:, 0, 0].tolist()
    [0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2]
    """
    import numpy as np

    whole, free = ~followed, np.ones_like(followed)
    found = np.zeros(followed.shape, dtype=np.uint8)
    for level in range(1, levels + 1):
        around = np.pad(free, 1, constant_values=True)
        for axis in range(3):
            along = np.moveaxis(whole, axis, 0)
            whole = np.moveaxis(along[::2] & along[1::2], 0, axis)
            along = np.moveaxis(around, axis, 0)
            around = np.moveaxis(along[:-3:2] & along[1:-2:2] & along[2:-1:2] & along[3::2], 0, axis)
        free = whole & around
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
