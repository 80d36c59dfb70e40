"""Draw a print again so that its layers take even time or filament."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from infill.arrays import Floats
from infill.refilling.even_layers import (
    LEAST_WIDTH,
    MOST_TIMES_SLOWER,
    MOST_WIDTH,
    LayerShares,
    LayerSteps,
    choose_shares,
    next_paces,
)
from infill.refilling.planning import RefillPlan
from infill.refilling.request import TIME, VOLUME
from infill.refilling.stats import RefillStats

TOLERANCE = 0.02  # share of the wanted changes that may be missed
REDRAWS = {TIME: 4, VOLUME: 1}  # curves are driven slower than the speed allows: the time changes less than it does


@dataclass(frozen=True, kw_only=True)
class EvenDrawing:
    """How a print is drawn and measured, to even out its layers.

    Parameters
    ----------
    by : str
        TIME or VOLUME.
    leeway : float
        Largest share by which infill may take more time, or more or less filament.
    draw : callable
        Draws the print by a plan.
    measure : callable
        Returns seconds or mm of every layer of the last drawing, (N,), from the first layer on.
    section : float
        Of the filament, mm², where the print counts it in mm³; else 1.
    """

    by: str
    leeway: float
    draw: Callable[[RefillPlan], RefillStats]
    measure: Callable[[], Floats]
    section: float = 1.0

    def even_out(self, stats: RefillStats, plan: RefillPlan, sliced: Floats) -> RefillStats:
        """Draw a print again with even layers; return its statistics, with the steps between layers before and after.

        Parameters
        ----------
        stats : RefillStats
            Of the last drawing, by `plan`.
        plan : RefillPlan
        sliced : (N,) float64, s or mm
            Of every layer as sliced.
        """
        before = self.measure()
        gain, low, high = self._find_leeway(stats, len(before))
        pairs = (gain[1:] > 0) & (gain[:-1] > 0)
        shares = choose_shares(before, gain, low, high, keeps_sum=self.by == VOLUME)
        wanted = gain * (shares - 1)
        best, after, current, least_error = plan, before, plan, float(np.abs(wanted).sum())
        drawings: list[tuple[Floats, Floats]] = []
        tolerance = TOLERANCE * least_error
        if self.by == TIME:
            shares[wanted > 0] = MOST_TIMES_SLOWER
        for _ in range(REDRAWS[self.by] if pairs.any() else 0):
            chosen = {layer + 1: float(shares[layer]) for layer in np.flatnonzero(gain > 0).tolist()}
            current = replace(plan, even=LayerShares(by=self.by, shares=chosen))
            stats = self.draw(current)
            measured = self.measure()
            error = float(np.abs(measured - before - wanted)[gain > 0].sum())
            if error < least_error:
                best, after, least_error = current, measured, error
            if error <= tolerance:
                break
            drawings.append((shares, measured - before))
            shares = next_paces(drawings, wanted)
        drawn = stats if best is current else self.draw(best)
        steps = [np.diff(values)[pairs].tolist() for values in (sliced, before, after)]
        drawn.steps = LayerSteps(sliced=steps[0], before=steps[1], after=steps[2])
        return drawn

    def _find_leeway(self, stats: RefillStats, layers: int) -> tuple[Floats, Floats, Floats]:
        """Return seconds or mm of the new infill of every layer, and its least and largest share, (N,)."""
        gain, low, high = np.zeros(layers), np.ones(layers), np.ones(layers)
        for layer, (usual, filament, seconds) in stats.drawn.items():
            if self.by == TIME:
                gain[layer - 1], high[layer - 1] = seconds, 1 + self.leeway
            elif filament > 0:
                gain[layer - 1] = filament / self.section
                low[layer - 1] = min(max(1 - self.leeway, LEAST_WIDTH * usual / filament), 1)
                high[layer - 1] = max(min(1 + self.leeway, MOST_WIDTH * usual / filament), 1)
        return gain, low, high
