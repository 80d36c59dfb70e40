"""Volumes in chunks with fewer triangles: closed, near the whole surface, and hardly more than in memory."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from test_chunked_command import gyroid
from test_chunks import Arranged, Case, cases

from infill import ParameterError, Smoothing, Surface, smooth_volume
from infill.chunks.hashing import hash_surface
from infill.chunks.layout import ChunkLayout
from infill.chunks.seams import ROOM, SeamPlan
from infill.chunks.simplifying import Fragment, join_fragments
from infill.errors import GeometryError
from infill.lazy.volume import LazyVolume
from infill.meshes.distance import TriangleTree
from infill.meshes.edge_collapse import collapse_edges
from infill.smoothing import chunked_simplified
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.chunked_surface import ChunkedSurface
from infill.smoothing.request import SmoothRequest

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")


@contextmanager
def smoothed(values: NDArray[Any], *, side: int, **options: Any) -> Iterator[ChunkedSurface]:
    keywords = {name: options.pop(name) for name in ("workers", "scheduler", "resume") if name in options}
    request = SmoothRequest(method="plain", allow_broken=True, **options)
    volume = LazyVolume(array=Arranged(values), spacing=(0.5, 0.5, 0.5), origin=(1.0, -2.0, 0.5))
    with smooth_in_chunks(volume, request, threshold=120, side=side, **keywords) as surface:
        yield surface


def farthest(points: NDArray[Any], surface: Surface) -> float:
    return float(TriangleTree.of(surface).nearest(np.asarray(points, dtype=np.float64))[0].max())


def check_simplified(values: NDArray[Any], side: int, tolerance: float) -> tuple[int, Surface, Surface]:
    """Simplify in chunks, and check everything that has to hold; return the triangles, and the whole surface."""
    with smoothed(values, side=side, tolerance=None) as chunked:
        full, whole_report = chunked.whole(), chunked.report()
    with smoothed(values, side=side, tolerance=tolerance) as chunked:
        found, report = chunked.whole(), chunked.report()
        assert chunked.triangles == len(found.faces) == report["triangles"]
        assert chunked.vertices == len(found.vertices) == report["vertices"]
    assert report["hash"] == whole_report["hash"] == hash_surface(full.vertices, full.faces)
    assert report["closed"]
    assert found.closed
    mesh = manifold3d.Mesh(
        vert_properties=np.asarray(found.vertices, dtype=np.float32), tri_verts=np.asarray(found.faces, dtype=np.uint32)
    )
    assert manifold3d.Manifold(mesh).status() == manifold3d.Error.NoError
    assert len(found.vertices) - len(found.faces) // 2 == len(full.vertices) - len(full.faces) // 2
    assert farthest(found.vertices, full) <= tolerance
    assert farthest(full.vertices, found) <= tolerance
    assert found.volume == pytest.approx(full.volume, rel=2e-3)
    assert report["volume"] == pytest.approx(found.volume, rel=1e-9)
    simplified = report["simplified"]
    assert simplified is not None
    assert simplified["triangles_before"] == len(full.faces)
    assert simplified["volume_change"] == pytest.approx(found.volume / full.volume - 1, abs=1e-9)
    assert whole_report["simplified"] is None
    return len(found.faces), full, found


@pytest.mark.longest
def test_eight_chunks_are_simplified() -> None:
    count, full, _ = check_simplified(gyroid(60, 30), 32, 0.05)
    memory = collapse_edges(full, tolerance=0.05)
    assert memory is not None
    assert count < 1.15 * len(memory.faces) < 0.2 * len(full.faces)


@pytest.mark.longest
def test_sixty_four_chunks_are_simplified() -> None:
    noise = np.random.default_rng(1).normal(0, 10, (130,) * 3)
    count, full, _ = check_simplified(np.clip(gyroid(130, 41) + noise, 0, 255).astype(np.uint8), 40, 0.05)
    memory = collapse_edges(full, tolerance=0.05)
    assert memory is not None
    assert count < 1.3 * len(memory.faces)


@pytest.mark.longest
@settings(max_examples=10)
@given(case=cases(largest=70))
def test_any_volume_is_simplified(case: Case) -> None:
    low, high = np.quantile(case.values, [0, case.share])
    values = np.where(case.values >= high, 255, 0) if high > low else gyroid(40, 20)
    with suppress(GeometryError):  # nothing is left of a few cells, with and without chunks
        check_simplified(values.astype(np.uint8), 32, 0.05)


@pytest.mark.long
def test_workers_change_no_bit() -> None:
    values, hashes = gyroid(60, 40), set()
    for options in ({"workers": 1}, {"workers": 3}):
        with smoothed(values, side=32, **options) as chunked:
            found = chunked.whole()
            hashes.add(hash_surface(found.vertices, found.faces))
    assert len(hashes) == 1


@pytest.mark.longest
def test_parts_of_one_chunk_are_simplified_as_chunks_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("infill.chunks.seams.PART", 32)
    check_simplified(gyroid(60, 30), 512, 0.05)


def test_a_tolerance_that_is_too_large_is_refused() -> None:
    with (
        pytest.raises(ParameterError, match=r"tolerance is 0.6 mm, and a volume in chunks is simplified by at most a"),
        smoothed(gyroid(40, 30), side=32, tolerance=0.6),
    ):
        pass


@pytest.mark.long
def test_simplification_resumes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    values, calls = gyroid(60, 30), Counter[str]()
    stop = ["simplify_box", 9]
    for name in ("simplify_chunk", "simplify_box"):
        whole = getattr(chunked_simplified, name)

        def counted(*arguments: Any, whole: Any = whole, name: str = name) -> Any:
            calls[name] += 1
            if [name, calls[name]] == stop:
                raise ZeroDivisionError
            return whole(*arguments)

        monkeypatch.setattr(chunked_simplified, name, counted)
    with pytest.raises(ZeroDivisionError), smoothed(values, side=32, workers=1, resume=tmp_path / "kept"):
        pass
    first = dict(calls)
    damaged = max((tmp_path / "kept/pieces").rglob("*.kept"), key=lambda path: path.stat().st_size)
    data = bytearray(damaged.read_bytes())
    data[-5] ^= 1
    damaged.write_bytes(data)
    stop[1] = 0
    calls.clear()
    with smoothed(values, side=32, workers=1, resume=tmp_path / "kept") as chunked:
        found = chunked.whole()
    # One file was damaged; boxes of the batch in which the run ended are simplified again.
    assert first["simplify_chunk"] == 8
    assert calls["simplify_chunk"] == 1
    assert calls["simplify_box"] == 12 + 6 + 1 - 8
    calls.clear()
    with smoothed(values, side=32, workers=1) as chunked:
        expected = chunked.whole()
    np.testing.assert_array_equal(found.vertices, expected.vertices)
    np.testing.assert_array_equal(found.faces, expected.faces)
    assert calls["simplify_box"] == 12 + 6 + 1


def test_a_dask_array_is_simplified_as_its_file() -> None:
    import dask.array

    options: dict[str, Any] = {"method": "plain", "threshold": 120, "smoothing": Smoothing(steps=6)}
    found = smooth_volume(dask.array.from_array(gyroid(40, 30), chunks=20), **options)
    whole = smooth_volume(gyroid(40, 30), strict=True, allow_broken=True, **options)
    assert len(found.surface.faces) == pytest.approx(len(whole.surface.faces), rel=0.1)


# --- seams -----------------------------------------------------------------------------------------------


@given(
    shape=st.tuples(*[st.integers(1, 400)] * 3),
    size=st.tuples(*[st.integers(1, 30)] * 3),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=40)
def test_boxes_of_a_round_do_not_overlap_and_reach_every_seam(
    shape: tuple[int, int, int], size: tuple[int, int, int], seed: int
) -> None:
    plan = SeamPlan(layout=ChunkLayout(shape=shape, size=size, steps=3))
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1, np.array(shape), (300, 3))
    for point in points:  # half of them on planes
        for axis, planes in enumerate(plan.planes):
            if planes and rng.random() < 0.5:
                point[axis] = rng.choice(planes)
    inside = np.zeros(len(points), dtype=bool)
    deep = np.zeros(len(points), dtype=bool)
    for boxes in plan.rounds():
        held = np.array([box.holds(points) for box in boxes]).reshape(len(boxes), len(points))
        assert held.sum(axis=0).max(initial=0) <= 1
        inside |= held.any(axis=0)
        deep |= np.array([box.holds(points, -0.4 * plan.reach) for box in boxes]).reshape(held.shape).any(axis=0)
    on_plane = np.zeros(len(points), dtype=bool)
    for axis, planes in enumerate(plan.planes):
        on_plane |= np.isin(points[:, axis], planes)
    assert deep[on_plane].all()  # what borders a box was inside one before, or is in a later one
    assert plan.near_seams(points)[inside].all()


def test_planes_that_are_close_share_a_box() -> None:
    plan = SeamPlan(layout=ChunkLayout(shape=(78, 6, 6), size=(3, 1, 1), steps=1))  # the last chunk is one brick
    assert plan.planes[0] == (23.0, 47.0, 71.0)
    assert len(plan.clusters[0]) == 3
    assert ROOM * plan.reach < 24
    narrow = SeamPlan(layout=ChunkLayout(shape=(600, 6, 6), size=(37, 1, 1), steps=1))
    assert all(b - a <= 148 for a, b in zip(narrow.planes[0][:-1], narrow.planes[0][1:], strict=True))


def test_fragments_join_where_they_share_numbers() -> None:
    points = np.random.default_rng(0).normal(size=(4, 3))
    one = Fragment(numbers=np.array([5, 9, 2]), points=points[:3], faces=np.array([[0, 1, 2]], dtype=np.int32))
    other = Fragment(numbers=np.array([9, 5, 7]), points=points[[1, 0, 3]], faces=np.array([[0, 1, 2]], dtype=np.int32))
    joined = join_fragments([one, other])
    assert joined.numbers.tolist() == [2, 5, 7, 9]
    np.testing.assert_array_equal(joined.points[joined.faces], points[[[0, 1, 2], [1, 0, 3]]])
    assert joined.border.all()
    assert joined.select(np.array([False, True])).numbers.tolist() == [5, 7, 9]


# --- vertices that stay ----------------------------------------------------------------------------------


def half_of_a_gyroid() -> tuple[Surface, NDArray[np.bool_], Surface]:
    """An open half of a surface, its border, and the whole."""
    options: dict[str, Any] = {"method": "plain", "tolerance": None, "strict": True, "allow_broken": True}
    whole = smooth_volume(gyroid(48, 30), threshold=120, **options).surface
    left = np.asarray(whole.vertices)[whole.faces].mean(axis=1)[:, 0] < 24
    faces = whole.faces[left]
    used = np.unique(faces)
    half = replace(whole, vertices=np.asarray(whole.vertices)[used], faces=np.searchsorted(used, faces))
    return half, np.isin(used, whole.faces[~left]), whole


def test_pinned_vertices_stay_to_the_bit() -> None:
    half, border, _ = half_of_a_gyroid()
    pinned = border | (np.asarray(half.vertices)[:, 1] < 10)
    before = np.array(half.vertices), half.faces.copy()
    found = collapse_edges(half, tolerance=0.1, pinned=pinned)
    assert found is not None
    assert len(found.faces) < 0.5 * len(half.faces)
    count = int(pinned.sum())
    np.testing.assert_array_equal(np.asarray(found.vertices)[:count], np.asarray(half.vertices)[pinned])
    rank = np.cumsum(pinned) - 1
    still = half.faces[pinned[half.faces].all(axis=1)]
    kept = {tuple(sorted(face)) for face in found.faces.tolist() if max(face) < count}
    assert {tuple(sorted(face)) for face in rank[still].tolist()} == kept
    assert farthest(found.vertices, half) <= 0.1
    assert farthest(half.vertices, found) <= 0.1
    np.testing.assert_array_equal(half.vertices, before[0])
    np.testing.assert_array_equal(half.faces, before[1])


def test_an_open_surface_needs_a_pinned_border() -> None:
    half, border, _ = half_of_a_gyroid()
    assert collapse_edges(half, tolerance=0.1) is None
    assert collapse_edges(half, tolerance=0.1, pinned=np.zeros_like(border)) is None
    everything = collapse_edges(half, tolerance=0.1, pinned=np.ones_like(border))
    assert everything is not None
    np.testing.assert_array_equal(everything.faces, half.faces)
    fewest = collapse_edges(half, pinned=border)
    assert fewest is not None
    assert border.sum() < len(fewest.faces) < 0.2 * len(half.faces)


def test_distances_are_measured_from_another_surface() -> None:
    """Simplified twice, a surface stays within one tolerance of the original."""
    _, _, whole = half_of_a_gyroid()
    once = collapse_edges(whole, tolerance=0.1)
    assert once is not None
    free = np.zeros(len(once.vertices), dtype=bool)
    twice = collapse_edges(once, tolerance=0.1, pinned=free, original=whole)
    loose = collapse_edges(once, tolerance=0.1)
    assert twice is not None
    assert loose is not None
    assert farthest(twice.vertices, whole) <= 0.1
    assert farthest(whole.vertices, twice) <= 0.1
    assert max(farthest(whole.vertices, loose), farthest(loose.vertices, whole)) > 0.1  # the comparison can fail


@given(seed=st.integers(0, 2**32 - 1), share=st.floats(0.0, 1.0))
def test_open_meshes_are_paired_as_a_dictionary_does(seed: int, share: float) -> None:
    """Some faces of a closed mesh, with vertices at which several fans meet."""
    from infill.graph import label_connected
    from infill.kernels.corners import pair_open_edges, split_open_fans

    whole = small_mesh()
    faces = whole.faces[np.random.default_rng(seed).random(len(whole.faces)) < share]
    start, count = faces.astype(np.int32).ravel(), len(whole.vertices)
    twin, name = np.empty(len(start), dtype=np.int32), np.empty(len(start) + count, dtype=np.int32)
    assert pair_open_edges(start, count, twin)
    ends = np.roll(faces, -1, axis=1).ravel()
    corner_of = {(a, b): corner for corner, (a, b) in enumerate(zip(start.tolist(), ends.tolist(), strict=True))}
    assert twin.tolist() == [corner_of.get((b, a), -1) for a, b in corner_of]
    before = start.copy()
    total = split_open_fans(start, twin, count, name)
    np.testing.assert_array_equal(name[start], before)
    # Corners at one vertex are in one fan if an edge between them has two faces.
    corner = np.flatnonzero(twin >= 0)
    following = twin[corner] - twin[corner] % 3 + (twin[corner] % 3 + 1) % 3  # starts at the same vertex
    fans, fan_count = label_connected(corner, following, len(start))
    assert len(np.unique(np.stack([start, fans]), axis=1).T) == fan_count == len(np.unique(start))
    assert total == count + fan_count - len(np.unique(before))
    if len(faces):  # an edge with two faces on the same side
        twice = np.concatenate([faces, faces[:1]]).astype(np.int32).ravel()
        assert not pair_open_edges(twice, count, np.empty(len(twice), dtype=np.int32))


def small_mesh() -> Surface:
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=2)
    return Surface(vertices=ball.vertices, faces=np.array(ball.faces, dtype=np.int32))
