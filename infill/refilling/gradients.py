"""A density that changes over a print: the field that it follows, its lines in an area, and cells that follow it."""

from __future__ import annotations

import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats
from infill.errors import GeometryError, ParameterError, UsageError
from infill.interior.conformal_map import spline_jacobians
from infill.interior.plane_map import fit_plane_map
from infill.options.density_fields import BoxedField, Field, ScatteredField, SimulatedField, describe_box, resolve_field
from infill.paths.families.family import STRETCHED_TOUCH, Bounds, Family, NominalStrand, PathSpec
from infill.paths.families.nested import ConcentricPaths, GradedRings, RatioMap
from infill.paths.plane_splines import PlaneMap, PlaneSpline, invert_map, pattern_bounds
from infill.paths.stretching import (
    equal_normals,
    line_angles,
    scaled_length,
    step_family,
    stretch_family,
)
from infill.plain_numbers import plain_argument
from infill.refilling.print_place import PrintPlace, mark_inside

if TYPE_CHECKING:
    from shapely import Polygon

LOWEST, HIGHEST = 0.01, 0.6  # densities; above, lines of some patterns come too near where cells change
LOCAL_STEP = 0.05  # of density, that it changes by within the heights of a step at most
MEAN_STEP = 1.14  # ratio of the highest and the lowest mean density of the layers of a step, which beads make up for
MOST_STEPS = 64
LEAST_LAYERS = 4  # of a step: in its first layer, lines cross those below
STEP_POINTS = 2000  # at which densities are compared, in each layer
RATIO_NODES = 128  # along the longer side of the print, between which densities are interpolated for rings
NODES = 64  # along the longer side of the print, where the field is evaluated
CELL_NODES = 16  # in a cell at most: those of a print that is smaller than a few cells need not lie closer
PADDING = 0.25  # of that side, and cells: around the print, as far as its lines may reach in the plane of the pattern
PADDED_CELLS = 3.0
TRIAL_CELLS = 24.0  # along a square of the pattern, in which its lines are measured
TRIAL_HEIGHTS = 8  # in a period of a pattern that changes with height
TABLE = 9  # scales for which lengths are measured
WIDER_SCALES = 1.3  # factor by which their range is wider than that of densities
DIRECTIONS = 8  # of lines
AREA_POINTS, AREA_STEP = 4000, 0.5  # points in an area at which a density is averaged, about, and mm between them
MOST_SHELL = (
    10.0  # mm by which a part is larger than its infill along an axis, for a simulation of it to be moved there
)
SLIGHT = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class Gradient:
    """A density that follows a field.

    Parameters
    ----------
    first, last : float
        Shares of the volume where the field is lowest, and where it is highest.
    by : Field
    name : str
        Of the field.
    """

    first: float
    last: float
    by: Field
    name: str

    @property
    def middle(self) -> float:
        """The density of the nominal cell."""
        return (self.first + self.last) / 2

    @property
    def checksum(self) -> int:
        """A checksum of the numbers of the field; 0 for one without numbers."""
        if isinstance(self.by, BoxedField):
            return zlib.crc32(np.ascontiguousarray(self.by.values).tobytes())
        if isinstance(self.by, ScatteredField):
            return zlib.crc32(self.by.points.tobytes() + self.by.values.tobytes())
        return 0


def check_gradient(densities: Sequence[float], by: object) -> Gradient:
    """Check two densities, where a field is lowest and where it is highest, and the field."""
    if len(densities) != 2:
        raise UsageError.about("density", f"has {len(densities)} numbers; give one, or two such as 40%:12%")
    for density in densities:
        if not LOWEST <= density <= HIGHEST:
            raise ParameterError.about(
                "density",
                f"is {_percent(density)} somewhere; where it changes, give {LOWEST:.0%} to {HIGHEST:.0%}",
            )
    if by is None:
        raise UsageError.about(
            "density",
            f"is {_percent(densities[0])}:{_percent(densities[1])}, and a density that changes follows a field: give "
            "it too, such as --by x, or one density",
        )
    field, name = resolve_field(by, roofs=True)
    return Gradient(first=densities[0], last=densities[1], by=field, name=name)


def _percent(density: float) -> str:
    """Format a density in per cent."""
    return f"{plain_argument(100 * density)}%"


def check_stretches(family: Family, name: str) -> None:
    """Raise UsageError if the cells of a pattern cannot change from place to place."""
    if not family.stretches:
        from infill.paths.families.catalogue import FAMILIES

        names = ", ".join(known for known, member in FAMILIES.items() if member.stretches)
        raise UsageError.about(
            "density", f"is to change from place to place, and cells of {name} cannot; choose from {names}"
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class GradedDensity:
    """A gradient over the infill of a print.

    Parameters
    ----------
    gradient : Gradient
    place : PrintPlace
    low, high : float
        The lowest and the highest value of the field there.
    averaged : sequence of (float, float), mm
        Heights from which and to which the density is the mean over the layers with infill, from place to place: where
        it would change faster with height than lines can that lie on lines.
    """

    gradient: Gradient
    place: PrintPlace
    low: float
    high: float
    averaged: Sequence[tuple[float, float]] = ()

    def shares(self, points: Floats) -> Floats:
        """Return the densities at points (N, 3), mm: (N,)."""
        densities = self._shares_of_field(points)
        for low, high in self.averaged:
            rows = np.flatnonzero((points[:, 2] > low) & (points[:, 2] <= high))
            if len(rows):
                densities[rows] = self._average_shares(points[rows, :2], low, high)
        return densities

    @cached_property
    def averaged_range(self) -> tuple[float, ...]:
        """The lowest and the highest density in the infill, if it is averaged over layers somewhere; else none."""
        if not self.averaged:
            return ()
        shares = self.shares(self.place.points)
        return float(shares.min()), float(shares.max())

    def _average_shares(self, places: Floats, low: float, high: float) -> Floats:
        """Return the means over the layers between two heights, mm, at places (N, 2), mm: of those that hold infill."""
        heights = [layer.z for layer in self.place.filled if low < layer.z <= high]
        points = [np.column_stack([places, np.full(len(places), height)]) for height in heights]
        holds = np.stack([self.place.holds_infill(layer) for layer in points])
        holds[:, ~holds.any(axis=0)] = True
        means: Floats = np.average(np.stack([self._shares_of_field(layer) for layer in points]), axis=0, weights=holds)
        return means

    def _shares_of_field(self, points: Floats) -> Floats:
        """Return the densities of the field itself at points (N, 3), mm: (N,)."""
        values = self.gradient.by.at(points, self.place)
        share = np.clip((np.nan_to_num(values, nan=self.low) - self.low) / (self.high - self.low), 0.0, 1.0)
        densities: Floats = self.gradient.first + (self.gradient.last - self.gradient.first) * share
        return densities

    def mean(self, area: Polygon, z: float) -> float:
        """Return the mean density in an area at a height, mm."""
        import shapely

        x0, y0, x1, y1 = area.bounds
        step = min(AREA_STEP, math.sqrt(area.area / 4)) if area.area < AREA_POINTS * AREA_STEP**2 else 0.0
        step = step or math.sqrt(area.area / AREA_POINTS)
        x, y = (np.arange(low + step / 2, high, step) for low, high in ((x0, x1), (y0, y1)))
        nodes = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
        shapely.prepare(area)
        nodes = nodes[shapely.contains_xy(area, nodes[:, 0], nodes[:, 1])]
        if not len(nodes):
            nodes = shapely.get_coordinates(shapely.point_on_surface(area))
        return float(self.shares(np.column_stack([nodes, np.full(len(nodes), z)])).mean())


def measure_gradient(gradient: Gradient, place: PrintPlace) -> GradedDensity:
    """Find the lowest and the highest value of a field in the infill of a print.

    Raises
    ------
    GeometryError
        If the field is not finite everywhere there, is the same everywhere, or does not cover the infill.
    """
    low, high = place.bounds
    if isinstance(gradient.by, SimulatedField) and not gradient.by.covers(low, high):
        gradient = replace(gradient, by=_move_to_infill(gradient.by, low, high))
    if isinstance(gradient.by, ScatteredField) and not gradient.by.covers(low, high):
        of_part = ", or, of one part alone, as large as it is" if isinstance(gradient.by, SimulatedField) else ""
        lie = describe_box(gradient.by.points.min(axis=0), gradient.by.points.max(axis=0))
        raise GeometryError.about(
            "by",
            f"is {gradient.name}, whose points lie at {lie}, and the infill at {describe_box(low, high)}; "
            f"give points all over it, x, y and z on the bed as the G-code has them{of_part}",
        )
    values = gradient.by.at(place.points, place)
    if not np.isfinite(values).all():
        raise GeometryError.about(
            "by",
            f"is {gradient.name}, which is not finite everywhere in the infill; it lies at {describe_box(low, high)}",
        )
    lowest, highest = float(values.min()), float(values.max())
    if highest - lowest <= SLIGHT * max(abs(lowest), abs(highest), SLIGHT):
        raise GeometryError.about(
            "by",
            f"is {gradient.name}, which is {plain_argument(lowest)} everywhere in the infill; give one density, or "
            "another field",
        )
    return average_thin_steps(GradedDensity(gradient=gradient, place=place, low=lowest, high=highest))


def _move_to_infill(field: SimulatedField, low: Floats, high: Floats) -> SimulatedField:
    """Move the points of a part onto the bed, about the middle of its infill; leave points of another size.

    Walls are as thick on one side as on the other, so the middle of the infill is that of the part.
    """
    first, last = field.points.min(axis=0), field.points.max(axis=0)
    shell = (last - first) - (high - low)
    if (shell < -SLIGHT).any() or (shell > MOST_SHELL).any():
        return field
    shift = (low + high - first - last) / 2
    shift[2] = -first[2]
    return replace(field, points=field.points + shift)


def average_thin_steps(graded: GradedDensity) -> GradedDensity:
    """Average a density over the heights of each step in which it changes by more than within a step."""
    densities = _LayerDensities.of(graded)
    ends, looser = densities.find_ends()
    bounds = _step_heights(densities.heights, ends)
    averaged = [
        heights
        for start, end, heights in zip([0, *ends[:-1]], ends, bounds, strict=True)
        if len(densities.ends_within(start, end, looser)) > 1
    ]
    return replace(graded, averaged=averaged)


def find_steps(graded: GradedDensity) -> list[tuple[float, float]]:
    """Divide the heights of the infill into steps in which its density hardly changes; return their ends, mm.

    Within a step, the mean of a layer changes by no more than beads can be wider or narrower, and a place by
    `LOCAL_STEP`; unless that takes more than `MOST_STEPS`, or steps of fewer than `LEAST_LAYERS`.
    """
    densities = _LayerDensities.of(graded)
    return _step_heights(densities.heights, densities.find_ends()[0])


def _step_heights(heights: Floats, ends: Sequence[int]) -> list[tuple[float, float]]:
    """Return the heights, mm, where steps begin and end."""
    middles = [float(heights[end - 1] + heights[end]) / 2 for end in ends[:-1]]
    return list(zip([-math.inf, *middles], [*middles, math.inf], strict=True))


@dataclass(frozen=True, kw_only=True, eq=False)
class _LayerDensities:
    """Densities of layers at points on a grid.

    Parameters
    ----------
    heights : (L,) float64, mm
    shares : (L, N) float64
        NaN outside the infill.
    means : (L,) float64
    fewest : int
        Layers of these that a step has at least.
    """

    heights: Floats
    shares: Floats
    means: Floats
    fewest: int

    @classmethod
    def of(cls, graded: GradedDensity) -> _LayerDensities:
        """Evaluate a density in the layers with infill."""
        layers = graded.place.filled
        low, high = graded.place.bounds[:, :2]
        count = math.ceil(math.sqrt(STEP_POINTS))
        axes = [np.linspace(start, end, count) for start, end in zip(low, high, strict=True)]
        nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
        heights = np.array([layer.z for layer in layers])
        shares = np.stack([graded.shares(np.column_stack([nodes, np.full(len(nodes), z)])) for z in heights])
        inside = np.stack([mark_inside(layer.areas, nodes) for layer in layers])
        means = [row[held].mean() if held.any() else row.mean() for row, held in zip(shares, inside, strict=True)]
        fewest = math.ceil(LEAST_LAYERS * len(layers) / max(len(graded.place.heights), len(layers)))
        return cls(heights=heights, shares=np.where(inside, shares, np.nan), means=np.array(means), fewest=fewest)

    def find_ends(self) -> tuple[list[int], float]:
        """Return where steps end, and by which factor they had to change more for there to be few enough."""
        looser = 1.0
        while True:
            ends = self.ends_within(0, len(self.means), looser, self.fewest)
            if len(ends) <= MOST_STEPS:
                return self._join_last(ends, looser), looser
            looser *= 1.25

    def _join_last(self, ends: list[int], looser: float) -> list[int]:
        """Join a last step of few layers to the one below, if the density changes too fast there as well."""
        begin, middle, end = [0, 0, *ends][-3:]
        few = len(ends) > 1 and end - middle < self.fewest
        return [*ends[:-2], end] if few and len(self.ends_within(begin, middle, looser)) > 1 else ends

    def ends_within(self, start: int, end: int, looser: float, fewest: int = 1) -> list[int]:
        """Return where steps between two layers end, each as late as its densities allow."""
        ends: list[int] = []
        local, ratio = LOCAL_STEP * looser, MEAN_STEP**looser
        begin = start
        low, high = self.shares[start].copy(), self.shares[start].copy()
        low_mean = high_mean = float(self.means[start])
        for number in range(start + 1, end):
            low, high = np.fmin(low, self.shares[number]), np.fmax(high, self.shares[number])
            low_mean, high_mean = min(low_mean, float(self.means[number])), max(high_mean, float(self.means[number]))
            changes = np.nanmax(high - low, initial=0.0) > local or high_mean > ratio * low_mean
            if changes and number - begin >= fewest:
                ends.append(number)
                begin = number
                low, high = self.shares[number].copy(), self.shares[number].copy()
                low_mean = high_mean = float(self.means[number])
        return [*ends, end]


def stretch_to_density(family: Family, graded: GradedDensity, line_width: float) -> Family:
    """Return a family whose cells follow a graded density; its nominal cell is that of the middle density."""
    steps = find_steps(graded)
    heights = np.array([layer.z for layer in graded.place.filled])
    of_steps = [heights[(heights > low) & (heights <= high)] for low, high in steps]
    middles = [float((within.min() + within.max()) / 2) for within in of_steps]
    if isinstance(family, ConcentricPaths):
        families: list[Family] = [GradedRings(ratios=ratios) for ratios in _ratios_at(graded, middles)]
    else:
        trial = _Trial.of(family, family.cell_for(graded.gradient.middle, line_width), line_width)
        made = _stretch_at(trial, graded, middles)
        rise = min(_rise(plane_map.slopes) for plane_map in made)
        families = [stretch_family(family, plane_map, rise) for plane_map in made]
    return families[0] if len(families) == 1 else step_family(family, families, [high for _, high in steps], middles)


def _ratios_at(graded: GradedDensity, heights: Sequence[float]) -> list[RatioMap]:
    """Return the ratios of the densities at some heights, mm, to the middle one."""
    low, high = graded.place.bounds[:, :2]
    step = float((high - low).max()) / RATIO_NODES
    axes = [np.arange(start, end + step, step) for start, end in zip(low, high, strict=True)]
    return [
        RatioMap(corner=low, step=step, values=shares / graded.gradient.middle)
        for shares in _shares_at(graded, axes, heights)
    ]


def _shares_at(graded: GradedDensity, axes: Sequence[Floats], heights: Sequence[float]) -> list[Floats]:
    """Return the densities at the nodes of a grid, (N, M) for each height, mm; beside the print, those at its side."""
    nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    inside = np.clip(nodes.reshape(-1, 2), *graded.place.bounds[:, :2])
    rows = [graded.shares(np.column_stack([inside, np.full(len(inside), height)])) for height in heights]
    return [row.reshape(nodes.shape[:2]) for row in rows]


def _stretch_at(trial: _Trial, graded: GradedDensity, heights: Sequence[float]) -> list[PlaneMap]:
    """Return the maps to the plane of the pattern at some heights, mm."""
    low, high = graded.place.bounds[:, :2]
    axes, step, padding = map_axes(low, high, trial.cell)
    corner = np.array([axis[0] for axis in axes])
    splines, slopes = [], []
    for shares in _shares_at(graded, axes, heights):
        coordinates, _ = fit_plane_map(trial.scales_of(shares, graded.gradient.middle), trial.normals)
        splines.append(PlaneSpline(corner=corner, step=step, coefficients=corner + step * coordinates))
        slopes.append(spline_jacobians(coordinates))
    bounds = float(low[0]), float(low[1]), float(high[0]), float(high[1])
    return [
        invert_map(spline, slope, pattern_bounds(spline, bounds), padding)
        for spline, slope in zip(splines, slopes, strict=True)
    ]


def map_axes(low: Floats, high: Floats, cell: float) -> tuple[list[Floats], float, float]:
    """Return the nodes of a map along x and y, their distance, and how far they reach beyond a print; all in mm.

    Parameters
    ----------
    low, high : (2,) float64, mm
        The box around the infill of a print.
    cell : float, mm

    >>> axes, step, padding = map_axes(np.zeros(2), np.array([64.0, 32.0]), 3.0)
    >>> [len(axis) for axis in axes], step, padding
    ([97, 65], 1.0, 16.0)
    """
    step = max(float((high - low).max()) / NODES, cell / CELL_NODES)
    padding = max(PADDING * NODES * step, PADDED_CELLS * cell)
    corner = low - padding
    counts = np.ceil((high + padding - corner) / step).astype(int) + 1
    axes = [start + step * np.arange(count) for start, count in zip(corner, counts.tolist(), strict=True)]
    return axes, step, padding


def _rise(slopes: Floats) -> float:
    """Return the least scale of a map, from its Jacobians (..., 2, 2): the root of the least determinant."""
    return float(np.sqrt(np.linalg.det(slopes).min()))


@dataclass(frozen=True, kw_only=True, eq=False)
class _Trial:
    """A family in a square of its own plane, at some heights if it changes with height.

    Parameters
    ----------
    cell : float, mm
    half_gap : float, mm
        Half the distance of beads that touch; 0 if none do.
    strands : sequence of NominalStrand
    normals : (N, 2) float64
        Directions across its lines, each for an equal share of their length.
    """

    cell: float
    half_gap: float
    strands: Sequence[NominalStrand]
    normals: Floats

    @classmethod
    def of(cls, family: Family, cell: float, line_width: float) -> _Trial:
        """Draw a family for a trial."""
        count, period = 1 if family.prismatic else TRIAL_HEIGHTS, 2 * cell
        spec = PathSpec(cell=cell, line_width=line_width, radius=math.inf)
        layers = [
            family.nominal_strands(_square(cell), replace(spec, z=period * (part + 0.5) / count, layer=part))
            for part in range(count)
        ]
        strands = [strand for layer in layers for strand in layer]
        normals = equal_normals(*line_angles(strands, _square(cell)), DIRECTIONS)
        half_gap = STRETCHED_TOUCH * line_width / 2 if family.touches else 0.0
        return cls(cell=cell, half_gap=half_gap, strands=strands, normals=normals)

    def scales_of(self, shares: Floats, middle: float) -> Floats:
        """Return the number of cells in a length, over that of the middle density, for densities."""
        ratios = shares / middle
        if not self.half_gap:  # as much line in an area as cells in a length
            return ratios
        scales = np.geomspace(float(ratios.min()) / WIDER_SCALES, float(ratios.max()) * WIDER_SCALES, TABLE)
        square = _square(self.cell)
        lengths = np.array([scaled_length(self.strands, square, scale, self.half_gap) for scale in scales])
        nominal = scaled_length(self.strands, square, 1.0, self.half_gap)
        return np.interp(ratios, lengths / nominal, scales)


def _square(cell: float) -> Bounds:
    """Return the box of a trial about (0, 0), mm."""
    half = TRIAL_CELLS * cell / 2
    return -half, -half, half, half
