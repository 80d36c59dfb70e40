r"""Corners of paths rounded to arcs, and the arcs cut into chords.

A corner of turn t between two legs becomes an arc that begins and ends at a distance s (the setback) from the corner::

        ----------o .                    radius      r = s / tan(t/2)
             s       ` .                 deviation   d = s tan(t/4)      of the arc from the corner
                        o                length      r t                 instead of 2 s
                         \  s

A machine of acceleration a passes the arc at v = √(a r), if the chords let it: each may turn by at most c / v, where c
is what the firmware's corners allow (about 1.8 × the square corner velocity, or the jerk). So an arc is cut into as few
equal chords as that takes: the joints at its ends turn by half as much as those inside. Fewer chords make a slower
machine, more of them a larger file and nothing else.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.arrays import Floats, Places

SHARPEST = math.radians(172)  # a path that turns back on itself keeps its corner
LEAST_DEVIATION = 0.001  # mm: less than the numbers of G-code can tell
UNIT = 0.001  # mm: the last decimal of a position in G-code
COARSEST = 0.02  # mm between a chord and its arc
SHORTEST_CHORD = 0.06  # mm
MOST_CHORD_TURN = 0.5  # radians from one chord to the next, where chords are long enough: a corner that is none


@dataclass(frozen=True, kw_only=True)
class Machine:
    """Speed, acceleration and cornering of a machine, which decide how finely a curve is cut.

    Parameters
    ----------
    acceleration : float or (N,) float64
        mm/s², of the path's points if an array.
    speed : float or (N,) float64
        Requested, mm/s.
    corner : float
        Turn, in radians, times speed, in mm/s, that the firmware passes without slowing down: 1.82 × the square
        corner velocity, √(8 a × junction deviation), or the jerk.
    segments_per_second : float
        That the controller can take.
    coarsest : float, mm
        Largest distance between a chord and its curve.
    """

    acceleration: float | Floats = 1000.0
    speed: float | Floats = 80.0
    corner: float = 9.0
    segments_per_second: float = math.inf
    coarsest: float = COARSEST

    def shortest_chord(self, speed: Floats) -> Floats:
        """Return the length, mm, of the shortest chords that the machine takes at some speeds, mm/s."""
        return np.maximum(speed / self.segments_per_second, SHORTEST_CHORD)


@dataclass(frozen=True, kw_only=True)
class RoundedPaths:
    """Paths with their corners rounded.

    Parameters
    ----------
    points : (K, 2) float64, mm
    first : (M + 1,) int
        Path i has the points `first[i]` to `first[i + 1]`.
    source : (K,) int
        The number of the old point that each new one stands for.
    radius : (N,) float64, mm
        Of the arc at each old point; infinite at points that are not corners, 0 at corners that stay sharp.
    """

    points: Floats
    first: Places
    source: Places
    radius: Floats


def round_corners(
    points: Floats,
    offsets: Places,
    *,
    deviation: float | Floats = math.inf,
    radius: float | Floats = math.inf,
    machine: Machine | None = None,
    unit: float = 0.0,
) -> RoundedPaths:
    """Round the corners of open paths; ends stay where they are.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The paths one after another.
    offsets : (M + 1,) int
        Where each begins, and N.
    deviation : float or (N,) float64, mm
        How far an arc may lie from the corner.
    radius : float or (N,) float64, mm
        Largest radius; an arc also ends at the middle of a leg that two corners share, unless one needs less.
    machine : Machine, optional
        Decides the number of chords.
    unit : float, mm
        Round the new points to multiples of this.

    Returns
    -------
    RoundedPaths

    >>> corner = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    >>> result = round_corners(corner, np.array([0, 3]), radius=2.0)
    >>> float(result.radius[1]), len(result.points)
    (2.0, 11)
    """
    machine = machine or Machine()
    count = len(points)
    corners = inner_points(count, offsets)
    turn, before, after, lengths = corner_turns(points, corners)
    half = turn / 2
    half_tangent = np.maximum(np.tan(half), 1e-12)
    full_setback = np.minimum(
        _take(radius, corners) * half_tangent, _take(deviation, corners) / np.maximum(np.tan(turn / 4), 1e-12)
    )
    full_setback[(turn > SHARPEST) | (lengths.min(axis=0) == 0)] = 0.0
    setback = _fit_setbacks(full_setback, corners, lengths, half_tangent, count)
    straight = half < 1e-9
    arc = np.divide(setback, np.tan(half), out=np.full(len(corners), np.inf), where=~straight)
    setback[(setback * np.tan(turn / 4) < LEAST_DEVIATION) | straight] = 0.0
    chords = _chord_counts(arc, turn, machine, corners)
    chords[setback == 0] = 0
    radii = np.full(count, np.inf)
    radii[corners] = np.where(straight, np.inf, np.where(setback == 0, 0.0, arc))
    return _insert_arcs(points, offsets, corners, setback, arc, turn, before, after, chords, radii, unit)


def inner_points(count: int, offsets: Places) -> Places:
    """Return the places of the points inside some paths, neither their first nor their last, of `count` points.

    >>> inner_points(5, np.array([0, 3, 5])).tolist()
    [1]
    """
    inner = np.ones(count, dtype=bool)
    inner[offsets[:-1][offsets[:-1] < count]] = False
    inner[offsets[1:] - 1] = False
    return np.flatnonzero(inner)


def _take(value: float | Floats, index: Places) -> Floats | float:
    """Return the values at indices, or the number itself if it is one for all."""
    return value[index] if isinstance(value, np.ndarray) else value


def corner_turns(points: Floats, index: Places) -> tuple[Floats, Floats, Floats, Floats]:
    """Compute the turn at each inner point, the directions of its two legs, and their lengths (2, n)."""
    before, after = points[index] - points[index - 1], points[index + 1] - points[index]
    lengths = np.stack([np.hypot(*before.T), np.hypot(*after.T)])
    before, after = (
        leg / np.maximum(length, 1e-300)[:, None] for leg, length in zip((before, after), lengths, strict=True)
    )
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(np.abs(cross), before[:, 0] * after[:, 0] + before[:, 1] * after[:, 1]), before, after, lengths


def _fit_setbacks(full_setback: Floats, corners: Places, lengths: Floats, half_tangent: Floats, count: int) -> Floats:
    """Fit setbacks into their legs: two corners share a leg so that their arcs are equal, unless one needs less."""
    needs, weight = np.zeros(count), np.zeros(count)
    needs[corners], weight[corners] = full_setback, np.where(full_setback > 0, half_tangent, 0.0)
    corner_weight = np.maximum(weight[corners], 1e-12)
    fits = [
        np.maximum(length * (corner_weight / (corner_weight + weight[corners + step])), length - needs[corners + step])
        for length, step in zip(lengths, (-1, 1), strict=True)
    ]
    setback: Floats = np.minimum(full_setback, np.minimum(*fits))
    return setback


def _chord_counts(arc: Floats, turn: Floats, machine: Machine, corners: Places) -> Places:
    """Compute the number of chords of each arc."""
    arc = np.where(np.isfinite(arc), np.maximum(arc, 1e-9), 1e9)
    speed = np.minimum(np.sqrt(_take(machine.acceleration, corners) * arc), _take(machine.speed, corners))
    speed_count = np.ceil(turn * speed / machine.corner - 1e-9)
    speed_count = np.minimum(speed_count, np.floor(turn * arc / machine.shortest_chord(speed)))
    speed_count = np.maximum(speed_count, np.floor(np.minimum(turn / MOST_CHORD_TURN, turn * arc / SHORTEST_CHORD)))
    shape_count = np.ceil(turn / (2 * np.arccos(np.maximum(1 - machine.coarsest / arc, 0.0))) - 1e-9)
    number: Places = np.maximum(np.maximum(speed_count, shape_count), 1).astype(np.intp)
    return number


def _insert_arcs(
    points: Floats,
    offsets: Places,
    corners: Places,
    setback: Floats,
    arc: Floats,
    turn: Floats,
    before: Floats,
    after: Floats,
    chords: Places,
    radii: Floats,
    unit: float,
) -> RoundedPaths:
    """Replace corners by their arcs."""
    count = len(points)
    number = np.ones(count, dtype=np.intp)  # of new points for each old one
    number[corners] = np.where(chords > 0, chords + 1, 1)
    source = np.repeat(np.arange(count), number)
    start = np.concatenate([[0], np.cumsum(number)])
    new = points[source]
    corner = np.zeros(count, dtype=np.intp)
    corner[corners] = np.arange(len(corners))
    bent = np.zeros(count, dtype=bool)
    bent[corners] = chords > 0
    on_arc = np.flatnonzero(bent[source])
    arc_index = corner[source[on_arc]]
    place = on_arc - start[source[on_arc]]
    angle = (turn / np.maximum(chords, 1))[arc_index] * place
    size = arc[arc_index]
    along, inwards = size * np.sin(angle) - setback[arc_index], size * (1 - np.cos(angle))
    side = np.sign(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    # Axis by axis: NumPy is slow along the short axis of an array.
    new[on_arc, 0] += along * before[arc_index, 0] - inwards * (side * before[:, 1])[arc_index]
    new[on_arc, 1] += along * before[arc_index, 1] + inwards * (side * before[:, 0])[arc_index]
    if unit:
        new = np.rint(new / unit) * unit
    # Arcs that meet in the middle of a leg share a point there; an arc may end at a point of the path, which stays.
    keep = np.ones(len(new), dtype=bool)
    step = np.abs(np.diff(new, axis=0))
    close = np.flatnonzero(np.maximum(step[:, 0], step[:, 1]) <= max(unit * 5, 1e-9)) + 1
    fixed = ~bent[source]
    both_fixed = fixed[close] & fixed[close - 1]
    keep[np.where(fixed[close], close - 1, close)[~both_fixed]] = False
    final = np.concatenate([[0], np.cumsum(keep)])
    return RoundedPaths(points=new[keep], first=final[start[offsets]], source=source[keep], radius=radii)
