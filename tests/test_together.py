"""Labels smoothed together: walls shared to the bit, every label with its volume, whatever the labels are."""

from __future__ import annotations

import re
import weakref
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from test_command_line import refused, run

import infill
from infill import Smoothing, UsageError, Volume, read_mesh, smooth_labels
from infill.kernels.partition import code_of_four, code_of_three, weigh_corners
from infill.kernels.sparse import BRICK
from infill.meshes.intersections import intersecting_pairs
from infill.meshes.solids import FINE, manifold_status
from infill.partition.fields import PartitionFields, smooth_fields
from infill.partition.junctions import find_crossings
from infill.partition.tetrahedra import STEPS, TETRAHEDRA, make_tables, pattern_code
from infill.partition.walls import OUTSIDE, Walls, cut_labels, place_walls, trace_walls
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.label_stages import field_reach
from infill.surface import Surface


def voronoi(shape: tuple[int, int, int], count: int, seed: int = 0) -> NDArray[np.int64]:
    """Labels 1, 2 ... of the nearest of random points."""
    points = np.random.default_rng(seed).uniform(0, shape, (count, 3))
    cells = np.stack(np.indices(shape), axis=-1).reshape(-1, 3) + 0.5
    return (cKDTree(points).query(cells)[1] + 1).reshape(shape)


def fields_of(labels: NDArray[np.int64], steps: int = 10) -> PartitionFields:
    """The plain fields of labels 0, 1 ..., in the whole grid."""
    numbers = labels.astype(np.uint16)
    boxes = [((0, 0, 0), labels.shape)] * (int(labels.max()) + 1)
    return smooth_fields(
        numbers, boxes, lambda mask, threads: smooth_bricks(mask, Smoothing(steps=steps), threads=threads)
    )


def walls_of(labels: NDArray[np.int64], steps: int = 10) -> tuple[Walls, NDArray[np.uint16]]:
    fields = fields_of(labels, steps)
    offsets = np.zeros(fields.count)
    winners = fields.winners(offsets)
    return place_walls(trace_walls(winners), fields, offsets), winners


def surface_of_label(walls: Walls, label: int) -> Surface:
    faces = np.concatenate(
        [walls.triangles[walls.sides[:, 0] == label], walls.triangles[walls.sides[:, 1] == label][:, ::-1]]
    )
    used, corners = np.unique(faces, return_inverse=True)
    return Surface(vertices=walls.points[used].astype(np.float64), faces=corners.reshape(-1, 3))


def assert_partition(labels: NDArray[np.int64], walls: Walls, winners: NDArray[np.uint16]) -> None:
    """Closed for every label that is left, none inside out, and together the box, without gap or overlap."""
    total = 0.0
    for label in np.unique(winners)[np.unique(winners) > 0]:
        surface = surface_of_label(walls, int(label))
        assert surface.closed
        assert surface.volume == pytest.approx(walls.volumes[label], rel=1e-6)
        assert surface.volume > 0
        total += surface.volume
    assert walls.volumes.sum() == pytest.approx(labels.size, rel=1e-9)
    if (labels > 0).all():
        assert total == pytest.approx(labels.size, rel=1e-6)
    assert (walls.sides[:, 0] != walls.sides[:, 1]).all()
    assert ((walls.sides[:, 1] != OUTSIDE) | (walls.sides[:, 0] > 0)).all()


# --- the cutting of cubes ----------------------------------------------------------------------------------


def test_six_tetrahedra_fill_a_cube() -> None:
    corners = np.array([[STEPS[step] for step in (0, first, second, 7)] for first, second in TETRAHEDRA], dtype=float)
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    assert volumes.tolist() == pytest.approx([1 / 6] * 6)


@given(st.tuples(*[st.integers(0, 3)] * 4))
def test_kernels_number_the_ways_in_which_labels_are_alike_as_the_tables_do(labels: tuple[int, ...]) -> None:
    assert code_of_four(*labels) == pattern_code(labels)
    assert code_of_three(*labels[:3]) == pattern_code(labels[:3])


def test_a_tetrahedron_has_no_more_walls_than_labels_need() -> None:
    counts = make_tables().counts[0]
    for labels, triangles in (((0, 0, 0, 0), 0), ((0, 1, 1, 1), 1), ((0, 1, 0, 1), 2), ((0, 0, 1, 2), 5)):
        assert counts[pattern_code(labels)] == triangles
    assert counts[pattern_code((0, 1, 2, 3))] == 12


@given(st.integers(3, 4), st.integers(0, 10**6))
def test_points_of_faces_and_insides_have_equal_values_of_all_labels(count: int, seed: int) -> None:
    """Where such a point lies well inside; else it is drawn in."""
    values = np.random.default_rng(seed).uniform(-1, 0.2, (4, 4))
    values[np.arange(4), np.arange(4)] = 0.5
    weight = np.zeros(4)
    weigh_corners(values, count, weight)
    assert weight[:count].sum() == pytest.approx(1)
    assert weight[:count].min() > 0.005
    exact = np.linalg.solve(
        np.concatenate([values[1:count, :count] - values[0, :count], np.ones((1, count))]), [0.0] * (count - 1) + [1.0]
    )
    if exact.min() > 0.02:
        np.testing.assert_allclose(weight[:count], exact, atol=1e-9)


# --- laws --------------------------------------------------------------------------------------------------


def test_two_labels_are_the_binary_scheme_to_the_last_bit() -> None:
    labels = np.where(voronoi((40, 36, 50), 9) % 2, 1, 2).astype(np.int64)
    fields = fields_of(labels)
    field = smooth_bricks(labels == 1, Smoothing(steps=10)).to_dense()
    assert np.array_equal(smooth_bricks(labels == 2, Smoothing(steps=10)).to_dense(), -field)
    winners = fields.winners(np.zeros(fields.count))
    assert np.array_equal(winners == 1, (field > 0) | ((field == 0) & (labels == 1)))


@pytest.mark.parametrize("interface", [1.0, 4.0])
def test_fields_are_those_of_the_whole_grid(interface: float) -> None:
    """Also with a wide interface, which reaches further: labels are smoothed in their part of the grid."""
    labels = np.zeros((90, 40, 40), dtype=np.uint16)
    labels[4:12, 10:30, 10:30], labels[70:84, 10:30, 10:30] = 1, 2
    smoothing = Smoothing(steps=40, interface=interface)
    boxes = [((0, 0, 0), labels.shape), ((4, 10, 10), (12, 30, 30)), ((70, 10, 10), (84, 30, 30))]
    fields = smooth_fields(
        labels,
        boxes,
        lambda mask, threads: smooth_bricks(mask, smoothing, threads=threads),
        reach=field_reach(interface),
    )
    for label in (1, 2):
        whole = smooth_bricks(labels == label, smoothing).to_dense()
        beside = np.full(labels.shape, -1, dtype=np.float32)
        for entry in np.flatnonzero((fields.labels == label) & (fields.slots >= 0)):
            brick = np.argwhere((fields.entries[..., 0] <= entry) & (entry < fields.entries[..., 1]))[0] * BRICK - 1
            cells = fields.values[fields.slots[entry]].reshape(BRICK)
            low, high = np.maximum(brick, 0), np.minimum(brick + BRICK, labels.shape)
            inner = tuple(slice(a - at, b - at) for a, b, at in zip(low, high, brick, strict=True))
            beside[tuple(map(slice, low, high))] = cells[inner]
        assert np.array_equal(beside, whole)


@settings(max_examples=10, deadline=None)
@given(
    st.tuples(st.integers(3, 20), st.integers(3, 20), st.integers(3, 34)),
    st.integers(1, 30),
    st.integers(0, 10**6),
    st.integers(0, 6),
)
def test_any_labels_are_parted_without_gap_or_overlap(
    shape: tuple[int, int, int], count: int, seed: int, steps: int
) -> None:
    labels = voronoi(shape, count, seed)
    labels[labels == 1] = 0
    walls, winners = walls_of(labels, steps)
    assert_partition(labels, walls, winners)


NASTY = {
    "noise": lambda: np.random.default_rng(0).integers(0, 5, (9, 8, 19)),
    "a checkerboard": lambda: np.indices((8, 8, 8)).sum(axis=0) % 2 + 1,
    "a label in every cell": lambda: np.arange(1, 6 * 5 * 7 + 1).reshape(6, 5, 7),
    "labels that touch at a corner": lambda: np.pad(
        np.kron(np.diag([1, 2]), np.ones((4, 4), int))[..., None] * np.ones(4, int), 2
    ),
    "a single cell": lambda: np.pad(np.ones((1, 1, 1), int), 3),
    "one label": lambda: np.ones((4, 5, 6), int),
    "one cell in all": lambda: np.ones((1, 1, 1), int),
}


@pytest.mark.parametrize("name", NASTY)
@pytest.mark.parametrize("steps", [0, 8])
def test_nasty_labels_are_parted_too(name: str, steps: int) -> None:
    labels = np.asarray(NASTY[name]()).astype(np.int64)
    walls, winners = walls_of(labels, steps)
    assert_partition(labels, walls, winners)
    for label in np.unique(winners)[np.unique(winners) > 0][:20]:
        assert manifold_status(surface_of_label(walls, int(label))) == FINE


def triangles_as_set(walls: Walls, numbering: NDArray[np.int64]) -> set[Any]:
    """All triangles by the coordinates of their corners and the labels beside them, whatever their order."""
    corners = np.round(walls.points[walls.triangles], 4)
    sides = np.where(walls.sides == OUTSIDE, -1, numbering[walls.sides])
    return {
        (frozenset(map(tuple, triangle.tolist())), frozenset(pair.tolist()))
        for triangle, pair in zip(corners, sides, strict=True)
    }


def test_the_numbers_of_labels_do_not_matter() -> None:
    labels = voronoi((20, 20, 20), 8)
    order = np.concatenate([[0], np.random.default_rng(1).permutation(8) + 1])
    one, other = walls_of(labels)[0], walls_of(order[labels])[0]
    assert triangles_as_set(one, order) == triangles_as_set(other, np.arange(9))


@pytest.mark.longest
@pytest.mark.parametrize("method", ["plain", "refine"])
def test_a_partition_passes_through_itself_nowhere(method: Any) -> None:
    """Not even where many lines on which three labels meet were made smooth: moves are taken back there."""
    result = smooth_labels(voronoi((40, 40, 40), 60), together=True, method=method, smoothing=Smoothing(steps=10))
    assert not any("pass through each other" in problem for problem in result.report["problems"])
    corners = np.concatenate([surface.vertices[surface.faces] for surface in result.surfaces.values()])
    points, faces = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    _, once = np.unique(np.sort(faces.reshape(-1, 3), axis=1), axis=0, return_index=True)  # walls are there twice
    assert not len(intersecting_pairs(Surface(vertices=points, faces=faces.reshape(-1, 3)[once])))


# --- what users call ---------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("method", ["plain", "refine"])
@pytest.mark.parametrize("spacing", [1.0, (0.7, 0.7, 2.8)])
def test_every_label_keeps_its_volume(method: Any, spacing: Any) -> None:
    labels = voronoi((48, 44, 40), 14)
    labels[:, :, :5] = 0
    result = smooth_labels(labels, together=True, method=method, spacing=spacing, smoothing=Smoothing(steps=8))
    assert result.report["problems"] == []
    for label in result.report["labels"]:
        cells = int((labels == label["number"]).sum())
        volume = cells * float(np.prod(np.broadcast_to(spacing, 3)))
        assert label["data"] == pytest.approx(volume)
        assert result.surfaces[label["name"]].volume == pytest.approx(volume, rel=1e-4)


@pytest.mark.parametrize("method", ["plain", "refine"])
def test_the_line_where_three_labels_meet_is_smooth(method: Any) -> None:
    """Three sectors around a slanted line: no point of it lies further than a third of a voxel from it."""
    x, y, z = (axis - 19.5 for axis in np.indices((40, 40, 40)))
    turned = np.arctan2(y - 0.23 * z, x - 0.41 * z)
    labels = (np.floor((turned + np.pi + 0.4) / (2 * np.pi / 3)).astype(np.int64) % 3) + 1
    result = smooth_labels(labels, together=True, method=method, smoothing=Smoothing(steps=10), tolerance=None)
    corners = [set(map(tuple, surface.vertices.tolist())) for surface in result.surfaces.values()]
    shared = np.array(sorted(set.intersection(*corners))) - 20
    inner = shared[np.abs(shared).max(axis=1) < 14]
    direction = np.array([0.41, 0.23, 1.0]) / np.linalg.norm([0.41, 0.23, 1.0])
    off = np.linalg.norm(inner - (inner @ direction)[:, None] * direction, axis=1)
    assert len(inner) > 40
    assert off.max() < 1 / 3


def test_neighbours_have_the_same_triangles_at_their_walls(tmp_path: Path) -> None:
    """In files too: all of them together, merged by equal coordinates, have every wall twice, once from each side."""
    labels = voronoi((30, 30, 30), 6)
    result = smooth_labels(labels, together=True, spacing=0.37, origin=(3.1, -20.7, 5.3), smoothing=Smoothing(steps=8))
    seen: dict[Any, int] = {}
    for name, surface in result.surfaces.items():
        infill.Result(surfaces={name: surface}, report={}, stages=None).save(tmp_path / f"{name}.stl")
        mesh = read_mesh(tmp_path / f"{name}.stl")
        for triangle in np.asarray(mesh.vertices)[np.asarray(mesh.faces)].tolist():
            key = frozenset(map(tuple, triangle))
            seen[key] = seen.get(key, 0) + 1
    lone = np.array([corner for key, count in seen.items() if count == 1 for corner in key])
    assert max(seen.values()) == 2
    low, high = np.array([3.1, -20.7, 5.3]), np.array([3.1, -20.7, 5.3]) + 30 * 0.37
    on_side = (np.abs(lone - low) < 1e-4) | (np.abs(lone - high) < 1e-4)
    assert on_side.any(axis=1).all()  # only the sides of the box have no neighbour


def test_a_label_that_is_lost_and_one_that_falls_apart_are_told() -> None:
    labels = np.ones((30, 30, 30), dtype=np.int64)
    labels[4:12, 4:12, 4:12] = 2
    labels[18:26, 4:12, 4:12] = 2
    labels[12:18, 7:9, 7:9] = 2  # a bar of two cells, which plain smoothing breaks
    result = smooth_labels(labels, together=True, method="plain", smoothing=Smoothing(steps=20))
    assert "label_2: 1 component fell apart into 2" in result.report["problems"]


def test_negative_labels_and_a_choice_of_labels(tmp_path: Path) -> None:
    labels = voronoi((24, 24, 24), 5) - 3
    result = smooth_labels(labels, together=True, smoothing=Smoothing(steps=5))
    assert [label["number"] for label in result.report["labels"]] == [-2, -1, 1, 2]
    chosen = smooth_labels(labels, together=True, label=(1, 2), smoothing=Smoothing(steps=5))
    assert list(chosen.surfaces) == ["label_1", "label_2"]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"level": 0.1}, "^level does not go with labels together; leave it out$"),
        ({"despeckle": 3.0}, "^despeckle does not go"),
        ({"method": "grey"}, "^method is grey, and labels have no grey values"),
        ({"keep_going": True}, "^keep_going does not go"),
    ],
)
def test_options_for_single_labels_are_refused(options: dict[str, Any], says: str) -> None:
    with pytest.raises(UsageError, match=says):
        smooth_labels(voronoi((9, 9, 9), 3), together=True, **options)


def test_the_command_writes_a_file_for_each_label(tmp_path: Path) -> None:
    np.save(tmp_path / "labels.npy", voronoi((24, 24, 24), 3))
    result = run("smooth", tmp_path / "labels.npy", "--together", "-o", tmp_path / "{label}.stl")
    assert result.exit_code == 0, result.stderr
    assert len(re.findall(r"[+-]0\.00\d\d% of the data; (?:kept|changed a little)", result.stderr)) == 3
    assert re.search(r"verdict +1 changed a little \(label_3\), 2 kept", result.stderr)
    assert sorted(path.name for path in tmp_path.glob("*.stl")) == ["label_1.stl", "label_2.stl", "label_3.stl"]
    refused(
        run("smooth", tmp_path / "labels.npy", "--together", "-o", tmp_path / "a.stl"),
        "use .3mf, .glb, .ply, .vtp or .vtu",
    )


# --- parts of it -------------------------------------------------------------------------------------------


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.0, 0.4))
def test_crossings_are_those_of_the_search_in_a_tree(seed: int, shift: float) -> None:
    """Whatever points are moved, and with cells that are not cubes."""
    walls, _ = walls_of(voronoi((14, 12, 16), 8, seed % 50), 3)
    rng = np.random.default_rng(seed)
    points = np.maximum(walls.points + shift * rng.standard_normal(walls.points.shape), 0).astype(np.float32)
    chosen = np.flatnonzero(rng.random(len(walls.triangles)) < 0.8)
    scale = (1.0, 1.0, 2.5)
    surface = Surface(vertices=points * np.array(scale), faces=walls.triangles[chosen])
    expected = chosen[intersecting_pairs(surface)]
    assert np.array_equal(find_crossings(points, walls.triangles, chosen, scale), np.unique(expected, axis=0))


def test_labels_cut_out_of_the_complex_are_their_triangles() -> None:
    walls, _ = walls_of(voronoi((20, 18, 16), 7))
    cuts = list(cut_labels(walls, 8))
    assert [cut.label for cut in cuts] == list(range(1, 8))
    for cut in cuts:
        behind, before = (walls.triangles[walls.sides[:, side] == cut.label] for side in range(2))
        assert np.array_equal(cut.points[cut.faces], np.concatenate([behind, before[:, ::-1]]))
        assert np.array_equal(cut.points, np.unique(cut.points[cut.faces]))


@pytest.mark.parametrize("turned", [False, True])
def test_surfaces_of_labels_are_made_when_they_are_asked_for(*, turned: bool) -> None:
    labels = voronoi((20, 18, 16), 5)
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0] if turned else np.eye(3)
    turn[:, 0] *= np.linalg.det(turn)
    volume = Volume(values=labels, spacing=(0.5, 0.5, 1.5), origin=(3.0, 4.0, 5.0), direction=turn)
    result = smooth_labels(volume, together=True, smoothing=Smoothing(steps=10), tolerance=None)
    surfaces = result.surfaces
    assert list(surfaces) == [label["name"] for label in result.report["labels"]]
    assert len(surfaces) == 5
    assert "label_9" not in surfaces
    corners: list[set[tuple[float, ...]]] = []
    for label in result.report["labels"]:
        surface = surfaces[label["name"]]
        assert surface is surfaces[label["name"]]  # while it is in use
        fresh = Surface(vertices=surface.vertices, faces=surface.faces)
        assert (len(fresh.faces), fresh.closed) == (label["triangles"], label["closed"]) == (len(surface.faces), True)
        assert fresh.volume == pytest.approx(label["volume"], rel=1e-12)
        assert fresh.area == pytest.approx(surface.area, rel=1e-12)
        place = weakref.ref(surface)
        corners.append(set(map(tuple, surface.vertices.tolist())))
        del surface, fresh
        assert place() is None
    # Neighbours have the same coordinates to the last bit.
    walls = set(map(tuple, result.stages.walls.points.tolist()))
    assert set().union(*corners) == walls


def test_volumes_by_shares_of_cells_are_about_those_within_walls() -> None:
    """They begin the search for offsets, and change with these as they say."""
    fields = fields_of(voronoi((48, 48, 48), 6))
    ramp, offsets = 2 * fields.slope(), np.zeros(fields.count)
    volumes, changes = fields.shares(offsets, ramp)
    assert volumes.sum() == pytest.approx(48**3, rel=1e-9)
    walls = place_walls(trace_walls(fields.winners(offsets)), fields, offsets)
    np.testing.assert_allclose(volumes[1:], walls.volumes[1:], rtol=0.01)
    offsets[2] = 0.05
    gain = fields.shares(offsets, ramp)[0] - volumes
    assert gain[2] == pytest.approx(0.05 * changes[[2]].sum(), rel=0.1)
    np.testing.assert_allclose(
        -gain[[1, 3, 4, 5, 6]], 0.05 * changes[[2]].toarray()[0][[1, 3, 4, 5, 6]], atol=0.1 * gain[2]
    )


def test_bricks_that_hold_one_value_are_not_kept() -> None:
    fields = fields_of(voronoi((60, 60, 60), 3))
    assert not ((fields.values == fields.values[:, :1]).all(axis=1) & (np.abs(fields.values[:, 0]) == 1)).any()
