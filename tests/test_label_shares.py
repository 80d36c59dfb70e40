"""Labels that share cells, smoothed together: partial volumes, and probabilities of a network."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import nibabel
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from infill import ParameterError, UsageError, read_segmentation, smooth_labels
from infill.imaging.segmentations import LEAST_SHARE, segmentation_of_shares

FINE = 4  # parts of the side of a cell


def shared_cells(fine: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Return the share of each cell that a shape on finer cells fills."""
    sides = [part for count in fine.shape for part in (count // FINE, FINE)]
    return fine.reshape(sides).mean(axis=(1, 3, 5)).astype(np.float32)


def fine_ball(size: int, centre: tuple[float, ...], radius: float) -> NDArray[np.bool_]:
    """Return a ball in a box of `size` cells, on finer cells."""
    places = (np.indices((size * FINE,) * 3) + 0.5) / FINE - np.reshape(centre, (3, 1, 1, 1))
    return np.asarray((places**2).sum(axis=0) < radius**2)


def random_shares(labels: int, seed: int) -> NDArray[np.float32]:
    """Return shares that change from cell to cell, and add up to 1 with the space between."""
    noise = np.random.default_rng(seed).normal(size=(labels + 1, 20, 18, 16))
    smooth = np.exp(
        12 * gaussian_filter(noise, (0, 3, 3, 3), mode="nearest") / gaussian_filter(noise, (0, 3, 3, 3)).std() / 4
    )
    return np.asarray((smooth / smooth.sum(axis=0))[1:], dtype=np.float32)


@pytest.mark.parametrize("method", ["plain", "refine"])
def test_whole_cells_give_what_labels_give(method: Any) -> None:
    labels = random_shares(3, 0).argmax(axis=0) + 1
    labels[:, :4] = 0
    shares = np.stack([labels == label for label in (1, 2, 3)]).astype(float)
    one, other = (smooth_labels(data, together=True, method=method) for data in (labels, shares))
    for name, surface in one.surfaces.items():
        assert other.surfaces[name].vertices.tobytes() == surface.vertices.tobytes()
        assert other.surfaces[name].faces.tobytes() == surface.faces.tobytes()
    assert [keys["data"] for keys in other.report["labels"]] == [keys["data"] for keys in one.report["labels"]]


def test_the_two_sides_of_a_wall_can_be_given_alike() -> None:
    share = shared_cells(fine_ball(24, (11.3, 12.2, 12.9), 6.4))
    ball, around = (
        smooth_labels(part[None], together=True, method="plain", tolerance=None).stages.partition
        for part in (share, 1 - share)
    )
    inner = [
        part.walls.points[np.unique(part.walls.triangles[(part.walls.sides >= 0).all(axis=1)])]
        for part in (ball, around)
    ]
    assert inner[0].shape == inner[1].shape
    assert np.abs(inner[0] - inner[1]).max() < 1e-3  # offsets are sought to 1e-5 of volumes that differ


@settings(max_examples=4, deadline=None)
@given(labels=st.integers(1, 4), seed=st.integers(0, 99))
def test_every_label_keeps_the_volume_of_its_shares(labels: int, seed: int) -> None:
    shares = random_shares(labels, seed)
    report = smooth_labels(shares, spacing=0.5, together=True).report
    held = np.where(shares < LEAST_SHARE, 0, np.where(shares > 1 - LEAST_SHARE, 1, shares))
    for keys in report["labels"]:
        volume = held[keys["number"] - 1].sum(dtype=float) * 0.125
        assert keys["data"] == pytest.approx(volume, rel=1e-6)
        if volume > 1:
            assert keys["volume"] == pytest.approx(volume, rel=1e-4)


@pytest.mark.parametrize("method", ["plain", "refine"])
def test_shares_place_a_wall_better_than_whole_cells(method: Any) -> None:
    centre, radius = np.array([15.8, 16.3, 15.6]), 9.3
    share = shared_cells(fine_ball(32, tuple(centre), radius))
    errors = []
    for data in (share[None], (share > 0.5).astype(int)):
        surface = smooth_labels(data, together=True, method=method, tolerance=None).surfaces["label_1"]
        errors.append(np.sqrt(np.mean((np.linalg.norm(surface.vertices - centre, axis=1) - radius) ** 2)))
    assert errors[0] < 0.8 * errors[1]


def test_shares_that_leave_nothing_begin_with_the_space_between(caplog: pytest.LogCaptureFixture) -> None:
    shares = random_shares(2, 3)
    whole = np.concatenate([1 - shares.sum(axis=0, keepdims=True), shares])
    with caplog.at_level(logging.WARNING, logger="infill"):
        full = segmentation_of_shares(whole)
    assert "the first is taken as the space between" in caplog.text
    assert full.shares is not None
    assert full.shares == pytest.approx(segmentation_of_shares(shares).shares, abs=1e-6)
    first, second = np.sort(whole, axis=0)[-1:-3:-1]
    clear = first - second > 2 * LEAST_SHARE  # shares that count as none add to the space between
    assert (full.layers[0].values == np.argmax(whole, axis=0))[clear].all()
    assert clear.mean() > 0.8


def test_files_hold_shares(tmp_path: Path) -> None:
    shares = random_shares(2, 5)
    np.save(tmp_path / "a.npy", shares)
    np.savez(tmp_path / "b.npz", probabilities=shares, spacing=np.array([0.5, 0.5, 0.8]))
    np.savez(tmp_path / "c.npz", values=shares.transpose(0, 3, 2, 1), spacing_zyx_mm=np.array([0.8, 0.5, 0.5]))
    affine = np.diag([-0.5, -0.5, 0.8, 1.0])  # x and y lead as in LPS
    nibabel.save(nibabel.Nifti1Image(np.moveaxis(shares, 0, -1), affine), tmp_path / "d.nii.gz")
    header = (
        "NRRD0004\ntype: float\ndimension: 4\nsizes: 2 20 18 16\nspace: left-posterior-superior\nencoding: raw\n"
        "space directions: none (0.5,0,0) (0,0.5,0) (0,0,0.8)\nkinds: list domain domain domain\nendian: little\n\n"
    )
    (tmp_path / "e.nrrd").write_bytes(header.encode() + shares.astype("<f4").tobytes(order="F"))
    expected = segmentation_of_shares(shares)
    for name in ("a.npy", "b.npz", "c.npz", "d.nii.gz", "e.nrrd"):
        segmentation = read_segmentation(tmp_path / name)
        assert segmentation.shares is not None, name
        assert segmentation.shares.tolist() == expected.shares.tolist(), name  # type: ignore[union-attr]
        assert segmentation.layers[0].values.tolist() == expected.layers[0].values.tolist(), name
        assert segmentation.layers[0].spacing == pytest.approx((1, 1, 1) if name == "a.npy" else (0.5, 0.5, 0.8)), name


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.full((2, 4, 4, 4), 0.7), "add up to 1.4; give shares"),
        (np.full((2, 4, 4, 4), np.nan), "give shares that add up"),
        (np.full((1, 4, 4, 4), -0.5), "go from -0.5"),
        (np.ones((2, 4, 4, 4), dtype=int), r"the type int64; give real numbers"),
    ],
)
def test_what_are_no_shares_is_refused_in_one_line(values: NDArray[Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        smooth_labels(values, together=True)


def test_labels_that_share_cells_are_smoothed_together_alone() -> None:
    with pytest.raises(UsageError, match="together.*give it"):
        smooth_labels(random_shares(2, 1))


def test_a_series_of_volumes_is_still_chosen_from(tmp_path: Path) -> None:
    series = np.random.default_rng(0).normal(100, 5, (4, 5, 6, 2))
    nibabel.save(nibabel.Nifti1Image(series, np.eye(4)), tmp_path / "series.nii")
    with pytest.raises(Exception, match="choose one of its 2 frames"):
        read_segmentation(tmp_path / "series.nii")
