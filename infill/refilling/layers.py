"""Refill a batch of layers: change its strokes, count the savings, and prove that nothing else changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bodies import InfillSection, compose_section, measure_travel, replace_sections, validate_section
from infill.gcode.splicing import find_difference, splice_paths, verify_replay
from infill.gcode.table import GcodeTable, read_table
from infill.paths.contact import Contact
from infill.paths.covering import total_length
from infill.planner.print_clock import path_seconds
from infill.ragged import concatenate_rows, split_rows
from infill.refilling.batch import LEAST_SPEED, Batch
from infill.refilling.measuring import LayerPaths, SampledLayer, measure_layers
from infill.refilling.planning import RefillPlan
from infill.refilling.repath import NO_REGION, LayerMemory, NewSection, choose_retractions, draw_sections, leaves_region
from infill.refilling.request import KEEP
from infill.refilling.rules import RefillRules, short_layers, unchangeable_strokes
from infill.refilling.smooth_in_place import path_lengths, redraw_strokes, stroke_corners, widened_filament
from infill.refilling.stats import InfillAmounts, RefillStats

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Flags = NDArray[np.bool_]

PURGED, UNREAD = "purged filament", "no plain moves"  # reasons for a section without strokes
NO_CORNER = "no corner to round"
SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners


@dataclass(frozen=True, kw_only=True)
class RefilledBatch:
    """A batch after its refill.

    Parameters
    ----------
    text : bytes
    tally : RefillStats
        Statistics of this batch, without the contact of its infill.
    infill : LayerPaths
        Its infill now.
    """

    text: bytes
    tally: RefillStats
    infill: LayerPaths


def refill_batch(batch: Batch, rules: RefillRules, plan: RefillPlan | None, memory: LayerMemory) -> RefilledBatch:
    """Refill a batch.

    Parameters
    ----------
    batch : Batch
    rules : RefillRules
    plan : RefillPlan, optional
        New paths; without it, the slicer's own are rounded, and batches may come in any order.
    memory : LayerMemory
        State after the previous batch, if there is a plan.
    """
    table, marks = batch.table, batch.marks
    tools = _tools(table)
    tally = RefillStats(layers=marks.layers)
    tally.use(tools, table.extruded)
    tally.sections = len(batch.sections)
    if plan is not None:
        memory.ways = measure_travel(table, memory.ways)
    if not len(batch.infill):
        _count_reasons(tally, batch, {})
        return _keep_batch(batch, tally, np.empty(0))
    acceleration = batch.acceleration(rules.acceleration)
    old_seconds = path_seconds(batch.infill.points, batch.infill.first, batch.speed, acceleration, rules.limits)
    if plan is not None:
        return _replace_sections(batch, rules, plan, memory, tally, old_seconds, tools)
    return _round_strokes(batch, rules, tally, old_seconds, tools)


def measure_batch(
    batch: Batch, refilled_batch: RefilledBatch, last: SampledLayer | None, stride: int
) -> tuple[Contact, Contact, SampledLayer | None]:
    """Measure the contact of the infill of a batch, before and after; return also the state for the next batch.

    Parameters
    ----------
    batch : Batch
    refilled_batch : RefilledBatch
    last : SampledLayer, optional
        Third result of this function for the previous batch.
    stride : int
        Sampling stride, in layers.
    """
    return measure_layers(
        batch.drawing,
        refilled_batch.infill,
        batch.others,
        np.unique(batch.marks.layer),
        line_width=batch.line_width,
        stride=stride,
        last=last,
    )


def _round_strokes(
    batch: Batch, rules: RefillRules, tally: RefillStats, before: Floats, tools: Places
) -> RefilledBatch:
    """Round the slicer's paths of a batch."""
    infill, acceleration = batch.infill, batch.acceleration(rules.acceleration)
    rounded_paths = stroke_corners(batch, rules.rounding.corner, acceleration=rules.acceleration).rounded(
        rules.rounding
    )
    after = path_seconds(rounded_paths.points, rounded_paths.first, batch.speed, acceleration, rules.limits)
    reasons = {**unchangeable_strokes(batch, rules), "no faster": after > before * SLOWER}
    redrawn_strokes = redraw_strokes(infill, rounded_paths, ~_union(reasons, len(infill)), rules.rounding)
    new_text = splice_paths(batch.table, infill, redrawn_strokes)
    fault = verify_replay(batch.table, infill, redrawn_strokes, new_text)
    if fault:
        _count_reasons(tally, batch, {f"a check failed: {fault}": batch.section})
        return _keep_batch(batch, tally, before)
    changed = np.zeros(len(infill), dtype=bool)
    changed[redrawn_strokes.which] = True
    kept_sections = {reason: batch.section[strokes] for reason, strokes in reasons.items()}
    if rules.request.pattern != KEEP:  # a new pattern that fits nowhere
        kept_sections[NO_REGION] = batch.section
    _count_reasons(tally, batch, kept_sections, batch.section[changed])
    length = path_lengths(rounded_paths.points, rounded_paths.first)
    _count(
        tally,
        batch,
        before,
        changed,
        InfillAmounts(
            seconds=float(after[changed].sum()),
            length=float(length[changed].sum()),
            filament=float(redrawn_strokes.filament.sum()),
        ),
    )
    tally.widened += float((widened_filament(infill, redrawn_strokes) - redrawn_strokes.filament).sum())
    tally.save(
        tools[infill.opens[redrawn_strokes.which]], infill.filament[redrawn_strokes.which], redrawn_strokes.filament
    )
    tally.round(rounded_paths.radius[np.repeat(changed, np.diff(infill.first))])
    old_paths, new_paths = (
        split_rows(infill.points, infill.first),
        split_rows(rounded_paths.points, rounded_paths.first),
    )
    points, first = concatenate_rows(
        [new_paths[k] if changed[k] else old_paths[k] for k in range(len(infill))], like=(2,)
    )
    return RefilledBatch(
        text=new_text.text, tally=tally, infill=LayerPaths(points=points, first=first, layer=batch.layer)
    )


def _replace_sections(
    batch: Batch,
    rules: RefillRules,
    plan: RefillPlan,
    memory: LayerMemory,
    tally: RefillStats,
    before: Floats,
    tools: Places,
) -> RefilledBatch:
    """Replace the paths of a batch by new ones."""
    table, infill = batch.table, batch.infill
    candidates, unfit = draw_sections(batch, plan, memory, rules.acceleration)
    reasons = unchangeable_strokes(batch, rules)
    fixed = _union(reasons, len(infill))
    kept_sections = {reason: batch.section[strokes] for reason, strokes in reasons.items()} | unfit
    allowed = [section for section in candidates if not fixed[section.body.strokes].any()]
    fresh = _slow_down(batch, rules, [section for section in allowed if not leaves_region(section)])
    drawn = np.array([section.body.section for section in fresh], dtype=np.intp)
    kept_sections["a path would leave its region"] = np.setdiff1d([section.body.section for section in allowed], drawn)
    if not fresh:
        _count_reasons(tally, batch, kept_sections)
        return _keep_batch(batch, tally, before)
    texts, filament = [], []
    for section in fresh:
        text, pushed = compose_section(
            table, section.body, section.paths, section.rate, memory.ways, choose_retractions(section)
        )
        texts.append(text)
        filament.append(pushed)
    new_text = replace_sections(table, [section.body for section in fresh], texts)
    new_table = read_table(new_text.text, table.before)
    fault = find_difference(table, new_table, new_text) or validate_section(
        new_table, new_text, [section.body for section in fresh], texts
    )
    if fault:
        _count_reasons(tally, batch, kept_sections | {f"a check failed: {fault}": drawn})
        return _keep_batch(batch, tally, before)
    _count_reasons(tally, batch, kept_sections, drawn)
    changed = np.zeros(len(infill), dtype=bool)
    for section in fresh:
        changed[section.body.strokes] = True
        tally.round(section.radii)
    _count(
        tally,
        batch,
        before,
        changed,
        InfillAmounts(
            seconds=sum(_new_seconds(section, rules) for section in fresh),
            length=sum(total_length(section.paths) for section in fresh),
            filament=sum(filament),
        ),
    )
    opens = np.array([section.body.first for section in fresh])
    tally.save(tools[opens], np.array([section.body.filament for section in fresh]), np.array(filament))
    old_paths, unchanged_strokes = split_rows(infill.points, infill.first), np.flatnonzero(~changed).tolist()
    paths = [old_paths[k] for k in unchanged_strokes] + [path for section in fresh for path in section.paths]
    layer = [batch.layer[unchanged_strokes], *(np.full(len(section.paths), section.body.layer) for section in fresh)]
    points, first = concatenate_rows(paths, like=(2,))
    drawing = LayerPaths(points=points, first=first, layer=np.concatenate(layer))
    return RefilledBatch(text=new_text.text, tally=tally, infill=drawing)


def _count_reasons(
    tally: RefillStats, batch: Batch, reasons: Mapping[str, Places], changed: Places | None = None
) -> None:
    """Count every section of a batch once: as replaced, or as kept for its first reason.

    Parameters
    ----------
    tally : RefillStats
    batch : Batch
    reasons : mapping of str to array of int
        Sections by reason.
    changed : array of int, optional
        Sections with new paths.
    """
    changed = np.unique(changed) if changed is not None else np.empty(0, dtype=np.intp)
    tally.replaced = len(changed)
    remaining = np.setdiff1d(batch.sections, changed)
    unread = np.setdiff1d(remaining, batch.section)
    purged = np.intersect1d(unread, batch.purged_sections)
    for reason, sections in {PURGED: purged, UNREAD: unread, **reasons, NO_CORNER: remaining}.items():
        tally.keep(reason, len(np.intersect1d(remaining, sections)))
        remaining = np.setdiff1d(remaining, sections)


def _keep_batch(batch: Batch, tally: RefillStats, before: Floats) -> RefilledBatch:
    """Return a batch unchanged."""
    _count(tally, batch, before, np.zeros(len(batch.infill), dtype=bool), InfillAmounts())
    return RefilledBatch(text=batch.table.data, tally=tally, infill=batch.drawing)


def _count(tally: RefillStats, batch: Batch, before: Floats, changed: Flags, new: InfillAmounts) -> None:
    """Count the infill of a batch before the refill, and after it, with `new` in place of the changed strokes."""
    infill = batch.infill

    def amounts(chosen: Flags) -> InfillAmounts:
        return InfillAmounts(
            seconds=float(before[chosen].sum()),
            length=float(infill.length[chosen].sum()),
            filament=float(infill.filament[chosen].sum()),
        )

    tally.infill = amounts(np.ones(len(infill), dtype=bool))
    tally.infill_after = amounts(~changed) + new
    tally.widened = tally.infill_after.filament


def _new_seconds(fresh: NewSection, rules: RefillRules) -> float:
    """Return the time of new paths, s."""
    points, first = concatenate_rows(fresh.paths, like=(2,))
    speed, acceleration = max(fresh.body.feed / 60, LEAST_SPEED), fresh.acceleration
    number = len(fresh.paths)
    return float(path_seconds(points, first, np.full(number, speed), np.full(number, acceleration), rules.limits).sum())


def _slow_down(batch: Batch, rules: RefillRules, fresh: list[NewSection]) -> list[NewSection]:
    """Slow down new paths that would take less time than the old ones, in layers as short as cooling allows.

    Travel counts on both sides, at the feed rates of the section and without acceleration, as slicers count it.
    Retractions count among the old moves only: those of the new ones are not yet known.
    """
    short = short_layers(batch, rules)
    slowed = []
    for section in fresh:
        body = section.body
        length = total_length(section.paths)
        if short[body.layer - int(batch.marks.layer[0])] and length > 0:
            available = _section_seconds(batch.table, body) - _travel_seconds(batch.table, section)
            if 0 < 60 * length / body.feed < available:
                body = replace(body, feed=60 * length / available)
        slowed.append(replace(section, body=body))
    return slowed


def _lead_line(table: GcodeTable, body: InfillSection) -> int:
    """Return the line after which a section begins, with its travel: the last printing one, or the one before."""
    printing = np.flatnonzero(table.extruded[: body.first] > 0)
    return int(printing[-1]) if len(printing) else max(body.first - 1, 0)


def _section_seconds(table: GcodeTable, body: InfillSection) -> float:
    """Return the time of the old moves of a section, with the travel to it and in it and its retractions, s."""
    lines = slice(_lead_line(table, body), body.last + 1)
    distance = np.hypot(np.diff(table.x[lines]), np.diff(table.y[lines]))
    distance = np.where(distance > 0, distance, np.abs(table.extruded[lines][1:]))
    return float(np.nan_to_num(60 * distance / table.f[lines][1:]).sum())


def _travel_seconds(table: GcodeTable, fresh: NewSection) -> float:
    """Return the time of travel to, between and from new paths, at the highest feed rate of their section, s."""
    body = fresh.body
    lead = _lead_line(table, body)
    start = np.array([table.x[lead], table.y[lead]])
    ends = np.array([start, *(place for path in fresh.paths for place in (path[0], path[-1])), body.end])
    distance = np.linalg.norm(ends[1::2] - ends[::2], axis=1).sum()
    return float(60 * distance / max(table.f[lead + 1 : body.last + 1].max(), body.feed))


def _union(reasons: dict[str, Flags], strokes: int) -> Flags:
    """Unite the strokes of all reasons."""
    union = np.zeros(strokes, dtype=bool)
    for flags in reasons.values():
        union |= flags
    return union


def _tools(table: GcodeTable) -> Places:
    """Return the tool in use on every line."""
    tools = np.full(len(table), table.before.tool)
    for command in table.commands:
        if command.code[:1] == "T" and command.code[1:].isdigit():
            tools[command.line :] = int(command.code[1:])
    return tools
