"""Components of a graph: the same whether its edges are joined here or by SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from infill import graph


@given(
    st.integers(1, 12).flatmap(
        lambda count: st.tuples(st.just(count), st.lists(st.tuples(*[st.integers(0, count - 1)] * 2)))
    )
)
def test_small_graphs_have_the_components_of_large_ones(case: tuple[int, list[tuple[int, int]]]) -> None:
    count, edges = case
    start, end = np.array(edges, dtype=np.int64).reshape(-1, 2).T
    names, number = graph.label_connected(start, end, count)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(graph, "FEW", -1)
        by_scipy, same = graph.label_connected(start, end, count)
    assert number == same
    assert names.tolist() == by_scipy.tolist()
