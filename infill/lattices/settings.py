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
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, get_args

from infill.checks import choose_word
from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.lattices.regions import Region, parse_region
from infill.options.assignments import pop_table
from infill.options.declaration import Option, by_field, drop_replaced, read_options
from infill.options.keyword_options import parse_numbers, parse_share, parse_word
from infill.options.toml import format_options, read_toml
from infill.options.trust import check_trusted

if TYPE_CHECKING:
    from infill.lattices.request import FillSpec

THIRDS = ("density", "line_width", "cell")  # two of them determine the third; the first is dropped first
Slicer = Literal["prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"]
FILES, PATTERN, SOLID = "Files", "Pattern", "Solid"


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


def parse_slicers(name: str, value: object) -> tuple[Slicer, ...]:
    """Read one or more slicers, each once, or raise UsageError.

    >>> parse_slicers("for", ["cura", "prusaslicer", "cura"]), parse_slicers("for", "plain")
    (('cura', 'prusaslicer'), ('plain',))
    """
    slicers: dict[Slicer, None] = {}
    for word in value if isinstance(value, (list, tuple)) else [value]:
        meant = choose_word(word, get_args(Slicer)) if isinstance(word, str) else word
        known = next((slicer for slicer in get_args(Slicer) if slicer == meant), None)
        if known is None:
            raise UsageError.about(name, f"is {quote_value(word)}; choose from {', '.join(get_args(Slicer))}")
        slicers[known] = None
    return tuple(slicers)


def parse_regions(name: str, value: object) -> tuple[Region, ...]:
    """Read one or more regions, or raise UsageError.

    >>> [region.density for region in parse_regions("region", ["z=0..5:density=40%", "a.stl:density=60%"])]
    [0.4, 0.6]
    """
    texts = value if isinstance(value, (list, tuple)) else [value]
    return tuple(parse_region(name, parse_word(name, text)) for text in texts)


@dataclass(frozen=True, kw_only=True)
class FillOptions:
    """The options of a fill, as typed or as a config file has them; None for those left to the request."""

    units: Annotated[
        Literal["um", "mm", "cm", "m", "in"] | None, Option("Unit of the mesh.", FILES, default="as in the file, or mm")
    ] = None
    pattern: Annotated[
        str,
        Option(
            "Any that 'infill list' shows: walls in space, such as gyroid; bars, such as octet, voronoi-foam or"
            " gyroid-network; upright walls, such as honeycomb. Or a drawing that is repeated (.svg .dxf .wkt "
            ".png .jpg .bmp), or module.py:name.",
            PATTERN,
            unit="NAME",
            default="gyroid",
        ),
    ] = "gyroid"
    density: Annotated[
        float | tuple[float, ...] | None,
        Option(
            "Infill density: 20%, or 0.2; two, such as 15%:40%, for one that changes.",
            PATTERN,
            unit="SHARE",
            default="20%",
            read=parse_densities,
            typed=str,
        ),
    ] = None
    by: Annotated[
        str | None,
        Option(
            "Direction in which the density changes from its first value to its second: x, y, z, or skin (from the "
            "skin inwards); or a field: a .csv of x, y, z, value, results of a simulation, .vtu or .frd, a .npy, a "
            "picture from above, or module.py:name.",
            PATTERN,
            unit="FIELD",
            default="z",
        ),
    ] = None
    grade: Annotated[
        Literal["width", "cell"] | None,
        Option(
            "What changes between two densities: the width of walls; or the size of cells, for walls in "
            "space such as gyroid.",
            PATTERN,
            default="width",
        ),
    ] = None
    regions: Annotated[
        tuple[Region, ...],
        Option(
            "Another density, pattern or wall in a range of heights (z=10..20:density=40%), a box "
            "(box=x0,y0,z0,x1,y1,z1:pattern=grid) or a mesh (modifier.stl:density=60%,wall=2), mm; may be given again, "
            "and later ones win.",
            PATTERN,
            unit="WHERE:KEY=VALUE",
            name="region",
            read=parse_regions,
            typed=list[str],
        ),
    ] = ()
    cell: Annotated[
        float | None, Option("Period of the pattern.", PATTERN, unit="MM", default="by density and line width")
    ] = None
    line_width: Annotated[
        float | None,
        Option(
            "Width of the walls inside, or diameter of bars.",
            PATTERN,
            unit="MM",
            default="0.45, in a project 0.9, or for bars, by density and cell",
        ),
    ] = None
    align: Annotated[
        Literal["part", "bed", "body"],
        Option(
            "Where the pattern begins: in the middle of the part, at x = y = 0 on its bottom, or in the middle "
            "of each body of several.",
            PATTERN,
            default="part",
        ),
    ] = "part"
    angle: Annotated[
        float, Option("Turns the pattern counter-clockwise about z.", PATTERN, unit="DEG", default="0")
    ] = 0.0
    phase: Annotated[
        tuple[float, ...],
        Option(
            "Shifts the pattern in x, y and z.",
            PATTERN,
            unit="MM MM MM",
            default="0 0 0; in a project, to where slicers print it",
            read=partial(parse_numbers, counts=(2, 3)),
            typed=tuple[float, float, float],
        ),
    ] = (0.0, 0.0, 0.0)
    seed: Annotated[
        int | None, Option("Random seed, for voronoi and voronoi-foam.", PATTERN, unit="N", default="0")
    ] = None
    wall: Annotated[
        float | None,
        Option(
            "Thickness of the shell, 0 for none; in a project, what the slicer's perimeters take.",
            SOLID,
            unit="MM",
            default="1.2, in a project 0.9",
        ),
    ] = None
    drain: Annotated[
        float | None,
        Option(
            "Add drain holes of this diameter, one at the bottom of each closed cavity (for resin and powder), a "
            "wall away from every side.",
            SOLID,
            unit="MM",
            default="none",
        ),
    ] = None
    vent: Annotated[
        bool, Option("With --drain, also a hole up from the highest place of every void, for air.", SOLID)
    ] = False
    drain_at: Annotated[
        tuple[tuple[float, ...], ...],
        Option(
            "With --drain, a place on the skin for a hole straight in, mm; may be given again.",
            SOLID,
            unit="X,Y,Z",
            read=parse_places,
            typed=list[str],
        ),
    ] = ()
    open_: Annotated[
        Literal["top", "bottom", "both"] | None,
        Option(
            "Leave the shell out at the flat top or bottom of the part, or both: voids are open there.",
            SOLID,
            name="open",
            default="closed",
        ),
    ] = None
    ties: Annotated[
        bool,
        Option(
            "Where neither floor nor roof holds upright walls, with --open both or --wall 0: tie islands of them to "
            "the nearest wall or line by bars of the line width.",
            SOLID,
            negatable=True,
        ),
    ] = True
    smooth_radius: Annotated[
        float | None,
        Option(
            "Radius of the fillets where walls meet at right angles; 0 for none.",
            SOLID,
            unit="MM",
            default="0.25, less in small parts",
        ),
    ] = None
    form: Annotated[
        Literal["solid", "infill", "project"] | None,
        Option(
            "solid: shell and infill in one; infill: the infill alone; project: part and infill for a slicer.",
            SOLID,
            name="as",
            default="solid, or project with --for",
        ),
    ] = None
    slicer: Annotated[
        tuple[Slicer, ...],
        Option(
            "Slicer that a project is for; plain: two objects without settings. May be given again, with {slicer} in "
            "the name of the file.",
            SOLID,
            name="for",
            unit="|".join(get_args(Slicer)),
            read=parse_slicers,
            typed=list[str],
        ),
    ] = ()
    overlap: Annotated[
        float | None, Option("How far the infill alone reaches into the shell.", SOLID, unit="MM", default="0.15")
    ] = None
    tolerance: Annotated[
        float,
        Option(
            "Simplify the voids: move their surface by at most this; 0 for all triangles.",
            SOLID,
            unit="MM",
            default="0.03",
        ),
    ] = 0.03
    max_triangles: Annotated[
        int | None, Option("Most triangles of the mesh.", SOLID, unit="N", default="a million")
    ] = None
    resolution: Annotated[
        int | None,
        Option(
            "Cells along the longest side of the part, in which voids are computed.",
            SOLID,
            unit="N",
            default="what pattern and wall need",
            replaces=("voxel",),
        ),
    ] = None
    voxel: Annotated[
        float | None, Option("Size of these cells instead.", SOLID, unit="MM", replaces=("resolution",))
    ] = None


@dataclass(frozen=True, kw_only=True)
class FillSettings:
    """How to fill, described in terms of the command line.

    Parameters
    ----------
    request : FillSpec
    units : str or None
        Of the mesh.
    slicers : tuple of str
        The slicers that a project is for; empty for a mesh.
    """

    request: FillSpec
    units: str | None
    slicers: tuple[Slicer, ...] = ()

    def to_toml(self) -> str:
        """Write all settings as a TOML document that `resolve` reads back."""
        slicer = self.slicers[0] if len(self.slicers) == 1 else self.slicers or None
        options = {**self.request.facts(), "units": self.units, "for": slicer}
        return format_options(options, "infill fill PART --config THIS_FILE -o OUT")


def resolve(
    typed: Mapping[str, Any], assigned: Sequence[str] = (), config: Path | None = None, *, trust: bool = False
) -> FillSettings:
    """Resolve the settings: the command line takes precedence over the file, and the file over the defaults.

    Parameters
    ----------
    typed : mapping
        Options by their names on the command line.
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
    from infill.lattices.choosing import add_seed, read_own_parameters
    from infill.lattices.request import check_request

    typed = read_options("fill", FillOptions, typed)
    read = read_toml(config, example='pattern = "gyroid"') if config else {}
    if config:
        check_trusted({name: value for name, value in read.items() if name not in typed}, config, trust=trust)
    table = dict(pop_table(read))
    if "densities" in read:
        read.setdefault("density", read.pop("densities"))  # as reports call two of them
    filed = _drop_dependent(typed, drop_replaced(FillOptions, typed, read_options("fill", FillOptions, read)))
    if typed.get("pattern", filed.get("pattern")) != filed.get("pattern"):
        table = {}  # the parameters of another pattern
    options = FillOptions(**by_field(FillOptions, {**filed, **typed}))
    form, slicers = _choose_form(options, typed)
    own_values = read_own_parameters(options.pattern, assigned, table)
    if options.seed is not None:
        own_values = add_seed(options.pattern, own_values, options.seed)
    apart = ("units", "slicer", "form", "seed")
    values = {field: getattr(options, field) for field in FillOptions.__dataclass_fields__ if field not in apart}
    values["regions"] = tuple(replace(region, units=options.units) for region in options.regions)
    request = check_request(own=own_values, form=form, **values)
    if typed.get("ties"):
        _check_ties(request)
    return FillSettings(request=request, units=options.units, slicers=slicers)


def _check_ties(request: FillSpec) -> None:
    """Raise UsageError for requested ties where there is nothing to tie."""
    from patterns.cellular import Cells
    from patterns.lightning import Lightning

    if isinstance(request.kind, (Cells, Lightning)):
        raise UsageError.about("ties", f"is for islands of upright walls, and {request.pattern} has none; leave it out")
    if not request.ties_islands:
        raise UsageError.about(
            "ties", "is given, and floor and roof of the shell hold all walls; give open both or a wall of 0 too"
        )


def _drop_dependent(typed: Mapping[str, Any], filed: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options of a file without those that depend on values that typed options change."""
    kept = dict(filed)
    for name in THIRDS:
        if all(third in typed or third in kept for third in THIRDS) and name not in typed:
            kept.pop(name, None)
    if "wall" in typed:
        kept.pop("overlap", None)
    if isinstance(typed.get("density"), float):
        kept.pop("by", None)
        kept.pop("grade", None)
    return kept


def _choose_form(options: FillOptions, typed: Mapping[str, Any]) -> tuple[str, tuple[Slicer, ...]]:
    """Return the form and the slicers: either implies the other, and a typed one wins over the file."""
    form, slicers = options.form or ("project" if options.slicer else "solid"), options.slicer
    if slicers and form != "project":
        if "as" not in typed:
            form = "project"
        elif "for" in typed:
            raise UsageError.about(
                "for", f"is {slicers[0]!r}, and projects for slicers are as project, not {form}; leave one out"
            )
        else:
            slicers = ()
    if form == "project" and not slicers:
        raise UsageError.about(
            "as", "is 'project', and for is missing; say which slicer it is for, such as --for prusaslicer"
        )
    return form, slicers
