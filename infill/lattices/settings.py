"""The settings of `infill fill`: defaults, overridden by a TOML file, overridden by flags.

In the file, the options have the names that they have on the command line, and the pattern's own parameters stand in a
table `[set]`::

    pattern = "gyroid"
    density = "20%"
    wall = 1.6

A project that the command wrote has them attached, and can be given in place of the file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from infill.errors import UsageError
from infill.lattices.choosing import own_parameters, seeded
from infill.lattices.request import TOLERANCE, Request, checked
from infill.options.assignments import table_of
from infill.options.keyword_options import (
    Reader,
    parse_flag,
    parse_number,
    parse_numbers,
    parse_share,
    parse_whole,
    parse_word,
    parsed,
)
from infill.options.toml import options_text, read_toml
from infill.options.trust import check_trusted

THIRDS = ("density", "line_width", "cell")  # of which two say the third; the first to go


@dataclass(frozen=True, kw_only=True)
class FillSettings:
    """How to fill, described in terms of the command line.

    Parameters
    ----------
    request : Request
    units : str or None
        Of the mesh.
    slicer : str or None
        For whom a project is.
    """

    request: Request
    units: str | None
    slicer: str | None

    def to_toml(self) -> str:
        """Return all settings, as a TOML document that `resolve` reads back."""
        options = {**self.request.facts(), "units": self.units, "for": self.slicer}
        return options_text(options, "infill fill PART --config THIS_FILE -o OUT")


def resolve(
    flags: Mapping[str, Any], assigned: Sequence[str] = (), config: Path | None = None, *, trust: bool = False
) -> FillSettings:
    """Return the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    flags : mapping
        What was typed, by its name on the command line; None counts as not given.
    assigned : sequence of str
        The pattern's own parameters as ``name=value``.
    config : Path, optional
        A TOML file, or a project.
    trust : bool
        Whether the file may name code to run and files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError, patterns.PatternError
        If a name is unknown, a value is of the wrong type or out of range, or options contradict each other.
    FormatError
        If the file is missing or not TOML, or asks for what it is not trusted with.
    """
    typed = parsed("fill", READERS, {name: value for name, value in flags.items() if value is not None})
    read = read_toml(config, example='pattern = "gyroid"') if config else {}
    if config:
        check_trusted({name: value for name, value in read.items() if name not in typed}, config, trust=trust)
    table = dict(table_of(read))
    filed = parsed("fill", READERS, read)
    if typed.get("pattern", filed.get("pattern")) != filed.get("pattern"):
        table = {}  # the parameters of another pattern
    if "densities" in filed:
        filed.setdefault("density", filed.pop("densities"))  # as reports call two of them
    for name in THIRDS:
        if all(each in typed or each in filed for each in THIRDS) and name not in typed:
            filed.pop(name, None)
    for name, other in (("voxel", "resolution"), ("resolution", "voxel")):
        if name in typed and other not in typed:
            filed.pop(other, None)
    if "wall" in typed:
        filed.pop("overlap", None)  # that of another wall
    if isinstance(typed.get("density"), float):
        filed.pop("by", None)  # that of two
        filed.pop("grade", None)
    both = {**filed, **typed}
    slicer, units = both.pop("for", None), both.pop("units", None)
    form = both.pop("as", "solid" if slicer is None else "project")
    if slicer is not None and form != "project":
        if "as" not in typed:
            form = "project"
        elif "for" in typed:
            raise UsageError(f"for is {slicer!r}, and projects for slicers are as project, not {form}; leave one out")
        else:
            slicer = None
    if form == "project" and slicer is None:
        raise UsageError("as is 'project', and for is missing; say which slicer it is for, such as --for prusaslicer")
    pattern = both.pop("pattern", "gyroid")
    seed = both.pop("seed", None)
    own = own_parameters(pattern, assigned, table)
    if seed is not None:
        own = seeded(pattern, own, seed)
    open_ = both.pop("open", None)
    values = {**DEFAULTS, **both}
    return FillSettings(
        request=checked(pattern=pattern, own=own, form=form, open_=open_, **values), units=units, slicer=slicer
    )


def parse_densities(name: str, value: object) -> float | tuple[float, ...]:
    """Return one density, or two with a colon between, or raise UsageError.

    >>> parse_densities("density", "15%:40%"), parse_densities("density", 0.2)
    ((0.15, 0.4), 0.2)
    """
    parts = value.split(":") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
    found = tuple(parse_share(name, each, "give a share such as 20%, or two such as 15%:40%") for each in parts)
    return found if len(found) > 1 else found[0]


def parse_places(name: str, value: object) -> tuple[tuple[float, ...], ...]:
    """Return places x, y, z, of which there may be one alone, or raise UsageError.

    >>> parse_places("drain_at", ["1,2,3", "4, 5, 6"]), parse_places("drain_at", [7, 8, 9])
    (((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), ((7.0, 8.0, 9.0),))
    """
    several = isinstance(value, (list, tuple)) and all(isinstance(each, (list, tuple, str)) for each in value)
    places = value if several and isinstance(value, (list, tuple)) else [value]
    return tuple(parse_numbers(name, each, (3,)) for each in places)


DEFAULTS: dict[str, Any] = {
    "density": None,
    "by": None,
    "grade": None,
    "cell": None,
    "line_width": None,
    "wall": None,
    "align": "part",
    "angle": 0.0,
    "phase": (0.0, 0.0, 0.0),
    "drain": None,
    "vent": False,
    "drain_at": (),
    "smooth_radius": None,
    "overlap": None,
    "tolerance": TOLERANCE,
    "max_triangles": None,
    "resolution": None,
    "voxel": None,
}
READERS: Mapping[str, Reader] = {
    "pattern": parse_word,
    "density": parse_densities,
    "densities": parse_densities,
    "by": parse_word,
    "grade": parse_word,
    "cell": parse_number,
    "line_width": parse_number,
    "wall": parse_number,
    "as": parse_word,
    "for": parse_word,
    "units": parse_word,
    "align": parse_word,
    "angle": parse_number,
    "phase": partial(parse_numbers, counts=(2, 3)),
    "seed": parse_whole,
    "drain": parse_number,
    "vent": parse_flag,
    "drain_at": parse_places,
    "open": parse_word,
    "smooth_radius": parse_number,
    "overlap": parse_number,
    "tolerance": parse_number,
    "max_triangles": parse_whole,
    "resolution": parse_whole,
    "voxel": parse_number,
}
