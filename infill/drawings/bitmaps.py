"""Pictures as patterns, in which dark shapes are solid: PNG, JPEG and BMP by Pillow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.drawing import Picture
from infill.errors import FormatError
from infill.files.broken import wrap_reader_errors

MOST_PIXELS = 16_000_000
LEAST_CONTRAST = 0.05  # of black to white: a fainter picture counts as a single colour


def read_grey(path: Path) -> NDArray[np.float32]:
    """Read a picture as greys from 0, black, to 1, white; rows from above, transparent pixels white."""
    from PIL import Image, UnidentifiedImageError

    try:
        with wrap_reader_errors(path), Image.open(path) as image:
            width, height = image.size
            if width * height > MOST_PIXELS:
                raise FormatError(
                    f"{path} has {width} × {height} pixels; the limit is {MOST_PIXELS} in all; make it smaller"
                )
            coloured = image.convert("RGBA")
            background = Image.new("RGBA", coloured.size, "white")
            return np.asarray(Image.alpha_composite(background, coloured).convert("L"), dtype=np.float32) / np.float32(
                255
            )
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError) as error:
        raise FormatError(f"{path} is broken or not a picture; save it again") from error


def read_bitmap(path: Path) -> Picture:
    """Read a picture as a field [x, y]: 0 at the Otsu threshold of its greys, -1 light or transparent, +1 dark.

    The threshold separates its greys best (Otsu, IEEE Transactions on Systems, Man, and Cybernetics 9 (1979) 62).
    """
    from skimage.filters import threshold_otsu

    grey = read_grey(path)
    dark, light = float(grey.min()), float(grey.max())
    if light - dark < LEAST_CONTRAST:
        raise FormatError(f"{path} is a picture of one colour; draw dark shapes on a light ground")
    middle = float(threshold_otsu(grey))  # type: ignore[no-untyped-call]
    if not dark < middle < light:
        middle = (dark + light) / 2
    # Both sides of the threshold are stretched to 1, so that half-covered pixels at an edge keep their place.
    field = np.clip((middle - grey) / min(middle - dark, light - middle), -1, 1)
    return Picture(field=np.ascontiguousarray(field[::-1].T))
