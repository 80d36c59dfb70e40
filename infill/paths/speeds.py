"""The speeds at which a machine passes paths, at most."""

from __future__ import annotations

import math

import numpy as np

from infill.arrays import Floats, Places
from infill.paths.corners import corner_turns, inner_points

STRAIGHTEST = 1e-9  # radians: a joint that turns by less limits no speed


def find_peak_speeds(
    points: Floats, offsets: Places, *, speed: float | Floats, acceleration: float | Floats, corner: float
) -> Floats:
    """Find the highest speed, mm/s, on the segment after each point of some paths: (N,); 0 after the last one.

    A joint is passed at `corner` / turn at most, and between two joints a machine speeds up and slows down again.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The paths one after another.
    offsets : (M + 1,) int
        Where each begins, and N.
    speed, acceleration : float or (M,) float64
        mm/s and mm/s², of each path if arrays.
    corner : float
        See `infill.paths.corners.Machine`.

    >>> line = np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]])
    >>> find_peak_speeds(line, np.array([0, 3]), speed=80.0, acceleration=1000.0, corner=9.0).tolist()
    [80.0, 80.0, 0.0]
    """
    count = np.diff(offsets)
    fastest = np.repeat(np.broadcast_to(speed, len(count)), count) ** 2
    joints = fastest.copy()
    inner = inner_points(len(points), offsets)
    turn, _, _, _ = corner_turns(points, inner)
    joints[inner] = np.minimum(joints[inner], (corner / np.maximum(turn, STRAIGHTEST)) ** 2)
    length = np.hypot(*np.diff(points, axis=0).T)
    reach = 2 * np.repeat(np.broadcast_to(acceleration, len(count)), count)[:-1] * length
    reach[offsets[1:-1] - 1] = math.inf  # from path to path
    squares = look_ahead(joints, reach)
    peaks = np.minimum((squares[:-1] + squares[1:] + reach) / 2, fastest[:-1])
    return np.append(np.sqrt(peaks), 0.0)


def look_ahead(joints: Floats, reach: Floats) -> Floats:
    """Return the greatest u <= joints with |u[j + 1] - u[j]| <= reach[j], (N + 1,), mm²/s².

    >>> look_ahead(np.array([0.0, 100.0, 100.0, 4.0]), np.array([30.0, 10.0, 30.0])).tolist()
    [0.0, 30.0, 34.0, 4.0]
    """
    forward, backward, window, size = joints.copy(), joints.copy(), reach, 1
    while len(window):  # the reach of `size` moves in a row, from each move on
        onward = forward[:-size] + window
        back = backward[size:] + window
        if not ((onward < forward[size:]).any() or (back < backward[:-size]).any()):
            break  # wider windows change nothing either: each is made of two of these
        np.minimum(forward[size:], onward, out=forward[size:])
        np.minimum(backward[:-size], back, out=backward[:-size])
        window, size = window[:-size] + window[size:], 2 * size
    return np.asarray(np.minimum(forward, backward))
