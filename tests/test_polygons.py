"""Polygons in triangles: each covered once, every edge kept, so that what was closed stays closed."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from polygon_meshes import KEYHOLE, SOLIDS, Solid, prism

from infill import Surface
from infill.meshes.polygons import split_fan, split_polygons, split_strips


def split(solid: Solid) -> Surface:
    corners = np.concatenate([np.array(each) for each in solid.polygons])
    counts = np.array([len(each) for each in solid.polygons])
    return Surface(vertices=solid.vertices, faces=split_polygons(solid.vertices, corners, counts))


@pytest.mark.parametrize("name", SOLIDS)
def test_polygons_are_covered_once(name: str) -> None:
    solid, surface = SOLIDS[name], split(SOLIDS[name])
    assert len(surface.faces) == solid.triangles
    assert surface.closed
    # Sums of a few dozen products in double precision.
    assert surface.volume == pytest.approx(solid.volume, rel=1e-12)
    assert surface.area == pytest.approx(solid.area, rel=1e-12)


def test_no_triangle_is_flat_if_none_need_be() -> None:
    """Corners on straight sides: a fan from the first would have triangles without an area."""
    for name, solid in SOLIDS.items():
        if name.startswith("corners"):
            assert trimesh.Trimesh(solid.vertices, split(solid).faces, process=False).area_faces.min() > 1


def test_a_ring_around_a_hole_that_it_reaches_by_a_bridge() -> None:
    """As programs write faces with holes: the two banks of the bridge are one edge, run along in both directions."""
    ring = np.array(KEYHOLE, dtype=float)
    vertices = np.column_stack([ring, np.zeros(len(ring))])
    faces = split_polygons(vertices, np.arange(len(ring)), np.array([len(ring)]))
    assert Surface(vertices=vertices, faces=faces).area == pytest.approx(900 - 100, rel=1e-12)


def test_the_comparison_can_fail() -> None:
    """A fan from the tip of a tooth leaves the comb."""
    solid = SOLIDS["comb from 1"]
    fans = np.concatenate([split_fan(np.array(each)) for each in solid.polygons])
    assert Surface(vertices=solid.vertices, faces=fans).area > 1.1 * solid.area


@pytest.mark.slow
@given(
    radii=st.lists(st.floats(0.2, 5), min_size=4, max_size=40),
    turn=st.integers(0, 39),
    way=st.tuples(*3 * [st.floats(-1, 1)]).filter(lambda axis: np.linalg.norm(axis) > 0.1),
    bump=st.floats(0, 0.05),
)
@settings(max_examples=60, deadline=None)
def test_any_star_shaped_prism_in_any_pose(
    radii: list[float], turn: int, way: tuple[float, float, float], bump: float
) -> None:
    """Also where the caps are not quite flat: closed, and the flat ones covered once."""
    n = len(radii)
    angles = 2 * np.pi * np.arange(n) / n
    solid = prism(list(zip(radii * np.cos(angles), radii * np.sin(angles), strict=True)), 2, turn=turn % n)
    turned = trimesh.transformations.rotation_matrix(1.0, way)[:3, :3]
    surface = split(Solid(vertices=solid.vertices @ turned.T, polygons=solid.polygons, volume=0, area=0))
    assert surface.closed
    # Slivers of the noise of the rotation: 1e-16 times lengths of 10 along edges of 10, of each triangle.
    assert surface.area == pytest.approx(solid.area, rel=1e-9)
    assert surface.volume == pytest.approx(solid.volume, rel=1e-9)
    uneven = solid.vertices + bump * np.sin(17 * np.arange(2 * n))[:, None] * [0, 0, 1]
    assert split(Solid(vertices=uneven, polygons=solid.polygons, volume=0, area=0)).closed


@pytest.mark.parametrize(
    "ring",
    [
        [(0, 0, 0)] * 5,
        [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)],
        [(k, 2 * k, 0) for k in range(6)],
        [(0, 0, 0), (9, 9, 0), (9, 0, 0), (0, 9, 0), (5, 20, 0), (-3, 2, 0), (0, 0, 1)],
        [(1e200, 0, 0), (0, 1e200, 0), (0, 0, 1e200), (1e200, 1e200, 0), (3, 4, 5)],
    ],
)
def test_what_has_no_inside_still_keeps_its_edges(ring: list[tuple[float, float, float]]) -> None:
    vertices = np.array(ring, dtype=float)
    n = len(ring)
    faces = split_polygons(vertices, np.concatenate([np.arange(n), np.arange(n)[::-1]]), np.array([n, n]))
    sides = np.concatenate([faces[: n - 2, [i, (i + 1) % 3]] for i in range(3)])
    pairs = {tuple(each) for each in sides.tolist()}
    assert {(i, (i + 1) % n) for i in range(n)} <= pairs
    assert {(j, i) for i, j in pairs} == {each for each in pairs if each[::-1] in pairs} | {
        ((i + 1) % n, i) for i in range(n)
    }


TETRAHEDRON = np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]])


@pytest.mark.parametrize("turn", range(4))
def test_two_faces_of_a_tetrahedron_as_one_quadrilateral(turn: int) -> None:
    """It is not flat: one of its diagonals is an edge of the others, which must not have four faces."""
    polygons = [list(np.roll([0, 1, 3, 2], turn)), [1, 2, 3], [0, 2, 1]]
    surface = split(Solid(vertices=TETRAHEDRON, polygons=polygons, volume=0, area=0))
    assert surface.closed
    assert surface.volume == pytest.approx(9**3 / 6, rel=1e-12)


@pytest.mark.parametrize(("one", "other"), [(k, j) for k in range(4) for j in range(4)])
def test_two_quadrilaterals_around_a_vertex_of_two_edges(one: int, other: int) -> None:
    """They share three corners; cut off by both, the middle one would leave an edge with four faces."""
    vertices = np.array([[0.0, 0, 0], [4, 4, 1], [8, 0, 0], [4, -4, 0], [4, 0, 6]])
    polygons = [list(np.roll([0, 1, 2, 3], one)), list(np.roll([2, 1, 0, 4], other)), [0, 3, 4], [3, 2, 4]]
    surface = split(Solid(vertices=vertices, polygons=polygons, volume=0, area=0))
    assert surface.closed


def test_polygons_of_two_corners_are_left_out() -> None:
    corners, counts = np.array([0, 1, 0, 1, 2, 2]), np.array([2, 3, 1])
    assert split_polygons(np.eye(3), corners, counts).tolist() == [[0, 1, 2]]


def test_strips_as_the_reader_of_trimesh() -> None:
    rng = np.random.default_rng(0)
    strips = [rng.integers(0, 50, rng.integers(0, 12)) for _ in range(40)]
    found = split_strips(np.concatenate(strips), np.array([len(each) for each in strips]))
    expected = trimesh.util.triangle_strips_to_faces([each for each in strips if len(each) > 2])
    expected = expected[(expected != np.roll(expected, 1, axis=1)).all(axis=1)]
    turned = np.sort(found, axis=1), np.sort(expected, axis=1)
    assert np.array_equal(*turned)
    ways = [np.linalg.det(np.eye(3)[np.argsort(each)]) for faces in (found, expected) for each in faces]
    assert np.array_equal(ways[: len(found)], ways[len(found) :])
