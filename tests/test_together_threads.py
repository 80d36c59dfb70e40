"""Labels together do not depend on the number of threads, however large the volume is: every sum is of whole numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_together import fields_of, voronoi

from infill import smooth_labels
from infill.partition import fields as partition_fields
from infill.partition import volumes as partition_volumes
from infill.partition.fields import brick_stride
from infill.partition.volumes import areas_of_sums, keep_volumes, neighbour_areas, sum_areas
from infill.partition.walls import place_walls, sum_volumes, trace_walls, volumes_of_sums


@pytest.fixture
def sampled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take samples of a small volume as of a large one."""
    monkeypatch.setattr(partition_fields, "SAMPLED_BRICKS", 20)
    monkeypatch.setattr(partition_fields, "SAMPLES", 4000)
    monkeypatch.setattr(partition_volumes, "SAMPLED", 2000)


@pytest.mark.usefixtures("sampled")
@pytest.mark.parametrize("method", ["plain", "auto"])
def test_any_number_of_threads_gives_the_same_bits(method: Any) -> None:
    labels = voronoi((40, 34, 38), 14)
    labels[:9] = 0
    results = [
        smooth_labels(labels, together=True, method=method, tolerance=None, threads=threads) for threads in (1, 2, 5)
    ]
    first = results[0].stages.partition
    for result in results[1:]:
        other = result.stages.partition
        assert np.array_equal(other.offsets, first.offsets)
        assert np.array_equal(other.walls.points, first.walls.points)
        assert np.array_equal(other.walls.volumes, first.walls.volumes)
    changes = [keys["volume_change"] for keys in results[0].report["labels"]]
    assert np.abs(changes).max() < 1e-4


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), parts=st.integers(2, 5))
def test_volumes_and_areas_of_parts_add_up_to_the_bit(seed: int, parts: int) -> None:
    labels = voronoi((12, 13, 14), 6, seed)
    fields = fields_of(labels)
    graph = trace_walls(fields.winners(np.zeros(fields.count)))
    walls = place_walls(graph, fields, np.zeros(fields.count))
    scale = (1.0, 1.3, 1.7)
    part = np.random.default_rng(seed).integers(0, parts, len(graph.triangles))
    volumes = areas = 0
    for number in range(parts):
        chosen = graph.triangles[part == number], graph.sides[part == number]
        volumes = volumes + sum_volumes(walls.points, *chosen, fields.count, scale=scale)
        areas = areas + areas_of_sums(*sum_areas(walls.points, *chosen, fields.count, scale, 3), 3, fields.count)
    whole = sum_volumes(walls.points, graph.triangles, graph.sides, fields.count, scale=scale)
    assert np.array_equal(volumes, whole)
    assert abs(areas - neighbour_areas(walls, fields.count, scale, 3)).max() == 0
    exact = np.zeros(fields.count)
    a, b, c = (walls.points[graph.triangles[:, side]] * np.array(scale) for side in range(3))
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    np.add.at(exact, graph.sides[:, 0], six / 6)
    inner = graph.sides[:, 1] >= 0
    np.subtract.at(exact, graph.sides[inner, 1], six[inner] / 6)
    assert volumes_of_sums(whole, labels.shape, scale)[1:] == pytest.approx(exact[1:], rel=1e-9)


def test_a_sample_is_about_as_good_as_all() -> None:
    labels = voronoi((30, 30, 30), 5)
    fields = fields_of(labels)
    walls = place_walls(trace_walls(fields.winners(np.zeros(fields.count))), fields, np.zeros(fields.count))
    whole, sample = (neighbour_areas(walls, fields.count, (1, 1, 1), stride).toarray() for stride in (1, 4))
    assert sample.sum() == pytest.approx(whole.sum(), rel=0.1)
    rises = fields.rises(1)
    assert len(fields.rises(4)) == pytest.approx(len(rises) / 4, rel=0.3)
    assert brick_stride(len(fields.values)) == 1
    volumes = np.bincount(labels.ravel(), minlength=fields.count)
    assert keep_volumes(fields, volumes).walls.volumes[1:] == pytest.approx(volumes[1:], rel=1e-4)
