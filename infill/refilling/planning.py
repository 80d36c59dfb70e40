"""Plan a refill: the pattern for the regions of a print, and the size of its cells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats
from infill.paths.covering import check_cell, solve_cell, total_length
from infill.paths.families.family import TOUCH, CentredFamily, Family
from infill.paths.families.infill_space import fills_print, place_family
from infill.paths.neighbours import index_beads
from infill.paths.rounding import Rounding, round_paths
from infill.paths.stretching import SteppedFamily, StretchedFamily
from infill.refilling.even_layers import LayerShares
from infill.refilling.gradients import GradedDensity, stretch_to_density
from infill.refilling.layers import Layers
from infill.refilling.print_place import PrintPlace
from infill.refilling.regions import FreeAreas

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon


USUAL_SPEED = 80.0  # mm/s, for lengths: it only decides how finely arcs are cut
LARGEST_RADIUS = 1000.0  # mm, for an unlimited radius
STRETCHED_TURN = math.radians(12)  # corners of waves turn by more, however they are stretched; divided legs by less
LENGTH_TOLERANCE = 0.08  # relative error of the length in an area, about as much as beads can make up for
GRADED_TOLERANCE = 0.01  # the same for a density that changes, as beads make up for its change within a step
PLACED_LAYERS = 24  # in which the cell of a family is solved for that follows the print, at most
STEPPED_LAYERS = 8  # in which the cell of a family is solved for that changes in steps, at most
USUAL_HEIGHT = 0.2  # mm of a layer, where no tag gives it


@dataclass(frozen=True, kw_only=True)
class RefillPlan:
    """Pattern for the regions, with its cell and rounding.

    Parameters
    ----------
    family : Family
    cell : float, mm
    line_width : float, mm
    rounding : Rounding
    density : float, optional
        Requested mm of line per mm²; else every section keeps its filament.
    fixed : bool
        True for a requested cell: it is the same everywhere, and decides the filament.
    graded : GradedDensity, optional
        A share of the volume that changes from place to place; `density` is that of the middle then.
    height : float, mm, optional
        Of the middle of a step, if cells change in steps of height.
    even : LayerShares, optional
        More or less filament, or more time, for the infill of single layers.
    scale : float, optional
        Filament per mm, over the slicer's, for a pattern that follows the print: its layers differ on purpose.
    """

    family: Family
    cell: float
    line_width: float
    rounding: Rounding
    density: float | None
    fixed: bool = False
    graded: GradedDensity | None = None
    height: float | None = None
    even: LayerShares | None = None
    scale: float | None = None

    def with_cell(self, cell: float) -> RefillPlan:
        """Return the plan with another cell, mm, or the smallest that beads fit into."""
        return replace(self, cell=max(cell, TOUCH * self.line_width))

    @property
    def radius(self) -> float:
        """The largest radius requested, mm."""
        return min(self.rounding.radius, LARGEST_RADIUS)

    def rounding_of(self, cell: float) -> Rounding:
        """Return the rounding of corners for a cell, mm."""
        return replace(self.rounding, radius=min(self.radius, self.family.largest_radius(cell, self.line_width)))

    def radii_at(self, paths: Sequence[Floats], cell: float) -> Floats | None:
        """Return the largest radius of corners at all points of some paths, mm; None if it is the same everywhere."""
        if not paths:
            return None
        return self.family.radii_at(np.concatenate(paths), cell, self.line_width)

    @property
    def kept_turn(self) -> float:
        """The turn, in radians, below which no point is one of the pattern's corners; 0 for lines other than waves."""
        is_waves = isinstance(self.family, StretchedFamily) and self.family.family.touches
        return STRETCHED_TURN if is_waves or self.follows_print else 0.0

    @property
    def follows_print(self) -> bool:
        """True for a pattern that follows the print: its lines also end beside others, away from walls."""
        return self.scale is not None

    def at(self, z: float) -> RefillPlan:
        """Return the plan for a height, mm: of a family that changes in steps, the one there."""
        if not isinstance(self.family, SteppedFamily):
            return self
        return replace(self, family=self.family.at(z), height=self.family.middle_of(z))

    def length_in(self, areas: Sequence[Polygon], z: float) -> float:
        """Return the requested mm of line in areas at a height, if a density was requested."""
        if self.graded is None:
            return (self.density or 0.0) * float(sum(area.area for area in areas))
        return sum((self.density_in(area, z) or 0.0) * float(area.area) for area in areas)

    @property
    def tolerance(self) -> float:
        """The relative error of the length in an area before it gets a cell of its own."""
        return LENGTH_TOLERANCE if self.graded is None else GRADED_TOLERANCE

    @property
    def has_own_cells(self) -> bool:
        """True if areas may have cells of their own: in other patterns, layers would not fit one another."""
        return not self.fixed and self.family.prismatic

    def density_in(self, area: Polygon, z: float) -> float | None:
        """Return the requested mm of line per mm² in an area at a height; None if sections keep their filament."""
        if self.graded is None or self.density is None:
            return self.density
        return self.density * self.graded.mean(area, z) / self.graded.gradient.middle


def plan_refill(
    family: Family,
    samples: Sequence[Layers],
    rounding: Rounding,
    *,
    density: float | None,
    acceleration: float,
    cell: float | None = None,
    graded: GradedDensity | None = None,
    place: PrintPlace | None = None,
) -> RefillPlan | None:
    """Choose the cell so that the sampled layers take the requested filament; None if there is no room for infill.

    There is none where the filament of the slicer's own infill is more than beads that touch.

    Parameters
    ----------
    family : Family
    samples : sequence of Layers
    rounding : Rounding
    density : float, optional
        Share of the volume; without it, the filament of the slicer's own infill.
    acceleration : float, mm/s²
        Where the print commands none.
    cell : float, optional
        mm; overrides the filament.
    graded : GradedDensity, optional
        A density that changes from place to place; `density` is its middle.
    place : PrintPlace, optional
        The infill of the print, for a pattern that follows it: its cell is solved for in layers from all heights.
    """
    import shapely

    regions: list[tuple[MultiPolygon, float, int]] = []
    walls, lengths, width, spacing = [], list[float](), 0.0, 1.0
    region: FreeAreas | None = None
    visited: set[tuple[float, bytes]] = set()
    area = shapely.MultiPolygon()
    for layer in (layer for layers in samples for layer in layers.typical):
        width = layer.layers.line_width
        fingerprint = layer.z, layer.paths[0][0].tobytes()
        if fingerprint in visited:  # samples overlap in small prints
            continue
        visited.add(fingerprint)
        previous, region = region, layer.find_region(region)
        if not region.polygons:
            continue
        if region is not previous:
            walls.append(layer.beads.points)
            area = shapely.MultiPolygon(list(region.polygons))
        regions.append((area, layer.z, layer.number))
        spacing = _spacing(width, layer.height)
        if graded is not None:
            lengths.append(sum(graded.mean(part, layer.z) * part.area for part in region.polygons) / spacing)
        else:
            lengths.append(layer.length if density is None else density * area.area / spacing)
    if not regions:
        return None
    family = _centre_family(family, [area for area, _, _ in regions])
    if graded is not None:
        family = stretch_to_density(family, graded, width)
    if place is not None:
        family = place_family(family, place.space)
        regions, lengths = _regions_of_print(place, None if density is None else density / spacing)
    plan = RefillPlan(
        family=family,
        cell=1.0,
        line_width=width,
        rounding=rounding,
        density=None if density is None else density / spacing,
        graded=graded,
        scale=None if place is None else 1.0,
    )
    area_of_all = sum(region.area for region, _, _ in regions)
    if fills_print(family) and cell is None and density is None and sum(lengths) * TOUCH * width > area_of_all:
        return None
    if not fills_print(family) and cell is None:
        cell = max(family.cell_for(sum(lengths) / area_of_all * TOUCH * width, width), TOUCH * width)
    if cell is not None:
        check_cell(cell, width)
        return replace(plan, cell=cell, fixed=True)
    # Of all layers at once: where they differ, a few more corners stay sharp.
    everywhere = index_beads(np.concatenate(walls))

    def measure(paths: Sequence[Floats], cell: float) -> float:
        """Measure the length of the paths of a cell with round corners, mm."""
        strands = [path for path in paths if len(path) > 1]
        smooth_paths, _ = round_paths(
            strands,
            walls=everywhere,
            acceleration=acceleration,
            speed=USUAL_SPEED,
            rounding=plan.rounding_of(cell),
            line_width=width,
            wide=family.wide,
            radii=plan.radii_at(strands, cell),
            kept_turn=plan.kept_turn,
        )
        return total_length(smooth_paths)

    # Areas get cells of their own on every step, so that a few layers are enough there.
    few = slice(None, None, -(-len(regions) // STEPPED_LAYERS) if isinstance(family, SteppedFamily) else 1)
    length = sum(lengths[few])
    solved = solve_cell(regions[few], family, length, line_width=width, radius=plan.radius, measure=measure)
    return replace(plan, cell=solved.cell)


def _regions_of_print(
    place: PrintPlace, density: float | None
) -> tuple[list[tuple[MultiPolygon, float, int]], list[float]]:
    """Return regions of layers from all heights of a print, and the requested length in each, mm.

    Parameters
    ----------
    place : PrintPlace
    density : float, optional
        mm of line per mm²; without it, the slicer's own length.
    """
    import shapely

    layers = place.filled[:: -(-len(place.filled) // PLACED_LAYERS)]
    regions = [(shapely.MultiPolygon(list(layer.areas)), layer.z, layer.number) for layer in layers]
    if density is None:
        return regions, [layer.length for layer in layers]
    return regions, [density * region.area for region, _, _ in regions]


def _centre_family(family: Family, areas: Sequence[MultiPolygon]) -> Family:
    """Return the family about one middle for the entire print, unless it has one."""
    if not isinstance(family, CentredFamily) or family.middle is not None:
        return family
    boxes = np.array([area.bounds for area in areas])
    low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    return replace(family, middle=tuple(((low + high) / 2).tolist()))


def _spacing(width: float, height: float) -> float:
    """Return the spacing, mm, at which beads with rounded sides fill the plane."""
    return width - (USUAL_HEIGHT if np.isnan(height) else min(height, width)) * (1 - np.pi / 4)
