"""A drawing of a pattern: its lines at height 0 in the default block, as pixels or as text."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np
import shapely
from numpy.typing import NDArray

from patterns import Pattern
from patterns.linework import sample_points
from patterns.protocol import draw_lines

SIZE = 60.0  # mm: the default block of make
LINE_WIDTH = 0.45  # mm: the default line width of make
PIXELS = 600
SUPERSAMPLING = 3
INK, PAPER = (40, 40, 40), (255, 255, 255)
BRAILLE_COLUMNS, PLAIN_COLUMNS = 40, 60
# A braille character has 2 x 4 dots; these are their bits, column by column from the top.
BRAILLE = 0x2800
DOT_BITS = np.array([[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]])


def default_lines(pattern: Pattern) -> shapely.MultiLineString:
    """Return the lines of a pattern at height 0 in the default block, centred on (0, 0), mm."""
    half = (SIZE - LINE_WIDTH) / 2
    return draw_lines(pattern, shapely.box(-half, -half, half, half))


def write_drawing(pattern: Pattern, file: BinaryIO) -> None:
    """Write the lines of a pattern, as wide as make's default, as PNG."""
    from PIL import Image, ImageDraw

    scale = PIXELS * SUPERSAMPLING / SIZE
    picture = Image.new("RGB", (PIXELS * SUPERSAMPLING,) * 2, PAPER)
    draw = ImageDraw.Draw(picture)
    for line in default_lines(pattern).geoms:
        x, y = (shapely.get_coordinates(line) * (1, -1) + SIZE / 2).T * scale
        draw.line(list(zip(x, y, strict=True)), fill=INK, width=round(LINE_WIDTH * scale), joint="curve")
    picture.resize((PIXELS, PIXELS), Image.Resampling.BOX).save(file, format="PNG", optimize=True)


def draw_text(pattern: Pattern, *, braille: bool = True) -> str:
    """Draw the lines of a pattern as a square of text: braille dots, or larger, a # for each cell with a line."""
    columns = BRAILLE_COLUMNS if braille else PLAIN_COLUMNS
    rows = columns // 2  # a character is about twice as high as wide
    across, down = (2, 4) if braille else (1, 1)
    dots = _dots(default_lines(pattern), (columns * across, rows * down))
    if not braille:
        return "\n".join("".join("#" if dot else " " for dot in row).rstrip() for row in dots.T)
    bits = (dots.reshape(columns, across, rows, down).transpose(2, 0, 1, 3) * DOT_BITS).sum(axis=(2, 3))
    return "\n".join("".join(chr(BRAILLE + bit) for bit in row) for row in bits)


def _dots(lines: shapely.MultiLineString, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Return True for dots [x from the left, y from the top] on a line."""
    points = sample_points(lines, SIZE / max(shape) / 2)
    place = ((points * (1, -1) / SIZE + 0.5) * shape).astype(int).clip(0, np.array(shape) - 1)
    dots = np.zeros(shape, dtype=bool)
    dots[tuple(place.T)] = True
    return dots
