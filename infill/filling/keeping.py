"""The slicer's own infill with its corners rounded: ends, order and travel stay as they are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.batch import Batch
from infill.filling.corners import Machine, Rounded, rounded
from infill.filling.curves import MOST_BULGE, recut
from infill.filling.surroundings import BESIDE, TOWARDS, Beads, beside, bounded_deviation
from infill.gcode.sections import Strokes
from infill.gcode.splicing import UNIT, Redrawn
from infill.ragged import packed, parted, picked

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

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


def rounded_strokes(batch: Batch, rounding: Rounding, *, acceleration: float) -> Rounded:
    """Round the strokes of a batch, layer by layer.

    Parameters
    ----------
    batch : Batch
    rounding : Rounding
    acceleration : float, mm/s²
        Where the print commands none.
    """
    return smoothed(
        batch.infill.points,
        batch.infill.first,
        walls=batch.others,
        layer=batch.layer,
        acceleration=batch.acceleration(acceleration),
        speed=batch.speed,
        rounding=rounding,
        line_width=batch.line_width,
    )


def smoothed_paths(
    paths: Sequence[Floats],
    *,
    walls: Floats,
    acceleration: float,
    speed: float,
    rounding: Rounding,
    line_width: float,
    hard: NDArray[np.bool_] | None = None,
) -> tuple[list[Floats], Floats]:
    """Return paths of one layer with round corners, and the radii of their arcs, mm; see `smoothed`."""
    if not len(paths):
        return [], np.empty(0)
    points, first = packed(paths)
    done = smoothed(
        points,
        first,
        walls=walls,
        acceleration=np.full(len(paths), acceleration),
        speed=np.full(len(paths), speed),
        rounding=rounding,
        line_width=line_width,
        hard=hard,
    )
    return parted(done.points, done.first), done.radius


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


def lengths(points: Floats, first: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[first[1:] - 1] - along[first[:-1]])


def redrawn(infill: Strokes, new: Rounded, chosen: NDArray[np.bool_], rounding: Rounding) -> Redrawn:
    """Return the strokes to draw anew: those chosen that rounding changed."""
    which = np.flatnonzero(chosen & _changed(infill, new))
    at, first = picked(new.first, which)
    length = lengths(new.points, new.first)[which]
    rate = infill.filament[which] / infill.length[which]
    filament = rate * length
    if rounding.same_filament:
        filament = np.minimum(infill.filament[which], filament * MOST_WIDENED)
    return Redrawn(
        which=which,
        points=new.points[at],
        first=first,
        source=new.source[at],
        filament=filament,
    )


def _changed(infill: Strokes, new: Rounded) -> NDArray[np.bool_]:
    """Return which strokes have other points than before."""
    changed: NDArray[np.bool_] = np.diff(new.first) != np.diff(infill.first)
    alike = np.flatnonzero(~changed)
    (there, _), (here, _) = picked(infill.first, alike), picked(new.first, alike)
    old, now = infill.points[there], new.points[here]
    moved = (np.abs(old[:, 0] - now[:, 0]) > UNIT / 2) | (np.abs(old[:, 1] - now[:, 1]) > UNIT / 2)
    owner = np.repeat(alike, np.diff(infill.first)[alike])
    changed[owner[moved]] = True
    return changed
