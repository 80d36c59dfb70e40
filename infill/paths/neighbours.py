"""The other beads of a layer: where a corner of the infill lies beside one of them, so that it may hardly move."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.checks import FARTHEST
from infill.paths.contact import STEP as FINE
from infill.paths.contact import Samples, projected, sampled

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

STEP = 0.2  # mm between points on other beads
BESIDE = 1.3  # line widths between the centre lines of a corner and of a bead that it lies beside
# Line widths that a corner beside a bead may move away from it. At a third, a grid touches walls along 13 % less of its
# length, at a twelfth 2 to 6 %; `touch` leaves the slicer's own infill more.
ANCHORED = 1 / 12
TOWARDS = 0.015  # mm that it may move towards it
LARGEST_DISTANCE = 5.0  # mm, of a search
NEAREST = 3  # pieces of beads around a point, of which one is the nearest
FEW = 500  # points: with so few, nothing is gained by looking where walls are
MOST_SQUARES = 1 << 24  # of a plane of squares: a byte each


@dataclass(frozen=True, kw_only=True)
class Beads:
    """The moves of a table that extrude and are not among the strokes of its infill.

    Parameters
    ----------
    ends : (N, 2, 2) float64, mm
        Where each begins and ends.
    layer : (N,) int, ascending
    skin : (N,) bool
        They belong to solid infill; else to walls, supports and so on.
    """

    ends: Floats
    layer: Places
    skin: NDArray[np.bool_]

    def walls(self, layers: Places) -> Walls:
        """Return the beads of some layers, ready for searches."""
        some = np.flatnonzero(np.isin(self.layer, layers))
        points = sampled(self.ends[some].reshape(-1, 2), np.arange(len(some) + 1) * 2, STEP)
        return walls_of(points.points, self.layer[some][points.path])

    def around(self, number: int, step: float) -> Around:
        """Return points on the beads of a layer, at most `step` apart, mm."""
        found = self.samples_of(number, step)
        low, high = np.searchsorted(self.layer, [number, number + 1])
        ends = self.ends[low:high].reshape(-1, 2)  # which stick out where lines turn
        skin = self.skin[low:high]
        return Around(
            points=np.concatenate([found.points, ends]),
            skin=np.append(skin[found.path], np.repeat(skin, 2)),
            half=np.concatenate([found.half, np.zeros(ends.shape)]),
        )

    def ends_of(self, number: int) -> Floats:
        """Return where the beads of a layer begin and end, (K, 2, 2), mm."""
        low, high = np.searchsorted(self.layer, [number, number + 1])
        return self.ends[low:high]

    def samples_of(self, number: int, step: float = FINE) -> Samples:
        """Return samples of the beads of a layer, at most `step` apart, mm."""
        some = self.ends_of(number)
        return sampled(some.reshape(-1, 2), np.arange(len(some) + 1) * 2, step)


@dataclass(frozen=True, kw_only=True)
class Around:
    """Points on the other beads of a layer.

    Parameters
    ----------
    points : (N, 2) float64, mm
    skin : (N,) bool
        They lie on solid infill.
    half : (N, 2) float64, mm, optional
        From each to the end of the piece of its bead whose middle it is; without it, beads are points.
    """

    points: Floats
    skin: NDArray[np.bool_]
    half: Floats | None = None

    @cached_property
    def all(self) -> Walls:
        """All of them, as layer 0."""
        return walls_of(self.points, half=self.half)

    @cached_property
    def walls(self) -> Walls:
        """Those that are no skins."""
        return walls_of(self.points[~self.skin], half=None if self.half is None else self.half[~self.skin])

    @cached_property
    def skins(self) -> Walls:
        """The skins."""
        return walls_of(self.points[self.skin], half=None if self.half is None else self.half[self.skin])


@dataclass(frozen=True, kw_only=True)
class Walls:
    """Points on the other beads of some layers, laid side by side, so that one search serves all layers.

    Parameters
    ----------
    points : (K, 2) float64, mm
        Moved along x by `pitch` for each layer.
    layers : (L,) int, ascending
    pitch : float, mm
    low, high : (2,) float64, mm
        The box that holds them, before they were moved.
    half : (K, 2) float64, mm
        From each to the end of the piece of its bead whose middle it is.
    """

    points: Floats
    layers: Places
    pitch: float
    low: Floats
    high: Floats
    half: Floats

    @cached_property
    def tree(self) -> cKDTree:
        """For searches."""
        from scipy.spatial import cKDTree

        return cKDTree(self.points, balanced_tree=False)  # built twice as fast

    def near(self, points: Floats, layer: Places | int, distance: float) -> Floats:
        """Return how near the other beads of its layer come to each point, mm; infinite from `distance` on.

        Parameters
        ----------
        points : (N, 2) float64, mm
        layer : (N,) int, or one for all
        distance : float, mm
            Up to `LARGEST_DISTANCE`.
        """
        found = np.full(len(points), np.inf)
        if not len(self.points) or not len(points):
            return found
        layer = np.broadcast_to(layer, len(points))
        slot = np.minimum(np.searchsorted(self.layers, layer), len(self.layers) - 1)
        with np.errstate(invalid="ignore"):
            # Axis by axis: NumPy is slow along the short axis of an array.
            known = self.layers[slot] == layer
            for axis in (0, 1):
                known &= points[:, axis] > self.low[axis] - distance
                known &= points[:, axis] < self.high[axis] + distance
        some = np.flatnonzero(known)
        moved = _moved(points[some], slot[some], self.pitch)
        close = _around(moved, self.points, distance) if len(some) > FEW else np.arange(len(some))
        found[some[close]] = self.tree.query(moved[close], distance_upper_bound=distance)[0]
        return found

    def nearest(self, points: Floats, layer: Places, distance: float, places: range) -> tuple[Floats, Places]:
        """Return the nearest points on other beads of its layer for each point: how far, mm, and their numbers.

        Parameters
        ----------
        points : (N, 2) float64, mm
        layer : (N,) int
            Among `layers`.
        distance : float, mm
            Up to `LARGEST_DISTANCE`.
        places : range
            Which of them, from 1 on; where there are fewer, their distance is infinite.

        Returns
        -------
        distance : (N, places) float64, mm
        number : (N, places) int
        """
        moved = _moved(points, np.searchsorted(self.layers, layer), self.pitch)
        found, number = self.tree.query(moved, k=list(places), distance_upper_bound=distance)
        return found, number


def foot(points: Floats, walls: Walls) -> tuple[Floats, Floats]:
    """Return the nearest places on other beads of a single layer, (N, 2), mm, and how far they are, (N,), mm.

    Of the pieces whose middles are nearest, `NEAREST` are looked at: where beads come together, another one may be
    nearer, by less than a tenth of a piece.

    Parameters
    ----------
    points : (N, 2) float64, mm
    walls : Walls
        Without any, all are infinitely far.
    """
    if not len(walls.points):
        return points, np.full(len(points), np.inf)
    _, which = walls.tree.query(points, k=min(NEAREST, len(walls.points)))
    which = which.reshape(len(points), -1)
    along, apart = projected(points, walls.points, walls.half, which)
    rows, best = np.arange(len(points)), apart.argmin(axis=1)
    piece = which[rows, best]
    return walls.points[piece] + along[rows, best][:, None] * walls.half[piece], apart[rows, best]


def walls_of(points: Floats, layer: Places | None = None, half: Floats | None = None) -> Walls:
    """Return points on other beads, ready for searches.

    Parameters
    ----------
    points : (K, 2) float64, mm
    layer : (K,) int, optional
        Without it, all are of layer 0.
    half : (K, 2) float64, mm, optional
        Without it, beads are points.
    """
    half = np.zeros(points.shape) if half is None else half
    layer = np.zeros(len(points), dtype=np.intp) if layer is None else layer
    real = (np.abs(points[:, 0]) < FARTHEST) & (np.abs(points[:, 1]) < FARTHEST)
    points, layer, half = points[real], layer[real], half[real]
    layers, slot = np.unique(layer, return_inverse=True)
    low = np.array([points[:, axis].min(initial=FARTHEST) for axis in (0, 1)])
    high = np.array([points[:, axis].max(initial=-FARTHEST) for axis in (0, 1)])
    pitch = float(high[0] - low[0]) + 4 * LARGEST_DISTANCE
    return Walls(points=_moved(points, slot, pitch), layers=layers, pitch=pitch, low=low, high=high, half=half)


def _moved(points: Floats, slot: Places, pitch: float) -> Floats:
    """Return points where their layer is laid."""
    return np.stack([points[:, 0] + slot * pitch, points[:, 1]], axis=1)


def _around(points: Floats, walls: Floats, distance: float) -> Places:
    """Return the points that are worth a closer look: those in squares around a wall, as wide as the distance."""
    low = np.array([walls[:, k].min() for k in (0, 1)]) - 2 * distance
    size = np.array([walls[:, k].max() for k in (0, 1)]) - low
    squares = (size / distance).astype(np.intp) + 4
    if squares[0] * squares[1] > MOST_SQUARES:
        return np.arange(len(points))
    at = ((walls[:, 0] - low[0]) / distance).astype(np.intp), ((walls[:, 1] - low[1]) / distance).astype(np.intp)
    taken = np.zeros(squares, dtype=bool)
    taken[at] = True
    taken[1:] |= taken[:-1].copy()
    taken[:-1] |= taken[1:].copy()
    taken[:, 1:] |= taken[:, :-1].copy()
    taken[:, :-1] |= taken[:, 1:].copy()
    # Points farther out fall into the outermost squares, of which none is near a wall.
    own = tuple(
        np.clip((points[:, axis] - low[axis]) / distance, 0, squares[axis] - 1).astype(np.intp) for axis in (0, 1)
    )
    return np.flatnonzero(taken[own])


def bounded_deviation(
    points: Floats,
    corners: Places,
    near: Floats,
    walls: Walls,
    layer: Places,
    *,
    deviation: float,
    line_width: float,
) -> Floats:
    """Return how far some corners of paths that lie beside other beads may move, mm: `deviation` or less.

    A corner beside a bead anchors the infill there: it moves away by a twelfth of the line width at most. One that
    would be cut towards the bead, as on a path around a boss, stays.

    Parameters
    ----------
    points : (N, 2) float64, mm
    corners : (C,) int
        Inner points, nearer than `BESIDE` line widths to another bead.
    near : (C,) float64, mm
        How near.
    walls : Walls
    layer : (C,) int
    deviation, line_width : float, mm
    """
    least = min(deviation, ANCHORED * line_width)
    then = walls.near(points[corners] + _inward(points, corners) * least, layer, BESIDE * line_width)
    return np.where(then < near - TOWARDS, min(deviation, TOWARDS), least)


def _inward(points: Floats, here: Places) -> Floats:
    """Return the direction in which rounding moves each corner: between its two legs."""
    legs = (points[here - 1] - points[here], points[here + 1] - points[here])
    before, after = (leg / np.maximum(np.hypot(*leg.T), 1e-12)[:, None] for leg in legs)
    middle = before + after
    direction: Floats = middle / np.maximum(np.hypot(*middle.T), 1e-12)[:, None]
    return direction
