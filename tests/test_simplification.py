"""Fewer triangles: the mesh stays closed and connected as it was, keeps its volume, and stays within the tolerance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapes import assert_printable
from skimage.measure import marching_cubes

from infill.errors import GeometryError, ParameterError
from infill.kernels import quadrics
from infill.meshes import edge_collapse as collapsing
from infill.meshes.distance import LEAF, TriangleTree, nearest_on_triangles
from infill.meshes.edge_collapse import CornerTable, collapse_edges
from infill.meshes.hausdorff_samples import CLEAR, SURE, aligned_faces, match_faces, sample_between_vertices
from infill.meshes.intersections import count_self_intersections
from infill.meshes.project_back import project_back
from infill.meshes.simplification import simplify_surface
from infill.surface import Surface

DRIFT = 0.05  # of the tolerance: how far the surface may have moved outwards or inwards on average
PER_TRIANGLE = 25  # places at which a triangle's distance is measured


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def isosurface(field: NDArray[np.floating]) -> Surface:
    """The surface at 0 of a field that is negative inside, with small and slender triangles, as scans have them."""
    vertices, faces, _, _ = marching_cubes(np.pad(field, 1, constant_values=1.0), 0.0)
    return surface_of(trimesh.Trimesh(vertices, faces, process=True))


def grid(cells: int) -> NDArray[np.float64]:
    return np.stack(np.meshgrid(*[np.linspace(-1, 1, cells)] * 3, indexing="ij"))


def made(name: str, cells: int = 40) -> Surface:
    """Return a shape with flat, round, sharp or thin places, of about `cells` triangles across."""
    x, y, z = grid(cells)
    shapes = {
        "ball": lambda: x * x + y * y + z * z - 0.6,
        "torus": lambda: (np.hypot(x, y) - 0.6) ** 2 + z * z - 0.06,
        "box with a hole": lambda: np.maximum(
            np.maximum(np.maximum(abs(x), abs(y)), abs(z)) - 0.71, 0.33 - np.hypot(x, z)
        ),
        "gyroid": lambda: np.sin(4 * x) * np.cos(4 * y) + np.sin(4 * y) * np.cos(4 * z) + np.sin(4 * z) * np.cos(4 * x),
        "shell": lambda: abs(np.sqrt(x * x + y * y + z * z) - 0.7) - 0.12,
        "two balls": lambda: np.minimum(np.hypot(np.hypot(x - 0.45, y), z), np.hypot(np.hypot(x + 0.45, y), z)) - 0.4,
        "plate": lambda: np.maximum(np.maximum(abs(x), abs(y)) - 0.8, abs(z) - 0.083),
        "noise": lambda: np.cos(9 * x + 2 * np.sin(7 * y)) + np.cos(8 * y - z) + np.cos(7 * z + x) - 0.4,
    }
    return isosurface(shapes[name]())


SHAPES = ["ball", "torus", "box with a hole", "gyroid", "shell", "two balls", "plate", "noise"]


def spread_at_random(surface: Surface, count: int, seed: int) -> NDArray[np.float64]:
    """Points all over a surface, by shares that are drawn: not the places that the code under test looks at."""
    shares = np.random.default_rng(seed).dirichlet([1, 1, 1], (len(surface.faces), count))
    corners = np.asarray(surface.vertices)[surface.faces]
    return np.concatenate([np.einsum("fpk,fkc->fpc", shares, corners).reshape(-1, 3), np.asarray(surface.vertices)])


def farthest(one: Surface, other: Surface, count: int = PER_TRIANGLE) -> float:
    """The largest distance of one surface from the other, at places that are drawn."""
    return float(TriangleTree.of(other).nearest(spread_at_random(one, count, 1))[0].max())


def components(surface: Surface) -> int:
    return len(trimesh.Trimesh(surface.vertices, surface.faces, process=False).split(only_watertight=False))


@pytest.mark.long
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("tolerance", [0.02, 0.1, 0.4])
def test_a_simplified_surface_is_closed_near_and_as_connected_and_large_as_before(shape: str, tolerance: float) -> None:
    surface = made(shape, 24)
    found = simplify_surface(surface, tolerance=tolerance)
    assert len(found.faces) < len(surface.faces)
    assert found.closed
    assert found.euler_number == surface.euler_number
    assert components(found) == components(surface)
    assert abs(found.volume - surface.volume) <= DRIFT * tolerance * surface.area
    assert count_self_intersections(np.asarray(found.vertices), found.faces) == 0
    assert farthest(found, surface) <= tolerance
    assert farthest(surface, found, 3) <= tolerance
    assert_printable(trimesh.Trimesh(found.vertices, found.faces, process=False))


@pytest.mark.longest
@settings(max_examples=12)
@given(
    waves=st.tuples(*[st.floats(3, 9)] * 3),
    phases=st.tuples(*[st.floats(0, 6)] * 3),
    level=st.floats(-0.6, 0.6),
    tolerance=st.floats(0.03, 0.5),
    unit=st.sampled_from([1e-3, 1.0, 25.4]),
)
def test_the_laws_hold_for_any_solid_tolerance_and_unit(
    waves: tuple[float, ...], phases: tuple[float, ...], level: float, tolerance: float, unit: float
) -> None:
    x, y, z = (w * axis + p for w, p, axis in zip(waves, phases, grid(18), strict=True))
    surface = isosurface(np.cos(x) + np.cos(y + np.sin(z)) + np.cos(z) - level)
    surface = Surface(vertices=surface.vertices * unit + 100 * unit, faces=surface.faces)
    found = simplify_surface(surface, tolerance=tolerance * unit)
    assert found.closed
    assert found.euler_number == surface.euler_number
    assert abs(found.volume - surface.volume) <= DRIFT * tolerance * unit * surface.area
    assert farthest(found, surface) <= tolerance * unit
    assert farthest(surface, found, 3) <= tolerance * unit


def test_flat_faces_become_as_few_triangles_as_they_need() -> None:
    box = trimesh.creation.box((3, 2, 1)).subdivide().subdivide().subdivide()
    surface = surface_of(box)
    assert len(surface.faces) == 768
    found = simplify_surface(surface, tolerance=1e-4)
    assert len(found.faces) == 12
    assert found.volume == pytest.approx(6, rel=1e-12)
    np.testing.assert_allclose(found.bounds, [[-1.5, -1, -0.5], [1.5, 1, 0.5]], atol=1e-4)


@pytest.mark.slow
def test_ten_times_fewer_triangles_on_a_smooth_ring() -> None:
    surface = made("torus", 80)
    found = simplify_surface(surface, tolerance=0.1)
    assert len(found.faces) * 10 <= len(surface.faces)


@pytest.mark.longest
def test_the_number_of_triangles_asked_for_is_kept() -> None:
    surface = made("gyroid", 24)
    for count in (2000, 501):
        found = simplify_surface(surface, triangles=count)
        assert count - 2 < len(found.faces) <= count
        assert found.closed
        assert found.euler_number == surface.euler_number
        assert found.volume == pytest.approx(surface.volume, rel=1e-3)
    both = simplify_surface(surface, triangles=len(simplify_surface(surface, tolerance=0.3).faces) + 20, tolerance=0.3)
    assert farthest(both, surface) <= 0.3
    with pytest.raises(GeometryError, match=r"only to [\d,]+; allow more"):
        simplify_surface(surface, triangles=4)
    with pytest.raises(GeometryError, match=r"at most 100 triangles and 0\.01 mm of leeway, only to"):
        simplify_surface(surface, triangles=100, tolerance=0.01)


@pytest.mark.parametrize("wrong", [{"tolerance": 0.0}, {"tolerance": math.nan}, {"triangles": 3}])
def test_what_makes_no_sense_is_an_error(wrong: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=r"tolerance is|triangles is"):
        simplify_surface(made("ball", 12), **wrong)  # type: ignore[arg-type]


def test_a_spike_higher_than_the_tolerance_stays() -> None:
    ball = trimesh.creation.icosphere(4, 10)
    vertices = np.array(ball.vertices)
    top = int(vertices[:, 2].argmax())
    vertices[top] *= 1.08
    surface = Surface(vertices=vertices, faces=np.asarray(ball.faces))
    found = simplify_surface(surface, tolerance=0.2)
    assert np.linalg.norm(np.asarray(found.vertices) - vertices[top], axis=1).min() <= 0.2
    assert len(found.faces) < len(surface.faces) / 2


def test_solids_that_touch_at_a_vertex_still_do() -> None:
    box = trimesh.creation.box((1, 1, 1)).subdivide().subdivide()
    one, other = np.array(box.vertices), np.array(box.vertices) + 1.0
    both = trimesh.Trimesh(np.concatenate([one, other]), np.concatenate([box.faces, box.faces + len(one)]))
    surface = surface_of(both)  # merged where they touch
    assert len(surface.vertices) == 2 * len(one) - 1
    table = CornerTable.of(surface)
    assert table is not None
    assert table.fixed.sum() == 2
    found = simplify_surface(surface, tolerance=1e-3)
    assert found.closed
    assert found.volume == pytest.approx(2)
    assert len(found.faces) < 40
    assert (np.abs(np.asarray(found.vertices) - 0.5).max(axis=1) < 1e-9).sum() == 1


def test_what_is_not_closed_or_shares_an_edge_four_times_is_refused() -> None:
    box = surface_of(trimesh.creation.box((1, 1, 1)))
    for faces in (box.faces[1:], np.concatenate([box.faces, box.faces[:1, ::-1], box.faces[:1]])):
        broken = Surface(vertices=box.vertices, faces=faces)
        assert collapse_edges(broken, tolerance=0.1) is None
        with pytest.raises(GeometryError, match="not every edge is shared by exactly two triangles"):
            simplify_surface(broken, tolerance=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("far", [0.3, -0.3])
def test_a_surface_that_strays_is_bent_back(far: float) -> None:
    ball = trimesh.creation.icosphere(4, 10)
    surface = surface_of(ball)
    coarse = surface_of(trimesh.creation.icosphere(3, 10))
    strayed = np.array(coarse.vertices)
    strayed[::37] *= 1 + far / 10
    found = Surface(vertices=strayed, faces=coarse.faces)
    assert farthest(found, surface) > 0.25
    back, left, _ = project_back(found, surface, TriangleTree.of(surface), 0.15)
    assert not len(left)
    assert back.closed
    assert farthest(back, surface) <= 0.16
    assert farthest(surface, back, 3) <= 0.16


@pytest.mark.longest
@pytest.mark.parametrize("threads", [1, 3])
def test_places_lie_on_their_faces_and_tell_how_far_those_are(threads: int) -> None:
    surface, other = made("noise", 20), made("gyroid", 20)
    tree, far = TriangleTree.of(other), 3.0
    away, owner = tree.nearest(np.asarray(surface.vertices), enough=far)
    found = sample_between_vertices(tree, surface, owner, away, 0.5, far, threads=threads)
    corners, others = (np.asarray(each.vertices)[each.faces] for each in (surface, other))
    on_face = trimesh.triangles.closest_point(corners[found.face], found.points) - found.points
    np.testing.assert_allclose(on_face, 0, atol=1e-9)
    off = np.linalg.norm(trimesh.triangles.closest_point(others[found.owner], found.points) - found.points, axis=1)
    np.testing.assert_allclose(off, found.away, atol=1e-9)
    exact = tree.nearest(found.points)[0]
    assert (found.away >= exact - 1e-9).all()
    further = found.away > SURE * far
    assert further.any()
    np.testing.assert_allclose(found.away[further], exact[further], atol=1e-9)
    # Where no place was looked at, nothing is further away than the tolerance, or than places nearby.
    drawn = spread_at_random(surface, 5, 3)
    beyond = drawn[tree.nearest(drawn)[0] > far]
    assert len(beyond)
    looked = np.concatenate([np.asarray(surface.vertices), found.points])
    assert np.linalg.norm(beyond[:, None] - looked[None], axis=2).min(axis=1).max() <= 0.5


def test_a_piece_whose_corners_are_near_one_face_is_left_out() -> None:
    flat = Surface(vertices=np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0]]), faces=np.array([[0, 1, 2]]))
    above = Surface(vertices=np.array([[1.0, 1, 0.5], [4, 1, 0.5], [1, 4, 0.5]]), faces=np.array([[0, 1, 2]]))
    away, owner = TriangleTree.of(flat).nearest(above.vertices)
    assert len(sample_between_vertices(TriangleTree.of(flat), above, owner, away, 0.5, 0.6).points) == 0
    assert len(sample_between_vertices(TriangleTree.of(flat), above, owner, away, 0.5, 0.4).points) > 20


@pytest.mark.parametrize("slope", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("at", [-0.8, 0.0, 0.35])
def test_a_piece_that_two_faces_share_is_left_out_where_both_are_near(slope: float, at: float) -> None:
    """A face lies below a ridge: it needs a place of its own only where the ridge is too far above it."""
    ends = np.array([[at - 9, -9, -9 * slope], [at - 9, 9, -9 * slope], [at, -9, 0], [at, 9, 0]])
    ends = np.concatenate([ends, np.array([[at + 9, -9, -9 * slope], [at + 9, 9, -9 * slope]])])
    roof = Surface(vertices=ends, faces=np.array([[0, 2, 1], [2, 3, 1], [2, 4, 3], [4, 5, 3]]))
    corners = np.array([[-1.0, -1, 0], [-1, 1, 0], [1, 0, 0]])
    corners[:, 2] = -slope * abs(corners[:, 0] - at)
    below, tree = Surface(vertices=corners, faces=np.array([[0, 1, 2]])), TriangleTree.of(roof)
    exact = tree.nearest(spread_at_random(below, 4000, 7))[0].max()
    away, owner = tree.nearest(corners)
    near, far = (
        sample_between_vertices(tree, below, owner, away, 0.01, share * exact, all_places=False).points
        for share in (1.02, 0.9)
    )
    assert len(near) == 0
    assert len(far) > 0
    assert len(sample_between_vertices(tree, below, owner, away, 0.01, 1.2 * exact).points) <= 12


def test_some_faces_are_level_as_all_are() -> None:
    surface = made("box with a hole", 16)
    every = aligned_faces(surface, 0.1)
    some = np.array([5, 3, len(every) - 1, 3])
    np.testing.assert_array_equal(aligned_faces(surface, 0.1, faces=some), every[some])


def test_faces_that_two_surfaces_share_are_known_whatever_their_order() -> None:
    surface, rng = made("torus", 24), np.random.default_rng(4)
    order = rng.permutation(len(surface.vertices))
    rank = np.argsort(order)
    chosen = rng.permutation(len(surface.faces))[: len(surface.faces) // 2]
    turned = np.roll(rank[surface.faces[chosen]], 1, axis=1)
    moved = np.array(surface.vertices)[order]
    moved[turned[0, 0]] += 1e-9
    other = Surface(vertices=moved, faces=turned)
    gone = (turned == turned[0, 0]).any(axis=1)
    np.testing.assert_array_equal(match_faces(other, surface), np.where(gone, -1, chosen))


@pytest.mark.slow
def test_what_was_measured_is_handed_to_a_surface_that_differs_in_a_place() -> None:
    surface = made("gyroid", 24)
    first = collapse_edges(surface, tolerance=0.1)
    assert first is not None
    back, _, seen = project_back(first, surface, TriangleTree.of(surface), 0.1)
    strayed = np.array(back.vertices)
    strayed[7] += 0.5
    found = replace(back, vertices=strayed)
    handed = seen.transfer_to(found, surface, 1.0, 0.1)
    exact = TriangleTree.of(found).nearest(handed.points)[0]
    np.testing.assert_array_equal(handed.away > 0.1, exact > 0.1)
    np.testing.assert_array_equal(handed.unsure, np.flatnonzero((found.faces == 7).any(axis=1)))
    again, left, _ = project_back(found, surface, TriangleTree.of(surface), 0.1, known=seen)
    assert not len(left)
    assert max(farthest(again, surface), farthest(surface, again, 3)) <= 0.11


@pytest.mark.longest
@pytest.mark.parametrize("shape", ["ball", "plate", "gyroid", "box with a hole"])
@pytest.mark.parametrize("tolerance", [0.05, 0.3, 1.0])
def test_a_level_face_has_nothing_near_that_faces_elsewhere(shape: str, tolerance: float) -> None:
    """By points all over the faces, against every pair of faces whose normals differ by more than 30 degrees."""
    found = collapse_edges(made(shape, 16), tolerance=0.1)
    assert found is not None
    level = aligned_faces(found, tolerance)
    corners = np.asarray(found.vertices)[found.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    own = spread_at_random(found, 20, 3)[: 20 * len(corners)].reshape(len(corners), 20, 3)
    for face in np.flatnonzero(level):
        aslant = normals @ normals[face] < np.cos(np.radians(30.1))
        if aslant.any():
            others = Surface(vertices=found.vertices, faces=found.faces[aslant])
            assert TriangleTree.of(others).nearest(own[face])[0].min() >= CLEAR * tolerance
    assert level.any() or shape in ("plate", "box with a hole") or tolerance == 1.0
    if shape == "plate" and tolerance == 1.0:  # its other side is two cells away
        assert not level.any()


@pytest.mark.slow
def test_a_vertex_that_strayed_where_all_is_level_is_brought_back() -> None:
    surface, tolerance = made("ball", 40), 0.1
    first = collapse_edges(surface, tolerance=tolerance)
    assert first is not None
    strayed = np.array(first.vertices)
    strayed[70] += 3 * tolerance * (strayed[70] - first.bounds.mean(axis=0)) / 20
    found = replace(first, vertices=strayed)
    assert aligned_faces(found, tolerance)[(found.faces == 70).any(axis=1)].all()  # nothing but its distance tells
    assert farthest(found, surface) > 2 * tolerance
    again, left, _ = project_back(found, surface, TriangleTree.of(surface), tolerance)
    assert not len(left)
    assert max(farthest(again, surface), farthest(surface, again, 3)) <= 1.01 * tolerance


@pytest.mark.long
@pytest.mark.parametrize("shape", SHAPES)
def test_patches_keep_the_laws_and_do_not_depend_on_threads(shape: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(collapsing, "PATCH", 100)
    surface, tolerance = made(shape, 24), 0.1
    table = CornerTable.of(surface)
    assert table is not None
    assert len(surface.faces) > 10 * collapsing.PATCH
    one = table.without_edges((0.2 * tolerance) ** 2, 4, threads=1)
    two = table.without_edges((0.2 * tolerance) ** 2, 4, threads=2)
    assert len(one.start) < len(table.start)
    np.testing.assert_array_equal(one.vertices, two.vertices)
    np.testing.assert_array_equal(one.start, two.start)
    np.testing.assert_array_equal(one.into, two.into)
    np.testing.assert_array_equal(one.start[one.twin], np.roll(one.start.reshape(-1, 3), -1, axis=1).ravel())
    found = one.to_surface(surface)
    assert found.closed
    assert found.euler_number == surface.euler_number
    assert components(found) == components(surface)
    assert abs(found.volume - surface.volume) <= DRIFT * tolerance * surface.area
    whole = simplify_surface(surface, tolerance=tolerance)
    assert max(farthest(whole, surface), farthest(surface, whole, 3)) <= tolerance


@pytest.mark.slow
def test_the_nearest_triangle_is_found_whatever_came_before_and_any_that_is_near_enough() -> None:
    surface = made("noise", 16)
    points = np.random.default_rng(3).uniform(-2, 18, (500, 3))
    tree = TriangleTree.of(surface)
    away, face = tree.nearest(points)
    everywhere = np.repeat(np.asarray(surface.vertices)[surface.faces][None], 40, axis=0).reshape(-1, 3, 3)
    each = np.repeat(points[:40], len(surface.faces), axis=0)
    exact = np.linalg.norm(trimesh.triangles.closest_point(everywhere, each) - each, axis=1)
    np.testing.assert_allclose(away[:40], exact.reshape(40, -1).min(axis=1), atol=1e-9)
    np.testing.assert_allclose(tree.nearest(points[::-1])[0][::-1], away, atol=1e-12)
    corners = np.asarray(surface.vertices)[surface.faces[face]]
    np.testing.assert_allclose(
        np.linalg.norm(trimesh.triangles.closest_point(corners, points) - points, axis=1), away, atol=1e-9
    )
    near = tree.nearest(points, enough=1.0)[0]
    assert (near >= away - 1e-12).all()
    np.testing.assert_array_equal(near <= 1.0, away <= 1.0)
    np.testing.assert_allclose(near[near > 1.0], away[near > 1.0], atol=1e-12)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 8, 9, 16, 17, 31])
def test_boxes_of_a_tree_hold_what_is_below_them(count: int) -> None:
    vertices = np.random.default_rng(count).uniform(-3, 3, (count, 3, 3))
    tree = TriangleTree.of(Surface(vertices=vertices.reshape(-1, 3), faces=np.arange(3 * count).reshape(-1, 3)))
    np.testing.assert_array_equal(tree.corners, vertices[tree.order])
    np.testing.assert_array_equal(np.sort(tree.order), np.arange(count))
    leaves = (len(tree.low) + 1) // 2
    for box in range(len(tree.low)):
        first, held = box, 1
        while first < leaves - 1:
            first, held = 2 * first + 1, 2 * held
        below = tree.corners[LEAF * (first - leaves + 1) :][: LEAF * held].reshape(-1, 3)
        np.testing.assert_array_equal(tree.low[box], below.min(axis=0, initial=np.inf))
        np.testing.assert_array_equal(tree.high[box], below.max(axis=0, initial=-np.inf))


def test_a_quadric_is_the_sum_of_squared_distances_and_is_least_where_the_planes_meet() -> None:
    """The compiled form against the formula: areas in thirds, times squared distances from the planes of the faces."""
    surface = surface_of(trimesh.creation.box((3, 2, 1)))
    vertices, corners = np.asarray(surface.vertices), np.asarray(surface.vertices)[surface.faces]
    quadric = np.zeros((len(vertices), 11))
    quadrics.add_planes(vertices, surface.faces.astype(np.int32).ravel(), quadric)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1) / 2
    normals /= 2 * areas[:, None]
    points = np.random.default_rng(5).uniform(-2, 2, (20, 3))
    for vertex in range(len(vertices)):
        around = (surface.faces == vertex).any(axis=1)
        heights = ((points[:, None] - corners[None, around, 0]) * normals[around]).sum(axis=2)
        expected = (areas[around] / 3 * heights**2).sum(axis=1)
        found = [quadrics.evaluate_quadric(quadric[vertex], *point) for point in points]
        np.testing.assert_allclose(found, expected, atol=1e-12)
        assert quadric[vertex, 10] == pytest.approx(areas[around].sum() / 3)
    one, other = surface.faces[0, :2]
    total, place = np.empty(11), np.empty(3)
    least = quadrics.best_place(vertices[one], vertices[other], quadric[one], quadric[other], total, place)
    around_both = [quadrics.evaluate_quadric(total, *(place + shift)) for shift in 0.1 * np.eye(3)]
    assert all(least <= value + 1e-12 for value in around_both)


@given(st.integers(0, 2**32 - 1))
def test_nearest_places_on_triangles_are_those_of_trimesh(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners, points = rng.normal(size=(20, 3, 3)), 2 * rng.normal(size=(20, 3))
    corners[0, 2], corners[1] = corners[0, 1], corners[1, :1]  # a line, and a point
    places = nearest_on_triangles(corners, points)
    expected = trimesh.triangles.closest_point(corners, points)
    np.testing.assert_allclose(places[2:], expected[2:], atol=1e-9)
    along = corners[0, 0] + np.linspace(0, 1, 2001)[:, None] * (corners[0, 1] - corners[0, 0])
    assert np.linalg.norm(places[0] - points[0]) <= np.linalg.norm(along - points[0], axis=1).min() + 1e-9
    np.testing.assert_allclose(places[1], corners[1, 0], atol=1e-12)
