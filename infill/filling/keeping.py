"""The slicer's own infill with its corners rounded: ends, order and travel stay as they are."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import Contact, Samples, contact, sampled
from infill.filling.corners import Machine, Rounded, rounded
from infill.filling.surroundings import beads, bounded_deviation
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
    layer = marks.layer[opens]
    count = np.diff(infill.first)
    deviation = np.full(len(infill.points), rounding.deviation)
    for number in np.unique(layer):
        some = np.flatnonzero(layer == number)
        at = _points_of(infill.first, some)
        walls = beads(table, infill, marks.layer == number)
        first = np.concatenate([[0], np.cumsum(count[some])])
        width = float(np.median(line_width(marks, opens[some])))
        deviation[at] = bounded_deviation(
            infill.points[at], first, walls, deviation=rounding.deviation, line_width=width
        )
    commanded = marks.acceleration[opens]
    machine = Machine(
        acceleration=np.repeat(np.where(np.isnan(commanded), acceleration, commanded), count),
        speed=np.repeat(np.maximum(table.f[opens] / 60, 1.0), count),
        corner=rounding.corner,
    )
    return rounded(infill.points, infill.first, deviation=deviation, radius=rounding.radius, machine=machine, unit=UNIT)


def _points_of(first: Places, some: Places) -> Places:
    """Return the numbers of the points of some paths, one path after another."""
    number = first[some + 1] - first[some]
    begins = np.repeat(first[some] - np.concatenate([[0], np.cumsum(number)[:-1]]), number)
    return np.arange(int(number.sum())) + begins


def lengths(points: Floats, first: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[first[1:] - 1] - along[first[:-1]])


def redrawn(infill: Strokes, new: Rounded, chosen: NDArray[np.bool_], rounding: Rounding) -> Redrawn:
    """Return the strokes to draw anew: those chosen that rounding changed."""
    number = np.diff(new.first)
    which = np.flatnonzero(chosen & (number != np.diff(infill.first)))
    at = _points_of(new.first, which)
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


@dataclass(frozen=True, kw_only=True)
class Layer:
    """What a layer prints, as points.

    Parameters
    ----------
    infill : Samples
    walls : (N, 2) float64, mm
        On everything else.
    """

    infill: Samples
    walls: Floats

    @property
    def all_points(self) -> Floats:
        """Points on everything, (N, 2), mm."""
        return np.concatenate([self.infill.points, self.walls])


def layer_of(table: Table, marks: Marks, infill: Strokes, points: Floats, first: Places, number: int) -> Layer:
    """Return one layer with the infill drawn along `points`, `first`: the old paths or new ones."""
    some = np.flatnonzero(marks.layer[first_moves(infill)] == number)
    at = _points_of(first, some)
    ends = np.concatenate([[0], np.cumsum((first[1:] - first[:-1])[some])])
    walls = beads(table, infill, marks.layer == number, 0.1)
    return Layer(infill=sampled(points[at], ends), walls=walls)


def contact_of(layer: Layer, below: Layer, width: float) -> Contact:
    """Measure what holds up the infill of a layer."""
    return contact(layer.infill, layer.walls, below.all_points, width)
