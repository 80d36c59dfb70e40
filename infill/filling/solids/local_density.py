"""How dense a filled part is where about as much was asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.filling.solids.grading import Local
from infill.filling.solids.space import Space
from infill.surface import Surface
from infill.voxels.scanlines import crossings, filled

SAMPLES = 200_000  # cells
Floats = NDArray[np.float64]


def densities_by_share(space: Space, voids: Surface, local: Local, count: int, *, mean: float) -> tuple[Floats, Floats]:
    """Return what was asked for on average, and what is there, in equal numbers of cells drawn by chance: (count,).

    Whether the centre of a cell is solid is asked of the meshes of the voids. Along the walls, more centres or fewer
    are in than volume is, as the grid happens to lie: so voids are scaled to leave the mean density.
    """
    corners, shape = (np.asarray(voids.vertices, dtype=np.float64) - space.origin) / space.size, space.depth.shape
    void = filled(crossings(corners, voids.faces, shape), shape)
    inside = np.argwhere(space.within)
    cells = inside[np.random.default_rng(0).integers(len(inside), size=SAMPLES)]
    shares, solid = _between(local.shares, cells / local.step), ~void[tuple(cells.T)]
    order = np.array_split(np.argsort(shares), count)
    larger = (1 - mean) / max(1 - float(solid.mean()), 1e-9)
    return (
        np.array([shares[each].mean() for each in order]),
        np.array([1 - larger * (1 - solid[each].mean()) for each in order]),
    )


def _between(nodes: NDArray[np.float32], at: Floats) -> Floats:
    """Return the values between nodes, straight."""
    from scipy.ndimage import map_coordinates

    found: Floats = map_coordinates(nodes.astype(np.float64), at.T, order=1, mode="nearest")
    return found
