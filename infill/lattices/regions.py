"""Regions of a part with another density, as they are given: boxes, ranges of heights, and meshes."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.options.keyword_options import parse_share
from infill.plain_numbers import plain_argument

if TYPE_CHECKING:
    import trimesh

    from infill.surface import Surface

EXAMPLES = "z=10..20:density=40%, box=0,0,0,10,10,5:density=40% or modifier.stl:density=60%"
RANGE = re.compile(r"z=(?P<low>[^:]*?)\.\.(?P<high>.*)")
# As people type it: 0-10mm, z=0-10, 5..20 mm.
TYPED_RANGE = re.compile(
    r"(?:z\s*=\s*)?(?P<low>-?[\d.,]*\d)\s*(?:mm)?\s*(?:\.\.|-|–|to)\s*(?P<high>-?[\d.,]*\d)\s*(?:mm)?"
)
SHARE = "give a density such as density=40%"


@dataclass(frozen=True, kw_only=True, eq=False)
class Region:
    """A part of the space inside the walls with a density of its own: a range of heights, a box, or a mesh.

    Parameters
    ----------
    density : float or str
        Solid share there: 0.4, or "40%".
    z : (float, float), optional
        Lowest and highest place, mm; infinite ones are allowed.
    box : six floats, optional
        Lowest x, y and z and highest x, y and z, mm.
    mesh : Surface, trimesh.Trimesh, str or Path, optional
        A closed mesh in the coordinates of the part, mm, or its file.
    units : {"um", "mm", "cm", "m", "in"}, optional
        Of the file; by default what the file states, or mm.

    >>> Region(density=0.4, z=(10, 20)).text
    'z=10..20:density=40%'
    """

    density: float | str
    z: tuple[float, float] | None = None
    box: tuple[float, ...] | None = None
    mesh: Surface | trimesh.Trimesh | str | Path | None = None
    units: str | None = None

    @property
    def place(self) -> str:
        """The place as the command line has it."""
        if self.z is not None:
            return "z=" + "..".join(f"{plain_argument(end, 10)}" if math.isfinite(end) else "" for end in self.z)
        if self.box is not None:
            return "box=" + ",".join(f"{plain_argument(end, 10)}" for end in self.box)
        return str(self.mesh) if isinstance(self.mesh, (str, Path)) else "a mesh"

    @property
    def text(self) -> str:
        """The region as the command line has it."""
        return f"{self.place}:density={plain_argument(100 * parse_share('density', self.density), 10)}%"


def parse_region(name: str, text: str) -> Region:
    """Read a region such as z=10..20:density=40%, or raise UsageError.

    >>> parse_region("region", "z=10..20:density=40%").z, parse_region("region", "a.stl:density=60%").mesh
    ((10.0, 20.0), 'a.stl')
    >>> parse_region("region", "0-10mm:density=60%").z, parse_region("region", "z=0,5 - 8:density=60%").z
    ((0.0, 10.0), (0.5, 8.0))
    """
    place, found, share = text.rpartition(":density=")
    if not found or not place.strip():
        raise UsageError.about(name, f"is {quote_value(text)}; give a place and a density, such as {EXAMPLES}")
    density = parse_share(name, share, SHARE)
    place = place.strip()
    if found_range := TYPED_RANGE.fullmatch(place) or RANGE.fullmatch(place):
        low, high = (
            _parse_end(name, text, found_range[end], at) for end, at in (("low", -math.inf), ("high", math.inf))
        )
        return Region(density=density, z=(low, high))
    if place.startswith("box="):
        corners = tuple(_parse_end(name, text, word, math.nan) for word in place[len("box=") :].split(","))
        return Region(density=density, box=corners)
    if not Path(place).suffix:
        raise UsageError.about(name, f"is {quote_value(text)}; give a place and a density, such as {EXAMPLES}")
    return Region(density=density, mesh=place)


def _parse_end(name: str, text: str, word: str, left_out: float) -> float:
    """Read a coordinate, mm, or return the one that stands for none."""
    try:
        return float(word.replace(",", ".")) if word.strip() or math.isnan(left_out) else left_out
    except ValueError:
        raise UsageError.about(name, f"is {quote_value(text)}; give numbers in mm, such as {EXAMPLES}") from None
