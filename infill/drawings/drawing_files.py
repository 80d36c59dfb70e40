"""`read_drawing`: read lines or dark shapes from a file.

.svg                     outlines and strokes, with the size of the page
.dxf                     lines, arcs, splines, polylines, blocks (extra `drawings`)
.wkt                     well-known text
.png .jpg .jpeg .bmp     dark shapes on a light ground
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from infill.drawing import Drawing, Picture, TooComplexError
from infill.drawings.bitmaps import read_bitmap
from infill.drawings.dxf import read_dxf
from infill.drawings.svg import read_svg
from infill.drawings.wkt import read_wkt
from infill.errors import FormatError
from infill.files.broken import require_readable

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
