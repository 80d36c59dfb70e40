"""`voxelise_points`: cells near points, or inside them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from infill import GeometryError, MemoryLimitError, ParameterError, read_mesh
from infill.volume import Volume
from infill.voxels.flooding import enclosed_void
from infill.voxels.from_points import fill_balls, voxelise_points

RADIUS = 20.0
BALL = 4 / 3 * math.pi * RADIUS**3


def on_ball(count: int) -> np.ndarray:
    """Points spread evenly over a ball: a Fibonacci lattice."""
    place = np.arange(count) + 0.5
    polar, around = np.arccos(1 - 2 * place / count), np.pi * (1 + math.sqrt(5)) * place
    return RADIUS * np.stack([np.cos(around) * np.sin(polar), np.sin(around) * np.sin(polar), np.cos(polar)], axis=1)


def size(volume: Volume) -> float:
    return float(volume.values.sum()) * volume.cell_volume


def distances(volume: Volume, points: np.ndarray) -> np.ndarray:
    centres = volume.place((np.argwhere(np.ones(volume.values.shape, dtype=bool)) + 0.5) * volume.cell_size)
    return np.linalg.norm(centres[:, None] - points, axis=2).min(axis=1).reshape(volume.values.shape)


@given(seed=st.integers(0, 10_000), count=st.integers(4, 30), shell=st.floats(1.0, 9.0))
def test_a_shell_is_every_cell_near_a_point(seed: int, count: int, shell: float) -> None:
    points = np.random.default_rng(seed).uniform(-4, 4, size=(count, 3))
    volume = voxelise_points(points, voxel=1.0, shell=shell)
    assert np.array_equal(volume.values, distances(volume, points) <= shell / 2)


def test_the_comparison_of_distances_can_fail() -> None:
    points = np.random.default_rng(1).uniform(-4, 4, size=(20, 3))
    volume = voxelise_points(points, voxel=1.0, shell=3.0)
    assert not np.array_equal(volume.values, distances(volume, points) <= 1.6)


@given(seed=st.integers(0, 10_000))
def test_balls_may_lie_outside_the_grid(seed: int) -> None:
    centres = np.random.default_rng(seed).uniform(-4, 12, size=(12, 3))
    cells = np.argwhere(np.ones((8, 7, 6), dtype=bool))
    near = np.linalg.norm(cells[:, None] - centres, axis=2).min(axis=1) <= 2.7
    assert np.array_equal(fill_balls(centres, 2.7, (8, 7, 6)).ravel(), near)


@given(seed=st.integers(0, 10_000), density=st.floats(0.1, 0.9))
def test_enclosed_is_what_a_flood_does_not_reach(seed: int, density: float) -> None:
    from scipy import ndimage

    solid = np.pad(np.random.default_rng(seed).random((7, 6, 5)) < density, 1)
    component, _ = ndimage.label(~solid)
    assert np.array_equal(enclosed_void(solid), (component != component[0, 0, 0]) & ~solid)


@pytest.mark.parametrize("shell", [None, 3.0])
def test_the_margin_is_empty_and_no_more(shell: float | None) -> None:
    points = on_ball(2000)
    values = voxelise_points(points, voxel=1.0, shell=shell, margin=3).values
    assert not any(np.take(values, range(3), axis=axis).any() for axis in range(3))
    assert all(np.take(values, 3 + (shell is not None), axis=axis).any() for axis in range(3))
    assert values.shape == ((46,) * 3 if shell is None else (50,) * 3)


@pytest.mark.slow
@pytest.mark.parametrize(("count", "voxel"), [(1000, 0.5), (5000, 1.0), (5000, 0.5), (20_000, 1.0), (20_000, 0.5)])
def test_the_solid_of_a_ball_is_the_ball(count: int, voxel: float) -> None:
    # The plane triangles between 1000 points of the ball would lose 0.7 %.
    assert size(voxelise_points(on_ball(count), voxel=voxel)) == pytest.approx(BALL, rel=0.01)


@pytest.mark.slow
def test_points_that_are_not_even_do_as_well(rng: np.random.Generator) -> None:
    points = rng.normal(size=(5000, 3))
    points *= RADIUS / np.linalg.norm(points, axis=1)[:, None]
    assert size(voxelise_points(points, voxel=0.5)) == pytest.approx(BALL, rel=0.01)


@pytest.mark.slow
def test_the_surface_of_the_solid_runs_through_the_points() -> None:
    points = on_ball(5000)
    volume = voxelise_points(points, voxel=0.5)
    placed = np.argwhere(volume.values) * 0.5 + 0.25 + np.array(volume.origin)
    out = np.linalg.norm(placed, axis=1)
    assert out.max() < RADIUS + 0.5  # a cell
    empty = np.argwhere(~volume.values) * 0.5 + 0.25 + np.array(volume.origin)
    assert np.linalg.norm(empty, axis=1).min() > RADIUS - 0.5


@pytest.mark.slow
def test_a_box_keeps_its_corners() -> None:
    grid = np.linspace(-5, 5, 41)
    plane = np.stack([each.ravel() for each in np.meshgrid(grid, grid, [5.0])], axis=1)
    points = np.concatenate([np.roll(plane * [1, 1, sign], shift, axis=1) for shift in range(3) for sign in (1, -1)])
    assert size(voxelise_points(points, voxel=0.2)) == pytest.approx(1000, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("shell", [None, 0.25])
def test_units_scale_the_grid_and_change_no_cell(shell: float | None) -> None:
    # A power of two, so that rounding is the same.
    points = on_ball(1000) / 64
    here = voxelise_points(points, voxel=1 / 64, shell=shell)
    there = voxelise_points(points * 64, voxel=1.0, shell=shell and shell * 64)
    assert np.array_equal(here.values, there.values)


def test_the_order_of_points_does_not_matter_and_doubles_do_not(rng: np.random.Generator) -> None:
    points = on_ball(1000)
    here = voxelise_points(points, voxel=1.0)
    there = voxelise_points(rng.permutation(np.concatenate([points, points[::3]])), voxel=1.0)
    assert np.array_equal(here.values, there.values)


@pytest.mark.parametrize(
    ("points", "options", "error", "says"),
    [
        (np.eye(3), {"voxel": 0.1}, ParameterError, "3 points given"),
        (np.zeros((5, 6)), {"voxel": 0.1}, ParameterError, r"\(5, 6\)"),
        (np.full((5, 3), np.nan), {"voxel": 0.1}, ParameterError, "5 of 5 points"),
        (np.eye(5, 3), {"voxel": 0}, ParameterError, "voxel is 0"),
        (on_ball(500), {"voxel": 1, "shell": 0.5}, ParameterError, "shell is 0.5 mm"),
        (on_ball(500), {"voxel": 1, "margin": -1}, ParameterError, "margin is -1"),
        (on_ball(500), {"voxel": 30}, ParameterError, "39.97 mm thick"),
        (on_ball(500) * [1, 1, 0], {"voxel": 1}, GeometryError, "in a plane"),
        (np.tile([1.0, 2, 3], (9, 1)), {"voxel": 1}, GeometryError, "in a plane"),
        (on_ball(500)[:250], {"voxel": 1}, GeometryError, "do not enclose a solid"),
        (on_ball(500), {"voxel": 0.01}, MemoryLimitError, "larger voxels"),
        (on_ball(500), {"voxel": 0.01, "shell": 1}, MemoryLimitError, "larger voxels"),
    ],
)
def test_errors_say_what_to_do(
    points: np.ndarray, options: dict[str, float], error: type[Exception], says: str
) -> None:
    with pytest.raises(error, match=says) as caught:
        voxelise_points(points, max_memory=2**28, **options)
    assert "\n" not in str(caught.value)
    assert ";" in str(caught.value)


def test_a_plane_has_a_shell() -> None:
    points = on_ball(500) * [1, 1, 0]
    assert voxelise_points(points, voxel=1, shell=4).values.any()


@pytest.mark.slow
def test_the_kitten_is_solid(data: Path) -> None:
    points = np.loadtxt(data / "models/kitten_points.xyz")[:, :3]
    coarse, fine = (size(voxelise_points(points, voxel=voxel)) for voxel in (0.01, 0.006))
    assert coarse == pytest.approx(fine, rel=0.005)
    assert fine == pytest.approx(0.1245, rel=0.01)  # by cells of 0.0025


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "voxel"), [("medical/femur.stl", 2.0), ("models/armadillo_52k.off", 1.2), ("models/horse_97k.ply", 0.0015)]
)
def test_the_vertices_of_a_mesh_enclose_its_volume(data: Path, name: str, voxel: float) -> None:
    mesh = read_mesh(data / name)
    # Grooves narrower than the shell are filled, and the points stand on the mesh, not beside it.
    assert size(voxelise_points(mesh.vertices, voxel=voxel)) == pytest.approx(abs(mesh.volume), rel=0.015)
