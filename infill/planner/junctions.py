"""Highest speed from one move to the next: four models of a planner, all joints at once.

A joint between moves of unit directions u and w turns by phi, with sin(phi / 2) = |w - u| / 2 and cos(phi / 2) =
|w + u| / 2. These are exact for the smallest turns, where 1 - cos(phi) has lost every digit. Everything is a square of
a speed, mm²/s².
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.limits import Limits
from infill.kernels.compiling import is_compiler_loaded, log_compilation
from infill.planner.bounds import BoundedMoves, Moves, limit_values, row_lengths

Limit = Callable[[str], Floats]
SMALL_SEGMENT = 1.0  # mm: below it Marlin takes the corner for part of an arc,
SMALL_TURN = np.pi / 4  # where it turns less than this


def joint_limits(moves: Moves, bounds: BoundedMoves, limits: Sequence[Limits]) -> Floats:
    """Return the square of the highest speed before, between and after moves, (N + 1,), mm²/s².

    The machine starts and ends at rest. The speeds of the moves themselves limit the joints as well.
    """

    def limit(name: str) -> Floats:
        """Return a limit for every move."""
        return limit_values(limits, name, moves.setting)

    inside, at_rest = _MODELS[limits[0].model]
    cruise, rest = bounds.speed**2, at_rest(bounds, limit) ** 2
    joints = np.empty(len(cruise) + 1)
    joints[0], joints[-1] = rest[0], rest[-1]
    if len(cruise) > 1:
        inner = np.minimum(inside(bounds, limit), np.minimum(cruise[:-1], cruise[1:]))
        joints[1:-1] = np.where(moves.stop[1:], np.minimum(rest[:-1], rest[1:]), inner)
    return joints


def _select_limits(limit: Floats, which: slice) -> Floats:
    """Select the limits of some moves; a single limit holds for all."""
    return limit if len(limit) == 1 else limit[which]


BEFORE, AFTER = slice(None, -1), slice(1, None)


def _half_turn_sin_cos(direction: Floats) -> tuple[Floats, Floats]:
    """Return sin and cos of half the angle by which each unit vector turns into the next, (N - 1,) both."""
    difference, total = np.diff(direction, axis=0), direction[:-1] + direction[1:]
    return row_lengths(difference) / 2, row_lengths(total) / 2


def _square_corner(bounds: BoundedMoves, limit: Limit) -> Floats:
    """Return the square of the highest speed at each corner, mm²/s², by Klipper's square corner velocity.

    With s = cos(phi / 2), the circle that leaves the corner by the deviation J allows v² = a J s / (1 - s), where J
    gives the square corner velocity c at a right angle: a J = c² (sqrt(2) - 1). The circle must touch both moves
    before their middles: v² <= a d / 2 · cot(phi / 2). And filament may not jump by more than its own velocity.
    """
    modal = limit("acceleration")
    deviation = limit("square_corner_velocity") ** 2 * (np.sqrt(2) - 1) / modal
    if is_compiler_loaded():
        return find_compiled_corners(bounds, deviation, limit("corner_extrusion_velocity"))
    sine, cosine = _half_turn_sin_cos(bounds.direction[:, :3])
    scaled = deviation * bounds.acceleration
    with np.errstate(divide="ignore", invalid="ignore"):
        circle = cosine * (1 + cosine) / sine**2 * np.minimum(scaled[:-1], scaled[1:])
        midpoint = np.minimum(bounds.reach[:-1], bounds.reach[1:]) * cosine / (4 * sine)
        filament = _select_limits(limit("corner_extrusion_velocity"), AFTER) / np.abs(np.diff(bounds.direction[:, 3]))
    joints = np.asarray(np.fmin(np.fmin(circle, midpoint), filament**2))
    joints[bounds.turning_only[:-1] | bounds.turning_only[1:]] = 0.0
    return joints


def find_compiled_corners(bounds: BoundedMoves, deviation: Floats, push: Floats) -> Floats:
    """Return the same as `_square_corner`, by compiled loops, from the deviation and the jump of the extruder."""
    from infill.kernels.moves import find_corner_speeds

    squares = np.empty(len(bounds.speed) - 1)
    with log_compilation("speeds"):
        find_corner_speeds(
            bounds.direction, bounds.distance, bounds.acceleration, bounds.turning_only, deviation, push, squares
        )
    return squares


def _junction_deviation(bounds: BoundedMoves, limit: Limit) -> Floats:
    """Return the square of the highest speed at each corner, mm²/s², by Marlin's rule in four dimensions.

    v² = a J s / (1 - s) with s = cos(phi / 2), where a is what the axes allow towards the inside of the corner; where
    a move shorter than 1 mm turns by less than 45 degrees, it is an arc of its length, v² <= a d / phi.
    """
    unit = bounds.direction / row_lengths(bounds.direction)[:, None]
    sine, cosine = _half_turn_sin_cos(unit)
    length = np.minimum(bounds.distance[:-1], bounds.distance[1:])
    inwards = np.abs(np.diff(unit, axis=0))
    acceleration = np.minimum(bounds.acceleration[:-1], bounds.acceleration[1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        inwards /= 2 * sine[:, None]
        axes = _select_limits(limit("axis_acceleration"), AFTER) / inwards
        acceleration = np.fmin(acceleration, np.nanmin(np.where(inwards > 0, axes, np.inf), axis=1))
        circle = acceleration * _select_limits(limit("junction_deviation"), AFTER) * cosine * (1 + cosine) / sine**2
        turn = 2 * np.arctan2(sine, cosine)
        arc = np.where((length < SMALL_SEGMENT) & (turn < SMALL_TURN), length * acceleration / turn, np.inf)
    return np.asarray(np.fmin(np.fmin(circle, arc), np.inf))


def _jerk(bounds: BoundedMoves, limit: Limit) -> Floats:
    """Return the square of the highest speed at each corner, mm²/s², by classic jerk.

    The velocity of no axis may jump by more than its jerk; a reversal counts its larger side.

    The speed of the joint is the lower one of both moves, scaled down until every axis agrees; or that of a start
    from rest, if both moves allow it. Two things are asymmetric, in firmware of this model and in the estimates of
    slicers, and so in this function: jumps are measured with the later move's own speed, not with that of the joint,
    and the later move's start from rest counts.
    """
    if is_compiler_loaded():
        return find_compiled_jerk(bounds, limit("jerk"))
    slower = np.minimum(bounds.speed[:-1], bounds.speed[1:])
    leave = bounds.direction[:-1] * slower[:, None]
    enter = bounds.direction[1:] * bounds.speed[1:, None]
    jump = np.where(leave * enter > 0, np.abs(leave - enter), np.maximum(np.abs(leave), np.abs(enter)))
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.fmin((_select_limits(limit("jerk"), AFTER) / jump).min(axis=1), 1.0)
    joint = slower * factor
    rest = _rest_speed(bounds, limit)
    both = (rest[:-1] > 0.99 * joint) & (rest[1:] > 0.99 * joint)
    return np.asarray(np.where(both, np.minimum(rest[1:], slower), joint) ** 2)


def _rest_speed(bounds: BoundedMoves, limit: Limit) -> NDArray[np.float64]:
    """Return the speed with which moves begin and end at rest, mm/s: the smallest jerk of all axes involved."""
    jerk = limit("jerk")
    if is_compiler_loaded():
        return find_compiled_rest(bounds, jerk)
    meets = np.abs(bounds.direction) * bounds.speed[:, None] > jerk
    return np.asarray(np.minimum(bounds.speed, np.where(meets, jerk, np.inf).min(axis=1)))


def find_compiled_jerk(bounds: BoundedMoves, jerk: Floats) -> Floats:
    """Return the same as `_jerk`, by compiled loops."""
    from infill.kernels.jerk import find_joint_speeds

    joint, rest = np.empty(len(bounds.speed) - 1), find_compiled_rest(bounds, jerk)
    with log_compilation("speeds"):
        find_joint_speeds(bounds.direction, bounds.speed, jerk, rest, joint)
    return joint**2


def find_compiled_rest(bounds: BoundedMoves, jerk: Floats) -> Floats:
    """Return the same as `_rest_speed`, by compiled loops."""
    from infill.kernels.jerk import find_rest_speeds

    rest = np.empty(len(bounds.speed))
    with log_compilation("speeds"):
        find_rest_speeds(bounds.direction, bounds.speed, jerk, rest)
    return rest


def _vector_jerk(bounds: BoundedMoves, limit: Limit) -> Floats:
    """Return the square of the highest speed at each corner, mm²/s², by old classic jerk: x and y jump as a vector.

    Every move counts with its own speed.
    """
    jump = np.abs(np.diff(bounds.direction * bounds.speed[:, None], axis=0))
    jump[:, 0] = np.hypot(jump[:, 0], jump[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.fmin((_select_limits(limit("jerk"), AFTER) / jump)[:, [0, 2, 3]].min(axis=1), 1.0)
    return np.asarray(np.minimum(bounds.speed[:-1], bounds.speed[1:] * factor) ** 2)


def _vector_rest_speed(bounds: BoundedMoves, limit: Limit) -> Floats:
    """Return the speed with which moves begin and end at rest, mm/s: half the jerk of x and y, or of z or e if less."""
    half = limit("jerk") / 2
    meets = np.abs(bounds.direction) * bounds.speed[:, None] > half
    meets[:, :2] = [True, False]
    return np.asarray(np.minimum(bounds.speed, np.where(meets, half, np.inf).min(axis=1)))


def _zero_rest_speed(bounds: BoundedMoves, limit: Limit) -> Floats:  # noqa: ARG001 - no limit matters
    """Return the speed with which moves begin and end at rest, mm/s: 0, as these models have no jerk."""
    return np.zeros(len(bounds.speed))


# Highest speeds at joints, and at a start from rest or an end, by model.
_MODELS: Final[dict[str, tuple[Callable[[BoundedMoves, Limit], Floats], Callable[[BoundedMoves, Limit], Floats]]]] = {
    "jerk": (_jerk, _rest_speed),
    "vector-jerk": (_vector_jerk, _vector_rest_speed),
    "junction": (_junction_deviation, _zero_rest_speed),
    "klipper": (_square_corner, _zero_rest_speed),
}
