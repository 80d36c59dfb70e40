"""Requests for `fill`: numbers checked, and defaults chosen."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from infill.checks import LONGEST, check_length, check_positive, check_range, check_whole_number
from infill.drawings.tiled import Tiled
from infill.errors import GeometryError, UsageError
from infill.interior.opening import Open
from infill.lattices.grading import Grading, Varies
from infill.lattices.placed_regions import RegionDensities, check_density, place_region
from infill.lattices.region_nodes import PlacedRegion
from infill.options.density_fields import resolve_field
from infill.options.keyword_options import parse_share
from infill.options.resolve_pattern import Kind, resolve_pattern
from infill.plain_numbers import plain_argument
from patterns.cellular import Cells
from patterns.declared import given_parameters
from patterns.lightning import Lightning
from patterns.unit_cells import Bars, Network, Surfaces

if TYPE_CHECKING:
    from infill.reports.filling import FillRequest

Form = Literal["solid", "infill", "project"]
Align = Literal["part", "bed", "body"]
Size = Literal["cell", "width"]

DENSITY, LINE_WIDTH, WALL, TOLERANCE, RADIUS = 0.2, 0.45, 1.2, 0.03, 0.25  # a share; mm
SLICED_WIDTH, SLICED_WALL = 0.9, 0.9  # mm, in a project: two lines of a usual nozzle, as slicers fill bodies with
GAP = 1.0, 1.5  # mm: between these, slicers fill walls with two lines of 0.45 mm that are too far apart, 7 % short
SLICED_BAR = 2.7  # mm, in a project: slicers fill thinner ones less than to the full
MOST_TRIANGLES, LEAST_TRIANGLES = 1_000_000, 250_000  # of part and voids by default, and of voids at least
FURTHEST = 1e4  # mm
FEWEST_TRIANGLES = 1000  # of voids
LEAST_ROUND = 6.0  # radii of fillets in the thickness of a part, by default
OVERLAP = 0.15  # mm by which an infill body reaches into the wall
ROUNDED = 2.0  # radii from an edge: rounding has no visible effect further away


@dataclass(frozen=True, kw_only=True)
class FillSpec:
    """A request for `fill`, checked.

    Parameters
    ----------
    pattern : str
        Its name.
    kind : Cells, Pattern or class of patterns
        The pattern, or class of patterns, of that name.
    parameters : mapping
        The pattern's own, by name.
    density : float or None
        Solid share inside the walls; None if it follows from cell and line width, or from the roofs of a part. With a
        grading, its middle.
    grading : Grading, RegionDensities or None
        Variation of the density from place to place.
    cell, line_width : float or None
        mm; None if it follows from the density.
    wall, overlap, tolerance : float
        mm; without a shell, a wall of 0: the infill ends at the skin.
    drain : float or None
        Diameter of a hole for each void, mm.
    vent : bool
        True if every void also has a hole up from its highest place.
    drain_at : tuple of (x, y, z)
        Places of holes on the skin, mm.
    open_ : {"top", "bottom", "both"} or None
        Sides of the part without a wall.
    smooth_radius : float or None
        mm; None for the default, which is smaller in small parts.
    angle : float
        Degrees.
    phase : (x, y, z)
        mm
    align : {"part", "bed", "body"}
    form : {"solid", "infill"}
    resolution : int or None
        Cells of the grid along the longest side of the part.
    voxel : float or None
        mm
    max_triangles : int or None
    cell_alone : bool
        True if only the cell was given, so that the density follows from it and the default line width.
    ties : bool
        True if islands of upright walls that nothing holds may be tied to the rest.
    is_block : bool
        True for a block of infill, in which pieces may stand by themselves, such as the rings of concentric.
    regions : tuple of PlacedRegion
        Regions with settings of their own; later ones lie over earlier ones, key by key.
    given : mapping
        The keywords of `check_request`, from which requests for other patterns follow.
    """

    pattern: str
    kind: Kind
    parameters: Mapping[str, Any]
    density: float | None
    cell: float | None
    line_width: float | None
    wall: float
    overlap: float
    angle: float
    phase: tuple[float, float, float]
    align: Align
    form: Form
    drain: float | None
    smooth_radius: float | None
    tolerance: float
    resolution: int | None
    voxel: float | None
    max_triangles: int | None
    grading: Grading | RegionDensities | None = None
    open_: Open | None = None
    vent: bool = False
    drain_at: tuple[tuple[float, float, float], ...] = ()
    cell_alone: bool = False
    ties: bool = True
    is_block: bool = False
    regions: tuple[PlacedRegion, ...] = ()
    given: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)

    @property
    def beyond(self) -> float:
        """Distance by which an open side is moved out for the voids, besides some cells of the grid, mm."""
        return ROUNDED * (RADIUS if self.smooth_radius is None else self.smooth_radius)

    @property
    def reaches_skin(self) -> bool:
        """True if voids go through the skin: a slicer makes the shell, or there is none."""
        return self.form == "project" or self.wall == 0

    @property
    def ties_islands(self) -> bool:
        """True if upright walls that nothing holds are tied to the rest: no floor and no roof of a shell holds them."""
        return self.ties and not self.is_block and (self.wall == 0 or self.open_ == "both")

    @property
    def extra_bytes_per_cell(self) -> int:
        """Additional bytes for each cell of the grid: where bodies are, and how deep in them the cell lies."""
        return 5 if self.align == "body" else 0

    @property
    def has_slicer_lines(self) -> bool:
        """True if walls and bars are as wide as a slicer's lines, which no density may change."""
        return self.form == "project" and not isinstance(self.kind, Lightning)

    def gaps_in(self, width: float) -> bool:
        """Tell whether slicers leave gaps in walls of a width, mm, that is the same everywhere."""
        even = self.grading is None or self.grading.varies == "cell"
        return self.form == "project" and even and not has_bars(self.kind) and GAP[0] < width < GAP[1]

    @property
    def default_width(self) -> float:
        """Width of walls inside, mm: of the middle density, such that the thinnest walls have the usual width."""
        sliced = SLICED_BAR if has_bars(self.kind) else SLICED_WIDTH
        return (sliced if self.form == "project" else LINE_WIDTH) / self.thinnest

    @property
    def share(self) -> float:
        """Width of lines that do not cross, over the cell."""
        if self.cell is not None and self.line_width is not None:
            return min(1.0, self.line_width / self.cell)
        assert self.density is not None
        return self.density

    @property
    def thinnest(self) -> float:
        """Least width of walls, over the line width."""
        if self.grading is None:
            return 1.0
        # The density of walls grows as their width, that of bars as its square.
        return math.sqrt(self.grading.thinnest) if has_bars(self.kind) else self.grading.thinnest

    def radius(self, thickness: float) -> float:
        """Return the radius of fillets, mm, in a part whose inside has a thickness, mm."""
        return min(RADIUS, thickness / LEAST_ROUND) if self.smooth_radius is None else self.smooth_radius

    @property
    def smallest(self) -> float:
        """Least size of cells, over the nominal cell."""
        return 1.0 if self.grading is None else self.grading.smallest

    @property
    def lowest(self) -> float | None:
        """The lowest requested density."""
        return self.density if self.grading is None else self.grading.lowest

    @property
    def is_drawn_once(self) -> bool:
        """True if the pattern is a single drawing."""
        return _draws_once(self.kind, self.parameters)

    @property
    def can_have_regions(self) -> bool:
        """True if the density is one number, which regions may change."""
        return (
            self.density is not None and not isinstance(self.grading, Grading) and not isinstance(self.kind, Lightning)
        )

    @property
    def walls(self) -> tuple[float, ...]:
        """The thickness of the shell of the part, and in regions with another, mm."""
        return (self.wall, *(region.wall for region in self.regions if region.wall is not None))

    @property
    def has_areas(self) -> bool:
        """True if regions have patterns of their own."""
        return any(region.kind is not None for region in self.regions)

    @property
    def varied(self) -> tuple[Size, ...]:
        """Sizes that may be changed to reach the density, in this order."""
        if self.density is None:
            return ()
        if self.grading is not None:
            thick = self.cell is not None or (self.line_width is None and has_bars(self.kind))
            return ("width",) if thick else ("cell",)
        if self.cell is not None or self.line_width is not None:
            return ("cell",) if self.cell is None else ("width",)
        return (
            ("width",)
            if (has_bars(self.kind) or isinstance(self.kind, Lightning)) and not self.has_slicer_lines
            else ("cell", "width")
        )

    def triangles_left(self, taken: int) -> int:
        """Return the number of triangles that voids may have beside those of the part.

        Raises
        ------
        GeometryError
            If none are left.
        """
        if self.max_triangles is None:
            return max(MOST_TRIANGLES - taken, LEAST_TRIANGLES)
        if self.max_triangles < taken + FEWEST_TRIANGLES:
            raise GeometryError.about(
                "max_triangles",
                f"is {self.max_triangles:,}, and the skin of the part alone has {taken:,}; give at least "
                f"{taken + FEWEST_TRIANGLES:,}",
            )
        return self.max_triangles - taken

    def facts(self) -> FillRequest:
        """Return the request as the report has it."""
        graded = self.grading if isinstance(self.grading, Grading) else None
        return {
            "pattern": self.pattern,
            "parameters": dict(self.parameters),
            "density": None if graded is not None else self.density,
            "densities": None if graded is None else [graded.first, graded.last],
            "by": None if graded is None else graded.name,
            "grade": None if graded is None else graded.varies,
            "region": [region.text for region in self.regions if region.is_requested],
            "cell": self.cell,
            "line_width": self.line_width,
            "wall": self.wall,
            "angle": self.angle,
            "phase": list(self.phase),
            "align": self.align,
            "form": self.form,
            "overlap": self.overlap,
            "drain": self.drain,
            "vent": self.vent,
            "drain_at": [list(place) for place in self.drain_at],
            "open": self.open_,
            "ties": self.ties,
            "smooth_radius": self.smooth_radius,
            "tolerance": self.tolerance,
            "resolution": self.resolution,
            "voxel": self.voxel if self.resolution is None else None,
            "max_triangles": self.max_triangles,
        }


def has_bars(kind: Kind) -> bool:
    """Tell whether a pattern is made of bars; their thickness follows from the density."""
    return isinstance(kind, (Network, Bars))


def check_request(
    *,
    pattern: object,
    own: Mapping[str, Any],
    density: float | tuple[float, ...] | None = None,
    by: object = None,
    regions: Sequence[object] = (),
    cell: float | None = None,
    line_width: float | None = None,
    wall: float | None = None,
    overlap: float | None = None,
    angle: float = 0.0,
    phase: tuple[float, ...] = (0.0, 0.0, 0.0),
    align: str = "part",
    form: str = "solid",
    drain: float | None = None,
    smooth_radius: float | None = None,
    tolerance: float = TOLERANCE,
    resolution: int | None = None,
    voxel: float | None = None,
    max_triangles: int | None = None,
    open_: str | None = None,
    grade: str | None = None,
    vent: bool = False,
    drain_at: Sequence[Sequence[float]] = (),
    ties: bool = True,
) -> FillSpec:
    """Check that numbers are in range; return a request in which sizes that follow from others are open."""
    given = {key: value for key, value in locals().items() if key not in ("pattern", "own", "regions")}
    placed = tuple(map(place_region, regions))
    kind, name = resolve_pattern(pattern, "fill")
    kind, cell = _take_cell(kind, name, cell)
    once = _draws_once(kind, own)
    if once and cell is None:
        raise UsageError.about("cell", f"is missing, and {name} is drawn once; give the width of the drawing in mm")
    if once and density is not None:
        raise UsageError.about(
            "density", f"is given, and {name} is drawn once, whose lines decide the density; leave it out"
        )
    if density is not None and cell is not None and line_width is not None:
        raise UsageError.about(
            ("density", "cell", "line_width"), "are all given; give two of them, and the third follows"
        )
    if resolution is not None and voxel is not None:
        raise UsageError.about(("voxel", "resolution"), "are both given; give one of them")
    if align not in get_args(Align):
        raise UsageError.about("align", f"is {align!r}; choose from {', '.join(get_args(Align))}")
    if form not in get_args(Form):
        raise UsageError.about("as", f"is {form!r}; choose from {', '.join(get_args(Form))}")
    if drain is not None and form != "solid":
        raise UsageError.about(
            "drain", f"is for a shell with its infill as one, and as is {form!r}; leave one of them out"
        )
    places = tuple(_check_place(place) for place in drain_at)
    for option, value in (("vent", vent), ("drain_at", bool(places))):
        if value and drain is None:
            raise UsageError.about(
                option, "is given, and drain is missing; give drain too, the diameter of the holes in mm"
            )
    if open_ is not None and open_ not in get_args(Open):
        raise UsageError.about("open", f"is {open_!r}; choose from {', '.join(get_args(Open))}")
    if open_ is not None and form == "project":
        raise UsageError.about(
            "open",
            f"is {open_!r}, and as is 'project', whose shell is the slicer's; leave open out, and let the slicer "
            "make no top or bottom layers",
        )
    if len(phase) not in (2, 3):
        raise UsageError.about("phase", f"has {len(phase)} numbers; give two or three, mm")
    shift = [check_range("phase", step, -FURTHEST, FURTHEST, "mm") for step in phase]
    asked_width, has_densities = line_width, any(region.density is not None for region in placed)
    grading: Grading | RegionDensities | None = None
    if isinstance(density, (tuple, list)):
        if isinstance(kind, Lightning):
            raise UsageError.about(
                "density", f"is to change from place to place, and branches of {name} follow roofs; give one"
            )
        grading = check_grading(density, by, grade or "width")
        density = grading.middle
        if grading.varies == "cell":
            _check_cells_follow(kind, name, align)
    elif by is not None or grade is not None:
        option = "by" if by is not None else "grade"
        raise UsageError.about(option, "is given with one density; give two, such as 15%:40%, or leave it out")
    elif density is not None:
        density = check_density("density", parse_share("density", density))
    elif (cell is None or line_width is None) and not isinstance(kind, Lightning):
        density = DENSITY if cell is None or has_bars(kind) or (has_densities and not once) else None
        if density is None:
            line_width = SLICED_WIDTH if form == "project" else LINE_WIDTH
    cell_alone = density is None and cell is not None and asked_width is None
    cell_alone = cell_alone and not (once or isinstance(kind, Lightning))
    if density is not None and line_width is not None and isinstance(kind, Lightning):
        raise UsageError.about(
            ("density", "line_width"),
            f"are both given, and {name} has as many branches as the roofs need; leave one of "
            "them out, or give cell and line_width",
        )
    if wall is None:
        wall = SLICED_WALL if form == "project" else WALL
    elif check_range("wall", wall, 0.0, LONGEST, "mm"):
        wall = check_length("wall", wall)
    else:
        _check_without_shell(form=form, open_=open_, drain=drain)
    spec = FillSpec(
        pattern=name,
        kind=kind,
        parameters=own,
        density=density,
        cell=None if cell is None else check_length("cell", cell),
        line_width=None if line_width is None else check_length("line_width", line_width),
        wall=wall,
        overlap=min(OVERLAP, wall / 2) if overlap is None else check_range("overlap", overlap, 0.0, 0.9 * wall, "mm"),
        angle=check_range("angle", angle, -360.0, 360.0, "degrees"),
        phase=(shift[0], shift[1], shift[2] if len(shift) == 3 else 0.0),
        align=align,  # type: ignore[arg-type]
        form=form,  # type: ignore[arg-type]
        drain=None if drain is None else check_length("drain", drain),
        smooth_radius=None if smooth_radius is None else check_range("smooth_radius", smooth_radius, 0.0, 100.0, "mm"),
        tolerance=check_range("tolerance", tolerance, 0.0, 100.0, "mm"),
        resolution=None if resolution is None else check_whole_number("resolution", resolution, 1),
        voxel=None if voxel is None else check_positive("voxel", voxel, "mm"),
        max_triangles=None if max_triangles is None else check_whole_number("max_triangles", max_triangles, 4),
        grading=grading,
        open_=open_,  # type: ignore[arg-type]
        vent=vent,
        drain_at=places,
        cell_alone=cell_alone,
        ties=ties,
        given=given,
    )
    return place_regions(spec, placed) if placed else spec


def place_regions(spec: FillSpec, regions: tuple[PlacedRegion, ...]) -> FillSpec:
    """Return a request with regions in place of those that it has; raise UsageError if it cannot have one of them.

    The pattern of the whole part in a region counts as that of the part, unless it lies over another pattern.
    """
    placed = list[PlacedRegion]()
    for number, region in enumerate(regions, 1):
        is_same = region.pattern == spec.pattern and all(below.kind is None for below in placed)
        placed.append(replace(region, number=number, kind=None if is_same else region.kind))
        if region.wall is not None and spec.reaches_skin:
            reason = "wall is 0" if spec.wall == 0 else "as is 'project', whose shell the slicer makes"
            raise UsageError.about("region", f"is {region.place} with a wall, and {reason}; leave one of them out")
    if not spec.can_have_regions and any(region.density is not None and region.kind is None for region in placed):
        graded = isinstance(spec.grading, Grading)
        problem = _region_problem(spec.kind, spec.pattern, graded=graded, once=spec.is_drawn_once)
        raise UsageError.about("region", f"is given, and {problem}")
    if not spec.can_have_regions:
        return replace(spec, regions=tuple(placed))
    graded_regions = tuple(
        replace(region, density=None) if region.kind is not None else region
        for region in placed
        if region.kind is not None or region.density is not None
    )
    assert spec.density is not None
    grading = RegionDensities(base=spec.density, regions=graded_regions) if graded_regions else None
    return replace(spec, regions=tuple(placed), grading=grading)


def _check_without_shell(*, form: str, open_: str | None, drain: float | None) -> None:
    """Raise an error for what a part without a shell cannot have."""
    if form != "solid":
        raise UsageError.about("as", f"is {form!r}, and a wall of 0 already leaves the infill alone; leave as out")
    for option, value in (("open", open_), ("drain", drain)):
        if value is not None:
            raise UsageError.about(option, "is given, and with a wall of 0 there is no shell; leave it out")


def _draws_once(kind: Kind, own: Mapping[str, Any]) -> bool:
    """Tell whether a pattern with parameters of its own is a single drawing."""
    return isinstance(kind, Tiled) and not own.get("repeat", kind.repeat)


def _region_problem(kind: Kind, name: str, *, graded: bool, once: bool) -> str:
    """Return why a request cannot have regions, and a remedy."""
    if graded:
        return "the density changes everywhere; give one density"
    if isinstance(kind, Lightning):
        return f"branches of {name} follow roofs; choose another pattern"
    if once:
        return f"{name} is drawn once, whose lines decide the density; leave it out"
    return "cell and line_width decide the density; give density and one of them"


def _take_cell(kind: Kind, name: str, cell: float | None) -> tuple[Kind, float | None]:
    """Return a pattern without a cell of its own, and that cell, or the one that is given beside it."""
    if isinstance(kind, type) or (own := given_parameters(kind).get("cell")) is None:
        return kind, cell
    if cell is not None and cell != own:
        raise UsageError.about(
            "cell",
            f"is {plain_argument(cell)} mm, and {name} is made with {plain_argument(own)} mm; give one of them",
        )
    return replace(kind, cell=None) if isinstance(kind, Cells) else kind, own


def _check_place(place: Sequence[float]) -> tuple[float, float, float]:
    """Check a place of a drain."""
    if isinstance(place, (str, bytes)) or not isinstance(place, (Sequence, np.ndarray)) or len(place) != 3:
        raise UsageError.about("drain_at", f"has a place {place!r}; give three numbers x, y, z in mm for each")
    x, y, z = (check_range("drain_at", coordinate, -FURTHEST, FURTHEST, "mm") for coordinate in place)
    return x, y, z


def _check_cells_follow(kind: Kind, name: str, align: str) -> None:
    """Raise an error if the cells of a pattern cannot follow a field."""
    if not isinstance(kind, Surfaces):
        raise UsageError.about(
            "grade",
            f"is 'cell', and cells of {name} cannot follow a field; choose walls along a surface, such as "
            "gyroid, or grade 'width'",
        )
    if align == "body":
        raise UsageError.about(
            "grade", "is 'cell', and cells that follow a field cannot begin again in every body; align 'part'"
        )


def check_grading(densities: Sequence[float], by: object, grade: str = "width") -> Grading:
    """Check two densities, where a field is lowest and where it is highest, and the field."""
    if grade not in get_args(Varies):
        raise UsageError.about("grade", f"is {grade!r}; choose from {', '.join(get_args(Varies))}")
    if len(densities) != 2:
        raise UsageError.about("density", f"has {len(densities)} numbers; give one, or two such as 15%:40%")
    low, high = (check_density("density", parse_share("density", density)) for density in densities)
    field, name = resolve_field("z" if by is None else by)
    return Grading(first=low, last=high, by=field, name=name, varies=grade)  # type: ignore[arg-type]
