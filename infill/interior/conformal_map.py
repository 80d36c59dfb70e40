"""Coordinates in which cells of one size follow a field: where it is high, cells are small, and none are torn.

Cells of a size that changes cannot all be cubes. So the coordinates are those whose slopes come nearest to the scales
asked for, in the sense of least squares: along each axis the solution of Poisson's equation, whose right side is the
slope of the scale along that axis. Cells are flatter or longer than cubes then, and scales are corrected until these
have as much wall in a volume as cubes would, as far as a limit allows.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats

ROUNDS = 6  # of corrections of the scales for cells that are not cubes
MOST = 2.5  # largest correction of a scale, up or down, as a factor
FOLDED = 0.02  # of the number of cells in a volume where they are largest: with fewer, cells nearly fold over
EASED = 0.8  # power by which scales that would fold cells are evened out
DIRECTIONS = 32  # of walls, over half a sphere


def fit_conformal_map(scales: NDArray[np.floating]) -> tuple[Floats, Floats]:
    """Compute coordinates in which cells follow scales; return them and the resulting increase of wall.

    Parameters
    ----------
    scales : (n, m, k) float
        At nodes one apart, two or more along each axis: factor of the wall in a volume, which for cubes is the factor
        of the number of cells in a length.

    Returns
    -------
    coordinates : (n + 2, m + 2, k + 2, 3) float64
        The coefficients of a cubic spline over the nodes and one more on either side, in nodes; see `map_points`.
        The node in the middle stays where it is.
    more : (n, m, k) float64
        Factor of the wall in a volume.

    Notes
    -----
    Where scales change so quickly that cells would fold over each other, the scales are evened out until no cell folds.
    """
    targets = np.asarray(scales, dtype=np.float64)
    while True:
        coordinates, slopes, more = _fit_coordinates(targets)
        if np.linalg.det(slopes).min() > FOLDED * targets.min() ** 3:
            break
        targets = targets**EASED
    middle = (np.array(targets.shape) - 1) / 2
    return coordinates + (middle - map_points(coordinates, middle[None])[0]), more


def _fit_coordinates(targets: Floats) -> tuple[Floats, Floats, Floats]:
    """Fit a spline to wanted factors of wall, (n, m, k); return its coefficients, slopes and the factors reached."""
    scales, more = targets, np.ones_like(targets)
    for number in range(ROUNDS):
        if number:
            scales = np.clip(scales * targets / more, targets / MOST, targets * MOST)
        coordinates = _extrapolate(_integrate(scales))
        slopes = spline_slopes(coordinates)
        more = wall_density_factor(slopes)
    return coordinates, slopes, more


def map_points(coordinates: Floats, points: Floats) -> Floats:
    """Map points (N, 3) to coordinates of `fit_conformal_map`, (N, 3); both in nodes."""
    from scipy.ndimage import map_coordinates

    along = [map_coordinates(axis, points.T + 1, order=3, prefilter=False) for axis in np.moveaxis(coordinates, -1, 0)]
    return np.stack(along, axis=-1)


def _integrate(scales: Floats) -> Floats:
    """Compute the coordinates whose steps between nodes come nearest to the scales there, (n, m, k, 3)."""
    from scipy.fft import dctn, idctn

    # At the ends, steps to missing neighbours are 0, so cosines solve it.
    waves = [2 - 2 * np.cos(np.pi * np.arange(count) / count) for count in scales.shape]
    squared = waves[0][:, None, None] + waves[1][:, None] + waves[2]
    squared[0, 0, 0] = 1.0
    coordinates = np.empty((*scales.shape, 3))
    for axis in range(3):
        along = np.moveaxis(scales, axis, 0)
        steps = (along[1:] + along[:-1]) / 2
        rise = np.zeros_like(along)
        rise[1:] += steps
        rise[:-1] -= steps
        summed = dctn(np.moveaxis(rise, 0, axis), type=2) / squared
        summed[0, 0, 0] = 0.0
        coordinates[..., axis] = idctn(summed, type=2)
    return coordinates


def _extrapolate(nodes: Floats) -> Floats:
    """Extrapolate one more node linearly on either side along each axis."""
    for axis in range(3):
        start, second, before, end = (np.take(nodes, [at], axis=axis) for at in (0, 1, -2, -1))
        nodes = np.concatenate([2 * start - second, nodes, 2 * end - before], axis=axis)
    return nodes


def spline_slopes(coordinates: Floats) -> Floats:
    """Compute slopes (n, m, k, 3, 3) at the nodes of a spline with coefficients (n + 2, m + 2, k + 2, 3)."""
    values, slopes = (1 / 6, 2 / 3, 1 / 6), (-1 / 2, 0.0, 1 / 2)
    shape = tuple(count - 2 for count in coordinates.shape[:3])
    derivatives = np.zeros((*shape, 3, 3))
    for axis in range(3):
        summed = coordinates
        for along in range(3):
            weights = slopes if along == axis else values
            at = [np.take(summed, range(start, start + shape[along]), axis=along) for start in range(3)]
            summed = weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2]
        derivatives[..., axis] = summed
    return derivatives


def wall_density_factor(slopes: Floats) -> Floats:
    """Return the factor of wall area per volume where a pattern's coordinates have slopes (..., 3, 3).

    Walls are assumed to lie in all directions alike: the mean over normals n of |slopesᵀ n|.
    """
    golden = math.pi * (3 - math.sqrt(5))
    total = np.zeros(slopes.shape[:-2])
    for at in range(DIRECTIONS):
        up = (at + 0.5) / DIRECTIONS
        flat = math.sqrt(1 - up * up)
        normal = np.array([flat * math.cos(golden * at), flat * math.sin(golden * at), up])
        total += np.sqrt(((normal @ slopes) ** 2).sum(axis=-1))
    return total / DIRECTIONS
