"""The outline of a region as edges with their places along it: to cut paths at it, and to join paths along it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import GeometryError
from infill.paths.families.family import Path

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Numbers = NDArray[np.intp]

MOST_BOXES = 32  # around the edges of an outline: with more, leaving out what is far away takes as long as it saves
ROUNDING = 1e-12  # of coordinates: what an exact test may find nearer than sums of them do


@dataclass(frozen=True, kw_only=True)
class Outline:
    """The rings of a region, each a sequence of edges.

    Attributes
    ----------
    region : Polygon or MultiPolygon
        mm, prepared.
    begin, end : (E, 2) float64
        Edges, mm.
    ring : (E,) int
        The ring of each edge.
    place : (E,) float64
        Distance along its ring at which an edge begins, mm.
    around : (R,) float64
        Lengths of the rings, mm.
    first : (R + 1,) int
        The first edge of each ring.
    """

    region: Any
    begin: Path
    end: Path
    ring: Numbers
    place: Floats
    around: Floats
    first: Numbers

    @cached_property
    def boxes(self) -> tuple[Path, Path]:
        """Lower and upper corners of boxes around successive edges, (B, 2) each, mm: `MOST_BOXES` or a few more."""
        size = max(1, -(-len(self.begin) // MOST_BOXES))
        starts = np.concatenate([np.arange(low, high, size) for low, high in pairwise(self.first.tolist())])
        low, high = np.minimum(self.begin, self.end), np.maximum(self.begin, self.end)
        return np.minimum.reduceat(low, starts), np.maximum.reduceat(high, starts)

    def may_reach(self, begin: Path, end: Path, distance: float = 0.0) -> NDArray[np.bool_]:
        """Tell which segments, (N, 2) mm, may lie within a distance, mm, of the outline: no other one does.

        >>> from shapely import box
        >>> begin, end = np.array([[1.0, 1.0], [1.0, 1.0]]), np.array([[2.0, 1.0], [4.0, 1.0]])
        >>> outline_of(box(0, 0, 3, 2)).may_reach(begin, end).tolist()
        [False, True]
        """
        # Axis by axis: NumPy is slow along the short axis of an array.
        (low_x, low_y), (high_x, high_y) = np.minimum(begin, end).T, np.maximum(begin, end).T
        reaches = np.zeros(len(begin), dtype=bool)
        margin = distance + ROUNDING * max(float(np.abs(corners).max()) for corners in self.boxes)
        for (left, bottom), (right, top) in zip(*(corners.tolist() for corners in self.boxes), strict=True):
            reaches |= (
                (low_x <= right + margin)
                & (high_x >= left - margin)
                & (low_y <= top + margin)
                & (high_y >= bottom - margin)
            )
        return reaches

    def points_at(self, ring: int, places: Floats) -> Path:
        """Return points at places along a ring, (N, 2), mm; a place beyond its length goes round."""
        edges = slice(self.first[ring], self.first[ring + 1])
        corner_places = np.append(self.place[edges], self.around[ring])
        points = np.concatenate([self.begin[edges], self.begin[edges][:1]])
        places = places % self.around[ring]
        return np.stack([np.interp(places, corner_places, points[:, axis]) for axis in (0, 1)], axis=-1)

    def corners_between(self, ring: int, begin: float, length: float) -> Path:
        """Return only the corners that a ring has within `length` mm after `begin`, without the ends: (N, 2), mm."""
        first_edge, count = int(self.first[ring]), int(self.first[ring + 1] - self.first[ring])
        corner_places, around = self.place[first_edge : first_edge + count], float(self.around[ring])
        begin %= around
        low = int(corner_places.searchsorted(begin, side="right"))
        end = begin + length
        high = (
            int(corner_places.searchsorted(end))
            if end <= around
            else count + int(corner_places.searchsorted(end - around))
        )
        corners: Path = self.begin[first_edge + np.arange(low, high) % count]
        return corners

    def stretch(self, ring: int, begin: float, length: float) -> Path:
        """Return the ring from a place on, backwards if `length` is below 0: (N, 2), with both ends, mm."""
        begin_point, end_point = self.points_at(ring, np.array([begin, begin + length]))
        corners = self.corners_between(ring, begin + min(length, 0.0), abs(length))[:: 1 if length > 0 else -1]
        return np.concatenate([begin_point[None], corners, end_point[None]])


def outline_of(region: Polygon | MultiPolygon) -> Outline:
    """Build the outline of a region, or raise GeometryError unless it is valid and has an area.

    >>> from shapely import box
    >>> outline_of(box(0, 0, 3, 2)).around.tolist()
    [10.0]
    """
    import shapely

    if region.geom_type not in ("Polygon", "MultiPolygon"):
        raise GeometryError(f"the region is a {region.geom_type}; give a Polygon or a MultiPolygon")
    if region.is_empty or not region.is_valid:
        reason = "empty" if region.is_empty else shapely.is_valid_reason(region)
        raise GeometryError(f"the region is not a valid one ({reason}); give one whose rings neither cross nor vanish")
    points, ring_of = shapely.get_coordinates(shapely.get_rings(shapely.get_parts(region)), return_index=True)
    begin, end = points[:-1], points[1:]
    edge = (ring_of[1:] == ring_of[:-1]) & (begin != end).any(axis=-1)
    begin, end, ring = begin[edge], end[edge], ring_of[:-1][edge].astype(np.intp)
    first_edge = np.searchsorted(ring, np.arange(ring_of[-1] + 2))
    distance = np.concatenate([[0.0], np.cumsum(np.hypot(*(end - begin).T))])
    shapely.prepare(region)
    return Outline(
        region=region,
        begin=begin,
        end=end,
        ring=ring,
        place=distance[:-1] - distance[first_edge[ring]],
        around=np.diff(distance[first_edge]),
        first=first_edge,
    )
