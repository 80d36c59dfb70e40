"""A part of a file with several meshes: a surface with a name and an optional colour."""

from __future__ import annotations

from collections.abc import Mapping
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
        Empty for none.
    colour : (red, green, blue), optional
        From 0 to 1, sRGB.
    """

    surface: Surface
    name: str = ""
    colour: Colour | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class LatePart:
    """One mesh among several, which is made when it is asked for; otherwise as `Part`.

    Parameters
    ----------
    surfaces : mapping of str to Surface
    name : str
        Of its surface among these.
    colour : (red, green, blue), optional
    """

    surfaces: Mapping[str, Surface]
    name: str
    colour: Colour | None = None

    @property
    def surface(self) -> Surface:
        """The surface, mm."""
        return self.surfaces[self.name]


def hex_colour(colour: Colour) -> str:
    """Return a colour in the notation of the web.

    >>> hex_colour((1.0, 0.5, 0.0))
    '#FF8000'
    """
    return "#" + "".join(f"{round(255 * channel):02X}" for channel in colour)


def printable_name(name: str) -> str:
    r"""Return a name on one line, without unprintable characters, some of which XML forbids.

    >>> printable_name("a\x01b\u00a0c")
    'ab c'
    """
    return "".join(character for character in " ".join(name.split()) if character.isprintable())
