"""Distances from a surface known by points: laws, the kernel beside its formula, and what `smooth_points` makes of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from infill import ParameterError, Surface, smooth_points
from infill.kernels.point_fields import signed_distances
from infill.kernels.threads import in_threads
from infill.meshes.distance import distances
from infill.smoothing.sources import read_source, smooth_source
from infill.voxels.from_points import voxelise_points
from infill.voxels.point_fields import (
    PASSES,
    REACH,
    SHARPNESS,
    cell_distances,
    distance_from_points,
    merge_close_points,
    sort_into_bins,
)

RADIUS = 20.0


def on_ball(count: int) -> np.ndarray:
    points = trimesh.sample.sample_surface_even(
        trimesh.creation.icosphere(subdivisions=6, radius=RADIUS), count, seed=1
    )[0]
    return np.asarray(RADIUS * points / np.linalg.norm(points, axis=1)[:, None])


def cloud(mesh: trimesh.Trimesh, count: int) -> tuple[np.ndarray, np.ndarray]:
    points, faces = trimesh.sample.sample_surface_even(mesh, count, seed=1)
    return np.asarray(points), np.asarray(mesh.face_normals[faces])


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), count=st.integers(1, 60), threads=st.integers(1, 3))
def test_the_kernel_does_what_the_formula_says(seed: int, count: int, threads: int) -> None:
    rng = np.random.default_rng(seed)
    points, normals = rng.uniform(0, 9, size=(count, 3)), rng.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    places = np.argwhere(np.ones((12, 11, 10), dtype=bool)).astype(np.int32)
    sigma = float(rng.uniform(0.75, 2.0))
    order, first, shape = sort_into_bins(points, REACH * sigma)
    found = np.empty(len(places), dtype=np.float32)
    arguments = (places, points[order], normals[order], first, shape, sigma, REACH * sigma, SHARPNESS, PASSES)
    in_threads(signed_distances, *arguments, found, threads=threads)
    expected = distance_from_points(places.astype(np.float64), points, normals, sigma)
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    assert found == pytest.approx(expected, abs=1e-5, nan_ok=True)


@pytest.mark.longest
@given(seed=st.integers(0, 10_000))
def test_planes_are_exact_and_spheres_to_the_second_order(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed)
    flat = turn.apply(np.column_stack([rng.uniform(-4, 4, size=(400, 2)), np.zeros(400)]))
    up = turn.apply([0.0, 0, 1])
    places = rng.uniform(-1, 1, size=(20, 3))
    assert distance_from_points(places, flat, np.tile(up, (400, 1)), 1.0) == pytest.approx(places @ up, abs=1e-12)
    ball = on_ball(6000)  # 0.9 apart
    places = ball[:50] * rng.uniform(0.97, 1.03, size=(50, 1))
    away = distance_from_points(places, ball, ball / RADIUS, 1.0) - (np.linalg.norm(places, axis=1) - RADIUS)
    assert np.abs(away).max() < 0.005  # by the normals of the points alone, 1 / RADIUS too far outwards


def test_a_place_without_points_near_has_no_distance() -> None:
    assert np.isnan(distance_from_points(np.array([[9.0, 0, 0]]), np.zeros((1, 3)), np.array([[0.0, 0, 1]]), 1.0)[0])


@pytest.mark.slow
def test_normals_may_point_either_way_have_any_length_or_be_missing() -> None:
    points, rng = on_ball(2000), np.random.default_rng(2)
    solid = voxelise_points(points, voxel=1.0)
    exact = cell_distances(solid, points, points)
    scaled = points * rng.uniform(0.1, 5, size=(len(points), 1)) * rng.choice([-1, 1], size=(len(points), 1))
    assert cell_distances(solid, points, scaled) == pytest.approx(exact, abs=1e-5)
    some = np.where(np.arange(len(points))[:, None] % 2, 0.0, points)
    for estimated in (cell_distances(solid, points, None), cell_distances(solid, points, some)):
        assert np.abs(estimated - exact).max() < 0.1


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1 / 64, 64])
def test_units_change_nothing(factor: float) -> None:
    points = on_ball(1000)
    one, other = (
        cell_distances(voxelise_points(points * unit, voxel=2 * unit), points * unit, points) for unit in (1.0, factor)
    )
    assert np.array_equal(one, other)


def test_points_in_half_a_cell_become_one_and_opposite_ones_none() -> None:
    places = np.array([[0.1, 0.1, 0.1], [0.3, 0.3, 0.3], [2.0, 2, 2], [2.1, 2.1, 2.1]])
    across = np.array([[0.0, 0, 1], [0, 0, 1], [0, 1, 0], [0, -1, 0]])
    points, normals = merge_close_points(places, across)
    assert points == pytest.approx(np.array([[0.2, 0.2, 0.2]]))
    assert normals == pytest.approx(np.array([[0.0, 0, 1]]))


@pytest.mark.longest
@pytest.mark.parametrize("known", [True, False])
def test_noise_does_not_move_the_surface_outwards(known: bool) -> None:
    mesh = trimesh.creation.torus(8, 3, major_sections=128, minor_sections=64)
    points, normals = cloud(mesh, 30_000)
    points = points + np.random.default_rng(1).normal(0, 0.1, points.shape)  # a quarter of a voxel
    result = smooth_points(points, voxel=0.4, normals=normals if known else None, tolerance=None)
    plain = smooth_points(
        points, voxel=0.4, method="plain", tolerance=None
    )  # cells alone go around the outermost points
    assert abs(result.mesh.volume / mesh.volume - 1) < 0.003
    assert plain.mesh.volume / mesh.volume - 1 > 0.05
    assert result.report["input"]["normals"] is known
    truth = Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))
    assert distances(result.surface.vertices, truth).max() < 0.15 * 0.4
    assert result.mesh.is_watertight


@pytest.mark.longest
def test_edges_of_a_turned_box_stay_within_a_voxel() -> None:
    mesh = trimesh.creation.box((20, 14, 9))
    mesh.apply_transform(trimesh.transformations.rotation_matrix(0.7, [1, 2, 3]))
    points, normals = cloud(mesh, 30_000)
    result = smooth_points(points, voxel=0.4, normals=normals, tolerance=None)
    truth = Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))
    away = distances(result.surface.vertices, truth) / 0.4
    assert (away.max(), away.mean()) < (1.0, 0.15)
    assert abs(result.mesh.volume / mesh.volume - 1) < 0.001


@pytest.mark.slow
def test_normals_that_do_not_fit_are_refused() -> None:
    points = on_ball(500)
    with pytest.raises(ParameterError, match=r"normals have the shape \(3,\) and the points \(500, 3\); give one each"):
        smooth_points(points, voxel=2.0, normals=[0.0, 0, 1], tolerance=None)
    with pytest.raises(ParameterError, match="a shell lies on both sides of the points"):
        smooth_points(points, voxel=2.0, shell=4.0, normals=points, tolerance=None)
    broken = points.copy()
    broken[::7] = np.nan
    assert smooth_points(points, voxel=2.0, normals=broken, tolerance=None).report["verdict"]["word"] == "kept"


@pytest.mark.slow
def test_normals_of_a_file_are_used_and_a_shell_leaves_them_out(tmp_path: Path) -> None:
    points = on_ball(2000)
    path = tmp_path / "ball.xyz"
    np.savetxt(path, np.concatenate([points, points / RADIUS], axis=1))
    source = read_source(path)
    assert source.shape == (2000, 6)  # type: ignore[union-attr]
    assert smooth_source(source, voxel=1.0).report["input"]["normals"] is True
    assert smooth_source(source, voxel=1.0, shell=4.0).report["input"]["normals"] is False
    metres = read_source(path, units="m")
    assert np.array_equal(metres, source * [1000, 1000, 1000, 1, 1, 1])  # type: ignore[operator]


@pytest.mark.slow
def test_all_that_is_far_from_points_stays_as_the_cells_are() -> None:
    points = on_ball(2000)
    solid = voxelise_points(points, voxel=1.0, margin=8)
    found = cell_distances(solid, points, None)
    centres = (np.argwhere(np.ones(found.shape, dtype=bool)) + 0.5) + np.array(solid.origin)
    away = RADIUS - np.linalg.norm(centres, axis=1).reshape(found.shape)
    sure = np.abs(away) > 0.1
    assert np.array_equal((found > 0)[sure], (away > 0)[sure])
    near = np.abs(away) < 1
    assert np.abs(found - away)[near].max() < 0.05
