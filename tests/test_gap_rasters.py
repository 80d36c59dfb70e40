"""Gaps on a raster beside `scipy.ndimage`, and the area of a hull beside that of Qhull."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage
from scipy.spatial import ConvexHull

from infill.refilling.widest_gap import hull_area, measure_regions

SHAPES = [(1, 1), (1, 9), (9, 1), (5, 7), (40, 60), (130, 90)]


@pytest.mark.parametrize("share", [0.001, 0.02, 0.3, 0.9, 1.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_regions_and_their_largest_distances_are_those_of_ndimage(shape: tuple[int, int], share: float) -> None:
    random = np.random.default_rng(shape[0])
    free = ndimage.gaussian_filter(random.normal(size=shape), 1.5) > -0.05
    taken = random.random(shape) < share
    taken[random.integers(shape[0]), random.integers(shape[1])] = True
    region, square = measure_regions(free, taken)
    labels, count = ndimage.label(free)
    np.testing.assert_array_equal(region, labels)
    distance = ndimage.distance_transform_edt(~taken)
    expected = np.zeros(count + 1)
    np.maximum.at(expected, labels.ravel(), distance.ravel())
    np.testing.assert_array_equal(square, np.rint(expected**2).astype(int))


@pytest.mark.parametrize("on_raster", [True, False])
@pytest.mark.parametrize("count", [3, 10, 2000])
def test_the_area_of_a_hull_is_that_of_qhull(count: int, on_raster: bool) -> None:
    points = np.random.default_rng(count).normal(size=(count, 2)) * 30
    points = np.round(points, 1) if on_raster else points
    assert hull_area(points) == pytest.approx(ConvexHull(points).volume, rel=1e-12)


@pytest.mark.parametrize("points", [[[3.0, 4.0]], [[1.0, 2.0], [1.0, 2.0]], [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]])
def test_points_on_one_line_have_no_area(points: list[list[float]]) -> None:
    assert hull_area(np.array(points)) == 0.0
