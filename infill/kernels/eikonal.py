"""Travel times on a grid, compiled: see `infill.paths.travel_times`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit


@njit(cache=True)
def sweep_times(times, known, delay, tolerance):
    """Lower the times of a grid in place, in four orders of its nodes, until no sweep lowers one by more than a limit.

    Parameters
    ----------
    times : (N, M) float64
        Infinite where nothing is known yet.
    known : (N, M) bool
        Nodes whose times stay.
    delay : (N, M) float64
        The time that a front takes from a node to the next one.
    tolerance : float
    """
    rows, columns = times.shape
    lowered = np.inf
    while lowered > tolerance:
        lowered = 0.0
        for order in range(4):
            for p in range(rows):
                i = p if order < 2 else rows - 1 - p
                for q in range(columns):
                    j = q if order % 2 == 0 else columns - 1 - q
                    if known[i, j]:
                        continue
                    a = min(times[i - 1, j] if i > 0 else np.inf, times[i + 1, j] if i + 1 < rows else np.inf)
                    b = min(times[i, j - 1] if j > 0 else np.inf, times[i, j + 1] if j + 1 < columns else np.inf)
                    if a == np.inf and b == np.inf:
                        continue
                    wait = delay[i, j]
                    if abs(a - b) < wait:
                        arrival = (a + b + np.sqrt(2 * wait * wait - (a - b) ** 2)) / 2
                    else:
                        arrival = min(a, b) + wait
                    if arrival < times[i, j]:
                        lowered = max(lowered, times[i, j] - arrival)
                        times[i, j] = arrival
