"""Components of a mesh smoothed one by one: what overlaps or touches stays apart, cavities stay where they are."""

from __future__ import annotations

import json
import math
import re
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from shapes import assert_printable
from test_command_line import one_line_error, run

from infill import GeometryError, ParameterError, Surface, read_mesh, smooth_mesh
from infill.meshes.split_components import concatenate_surfaces, edge_components, split_components

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

VOLUME = 1e-4  # of the volume: the level is looked for to 1e-5, and 32-bit corners cost the rest


def ball(radius: float, at: tuple[float, float, float] = (0, 0, 0), *, inwards: bool = False) -> trimesh.Trimesh:
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=radius)
    mesh.apply_translation(at)
    if inwards:
        mesh.invert()
    return mesh


def box(at: tuple[float, float, float], side: float = 10.0) -> trimesh.Trimesh:
    mesh = trimesh.creation.box((side, side, side))
    mesh.apply_translation(at)
    return mesh


def surface(*meshes: trimesh.Trimesh) -> Surface:
    whole = trimesh.util.concatenate(list(meshes))
    return Surface(vertices=np.asarray(whole.vertices), faces=np.asarray(whole.faces))


def merged(*meshes: trimesh.Trimesh) -> Surface:
    """Meshes as a file without connections holds them: equal corners are one."""
    soup = surface(*meshes)
    vertices, index = np.unique(soup.vertices.round(9), axis=0, return_inverse=True)
    return Surface(vertices=vertices, faces=index.reshape(-1)[soup.faces])


CROSS = [
    (0.0, 0.0, 0.0),
    *[tuple(float(10 * way * (i == axis)) for i in range(3)) for axis in range(3) for way in (-1, 1)],
]


# --- parting ---------------------------------------------------------------------------------------------


def test_seven_boxes_that_share_their_faces_are_seven() -> None:
    for mesh in (surface(*map(box, CROSS)), merged(*map(box, CROSS))):
        parts = split_components(mesh, 0.1)
        assert [len(each.faces) for each in parts.surfaces] == [12] * 7
        assert all(each.closed and each.volume == pytest.approx(1000) for each in parts.surfaces)
        assert sorted(tuple(each.bounds.mean(axis=0).round(6)) for each in parts.surfaces) == sorted(CROSS)


def test_boxes_that_share_an_edge_or_a_corner_are_apart() -> None:
    for at in ((10.0, 10.0, 0.0), (10.0, 10.0, 10.0)):
        parts = split_components(merged(box((0, 0, 0)), box(at)), 0.1)
        assert [each.volume for each in parts.surfaces] == pytest.approx([1000, 1000])


def test_the_order_of_faces_and_their_place_do_not_matter() -> None:
    rng = np.random.default_rng(0)
    mesh = merged(*map(box, CROSS))
    for _ in range(20):
        turn = trimesh.transformations.random_rotation_matrix(rng.random(3))[:3, :3]
        turned = Surface(vertices=mesh.vertices @ turn.T, faces=mesh.faces[rng.permutation(len(mesh.faces))])
        assert edge_components(turned.vertices, turned.faces)[1] == 7


def test_a_solid_that_touches_itself_is_one() -> None:
    """A ring of eight cubes in a plane without one at a corner: the two beside the gap share an edge."""
    cells = [(0, 0), (1, 0), (2, 0), (0, 1), (0, 2), (1, 2), (2, 1)]
    solid = np.zeros((3, 3, 1), bool)
    solid[tuple(np.transpose([(x, y, 0) for x, y in cells]))] = True
    vertices, faces = [], []
    for at in np.argwhere(solid):
        for axis in range(3):
            for way in (-1, 1):
                beside = at + way * (np.arange(3) == axis)
                if (beside >= 0).all() and (beside < solid.shape).all() and solid[tuple(beside)]:
                    continue
                one, other = (axis + 1) % 3, (axis + 2) % 3
                corners = np.repeat(at[None] + 0.0, 4, axis=0)
                corners[:, axis] += way > 0
                corners[[1, 2], one] += 1
                corners[[2, 3], other] += 1
                order = (0, 1, 2, 3) if way > 0 else (3, 2, 1, 0)
                begin = len(vertices)
                vertices.extend(corners)
                faces.extend(
                    [
                        [begin + order[0], begin + order[1], begin + order[2]],
                        [begin + order[0], begin + order[2], begin + order[3]],
                    ]
                )
    points, index = np.unique(np.array(vertices), axis=0, return_inverse=True)
    mesh = Surface(vertices=points, faces=index.reshape(-1)[np.array(faces)])
    assert mesh.volume == pytest.approx(7)
    assert not mesh.closed  # four faces share the edge between (1, 2) and (2, 1)
    assert len(split_components(mesh, 0.1).surfaces) == 1


@pytest.mark.slow
def test_cavities_belong_to_what_is_around_them_and_islands_do_not() -> None:
    nested = surface(ball(10), ball(7, inwards=True), ball(4), ball(2, inwards=True))
    for mesh in (nested, Surface(vertices=nested.vertices, faces=nested.faces[:, ::-1])):
        parts = split_components(mesh, 0.1)
        volumes = [abs(each.volume) for each in parts.surfaces]
        expected = [ball(10).volume - ball(7).volume, ball(4).volume - ball(2).volume]
        assert volumes == pytest.approx(expected)


def test_a_ball_inside_another_that_faces_the_same_way_is_its_own() -> None:
    assert len(split_components(surface(ball(10), ball(5)), 0.1).surfaces) == 2


def test_sheets_are_counted_and_left_out() -> None:
    loose = trimesh.Trimesh([(30, 0, 0), (31, 0, 0), (30, 1, 0)], [(0, 1, 2)], process=False)
    parts = split_components(surface(ball(10), loose), 0.1)
    assert (len(parts.surfaces), parts.sheets) == (1, 1)


def test_an_open_component_is_one_too() -> None:
    half = ball(10)
    half.update_faces(half.triangles_center[:, 2] < 5)
    parts = split_components(surface(half, ball(3, (20, 0, 0))), 0.1)
    assert [len(each.faces) for each in parts.surfaces] == [len(half.faces), len(ball(3).faces)]


def test_joined_surfaces_are_one_after_the_other() -> None:
    one, other = surface(ball(10)), surface(ball(5))
    both = concatenate_surfaces([one, other])
    assert both.volume == pytest.approx(one.volume + other.volume)
    assert both.closed
    assert (both.faces[: len(one.faces)] == one.faces).all()


# --- smoothing -------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_balls_that_overlap_stay_two_of_exactly_their_volumes() -> None:
    one, other = ball(10), ball(8, (9, 0, 0))
    mesh = surface(other, one)
    assert smooth_mesh(mesh, resolution=60, tolerance=None).report["components"] == 1
    result = smooth_mesh(mesh, resolution=60, by_component=True, tolerance=None)
    assert list(result.surfaces) == ["component_1", "component_2"]
    for found, given in zip(result.surfaces.values(), (one, other), strict=True):
        assert found.volume == pytest.approx(given.volume, rel=VOLUME)
        assert found.bounds == pytest.approx(given.bounds, abs=0.15)  # half a voxel
        assert_printable(found.to_trimesh())
    sizes = [each["report"]["grid"]["spacing"] for each in result.report["components"]]
    assert sizes == [pytest.approx([27 / 60] * 3)] * 2
    assert result.report["volume"] == pytest.approx(one.volume + other.volume, rel=VOLUME)


@pytest.mark.slow
def test_a_shell_with_a_cavity_stays_one() -> None:
    result = smooth_mesh(surface(ball(10), ball(6, inwards=True)), resolution=60, by_component=True, tolerance=None)
    assert list(result.surfaces) == ["component_1"]
    assert result.surface.volume == pytest.approx(ball(10).volume - ball(6).volume, rel=VOLUME)
    assert result.report["components"][0]["report"]["topology"]["result"]["cavities"] == 1


@pytest.mark.slow
def test_seven_boxes_stay_seven() -> None:
    result = smooth_mesh(merged(*map(box, CROSS)), resolution=60, by_component=True, tolerance=None)
    assert len(result.surfaces) == 7
    for found in result.surfaces.values():
        assert found.volume == pytest.approx(1000, rel=VOLUME)


@pytest.mark.slow
def test_one_component_is_smoothed_as_ever() -> None:
    mesh = surface(ball(10))
    one, other = (
        smooth_mesh(mesh, resolution=40, tolerance=None),
        smooth_mesh(mesh, resolution=40, by_component=True, tolerance=None),
    )
    assert np.allclose(one.surface.vertices, other.surface.vertices, atol=1e-9)
    assert (one.surface.faces == other.surface.faces).all()


@pytest.mark.longest
def test_a_small_component_gets_finer_voxels_unless_their_size_was_asked_for() -> None:
    mesh = surface(ball(50), ball(0.2, (60, 0, 0)))
    spacing = smooth_mesh(mesh, by_component=True, tolerance=None).report["components"][1]["report"]["grid"]["spacing"]
    assert spacing == pytest.approx([0.05] * 3, rel=0.01)
    with pytest.raises(ParameterError, match=r"component_2: voxel is 1 mm .* give at most 0\.2 mm"):
        smooth_mesh(mesh, voxel=1.0, by_component=True, tolerance=None)
    result = smooth_mesh(mesh, voxel=1.0, by_component=True, allow_broken=True, tolerance=None)
    assert list(result.surfaces) == ["component_1"]
    assert result.report["failed"][0]["name"] == "component_2"
    assert result.report["verdict"]["word"] == "lost"


def test_mistakes_are_told_in_one_line() -> None:
    with pytest.raises(ParameterError, match="give one of them"):
        smooth_mesh(surface(ball(10)), voxel=1.0, resolution=20, by_component=True, tolerance=None)
    flat = Surface(vertices=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), faces=np.array([[0, 1, 2]]))
    with pytest.raises(GeometryError, match="none of the 1 components of the mesh encloses anything"):
        smooth_mesh(flat, by_component=True, tolerance=None)
    point = Surface(vertices=np.zeros((3, 3)), faces=np.array([[0, 1, 2]]))
    with pytest.raises(GeometryError, match="one point"):
        smooth_mesh(point, by_component=True, tolerance=None)
    with pytest.raises(GeometryError, match="no component can be smoothed; component_1: "):
        smooth_mesh(
            surface(ball(0.3), ball(0.2, (9, 0, 0))), voxel=4.0, by_component=True, allow_broken=True, tolerance=None
        )


@pytest.mark.slow
def test_progress_never_goes_back() -> None:
    told: list[float] = []
    mesh = surface(ball(10), ball(8, (9, 0, 0)))
    smooth_mesh(mesh, resolution=30, by_component=True, progress=lambda _, share: told.append(share), tolerance=None)
    assert told == sorted(told)
    assert 0.5 < told[-1] <= 1


# --- files -----------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_every_format_holds_all_components(tmp_path: Path) -> None:
    result = smooth_mesh(surface(ball(10), ball(8, (9, 0, 0))), resolution=40, by_component=True, tolerance=None)
    for suffix in (".stl", ".ply", ".obj", ".3mf", ".glb"):
        read = read_mesh(result.save(tmp_path / f"both{suffix}"))
        assert read.volume == pytest.approx(result.report["volume"], rel=VOLUME), suffix
        assert len(trimesh.Trimesh(read.vertices, read.faces, process=False).split()) == 2, suffix
    assert result.save(tmp_path / "both.png").stat().st_size > 1000


@pytest.mark.longest
def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    trimesh.util.concatenate([ball(10), ball(8, (9, 0, 0))]).export("both.stl")
    words = ("smooth", "both.stl", "--by-component", "--resolution", "40")
    result = run(*words, "-o", "o.stl", "-o", "o.3mf", "--preview", "o.png", "--json")
    assert result.exit_code == 0, result.stderr
    report = json.loads(result.stdout)
    assert [each["name"] for each in report["components"]] == ["component_1", "component_2"]
    assert report["files"] == ["o.stl", "o.3mf", "o.png"]
    assert "component_2" in result.stderr
    with zipfile.ZipFile("o.3mf") as archive:
        model = archive.read("3D/3dmodel.model").decode()
    assert re.findall(r'name="(component_\d)"', model) == ["component_1", "component_2"]
    assert read_mesh(tmp_path / "o.stl").volume == pytest.approx(report["volume"], rel=VOLUME)
    assert run(*words, "-o", "o.npz").exit_code == 2
    assert run(*words, "--each-label", "-o", "x.3mf").exit_code == 2
    np.save("ball.npy", np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0) < 64)
    one_line_error(run("smooth", "ball.npy", "--by-component", "-o", "y.stl"), "by-component is for mesh")
    assert math.isfinite(report["seconds"]["total"])


def test_reports_of_components_hold_on_to_nothing() -> None:
    """What is measured only when somebody asks needs the field, which for many components is much memory."""
    both = trimesh.util.concatenate([trimesh.creation.icosphere(radius=5), trimesh.creation.box((4, 4, 4))])
    both.vertices[-8:] += [20, 0, 0]
    report: Any = smooth_mesh(both, voxel=0.5, by_component=True, tolerance=None).report
    assert [type(each["report"]) for each in report["components"]] == [dict, dict]
    assert all(each["report"]["distance"]["result"]["max"] < 1 for each in report["components"])


@pytest.mark.slow
def test_the_last_row_names_what_the_verdict_is_due_to(tmp_path: Path) -> None:
    boxes = [trimesh.creation.box((10, 10, 10)), trimesh.creation.box((8, 8, 8))]
    boxes[1].apply_translation((20, 0, 0))
    path = tmp_path / "boxes.stl"
    trimesh.util.concatenate(boxes).export(path)
    words = ["smooth", path, "--by-component", "-o", tmp_path / "a.3mf", "--voxel", "0.25"]
    kept = run(*words)
    assert re.search(r"\n  verdict +kept\n", kept.stderr)
    lost = run(*words, "--smooth", "plain", "--level", "0", "--allow-broken", "--force")
    assert re.search(r"\n  verdict +lost: component_1 and 1 more of 2\n", lost.stderr)
