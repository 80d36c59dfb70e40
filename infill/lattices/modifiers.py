"""The modifiers of a slicer's project as regions of a fill."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from infill.lattices.placed_regions import HIGHEST, LOWEST
from infill.lattices.region_nodes import PlacedRegion
from infill.lattices.request import FillSpec, place_regions
from infill.surface import Modifier, Surface


def add_modifiers(part: Surface, request: FillSpec) -> tuple[Surface, FillSpec]:
    """Add the modifiers of a part to a request, below its regions; return a note in the part for each left out.

    Parameters
    ----------
    part : Surface, mm
    request : FillSpec
    """
    used, notes = [], list(part.notes)
    for modifier in part.modifiers:
        problem = _find_problem(modifier, part) if request.can_have_regions else "the density is not one number"
        if problem is None:
            used.append(_place_modifier(modifier))
        else:
            notes.append(f"{modifier.name} is left out, as {problem}")
    part = replace(part, notes=tuple(notes), modifiers=())
    return part, place_regions(request, (*used, *request.regions)) if used else request


def _find_problem(modifier: Modifier, part: Surface) -> str | None:
    """Return why a modifier can be no region, or None."""
    if not LOWEST <= modifier.density <= HIGHEST:
        return f"regions have a density of {LOWEST:.0%} to {HIGHEST:.0%}"
    if not modifier.surface.closed:
        return "its mesh is not closed"
    low, high = part.bounds
    if not ((modifier.surface.bounds[0] < high) & (modifier.surface.bounds[1] > low)).all():
        return "it lies outside the part"
    return None


def _place_modifier(modifier: Modifier) -> PlacedRegion:
    """Return a modifier as a region."""
    low, high = np.asarray(modifier.surface.bounds, dtype=np.float64)
    return PlacedRegion(
        text=modifier.name,
        place=modifier.name,
        density=modifier.density,
        low=low,
        high=high,
        surface=modifier.surface,
        is_requested=False,
    )
