"""Walls between labels with fewer triangles: near the given ones, whole, with every volume."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from infill import smooth_labels
from infill.kernels import wall_collapsing as kernels
from infill.kernels.wall_edges import list_stars, list_walls
from infill.meshes.distance import distances
from infill.meshes.intersections import intersecting_pairs
from infill.partition import simplifying, wall_mesh
from infill.partition.simplifying import find_far, simplify_partition
from infill.partition.volumes import VolumePartition
from infill.partition.wall_mesh import WallMesh, chain, edges_of, number_pairs, pair_wall_edges
from infill.partition.walls import OUTSIDE, Walls
from infill.smoothing import together
from infill.surface import Surface

CUBIC = (1.0, 1.0, 1.0)


def make_cells(shape: tuple[int, ...], count: int, seed: int, scale: tuple[float, ...] = CUBIC) -> NDArray[np.uint16]:
    """Number the cells of a grid by the nearest of some random points, from 1 on."""
    rng = np.random.default_rng(seed)
    places = (np.indices(shape).reshape(3, -1).T + 0.5) * scale
    seeds = rng.uniform(0, np.multiply(shape, scale), (count, 3))
    return (cKDTree(seeds).query(places)[1] + 1).reshape(shape).astype(np.uint16)


def partition_of(labels: NDArray[Any], monkeypatch: pytest.MonkeyPatch, **options: Any) -> VolumePartition:
    """Smooth labels together; return their walls with all triangles."""
    kept: list[VolumePartition] = []

    def keep(*arguments: Any, **keywords: Any) -> VolumePartition:
        kept.append(original(*arguments, **keywords))
        return kept[-1]

    original = together.keep_volumes
    with monkeypatch.context() as patched:
        patched.setattr(together, "keep_volumes", keep)
        smooth_labels(labels, together=True, tolerance=None, **options)
    return kept[0]


def key_of(walls: Walls) -> NDArray[np.int64]:
    """Number the walls by the labels on both sides, whichever is before."""
    low = np.where(walls.sides[:, 1] == OUTSIDE, walls.sides[:, 0], walls.sides.min(axis=1)).astype(np.int64)
    high = np.where(walls.sides[:, 1] == OUTSIDE, 1 << 20, walls.sides.max(axis=1))
    return low << 32 | high


def wall_as_surface(walls: Walls, key: int, scale: tuple[float, ...]) -> Surface:
    """Return one wall."""
    return Surface(vertices=walls.points.astype(float) * scale, faces=walls.triangles[key_of(walls) == key])


def spread_places(surface: Surface, count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Spread random places over triangles, as many for each area, and add their corners."""
    corners = surface.vertices[surface.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = rng.choice(len(corners), count, p=area / area.sum())
    places = np.einsum("ij,ijk->ik", rng.dirichlet((1, 1, 1), count), corners[chosen])
    return np.concatenate([places, corners.reshape(-1, 3)])


def label_faces(walls: Walls, label: int) -> NDArray[np.int64]:
    """Return the triangles of a label, facing outwards."""
    return np.concatenate(
        [walls.triangles[walls.sides[:, 0] == label], walls.triangles[walls.sides[:, 1] == label][:, ::-1]]
    )


def euler_number(triangles: NDArray[np.integer]) -> int:
    """Return the points less the edges plus the triangles."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return len(np.unique(triangles)) - len(np.unique(edges, axis=0)) + len(triangles)


def check_whole(given_walls: Walls, fewer: Walls) -> None:
    """Check that every label is closed, a manifold, and of the same kind as before."""
    for label in np.unique(given_walls.sides[given_walls.sides > 0]):
        faces = label_faces(fewer, int(label))
        edges = Counter(map(tuple, np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).tolist()))
        assert max(edges.values()) == 1
        assert all((b, a) in edges for a, b in edges)
        assert euler_number(faces) == euler_number(label_faces(given_walls, int(label)))


@pytest.mark.longest
@settings(max_examples=6, deadline=None)
@given(
    seed=st.integers(0, 999),
    count=st.integers(2, 9),
    tolerance=st.sampled_from([0.05, 0.1, 0.3]),
    tall=st.sampled_from([1.0, 3.0]),
)
def test_each_wall_stays_within_the_tolerance_of_itself_both_ways(
    seed: int, count: int, tolerance: float, tall: float
) -> None:
    scale = (1.0, 1.0, tall)
    labels = make_cells((22, 20, 18), count, seed, scale)
    labels[labels == 2] = 0
    with pytest.MonkeyPatch.context() as monkeypatch:
        partition = partition_of(labels, monkeypatch, spacing=scale)
    simple = simplify_partition(partition, tolerance, scale=scale)
    before, after = partition.walls, simple.walls
    assert len(after.triangles) < 0.5 * len(before.triangles)
    assert set(key_of(after).tolist()) == set(key_of(before).tolist())
    rng = np.random.default_rng(seed)
    for key in np.unique(key_of(before)).tolist():
        one, other = (wall_as_surface(walls, key, scale) for walls in (before, after))
        assert distances(spread_places(one, 2000, rng), other).max() <= tolerance
        assert distances(spread_places(other, 2000, rng), one).max() <= tolerance
    check_whole(before, after)
    assert not len(intersecting_pairs(Surface(vertices=after.points * np.array(scale), faces=after.triangles)))
    kept = before.volumes[1:] > 0
    assert np.abs(after.volumes[1:][kept] / before.volumes[1:][kept] - 1).max() < 5e-5
    assert after.volumes.sum() == pytest.approx(np.prod(np.multiply(labels.shape, scale)))


def test_flat_walls_take_few_triangles_and_end_at_the_sides_of_the_box(monkeypatch: pytest.MonkeyPatch) -> None:
    labels = np.ones((20, 20, 20), dtype=np.uint8)
    labels[:, 10:] = 2
    partition = partition_of(labels, monkeypatch)
    simple = simplify_partition(partition, 0.1, scale=CUBIC)
    assert len(partition.walls.triangles) > 3000
    assert len(simple.walls.triangles) <= 2 + 4 * 5 + 2 + 24  # a rectangle and two boxes, hardly more
    outside = simple.walls.triangles[simple.walls.sides[:, 1] == OUTSIDE]
    corners = simple.walls.points[outside]
    on_side = ((corners == 0) | (corners == 20)).all(axis=1).any(axis=1)
    assert on_side.all()
    assert sorted(np.unique(corners[..., 0]).tolist())[:: len(np.unique(corners[..., 0])) - 1] == [0, 20]


def test_the_result_is_the_same_with_any_number_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((70, 20, 20), 8, 3), monkeypatch)
    one, two, three = (simplify_partition(partition, 0.1, scale=CUBIC, threads=threads) for threads in (1, 2, 3))
    assert one.walls.points.tobytes() == two.walls.points.tobytes() == three.walls.points.tobytes()
    assert one.walls.triangles.tobytes() == two.walls.triangles.tobytes() == three.walls.triangles.tobytes()


def test_nothing_changes_its_input(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((16, 16, 16), 4, 0), monkeypatch)
    walls = partition.walls
    before = [part.tobytes() for part in (walls.points, walls.triangles, walls.sides, walls.volumes)]
    simplify_partition(partition, 0.2, scale=CUBIC)
    assert before == [part.tobytes() for part in (walls.points, walls.triangles, walls.sides, walls.volumes)]


def test_the_order_of_points_is_that_of_the_specification(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((16, 16, 16), 9, 5), monkeypatch)
    mesh = WallMesh.of(partition.walls, CUBIC, (16, 16, 16))
    faces_at: dict[int, list[int]] = {}
    for number, triangle in enumerate(mesh.triangles.tolist()):
        for corner in triangle:
            faces_at.setdefault(corner, []).append(number)
    for point in range(0, len(mesh.points), 7):
        uses: dict[int, list[int]] = {}
        for number in faces_at[point]:
            for corner in mesh.triangles[number].tolist():
                if corner != point:
                    uses.setdefault(corner, []).append(int(mesh.pair[number]))
        lines = [corner for corner, pairs in uses.items() if len(pairs) != 2 or len(set(pairs)) > 1]
        assert mesh.order[point] == {0: kernels.WALL, 2: kernels.LINE}.get(len(lines), kernels.FIXED)


def test_a_wall_that_is_moved_is_found_and_its_points_can_be_fixed(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((20, 20, 20), 4, 1), monkeypatch)
    whole = WallMesh.of(partition.walls, CUBIC, (20, 20, 20))
    fewer = WallMesh.of(simplify_partition(partition, 0.1, scale=CUBIC).walls, CUBIC, (20, 20, 20))
    assert not len(find_far(whole, fewer, 0.1, CUBIC, 1))
    inner = np.flatnonzero((fewer.order == kernels.WALL) & (fewer.flags == 0))
    points = fewer.points.copy()
    points[inner[0]] += 0.5
    moved = replace(fewer, points=points)
    far = find_far(whole, moved, 0.1, CUBIC, 1)
    assert len(far)
    assert np.linalg.norm(far - points[inner[0]], axis=1).min() < 1.0
    kept = whole.fix(whole.near(far, 1.5)).collapse(0.08**2, 0.08, 1)
    assert not len(find_far(whole, kept, 0.1, CUBIC, 1))
    near = np.linalg.norm(whole.points - points[inner[0]], axis=1) < 1.0
    held = set(map(tuple, kept.points.tolist()))
    assert near.any()
    assert all(place in held for place in map(tuple, whole.points[near].tolist()))


def test_every_point_that_was_is_measured_even_of_large_meshes(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((20, 20, 20), 4, 1), monkeypatch)
    monkeypatch.setattr(wall_mesh, "MOST_SAMPLED", 10)
    whole = WallMesh.of(partition.walls, CUBIC, (20, 20, 20))
    fewer = WallMesh.of(simplify_partition(partition, 0.1, scale=CUBIC).walls, CUBIC, (20, 20, 20))
    inner = np.flatnonzero((whole.order == kernels.WALL) & (whole.flags == 0))
    all_walls, spikes = Surface(vertices=fewer.points, faces=fewer.triangles), 0
    for number in inner[:: len(inner) // 20]:
        points = whole.points.copy()
        points[number] += 0.5
        if distances(points[number][None], all_walls)[0] < 0.2:  # along the wall
            continue
        spikes += 1
        far = find_far(replace(whole, points=points), fewer, 0.1, CUBIC, 1)
        assert (far == points[number]).all(axis=1).any()
        assert not len(find_far(replace(whole, points=points), fewer, 0.1, CUBIC, 1, around=points[number][None] + 9))
    assert spikes > 5


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 99), places=st.integers(1, 12), reach=st.sampled_from([1.0, 2.5]))
def test_points_that_come_back_leave_every_label_whole(seed: int, places: int, reach: float) -> None:
    with pytest.MonkeyPatch.context() as monkeypatch:
        partition = partition_of(make_cells((20, 20, 20), 6, 1), monkeypatch)
    whole = WallMesh.of(partition.walls, CUBIC, (20, 20, 20))
    fewer = whole.collapse(0.02**2, None, 1).collapse(0.2**2, 0.2, 1)
    is_back = whole.near(np.random.default_rng(seed).uniform(0, 20, (places, 3)), reach)
    mended = fewer.restore(whole, is_back)
    assert mended is not None
    restored, back = mended
    assert set(map(tuple, whole.points[is_back].tolist())) <= set(map(tuple, back.tolist()))
    assert len(fewer.triangles) <= len(restored.triangles) < len(whole.triangles)
    assert (restored.points[restored.into[is_back]] == whole.points[is_back]).all()
    mapped = restored.into[whole.triangles]
    distinct = (mapped != np.roll(mapped, 1, axis=1)).all(axis=1)
    assert mapped[distinct].tolist() == restored.triangles.tolist()
    assert not restored.crowded_points().any()
    new = restored.into[is_back]
    before, after = whole.points[whole.triangles[distinct]], restored.points[restored.triangles]
    normals = [np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) for corners in (before, after)]
    assert ((normals[0] * normals[1]).sum(axis=1) > 0)[np.isin(restored.triangles, new).any(axis=1)].all()
    walls = restored.as_walls(partition.graph, CUBIC)[1]
    check_whole(partition.walls, walls)
    assert set(key_of(walls).tolist()) == set(key_of(partition.walls).tolist())


def test_triangles_that_lie_on_each_other_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = WallMesh.of(partition_of(make_cells((12, 12, 12), 3, 2), monkeypatch).walls, CUBIC, (12, 12, 12))
    assert not mesh.crowded_points().any()
    points = len(mesh.points)
    pillow = np.array([[0, 1, 2], [0, 2, 1]], dtype=np.int32) + points  # closed, and apart from all else
    doubled = replace(
        mesh,
        points=np.concatenate([mesh.points, np.eye(3)]),
        triangles=np.concatenate([mesh.triangles, pillow]),
        sides=np.concatenate([mesh.sides, mesh.sides[:1], mesh.sides[:1]]),
    )
    assert np.flatnonzero(doubled.crowded_points()).tolist() == [points, points + 1, points + 2]
    inner = int(np.flatnonzero(mesh.order == kernels.WALL)[0])
    at = mesh.triangles[(mesh.triangles == inner).any(axis=1)][:1]
    flap = np.array([[at[0, 0], at[0, 1], points]], dtype=np.int32)
    flapped = replace(
        mesh,
        points=np.concatenate([mesh.points, np.zeros((1, 3))]),
        triangles=np.concatenate([mesh.triangles, flap]),
        sides=np.concatenate([mesh.sides, mesh.sides[(mesh.triangles == inner).any(axis=1)][:1]]),
    )
    assert np.flatnonzero(flapped.crowded_points()).tolist() == sorted(at[0, :2].tolist())


@pytest.mark.longest
@pytest.mark.parametrize("walls", ["flat", "rough"])
def test_a_place_that_fails_costs_few_triangles(walls: str, monkeypatch: pytest.MonkeyPatch) -> None:
    labels = make_cells((30, 30, 30), 6, 3)
    if walls == "rough":
        labels = make_cells((30, 30, 30), 200, 3) % 6 + 1
    partition = partition_of(labels, monkeypatch)
    plain = simplify_partition(partition, 0.1, scale=CUBIC)
    failing = partition.walls.points.astype(float)[len(partition.walls.points) // 2][None]
    collapses, checks = [], []

    def collapse(self: WallMesh, *arguments: Any) -> WallMesh:
        collapses.append(arguments)
        return collapse_of_mesh(self, *arguments)

    def find(*arguments: Any, **options: Any) -> NDArray[np.float64]:
        """Report a planted place at the first check."""
        checks.append(arguments)
        return failing if len(checks) == 1 else find_far(*arguments, **options)

    collapse_of_mesh = WallMesh.collapse
    monkeypatch.setattr(WallMesh, "collapse", collapse)
    monkeypatch.setattr(simplifying, "find_far", find)
    mended = simplify_partition(partition, 0.1, scale=CUBIC)
    check_whole(partition.walls, mended.walls)
    more = len(mended.walls.triangles) / len(plain.walls.triangles)
    if walls == "rough":
        assert 1 < more < 1.1
        assert len(collapses) == 2  # without and with measured distances, once
    else:
        assert 1 < more < 2  # all is done again, with a smaller tolerance
    near = np.linalg.norm(partition.walls.points - failing, axis=1) < 1.0
    assert cKDTree(mended.walls.points).query(partition.walls.points[near])[0].max() < 0.01


def test_walls_that_came_in_with_crossings_are_simplified_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((16, 16, 16), 4, 1), monkeypatch)
    mesh = WallMesh.of(partition.walls, CUBIC, (16, 16, 16))
    inner = np.flatnonzero((mesh.order == kernels.WALL) & (mesh.flags == 0))
    points = partition.walls.points.copy()
    points[inner[0]] += np.array([6.0, 5.0, 4.0], dtype=np.float32)
    crossed = replace(partition.walls, points=points)
    pairs = len(intersecting_pairs(Surface(vertices=points.astype(float), faces=crossed.triangles)))
    simple = simplify_partition(replace(partition, walls=crossed, crossings=pairs), 0.1, scale=CUBIC)
    assert len(simple.walls.triangles) < 0.6 * len(crossed.triangles)
    surface = Surface(vertices=simple.walls.points.astype(float), faces=simple.walls.triangles)
    assert 0 < len(intersecting_pairs(surface)) == simple.crossings <= pairs


@settings(max_examples=20, deadline=None)
@given(st.integers(1, 40), st.integers(3, 12), st.integers(1, 4), st.integers(0, 10**6))
def test_edges_and_corners_of_walls_come_in_the_order_of_a_sort(count: int, points: int, pairs: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    triangles = np.array([rng.permutation(points)[:3] for _ in range(count)], dtype=np.int32)
    pair = rng.integers(0, pairs, count).astype(np.int32)
    starts, ends = edges_of(triangles)
    keys = np.minimum(starts, ends).astype(np.int64) << 32 | np.maximum(starts, ends)
    order = np.lexsort((np.repeat(pair, 3), keys))
    sorted_keys, sorted_pairs = keys[order], np.repeat(pair, 3)[order]
    same = (sorted_keys[1:] == sorted_keys[:-1]) & (sorted_pairs[1:] == sorted_pairs[:-1])
    first, second, single = pair_wall_edges(triangles, pair)
    assert first.tolist() == order[:-1][same].tolist()
    assert second.tolist() == order[1:][same].tolist()
    assert single.tolist() == order[~(np.append(same, False) | np.append(False, same))].tolist()

    begins, star = np.zeros(points + 1, dtype=np.int32), np.empty(3 * count, dtype=np.int32)
    list_stars(triangles, begins, star)
    corners = np.argsort(triangles.ravel(), kind="stable")
    assert star.tolist() == (corners // 3).tolist()
    assert begins.tolist() == np.searchsorted(np.sort(triangles.ravel()), np.arange(points + 1)).tolist()
    at, faces = np.empty(3 * count, dtype=np.int32), np.empty(3 * count, dtype=np.int32)
    number = list_walls(begins, star, pair, at, faces)
    owner = triangles.ravel()[corners]
    one_of_each = np.unique(owner.astype(np.int64) << 32 | pair[star], return_index=True)[1]
    assert at[:number].tolist() == owner[one_of_each].tolist()
    assert faces[:number].tolist() == star[one_of_each].tolist()


@settings(max_examples=20, deadline=None)
@given(st.integers(1, 60), st.integers(1, 9), st.integers(0, 10**6))
def test_items_are_chained_in_the_order_of_their_numbers(count: int, owners: int, seed: int) -> None:
    owner = np.random.default_rng(seed).integers(0, owners, count)
    heads, after = chain(owner, owners)
    for number in range(owners):
        chained, item = [], int(heads[number])
        while item >= 0:
            chained.append(item)
            item = int(after[item])
        assert chained == np.flatnonzero(owner == number).tolist()


@pytest.mark.parametrize("in_table", [5, 4096])
def test_pairs_of_labels_are_numbered_in_their_order(in_table: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wall_mesh, "MOST_IN_TABLE", in_table)
    sides = np.random.default_rng(2).integers(0, 9, (200, 2)).astype(np.int16)
    sides[::7, 1] = OUTSIDE
    expected = np.unique(np.where(sides == OUTSIDE, 99, sides), axis=0, return_inverse=True)[1].ravel()
    assert number_pairs(sides).tolist() == expected.tolist()


def test_places_reach_as_far_as_the_triangles_at_their_point(monkeypatch: pytest.MonkeyPatch) -> None:
    partition = partition_of(make_cells((12, 12, 12), 5, 4), monkeypatch)
    mesh = WallMesh.of(partition.walls, CUBIC, (12, 12, 12))
    places, _, _, point, corners, starts, star, _, reach = mesh.watched(0.1)
    for n in range(0, len(places), 17):
        of_star = corners[star[starts[point[n]] : starts[point[n] + 1]]].reshape(-1, 3)
        assert reach[n] == pytest.approx(np.linalg.norm(of_star - places[n], axis=1).max(), rel=1e-12)
