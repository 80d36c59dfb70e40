"""Which box of a drawing is repeated, and the outlines of a picture."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from infill.drawing import Bounds, Drawing, Picture
from infill.errors import FormatError
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth

SPARSE = 0.25  # of a page: a drawing that is smaller in both directions is taken without its page
SEAM = 0.1  # of the edge of a box: where so much of it is drawn, it is a seam
GAP = 0.1  # of the larger side, between outlines that are repeated without a page
LARGEST_PICTURE = 1000  # pixels along a side: beyond, several make one
PIXEL_STEPS = 5  # of the equation, on the pixels themselves: rids a picture of speckles
SLACK = 1e-3  # of the larger side: so far lines that go on may be off
PIXEL = 0.1  # mm


def tile_of(drawing: Drawing) -> Bounds:
    """Return the box that is repeated."""
    x0, y0, x1, y1 = drawing.bounds
    if drawing.page:
        left, bottom, right, top = drawing.page
        if x1 - x0 >= SPARSE * (right - left) or y1 - y0 >= SPARSE * (top - bottom):
            return drawing.page
    size = max(x1 - x0, y1 - y0)
    gap = 0.0 if _seamed(drawing) else GAP * size
    sides = []
    for period, low, high in zip(_periods(drawing, SLACK * size), (x0, y0), (x1, y1), strict=True):
        wide = max(high - low + gap, GAP * size)  # a straight line has no height of its own
        sides.append(period or ((low + high - wide) / 2, (low + high + wide) / 2))
    (left, right), (bottom, top) = sides
    return left, bottom, right, top


def _periods(drawing: Drawing, slack: float) -> tuple[tuple[float, float] | None, ...]:
    """Return from where to where lines go along each axis, if all that begin at one side go on from the other."""
    ends = [line[[0, -1]] for line in drawing.lines if not np.array_equal(line[0], line[-1])]
    open_ends = np.concatenate(ends) if ends else np.empty((0, 2))
    found: list[tuple[float, float] | None] = [None, None]
    for axis in (0, 1, 0):  # ends that go on along one axis are left out along the other
        if found[axis] or not len(open_ends):
            continue
        along = open_ends[:, axis]
        low, high = float(along.min()), float(along.max())
        at_low, at_high = (np.abs(along - side) < slack for side in (low, high))
        first, last = (np.sort(open_ends[side, 1 - axis]) for side in (at_low, at_high))
        if high - low > slack and len(first) == len(last) and (np.abs(first - last) < slack).all():
            found[axis] = low, high
            open_ends = open_ends[~(at_low | at_high)]
    return tuple(found)


def _seamed(drawing: Drawing) -> bool:
    """Return whether lines end at the box around the drawing or run along it, so that they go on in the next tile."""
    x0, y0, x1, y1 = drawing.bounds
    slack = SLACK * max(x1 - x0, y1 - y0)
    along = 0.0
    for line in drawing.lines:
        on = np.stack([abs(line[:, 0] - x) < slack for x in (x0, x1)] + [abs(line[:, 1] - y) < slack for y in (y0, y1)])
        if np.hypot(*(line[0] - line[-1])) > slack and on[:, [0, -1]].any():
            return True
        both = (on[:, 1:] & on[:, :-1]).any(axis=0)
        along += float(np.hypot(*np.diff(line, axis=0).T)[both].sum())
    return along > SEAM * 2 * (x1 - x0 + y1 - y0)


def traced(picture: Picture, path: Path) -> Drawing:
    """Return the outlines of what is dark, a tenth of a millimetre a pixel, going on across the edges."""
    from scipy.ndimage import uniform_filter
    from skimage.measure import find_contours

    field = picture.field
    several = math.ceil(max(field.shape) / LARGEST_PICTURE)
    if several > 1:
        field = uniform_filter(field, several, mode="wrap")[::several, ::several]
    pad = 2 * PIXEL_STEPS
    wrapped = np.pad(field, pad, mode="wrap")
    blurred = smooth(wrapped, Smoothing(steps=PIXEL_STEPS), method="inplace")
    inner = blurred[pad : -pad + 1, pad : -pad + 1].astype(np.float64)
    inner[inner == 0] = np.finfo(np.float32).tiny
    inner[-1], inner[:, -1] = inner[0], inner[:, 0]
    contours = find_contours(inner, 0.0)  # type: ignore[no-untyped-call]
    lines = tuple(line * PIXEL * several for line in contours if len(line) > 2)
    if not lines:
        raise FormatError(f"{path} holds only specks of single pixels; draw larger dark shapes")
    size = PIXEL * several * (np.array(inner.shape) - 1)
    return Drawing(lines=lines, page=(0.0, 0.0, float(size[0]), float(size[1])))
