"""Regions with another density, pattern or wall, as they are given: boxes, ranges of heights, and meshes."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.errors import ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.options.keyword_options import parse_share
from infill.plain_numbers import plain_argument
from patterns.quantities import LENGTHS, parse_quantity

if TYPE_CHECKING:
    import trimesh

    from infill.surface import Surface

EXAMPLES = "z=10..20:density=40%, box=0,0,0,10,10,5:pattern=grid or modifier.stl:density=60%,wall=2"
RANGE = re.compile(r"z=(?P<low>[^:]*?)\.\.(?P<high>.*)")
# As people type it: 0-10mm, z=0-10, 5..20 mm, 0-0.4in.
UNIT = "|".join(map(re.escape, LENGTHS))
TYPED_RANGE = re.compile(
    rf"(?:z\s*=\s*)?(?P<low>-?[\d.,]*\d\s*(?P<low_unit>{UNIT})?)\s*(?:\.\.|-|–|to)\s*"
    rf"(?P<high>-?[\d.,]*\d\s*(?P<unit>{UNIT})?)"
)
KEYS = ("density", "pattern", "wall")
KEY = re.compile(rf"\s*(?P<key>{'|'.join(KEYS)})\s*=\s*")
UNKNOWN_KEY = re.compile(r":\s*(?P<key>[A-Za-z_][\w-]*)\s*=")
SHARE = "give a density such as density=40%"


@dataclass(frozen=True, kw_only=True, eq=False)
class Region:
    """A part of a filled part with settings of its own: a range of heights, a box, or a mesh.

    Parameters
    ----------
    density : float or str, optional
        Solid share inside the walls there: 0.4, or "40%".
    pattern : str, Path, Pattern, Cells or callable, optional
        The pattern there, as `infill.fill` takes it.
    wall : float or str, optional
        Thickness of the shell there, mm: 2, or "2mm".
    z : (float, float), optional
        Lowest and highest place, mm; infinite ones are allowed.
    box : six floats, optional
        Lowest x, y and z and highest x, y and z, mm.
    mesh : Surface, trimesh.Trimesh, str or Path, optional
        A closed mesh in the coordinates of the part, mm, or its file.
    units : {"um", "mm", "cm", "m", "in"}, optional
        Of the file; by default what the file states, or mm.

    >>> Region(density=0.4, wall=2, z=(10, 20)).text
    'z=10..20:density=40%,wall=2'
    """

    density: float | str | None = None
    pattern: object = None
    wall: float | str | None = None
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
        settings = []
        if self.density is not None:
            settings.append(f"density={plain_argument(100 * parse_share('density', self.density), 10)}%")
        if self.pattern is not None:
            settings.append(f"pattern={name_pattern(self.pattern)}")
        if self.wall is not None:
            settings.append(f"wall={plain_argument(parse_wall('wall', self.wall), 10)}")
        return f"{self.place}:{','.join(settings)}"


def name_pattern(pattern: object) -> str:
    """Return the name of a pattern that is given by name, by file or as an object."""
    if isinstance(pattern, (str, Path)):
        return str(pattern)
    return str(getattr(pattern, "name", getattr(pattern, "__name__", type(pattern).__name__)))


def parse_wall(name: str, wall: object) -> float:
    """Read the thickness of a shell, mm: 2, "2mm" or "0.2cm"; raise UsageError.

    >>> parse_wall("region", "2mm"), parse_wall("region", 1.6)
    (2.0, 1.6)
    """
    length = parse_quantity(wall, "mm") if isinstance(wall, str) else wall
    if length is None or isinstance(length, bool) or not isinstance(length, (int, float)):
        raise UsageError.about(name, f"has a wall of {quote_value(wall)}; give a thickness in mm, such as wall=2")
    return float(length)


def parse_region(name: str, text: str) -> Region:
    """Read a region such as z=10..20:density=40%, or raise UsageError.

    >>> parse_region("region", "z=10..20:density=40%").z, parse_region("region", "a.stl:density=60%").mesh
    ((10.0, 20.0), 'a.stl')
    >>> parse_region("region", "0-10mm:density=60%").z, parse_region("region", "z=0,5 - 8:density=60%").z
    ((0.0, 10.0), (0.5, 8.0))
    >>> parse_region("region", "0-1cm:wall=2").z, parse_region("region", "z=0..0.5in:wall=0.1in").wall
    ((0.0, 10.0), 2.54)
    >>> region = parse_region("region", "z=0..:pattern=grid, density=60%, wall=2mm")
    >>> region.pattern, region.density, region.wall
    ('grid', 0.6, 2.0)
    """
    found = re.search(rf":{KEY.pattern}", text)
    unknown = UNKNOWN_KEY.search(text)
    if unknown and unknown["key"] not in KEYS and (found is None or unknown.start() < found.start()):
        raise UsageError.about(
            name, f"is {quote_value(text)}, and regions have no {unknown['key']}; give {', '.join(KEYS)}"
        )
    place = text[: found.start()].strip() if found else ""
    if not found or not place:
        raise UsageError.about(name, f"is {quote_value(text)}; give a place and a setting, such as {EXAMPLES}")
    settings = _parse_settings(name, text, text[found.start() + 1 :])
    if found_range := TYPED_RANGE.fullmatch(place) or RANGE.fullmatch(place):
        ends = found_range.groupdict()
        if ends.get("unit") and not ends["low_unit"]:
            ends["low"] += ends["unit"]  # 0-1cm: both are cm
        low, high = (_parse_end(name, text, ends[end], at) for end, at in (("low", -math.inf), ("high", math.inf)))
        return Region(**settings, z=(low, high))
    if place.startswith("box="):
        corners = tuple(_parse_end(name, text, word, math.nan) for word in place[len("box=") :].split(","))
        return Region(**settings, box=corners)
    if not Path(place).suffix:
        raise UsageError.about(name, f"is {quote_value(text)}; give a place and a setting, such as {EXAMPLES}")
    return Region(**settings, mesh=place)


def _parse_settings(name: str, text: str, words: str) -> dict[str, Any]:
    """Read the settings behind a place: density=40%, pattern=grid, wall=2mm."""
    settings: dict[str, Any] = {}
    for word in re.split(rf",(?=\s*(?:{'|'.join(KEYS)}|[A-Za-z_][\w-]*)\s*=)", words):
        setting = KEY.match(word)
        if setting is None or not word[setting.end() :].strip():
            raise UsageError.about(
                name,
                f"is {quote_value(text)}, and {quote_value(word.strip())} is not a setting; give {', '.join(KEYS)}",
            )
        key, value = setting["key"], word[setting.end() :].strip()
        if key in settings:
            raise UsageError.about(name, f"is {quote_value(text)}, with {key} twice; give it once")
        if key == "density":
            settings[key] = _parse_density(name, text, value)
        else:
            settings[key] = value if key == "pattern" else parse_wall(name, value)
    return settings


def _parse_density(name: str, text: str, value: str) -> float:
    """Read the density of a region, or raise UsageError that shows the region and its density."""
    try:
        return parse_share(name, value, SHARE)
    except ParameterError:
        raise UsageError.about(
            name, f"is {quote_value(text)}, with a density of {quote_value(value)}; {SHARE}, up to 90%"
        ) from None


def _parse_end(name: str, text: str, word: str, left_out: float) -> float:
    """Read a coordinate, mm, or return the one that stands for none."""
    if not word.strip() and not math.isnan(left_out):
        return left_out
    place = parse_quantity(word, "mm")
    if place is None:
        raise UsageError.about(name, f"is {quote_value(text)}; give numbers in mm, such as {EXAMPLES}")
    return place
