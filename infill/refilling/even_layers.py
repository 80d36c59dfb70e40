"""Even layers: the speed or bead width of the infill, chosen so that neighbours take alike time or filament.

An experiment. The paths stay as they are drawn without it: cells that differ from layer to layer would not lie on one
another. So filament is evened out by the width of beads, and time by the speed of the infill, which only ever falls.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from infill.arrays import Flags, Floats
from infill.gcode.strokes import read_strokes
from infill.planner.layer_sums import LayerSums
from infill.refilling.request import TIME, VOLUME

if TYPE_CHECKING:
    from infill.planner.lookahead import MotionPlan
    from infill.planner.timeline import Steps, Timeline
    from infill.reports.refilling import EvenKeys

UNITS = {TIME: "s", VOLUME: "mm"}
LEAST_WIDTH, MOST_WIDTH = 0.92, 1.08  # of the slicer's filament per mm, to meet the filament of a region
ROUNDS = 200  # of averaging with both neighbours: a Gaussian with a standard deviation of 10 layers
LEAST_GAIN = 0.5  # of the step between two layers that both together must be able to take away
MOST_TIMES_SLOWER = 2.0
# Of slowness, for the seconds that it adds: 1 for straight lines, more for curves, which are driven slower anyway.
FIRST_POWER, POWERS = 2.0, (1.0, 3.0)
LEAST, SURE = 1e-6, 0.02  # s or share, and logarithm of a ratio of shares
BISECTIONS = 50


@dataclass(frozen=True, kw_only=True)
class LayerShares:
    """Shares by which the infill of layers is slower, or its beads are wider or narrower.

    Parameters
    ----------
    by : str
        TIME or VOLUME.
    shares : mapping of int to float
        By layer; 1 for all others.
    """

    by: str
    shares: Mapping[int, float]

    def feed_rate(self, layer: int, feed: float) -> float:
        """Return the feed rate of the infill of a layer, mm/min."""
        return feed / self.shares.get(layer, 1.0) if self.by == TIME else feed

    def filament_rate(self, layer: int, rate: float, usual_rate: float) -> float:
        """Return the filament per mm of a layer, within the window around the slicer's."""
        if self.by != VOLUME:
            return rate
        return float(np.clip(rate * self.shares.get(layer, 1.0), LEAST_WIDTH * usual_rate, MOST_WIDTH * usual_rate))


@dataclass(frozen=True, kw_only=True)
class LayerSteps:
    """Differences between neighbouring layers with new infill, s or mm.

    Parameters
    ----------
    sliced, before, after : list of float
        As sliced; with the new infill; and with the new infill evened out.
    """

    sliced: list[float] = field(default_factory=list)
    before: list[float] = field(default_factory=list)
    after: list[float] = field(default_factory=list)

    def __add__(self, other: LayerSteps) -> LayerSteps:
        return LayerSteps(
            sliced=self.sliced + other.sliced, before=self.before + other.before, after=self.after + other.after
        )

    def report(self, by: str) -> EvenKeys:
        """Report the spread of the steps."""
        return {
            "unit": UNITS[by],
            "steps": len(self.after),
            "spread_sliced": _spread(self.sliced),
            "spread_before": _spread(self.before),
            "spread_after": _spread(self.after),
            "median_step_sliced": _median(self.sliced),
            "median_step_before": _median(self.before),
            "median_step_after": _median(self.after),
        }


def choose_shares(amounts: Floats, gain: Floats, low: Floats, high: Floats, *, keeps_sum: bool) -> Floats:
    """Choose the shares of the infill that bring every layer as near to its neighbours as its leeway lets it.

    In every round, each layer takes half of itself and a quarter of both neighbours, within its leeway. A step of which
    two layers cannot take half away stays, and so do layers without new infill.

    Parameters
    ----------
    amounts : (N,) float64, s or mm
        Of every layer.
    gain : (N,) float64
        Of the infill in it; 0 where it cannot change.
    low, high : (N,) float64
        Least and largest share of the infill.
    keeps_sum : bool
        Whether all layers together keep their amount, as far as the leeway allows.

    >>> amounts, infill = np.array([10.0, 10, 11, 10, 10]), np.full(5, 5.0)
    >>> choose_shares(amounts, infill, np.full(5, 0.9), np.full(5, 1.1), keeps_sum=True).round(2).tolist()
    [1.02, 1.03, 0.9, 1.03, 1.02]
    """
    least, most = amounts + gain * (low - 1), amounts + gain * (high - 1)
    changes = gain > 0
    joined = _joins_neighbours(amounts, least, most) & changes[1:] & changes[:-1]
    new = amounts.copy()
    for _ in range(ROUNDS):
        step = np.where(joined, np.diff(new), 0.0) / 4
        new = np.clip(new + np.append(step, 0.0) - np.append(0.0, step), least, most)
    if keeps_sum:
        new = _restore_sum(new, float(amounts.sum()), least, most)
    shares = np.ones(len(amounts))
    shares[changes] += (new - amounts)[changes] / gain[changes]
    return np.clip(shares, low, high)


def next_paces(drawn: Sequence[tuple[Floats, Floats]], wanted: Floats) -> Floats:
    """Return better paces of layers: how many times as slow as without evening out the infill should be.

    The seconds that a layer gains are taken as a power of its pace less 1, which the last two drawings give.

    Parameters
    ----------
    drawn : sequence of tuple of (N,) float64
        Of every drawing, the paces, from 1, and what the layers took longer, s.
    wanted : (N,) float64, s
        What they should take longer.

    >>> next_paces([(np.array([2.0, 2, 1]), np.array([4.0, 1, 0]))], np.array([1.0, 3, 0])).tolist()
    [1.5, 2.0, 1.0]
    """
    paces, gained = drawn[-1]
    slower, power = (paces > 1) & (wanted > 0), np.full(len(paces), FIRST_POWER)
    if len(drawn) > 1:
        longer = np.log(np.maximum(gained, LEAST) / np.maximum(drawn[-2][1], LEAST))
        further = np.log(np.maximum(paces - 1, LEAST) / np.maximum(drawn[-2][0] - 1, LEAST))
        power = np.divide(longer, further, out=power, where=np.abs(further) > SURE)
    ratio = np.divide(wanted, np.maximum(gained, LEAST), out=np.ones(len(paces)), where=slower)
    return np.asarray(np.clip(1 + (paces - 1) * ratio ** (1 / np.clip(power, *POWERS)), 1, MOST_TIMES_SLOWER))


def measure_layers_of(timeline: Timeline, text: BinaryIO, by: str) -> Floats:
    """Measure the seconds or the filament, mm, of every layer of a print, (N,), by its marks as `refill` counts them.

    Parameters
    ----------
    timeline : Timeline
        Of the text, not read yet.
    text : binary file
    by : str
        TIME or VOLUME.
    """
    sums, places, begin, layers = LayerSums(), np.empty(0, dtype=np.intp), 0, 0

    def count(steps: Steps, plan: MotionPlan) -> None:
        sums.add(replace(steps, layer=np.searchsorted(places, steps.place, side="right")), plan)

    text.seek(0)
    for table, marks, _ in read_strokes(text, timeline.state):
        layer = np.append(layers, marks.layer)
        places = np.append(places, begin + table.start[np.flatnonzero(np.diff(layer))])
        begin, layers = begin + len(table.data), int(layer[-1])
        count(*timeline.follow(table))
    count(*timeline.rest())
    amounts = sums.seconds if by == TIME else sums.filament
    return np.asarray(np.pad(amounts, (0, max(layers + 1 - len(amounts), 0)))[1:])


def _joins_neighbours(amounts: Floats, least: Floats, most: Floats) -> Flags:
    """Tell for each step between layers, (N - 1,), whether their leeways can take enough of it away."""
    rest = np.maximum(least[1:] - most[:-1], least[:-1] - most[1:])
    return np.asarray(rest <= (1 - LEAST_GAIN) * np.abs(np.diff(amounts)))


def _restore_sum(values: Floats, total: float, least: Floats, most: Floats) -> Floats:
    """Shift all values by one amount, within their limits, so that their sum comes as near to a total as it can."""
    reach = float(np.ptp(np.concatenate([least, most]))) or 1.0
    below, above = -reach, reach
    for _ in range(BISECTIONS):
        shift = (below + above) / 2
        is_less = np.clip(values + shift, least, most).sum() < total
        below, above = (shift, above) if is_less else (below, shift)
    return np.clip(values + (below + above) / 2, least, most)


def _spread(steps: list[float]) -> float:
    """Return the standard deviation, 0 for no steps."""
    return float(np.std(steps)) if steps else 0.0


def _median(steps: list[float]) -> float:
    """Return the median size, 0 for no steps."""
    return float(np.median(np.abs(steps))) if steps else 0.0
