"""What became of components: one comparison, whoever labelled them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy import ndimage

from infill import Smoothing
from infill.inspection import component_matching as fates
from infill.inspection.component_matching import compare_components, count_overlaps, sum_overlaps
from infill.isosurfaces.components import data_bits, find_components, shared_cells, solid_bits
from infill.phasefield.sparse import smooth_bricks


def labels(text: str) -> np.ndarray:
    return np.array([int(each) for each in text])


def test_each_fate_by_name() -> None:
    """Number 1 vanishes, 2 breaks into 1 and 2, 3 runs into 2 as well, and 3 comes out of nothing."""
    found = compare_components(count_overlaps(labels("1102220300"), labels("0001020203")))
    assert found.vanished.tolist() == [0]
    assert found.broken.tolist() == [1]
    assert found.fused.tolist() == [1]
    assert found.appeared.tolist() == [2]
    assert (found.breaks, found.fusions) == (1, 1)


def test_crumbs_and_small_pieces_do_not_count() -> None:
    before, after = labels("111111110222222220"), labels("111111220333333310")
    assert compare_components(count_overlaps(before, after)).broken.tolist() == [0, 1]
    assert compare_components(count_overlaps(before, after), part=3).broken.tolist() == []
    assert compare_components(count_overlaps(before, after)).fused.tolist() == [0]
    assert compare_components(count_overlaps(before, after), piece=2).fused.tolist() == []
    assert compare_components(count_overlaps(before, after), counted=np.array([True, False])).fused.tolist() == []


@given(seed=st.integers(0, 2**20), size=st.integers(1, 60))
def test_a_table_and_sorting_say_the_same(seed: int, size: int) -> None:
    rng = np.random.default_rng(seed)
    before, after = rng.integers(0, 5, size), rng.integers(0, 4, size)
    table, limit = count_overlaps(before, after), fates.TABLE
    fates.TABLE = 0
    try:
        by_sorting = count_overlaps(before, after)
    finally:
        fates.TABLE = limit
    for name in ("one", "other", "cells"):
        assert np.array_equal(getattr(table, name), getattr(by_sorting, name))
    assert table.cells.sum() == ((before > 0) & (after > 0)).sum()


@pytest.mark.slow
@given(
    shape=st.tuples(st.integers(1, 20), st.integers(1, 20), st.integers(1, 40)),
    density=st.floats(0.1, 0.9),
    steps=st.integers(1, 4),
    seed=st.integers(0, 2**20),
)
@example(shape=(20, 20, 40), density=0.99, steps=1, seed=0)  # a brick that is solid throughout
def test_bricks_overlap_as_whole_arrays_do(shape: tuple[int, ...], density: float, steps: int, seed: int) -> None:
    """Two labellers, of runs of bits and of SciPy: the same components share as many cells."""
    f = ndimage.gaussian_filter(np.random.default_rng(seed).random(shape), 1.0)
    solid = f < np.quantile(f, density)
    field = smooth_bricks(solid, Smoothing(steps=steps))
    before, after = find_components(field, data_bits(field)), find_components(field, solid_bits(field))
    of_bricks = sum_overlaps(shared_cells(before, after), before=before.count, after=after.count)
    of_arrays = count_overlaps(ndimage.label(solid)[0], ndimage.label(field.to_dense() > 0)[0])
    assert (of_bricks.before, of_bricks.after) == (of_arrays.before, of_arrays.after)
    one, other = compare_components(of_bricks, part=3, piece=5), compare_components(of_arrays, part=3, piece=5)
    for name in ("vanished", "appeared", "broken", "fused"):
        assert len(getattr(one, name)) == len(getattr(other, name))
    assert (one.breaks, one.fusions) == (other.breaks, other.fusions)
