r"""Lines that run into the walls along which they are joined, by a curve in the place of a corner.

::

        wall   ==========================          ==========================
                   ,----------------.                  .-""------------""-.
                   |                |      becomes    /                    \
                   |                |                |                      |

A machine brakes at such a corner nearly to rest. The curve takes a quarter of the way along the wall at each end, so
that half of it stays beside the wall, and as much of the line, if it is that long.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Flags, Floats
from infill.paths.curves import points_of_cubic
from infill.paths.neighbours import BESIDE, BeadIndex

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

LEAST_TURN = math.radians(25)  # of a corner
MOST_TURN = math.radians(170)  # a path that turns back on itself keeps its corner
SHARE = 0.25  # of the way along a wall that a curve takes at each of its ends
OF_LINE = 0.5  # of the length of a line up to its next corner
LEAST_SLOPE = 0.2  # of a leg that leaves a wall: how much nearer to it one end lies, over its length
MOST_BEND = math.radians(45)  # of a line, off its direction at the corner, where a curve begins: beyond, it could cross
LEAST_SETBACK = 0.1  # mm
CURVE_POINTS = 9  # on a curve, with its ends
EXEMPT = 3.5  # line widths along a path within which a curve may come near its own path
SLACK = 1e-3  # mm: the last decimal of G-code


def round_wall_joins(
    paths: Sequence[Floats],
    walls: BeadIndex,
    area: Polygon | MultiPolygon,
    *,
    line_width: float,
    largest: float = math.inf,
    spacing: float = 0.0,
) -> list[Floats]:
    """Replace the corners between lines and the walls along which they run by curves.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
        Of layer 0.
    walls : BeadIndex
        The other beads.
    area : Polygon or MultiPolygon, mm
        Which no curve leaves; prepared for queries.
    line_width, largest : float, mm
        `largest` is that of the setbacks of curves from their corners.
    spacing : float, mm
        Within which no curve comes near another path, nor near its own further on, unless its corner lay as near.
    """
    if not paths:
        return []
    neighbours = _Neighbours(paths, spacing, EXEMPT * line_width)
    return [
        _round_path(number, path, walls, area, line_width, largest, neighbours) for number, path in enumerate(paths)
    ]


class _Neighbours:
    """The segments of all paths, for curves that may not come near them."""

    def __init__(self, paths: Sequence[Floats], spacing: float, exempt: float) -> None:
        import shapely

        self.spacing, self.exempt = spacing, exempt
        along = [np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T))) for path in paths]
        self.owner = np.repeat(np.arange(len(paths)), [len(path) - 1 for path in paths])
        self.begin = np.concatenate([places[:-1] for places in along])
        self.end = np.concatenate([places[1:] for places in along])
        self.segments = shapely.linestrings(np.concatenate([np.stack([path[:-1], path[1:]], axis=1) for path in paths]))
        self.tree = shapely.STRtree(self.segments)

    def crowds(self, curve: Floats, corner: Floats, owner: int, span: tuple[float, float]) -> bool:
        """Tell whether a curve comes nearer to others than `spacing`, and nearer than the corner in its place.

        Parameters
        ----------
        curve, corner : (N, 2) float64, mm
        owner : int
            Number of their path.
        span : (float, float), mm
            Where they begin and end along it.
        """
        import shapely

        line = shapely.linestrings(curve)
        candidates = self.tree.query(line, predicate="dwithin", distance=self.spacing)
        is_same = (self.owner[candidates] == owner) & (self.begin[candidates] < span[1] + self.exempt)
        candidates = candidates[~(is_same & (self.end[candidates] > span[0] - self.exempt))]
        if not len(candidates):
            return False
        before = shapely.distance(shapely.linestrings(corner), self.segments[candidates])
        after = shapely.distance(line, self.segments[candidates])
        return bool((after < np.minimum(self.spacing, before) - SLACK).any())


def _round_path(
    number: int,
    path: Floats,
    walls: BeadIndex,
    area: Polygon | MultiPolygon,
    line_width: float,
    largest: float,
    neighbours: _Neighbours,
) -> Floats:
    """Round the corners of one path."""
    import shapely

    if len(path) < 3 or largest < LEAST_SETBACK:
        return path
    step = np.diff(path, axis=0)
    length = np.hypot(*step.T)
    heading = np.arctan2(step[:, 1], step[:, 0])
    turn = np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi)
    corners = np.flatnonzero((turn > LEAST_TURN) & (turn < MOST_TURN)) + 1
    if not len(corners):
        return path
    along_wall = _legs_along(path, length, walls, BESIDE * line_width)
    along = np.concatenate([[0.0], np.cumsum(length)])
    stops = np.concatenate([[0], corners, [len(path) - 1]])
    pieces, begun = [], 0  # the points of the path from `begun` on are still to be copied
    for place, corner in enumerate(corners.tolist(), 1):
        before, after = along_wall[corner - 1], along_wall[corner]
        if before == after:
            continue
        sides = (along[corner] - along[stops[place - 1]], along[stops[place + 1]] - along[corner])
        shares = (SHARE if before else OF_LINE, SHARE if after else OF_LINE)
        straight = (
            along[corner] - along[_end_of_straight(heading, corner - 1, int(stops[place - 1]))],
            along[_end_of_straight(heading, corner, int(stops[place + 1]))] - along[corner],
        )
        setback = min(sides[0] * shares[0], sides[1] * shares[1], *straight, largest)
        while setback >= LEAST_SETBACK:
            first, leg_in = _point_at(path, along, along[corner] - setback)
            last, leg_out = _point_at(path, along, along[corner] + setback)
            curve = _curve(first, step[leg_in], last, step[leg_out], setback)
            span = float(along[corner] - setback), float(along[corner] + setback)
            sharp = np.concatenate([[first], path[leg_in + 1 : leg_out + 1], [last]])
            if shapely.covers(area, shapely.linestrings(curve)) and not neighbours.crowds(curve, sharp, number, span):
                pieces += [path[begun : leg_in + 1], curve]
                begun = leg_out + 1
                break
            setback /= 2
    return np.concatenate([*pieces, path[begun:]]) if pieces else path


def _end_of_straight(heading: Floats, leg: int, stop: int) -> int:
    """Return the point up to which a path keeps the direction of a leg, to `MOST_BEND`; at most the point `stop`."""
    legs = heading[leg:stop] if stop > leg else heading[stop : leg + 1][::-1]
    bent = np.abs((legs - heading[leg] + np.pi) % (2 * np.pi) - np.pi) > MOST_BEND
    count = int(np.argmax(bent)) if bent.any() else len(legs)
    return leg + count if stop > leg else leg + 1 - count


def _legs_along(path: Floats, length: Floats, walls: BeadIndex, reach: float) -> Flags:
    """Tell for each leg of a path, (N - 1,), whether it runs along other beads: about as near to them at both ends."""
    distance = walls.distances(np.concatenate([path, (path[1:] + path[:-1]) / 2]), 0, reach)
    ends, middles = distance[: len(path)], distance[len(path) :]
    with np.errstate(invalid="ignore"):
        along: Flags = np.isfinite(middles) & (np.abs(ends[1:] - ends[:-1]) <= LEAST_SLOPE * length)
    return along


def _point_at(path: Floats, along: Floats, place: float) -> tuple[Floats, int]:
    """Return the point of a path at a length along it, and its leg."""
    leg = int(np.clip(np.searchsorted(along, place, side="right") - 1, 0, len(path) - 2))
    share = (place - along[leg]) / max(along[leg + 1] - along[leg], 1e-12)
    return path[leg] + share * (path[leg + 1] - path[leg]), leg


def _curve(first: Floats, way_in: Floats, last: Floats, way_out: Floats, setback: float) -> Floats:
    """Return points of a cubic curve between two points with these directions: of straight legs, an arc."""
    way_in, way_out = way_in / np.hypot(*way_in), way_out / np.hypot(*way_out)
    turn = math.acos(float(np.clip(way_in @ way_out, -1.0, 1.0)))
    handle = 4 / 3 * math.tan(turn / 4) * setback / max(math.tan(turn / 2), 1e-9) if turn > 1e-6 else setback / 3
    control = np.stack([first, first + handle * way_in, last - handle * way_out, last])
    return points_of_cubic(control[:, None], np.linspace(0.0, 1.0, CURVE_POINTS))
