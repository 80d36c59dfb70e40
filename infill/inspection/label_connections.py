"""Count the components, cavities and tunnels of every label of a partition."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from infill.inspection.changes import ConnectionCounts
from infill.partition.walls import count_parts

# Cells are neighbours along every edge of the tetrahedra that they are cut into, those of a label and those beside it.
NEIGHBOURS = np.array(
    [[[1, 1, 0], [1, 1, 0], [0, 0, 0]], [[1, 1, 0], [1, 1, 1], [0, 1, 1]], [[0, 0, 0], [0, 1, 1], [0, 1, 1]]]
)


def count_connections(winners: NDArray[np.uint16], count: int, *, threads: int | None = None) -> list[ConnectionCounts]:
    """Count the connections of every label, 0 first; that of 0 counts nothing.

    Components and cavities are those of cells; tunnels follow from them and the Euler number of the surface, which is
    its number of points less half the number of its triangles.

    Parameters
    ----------
    winners : (n0, n1, n2) uint16
        The label of every cell.
    count : int
        Labels, 0 among them.
    """
    points, triangles = count_parts(winners, count, threads=threads)
    euler = points - triangles // 2
    grids: list[Any] = [_find_box_of_rest(winners), *ndimage.find_objects(winners, max_label=count - 1)]
    regions = [_find_regions(winners, box, number) for number, box in enumerate(grids)]
    owners = np.repeat(np.arange(count), [len(region) for region in regions])
    boxes = np.concatenate(regions)
    counts = [ConnectionCounts.of(components=0, cavities=0, tunnels=0)]
    for number, region in enumerate(regions[1:], 1):
        cavities = 0
        if len(region):
            low, high = region[:, 0].min(axis=0), region[:, 1].max(axis=0)
            inside = (boxes[:, 0] > low).all(axis=1) & (boxes[:, 1] < high).all(axis=1)
            if (owners[inside] != number).any():  # else nothing can be enclosed
                solid = winners[tuple(map(slice, low, high))] == number
                cavities = ndimage.label(np.pad(~solid, 1, constant_values=True), structure=NEIGHBOURS)[1] - 1
        tunnels = len(region) + cavities - int(euler[number]) // 2
        counts.append(ConnectionCounts.of(components=len(region), cavities=cavities, tunnels=tunnels))
    return counts


def _find_box_of_rest(winners: NDArray[np.uint16]) -> tuple[slice, ...] | None:
    """Return the whole grid if it has cells of label 0, else None."""
    return None if winners.all() else tuple(slice(0, count) for count in winners.shape)


def _find_regions(winners: NDArray[np.uint16], box: tuple[slice, ...] | None, number: int) -> NDArray[np.int64]:
    """Return the boxes of the components of a label, (n, 2, 3): from low to high, exclusive; `box` holds all of it."""
    if box is None:
        return np.empty((0, 2, 3), dtype=np.int64)
    components, _ = ndimage.label(winners[box] == number, structure=NEIGHBOURS)
    corner = np.array([axis.start for axis in box])
    ends = [
        [[axis.start for axis in place], [axis.stop for axis in place]] for place in ndimage.find_objects(components)
    ]
    return np.asarray(np.array(ends, dtype=np.int64).reshape(-1, 2, 3) + corner)
