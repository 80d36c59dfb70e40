"""Components of a graph."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def label_connected(
    start: NDArray[np.integer[Any]], end: NDArray[np.integer[Any]], count: int
) -> tuple[NDArray[np.int32], int]:
    """Label the components of a graph; return the component of each node, and the number of components.

    Parameters
    ----------
    start, end : (E,) int
        Nodes at the ends of each edge.
    count : int
        Number of nodes.

    >>> names, number = label_connected(np.array([0, 3]), np.array([2, 3]), 4)
    >>> names.tolist(), number
    ([0, 1, 0, 2], 3)
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(start), dtype=np.int8), (start, end)), shape=(count, count))
    number, names = connected_components(graph, directed=False)
    return names, int(number)
