"""Seconds and filament of every layer of a print, batch by batch, and how much neighbours differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from infill.arrays import Floats
from infill.planner.lookahead import MotionPlan
from infill.planner.timeline import Steps


def neighbour_spread(values: Sequence[float] | Floats) -> float:
    """Return the standard deviation of the differences between neighbours; 0 for fewer than two.

    >>> neighbour_spread([3, 3, 3]), neighbour_spread([3, 5, 3, 5, 3])
    (0.0, 2.0)
    """
    return float(np.std(np.diff(values))) if len(values) > 1 else 0.0


@dataclass(kw_only=True)
class LayerSums:
    """Sums over the moves so far, one row for each layer; row 0 holds the moves before the first layer.

    Parameters
    ----------
    seconds : (N,) float64, s
    filament : (N,) float64, mm
        Without what is drawn back and primed.

    A layer begins at the slicer's mark and ends at the next, so it counts with the travel that leads to its first line,
    and the last layer with the moves that end the print.
    """

    seconds: Floats = field(default_factory=lambda: np.zeros(1))
    filament: Floats = field(default_factory=lambda: np.zeros(1))

    def add(self, steps: Steps, plan: MotionPlan) -> None:
        """Add moves that follow the previous ones."""
        if not len(steps):
            return
        delta = steps.moves.delta
        draws = (delta[:, 3] > 0) & (delta[:, :3] != 0).any(axis=1)
        seconds, filament = plan.seconds + steps.pause, np.where(draws, delta[:, 3], 0.0)
        rows = max(len(self.seconds), int(steps.layer.max()) + 1)
        self.seconds = np.pad(self.seconds, (0, rows - len(self.seconds)))
        self.filament = np.pad(self.filament, (0, rows - len(self.filament)))
        self.seconds += np.bincount(steps.layer, seconds, rows)
        self.filament += np.bincount(steps.layer, filament, rows)
