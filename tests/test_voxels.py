"""`voxelise`: which cells lie inside, for meshes in every state."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from infill import GeometryError, MemoryLimitError, ParameterError, Surface, read_mesh
from infill.meshes.hole_filling import fill_holes, open_edges, orient_faces, split_loops
from infill.meshes.merging import merge_vertices
from infill.volume import Volume
from infill.voxels.flooding import enclosed_void
from infill.voxels.from_mesh import voxelise, voxelise_with_report
from infill.voxels.scanlines import fill_rows, intersect_rows

BALL = trimesh.creation.icosphere(subdivisions=3, radius=10.0)
SHIFT = (0.123, 0.234, 0.345)  # keeps faces off the cell centres
MEBI = 2**20


def surface(*meshes: trimesh.Trimesh) -> Surface:
    whole = trimesh.util.concatenate(meshes)
    return Surface(vertices=np.array(whole.vertices), faces=np.array(whole.faces))


def ball(radius: float = 10.0, at: tuple[float, float, float] = (0, 0, 0), *, inward: bool = False) -> trimesh.Trimesh:
    mesh = BALL.copy()
    mesh.apply_scale(radius / 10)
    mesh.apply_translation(at)
    if inward:
        mesh.invert()
    return mesh


def box(*extents: float) -> trimesh.Trimesh:
    mesh = trimesh.creation.box(extents)
    mesh.apply_translation(SHIFT)
    return mesh


def size(volume: Volume) -> float:
    return float(volume.values.sum()) * volume.cell_volume


def moved(of: Surface, *, by: tuple[float, ...] = (0, 0, 0), scale: float = 1.0) -> Surface:
    return Surface(vertices=of.vertices * scale + np.array(by), faces=of.faces)


def inverted(of: Surface) -> Surface:
    return Surface(vertices=of.vertices, faces=of.faces[:, ::-1])


def centres(volume: Volume) -> np.ndarray:
    return volume.place((np.argwhere(np.ones(volume.values.shape, dtype=bool)) + 0.5) * volume.cell_size)


def winding(of: Surface, points: np.ndarray) -> np.ndarray:
    """The winding number by the definition: all solid angles over 4 pi (Van Oosterom and Strackee 1983)."""
    total = np.zeros(len(points))
    for a, b, c in of.vertices[of.faces]:
        a, b, c = a - points, b - points, c - points
        la, lb, lc = (np.linalg.norm(each, axis=1) for each in (a, b, c))
        above = np.einsum("ij,ij->i", a, np.cross(b, c))
        dots = (np.einsum("ij,ij->i", p, q) * r for p, q, r in ((a, b, lc), (b, c, la), (c, a, lb)))
        total += 2 * np.arctan2(above, la * lb * lc + sum(dots))
    return total / (4 * math.pi)


def closed_mesh(seed: int, points: int) -> Surface:
    """Random corners joined as a convex component is: closed, and through itself in many places."""
    rng = np.random.default_rng(seed)
    on_ball = rng.normal(size=(points, 3))
    hull = trimesh.convex.convex_hull(on_ball / np.linalg.norm(on_ball, axis=1)[:, None])
    return Surface(vertices=rng.uniform(-1, 1, size=hull.vertices.shape), faces=np.array(hull.faces))


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), points=st.integers(4, 20))
def test_every_cell_is_what_the_winding_number_says(seed: int, points: int) -> None:
    mesh = closed_mesh(seed, points)
    volume = voxelise(mesh, resolution=12)
    expected = np.abs(winding(mesh, centres(volume))) > 0.5
    assert np.array_equal(volume.values.ravel(), expected)


def test_the_comparison_with_the_winding_number_can_fail() -> None:
    mesh = closed_mesh(1, 12)
    volume = voxelise(mesh, resolution=12)
    other = np.abs(winding(moved(mesh, by=(0.3, 0, 0)), centres(volume))) > 0.5
    assert not np.array_equal(volume.values.ravel(), other)


@given(seed=st.integers(0, 10_000), points=st.integers(4, 20), scale=st.sampled_from([1e-3, 1.0, 25.4]))
def test_the_signs_of_every_row_add_up_to_nothing(seed: int, points: int, scale: float) -> None:
    rng = np.random.default_rng(seed)
    # Whole and half numbers put corners, edges and faces on the rows themselves.
    mesh = closed_mesh(seed, points)
    corners = np.round(rng.uniform(1, 30, size=mesh.vertices.shape) * 2) / 2 if seed % 2 else mesh.vertices * 14 + 16
    found = intersect_rows(corners, mesh.faces, (33, 33, 33))
    total = np.bincount(found.row, weights=found.sign)
    assert not total.any()


@pytest.mark.slow
@given(steps=st.tuples(*[st.integers(-40, 40)] * 3))
def test_moving_by_whole_cells_moves_the_grid(steps: tuple[int, ...]) -> None:
    mesh = moved(surface(ball()), by=SHIFT)
    here, there = voxelise(mesh, voxel=1.0), voxelise(moved(mesh, by=steps), voxel=1.0)
    assert np.array_equal(here.values, there.values)
    assert np.allclose(np.array(there.origin) - here.origin, steps, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_mirrored_mesh_has_mirrored_cells(axis: int) -> None:
    mesh = closed_mesh(5, 15)
    sign = np.ones(3)
    sign[axis] = -1
    mirrored = Surface(vertices=mesh.vertices * sign, faces=mesh.faces[:, ::-1])
    assert np.array_equal(voxelise(mirrored, resolution=30).values, np.flip(voxelise(mesh, resolution=30).values, axis))


@pytest.mark.slow
@pytest.mark.parametrize("order", [(1, 2, 0), (2, 0, 1), (1, 0, 2)])
def test_axes_are_all_alike(order: tuple[int, ...]) -> None:
    mesh = closed_mesh(6, 15)
    turned = Surface(vertices=mesh.vertices[:, order], faces=mesh.faces)
    assert np.array_equal(voxelise(turned, resolution=30).values, voxelise(mesh, resolution=30).values.transpose(order))


@pytest.mark.longest
@pytest.mark.parametrize("scale", [1e-3, 25.4, 1e4])
def test_units_scale_the_grid_and_change_no_cell(scale: float) -> None:
    mesh = closed_mesh(7, 15)
    here, there = voxelise(mesh, resolution=30), voxelise(moved(mesh, scale=scale), resolution=30)
    assert np.array_equal(here.values, there.values)
    assert there.spacing == pytest.approx(np.array(here.spacing) * scale)


@pytest.mark.slow
def test_an_inverted_mesh_is_the_mesh() -> None:
    mesh = closed_mesh(8, 15)
    assert np.array_equal(voxelise(inverted(mesh), resolution=30).values, voxelise(mesh, resolution=30).values)


@pytest.mark.slow
def test_the_order_of_faces_and_merged_vertices_do_not_matter() -> None:
    mesh = closed_mesh(9, 15)
    rng = np.random.default_rng(0)
    loose = Surface(vertices=mesh.vertices[mesh.faces].reshape(-1, 3), faces=np.arange(mesh.faces.size).reshape(-1, 3))
    shuffled = Surface(vertices=loose.vertices, faces=rng.permutation(loose.faces))
    assert np.array_equal(voxelise(shuffled, resolution=30).values, voxelise(mesh, resolution=30).values)


def test_the_grid_is_the_box_with_its_margin() -> None:
    volume = voxelise(surface(box(10, 6, 3)), voxel=0.5, margin=3)
    assert volume.values.shape == (26, 18, 12)
    assert np.array(volume.origin) == pytest.approx(np.array([-5, -3, -1.5]) + SHIFT - 3 * 0.5)
    assert volume.values[3:-3, 3:-3, 3:-3].all()
    assert volume.values.sum() == 20 * 12 * 6


@pytest.mark.parametrize("margin", [0, 1, 2])
def test_no_margin_loses_no_cell(margin: int) -> None:
    assert voxelise(surface(box(4, 4, 4)), voxel=0.5, margin=margin).values.sum() == 512


def test_a_ball_has_its_volume() -> None:
    for resolution, within in ((50, 0.005), (200, 0.0005)):  # the error falls faster than the cell size
        assert size(voxelise(surface(ball()), resolution=resolution)) == pytest.approx(BALL.volume, rel=within)


@pytest.mark.longest
@pytest.mark.parametrize("turned", [(False, False), (True, True), (False, True), (True, False)])
def test_overlapping_balls_are_united(turned: tuple[bool, bool]) -> None:
    one, other = ball(inward=turned[0]), ball(at=(12, 0, 0), inward=turned[1])
    both = voxelise_with_report(surface(one, other), voxel=0.5)
    reference = voxelise(surface(ball(), ball(at=(12, 0, 0))), voxel=0.5)
    assert np.array_equal(both.volume.values, reference.values)
    apart = np.abs(winding(surface(ball()), centres(reference)[::997])) > 0.5
    apart |= np.abs(winding(surface(ball(at=(12, 0, 0))), centres(reference)[::997])) > 0.5
    assert np.array_equal(reference.values.ravel()[::997], apart)
    assert both.repairs.components == 2


@pytest.mark.parametrize("all_inward", [False, True])
def test_a_ball_that_faces_against_the_one_around_it_is_a_cavity(all_inward: bool) -> None:
    mesh = surface(ball(inward=all_inward), ball(5, inward=not all_inward))
    assert size(voxelise(mesh, resolution=100)) == pytest.approx(mesh.volume * (-1 if all_inward else 1), rel=0.002)


@pytest.mark.slow
@pytest.mark.parametrize("inward", [False, True])
def test_a_ball_that_faces_as_the_one_around_it_adds_nothing(inward: bool) -> None:
    mesh = surface(ball(inward=inward), ball(5, inward=inward))
    assert np.array_equal(voxelise(mesh, voxel=0.5).values, voxelise(surface(ball()), voxel=0.5).values)


def test_an_inverted_ball_beside_a_larger_one_keeps_its_cavity() -> None:
    mesh = surface(ball(20), ball(at=(40, 0, 0), inward=True), ball(5, at=(40, 0, 0)))
    found = voxelise_with_report(mesh, voxel=0.5)
    volume, repairs = found.volume, found.repairs
    expected = BALL.volume * (8 + 1 - 1 / 8)
    assert size(volume) == pytest.approx(expected, rel=0.002)
    assert repairs.turned == 2
    assert repairs.volume == pytest.approx(expected, rel=1e-9)  # of the triangles, in mm³, as they are turned


def test_solid_in_a_cavity_is_solid() -> None:
    for inward in (False, True):
        mesh = surface(ball(), ball(7, inward=True), ball(4, inward=inward))
        assert size(voxelise(mesh, voxel=0.25)) == pytest.approx(BALL.volume * (1 - 0.343 + 0.064), rel=0.003)


@pytest.mark.slow
@pytest.mark.parametrize("missing", range(12))
def test_a_box_without_a_triangle_is_the_box(missing: int) -> None:
    whole = surface(box(5, 4, 3))
    holed = Surface(vertices=whole.vertices, faces=np.delete(whole.faces, missing, axis=0))
    found = voxelise_with_report(holed, voxel=0.25)
    volume, repairs = found.volume, found.repairs
    assert np.array_equal(volume.values, voxelise(whole, voxel=0.25).values)
    assert repairs.holes == 1
    assert 0 < repairs.hole_share < 0.2


@pytest.mark.slow
@given(seed=st.integers(0, 10_000))
def test_triangles_turned_over_or_doubled_change_nothing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    whole = surface(ball())
    faces = whole.faces.copy()
    some = rng.choice(len(faces), size=len(faces) // 3, replace=False)
    faces[some] = faces[some, ::-1]
    assert np.array_equal(
        voxelise(Surface(vertices=whole.vertices, faces=faces), voxel=1.0).values, voxelise(whole, voxel=1.0).values
    )
    doubled = Surface(vertices=whole.vertices, faces=np.concatenate([whole.faces, whole.faces[some[:20]]]))
    assert np.array_equal(voxelise(doubled, voxel=1.0).values, voxelise(whole, voxel=1.0).values)


@pytest.mark.slow
def test_half_a_ball_is_closed_by_a_disc_as_by_the_generalised_winding_number() -> None:
    dome = trimesh.intersections.slice_mesh_plane(BALL, plane_normal=(0, 0, 1), plane_origin=(0, 0, 0.1))
    mesh = merge_vertices(np.round(dome.vertices, 9), np.array(dome.faces))  # the cut leaves cracks of 1e-15 mm
    assert (mesh.vertices[np.unique(open_edges(mesh.faces)), 2] == 0.1).all()  # the hole is flat
    volume = voxelise(mesh, voxel=1.03)
    points = centres(volume)
    expected = np.abs(winding(mesh, points)) > 0.5
    assert np.array_equal(volume.values.ravel(), expected)


def test_cracks_change_nothing(rng: np.random.Generator) -> None:
    corners = BALL.vertices[BALL.faces]
    # Every triangle apart from its neighbours by less than anything a file keeps.
    apart = Surface(
        vertices=(corners + rng.uniform(-1e-12, 1e-12, corners.shape)).reshape(-1, 3),
        faces=np.arange(corners.size // 3).reshape(-1, 3),
    )
    found = voxelise_with_report(apart, voxel=1.03)
    volume, repairs = found.volume, found.repairs
    assert np.array_equal(volume.values, voxelise(surface(BALL), voxel=1.03).values)
    assert repairs.components == 1


def test_a_pipe_without_ends_is_filled() -> None:
    pipe = trimesh.creation.cylinder(radius=5, height=20, sections=64)
    mesh = surface(pipe)
    wall = Surface(vertices=mesh.vertices, faces=mesh.faces[np.abs(pipe.face_normals[:, 2]) < 0.5])
    found = voxelise_with_report(wall, voxel=0.3)
    volume, repairs = found.volume, found.repairs
    assert np.array_equal(volume.values, voxelise(mesh, voxel=0.3).values)
    assert repairs.holes == 2


def test_a_box_without_a_lid_is_filled_to_the_brim_as_by_the_generalised_winding_number() -> None:
    whole = surface(box(4, 4, 4))
    normal = np.cross(*(np.diff(whole.vertices[whole.faces], axis=1)[:, i] for i in range(2)))
    holed = Surface(vertices=whole.vertices, faces=whole.faces[normal[:, 2] < 1])
    volume = voxelise(holed, voxel=0.5)
    points = centres(volume)
    assert np.array_equal(volume.values.ravel(), winding(holed, points) > 0.5)


def test_loops_part_where_they_touch() -> None:
    edges = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]])
    assert sorted(sorted(loop) for loop in split_loops(edges)) == [[0, 1, 2], [0, 3, 4]]


def test_a_capped_mesh_is_closed_as_a_sum() -> None:
    rng = np.random.default_rng(3)
    whole = surface(ball())
    faces = whole.faces[rng.random(len(whole.faces)) > 0.3]
    _, closed, holes = fill_holes(whole.vertices, faces)
    assert holes > 10
    assert len(open_edges(closed)) == 0


def test_a_moebius_strip_is_left_as_it_is() -> None:
    strip = np.array([[i, (i + 1) % 5, (i + 2) % 5] for i in range(5)])  # the five-vertex Möbius band
    assert np.array_equal(orient_faces(strip), strip)


def test_filled_cells_and_flooded_cells_agree() -> None:
    volume = voxelise(surface(ball(), ball(5, inward=True)), voxel=0.5)
    hollow = enclosed_void(volume.values)
    assert hollow.sum() * volume.cell_volume == pytest.approx(BALL.volume / 8, rel=0.02)  # 20 cells across
    assert not (hollow & volume.values).any()


def test_a_row_through_nothing_is_empty() -> None:
    nothing = intersect_rows(
        np.array([[0.1, 0.1, 0.1], [0.2, 0.1, 0.1], [0.1, 0.2, 0.1]]), np.array([[0, 1, 2]]), (2, 2, 2)
    )
    assert len(nothing.row) == 0
    assert not fill_rows(nothing, (2, 2, 2)).any()


@pytest.mark.parametrize(
    ("mesh", "options", "error", "says"),
    [
        (surface(box(4, 4, 4)), {"voxel": 1, "resolution": 9}, ParameterError, "voxel and resolution are both given"),
        (surface(box(4, 4, 4)), {"voxel": 0}, ParameterError, "voxel is 0"),
        (surface(box(4, 4, 4)), {"resolution": 0}, ParameterError, "resolution is 0"),
        (surface(box(4, 4, 4)), {"margin": -1}, ParameterError, "margin is -1"),
        (surface(box(4, 4, 4)), {"resolution": 3000}, MemoryLimitError, "3004 x 3004 x 3004"),
        (surface(ball(), ball(at=(40, 0, 0))), {"voxel": 100}, ParameterError, "voxel is 100 mm and the part"),
        (Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]])), {}, GeometryError, "encloses nothing"),
        (Surface(vertices=np.zeros((3, 3)), faces=np.array([[0, 1, 2]])), {}, GeometryError, "one point"),
        (Surface(vertices=np.eye(3), faces=np.empty((0, 3), dtype=int)), {}, GeometryError, "no triangles"),
        (Surface(vertices=np.full((3, 3), np.nan), faces=np.array([[0, 1, 2]])), {}, GeometryError, "not finite"),
    ],
)
def test_errors_say_what_to_do(mesh: Surface, options: dict[str, float], error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says) as caught:
        voxelise(mesh, max_memory=200 * MEBI, **options)
    assert "\n" not in str(caught.value)
    assert ";" in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "models/bunny_75k.off",
        "models/armadillo_52k.off",
        "models/horse_97k.ply",
        "models/pig_filled.stl",
        "medical/femur.stl",
        "medical/skull_d.stl",
        "medical/mandible_repaired_mm.stl",
        "printable/m3x10_screw.stl",
    ],
)
def test_closed_meshes_have_their_volume(data: Path, name: str) -> None:
    mesh = read_mesh(data / name)
    # 200 cells along the longest side; faces that lie along the grid may all round one way.
    assert size(voxelise(mesh)) == pytest.approx(abs(mesh.volume), rel=1e-3)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "expected", "within"),
    [
        ("nasty/nonmanifold.stl", 1.0, 1e-9),
        ("nasty/cubes_touching_edge.stl", 2.0, 1e-9),
        ("nasty/extruder_idler_overlapping.obj", 5420.0, 3e-3),  # flat walls, 0.19 mm cells
        ("nasty/multibody_ascii.stl", 0.0014714 + 0.0059518, 1e-2),  # faces set right by trimesh's fix_normals
        ("nasty/huge_150m_inverted.stl", 1e15, 1e-2),  # a step of 1/3 of the side, 66.7 cells
        ("nasty/frog_legs_open.obj", 1316.8, 1e-2),  # 2 mm thick: 8 cells
        ("nasty/wall_hole_degenerate.obj", 1066.7, 1e-2),
        ("models/bunny_holes_69k.obj", 0.000754, 5e-3),  # the closed version of it
        ("medical/mandible_raw_m.stl", 5.13e-5, 1e-3),
        ("printable/prusa_x-carriage.stl", 33664.0, 5e-3),  # cavities on purpose
    ],
)
def test_broken_meshes_have_the_volume_of_the_part(data: Path, name: str, expected: float, within: float) -> None:
    assert size(voxelise(read_mesh(data / name))) == pytest.approx(expected, rel=within)


def test_an_open_mesh_is_the_same_mesh_filled(data: Path) -> None:
    found = voxelise_with_report(read_mesh(data / "models/pig_open.stl"))
    volume, repairs = found.volume, found.repairs
    assert repairs.holes == 432
    assert np.array_equal(volume.values, voxelise(read_mesh(data / "models/pig_filled.stl")).values)


@pytest.mark.longest
def test_overlapping_bones_are_united(data: Path) -> None:
    mesh = read_mesh(data / "medical/foot_right_bodyparts3d.stl")
    found = voxelise_with_report(mesh, resolution=40)
    volume, repairs = found.volume, found.repairs
    assert (repairs.components, repairs.turned, repairs.holes) == (24, 0, 0)
    some = np.random.default_rng(4).choice(volume.values.size, 20, replace=False)
    some = np.concatenate([some, np.flatnonzero(volume.values.ravel())[::50][:30]])
    assert np.array_equal(volume.values.ravel()[some], np.abs(winding(mesh, centres(volume)[some])) > 0.5)


def test_triangles_without_volume_are_refused(data: Path) -> None:
    with pytest.raises(GeometryError, match="encloses nothing"):
        voxelise(read_mesh(data / "nasty/triangle_soup.stl"))


def test_the_mesh_that_was_voxelised_is_closed_and_encloses_what_was_told() -> None:
    """As it stands where it is closed, its vertices merged where that closes it, and else with its caps."""
    whole = surface(box(5, 4, 3))
    soup = Surface(vertices=whole.vertices[whole.faces].reshape(-1, 3), faces=np.arange(36).reshape(-1, 3))
    holed = Surface(vertices=whole.vertices, faces=whole.faces[:-1])
    for mesh in (whole, soup, holed):
        found = voxelise_with_report(mesh, voxel=0.25)
        assert found.closed.closed
        assert found.closed.volume == pytest.approx(60)
        assert found.repairs.volume == pytest.approx(60)
        assert found.closed.bounds == pytest.approx(mesh.bounds)


@pytest.mark.slow
def test_a_mesh_with_holes_is_capped_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from infill import smooth_mesh
    from infill.voxels import from_mesh

    calls = []

    def counted(*arguments: Any) -> Any:
        calls.append(1)
        return fill_holes(*arguments)

    for module in ("infill.voxels.from_mesh", "infill.smoothing.job"):
        monkeypatch.setattr(f"{module}.fill_holes", counted, raising=False)
    assert from_mesh.fill_holes is counted
    whole = surface(BALL)
    report = smooth_mesh(Surface(vertices=whole.vertices, faces=whole.faces[3:]), resolution=30, tolerance=None).report
    assert report["input"]["repairs"]["holes"] >= 1
    assert report["distance"]["data"]["max"] < 1.5 * max(report["grid"]["spacing"])
    assert len(calls) == 1
