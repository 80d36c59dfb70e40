"""Panels side by side, each with its caption, and lines of text below."""

from __future__ import annotations

import re
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
Font = ImageFont.FreeTypeFont | ImageFont.ImageFont


def arrange_panels(panels: Mapping[str, Image.Image], facts: str, legend: Legend = ()) -> Image.Image:
    """Arrange panels by their captions, with facts below, and a legend of colours.

    Parameters
    ----------
    panels : mapping of str to Image
        At most `PANEL` pixels high; wider ones get more room.
    facts : str
        Broken into lines as wide as the picture.
    legend : sequence of (colour, str)
        Words, each next to a patch of its colour unless that is None.
    """
    widths = [max(panel.width, PANEL) for panel in panels.values()]
    width = sum(widths) + (len(panels) + 1) * MARGIN
    font = ImageFont.load_default(16)
    fact_lines = wrap_words(spell_units(facts), width - 2 * MARGIN, font)
    rows = _arrange_legend(legend, width, font)
    line_count = max(len(fact_lines), 1) + len(rows)
    picture = Image.new("RGB", (width, PANEL + 2 * CAPTION + MARGIN + LINE * (line_count - 1)), BACKGROUND)
    draw = ImageDraw.Draw(picture)
    for i, (caption, panel) in enumerate(panels.items()):
        x_offset = (i + 1) * MARGIN + sum(widths[:i])
        draw.text((x_offset, 10), spell_units(caption), fill=INK, font=font)
        picture.paste(panel, (x_offset + (widths[i] - panel.width) // 2, CAPTION + (PANEL - panel.height) // 2))
    top = CAPTION + PANEL + 10
    for line in fact_lines:
        draw.text((MARGIN, top), line, fill=INK, font=font)
        top += LINE
    for row in rows:
        for x, colour, words in row:
            if colour is not None:
                draw.rectangle((x, top + 4, x + SWATCH, top + 4 + SWATCH), fill=colour)
            draw.text((x + _swatch_width(colour), top), words, fill=INK, font=font)
        top += LINE
    return picture


def spell_units(text: str) -> str:
    """Spell out units whose signs the font of pictures lacks: mm³ as cubic mm, µm as um.

    >>> spell_units("3 mm³ of 12 µm², 2 x 4 µm")
    '3 cubic mm of 12 square um, 2 x 4 um'
    """
    powers = {"²": "square", "³": "cubic"}
    return re.sub(r"(\w+)([²³])", lambda match: f"{powers[match[2]]} {match[1]}", text).replace("µ", "u")


def wrap_words(text: str, width: float, font: Font) -> list[str]:
    """Break a text between words into lines that are at most `width` pixels wide; a longer word has its own line."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and font.getlength(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def _swatch_width(colour: Colour | None) -> int:
    """Return the pixels that a patch of colour takes before its words."""
    return 0 if colour is None else SWATCH + 8


def _arrange_legend(legend: Legend, width: int, font: Font) -> list[list[tuple[float, Colour | None, str]]]:
    """Arrange the entries of a legend in rows of the picture's width: the left edge, colour and words of each."""
    rows: list[list[tuple[float, Colour | None, str]]] = []
    x = float(width)
    for colour, text in legend:
        words = spell_units(text)
        entry_width = _swatch_width(colour) + font.getlength(words)
        if not rows or x + entry_width > width - MARGIN:
            rows.append([])
            x = float(MARGIN)
        rows[-1].append((x, colour, words))
        x += entry_width + 2 * MARGIN
    return rows


def draw_mesh_panel(surface: Surface) -> Image.Image:
    """Draw a mesh as one panel."""
    return Image.fromarray(render(surface, width=PANEL, height=PANEL, background=BACKGROUND))
