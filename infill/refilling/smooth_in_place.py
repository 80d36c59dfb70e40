"""Round the corners of the slicer's own infill: ends, order and travel stay as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.sections import InfillStrokes
from infill.gcode.splicing import NewPaths
from infill.paths.corners import UNIT, RoundedPaths
from infill.paths.rounding import PathCorners, Rounding, find_corners
from infill.ragged import select_rows
from infill.refilling.batch import Batch
from infill.refilling.widest_gap import largest_moves

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

MOST_WIDENED = 1.08  # largest widening of beads, to make up for shorter paths


def stroke_corners(batch: Batch, corner: float, *, acceleration: float) -> PathCorners:
    """Recut the curves in the strokes of a batch, and find their corners.

    Parameters
    ----------
    batch : Batch
    corner : float
        See `Machine`.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    return find_corners(
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


def path_lengths(points: Floats, offsets: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[offsets[1:] - 1] - along[offsets[:-1]])


def redraw_strokes(infill: InfillStrokes, new: RoundedPaths, chosen: NDArray[np.bool_], rounding: Rounding) -> NewPaths:
    """Select the strokes to redraw: those chosen that rounding changed."""
    strokes = np.flatnonzero(chosen & _moved_strokes(infill, new))
    points_at, offsets = select_rows(new.first, strokes)
    length = path_lengths(new.points, new.first)[strokes]
    rate = infill.filament[strokes] / infill.length[strokes]
    drawn = NewPaths(
        which=strokes,
        points=new.points[points_at],
        first=offsets,
        source=new.source[points_at],
        filament=rate * length,
    )
    return replace(drawn, filament=widened_filament(infill, drawn)) if rounding.same_filament else drawn


def widened_filament(infill: InfillStrokes, new: NewPaths) -> Floats:
    """Return the filament, mm, that redrawn strokes take with wider beads, (S,): as before, or as much as fits."""
    length = path_lengths(new.points, new.first)
    rate = infill.filament[new.which] / infill.length[new.which]
    return np.minimum(infill.filament[new.which], rate * length * MOST_WIDENED)


def _moved_strokes(infill: InfillStrokes, new: RoundedPaths) -> NDArray[np.bool_]:
    """Tell which strokes have other points than before."""
    changed: NDArray[np.bool_] = np.diff(new.first) != np.diff(infill.first)
    alike = np.flatnonzero(~changed)
    (old_places, _), (new_places, _) = select_rows(infill.first, alike), select_rows(new.first, alike)
    old_points, new_points = infill.points[old_places], new.points[new_places]
    moved = (np.abs(old_points[:, 0] - new_points[:, 0]) > UNIT / 2) | (
        np.abs(old_points[:, 1] - new_points[:, 1]) > UNIT / 2
    )
    owner = np.repeat(alike, np.diff(infill.first)[alike])
    changed[owner[moved]] = True
    return changed
