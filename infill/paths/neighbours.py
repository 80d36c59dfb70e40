"""The other beads of a layer, indexed: a corner of the infill that lies beside one of them may hardly move."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats, Places
from infill.checks import FARTHEST
from infill.paths.contact import project_to_pieces
from infill.paths.point_grid import PointGrid, sort_into_grid

if TYPE_CHECKING:
    from scipy.spatial import cKDTree


BESIDE = 1.3  # line widths between the centre lines of a corner and of a bead that it lies beside
# Line widths that a corner beside a bead may move away from it. At a third, a grid touches walls along 13 % less of its
# length, at a twelfth 2 to 6 %; `touch` leaves the slicer's own infill more.
AWAY_LIMIT = 1 / 12
TOWARDS_LIMIT = 0.015  # mm that it may move towards it
LARGEST_DISTANCE = 5.0  # mm, of a search
NEAREST = 3  # candidate pieces of beads around a point
SAME_PLACE = 1e-9  # mm between places that are one


@dataclass(frozen=True, kw_only=True)
class BeadIndex:
    """Points on the other beads of some layers, laid side by side, so that one search serves all layers.

    Parameters
    ----------
    points : (K, 2) float64, mm
        Moved along x by `pitch` for each layer.
    layers : (L,) int, ascending
    pitch : float, mm
    low, high : (2,) float64, mm
        Their bounding box before the move.
    half : (K, 2) float64, mm
        From each, the middle of a piece of a bead, to the end of its piece.
    """

    points: Floats
    layers: Places
    pitch: float
    low: Floats
    high: Floats
    half: Floats

    @cached_property
    def grid(self) -> PointGrid:
        """The points in the squares of a grid."""
        return sort_into_grid(self.points if len(self.points) else np.zeros((1, 2)))

    @cached_property
    def longest(self) -> float:
        """The longest half of a piece, mm."""
        return float(np.hypot(*self.half.T).max(initial=0.0))

    @cached_property
    def tree(self) -> cKDTree:
        """Search tree of the points, which takes longer to load and to search than the grid."""
        from scipy.spatial import cKDTree

        return cKDTree(self.points, balanced_tree=False)  # built twice as fast

    def slots(self, layer: Places) -> Places:
        """Return the place of each layer among `layers`, (N,); -1 for one without beads."""
        if not len(self.layers):
            return np.full(len(layer), -1)
        slot = np.minimum(np.searchsorted(self.layers, layer), len(self.layers) - 1)
        return np.where(self.layers[slot] == layer, slot, -1)

    def distances(self, points: Floats, layer: Places | int, distance: float) -> Floats:
        """Compute distances to the other beads of each point's layer, mm; infinite from `distance` on.

        Parameters
        ----------
        points : (N, 2) float64, mm
        layer : (N,) int, or one for all
        distance : float, mm
            Up to `LARGEST_DISTANCE`.
        """
        result = np.full(len(points), np.inf)
        if not len(self.points) or not len(points):
            return result
        slot = self.slots(np.broadcast_to(layer, len(points)))
        with np.errstate(invalid="ignore"):
            # Axis by axis: NumPy is slow along the short axis of an array.
            is_candidate = slot >= 0
            for axis in (0, 1):
                is_candidate &= points[:, axis] > self.low[axis] - distance
                is_candidate &= points[:, axis] < self.high[axis] + distance
        candidates = np.flatnonzero(is_candidate)
        shifted = _shift_to_layer(points[candidates], slot[candidates], self.pitch)
        result[candidates] = self.grid.distances(shifted, distance)
        return result

    def nearest(self, points: Floats, layer: Places, distance: float, places: range) -> tuple[Floats, Places]:
        """Find the nearest points on other beads of its layer for each point; return distances, mm, and numbers.

        Parameters
        ----------
        points : (N, 2) float64, mm
        layer : (N,) int
            Among `layers`.
        distance : float, mm
            Up to `LARGEST_DISTANCE`.
        places : range
            Ranks of the neighbours to return, from 1 on; the distance of a missing one is infinite.

        Returns
        -------
        distance : (N, places) float64, mm
        number : (N, places) int
        """
        shifted = _shift_to_layer(points, np.searchsorted(self.layers, layer), self.pitch)
        number, square = self.grid.several(shifted, distance, places.stop)
        # Where two points are as near as each other, and one of them is left out, the tree chooses.
        tied = np.zeros(len(points), dtype=bool)
        for rank in (places.start - 1, places.stop - 1):
            if rank:
                tied |= (square[:, rank - 1] == square[:, rank]) & np.isfinite(square[:, rank])
        ranks = slice(places.start - 1, places.stop - 1)
        number, distances = number[:, ranks], np.sqrt(square[:, ranks])
        if tied.any():
            distances[tied], number[tied] = self.tree.query(
                shifted[tied], k=list(places), distance_upper_bound=distance
            )
        return distances, number


def project_to_beads(points: Floats, walls: BeadIndex, reach: float = np.inf) -> tuple[Floats, Floats]:
    """Project points to the beads of a single layer; return the places, (N, 2), and the distances, (N,), mm.

    Candidates are the `NEAREST` pieces with the nearest middles: where beads come together, another one may be
    nearer, by less than a tenth of a piece.

    Parameters
    ----------
    points : (N, 2) float64, mm
    walls : BeadIndex
        Without points, all distances are infinite.
    reach : float, mm
        Beyond it, distances are infinite, which saves searching; default: as far as needed.
    """
    if not len(walls.points):
        return points, np.full(len(points), np.inf)
    count = min(NEAREST, len(walls.points))
    chosen, nearest, unsure = walls.grid.project(
        points, walls.half, count, reach=reach, longest=walls.longest, same=SAME_PLACE
    )
    if unsure.any():  # there, the tree chooses among pieces that are as near as each other
        candidates = np.asarray(walls.tree.query(points[unsure], k=list(range(1, count + 1)))[1])
        along, apart = project_to_pieces(points[unsure], walls.points, walls.half, candidates)
        rows, choice = np.arange(len(apart)), apart.argmin(axis=1)
        piece = candidates[rows, choice]
        chosen[unsure] = walls.points[piece] + along[rows, choice, None] * walls.half[piece]
        nearest[unsure] = np.where(apart[rows, choice] <= reach, apart[rows, choice], np.inf)
    return chosen, nearest


def index_beads(points: Floats, layer: Places | None = None, half: Floats | None = None) -> BeadIndex:
    """Index points on other beads for searches.

    Parameters
    ----------
    points : (K, 2) float64, mm
    layer : (K,) int, optional
        Default: 0 for all.
    half : (K, 2) float64, mm, optional
        Without it, beads are points.
    """
    half = np.zeros(points.shape) if half is None else half
    layer = np.zeros(len(points), dtype=np.intp) if layer is None else layer
    on_bed = (np.abs(points[:, 0]) < FARTHEST) & (np.abs(points[:, 1]) < FARTHEST)
    points, layer, half = points[on_bed], layer[on_bed], half[on_bed]
    layers, slot = np.unique(layer, return_inverse=True)
    low = np.array([points[:, axis].min(initial=FARTHEST) for axis in (0, 1)])
    high = np.array([points[:, axis].max(initial=-FARTHEST) for axis in (0, 1)])
    pitch = float(high[0] - low[0]) + 4 * LARGEST_DISTANCE
    return BeadIndex(
        points=_shift_to_layer(points, slot, pitch), layers=layers, pitch=pitch, low=low, high=high, half=half
    )


def _shift_to_layer(points: Floats, slot: Places, pitch: float) -> Floats:
    """Shift points to the place of their layer."""
    return np.stack([points[:, 0] + slot * pitch, points[:, 1]], axis=1)


def deviation_beside_beads(
    points: Floats,
    corners: Places,
    distance: Floats,
    walls: BeadIndex,
    layer: Places,
    *,
    deviation: float,
    line_width: float,
) -> Floats:
    """Bound the moves, mm, of corners beside other beads: `deviation` or less.

    A corner beside a bead anchors the infill there: it moves away by a twelfth of the line width at most. One that
    would be cut towards the bead, as on a path around a boss, stays.

    Parameters
    ----------
    points : (N, 2) float64, mm
    corners : (C,) int
        Inner points, nearer than `BESIDE` line widths to another bead.
    distance : (C,) float64, mm
        Their distances.
    walls : BeadIndex
    layer : (C,) int
    deviation, line_width : float, mm
    """
    away_limit = min(deviation, AWAY_LIMIT * line_width)
    new_distance = walls.distances(
        points[corners] + _inward_direction(points, corners) * away_limit, layer, BESIDE * line_width
    )
    return np.where(new_distance < distance - TOWARDS_LIMIT, min(deviation, TOWARDS_LIMIT), away_limit)


def _inward_direction(points: Floats, corners: Places) -> Floats:
    """Compute the direction in which rounding moves each corner: between its two legs."""
    legs = (points[corners - 1] - points[corners], points[corners + 1] - points[corners])
    before, after = (leg / np.maximum(np.hypot(*leg.T), 1e-12)[:, None] for leg in legs)
    middle = before + after
    direction: Floats = middle / np.maximum(np.hypot(*middle.T), 1e-12)[:, None]
    return direction
