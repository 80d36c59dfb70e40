"""Coordinates in which cells of one size follow a field: where it is high, cells are small, and none are torn.

Cells of a size that changes cannot all be cubes. So the coordinates are those whose slopes come nearest to the scales
asked for, in the sense of least squares: along each axis the solution of Poisson's equation, whose right side is the
slope of the scale along that axis. Cells are flatter or longer than cubes then, and scales are corrected until these
have as much wall in a volume as cubes would, as far as a limit allows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats

ROUNDS = 6  # of corrections of the scales for cells that are not cubes
MOST = 2.5  # largest correction of a scale, up or down, as a factor
FOLDED = 0.02  # of the number of cells in a volume where they are largest: with fewer, cells nearly fold over
EASED = 0.8  # power by which scales that would fold cells are evened out
DIRECTIONS = 32  # of walls, over half a circle or half a sphere


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
    return fit_without_folds(scales, _fit_coordinates)


def fit_without_folds(
    scales: NDArray[np.floating], fit: Callable[[Floats], tuple[Floats, Floats, Floats]]
) -> tuple[Floats, Floats]:
    """Even scales out until no cell folds; return the coordinates, kept in the middle, and the factors reached.

    Parameters
    ----------
    scales : (n, m) or (n, m, k) float
    fit : callable
        Returns coordinates, their slopes, and the factors reached, for scales.
    """
    targets = np.asarray(scales, dtype=np.float64)
    while True:
        coordinates, slopes, more = fit(targets)
        if np.linalg.det(slopes).min() > FOLDED * targets.min() ** targets.ndim:
            return _keep_middle(coordinates), more
        targets = targets**EASED


def _keep_middle(coordinates: Floats) -> Floats:
    """Shift coordinates so that the node in the middle stays where it is."""
    middle = (np.array(coordinates.shape[:-1]) - 3) / 2
    shifted: Floats = coordinates + (middle - map_points(coordinates, middle[None])[0])
    return shifted


def _fit_coordinates(targets: Floats) -> tuple[Floats, Floats, Floats]:
    """Fit a spline to wanted factors of wall, (n, m, k); return its coefficients, slopes and the factors reached."""
    scales, more = targets, np.ones_like(targets)
    for number in range(ROUNDS):
        if number:
            scales = np.clip(scales * targets / more, targets / MOST, targets * MOST)
        along_axes = [step_divergence(scales, axis) for axis in range(targets.ndim)]
        coordinates = extrapolate_nodes(solve_poisson(along_axes))
        slopes = spline_jacobians(coordinates)
        more = wall_density_factor(slopes)
    return coordinates, slopes, more


def map_points(coordinates: Floats, points: Floats) -> Floats:
    """Map points (N, 3) or (N, 2) to coordinates of `fit_conformal_map`; both in nodes."""
    from scipy.ndimage import map_coordinates

    along = [map_coordinates(axis, points.T + 1, order=3, prefilter=False) for axis in np.moveaxis(coordinates, -1, 0)]
    return np.stack(along, axis=-1)


def solve_poisson(divergences: Sequence[Floats]) -> Floats:
    """Compute the coordinates whose steps between nodes come nearest to wanted ones, (n, m, k, 3).

    Parameters
    ----------
    divergences : sequence of (n, m, k) float64
        Of the wanted steps, for each coordinate: sums of `step_divergence`.
    """
    from scipy.fft import dctn, idctn

    # At the ends, steps to missing neighbours are 0, so cosines solve it.
    shape = divergences[0].shape
    waves = [2 - 2 * np.cos(np.pi * np.arange(count) / count) for count in shape]
    squared = sum(np.ix_(*waves), np.zeros(()))
    squared[(0,) * len(shape)] = 1.0
    coordinates = np.empty((*shape, len(divergences)))
    for axis, divergence in enumerate(divergences):
        summed = dctn(divergence, type=2) / squared
        summed[(0,) * len(shape)] = 0.0
        coordinates[..., axis] = idctn(summed, type=2)
    return coordinates


def step_divergence(slopes: Floats, axis: int) -> Floats:
    """Return the divergence of steps along an axis, whose slopes at the nodes are given."""
    along = np.moveaxis(slopes, axis, 0)
    steps = (along[1:] + along[:-1]) / 2
    rise = np.zeros_like(along)
    rise[1:] += steps
    rise[:-1] -= steps
    return np.moveaxis(rise, 0, axis)


def extrapolate_nodes(nodes: Floats) -> Floats:
    """Extrapolate one more node linearly on either side along each axis."""
    for axis in range(nodes.ndim - 1):
        start, second, before, end = (np.take(nodes, [at], axis=axis) for at in (0, 1, -2, -1))
        nodes = np.concatenate([2 * start - second, nodes, 2 * end - before], axis=axis)
    return nodes


def spline_jacobians(coordinates: Floats) -> Floats:
    """Compute the Jacobians of a cubic spline at its nodes, from coefficients (n + 2, m + 2, k + 2, 3).

    The result, (n, m, k, 3, 3), has the derivative of coordinate i along axis j at [..., i, j], per step of the nodes.
    """
    values, slopes = (1 / 6, 2 / 3, 1 / 6), (-1 / 2, 0.0, 1 / 2)
    shape = tuple(count - 2 for count in coordinates.shape[:-1])
    dimension = len(shape)
    derivatives = np.zeros((*shape, dimension, dimension))
    for axis in range(dimension):
        summed = coordinates
        for along in range(dimension):
            weights = slopes if along == axis else values
            at = [np.take(summed, range(start, start + shape[along]), axis=along) for start in range(3)]
            summed = weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2]
        derivatives[..., axis] = summed
    return derivatives


def all_directions(dimension: int) -> Floats:
    """Return directions spread evenly over half a circle, or over half a sphere: (`DIRECTIONS`, dimension)."""
    count = np.arange(DIRECTIONS)
    if dimension == 2:
        angle = np.pi * (count + 0.5) / DIRECTIONS
        return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    golden = math.pi * (3 - math.sqrt(5))
    up = (count + 0.5) / DIRECTIONS
    flat = np.sqrt(1 - up * up)
    return np.stack([flat * np.cos(golden * count), flat * np.sin(golden * count), up], axis=-1)


def wall_density_factor(slopes: Floats, normals: Floats | None = None) -> Floats:
    """Return the factor of wall area per volume where a pattern's coordinates have slopes (..., 3, 3).

    It is the mean over normals n of |slopesᵀ n|; without normals, walls are assumed to lie in all directions alike. In
    a plane, with slopes (..., 2, 2), it is that of line per area.
    """
    directions = all_directions(slopes.shape[-1]) if normals is None else normals
    total = np.zeros(slopes.shape[:-2])
    if slopes.shape[-1] == 2:  # |slopesᵀ n|² as a quadratic form of n, whose coefficients are computed once
        (a, b), (c, d) = np.moveaxis(slopes, (-2, -1), (0, 1))
        first, mixed, last = a * a + b * b, 2 * (a * c + b * d), c * c + d * d
        for cosine, sine in directions.tolist():
            total += np.sqrt(np.maximum(cosine**2 * first + cosine * sine * mixed + sine**2 * last, 0.0))
        return total / len(directions)
    for normal in directions:
        total += np.sqrt(((normal @ slopes) ** 2).sum(axis=-1))
    return total / len(directions)
