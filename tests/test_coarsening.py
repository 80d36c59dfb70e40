"""Larger cells in the place of those of a scan."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from infill import GeometryError, ParameterError, Volume, smooth_volume
from infill.voxels.coarsening import coarsen


@given(st.integers(0, 99), st.tuples(*[st.integers(2, 9)] * 3), st.integers(1, 4))
def test_whole_factors_are_means_of_blocks(seed: int, cells: tuple[int, int, int], factor: int) -> None:
    values = np.random.default_rng(seed).normal(size=[count * factor for count in cells])
    found = coarsen(Volume(values=values), float(factor))
    blocks = values.reshape(cells[0], factor, cells[1], factor, cells[2], factor).mean(axis=(1, 3, 5))
    assert found.spacing == (factor, factor, factor)
    assert np.allclose(found.values, blocks, atol=1e-6)


@given(st.floats(1.0, 6.0), st.tuples(*[st.integers(12, 30)] * 3))
def test_what_is_even_stays_even_and_slopes_stay_slopes(voxel: float, shape: tuple[int, int, int]) -> None:
    even = coarsen(Volume(values=np.full(shape, 7.5), spacing=(1.0, 1.0, 2.0)), voxel)
    assert np.allclose(even.values, 7.5)
    assert even.spacing == pytest.approx((voxel, voxel, max(voxel, 2.0)))
    x = np.broadcast_to(np.arange(shape[0])[:, None, None] + 0.5, shape)
    slope = coarsen(Volume(values=x), voxel).values[:, 0, 0]
    middles = (np.arange(len(slope)) + 0.5) * voxel
    assert np.abs(slope - middles)[:-1].max() < 0.13  # cells that are cut count as even; the last may reach beyond


@pytest.mark.slow
def test_a_mask_keeps_its_volume_in_larger_voxels() -> None:
    solid = ((np.indices((60, 60, 60)) - 29.5) ** 2).sum(axis=0) < 24**2
    result = smooth_volume(solid, voxel=2.5, tolerance=None)
    assert result.report["volume"] == pytest.approx(solid.sum(), rel=0.01)
    assert result.report["grid"]["spacing"] == [2.5, 2.5, 2.5]
    assert result.report["input"]["coarse"] is True
    assert any("was not compared" in change for change in result.report["verdict"]["changes"])
    grey = np.where(solid, 300.0, 20.0)
    grey[0, 0, 0] = 100.0  # so that it is no mask
    assert smooth_volume(grey, threshold=160, voxel=2.0, tolerance=None).report["volume"] == pytest.approx(
        solid.sum(), rel=0.02
    )


@pytest.mark.parametrize(
    ("voxel", "says"), [(0.5, "give no less"), (20.0, "give at most 13 mm"), (-1.0, "voxel is -1")]
)
def test_sizes_that_make_no_sense(voxel: float, says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        coarsen(Volume(values=np.zeros((26, 9, 9))), voxel)


def crossing_sheets() -> NDArray[np.uint8]:
    """Two sheets of two cells, 40 x 40 cells each, that cross: 3,120 cells."""
    cells = np.zeros((60, 60, 60), dtype=np.uint8)
    cells[29:31, 10:50, 10:50] = 1
    cells[10:50, 29:31, 10:50] = 1
    return cells


@pytest.mark.parametrize("voxel", [1.2, 2.0, 3.0])
def test_larger_voxels_that_change_the_solid_are_refused_at_once_with_a_size_that_keeps_it(voxel: float) -> None:
    """The volume is compared with that of the cells that were given, and not with that of the larger ones."""
    sheets = crossing_sheets()
    with pytest.raises(GeometryError, match=r"the larger voxels hold \d+% (more|less) than the 6,240 mm³") as caught:
        smooth_volume(sheets, voxel=voxel)
    fitting = re.search(r"--voxel ([\d.]+) keeps it", str(caught.value))
    if fitting:
        assert smooth_volume(sheets, voxel=float(fitting[1])).surface.volume == pytest.approx(6240, rel=0.05)
    else:
        assert "leave --voxel out" in str(caught.value)
    broken = smooth_volume(sheets, voxel=voxel, allow_broken=True).report
    assert broken["verdict"]["word"] == "lost"
    assert broken["input"]["coarsened"]["volume_before"] == 6240


def test_larger_voxels_that_keep_the_solid_say_nothing_of_it() -> None:
    x, y, z = np.indices((40, 40, 40)) - 19.5
    ball = (x**2 + y**2 + z**2 < 17**2).astype(np.uint8)
    report = smooth_volume(ball, voxel=2.0).report
    assert abs(report["input"]["coarsened"]["change"]) < 0.05
    assert not any("larger voxels hold" in text for text in report["verdict"]["changes"])
