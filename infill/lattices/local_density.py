"""The density of a filled part, by the density that was requested there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import Interior
from infill.lattices.grading import LocalWidths
from infill.surface import Surface
from infill.voxels.scanlines import fill_rows, intersect_rows

SAMPLES = 200_000
SHIFTS = (  # of a cell: along every axis, the middles of its four quarters
    (-0.375, -0.125, 0.125),
    (0.125, 0.375, -0.375),
    (-0.125, 0.125, 0.375),
    (0.375, -0.375, -0.125),
)
Floats = NDArray[np.float64]


def densities_by_share(
    space: Interior, voids: Surface, local: LocalWidths, count: int, *, mean: float
) -> tuple[Floats, Floats]:
    """Return requested and measured densities, averaged over equal numbers of random cells: (count,) each.

    Whether a place is solid is tested on the meshes of the voids, on grids that are shifted by parts of a cell:
    vertices of the meshes lie between the centres of cells, and unshifted centres would make thin walls look thicker or
    thinner. Voids are scaled so that the mean density is exact, which removes the chance that remains.
    """
    depth, corners = space.depth, (np.asarray(voids.vertices, dtype=np.float64) - space.origin) / space.size
    candidates = np.argwhere((depth > -1) & (space.shares >= 0.5))  # at most a cell outside the walls
    cells = candidates[np.random.default_rng(0).integers(len(candidates), size=SAMPLES)]
    places, solid = cells.astype(np.float64), np.empty(SAMPLES, dtype=bool)
    for shift, indices in zip(SHIFTS, np.array_split(np.arange(SAMPLES), len(SHIFTS)), strict=True):
        void = fill_rows(intersect_rows(corners - shift, voids.faces, depth.shape), depth.shape)
        solid[indices] = ~void[tuple(cells[indices].T)]
        places[indices] += shift
    inside = _interpolate(depth, places) > 0
    places, solid = places[inside], solid[inside]
    shares = _interpolate(local.shares, places / local.step)
    groups = np.array_split(np.argsort(shares), count)
    scale = (1 - mean) / max(1 - float(solid.mean()), 1e-9)
    return (
        np.array([shares[group].mean() for group in groups]),
        np.array([1 - scale * (1 - solid[group].mean()) for group in groups]),
    )


def _interpolate(nodes: NDArray[np.float32], at: Floats) -> Floats:
    """Interpolate linearly between nodes."""
    from scipy.ndimage import map_coordinates

    interpolated: Floats = map_coordinates(nodes, at.T, output=np.float64, order=1, mode="nearest")
    return interpolated
