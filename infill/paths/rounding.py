"""Paths with round corners: curves cut anew, corners as round as other beads beside them allow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.paths.corner_offset import Room, room_of, widened
from infill.paths.corners import UNIT, Machine, Rounded, rounded
from infill.paths.curves import MOST_BULGE, Recut, recut
from infill.paths.neighbours import BESIDE, TOWARDS, Walls, bounded_deviation
from infill.paths.touch import deviations_that_keep_touch
from infill.ragged import packed, parted

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

BESIDE_WALLS = 2.5  # times the deviation of others; with 3, and more, chopped parts gain no time and move farther


@dataclass(frozen=True, kw_only=True)
class Rounding:
    """How corners are rounded.

    Parameters
    ----------
    deviation : float, mm
        How far a path may move at its corners. Those beside other beads hold nothing but themselves: they may move
        `BESIDE_WALLS` times as far.
    most : float, mm
        How far those may move as well.
    radius : float, mm
        Its largest radius.
    corner : float
        See `Machine`.
    same_filament : bool
        Widen the beads so that each stroke keeps its filament, up to 8 %.
    """

    deviation: float = math.inf
    most: float = math.inf
    radius: float = math.inf
    corner: float = 9.0
    same_filament: bool = False


@dataclass(frozen=True, kw_only=True)
class Corners:
    """Some paths with their curves cut anew, and what is known of the corners that are left.

    Parameters
    ----------
    curves : Recut
    old : int
        Number of points before.
    machine : Machine
    inner : (C,) int
        The points of `curves` that are corners and may change.
    beside : (B,) int
        Those of them that lie beside other beads.
    near : (B,) float64, mm
        How near.
    layer : (B,) int
    walls : Walls
        The other beads.
    line_width : float, mm
    room : Room, optional
        Where corners may be taken wide.
    limit : (K,) float64, mm, optional
        How far the path may move at each point of `curves`, whatever the rounding.
    """

    curves: Recut
    old: int
    machine: Machine
    inner: Places
    beside: Places
    near: Floats
    layer: Places
    walls: Walls
    line_width: float
    room: Room | None = None
    limit: Floats | None = None

    def rounded(self, rounding: Rounding) -> Rounded:
        """Return the paths with round corners."""
        points, first = self.curves.points, self.curves.first
        deviation = np.zeros(len(points))
        limit = np.full(len(points), np.inf) if self.limit is None else self.limit
        deviation[self.inner] = np.minimum(rounding.deviation, limit[self.inner])
        deviation[self.beside] = bounded_deviation(
            points,
            self.beside,
            self.near,
            self.walls,
            self.layer,
            deviation=min(BESIDE_WALLS * rounding.deviation, rounding.most),
            line_width=self.line_width,
        )
        deviation[self.beside] = np.minimum(deviation[self.beside], limit[self.beside])
        if self.room is not None:
            most = np.minimum(rounding.deviation, limit[self.room.corner])
            points, wide = widened(points, self.room, deviation=most, radius=rounding.radius)
            deviation[self.room.corner] = wide
        done = rounded(points, first, deviation=deviation, radius=rounding.radius, machine=self.machine, unit=UNIT)
        radius = np.full(self.old, np.inf)
        kept = np.flatnonzero(~self.curves.curved)
        radius[self.curves.source[kept]] = done.radius[kept]
        return Rounded(points=done.points, first=done.first, source=self.curves.source[done.source], radius=radius)


def corners_of(
    points: Floats,
    first: Places,
    *,
    walls: Walls,
    layer: Places,
    acceleration: Floats,
    speed: Floats,
    corner: float,
    line_width: float,
    hard: NDArray[np.bool_] | None = None,
    wide: bool = False,
    limit: Floats | None = None,
    keep_touch: bool = False,
) -> Corners:
    """Cut the curves of some paths anew, and find their corners.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
        Where each path begins.
    walls : Walls
        What corners may lie beside.
    layer : (M,) int
        Of each path.
    acceleration, speed : (M,) float64
        mm/s² and mm/s.
    corner : float
        See `Machine`.
    line_width : float, mm
    hard : (N,) bool, optional
        Points that stay as they are.
    wide : bool
        Take corners wide where there is room.
    limit : (M,) float64, mm, optional
        How far each path may move at most.
    keep_touch : bool
        Leave what touches walls beside them: see `infill.paths.touch`.
    """

    def machine(begins: Places) -> Machine:
        count = np.diff(begins)
        return Machine(acceleration=np.repeat(acceleration, count), speed=np.repeat(speed, count), corner=corner)

    of = np.repeat(layer, np.diff(first))
    near = walls.near(points, of, BESIDE * line_width)
    bulge = np.where(np.isfinite(near), TOWARDS, MOST_BULGE)
    if hard is not None:
        bulge[hard] = 0.0
    curves = recut(points, first, machine(first), bulge)
    inner = ~curves.curved
    inner[curves.first[:-1]] = inner[curves.first[1:] - 1] = False
    corners = np.flatnonzero(inner)
    if hard is not None:
        corners = corners[~hard[curves.source[corners]]]
    is_beside = np.isfinite(near[curves.source[corners]])
    beside, room = corners[is_beside], None
    layers = of[curves.source]
    most = None if limit is None else np.repeat(limit, np.diff(curves.first))
    if keep_touch:
        most = np.full(len(curves.points), np.inf) if most is None else most
        touch = deviations_that_keep_touch(curves.points, curves.first, corners, layers, walls, line_width=line_width)
        most[corners] = np.minimum(most[corners], touch)
    if wide:
        room = room_of(curves.points, curves.first, corners[~is_beside], layers, walls, line_width=line_width)
    return Corners(
        curves=curves,
        old=len(points),
        machine=machine(curves.first),
        inner=corners,
        beside=beside,
        near=near[curves.source[beside]],
        layer=of[curves.source[beside]],
        walls=walls,
        line_width=line_width,
        room=room,
        limit=most,
    )


def rounded_paths(
    paths: Sequence[Floats],
    *,
    walls: Walls,
    acceleration: float,
    speed: float,
    rounding: Rounding,
    line_width: float,
    hard: NDArray[np.bool_] | None = None,
    wide: bool = False,
) -> tuple[list[Floats], Floats]:
    """Return paths of layer 0 with round corners, and the radii of their arcs, mm; see `corners_of`."""
    if not len(paths):
        return [], np.empty(0)
    points, first = packed(paths)
    corners = corners_of(
        points,
        first,
        walls=walls,
        layer=np.zeros(len(paths), dtype=np.intp),
        acceleration=np.full(len(paths), acceleration),
        speed=np.full(len(paths), speed),
        corner=rounding.corner,
        line_width=line_width,
        hard=hard,
        wide=wide,
    )
    done = corners.rounded(rounding)
    return parted(done.points, done.first), done.radius
