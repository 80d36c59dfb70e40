"""Replace the slicer's infill by new paths: in its regions, with its filament, section by section."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bodies import InfillSection, TravelSettings, find_sections
from infill.kernels.threads import in_order
from infill.paths.contact import sample_paths
from infill.paths.corners import UNIT
from infill.paths.covering import total_length
from infill.paths.layer_below import LayerBelow, index_layer_below
from infill.paths.neighbours import BeadIndex, LayerBeads
from infill.ragged import select_rows
from infill.refilling.batch import Batch
from infill.refilling.fitting import (
    LENGTH_TOLERANCE,
    REGION_TOLERANCE,
    AreaSetting,
    Column,
    FittedPaths,
    continue_column,
    fit_paths,
)
from infill.refilling.planning import RefillPlan
from infill.refilling.regions import INFILL_STEP, STEP, Region, find_region
from infill.refilling.sharing import SectionGroup, area_lengths, group_sections, refusal_reason

if TYPE_CHECKING:
    from shapely import Polygon

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Paths = list[Floats]

LEAST_WIDTH, MOST_WIDTH = 0.92, 1.08  # of the slicer's filament per mm, to meet the filament of a region
LEAST_TRAVEL = 1.0  # mm; shorter travel never retracts
DEBT = 0.1  # of the filament of a layer: the error at which columns choose new cells
AGAIN_AFTER = 8  # layers until columns may choose new cells again
NO_REGION = "no sure region"
ACROSS = 0.1  # mm that travel may leave its areas without a retraction


@dataclass(kw_only=True)
class LayerMemory:
    """State that one layer leaves for the next.

    Parameters
    ----------
    region : Region, optional
    ways : TravelSettings
    drawn : dict of (area, layer) to FittedPaths
        Of the areas of the region; for a pattern that repeats in every layer, the layer is 0.
    columns : list of Column
        One for each area.
    others : BeadIndex, optional
        Its other beads.
    ground : LayerBelow, optional
        The layer below the one in which the region began, for a pattern that repeats in every layer.
    owed : float
        mm of filament still missing after beads are widened as far as allowed.
    fitted : int
        The last layer in which columns chose new cells, to make up for `owed`.
    """

    region: Region | None = None
    ways: TravelSettings = field(default_factory=TravelSettings)
    drawn: dict[tuple[int, int], FittedPaths] = field(default_factory=dict)
    columns: list[Column] = field(default_factory=list)
    ground: LayerBelow | None = None
    others: BeadIndex | None = None
    owed: float = 0.0
    fitted: int = -AGAIN_AFTER


@dataclass(frozen=True, kw_only=True)
class NewSection:
    """New paths for a section.

    Parameters
    ----------
    body : InfillSection
    paths : list of (N, 2) float64, mm
    rate : float
        mm of filament per mm.
    areas : tuple of Polygon
    radii : (C,) float64, mm
        Of the arcs; 0 or infinite at corners without an arc.
    acceleration : float, mm/s²
    """

    body: InfillSection
    paths: Paths
    rate: float
    areas: tuple[Polygon, ...]
    radii: Floats
    acceleration: float


def draw_sections(
    batch: Batch, plan: RefillPlan, memory: LayerMemory, acceleration: float
) -> tuple[list[NewSection], dict[str, Places]]:
    """Draw new paths for the sections of a batch; return them, and the sections that keep theirs, by reason.

    Parameters
    ----------
    batch : Batch
    plan : RefillPlan
    memory : LayerMemory
        State after the previous layer; updated to the last layer.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    section_bodies, reasons = find_sections(batch.table, batch.marks, batch.infill)
    commanded = batch.acceleration(acceleration)
    fresh: list[NewSection] = []
    # Regions do not depend on the drawing: another thread searches the next one meanwhile.
    for number, (region, layer_beads) in in_order(
        _region_finder(batch, memory.region), np.unique(batch.layer).tolist(), threads=1
    ):
        strokes = np.flatnonzero(batch.layer == number)
        if region is not memory.region:
            below = [path for member in memory.drawn.values() for path in member.paths]
            memory.ground = None
            if memory.others is not None and plan.family.prismatic:
                memory.ground = index_layer_below(below, memory.others, plan.line_width)
            memory.drawn.clear()
        elif not plan.family.prismatic:
            memory.drawn.clear()
        memory.region, memory.others = region, layer_beads.all
        groups = group_sections(region, batch.infill, strokes, batch.section)
        layer_bodies = {body.section: body for body in section_bodies if body.layer == number}
        area_lengths_mm = area_lengths(groups)
        memory.columns = [
            continue_column(polygon, area_lengths_mm.get(area, 0.0), plan, memory.columns)
            for area, polygon in enumerate(region.polygons)
        ]
        _settle_debt(memory, number, sum(body.filament for body in layer_bodies.values()))
        for group in groups:
            members = [layer_bodies[member] for member in group.areas if member in layer_bodies]
            reason = refusal_reason(group, members)
            if not reason:
                filled = _fill_group(group, members, region, layer_beads.all, plan, memory, commanded)
                fresh += filled
                reason = "" if filled else "no path fits"
            if reason:
                reasons.setdefault(reason, []).extend(body.section for body in members)
    kept_sections = {reason: np.array(sections, dtype=np.intp) for reason, sections in reasons.items()}
    return sorted(fresh, key=lambda member: member.body.first), {**kept_sections, NO_REGION: batch.section}


def _settle_debt(memory: LayerMemory, layer: int, filament: float) -> None:
    """Let the columns that are far off choose new cells, if much filament of a layer is owed, mm."""
    if abs(memory.owed) <= DEBT * filament or layer < memory.fitted + AGAIN_AFTER:
        return
    memory.fitted = layer
    memory.columns = [replace(stack, fresh=True) for stack in memory.columns]
    for key, fitted_paths in list(memory.drawn.items()):
        target = memory.columns[key[0]].length
        if abs(fitted_paths.length - target) > LENGTH_TOLERANCE * target:
            del memory.drawn[key]


def _region_finder(batch: Batch, initial: Region | None) -> Callable[[int], tuple[Region, LayerBeads]]:
    """Return a function that finds the region of a layer and its other beads, one layer after another."""
    region = initial

    def find_next(number: int) -> tuple[Region, LayerBeads]:
        nonlocal region
        layer_beads = batch.others.around(number, STEP)
        places, offsets = select_rows(batch.infill.first, np.flatnonzero(batch.layer == number))
        region = find_region(
            layer_beads, sample_paths(batch.infill.points[places], offsets, INFILL_STEP).points, region
        )
        return region, layer_beads

    return find_next


def _fill_group(
    group: SectionGroup,
    members: Sequence[InfillSection],
    region: Region,
    walls: BeadIndex,
    plan: RefillPlan,
    memory: LayerMemory,
    acceleration: Floats,
) -> list[NewSection]:
    """Draw new paths for sections that share areas, with their filament; return none if no path fits."""
    areas = tuple(region.polygons[area] for item in group.areas.values() for area in item)
    sections = []
    for body in members:
        place = AreaSetting(
            plan=plan,
            walls=walls,
            z=body.z,
            layer=body.layer,
            speed=body.feed / 60,
            acceleration=float(acceleration[body.strokes[0]]),
            ground=memory.ground,
        )
        fitted_areas = [_paths_in_area(area, place, memory) for area in group.areas[body.section]]
        sections.append(
            NewSection(
                body=body,
                paths=_shorter_direction([path for item in fitted_areas for path in item.paths], body),
                rate=body.rate,
                areas=areas,
                radii=np.concatenate([np.empty(0), *(item.radii for item in fitted_areas)]),
                acceleration=place.acceleration,
            )
        )
    filament = sum(item.rate * total_length(item.paths) for item in sections)
    if not filament:
        return []
    if plan.fixed:
        target = filament
    elif plan.density is None:
        target = sum(body.filament for body in members)
    else:
        target = members[0].rate * plan.density * sum(area.area for area in areas)
    target += memory.owed
    factor = float(np.clip(target / filament, LEAST_WIDTH, MOST_WIDTH))
    memory.owed = target - factor * filament
    return [replace(item, rate=item.rate * factor) for item in sections]


def _paths_in_area(area: int, place: AreaSetting, memory: LayerMemory) -> FittedPaths:
    """Return the paths of an area, drawn once for all layers that have them in common."""
    key = (area, 0 if place.plan.family.prismatic else place.layer)
    if key not in memory.drawn:
        memory.drawn[key] = result = fit_paths(memory.columns[area], place)
        memory.columns[area] = replace(memory.columns[area], cell=result.cell)
    return memory.drawn[key]


def _shorter_direction(paths: Paths, body: InfillSection) -> Paths:
    """Order paths forwards or backwards, whichever begins and ends nearer to the section's ends."""
    if not paths:
        return paths

    def travel_of(ordered: Paths) -> float:
        return float(np.hypot(*(ordered[0][0] - body.start)) + np.hypot(*(ordered[-1][-1] - body.end)))

    return min(paths, [path[::-1] for path in paths[::-1]], key=travel_of)


def choose_retractions(fresh: NewSection) -> list[bool]:
    """Tell for each travel, to each path and to the end, whether to retract: where it leaves the region."""
    import shapely

    begins = [fresh.body.start, *(path[-1] for path in fresh.paths)]
    ends = [*(path[0] for path in fresh.paths), fresh.body.end]
    travels = shapely.linestrings(np.stack([np.array(begins), np.array(ends)], axis=1))
    allowed = shapely.buffer(shapely.union_all(list(fresh.areas)), ACROSS)
    shapely.prepare(allowed)
    is_long = shapely.length(travels) > LEAST_TRAVEL
    return [bool(leaves) for leaves in is_long & ~shapely.covers(allowed, travels)]


def leaves_region(fresh: NewSection) -> bool:
    """Tell whether a path leaves its region."""
    import shapely

    if not fresh.paths:
        return False
    allowed = shapely.buffer(shapely.union_all(list(fresh.areas)), REGION_TOLERANCE + UNIT)
    shapely.prepare(allowed)
    return not bool(shapely.covers(allowed, [shapely.linestrings(path) for path in fresh.paths]).all())
