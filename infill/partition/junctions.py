"""The lines where three labels or more meet, made smooth.

Where three labels meet, a label may win inside a tetrahedron and at none of its corners: such pieces are left out, and
lines become jagged by a part of a cell. So their points are moved towards the middle of their neighbours on the
line, and the points beside them towards the middle of theirs. Where triangles then pass through each other, moves are
taken back.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.kernels import partition as kernels
from infill.meshes.intersections import intersecting_pairs
from infill.partition.tetrahedra import FACE_SLOT
from infill.partition.walls import WallGraph, Walls
from infill.surface import Surface

ROUNDS = 10  # of moving towards the middle of neighbours
SHARE = 0.5  # of the way, in each
RINGS = 2  # of points beside a line that are moved with it
TAKEN_BACK_ROUNDS = 5  # of taking back moves, each with a ring of points more


def smooth_junctions(graph: WallGraph, walls: Walls) -> NDArray[np.float32]:
    """Return the points of walls with the lines where labels meet, and the points beside them, made smooth.

    Points on the sides of the box stay where they are.
    """
    is_junction = _find_junctions(graph)
    if not is_junction.any():
        return walls.points
    near = is_junction
    for _ in range(RINGS):
        near = _add_ring(near, walls.triangles)
    triangles = walls.triangles[near[walls.triangles].any(axis=1)]
    used, corners = np.unique(triangles, return_inverse=True)
    corners = corners.reshape(-1, 3)
    junction, moved = is_junction[used], near[used]
    start, end = (np.roll(corners, -step, axis=1).ravel() for step in range(2))
    # A point on a line has neighbours on the line alone, others have all.
    counts = [junction[b] | ~junction[a] for a, b in ((start, end), (end, start))]
    source = np.concatenate([end[counts[0]], start[counts[1]]])
    target = np.concatenate([start[counts[0]], end[counts[1]]])
    number = np.bincount(target, minlength=len(used))
    points = walls.points[used].astype(np.float64)
    moved &= (number > 0) & ~on_side(points, graph.winners.shape).any(axis=1)
    for _ in range(ROUNDS):
        middles = np.stack([np.bincount(target, points[source, axis], len(used)) for axis in range(3)], axis=1)
        points[moved] += SHARE * (middles[moved] / number[moved, None] - points[moved])
    smoothed = walls.points.copy()
    smoothed[used[moved]] = points[moved]
    return smoothed


def take_back_crossings(
    walls: Walls, moved: NDArray[np.float32], scale: tuple[float, ...], *, threads: int | None = None
) -> tuple[NDArray[np.float32], int]:
    """Take back moves of points whose triangles pass through others; return the points, and how many pairs still do.

    Parameters
    ----------
    walls : Walls
        With the points before they were moved.
    moved : (P, 3) float32
        The points after it.
    scale : (3,) float
        Sides of a cell.
    """
    points, sides = moved.copy(), np.array(scale)
    is_moved = (moved != walls.points).any(axis=1)
    close = _add_ring(is_moved, walls.triangles)  # what a moved triangle may run into lies beside it
    triangles = walls.triangles[close[walls.triangles].any(axis=1)]
    for _ in range(TAKEN_BACK_ROUNDS):
        surface = Surface(vertices=points * sides, faces=triangles)
        pairs = intersecting_pairs(surface, threads=threads)
        if not len(pairs):
            return points, 0
        crossing = np.zeros(len(points), dtype=bool)
        crossing[triangles[np.unique(pairs)]] = True
        crossing = _add_ring(crossing, triangles)
        points[crossing] = walls.points[crossing]
    return points, len(intersecting_pairs(Surface(vertices=points * sides, faces=triangles), threads=threads))


def _add_ring(marked: NDArray[np.bool_], triangles: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Mark the points (P,) of all triangles with a marked point."""
    wider = marked.copy()
    wider[triangles[marked[triangles].any(axis=1)]] = True
    return wider


def _find_junctions(graph: WallGraph) -> NDArray[np.bool_]:
    """Mark the points in faces and insides of tetrahedra, where three labels or four meet."""
    slots = np.empty(graph.point_count, dtype=np.int8)
    kernels.name_points(graph.masks, graph.starts, slots)
    return np.asarray(slots >= FACE_SLOT)


def on_side(points: NDArray[np.floating], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark the coordinates of points that lie on a side of the box, (P, 3)."""
    return np.asarray((points <= 0) | (points >= np.array(shape)))
