r"""Limit the moves of corners so that infill that touches walls keeps touching them along nearly all of that length.

An arc of turn t and setback s is shorter than the two legs that it replaces by s (2 - t / tan(t/2)), and lies up to
s tan(t/4) from them. If that is at most half of the slack, the distance by which the wall could be farther away and
still touch, the arc touches it as its legs did; else it may lose both of them, 2 s. So an arc either ends before its
legs come to touch a wall, or it loses at most `MOST_LOST` of the length that touches there. Corners at both ends of a
leg share it.
"""

from __future__ import annotations

import numpy as np

from infill.arrays import Floats, Places
from infill.kernels.compiling import log_compilation
from infill.paths.corners import corner_turns
from infill.paths.neighbours import BeadIndex

REACH = 1.1  # line widths between centre lines of a wall and of infill that touches it
MOST_LOST = 0.015  # of the length that touches walls
STEP = 0.5  # mm between places at which the distance from walls is measured; linear in between
SEEN = 1.5  # mm, the largest distance that is measured: more than REACH and a step


def touch_preserving_deviations(
    points: Floats, offsets: Places, corner: Places, layer: Places, walls: BeadIndex, *, line_width: float
) -> Floats:
    """Compute the move, mm, that costs each corner little touch with walls, (C,); infinite where nothing touches.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The paths one after another.
    offsets : (M + 1,) int
        Where each begins, and N.
    corner : (C,) int
        Inner points of the paths.
    layer : (N,) int
    walls : BeadIndex
    line_width : float, mm
    """
    turn = corner_turns(points, corner)[0]
    reach = REACH * line_width
    before, begins, ends, distance = measure_wall_touch(points, offsets, layer, walls, reach)
    reached = np.minimum(ends[corner - 1], begins[corner])  # along a leg, before it comes to touch
    spare = MOST_LOST * (before[corner - 1] + before[corner]) / 2
    quarter = np.maximum(np.tan(turn / 4), 1e-12)  # of a straight joint, which needs no arc
    shortened = np.maximum(2 - turn / np.maximum(np.tan(turn / 2), 1e-12), 1e-12)  # by an arc, over its setback
    touches = np.minimum(spare / shortened, np.maximum(reach - distance[corner], 0.0) / 2 / quarter)
    setback = np.maximum(reached, np.maximum(touches, spare / 2))
    return np.asarray(setback * quarter)


def measure_wall_touch(
    points: Floats, offsets: Places, layer: Places, walls: BeadIndex, reach: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """Measure how much of each leg lies near walls, its distance from both ends, and that of walls from the start.

    Near is within `reach`.

    Returns
    -------
    amount : (N,) float64, mm
        Of the leg that begins at each point; 0 for the last of a path.
    begins, ends : (N,) float64, mm
        Distance of that part from the leg's beginning, and from its end; infinite where the leg touches no wall.
    near : (N,) float64, mm
        Up to `SEEN`.
    """
    from infill.kernels.wall_touch import measure_touch

    is_last = np.zeros(len(points), dtype=bool)
    is_last[offsets[1:] - 1] = True
    length = np.append(np.hypot(*np.diff(points, axis=0).T), 0.0)
    length[is_last] = 0.0
    slot = walls.slots(layer)
    amount, begins, ends, near = (np.empty(len(points)) for _ in range(4))
    box = np.concatenate([walls.low, walls.high])
    with log_compilation("corners"):
        measure_touch(
            *walls.grid.squares,
            points,
            is_last,
            length,
            slot,
            walls.pitch,
            box,
            STEP,
            SEEN,
            reach,
            amount,
            begins,
            ends,
            near,
        )
    return amount, begins, ends, near
