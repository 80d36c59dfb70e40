"""A drawing as a family of paths: a tile that is repeated, smoothed by the paper's equation."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.checks import length, positive, within
from infill.errors import FormatError
from infill.filling.tile_fields import tile_grid, two_colours
from infill.filling.tile_lines import TOUCH, borders
from infill.filling.tile_paths import Strand, repeated, tile_strands
from infill.formats.drawing import Bounds, Drawing, Picture
from infill.formats.drawings import read_drawing
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth

SPARSE = 0.5  # of a page: a drawing that is smaller is taken without its page
SEAM = 0.1  # of the edge of a box: where so much of it is drawn, or a line ends at it, it is a seam
GAP = 0.1  # of the larger side, between outlines that are repeated without a page
LARGEST_PICTURE = 1000  # pixels along a side: beyond, several make one
PIXEL_STEPS = 5  # of the equation, on the pixels themselves: rids a picture of speckles
LEAST_BLUR = 0.15  # of a line width
BLUR_PER_RADIUS = 0.5
CAREFUL = 0.35  # of the thickest place of a colour: what no smoothing may exceed


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawn:
    """A drawing that is repeated in both directions; `cell` is the width of its tile, mm.

    Parameters
    ----------
    name : str
        Of the file.
    drawing : Drawing
        Its lines, with the tile as the page.
    """

    name: str
    drawing: Drawing
    summary: str = "a drawing, repeated"
    prismatic: bool = True

    @property
    def width(self) -> float:
        """The width of the tile as drawn, mm."""
        x0, _, x1, _ = self.tile
        return x1 - x0

    @property
    def tile(self) -> Bounds:
        """The box that is repeated, mm."""
        assert self.drawing.page is not None
        return self.drawing.page

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float = 0.0,  # noqa: ARG002 - every layer is the same
        layer: int = 0,  # noqa: ARG002
        radius: float = 0.0,
    ) -> list[NDArray[np.float64]]:
        """Return paths that cover a box: no two cross, and those of open or branching lines run on both sides of them.

        Parameters
        ----------
        bounds : (x0, y0, x1, y1)
            mm.
        cell : float
            Width of the tile, mm.
        line_width : float
            mm.
        z, layer
            Of no effect.
        radius : float
            mm: about the radius that a right angle gets. Outlines too small for that get less.

        Raises
        ------
        GeometryError
            If nothing is left of the drawing at this size, or the tile is too large for the line width.
        """
        strands, size = _strands(self, length("cell", cell), length("line_width", line_width), float(radius))
        return repeated(strands, size, bounds)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the width of the tile at which the paths fill about `density` of the plane."""
        within("density", density, 1e-4, 1)
        x0, y0, x1, y1 = self.tile
        return self._drawn_length(line_width) * TOUCH * line_width / density * (x1 - x0) / ((x1 - x0) * (y1 - y0))

    def _drawn_length(self, line_width: float) -> float:
        del line_width
        return float(sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in self.drawing.lines))

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return infinity: paths that touch are smoothed together."""
        return math.inf


def drawn(path: str | os.PathLike[str], *, width: float | None = None) -> Drawn:
    """Return a drawing as a family of paths.

    Parameters
    ----------
    path : str or Path
        .svg, .dxf, .wkt, .png, .jpg, .jpeg or .bmp. What is repeated is the page, where the drawing fills at least
        half of it; else the box around the lines, with a gap where they are outlines that do not go on beyond it.
    width : float, optional
        Width of the tile, mm; by default as drawn, and a tenth of a millimetre a pixel.

    Raises
    ------
    FormatError
        See `read_drawing`.
    """
    found = read_drawing(path)
    drawing = _traced(found, Path(path)) if isinstance(found, Picture) else found
    drawing = replace(drawing, page=_tile(drawing))
    if width is not None:
        drawing = _scaled(drawing, length("width", width))
    return Drawn(name=Path(path).name, drawing=drawing)


def _scaled(drawing: Drawing, width: float) -> Drawing:
    assert drawing.page is not None
    x0, y0, x1, y1 = drawing.page
    factor = positive("width", width, "mm") / (x1 - x0)
    lines = tuple((line - (x0, y0)) * factor for line in drawing.lines)
    return replace(drawing, lines=lines, page=(0.0, 0.0, width, (y1 - y0) * factor))


def _tile(drawing: Drawing) -> Bounds:
    """Return the box that is repeated."""
    x0, y0, x1, y1 = drawing.bounds
    if drawing.page:
        left, bottom, right, top = drawing.page
        if x1 - x0 >= SPARSE * (right - left) and y1 - y0 >= SPARSE * (top - bottom):
            return drawing.page
    gap = 0.0 if _seamed(drawing) else GAP * max(x1 - x0, y1 - y0)
    thin = GAP * max(x1 - x0, y1 - y0)  # a straight line has no height of its own
    wide, high = (max(each + gap, thin) for each in (x1 - x0, y1 - y0))
    return (x0 + x1 - wide) / 2, (y0 + y1 - high) / 2, (x0 + x1 + wide) / 2, (y0 + y1 + high) / 2


def _seamed(drawing: Drawing) -> bool:
    """Return whether lines end at the box around the drawing or run along it, so that they go on in the next tile."""
    x0, y0, x1, y1 = drawing.bounds
    slack = 1e-3 * max(x1 - x0, y1 - y0)
    along = 0.0
    for line in drawing.lines:
        on = np.stack([abs(line[:, 0] - x) < slack for x in (x0, x1)] + [abs(line[:, 1] - y) < slack for y in (y0, y1)])
        if np.hypot(*(line[0] - line[-1])) > slack and on[:, [0, -1]].any():
            return True
        both = (on[:, 1:] & on[:, :-1]).any(axis=0)
        along += float(np.hypot(*np.diff(line, axis=0).T)[both].sum())
    return along > SEAM * 2 * (x1 - x0 + y1 - y0)


def _traced(picture: Picture, path: Path) -> Drawing:
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
    lines = tuple(line * 0.1 * several for line in find_contours(inner, 0.0) if len(line) > 2)
    if not lines:
        raise FormatError(f"{path} holds only specks of single pixels; draw larger dark shapes")
    size = 0.1 * several * (np.array(inner.shape) - 1)
    return Drawing(lines=lines, page=(0.0, 0.0, float(size[0]), float(size[1])))


@lru_cache(maxsize=8)
def _strands(family: Drawn, cell: float, line_width: float, radius: float) -> tuple[list[Strand], tuple[float, float]]:
    """Return the strands of a tile and its size, mm; the field is computed once for every layer and region."""
    x0, y0, x1, y1 = family.tile
    factor = cell / (x1 - x0)
    size = cell, (y1 - y0) * factor
    lines = [(line - (x0, y0)) * factor for line in family.drawing.lines]
    blur = max(LEAST_BLUR * line_width, BLUR_PER_RADIUS * radius)
    grid = tile_grid(size, line_width=line_width, blur=blur)
    field = two_colours(borders(lines, size, line_width=line_width), grid, line_width=line_width, blur=blur)
    return tile_strands(field, grid), size
