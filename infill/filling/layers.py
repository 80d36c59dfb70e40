"""A batch of layers refilled: which strokes change, what that saves, and the proof that nothing else did."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import Contact
from infill.filling.keeping import Rounding, first_moves, lengths, redrawn, rounded_strokes
from infill.filling.request import SAME, Request
from infill.filling.support import Sample
from infill.filling.timing import neutral_limits, path_seconds
from infill.gcode.sections import SPARSE, Marks, Strokes, strokes
from infill.gcode.splicing import UNIT, spliced, unlike
from infill.gcode.survey import Survey
from infill.gcode.table import State, Table

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

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
    before, after : Contact
        Of the layers that were looked at.
    """

    rounding: Rounding
    acceleration: float
    request: Request
    begin: State = field(default_factory=State)
    usual_speed: float = 0.0
    least_layer: float = 0.0
    resets_filament: bool = True
    before: Contact = field(default_factory=Contact)
    after: Contact = field(default_factory=Contact)

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
        )

    def with_deviation(self, deviation: float, before: Contact, after: Contact) -> Rules:
        """Return the rules with a deviation that was measured."""
        return replace(self, rounding=replace(self.rounding, deviation=deviation), before=before, after=after)


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
    smallest_radius: float = np.inf
    lines: list[tuple[int, bytes, float]] = field(default_factory=list)

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
    tool = table.before.tool
    tally.layers += int(marks.layer[-1] - (marks.layer[0] - (marks.tagged[0]))) if len(marks.layer) else 0
    tally.filament[tool] = tally.filament.get(tool, 0.0) + float(table.extruded.sum())
    infill = strokes(table, marks)
    sparse = marks.is_role(SPARSE)
    sections = np.unique(marks.section[sparse & (table.extruded > 0)])
    tally.sections += len(sections)
    if not len(infill):
        if len(sections):
            _count(tally, "no plain moves", len(sections))
        return table.data, tally
    opens = first_moves(infill)
    section = marks.section[opens]
    new = rounded_strokes(table, marks, infill, rules.rounding, acceleration=rules.acceleration)
    speed = np.maximum(table.f[opens] / 60, 1.0)
    commanded = marks.acceleration[opens]
    acceleration = np.where(np.isnan(commanded), rules.acceleration, commanded)
    limits = neutral_limits()
    before = path_seconds(infill.points, infill.first, speed, acceleration, limits)
    after = path_seconds(new.points, new.first, speed, acceleration, limits)
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
    tally.infill_filament += float(infill.filament.sum())
    tally.infill_filament_after += float(infill.filament.sum()) - saved
    tally.change[tool] = tally.change.get(tool, 0.0) - saved
    _count_corners(infill, changed, new.radius, tally)
    return done.text, tally


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
    radius = radius[: len(bent)] if len(radius) == len(bent) else radius
    found = radius[(radius > 0) & np.isfinite(radius)]
    tally.corners += len(found)
    tally.smallest_radius = min(tally.smallest_radius, float(found.min(initial=np.inf)))


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
    reasons["slowed down to cool"] = _slowed(table, marks, layer, table.f[opens], rules)
    ends = np.stack([infill.points[infill.first[:-1]], infill.points[infill.first[1:] - 1]])
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
    x = np.diff(table.x, prepend=table.before.x)
    y = np.diff(table.y, prepend=table.before.y)
    seconds = np.nan_to_num(np.hypot(x, y) / (table.f / 60))
    number = marks.layer - marks.layer[0]
    each = np.bincount(number, weights=seconds)
    # Rounding takes a tenth of the length of the infill at most.
    short = each * 0.9 < rules.least_layer
    found: NDArray[np.bool_] = slowed | short[layer - marks.layer[0]]
    return found
