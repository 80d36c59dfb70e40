"""Measure the widest gaps between the beads of a layer, which bound the moves of its infill.

Of every point in the plane, let d be the distance to the nearest bead. If no point of a bead moves farther than δ, and
none of the new bead is farther than δ from the old one, d grows by δ at most, everywhere. The widest gap is the largest
circle that no centre line enters, of radius R = max d over the region of the infill. So with δ ≤ `MOST_GROWTH` R, it
grows by that share at most, whatever the pattern.

R is found on a raster, for each region that the other beads of a layer enclose, and is taken smaller by what a raster
may be wrong.
"""

from __future__ import annotations

import hashlib

import numpy as np

from infill.arrays import Flags, Floats, Places
from infill.kernels.compiling import log_compilation
from infill.refilling.layers import Layer, Layers

MOST_GROWTH = 0.15  # of the radius of the widest gap
MOST_PIXELS = 512  # along the longer side of a raster
FINEST = 0.5  # line widths: a pixel of a small one
MARGIN = 2.0  # mm around the infill of a layer
ERROR = 0.75  # pixels: that a centre line may lie from the pixels that stand for it, diagonally


class GapMemory:
    """The gaps of the layers of a print: those with the same beads have the same, in every drawing."""

    def __init__(self) -> None:
        """Begin without layers."""
        self._radii: dict[bytes, Floats] = {}

    def radii_of(self, layer: Layer) -> Floats:
        """Return the radius, mm, of the widest gap around each stroke of a layer."""
        beads = (*layer.paths, layer.bead_ends, np.array(layer.layers.line_width))
        digest = hashlib.blake2b(digest_size=16)
        for array in beads:
            digest.update(np.ascontiguousarray(array).tobytes())
        key = digest.digest()
        if key not in self._radii:
            self._radii[key] = _widest_gap_radii(layer)
        return self._radii[key]


def largest_moves(layers: Layers, gaps: GapMemory) -> Floats:
    """Compute the largest move of each stroke of some layers by the gaps of its region, (M,), mm."""
    moves = np.zeros(len(layers.infill))
    for layer in layers:
        moves[layer.strokes] = MOST_GROWTH * gaps.radii_of(layer)
    return moves


def _widest_gap_radii(layer: Layer) -> Floats:
    """Measure the radius, mm, of the widest gap around each stroke of a layer."""
    points, offsets = layer.paths
    low, high = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    spacing = _spacing(points, offsets)
    pixel = max(FINEST * layer.layers.line_width, float((high - low).max()) / MOST_PIXELS)
    if not np.isfinite(high - low).all() or pixel > spacing:
        return np.full(len(layer.strokes), spacing / 2)
    shape = tuple(np.ceil((high - low) / pixel).astype(int) + 1)
    walls = _raster(layer.bead_ends[:, 0], layer.bead_ends[:, 1], low, pixel, shape)
    leg = np.ones(len(points), dtype=bool)
    leg[offsets[1:] - 1] = False
    begins = np.flatnonzero(leg)
    beads = _raster(points[begins], points[begins + 1], low, pixel, shape)
    pixel_of = np.floor((points - low) / pixel + 0.5).astype(np.intp)
    beads[pixel_of[:, 0], pixel_of[:, 1]] = True
    region, square = measure_regions(~_dilate(walls), walls | beads)
    open_sides = np.concatenate([region[0], region[-1], region[:, 0], region[:, -1]])
    radius = np.maximum(np.sqrt(square) * pixel - ERROR * pixel, 0.0)
    radius[0] = np.inf  # beside a wall
    radius[open_sides] = spacing / 2  # an open region, without a bead that bounds the infill
    stroke_radius = np.minimum.reduceat(radius[region[pixel_of[:, 0], pixel_of[:, 1]]], offsets[:-1])
    return np.where(
        np.isfinite(stroke_radius),
        stroke_radius,
        float(stroke_radius[np.isfinite(stroke_radius)].min(initial=spacing / 2)),
    )


def measure_regions(free: Flags, taken: Flags) -> tuple[Places, Places]:
    """Find the regions of free pixels, and the largest squared distance from a pixel of each to the next taken one.

    Parameters
    ----------
    free, taken : (X, Y) bool

    Returns
    -------
    region : (X, Y) int64
        From 1 on; 0 for pixels that are not free.
    square : (R + 1,) int64, pixels²
        First that of all pixels that are not free.
    """
    from infill.kernels.gap_rasters import find_largest_squares, label_regions

    region = np.empty(free.shape, dtype=np.int64)
    with log_compilation("gaps"):
        square = np.zeros(label_regions(free, region) + 1, dtype=np.int64)
        find_largest_squares(taken, region, square)
    return region, square


def hull_area(points: Floats) -> float:
    """Return the area of the convex hull of points, (N, 2), mm²."""
    from infill.kernels.gap_rasters import find_hull_area

    with log_compilation("gaps"):
        return float(find_hull_area(points[np.lexsort((points[:, 1], points[:, 0]))]))


def _spacing(points: Floats, offsets: Places) -> float:
    """Estimate the distance between lines, mm: the area of their hull over their length."""
    step = np.hypot(*np.diff(points, axis=0).T)
    step[offsets[1:-1] - 1] = 0.0
    length = float(step.sum())
    if not length or not np.isfinite(points).all():
        return 0.0
    return hull_area(points) / length


def _raster(starts: Floats, ends: Floats, low: Floats, pixel: float, shape: tuple[int, ...]) -> Flags:
    """Mark the pixels that straight pieces of beads pass through; pieces outside are left out.

    Pieces are cut into equal ones of half a pixel at most, and the middle of each is marked.
    """
    pixels = np.zeros(shape, dtype=bool)
    high = low + pixel * np.array(shape)
    # Axis by axis: NumPy is slow along the short axis of an array.
    is_close = np.ones(len(starts), dtype=bool)
    for axis in (0, 1):
        start, stop = starts[:, axis], ends[:, axis]
        is_close &= (np.maximum(start, stop) >= low[axis] - pixel) & (np.minimum(start, stop) <= high[axis])
    (x, y), (end_x, end_y) = starts[is_close].T, ends[is_close].T
    dx, dy = end_x - x, end_y - y
    pieces = np.maximum(1, np.ceil(np.hypot(dx, dy) / (pixel / 2) - 1e-9)).astype(np.intp)
    piece_of = np.repeat(np.arange(len(pieces)), pieces)
    share = (np.arange(len(piece_of)) - (np.cumsum(pieces) - pieces)[piece_of] + 0.5) / pieces[piece_of]
    row = np.floor((x[piece_of] + share * dx[piece_of] - low[0]) / pixel + 0.5)
    column = np.floor((y[piece_of] + share * dy[piece_of] - low[1]) / pixel + 0.5)
    inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    pixels[row[inside].astype(np.intp), column[inside].astype(np.intp)] = True
    return pixels


def _dilate(pixels: Flags) -> Flags:
    """Add the neighbours on all four sides to pixels."""
    result = pixels.copy()
    result[1:] |= pixels[:-1]
    result[:-1] |= pixels[1:]
    result[:, 1:] |= pixels[:, :-1]
    result[:, :-1] |= pixels[:, 1:]
    return result
