"""Measure the thinnest walls of a solid, before and after smoothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.inspection.rays import first_solid_length
from infill.kernels.rays import sample_rays
from infill.phasefield.sparse import SparseField
from infill.surface import Surface

# The thinnest wall is that behind a hundredth of the surface: less may be a single edge or corner. Of 4000 rays that
# is 40, so the share actually found lies between 0.7 % and 1.3 % (twice the standard deviation, sqrt(0.01 / 4000)).
THIN = 0.01
SAMPLES = 4000
STEP = 0.25  # cells: a solid sampled cell by cell has no finer detail
# Cells: a wall is no thicker. Smoothing removes walls of 3 cells and keeps those of 5; 16 is three times that.
FARTHEST = 16.0
LEEWAY_OF_DATA, LEEWAY = 4, 1  # steps behind the surface within which a ray enters: it lies up to a cell off the data


def thinnest_walls(
    field: SparseField, surface: Surface, spacing: tuple[float, ...], level: float = 0.0
) -> tuple[float | None, float | None]:
    """Measure the wall behind the thinnest 1 % of surface, mm, in data and smoothed; None if over 16 cells.

    Parameters
    ----------
    field : SparseField
        Solid where it is above the level; its data are solid above 0.
    surface : Surface
        The surface of that solid, mm from the lower corner of the first cell.
    spacing : (hx, hy, hz), mm
    level : float

    Returns
    -------
    float or None
        None if everything behind the surface is thicker than 16 cells, measured along their shortest side; or, for the
        data, if nothing is solid there.

    Notes
    -----
    From points all over the surface, rays go inwards along the normal until they leave the solid. A ray that does not
    leave within reach is longer than all those that do: it shows only that there is not a wall.
    """
    size = np.array(spacing)
    count = len(surface.faces)
    sampled = np.random.default_rng(0).choice(count, min(count, SAMPLES), replace=False)
    corners = surface.vertices[surface.faces[sampled]].astype(np.float64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    has_area = length[:, 0] > 0
    inwards, start = -normals[has_area] / length[has_area], corners[has_area].mean(axis=1)
    # In the middle of each step, so that a wall of whole cells along an axis is measured at its true thickness.
    places = round(FARTHEST / STEP) + LEEWAY_OF_DATA + 1  # up to the first one beyond a wall that begins late
    distances = (np.arange(places, dtype=np.float64) + 0.5) * (STEP * float(size.min()))

    def thinnest_wall(values: NDArray[np.generic], height: float, leeway: int) -> float | None:
        """Return the thickness of the thinnest walls in values, mm; None without any."""
        solid = np.empty((len(start), len(distances)))
        sample_rays(field.slots, values, field.shape, start, inwards, distances, size, height, solid)
        lengths = first_solid_length(solid, distances, leeway=leeway)
        lengths = lengths[lengths > 0]
        if len(lengths) == 0:
            return None
        thinnest = float(np.quantile(lengths, THIN, method="inverted_cdf"))
        return thinnest if thinnest <= FARTHEST * float(size.min()) else None

    return thinnest_wall(field.data, 0.0, LEEWAY_OF_DATA), thinnest_wall(field.values, level, LEEWAY)
