"""`read_drawing`: read lines or dark shapes from a file.

.svg                     outlines and strokes, with the size of the page
.dxf                     lines, arcs, splines, polylines, blocks (extra `drawings`)
.wkt                     well-known text
.png .jpg .jpeg .bmp     dark shapes on a light ground
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely

from infill.checks import check_length, check_positive
from infill.drawing import Drawing, Picture, TooComplexError
from infill.drawings.bitmaps import read_bitmap
from infill.drawings.dxf import read_dxf
from infill.drawings.svg import read_svg
from infill.drawings.wkt import read_wkt
from infill.errors import FormatError
from infill.files.broken import require_readable
from infill.paths.tiles.drawn_family import DrawnFamily
from infill.paths.tiles.tiling import repeating_box, trace_picture

MOST_CROSSINGS = 500_000  # of a tile, all of which are found where walls or paths are made of it
SAMPLED_SEGMENTS = 500

LOG = logging.getLogger("infill")

READERS: dict[str, Callable[[Path], Drawing | Picture]] = {
    ".svg": read_svg,
    ".dxf": read_dxf,
    ".wkt": read_wkt,
    ".png": read_bitmap,
    ".jpg": read_bitmap,
    ".jpeg": read_bitmap,
    ".bmp": read_bitmap,
}


def read_drawing(path: str | os.PathLike[str]) -> Drawing | Picture:
    """Read the lines of a drawing, or the dark shapes of a picture.

    Parameters
    ----------
    path : str or Path
        .svg, .dxf or .wkt, whose lines are returned in mm; .png, .jpg, .jpeg or .bmp, whose pixels have no size.

    Raises
    ------
    FormatError
        If the file is missing, its suffix is unknown, it is broken, it holds no lines (only texts, for example), it is
        a picture of one colour, or it exceeds the limit in the message.
    """
    source = require_readable(path, READERS, "a drawing")
    try:
        return READERS[source.suffix.lower()](source)
    except TooComplexError as error:
        raise FormatError(f"{source} {error}; give a simpler drawing") from error
    except OSError as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(f"cannot read {source}: {error.strerror or error}; check the file") from error


def read_tile(path: str | os.PathLike[str]) -> Drawing:
    """Read a drawing, or trace a picture, as a tile that repeats; raise FormatError, also for many crossings."""
    content = read_drawing(path)
    if isinstance(content, Picture):
        return trace_picture(content, Path(path))
    if content.left_out:
        LOG.warning("%s: left out: %s", path, ", ".join(content.left_out))
    crossings = _estimate_crossings(content)
    if crossings > MOST_CROSSINGS:
        raise FormatError(
            f"the lines of {path} cross or touch about {crossings:,.0f} times; the limit is {MOST_CROSSINGS:,}; draw "
            "fewer lines over each other"
        )
    return replace(content, page=repeating_box(content))


def _estimate_crossings(drawing: Drawing) -> float:
    """Return about how many pairs of segments of a drawing meet, ends that touch included, from a sample of them."""
    segments = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in drawing.lines])
    tree = shapely.STRtree(shapely.linestrings(segments))
    stride = -(-len(segments) // SAMPLED_SEGMENTS)
    sample = tree.geometries[::stride]
    meetings = len(tree.query(sample, predicate="intersects")[0]) - len(sample)  # none with itself
    return meetings / len(sample) * len(segments) / 2


def read_tile_family(path: str | os.PathLike[str], *, width: float | None = None) -> DrawnFamily:
    """Read a drawing as a tile that repeats: a family of paths.

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
    drawing = read_tile(path)
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
