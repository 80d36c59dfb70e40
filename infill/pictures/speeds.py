"""A layer of a print from above, every line in the colour of its speed; several side by side in one scale."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import BinaryIO, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from infill.planner.layer_speeds import LayerSpeeds

PANEL: Final = 640  # pixels
MARGIN, CAPTION, BAR = 16, 28, 44
LEAST_HEIGHT: Final = 60  # pixels: of a print that is a single line
SUPERSAMPLING: Final = 2
PAPER, INK, TRAVEL = (255, 255, 255), (40, 40, 40), (205, 205, 205)
STOPS: Final = np.array([(38, 56, 150), (20, 140, 180), (90, 180, 70), (240, 160, 40), (190, 30, 40)], dtype=float)


def speed_colours(speed: NDArray[np.floating], top: float) -> NDArray[np.uint8]:
    """Return a colour for every speed, from blue at 0 to red at `top`, (N, 3).

    >>> speed_colours(np.array([0.0, 80.0]), 80.0).tolist()
    [[38, 56, 150], [190, 30, 40]]
    """
    place = np.clip(np.asarray(speed) / top, 0, 1) * (len(STOPS) - 1)
    return np.column_stack([np.interp(place, np.arange(len(STOPS)), channel) for channel in STOPS.T]).astype(np.uint8)


def write_speeds(layers: Mapping[str, LayerSpeeds], file: BinaryIO) -> None:
    """Write the picture of `draw_speeds` as PNG."""
    draw_speeds(layers).save(file, format="PNG", optimize=True)


def draw_speeds(layers: Mapping[str, LayerSpeeds]) -> Image.Image:
    """Draw the speeds of layers side by side.

    Parameters
    ----------
    layers : mapping of str to LayerSpeeds
        By caption.
    """
    drawn = [layer.speed[layer.draws] for layer in layers.values()]
    top = max([float(np.percentile(speed, 99)) for speed in drawn if len(speed)], default=1.0)
    corners = np.concatenate([np.vstack([layer.start[:, :2], layer.end[:, :2]]) for layer in layers.values()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    scale = (PANEL - 2) / (float((high - low).max()) or 1.0)
    height = max(math.ceil(scale * float(high[1] - low[1])) + 2, LEAST_HEIGHT)
    width = MARGIN + len(layers) * (PANEL + MARGIN)
    sheet = Image.new("RGB", (width, MARGIN + CAPTION + height + MARGIN + BAR), PAPER)
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(size=14)
    for number, (caption, layer) in enumerate(layers.items()):
        x = MARGIN + number * (PANEL + MARGIN)
        draw.text((x, MARGIN), caption, fill=INK, font=font)
        sheet.paste(_draw_panel(layer, (low + high) / 2, scale, height, top), (x, MARGIN + CAPTION))
    _draw_scale(sheet, draw, font, top)
    return sheet


def _draw_panel(layer: LayerSpeeds, middle: NDArray[np.floating], scale: float, height: int, top: float) -> Image.Image:
    """Draw the lines of a layer in the colours of their speeds, and travel moves thin, around the middle of all."""
    size = (PANEL * SUPERSAMPLING, height * SUPERSAMPLING)
    picture = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(picture)
    ends = np.column_stack([layer.start[:, :2] - middle, layer.end[:, :2] - middle]) * (scale * SUPERSAMPLING)
    ends[:, 1::2] *= -1  # y upwards
    ends += np.tile(size, 2) / 2
    shades = np.where(layer.draws[:, None], speed_colours(layer.speed, top), np.array(TRAVEL, dtype=np.uint8))
    for line, shade, draws in zip(ends.tolist(), shades.tolist(), layer.draws.tolist(), strict=True):
        draw.line(line, fill=tuple(shade), width=2 * SUPERSAMPLING if draws else 1)
    return picture.resize((PANEL, height), Image.Resampling.BOX)


def _draw_scale(
    sheet: Image.Image, draw: ImageDraw.ImageDraw, font: ImageFont.ImageFont | ImageFont.FreeTypeFont, top: float
) -> None:
    """Draw the scale of colours below the panels."""
    row = sheet.height - BAR
    shades = np.broadcast_to(speed_colours(np.linspace(0, top, PANEL // 2), top), (10, PANEL // 2, 3))
    sheet.paste(Image.fromarray(np.ascontiguousarray(shades)), (MARGIN, row))
    draw.text((MARGIN, row + 14), "0", fill=INK, font=font)
    draw.text((MARGIN + PANEL // 2, row + 14), f"{top:.0f} mm/s", fill=INK, font=font, anchor="ra")
    draw.line([(MARGIN + PANEL // 2 + 20, row + 5), (MARGIN + PANEL // 2 + 50, row + 5)], fill=TRAVEL, width=2)
    draw.text((MARGIN + PANEL // 2 + 58, row - 3), "travel", fill=INK, font=font)
