"""A user's request for a refill, checked."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from infill.checks import check_range
from infill.errors import ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.options.declaration import Option
from infill.options.keyword_options import parse_share, read_number
from patterns.errors import PatternError

Progress = Callable[[str, float], None]
KEEP = "keep"
AUTO = "auto"
SAME = "same"
NO_LIMIT = "none"
ON, OFF = "on", "off"
FEWEST_SEGMENTS, MOST_SEGMENTS = 10.0, 100_000.0  # per second
LARGEST_RADIUS = 100.0  # mm
ENDLESS = 10**9  # layers
MOST_LISTED = 10  # objects in a message
LEEWAY, MOST_LEEWAY = 0.1, 0.5  # share of the infill of a layer
TIME, VOLUME = "time", "volume"
PATHS, WHERE = "Paths", "Where"


def parse_radius(name: str, value: object) -> str | float:
    """Parse "auto" or a number of mm, or raise ParameterError.

    >>> parse_radius("smooth_radius", "1.5")
    1.5
    """
    if value == AUTO:
        return AUTO
    try:
        return read_number(name, value, "mm")
    except ValueError:
        raise UsageError.about(name, f"is {quote_value(value)}; give auto, or a number in mm") from None


def parse_segments(name: str, value: object) -> str | float:
    """Parse "auto", "none" or a number of segments per second, or raise ParameterError.

    >>> parse_segments("max_segments", "150"), parse_segments("max_segments", "none")
    (150.0, 'none')
    """
    if value in (AUTO, NO_LIMIT):
        return str(value)
    try:
        return read_number(name, value)
    except ValueError:
        raise UsageError.about(
            name, f"is {quote_value(value)}; give auto, none, or a number of segments per second"
        ) from None


def parse_share_or_same(name: str, value: object) -> str | float:
    """Parse "same", or the share in ``20%`` or 0.2, or raise ParameterError.

    >>> parse_share_or_same("density", "20%"), parse_share_or_same("density", "same")
    (0.2, 'same')
    """
    return SAME if value == SAME else parse_share(name, value, "give same, or a share such as 20%")


def parse_densities(name: str, value: object) -> str | float | tuple[float, ...]:
    """Parse "same", a share, or two shares with a colon between, or raise ParameterError.

    >>> parse_densities("density", "40%:12%"), parse_densities("density", [0.4, 0.12]), parse_densities("density", 0.2)
    ((0.4, 0.12), (0.4, 0.12), 0.2)
    """
    parts = value.split(":") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
    if len(parts) == 1:
        return parse_share_or_same(name, parts[0])
    return tuple(parse_share(name, part, "give a share such as 20%, or two such as 40%:12%") for part in parts)


def parse_leeway(name: str, value: object) -> float:
    """Parse the share in ``10%`` or 0.1, or raise ParameterError.

    >>> parse_leeway("leeway", "10%")
    0.1
    """
    share = parse_share(name, value, "give a share such as 10%")
    if share > MOST_LEEWAY:
        raise ParameterError.about(name, f"is {quote_value(value)}; give a share such as 10%, up to {MOST_LEEWAY:.0%}")
    return share


def parse_range(name: str, value: object) -> tuple[int, int]:
    """Parse ``5-20``, ``5-``, ``5``, 5 or [5, 20] as the first and the last, or raise ParameterError.

    >>> parse_range("layers", "5-20")
    (5, 20)
    """
    parts = value if isinstance(value, (list, tuple)) and len(value) == 2 else [value]
    numbers = [part for part in parts if isinstance(part, int) and not isinstance(part, bool)]
    if len(numbers) == len(parts):
        return numbers[0], numbers[-1]
    match = re.fullmatch(r"\s*(\d{1,9})\s*(?:(-)\s*(\d{0,9})\s*)?", value) if isinstance(value, str) else None
    if not match:
        raise UsageError.about(name, f"is {quote_value(value)}; give a range such as 5-20, or 5-")
    lowest = int(match[1])
    return lowest, int(match[3]) if match[3] else ENDLESS if match[2] else lowest


def describe_objects(names: Iterable[str]) -> str:
    """List the objects of a print in words, the first ten of many.

    >>> describe_objects(["a", "b"]), describe_objects([])
    ("it has 'a', 'b'", 'nothing in its file names one')
    """
    listed = [quote_value(name) for name in dict.fromkeys(names) if name]
    more = f" and {len(listed) - MOST_LISTED:,} more" if len(listed) > MOST_LISTED else ""
    return f"it has {', '.join(listed[:MOST_LISTED])}{more}" if listed else "nothing in its file names one"


@dataclass(frozen=True, kw_only=True)
class Request:
    """Options of a refill.

    Parameters
    ----------
    pattern : str, Path, Pattern or Cells
        "keep" for the slicer's own paths, or a pattern as `resolve_paths` takes it. Once checked, its name.
    density : None, "same", float or tuple of float
        None: the slicer's filament per mm with its own paths, its filament with others. "same": its filament.
        A number above 0 and up to 1: the share of the volume. Two: where `by` is lowest, and where it is highest.
    by : object
        The field that a density with two numbers follows, as `resolve_field` takes it. Once checked, its name.
    smooth_radius : "auto" or float
        mm; 0 leaves corners as they are.
    max_deviation : float, optional
        Largest move of a path, mm.
    max_segments : "auto", "none" or float
        Segments per second that the controller takes. "auto": as the file's G-code flavour implies.
    arcs : str
        "on": write curves as arcs (G2, G3). "off": as straight segments. "auto": as arcs if the file has some.
    even : "time" or "volume", optional
        Even out the layers of a new pattern.
    leeway : float, optional
        Share by which the infill of a layer may change for that; by default `LEEWAY`.
    layers : tuple of int, optional
        First and last layer to refill, counted from 1.
    part : str, optional
        Refill only objects whose name contains this.
    parameters : mapping
        Of the pattern, by name; angles in degrees. Once checked, with those that the pattern was made with.
    lines : Pattern or class of patterns, optional
        Set once checked: the pattern, if paths are to follow its lines.
    gradient : Gradient, optional
        Set once checked: the density that changes.

    Raises
    ------
    ParameterError
        If one of them is out of range.
    """

    pattern: Annotated[
        str,
        Option(
            "keep: the slicer's own paths, with round corners. auto: honeycomb if it prints faster with the same "
            "filament, else keep. Or a drawing: tile.svg, .dxf, .png, .wkt. Or a"
            " built-in pattern: honeycomb, zigzag, concentric-heart, grid, triangles, tri-hexagon, cubic, adaptive-"
            "cubic, support-cubic, lightning, rectilinear, "
            "hilbert, gyroid, schwarz-p, schwarz-d, concentric, honeycomb-3d, octagons, voronoi, cross, cross-"
            "hatch, quarter-cubic, lateral-honeycomb, archimedean-chords, octagram-spiral. Or module.py:name.",
            PATHS,
            unit="keep|auto|NAME|FILE",
            default="keep",
        ),
    ] = KEEP
    density: Annotated[
        str | float | tuple[float, ...] | None,
        Option(
            "same: the filament that the infill took; with keep, by beads up to 8 % wider. 20%: of the volume, "
            "for a built-in pattern; 40%:12%: one that changes, see --by.",
            PATHS,
            unit="same|PERCENT|A:B",
            default="the slicer's filament per mm for keep, else same",
            read=parse_densities,
            typed=str,
        ),
    ] = None
    by: Annotated[
        str | None,
        Option(
            "What a density of two numbers follows, from its first to its second: x, y or z, along the infill; skin, "
            "from walls, roofs and floors inwards; roofs, from these downwards; or a field: a .csv of x, y, z, value, "
            "results of a simulation, .vtu or .frd, a .npy, a picture from above, or module.py:name.",
            PATHS,
            unit="FIELD",
        ),
    ] = None
    smooth_radius: Annotated[
        str | float,
        Option(
            "Largest radius of a corner; 0 leaves corners; auto: as large as support and contact allow.",
            PATHS,
            unit="auto|MM",
            default="auto",
            read=parse_radius,
            typed=str,
        ),
    ] = AUTO
    max_deviation: Annotated[
        float | None,
        Option(
            "How far a path may move.",
            PATHS,
            unit="MM",
            default="no limit",
        ),
    ] = None
    max_segments: Annotated[
        str | float,
        Option(
            "Segments per second that the controller can take at the speed of the infill; auto: 200 where the file is "
            "for Marlin (legacy), as on 8-bit boards, else none.",
            PATHS,
            unit="auto|none|N",
            default="auto",
            read=parse_segments,
            typed=str,
        ),
    ] = AUTO
    arcs: Annotated[
        str,
        Option(
            "Write curves as arcs, G2 and G3, in about a third of the lines, for a printer that takes them; auto: if "
            "the file has some.",
            PATHS,
            unit="auto|on|off",
            default="auto",
        ),
    ] = AUTO
    even: Annotated[
        str | None,
        Option(
            "An experiment: infill of single layers slower, or of wider or narrower beads, so that neighbouring layers "
            "take alike time or filament; for a new pattern.",
            PATHS,
            unit="time|volume",
            default="as drawn",
        ),
    ] = None
    leeway: Annotated[
        str | float | None,
        Option(
            "Share by which the infill of a layer may change for --even, 50% at most; beads change by 8 % at most.",
            PATHS,
            unit="PERCENT",
            default="10%",
            read=parse_leeway,
            typed=str,
        ),
    ] = None
    layers: Annotated[
        tuple[int, int] | None,
        Option(
            "Layers to refill, counted from 1: 5-20, or 5-.",
            WHERE,
            unit="FROM-TO",
            default="all",
            read=parse_range,
            typed=str,
        ),
    ] = None
    part: Annotated[
        str | None,
        Option("Refill only objects with this in their name.", WHERE, unit="NAME", name="object", default="all"),
    ] = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    lines: Any = field(default=None, init=False)
    gradient: Any = field(default=None, init=False)

    def __post_init__(self) -> None:
        if self.density is not None:
            object.__setattr__(self, "density", parse_densities("density", self.density))
        if isinstance(self.smooth_radius, str):
            if self.smooth_radius != AUTO:
                raise UsageError.about("smooth_radius", f"is {self.smooth_radius!r}; give 'auto', or a number in mm")
        else:
            check_range("smooth_radius", self.smooth_radius, 0, LARGEST_RADIUS, "mm")
        if self.max_deviation is not None:
            check_range("max_deviation", self.max_deviation, 0, LARGEST_RADIUS, "mm")
        if isinstance(self.max_segments, str):
            if self.max_segments not in (AUTO, NO_LIMIT):
                raise UsageError.about(
                    "max_segments", f"is {self.max_segments!r}; give 'auto', 'none', or a number of segments per second"
                )
        else:
            check_range("max_segments", self.max_segments, FEWEST_SEGMENTS, MOST_SEGMENTS, "segments per second")
        if self.arcs not in (AUTO, ON, OFF):
            raise UsageError.about("arcs", f"is {quote_value(self.arcs)}; give auto, on or off")
        self._check_even()
        if self.layers is not None and not 1 <= self.layers[0] <= self.layers[1]:
            raise ParameterError.about(
                "layers", f"is {self.layers[0]} to {self.layers[1]}; count from 1, the lower one first"
            )
        if self.pattern != KEEP:
            self._resolve_pattern()
        if self.pattern == KEEP and isinstance(self.density, int | float | tuple):
            raise UsageError.about(
                "density",
                "only works with --pattern NAME; to change the slicer's own infill, set the density in the slicer",
            )
        if self.even is not None:
            self._check_follows_print()
        if self.parameters:
            from infill.refilling.placement import check_pattern_parameters

            try:
                check_pattern_parameters(self.pattern, self.parameters, self.lines)
            except PatternError as error:
                raise ParameterError.like(error) from None
            if self.cell is not None and self.density is not None:
                raise UsageError.about(("density", "cell"), "are both given, and each decides the other; leave one out")

        if isinstance(self.density, tuple):
            self._check_gradient(self.density)
        elif self.by is not None:
            raise UsageError.about(
                "by", "is given without two densities; give these too, such as 40%:12%, or leave it out"
            )

    def _check_gradient(self, densities: tuple[float, ...]) -> None:
        """Check the density that changes, and that the pattern can follow it."""
        from infill.refilling.gradients import check_gradient, check_stretches
        from infill.refilling.placement import family_of

        if self.even is not None:
            raise UsageError.about(
                ("even", "by"), "are both given, and layers whose density changes are not even; leave one out"
            )
        gradient = check_gradient(densities, self.by)
        check_stretches(family_of(self.pattern, self.parameters, self.lines), self.pattern)
        changes = gradient.first != gradient.last
        for attribute, value in (
            ("density", densities if changes else gradient.first),
            ("by", gradient.name if changes else None),
            ("gradient", gradient if changes else None),
        ):
            object.__setattr__(self, attribute, value)

    def _check_even(self) -> None:
        """Raise UsageError or ParameterError if layers cannot be evened out as requested; read the leeway."""
        if self.even not in (None, TIME, VOLUME):
            raise UsageError.about("even", f"is {quote_value(self.even)}; give time or volume")
        if self.even is not None and self.pattern == KEEP:
            raise UsageError.about("even", "only works with --pattern NAME, such as gyroid; the slicer's paths stay")
        if self.leeway is None:
            return
        object.__setattr__(self, "leeway", parse_leeway("leeway", self.leeway))
        if self.even is None:
            raise UsageError.about("leeway", "only works with --even time or --even volume; give one of them")

    def _check_follows_print(self) -> None:
        """Raise UsageError for layers to be evened out that a pattern makes uneven on purpose."""
        from infill.paths.families.catalogue import FAMILIES
        from infill.paths.families.infill_space import follows_print

        if self.pattern in FAMILIES and self.lines is None and follows_print(FAMILIES[self.pattern]):
            raise UsageError.about(
                "even", f"does not work with {self.pattern}, whose layers take what each needs; take another pattern"
            )

    def _resolve_pattern(self) -> None:
        """Put the name of the pattern in its place, and find its parameters and lines."""
        from infill.refilling.placement import resolve_paths

        try:
            resolved = resolve_paths(self.pattern, self.parameters)
        except PatternError as error:
            raise ParameterError.like(error) from None
        for attribute, value in zip(("pattern", "parameters", "lines"), resolved, strict=True):
            object.__setattr__(self, attribute, value)

    @property
    def radius(self) -> float:
        """The largest radius, mm."""
        return math.inf if isinstance(self.smooth_radius, str) else float(self.smooth_radius)

    @property
    def cell(self) -> float | None:
        """The requested size of the pattern, mm."""
        cell = self.parameters.get("cell")
        return None if cell is None else float(cell)

    @property
    def allowed_leeway(self) -> float:
        """The share by which the infill of a layer may change to even out layers."""
        return LEEWAY if self.leeway is None else float(self.leeway)

    @property
    def deviation(self) -> float:
        """The largest deviation, mm."""
        return math.inf if self.max_deviation is None else float(self.max_deviation)
