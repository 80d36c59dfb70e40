"""Round the corners of the slicer's own infill: ends, order and travel stay as they are."""

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

MOST_WIDENED = 1.08  # largest widening of beads, to make up for shorter paths


def stroke_corners(batch: Batch, corner: float, *, acceleration: float) -> Corners:
    """Recut the curves in the strokes of a batch, and find their corners.

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


def lengths(points: Floats, offsets: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[offsets[1:] - 1] - along[offsets[:-1]])


def redrawn(infill: Strokes, new: Rounded, chosen: NDArray[np.bool_], rounding: Rounding) -> Redrawn:
    """Select the strokes to redraw: those chosen that rounding changed."""
    strokes = np.flatnonzero(chosen & _moved_strokes(infill, new))
    points_at, offsets = picked(new.first, strokes)
    length = lengths(new.points, new.first)[strokes]
    rate = infill.filament[strokes] / infill.length[strokes]
    drawn = Redrawn(
        which=strokes,
        points=new.points[points_at],
        first=offsets,
        source=new.source[points_at],
        filament=rate * length,
    )
    return replace(drawn, filament=same_filament(infill, drawn)) if rounding.same_filament else drawn


def same_filament(infill: Strokes, new: Redrawn) -> Floats:
    """Return the filament, mm, that redrawn strokes take with wider beads, (S,): as before, or as much as fits."""
    length = lengths(new.points, new.first)
    rate = infill.filament[new.which] / infill.length[new.which]
    return np.minimum(infill.filament[new.which], rate * length * MOST_WIDENED)


def _moved_strokes(infill: Strokes, new: Rounded) -> NDArray[np.bool_]:
    """Tell which strokes have other points than before."""
    changed: NDArray[np.bool_] = np.diff(new.first) != np.diff(infill.first)
    alike = np.flatnonzero(~changed)
    (old_places, _), (new_places, _) = picked(infill.first, alike), picked(new.first, alike)
    old_points, new_points = infill.points[old_places], new.points[new_places]
    moved = (np.abs(old_points[:, 0] - new_points[:, 0]) > UNIT / 2) | (
        np.abs(old_points[:, 1] - new_points[:, 1]) > UNIT / 2
    )
    owner = np.repeat(alike, np.diff(infill.first)[alike])
    changed[owner[moved]] = True
    return changed
