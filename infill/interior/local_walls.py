"""Walls whose thickness differs in places: the depth below a wall that changes at the border of a place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume


@dataclass(frozen=True, kw_only=True, eq=False)
class LocalWall:
    """A place with a wall of its own.

    Parameters
    ----------
    wall : float
        mm
    measure : callable
        Returns the distance of the centre of each cell of a volume from the border of the place, (nx, ny, nz) float32
        in cells, positive inside, from the volume and the distance at which it may be cut off.
    """

    wall: float
    measure: Callable[[Volume, float], NDArray[np.float32]]


def subtract_walls(
    depth: NDArray[np.float32], cells: Volume, wall: float, places: Sequence[LocalWall], reach: float
) -> NDArray[np.float32]:
    """Turn the depth below a skin into that below its walls, in cells; later places lie over earlier ones.

    Parameters
    ----------
    depth : (nx, ny, nz) float32
        Below the skin, in cells; it is overwritten.
    cells : Volume
        The grid.
    wall : float
        mm, where no place has another.
    places : sequence of LocalWall
    reach : float
        Cells within which depths are exact on either side of a wall.

    Notes
    -----
    With f and g the depths below the walls outside and inside, and s the distance into the place, the depth is
    max(min(f, g), min(f, -s), min(g, s)): f where s < 0 and g where s > 0, and nowhere steeper than one of the three.
    A border is therefore a step, whose face is the border itself.
    """
    size = float(cells.cell_size[0])
    if not places:
        depth -= np.float32(wall / size)
        return depth
    below = depth - np.float32(wall / size)
    for place in places:
        inside, own = place.measure(cells, reach), depth - np.float32(place.wall / size)
        joined = np.minimum(below, own)
        np.maximum(joined, np.minimum(own, inside, out=own), out=joined)
        np.maximum(joined, np.minimum(below, np.negative(inside, out=inside), out=below), out=joined)
        below = joined
    return below
