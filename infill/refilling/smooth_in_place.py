"""Round the corners of the slicer's own infill: ends, order and travel stay as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.gcode.splicing import NewPaths, splice_paths, verify_replay
from infill.gcode.strokes import InfillStrokes
from infill.paths.corners import UNIT, RoundedPaths
from infill.paths.rounding import PathCorners, Rounding, find_corners
from infill.planner.print_clock import path_seconds
from infill.ragged import concatenate_rows, select_rows, split_rows
from infill.refilling.layers import LayerPaths, Layers
from infill.refilling.regions import NO_REGION
from infill.refilling.request import KEEP
from infill.refilling.rules import RefillRules, unchangeable_strokes
from infill.refilling.stats import InfillAmounts, NewInfill
from infill.refilling.widest_gap import GapMemory, largest_moves

MOST_WIDENED = 1.08  # largest widening of beads, to make up for shorter paths
SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners


def smooth_in_place(layers: Layers, rules: RefillRules, seconds: Floats, gaps: GapMemory) -> NewInfill:
    """Round the slicer's paths of some layers, and prove that nothing else changed.

    Parameters
    ----------
    layers : Layers
    rules : RefillRules
    seconds : (M,) float64
        Times of the old strokes.
    gaps : GapMemory
    """
    infill, section = layers.infill, layers.section
    corners = stroke_corners(layers, rules.rounding, acceleration=rules.acceleration, gaps=gaps)
    smooth = corners.rounded(rules.rounding)
    moved = _moved_strokes(infill, smooth)
    acceleration = layers.acceleration(rules.acceleration)
    smooth = rules.rounding.merge_segments(smooth, speed=layers.speed, acceleration=acceleration)
    new_seconds = path_seconds(smooth.points, smooth.first, layers.speed, acceleration)
    reasons = {**unchangeable_strokes(layers, rules), "no faster": new_seconds > seconds * SLOWER}
    new = redraw_strokes(infill, smooth, moved & ~np.any(list(reasons.values()), axis=0), rules)
    spliced = splice_paths(layers.table, infill, new)
    fault = verify_replay(layers.table, infill, new, spliced)
    if fault:
        return NewInfill.unchanged(layers, {f"a check failed: {fault}": section})
    kept = {reason: section[strokes] for reason, strokes in reasons.items()}
    if rules.request.pattern != KEEP:  # a new pattern that fits nowhere
        kept[NO_REGION] = section
    changed = np.zeros(len(infill), dtype=bool)
    changed[new.which] = True
    rows = zip(split_rows(infill.points, infill.first), split_rows(smooth.points, smooth.first), strict=True)
    paths = [after if is_new else before for is_new, (before, after) in zip(changed.tolist(), rows, strict=True)]
    points, first = concatenate_rows(paths, like=(2,))
    return NewInfill(
        text=spliced.text,
        paths=LayerPaths(points=points, first=first, layer=layers.layer),
        changed=changed,
        kept=kept,
        amounts=InfillAmounts(
            seconds=float(new_seconds[changed].sum()),
            length=float(path_lengths(smooth.points, smooth.first)[changed].sum()),
            filament=float(new.filament.sum()),
        ),
        lines=infill.opens[new.which],
        increase=new.filament - infill.filament[new.which],
        widened=float((widened_filament(infill, new) - new.filament).sum()),
        radii=smooth.radius[np.repeat(changed, np.diff(infill.first))],
    )


def stroke_corners(layers: Layers, rounding: Rounding, *, acceleration: float, gaps: GapMemory) -> PathCorners:
    """Recut the curves in the strokes of some layers, and find their corners.

    Parameters
    ----------
    layers : Layers
    rounding : Rounding
    acceleration : float, mm/s²
        Where the print commands none.
    gaps : GapMemory
    """
    return find_corners(
        layers.infill.points,
        layers.infill.first,
        walls=layers.walls(),
        layer=layers.layer,
        acceleration=layers.acceleration(acceleration),
        speed=layers.speed,
        corner=rounding.corner,
        segments_per_second=rounding.segments_per_second,
        coarsest=rounding.coarsest,
        line_width=layers.line_width,
        wide=True,
        limit=largest_moves(layers, gaps),
        keep_touch=True,
    )


def path_lengths(points: Floats, offsets: Places) -> Floats:
    """Return the length of every path, mm."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return np.asarray(along[offsets[1:] - 1] - along[offsets[:-1]])


def redraw_strokes(infill: InfillStrokes, new: RoundedPaths, chosen: NDArray[np.bool_], rules: RefillRules) -> NewPaths:
    """Return the new paths of the chosen strokes."""
    strokes = np.flatnonzero(chosen)
    points_at, offsets = select_rows(new.first, strokes)
    length = path_lengths(new.points, new.first)[strokes]
    rate = infill.filament[strokes] / infill.length[strokes]
    drawn = NewPaths(
        which=strokes,
        points=new.points[points_at],
        first=offsets,
        source=new.source[points_at],
        filament=rate * length,
        arc_deviation=rules.arc_deviation,
    )
    return replace(drawn, filament=widened_filament(infill, drawn)) if rules.rounding.same_filament else drawn


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
