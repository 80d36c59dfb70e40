"""Read a drawing as a family of paths: a tile that repeats."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from infill.checks import length, positive
from infill.drawing import Drawing, Picture
from infill.drawings.drawing_files import read_drawing
from infill.paths.tiles.drawn_family import Drawn
from infill.paths.tiles.tiling import tile_of, traced


def drawn(path: str | os.PathLike[str], *, width: float | None = None) -> Drawn:
    """Return a drawing as a family of paths.

    Parameters
    ----------
    path : str or Path
        .svg, .dxf, .wkt, .png, .jpg, .jpeg or .bmp. What is repeated is the page, where the drawing extends over
        a quarter of it in one direction at least. Otherwise it is the box around the lines, from where they begin on
        one side to where they go on from the other; outlines that do not go on get a gap between them.
    width : float, optional
        Width of the tile, mm; by default as drawn, and a tenth of a millimetre a pixel.

    Raises
    ------
    FormatError
        See `read_drawing`.
    """
    found = read_drawing(path)
    drawing = traced(found, Path(path)) if isinstance(found, Picture) else replace(found, page=tile_of(found))
    if width is not None:
        drawing = _scaled(drawing, length("width", width))
    return Drawn(name=Path(path).name, drawing=drawing)


def _scaled(drawing: Drawing, width: float) -> Drawing:
    assert drawing.page is not None
    x0, y0, x1, y1 = drawing.page
    factor = positive("width", width, "mm") / (x1 - x0)
    lines = tuple((line - (x0, y0)) * factor for line in drawing.lines)
    return replace(drawing, lines=lines, page=(0.0, 0.0, width, (y1 - y0) * factor))
