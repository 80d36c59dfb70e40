"""The requested density of a filled part, at every point of it, where it is graded or has regions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats

if TYPE_CHECKING:
    from infill.lattices.voids import Layout


@dataclass(frozen=True, kw_only=True, eq=False)
class DensityMap:
    """A requested density at the nodes of a grid, linear in between.

    Parameters
    ----------
    shares : (n, m, k) float32
    origin : (3,) float64, mm
        The first node.
    step : float
        Distance of the nodes, mm.
    lowest, highest : float
        Inside the walls.
    """

    shares: NDArray[np.float32]
    origin: Floats
    step: float
    lowest: float
    highest: float

    @classmethod
    def of(cls, layout: Layout) -> DensityMap | None:
        """Return the densities of a layout; None if it has the same everywhere."""
        local = layout.local
        if local is None:
            return None
        inside = local.shares[local.within]
        return cls(
            shares=local.shares,
            origin=np.asarray(layout.space.origin, dtype=np.float64),
            step=local.step * layout.space.size,
            lowest=float(inside.min()),
            highest=float(inside.max()),
        )

    def at(self, points: NDArray[np.floating]) -> Floats:
        """Return the density at points (N, 3), mm, within the lowest and the highest: (N,)."""
        from scipy.ndimage import map_coordinates

        nodes = ((np.asarray(points, dtype=np.float64) - self.origin) / self.step).T
        shares = map_coordinates(self.shares, nodes, order=1, mode="nearest", output=np.float64)
        return np.clip(shares, self.lowest, self.highest)
