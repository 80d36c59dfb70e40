"""Searches on a grid of points, each beside SciPy's trees or a plain form in NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

from infill.arrays import Floats
from infill.graph import label_connected
from infill.paths.contact import (
    SELF_STRETCH,
    STEP,
    TOUCHING,
    Samples,
    are_beside,
    are_near,
    project_to_pieces,
    sample_paths,
)
from infill.paths.gaps import find_pinched_points
from infill.paths.neighbours import index_beads, project_to_beads
from infill.paths.point_grid import join_near_paths, sort_into_grid

REACH = 0.5  # mm


def scattered(seed: int, count: int, size: tuple[float, float]) -> Floats:
    """Return points in a box, one in three of them on a raster, so that some are alike."""
    points = np.random.default_rng(seed).random((count, 2)) * size
    points[::3] = np.round(points[::3], 1)
    return points


def wandering(seed: int, paths: int, size: float) -> Samples:
    """Return samples of paths that cross one another, themselves, and the box they begin in."""
    random = np.random.default_rng(seed)
    steps = random.normal(0, 0.6, (paths, 40, 2))
    points = np.cumsum(steps, axis=1) + random.random((paths, 1, 2)) * size
    return sample_paths(points.reshape(-1, 2), np.arange(paths + 1) * 40)


@pytest.mark.parametrize("size", [(30.0, 30.0), (30.0, 0.0), (1e5, 2.0), (0.0, 0.0)])
@pytest.mark.parametrize("count", [1, 2, 50, 2000])
def test_the_nearest_point_is_that_of_a_tree(count: int, size: tuple[float, float]) -> None:
    points = scattered(1, count, size)
    random = np.random.default_rng(2)
    places = np.concatenate([random.random((300, 2)) * size + random.normal(0, 0.4, (300, 2)), points[:20]])
    places = np.concatenate([places, [[1e5, 1e5], [-1e5, 0.0], [1e300, 3.0], [np.nan, 1.0]]])
    grid = sort_into_grid(points)
    np.testing.assert_array_equal(np.sort(grid.number), np.arange(count))
    np.testing.assert_array_equal(grid.points, points[grid.number])
    assert len(grid.begins) < 8 * count + 1100
    for distance in (0.03, 0.5, 5.0):
        expected = cKDTree(points).query(places[:-1], distance_upper_bound=distance)[0]
        np.testing.assert_array_equal(grid.distances(places, distance), np.append(expected, np.inf))


def test_a_distance_does_not_count_itself() -> None:
    grid = sort_into_grid(np.array([[0.0, 0.0], [3.0, 4.0]]))
    assert grid.distances(np.array([[0.0, 4.0]]), 3.0).tolist() == [np.inf]
    assert grid.distances(np.array([[0.0, 4.0]]), np.nextafter(3.0, 4.0)).tolist() == [3.0]


def nearest_pieces(places: Floats, samples: Samples, count: int) -> tuple[Any, Any, Any]:
    """Return the pieces with the nearest middles, where they are nearest along their paths, and how far away."""
    _, pieces = cKDTree(samples.points).query(places, k=count, distance_upper_bound=REACH + STEP / 2)
    pieces = pieces.reshape(len(places), -1)
    exists = pieces < len(samples.points)
    pieces = np.where(exists, pieces, 0)
    share, apart = project_to_pieces(places, samples.points, samples.half, pieces)
    return pieces, samples.along[pieces] + share * samples.weight[pieces] / 2, np.where(exists, apart, np.inf)


@pytest.mark.parametrize(("seed", "paths"), [(1, 1), (2, 5), (3, 60)])
def test_pieces_within_reach_are_those_of_a_tree(seed: int, paths: int) -> None:
    samples, places = wandering(seed, paths, 20.0), scattered(seed + 9, 2000, (24.0, 24.0))
    near = are_near(places, samples, REACH)
    assert near.any()
    assert not near.all()
    np.testing.assert_array_equal(near, (nearest_pieces(places, samples, 3)[2] <= REACH).any(axis=1))


@pytest.mark.parametrize(("seed", "paths"), [(1, 1), (2, 5), (3, 60)])
def test_places_beside_another_stretch_are_those_of_all_pieces(seed: int, paths: int) -> None:
    samples = wandering(seed, paths, 20.0)
    chosen = np.arange(0, len(samples.points), 2)
    places, path, along = samples.points[chosen], samples.path[chosen], samples.along[chosen]
    pieces, where, apart = nearest_pieces(places, samples, min(len(samples.points), 400))
    is_own = (samples.path[pieces] == path[:, None]) & (
        np.abs(where - along[:, None]) <= SELF_STRETCH * REACH / TOUCHING
    )
    expected = ((apart <= REACH) & ~is_own).any(axis=1)
    assert expected.any()
    assert not expected.all()
    beside = are_beside(places, path, along, samples, REACH)
    np.testing.assert_array_equal(beside, expected)


@pytest.mark.parametrize(("seed", "paths", "size"), [(1, 1, 5.0), (2, 30, 60.0), (3, 200, 150.0)])
def test_paths_that_touch_are_joined_as_by_all_pairs(seed: int, paths: int, size: float) -> None:
    samples = wandering(seed, paths, size)
    pairs = samples.path[cKDTree(samples.points).query_pairs(REACH, output_type="ndarray")]
    expected, groups = label_connected(pairs[:, 0], pairs[:, 1], paths)
    group = join_near_paths(samples.points, samples.path, REACH)
    assert paths == 1 or 1 < groups < paths
    assert len(np.unique(np.stack([group, expected]), axis=1).T) == groups == len(np.unique(group))


@pytest.mark.parametrize("raster", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("count", [1, 2, 3, 100, 4000])
def test_several_neighbours_are_those_of_a_tree_also_where_some_are_as_near(count: int, raster: float) -> None:
    random = np.random.default_rng(count)
    points, layer = random.random((count, 2)) * 40, np.sort(random.integers(0, 3, count))
    points = np.round(points / raster) * raster if raster else points
    beads = index_beads(points, layer)
    chosen = random.integers(0, count, 500)
    distance, number = beads.nearest(points[chosen], layer[chosen], 1.35, range(2, 6))
    slot = np.searchsorted(beads.layers, layer[chosen])
    shifted = np.stack([points[chosen, 0] + slot * beads.pitch, points[chosen, 1]], axis=1)
    expected, expected_number = beads.tree.query(shifted, k=[2, 3, 4, 5], distance_upper_bound=1.35)
    np.testing.assert_array_equal(distance, expected)
    exists = np.isfinite(distance)
    sets = [np.sort(np.where(exists, numbers, -1), axis=1) for numbers in (number, expected_number)]
    np.testing.assert_array_equal(*sets)


@pytest.mark.parametrize("raster", [0.0, 0.5])
@pytest.mark.parametrize("count", [1, 2, 3, 100, 4000])
def test_the_projection_to_beads_is_that_of_a_tree(count: int, raster: float) -> None:
    """However far away they are, and where two are as near as each other."""
    random = np.random.default_rng(count)
    points, places = random.random((count, 2)) * 40, random.random((900, 2)) * 90 - 30
    half = random.choice([0.0, 0.1, -0.1, 0.25], (count, 2))
    if raster:
        points, places = (np.round(values / raster) * raster for values in (points, places))
    beads = index_beads(points, half=half)
    nearest = beads.tree.query(places, k=list(range(1, min(count, 3) + 1)))[1]
    along, apart = project_to_pieces(places, beads.points, beads.half, nearest)
    rows, choice = np.arange(len(places)), apart.argmin(axis=1)
    chosen = nearest[rows, choice]
    projected, distance = project_to_beads(places, beads)
    np.testing.assert_array_equal(distance, apart[rows, choice])
    expected = points[chosen] + along[rows, choice][:, None] * half[chosen]
    np.testing.assert_allclose(projected, expected, rtol=0, atol=1e-9)
    for reach in (0.0, 0.4, 3.0):
        within, is_near = project_to_beads(places, beads, reach), distance <= reach
        np.testing.assert_array_equal(within[1], np.where(is_near, distance, np.inf))
        np.testing.assert_array_equal(within[0][is_near], projected[is_near])


@pytest.mark.parametrize("count", [0, 1, 2, 300])
def test_pinched_points_are_those_of_all_pairs(count: int) -> None:
    random = np.random.default_rng(count)
    points, ring, around = random.random((count, 2)) * 8, random.integers(0, 2, count), np.array([30.0, 4.0])
    place = random.random(count) * around[ring]
    a, b = cKDTree(points).query_pairs(REACH, output_type="ndarray").T if count else np.empty((2, 0), dtype=int)
    way = np.abs(place[a] - place[b]) % around[ring[a]]
    is_pinch = (ring[a] != ring[b]) | (np.minimum(way, around[ring[a]] - way) > 1.5)
    expected = np.unique(np.concatenate([a[is_pinch], b[is_pinch]]))
    assert count < 9 or 9 < len(expected) < count
    assert find_pinched_points(points, ring, place, around, REACH, 1.5).tolist() == expected.tolist()
