"""Round the corners of paths as far as the beads beside them allow, and recut their curves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.paths.corner_offset import CornerFreedom, corner_freedom, offset_corners
from infill.paths.corners import COARSEST, UNIT, Machine, RoundedPaths, corner_turns, inner_points, round_corners
from infill.paths.curves import MOST_BULGE, RecutPaths, recut_curves
from infill.paths.neighbours import BESIDE, TOWARDS_LIMIT, BeadIndex, deviation_beside_beads
from infill.paths.short_segments import merge_short_segments
from infill.paths.speeds import find_peak_speeds
from infill.paths.touch import touch_preserving_deviations
from infill.ragged import concatenate_rows, split_rows

BESIDE_WALLS = 2.5  # times the deviation of other corners; from 3 on, chopped parts gain no time and move farther


@dataclass(frozen=True, kw_only=True)
class Rounding:
    """Limits by which corners are rounded.

    Parameters
    ----------
    deviation : float, mm
        Limit of the move of a path at its corners. Corners beside other beads support no other infill: they may
        move `BESIDE_WALLS` times as far.
    most : float, mm
        Upper limit for these.
    radius : float, mm
        Its largest radius.
    corner : float
        See `Machine`.
    same_filament : bool
        Widen the beads so that each stroke keeps its filament, up to 8 %.
    segments_per_second : float
        That the controller of the machine can take.
    coarsest : float, mm
        See `Machine`.
    """

    deviation: float = math.inf
    most: float = math.inf
    radius: float = math.inf
    corner: float = 9.0
    same_filament: bool = False
    segments_per_second: float = math.inf
    coarsest: float = COARSEST

    def merge_segments(
        self, paths: RoundedPaths, *, speed: float | Floats, acceleration: float | Floats
    ) -> RoundedPaths:
        """Merge segments that the machine passes before its controller has read the next one, and those of no use.

        Parameters
        ----------
        paths : RoundedPaths
        speed, acceleration : float or (M,) float64
            mm/s and mm/s², of each path if arrays.
        """
        if math.isinf(self.segments_per_second):
            return merge_short_segments(paths)
        peaks = find_peak_speeds(paths.points, paths.first, speed=speed, acceleration=acceleration, corner=self.corner)
        return merge_short_segments(paths, peaks / self.segments_per_second)


@dataclass(frozen=True, kw_only=True)
class PathCorners:
    """Paths with recut curves, and their remaining corners with all that limits them.

    Parameters
    ----------
    curves : RecutPaths
    old : int
        Number of points before.
    machine : Machine
    inner : (C,) int
        The points of `curves` that are corners and may change.
    beside : (B,) int
        The corners that lie beside other beads.
    near : (B,) float64, mm
        Their distances.
    layer : (B,) int
    walls : BeadIndex
        The other beads.
    line_width : float, mm
    room : CornerFreedom, optional
        Corners that may move outwards.
    limit : (K,) float64, mm, optional
        Limit of the move at each point of `curves`, whatever the rounding.
    radii : (K,) float64, mm, optional
        Limit of the radius at each of them.
    """

    curves: RecutPaths
    old: int
    machine: Machine
    inner: Places
    beside: Places
    near: Floats
    layer: Places
    walls: BeadIndex
    line_width: float
    room: CornerFreedom | None = None
    limit: Floats | None = None
    radii: Floats | None = None

    def rounded(self, rounding: Rounding) -> RoundedPaths:
        """Return the paths with round corners."""
        points, offsets = self.curves.points, self.curves.first
        deviation = np.zeros(len(points))
        limit = np.full(len(points), np.inf) if self.limit is None else self.limit
        deviation[self.inner] = np.minimum(rounding.deviation, limit[self.inner])
        deviation[self.beside] = deviation_beside_beads(
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
            room_limit = np.minimum(rounding.deviation, limit[self.room.corner])
            points, room_deviation = offset_corners(points, self.room, deviation=room_limit, radius=rounding.radius)
            deviation[self.room.corner] = room_deviation
        largest = rounding.radius if self.radii is None else np.minimum(self.radii, rounding.radius)
        result = round_corners(points, offsets, deviation=deviation, radius=largest, machine=self.machine, unit=UNIT)
        radius = np.full(self.old, np.inf)
        corners = np.flatnonzero(~self.curves.curved)
        radius[self.curves.source[corners]] = result.radius[corners]
        return RoundedPaths(
            points=result.points, first=result.first, source=self.curves.source[result.source], radius=radius
        )


def find_corners(
    points: Floats,
    offsets: Places,
    *,
    walls: BeadIndex,
    layer: Places,
    acceleration: Floats,
    speed: Floats,
    corner: float,
    line_width: float,
    segments_per_second: float = math.inf,
    coarsest: float = COARSEST,
    hard: NDArray[np.bool_] | None = None,
    wide: bool = False,
    limit: Floats | None = None,
    keep_touch: bool = False,
    radii: Floats | None = None,
    recut: bool = True,
) -> PathCorners:
    """Recut the curves of some paths, and find their corners.

    Parameters
    ----------
    points : (N, 2) float64, mm
    offsets : (M + 1,) int
        Where each path begins.
    walls : BeadIndex
        Other beads.
    layer : (M,) int
        Of each path.
    acceleration, speed : (M,) float64
        mm/s² and mm/s.
    corner : float
        See `Machine`.
    line_width : float, mm
    segments_per_second, coarsest : float
        See `Rounding`.
    hard : (N,) bool, optional
        Points that stay as they are.
    wide : bool
        Move corners outwards where there is room.
    limit : (M,) float64, mm, optional
        Limit of the move of each path.
    keep_touch : bool
        Keep the length that touches walls: see `infill.paths.touch`.
    radii : (N,) float64, mm, optional
        Limit of the radius at each point.
    recut : bool
        Recut curves; otherwise all turns are corners.
    """

    def machine_of(begins: Places) -> Machine:
        """Return the machine at the points of paths that begin at these places."""
        count = np.diff(begins)
        return Machine(
            acceleration=np.repeat(acceleration, count),
            speed=np.repeat(speed, count),
            corner=corner,
            segments_per_second=segments_per_second,
            coarsest=coarsest,
        )

    layer_of = np.repeat(layer, np.diff(offsets))
    distance = walls.distances(points, layer_of, BESIDE * line_width)
    hard = np.zeros(len(points), dtype=bool) if hard is None else hard
    bulge = np.where(np.isfinite(distance), TOWARDS_LIMIT, MOST_BULGE) if recut else np.zeros(len(points))
    bulge[hard] = 0.0
    curves = recut_curves(points, offsets, machine_of(offsets), bulge)
    inner = ~curves.curved
    inner[curves.first[:-1]] = inner[curves.first[1:] - 1] = False
    corners = np.flatnonzero(inner & ~hard[curves.source])
    is_beside = np.isfinite(distance[curves.source[corners]])
    beside_walls = corners[is_beside]
    layers = layer_of[curves.source]
    point_limit = None if limit is None else np.repeat(limit, np.diff(curves.first))
    if keep_touch:
        point_limit = np.full(len(curves.points), np.inf) if point_limit is None else point_limit
        touch = touch_preserving_deviations(curves.points, curves.first, corners, layers, walls, line_width=line_width)
        point_limit[corners] = np.minimum(point_limit[corners], touch)
    open_corners = corners[~is_beside]
    freedom = partial(corner_freedom, curves.points, curves.first, open_corners, layers, walls, line_width=line_width)
    return PathCorners(
        curves=curves,
        old=len(points),
        machine=machine_of(curves.first),
        inner=corners,
        beside=beside_walls,
        near=distance[curves.source[beside_walls]],
        layer=layer_of[curves.source[beside_walls]],
        walls=walls,
        line_width=line_width,
        room=freedom() if wide else None,
        limit=point_limit,
        radii=None if radii is None else radii[curves.source],
    )


def _slight_turns(points: Floats, offsets: Places, least: float) -> NDArray[np.bool_]:
    """Find the points inside paths where these turn by less than `least` radians: (N,)."""
    slight = np.zeros(len(points), dtype=bool)
    inner = inner_points(len(points), offsets)
    slight[inner] = corner_turns(points, inner)[0] < least
    return slight


def round_paths(
    paths: Sequence[Floats],
    *,
    walls: BeadIndex,
    acceleration: float,
    speed: float,
    rounding: Rounding,
    line_width: float,
    hard: NDArray[np.bool_] | None = None,
    wide: bool = False,
    radii: Floats | None = None,
    kept_turn: float = 0.0,
) -> tuple[list[Floats], Floats]:
    """Round the corners of paths of layer 0; return the paths and the radii of their arcs, mm.

    The arguments are those of `find_corners`. With `kept_turn`, radians, no curves are recut, and points where a path
    turns by less stay as they are.
    """
    if not len(paths):
        return [], np.empty(0)
    points, offsets = concatenate_rows(paths)
    if kept_turn:
        slight = _slight_turns(points, offsets, kept_turn)
        hard = slight if hard is None else hard | slight
    corners = find_corners(
        points,
        offsets,
        walls=walls,
        layer=np.zeros(len(paths), dtype=np.intp),
        acceleration=np.full(len(paths), acceleration),
        speed=np.full(len(paths), speed),
        corner=rounding.corner,
        line_width=line_width,
        segments_per_second=rounding.segments_per_second,
        coarsest=rounding.coarsest,
        hard=hard,
        wide=wide,
        radii=radii,
        recut=not kept_turn,
    )
    result = rounding.merge_segments(corners.rounded(rounding), speed=speed, acceleration=acceleration)
    return split_rows(result.points, result.first), result.radius
