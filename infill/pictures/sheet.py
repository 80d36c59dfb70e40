"""Panels side by side, each with its caption, and lines of text below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PIL import Image, ImageDraw, ImageFont

from infill.pictures.render import Colour, render
from infill.surface import Surface

PANEL = 420  # pixels
MARGIN, CAPTION, LINE = 14, 34, 24
SWATCH = 12
BACKGROUND: Colour = (255, 255, 255)
INK: Colour = (40, 40, 40)

Legend = Sequence[tuple[Colour | None, str]]


def arrange_panels(panels: Mapping[str, Image.Image], facts: str, legend: Legend = ()) -> Image.Image:
    """Arrange panels by their captions, with a line of facts, and a legend of colours.

    Parameters
    ----------
    panels : mapping of str to Image
        At most `PANEL` pixels high; wider ones get more room.
    facts : str
    legend : sequence of (colour, str)
        Words, each next to a patch of its colour unless that is None.
    """
    widths = [max(panel.width, PANEL) for panel in panels.values()]
    width = sum(widths) + (len(panels) + 1) * MARGIN
    picture = Image.new("RGB", (width, PANEL + 2 * CAPTION + MARGIN + (LINE if legend else 0)), BACKGROUND)
    draw, font = ImageDraw.Draw(picture), ImageFont.load_default(16)
    for i, (caption, panel) in enumerate(panels.items()):
        x_offset = (i + 1) * MARGIN + sum(widths[:i])
        draw.text((x_offset, 10), caption, fill=INK, font=font)
        picture.paste(panel, (x_offset + (widths[i] - panel.width) // 2, CAPTION + (PANEL - panel.height) // 2))
    draw.text((MARGIN, CAPTION + PANEL + 10), facts, fill=INK, font=font)
    x, top = float(MARGIN), CAPTION + PANEL + 10 + LINE
    for colour, words in legend:
        if colour is not None:
            draw.rectangle((x, top + 4, x + SWATCH, top + 4 + SWATCH), fill=colour)
            x += SWATCH + 8
        draw.text((x, top), words, fill=INK, font=font)
        x += draw.textlength(words, font=font) + 2 * MARGIN
    return picture


def draw_mesh_panel(surface: Surface) -> Image.Image:
    """Draw a mesh as one panel."""
    return Image.fromarray(render(surface, width=PANEL, height=PANEL, background=BACKGROUND))
