r"""Paths that stand for curves, such as a gyroid's, cut into better chords.

A slicer writes a curve as chords of some length, whatever the machine: at every joint it slows down. Where the turns
are gentle, a smooth curve goes through the joints (its direction there is that of the circle through a joint and its
neighbours, each leg a cubic Bézier curve between two such directions) and is cut again: a chord may turn by c / v at
the speed v = √(a / κ) that the curvature κ allows, so the density of chords along the curve is √(a κ) / c.

The curve does not move: it leaves the slicer's chords by their own sagitta, of 0.1 mm at most. Where the sagitta would
be larger, the joint counts as a corner.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.paths.corners import COARSEST, MOST_CHORD_TURN, SHORTEST_CHORD, Machine

GENTLE = math.radians(40)  # a turn above this is a corner
MOST_BULGE = 0.1  # mm between a curve and the slicer's chord
PIECES = 4  # of a leg, to integrate along it
STRAIGHTEST = 1e-6  # 1/mm
MOST_MISSED = 1.5 * COARSEST  # mm between an old point of a curve and the new chords


@dataclass(frozen=True, kw_only=True)
class RecutPaths:
    """Paths of which some points are new.

    Parameters
    ----------
    points : (K, 2) float64, mm
    first : (M + 1,) int
        Where each path begins.
    source : (K,) int
        The old point equal to each new one, or the last old point before it.
    curved : (K,) bool
        True on a curve, False at corners.
    """

    points: Floats
    first: Places
    source: Places
    curved: NDArray[np.bool_]


def recut_curves(points: Floats, offsets: Places, machine: Machine, bulge: float | Floats = MOST_BULGE) -> RecutPaths:
    """Cut the curves among some paths into the chords that a machine needs.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The paths one after another.
    offsets : (M + 1,) int
        Where each begins, and N.
    machine : Machine
    bulge : float or (N,) float64, mm
        How far a curve may leave the chords at each point.

    Returns
    -------
    RecutPaths
    """
    count = len(points)
    has_leg = np.ones(max(count - 1, 0), dtype=bool)  # the leg after a point belongs to its path
    has_leg[offsets[1:-1] - 1] = False
    leg = np.diff(points, axis=0)
    length = np.hypot(*leg.T)
    heading = np.arctan2(leg[:, 1], leg[:, 0])
    turn = np.zeros(count)
    turn[1:-1] = np.where(has_leg[:-1] & has_leg[1:], _wrap_angle(np.diff(heading)), np.pi)
    longer = np.maximum(length[:-1], length[1:])
    gentle = np.zeros(count, dtype=bool)
    gentle[1:-1] = has_leg[:-1] & has_leg[1:] & (np.minimum(length[:-1], length[1:]) > 0)
    limit = np.broadcast_to(bulge, count)
    gentle[1:-1] &= (np.abs(turn[1:-1]) < GENTLE) & (longer * np.abs(turn[1:-1]) / 8 < limit[1:-1])
    bent = np.flatnonzero(gentle[:-1] & gentle[1:] & has_leg)
    # The circle through three points turns towards each neighbour by that leg's share.
    share = np.zeros(count)
    share[1:-1] = length[:-1] / np.maximum(length[:-1] + length[1:], 1e-300)
    leaving, arriving = -turn[bent] * (1 - share[bent]), turn[bent + 1] * share[bent + 1]
    # A leg beside shorter ones takes nearly all of the turn at both of its ends.
    low = _bound_bulges(length[bent], np.abs(leaving), np.abs(arriving)) < np.minimum(limit[bent], limit[bent + 1])
    bent, leaving, arriving = bent[low], leaving[low], arriving[low]
    if not len(bent):
        return RecutPaths(points=points, first=offsets, source=np.arange(count), curved=np.zeros(count, dtype=bool))
    start, end = heading[bent] + leaving, heading[bent] + arriving
    handle = length[bent] / 3
    control = np.stack(
        [
            points[bent],
            points[bent] + handle[:, None] * np.stack([np.cos(start), np.sin(start)], axis=1),
            points[bent + 1] - handle[:, None] * np.stack([np.cos(end), np.sin(end)], axis=1),
            points[bent + 1],
        ]
    )
    number = _chord_density(control, bent, machine)
    opens = np.flatnonzero(np.diff(bent, prepend=-2) != 1)  # where a run of curved legs begins
    while True:
        result, astray = _resample_runs(points, offsets, bent, control, number, opens)
        if not len(astray):
            return result
        opens = np.union1d(opens, astray)  # these joints stay


def _bound_bulges(length: Floats, start_angle: Floats, end_angle: Floats) -> Floats:
    """Bound the distance of cubic curves from their legs by the angles at both ends.

    That is L α / 4 if they are equal, 4 L α / 27 if one of them is 0, and no more than between these elsewhere.
    """
    distance: Floats = length * (np.minimum(start_angle, end_angle) / 4 + np.abs(start_angle - end_angle) * 4 / 27)
    return distance


def _wrap_angle(angle: Floats) -> Floats:
    """Wrap angles to the range from -π to π."""
    result: Floats = (angle + np.pi) % (2 * np.pi) - np.pi
    return result


def points_of_cubic(control: Floats, share: Floats) -> Floats:
    """Return points of cubic curves, (n, 2); `control` is (4, n, 2) or, of one curve, (4, 1, 2), and `share` (n,)."""
    u, v = share[:, None], 1 - share[:, None]
    curve_points: Floats = (
        v**3 * control[0] + 3 * v * v * u * control[1] + 3 * v * u * u * control[2] + u**3 * control[3]
    )
    return curve_points


def _chord_density(control: Floats, bent: Places, machine: Machine) -> Floats:
    """Compute the number of chords that each quarter of each curved leg needs: (legs, PIECES)."""
    grid = np.stack([points_of_cubic(control, np.full(len(bent), k / PIECES)) for k in range(PIECES + 1)], axis=1)
    piece = np.diff(grid, axis=1)
    length = np.hypot(piece[..., 0], piece[..., 1])
    heading = np.arctan2(piece[..., 1], piece[..., 0])
    inner = np.abs(_wrap_angle(np.diff(heading, axis=1)))
    bend = np.concatenate([inner[:, :1], inner], axis=1)
    bend[:, 1:-1] = (inner[:, :-1] + inner[:, 1:]) / 2
    curvature = np.maximum(bend / np.maximum(length, 1e-9), STRAIGHTEST)
    acceleration, speed = (
        value[bent][:, None] if isinstance(value, np.ndarray) else value
        for value in (machine.acceleration, machine.speed)
    )
    pace = np.minimum(np.sqrt(acceleration / curvature), speed)
    wanted = np.minimum(curvature * pace / machine.corner, 1 / machine.shortest_chord(pace))
    wanted = np.maximum(wanted, np.minimum(curvature / MOST_CHORD_TURN, 1 / SHORTEST_CHORD))
    number: Floats = length * np.maximum(wanted, np.sqrt(curvature / (8 * machine.coarsest)))
    return number


def _resample_runs(
    points: Floats, offsets: Places, bent: Places, control: Floats, number: Floats, opens: Places
) -> tuple[RecutPaths, Places]:
    """Replace the points inside runs of curved legs by new ones.

    Return also the curved legs whose first point, an old one, the new chords miss: this occurs where a curve is
    straight for a long way and then turns.
    """
    count = len(points)
    run = np.repeat(np.arange(len(opens)), np.diff(np.append(opens, len(bent))))
    run_chords = np.add.reduceat(number.sum(axis=1), opens)
    chords = np.maximum(1, np.ceil(run_chords - 1e-9)).astype(np.intp)
    # Along each run the cumulative number of chords goes from 0 to an integer.
    scaled = number * (chords / run_chords)[run][:, None]
    before = np.concatenate([[0], np.cumsum(chords)])
    along = np.concatenate([[0.0], np.cumsum(scaled.ravel())])
    positions = np.arange(before[-1]) + 0.0
    inner = np.ones(len(positions), dtype=bool)
    inner[before[:-1]] = False  # the beginnings of runs are points of the path
    positions, run_of = positions[inner], np.repeat(np.arange(len(opens)), chords)[inner]
    place = np.interp(positions, along, np.arange(len(along)) / PIECES)
    lowest, highest = opens[run_of], np.append(opens[1:], len(bent))[run_of] - 1
    leg = np.clip(place.astype(np.intp), lowest, highest)
    new = points_of_cubic(control[:, leg], np.clip(place - leg, 0.0, 1.0))
    starts = np.empty((int(before[-1]), 2))
    starts[before[:-1]], starts[inner] = points[bent[opens]], new
    ends = np.roll(starts, -1, axis=0)
    ends[before[1:] - 1] = points[bent[np.append(opens[1:], len(bent)) - 1] + 1]
    joint = np.setdiff1d(np.arange(len(bent)), opens)
    chord = np.clip(along[joint * PIECES].astype(np.intp), before[run[joint]], before[run[joint] + 1] - 1)
    astray = joint[segment_distances(points[bent[joint]], starts[chord], ends[chord]) > MOST_MISSED]
    stays = np.ones(count, dtype=bool)
    stays[bent] = False
    stays[bent[opens]] = True
    on_curve = np.zeros(count, dtype=bool)
    on_curve[bent] = on_curve[bent + 1] = True
    old = np.flatnonzero(stays)
    source = np.concatenate([old, bent[leg]])
    order = np.lexsort((np.concatenate([np.zeros(len(old)), place + 1]), source))
    merged_points = np.concatenate([points[old], new])[order]
    source = source[order]
    result = RecutPaths(
        points=merged_points,
        first=np.searchsorted(source, offsets),
        source=source,
        curved=np.concatenate([on_curve[old], np.ones(len(new), dtype=bool)])[order],
    )
    return result, astray


def segment_distances(points: Floats, starts: Floats, ends: Floats) -> Floats:
    """Return the distance, mm, of each point from its own segment; all are (N, 2)."""
    chord, delta = ends - starts, points - starts
    share = (delta * chord).sum(axis=1) / np.maximum((chord**2).sum(axis=1), 1e-300)
    return np.asarray(np.hypot(*(delta - np.clip(share, 0.0, 1.0)[:, None] * chord).T))
