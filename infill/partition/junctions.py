"""The lines where three labels or more meet, made smooth, and the volumes of labels restored by moving walls.

Where three labels meet, a label may win inside a tetrahedron and at none of its corners: such pieces are left out, and
lines become jagged by a part of a cell. So their points are moved towards the middle of their neighbours on the
line, and the points beside them towards the middle of theirs. Volumes that change by this are restored: each
wall between k and l moves along its normal by m_k - m_l, and the moves m solve the same Laplacian as the offsets of
`infill.partition.volumes`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.kernels import partition as kernels
from infill.partition.tetrahedra import FACE_SLOT
from infill.partition.walls import OUTSIDE, WallGraph, Walls

ROUNDS = 10  # of moving towards the middle of neighbours
SHARE = 0.5  # of the way, in each
RINGS = 2  # of points beside a line that are moved with it
RESTORING_ROUNDS = 6
PRECISION = 2e-5  # of a label's volume

Restore = Callable[[Walls, NDArray[np.float64]], NDArray[np.float64]]


def smooth_junctions(graph: WallGraph, walls: Walls) -> NDArray[np.float32]:
    """Return the points of walls with the lines where labels meet, and the points beside them, made smooth.

    Points on the sides of the box stay where they are.
    """
    is_junction = _find_junctions(graph)
    if not is_junction.any():
        return walls.points
    near = is_junction
    for _ in range(RINGS):
        touched = near[walls.triangles].any(axis=1)
        near = np.zeros_like(near)
        near[walls.triangles[touched]] = True
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
    moved &= (number > 0) & ~_on_side(points, graph.winners.shape).any(axis=1)
    for _ in range(ROUNDS):
        middles = np.stack([np.bincount(target, points[source, axis], len(used)) for axis in range(3)], axis=1)
        points[moved] += SHARE * (middles[moved] / number[moved, None] - points[moved])
    smoothed = walls.points.copy()
    smoothed[used[moved]] = points[moved]
    return smoothed


def restore_volumes(
    graph: WallGraph,
    walls: Walls,
    targets: NDArray[np.float64],
    solve: Restore,
    measure: Callable[[NDArray[np.float32]], NDArray[np.float64]],
    scale: tuple[float, ...],
) -> Walls:
    """Move walls along their normals until every label has its volume.

    Parameters
    ----------
    graph, walls : WallGraph, Walls
    targets : (labels,) float64
        Volumes, 0 for labels whose volume is not sought.
    solve : callable
        Returns how far the walls of each label move outwards, for walls and missing volumes.
    measure : callable
        Returns the volumes within points.
    scale : (3,) float
        Sides of a cell.
    """
    sides = np.array(scale)
    fixed = _on_side(walls.points, graph.winners.shape)
    sought = targets > 0
    best, smallest_error = walls, np.inf
    for _ in range(RESTORING_ROUNDS):
        missing = np.where(sought, targets - walls.volumes, 0.0)
        error = float(np.max(np.abs(missing[sought]) / targets[sought], initial=0.0))
        if error < smallest_error:
            best, smallest_error = walls, error
        if error <= PRECISION:
            break
        moves = np.append(solve(walls, missing), 0.0)  # nothing moves towards the outside
        inner = walls.sides[:, 1] != OUTSIDE
        triangles = walls.triangles[inner]
        corners = (walls.points * sides)[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(normals, axis=1)
        along = normals * (moves[walls.sides[inner, 0]] - moves[walls.sides[inner, 1]])[:, None]
        count = len(walls.points)
        total = np.zeros(count)
        shift = np.zeros((count, 3))
        for corner in range(3):
            total += np.bincount(triangles[:, corner], area, count)
            for axis in range(3):
                shift[:, axis] += np.bincount(triangles[:, corner], along[:, axis], count)
        shift /= np.maximum(total, 1e-300)[:, None] * sides
        points = walls.points + np.where(fixed, 0.0, shift).astype(np.float32)
        walls = replace(walls, points=points, volumes=measure(points))
    return best


def _find_junctions(graph: WallGraph) -> NDArray[np.bool_]:
    """Mark the points in faces and insides of tetrahedra, where three labels or four meet."""
    slots = np.empty(graph.point_count, dtype=np.int8)
    kernels.name_points(graph.masks, graph.starts, slots)
    return np.asarray(slots >= FACE_SLOT)


def _on_side(points: NDArray[np.floating], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Mark the coordinates of points that lie on a side of the box, (P, 3)."""
    return np.asarray((points <= 0) | (points >= np.array(shape)))
