"""Coordinates in which cells of one size follow a field: where it is high, they are small, and nowhere are they torn.

Cells of a size that changes cannot all be cubes. So the coordinates are those whose slopes come nearest to the scales
asked for, in the sense of least squares: along each axis the solution of Poisson's equation, whose right side is the
slope of the scale along that axis. Cells are flatter or longer than cubes then, and scales are corrected until these
have as much wall in a volume as cubes would, as far as a limit allows.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
ROUNDS = 6  # in which scales are corrected for cells that are no cubes
MOST = 2.5  # times what was asked for, or that part of it: how far scales are corrected
FOLDED = 0.02  # of the number of cells in a volume where they are to be largest: with fewer, cells all but fold over
EASED = 0.8  # power of scales that would fold cells
DIRECTIONS = 32  # over half a sphere, in which walls are taken to lie


def stretched(scales: NDArray[np.floating]) -> tuple[Floats, Floats]:
    """Return coordinates in which about so many cells more fit into a length, and how much more wall they mean.

    Parameters
    ----------
    scales : (n, m, k) float
        At nodes one apart, two or more along each axis: how many times as much wall is to be in a volume, which for
        cubes is how many times as many cells are in a length.

    Returns
    -------
    coordinates : (n + 2, m + 2, k + 2, 3) float64
        The coefficients of a cubic spline over the nodes and one more on either side, in nodes: `place` says where each
        point is in it. The node in the middle stays where it is.
    more : (n, m, k) float64
        How many times as much wall there is in a volume.

    Notes
    -----
    Where scales change so much within so little room that cells would fold over one another, they are evened out until
    none does.
    """
    wanted = np.asarray(scales, dtype=np.float64)
    while True:
        coordinates, slopes, more = _nearest(wanted)
        if np.linalg.det(slopes).min() > FOLDED * wanted.min() ** 3:
            break
        wanted = wanted**EASED
    middle = (np.array(wanted.shape) - 1) / 2
    return coordinates + (middle - place(coordinates, middle[None])[0]), more


def _nearest(wanted: Floats) -> tuple[Floats, Floats, Floats]:
    """Return coordinates with about as much wall in a volume as wanted at nodes (n, m, k), slopes, and how much."""
    asked, more = wanted, np.ones_like(wanted)
    for number in range(ROUNDS):
        if number:
            asked = np.clip(asked * wanted / more, wanted / MOST, wanted * MOST)
        coordinates = _around(_integrated(asked))
        slopes = slopes_of(coordinates)
        more = walls_in(slopes)
    return coordinates, slopes, more


def place(coordinates: Floats, points: Floats) -> Floats:
    """Return where points (N, 3) lie in coordinates of `stretched`, (N, 3); both in nodes."""
    from scipy.ndimage import map_coordinates

    along = [map_coordinates(each, points.T + 1, order=3, prefilter=False) for each in np.moveaxis(coordinates, -1, 0)]
    return np.stack(along, axis=-1)


def _integrated(scales: Floats) -> Floats:
    """Return the coordinates whose steps between nodes come nearest to the scales there, (n, m, k, 3)."""
    from scipy.fft import dctn, idctn

    # Steps to no neighbour are 0 at the ends, so cosines solve it.
    waves = [2 - 2 * np.cos(np.pi * np.arange(count) / count) for count in scales.shape]
    squared = waves[0][:, None, None] + waves[1][:, None] + waves[2]
    squared[0, 0, 0] = 1.0
    found = np.empty((*scales.shape, 3))
    for axis in range(3):
        along = np.moveaxis(scales, axis, 0)
        steps = (along[1:] + along[:-1]) / 2
        rise = np.zeros_like(along)
        rise[1:] += steps
        rise[:-1] -= steps
        summed = dctn(np.moveaxis(rise, 0, axis), type=2) / squared
        summed[0, 0, 0] = 0.0
        found[..., axis] = idctn(summed, type=2)
    return found


def _around(nodes: Floats) -> Floats:
    """Return the nodes with one more on either side along each axis, straight on."""
    for axis in range(3):
        first, second, before, last = (np.take(nodes, [at], axis=axis) for at in (0, 1, -2, -1))
        nodes = np.concatenate([2 * first - second, nodes, 2 * last - before], axis=axis)
    return nodes


def slopes_of(coordinates: Floats) -> Floats:
    """Return the slopes of a spline at its nodes, (n, m, k, 3, 3): of each coordinate, along each axis."""
    values, slopes = (1 / 6, 2 / 3, 1 / 6), (-1 / 2, 0.0, 1 / 2)
    shape = tuple(count - 2 for count in coordinates.shape[:3])
    found = np.zeros((*shape, 3, 3))
    for axis in range(3):
        part = coordinates
        for other in range(3):
            weights = slopes if other == axis else values
            at = [np.take(part, range(first, first + shape[other]), axis=other) for first in range(3)]
            part = weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2]
        found[..., axis] = part
    return found


def walls_in(slopes: Floats) -> Floats:
    """Return how many times as much wall is in a volume where a pattern is stretched by slopes (..., 3, 3).

    Walls that lie in all directions alike are taken: the mean over normals n of |slopesᵀ n|.
    """
    golden = math.pi * (3 - math.sqrt(5))
    total = np.zeros(slopes.shape[:-2])
    for at in range(DIRECTIONS):
        up = (at + 0.5) / DIRECTIONS
        flat = math.sqrt(1 - up * up)
        normal = np.array([flat * math.cos(golden * at), flat * math.sin(golden * at), up])
        total += np.sqrt(((normal @ slopes) ** 2).sum(axis=-1))
    return total / DIRECTIONS
