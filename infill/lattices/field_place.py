"""The inside of a part as the place of a field: its box, and how deep a point lies below the skin."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import Interior

LEAST_SHARE = 0.5  # of a layer of cells that lies in the part
MOST_CELLS = 2e6  # in which the distance from the skin is measured


@dataclass(frozen=True, kw_only=True, eq=False)
class InteriorPlace:
    """The inside of a part."""

    space: Interior

    @property
    def bounds(self) -> Floats:
        """The box around the part, (2, 3), mm."""
        return np.asarray(self.space.part.bounds, dtype=np.float64)

    @cached_property
    def _skin_distances(self) -> tuple[NDArray[np.float32], int, int, int]:
        """Distance from the skin in cells a stride apart; the stride, the lowest layer, and those added below it."""
        from scipy.ndimage import distance_transform_edt

        space = self.space
        stride = max(1, int(np.ceil((space.depth.size / MOST_CELLS) ** (1 / 3))))
        # Beyond an open side there is neither wall nor part, so no point is nearest to cells there.
        layers = np.flatnonzero(space.layer_shares >= LEAST_SHARE)
        bottom, top = int(layers[0]), int(layers[-1]) + 1
        inside = space.depth[::stride, ::stride, bottom:top:stride] > 0
        opening = space.opening
        ends = (1, 1) if opening is None else (int(np.isinf(opening.low)), int(np.isinf(opening.high)))
        distance = distance_transform_edt(np.pad(inside, ((1, 1), (1, 1), ends))).astype(np.float32)
        return distance, stride, bottom, ends[0]

    def skin_depth(self, points: Floats) -> Floats:
        """Return the depth of points (N, 3) below the inner side of the walls, in cells of the grid: (N,)."""
        from scipy.ndimage import map_coordinates

        (distance, stride, bottom, below), space = self._skin_distances, self.space
        nodes = ((points - space.origin) / space.size - (0, 0, bottom)).T / stride + np.array([[1], [1], [below]])
        depths: Floats = map_coordinates(distance, nodes, order=1, mode="nearest")
        return depths
