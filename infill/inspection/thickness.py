"""The thinnest walls of a solid, before and after smoothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels.sparse import BRICK, SOLID_BRICK
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

SAMPLES = 4000
STEP = 0.25  # cells
FARTHEST = 16.0  # cells: what is thicker is no wall
THIN = 0.01  # the thinnest wall is that of this part of the surface


def thinnest_walls(
    field: SparseField, surface: Surface, spacing: tuple[float, ...], level: float = 0.0
) -> tuple[float | None, float | None]:
    """Return how thick the solid is behind the thinnest hundredth of the surface, mm: in the data, and smoothed.

    Parameters
    ----------
    field : SparseField
        Solid where it is above the level; its data are solid above 0.
    surface : Surface
        Of that solid, mm from the lower corner of the first cell.
    spacing : (hx, hy, hz), mm
    level : float

    Returns
    -------
    float or None
        None if what is behind is thicker than 16 cells everywhere, or, for the data, if none is solid there.

    Notes
    -----
    From points all over the surface rays go inwards, along the normal, until they leave the solid.
    """
    size = np.array(spacing)
    some = np.random.default_rng(0).permutation(len(surface.faces))[:SAMPLES]
    corners = surface.vertices[surface.faces[some]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    keep = length[:, 0] > 0
    inwards, start = -normals[keep] / length[keep], corners[keep].mean(axis=1)
    step = STEP * float(size.min())
    at = np.arange(1, round(FARTHEST / STEP) + 1) * step
    cells = np.floor((start[:, None] + inwards[:, None] * at[:, None]) / size).astype(np.int64)
    smoothed, data = solid_at(field, cells.reshape(-1, 3), level)
    return tuple(
        _thin(inside.reshape(len(start), len(at)), step, leeway) for inside, leeway in ((data, 4), (smoothed, 1))
    )  # type: ignore[return-value]


def _thin(inside: NDArray[np.bool_], step: float, leeway: int) -> float | None:
    """Return the first hundredth of the lengths of the first stretch inside that begins within `leeway` steps."""
    begun = inside[:, : leeway + 1].any(axis=1)
    first = inside.argmax(axis=1)
    ahead = np.arange(inside.shape[1]) >= first[:, None]
    out = ahead & ~inside
    ends = np.where(out.any(axis=1), out.argmax(axis=1), inside.shape[1])
    lengths = (ends - first)[begun] * step
    if len(lengths) == 0:
        return None
    thin = float(np.quantile(lengths, THIN))
    return None if thin >= inside.shape[1] * step else thin


def solid_at(field: SparseField, cells: NDArray[np.int64], level: float) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return for cells (N, 3) of the grid whether they are solid, smoothed and in the data; beyond it none is."""
    inside: NDArray[np.bool_] = np.all((cells >= 0) & (cells < field.shape), axis=1)
    place = np.where(inside[:, None], cells, 0) + 1
    brick, cell = np.divmod(place, BRICK)
    slot = field.slots[tuple(brick.T)]
    kept = slot >= 0
    alone = (slot == SOLID_BRICK) & inside
    found = []
    for values, height in ((field.values, level), (field.data, 0.0)):
        solid = alone.copy()
        above: NDArray[np.bool_] = values[slot[kept], cell[kept, 0], cell[kept, 1], cell[kept, 2]] > height
        solid[kept] = above & inside[kept]
        found.append(solid)
    return found[0], found[1]
