"""A batch of layers refilled: which strokes change, what that saves, and the proof that nothing else did."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import Contact
from infill.filling.covering import total_length
from infill.filling.keeping import Rounding, first_moves, lengths, line_width, redrawn, rounded_strokes
from infill.filling.measuring import MEASURED, Below, Drawing, drawing, measured
from infill.filling.replacing import Fresh, Memory, Plan, fresh_sections, outside, retractions
from infill.filling.request import SAME, Request
from infill.filling.support import Sample
from infill.filling.surroundings import beads
from infill.filling.timing import neutral_limits, path_seconds
from infill.gcode.bodies import composed, exchanged, unlawful, ways_of
from infill.gcode.limits import Limits
from infill.gcode.sections import SPARSE, Marks, Strokes, strokes
from infill.gcode.splicing import UNIT, differing, spliced, unlike
from infill.gcode.survey import Survey
from infill.gcode.table import State, Table, read

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

LEAST_RADIUS = 0.02  # mm: below this a corner beside a wall was hardly touched
LEAST_TRAVEL = 1.0  # mm: shorter ways are never retracted
SHORT_LAYER = 15.0  # s: shorter layers may have been slowed down to cool, whatever the file tells
SLOWER = 1.01  # a stroke that takes longer than this share of its old time keeps its corners
SLOWED = 0.97  # a layer whose infill is slower than this share of the usual was slowed down to cool


@dataclass(frozen=True, kw_only=True)
class Rules:
    """How every batch is refilled.

    Parameters
    ----------
    rounding : Rounding
    acceleration : float, mm/s²
        Where the print commands none.
    request : Request
    begin : State
        Before the first line.
    usual_speed : float, mm/min
        Of the infill in most layers; 0 if it is not known.
    least_layer : float, s
        A layer that would take less is left as it is.
    resets_filament : bool
        The print sets its counter of filament by G92, so that we may.
    stride : int
        Every so-many-th layer is measured.
    plan : Plan, optional
        Paths of our own; without it, the slicer's are kept.
    memory : Memory
        What one batch leaves for the next.
    limits : Limits
        What paths are timed with.
    """

    rounding: Rounding
    acceleration: float
    request: Request
    begin: State = field(default_factory=State)
    usual_speed: float = 0.0
    least_layer: float = 0.0
    resets_filament: bool = True
    stride: int = 1
    plan: Plan | None = None
    memory: Memory = field(default_factory=Memory)
    limits: Limits = field(default_factory=neutral_limits)

    def with_survey(self, found: Survey, some: list[Sample]) -> Rules:
        """Return the rules with what a survey tells."""
        speeds = [sample.table.f[first_moves(sample.infill)] for sample in some]
        cooled = found.settings.get("cooling", "1") != "0"
        least = found.number("slowdown_below_layer_time", "slow_down_layer_time") if cooled else 0.0
        return replace(
            self,
            usual_speed=float(np.median(np.concatenate(speeds))) if speeds else 0.0,
            least_layer=least or 0.0,
            resets_filament=found.resets_filament,
            stride=max(1, round(found.layers / MEASURED)),
        )

    def with_plan(self, plan: Plan) -> Rules:
        """Return the rules with paths of our own."""
        return replace(self, plan=plan)

    def with_deviation(self, deviation: float) -> Rules:
        """Return the rules with a deviation that was measured."""
        return replace(self, rounding=replace(self.rounding, deviation=deviation))


@dataclass(kw_only=True)
class Histogram:
    """How often lengths occur, by tenths of an octave from a micrometre to a metre: it does not grow."""

    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(200, dtype=np.int64))

    def add(self, lengths: Floats) -> None:
        """Count some lengths, mm."""
        place = np.clip(10 * np.log2(np.maximum(lengths, 1e-3) / 1e-3), 0, len(self.counts) - 1)
        self.counts += np.bincount(place.astype(np.intp), minlength=len(self.counts))

    def report(self) -> dict[str, float] | None:
        """Return the lengths that 1, 50 and 99 % do not reach, to a fifteenth, mm."""
        total = np.cumsum(self.counts)
        if not total[-1]:
            return None
        places = np.searchsorted(total, np.array([0.01, 0.5, 0.99]) * total[-1])
        return {
            name: round(float(1e-3 * 2 ** ((place + 0.5) / 10)), 4)
            for name, place in zip(("smallest_hundredth", "median", "largest_hundredth"), places, strict=True)
        }


@dataclass(kw_only=True)
class Tally:
    """What was done so far: sums over batches."""

    sections: int = 0
    replaced: int = 0
    kept: dict[str, int] = field(default_factory=dict)
    layers: int = 0
    seconds: float = 0.0
    seconds_after: float = 0.0
    length: float = 0.0
    length_after: float = 0.0
    filament: dict[int, float] = field(default_factory=dict)
    change: dict[int, float] = field(default_factory=dict)
    infill_filament: float = 0.0
    infill_filament_after: float = 0.0
    corners: int = 0
    radii: Histogram = field(default_factory=Histogram)
    lines: list[tuple[int, bytes, float]] = field(default_factory=list)
    before: Contact = field(default_factory=Contact)
    after: Contact = field(default_factory=Contact)
    below: Below | None = None

    @property
    def saved(self) -> float:
        """Seconds."""
        return self.seconds - self.seconds_after

    @property
    def filament_ratio(self) -> float:
        """Filament of the whole print, after over before."""
        whole = sum(self.filament.values())
        return 1 + sum(self.change.values()) / whole if whole > 0 else 1.0

    @property
    def tool_ratios(self) -> tuple[float, ...]:
        """The same by tool."""
        tools = range(max(self.filament, default=-1) + 1)
        return tuple(
            1 + self.change.get(tool, 0.0) / self.filament[tool] if self.filament.get(tool, 0.0) > 0 else 1.0
            for tool in tools
        )


def refilled_batch(table: Table, marks: Marks, rules: Rules, tally: Tally) -> tuple[bytes, Tally]:
    """Return the new text of a batch of whole layers, and the tally with what was done added to it."""
    tools = _tools(table)
    tally.layers += int(marks.layer[-1] - (marks.layer[0] - (marks.tagged[0]))) if len(marks.layer) else 0
    _add(tally.filament, tools, table.extruded)
    infill = strokes(table, marks)
    rules.memory.ways = ways_of(table, rules.memory.ways)
    sparse = marks.is_role(SPARSE)
    sections = np.unique(marks.section[sparse & (table.extruded > 0)])
    tally.sections += len(sections)
    if not len(infill):
        if len(sections):
            _count(tally, "no plain moves", len(sections))
        return table.data, tally
    if rules.plan is not None:
        return _replaced(table, marks, infill, rules, tally, tools)
    opens = first_moves(infill)
    section = marks.section[opens]
    _count(tally, "no plain moves", len(np.setdiff1d(sections, section)))
    new = rounded_strokes(table, marks, infill, rules.rounding, acceleration=rules.acceleration)
    speed, acceleration = table.f[opens] / 60, _accelerations(marks, opens, rules)
    before = _seconds(infill.points, infill.first, speed, acceleration, rules)
    after = _seconds(new.points, new.first, speed, acceleration, rules)
    chosen, reasons = _chosen(table, marks, infill, rules, after <= before * SLOWER)
    anew = redrawn(infill, new, chosen, rules.rounding)
    done = spliced(table, infill, anew)
    wrong = unlike(table, infill, anew, done)
    if wrong:
        _count(tally, f"a check failed: {wrong}", len(sections))
        return _nothing(table, infill, before, tally)
    changed = np.zeros(len(infill), dtype=bool)
    changed[anew.which] = True
    touched = np.unique(section[changed])
    tally.replaced += len(touched)
    for reason, which in reasons.items():
        left = np.setdiff1d(np.unique(section[which]), touched)
        _count(tally, reason, len(left))
    tally.seconds += float(before.sum())
    tally.seconds_after += float(np.where(changed, after, before).sum())
    length = lengths(new.points, new.first)
    tally.length += float(infill.length.sum())
    tally.length_after += float(np.where(changed, length, infill.length).sum())
    saved = float(infill.filament[changed].sum() - anew.filament.sum())
    _add(tally.change, tools[opens[anew.which]], anew.filament - infill.filament[anew.which])
    tally.infill_filament += float(infill.filament.sum())
    tally.infill_filament_after += float(infill.filament.sum()) - saved
    _count_corners(infill, changed, new.radius, tally)
    drawn = Drawing(points=new.points, first=new.first, layer=marks.layer[opens])
    _measure(table, marks, infill, _mixed(infill, drawn, changed), rules, tally)
    return done.text, tally


def _mixed(infill: Strokes, new: Drawing, changed: NDArray[np.bool_]) -> Drawing:
    """Return the new paths of the strokes that changed, and the old ones of the others."""
    paths = [
        new.points[new.first[k] : new.first[k + 1]]
        if changed[k]
        else infill.points[infill.first[k] : infill.first[k + 1]]
        for k in range(len(infill))
    ]
    return drawing(paths, new.layer.tolist())


def _measure(table: Table, marks: Marks, infill: Strokes, new: Drawing, rules: Rules, tally: Tally) -> None:
    """Add what some layers of a batch are held up by."""
    opens = first_moves(infill)
    old = Drawing(points=infill.points, first=infill.first, layer=marks.layer[opens])
    before, after, tally.below = measured(
        old,
        new,
        beads(table, marks, infill),
        np.unique(marks.layer),
        line_width=float(np.median(line_width(marks, opens))),
        stride=rules.stride,
        last=tally.below,
    )
    tally.before += before
    tally.after += after


def _replaced(
    table: Table, marks: Marks, infill: Strokes, rules: Rules, tally: Tally, tools: Places
) -> tuple[bytes, Tally]:
    """Return the text of a batch with paths of our own."""
    plan, ways = rules.plan, rules.memory.ways
    assert plan is not None
    opens = first_moves(infill)
    before = _seconds(infill.points, infill.first, table.f[opens] / 60, _accelerations(marks, opens, rules), rules)
    fresh, reasons = fresh_sections(table, marks, infill, plan, rules.memory, rules.acceleration)
    may, why = _chosen(table, marks, infill, rules, np.ones(len(infill), dtype=bool))
    for reason, which in why.items():
        sections = np.unique(marks.section[opens[which]])
        _count(tally, reason, len(sections))
    fresh = [each for each in fresh if may[each.body.strokes].all()]
    for reason, number in reasons.items():
        _count(tally, reason, number)
    within = [each for each in fresh if not outside(each)]
    _count(tally, "a path would leave its region", len(fresh) - len(within))
    fresh = within
    if not fresh:
        return _nothing(table, infill, before, tally)
    fresh = _unhurried(table, marks, fresh, rules)
    texts, filament = [], []
    for each in fresh:
        text, pushed, _ = composed(table, each.body, each.paths, each.rate, ways, retractions(each, LEAST_TRAVEL))
        texts.append(text)
        filament.append(pushed)
    done = exchanged(table, [each.body for each in fresh], texts)
    other = read(done.text, table.before)
    wrong = differing(table, other, done) or unlawful(other, done, [each.body for each in fresh], texts)
    if wrong:
        _count(tally, f"a check failed: {wrong}", len(fresh))
        return _nothing(table, infill, before, tally)
    tally.replaced += len(fresh)
    for radius in rules.memory.radii:
        _count_radii(radius, tally)
    rules.memory.radii.clear()
    changed = np.zeros(len(infill), dtype=bool)
    for each in fresh:
        changed[each.body.strokes] = True
    tally.seconds += float(before.sum())
    tally.length += float(infill.length.sum())
    tally.infill_filament += float(infill.filament.sum())
    tally.seconds_after += float(before[~changed].sum())
    tally.length_after += float(infill.length[~changed].sum())
    for each in fresh:
        if not each.paths:
            continue
        first = np.concatenate([[0], np.cumsum([len(path) for path in each.paths])])
        points = np.concatenate(each.paths)
        speed = np.full(len(each.paths), each.body.feed / 60)
        acceleration = np.full(len(each.paths), _accelerations(marks, np.array([each.body.first]), rules)[0])
        tally.seconds_after += float(_seconds(points, first, speed, acceleration, rules).sum())
        tally.length_after += float(lengths(points, first).sum())
    tally.infill_filament_after += float(infill.filament[~changed].sum()) + sum(filament)
    kept = np.flatnonzero(~changed)
    paths = [infill.points[infill.first[k] : infill.first[k + 1]] for k in kept]
    layer = marks.layer[opens[kept]].tolist()
    for each in fresh:
        paths += each.paths
        layer += [each.body.layer] * len(each.paths)
    _measure(table, marks, infill, drawing(paths, layer), rules, tally)
    first = np.array([each.body.first for each in fresh])
    _add(tally.change, tools[first], np.array(filament) - np.array([each.body.filament for each in fresh]))
    return done.text, tally


def _unhurried(table: Table, marks: Marks, fresh: list[Fresh], rules: Rules) -> list[Fresh]:
    """Slow down new paths that are shorter than the old ones, in layers that may be as short as cooling allows."""
    short = _layer_seconds(table, marks) < max(SHORT_LAYER, rules.least_layer)
    slowed = []
    for each in fresh:
        body = each.body
        length = total_length(each.paths)
        if short[body.layer - int(marks.layer[0])] and 0 < length < body.length:
            body = replace(body, feed=body.feed * length / body.length)
        slowed.append(replace(each, body=body))
    return slowed


def _accelerations(marks: Marks, line: Places, rules: Rules) -> Floats:
    commanded = marks.acceleration[line]
    return np.where(np.isnan(commanded), rules.acceleration, commanded)


def _seconds(points: Floats, first: Places, speed: Floats, acceleration: Floats, rules: Rules) -> Floats:
    return path_seconds(points, first, np.maximum(speed, 1.0), acceleration, rules.limits)


def _tools(table: Table) -> Places:
    """Return the tool in use on every line."""
    tools = np.full(len(table), table.before.tool)
    for command in table.commands:
        if command.code[:1] == "T" and command.code[1:].isdigit():
            tools[command.line :] = int(command.code[1:])
    return tools


def _add(sums: dict[int, float], tools: Places, values: Floats) -> None:
    """Add values to the sums of their tools."""
    for tool in np.unique(tools).tolist():
        sums[tool] = sums.get(tool, 0.0) + float(values[tools == tool].sum())


def _nothing(table: Table, infill: Strokes, before: Floats, tally: Tally) -> tuple[bytes, Tally]:
    """Return a batch as it was."""
    tally.seconds += float(before.sum())
    tally.seconds_after += float(before.sum())
    for name in ("length", "length_after"):
        setattr(tally, name, getattr(tally, name) + float(infill.length.sum()))
    for name in ("infill_filament", "infill_filament_after"):
        setattr(tally, name, getattr(tally, name) + float(infill.filament.sum()))
    return table.data, tally


def _count(tally: Tally, reason: str, number: int) -> None:
    if number:
        tally.kept[reason] = tally.kept.get(reason, 0) + number


def _count_corners(infill: Strokes, changed: NDArray[np.bool_], radius: Floats, tally: Tally) -> None:
    bent = np.repeat(changed, np.diff(infill.first))
    _count_radii(radius[bent], tally)


def _count_radii(radius: Floats, tally: Tally) -> None:
    found = radius[(radius > LEAST_RADIUS) & np.isfinite(radius)]
    tally.corners += len(found)
    tally.radii.add(found)


def _chosen(
    table: Table, marks: Marks, infill: Strokes, rules: Rules, faster: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], dict[str, NDArray[np.bool_]]]:
    """Return which strokes may change, and for those that may not, why."""
    opens = first_moves(infill)
    layer = marks.layer[opens]
    reasons: dict[str, NDArray[np.bool_]] = {}
    if rules.request.layers is not None:
        low, high = rules.request.layers
        reasons["not among the layers asked for"] = (layer < low) | (layer > high)
    if rules.request.part is not None:
        wanted = [number for number, name in marks.names.items() if rules.request.part in name]
        reasons["another object"] = ~np.isin(marks.section[opens], wanted)
    reasons["slowed down to cool"] = _slowed(table, marks, layer, table.f[opens], rules)
    ends = np.stack([infill.points[infill.first[:-1]], infill.points[infill.first[1:] - 1]])
    last = infill.line[infill.first[1:] - 1] == len(table) - 1
    reasons["cut off by the end of the file"] = last & (not table.data.endswith(b"\n"))
    reasons["finer numbers than a micrometre"] = np.abs(ends / UNIT - np.rint(ends / UNIT)).max(axis=(0, 2)) > 1e-4
    if not rules.resets_filament and rules.request.density != SAME:
        reasons["a counter of filament that is never set"] = ~table.relative_e[opens]
    reasons["no faster"] = ~faster
    kept = np.zeros(len(infill), dtype=bool)
    for which in reasons.values():
        kept |= which
    return ~kept, reasons


def _slowed(table: Table, marks: Marks, layer: Places, speed: Floats, rules: Rules) -> NDArray[np.bool_]:
    """Return which strokes lie in layers that were slowed down to cool, or are as short as may be."""
    slowed = np.zeros(len(layer), dtype=bool)
    if not rules.least_layer:
        return slowed
    slowed |= speed < SLOWED * rules.usual_speed
    each = _layer_seconds(table, marks)
    # Rounding takes a tenth of the length of the infill at most.
    short = each * 0.9 < rules.least_layer
    found: NDArray[np.bool_] = slowed | short[layer - marks.layer[0]]
    return found


def _layer_seconds(table: Table, marks: Marks) -> Floats:
    """Return how long each layer of a table takes at its feed rates, without acceleration, as slicers reckon."""
    x = np.diff(table.x, prepend=table.before.x)
    y = np.diff(table.y, prepend=table.before.y)
    seconds = np.nan_to_num(np.hypot(x, y) / (table.f / 60))
    return np.bincount(marks.layer - marks.layer[0], weights=seconds).astype(np.float64)
