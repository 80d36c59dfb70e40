"""The points of walls and the corners of cells between which they lie: middles, and marks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels import wall_points as kernels
from infill.kernels.threads import in_threads, thread_count
from infill.partition.walls import CUTTING, SLOTS_AT, WallGraph


def place_middles(graph: WallGraph, *, corner: tuple[int, ...], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return the middles of the edges, faces and tetrahedra in which points lie, (P, 3), in cells of the whole grid.

    Parameters
    ----------
    graph : WallGraph
        Of a part of the grid.
    corner : (3,) int
        The cell at which the part begins.
    shape : (3,) int
        Cells of the whole grid.

    See `infill.partition.simplices.middle_points` for the specification.
    """
    middles = np.empty((graph.point_count, 3))
    place = np.array(shape, dtype=np.int64), np.array(corner, dtype=np.int64)
    kernels.place_middles(*CUTTING, SLOTS_AT, *graph.rows, *place, middles)
    return middles


def mark_far(
    graph: WallGraph,
    points: NDArray[np.float32],
    cell_size: NDArray[np.float64],
    limit: float,
    far: NDArray[np.bool_],
    *,
    threads: int | None = None,
) -> None:
    """Mark the cells (n0, n1, n2) at the corners of simplices whose point (P, 3) lies over `limit` from the middle."""
    sides = np.asarray(cell_size, dtype=np.float64)
    within = *CUTTING, SLOTS_AT, *graph.rows
    in_threads(kernels.mark_far, *within, points, sides, float(limit), far, threads=thread_count(threads))


def mark_beside(graph: WallGraph, cells: NDArray[np.bool_], *, threads: int | None = None) -> NDArray[np.bool_]:
    """Mark the points of walls (P,) whose edge, face or tetrahedron has a corner in a marked cell."""
    is_beside = np.empty(graph.point_count, dtype=bool)
    within = *CUTTING, SLOTS_AT, *graph.rows
    in_threads(kernels.mark_beside, *within, cells, is_beside, threads=thread_count(threads))
    return is_beside


def mark_labels(
    graph: WallGraph, is_marked: NDArray[np.bool_], labels: int, *, threads: int | None = None
) -> NDArray[np.bool_]:
    """Mark the labels (labels,) that have a triangle with a marked point (P,)."""
    count = thread_count(threads)
    marks = np.zeros((count, labels), dtype=bool)
    in_threads(kernels.mark_labels, graph.triangles, graph.sides, is_marked, marks, threads=count)
    return np.asarray(marks.any(axis=0))
