"""Ties: short bars from islands of lines, which nothing holds, to the nearest wall or neighbouring line.

    lines and rims of the walls -> pieces -> points along them -> Delaunay edges between pieces -> shortest tree

Every edge of the shortest tree is a tie, so no set of fewer or shorter bars makes one piece of all.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.graph import label_connected

if TYPE_CHECKING:
    from infill.reports.filling import FillTie

TOUCHING = 0.25  # of the width: lines that are nearer to each other, or to a wall, than this overlap
INTO = 0.25  # of the width: ties reach so far into lines, which hides their ends
INTO_WALL = 1.0  # of the width: ties reach so far into walls
STEP, MOST_POINTS = 1.0, 200_000  # widths between points along lines, and how many points there may be
BESIDE = 1e-6  # of the width: rounding may put the end of a tie so far outside
AT_SKIN = 10.0  # times as long counts a tie that the skin of a part without a shell cuts off along its side
DECIMALS = 6  # of a report, mm

Segments = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Ties:
    """Bars that tie islands to the rest.

    Parameters
    ----------
    segments : (N, 2, 2) float64, mm
        Both ends of each, without what reaches into lines and walls.
    drawn : (M, 2, 2) float64, mm
        Lines of the line width that draw them, with what reaches into lines and walls: several side by side for a wider
        bar.
    width : float
        Of the bars, mm.
    loose : int
        Islands that no straight bar reaches.
    """

    segments: Segments
    drawn: Segments
    width: float = 0.0
    loose: int = 0

    @classmethod
    def none(cls) -> Ties:
        """Return no ties."""
        return cls(segments=np.empty((0, 2, 2)), drawn=np.empty((0, 2, 2)))

    def facts(self) -> list[FillTie]:
        """Return place, length and width of each, as the report has them: to a millionth of a millimetre."""
        middles = np.round(self.segments.mean(axis=1), DECIMALS) + 0.0  # no minus before a zero
        lengths = np.round(np.linalg.norm(np.diff(self.segments, axis=1)[:, 0], axis=1), DECIMALS)
        return [
            {"at": at, "length": length, "width": round(self.width, DECIMALS)}
            for at, length in zip(middles.tolist(), lengths.tolist(), strict=True)
        ]

    def join(self, others: list[Ties]) -> Ties:
        """Return these and other ties."""
        every = [self, *others]
        return Ties(
            segments=np.concatenate([ties.segments for ties in every]),
            drawn=np.concatenate([ties.drawn for ties in every]),
            width=max(ties.width for ties in every),
            loose=sum(ties.loose for ties in every),
        )

    def shift(self, offset: NDArray[np.float64]) -> Ties:
        """Return the same ties, moved by (2,) mm."""
        return replace(self, segments=self.segments + offset, drawn=self.drawn + offset)

    def widen(self, width: float, least: float) -> Ties:
        """Return the same ties, at least so wide: lines of a width side by side, mm."""
        wide = max(width, least)
        count = math.ceil(wide / width - BESIDE)
        along = np.diff(self.drawn, axis=1)
        across = np.stack([-along[..., 1], along[..., 0]], axis=-1)
        across /= np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), np.finfo(float).tiny)
        aside = np.linspace(-1, 1, count) * (wide - width) / 2 if count > 1 else np.zeros(1)
        drawn = (self.drawn + aside[:, None, None, None] * across).reshape(-1, 2, 2)
        return replace(self, drawn=drawn, width=wide)


def tie_islands(lines: shapely.Geometry, room: shapely.Geometry, *, width: float, walled: bool) -> Ties:
    """Find the shortest bars that make one piece of all lines in each part of a room.

    Parameters
    ----------
    lines : MultiLineString
        Centres of lines, mm.
    room : Polygon or MultiPolygon
        Where lines hold nothing but each other, mm.
    width : float
        Of the lines, mm.
    walled : bool
        True if the rims of the room are walls, which hold what touches them; several are tied to each other.

    Notes
    -----
    The shortest tree between points in a plane is a part of their Delaunay triangulation (Toussaint 1980,
    doi:10.1016/0031-3203(80)90066-7). Points lie a line width apart, and each edge of the tree is replaced by the
    shortest one between the two pieces that it joins.

    >>> ring = shapely.Point(0, 0).buffer(2).exterior
    >>> ties = tie_islands(shapely.MultiLineString([ring]), shapely.box(-5, -4, 5, 4), width=0.5, walled=True)
    >>> len(ties.segments), float(np.abs(ties.segments[0, 0] - ties.segments[0, 1]).max().round(3)), ties.loose
    (1, 2.0, 0)
    """
    rooms = shapely.get_parts(room)
    ties = [_tie_in_room(lines, polygon, width, walled=walled) for polygon in rooms if polygon.area > width**2]
    return Ties.none().join(ties)


def has_islands(lines: shapely.Geometry, room: shapely.Polygon, *, width: float, walled: bool) -> bool:
    """Tell whether lines in a room, and its rims if they are walls, hang together in more than one piece."""
    return len(_pieces_in_room(lines, room, width, walled=walled)[0]) > 1


def _tie_in_room(lines: shapely.Geometry, room: shapely.Polygon, width: float, *, walled: bool) -> Ties:
    """Find the ties in a room of one part."""
    pieces, rims = _pieces_in_room(lines, room, width, walled=walled)
    if len(pieces) < 2:
        return Ties.none()
    points, piece = _points_along(pieces, width)
    inner = room.buffer(BESIDE * width if walled else -width / 2)
    pairs, loose = _shortest_tree(points, piece, len(pieces), room.buffer(BESIDE * width), inner)
    segments, drawn = [], []
    for start, end in pairs:
        a, b = piece[start], piece[end]
        segment = shapely.get_coordinates(shapely.shortest_line(pieces[a], pieces[b]))
        if not shapely.covers(inner, shapely.linestrings(segment)):
            segment = points[[start, end]]
        along = segment[1] - segment[0]
        along *= width / np.linalg.norm(along)
        into = [INTO_WALL if number < rims else INTO for number in (a, b)]
        segments.append(segment)
        drawn.append(np.array([segment[0] - into[0] * along, segment[1] + into[1] * along]))
    shape = (-1, 2, 2)
    return Ties(segments=np.array(segments).reshape(shape), drawn=np.array(drawn).reshape(shape), loose=loose)


def _pieces_in_room(
    lines: shapely.Geometry, room: shapely.Polygon, width: float, *, walled: bool
) -> tuple[list[shapely.Geometry], int]:
    """Return the connected groups of a room: first pieces with a rim, then islands; and the number of the former."""
    touching = TOUCHING * width
    strokes = shapely.get_parts(shapely.intersection(lines, room.buffer(touching if walled else 0.0)))
    strokes = strokes[shapely.length(strokes) > 0]
    rims = shapely.get_parts(shapely.get_rings(room)) if walled else np.empty(0, dtype=object)
    parts = np.concatenate([rims, strokes])
    start, end = shapely.STRtree(parts).query(parts, predicate="dwithin", distance=touching)
    names, count = label_connected(start, end, len(parts))
    order = list(dict.fromkeys(names.tolist()))  # those with rims come first
    pieces = [shapely.multilinestrings([_as_line(part) for part in parts[names == name]]) for name in order]
    return pieces, len(set(names[: len(rims)].tolist())) if count else 0


def _as_line(part: shapely.Geometry) -> shapely.LineString:
    """Return the corners of a geometry as a line."""
    return shapely.linestrings(shapely.get_coordinates(part))


def _points_along(pieces: list[shapely.Geometry], width: float) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return points along pieces, (N, 2) mm, and the piece of each."""
    step = max(STEP * width, sum(shapely.length(pieces).tolist()) / MOST_POINTS)
    points, piece = shapely.get_coordinates(shapely.segmentize(pieces, step), return_index=True)
    return points, piece


def _shortest_tree(
    points: NDArray[np.float64], piece: NDArray[np.intp], count: int, room: shapely.Polygon, inner: shapely.Polygon
) -> tuple[list[tuple[int, int]], int]:
    """Return the edges between points, as their numbers, that join pieces; and how many pieces remain apart.

    Edges lie in the room, and rather in its inner part.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import minimum_spanning_tree
    from scipy.spatial import Delaunay

    low, high = points.min(axis=0), points.max(axis=0)
    margin = np.ptp(points, axis=0).max()
    around = shapely.get_coordinates(shapely.box(*(low - margin), *(high + margin)))[:4]  # so that not all lie in a row
    corners = Delaunay(np.concatenate([points, around])).simplices
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges = edges[(edges < len(points)).all(axis=1)]
    edges = edges[piece[edges[:, 0]] != piece[edges[:, 1]]]
    shapely.prepare(room)
    edges = edges[shapely.covers(room, shapely.linestrings(points[edges]))]
    length = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    length = np.where(shapely.covers(inner, shapely.linestrings(points[edges])), length, AT_SKIN * length)
    pair = np.sort(piece[edges], axis=1)
    order = np.lexsort([*edges.T, length, pair[:, 1], pair[:, 0]])
    _, least = np.unique(pair[order], axis=0, return_index=True)
    edges, length, pair = edges[order][least], length[order][least], pair[order][least]
    graph = coo_array((np.maximum(length, np.finfo(float).tiny), (pair[:, 0], pair[:, 1])), shape=(count, count))
    tree = minimum_spanning_tree(graph).tocoo()
    chosen = {(int(a), int(b)) for a, b in zip(tree.row, tree.col, strict=True)}
    numbers = [k for k, (a, b) in enumerate(pair.tolist()) if (a, b) in chosen]
    return [(int(a), int(b)) for a, b in edges[numbers]], count - 1 - len(chosen)
