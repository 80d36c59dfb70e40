"""Smoothing some of the components of a scan or mesh alone: as if the others had never been in the file."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from infill import InfillError, Surface, smooth_mesh, smooth_volume
from infill.smoothing.kept_components import choose_components, find_mesh_components, find_scan_components
from infill.volume import Volume

BALLS = ((8, 6), (22, 5), (33, 3))  # middles along x and radii


def balls(*numbers: int) -> np.ndarray:
    """Return grey values of balls, which fade at their surface, so that their places in cells are known better."""
    values = np.zeros((40, 18, 18), np.int16)
    for number in numbers:
        middle, radius = BALLS[number - 1]
        away = np.sqrt(((np.indices(values.shape) - np.reshape((middle, 9, 9), (3, 1, 1, 1))) ** 2).sum(axis=0))
        values = np.maximum(values, np.clip(100 * (radius - away), 0, 100).astype(np.int16))
    return values


@pytest.mark.longest
@pytest.mark.parametrize("threshold", [50, "otsu", (50, None)])
def test_what_is_kept_is_smoothed_as_if_the_rest_had_never_been_there(threshold) -> None:
    steps = {"method": "plain", "tolerance": 0}
    kept = smooth_volume(balls(1, 2, 3), threshold=threshold, keep_components="1,3", **steps)
    alone = smooth_volume(balls(1, 3), threshold=kept.report["input"]["segmentation"]["low"], **steps)
    assert kept.report["components"] == 2
    np.testing.assert_array_equal(kept.surface.vertices, alone.surface.vertices)
    np.testing.assert_array_equal(kept.surface.faces, alone.surface.faces)


def test_components_count_from_the_largest() -> None:
    scan = find_scan_components(Volume(values=balls(3, 1, 2)), threshold=50)
    sizes = [int((balls(number) >= 50).sum()) for number in (1, 2, 3)]
    assert scan.volumes.tolist() == sizes
    for number, (middle, _) in enumerate(BALLS):
        assert scan.place(number) == [middle + 0.5, 9.5, 9.5]


@pytest.mark.parametrize(
    "values", [balls(1, 2, 3) > 50, (balls(1, 2, 3) > 50).astype(np.uint8), balls(1, 2, 3) / 50 - 1.0]
)
def test_masks_and_phase_fields_keep_their_void(values: np.ndarray) -> None:
    found = find_scan_components(Volume(values=values))
    kept = found.keep(np.array([False, True, False])).values
    assert kept.dtype == values.dtype
    solid = kept > 0
    assert not solid[:16].any()
    assert not solid[29:].any()
    np.testing.assert_array_equal(kept[17:28], values[17:28])


def test_a_component_of_a_mesh_is_kept_with_its_cavity() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2, radius=5)
    cavity = trimesh.creation.icosphere(subdivisions=2, radius=2)
    cavity.invert()
    both = trimesh.util.concatenate([trimesh.creation.box((30, 30, 30)).apply_translation((40, 0, 0)), ball, cavity])
    surface = Surface(vertices=np.asarray(both.vertices), faces=np.asarray(both.faces))
    found = find_mesh_components(surface)
    assert found.volumes == pytest.approx([27000, ball.volume + cavity.volume])
    kept = found.keep(np.array([False, True]))
    assert kept.volume == pytest.approx(ball.volume + cavity.volume)


@pytest.mark.longest
def test_a_mesh_is_smoothed_without_its_other_components() -> None:
    balls = [trimesh.creation.icosphere(subdivisions=3, radius=radius) for radius in (5, 6)]
    both = trimesh.util.concatenate([balls[0], balls[1].apply_translation((20, 0, 0))])
    result = smooth_mesh(both, keep_components=2, voxel=0.5)
    assert result.report["volume"] == pytest.approx(balls[0].volume, rel=0.01)


@pytest.mark.parametrize("value", ["0", "4", "1,4", "2-9", "x", "3-1", "", "1,,2", "-1", "9" * 30, []])
def test_what_names_no_component_is_one_clear_message(value: object) -> None:
    with pytest.raises(InfillError, match="^keep_components "):
        choose_components(value, 3)


def test_ranges_and_lists_choose_the_same() -> None:
    assert choose_components("1,3-4,6-", 7).tolist() == [True, False, True, True, False, True, True]
    assert choose_components((2,), 3).tolist() == choose_components("2", 3).tolist() == [False, True, False]
