"""The modifiers of a slicer's project as regions of a fill."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from infill.lattices.placed_regions import HIGHEST, LOWEST
from infill.lattices.region_nodes import PlacedRegion
from infill.lattices.request import FillSpec, place_regions
from infill.options.resolve_pattern import resolve_pattern
from infill.surface import Modifier, Surface


def add_modifiers(part: Surface, request: FillSpec) -> tuple[Surface, FillSpec]:
    """Add the modifiers of a part to a request, below its regions; return a note in the part for each left out.

    Of a modifier with several settings, those that a fill can have are used.

    Parameters
    ----------
    part : Surface, mm
    request : FillSpec
    """
    used, notes = [], list(part.notes)
    for modifier in part.modifiers:
        region, problems = _place_modifier(modifier, part, request)
        if region is not None:
            used.append(region)
            notes.extend(f"{modifier.name}: {problem}, so that of the part is used" for problem in problems)
        else:
            notes.append(f"{modifier.name} is left out, as {'; '.join(problems)}")
    part = replace(part, notes=tuple(notes), modifiers=())
    return part, place_regions(request, (*used, *request.regions)) if used else request


def _place_modifier(modifier: Modifier, part: Surface, request: FillSpec) -> tuple[PlacedRegion | None, list[str]]:
    """Return a modifier as a region, if it can be one, and why settings of it are left out."""
    low, high = np.asarray(modifier.surface.bounds, dtype=np.float64)
    part_low, part_high = part.bounds
    if not modifier.surface.closed:
        return None, ["its mesh is not closed"]
    if not ((low < part_high) & (high > part_low)).all():
        return None, ["it lies outside the part"]
    settings, problems = _find_settings(modifier, request)
    if not settings:
        return None, problems
    flips = modifier.surface.volume < 0
    surface = replace(modifier.surface, faces=modifier.surface.faces[:, ::-1]) if flips else modifier.surface
    return PlacedRegion(
        text=modifier.name,
        place=modifier.name,
        low=low,
        high=high,
        surface=surface,
        is_requested=False,
        **settings,
    ), problems


def _find_settings(modifier: Modifier, request: FillSpec) -> tuple[dict[str, Any], list[str]]:
    """Return the settings of a modifier that a fill can have, and what is wrong with the others."""
    settings: dict[str, Any] = {}
    problems = []
    is_sparse = modifier.density is None or LOWEST <= modifier.density <= HIGHEST
    if not is_sparse:  # what a slicer makes solid or leaves empty has no pattern
        problems.append(f"regions have a density of {LOWEST:.0%} to {HIGHEST:.0%}")
    elif modifier.density is not None and not request.can_have_regions:
        problems.append("the density is not one number")
    elif modifier.density is not None:
        settings["density"] = modifier.density
    if is_sparse and modifier.pattern is not None:
        settings["kind"], settings["pattern"] = resolve_pattern(modifier.pattern, "fill")
    elif is_sparse and modifier.slicer_pattern is not None:
        problems.append(f"its infill pattern {modifier.slicer_pattern} has no equivalent")
    if modifier.wall is not None:
        if modifier.wall == 0:
            problems.append("it has no walls, and a region keeps its shell")
        elif request.reaches_skin:
            problems.append("walls are the slicer's in a project, and there are none with a wall of 0")
        else:
            settings["wall"] = modifier.wall
    return settings, problems
