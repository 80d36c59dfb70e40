"""The edges, faces and tetrahedra in which the points of walls lie."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from infill.kernels import partition as kernels
from infill.partition.tetrahedra import EDGE_SLOT, FACE_SLOT, FACES, SLOTS, STEPS, TETRAHEDRA, TETRAHEDRON_SLOT
from infill.partition.walls import WallGraph

BITS = np.array([bin(number).count("1") for number in range(2**13)], dtype=np.int8)


def simplices(graph: WallGraph) -> Iterator[tuple[NDArray[np.int64], list[NDArray[np.int64]]]]:
    """Yield points of walls of one kind, and the corners between which they lie: places in the lattice, (n, 3) each.

    A point on the side of the box has one corner, itself; others have two, three or four, with as many labels.
    """
    slots = np.empty(graph.point_count, dtype=np.int8)
    kernels.name_points(graph.masks, graph.starts, slots)
    lattice = tuple(count + 2 for count in graph.winners.shape)
    bases = np.repeat(base_numbers(graph), count_bits(graph.masks))
    order = np.argsort(slots, kind="stable")
    ends = np.searchsorted(slots[order], np.arange(SLOTS + 1))
    for slot in range(SLOTS):
        chosen = order[ends[slot] : ends[slot + 1]]
        if not len(chosen):
            continue
        if slot < FACE_SLOT:
            chain: tuple[int, ...] = (0, slot - EDGE_SLOT) if slot else (0,)
        elif slot < TETRAHEDRON_SLOT:
            chain = (0, *FACES[slot - FACE_SLOT])
        else:
            chain = (0, *TETRAHEDRA[slot - TETRAHEDRON_SLOT], 7)
        places = np.stack(np.unravel_index(bases[chosen], lattice), axis=1)
        yield chosen, [places + STEPS[step] for step in chain]


def middle_points(graph: WallGraph) -> NDArray[np.float64]:
    """Return the middles of the edges, faces and tetrahedra in which the points of walls lie, (P, 3), in cells.

    With these, no tetrahedron is inside out.
    """
    middles = np.empty((graph.point_count, 3))
    for chosen, corners in simplices(graph):
        middles[chosen] = np.mean([axis_places(corner, graph.winners.shape) for corner in corners], axis=0)
    return middles


def axis_places(places: NDArray[np.integer], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return places in the lattice, (N, 3), in cells of the grid."""
    return np.asarray(np.clip(places - 0.5, 0, shape))


def cells_at(grid: NDArray[np.generic], places: NDArray[np.integer]) -> NDArray[np.generic]:
    """Return the values of cells at places in the lattice, (N,); beyond the grid, those of its last cells."""
    inner = np.clip(places - 1, 0, np.array(grid.shape) - 1)
    return np.asarray(grid[tuple(inner.T)])


def base_numbers(graph: WallGraph) -> NDArray[np.int64]:
    """Return the numbers of all bases in the lattice, (b,)."""
    columns = graph.winners.shape[2] + 2
    counts = (graph.row_starts[..., 3] - graph.row_starts[..., 0]).ravel()
    return np.asarray(np.repeat(np.arange(len(counts)), counts) * columns + graph.bases)


def count_bits(masks: NDArray[np.integer]) -> NDArray[np.int64]:
    """Count the bits of numbers below 2**26."""
    return np.asarray(BITS[masks & 8191].astype(np.int64) + BITS[masks >> 13])
