"""The volume beside that of the mask: what the grey values enclose between the voxels."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from test_command_line import run

from infill import Smoothing, smooth_volume
from infill.errors import UsageError
from infill.smoothing.scans import surface_value
from infill.volume import Volume

pytestmark = pytest.mark.usefixtures("compiled")

RADIUS, STEPS = 7.3, Smoothing(steps=4)


def blurred_ball(radius: float = RADIUS) -> np.ndarray:
    """Grey values from 0 to 1000 that are 500 on a ball, with an edge two cells wide."""
    away = np.sqrt(((np.indices((24, 24, 24)) - 11.6) ** 2).sum(axis=0))
    return np.clip((radius - away) / 2 + 0.5, 0, 1) * 1000


@pytest.mark.parametrize("threshold", [500.0, (500.0, None)])
def test_the_volume_of_the_grey_ball_is_that_of_the_ball(threshold: float | tuple[float, None]) -> None:
    result = smooth_volume(blurred_ball(), spacing=0.5, threshold=threshold, smoothing=STEPS, tolerance=None)
    isosurface = result.report["isosurface"]
    assert isosurface["volume"] == pytest.approx(4 / 3 * math.pi * RADIUS**3 / 8, rel=0.015)  # chords of cells
    assert isosurface["change"] == result.surface.volume / isosurface["volume"] - 1


def test_a_mask_that_is_larger_says_so() -> None:
    """Smoothed as a mask at a lower threshold, the ball is a cell larger; the data agree, the isosurface does not."""
    report = smooth_volume(blurred_ball(), threshold=1.0, method="plain", smoothing=STEPS, tolerance=None).report
    assert abs(report["volume_change"]) < 1e-3
    inner = smooth_volume(blurred_ball(), threshold=500.0, method="plain", smoothing=STEPS, tolerance=None).report
    assert report["isosurface"]["volume"] > 1.3 * inner["isosurface"]["volume"]


@pytest.mark.parametrize(
    ("values", "options"),
    [
        (blurred_ball() > 500, {}),
        (np.where(blurred_ball() > 500, 7, 0), {"label": 7}),
        (blurred_ball(), {"threshold": (300.0, 1000.0)}),
        (np.where(blurred_ball() > 500, 1000.0, 0.0), {"threshold": 500.0}),
    ],
    ids=["a mask", "a label", "a range", "two values"],
)
def test_without_grey_values_and_one_threshold_there_is_no_isosurface(values: np.ndarray, options: dict) -> None:
    assert smooth_volume(values, smoothing=STEPS, tolerance=None, **options).report["isosurface"] is None


def test_the_summary_has_both(tmp_path: Path) -> None:
    np.save(tmp_path / "ball.npy", blurred_ball())
    result = run("smooth", tmp_path / "ball.npy", "--threshold", "500", "-o", tmp_path / "a.stl")
    assert result.exit_code == 0, result.stderr
    (row,) = [line for line in result.stderr.splitlines() if line.startswith("  solid")]
    assert "% of the data, " in row
    assert row.endswith("% of the isosurface of the grey values")


@pytest.mark.slow
@pytest.mark.parametrize("kind", [np.uint8, np.float32])
def test_cells_with_the_value_of_the_threshold_are_solid(kind: type) -> None:
    """Where values are whole numbers: with the surface through such cells, a slab of them was lost."""
    labels = np.zeros((30, 30, 30), dtype=kind)
    labels[5:15, 5:25, 5:25], labels[15:20, 5:25, 5:25], labels[20:25, 5:25, 5:25] = 1, 2, 7
    solid = int((labels >= 1).sum())
    for grey in (None, False):
        result = smooth_volume(labels, threshold=1, grey=grey, tolerance=None)
        assert result.report["input"]["grey"] is (grey is None)
        assert result.surface.volume == pytest.approx(solid, rel=0.03)


def test_grey_levels_can_be_left_out() -> None:
    values = blurred_ball()
    kept, left_out = (smooth_volume(values, threshold=500.0, grey=grey, tolerance=None) for grey in (None, False))
    assert kept.report["input"]["grey"] is True
    assert left_out.report["input"]["grey"] is False
    with pytest.raises(UsageError, match="grey is left out, and method is grey"):
        smooth_volume(values, threshold=500.0, grey=False, method="grey")


def test_a_threshold_between_whole_numbers_stays_where_it_is() -> None:
    """Only cells that have its very value call for a surface below it: a share of 0.3 is not 0.5."""
    values = np.zeros((8, 8, 8), dtype=np.float32)
    values[2:6, 2:6, 2:6] = 1
    volume = Volume(values=values)
    assert surface_value(volume, {"method": "range", "low": 0.3}) == 0.3
    assert surface_value(volume, {"method": "range", "low": 1.0}) == 0.5
    assert surface_value(Volume(values=values * 0.7), {"method": "range", "low": 1.0}) == 1.0
