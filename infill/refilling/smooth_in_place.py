"""The slicer's own infill with its corners rounded: ends, order and travel stay as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.sections import Strokes
from infill.gcode.splicing import Redrawn
from infill.paths.corners import UNIT, Rounded
from infill.paths.rounding import Corners, Rounding, corners_of
from infill.ragged import picked
from infill.refilling.batch import Batch
from infill.refilling.widest_gap import largest_moves

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

MOST_WIDENED = 1.08  # how much wider beads may become to make up for shorter paths


def stroke_corners(batch: Batch, corner: float, *, acceleration: float) -> Corners:
    """Return the strokes of a batch with their curves cut anew, and their corners.

    Parameters
    ----------
    batch : Batch
    corner : float
        See `Machine`.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    return corners_of(
        batch.infill.points,
        batch.infill.first,
        walls=batch.others.walls(np.unique(batch.layer)),
        layer=batch.layer,
        acceleration=batch.acceleration(acceleration),
        speed=batch.speed,
        corner=corner,
        line_width=batch.line_width,
        wide=True,
        limit=largest_moves(batch),
        keep_touch=True,
    )


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
    drawn = Redrawn(
        which=which,
        points=new.points[at],
        first=first,
        source=new.source[at],
        filament=rate * length,
    )
    return replace(drawn, filament=same_filament(infill, drawn)) if rounding.same_filament else drawn


def same_filament(infill: Strokes, new: Redrawn) -> Floats:
    """Return the filament, mm, that strokes drawn anew take with wider beads, (S,): as before, or all these hold."""
    length = lengths(new.points, new.first)
    rate = infill.filament[new.which] / infill.length[new.which]
    return np.minimum(infill.filament[new.which], rate * length * MOST_WIDENED)


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
