"""A batch of layers refilled: which strokes change, what that saves, and the proof that nothing else did."""

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

PURGED, UNREAD = "purged filament", "no plain moves"  # why a section has no strokes
NO_CORNER = "no corner to round"
SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners


@dataclass(frozen=True, kw_only=True)
class Refilled:
    """A batch after its refill.

    Parameters
    ----------
    text : bytes
    tally : Tally
        What was done in this batch; nothing of what holds its infill up.
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
        Paths of our own; without it, the slicer's are kept, and batches may come in any order.
    memory : Memory
        What the batch before left for this one, if there is a plan.
    """
    table, marks = batch.table, batch.marks
    tools = _tools(table)
    tally = Tally(layers=marks.layers)
    tally.use(tools, table.extruded)
    tally.sections = len(batch.sections)
    if plan is not None:
        memory.ways = ways_of(table, memory.ways)
    if not len(batch.infill):
        _tell(tally, batch, {})
        return _as_it_was(batch, tally, np.empty(0))
    acceleration = batch.acceleration(rules.acceleration)
    before = path_seconds(batch.infill.points, batch.infill.first, batch.speed, acceleration, rules.limits)
    if plan is not None:
        return _replaced(batch, rules, plan, memory, tally, before, tools)
    return _kept(batch, rules, tally, before, tools)


def measured_contact(
    batch: Batch, done: Refilled, last: Below | None, stride: int
) -> tuple[Contact, Contact, Below | None]:
    """Return what holds the infill of a batch up, before and after, and what the next batch needs of it.

    Parameters
    ----------
    batch : Batch
    done : Refilled
    last : Below, optional
        What this function returned for the batch before.
    stride : int
        Every so-many-th layer is measured.
    """
    return measured(
        batch.drawing,
        done.infill,
        batch.others,
        np.unique(batch.marks.layer),
        line_width=batch.line_width,
        stride=stride,
        last=last,
    )


def _kept(batch: Batch, rules: Rules, tally: Tally, before: Floats, tools: Places) -> Refilled:
    """Return a batch with the slicer's paths, rounded."""
    infill, acceleration = batch.infill, batch.acceleration(rules.acceleration)
    new = stroke_corners(batch, rules.rounding.corner, acceleration=rules.acceleration).rounded(rules.rounding)
    after = path_seconds(new.points, new.first, batch.speed, acceleration, rules.limits)
    reasons = {**unchanged(batch, rules), "no faster": after > before * SLOWER}
    anew = redrawn(infill, new, ~_any_of(reasons, len(infill)), rules.rounding)
    done = spliced(batch.table, infill, anew)
    wrong = unlike(batch.table, infill, anew, done)
    if wrong:
        _tell(tally, batch, {f"a check failed: {wrong}": batch.section})
        return _as_it_was(batch, tally, before)
    changed = np.zeros(len(infill), dtype=bool)
    changed[anew.which] = True
    kept = {reason: batch.section[which] for reason, which in reasons.items()}
    if rules.request.pattern != KEEP:  # a pattern of ours that found no room anywhere
        kept[NO_REGION] = batch.section
    _tell(tally, batch, kept, batch.section[changed])
    length = lengths(new.points, new.first)
    _count(
        tally,
        batch,
        before,
        changed,
        Amounts(
            seconds=float(after[changed].sum()),
            length=float(length[changed].sum()),
            filament=float(anew.filament.sum()),
        ),
    )
    tally.widened += float((same_filament(infill, anew) - anew.filament).sum())
    tally.save(tools[infill.opens[anew.which]], infill.filament[anew.which], anew.filament)
    tally.round(new.radius[np.repeat(changed, np.diff(infill.first))])
    old_paths, new_paths = parted(infill.points, infill.first), parted(new.points, new.first)
    points, first = packed([new_paths[k] if changed[k] else old_paths[k] for k in range(len(infill))], like=(2,))
    return Refilled(text=done.text, tally=tally, infill=Drawing(points=points, first=first, layer=batch.layer))


def _replaced(
    batch: Batch, rules: Rules, plan: Plan, memory: Memory, tally: Tally, before: Floats, tools: Places
) -> Refilled:
    """Return a batch with paths of our own."""
    table, infill = batch.table, batch.infill
    found, odd = fresh_sections(batch, plan, memory, rules.acceleration)
    reasons = unchanged(batch, rules)
    fixed = _any_of(reasons, len(infill))
    kept = {reason: batch.section[which] for reason, which in reasons.items()} | odd
    wanted = [each for each in found if not fixed[each.body.strokes].any()]
    fresh = _unhurried(batch, rules, [each for each in wanted if not outside(each)])
    drawn = np.array([each.body.section for each in fresh], dtype=np.intp)
    kept["a path would leave its region"] = np.setdiff1d([each.body.section for each in wanted], drawn)
    if not fresh:
        _tell(tally, batch, kept)
        return _as_it_was(batch, tally, before)
    texts, filament = [], []
    for each in fresh:
        text, pushed = composed(table, each.body, each.paths, each.rate, memory.ways, retractions(each))
        texts.append(text)
        filament.append(pushed)
    done = exchanged(table, [each.body for each in fresh], texts)
    other = read(done.text, table.before)
    wrong = differing(table, other, done) or unlawful(other, done, [each.body for each in fresh], texts)
    if wrong:
        _tell(tally, batch, kept | {f"a check failed: {wrong}": drawn})
        return _as_it_was(batch, tally, before)
    _tell(tally, batch, kept, drawn)
    changed = np.zeros(len(infill), dtype=bool)
    for each in fresh:
        changed[each.body.strokes] = True
        tally.round(each.radii)
    _count(
        tally,
        batch,
        before,
        changed,
        Amounts(
            seconds=sum(_seconds(each, rules) for each in fresh),
            length=sum(total_length(each.paths) for each in fresh),
            filament=sum(filament),
        ),
    )
    opens = np.array([each.body.first for each in fresh])
    tally.save(tools[opens], np.array([each.body.filament for each in fresh]), np.array(filament))
    old_paths, same = parted(infill.points, infill.first), np.flatnonzero(~changed).tolist()
    paths = [old_paths[k] for k in same] + [path for each in fresh for path in each.paths]
    layer = [batch.layer[same], *(np.full(len(each.paths), each.body.layer) for each in fresh)]
    points, first = packed(paths, like=(2,))
    drawing = Drawing(points=points, first=first, layer=np.concatenate(layer))
    return Refilled(text=done.text, tally=tally, infill=drawing)


def _tell(tally: Tally, batch: Batch, reasons: Mapping[str, Places], changed: Places | None = None) -> None:
    """Count every section of a batch once: as replaced, or as kept for the first reason that it has.

    Parameters
    ----------
    tally : Tally
    batch : Batch
    reasons : mapping of str to array of int
        Sections that have each reason.
    changed : array of int, optional
        Sections of which something was drawn anew.
    """
    changed = np.unique(changed) if changed is not None else np.empty(0, dtype=np.intp)
    tally.replaced = len(changed)
    left = np.setdiff1d(batch.sections, changed)
    unread = np.setdiff1d(left, batch.section)
    purged = np.intersect1d(unread, batch.purged_sections)
    for reason, some in {PURGED: purged, UNREAD: unread, **reasons, NO_CORNER: left}.items():
        tally.keep(reason, len(np.intersect1d(left, some)))
        left = np.setdiff1d(left, some)


def _as_it_was(batch: Batch, tally: Tally, before: Floats) -> Refilled:
    """Return a batch as it was."""
    _count(tally, batch, before, np.zeros(len(batch.infill), dtype=bool), Amounts())
    return Refilled(text=batch.table.data, tally=tally, infill=batch.drawing)


def _count(tally: Tally, batch: Batch, before: Floats, changed: Flags, new: Amounts) -> None:
    """Say what the infill of a batch took, and what it takes now that some strokes were changed for new paths."""
    infill = batch.infill

    def amounts(some: Flags) -> Amounts:
        return Amounts(
            seconds=float(before[some].sum()),
            length=float(infill.length[some].sum()),
            filament=float(infill.filament[some].sum()),
        )

    tally.infill = amounts(np.ones(len(infill), dtype=bool))
    tally.infill_after = amounts(~changed) + new
    tally.widened = tally.infill_after.filament


def _seconds(fresh: Fresh, rules: Rules) -> float:
    """Return how long new paths take."""
    points, first = packed(fresh.paths, like=(2,))
    speed, acceleration = max(fresh.body.feed / 60, LEAST_SPEED), fresh.acceleration
    number = len(fresh.paths)
    return float(path_seconds(points, first, np.full(number, speed), np.full(number, acceleration), rules.limits).sum())


def _unhurried(batch: Batch, rules: Rules, fresh: list[Fresh]) -> list[Fresh]:
    """Slow down new paths that would take less time than the old ones, in layers as short as cooling allows.

    Travel counts on both sides, at the feed rates of the section and without acceleration, as slicers reckon it, and
    retractions among the old moves: how many the new ones have is known when they are written.
    """
    short = short_layers(batch, rules)
    slowed = []
    for each in fresh:
        body = each.body
        length = total_length(each.paths)
        if short[body.layer - int(batch.marks.layer[0])] and length > 0:
            left = _section_seconds(batch.table, body) - _travel_seconds(batch.table, each)
            if 0 < 60 * length / body.feed < left:
                body = replace(body, feed=60 * length / left)
        slowed.append(replace(each, body=body))
    return slowed


def _lead(table: Table, body: Body) -> int:
    """Return the line after which a section begins, travel included: the last that prints, or the one before."""
    printing = np.flatnonzero(table.extruded[: body.first] > 0)
    return int(printing[-1]) if len(printing) else max(body.first - 1, 0)


def _section_seconds(table: Table, body: Body) -> float:
    """Return how long the old moves of a section take, travel to it and in it and its retractions too."""
    lines = slice(_lead(table, body), body.last + 1)
    away = np.hypot(np.diff(table.x[lines]), np.diff(table.y[lines]))
    away = np.where(away > 0, away, np.abs(table.extruded[lines][1:]))
    return float(np.nan_to_num(60 * away / table.f[lines][1:]).sum())


def _travel_seconds(table: Table, fresh: Fresh) -> float:
    """Return how long travel to, between and from new paths takes, at the highest feed rate of their section."""
    body = fresh.body
    lead = _lead(table, body)
    start = np.array([table.x[lead], table.y[lead]])
    ends = np.array([start, *(place for path in fresh.paths for place in (path[0], path[-1])), body.end])
    away = np.linalg.norm(ends[1::2] - ends[::2], axis=1).sum()
    return float(60 * away / max(table.f[lead + 1 : body.last + 1].max(), body.feed))


def _any_of(reasons: dict[str, Flags], strokes: int) -> Flags:
    """Return which strokes have a reason."""
    found = np.zeros(strokes, dtype=bool)
    for which in reasons.values():
        found |= which
    return found


def _tools(table: Table) -> Places:
    """Return the tool in use on every line."""
    tools = np.full(len(table), table.before.tool)
    for command in table.commands:
        if command.code[:1] == "T" and command.code[1:].isdigit():
            tools[command.line :] = int(command.code[1:])
    return tools
