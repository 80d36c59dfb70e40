"""Moves within the limits of axes, and corners at Klipper's speeds: the specification is NumPy, in `infill.planner`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _within(requested, limit, share):
    """Return a value along a move within the limit of an axis; NaN if the axis neither moves nor may."""
    most = limit / share
    return most if most < requested or most != most else requested


@njit(nogil=True, cache=True, error_model="numpy")
def limit_moves(
    delta,
    feedrate,
    setting,
    together,
    rates,
    feedrates,
    accelerations,
    lowest,
    distance,
    direction,
    alone,
    speed,
    acceleration,
    path_acceleration,
):
    """Limit moves to the speed and acceleration of the path and of every axis.

    Parameters
    ----------
    delta, feedrate, setting
        As in `infill.planner.bounds.Moves`; the feed rate is a number.
    together : bool
        Klipper's rule: the path limits x and y, and the extruder only moves that it makes alone.
    rates : (S, 5) float64
        Of each setting: the least feed rate of travel and of others, and the acceleration of travel, of others, and of
        the extruder alone.
    feedrates, accelerations : (S, 4) float64
        Of the axes; infinite where nothing limits.
    lowest : float, mm/s
    distance, direction, alone, speed, acceleration, path_acceleration
        Written: see `BoundedMoves`.
    """
    for move in range(len(feedrate)):
        x, y, z, pushed = delta[move, 0], delta[move, 1], delta[move, 2], delta[move, 3]
        of = setting[move]
        travelled = math.sqrt((x * x + z * z) + y * y)
        alone[move] = travelled == 0
        distance[move] = abs(pushed) if alone[move] else travelled
        draws = pushed != 0
        fast = max(max(feedrate[move], rates[of, 1] if draws else rates[of, 0]), lowest)
        path_acceleration[move] = rates[of, 3] if draws else rates[of, 2]
        quick = rates[of, 4] if alone[move] else path_acceleration[move]
        if together and not alone[move]:
            fast = min(fast, min(feedrates[of, 0], feedrates[of, 1]))
        for axis in range(4):
            direction[move, axis] = delta[move, axis] / distance[move]
            share = abs(direction[move, axis])
            if together and (axis < 2 or (axis == 3 and pushed > 0 and (x != 0 or y != 0))):
                share = 0.0
            fast = _within(fast, feedrates[of, axis], share)
            quick = _within(quick, accelerations[of, axis], share)
        speed[move], acceleration[move] = fast, quick


@njit(nogil=True, cache=True, error_model="numpy")
def find_corner_speeds(direction, distance, acceleration, alone, deviations, pushes, squares):
    """Find the square of the highest speed at each corner, by Klipper's square corner velocity.

    Parameters
    ----------
    direction, distance, acceleration, alone
        As in `BoundedMoves`.
    deviations, pushes : (N,) or (1,) float64
        The deviation of a corner, mm, and the most that the speed of the extruder may jump, mm/s.
    squares : (N - 1,) float64, mm²/s²
        Written.
    """
    for move in range(len(distance) - 1):
        after = move + 1
        if alone[move] or alone[after]:
            squares[move] = 0.0
            continue
        ux, uy, uz = direction[move, 0], direction[move, 1], direction[move, 2]
        wx, wy, wz = direction[after, 0], direction[after, 1], direction[after, 2]
        dx, dy, dz, tx, ty, tz = wx - ux, wy - uy, wz - uz, ux + wx, uy + wy, uz + wz
        sine = math.sqrt((dx * dx + dz * dz) + dy * dy) / 2
        cosine = math.sqrt((tx * tx + tz * tz) + ty * ty) / 2
        here, there = (move, after) if len(deviations) > 1 else (0, 0)
        scaled = min(deviations[here] * acceleration[move], deviations[there] * acceleration[after])
        circle = cosine * (1 + cosine) / (sine * sine) * scaled
        reach = min(2 * acceleration[move] * distance[move], 2 * acceleration[after] * distance[after])
        midpoint = reach * cosine / (4 * sine)
        filament = pushes[after if len(pushes) > 1 else 0] / abs(direction[after, 3] - direction[move, 3])
        highest = filament * filament
        if not circle >= highest and circle == circle:
            highest = circle
        if not midpoint >= highest and midpoint == midpoint:
            highest = midpoint
        squares[move] = highest
