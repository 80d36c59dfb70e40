"""A part of a file that holds several meshes: a surface with a name, and perhaps a colour."""

from __future__ import annotations

from dataclasses import dataclass

from infill.imaging.label_tables import Colour
from infill.surface import Surface


@dataclass(frozen=True, kw_only=True)
class Part:
    """One mesh among several.

    Parameters
    ----------
    surface : Surface, mm
    name : str
        Empty if it has none.
    colour : (red, green, blue), optional
        From 0 to 1, sRGB.
    """

    surface: Surface
    name: str = ""
    colour: Colour | None = None


def hexadecimal(colour: Colour) -> str:
    """Return a colour as it is written on the web.

    >>> hexadecimal((1.0, 0.5, 0.0))
    '#FF8000'
    """
    return "#" + "".join(f"{round(255 * each):02X}" for each in colour)


def plain(name: str) -> str:
    r"""Return a name without the characters that XML forbids.

    >>> plain("a\x01b\u00a0c")
    'ab c'
    """
    return "".join(each for each in " ".join(name.split()) if each.isprintable())
