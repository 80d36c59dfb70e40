"""Regions in their place in a part: the widths of walls that give each its density.

Regions are painted on the nodes of a grid, the later ones over the earlier ones. Where a region covers a part of the
box around a node, the width is a mean, so it changes within one step between nodes.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from infill.arrays import Floats
from infill.checks import LONGEST, SHORTEST, check_range
from infill.errors import GeometryError, ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.formats.mesh_files import read_mesh
from infill.imaging.units import STATED_UNITS, UNITS
from infill.interior.interior import Interior
from infill.lattices.grading import LocalWidths, Varies, cells_inside
from infill.lattices.region_nodes import PlacedRegion, RegionNodes
from infill.lattices.regions import SHARE, Region, parse_region, parse_wall
from infill.meshes.merging import surface_of
from infill.meshes.split_components import concatenate_surfaces
from infill.options.keyword_options import parse_share
from infill.options.resolve_pattern import resolve_pattern
from infill.plain_numbers import plain_argument
from infill.surface import Surface

LOG = logging.getLogger("infill")
FINEST_STEP, MOST_NODES = 1.0, 4e6  # cells between nodes, at least; and how many there may be
LOWEST, HIGHEST = 0.01, 0.9  # densities


def place_region(region: object) -> PlacedRegion:
    """Check a region and read its mesh.

    Raises
    ------
    UsageError
        If it is not a region, has several places, or its ends are in the wrong order.
    FormatError
        If its file cannot be read.
    GeometryError
        If its mesh is not closed.
    """
    if isinstance(region, str):
        region = parse_region("region", region)
    if not isinstance(region, Region):
        raise UsageError.about("region", f"is {quote_value(region)}; give infill.Region(density=0.4, z=(10, 20))")
    places = [place for place in (region.z, region.box, region.mesh) if place is not None]
    if len(places) != 1:
        raise UsageError.about("region", f"has {len(places)} places; give one of z, box and mesh")
    placed = PlacedRegion(
        text=region.text,
        place=region.place,
        low=np.full(3, -np.inf),
        high=np.full(3, np.inf),
        **_check_settings(region),
    )
    if region.mesh is not None:
        surface = _read_region_mesh(region)
        low, high = np.asarray(surface.bounds, dtype=np.float64)
        return replace(placed, low=low, high=high, surface=surface)
    ends = region.box if region.z is None else (-np.inf, -np.inf, region.z[0], np.inf, np.inf, region.z[1])
    if ends is not None and np.isnan(ends).any():
        raise ParameterError.about("region", f"is {region.place!r}; give numbers that are finite")
    if ends is None or len(ends) != 6:
        raise UsageError.about("region", f"is {region.place!r}; give six numbers, such as box=0,0,0,10,10,5")
    low, high = np.array(ends, dtype=np.float64).reshape(2, 3)
    if not (low < high).all():
        raise UsageError.about(
            "region", f"is {region.place!r}, whose ends are in the wrong order; give the lower ones first"
        )
    return replace(placed, low=low, high=high)


def check_density(name: str, share: float) -> float:
    """Return a density, or raise ParameterError if it is not a share that infill can have.

    >>> check_density("density", 0.2)
    0.2
    """
    if not LOWEST <= share <= HIGHEST:
        raise ParameterError.about(name, f"is {plain_argument(100 * share)}%; give {LOWEST:.0%} to {HIGHEST:.0%}")
    return share


def _check_settings(region: Region) -> dict[str, Any]:
    """Check density, pattern and wall of a region; return those that it has."""
    settings: dict[str, Any] = {}
    if region.density is not None:
        settings["density"] = check_density("region density", parse_share("region", region.density, SHARE))
    if region.pattern is not None:
        settings["kind"], settings["pattern"] = resolve_pattern(region.pattern, "fill")
    if region.wall is not None:
        wall = parse_wall("region", region.wall)
        if wall == 0:
            raise UsageError.about(
                "region", f"is {region.text}, and a region keeps its shell; give a wall above 0 mm, or leave wall out"
            )
        settings["wall"] = check_range("region wall", wall, SHORTEST, LONGEST, "mm")
    if not settings:
        raise UsageError.about("region", f"is {region.place!r} alone; give a density, pattern or wall there")
    return settings


def _read_region_mesh(region: Region) -> Surface:
    """Return the closed mesh of a region, mm."""
    assert region.mesh is not None
    if isinstance(region.mesh, (str, Path)):
        surface = read_mesh(region.mesh)
        stated = STATED_UNITS.get(Path(region.mesh).suffix.lower(), 1.0)
        if region.units is not None:
            surface = surface.scaled(UNITS[region.units] / stated)
        if modifiers := surface.modifiers:
            LOG.warning("%s: the region is %s, not the part", region.mesh, ", ".join(each.name for each in modifiers))
            surface = concatenate_surfaces([each.surface for each in modifiers])
    else:
        surface = surface_of(region.mesh)
    if not surface.closed:
        raise GeometryError.about(
            "region", f"is {region.place}, whose mesh is not closed; close it, or give a box or a range of heights"
        )
    return replace(surface, faces=surface.faces[:, ::-1]) if surface.volume < 0 else surface


@dataclass(frozen=True, kw_only=True, eq=False)
class RegionDensities:
    """A density with other ones in regions.

    Parameters
    ----------
    base : float
        The density outside all regions.
    regions : tuple of PlacedRegion
        Where they overlap, the last one counts. Those without a density have another pattern.
    is_rest : bool
        False if another pattern lies outside the regions.
    """

    base: float
    regions: tuple[PlacedRegion, ...]
    is_rest: bool = True
    name: str = "regions"
    varies: Varies = "width"

    @property
    def middle(self) -> float:
        """The density whose walls are as wide as the line width."""
        return self.base

    @property
    def densities(self) -> tuple[float, ...]:
        """The density outside the regions, and those of the regions."""
        return (self.base, *(self.base if region.density is None else region.density for region in self.regions))

    @property
    def lowest(self) -> float:
        """The lowest density."""
        return min(self.densities)

    @property
    def thinnest(self) -> float:
        """Rough width of the narrowest walls over the line width."""
        return self.lowest / self.base

    @property
    def smallest(self) -> float:
        """Size of the smallest cells over the nominal cell."""
        return 1.0

    def widths_in(self, space: Interior, widths: Callable[[float], float]) -> LocalWidths:
        """Return the widths of walls in a space; `widths` gives the width for a density, in cells of the pattern.

        Raises
        ------
        GeometryError
            If a region holds nothing of the space inside the walls.
        """
        shape = np.array(space.depth.shape)
        step = max(FINEST_STEP, float(np.cbrt(np.prod(shape - 1.0) / MOST_NODES)))
        counts = tuple((np.ceil((shape - 1) / step).astype(int) + 1).tolist())
        nodes = np.stack(np.meshgrid(*(step * np.arange(count) for count in counts), indexing="ij"), axis=-1)
        within = cells_inside(space, nodes.reshape(-1, 3)).reshape(counts)
        covers = []
        for region in self.regions:
            cover = region.cover(space, counts, step=step)
            if region.is_requested and not cover[within].any():
                raise _miss_error(region, "holds nothing of the space inside the walls", np.asarray(space.part.bounds))
            covers.append(cover)
        wide = np.array([widths(density) for density in self.densities]) / widths(self.base)
        regions = RegionNodes(
            regions=self.regions,
            densities=np.array(self.densities),
            covers=tuple(covers),
            ratios=wide,
            is_matched=np.array([self.is_rest, *(region.density is not None for region in self.regions)]),
        )
        shares = regions.paint(regions.densities)
        return LocalWidths(
            ratio=regions.paint(wide),
            step=step,
            mean=float(shares[within].mean(dtype=np.float64)),
            shares=shares,
            within=within,
            regions=regions,
        )


def check_places(regions: Sequence[PlacedRegion], bounds: Floats) -> None:
    """Raise GeometryError if a region lies outside the box around a part, (2, 3) mm."""
    for region in regions:
        if not ((region.low < bounds[1]) & (region.high > bounds[0])).all():
            raise _miss_error(region, "lies outside the part", bounds)


def _miss_error(region: PlacedRegion, problem: str, bounds: Floats) -> GeometryError:
    """Return the error that a region holds nothing of a part."""
    spans = ", ".join(
        f"{axis} {plain_argument(low, 4)} to {plain_argument(high, 4)}"
        for axis, low, high in zip("xyz", *bounds, strict=True)
    )
    return GeometryError.about("region", f"{region.place} {problem}; the part spans {spans} mm; give a place in it")
