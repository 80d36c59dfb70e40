"""The lines where three labels or more meet, made smooth.

Where three labels meet, a label may win inside a tetrahedron and at none of its corners: such pieces are left out, and
lines become jagged by a part of a cell. So their points are moved towards the middle of their neighbours on the
line, and the points beside them towards the middle of theirs. Where triangles then pass through each other, moves are
taken back.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels import junctions as line_kernels
from infill.kernels import partition as kernels
from infill.kernels.threads import in_threads, thread_count
from infill.partition.tetrahedra import FACE_SLOT
from infill.partition.walls import Shifts, WallGraph, Walls

ROUNDS = 10  # of moving towards the middle of neighbours
SHARE = 0.5  # of the way, in each
RINGS = 2  # of points beside a line that are moved with it
TAKEN_BACK_ROUNDS = 5  # of taking back moves, each with a ring of points more
ROOM = 1 << 10  # pairs of each thread, at first


def smooth_junctions(
    graph: WallGraph, walls: Walls, *, shape: tuple[int, ...] | None = None, threads: int | None = None
) -> Shifts:
    """Return shifts of points by which the lines where labels meet, and what lies beside them, become smooth.

    Points on the sides of the box, which has `shape` cells if the graph is that of a part, stay where they are.
    """
    count, triangles = thread_count(threads), walls.triangles
    is_junction = _find_junctions(graph)
    near = is_junction
    for _ in range(RINGS):
        near = _add_ring(near, triangles, count)
    moved = np.flatnonzero(near)
    moved = moved[~on_side(walls.points[moved], shape or graph.winners.shape).any(axis=1)]
    place = np.full(len(near), -1, dtype=np.int32)
    place[moved] = np.arange(len(moved))
    chosen = _touched(place >= 0, triangles, count)
    counts = np.zeros(len(moved), dtype=np.int64)
    line_kernels.count_neighbours(triangles, chosen, is_junction, place, counts)
    starts = np.concatenate([[0], counts.cumsum()])
    neighbours = np.empty(starts[-1], dtype=np.int32)
    line_kernels.list_neighbours(triangles, chosen, is_junction, place, starts[:-1].copy(), neighbours)
    before = walls.points[moved].astype(np.float64)
    after = np.empty_like(before)
    for _ in range(ROUNDS):
        in_threads(line_kernels.move_to_middles, walls.points, starts, neighbours, SHARE, before, after, threads=count)
        before, after = after, before
    return Shifts(points=moved, vectors=(before - walls.points[moved]).astype(np.float32))


def take_back_crossings(
    walls: Walls, shifts: Shifts, scale: tuple[float, ...], *, threads: int | None = None
) -> tuple[Shifts, int]:
    """Take back shifts of points whose triangles pass through others; return the rest, and how many pairs still do.

    The same shifts are returned if there was nothing to take back.

    Parameters
    ----------
    walls : Walls
        Shifted.
    shifts : Shifts
    scale : (3,) float
        Sides of a cell.
    """
    triangles, points = walls.triangles, walls.points
    changed = shifts.points
    for number in range(TAKEN_BACK_ROUNDS + 1):
        pairs = find_crossings_beside(points, triangles, changed, scale, threads=threads)
        if not len(pairs) or number == TAKEN_BACK_ROUNDS:
            break
        is_taken = mark_crossing(triangles, pairs, len(points), threads=threads)[shifts.points]
        changed = shifts.points[is_taken]
        if points is walls.points:
            points = points.copy()  # once: it is as large as all walls
        points[changed] -= shifts.vectors[is_taken]
        shifts = Shifts(points=shifts.points[~is_taken], vectors=shifts.vectors[~is_taken])
    return shifts, len(pairs)


def mark_crossing(
    triangles: NDArray[np.integer], pairs: NDArray[np.int64], points: int, *, threads: int | None = None
) -> NDArray[np.bool_]:
    """Mark the points (P,) of triangles that pass through others, pairs (N, 2), and those beside them."""
    crossing = np.zeros(points, dtype=bool)
    crossing[triangles[np.unique(pairs)]] = True
    return _add_ring(crossing, triangles, thread_count(threads))


def find_crossings_beside(
    points: NDArray[np.float32],
    triangles: NDArray[np.integer],
    moved: NDArray[np.int64],
    scale: tuple[float, ...],
    *,
    threads: int | None = None,
) -> NDArray[np.int64]:
    """Return the pairs of triangles that pass through each other beside moved points: see `find_crossings`."""
    count = thread_count(threads)
    is_moved = np.zeros(len(points), dtype=bool)
    is_moved[moved] = True
    # What a moved triangle may run into lies beside it.
    chosen = _touched(_add_ring(is_moved, triangles, count), triangles, count)
    return find_crossings(points, triangles, chosen, scale, threads=count)


def find_crossings(
    points: NDArray[np.float32],
    triangles: NDArray[np.integer],
    chosen: NDArray[np.int64],
    scale: tuple[float, ...],
    *,
    threads: int | None = None,
) -> NDArray[np.int64]:
    """Return the pairs of chosen triangles that pass through each other, (N, 2), in order, the lower number first.

    As `infill.meshes.intersections.intersecting_pairs` does; triangles are found by the cells in which they lie, which
    is faster for triangles that are all about as large as a cell.

    Parameters
    ----------
    points : (P, 3) float32
        In cells, within a box that begins at 0.
    triangles : (T, 3) int
    chosen : (N,) int64
        Numbers of triangles.
    scale : (3,) float
        Sides of a cell.
    """
    if not len(chosen):
        return np.empty((0, 2), dtype=np.int64)
    count = thread_count(threads)
    boxes, widest = np.empty((len(chosen), 2, 3), dtype=np.float32), np.zeros((count, 3), dtype=np.int64)
    in_threads(line_kernels.box_triangles, points, triangles, chosen, boxes, widest, threads=count)
    boxes -= np.floor(boxes[:, 0].min(axis=0))  # exact, and rows far from the origin need no room
    cells = boxes[:, 0].max(axis=0).astype(np.int64) + 1
    # One more plane: where rows begin is counted two places further on.
    starts, order = np.zeros((cells[0] + 1, max(cells[1], 2)), dtype=np.int64), np.empty(len(chosen), dtype=np.int64)
    line_kernels.sort_by_rows(boxes, starts, order)
    in_threads(line_kernels.sort_rows, boxes, starts, cells[2], order, threads=count)
    within = points, triangles, chosen, np.array(scale, dtype=np.float64), boxes, starts, order, widest.max(axis=0)
    room = ROOM
    while True:
        pairs = np.empty((count, room, 2), dtype=np.int64)
        numbers = in_threads(line_kernels.cross_rows, *within, pairs, threads=count)
        if max(numbers) <= room:
            return np.unique(np.concatenate([pairs[at, :number] for at, number in enumerate(numbers)]), axis=0)
        room = max(numbers)


def _add_ring(marked: NDArray[np.bool_], triangles: NDArray[np.integer], threads: int) -> NDArray[np.bool_]:
    """Mark the points (P,) of all triangles with a marked point."""
    wider = marked.copy()
    line_kernels.mark_corners(triangles, _touched(marked, triangles, threads), wider)
    return wider


def _touched(marked: NDArray[np.bool_], triangles: NDArray[np.integer], threads: int) -> NDArray[np.int64]:
    """Return the numbers of the triangles with a marked point."""
    is_touched = np.empty(len(triangles), dtype=bool)
    in_threads(line_kernels.mark_triangles, triangles, marked, is_touched, threads=threads)
    return np.flatnonzero(is_touched)


def _find_junctions(graph: WallGraph) -> NDArray[np.bool_]:
    """Mark the points in faces and insides of tetrahedra, where three labels or four meet."""
    slots = np.empty(graph.point_count, dtype=np.int8)
    kernels.name_points(graph.masks, graph.starts, slots)
    return np.asarray(slots >= FACE_SLOT)


def on_side(points: NDArray[np.floating], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark the coordinates of points that lie on a side of the box, (P, 3)."""
    return np.asarray((points <= 0) | (points >= np.array(shape)))
