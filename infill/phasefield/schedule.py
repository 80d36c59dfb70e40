"""Schedule of refining: the steps of a run with momentum that enter the three filters, with their weights.

See `infill.phasefield.refining` for the scheme and the polynomials T_k.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError

# The steps at which a snapshot is taken, in quarters of `Smoothing.steps`, and which of them go into the mild, the
# middle and the strong filter: two snapshots cancel x, three cancel x² as well. Filters share snapshots, and all of
# them share one run.
SNAPSHOT_QUARTERS = (1, 2, 3, 5, 7, 13)
FILTERS = ((0, 1), (2, 3, 4), (4, 5))
MOMENTUM = 0.5  # after half of `Smoothing.steps`: for long waves, a step then counts 1 / (1 - 1/2), twice as much
MIN_STEPS = 4  # steps: with fewer, two of the six would coincide


@dataclass(frozen=True, kw_only=True)
class Schedule:
    """Number of steps, and the weights of snapshots in each filter.

    Parameters
    ----------
    plain : int
        Steps without momentum.
    weights : per filter, dict of int to float
        The share of the field after each number of steps.
    """

    plain: int
    weights: tuple[dict[int, float], ...]

    @classmethod
    def of(cls, steps: int) -> Schedule:
        """Return the schedule that corresponds to a number of plain steps.

        Raises
        ------
        ParameterError
            If there are fewer than 4 steps.

        >>> schedule = Schedule.of(20)
        >>> schedule.last, [list(weights) for weights in schedule.weights]
        (65, [[5, 10], [15, 25, 35], [35, 65]])
        >>> [round(weight, 4) for weight in schedule.weights[0].values()]
        [2.0, -1.0]
        """
        if steps < MIN_STEPS:
            raise ParameterError(f"refining was given {steps} steps; it takes at least {MIN_STEPS}, and 20 as a rule")
        snapshots = [int(steps * quarters / 4 + 0.5) for quarters in SNAPSHOT_QUARTERS]
        shares = _leading_coefficients(snapshots[-1], snapshots[1], max(len(indices) for indices in FILTERS))
        return cls(
            plain=snapshots[1],
            weights=tuple(
                _flat_weights({snapshots[n]: shares[snapshots[n], : len(indices)] for n in indices})
                for indices in FILTERS
            ),
        )

    @property
    def last(self) -> int:
        """Total number of steps."""
        return max(max(weights) for weights in self.weights)

    def momentum(self, step: int) -> float:
        """Return the share of the previous change that a step, counted from 0, goes on with: b."""
        return 0.0 if step < self.plain else MOMENTUM


def _leading_coefficients(steps: int, plain: int, powers: int) -> NDArray[np.float64]:
    """Return the lowest coefficients of T_k, what k steps do to a wave (not Chebyshev's), (steps + 1, powers)."""
    share = np.zeros((steps + 1, powers))
    share[0, 0] = 1
    previous = share[0]
    for k in range(steps):
        current, damped = share[k], np.append(0, share[k, :-1])
        share[k + 1] = current - damped + (0 if k < plain else MOMENTUM) * (current - previous)
        previous = current
    return share


def _flat_weights(shares: dict[int, NDArray[np.float64]]) -> dict[int, float]:
    """Return the weights for which the sum of polynomials is 1 + O(x^n), n being their number."""
    powers = np.stack(list(shares.values()), axis=1)
    size = np.abs(powers).max(axis=1)
    target = np.zeros(len(powers))
    target[0] = 1
    solution = np.linalg.solve(powers / size[:, None], target / size)
    return dict(zip(shares, solution.tolist(), strict=True))
