"""Arcs of circles through runs of points of a path, as long as they stay near it."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit

FEWEST_SEGMENTS = 2  # of a path for which one arc may stand
MOST_SEGMENTS = 4096
BETWEEN = 1.5  # times the deviation of the points that segments may lie off, which are chords of a curve
LARGEST_TURN = 4.0  # radians of one arc: more, and its ends lie so near each other that they hardly define its circle
LARGEST_STEP = 1.1  # radians that one segment may turn
SMALLEST_RADIUS, LARGEST_RADIUS = 0.25, 500.0  # mm


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _fit_arc(points, first, last, deviation):
    """Return the centre and the turn of the arc from one point of a path to another; a turn of 0 if there is none.

    Its centre lies on the line halfway between its ends, where the squares of the distances of the points between them
    from the circle are smallest. With the ends at (±a, 0), the circle around (0, t) is u² + v² − 2 v t = a².
    """
    ax, ay, bx, by = points[first, 0], points[first, 1], points[last, 0], points[last, 1]
    half = math.hypot(bx - ax, by - ay) / 2
    if half < 1e-3:
        return 0.0, 0.0, 0.0
    mx, my = (ax + bx) / 2, (ay + by) / 2
    ux, uy = (bx - ax) / (2 * half), (by - ay) / (2 * half)
    above, below = 0.0, 0.0
    for k in range(first + 1, last):
        px, py = points[k, 0] - mx, points[k, 1] - my
        u, v = px * ux + py * uy, py * ux - px * uy
        above += v * (u * u + v * v - half * half)
        below += 2 * v * v
    if below < 1e-12:
        return 0.0, 0.0, 0.0
    t = above / below
    cx, cy, radius = mx - t * uy, my + t * ux, math.hypot(half, t)
    if radius < SMALLEST_RADIUS or radius > LARGEST_RADIUS:
        return 0.0, 0.0, 0.0
    turn = 0.0
    x, y = ax - cx, ay - cy
    for k in range(first + 1, last + 1):
        nx, ny = points[k, 0] - cx, points[k, 1] - cy
        step = math.atan2(x * ny - y * nx, x * nx + y * ny)
        if abs(step) < 1e-9 or abs(step) > LARGEST_STEP or step * turn < 0:
            return 0.0, 0.0, 0.0
        turn += step
        if abs(turn) > LARGEST_TURN:
            return 0.0, 0.0, 0.0
        # A segment is farthest from the circle at an end, or where it is nearest to the centre, as chords are.
        off = math.hypot(nx, ny) - radius
        length = math.hypot(nx - x, ny - y)
        near = abs(x * ny - y * nx) / max(length, 1e-12)
        share = -(x * (nx - x) + y * (ny - y)) / max(length * length, 1e-24)
        if abs(off) > deviation or (0 < share < 1 and abs(near - radius) > BETWEEN * deviation):
            return 0.0, 0.0, 0.0
        x, y = nx, ny
    return cx, cy, turn


@njit(nogil=True, cache=True, error_model="numpy")
def fit_arcs(points, first, stops, deviation, end, centre, turn):
    """Cut paths into arcs, as long as possible one after another, and single segments; return the number of both.

    Parameters
    ----------
    points : (N, 2) float64
    first : (M + 1,) int64
        Path i has the points `first[i]` to `first[i + 1]`.
    stops : (N,) bool
        Points that no arc passes.
    deviation : float
        Of an arc from its points, at most; from the segments between them, `BETWEEN` times that.
    end : (N,) int64, output
        The point at which each arc or segment ends; those before it ended at its beginning, unless a path begins there.
    centre : (N, 2) float64, output
    turn : (N,) float64, output
        Radians, positive counterclockwise; 0 for segments.
    """
    count = 0
    for path in range(len(first) - 1):
        at, close = first[path], first[path + 1] - 1
        while at < close:
            goal = at + 1
            while goal < close and goal - at < MOST_SEGMENTS and not stops[goal]:
                goal += 1
            best, best_x, best_y, best_turn = at + 1, 0.0, 0.0, 0.0
            # Longer and longer arcs until one fails; then halve the interval between it and the last one that holds.
            failed, step, trial = 0, FEWEST_SEGMENTS, at + FEWEST_SEGMENTS
            while trial <= goal and failed == 0:
                cx, cy, angle = _fit_arc(points, at, trial, deviation)
                if angle == 0:
                    failed = trial
                else:
                    best, best_x, best_y, best_turn = trial, cx, cy, angle
                    if trial == goal:
                        break
                    step *= 2
                    trial = min(trial + step, goal)
            while best_turn != 0 and failed - best > 1:
                trial = (best + failed) // 2
                cx, cy, angle = _fit_arc(points, at, trial, deviation)
                if angle == 0:
                    failed = trial
                else:
                    best, best_x, best_y, best_turn = trial, cx, cy, angle
            end[count], centre[count, 0], centre[count, 1], turn[count] = best, best_x, best_y, best_turn
            count += 1
            at = best
    return count
