"""Read a drawing as a family of paths: a tile that repeats."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from infill.checks import check_length, check_positive
from infill.drawing import Drawing, Picture
from infill.drawings.drawing_files import read_drawing
from infill.paths.tiles.drawn_family import DrawnFamily
from infill.paths.tiles.tiling import repeating_box, trace_picture


def read_tile_family(path: str | os.PathLike[str], *, width: float | None = None) -> DrawnFamily:
    """Read a drawing as a family of paths.

    Parameters
    ----------
    path : str or Path
        .svg, .dxf, .wkt, .png, .jpg, .jpeg or .bmp. The tile is the page if the drawing extends over at least a quarter
        of it in one direction. Otherwise it is the box around the lines, such that lines continue from tile to tile;
        outlines that do not continue get a gap between them.
    width : float, optional
        Width of the tile, mm; by default as drawn, with 0.1 mm per pixel for pictures.

    Raises
    ------
    FormatError
        See `read_drawing`.
    """
    content = read_drawing(path)
    drawing = (
        trace_picture(content, Path(path))
        if isinstance(content, Picture)
        else replace(content, page=repeating_box(content))
    )
    if width is not None:
        drawing = _scale_to_width(drawing, check_length("width", width))
    return DrawnFamily(name=Path(path).name, drawing=drawing)


def _scale_to_width(drawing: Drawing, width: float) -> Drawing:
    """Scale a drawing to a width, and move its page to the origin."""
    assert drawing.page is not None
    x0, y0, x1, y1 = drawing.page
    factor = check_positive("width", width, "mm") / (x1 - x0)
    lines = tuple((line - (x0, y0)) * factor for line in drawing.lines)
    return replace(drawing, lines=lines, page=(0.0, 0.0, width, (y1 - y0) * factor))
