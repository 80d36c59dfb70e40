"""Voids without a way out: counted, whatever else lies in them, touches them or is inside out."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from test_command_line import run

from infill import Surface, check, save
from infill.meshes.sealed_voids import count_sealed_voids

pytestmark = pytest.mark.usefixtures("silent_compiler")


def box(size: float, at: tuple[float, float, float] = (0, 0, 0)) -> trimesh.Trimesh:
    return trimesh.creation.box((size, size, size)).apply_translation(at)


def ball(radius: float, at: tuple[float, float, float] = (0, 0, 0), fine: int = 2) -> trimesh.Trimesh:
    return trimesh.creation.icosphere(fine, radius).apply_translation(at)


def turned(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces[:, ::-1], process=False)


def together(*meshes: trimesh.Trimesh) -> Surface:
    starts = np.cumsum([0, *(len(each.vertices) for each in meshes)])
    return Surface(
        vertices=np.concatenate([each.vertices for each in meshes]),
        faces=np.concatenate([each.faces + start for each, start in zip(meshes, starts, strict=False)]),
    )


def merged(surface: Surface) -> Surface:
    points, index = np.unique(surface.vertices, axis=0, return_inverse=True)
    return Surface(vertices=points, faces=index.reshape(-1)[surface.faces])


NINE = [turned(ball(3, (x, y, 0))) for x in (-10, 0, 10) for y in (-10, 0, 10)]
CUBE = box(10)
PYRAMID = trimesh.convex.convex_hull([[0, 0, 5], [1, 0, 2], [-1, 1, 2], [-1, -1, 2]])  # its tip touches the cube
WEDGE = trimesh.convex.convex_hull([[5, -5, -5], [5, -5, 5], [4, -4, -3], [4, -4, 3], [3, 0, 0]])
CASES = {
    "a solid": ((CUBE,), 0),
    "two solids": ((CUBE, box(5, (20, 0, 0))), 0),
    "nine voids": ((box(40), *NINE), 9),
    "a shell": ((ball(10), turned(ball(8))), 1),
    "solid in void in solid": ((box(40), turned(box(30)), box(20)), 1),
    "void in solid in void in solid": ((box(40), turned(box(30)), box(20), turned(box(10))), 2),
    "two solids in one void": ((box(40), turned(box(30)), box(5, (8, 0, 0)), box(5, (-8, 0, 0))), 1),
    "a void in each of two": ((box(10), turned(box(5)), box(10, (20, 0, 0)), turned(box(5, (20, 0, 0)))), 2),
    "solid within solid": ((box(40), box(20)), 0),
    "solid within solid, and a void that both surround": ((box(40), box(30), turned(box(10))), 0),
    "a void of one that another solid fills": ((box(40), turned(box(20)), box(30)), 0),
    "a shell that faces inwards alone": ((box(40), turned(box(10, (60, 0, 0)))), 0),
    "one that faces inwards in a void": ((box(40), turned(box(30)), turned(box(10))), 1),
    "all inside out": ((turned(box(40)), *(turned(each) for each in NINE)), 9),
    "all inside out, solid in void": ((turned(box(40)), box(30), turned(box(20))), 1),
    "a void beside a tunnel": ((trimesh.creation.annulus(5, 20, 40), turned(ball(3, (12, 0, 0)))), 1),
    "nothing but a tunnel": ((trimesh.creation.annulus(5, 20, 40),), 0),
    "overlapping solids, a void in one of them": ((box(20), turned(box(4, (-7, 0, 0))), box(20, (15, 0, 0))), 1),
    "overlapping solids, a void where both are": ((box(20), turned(box(2, (7, 0, 0))), box(20, (15, 0, 0))), 0),
    "a void that touches the outside in a point": ((CUBE, turned(PYRAMID)), 1),
    "two voids that touch in a point": ((box(40), turned(box(5, (2.5, 2.5, 2.5))), turned(box(5, (-2.5, -2.5, -2.5)))), 2),
    "two voids that touch along an edge": ((box(40), turned(box(5, (2.5, 2.5, 0))), turned(box(5, (-2.5, -2.5, 0)))), 2),
    "two solids that touch along an edge": ((box(10, (5, 5, 0)), box(10, (-5, -5, 0)), turned(box(2, (5, 5, 0)))), 1),
    "a void thinner than its walls": ((box(40), turned(trimesh.creation.box((30, 30, 1e-3)))), 1),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_voids_are_counted(name: str) -> None:
    """Also with vertices merged where shells touch in a point, and with all of it in another place."""
    meshes, expected = CASES[name]
    surface = together(*meshes)
    assert count_sealed_voids(surface) == expected
    if merged(surface).closed:  # not where four faces share an edge
        assert count_sealed_voids(merged(surface)) == expected
    turn = trimesh.transformations.rotation_matrix(1.0, (1, 2, 3), (40, 5, 6))
    assert count_sealed_voids(together(*(each.copy().apply_transform(turn) for each in meshes))) == expected


@given(
    st.lists(st.tuples(*3 * [st.integers(-3, 3)]), min_size=0, max_size=12, unique=True),
    st.lists(st.integers(0, 11), max_size=6),
    st.booleans(),
)
@settings(max_examples=12, deadline=None)
def test_any_voids_in_a_block(places: list[tuple[int, int, int]], filled: list[int], whole: bool) -> None:
    """Balls on a lattice: some hold a solid, which changes nothing; turning all of it neither."""
    meshes = [box(100), *(turned(ball(4, tuple(10.0 * k for k in each), 1)) for each in places)]
    meshes += [ball(2, tuple(10.0 * k for k in places[number]), 1) for number in set(filled) if number < len(places)]
    assert count_sealed_voids(together(*(turned(each) if whole else each for each in meshes))) == len(places)


@pytest.mark.longest
def test_check_says_so(tmp_path: Path) -> None:
    path = save(together(*CASES["nine voids"][0]), tmp_path / "a.stl")
    found = check(path)
    assert found.printable
    assert found.sealed_voids == 9
    assert found.components == 10
    assert found.warnings == ("9 sealed cavities, in which resin and powder stay",)
    result = run("check", str(path))
    assert result.exit_code == 0
    assert "1 part with 9 sealed cavities" in result.stdout
    assert json.loads(run("check", str(path), "--json").stdout)["sealed_voids"] == 9
    assert run("check", str(path), "--strict").exit_code == 1
    both = run("check", str(path), str(save(CUBE, tmp_path / "b.stl")))
    assert "9 sealed cavities, in which resin and powder stay" in both.stdout
    assert both.stdout.count("sealed") == 1


def test_an_open_mesh_has_no_voids_that_can_be_counted(tmp_path: Path) -> None:
    surface = together(*CASES["nine voids"][0])
    path = save(Surface(vertices=surface.vertices, faces=surface.faces[1:]), tmp_path / "a.stl")
    assert check(path).sealed_voids is None
    assert "sealed cavities unknown: the mesh is not watertight" in run("check", str(path)).stdout
    assert not any("sealed" in each for each in check(path).warnings)


@pytest.mark.slow
def test_smooth_says_so(tmp_path: Path) -> None:
    for name, mesh, voids in (("shell", together(ball(10), turned(ball(6))), 1), ("ball", together(ball(10)), 0)):
        path = save(mesh, tmp_path / f"{name}.stl")
        result = run("smooth", str(path), "--resolution", "12", "-o", str(tmp_path / f"{name}_smooth.stl"))
        assert result.exit_code == 0, result.stderr
        assert result.stderr.count(f"{voids}, in which resin and powder stay") == voids
        assert check(tmp_path / f"{name}_smooth.stl").sealed_voids == voids
