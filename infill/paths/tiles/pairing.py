"""Choose the lines of a tile to double, so that at every point an even number of single ones meets.

Points where an odd number meets are paired, along the lines and as close to each other as possible; the lines between
a pair are doubled. Known as a T-join: Edmonds and Johnson, Mathematical Programming 5 (1973) 88.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.drawing import Line

MOST_PAIRED = 1000


@dataclass(frozen=True, kw_only=True)
class TileGraph:
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

    def degree(self, chosen: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Count the ends of some parts at each node."""
        return np.bincount(self.node[chosen].ravel(), minlength=len(self.places))


def choose_doubled_parts(graph: TileGraph) -> NDArray[np.bool_]:
    """Choose the parts to double: shortest ways between nodes of odd degree, taken in pairs.

    Pairs are the nearest ones, improved as long as exchanging the partners of two pairs makes the ways shorter. With
    too many odd nodes, every part connected to an odd node is doubled.
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
        is_connected: NDArray[np.bool_] = np.isin(label[graph.node[:, 0]], label[odd])
        return is_connected
    distances, before = dijkstra(ways, directed=False, indices=odd, return_predecessors=True)
    for i, j in _pair_nodes(distances[:, odd]):
        node = int(odd[j])
        while node != odd[i]:
            previous = int(before[i, node])
            doubled[part_of[min(previous, node), max(previous, node)]] ^= True
            node = previous
    return doubled


def _pair_nodes(distances: Floats) -> list[tuple[int, int]]:
    """Pair numbers so that the sum of distances is small."""
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
