"""A batch of layers refilled: which strokes change, what that saves, and the proof that nothing else did."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.filling.batch import LEAST_SPEED, Batch
from infill.filling.covering import total_length
from infill.filling.keeping import lengths, redrawn, rounded_strokes
from infill.filling.measuring import Below, Drawing, measured
from infill.filling.planning import Plan
from infill.filling.replacing import Fresh, Memory, fresh_sections, outside, retractions
from infill.filling.rules import Rules, short_layers, unchanged
from infill.filling.tally import Amounts, Tally
from infill.filling.timing import path_seconds
from infill.gcode.bodies import composed, exchanged, unlawful, ways_of
from infill.gcode.sections import SPARSE
from infill.gcode.splicing import differing, spliced, unlike
from infill.gcode.table import Table, read
from infill.ragged import packed, parted

Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Flags = NDArray[np.bool_]

SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners


class Refiller:
    """Refills a print, one batch of whole layers after another.

    Parameters
    ----------
    rules : Rules
    plan : Plan, optional
        Paths of our own; without it, the slicer's are kept.

    Attributes
    ----------
    tally : Tally
        What was done so far.
    """

    def __init__(self, rules: Rules, plan: Plan | None = None) -> None:
        self.tally = Tally()
        self._rules = rules
        self._plan = plan
        self._memory = Memory()
        self._below: Below | None = None

    def refill(self, batch: Batch) -> bytes:
        """Return the new text of a batch."""
        table, marks, infill, tally = batch.table, batch.marks, batch.infill, self.tally
        tally.layers += int(marks.layer[-1] - (marks.layer[0] - marks.tagged[0])) if len(marks.layer) else 0
        tools = _tools(table)
        tally.use(tools, table.extruded)
        self._memory.ways = ways_of(table, self._memory.ways)
        sections = np.unique(marks.section[marks.is_role(SPARSE) & (table.extruded > 0)])
        tally.sections += len(sections)
        if not len(infill):
            tally.keep("no plain moves", len(sections))
            return table.data
        before = self._seconds(infill.points, infill.first, batch.speed, batch.acceleration(self._rules.acceleration))
        if self._plan is not None:
            return self._replaced(batch, self._plan, before, tools)
        tally.keep("no plain moves", len(np.setdiff1d(sections, batch.section)))
        return self._kept(batch, before, tools)

    def _kept(self, batch: Batch, before: Floats, tools: Places) -> bytes:
        """Return the text of a batch with the slicer's paths, rounded."""
        infill, rules, tally = batch.infill, self._rules, self.tally
        new = rounded_strokes(batch, rules.rounding, acceleration=rules.acceleration)
        after = self._seconds(new.points, new.first, batch.speed, batch.acceleration(rules.acceleration))
        reasons = {**unchanged(batch, rules), "no faster": after > before * SLOWER}
        anew = redrawn(infill, new, ~_any_of(reasons, len(infill)), rules.rounding)
        done = spliced(batch.table, infill, anew)
        wrong = unlike(batch.table, infill, anew, done)
        if wrong:
            tally.keep(f"a check failed: {wrong}", len(np.unique(batch.section)))
            return self._as_it_was(batch, before)
        changed = np.zeros(len(infill), dtype=bool)
        changed[anew.which] = True
        touched = np.unique(batch.section[changed])
        tally.replaced += len(touched)
        for reason, which in reasons.items():
            tally.keep(reason, len(np.setdiff1d(np.unique(batch.section[which]), touched)))
        self._count(
            batch,
            before,
            changed,
            Amounts(
                seconds=float(after[changed].sum()),
                length=float(lengths(new.points, new.first)[changed].sum()),
                filament=float(anew.filament.sum()),
            ),
        )
        tally.save(tools[infill.opens[anew.which]], infill.filament[anew.which], anew.filament)
        tally.round(new.radius[np.repeat(changed, np.diff(infill.first))])
        old_paths, new_paths = parted(infill.points, infill.first), parted(new.points, new.first)
        paths = [new_paths[k] if changed[k] else old_paths[k] for k in range(len(infill))]
        self._measure(batch, paths, batch.layer)
        return done.text

    def _replaced(self, batch: Batch, plan: Plan, before: Floats, tools: Places) -> bytes:
        """Return the text of a batch with paths of our own."""
        table, infill, rules, tally = batch.table, batch.infill, self._rules, self.tally
        found, odd = fresh_sections(batch, plan, self._memory, rules.acceleration)
        reasons = unchanged(batch, rules)
        for reason, which in reasons.items():
            tally.keep(reason, len(np.unique(batch.section[which])))
        for reason, number in odd.items():
            tally.keep(reason, number)
        fixed = _any_of(reasons, len(infill))
        wanted = [each for each in found if not fixed[each.body.strokes].any()]
        fresh = _unhurried(batch, rules, [each for each in wanted if not outside(each)])
        tally.keep("a path would leave its region", len(wanted) - len(fresh))
        if not fresh:
            return self._as_it_was(batch, before)
        texts, filament = [], []
        for each in fresh:
            text, pushed = composed(table, each.body, each.paths, each.rate, self._memory.ways, retractions(each))
            texts.append(text)
            filament.append(pushed)
        done = exchanged(table, [each.body for each in fresh], texts)
        other = read(done.text, table.before)
        wrong = differing(table, other, done) or unlawful(other, done, [each.body for each in fresh], texts)
        if wrong:
            tally.keep(f"a check failed: {wrong}", len(fresh))
            return self._as_it_was(batch, before)
        tally.replaced += len(fresh)
        changed = np.zeros(len(infill), dtype=bool)
        for each in fresh:
            changed[each.body.strokes] = True
            tally.round(each.radii)
        seconds = sum(self._seconds_of(each) for each in fresh)
        length = sum(total_length(each.paths) for each in fresh)
        self._count(batch, before, changed, Amounts(seconds=seconds, length=length, filament=sum(filament)))
        first = np.array([each.body.first for each in fresh])
        tally.save(tools[first], np.array([each.body.filament for each in fresh]), np.array(filament))
        old_paths, kept = parted(infill.points, infill.first), np.flatnonzero(~changed).tolist()
        layer = [batch.layer[kept], *(np.full(len(each.paths), each.body.layer) for each in fresh)]
        paths = [old_paths[k] for k in kept] + [path for each in fresh for path in each.paths]
        self._measure(batch, paths, np.concatenate(layer))
        return done.text

    def _as_it_was(self, batch: Batch, before: Floats) -> bytes:
        """Return a batch as it was."""
        self._count(batch, before, np.zeros(len(batch.infill), dtype=bool), Amounts())
        return batch.table.data

    def _count(self, batch: Batch, before: Floats, changed: Flags, new: Amounts) -> None:
        """Add what the infill of a batch took, and what it takes now that some strokes were changed for new paths."""
        infill = batch.infill

        def amounts(some: Flags) -> Amounts:
            return Amounts(
                seconds=float(before[some].sum()),
                length=float(infill.length[some].sum()),
                filament=float(infill.filament[some].sum()),
            )

        self.tally.infill += amounts(np.ones(len(infill), dtype=bool))
        self.tally.infill_after += amounts(~changed) + new

    def _measure(self, batch: Batch, paths: list[Floats], layer: Places) -> None:
        """Add what some layers of a batch are held up by, before and with these paths."""
        points, first = packed(paths, like=(2,))
        before, after, self._below = measured(
            Drawing(points=batch.infill.points, first=batch.infill.first, layer=batch.layer),
            Drawing(points=points, first=first, layer=layer),
            batch.others,
            np.unique(batch.marks.layer),
            line_width=batch.line_width,
            stride=self._rules.stride,
            last=self._below,
        )
        self.tally.measure(before, after)

    def _seconds_of(self, fresh: Fresh) -> float:
        """Return how long new paths take."""
        points, first = packed(fresh.paths, like=(2,))
        speed = np.full(len(fresh.paths), max(fresh.body.feed / 60, LEAST_SPEED))
        return float(self._seconds(points, first, speed, np.full(len(fresh.paths), fresh.acceleration)).sum())

    def _seconds(self, points: Floats, first: Places, speed: Floats, acceleration: Floats) -> Floats:
        return path_seconds(points, first, speed, acceleration, self._rules.limits)


def _unhurried(batch: Batch, rules: Rules, fresh: list[Fresh]) -> list[Fresh]:
    """Slow down new paths that are shorter than the old ones, in layers that may be as short as cooling allows."""
    short = short_layers(batch, rules)
    slowed = []
    for each in fresh:
        body = each.body
        length = total_length(each.paths)
        if short[body.layer - int(batch.marks.layer[0])] and 0 < length < body.length:
            body = replace(body, feed=body.feed * length / body.length)
        slowed.append(replace(each, body=body))
    return slowed


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
