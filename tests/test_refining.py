"""Refined smoothing: its laws, the bricks against the specification, and what it is for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from infill import ParameterError, Smoothing, smooth_volume
from infill.isosurfaces.components import data_bits, find_components
from infill.isosurfaces.levels import straighten_profile, surface_at_volume
from infill.phasefield.allen_cahn import STEEPNESS
from infill.phasefield.profile import REFINED_PROFILE
from infill.phasefield.refining import filter_bricks, filter_reference, refine_bricks, refine_reference
from infill.phasefield.schedule import FILTERS, Schedule
from infill.phasefield.sparse import SparseField, smooth_bricks
from infill.surface import Surface

TWENTY = Smoothing(steps=20)
CELLS = REFINED_PROFILE.scale * 2 / STEEPNESS  # what a refined distance of 1 stands for


def blobs(shape: tuple[int, ...], seed: int = 1, width: float = 3) -> np.ndarray:
    """Solid of some components, rounded, that touches the edges of the grid."""
    return gaussian_filter(np.random.default_rng(seed).normal(size=shape), width) > 0.01


def grid(*shape: int) -> list[np.ndarray]:
    return [x - (n - 1) / 2 for x, n in zip(np.indices(shape), shape, strict=True)]


def box(points: list[np.ndarray], half: tuple[float, ...], radius: float) -> np.ndarray:
    """Signed distance from a turned box with rounded edges."""
    cos, sin = math.cos(0.5), math.sin(0.5)
    x, y, z = points
    turned = np.stack([cos * x + sin * y, cos * y - sin * x, 0.9 * z + math.sqrt(0.19) * (cos * y - sin * x)])
    turned[1] = 0.9 * turned[1] - math.sqrt(0.19) * z
    q = np.abs(turned) - (np.array(half) - radius)[:, None, None, None]
    return np.linalg.norm(np.maximum(q, 0), axis=0) + np.minimum(q.max(axis=0), 0) - radius


def surface_of(field: SparseField) -> Surface:
    """The surface of the volume of the data, about the middle of the grid, in cells."""
    data = find_components(field, data_bits(field))
    surface = surface_at_volume(field, data, spacing=(1.0, 1.0, 1.0), targets=data.cells.astype(np.float64)).surface
    return Surface(vertices=surface.vertices - np.array(field.shape) / 2, faces=surface.faces)


@pytest.mark.parametrize("steps", [4, 5, 7, 10, 20, 30, 41])
def test_filters_leave_long_waves_alone(steps: int) -> None:
    """By the scheme itself, on a wave so long and low that the reaction is nothing and 1 - x^n all that counts."""
    schedule = Schedule.of(steps)
    q = 0.05  # x = alpha q^2 = 4e-4
    x = 2 / 7 * (1 - math.cos(q))
    for kept, weights in zip(FILTERS, schedule.weights, strict=True):
        assert sum(weights.values()) == pytest.approx(1, abs=1e-12)
        share, before, found = 1.0, 1.0, 0.0
        for k in range(schedule.last):
            share, before = (1 - x) * share + schedule.momentum(k) * (share - before), share
            found += weights.get(k + 1, 0.0) * share
        reach = max(weights) * 4 * x  # momentum makes up to two or three steps of one
        assert abs(found - 1) < 2 * reach ** len(kept)


def test_fewer_than_four_steps_are_refused() -> None:
    with pytest.raises(ParameterError, match="refining was given 3 steps; it takes at least 4"):
        refine_bricks(np.ones((3, 3, 3), dtype=bool), Smoothing(steps=3))


@pytest.mark.parametrize("solid", [True, False])
def test_uniform_data_are_fixed(solid: bool) -> None:
    sign = 1 if solid else -1
    data = np.full((20, 9, 33), solid)
    assert (refine_bricks(data, TWENTY).to_dense() == sign).all()
    assert filter_reference(data * 2.0 - 1, TWENTY)[2] == pytest.approx(sign)


def test_far_cells_are_plus_and_minus_one_to_the_last_bit() -> None:
    ball = sum(x**2 for x in grid(70, 70, 70)) < 20**2
    field = refine_bricks(ball, TWENTY).to_dense()
    radius = np.sqrt(sum(x**2 for x in grid(70, 70, 70)))
    assert (field[radius < 13] == 1).all()
    assert (field[radius > 27] == -1).all()
    assert np.abs(field).max() == 1


@pytest.mark.slow
@pytest.mark.parametrize("data", ["bits", "signs", "grey"])
def test_bricks_filter_as_the_specification(data: str) -> None:
    solid = blobs((37, 30, 50))
    f = solid if data == "bits" else np.where(solid, 1, -1).astype(np.int8)
    exact = np.where(solid, 1.0, -1.0)
    if data == "grey":
        f = exact = np.clip(gaussian_filter(exact, 1) * 1.2, -1, 1)
    for smoothing, spacing in ((TWENTY, 1.0), (Smoothing(steps=6, interface=3), (1.0, 1.0, 1.5))):
        expected = filter_reference(exact, smoothing, spacing=spacing)
        found = filter_bricks(f, smoothing, spacing=spacing)
        for ours, theirs in zip(found, expected, strict=True):
            assert np.abs(ours.to_dense() - theirs).max() < 1e-5  # rounding of float32, some 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(48, 45, 50), (90, 70)])
def test_bricks_refine_nearly_as_the_specification(shape: tuple[int, ...]) -> None:
    """Averages come from a coarse lattice: the surface differs by some hundredths of a cell, no more."""
    solid = blobs(shape, width=5)
    exact = refine_reference(np.where(solid, 1.0, -1.0), TWENTY)
    found = refine_bricks(solid, TWENTY).to_dense().reshape(shape)
    near = np.abs(exact) < 0.2
    difference = (found - exact)[near] * CELLS
    assert np.sqrt((difference**2).mean()) < 0.02
    assert np.abs(difference).max() < 0.25


def test_turning_solid_into_void_turns_the_sign() -> None:
    solid = blobs((30, 41, 22))
    field = refine_bricks(solid, TWENTY).to_dense()
    assert np.abs(refine_bricks(~solid, TWENTY).to_dense() + field).max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_mirrored_axes(axis: int) -> None:
    """On a grid that lies on the lattice of bricks in the same way from both ends, a law; on others nearly."""
    solid = blobs((30, 30, 30))  # 32 with a cell before and one behind: whole bricks
    field = refine_bricks(solid, TWENTY).to_dense()
    mirrored = np.flip(refine_bricks(np.flip(solid, axis).copy(), TWENTY).to_dense(), axis)
    assert np.abs(mirrored - field).max() < 1e-5
    off = np.flip(refine_bricks(np.flip(solid[:, :-1, :-3], axis).copy(), TWENTY).to_dense(), axis)
    near = np.abs(off) < 0.2
    difference = (off - refine_bricks(solid[:, :-1, :-3].copy(), TWENTY).to_dense())[near] * CELLS
    assert np.sqrt((difference**2).mean()) < 0.02


def test_threads_change_nothing() -> None:
    solid = blobs((40, 40, 60))
    assert (refine_bricks(solid, TWENTY, threads=1).values == refine_bricks(solid, TWENTY, threads=3).values).all()


def test_data_stay_as_they_are_and_progress_is_told() -> None:
    solid = blobs((20, 20, 20))
    kept, told = solid.copy(), []
    refine_bricks(solid, TWENTY, progress=told.append)
    assert (solid == kept).all()
    assert told == [k / 65 for k in range(65)]


@pytest.mark.slow
def test_a_sphere_is_round() -> None:
    """Plain smoothing to the volume comes to 0.030: an even shift, its one error on a sphere, goes with the level."""
    centre = [0.31, -0.17, 0.43]
    solid = sum((x - c) ** 2 for x, c in zip(grid(66, 66, 66), centre, strict=True)) < 26**2
    surface = surface_of(refine_bricks(solid, TWENTY))
    distance = np.linalg.norm(surface.vertices - centre, axis=1) - 26
    assert surface.closed
    assert surface.to_trimesh().euler_number == 2
    assert surface.volume == pytest.approx(solid.sum(), rel=1e-4)
    assert np.sqrt((distance**2).mean()) < 0.05  # 0.043 cells
    assert np.abs(distance).max() < 0.45  # at the poles, where the voxels are flat


@pytest.mark.slow
def test_a_box_keeps_its_edges() -> None:
    """0.08 cells off, where plain smoothing is 0.27 off."""
    half, radius = (28.0, 20.0, 13.0), 5.0
    solid = box(grid(76, 76, 76), half, radius) < 0
    off = []
    for field in (refine_bricks(solid, TWENTY), straighten_profile(smooth_bricks(solid, TWENTY))):
        surface = surface_of(field)
        distance = box([surface.vertices[:, None, None, axis] for axis in range(3)], half, radius)
        off.append((np.sqrt((distance**2).mean()), np.abs(distance).max()))
    (rms, largest), (plain_rms, plain_largest) = off
    assert rms < 0.1
    assert rms < plain_rms / 2.5
    assert largest < plain_largest / 2


def comb() -> np.ndarray:
    """Three walls 3 cells thick between two plates, turned."""
    x, y, z = grid(64, 64, 44)
    u, v = math.cos(0.3) * x + math.sin(0.3) * y, math.cos(0.3) * y - math.sin(0.3) * x
    walls = (np.abs((u + 8) % 16 - 8) < 1.5) & (np.abs(z) < 16)
    plates = np.abs(np.abs(z) - 15) < 3
    return (walls | plates) & (np.abs(u) < 17.5) & (np.abs(v) < 22)


@pytest.mark.slow
def test_thin_walls_survive_that_plain_smoothing_breaks() -> None:
    solid, thirty = comb(), Smoothing(steps=30)
    plain = smooth_volume(solid, smoothing=thirty, method="plain", allow_broken=True, tolerance=None).report
    result = smooth_volume(solid, smoothing=thirty, refine=True, tolerance=None)
    assert plain["problems"]
    assert not plain["request"]["refine"]
    assert not result.report["problems"]
    assert result.report["request"]["refine"]
    assert result.report["request"]["fidelity"] == 0
    assert result.report["topology"]["result"] == result.report["topology"]["data"]
    assert abs(result.report["volume_change"]) < 1e-4
    assert result.mesh.is_volume


@pytest.mark.slow
def test_levels_and_fields_of_a_result_are_those_of_phi() -> None:
    ball = sum(x**2 for x in grid(40, 40, 40)) < 12.2**2
    at_half = smooth_volume(ball, refine=True, level=0.5, tolerance=None)
    assert at_half.report["solid"]["level"]["common"] == 0.5
    values = at_half.stages.field().values
    assert np.abs(values).max() <= 1
    assert (values > 0).sum() == pytest.approx(at_half.mesh.volume, rel=0.03)  # cells counted against a surface
    by_volume = smooth_volume(ball, refine=True, tolerance=None)
    level = by_volume.report["solid"]["level"]["common"]
    again = smooth_volume(ball, refine=True, level=level, tolerance=None)
    assert again.mesh.volume == pytest.approx(by_volume.mesh.volume, rel=1e-4)


def test_phase_and_distance_are_inverse() -> None:
    for level in (-0.9, 0.0, 0.3):
        assert REFINED_PROFILE.phase(np.array([REFINED_PROFILE.distance_level(level)], dtype=np.float32))[
            0
        ] == pytest.approx(level, abs=1e-6)


def test_the_phase_may_take_the_place_of_distances(rng: np.random.Generator) -> None:
    distance = rng.normal(scale=4, size=(7, 40, 3)).astype(np.float32)
    apart = REFINED_PROFILE.phase(distance, unit=3)
    assert not np.shares_memory(apart, distance)
    assert np.shares_memory(REFINED_PROFILE.phase(distance, unit=3, out=distance), distance)
    assert np.array_equal(distance, apart)


def test_despeckle_goes_with_refining() -> None:
    ball = sum(x**2 for x in grid(40, 40, 40)) < 12**2
    ball[2:4, 2:4, 2:4] = True
    report = smooth_volume(ball, refine=True, despeckle=10, tolerance=None).report
    assert report["input"]["despeckled"] == 1
    assert report["topology"]["result"]["components"] == 1
