r"""Corner offsets: corners move outwards before they are rounded, as a driver takes a bend wide.

An arc inside a corner is shorter than its two legs, and lies inside of it all the way. A corner that is moved outwards
first, by about three quarters of what its arc then cuts off, gives a path of nearly the old length, half of it outside
and half of it inside of the old one: at the same distance between the two, the arc is half as large again.

Where lines touch, a corner may only move along the leg that touches another line, and only so far that the other leg
stays above the bead below it: the line beside it turns away at the same place, and does the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.arrays import Floats, Places
from infill.checks import FARTHEST
from infill.paths.contact import SELF_STRETCH, TOUCHING, sample_paths
from infill.paths.corners import corner_turns
from infill.paths.neighbours import BESIDE, BeadIndex, index_beads

OUTWARDS = 0.75  # how far a corner moves, over the distance from there to its arc: the length stays about the same
ALONG = 0.3  # the same along a leg that touches, over the length of the leg that the arc takes
ASIDE = 1 / 16  # line widths that such a move may carry the other leg aside
HAIRPIN = math.radians(150)  # a sharper turn would swing out by a third of its leg: it stays
LEAST_APART, MOST_APART = 0.5, 1.15  # line widths between legs that run side by side and touch
ROOM = 2.0  # line widths to search for walls, beyond those that a corner lies beside
LEG_STEP = 0.5  # mm along a leg between the places at which walls are searched
SEEN = 3.0  # line widths from a corner within which other lines are searched
NEIGHBOURS = 4  # nearest points of the infill that are examined
PARALLEL = 0.98  # cosine between legs that run side by side


@dataclass(frozen=True, kw_only=True)
class CornerFreedom:
    """Limits of the outward moves of corners.

    Parameters
    ----------
    corner : (C,) int
        Points of the paths.
    free : (C,) float64, mm
        How far each may move at most.
    along : (C,) int
        0: away from both legs; 1: on in the direction in which it is reached; -1: back from where it goes.
    turn : (C,) float64
        Radians.
    before, after : (C, 2) float64
        Directions of the legs.
    leg : (C,) float64, mm
        Length of the shorter one.
    """

    corner: Places
    free: Floats
    along: Places
    turn: Floats
    before: Floats
    after: Floats
    leg: Floats


def corner_freedom(
    points: Floats,
    offsets: Places,
    corner: Places,
    layer: Places,
    walls: BeadIndex,
    *,
    line_width: float,
) -> CornerFreedom:
    """Find the corners that may move outwards, and how far.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The paths one after another.
    offsets : (M + 1,) int
        Where each begins, and N.
    corner : (C,) int
        Their corners: none of them the end of a path, or beside a bead that is not of the infill.
    layer : (N,) int
    walls : BeadIndex
        Those beads.
    line_width : float, mm
    """
    turn, before, after, lengths = corner_turns(points, corner)
    leg = lengths.min(axis=0)
    wide = (turn < HAIRPIN) & (leg > 0)
    if not (np.abs(points) < FARTHEST).all():
        wide[:] = False
    corner, turn, before, after, leg = corner[wide], turn[wide], before[wide], after[wide], leg[wide]
    free, along = _room_beside_others(points, offsets, corner, (before, after), layer, line_width)
    loose = np.flatnonzero((along == 0) & (free > 0))
    free[loose] = np.minimum(free[loose], _off_walls(points, corner[loose], layer, walls, line_width))
    return CornerFreedom(corner=corner, free=free, along=along, turn=turn, before=before, after=after, leg=leg)


def offset_corners(
    points: Floats, room: CornerFreedom, *, deviation: float | Floats, radius: float
) -> tuple[Floats, Floats]:
    """Move corners outwards; return the paths and the distance that arcs may then lie from these corners, mm.

    Parameters
    ----------
    points : (N, 2) float64, mm
    room : CornerFreedom
    deviation : float or (C,) float64, mm
        How far the rounded path may lie from the old one.
    radius : float, mm
        Of the largest arc.

    Returns
    -------
    moved : (N, 2) float64, mm
    deviation : (C,) float64, mm
        Of the corners of `room`.
    """
    outwards, aside = room.along == 0, np.maximum(np.sin(room.turn), 0.1)
    # The arc comes as near as 1 - OUTWARDS of its deviation, the moved legs as far as their part of OUTWARDS.
    share = np.where(outwards, np.maximum(1 - OUTWARDS, OUTWARDS * np.cos(room.turn / 2)), 1.0)
    limit = np.minimum(deviation / share, 1e9)
    setback = np.minimum(limit / np.maximum(np.tan(room.turn / 4), 1e-12), room.leg / 2)
    setback = np.minimum(setback, np.minimum(radius, 1e9) * np.tan(room.turn / 2))
    full_step = np.where(outwards, OUTWARDS * setback * np.tan(room.turn / 4), ALONG * setback)
    step = np.minimum(full_step, np.where(outwards, room.free, room.free / aside))
    outward = room.before - room.after
    outward /= np.maximum(np.hypot(*outward.T), 1e-12)[:, None]
    direction = np.where(outwards[:, None], outward, np.where((room.along > 0)[:, None], room.before, -room.after))
    moved = points.copy()
    moved[room.corner] += direction * step[:, None]
    # The arc of a corner that could not move as far as it should have is smaller by as much.
    return moved, np.where(outwards, np.minimum(limit, deviation + step), deviation)


def _room_beside_others(
    points: Floats, offsets: Places, corner: Places, legs: tuple[Floats, Floats], layer: Places, line_width: float
) -> tuple[Floats, Places]:
    """Return how far each corner may move before it meets other lines, mm, and along which leg: 1, -1 or 0 (none).

    See `CornerFreedom`.
    """
    count = len(corner)
    if not count:
        return np.empty(0), np.empty(0, dtype=np.intp)
    distance, neighbours = index_beads(points, layer).nearest(
        points[corner], layer[corner], SEEN * line_width, range(2, NEIGHBOURS + 2)
    )
    row, place = np.nonzero(np.isfinite(distance))
    distance, neighbour = distance[row, place], neighbours[row, place]
    path = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    travelled = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    is_same_stretch = np.abs(travelled[neighbour] - travelled[corner[row]]) <= SELF_STRETCH * line_width
    is_same_stretch &= path[neighbour] == path[corner[row]]
    # Otherwise, other lines may hide behind the corner's own path.
    is_complete = np.bincount(row[is_same_stretch], minlength=count) < NEIGHBOURS
    row, distance, neighbour = row[~is_same_stretch], distance[~is_same_stretch], neighbour[~is_same_stretch]
    free = np.where(is_complete, (SEEN - TOUCHING) / 2 * line_width, 0.0)
    nearest = np.flatnonzero(np.diff(row, prepend=-1))
    free[row[nearest]] = np.maximum(distance[nearest] - TOUCHING * line_width, 0.0) / 2
    touches_leg = np.zeros((2, count), dtype=bool)
    offset = points[neighbour] - points[corner[row]]
    arriving = _directions(points, path)
    leaving = np.append(arriving[1:], np.zeros((1, 2)), axis=0)
    for leg_index, leg in enumerate(legs):
        x, y = leg[row, 0], leg[row, 1]
        level = np.zeros(len(row), dtype=bool)
        for side in (arriving, leaving):
            level |= np.abs(x * side[neighbour, 0] + y * side[neighbour, 1]) > PARALLEL
        apart = np.abs(x * offset[:, 1] - y * offset[:, 0]) / line_width
        touches_leg[leg_index, row[level & (apart > LEAST_APART) & (apart < MOST_APART)]] = True
    along = touches_leg[0].astype(np.intp) - touches_leg[1]
    free[touches_leg.all(axis=0)] = 0.0
    free[along != 0] = ASIDE * line_width
    return free, along


def _off_walls(points: Floats, corner: Places, layer: Places, walls: BeadIndex, line_width: float) -> Floats:
    """Compute how far each corner may move before one of its legs comes to lie beside a wall, mm.

    A leg moves with both of its ends, and less the further from them: half of the room is for each.
    """
    free = np.full(len(corner), ROOM * line_width / 2)
    for step in (-1, 1):
        ends = np.stack([points[corner], points[corner + step]], axis=1)
        samples = sample_paths(ends.reshape(-1, 2), np.arange(len(corner) + 1) * 2, LEG_STEP)
        length = np.hypot(*(ends[:, 1] - ends[:, 0]).T)[samples.path]
        distance = walls.distances(samples.points, layer[corner][samples.path], (BESIDE + ROOM) * line_width)
        room = np.maximum(distance - BESIDE * line_width, 0.0) / 2
        hits = np.flatnonzero(np.isfinite(distance))
        remainder = (1 - samples.along / np.maximum(length, 1e-9))[hits]
        np.minimum.at(free, samples.path[hits], room[hits] / np.maximum(remainder, 1e-3))
    return free


def _directions(points: Floats, path: Places) -> Floats:
    """Return the direction in which each point is reached, (N, 2); 0 where a path begins."""
    directions = np.zeros_like(points)
    delta = np.diff(points, axis=0)
    delta[path[1:] != path[:-1]] = 0.0
    directions[1:] = delta / np.maximum(np.hypot(*delta.T), 1e-12)[:, None]
    return directions
