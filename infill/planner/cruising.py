"""Klipper's minimum cruise ratio: moves must not speed up only to slow down at once.

Klipper plans twice, the second time with accelerations lowered by the ratio r to a (1 - r). The slower profile rises
and falls in humps; over each hump the true speed stays below the top of the slower one. Short moves back and forth are
then driven at a steady speed. Everything is a square of a speed, mm²/s².
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.planner.bounds import Floats

ROUNDING = 1e-9  # of a profile: its sums are exact to 1e-14, and places in a file to 1e-12


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
    """Return the top of the hump of each move, (N,).

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
