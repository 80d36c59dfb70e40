"""Distances from a surface known by points, by weighted planes, and the normals of the points."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.kernels.threads import in_threads, thread_count
from infill.volume import Volume
from infill.voxels.from_points import fill_balls, spacing_of_points

if TYPE_CHECKING:
    from scipy.spatial import KDTree

SHARPNESS, PASSES = 0.7, 2  # scale of differences between normals, and number of passes for the mean normal
# Standard deviation of the weights: in cells, in spacings (see `spacing_of_points`), whichever is larger.
FEWEST_CELLS, OF_SPACING = 0.75, 0.6
REACH = 3.0  # standard deviations from a point, beyond which it does not count
# Distance from a point within which the surface decides, not the cells: spacings along it, as wide as gaps, and cells
# across it.
ALONG, ACROSS = 0.8, 1.5
THIN = 0.5  # cells: points in a cube of this size become one
NEIGHBOURS = (12, 24, 48, 96)  # for the estimate of a normal: the fewest that lie roughly in a plane
PLANE = 0.05  # variance across the plane over that along it: less is a plane
SAMPLED = 5_000  # points that tell how many neighbours are needed


def distance_from_points(places: Floats, points: Floats, normals: Floats, sigma: float) -> Floats:
    """Measure the distance from a surface through points, (M,): below 0 inside, NaN where no point is near.

    Parameters
    ----------
    places : (M, 3) float64
    points, normals : (N, 3) float64
        Normals of length 1, outwards.
    sigma : float
        Standard deviation of the weights, in the unit of the points. Points further than three of it do not count.

    Notes
    -----
    With d_i = x - p_i, the mean normal m is found by iteration from m = 0:

        w_i = exp(-|d_i|² / 2 sigma² - |n_i - m|² / s²)        (the second term from the second time on)
        m   = sum w_i n_i / |sum w_i n_i|

    and the distance is sum w_i d_i . (n_i + m) / 2 / sum w_i. Planes whose normals differ from the mean, beyond an
    edge, have little weight, so that edges stay (Öztireli, Guennebaud, Gross 2009, "Feature preserving point set
    surfaces based on non-linear kernel regression", doi:10.1111/j.1467-8659.2009.01388.x). The mean of both normals is
    an addition to their method: a chord of a sphere is perpendicular to the mean of the normals at its ends, so that
    the surface does not move outwards where it bends, as it does by n_i alone (by sigma² / R on a sphere).
    """
    offset = places[:, None] - points
    squared = (offset**2).sum(axis=2)
    in_reach = squared <= (REACH * sigma) ** 2
    base = np.where(in_reach, np.exp(-squared / (2 * sigma**2)), 0.0)
    weights, mean = base, np.zeros_like(places)
    distance = np.full(len(places), np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        for _ in range(PASSES):
            mean = weights @ normals
            mean /= np.linalg.norm(mean, axis=1)[:, None]
            difference = ((normals - mean[:, None]) ** 2).sum(axis=2)
            weights = base * np.exp(-difference / SHARPNESS**2)
            planes = (offset * (normals + mean[:, None])).sum(axis=2) / 2
            distance = (weights * planes).sum(axis=1) / weights.sum(axis=1)
    return distance


def cell_distances(
    solid: Volume, points: Floats, normals: Floats | None, *, threads: int | None = None
) -> NDArray[np.float32]:
    """Measure the distance of cells from the surface of points, (nx, ny, nz) in cells: above 0 inside.

    Parameters
    ----------
    solid : Volume
        The cells inside, roughly: near the points, the points decide.
    points : (N, 3) float64, mm
    normals : (N, 3) float64, optional
        Of any length, inwards or outwards; estimated from the points around each if left out, or of length 0.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Returns
    -------
    (nx, ny, nz) float32
        Cut off at the distance beyond which no point is near.

    Notes
    -----
    The cells tell which side of a point is solid, whatever its normal.
    """
    from scipy.spatial import KDTree

    from infill.kernels.point_fields import signed_distances

    inside: NDArray[np.bool_] = np.asarray(solid.values)
    placed, index = np.unique((points - np.array(solid.origin)) / solid.cell_size - 0.5, axis=0, return_index=True)
    tree = KDTree(placed)
    spacing = spacing_of_points(tree)
    directions = _unit_normals(tree, None if normals is None else normals[index], thread_count(threads))
    outwards = _orient_outwards(inside, placed, directions, spacing)
    placed, outwards = merge_close_points(placed, outwards)
    sigma = max(FEWEST_CELLS, OF_SPACING * spacing)
    reach = math.hypot(ALONG * spacing, ACROSS)
    cells = np.argwhere(fill_balls(placed, reach, inside.shape)).astype(np.int32)
    ordered, bin_start, shape = sort_into_bins(placed, REACH * sigma)
    distances = np.empty(len(cells), dtype=np.float32)
    arguments = (cells, placed[ordered], outwards[ordered], bin_start, shape, sigma, REACH * sigma, SHARPNESS, PASSES)
    in_threads(signed_distances, *arguments, distances, threads=thread_count(threads))
    distance = np.where(inside, np.float32(reach), np.float32(-reach))
    near_cells = tuple(cells.T)
    distance[near_cells] = np.where(np.isfinite(distances), np.clip(-distances, -reach, reach), distance[near_cells])
    return distance


def merge_close_points(points: Floats, normals: Floats) -> tuple[Floats, Floats]:
    """Merge all points in the same cube of half a cell: return their mean, and the mean of their normals.

    Points whose normals cancel out are left out.

    >>> merge_close_points(np.array([[0.0, 0, 0], [0.2, 0, 0], [3, 0, 0]]), np.array([[0.0, 0, 1]] * 3))[0].tolist()
    [[0.1, 0.0, 0.0], [3.0, 0.0, 0.0]]
    """
    _, group, count = np.unique(np.floor(points / THIN), axis=0, return_inverse=True, return_counts=True)
    group = group.reshape(-1)

    def sum_groups(values: Floats) -> Floats:
        """Sum rows (N, 3) by group."""
        return np.stack(
            [np.bincount(group, weights=coordinate, minlength=len(count)) for coordinate in values.T], axis=1
        )

    mean, total = sum_groups(points) / count[:, None], sum_groups(normals)
    length = np.linalg.norm(total, axis=1)
    nonzero = length > 0
    return mean[nonzero], total[nonzero] / length[nonzero, None]


def _unit_normals(tree: KDTree, given_normals: Floats | None, threads: int) -> Floats:
    """Return normals of length 1, (N, 3): the given ones, or perpendiculars to the planes of the points around."""
    points = np.asarray(tree.data)
    lengths = None if given_normals is None else np.linalg.norm(given_normals, axis=1)
    has_normal = np.zeros(len(points), dtype=bool) if lengths is None else lengths > 0
    if given_normals is not None and lengths is not None and has_normal.all():
        unit: Floats = given_normals / lengths[:, None]
        return unit
    sample = points[:: max(1, len(points) // SAMPLED)]
    flatness = {}
    for count in NEIGHBOURS:
        flatness[count] = float(np.median(_fit_planes(tree, sample, min(count, len(points)), threads)[1]))
        if flatness[count] < PLANE or count >= len(points):
            break
    best = count if flatness[count] < PLANE else min(flatness, key=lambda size: flatness[size])
    estimated = _fit_planes(tree, points, min(best, len(points)), threads)[0]
    if given_normals is not None and lengths is not None:
        estimated[has_normal] = given_normals[has_normal] / lengths[has_normal, None]
    return estimated


def _fit_planes(tree: KDTree, points: Floats, count: int, threads: int) -> tuple[Floats, Floats]:
    """Fit planes to the points around each point; return their normals, and how far from flat they are: see `PLANE`."""
    _, neighbours = tree.query(points, k=count, workers=threads)
    local = np.asarray(tree.data)[neighbours]
    local = local - local.mean(axis=1, keepdims=True)
    variances, axes = np.linalg.eigh(np.swapaxes(local, 1, 2) @ local)
    flatness = variances[:, 0] / np.maximum(variances[:, 1], np.finfo(float).tiny)
    return np.ascontiguousarray(axes[:, :, 0]), flatness


def _orient_outwards(inside: NDArray[np.bool_], points: Floats, normals: Floats, spacing: float) -> Floats:
    """Turn the normals to the side where the cells are void."""
    from scipy.ndimage import gaussian_filter, map_coordinates

    soft = gaussian_filter(inside.astype(np.float32), max(1.0, spacing / 2))
    ahead, behind = (map_coordinates(soft, (points + side * normals).T, order=1) for side in (1.0, -1.0))
    oriented: Floats = np.where((ahead > behind)[:, None], -normals, normals)
    return oriented


def sort_into_bins(points: Floats, size: float) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Sort points (N, 3) into bins; return their order, the first of each bin, and the number of bins along each axis.

    Bins are cubes of a size, and the first begins at -`size`.
    """
    bin_index = (points / size).astype(np.int64) + 1
    bin_index[points < 0] = 0
    shape = bin_index.max(axis=0) + 1
    key = (bin_index[:, 0] * shape[1] + bin_index[:, 1]) * shape[2] + bin_index[:, 2]
    order = np.argsort(key, kind="stable")
    bin_start = np.zeros(int(shape.prod()) + 1, dtype=np.int64)
    np.cumsum(np.bincount(key, minlength=len(bin_start) - 1), out=bin_start[1:])
    return order, bin_start, shape
