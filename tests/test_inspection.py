"""`check`: what is printable and what is not."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from infill import FormatError, GeometryError, Surface, check, isosurface, save
from infill.inspection.printability import guess_unit
from infill.meshes.intersections import count_self_intersections, intersecting_pairs, intersecting_pairs_reference

BOX = trimesh.creation.box((10, 10, 10))


def joined(*meshes: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.util.concatenate(meshes)


def moved(mesh: trimesh.Trimesh, x: float, y: float = 0, z: float = 0) -> trimesh.Trimesh:
    copy = mesh.copy()
    copy.apply_translation((x, y, z))
    return copy


def with_faces(mesh: trimesh.Trimesh, faces: np.ndarray) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, np.ascontiguousarray(faces), process=False)


def sharing_vertices(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    mesh.merge_vertices()
    return mesh


def test_a_box_is_printable() -> None:
    found = check(BOX)
    assert found.printable
    assert found.problems == found.warnings == ()
    assert (found.triangles, found.components, found.open_edges) == (12, 1, 0)
    assert found.closed
    assert found.outward
    assert found.manifold == "NoError"
    assert found.volume == pytest.approx(1000)
    assert found.area == pytest.approx(600)
    assert found.extents == pytest.approx([10, 10, 10])
    assert found.unit_guess == "mm"


@pytest.mark.parametrize(
    ("mesh", "says"),
    [
        (with_faces(BOX, BOX.faces[1:]), "3 edge"),
        (with_faces(BOX, BOX.faces[:, ::-1]), "inside out"),
        (with_faces(BOX, np.concatenate([BOX.faces[:1, ::-1], BOX.faces[1:]])), "disagree"),
        (with_faces(BOX, np.concatenate([BOX.faces, BOX.faces[:2]])), "2 duplicate triangles"),
        (joined(BOX, moved(with_faces(BOX, BOX.faces[:, ::-1]), 20)), "inside out"),
        (sharing_vertices(joined(BOX, moved(BOX, 10, 10))), "1 edge"),
    ],
    ids=["hole", "inside out", "one turned", "double", "one component inside out", "touching edge"],
)
def test_what_is_not_printable(mesh: trimesh.Trimesh, says: str) -> None:
    found = check(mesh)
    assert not found.printable
    assert any(re.search(says, problem) for problem in found.problems)


def test_a_cavity_faces_in() -> None:
    hollow = joined(BOX, with_faces(trimesh.creation.box((4, 4, 4)), trimesh.creation.box().faces[:, ::-1]))
    found = check(hollow)
    assert found.printable
    assert found.components == 2
    assert found.volume == pytest.approx(1000 - 64)


def test_a_hole_is_no_cavity() -> None:
    """An inverted cube in the empty middle of a ring lies in no solid."""
    ring = trimesh.creation.annulus(5, 8, 4)
    cube = trimesh.creation.box()
    found = check(joined(ring, with_faces(cube, cube.faces[:, ::-1])))
    assert not found.outward
    assert not found.printable


def test_vertices_without_a_face_do_not_count(tmp_path: Path) -> None:
    stray = trimesh.Trimesh(np.concatenate([BOX.vertices, [[1000, 0, 0], [0, 0, 500]]]), BOX.faces, process=False)
    for found in (check(stray), check(save(stray, tmp_path / "stray.ply"))):
        assert found.components == 1
        assert found.extents == pytest.approx([10, 10, 10])


@pytest.mark.parametrize("faces", [np.empty((0, 3), dtype=int), np.array([[0, 1, 99]])])
def test_what_is_no_mesh_is_told(faces: np.ndarray) -> None:
    with pytest.raises(GeometryError, match="no faces|do not exist"):
        check(Surface(vertices=BOX.vertices, faces=faces))
    with pytest.raises(GeometryError, match="is not a mesh"):
        check(trimesh.Scene(BOX))


def test_components_that_overlap_are_a_warning() -> None:
    found = check(joined(BOX, moved(BOX, 5, 4, 3)))
    assert found.printable
    assert found.self_intersections > 0
    assert "pass through each other" in found.warnings[0]


def test_triangles_without_area_are_a_warning() -> None:
    """A corner of one face is cut off by a triangle of three points in a line."""
    vertices = np.concatenate([BOX.vertices, [(BOX.vertices[BOX.faces[0, 0]] + BOX.vertices[BOX.faces[0, 1]]) / 2]])
    a, b, c = BOX.faces[0]
    faces = np.concatenate([BOX.faces[1:], [[a, 8, c], [8, b, c], [a, b, 8]]])
    found = check(trimesh.Trimesh(vertices, faces, process=False))
    assert found.printable
    assert found.degenerate == 1


def test_triangles_with_two_equal_corners_are_a_warning() -> None:
    faces = np.concatenate([BOX.faces, [[0, 0, 1]]])
    found = check(with_faces(BOX, faces))
    assert found.printable
    assert found.degenerate == 1
    with pytest.raises(FormatError, match="three different corners"):
        check(with_faces(BOX, np.zeros((2, 3), dtype=int)))


@pytest.mark.parametrize(
    ("largest", "unit"),
    [(0.047, "m"), (0.8, "in"), (1.0, "in"), (2.0, "mm"), (250, "mm"), (2001, "µm"), (150000, "µm")],
)
def test_the_unit_is_guessed_by_size(largest: float, unit: str) -> None:
    assert guess_unit(largest) == unit


def crossing_segments(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether an edge of `one` crosses the inside of `other`, by solving for the point."""
    a, b, c = other
    for p, q in ((0, 1), (1, 2), (2, 0)):
        matrix = np.stack([b - a, c - a, one[p] - one[q]], axis=1)
        if abs(np.linalg.det(matrix)) < 1e-12:
            continue
        u, v, t = np.linalg.solve(matrix, one[p] - a)
        if u > 0 and v > 0 and u + v < 1 and 0 < t < 1:
            return True
    return False


@pytest.mark.slow
@given(seed=st.integers(0, 2**32 - 1), size=st.floats(0.1, 3))
def test_crossing_triangles_are_counted_as_by_brute_force(seed: int, size: float) -> None:
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0, 1, (18, 1, 3)) + size * rng.uniform(-0.5, 0.5, (18, 3, 3))
    expected = sum(
        crossing_segments(corners[i], corners[j]) or crossing_segments(corners[j], corners[i])
        for i in range(18)
        for j in range(i)
    )
    vertices, faces = corners.reshape(-1, 3), np.arange(54).reshape(-1, 3)
    assert count_self_intersections(vertices, faces) == expected
    by_numpy, by_kernel = (
        intersecting_pairs_reference(vertices, faces),
        intersecting_pairs(Surface(vertices=vertices, faces=faces)),
    )
    assert sorted(np.sort(by_numpy, axis=1).tolist()) == by_kernel.tolist()


@pytest.mark.slow
def test_there_is_room_for_many_pairs_on_any_number_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    sphere = trimesh.creation.icosphere(subdivisions=3)
    both = joined(sphere, moved(sphere, 0.5, 0.2, 0.1))
    surface = Surface(vertices=np.asarray(both.vertices), faces=np.asarray(both.faces))
    whole = intersecting_pairs(surface, threads=1)
    assert len(whole) > 50
    monkeypatch.setattr("infill.meshes.intersections.ROOM", 5)
    for threads in (1, 2, 3):
        np.testing.assert_array_equal(intersecting_pairs(surface, threads=threads), whole)


def test_a_surface_of_ours_passes(rng: np.random.Generator) -> None:
    assert check(isosurface(np.sign(rng.uniform(-1, 1, (9, 9, 9))))).printable


@pytest.mark.parametrize(
    "name",
    ["empty_0bytes.stl", "empty_binary.stl", "unparseable.stl", "invalid_vertex.stl"],
)
def test_files_that_cannot_be_read(name: str, data: Path) -> None:
    with pytest.raises(FormatError, match=name):
        check(data / "nasty" / name)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "printable"),
    [
        ("nasty/20mmbox_CR_line_ends.stl", True),
        ("nasty/zero_area_triangle.stl", True),
        ("nasty/unit_cube_1mm.stl", True),
        ("nasty/nonmanifold.stl", False),
        ("nasty/cubes_touching_edge.stl", False),
        ("nasty/triangle_soup.stl", False),
        ("nasty/huge_150m_inverted.stl", False),
        ("nasty/multibody_ascii.stl", False),
        ("nasty/frog_legs_open.obj", False),
        ("nasty/prusa_extruder-cover_nonmanifold.stl", False),
        ("printable/bracket_medium.stl", True),
        ("printable/letter_A.obj", True),
        ("printable/spur_gear.stl", True),
        ("printable/voron_door_hinge_x6.stl", True),
        ("models/bunny_7k.off", True),
        ("models/bunny_holes_69k.obj", False),
        ("models/pig_open.stl", False),
    ],
)
def test_real_files(name: str, printable: bool, data: Path) -> None:
    assert check(data / name).printable is printable


@pytest.mark.slow
def test_metres_are_noticed(data: Path) -> None:
    found = check(data / "nasty" / "metres_part_47um.stl")
    assert found.unit_guess == "m"
    assert math.isclose(max(found.extents), 0.047, rel_tol=0.02)


@pytest.mark.parametrize("suffix", [".gcode", ".GCODE", ".bgcode"])
def test_a_sliced_print_is_no_mesh(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_bytes(b"G1 X1 E1\n")
    with pytest.raises(FormatError, match="is a sliced print, not a mesh; infill motion tells"):
        check(path)
