"""Speeds between moves by classic jerk: the specification is `infill.planner.junctions`, in NumPy."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit

NEARLY = 0.99  # of the speed of a joint, which a start from rest must exceed


@njit(nogil=True, cache=True, error_model="numpy")
def find_rest_speeds(direction, speed, jerk, rest):
    """Find the speed with which each move begins and ends at rest.

    Parameters
    ----------
    direction : (N, 4) float64
    speed : (N,) float64, mm/s
    jerk : (N, 4) or (1, 4) float64, mm/s
    rest : (N,) float64, mm/s
        Written.
    """
    for move in range(len(speed)):
        row = move if len(jerk) > 1 else 0
        lowest = speed[move]
        for axis in range(4):
            if abs(direction[move, axis]) * speed[move] > jerk[row, axis]:
                lowest = min(lowest, jerk[row, axis])
        rest[move] = lowest


@njit(nogil=True, cache=True, error_model="numpy")
def find_joint_speeds(direction, speed, jerk, rest, joint):
    """Find the highest speed from each move to the next.

    Parameters
    ----------
    direction, speed, jerk, rest
        As in `find_rest_speeds`.
    joint : (N - 1,) float64, mm/s
        Written.
    """
    for move in range(len(speed) - 1):
        row = move + 1 if len(jerk) > 1 else 0
        slower, factor = min(speed[move], speed[move + 1]), math.inf
        for axis in range(4):
            leave, enter = direction[move, axis] * slower, direction[move + 1, axis] * speed[move + 1]
            jump = abs(leave - enter) if leave * enter > 0 else max(abs(leave), abs(enter))
            share = jerk[row, axis] / jump
            if share != share:  # no jump, and none allowed
                factor = 1.0
                break
            factor = min(factor, share)
        highest = slower * min(factor, 1.0)
        if rest[move] > NEARLY * highest and rest[move + 1] > NEARLY * highest:
            highest = min(rest[move + 1], slower)
        joint[move] = highest
