"""The slicer's own infill with its corners rounded: ends, order and travel stay as they are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.corners import Machine, Rounded, rounded
from infill.filling.curves import MOST_BULGE, recut
from infill.filling.surroundings import BESIDE, TOWARDS, Beads, beads, beside, bounded_deviation
from infill.gcode.sections import Marks, Strokes
from infill.gcode.splicing import UNIT, Redrawn
from infill.gcode.table import Table

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LINE_WIDTH = 0.45  # mm, where no tag tells it
MOST_WIDENED = 1.08  # how much wider beads may become to make up for shorter paths


@dataclass(frozen=True, kw_only=True)
class Rounding:
    """How corners are rounded.

    Parameters
    ----------
    deviation : float, mm
        How far an arc may lie from its corner.
    radius : float, mm
        Its largest radius.
    corner : float
        See `Machine`.
    same_filament : bool
        Widen the beads so that each stroke keeps its filament, up to 8 %.
    """

    deviation: float = math.inf
    radius: float = math.inf
    corner: float = 9.0
    same_filament: bool = False


def line_width(marks: Marks, line: Places) -> Floats:
    """Return the line width, mm, on some lines."""
    width = marks.width[line]
    return np.where(np.isnan(width), LINE_WIDTH, width)


def first_moves(infill: Strokes) -> Places:
    """Return the line of the first move of every stroke."""
    return infill.line[infill.first[:-1] + 1]


def rounded_strokes(
    table: Table, marks: Marks, infill: Strokes, rounding: Rounding, *, acceleration: float = 1000.0
) -> Rounded:
    """Round the strokes of a table, layer by layer.

    Parameters
    ----------
    table : Table
        Whole layers.
    acceleration : float, mm/s²
        Where no command tells it.
    """
    opens = first_moves(infill)
    commanded = marks.acceleration[opens]
    return smoothed(
        infill.points,
        infill.first,
        walls=beads(table, marks, infill),
        layer=marks.layer[opens],
        acceleration=np.where(np.isnan(commanded), acceleration, commanded),
        speed=np.maximum(table.f[opens] / 60, 1.0),
        rounding=rounding,
        line_width=float(np.median(line_width(marks, opens))) if len(opens) else LINE_WIDTH,
    )


def smoothed(
    points: Floats,
    first: Places,
    *,
    walls: Beads | Floats | None,
    layer: Places | None = None,
    acceleration: Floats,
    speed: Floats,
    rounding: Rounding,
    line_width: float,
    hard: NDArray[np.bool_] | None = None,
) -> Rounded:
    """Cut the curves of some paths anew and round the corners.

    Parameters
    ----------
    points : (N, 2) float64, mm
    first : (M + 1,) int
        Where each path begins.
    walls : Beads, or (K, 2) float64, optional
        What corners may lie beside, of all layers or of the only one.
    layer : (M,) int, ascending, optional
        Of the paths; needed if `walls` has layers.
    acceleration, speed : (M,) float64
        mm/s² and mm/s.
    rounding : Rounding
    line_width : float, mm
    hard : (N,) bool, optional
        Points that stay as they are.
    """

    def machine(begins: Places) -> Machine:
        count = np.diff(begins)
        return Machine(
            acceleration=np.repeat(acceleration, count), speed=np.repeat(speed, count), corner=rounding.corner
        )

    near = _near_walls(points, first, walls, layer, line_width)
    bulge = np.where(near, TOWARDS, MOST_BULGE)
    if hard is not None:
        bulge[hard] = 0.0
    curves = recut(points, first, machine(first), bulge)
    inner = ~curves.curved
    inner[curves.first[:-1]] = inner[curves.first[1:] - 1] = False
    corner = np.flatnonzero(inner)
    deviation = np.zeros(len(curves.points))
    deviation[corner] = rounding.deviation
    # Corners of their own beside other beads hardly move.
    corner = corner[near[curves.source[corner]]]
    for some, others in _by_layer(corner, curves.first, walls, layer):
        deviation[some] = bounded_deviation(
            curves.points, some, others, deviation=rounding.deviation, line_width=line_width
        )
    if hard is not None:
        deviation[hard[curves.source]] = 0.0
    done = rounded(
        curves.points,
        curves.first,
        deviation=deviation,
        radius=rounding.radius,
        machine=machine(curves.first),
        unit=UNIT,
    )
    radius = np.full(len(points), np.inf)
    kept = np.flatnonzero(~curves.curved)
    radius[curves.source[kept]] = done.radius[kept]
    return Rounded(points=done.points, first=done.first, source=curves.source[done.source], radius=radius)


def _by_layer(
    some: Places, first: Places, walls: Beads | Floats | None, layer: Places | None
) -> Iterator[tuple[Places, Floats]]:
    """Yield the points among some that belong to one layer, and the points on its other beads."""
    if isinstance(walls, Beads) and layer is not None:
        of = np.repeat(layer, np.diff(first))[some]
        for number in np.unique(of):
            yield some[slice(*np.searchsorted(of, [number, number + 1]))], walls.of(int(number))
    elif isinstance(walls, np.ndarray):
        yield some, walls


def _near_walls(
    points: Floats, first: Places, walls: Beads | Floats | None, layer: Places | None, line_width: float
) -> NDArray[np.bool_]:
    """Return which points lie beside another bead of their layer."""
    near = np.zeros(len(points), dtype=bool)
    for some, others in _by_layer(np.arange(len(points)), first, walls, layer):
        near[some[beside(points[some], others, BESIDE * line_width)[0]]] = True
    return near


def points_of(first: Places, some: Places) -> Places:
    """Return the numbers of the points of some paths, one path after another."""
    number = first[some + 1] - first[some]
    begins = np.repeat(first[some] - np.concatenate([[0], np.cumsum(number)[:-1]]), number)
    places: Places = np.arange(int(number.sum())) + begins
    return places


def lengths(points: Floats, first: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[first[1:] - 1] - along[first[:-1]])


def redrawn(infill: Strokes, new: Rounded, chosen: NDArray[np.bool_], rounding: Rounding) -> Redrawn:
    """Return the strokes to draw anew: those chosen that rounding changed."""
    number = np.diff(new.first)
    which = np.flatnonzero(chosen & _changed(infill, new))
    at = points_of(new.first, which)
    length = lengths(new.points, new.first)[which]
    rate = infill.filament[which] / infill.length[which]
    filament = rate * length
    if rounding.same_filament:
        filament = np.minimum(infill.filament[which], filament * MOST_WIDENED)
    return Redrawn(
        which=which,
        points=new.points[at],
        first=np.concatenate([[0], np.cumsum(number[which])]),
        source=new.source[at],
        filament=filament,
    )


def _changed(infill: Strokes, new: Rounded) -> NDArray[np.bool_]:
    """Return which strokes have other points than before."""
    changed: NDArray[np.bool_] = np.diff(new.first) != np.diff(infill.first)
    alike = np.flatnonzero(~changed)
    old, now = infill.points[points_of(infill.first, alike)], new.points[points_of(new.first, alike)]
    moved = (np.abs(old[:, 0] - now[:, 0]) > UNIT / 2) | (np.abs(old[:, 1] - now[:, 1]) > UNIT / 2)
    owner = np.repeat(alike, np.diff(infill.first)[alike])
    changed[owner[moved]] = True
    return changed
