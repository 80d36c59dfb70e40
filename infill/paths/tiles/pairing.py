"""Which lines of a tile are doubled, so that at every point an even number of single ones meets.

Where an odd number meets, points are taken in pairs, along the lines and as near to each other as can be; what lies
between a pair is doubled. Known as a T-join: Edmonds and Johnson, Mathematical Programming 5 (1973) 88.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.drawing import Line

Floats = NDArray[np.float64]

MOST_PAIRED = 1000


@dataclass(frozen=True, kw_only=True)
class Graph:
    """The lines of a tile on the torus.

    Parameters
    ----------
    parts : list of (N, 2) float64
        Lines between nodes, mm.
    node : (parts, 2) int
        The nodes at both ends of each.
    places : (nodes, 2) float64
        mm.
    """

    parts: list[Line]
    node: NDArray[np.intp]  # (parts, 2)
    places: Floats

    def degree(self, some: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Return how many ends of some parts meet at each node."""
        return np.bincount(self.node[some].ravel(), minlength=len(self.places))


def doubled_parts(graph: Graph) -> NDArray[np.bool_]:
    """Return which parts are to be doubled: shortest ways between nodes of odd degree, taken in pairs.

    Pairs are those nearest to each other, improved as long as exchanging the partners of two pairs makes the ways
    shorter. Where there are too many, all that hangs together with an odd node is doubled.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components, dijkstra

    doubled = np.zeros(len(graph.parts), dtype=bool)
    odd = np.flatnonzero(graph.degree(~doubled) % 2)
    if not odd.size:
        return doubled
    lengths = np.array([np.hypot(*np.diff(part, axis=0).T).sum() for part in graph.parts])
    order = np.argsort(-lengths, kind="stable")  # of parts between the same nodes, the shortest is written last
    part_of = {}
    for number in order:
        a, b = sorted(graph.node[number].tolist())
        part_of[a, b] = int(number)
    numbers = np.array(list(part_of.values()))
    a, b = graph.node[numbers].T
    count = len(graph.places)
    ways = coo_array((lengths[numbers], (a, b)), shape=(count, count)).tocsr()
    if len(odd) > MOST_PAIRED:
        _, label = connected_components(ways, directed=False)
        found: NDArray[np.bool_] = np.isin(label[graph.node[:, 0]], label[odd])
        return found
    distances, before = dijkstra(ways, directed=False, indices=odd, return_predecessors=True)
    for i, j in _pairs(distances[:, odd]):
        here = int(odd[j])
        while here != odd[i]:
            last = int(before[i, here])
            doubled[part_of[min(last, here), max(last, here)]] ^= True
            here = last
    return doubled


def _pairs(distances: Floats) -> list[tuple[int, int]]:
    """Return numbers in pairs whose distances are small in all."""
    upper = np.triu_indices(len(distances), 1)
    partner = np.full(len(distances), -1)
    for number in np.argsort(distances[upper], kind="stable"):
        i, j = upper[0][number], upper[1][number]
        if partner[i] < 0 and partner[j] < 0:
            partner[i], partner[j] = j, i
    better = True
    while better:
        better = False
        for i in range(len(partner)):
            j = partner[i]
            swapped = distances[i] + distances[j][partner]  # i with k, j with the partner of k
            gain = distances[i, j] + distances[np.arange(len(partner)), partner] - swapped
            gain[[i, j]] = 0
            k = int(np.argmax(gain))
            if gain[k] > 1e-9 * distances[i, j]:
                m = partner[k]
                partner[[i, k, j, m]] = k, i, m, j
                better = True
    return [(i, int(j)) for i, j in enumerate(partner) if i < j]
