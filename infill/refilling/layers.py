"""Refill a batch of layers: change its strokes, count the savings, and prove that nothing else changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bodies import Body, composed, exchanged, unlawful, ways_of
from infill.gcode.splicing import differing, spliced, unlike
from infill.gcode.table import Table, read
from infill.paths.contact import Contact
from infill.paths.covering import total_length
from infill.ragged import packed, parted
from infill.refilling.batch import LEAST_SPEED, Batch
from infill.refilling.measuring import Below, Drawing, measured
from infill.refilling.planning import Plan
from infill.refilling.repath import NO_REGION, Fresh, Memory, fresh_sections, outside, retractions
from infill.refilling.request import KEEP
from infill.refilling.rules import Rules, short_layers, unchanged
from infill.refilling.smooth_in_place import lengths, redrawn, same_filament, stroke_corners
from infill.refilling.stats import Amounts, Tally
from infill.refilling.timing import path_seconds

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Flags = NDArray[np.bool_]

PURGED, UNREAD = "purged filament", "no plain moves"  # reasons for a section without strokes
NO_CORNER = "no corner to round"
SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners


@dataclass(frozen=True, kw_only=True)
class Refilled:
    """A batch after its refill.

    Parameters
    ----------
    text : bytes
    tally : Tally
        Statistics of this batch, without the contact of its infill.
    infill : Drawing
        Its infill now.
    """

    text: bytes
    tally: Tally
    infill: Drawing


def refilled(batch: Batch, rules: Rules, plan: Plan | None, memory: Memory) -> Refilled:
    """Refill a batch.

    Parameters
    ----------
    batch : Batch
    rules : Rules
    plan : Plan, optional
        New paths; without it, the slicer's own are rounded, and batches may come in any order.
    memory : Memory
        State after the previous batch, if there is a plan.
    """
    table, marks = batch.table, batch.marks
    tools = _tools(table)
    tally = Tally(layers=marks.layers)
    tally.use(tools, table.extruded)
    tally.sections = len(batch.sections)
    if plan is not None:
        memory.ways = ways_of(table, memory.ways)
    if not len(batch.infill):
        _count_reasons(tally, batch, {})
        return _keep_batch(batch, tally, np.empty(0))
    acceleration = batch.acceleration(rules.acceleration)
    old_seconds = path_seconds(batch.infill.points, batch.infill.first, batch.speed, acceleration, rules.limits)
    if plan is not None:
        return _replace_sections(batch, rules, plan, memory, tally, old_seconds, tools)
    return _round_strokes(batch, rules, tally, old_seconds, tools)


def measured_contact(
    batch: Batch, refilled_batch: Refilled, last: Below | None, stride: int
) -> tuple[Contact, Contact, Below | None]:
    """Measure the contact of the infill of a batch, before and after; return also the state for the next batch.

    Parameters
    ----------
    batch : Batch
    refilled_batch : Refilled
    last : Below, optional
        Third result of this function for the previous batch.
    stride : int
        Sampling stride, in layers.
    """
    return measured(
        batch.drawing,
        refilled_batch.infill,
        batch.others,
        np.unique(batch.marks.layer),
        line_width=batch.line_width,
        stride=stride,
        last=last,
    )


def _round_strokes(batch: Batch, rules: Rules, tally: Tally, before: Floats, tools: Places) -> Refilled:
    """Round the slicer's paths of a batch."""
    infill, acceleration = batch.infill, batch.acceleration(rules.acceleration)
    rounded_paths = stroke_corners(batch, rules.rounding.corner, acceleration=rules.acceleration).rounded(
        rules.rounding
    )
    after = path_seconds(rounded_paths.points, rounded_paths.first, batch.speed, acceleration, rules.limits)
    reasons = {**unchanged(batch, rules), "no faster": after > before * SLOWER}
    redrawn_strokes = redrawn(infill, rounded_paths, ~_union(reasons, len(infill)), rules.rounding)
    new_text = spliced(batch.table, infill, redrawn_strokes)
    fault = unlike(batch.table, infill, redrawn_strokes, new_text)
    if fault:
        _count_reasons(tally, batch, {f"a check failed: {fault}": batch.section})
        return _keep_batch(batch, tally, before)
    changed = np.zeros(len(infill), dtype=bool)
    changed[redrawn_strokes.which] = True
    kept_sections = {reason: batch.section[strokes] for reason, strokes in reasons.items()}
    if rules.request.pattern != KEEP:  # a new pattern that fits nowhere
        kept_sections[NO_REGION] = batch.section
    _count_reasons(tally, batch, kept_sections, batch.section[changed])
    length = lengths(rounded_paths.points, rounded_paths.first)
    _count(
        tally,
        batch,
        before,
        changed,
        Amounts(
            seconds=float(after[changed].sum()),
            length=float(length[changed].sum()),
            filament=float(redrawn_strokes.filament.sum()),
        ),
    )
    tally.widened += float((same_filament(infill, redrawn_strokes) - redrawn_strokes.filament).sum())
    tally.save(
        tools[infill.opens[redrawn_strokes.which]], infill.filament[redrawn_strokes.which], redrawn_strokes.filament
    )
    tally.round(rounded_paths.radius[np.repeat(changed, np.diff(infill.first))])
    old_paths, new_paths = parted(infill.points, infill.first), parted(rounded_paths.points, rounded_paths.first)
    points, first = packed([new_paths[k] if changed[k] else old_paths[k] for k in range(len(infill))], like=(2,))
    return Refilled(text=new_text.text, tally=tally, infill=Drawing(points=points, first=first, layer=batch.layer))


def _replace_sections(
    batch: Batch, rules: Rules, plan: Plan, memory: Memory, tally: Tally, before: Floats, tools: Places
) -> Refilled:
    """Replace the paths of a batch by new ones."""
    table, infill = batch.table, batch.infill
    candidates, unfit = fresh_sections(batch, plan, memory, rules.acceleration)
    reasons = unchanged(batch, rules)
    fixed = _union(reasons, len(infill))
    kept_sections = {reason: batch.section[strokes] for reason, strokes in reasons.items()} | unfit
    allowed = [section for section in candidates if not fixed[section.body.strokes].any()]
    fresh = _slow_down(batch, rules, [section for section in allowed if not outside(section)])
    drawn = np.array([section.body.section for section in fresh], dtype=np.intp)
    kept_sections["a path would leave its region"] = np.setdiff1d([section.body.section for section in allowed], drawn)
    if not fresh:
        _count_reasons(tally, batch, kept_sections)
        return _keep_batch(batch, tally, before)
    texts, filament = [], []
    for section in fresh:
        text, pushed = composed(table, section.body, section.paths, section.rate, memory.ways, retractions(section))
        texts.append(text)
        filament.append(pushed)
    new_text = exchanged(table, [section.body for section in fresh], texts)
    new_table = read(new_text.text, table.before)
    fault = differing(table, new_table, new_text) or unlawful(
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
        Amounts(
            seconds=sum(_new_seconds(section, rules) for section in fresh),
            length=sum(total_length(section.paths) for section in fresh),
            filament=sum(filament),
        ),
    )
    opens = np.array([section.body.first for section in fresh])
    tally.save(tools[opens], np.array([section.body.filament for section in fresh]), np.array(filament))
    old_paths, unchanged_strokes = parted(infill.points, infill.first), np.flatnonzero(~changed).tolist()
    paths = [old_paths[k] for k in unchanged_strokes] + [path for section in fresh for path in section.paths]
    layer = [batch.layer[unchanged_strokes], *(np.full(len(section.paths), section.body.layer) for section in fresh)]
    points, first = packed(paths, like=(2,))
    drawing = Drawing(points=points, first=first, layer=np.concatenate(layer))
    return Refilled(text=new_text.text, tally=tally, infill=drawing)


def _count_reasons(tally: Tally, batch: Batch, reasons: Mapping[str, Places], changed: Places | None = None) -> None:
    """Count every section of a batch once: as replaced, or as kept for its first reason.

    Parameters
    ----------
    tally : Tally
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


def _keep_batch(batch: Batch, tally: Tally, before: Floats) -> Refilled:
    """Return a batch unchanged."""
    _count(tally, batch, before, np.zeros(len(batch.infill), dtype=bool), Amounts())
    return Refilled(text=batch.table.data, tally=tally, infill=batch.drawing)


def _count(tally: Tally, batch: Batch, before: Floats, changed: Flags, new: Amounts) -> None:
    """Count the infill of a batch before the refill, and after it, with `new` in place of the changed strokes."""
    infill = batch.infill

    def amounts(chosen: Flags) -> Amounts:
        return Amounts(
            seconds=float(before[chosen].sum()),
            length=float(infill.length[chosen].sum()),
            filament=float(infill.filament[chosen].sum()),
        )

    tally.infill = amounts(np.ones(len(infill), dtype=bool))
    tally.infill_after = amounts(~changed) + new
    tally.widened = tally.infill_after.filament


def _new_seconds(fresh: Fresh, rules: Rules) -> float:
    """Return the time of new paths, s."""
    points, first = packed(fresh.paths, like=(2,))
    speed, acceleration = max(fresh.body.feed / 60, LEAST_SPEED), fresh.acceleration
    number = len(fresh.paths)
    return float(path_seconds(points, first, np.full(number, speed), np.full(number, acceleration), rules.limits).sum())


def _slow_down(batch: Batch, rules: Rules, fresh: list[Fresh]) -> list[Fresh]:
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


def _lead_line(table: Table, body: Body) -> int:
    """Return the line after which a section begins, with its travel: the last printing one, or the one before."""
    printing = np.flatnonzero(table.extruded[: body.first] > 0)
    return int(printing[-1]) if len(printing) else max(body.first - 1, 0)


def _section_seconds(table: Table, body: Body) -> float:
    """Return the time of the old moves of a section, with the travel to it and in it and its retractions, s."""
    lines = slice(_lead_line(table, body), body.last + 1)
    distance = np.hypot(np.diff(table.x[lines]), np.diff(table.y[lines]))
    distance = np.where(distance > 0, distance, np.abs(table.extruded[lines][1:]))
    return float(np.nan_to_num(60 * distance / table.f[lines][1:]).sum())


def _travel_seconds(table: Table, fresh: Fresh) -> float:
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


def _tools(table: Table) -> Places:
    """Return the tool in use on every line."""
    tools = np.full(len(table), table.before.tool)
    for command in table.commands:
        if command.code[:1] == "T" and command.code[1:].isdigit():
            tools[command.line :] = int(command.code[1:])
    return tools
