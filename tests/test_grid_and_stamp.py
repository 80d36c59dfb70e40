"""Grids and stamps."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from infill import Grid, ParameterError, stamp, stamp_lines
from patterns import Honeycomb


@pytest.mark.parametrize("bad", [0, -1, math.nan, math.inf])
def test_bad_sizes_are_refused(bad: float) -> None:
    with pytest.raises(ParameterError, match="spacing is"):
        Grid(shape=(3, 3), spacing=bad)
    with pytest.raises(ParameterError, match="number of cells"):
        Grid(shape=(3, bad), spacing=1)


def test_shapes_and_origins_must_agree() -> None:
    with pytest.raises(ParameterError, match="empty"):
        Grid(shape=(), spacing=1)
    with pytest.raises(ParameterError, match="2 numbers for 3 axes"):
        Grid(shape=(2, 2, 2), spacing=(1, 2))
    with pytest.raises(ParameterError, match="origin"):
        Grid(shape=(2, 2), spacing=1, origin=(0, 0, 0))
    with pytest.raises(ParameterError, match="it must be a number"):
        Grid(shape=(2, True), spacing=1)


def test_cell_centres_lie_half_a_cell_inside() -> None:
    grid = Grid(shape=(4, 2), spacing=(0.5, 2.0), origin=(1.0, -1.0))
    assert grid.centres(0).tolist() == [1.25, 1.75, 2.25, 2.75]
    assert grid.centres(1).tolist() == [0.0, 2.0]
    assert grid.extents == (2.0, 4.0)
    assert grid.cells == 8


@given(
    x=st.floats(0, 8, allow_subnormal=False),
    y=st.floats(0, 6, allow_subnormal=False),
    block=st.sampled_from([1, 3, 5]),
)
def test_a_lone_point_stamps_the_block_centred_on_its_cell(x: float, y: float, block: int) -> None:
    grid = Grid(shape=(16, 12), spacing=0.5)
    solid = stamp([(x, y)], grid, block=block) > 0
    cell = min(int(x / 0.5), 15), min(int(y / 0.5), 11)
    reach = block // 2
    expected = np.zeros(grid.shape, dtype=bool)
    expected[max(0, cell[0] - reach) : cell[0] + reach + 1, max(0, cell[1] - reach) : cell[1] + reach + 1] = True
    assert np.array_equal(solid, expected)


def test_a_lone_point_stamps_block_cubed_in_3d() -> None:
    field = stamp([(2.5, 2.5, 2.5)], Grid(shape=(5, 5, 5), spacing=1.0))
    assert field.shape == (5, 5, 5)
    assert (field > 0).sum() == 27
    assert set(np.unique(field)) == {-1.0, 1.0}


def test_no_points_stamp_nothing() -> None:
    assert (stamp(np.empty((0, 2)), Grid(shape=(3, 3), spacing=1)) == -1).all()


@pytest.mark.parametrize("block", [0, 2, 4, -3])
def test_even_blocks_are_refused(block: int) -> None:
    with pytest.raises(ParameterError, match="odd|whole number"):
        stamp([(0.5, 0.5)], Grid(shape=(3, 3), spacing=1), block=block)


def test_points_outside_are_an_error_or_clipped() -> None:
    grid = Grid(shape=(4, 4), spacing=1)
    points = [(0.5, 0.5), (4.2, 2.0), (-1, 0)]
    with pytest.raises(ParameterError, match=r"2 of 3 points lie outside the grid, the first at \(4.2, 2\)"):
        stamp(points, grid)
    assert np.array_equal(stamp(points, grid, outside="clip"), stamp(points[:1], grid))


def test_points_that_are_no_numbers_are_refused() -> None:
    with pytest.raises(ParameterError, match="finite"):
        stamp([(math.nan, 0.5)], Grid(shape=(3, 3), spacing=1), outside="clip")


@pytest.mark.parametrize("points", [[(1, 1, 4), (2, 2, 4)], [1.0, 2.0], np.ones((2, 2, 2))])
def test_points_must_have_the_axes_of_the_grid(points: object) -> None:
    with pytest.raises(ParameterError, match=r"give \(N, 2\) for a grid of 2 axes"):
        stamp(points, Grid(shape=(5, 5), spacing=1.0))


def test_stamps_refuse_what_they_do_not_know() -> None:
    grid = Grid(shape=(3, 3), spacing=np.array(1.0))
    with pytest.raises(ParameterError, match="outside is 'cut'"):
        stamp([(1, 1)], grid, outside="cut")
    with pytest.raises(ParameterError, match="block"):
        stamp([(1, 1)], grid, block=1.5)
    assert (stamp([(1.5, 1.5)], grid, block=3.0) == 1).all()


def test_stamping_follows_mirrors(rng: np.random.Generator) -> None:
    grid = Grid(shape=(20, 20), spacing=0.5, origin=(-5, -5))
    points = rng.uniform(-5, 5, (30, 2))
    assert np.array_equal(stamp(points * [-1, 1], grid), stamp(points, grid)[::-1])
    assert np.array_equal(stamp(points[:, ::-1], grid), stamp(points, grid).T)


@pytest.mark.parametrize("spacing", [0.2, (0.2, 0.3)])
@pytest.mark.parametrize("angle", [0, 6, 45, 75])
def test_the_exact_stamp_is_the_clipped_distance(angle: float, spacing: float | tuple[float, float]) -> None:
    """It falls from solid to void over the smaller side of a cell, 0.2 mm."""
    grid = Grid(shape=(60, 50), spacing=spacing, origin=(-6, -5))
    lines = Honeycomb(cell=4, angle=angle).lines(shapely.box(-5, -4, 5, 4))
    x, y = np.meshgrid(grid.centres(0), grid.centres(1), indexing="ij")
    distance = shapely.distance(shapely.points(x, y), lines)
    expected = np.clip((1.0 / 2 - distance) / 0.1, -1, 1)
    assert np.abs(stamp_lines(lines, grid, width=1.0) - expected).max() < 1e-5  # float32


def test_the_exact_stamp_takes_flat_cells() -> None:
    grid = Grid(shape=(40, 20), spacing=(0.1, 0.2))
    line = shapely.MultiLineString([[(2.0, 0.0), (2.0, 4.0)]])
    field = stamp_lines(line, grid, width=0.6)
    solid_length = ((field + 1) / 2).sum() * 0.1 * 0.2 / 4.0
    assert solid_length == pytest.approx(0.6, abs=1e-6)


def test_the_exact_stamp_refuses_what_it_cannot_do() -> None:
    line = shapely.MultiLineString([[(0, 0), (1, 1)]])
    with pytest.raises(ParameterError, match="2 axes"):
        stamp_lines(line, Grid(shape=(2, 2, 2), spacing=1), width=1)
    with pytest.raises(ParameterError, match="line width"):
        stamp_lines(line, Grid(shape=(2, 2), spacing=1), width=0)


def test_an_exact_stamp_of_no_lines_is_void() -> None:
    assert (stamp_lines(shapely.MultiLineString([]), Grid(shape=(3, 3), spacing=1), width=1) == -1).all()


def test_many_lines_are_stamped_some_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    grid = Grid(shape=(80, 80), spacing=0.25, origin=(-10, -10))
    lines = Honeycomb(cell=3).lines(shapely.box(-9, -9, 9, 9))
    whole = stamp_lines(lines, grid, width=0.75)
    monkeypatch.setattr("infill.voxels.stamping.CANDIDATES_AT_ONCE", 100)
    assert np.array_equal(stamp_lines(lines, grid, width=0.75), whole)
