"""Choose the box of a drawing to repeat, and trace the outlines of a picture."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from infill.drawing import Bounds, Drawing, Picture
from infill.errors import FormatError
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth

SPARSE = 0.25  # of a page: a drawing that is smaller in both directions is repeated without its page
SEAM = 0.1  # of the edge of a box: with more of it drawn, the edge is a seam
GAP = 0.1  # of the larger side, between outlines that are repeated without a page
LARGEST_PICTURE = 1000  # pixels along a side: larger pictures are averaged over blocks of pixels
PIXEL_STEPS = 5  # of the equation, on the pixels themselves: rids a picture of speckles
SLACK = 1e-3  # of the larger side: tolerance for lines that continue in the next tile
PIXEL = 0.1  # mm


def repeating_box(drawing: Drawing) -> Bounds:
    """Return the box to repeat."""
    x0, y0, x1, y1 = drawing.bounds
    if drawing.page:
        west, bottom, east, top = drawing.page
        if x1 - x0 >= SPARSE * (east - west) or y1 - y0 >= SPARSE * (top - bottom):
            return drawing.page
    size = max(x1 - x0, y1 - y0)
    gap = 0.0 if _has_seams(drawing) else GAP * size
    sides = []
    for period, low, high in zip(_periods(drawing, SLACK * size), (x0, y0), (x1, y1), strict=True):
        side = max(high - low + gap, GAP * size)  # a straight line has no height of its own
        sides.append(period or ((low + high - side) / 2, (low + high + side) / 2))
    (west, east), (bottom, top) = sides
    return west, bottom, east, top


def _periods(drawing: Drawing, slack: float) -> tuple[tuple[float, float] | None, ...]:
    """Return the ends of a period along each axis, if all lines that leave at one side enter at the other."""
    ends = [line[[0, -1]] for line in drawing.lines if not np.array_equal(line[0], line[-1])]
    open_ends = np.concatenate(ends) if ends else np.empty((0, 2))
    periods: list[tuple[float, float] | None] = [None, None]
    for axis in (0, 1, 0):  # ends that go on along one axis are left out along the other
        if periods[axis] or not len(open_ends):
            continue
        along = open_ends[:, axis]
        low, high = float(along.min()), float(along.max())
        at_low, at_high = (np.abs(along - side) < slack for side in (low, high))
        low_ends, high_ends = (np.sort(open_ends[side, 1 - axis]) for side in (at_low, at_high))
        if high - low > slack and len(low_ends) == len(high_ends) and (np.abs(low_ends - high_ends) < slack).all():
            periods[axis] = low, high
            open_ends = open_ends[~(at_low | at_high)]
    return tuple(periods)


def _has_seams(drawing: Drawing) -> bool:
    """Tell whether lines end at the box around the drawing or run along it, so that they continue in the next tile."""
    x0, y0, x1, y1 = drawing.bounds
    slack = SLACK * max(x1 - x0, y1 - y0)
    along = 0.0
    for line in drawing.lines:
        on = np.stack([abs(line[:, 0] - x) < slack for x in (x0, x1)] + [abs(line[:, 1] - y) < slack for y in (y0, y1)])
        if np.hypot(*(line[0] - line[-1])) > slack and on[:, [0, -1]].any():
            return True
        on_box = (on[:, 1:] & on[:, :-1]).any(axis=0)
        along += float(np.hypot(*np.diff(line, axis=0).T)[on_box].sum())
    return along > SEAM * 2 * (x1 - x0 + y1 - y0)


def trace_picture(picture: Picture, path: Path) -> Drawing:
    """Trace the outlines of dark areas, a tenth of a millimetre a pixel, periodic across the edges."""
    from scipy.ndimage import uniform_filter
    from skimage.measure import find_contours

    field = picture.field
    block = math.ceil(max(field.shape) / LARGEST_PICTURE)
    if block > 1:
        field = uniform_filter(field, block, mode="wrap")[::block, ::block]
    pad = 2 * PIXEL_STEPS
    wrapped = np.pad(field, pad, mode="wrap")
    blurred = smooth(wrapped, Smoothing(steps=PIXEL_STEPS), method="inplace")
    inner = blurred[pad : -pad + 1, pad : -pad + 1].astype(np.float64)
    inner[inner == 0] = np.finfo(np.float32).tiny
    inner[-1], inner[:, -1] = inner[0], inner[:, 0]
    contours = find_contours(inner, 0.0)  # type: ignore[no-untyped-call]
    lines = tuple(line * PIXEL * block for line in contours if len(line) > 2)
    if not lines:
        raise FormatError(f"{path} holds only specks of single pixels; draw larger dark shapes")
    size = PIXEL * block * (np.array(inner.shape) - 1)
    return Drawing(lines=lines, page=(0.0, 0.0, float(size[0]), float(size[1])))
