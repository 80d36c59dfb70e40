"""The planner: the speed of each move, with trapezoids of speed and look-ahead over all moves.

Along a move the square of the speed changes by at most 2 a d. With S the sum of that over the moves so far, and c
the squares of the highest speeds at the joints, a planner with unlimited look-ahead gives joint j

    u_j = min over i of c_i + |S_j - S_i|,

the greatest profile within all limits. Both halves of it are found without a loop over moves, from windows of 1, 2,
4 … of them, whose reach is a sum of positive numbers. So no digit is lost, however far the machine can speed up
before or after, and a move has the same plan in any surroundings. A joint is settled if its u is the same whether the
machine stops after the last known move or drives on for ever, so long files are planned in pieces, each from the
last settled joint.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.limits import Limits
from infill.paths.speeds import look_ahead
from infill.planner.bounds import BoundedMoves, Moves, bound_moves, limit_values
from infill.planner.junctions import joint_limits
from infill.planner.struct_of_arrays import concatenate_rows, slice_rows

ROUNDING = 1e-9  # of a profile: its sums are exact to 1e-14, and places in a file to 1e-12

MOVES_AT_ONCE = 1 << 16  # moves planned at once


@dataclass(frozen=True, kw_only=True)
class MotionPlan:
    """Times and speeds of moves.

    Parameters
    ----------
    seconds : (N,) float64
    entry, peak, exit : (N,) float64
        Speeds, mm/s along the move (of filament where nothing else moves).
    """

    seconds: Floats
    entry: Floats
    peak: Floats
    exit: Floats

    def __len__(self) -> int:
        return len(self.seconds)


EMPTY_PLAN = MotionPlan(seconds=np.empty(0), entry=np.empty(0), peak=np.empty(0), exit=np.empty(0))


def plan_moves(moves: Moves, limits: Sequence[Limits]) -> MotionPlan:
    """Plan moves from rest to rest.

    Parameters
    ----------
    moves : Moves
    limits : sequence of Limits
        The limits that `moves.setting` counts; all of one model.

    Returns
    -------
    MotionPlan
    """
    plans, entry, begin, end = [], None, 0, 0
    while begin < len(moves):
        end = min(end + MOVES_AT_ONCE, len(moves))
        settled, settled_plan, entry = plan_settled(
            slice_rows(moves, slice(begin, end)), limits, entry, ends=end == len(moves)
        )
        plans.append(settled_plan)
        begin += settled
    return concatenate_rows(plans) if plans else EMPTY_PLAN


def plan_settled(
    moves: Moves, limits: Sequence[Limits], entry: float | None, *, ends: bool
) -> tuple[int, MotionPlan, float | None]:
    """Plan the moves at the front whose plan does not depend on later moves.

    Parameters
    ----------
    moves : Moves
    limits : sequence of Limits
    entry : float, optional
        Square of the speed before the first move, as returned by the previous call; None for rest.
    ends : bool
        The machine rests after the last move; else more moves follow.

    Returns
    -------
    settled : int
        Number of planned moves, from the front.
    plan : MotionPlan
        Plan of these moves.
    exit : float or None
        Square of the speed after them.
    """
    if not len(moves):
        return 0, EMPTY_PLAN, entry
    bounds = bound_moves(moves, limits)
    joints = joint_limits(moves, bounds, limits)
    if entry is not None:
        joints[0] = entry
    if not ends:
        joints[-1] = bounds.speed[-1] ** 2
    reach = bounds.reach
    squares, cruise = look_ahead(joints, reach), bounds.speed**2
    is_settled = squares <= _stopping_squares(reach)
    slower_reach = bounds.slower_reach(limit_values(limits, "minimum_cruise_ratio", moves.setting))
    # Moves that follow may be slower, in the same hump.
    if limits[0].model == "klipper" and ((slower_reach < reach).any() or not ends):
        squares, cruise, between = _cut_humps(bounds, joints, squares, slower_reach)
        is_settled &= between
    is_settled[0] = True
    settled = len(moves) if ends else int(np.flatnonzero(is_settled)[-1])
    return settled, _trapezoids(bounds, squares, cruise, settled), float(squares[settled])


def _cut_humps(
    bounds: BoundedMoves, joints: Floats, squares: Floats, reach: Floats
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Return profile, limits of the moves, and joints between humps, with the humps of a slower profile cut off."""
    slower = look_ahead(joints, reach)
    rising, falling = hump_slopes(slower, reach)
    between = (slower <= _stopping_squares(reach)) & (slower >= joints * (1 - ROUNDING))
    between[1:] &= ~rising  # each hump must be complete
    between[:-1] &= ~falling
    top = hump_tops(slower, reach, bounds.speed**2)
    squares = squares.copy()
    np.minimum(squares[:-1], top, out=squares[:-1])
    np.minimum(squares[1:], top, out=squares[1:])
    return squares, np.where(falling & ~rising, np.minimum(top, squares[:-1]), top), between


def _stopping_squares(reach: Floats) -> Floats:
    """Return the squared speeds at the joints from which the machine can stop at the end, (N + 1,)."""
    return np.append(np.cumsum(reach[::-1])[::-1], 0.0)


def _trapezoids(bounds: BoundedMoves, squares: Floats, cruise: Floats, count: int) -> MotionPlan:
    """Return times and speeds of the first moves: acceleration, constant speed, deceleration."""
    distance, acceleration = bounds.distance[:count], bounds.acceleration[:count]
    before, after = squares[:count], squares[1 : count + 1]
    peak = np.minimum(cruise[:count], (before + after) / 2 + acceleration * distance)
    peak = np.maximum(peak, np.maximum(before, after))  # by rounding only
    cruising = np.maximum(distance - (2 * peak - before - after) / (2 * acceleration), 0.0)
    entry, top, leaving = np.sqrt(before), np.sqrt(peak), np.sqrt(after)
    seconds = (2 * top - entry - leaving) / acceleration + cruising / top
    return MotionPlan(seconds=seconds, entry=entry, peak=top, exit=leaving)


def hump_slopes(eased: Floats, reach: Floats) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Find the moves that only speed up in the slower profile, and those that only slow down; return both masks.

    Parameters
    ----------
    eased : (N + 1,) float64
        The slower profile at the joints.
    reach : (N,) float64
        Largest change of the profile along each move.
    """
    change = np.diff(eased)
    full_change = reach - ROUNDING * (eased[:-1] + eased[1:])
    return change >= full_change, -change >= full_change


def hump_tops(eased: Floats, reach: Floats, cruise: Floats) -> Floats:
    """Return the top of the hump that each move belongs to, a squared speed, (N,) mm²/s².

    Parameters
    ----------
    eased, reach : as for `hump_slopes`
    cruise : (N,) float64
        The moves' own limits.

    >>> joints = np.array([0.0, 50.0, 100.0, 50.0, 0.0])
    >>> hump_tops(joints, np.full(4, 50.0), np.full(4, 900.0)).tolist()
    [100.0, 100.0, 100.0, 100.0]
    """
    rising, falling = hump_slopes(eased, reach)
    falling &= ~rising
    own_top = np.minimum(cruise, (eased[:-1] + eased[1:] + reach) / 2)
    number = np.arange(len(own_top))
    ahead = np.minimum.accumulate(np.where(rising, len(own_top), number)[::-1])[::-1]  # next move that does not rise
    behind = np.maximum.accumulate(np.where(falling, -1, number))  # the last move that does not fall
    at_next = np.minimum(ahead, len(own_top) - 1)
    summit = (ahead == len(own_top)) | falling[at_next]  # from rise directly to fall: the joint is the top
    up = np.where(summit, eased[ahead], own_top[at_next])
    at_last = np.maximum(behind, 0)
    down = np.where((behind < 0) | rising[at_last], eased[behind + 1], own_top[at_last])
    return np.where(rising, up, np.where(falling, down, own_top))
