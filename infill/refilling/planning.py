"""Plan a refill: the pattern for the regions of a print, and the size of its cells."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats
from infill.paths.covering import check_cell, solve_cell, total_length
from infill.paths.families.family import TOUCH, CentredFamily, Family
from infill.paths.neighbours import index_beads
from infill.paths.rounding import Rounding, round_paths
from infill.refilling.even_layers import LayerShares
from infill.refilling.layers import Layers
from infill.refilling.regions import FreeAreas

if TYPE_CHECKING:
    from shapely import MultiPolygon


USUAL_SPEED = 80.0  # mm/s, for lengths: it only decides how finely arcs are cut
LARGEST_RADIUS = 1000.0  # mm, for an unlimited radius
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
    even : LayerShares, optional
        More or less filament, or more time, for the infill of single layers.
    """

    family: Family
    cell: float
    line_width: float
    rounding: Rounding
    density: float | None
    fixed: bool = False
    even: LayerShares | None = None

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


def plan_refill(
    family: Family,
    samples: Sequence[Layers],
    rounding: Rounding,
    *,
    density: float | None,
    acceleration: float,
    cell: float | None = None,
) -> RefillPlan | None:
    """Choose the cell so that the sampled layers take the requested filament; None without infill.

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
    """
    import shapely

    regions: list[tuple[MultiPolygon, float, int]] = []
    walls, length, width, spacing = [], 0.0, 0.0, 1.0
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
        length += layer.length if density is None else density * area.area / spacing
    if not regions:
        return None
    if isinstance(family, CentredFamily) and family.middle is None:  # one centre for the whole print
        boxes = np.array([area.bounds for area, _, _ in regions])
        low, high = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
        family = replace(family, middle=tuple(((low + high) / 2).tolist()))
    plan = RefillPlan(
        family=family,
        cell=1.0,
        line_width=width,
        rounding=rounding,
        density=None if density is None else density / spacing,
    )
    if cell is not None:
        check_cell(cell, width)
        return replace(plan, cell=cell, fixed=True)
    # Of all layers at once: where they differ, a few more corners stay sharp.
    everywhere = index_beads(np.concatenate(walls))

    def measure(paths: Sequence[Floats], cell: float) -> float:
        smooth_paths, _ = round_paths(
            [path for path in paths if len(path) > 1],
            walls=everywhere,
            acceleration=acceleration,
            speed=USUAL_SPEED,
            rounding=plan.rounding_of(cell),
            line_width=width,
            wide=family.wide,
        )
        return total_length(smooth_paths)

    solved = solve_cell(regions, family, length, line_width=width, radius=plan.radius, measure=measure)
    return replace(plan, cell=solved.cell)


def _spacing(width: float, height: float) -> float:
    """Return the spacing, mm, at which beads with rounded sides fill the plane."""
    return width - (USUAL_HEIGHT if np.isnan(height) else min(height, width)) * (1 - np.pi / 4)
