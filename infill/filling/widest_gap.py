"""How wide the gaps between the beads of a layer are: what bounds how far its infill may move.

Of every point in the plane, let d be the distance to the nearest bead. If no point of a bead moves farther than δ, and
none of the new bead is farther than δ from the old one, d grows by δ at most, everywhere. The widest gap is the largest
circle that no centre line enters, of radius R = max d over the region of the infill. So with δ ≤ `MOST_GROWTH` R, it
grows by that share at most, whatever the pattern.

R is found on a raster, for each region that the other beads of a layer enclose, and is taken smaller by what a raster
may err.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.filling.batch import Batch
from infill.filling.contact import sampled
from infill.ragged import picked

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Flags = NDArray[np.bool_]

MOST_GROWTH = 0.15  # of the radius of the widest gap
MOST_PIXELS = 512  # along the longer side of a raster
FINEST = 0.5  # line widths: a pixel of a small one
MARGIN = 2.0  # mm around the infill of a layer
ERROR = 0.75  # pixels: that a centre line may lie from the pixels that stand for it, diagonally


def largest_moves(batch: Batch) -> Floats:
    """Return how far each stroke of a batch may move for the gaps of its region, (M,), mm."""
    moves = np.zeros(len(batch.infill))
    for number in np.unique(batch.layer).tolist():
        some = np.flatnonzero(batch.layer == number)
        moves[some] = MOST_GROWTH * _widest_gaps(batch, number, some)
    return moves


def _widest_gaps(batch: Batch, number: int, some: Places) -> Floats:
    """Return the radius, mm, of the widest gap around each of some strokes, all those of a layer."""
    from scipy import ndimage

    infill = batch.infill
    places, first = picked(infill.first, some)
    points = infill.points[places]
    low, high = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    spacing = _spacing(points, first)
    pixel = max(FINEST * batch.line_width, float((high - low).max()) / MOST_PIXELS)
    if not np.isfinite(high - low).all() or pixel > spacing:
        return np.full(len(some), spacing / 2)
    shape = tuple(np.ceil((high - low) / pixel).astype(int) + 1)
    others = batch.others.samples_of(number, pixel / 2).points
    walls = _raster(others, low, pixel, shape)
    beads = _raster(np.concatenate([sampled(points, first, pixel / 2).points, points]), low, pixel, shape)
    region, _ = ndimage.label(~ndimage.binary_dilation(walls))
    open_sides = np.unique(np.concatenate([region[0], region[-1], region[:, 0], region[:, -1]]))
    distance = ndimage.distance_transform_edt(~(walls | beads)) * pixel
    radius = np.zeros(int(region.max()) + 1)
    np.maximum.at(radius, region.ravel(), distance.ravel())
    radius = np.maximum(radius - ERROR * pixel, 0.0)
    radius[0] = np.inf  # beside a wall
    radius[open_sides] = spacing / 2  # around it is nothing that tells where the infill ends
    at = np.floor((points - low) / pixel + 0.5).astype(np.intp)
    least = np.minimum.reduceat(radius[region[at[:, 0], at[:, 1]]], first[:-1])
    return np.where(np.isfinite(least), least, float(least[np.isfinite(least)].min(initial=spacing / 2)))


def _spacing(points: Floats, first: Places) -> float:
    """Return about how far lines lie from one another, mm: the area of their hull over their length."""
    from scipy.spatial import ConvexHull, QhullError  # which loads sooner than a library of geometry

    step = np.hypot(*np.diff(points, axis=0).T)
    step[first[1:-1] - 1] = 0.0
    length = float(step.sum())
    if not length or not np.isfinite(points).all():
        return 0.0
    try:
        return float(ConvexHull(points).volume) / length  # of two axes, its area
    except QhullError:  # all on one line
        return 0.0


def _raster(points: Floats, low: Floats, pixel: float, shape: tuple[int, ...]) -> Flags:
    """Return which pixels some points fall into; those outside are left out."""
    found = np.zeros(shape, dtype=bool)
    at = np.floor((points - low) / pixel + 0.5)
    inside = ((at >= 0) & (at < np.array(shape))).all(axis=1)
    row, column = at[inside].astype(np.intp).T
    found[row, column] = True
    return found
