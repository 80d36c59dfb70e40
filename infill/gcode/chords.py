"""Arcs as firmware drives them: chords of one millimetre, or fewer degrees where the arc is small."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bounds import Floats

LONGEST = 1.0  # mm: the default of Marlin (MM_PER_ARC_SEGMENT) and of Klipper (gcode_arcs)
SHORTEST = 0.1  # mm
CIRCLE = 72  # chords at least, if they do not get too short


def chords(
    start: Floats, end: Floats, centre: Floats, clockwise: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], Floats, Floats]:
    """Cut arcs into chords.

    Parameters
    ----------
    start, end : (N, 3) float64
        mm; z rises evenly along the arc. Where x and y are the same, it is a whole circle.
    centre : (N, 2) float64
        mm
    clockwise : (N,) bool
        Seen from above: G2.

    Returns
    -------
    arc : (M,) int
        Which arc a chord belongs to.
    first, last : (M, 3) float64
        Its ends; those of an arc are exactly `start` and `end`.

    >>> arc, first, last = chords(np.zeros((1, 3)), np.array([[2.0, 0, 0]]), np.array([[1.0, 0]]), np.array([True]))
    >>> len(arc), last[len(arc) // 2 - 1].round(3).tolist()
    (32, [1.0, 1.0, 0.0])
    """
    away, until = start[:, :2] - centre, end[:, :2] - centre
    radius = np.hypot(*away.T)
    begin = np.arctan2(away[:, 1], away[:, 0])
    turn = (np.arctan2(until[:, 1], until[:, 0]) - begin) % (2 * np.pi)
    turn = np.where(turn < 1e-9, 2 * np.pi, turn)  # a whole circle, to the last digits of the file
    turn = np.where(clockwise & (turn < 2 * np.pi), turn - 2 * np.pi, np.where(clockwise, -turn, turn))
    length = np.abs(turn) * radius
    fine = np.minimum(np.abs(turn) * CIRCLE / (2 * np.pi), length / SHORTEST)
    count = np.maximum(np.ceil(np.maximum(length / LONGEST, fine) - 1e-9), 1).astype(np.intp)
    arc = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(arc)) - np.repeat(np.cumsum(count) - count, count)

    def at(share: Floats) -> Floats:
        angle = begin[arc] + share * turn[arc]
        level = centre[arc] + radius[arc, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        return np.column_stack([level, start[arc, 2] + share * (end - start)[arc, 2]])

    first, last = at(number / count[arc]), at((number + 1) / count[arc])
    opening, closing = number == 0, number == count[arc] - 1
    first[opening], last[closing] = start[arc[opening]], end[arc[closing]]
    return arc, first, last
