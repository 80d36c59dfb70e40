"""What smoothing keeps of shapes with a known truth, and that nothing is lost untold."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from itertools import cycle
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from made_shapes import Made, ball, box, every_shape, plate_with_holes, rod, together, turned, union
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from infill import GeometryError, Surface, smooth_mesh, smooth_volume
from infill.inspection.deviation import measure_deviation
from infill.phasefield import refining
from infill.smoothing import attempt
from infill.voxels.noise import NOISY

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

SHAPES: dict[str, Made] = dict(every_shape())
VOXELS = dict(zip(SHAPES, cycle([1.0, 0.75, 1.25]), strict=False))  # three resolutions
FAR = 1.5  # voxels: a loss from there on may not be called "kept"
DENSE = 0.35  # between the points that are compared
EXACT = 2  # voxels: from this thickness on, volumes are promised


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices, dtype=np.float64), faces=np.asarray(mesh.faces))


@cache
def smoothed(name: str) -> Any:
    return smooth_mesh(surface_of(SHAPES[name].mesh), voxel=VOXELS[name], allow_broken=True, tolerance=None)


def points_on(mesh: trimesh.Trimesh, seed: int = 5) -> NDArray[np.float64]:
    """Points all over a mesh, by trimesh, and its corners."""
    count = int(mesh.area / DENSE**2)
    return np.concatenate([np.asarray(trimesh.sample.sample_surface(mesh, count, seed=seed)[0]), mesh.vertices])


def apart(one: trimesh.Trimesh, other: trimesh.Trimesh) -> float:
    """How far the points of each lie from the other at most: too large by the distance between points, at most."""
    ways = [(points_on(one, 1), points_on(other, 2)), (points_on(other, 3), points_on(one, 4))]
    return max(float(cKDTree(there).query(here)[0].max()) for here, there in ways)


def test_there_are_a_hundred() -> None:
    assert len(SHAPES) >= 100


@pytest.mark.longest
def test_volumes_are_exact_and_not_biased() -> None:
    """Walls of two voxels and more; only what overlaps is counted on rows, and not to the last digit."""
    errors = {
        name: smoothed(name).report["volume"] / made.volume - 1
        for name, made in SHAPES.items()
        if made.thick >= EXACT * VOXELS[name]
    }
    assert len(errors) > 60
    assert {name: error for name, error in errors.items() if abs(error) >= 1e-3} == {}
    assert abs(np.mean(list(errors.values()))) < 2e-4


@pytest.mark.long
@pytest.mark.parametrize("name", SHAPES)
def test_nothing_is_lost_untold(name: str) -> None:
    made, result = SHAPES[name], smoothed(name)
    report = result.report
    assert result.surface.closed
    if name.startswith(("overlapping", "touching")):  # what they hide inside is no loss
        given_mesh = union(*made.mesh.split())
    elif name.startswith("bust"):
        assert "closed by caps" in report["verdict"]["changes"][-1]
        return
    else:
        given_mesh = made.mesh
    far = apart(given_mesh, result.mesh)
    word = report["verdict"]["word"]
    assert word != "kept" or far < FAR * VOXELS[name] + DENSE, far
    tunnels = given_mesh.body_count - given_mesh.euler_number // 2 if given_mesh.is_watertight else None
    if word == "kept" and tunnels is not None and not name.startswith("nested"):
        assert report["topology"]["result"]["tunnels"] == tunnels
        assert report["components"] == given_mesh.body_count
        assert report["volume"] == pytest.approx(made.volume, rel=0.01)


@pytest.mark.long
@pytest.mark.parametrize("cells", [50, 100, 200])
@pytest.mark.parametrize("turn", [False, True])
def test_faces_of_boxes_keep_their_place(cells: int, *, turn: bool, rng: np.random.Generator) -> None:
    sides = cells * np.array([1.0, rng.uniform(0.4, 1), rng.uniform(0.3, 0.9)])
    frame = np.eye(4)
    mesh = box(*sides)
    if turn:
        frame = trimesh.transformations.random_rotation_matrix(rng.random(3))
    frame[:3, 3] = rng.uniform(-3, 3, 3)
    mesh.apply_transform(frame)
    result = smooth_mesh(surface_of(mesh), voxel=1.0, tolerance=None)
    assert result.report["verdict"]["word"] == "kept"
    own = (result.surface.vertices - frame[:3, 3]) @ frame[:3, :3]
    for axis in range(3):
        others = [other for other in range(3) if other != axis]
        inner = (np.abs(own[:, others]) < sides[others] / 2 - 2).all(axis=1)
        for side in (-1, 1):
            face = inner & (side * own[:, axis] > 0)
            assert abs((side * own[face, axis] - sides[axis] / 2).mean()) < 0.03


@pytest.mark.slow
def test_walls_of_one_voxel_and_holes_of_one_and_a_half_survive() -> None:
    plate = smooth_mesh(surface_of(box(50, 40, 1.0)), voxel=1.0, tolerance=None).report
    assert (plate["verdict"]["word"], plate["topology"]["result"]["tunnels"]) == ("kept", 0)
    holes = smooth_mesh(surface_of(plate_with_holes(3.0, 2.0)), voxel=1.0, tolerance=None).report
    assert (holes["verdict"]["word"], holes["topology"]["result"]["tunnels"]) == ("kept", 6)


@st.composite
def assemblies(draw: st.DrawFn) -> trimesh.Trimesh:
    """Boxes, rods and balls on one another, some of them thinner than a voxel."""
    length = st.floats(0.4, 14)
    parts = []
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.sampled_from(["box", "rod", "ball"]))
        if kind == "box":
            part = box(draw(length), draw(length), draw(length))
        elif kind == "rod":
            part = rod(draw(st.floats(0.4, 5)), draw(length))
        else:
            part = ball(draw(st.floats(0.5, 8)), 2)
        part = turned(part, np.random.default_rng(draw(st.integers(0, 99))))
        part.apply_translation([draw(st.floats(-6, 6)) for _ in range(3)])
        parts.append(part)
    return union(box(8, 8, 8), *parts)


@pytest.mark.slow
@settings(max_examples=16)
@given(assemblies())
def test_no_loss_is_called_kept(mesh: trimesh.Trimesh) -> None:
    """Whatever is given: points found by trimesh that lie far away are told."""
    result = smooth_mesh(surface_of(mesh), voxel=1.0, allow_broken=True, tolerance=None)
    if result.report["verdict"]["word"] == "kept":
        assert apart(mesh, result.mesh) < FAR + DENSE


@pytest.mark.slow
@settings(max_examples=8)
@given(st.floats(2.5, 12), st.floats(2, 9), st.integers(0, 99))
def test_a_planted_loss_is_found(long: float, wide: float, seed: int) -> None:
    """A knob on a box, of which the result knows nothing; and the other way, a knob that was not given."""
    block = box(20, 16, 12)
    knob = union(block, box(wide, wide, 2 * long, (0, 0, 6)))
    knob, block = (turned(each, np.random.default_rng(seed)) for each in (knob, block))
    lost = measure_deviation(surface_of(knob), surface_of(block), cell=1.0)
    assert lost.word == "lost"
    assert re.search(r"of the input \(.*%\) is missing", lost.phrases[0])
    assert lost.back.max == pytest.approx(long, abs=1e-5)
    added = measure_deviation(surface_of(block), surface_of(knob), cell=1.0)
    assert added.word == "lost"
    assert "was not in the input" in added.phrases[-1]
    assert measure_deviation(surface_of(knob), surface_of(knob), cell=1.0).word == "kept"


def test_every_place_that_is_lost_counts() -> None:
    """Eight knobs, however few are listed: each of 2 x 2 x 4, of which what is more than two away is lost."""
    block = box(60, 30, 10)
    knobs = [box(2, 2, 10, (x, y, 4)) for x in (-24, -8, 8, 24) for y in (-10, 10)]
    found = measure_deviation(surface_of(union(block, *knobs)), surface_of(block), cell=1.0)
    assert len(found.lost) == 8
    assert " is missing in 8 places, up to " in found.phrases[0]
    assert sum(patch.area for patch in found.lost) == pytest.approx(8 * (4 * 2 * 2 + 4), rel=0.1)


@pytest.mark.slow
def test_a_loss_planted_in_the_field_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if smoothing had eaten a corner: the report compares with what was given, not with a stage in between."""
    eaten = surface_of(box(40, 30, 20))
    assert smooth_mesh(eaten, voxel=1.0, tolerance=None).report["verdict"]["word"] == "kept"
    whole = refining.refine_bricks

    def refine(values: NDArray[Any], *words: Any, **options: Any) -> Any:
        field = whole(values, *words, **options)
        places = (field.where * np.array([8, 8, 16]))[:, :, None, None, None] + np.indices((8, 8, 16))
        corner = (np.moveaxis(places, 1, 0) < np.reshape([16, 16, 16], (3, 1, 1, 1, 1))).all(axis=0)
        return replace(field, values=np.where(corner, np.float32(-1), field.values))

    monkeypatch.setattr(attempt, "refine_bricks", refine)
    with pytest.raises(GeometryError, match=r"mm² of the input \(.*%\) is missing, up to .* mm away, at \(-"):
        smooth_mesh(eaten, voxel=1.0, tolerance=None)
    result = smooth_mesh(eaten, voxel=1.0, allow_broken=True, tolerance=None)
    assert result.report["verdict"]["word"] == "lost"
    assert result.report["verdict"]["lost"][0]["distance"] > 2


@pytest.mark.slow
def test_faces_hidden_inside_are_no_loss_and_sheets_are_told() -> None:
    both = together(box(20, 16, 12), box(10, 30, 6, (2, 3, 1)))
    report = smooth_mesh(surface_of(both), voxel=1.0, tolerance=None).report
    assert report["problems"] == []
    (united,) = report["verdict"]["changes"]
    assert united.startswith("the mesh has 2 components, some of which overlap or touch, and the result 1")
    assert report["distance"]["hidden"] > 100
    sheet = trimesh.Trimesh([[0, 0, 20], [9, 0, 20], [0, 9, 20]], [[0, 1, 2], [0, 2, 1]], process=False)
    report = smooth_mesh(surface_of(together(box(20, 16, 12), sheet)), voxel=1.0, tolerance=None).report
    assert report["verdict"]["word"] == "changed a little"
    assert any("of faces that bound no solid are left out" in change for change in report["verdict"]["changes"])


@pytest.mark.longest
def test_finer_voxels_are_tried_where_something_thin_would_be_lost() -> None:
    """A fin of half a voxel at 200 voxels: kept at 400, and told."""
    part = union(box(100, 20, 20), box(0.4, 20, 30, (0, 0, 20)))
    report = smooth_mesh(surface_of(part), tolerance=None).report
    assert report["verdict"]["tried"][0] == "refine"
    assert report["verdict"]["taken"].endswith("voxels")
    assert report["verdict"]["word"] != "lost"
    with pytest.raises(GeometryError, match=r"of the input \(.*%\) is missing.*leave out --strict"):
        smooth_mesh(
            surface_of(union(box(100, 20, 20), box(0.1, 20, 30, (0, 0, 20)))),
            resolution=50,
            strict=True,
            tolerance=None,
        )


@pytest.mark.slow
def test_crumbs_are_taken_out_and_real_parts_stay() -> None:
    """Balls of one voxel beside a plate that breaks up into crumbs: each is a part of the mesh, and stays."""
    plate = turned(box(50, 40, 0.9), np.random.default_rng(1))
    report = smooth_mesh(surface_of(plate), voxel=1.0, allow_broken=True, method="plain", tolerance=None).report
    removed = report["verdict"]["crumbs"]
    assert removed["limit"] == pytest.approx(8)
    small = together(box(30, 20, 20), box(2, 2, 2, (30, 0, 0)), box(2, 2, 2, (0, 30, 0)))
    assert smooth_mesh(surface_of(small), voxel=1.0, tolerance=None).report["components"] == 3


@pytest.mark.slow
def test_thick_slices_are_interpolated() -> None:
    """A ball in slices of five pixels: nearer to the ball than with the slices as they are, and no terraces."""
    shape, size = (50, 50, 10), np.array([1.0, 1.0, 5.0])
    places = (np.indices(shape) + 0.5 - np.reshape(np.array(shape) / 2, (3, 1, 1, 1))) * np.reshape(size, (3, 1, 1, 1))
    solid = (places**2).sum(axis=0) < 20**2
    result = smooth_volume(solid, spacing=tuple(size), tolerance=None)
    assert result.report["input"]["slices"] == 5
    assert result.report["grid"]["spacing"] == [1.0, 1.0, 1.0]
    middle = np.array(shape) * size / 2
    off = np.linalg.norm(result.surface.vertices - middle, axis=1) - 20
    plain = smooth_volume(solid[:, :, ::1], spacing=1.0, tolerance=None).surface
    stretched = (plain.vertices - np.array(shape) / 2) * size
    assert off.std() < 0.7 * (np.linalg.norm(stretched, axis=1) - 20).std()


@pytest.mark.longest
@pytest.mark.parametrize(("share", "method"), [(0.0, "refine"), (0.1, "plain")])
def test_noise_is_measured_and_smoothed_plainly(share: float, method: str, rng: np.random.Generator) -> None:
    solid = ((np.indices((60, 60, 60)) - 29.5) ** 2).sum(axis=0) < 22**2
    report = smooth_volume(solid ^ (rng.random(solid.shape) < share), allow_broken=True, tolerance=None).report
    assert report["request"]["method"] == method
    assert (report["input"]["noise"] > NOISY) == (method == "plain")


def test_a_radius_in_mm_is_a_number_of_steps() -> None:
    solid = ((np.indices((40, 40, 40)) - 19.5) ** 2).sum(axis=0) < 15**2
    for spacing in (0.5, 1.0):
        report = smooth_volume(solid, spacing=spacing, radius=2.0 * spacing, tolerance=None).report
        assert report["request"]["steps"] == 14  # 3.5 times the square of two cells
