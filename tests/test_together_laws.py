"""Laws of labels smoothed together, from the array to the surfaces: numbers do not matter, nothing overlaps or is lost."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from test_together import NASTY, voronoi

from infill import GeometryError, ParameterError, Smoothing, Volume, smooth_labels, smooth_volume
from infill.formats.label_walls import LabelWalls
from infill.inspection.deviation import measure_deviation
from infill.surface import Surface

QUICK = Smoothing(steps=5)
SHAPES = st.tuples(st.integers(2, 12), st.integers(2, 12), st.integers(2, 20))


def walls_of(result: Any) -> LabelWalls:
    """The walls as files have them."""
    walls: LabelWalls = result.stages.walls
    return walls


def surface_of(walls: LabelWalls, label: int) -> Surface:
    back, front = (walls.triangles[walls.labels[:, side] == label] for side in (0, 1))
    used, corners = np.unique(np.concatenate([back, front[:, ::-1]]), return_inverse=True)
    return Surface(vertices=walls.points[used], faces=corners.reshape(-1, 3))


def assert_parted(labels: NDArray[Any], result: Any, cell_volume: float = 1.0) -> None:
    """Every triangle has two different sides, every edge closes for both, and volumes add up to that of the box."""
    walls = walls_of(result)
    assert (walls.labels[:, 0] != walls.labels[:, 1]).all()
    assert (walls.labels[:, 0] != 0).all()
    total = 0.0
    for row in result.report["labels"]:
        surface = surface_of(walls, row["number"])
        assert surface.closed
        assert row["closed"]
        assert surface.volume == pytest.approx(row["volume"], rel=1e-6)
        total += surface.volume
    outer = surface_of(walls, 0)
    if len(outer.faces):
        assert outer.closed
        # Seen from outside, all labels together; what is left of the box is the outside.
        assert -outer.volume == pytest.approx(total, rel=1e-5)
    if (labels != 0).all() and not result.report["failed"]:
        assert total == pytest.approx(labels.size * cell_volume, rel=1e-6)


@settings(max_examples=8, deadline=None)
@given(SHAPES, st.integers(1, 9), st.integers(0, 10**6), st.sampled_from(["plain", "refine"]), st.booleans())
def test_any_labels_are_parted(shape: tuple[int, int, int], count: int, seed: int, method: Any, has_rest: bool) -> None:
    labels = voronoi(shape, count + 1, seed)
    labels[labels == 1] = 0 if has_rest else 1
    try:
        result = smooth_labels(labels, together=True, method=method, smoothing=QUICK, spacing=(0.5, 0.5, 1.2))
    except ParameterError:
        assert not labels.any()
        return
    assert_parted(labels, result, 0.3)


@settings(max_examples=6, deadline=None)
@given(st.integers(2, 8), st.integers(0, 10**6), st.booleans())
def test_the_numbers_of_labels_change_names_alone(count: int, seed: int, is_signed: bool) -> None:
    """To the rounding of the search for volumes."""
    labels = voronoi((16, 15, 14), count, seed)
    rng = np.random.default_rng(seed)
    values = rng.permutation(np.arange(1, count + 1)) * 7 - (50 if is_signed else 0)
    renamed = np.concatenate([[0], values])[labels]
    one, other = (smooth_labels(array, together=True, smoothing=QUICK, tolerance=None) for array in (labels, renamed))
    for number, value in enumerate(values, 1):
        before, after = one.surfaces[f"label_{number}"], other.surfaces[f"label_{value}"]
        assert after.volume == pytest.approx(before.volume, rel=2e-4)
        assert len(before.faces) == pytest.approx(len(after.faces), rel=0.02)
        assert cKDTree(before.vertices).query(after.vertices)[0].max() < 0.2


@pytest.mark.parametrize("name", NASTY)
def test_nasty_labels_are_parted_and_told(name: str) -> None:
    labels = np.asarray(NASTY[name]())
    values = tuple(set(np.unique(labels)) - {0})
    options: Any = {"together": True, "method": "plain", "smoothing": QUICK, "label": tuple(map(int, values))}
    result = smooth_labels(labels, **options)
    assert_parted(labels, result)
    found = {row["number"] for row in [*result.report["labels"], *result.report["failed"]]}
    assert found == set(values)


def test_labels_of_which_nothing_is_left_are_refused() -> None:
    labels = np.asarray(NASTY["a single cell"]())
    with pytest.raises(GeometryError, match="^no label is left after smoothing; give fewer steps$"):
        smooth_labels(labels, together=True, method="refine", smoothing=Smoothing(steps=20))


@pytest.mark.parametrize(("method", "rms", "most"), [("plain", 0.03, 0.2), ("refine", 0.06, 0.7)])
def test_a_lone_label_is_smoothed_as_a_volume(method: Any, rms: float, most: float) -> None:
    """Up to the cells that its surface is cut from: cubes there, tetrahedra here, which round edges differently."""
    labels = np.zeros((30, 31, 32), dtype=np.int64)
    labels[6:20, 6:20, 6:20] = labels[12:26, 12:20, 8:24] = 1
    smoothing = Smoothing(steps=10)
    alone = smooth_volume(labels, label=1, method=method, smoothing=smoothing, tolerance=None, crumbs=0.0).surface
    together = smooth_labels(labels, together=True, method=method, smoothing=smoothing, tolerance=None).surfaces[
        "label_1"
    ]
    deviation = measure_deviation(alone, together, cell=1.0)
    assert together.volume == pytest.approx(alone.volume, rel=1e-4)
    assert max(deviation.there.rms, deviation.back.rms) < rms
    assert max(deviation.there.max, deviation.back.max) < most


def test_a_label_in_several_pieces_keeps_them() -> None:
    labels = np.ones((20, 20, 30), dtype=np.int64)
    for start in (3, 13, 22):
        labels[6:13, 6:13, start : start + 5] = 2
    result = smooth_labels(labels, together=True, smoothing=QUICK)
    assert [row["components"] for row in result.report["labels"]] == [1, 3]
    assert result.report["labels"][0]["topology"]["result"]["cavities"] == 3
    assert_parted(labels, result)


@pytest.mark.parametrize("values", [(2**31 + 5, 2**32 - 1), (-(2**15), 2**15)])
def test_labels_of_all_types_keep_their_numbers(values: tuple[int, int]) -> None:
    dtype = np.uint32 if min(values) > 0 else np.int32
    labels = np.where(np.arange(12)[:, None, None] < 6, *values).astype(dtype) * np.ones((1, 12, 12), dtype=dtype)
    result = smooth_labels(labels, together=True, smoothing=QUICK)
    assert [row["number"] for row in result.report["labels"]] == list(values)
    assert set(np.unique(walls_of(result).labels)) == {0, *values}


def test_too_many_labels_are_refused_in_one_line() -> None:
    labels = np.arange(1, 2**16).reshape(-1, 17, 15)
    with pytest.raises(ParameterError, match=r"^the volume holds 65535 values, more than the 4096 labels [^\n]*$"):
        smooth_labels(labels, together=True)


def test_a_turned_volume_has_the_same_parts() -> None:
    labels = voronoi((14, 15, 16), 4)
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    plain, turned = (
        smooth_labels(Volume(values=labels, direction=direction), together=True, smoothing=QUICK)
        for direction in (np.eye(3), turn)
    )
    for name, surface in plain.surfaces.items():
        np.testing.assert_allclose(turned.surfaces[name].vertices, surface.vertices @ turn.T, atol=1e-9)
