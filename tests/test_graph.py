"""Components of a graph: those of SciPy, for graphs of every shape."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from infill.graph import label_connected


def by_scipy(start: np.ndarray, end: np.ndarray, count: int) -> tuple[list[int], int]:
    graph = coo_array((np.ones(len(start), dtype=np.int8), (start, end)), shape=(count, count))
    number, names = connected_components(graph, directed=False)
    return names.tolist(), int(number)


@given(
    st.integers(1, 12).flatmap(
        lambda count: st.tuples(st.just(count), st.lists(st.tuples(*[st.integers(0, count - 1)] * 2)))
    )
)
def test_components_are_those_of_scipy(case: tuple[int, list[tuple[int, int]]]) -> None:
    count, edges = case
    start, end = np.array(edges, dtype=np.int64).reshape(-1, 2).T
    names, number = label_connected(start, end, count)
    assert (names.tolist(), number) == by_scipy(start, end, count)


@pytest.mark.parametrize("shape", ["path", "shuffled path", "path back", "scattered", "star"])
def test_large_graphs_of_any_shape_take_few_rounds(shape: str) -> None:
    """Within the seconds of a test: a round for each node would take hours."""
    count, rng = 200_000, np.random.default_rng(0)
    nodes = rng.permutation(count) if shape == "shuffled path" else np.arange(count)
    nodes = nodes[::-1] if shape == "path back" else nodes
    start, end = nodes[:-1], nodes[1:]
    if shape == "scattered":
        start, end = rng.integers(0, count, (2, count // 2))
    if shape == "star":
        start = np.full(count - 1, count - 1)
    names, number = label_connected(start, end, count)
    assert (names.tolist(), number) == by_scipy(start, end, count)
