"""The settings of `infill fill`: defaults, overridden by a TOML file, overridden by flags.

In the file, the options have the names that they have on the command line, and the pattern's own parameters stand in a
table `[set]`::

    pattern = "gyroid"
    density = "20%"
    wall = 1.6

A project that the command wrote has its settings attached, and can be given in place of the file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from infill.errors import UsageError
from infill.lattices.choosing import add_seed, read_own_parameters
from infill.lattices.request import TOLERANCE, FillSpec, check_request
from infill.options.assignments import pop_table
from infill.options.keyword_options import (
    Reader,
    parse_flag,
    parse_number,
    parse_numbers,
    parse_options,
    parse_share,
    parse_whole,
    parse_word,
)
from infill.options.toml import read_toml, write_options
from infill.options.trust import check_trusted

THIRDS = ("density", "line_width", "cell")  # two of them determine the third; the first is dropped first


@dataclass(frozen=True, kw_only=True)
class FillSettings:
    """How to fill, described in terms of the command line.

    Parameters
    ----------
    request : FillSpec
    units : str or None
        Of the mesh.
    slicer : str or None
        The slicer that a project is for.
    """

    request: FillSpec
    units: str | None
    slicer: str | None

    def to_toml(self) -> str:
        """Write all settings as a TOML document that `resolve` reads back."""
        options = {**self.request.facts(), "units": self.units, "for": self.slicer}
        return write_options(options, "infill fill PART --config THIS_FILE -o OUT")


def resolve(
    flags: Mapping[str, Any], assigned: Sequence[str] = (), config: Path | None = None, *, trust: bool = False
) -> FillSettings:
    """Resolve the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    flags : mapping
        Typed values by their names on the command line; None counts as absent.
    assigned : sequence of str
        The pattern's own parameters as ``name=value``.
    config : Path, optional
        A TOML file, or a project.
    trust : bool
        True if the file may name code to run and files from elsewhere: see `infill.options.trust`.

    Raises
    ------
    ParameterError, patterns.PatternError
        If a name is unknown, a value is of the wrong type or out of range, or options contradict each other.
    FormatError
        If the file is missing or not TOML, or asks for what it is not trusted with.
    """
    typed = parse_options("fill", READERS, {name: value for name, value in flags.items() if value is not None})
    read = read_toml(config, example='pattern = "gyroid"') if config else {}
    if config:
        check_trusted({name: value for name, value in read.items() if name not in typed}, config, trust=trust)
    table = dict(pop_table(read))
    filed = parse_options("fill", READERS, read)
    if typed.get("pattern", filed.get("pattern")) != filed.get("pattern"):
        table = {}  # the parameters of another pattern
    if "densities" in filed:
        filed.setdefault("density", filed.pop("densities"))  # as reports call two of them
    for name in THIRDS:
        if all(third in typed or third in filed for third in THIRDS) and name not in typed:
            filed.pop(name, None)
    for name, rival in (("voxel", "resolution"), ("resolution", "voxel")):
        if name in typed and rival not in typed:
            filed.pop(rival, None)
    if "wall" in typed:
        filed.pop("overlap", None)  # it belongs to another wall
    if isinstance(typed.get("density"), float):
        filed.pop("by", None)  # it belongs to two densities
        filed.pop("grade", None)
    options = {**filed, **typed}
    slicer, units = options.pop("for", None), options.pop("units", None)
    form = options.pop("as", "solid" if slicer is None else "project")
    if slicer is not None and form != "project":
        if "as" not in typed:
            form = "project"
        elif "for" in typed:
            raise UsageError(f"for is {slicer!r}, and projects for slicers are as project, not {form}; leave one out")
        else:
            slicer = None
    if form == "project" and slicer is None:
        raise UsageError("as is 'project', and for is missing; say which slicer it is for, such as --for prusaslicer")
    pattern = options.pop("pattern", "gyroid")
    seed = options.pop("seed", None)
    own_values = read_own_parameters(pattern, assigned, table)
    if seed is not None:
        own_values = add_seed(pattern, own_values, seed)
    open_ = options.pop("open", None)
    values = {**DEFAULTS, **options}
    return FillSettings(
        request=check_request(pattern=pattern, own=own_values, form=form, open_=open_, **values),
        units=units,
        slicer=slicer,
    )


def parse_densities(name: str, value: object) -> float | tuple[float, ...]:
    """Read one density, or two with a colon between, or raise UsageError.

    >>> parse_densities("density", "15%:40%"), parse_densities("density", 0.2)
    ((0.15, 0.4), 0.2)
    """
    parts = value.split(":") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
    shares = tuple(parse_share(name, part, "give a share such as 20%, or two such as 15%:40%") for part in parts)
    return shares if len(shares) > 1 else shares[0]


def parse_places(name: str, value: object) -> tuple[tuple[float, ...], ...]:
    """Read one or more places x, y, z, or raise UsageError.

    >>> parse_places("drain_at", ["1,2,3", "4, 5, 6"]), parse_places("drain_at", [7, 8, 9])
    (((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), ((7.0, 8.0, 9.0),))
    """
    is_list = isinstance(value, (list, tuple)) and all(isinstance(part, (list, tuple, str)) for part in value)
    places = value if is_list and isinstance(value, (list, tuple)) else [value]
    return tuple(parse_numbers(name, place, (3,)) for place in places)


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
