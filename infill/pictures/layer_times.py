"""Seconds of every layer of a print as a curve; those of several prints in one diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import BinaryIO, Final

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from infill.plain_numbers import plain_number

WIDTH, HEIGHT = 1000, 420  # pixels of the diagram
LEFT, TOP, RIGHT, BOTTOM = 64, 16, 24, 48
CAPTION: Final = 22  # pixels of a line
PAPER, INK, RULE = (255, 255, 255), (40, 40, 40), (225, 225, 225)
COLOURS: Final = ((30, 90, 180), (210, 80, 30))
HEADROOM: Final = 1.05  # of the diagram over its highest value
TICKS: Final = 6  # at most, of an axis
SUPERSAMPLING: Final = 2


def round_step(extent: float, most: int = TICKS) -> float:
    """Return the least step of 1, 2 or 5 times a power of ten that divides an extent into at most some parts.

    >>> round_step(100), round_step(7), round_step(1.3)
    (20.0, 2.0, 0.5)
    """
    power = 10.0 ** np.floor(np.log10(extent / most))
    return float(next(factor * power for factor in (1, 2, 5, 10) if extent <= most * factor * power * (1 + 1e-9)))


def write_layer_times(curves: Mapping[str, Sequence[float]], file: BinaryIO) -> None:
    """Write the picture of `draw_layer_times` as PNG."""
    draw_layer_times(curves).save(file, format="PNG", optimize=True)


def draw_layer_times(curves: Mapping[str, Sequence[float]]) -> Image.Image:
    """Draw seconds over the number of the layer, from 1.

    Parameters
    ----------
    curves : mapping of str to sequence of float
        Seconds of every layer, by caption.
    """
    layers = max(max(map(len, curves.values())), 2)
    top = HEADROOM * max((max(seconds, default=0.0) for seconds in curves.values()), default=0.0) or 1.0
    scale = SUPERSAMPLING
    size = LEFT + WIDTH + RIGHT, TOP + CAPTION * len(curves) + HEIGHT + BOTTOM
    sheet = Image.new("RGB", (size[0] * scale, size[1] * scale), PAPER)
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=14 * scale)
    origin = LEFT * scale, (size[1] - BOTTOM) * scale

    def place(layer: float, seconds: float) -> tuple[float, float]:
        """Return the pixel (x, y) of the seconds of a layer."""
        return (
            origin[0] + (layer - 1) / (layers - 1) * WIDTH * scale,
            origin[1] - seconds / top * HEIGHT * scale,
        )

    step = round_step(top)
    for seconds in np.arange(0, top, step).tolist():
        draw.line([place(1, seconds), place(layers, seconds)], fill=RULE, width=scale)
        draw.text(
            (origin[0] - 8 * scale, place(1, seconds)[1]), plain_number(seconds, 6), fill=INK, font=font, anchor="rm"
        )
    number_step = max(int(round_step(layers)), 1)
    for number in [1, *range(number_step, layers + 1, number_step)]:
        x, y = place(number, 0)
        draw.line([(x, y), (x, y + 5 * scale)], fill=INK, width=scale)
        draw.text((x, y + 8 * scale), f"{number}", fill=INK, font=font, anchor="ma")
    draw.line([place(1, top), origin, place(layers, 0)], fill=INK, width=scale)
    draw.text((size[0] * scale // 2, (size[1] - 4) * scale), "layer", fill=INK, font=font, anchor="md")
    draw.text((8 * scale, place(1, top)[1]), "s", fill=INK, font=font, anchor="lm")
    for row, ((caption, curve), colour) in enumerate(zip(curves.items(), COLOURS, strict=False)):
        y = (TOP + CAPTION * row) * scale
        draw.line([(origin[0], y + 9 * scale), (origin[0] + 24 * scale, y + 9 * scale)], fill=colour, width=3 * scale)
        draw.text((origin[0] + 32 * scale, y), caption, fill=INK, font=font)
        points = [place(number, seconds) for number, seconds in enumerate(curve, 1)]
        if len(points) > 1:
            draw.line(points, fill=colour, width=scale)
        x, y = points[0]
        draw.ellipse((x - scale, y - scale, x + scale, y + scale), fill=colour)
    return sheet.resize(size, Image.Resampling.BOX)
