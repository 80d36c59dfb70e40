"""Edges and components of a mesh: one count of faces along edges, one finder of what hangs together."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from infill import check
from infill.meshes.hole_filling import open_edges
from infill.meshes.shells import (
    select_faces,
    shell_volumes,
    split_into_batches,
    vertex_components,
    vertex_components_reference,
)
from infill.surface import Edges, Surface

faces_of = st.lists(st.tuples(*[st.integers(0, 9)] * 3), min_size=1, max_size=20).map(
    lambda faces: np.array(faces, dtype=np.int32)
)


def runs(faces: np.ndarray) -> Counter[tuple[int, int]]:
    """How often faces run from one vertex to another: written out, side by side."""
    return Counter((int(face[i]), int(face[(i + 1) % 3])) for face in faces for i in range(3))


def solid(*places: float) -> np.ndarray:
    """Faces of one cube for each place, each with vertices of its own."""
    box = trimesh.creation.box().faces
    return np.concatenate([box + 8 * n for n in range(len(places))])


@given(faces_of)
def test_faces_are_counted_along_every_edge_in_both_directions(faces: np.ndarray) -> None:
    found, expected = Edges.of(faces), runs(faces)
    sides = {(min(side), max(side)) for side in expected if side[0] != side[1]}
    assert [tuple(each) for each in found.ends.tolist()] == sorted(sides)
    for (i, j), ahead, back in zip(found.ends.tolist(), found.ahead, found.back, strict=True):
        assert (ahead, back) == (expected[i, j], expected[j, i])
    assert np.array_equal(found.faces, found.ahead + found.back)


@given(faces_of)
def test_closed_is_one_face_there_and_one_back(faces: np.ndarray) -> None:
    expected = all(
        count == 1 and start != end and runs(faces)[end, start] == 1 for (start, end), count in runs(faces).items()
    )
    surface = Surface(vertices=np.zeros((10, 3)), faces=faces)
    assert surface.closed == expected
    edges = Edges.of(faces)
    whole = not (faces == np.roll(faces, 1, axis=1)).any()
    assert surface.closed == (whole and bool((edges.ahead == 1).all() and (edges.back == 1).all()))


@given(faces_of)
def test_open_edges_are_what_is_run_along_too_often(faces: np.ndarray) -> None:
    expected = runs(faces)
    for (start, end), count in Counter(map(tuple, open_edges(faces).tolist())).items():
        assert count == expected[start, end] - expected[end, start]
    surplus = sum(max(0, n - expected[end, start]) for (start, end), n in expected.items() if start != end)
    assert len(open_edges(faces)) == surplus


def test_closed_surfaces_and_how_they_open() -> None:
    faces = solid(0, 0)
    here = np.zeros((16, 3))
    assert Surface(vertices=here, faces=faces).closed
    for broken in (
        faces[1:],
        faces[2:],
        np.concatenate([faces, faces[:2]]),
        np.concatenate([faces[:1, ::-1], faces[1:]]),
    ):
        assert not Surface(vertices=here, faces=broken).closed
    assert not Surface(vertices=here, faces=np.empty((0, 3), dtype=int)).closed


@given(faces_of, st.integers(0, 3))
def test_components_by_the_kernel_are_those_of_scipy(faces: np.ndarray, more: int) -> None:
    vertices = int(faces.max()) + 1 + more
    names, count = vertex_components_reference(faces, vertices)
    fast, same = vertex_components(faces, vertices)
    assert (count, names.dtype) == (same, fast.dtype)
    assert np.array_equal(names, fast)
    used = np.unique(faces)
    assert set(np.flatnonzero(names >= 0)) == set(used)
    firsts = [int(names[v]) for n, v in enumerate(used) if names[v] not in names[used[:n]]]
    assert firsts == list(range(count))  # numbered by their first vertices
    assert (names[faces] == names[faces[:, :1]]).all()


@pytest.mark.parametrize("label", [vertex_components, vertex_components_reference])
def test_two_cubes_are_two_components(label: Callable[..., tuple[np.ndarray, int]]) -> None:
    names, count = label(solid(0, 0), 16)
    assert count == 2
    assert names.tolist() == [0] * 8 + [1] * 8


def test_a_collapsed_triangle_of_its_own_is_no_component() -> None:
    """It is left out of the count, and so are its corners, although they come first."""
    box = trimesh.creation.box()
    vertices = np.concatenate([[[9.0, 9, 9], [8, 8, 8]], box.vertices])
    faces = np.concatenate([[[0, 1, 1]], box.faces + 2])
    found = check(trimesh.Trimesh(vertices, faces, process=False))
    assert (found.components, found.degenerate, found.closed) == (1, 1, True)


@pytest.mark.longest
def test_check_needs_no_compiler() -> None:
    import subprocess
    import sys

    code = "import sys, trimesh, infill; infill.check(trimesh.creation.box()); print('numba' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout.strip() == "False"


# --- what a library does too, and is kept for speed ------------------------------------------------------


@given(st.integers(0, 1000), st.integers(0, 9))
def test_a_stamp_is_what_a_filter_of_maxima_makes(seed: int, reach: int) -> None:
    from scipy.ndimage import maximum_filter1d

    from infill.voxels.stamping import dilate_along

    rng = np.random.default_rng(seed)
    marked = rng.random(rng.integers(1, 9, size=3)) < 0.2
    for axis in range(3):
        expected = maximum_filter1d(marked, 2 * reach + 1, axis=axis, mode="constant")
        assert np.array_equal(dilate_along(marked, axis, reach), expected)


def test_distances_from_triangles_are_those_of_trimesh(rng: np.random.Generator) -> None:
    from infill.kernels.distances import squared_distance

    corners, points = rng.normal(size=(4000, 3, 3)), 2 * rng.normal(size=(4000, 3))
    corners[:100, 2] = corners[:100, 1]  # and some without area
    nearest = trimesh.triangles.closest_point(corners[100:], points[100:])
    found = np.sqrt([squared_distance(*p, *abc) for p, abc in zip(points, corners, strict=True)])
    assert found[100:] == pytest.approx(np.linalg.norm(points[100:] - nearest, axis=1), abs=1e-12)
    along = np.linspace(0, 1, 20001)[:, None]
    for n in range(20):
        a, b = corners[n, :2]
        assert found[n] == pytest.approx(np.linalg.norm(a + along * (b - a) - points[n], axis=1).min(), abs=1e-4)


def several() -> Surface:
    """Return three balls, the last of them inside out, far from the origin."""
    balls = [trimesh.creation.icosphere(2, radius).apply_translation((1e3 + 9 * radius, 0, 5)) for radius in (1, 2, 3)]
    balls[2].invert()
    whole = trimesh.util.concatenate(balls)
    return Surface(vertices=whole.vertices, faces=whole.faces)


def test_the_volume_of_every_shell_is_that_of_its_mesh() -> None:
    surface = several()
    names, count = vertex_components(surface.faces, len(surface.vertices))
    each = surface.to_trimesh().split(only_watertight=False)
    np.testing.assert_allclose(shell_volumes(surface, names, count), [ball.volume for ball in each], rtol=1e-9)


def test_batches_hold_every_face_once_and_whole_shells() -> None:
    surface = several()
    batches = list(split_into_batches(surface, len(surface.faces) // 3 + 1))
    assert len(batches) > 1
    assert all(batch.closed for batch in batches)
    corners = np.concatenate([batch.vertices[batch.faces] for batch in batches])
    np.testing.assert_array_equal(corners, surface.vertices[surface.faces])
    assert list(split_into_batches(surface, len(surface.faces))) == [surface]


@given(st.lists(st.integers(1, 12), min_size=1, max_size=8), st.integers(1, 20))
def test_batches_are_as_large_as_asked_or_one_component(sizes: list[int], limit: int) -> None:
    fans = [
        [(begin, begin + n + 1, begin + n + 2) for n in range(size)]
        for begin, size in zip(range(0, 999, 20), sizes, strict=False)
    ]
    faces = np.array([face for fan in fans for face in fan])
    vertices = np.random.default_rng(0).normal(size=(20 * len(sizes), 3))
    batches = [len(batch.faces) for batch in split_into_batches(Surface(vertices=vertices, faces=faces), limit)]
    assert sum(batches) == sum(sizes)
    assert all(count <= limit or count in sizes for count in batches)
    assert all(one + other > limit for one, other in zip(batches, batches[1:], strict=False))


def test_some_faces_keep_their_corners_and_only_these() -> None:
    surface = several()
    kept = np.arange(len(surface.faces)) % 3 == 0
    some = select_faces(surface, kept)
    np.testing.assert_array_equal(some.vertices[some.faces], surface.vertices[surface.faces[kept]])
    assert len(np.unique(some.faces)) == len(some.vertices)
