"""How dense a filled part is where about as much was asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import Space
from infill.lattices.grading import Local
from infill.surface import Surface
from infill.voxels.scanlines import crossings, filled

SAMPLES = 200_000
SHIFTS = (  # of a cell: along every axis, the middles of its four quarters
    (-0.375, -0.125, 0.125),
    (0.125, 0.375, -0.375),
    (-0.125, 0.125, 0.375),
    (0.375, -0.375, -0.125),
)
Floats = NDArray[np.float64]


def densities_by_share(space: Space, voids: Surface, local: Local, count: int, *, mean: float) -> tuple[Floats, Floats]:
    """Return what was asked for on average, and what is there, in equal numbers of cells drawn by chance: (count,).

    Whether a place is solid is asked of the meshes of the voids, on grids that are shifted by parts of a cell: vertices
    of the meshes lie between the centres of cells, which say of thin walls that they are thicker or thinner. Voids are
    scaled to leave the mean density, for what chance there still is.
    """
    depth, corners = space.depth, (np.asarray(voids.vertices, dtype=np.float64) - space.origin) / space.size
    near = np.argwhere((depth > -1) & (space.shares >= 0.5))  # within a cell of what lies inside the walls
    cells = near[np.random.default_rng(0).integers(len(near), size=SAMPLES)]
    places, solid = cells.astype(np.float64), np.empty(SAMPLES, dtype=bool)
    for shift, some in zip(SHIFTS, np.array_split(np.arange(SAMPLES), len(SHIFTS)), strict=True):
        void = filled(crossings(corners - shift, voids.faces, depth.shape), depth.shape)
        solid[some] = ~void[tuple(cells[some].T)]
        places[some] += shift
    inside = _between(depth, places) > 0
    places, solid = places[inside], solid[inside]
    shares = _between(local.shares, places / local.step)
    order = np.array_split(np.argsort(shares), count)
    larger = (1 - mean) / max(1 - float(solid.mean()), 1e-9)
    return (
        np.array([shares[each].mean() for each in order]),
        np.array([1 - larger * (1 - solid[each].mean()) for each in order]),
    )


def _between(nodes: NDArray[np.float32], at: Floats) -> Floats:
    """Return the values between nodes, straight."""
    from scipy.ndimage import map_coordinates

    found: Floats = map_coordinates(nodes, at.T, output=np.float64, order=1, mode="nearest")
    return found
