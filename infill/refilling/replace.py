"""Replace the slicer's infill by new paths: in its regions, with its filament, section by section."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from infill.arrays import Floats, Places
from infill.gcode.infill_sections import InfillSection, find_sections
from infill.gcode.section_text import TravelSettings, measure_travel, redraw_sections
from infill.kernels.threads import in_order
from infill.paths.corners import UNIT
from infill.paths.covering import total_length
from infill.paths.families.family import Family
from infill.paths.families.infill_space import fills_print
from infill.paths.layer_below import LayerBelow, index_layer_below
from infill.paths.neighbours import BeadIndex
from infill.planner.print_clock import path_seconds
from infill.ragged import concatenate_rows, split_rows
from infill.refilling.even_layers import LEAST_WIDTH, MOST_WIDTH, LayerShares
from infill.refilling.fitting import (
    REGION_TOLERANCE,
    AreaSetting,
    Column,
    FittedPaths,
    continue_column,
    fit_paths,
)
from infill.refilling.layers import LEAST_SPEED, Layer, LayerPaths, Layers
from infill.refilling.planning import LENGTH_TOLERANCE, RefillPlan
from infill.refilling.regions import NO_REGION, FreeAreas, LayerBeads
from infill.refilling.rules import RefillRules, may_be_slowed, unchangeable_strokes
from infill.refilling.sharing import SectionGroup, group_sections
from infill.refilling.stats import InfillAmounts, NewInfill

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Paths = list[Floats]

LEAST_TRAVEL = 1.0  # mm; shorter travel never retracts
DEBT = 0.1  # of the filament of a layer: the error at which columns choose new cells
AGAIN_AFTER = 8  # layers until columns may choose new cells again
SLOWEST = 0.25  # of its speed, for infill that is much shorter than before on purpose
ACROSS = 0.1  # mm that travel may leave its areas without a retraction


@dataclass(kw_only=True)
class LayerMemory:
    """State that one layer leaves for the next.

    Parameters
    ----------
    ways : TravelSettings
    region : FreeAreas, optional
    found : FreeAreas, optional
        The region without regard to paths that stay; the next one is found by it.
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
    family : Family, optional
        Of the paths drawn.
    asked, taken : float
        mm of filament that sections should take together, and that they take, of a pattern that follows the print.
    fitted : int
        The last layer in which columns chose new cells, to make up for `owed`.
    """

    ways: TravelSettings = field(default_factory=TravelSettings)
    region: FreeAreas | None = None
    found: FreeAreas | None = None
    drawn: dict[tuple[int, int], FittedPaths] = field(default_factory=dict)
    columns: list[Column] = field(default_factory=list)
    ground: LayerBelow | None = None
    others: BeadIndex | None = None
    owed: float = 0.0
    family: Family | None = None
    fitted: int = -AGAIN_AFTER
    asked: float = 0.0
    taken: float = 0.0

    def enter(self, region: FreeAreas, others: BeadIndex, plan: RefillPlan) -> None:
        """Go on to a layer with this region and these other beads."""
        changed = region is not self.region or plan.family is not self.family
        if plan.family is not self.family:  # every column begins anew
            self.columns = []
        if changed:
            self.ground = None
            if self.others is not None and plan.family.prismatic:
                below = [path for fitted in self.drawn.values() for path in fitted.paths]
                self.ground = index_layer_below(below, self.others, plan.line_width)
        if changed or not plan.family.prismatic:
            self.drawn.clear()
        self.region, self.others, self.family = region, others, plan.family

    def settle_debt(self, layer: int, filament: float) -> None:
        """Let the columns that are far off choose new cells, if much filament of a layer is owed, mm."""
        if abs(self.owed) <= DEBT * filament or layer < self.fitted + AGAIN_AFTER:
            return
        self.fitted = layer
        self.columns = [replace(column, fresh=True) for column in self.columns]
        for key, fitted_paths in list(self.drawn.items()):
            target = self.columns[key[0]].length
            if abs(fitted_paths.length - target) > LENGTH_TOLERANCE * target:
                del self.drawn[key]

    def paths_in(self, area: int, place: AreaSetting) -> FittedPaths:
        """Return the paths of an area, drawn once for all layers that have them in common."""
        key = (area, 0 if place.plan.family.prismatic else place.layer)
        if key not in self.drawn:
            self.drawn[key] = result = fit_paths(self.columns[area], place)
            self.columns[area] = replace(self.columns[area], cell=result.cell)
        return self.drawn[key]


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
    asked : float
        mm of filament that it should take, if nothing but the mean of the print counted.
    """

    body: InfillSection
    paths: Paths
    rate: float
    areas: tuple[Polygon, ...]
    radii: Floats
    acceleration: float
    asked: float = 0.0

    @cached_property
    def length(self) -> float:
        """Length of the paths, mm."""
        return total_length(self.paths)

    @cached_property
    def travels(self) -> Floats:
        """Travel to each path and from the last one to the end of the section, (P + 1, 2, 2), mm."""
        begins = [self.body.start, *(path[-1] for path in self.paths)]
        ends = [*(path[0] for path in self.paths), self.body.end]
        return np.stack([np.array(begins), np.array(ends)], axis=1)

    def _grown_area(self, margin: float) -> Polygon | MultiPolygon:
        """Return its areas with a margin, mm, prepared for queries."""
        import shapely

        area: Polygon | MultiPolygon = shapely.buffer(shapely.union_all(list(self.areas)), margin)
        shapely.prepare(area)
        return area

    def retractions(self) -> list[bool]:
        """Tell for each travel whether to retract: where it leaves the region."""
        import shapely

        travels = shapely.linestrings(self.travels)
        is_long = shapely.length(travels) > LEAST_TRAVEL
        return [bool(leaves) for leaves in is_long & ~shapely.covers(self._grown_area(ACROSS), travels)]

    def leaves_region(self) -> bool:
        """Tell whether a path leaves its region."""
        import shapely

        if not self.paths:
            return False
        lines = [shapely.linestrings(path) for path in self.paths]
        return not bool(shapely.covers(self._grown_area(REGION_TOLERANCE + UNIT), lines).all())

    @cached_property
    def seconds(self) -> float:
        """The time of the paths, s."""
        points, first = concatenate_rows(self.paths, like=(2,))
        speed = np.full(len(self.paths), max(self.body.feed / 60, LEAST_SPEED))
        acceleration = np.full(len(self.paths), self.acceleration)
        return float(path_seconds(points, first, speed, acceleration).sum())

    def even_out(self, even: LayerShares) -> NewSection:
        """Return the section with the speed and the filament per mm that even out its layer."""
        body = replace(self.body, feed=even.feed_rate(self.body.layer, self.body.feed))
        return replace(self, body=body, rate=even.filament_rate(body.layer, self.rate, body.rate))

    def slow_down_to_old(self, layers: Layers, slowest: float = 0.0) -> NewSection:
        """Return the section, slowed down if it would take less time than the old one, to a share `slowest` at most.

        Travel counts on both sides, at the feed rates of the section and without acceleration, as slicers count it.
        Retractions count among the old moves only: those of the new ones are not yet known.
        """
        body, table = self.body, layers.table
        if not self.length > 0:
            return self
        # A section begins with its travel: after the last line that prints.
        printing = np.flatnonzero(table.extruded[: body.first] > 0)
        lead = int(printing[-1]) if len(printing) else max(body.first - 1, 0)
        lines = slice(lead, body.last + 1)
        distance = layers.steps[lines][1:]
        distance = np.where(distance > 0, distance, np.abs(table.extruded[lines][1:]))
        available = float(np.nan_to_num(60 * distance / table.f[lines][1:]).sum())
        travels = self.travels.copy()
        travels[0, 0] = table.x[lead], table.y[lead]
        travel = np.linalg.norm(travels[:, 1] - travels[:, 0], axis=1).sum()
        available -= float(60 * travel / max(table.f[lead + 1 : body.last + 1].max(), body.feed))
        if 0 < 60 * self.length / body.feed < available:
            body = replace(body, feed=max(60 * self.length / available, slowest * body.feed))
        return replace(self, body=body)


def replace_infill(layers: Layers, rules: RefillRules, plan: RefillPlan, memory: LayerMemory) -> NewInfill:
    """Replace the paths of some layers by new ones, and prove that nothing else changed.

    Parameters
    ----------
    layers : Layers
    rules : RefillRules
    plan : RefillPlan
    memory : LayerMemory
        State after the previous layer; updated to the last layer.
    """
    memory.ways = measure_travel(layers.table, memory.ways)
    if not len(layers.infill):
        return NewInfill.unchanged(layers, {})
    table, infill = layers.table, layers.infill
    candidates, unfit = draw_sections(layers, plan, memory, rules.acceleration)
    reasons = unchangeable_strokes(layers, rules)
    fixed = np.any(list(reasons.values()), axis=0)
    kept = {reason: layers.section[strokes] for reason, strokes in reasons.items()}
    allowed = [section for section in candidates if not fixed[section.body.strokes].any()]
    new = [section for section in allowed if not section.leaves_region()]
    drawn = np.array([section.body.section for section in new], dtype=np.intp)
    kept["a path would leave its region"] = np.setdiff1d([section.body.section for section in allowed], drawn)
    kept |= unfit  # which ends with all sections, for those that no other reason names
    if not new:
        return NewInfill.unchanged(layers, kept)
    slow = may_be_slowed(layers, rules)
    slowest = SLOWEST if plan.follows_print else 0.0
    new = [s.slow_down_to_old(layers, slowest) if slow[s.body.layer - int(layers.marks.layer[0])] else s for s in new]
    if plan.even is not None:
        new = [section.even_out(plan.even) for section in new]
    text, filament, fault = redraw_sections(
        table, [(s.body, s.paths, s.rate, s.retractions()) for s in new], memory.ways, rules.arc_deviation
    )
    if fault:
        return NewInfill.unchanged(layers, kept | {f"a check failed: {fault}": drawn})
    memory.asked += sum(section.asked for section in new)
    memory.taken += sum(section.rate * section.length for section in new)
    bodies = [section.body for section in new]
    changed = np.zeros(len(infill), dtype=bool)
    changed[np.concatenate([body.strokes for body in bodies])] = True
    old_paths, remaining = split_rows(infill.points, infill.first), np.flatnonzero(~changed).tolist()
    points, first = concatenate_rows(
        [*(old_paths[k] for k in remaining), *(path for section in new for path in section.paths)], like=(2,)
    )
    layer = [layers.layer[remaining], *(np.full(len(section.paths), section.body.layer) for section in new)]
    return NewInfill(
        text=text,
        paths=LayerPaths(points=points, first=first, layer=np.concatenate(layer)),
        changed=changed,
        kept=kept,
        amounts=InfillAmounts(
            seconds=sum(section.seconds for section in new),
            length=sum(section.length for section in new),
            filament=sum(filament),
        ),
        lines=np.array([body.first for body in bodies]),
        increase=np.array(filament) - np.array([body.filament for body in bodies]),
        radii=np.concatenate([section.radii for section in new]),
        drawn=_sum_by_layer(new),
    )


def _sum_by_layer(sections: Sequence[NewSection]) -> dict[int, Floats]:
    """Sum up filament at the slicer's filament per mm, filament, and seconds of new sections by layer, (3,) each."""
    sums: dict[int, Floats] = {}
    for section in sections:
        amounts = section.body.rate * section.length, section.rate * section.length, section.seconds
        sums[section.body.layer] = sums.get(section.body.layer, np.zeros(3)) + amounts
    return sums


def draw_sections(
    layers: Layers, plan: RefillPlan, memory: LayerMemory, acceleration: float
) -> tuple[list[NewSection], dict[str, Places]]:
    """Draw new paths for the sections of some layers; return them, and the sections that keep theirs, by reason.

    Parameters
    ----------
    layers : Layers
    plan : RefillPlan
    memory : LayerMemory
        State after the previous layer; updated to the last layer.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    bodies, reasons = find_sections(layers.table, layers.marks, layers.infill)
    commanded = layers.acceleration(acceleration)
    new: list[NewSection] = []
    # Regions do not depend on the drawing: another thread searches the next one meanwhile.
    spacing = plan.family.least_spacing * plan.line_width
    for layer, (region, beads) in in_order(_region_finder(memory.found, spacing), layers, threads=1):
        layer_plan = plan.at(layer.z)
        layer_bodies = {body.section: body for body in bodies if body.layer == layer.number}
        memory.found = region
        groups = group_sections(layer, region)
        refused = [
            group
            for group in groups
            if not any(group.areas.values()) or group.refusal_reason(_members(group, layer_bodies))
        ]
        if refused:
            own = {area for group in refused for areas in group.areas.values() for area in areas}
            kept_lines = layer.paths_of([section for group in refused for section in group.areas])
            region = region.keep_off(kept_lines, spacing, own)
            groups = groups if region is memory.found else group_sections(layer, region)
        memory.enter(region, beads.all, layer_plan)
        lengths: dict[int, float] = {}  # mm of the slicer's infill, by area
        for group in groups:
            for area, length in group.lengths.items():
                lengths[area] = lengths.get(area, 0.0) + length
        memory.columns = [
            continue_column(polygon, lengths.get(area, 0.0), layer_plan, memory.columns, layer.z)
            for area, polygon in enumerate(region.polygons)
        ]
        memory.settle_debt(layer.number, sum(body.filament for body in layer_bodies.values()))
        for group in groups:
            members = _members(group, layer_bodies)
            reason = group.refusal_reason(members)
            if not reason:
                filled = _fill_group(group, members, region, layer_plan, memory, commanded)
                new += filled
                reason = "" if filled else "no path fits"
            if reason:
                reasons.setdefault(reason, []).extend(body.section for body in members)
    kept = {reason: np.array(sections, dtype=np.intp) for reason, sections in reasons.items()}
    return sorted(new, key=lambda section: section.body.first), {**kept, NO_REGION: layers.section}


def _members(group: SectionGroup, bodies: Mapping[int, InfillSection]) -> list[InfillSection]:
    """Return the sections of a group that can be redrawn."""
    return [bodies[member] for member in group.areas if member in bodies]


def _region_finder(initial: FreeAreas | None, spacing: float) -> Callable[[Layer], tuple[FreeAreas, LayerBeads]]:
    """Return a function that finds the region of a layer and its other beads, one layer after another.

    Areas of a region lie as far from one another as lines, `spacing` mm.
    """
    region = initial

    def find_next(layer: Layer) -> tuple[FreeAreas, LayerBeads]:
        """Find the region of the next layer, and its other beads."""
        nonlocal region
        found = layer.find_region(region)
        region = found if found is region else found.keep_apart(spacing)
        return region, layer.beads

    return find_next


def _fill_group(
    group: SectionGroup,
    members: Sequence[InfillSection],
    region: FreeAreas,
    plan: RefillPlan,
    memory: LayerMemory,
    acceleration: Floats,
) -> list[NewSection]:
    """Draw new paths for sections that share areas, with their filament; return none if no path fits."""
    assert memory.others is not None
    areas = tuple(region.polygons[area] for item in group.areas.values() for area in item)
    sections = []
    for body in members:
        place = AreaSetting(
            plan=plan,
            walls=memory.others,
            z=body.z,
            layer=body.layer,
            speed=body.feed / 60,
            acceleration=float(acceleration[body.strokes[0]]),
            ground=memory.ground,
        )
        fitted = [memory.paths_in(area, place) for area in group.areas[body.section]]
        sections.append(
            NewSection(
                body=body,
                paths=_shorter_direction([path for item in fitted for path in item.paths], body),
                rate=body.rate,
                areas=areas,
                radii=np.concatenate([np.empty(0), *(item.radii for item in fitted)]),
                acceleration=place.acceleration,
            )
        )
    filament = sum(section.rate * section.length for section in sections)
    if not filament and fills_print(plan.family):
        return []
    if plan.fixed:
        target = filament
    elif plan.density is None:
        target = sum(body.filament for body in members)
    else:
        target = members[0].rate * plan.length_in(areas, members[0].z)
    if plan.scale is not None:
        return [replace(section, rate=section.rate * plan.scale, asked=target / len(sections)) for section in sections]
    target += memory.owed
    factor = float(np.clip(target / filament, LEAST_WIDTH, MOST_WIDTH))
    memory.owed = target - factor * filament
    return [replace(section, rate=section.rate * factor) for section in sections]


def _shorter_direction(paths: Paths, body: InfillSection) -> Paths:
    """Order paths forwards or backwards, whichever begins and ends nearer to the section's ends."""
    if not paths:
        return paths

    def travel_length(ordered: Paths) -> float:
        """Return the travel to ordered paths and from them to the end, mm."""
        return float(np.hypot(*(ordered[0][0] - body.start)) + np.hypot(*(ordered[-1][-1] - body.end)))

    return min(paths, [path[::-1] for path in paths[::-1]], key=travel_length)
