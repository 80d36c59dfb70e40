"""Sums over a print, feature by feature: seconds, lengths, paths, turns. Any size of file fits."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.planner.bounds import row_lengths
from infill.planner.lookahead import MotionPlan
from infill.planner.timeline import Steps

SHARP_TURN: Final = np.radians(30)  # a turn that counts
SHORT_SEGMENT: Final = 0.1  # mm: a segment that counts as short; its flow is rounded by the file's digits
# Lengths are counted in bins of 1.2 %, 200 a decade, from 1 µm to 1 m.
DECADE: Final = 200
LOWEST, HIGHEST = -3, 3
BINS: Final = DECADE * (HIGHEST - LOWEST)
SUMS: Final = (
    "seconds",
    "drawing",
    "filament",
    "length",
    "segments",
    "short",
    "paths",
    "retractions",
    "travel",
    "turns",
    "turning",
)


@dataclass(kw_only=True)
class FeatureSums:
    """Sums over the moves so far, one row per feature.

    Parameters
    ----------
    times_only : bool
        Sum up seconds, travel and retractions, without the shape of paths.

    A move that draws pushes filament along a path. Travel, retraction and pause before it count for its feature, since
    they lead to it. A path is a run of moves that draw for one feature.
    """

    times_only: bool = False
    sums: Floats = field(default_factory=lambda: np.zeros((1, len(SUMS))))
    lengths: NDArray[np.int64] = field(default_factory=lambda: np.zeros((1, BINS), dtype=np.int64))
    flow: Floats = field(default_factory=lambda: np.zeros(1))  # mm³/s, at most
    # Sums until the next move that draws: seconds, travel, retractions.
    leading: Floats = field(default_factory=lambda: np.zeros(3))
    last: Floats = field(default_factory=lambda: np.zeros(5))  # direction, feature, whether it drew
    drew_back: bool = False

    def add(self, steps: Steps, plan: MotionPlan) -> None:
        """Add moves that follow the previous ones."""
        if not len(steps):
            return
        delta = steps.moves.delta
        pushed, feature = delta[:, 3], steps.feature
        self._widen(int(feature.max()) + 1)
        distance = row_lengths(delta[:, :3])
        draws = (pushed > 0) & (distance > 0)
        back = pushed < 0
        begins_back = back & ~np.concatenate([[self.drew_back], back[:-1]])
        self.drew_back = bool(back[-1])
        seconds = plan.seconds + steps.pause
        retracts = begins_back + steps.retractions
        self._count_leading_moves(draws, feature, seconds, np.where(pushed > 0, 0.0, distance), retracts)
        if self.times_only:
            for name, values in (("seconds", seconds), ("retractions", steps.retractions)):
                self._sum(name, feature[draws], values[draws])
            self.last[3] = feature[-1]
            return
        along, length, pushed, at = delta[draws, :3], distance[draws], pushed[draws], feature[draws]
        joined = self._continues_path(draws, feature)
        direction = along / length[:, None]
        before = np.vstack([self.last[:3], direction])[:-1]
        turn = np.where(joined, _angles_between(before, direction), 0.0)
        columns = {
            "seconds": seconds[draws],
            "drawing": plan.seconds[draws],
            "filament": pushed,
            "length": length,
            "segments": np.ones(len(at)),
            "short": length < SHORT_SEGMENT,
            "paths": ~joined,
            "retractions": steps.retractions[draws],
            "turns": turn > SHARP_TURN,
            "turning": turn,
        }
        for name, values in columns.items():
            self._sum(name, at, values)
        place = np.clip((np.log10(length) - LOWEST) * DECADE, 0, BINS - 1).astype(np.intp)
        self.lengths += np.bincount(at * BINS + place, minlength=self.lengths.size).reshape(self.lengths.shape)
        certain = length >= SHORT_SEGMENT
        np.maximum.at(self.flow, at[certain], (pushed * steps.section[draws] / length * plan.peak[draws])[certain])
        if len(at):
            self.last[:3] = direction[-1]
        self.last[3:] = feature[-1], draws[-1]

    def finish(self, pause: float, retractions: int = 0) -> None:
        """Count moves after the last drawing one, a final pause and retraction, for the feature in force at the end."""
        self.leading += [pause, 0, retractions]
        self._count(np.array([int(self.last[3])]), self.leading[None])
        self.leading[:] = 0

    def total(self, name: str) -> Floats:
        """Return one of `SUMS` for every feature."""
        return self.sums[:, SUMS.index(name)]

    def median_length(self, feature: int) -> float | None:
        """Return the median length of the segments of a feature, mm, to 0.6 %; None if it has none."""
        counts = np.cumsum(self.lengths[feature])
        if not counts[-1]:
            return None
        place = int(np.searchsorted(counts, (counts[-1] + 1) / 2))
        return float(10 ** ((place + 0.5) / DECADE + LOWEST))

    def _widen(self, rows: int) -> None:
        """Add rows of zeros until there is one for each feature."""
        more = rows - len(self.sums)
        if more > 0:
            self.sums = np.pad(self.sums, ((0, more), (0, 0)))
            self.lengths = np.pad(self.lengths, ((0, more), (0, 0)))
            self.flow = np.pad(self.flow, (0, more))

    def _count_leading_moves(
        self,
        draws: NDArray[np.bool_],
        feature: NDArray[np.intp],
        seconds: Floats,
        travel: Floats,
        back: NDArray[np.intp],
    ) -> None:
        """Count moves that do not draw for the feature of the next one that does."""
        number = np.arange(len(draws))
        following = np.minimum.accumulate(np.where(draws, number, len(draws))[::-1])[::-1]
        leads = ~draws & (following < len(draws))
        waits = ~draws & (following == len(draws))
        rows = np.column_stack([seconds, travel, back])
        if draws.any():
            self._count(feature[draws][:1], self.leading[None])
            self.leading[:] = 0
        self._count(feature[following[leads]], rows[leads])
        self.leading += rows[waits].sum(axis=0)

    def _count(self, feature: NDArray[np.intp], rows: Floats) -> None:
        """Add seconds, travel and retractions of moves to those of their features."""
        for name, values in zip(("seconds", "travel", "retractions"), rows.T, strict=True):
            self._sum(name, feature, values)

    def _sum(self, name: str, feature: NDArray[np.intp], values: NDArray[Any]) -> None:
        """Add values to one column, each in the row of its feature."""
        self.sums[:, SUMS.index(name)] += np.bincount(feature, weights=values, minlength=len(self.sums))

    def _continues_path(self, draws: NDArray[np.bool_], feature: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Return, for the moves that draw, True if a move continues the path of the previous move."""
        drew = np.concatenate([[bool(self.last[4])], draws[:-1]])
        same = np.concatenate([[int(self.last[3])], feature[:-1]]) == feature
        return np.asarray((drew & same)[draws])


def _angles_between(before: Floats, after: Floats) -> Floats:
    """Return the angles between unit vectors, rad, exact for small ones."""
    return np.asarray(2 * np.arctan2(np.linalg.norm(after - before, axis=1), np.linalg.norm(after + before, axis=1)))
