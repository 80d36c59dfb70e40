"""Where inside a cell a surface lies that is known by points: their distance by weighted planes, and their normals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.volume import Volume
from infill.voxels.from_points import balls, spacing_of_points

if TYPE_CHECKING:
    from scipy.spatial import KDTree

SHARPNESS, PASSES = 0.7, 2  # how much normals may differ, and how often the mean normal is found
# Standard deviation of the weights: in cells, in spacings (see `spacing_of_points`), whichever is larger.
FEWEST_CELLS, OF_SPACING = 0.75, 0.6
REACH = 3.0  # standard deviations from a point: further away it does not count
# How far from a point the surface decides, not the cells: spacings along it, since gaps are that wide, cells across it.
ALONG, ACROSS = 0.8, 1.5
THIN = 0.5  # cells: points in a cube of this size become one
NEIGHBOURS = (12, 24, 48, 96)  # that a normal is estimated from: the fewest that lie in a plane, more or less
PLANE = 0.05  # variance across the plane over that along it: less is a plane
SAMPLED = 5_000  # points that tell how many neighbours it takes

Floats = NDArray[np.float64]


def distance_from_points(places: Floats, points: Floats, normals: Floats, sigma: float) -> Floats:
    """Return how far places lie from a surface through points, (M,): below 0 inside, NaN where no point is near.

    Parameters
    ----------
    places : (M, 3) float64
    points, normals : (N, 3) float64
        Normals of length 1, outwards.
    sigma : float
        Standard deviation of the weights, in the unit of the points. Points further than three of it do not count.

    Notes
    -----
    With d_i = x - p_i, the mean normal m is found from m = 0 on, each time anew:

        w_i = exp(-|d_i|² / 2 sigma² - |n_i - m|² / s²)        (the second term from the second time on)
        m   = sum w_i n_i / |sum w_i n_i|

    and the distance is sum w_i d_i . (n_i + m) / 2 / sum w_i. Planes whose normals differ from the mean, beyond an
    edge, count little, so that edges stay (Öztireli, Guennebaud, Gross 2009, "Feature preserving point set surfaces
    based on non-linear kernel regression", doi:10.1111/j.1467-8659.2009.01388.x). The mean of both normals is ours: a
    chord of a sphere is perpendicular to the mean of the normals at its ends, so that the surface does not move
    outwards where it bends, as it does by n_i alone (by sigma² / R on a sphere).
    """
    away = places[:, None] - points
    squared = (away**2).sum(axis=2)
    near = squared <= (REACH * sigma) ** 2
    base = np.where(near, np.exp(-squared / (2 * sigma**2)), 0.0)
    weights, mean = base, np.zeros_like(places)
    distance = np.full(len(places), np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        for _ in range(PASSES):
            mean = weights @ normals
            mean /= np.linalg.norm(mean, axis=1)[:, None]
            off = ((normals - mean[:, None]) ** 2).sum(axis=2)
            weights = base * np.exp(-off / SHARPNESS**2)
            planes = (away * (normals + mean[:, None])).sum(axis=2) / 2
            distance = (weights * planes).sum(axis=1) / weights.sum(axis=1)
    return distance


def near_points(
    solid: Volume, points: Floats, normals: Floats | None, *, threads: int | None = None
) -> NDArray[np.float32]:
    """Return how far cells lie from the surface of points, (nx, ny, nz) in cells: above 0 inside.

    Parameters
    ----------
    solid : Volume
        Which cells are inside, more or less: near the points, these decide.
    points : (N, 3) float64, mm
    normals : (N, 3) float64, optional
        Of any length, inwards or outwards; estimated from the points around each if left out, or of no length.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Returns
    -------
    (nx, ny, nz) float32
        Cut off at the distance beyond which no point is near.

    Notes
    -----
    Which side of a point is solid, the cells say, whatever the normals do.
    """
    from scipy.spatial import KDTree

    from infill.kernels.point_fields import signed_distances

    inside: NDArray[np.bool_] = np.asarray(solid.values)
    placed, index = np.unique((points - np.array(solid.origin)) / solid.cell_size - 0.5, axis=0, return_index=True)
    tree = KDTree(placed)
    spacing = spacing_of_points(tree)
    known = _directions(tree, None if normals is None else normals[index], thread_count(threads))
    outwards = _outwards(inside, placed, known, spacing)
    placed, outwards = thinned(placed, outwards)
    sigma = max(FEWEST_CELLS, OF_SPACING * spacing)
    near = math.hypot(ALONG * spacing, ACROSS)
    cells = np.argwhere(balls(placed, near, inside.shape)).astype(np.int32)
    ordered, first, shape = binned(placed, REACH * sigma)
    found = np.empty(len(cells), dtype=np.float32)
    arguments = (cells, placed[ordered], outwards[ordered], first, shape, sigma, REACH * sigma, SHARPNESS, PASSES)
    in_threads(signed_distances, *arguments, found, threads=thread_count(threads))
    distance = np.where(inside, np.float32(near), np.float32(-near))
    at = tuple(cells.T)
    distance[at] = np.where(np.isfinite(found), np.clip(-found, -near, near), distance[at])
    return distance


def thinned(points: Floats, normals: Floats) -> tuple[Floats, Floats]:
    """Return one point for all in the same cube of half a cell: their mean, and that of their normals.

    Points whose normals cancel out are left out.

    >>> thinned(np.array([[0.0, 0, 0], [0.2, 0, 0], [3, 0, 0]]), np.array([[0.0, 0, 1]] * 3))[0].tolist()
    [[0.1, 0.0, 0.0], [3.0, 0.0, 0.0]]
    """
    _, group, count = np.unique(np.floor(points / THIN), axis=0, return_inverse=True, return_counts=True)
    group = group.reshape(-1)

    def summed(values: Floats) -> Floats:
        return np.stack([np.bincount(group, weights=each, minlength=len(count)) for each in values.T], axis=1)

    mean, total = summed(points) / count[:, None], summed(normals)
    length = np.linalg.norm(total, axis=1)
    some = length > 0
    return mean[some], total[some] / length[some, None]


def _directions(tree: KDTree, given: Floats | None, threads: int) -> Floats:
    """Return normals of length 1, (N, 3): those given, or across the planes of the points around."""
    points = np.asarray(tree.data)
    lengths = None if given is None else np.linalg.norm(given, axis=1)
    known = np.zeros(len(points), dtype=bool) if lengths is None else lengths > 0
    if given is not None and lengths is not None and known.all():
        unit: Floats = given / lengths[:, None]
        return unit
    sample = points[:: max(1, len(points) // SAMPLED)]
    flatness = {}
    for count in NEIGHBOURS:
        flatness[count] = float(np.median(_planes(tree, sample, min(count, len(points)), threads)[1]))
        if flatness[count] < PLANE or count >= len(points):
            break
    best = count if flatness[count] < PLANE else min(flatness, key=lambda each: flatness[each])
    found = _planes(tree, points, min(best, len(points)), threads)[0]
    if given is not None and lengths is not None:
        found[known] = given[known] / lengths[known, None]
    return found


def _planes(tree: KDTree, points: Floats, count: int, threads: int) -> tuple[Floats, Floats]:
    """Return the normals of planes through the points around each, and how far from flat those are: see `PLANE`."""
    _, near = tree.query(points, k=count, workers=threads)
    around = np.asarray(tree.data)[near]
    around = around - around.mean(axis=1, keepdims=True)
    variances, axes = np.linalg.eigh(np.swapaxes(around, 1, 2) @ around)
    flatness = variances[:, 0] / np.maximum(variances[:, 1], np.finfo(float).tiny)
    return np.ascontiguousarray(axes[:, :, 0]), flatness


def _outwards(inside: NDArray[np.bool_], points: Floats, normals: Floats, spacing: float) -> Floats:
    """Return the normals turned to where the cells are void."""
    from scipy.ndimage import gaussian_filter, map_coordinates

    soft = gaussian_filter(inside.astype(np.float32), max(1.0, spacing / 2))
    ahead, behind = (map_coordinates(soft, (points + way * normals).T, order=1) for way in (1.0, -1.0))
    turned: Floats = np.where((ahead > behind)[:, None], -normals, normals)
    return turned


def binned(points: Floats, size: float) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return the order of points (N, 3) by bin, the first of each bin and how many bins there are along each axis.

    Bins are cubes of a size, and the first begins at -`size`.
    """
    place = (points / size).astype(np.int64) + 1
    place[points < 0] = 0
    shape = place.max(axis=0) + 1
    key = (place[:, 0] * shape[1] + place[:, 1]) * shape[2] + place[:, 2]
    order = np.argsort(key, kind="stable")
    first = np.zeros(int(shape.prod()) + 1, dtype=np.int64)
    np.cumsum(np.bincount(key, minlength=len(first) - 1), out=first[1:])
    return order, first, shape
