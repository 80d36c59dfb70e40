"""What is solid: the same cells by every way of saying so, and no guess where values do not tell."""

from __future__ import annotations

import json
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.ndimage import gaussian_filter
from skimage.filters import threshold_otsu

from infill.errors import LabelChoiceError, ParameterError
from infill.imaging.volume_files import read_volume
from infill.volume import Volume
from infill.voxels.segmentation import contrast, edge_window, otsu_threshold, scale_grey_values, segment_volume
from infill.voxels.slices import interpolate_slices, plan_sublayers


def volume(values: Any, dtype: Any = None) -> Volume:
    cells = np.asarray(values, dtype=dtype)
    return Volume(
        values=cells.reshape(*cells.shape, *(1,) * (3 - cells.ndim)), spacing=(1, 2, 3), origin=(4, 5, 6), space="LPS"
    )


RAMP = np.arange(-8, 19).reshape(3, 3, 3)


def ball(cells: int = 24, radius: float = 8.0) -> np.ndarray:
    """Signed distance to a ball, cells, positive inside."""
    axis = np.arange(cells) - (cells - 1) / 2
    return radius - np.sqrt(axis[:, None, None] ** 2 + axis[:, None] ** 2 + axis**2)


@pytest.mark.parametrize("dtype", [np.int8, np.int16, np.int32, np.int64, np.float32, float])
@pytest.mark.parametrize(
    ("way", "expected"),
    [
        ({"low": 3}, RAMP >= 3),
        ({"low": 2.5}, RAMP >= 3),
        ({"high": 3}, RAMP <= 3),
        ({"high": 3.7}, RAMP <= 3),
        ({"low": -2, "high": 3}, (RAMP >= -2) & (RAMP <= 3)),
        ({"low": float("-inf"), "high": 3}, RAMP <= 3),
        ({"low": -1000, "high": 3}, RAMP <= 3),
        ({"label": 4}, RAMP == 4),
        ({"label": (4, -3)}, (RAMP == 4) | (RAMP == -3)),
    ],
)
def test_each_way_says_which_cells(way: dict[str, Any], expected: np.ndarray, dtype: Any) -> None:
    given = volume(RAMP.astype(dtype))
    before = given.values.copy()
    solid, used = segment_volume(given, **way)
    assert solid.values.dtype == bool
    assert np.array_equal(solid.values, expected)
    assert (solid.spacing, solid.origin, solid.space) == (given.spacing, given.origin, given.space)
    assert used["values"] == [-8, 18]
    assert used["solid"] == expected.mean()
    assert used["method"] == ("label" if "label" in way else "range")
    json.dumps(used)
    assert np.array_equal(given.values, before)


@pytest.mark.parametrize(("dtype", "low"), [(np.uint8, 200), (np.int64, 2**62 + 1), (np.uint64, 2**63 + 1)])
def test_whole_numbers_are_compared_as_such(dtype: Any, low: int) -> None:
    """As 64-bit floating-point numbers, the large ones would not differ by 1."""
    values = np.array([[[0, low - 1, low]]], dtype=dtype)
    assert segment_volume(volume(values), low=low)[0].values.tolist() == [[[False, False, True]]]
    assert segment_volume(volume(values), label=low)[0].values.tolist() == [[[False, False, True]]]
    with pytest.raises(ParameterError, match="every cell"):
        segment_volume(volume(values), low=-1)


@pytest.mark.parametrize("pair", [(0, 1), (-1, 1), (0, 255), (0, 9), (0, 1000)])
@pytest.mark.parametrize("dtype", [np.int16, np.float32, float])
def test_two_values_are_a_mask(pair: tuple[int, int], dtype: Any) -> None:
    expected = RAMP % 3 == 0
    solid, used = segment_volume(volume(np.where(expected, pair[1], pair[0]), dtype))
    assert np.array_equal(solid.values, expected)
    assert used["method"] == "mask"


def test_booleans_stay() -> None:
    given = volume(RAMP > 3)
    solid, used = segment_volume(given)
    assert solid.values is given.values
    assert used == {"method": "mask", "values": [False, True], "solid": (RAMP > 3).mean()}


def test_a_field_of_both_signs_is_a_phase() -> None:
    field = np.linspace(-1, 0.7, 27).reshape(3, 3, 3)
    solid, used = segment_volume(volume(field))
    assert np.array_equal(solid.values, field > 0)
    assert used["method"] == "phase"


@pytest.mark.parametrize(
    ("values", "least", "most"),
    [
        (RAMP, -8, 18),
        (RAMP / 27.0 + 0.3, 0.0037, 0.967),
        (RAMP / 10, -0.8, 1.8),
        (np.where(RAMP > 3, 0, -1000), -1000, 0),  # which of them is void, air or water?
        (np.clip(RAMP, -1, 1), -1, 1),
    ],
)
def test_values_that_do_not_tell_are_not_guessed(values: np.ndarray, least: float, most: float) -> None:
    with pytest.raises(ParameterError, match="do not say what is solid") as caught:
        segment_volume(volume(values))
    said = str(caught.value)
    assert f"from {least:.3g}"[:7] in said
    for offer in ("--threshold X", "--range LOW,HIGH", "--label N", "--otsu (finds "):
        assert offer in said
    hint = float(said.partition("(finds ")[2].rstrip(")"))
    assert hint == pytest.approx(otsu_threshold(volume(values)), rel=1e-5)


@pytest.mark.parametrize("values", [np.where(RAMP > 3, 2, 1), np.clip(RAMP, 0, 2)], ids=["neither is 0", "0 and two"])
def test_few_values_that_fill_regions_are_labels(values: np.ndarray) -> None:
    with pytest.raises(LabelChoiceError, match=r"holds 2 labels: 1 \(\d+ mm³\), 2 \(\d+ mm³\); give -o"):
        segment_volume(volume(values))


@pytest.mark.parametrize(
    ("way", "says"),
    [
        ({"low": 19}, "threshold is 19, and no cell would be solid; the values go from -8 to 18"),
        ({"high": -9}, "no cell"),
        ({"low": -8}, "threshold is -8, and every cell would be solid"),
        ({"low": -np.inf, "high": np.inf}, "every cell"),
        ({"label": 99}, "label is 99, and no cell would be solid; the values go from -8 to 18"),
        ({"low": 5, "high": 2}, "give the lower end first"),
        ({"low": np.nan}, "threshold is nan"),
        ({"high": "much"}, "threshold is 'much'; it must be a number"),
        ({"label": 1.5}, "label is 1.5; it must be a whole number"),
        ({"label": True}, "label is True"),
        ({"label": ()}, "label is empty"),
        ({"low": 1, "otsu": True}, "exclude each other"),
        ({"high": 1, "label": 1}, "exclude each other"),
        ({"label": 1, "otsu": True}, "exclude each other"),
    ],
)
def test_a_choice_that_cannot_be(way: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says) as caught:
        segment_volume(volume(RAMP), **way)
    assert "\n" not in str(caught.value)


def test_few_labels_are_named() -> None:
    with pytest.raises(ParameterError, match=r"label is 7, and no cell would be solid; .* from 0 to 4 \(0, 2, 4\)"):
        segment_volume(volume(np.array([0, 2, 4, 4])), label=7)


@pytest.mark.parametrize("cells", [np.zeros(5), np.ones(5, bool), np.zeros(5, bool), np.ones(5, np.int16)])
def test_volumes_of_one_value(cells: np.ndarray) -> None:
    for options in ({}, {"otsu": True}, {"low": 0.5}):
        with pytest.raises(ParameterError, match=r"would be solid|all values are|do not say what is solid"):
            segment_volume(volume(cells), **options)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_cells_that_are_no_numbers(bad: float) -> None:
    cells = np.array([0.0, 1.0, bad])
    for work in (
        lambda: segment_volume(volume(cells), low=0.5),
        lambda: otsu_threshold(volume(cells)),
        lambda: scale_grey_values(volume(cells), 0.5),
    ):
        with pytest.raises(ParameterError, match="NaN or infinite"):
            work()


# --- Otsu ------------------------------------------------------------------------------------------------


@given(st.lists(st.integers(-300, 900), min_size=2, max_size=60).filter(lambda cells: len(set(cells)) > 1))
def test_otsu_parts_best(cells: list[int]) -> None:
    """No other threshold has a larger variance between the two classes."""
    values = np.array(cells, dtype=np.int16)

    def between(level: float) -> float:
        low, high = values[values < level], values[values >= level]
        return len(low) * len(high) * (low.mean() - high.mean()) ** 2

    found = between(otsu_threshold(volume(values)))
    # Sums of up to 60 products: rounding of the last places.
    assert found >= max(between(level) for level in np.unique(values)[1:]) * (1 - 1e-9)


@pytest.mark.parametrize("order", ["C", "F"])
def test_otsu_agrees_with_scikit_image(order: Any, rng: np.random.Generator) -> None:
    values = np.where(
        rng.random((20, 21, 22)) < 0.3, rng.normal(900, 90, (20, 21, 22)), rng.normal(-50, 120, (20, 21, 22))
    )
    whole = np.asarray(values.astype(np.int16), order=order)
    assert np.array_equal(whole >= otsu_threshold(volume(whole)), whole > threshold_otsu(whole))
    # It parts the same cells, in the middle between the classes; bins are a 4096th of about 1700.
    parted = np.asarray(values, order=order)
    assert ((parted >= otsu_threshold(volume(parted))) != (parted > threshold_otsu(values, 4096))).mean() < 1e-3
    assert segment_volume(volume(whole), otsu=True)[1]["low"] == otsu_threshold(volume(whole))
    wide = whole.astype(np.int32) * 1000
    assert np.array_equal(wide >= otsu_threshold(volume(wide)), whole > threshold_otsu(whole))


def test_large_volumes_are_looked_at_in_parts(rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch) -> None:
    values = rng.integers(-500, 500, (9, 10, 11)).astype(np.int16)
    whole = otsu_threshold(volume(values)), contrast(volume(values), 20), contrast(volume(values.T), 20)
    monkeypatch.setattr("infill.voxels.segmentation.SLAB", 25)
    assert (otsu_threshold(volume(values)), contrast(volume(values), 20)) == whole[:2]
    assert whole[2] == pytest.approx(whole[1], rel=1e-12)


def test_nothing_is_turned_into_64_bits() -> None:
    """int16, 8 MiB: a copy of 64-bit numbers would take 32."""
    values = np.zeros((128, 128, 256), dtype=np.int16)
    values[:64] = 400
    values[0, 0, 0] = -1000
    given = volume(values)
    segment_volume(volume(values[:2, :2]), otsu=True)  # scikit-image loads

    def peak(work: Any) -> float:
        tracemalloc.start()
        work()
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most / 2**20

    assert peak(lambda: segment_volume(given, low=200)) < 5  # the booleans, 4
    assert peak(lambda: segment_volume(given, low=200, high=500)) < 9  # two of them
    assert peak(lambda: scale_grey_values(given, 200, 400)) < 17  # the field, 16


# --- grey ------------------------------------------------------------------------------------------------


def test_grey_of_a_mask_is_plus_and_minus_one() -> None:
    given = volume(np.where(ball() > 0, 255, 0), np.uint8)
    field = scale_grey_values(given, 127.5)
    assert contrast(given, 127.5) == 255
    assert field.values.dtype == np.float32
    assert np.array_equal(field.values, np.where(ball() > 0, 1, -1))
    assert (field.spacing, field.origin, field.space) == (given.spacing, given.origin, given.space)


@pytest.mark.parametrize("dtype", [np.int16, np.uint16, np.float32, float])
def test_grey_keeps_the_sign_and_the_bounds(dtype: Any) -> None:
    values = (1000 + 200 * np.clip(ball(), -3, 3)).astype(dtype)
    before = values.copy()
    field = scale_grey_values(volume(values), 1100).values
    assert np.array_equal(field > 0, values > 1100)
    assert np.abs(field).max() == 1
    assert (np.abs(field) < 1).any()
    assert np.array_equal(values, before)


@pytest.mark.slow
def test_grey_of_a_flipped_and_scaled_scan_is_the_same() -> None:
    """Grey values have no unit: another zero and another scale change nothing but rounding to 32 bits."""
    values = 200 * np.clip(ball(), -3, 3)
    one, other = scale_grey_values(volume(values), 100), scale_grey_values(volume(values * 0.01 + 7), 8)
    assert other.values == pytest.approx(one.values, abs=1e-4)
    assert scale_grey_values(volume(values.T), 100).values == pytest.approx(one.values.T, abs=1e-6)


def test_the_edge_is_about_a_cell_wide() -> None:
    """On a ball f goes from -1 to +1 over one cell along the normal; on a face along the axes over 1.5."""
    flat = np.broadcast_to(np.linspace(-3, 3, 25)[:, None, None] * 80, (25, 4, 4))
    assert contrast(volume(flat), 1) == pytest.approx(20)
    # A pair lies across the surface as often as the normal points its way: the mean step is 1 / mean |n|_1 = 2/3.
    assert contrast(volume(80 * ball(40, 15.0)), 1) == pytest.approx(80 * 2 / 3, rel=0.02)
    assert edge_window(volume(80 * ball(40, 15.0)), 1) == pytest.approx(80, rel=0.02)


def test_spots_far_away_do_not_weigh() -> None:
    values = np.clip(ball() * 100, -100, 100)
    spotted = values.copy()
    spotted[12, 12, 12] = 1e5
    assert np.array_equal(scale_grey_values(volume(spotted), 3).values, scale_grey_values(volume(values), 3).values)


def test_the_surface_of_grey_data_is_nearer_than_that_of_a_mask() -> None:
    """Where f = 0 between two cells along x, against the true ball: cells."""
    values = np.clip(ball(), -1.5, 1.5) * 300 + 1000

    def distances(field: np.ndarray) -> np.ndarray:
        across = (field[1:] > 0) != (field[:-1] > 0)
        a, b = field[:-1][across], field[1:][across]
        part = a / (a - b)
        truth = ball()
        return (truth[:-1][across] * (1 - part) + truth[1:][across] * part) ** 2

    mask = np.where(values > 1000, 1.0, -1.0)
    grey_field = scale_grey_values(volume(values), 1000.0)
    assert np.sqrt(distances(grey_field.values).mean()) < 0.2 * np.sqrt(distances(mask).mean())


@pytest.mark.parametrize(
    ("level", "window", "says"),
    [
        (-9, None, "from -8 to 18"),
        (18, None, "choose within"),
        (np.nan, None, "level is nan"),
        (3, 0, "window is 0"),
        (3, -1, "window is -1"),
    ],
)
def test_a_level_or_window_that_cannot_be(level: float, window: float | None, says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        scale_grey_values(volume(RAMP), level, window)
    with pytest.raises(ParameterError, match="no surface lies at 99"):
        contrast(volume(RAMP), 99)


# --- real ones -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_real_scans(data: Path) -> None:
    folder = data / "volumes"
    head = read_volume(folder / "ct_head_cranium_int16.npz")
    solid, used = segment_volume(head, low=226)
    assert used["solid"] == pytest.approx(0.08486, abs=1e-5)
    assert np.array_equal(solid.values, np.load(folder / "ct_head_cranium_int16.npz")["hu"].T >= 226)
    assert contrast(head, 226) == pytest.approx(370.4, abs=0.1)
    skull, used = segment_volume(read_volume(folder / "seg_skull_label_seg3d.npz"))
    assert used["method"] == "mask"
    assert np.array_equal(skull.values, np.load(folder / "seg_skull_label_seg3d.npz")["label"].T == 1)
    with pytest.raises(ParameterError, match=r"from 0 to 3926 .*--otsu \(finds 648.5\)"):
        segment_volume(read_volume(folder / "ct_headsq_64x64x93_uint16.npz"))


def pillar(place: float, thickness: float, *, is_ball: bool) -> tuple[Volume, float]:
    """Return the filled share of cells in slices, of a ball or a pillar from -6 to 6 mm, and where its middle lies."""
    spacing, middle, parts = (0.4, 0.4, thickness), place * thickness, 12
    count = int(24 / thickness) | 1
    x, y = ((np.arange(37) - 18) * spacing[0] for _ in range(2))
    z = ((np.arange(count * parts) + 0.5) / parts - count / 2) * thickness - middle
    across = x[:, None, None] ** 2 + y[:, None] ** 2
    solid = across + z**2 < 36 if is_ball else (across < 9) & (np.abs(z) < 6)
    return Volume(values=solid.reshape(37, 37, count, parts).mean(axis=3), spacing=spacing), middle


@pytest.mark.parametrize("thickness", [1.2, 2.0, 4.0])
@pytest.mark.parametrize("place", [0.0, 0.2, 0.4, 0.6, 0.8])
@pytest.mark.parametrize("is_ball", [True, False])
def test_ends_between_thick_slices_lie_where_grey_values_say(thickness: float, place: float, *, is_ball: bool) -> None:
    """Within an eighth of a slice; as a mask, half a slice."""
    shares, middle = pillar(place, thickness, is_ball=is_ball)
    grey = scale_grey_values(shares, 0.5)
    mask = replace(shares, values=np.asarray(shares.values) > 0.5)
    for data, allowed in ((grey, thickness / 8), (mask, thickness / 2)):
        fine = interpolate_slices(data, *plan_sublayers(data))
        column, height = np.asarray(fine.values)[18, 18], fine.cell_size[2]
        inside = np.flatnonzero(column > 0)
        crossings = [
            outer + (inner - outer) * column[outer] / (column[outer] - column[inner])
            for inner, outer in ((inside[0], inside[0] - 1), (inside[-1], inside[-1] + 1))
        ]
        ends = (np.array(crossings) + 0.5) * height - shares.values.shape[2] * thickness / 2
        assert np.abs(np.abs(ends - middle) - 6).max() <= allowed + 1e-6


@pytest.mark.parametrize("share", [0.55, 0.7, 0.9])
@pytest.mark.parametrize("fill", [0.0, 0.2, 0.4, 0.6, 0.8])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_wall_is_as_high_beside_its_outline_as_within(share: float, fill: float, sign: int) -> None:
    """Where a straight wall fills a part of a pixel, this part is of its width, not of its height; so for pits.

    Pixels that the last slice holds less than half of, and those beside them more than half, are of a moving outline.
    """
    lying = np.array([0.0, share, 1.0, 1.0, 1.0, share, 0.0])
    standing = np.array([0.0, 0.0, fill, 1.0, 1.0, 1.0, 0.0, 0.0])
    shares = np.broadcast_to(lying[:, None, None] * standing, (7, 9, 8))
    data = Volume(values=(sign * (2 * shares - 1)).astype(np.float32), spacing=(0.5, 0.5, 2.0))
    fine = sign * np.asarray(interpolate_slices(data, 2, 20).values)  # cells of 0.1 mm
    for column, part in zip(fine[1:6, 4], lying[1:6], strict=True):
        inside = np.flatnonzero(column > 0)
        bottom, top = inside[0] / 10, (inside[-1] + 1) / 10
        assert top == pytest.approx(12, abs=2 / 8 + 0.05)
        if (part * fill > 0.5) == (fill > 0.5):
            assert bottom == pytest.approx(6 - 2 * fill, abs=2 / 8 + 0.05)


@pytest.mark.parametrize("count", [3, 4])
def test_slices_have_no_preferred_side(count: int, rng: np.random.Generator) -> None:
    """Read from the other end, or with solid and void exchanged, the shape between slices is the same."""
    values = gaussian_filter(rng.normal(size=(24, 21, 9)), (2, 2, 0.3)).astype(np.float32) * 10
    data = Volume(values=values.clip(-1, 1), spacing=(1, 1, count))
    fine = np.asarray(interpolate_slices(data, 2, count).values)
    flipped = interpolate_slices(replace(data, values=data.values[:, :, ::-1]), 2, count)
    assert np.allclose(np.asarray(flipped.values)[:, :, ::-1], fine, atol=1e-5)
    inverted = interpolate_slices(replace(data, values=-np.asarray(data.values)), 2, count)
    assert np.allclose(-np.asarray(inverted.values), fine, atol=1e-5)
    middles = fine[:, :, count // 2 :: count]
    assert count % 2 == 0 or ((middles > 0) == (values > 0)).all()
