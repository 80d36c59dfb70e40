"""Verdicts on labels smoothed together: what is lost, closed or torn is found, in the words of a single scan."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import ndimage
from test_together import NASTY, voronoi

from infill import Smoothing, Surface, Volume, smooth_labels, smooth_volume
from infill.inspection import partitions
from infill.inspection.deviation import KEPT, measure_deviation
from infill.inspection.label_connections import count_connections
from infill.inspection.partitions import PartitionCheck
from infill.isosurfaces.components import shell_names
from infill.kernels.wall_points import find_thick
from infill.meshes.shells import shell_volumes
from infill.partition.simplices import cells_at, middle_points, simplices
from infill.partition.wall_points import mark_beside, mark_far, mark_labels, place_middles
from infill.partition.walls import OUTSIDE, LabelCutter, WallGraph, count_parts, trace_walls


def labels_of(result: Any) -> dict[int, Any]:
    return {label["number"]: label for label in result.report["labels"]}


def check_of(labels: NDArray[np.int64], after: NDArray[np.int64], **place: Any) -> PartitionCheck:
    """A partition whose cells have changed their labels; its walls are in the middle."""
    graph = trace_walls(after.astype(np.uint16))
    return PartitionCheck(
        numbers=labels.astype(np.uint16),
        graph=graph,
        points=middle_points(graph).astype(np.float32),
        volume=Volume(values=labels, **place),
        count=int(max(labels.max(), after.max())) + 1,
    )


def surface_of(graph: WallGraph, number: int) -> Surface:
    cut = LabelCutter.of(graph.triangles, graph.sides, number + 1 + int(graph.winners.max())).cut(number)
    return Surface(vertices=middle_points(graph)[cut.points], faces=cut.faces)


# --- planted losses ------------------------------------------------------------------------------------------


def test_a_thin_plate_that_vanishes_is_lost() -> None:
    """It hangs on a block of the same label, which takes its volume; a plate that is a label of its own is kept."""
    labels = np.ones((30, 30, 30), dtype=np.int64)
    labels[14, 4:26, 4:26] = 2  # one voxel thick
    options: Any = {"together": True, "method": "plain", "smoothing": Smoothing(steps=20)}
    assert labels_of(smooth_labels(labels, **options))[2]["verdict"]["word"] != "lost"
    labels[20:26, 4:26, 4:26] = 2
    labels[14:22, 14:16, 14:16] = 2
    result = smooth_labels(labels, **options)
    verdict = labels_of(result)[2]["verdict"]
    assert verdict["word"] == "lost"
    assert verdict["thin"] > 0.9 * 2 * 22**2  # both sides of the plate
    assert result.report["verdict"] == {"word": "lost", "summary": "2 lost (label_1, label_2)"}
    assert any(
        problem.startswith("label_2: walls or gaps one voxel thick are gone") for problem in result.report["problems"]
    )


def test_a_label_of_which_nothing_is_left_is_lost() -> None:
    labels = np.zeros((24, 24, 24), dtype=np.int64)
    labels[6:18, 6:18, 6:18], labels[2, 20, 2] = 1, 6
    result = smooth_labels(labels, together=True, method="refine", smoothing=Smoothing(steps=30))
    assert [label["name"] for label in result.report["failed"]] == ["label_6"]
    assert result.report["verdict"]["word"] == "lost"
    assert result.report["verdict"]["summary"].startswith("1 lost (label_6), 1 ")
    assert "label_6: nothing of it is left" in result.report["problems"]


@pytest.mark.parametrize("space", [40, 12])  # with room around them, and touching the large label
@pytest.mark.parametrize("method", ["plain", "refine"])
def test_small_labels_keep_their_volume_or_are_named(space: int, method: Any) -> None:
    """Labels under 8 voxels beside a large one, whose volume is right at once."""
    labels = np.zeros((space, 40, 40), dtype=np.int64)
    centre = np.array(labels.shape)[:, None, None, None] // 2
    labels[((np.indices(labels.shape) - centre) ** 2).sum(axis=0) <= 15**2] = 1
    middle = space - 4
    labels[middle, 36, 36] = 2
    labels[middle, 4:6, 4] = 3
    labels[middle, 4:6, 34:37] = 4
    labels[middle - 1 : middle + 2, 36, 4] = labels[middle, 35:38, 4] = labels[middle, 36, 3:6] = 5
    result = smooth_labels(labels, together=True, method=method, tolerance=None)
    named = {problem.partition(":")[0] for problem in result.report["problems"]}
    for label in result.report["labels"]:
        if abs(label["volume_change"]) > (1e-4 if label["data"] >= 8 else 0.1):
            assert label["name"] in named
            assert label["verdict"]["word"] != "kept"
        if abs(label["volume_change"]) >= 0.5:
            assert label["verdict"]["word"] == "lost"
    kept = [label["number"] for label in result.report["labels"] if abs(label["volume_change"]) <= 0.05]
    assert len(kept) >= 4  # five in all, of which one may be too small for the steps


def test_a_hole_that_closes_is_told_for_both_labels() -> None:
    """Of the plate, a tunnel is gone; the rod through it has fallen apart."""
    labels = np.ones((30, 30, 30), dtype=np.int64)
    labels[13:17, 4:26, 4:26] = 2
    labels[13:17, 14:16, 14:16] = 3
    after = labels.copy()
    after[13:17, 14:16, 14:16] = 2
    labels[labels == 3] = 1
    check = check_of(labels, after)
    one, plate = check.topology()[1:3]
    assert (plate.data.tunnels, plate.result.tunnels) == (1, 0)
    assert (one.data.tunnels, one.result.tunnels) == (1, 0)
    assert (one.result.components, one.result.cavities) == (1, 1)
    assert check.deviations()[2] is not None

    result = smooth_labels(labels, together=True, method="plain", smoothing=Smoothing(steps=30))
    verdict = labels_of(result)[2]["verdict"]
    assert "1 of 1 tunnel is gone" in verdict["changes"]
    assert verdict["word"] in ("changed a little", "lost")
    assert "label_2" in result.report["verdict"]["summary"]


def test_a_part_that_moves_to_another_label_is_missing_from_one_and_new_in_the_other() -> None:
    labels = np.ones((24, 24, 24), dtype=np.int64)
    labels[12:] = 2
    after = labels.copy()
    after[12:20, 8:16, 8:16] = 1
    deviations = check_of(labels, after, spacing=0.5, origin=(10.0, 20.0, 30.0)).deviations()
    for number, cells in ((1, 8), (2, 6)):  # the side of the box is part of label 2, and nearer
        deviation = deviations[number]
        assert deviation is not None
        assert deviation.word == "lost"
        assert len(deviation.added) == 1
        assert deviation.added[0].distance == pytest.approx(0.5 * cells, abs=0.1)
        assert deviation.added[0].at[0] == pytest.approx(10 + 0.5 * (12 + cells), abs=0.3)
        assert deviation.added[0].at[1:] == pytest.approx((26.0, 36.0), abs=2.1)


def test_verdicts_are_those_of_a_single_scan() -> None:
    """A block with a plate that vanishes, alone in its volume."""
    labels = np.zeros((40, 30, 30), dtype=np.int64)
    labels[4:16, 6:24, 6:24] = 1
    labels[16:36, 14, 6:24] = 1
    options: Any = {"method": "plain", "smoothing": Smoothing(steps=20)}
    alone = smooth_volume(labels, label=1, allow_broken=True, crumbs=0.0, tolerance=None, **options).report["verdict"]
    together = labels_of(smooth_labels(labels, together=True, **options))[1]["verdict"]
    assert alone["word"] == together["word"] == "lost"
    assert together["thin"] == pytest.approx(alone["thin"], rel=0.25)
    assert together["far"] == alone["far"]


# --- laws ------------------------------------------------------------------------------------------------


@settings(max_examples=12, deadline=None)
@given(st.tuples(*[st.integers(2, 9)] * 3), st.integers(1, 5), st.integers(0, 10**6))
def test_connections_are_those_of_the_surface(shape: tuple[int, int, int], count: int, seed: int) -> None:
    labels = np.random.default_rng(seed).integers(0, count + 1, shape)
    graph = trace_walls(labels.astype(np.uint16))
    for number, counts in enumerate(count_connections(labels.astype(np.uint16), count + 1)[1:], 1):
        surface = surface_of(graph, number)
        assert counts.euler_number == len(surface.vertices) - len(surface.faces) // 2
        if not len(surface.faces):
            assert counts.components == 0
            continue
        volumes = shell_volumes(surface, *shell_names(surface))
        assert (counts.components, counts.cavities) == ((volumes > 0).sum(), (volumes < 0).sum())
        assert counts.tunnels >= 0


@pytest.mark.longest
@settings(max_examples=10, deadline=None)
@given(st.integers(2, 12), st.integers(0, 10**6), st.integers(0, 12), st.sampled_from([1.0, (0.5, 0.5, 1.7)]))
def test_labels_that_are_not_measured_are_near(count: int, seed: int, steps: int, spacing: Any) -> None:
    labels = voronoi((16, 15, 14), count, seed)
    result = smooth_labels(labels, together=True, spacing=spacing, method="plain", smoothing=Smoothing(steps=steps))
    for label in result.report["labels"]:
        distance, word = label["distance"], label["verdict"]["word"]
        if word == "kept":
            assert max(distance["result"]["max"], distance["input"]["max"]) <= 1.001 * KEPT * np.max(spacing)


@settings(max_examples=10, deadline=None)
@given(st.integers(2, 6), st.integers(0, 10**6), st.integers(0, 40))
def test_what_is_measured_near_changes_is_what_all_of_it_gives(count: int, seed: int, changes: int) -> None:
    labels = voronoi((14, 13, 12), count, seed)
    after, rng = labels.copy(), np.random.default_rng(seed)
    for place in rng.integers(0, 10, (changes, 3)):
        after[tuple(map(slice, place, place + rng.integers(1, 4, 3)))] = rng.integers(1, count + 1)
    check = check_of(labels, after)
    deviations = check.deviations()
    for number in range(1, count + 1):
        surfaces = check.given(number).surface, check.surface(number)
        if not all(len(surface.faces) for surface in surfaces):
            assert deviations[number] is None
            continue
        whole, local = check.exact_deviation(number), deviations[number]
        assert whole.word == (local.word if local else "kept")
        assert whole.thin_distance == pytest.approx(local.thin_distance if local else 0.0, abs=1e-9)
        assert measure_deviation(*surfaces, cell=1.0).there.max == whole.there.max
        if local:
            assert [patch.area for patch in local.lost] == [patch.area for patch in whole.lost]
            assert local.thin_area == whole.thin_area


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.integers(2, 9)] * 3), st.integers(0, 4), st.integers(0, 10**6))
def test_marks_of_points_are_those_of_the_corners_between_which_they_lie(
    shape: tuple[int, int, int], count: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    graph = trace_walls(rng.integers(0, count + 1, shape).astype(np.uint16))
    middles = middle_points(graph)
    assert (place_middles(graph, corner=(0, 0, 0), shape=shape) == middles).all()
    cells = rng.random(shape) < 0.2
    beside, far, limit = np.zeros(len(middles), dtype=bool), np.zeros(shape, dtype=bool), 0.4
    points, cell_size = (middles + rng.uniform(-0.5, 0.5, middles.shape)).astype(np.float32), np.array([1.0, 0.5, 2.0])
    is_far = np.linalg.norm((points - middles) * cell_size, axis=1) > limit
    for chosen, corners in simplices(graph):
        beside[chosen] = np.any([cells_at(cells, corner) for corner in corners], axis=0)
        for corner in corners:
            far[tuple(np.clip(corner[is_far[chosen]] - 1, 0, np.array(shape) - 1).T)] = True
    marked = np.zeros(shape, dtype=bool)
    mark_far(graph, points, cell_size, limit, marked)
    assert (marked == far).all()
    assert (mark_beside(graph, cells) == beside).all()
    sides = graph.sides[beside[graph.triangles].any(axis=1)]
    labels = mark_labels(graph, beside, count + 1)
    assert np.flatnonzero(labels).tolist() == np.unique(sides[sides != OUTSIDE]).tolist()


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.integers(1, 9)] * 3), st.floats(0.05, 0.95), st.integers(0, 10**6))
def test_thick_places_are_those_that_a_block_opens(shape: tuple[int, int, int], share: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    solid = rng.random(shape) < share
    places = rng.uniform(0, shape, (200, 3)).round(1)
    is_thick, position = np.empty(200, dtype=bool), places + 3
    find_thick(places, solid.astype(np.uint16), 1, is_thick)
    padded = np.pad(solid, 3, mode="edge")
    expected = np.ones(200, dtype=bool)
    for side in (padded, ~padded):
        thick = ndimage.binary_opening(side, np.ones((2, 2, 2)))
        cells = [np.floor(position - 0.5 + step).astype(int) for step in np.ndindex(2, 2, 2)]
        expected &= np.any([thick[tuple(cell.T)] for cell in cells], axis=0)
    assert (is_thick == expected).all()


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.integers(2, 9)] * 3), st.integers(0, 5), st.integers(0, 10**6))
def test_points_and_triangles_are_counted_without_walls(shape: tuple[int, int, int], count: int, seed: int) -> None:
    labels = np.random.default_rng(seed).integers(0, count + 1, shape).astype(np.uint16)
    graph = trace_walls(labels)
    points, triangles = count_parts(labels, count + 1)
    for number in range(1, count + 1):
        assert triangles[number] == (graph.sides == number).sum()
        assert points[number] == sum(
            (cells_at(labels, corner) == number).sum() for _, corners in simplices(graph) for corner in corners
        )


@pytest.mark.parametrize("spacing", [1.0, (0.5, 0.5, 1.7)])
def test_walls_traced_in_the_box_of_a_label_are_those_of_all(spacing: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    labels = voronoi((18, 16, 14), 7, 3)
    after = labels.copy()
    after[2:7, 3:9, 4:8] = labels[12, 4, 5]
    checks = []
    for most in (partitions.MOST_BOXES, 0):
        monkeypatch.setattr(partitions, "MOST_BOXES", most)
        check = check_of(labels, after, spacing=spacing)
        checks.append((check.deviations(), [check.given(number) for number in range(1, 8)]))
        assert (check.whole is None) == bool(most)
    (deviations, parts), (all_deviations, all_parts) = checks
    assert deviations == all_deviations
    assert any(deviations)
    for part, of_all in zip(parts, all_parts, strict=True):
        assert (part.surface.faces == of_all.surface.faces).all()
        assert (part.surface.vertices == of_all.surface.vertices).all()
        assert (part.unsettled == of_all.unsettled).all()


@pytest.mark.parametrize("name", NASTY)
def test_nothing_changes_where_nothing_is_smoothed(name: str) -> None:
    labels = np.asarray(NASTY[name]()).astype(np.int64)
    check = check_of(labels, labels)
    assert not any(check.deviations())
    assert all(topology.data == topology.result for topology in check.topology())


@pytest.mark.longest
def test_the_verdict_is_on_the_triangles_that_are_written() -> None:
    """A large tolerance moves walls as smoothing does, and is told in the same words and distances."""
    places = np.indices((40, 40, 40)) + 0.5 - 20
    labels = np.ones((40, 40, 40), dtype=np.int64)
    labels[(places**2).sum(axis=0) < 12**2] = 2
    labels[18:22, 18:22, 2:38] = 3
    fine, coarse = (smooth_labels(labels, together=True, tolerance=tolerance) for tolerance in (None, 3.0))
    assert len(coarse.surfaces["label_2"].faces) < 0.1 * len(fine.surfaces["label_2"].faces)
    check = check_of(labels, labels)
    words = set()
    for number, label in labels_of(coarse).items():
        deviation = measure_deviation(check.given(number).surface, coarse.surfaces[f"label_{number}"], cell=1.0)
        farthest = max(deviation.there.max, deviation.back.max)
        distance = label["distance"]
        assert max(distance["result"]["max"], distance["input"]["max"]) == pytest.approx(farthest, abs=1e-6)
        assert (label["verdict"]["word"] == "kept") == (farthest <= KEPT)
        words.add(label["verdict"]["word"])
    assert len(words) > 1
    assert {label["verdict"]["word"] for label in fine.report["labels"]} == {"kept"}
