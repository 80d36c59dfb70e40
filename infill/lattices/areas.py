"""Areas with a pattern of their own: what is requested in each, as if the whole part were filled so."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from infill.errors import UsageError
from infill.lattices.placed_regions import RegionDensities
from infill.lattices.region_nodes import PlacedRegion, boxes_overlap
from infill.lattices.request import FillSpec, check_request


@dataclass(frozen=True, kw_only=True, eq=False)
class PatternArea:
    """A region with a pattern of its own.

    Parameters
    ----------
    region : PlacedRegion
    request : FillSpec
        For the whole part, with the pattern and the densities that are in the region.
    """

    region: PlacedRegion
    request: FillSpec


def find_areas(request: FillSpec) -> tuple[PatternArea, ...]:
    """Find the areas of a request, the lowest first.

    Raises
    ------
    UsageError, ParameterError, patterns.PatternError
        If the pattern of a region cannot be had with the other options.
    """
    areas = []
    for number, region in enumerate(request.regions):
        if region.kind is not None:
            areas.append(PatternArea(region=region, request=_request_area(request, number)))
    return tuple(areas)


def _request_area(request: FillSpec, number: int) -> FillSpec:
    """Return the request for a whole part with the pattern of a region, and with the densities there."""
    region, given = request.regions[number], dict(request.given)
    if request.is_drawn_once:
        given["cell"] = None  # the width of the drawing
    if region.density is not None:
        if given.get("cell") is not None and given.get("line_width") is not None:
            raise UsageError.about(
                "region",
                f"is {region.text}, and cell and line_width decide the density; give density and one of them",
            )
        given.update(density=region.density, by=None, grade=None)
    spec = replace(check_request(pattern=region.kind, own={}, **given), pattern=region.pattern or "")
    walls = tuple(replace(other, kind=None, density=None) for other in request.regions)
    spec = replace(spec, phase=request.phase, regions=walls)
    if not spec.can_have_regions:
        return spec
    assert spec.density is not None
    over = tuple(_densities_over(request.regions, number))
    # In its own grid, the number of a region with several densities is that of none.
    is_mixed = any(other.number < region.number for other in over)
    own = replace(region, density=spec.density, number=0 if is_mixed else region.number)
    return replace(spec, grading=RegionDensities(base=spec.density, regions=(own, *over), is_rest=False))


def _densities_over(regions: tuple[PlacedRegion, ...], number: int) -> Iterator[PlacedRegion]:
    """Yield the regions whose densities hold in a part of a region with a pattern, the lowest first."""
    region = regions[number]
    for order, other in enumerate(regions):
        is_below = order < number and region.density is None
        is_above = order > number and other.kind is None
        if other.density is not None and (is_below or is_above) and boxes_overlap(region, other):
            yield other
