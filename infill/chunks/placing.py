"""Points of chunks in space, each by itself."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume


def place_points(points: NDArray[np.float64], place: Volume) -> NDArray[np.float64]:
    """Convert points as `infill.Volume.place` does, each by itself, so that the result does not depend on others."""
    turn, origin = np.asarray(place.direction), np.array(place.origin)
    if (turn == np.eye(3)).all():
        return place.place(points)
    x, y, z = points.T
    return np.stack(
        [(x * turn[axis, 0] + y * turn[axis, 1] + z * turn[axis, 2]) + origin[axis] for axis in range(3)], 1
    )
