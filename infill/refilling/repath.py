"""Paths of our own in the place of the slicer's infill: in its regions, with its filament, section by section."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bodies import Body, Ways, bodies
from infill.kernels.threads import in_order
from infill.paths.contact import sampled
from infill.paths.corners import UNIT
from infill.paths.covering import total_length
from infill.paths.layer_below import Ground, ground_of
from infill.paths.neighbours import Around, Walls
from infill.ragged import picked
from infill.refilling.batch import Batch
from infill.refilling.fitting import INSIDE, OFF, Column, Fitted, Place, column, fitted
from infill.refilling.planning import Plan
from infill.refilling.regions import INFILL_STEP, STEP, Region, region_of
from infill.refilling.sharing import Group, grouped, lengths_of, unsure

if TYPE_CHECKING:
    from shapely import Polygon

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Paths = list[Floats]

LEAST_WIDTH, MOST_WIDTH = 0.92, 1.08  # of the slicer's filament per mm, to meet the filament of a region
LEAST_TRAVEL = 1.0  # mm; shorter ways are never retracted
DEBT = 0.1  # of the filament of a layer that may be owed before columns choose their cells anew
AGAIN_AFTER = 8  # layers, before they do so again
NO_REGION = "no sure region"
ACROSS = 0.1  # mm that a way may leave its areas without a retraction


@dataclass(kw_only=True)
class Memory:
    """What one layer leaves for the next.

    Parameters
    ----------
    region : Region, optional
    ways : Ways
    drawn : dict of (area, layer) to Fitted
        Of the areas of the region; for a pattern that repeats in every layer, the layer is 0.
    columns : list of Column
        One for each area.
    others : Walls, optional
        Its other beads.
    ground : Ground, optional
        The layer below the one in which the region began, for a pattern that repeats in every layer.
    owed : float
        mm of filament that beads could not be widened enough to take.
    fitted : int
        The last layer in which columns chose their cells anew, to pay what is owed.
    """

    region: Region | None = None
    ways: Ways = field(default_factory=Ways)
    drawn: dict[tuple[int, int], Fitted] = field(default_factory=dict)
    columns: list[Column] = field(default_factory=list)
    ground: Ground | None = None
    others: Walls | None = None
    owed: float = 0.0
    fitted: int = -AGAIN_AFTER


@dataclass(frozen=True, kw_only=True)
class Fresh:
    """New paths for a section.

    Parameters
    ----------
    body : Body
    paths : list of (N, 2) float64, mm
    rate : float
        mm of filament per mm.
    areas : tuple of Polygon
    radii : (C,) float64, mm
        Of the arcs; 0 or infinite where there is none.
    acceleration : float, mm/s²
    """

    body: Body
    paths: Paths
    rate: float
    areas: tuple[Polygon, ...]
    radii: Floats
    acceleration: float


def fresh_sections(
    batch: Batch, plan: Plan, memory: Memory, acceleration: float
) -> tuple[list[Fresh], dict[str, Places]]:
    """Return new paths for the sections of a batch, and which sections keep theirs, by reason.

    Parameters
    ----------
    batch : Batch
    plan : Plan
    memory : Memory
        Of the layer before; of the last layer afterwards.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    found, reasons = bodies(batch.table, batch.marks, batch.infill)
    commanded = batch.acceleration(acceleration)
    fresh: list[Fresh] = []
    # Regions need nothing of what is drawn: the next one is looked for meanwhile.
    for number, (region, around) in in_order(_looker(batch, memory.region), np.unique(batch.layer).tolist(), threads=1):
        some = np.flatnonzero(batch.layer == number)
        if region is not memory.region:
            below = [path for each in memory.drawn.values() for path in each.paths]
            memory.ground = None
            if memory.others is not None and plan.family.prismatic:
                memory.ground = ground_of(below, memory.others, plan.line_width)
            memory.drawn.clear()
        elif not plan.family.prismatic:
            memory.drawn.clear()
        memory.region, memory.others = region, around.all
        groups = grouped(region, batch.infill, some, batch.section)
        here = {body.section: body for body in found if body.layer == number}
        held = lengths_of(groups)
        memory.columns = [
            column(polygon, held.get(area, 0.0), plan, memory.columns) for area, polygon in enumerate(region.polygons)
        ]
        _pay(memory, number, sum(body.filament for body in here.values()))
        for group in groups:
            members = [here[each] for each in group.areas if each in here]
            reason = unsure(group, members)
            if not reason:
                done = _filled(group, members, region, around.all, plan, memory, commanded)
                fresh += done
                reason = "" if done else "no path fits"
            if reason:
                reasons.setdefault(reason, []).extend(body.section for body in members)
    kept = {reason: np.array(sections, dtype=np.intp) for reason, sections in reasons.items()}
    return sorted(fresh, key=lambda each: each.body.first), {**kept, NO_REGION: batch.section}


def _pay(memory: Memory, layer: int, filament: float) -> None:
    """Let columns choose their cells anew if much is owed, mm, of the filament of a layer: those that are far off."""
    if abs(memory.owed) <= DEBT * filament or layer < memory.fitted + AGAIN_AFTER:
        return
    memory.fitted = layer
    memory.columns = [replace(each, fresh=True) for each in memory.columns]
    for key, drawn in list(memory.drawn.items()):
        wanted = memory.columns[key[0]].length
        if abs(drawn.length - wanted) > OFF * wanted:
            del memory.drawn[key]


def _looker(batch: Batch, before: Region | None) -> Callable[[int], tuple[Region, Around]]:
    """Return what tells the region of a layer and its other beads, of one layer after another."""
    last = before

    def looked(number: int) -> tuple[Region, Around]:
        nonlocal last
        around = batch.others.around(number, STEP)
        places, first = picked(batch.infill.first, np.flatnonzero(batch.layer == number))
        last = region_of(around, sampled(batch.infill.points[places], first, INFILL_STEP).points, last)
        return last, around

    return looked


def _filled(
    group: Group,
    members: Sequence[Body],
    region: Region,
    walls: Walls,
    plan: Plan,
    memory: Memory,
    acceleration: Floats,
) -> list[Fresh]:
    """Return new paths for sections that share areas, with the filament that they should take; none if none fits."""
    areas = tuple(region.polygons[area] for each in group.areas.values() for area in each)
    fresh = []
    for body in members:
        place = Place(
            plan=plan,
            walls=walls,
            z=body.z,
            layer=body.layer,
            speed=body.feed / 60,
            acceleration=float(acceleration[body.strokes[0]]),
            ground=memory.ground,
        )
        drawn = [_drawn(area, place, memory) for area in group.areas[body.section]]
        fresh.append(
            Fresh(
                body=body,
                paths=_nearest([path for each in drawn for path in each.paths], body),
                rate=body.rate,
                areas=areas,
                radii=np.concatenate([np.empty(0), *(each.radii for each in drawn)]),
                acceleration=place.acceleration,
            )
        )
    pushed = sum(each.rate * total_length(each.paths) for each in fresh)
    if not pushed:
        return []
    if plan.fixed:
        wanted = pushed
    elif plan.density is None:
        wanted = sum(body.filament for body in members)
    else:
        wanted = members[0].rate * plan.density * sum(area.area for area in areas)
    wanted += memory.owed
    factor = float(np.clip(wanted / pushed, LEAST_WIDTH, MOST_WIDTH))
    memory.owed = wanted - factor * pushed
    return [replace(each, rate=each.rate * factor) for each in fresh]


def _drawn(area: int, place: Place, memory: Memory) -> Fitted:
    """Return the paths of an area, drawn once for all layers that have them in common."""
    key = (area, 0 if place.plan.family.prismatic else place.layer)
    if key not in memory.drawn:
        memory.drawn[key] = done = fitted(memory.columns[area], place)
        memory.columns[area] = replace(memory.columns[area], cell=done.cell)
    return memory.drawn[key]


def _nearest(paths: Paths, body: Body) -> Paths:
    """Return paths in the order of printing: the same either way round, whichever begins and ends nearer."""
    if not paths:
        return paths

    def way(there: Paths) -> float:
        return float(np.hypot(*(there[0][0] - body.start)) + np.hypot(*(there[-1][-1] - body.end)))

    return min(paths, [path[::-1] for path in paths[::-1]], key=way)


def retractions(fresh: Fresh) -> list[bool]:
    """Return whether to retract on the way to each path and to the end: where the way leaves the region."""
    import shapely

    begins = [fresh.body.start, *(path[-1] for path in fresh.paths)]
    ends = [*(path[0] for path in fresh.paths), fresh.body.end]
    ways = shapely.linestrings(np.stack([np.array(begins), np.array(ends)], axis=1))
    whole = shapely.buffer(shapely.union_all(list(fresh.areas)), ACROSS)
    shapely.prepare(whole)
    long = shapely.length(ways) > LEAST_TRAVEL
    return [bool(each) for each in long & ~shapely.covers(whole, ways)]


def outside(fresh: Fresh) -> bool:
    """Return whether a path leaves its region."""
    import shapely

    if not fresh.paths:
        return False
    near = shapely.buffer(shapely.union_all(list(fresh.areas)), INSIDE + UNIT)
    shapely.prepare(near)
    return not bool(shapely.covers(near, [shapely.linestrings(path) for path in fresh.paths]).all())
