"""The factor at which a quantity, roughly proportional to it, reaches its target."""

from __future__ import annotations

import math
from collections.abc import Callable

LONGEST = 0.7  # step, in logarithms
GENTLE, STEEP = 0.2, 5.0  # slopes that a secant may have


def find_root(log_error: Callable[[float], float], good: float, tries: int) -> float:
    """Find the factor at which a logarithm is nearly 0; return the best factor that was tried.

    Parameters
    ----------
    log_error : callable
        Takes a factor, and returns the logarithm of the result over its target. It grows with the factor, but may jump.
    good : float
        Error that is good enough.
    tries : int

    Notes
    -----
    Steps of a secant in logarithms, from a factor of 1; once the root lies between two factors, steps that would leave
    these, and every step that follows one that gained little, go to the middle.

    >>> round(find_root(lambda times: math.log(times**1.5 / 3), 1e-6, 20), 4)
    2.0801
    """
    exponent, attempts = 0.0, list[tuple[float, float]]()
    low, high = -math.inf, math.inf
    for _ in range(tries):
        error = log_error(math.exp(exponent))
        attempts.append((exponent, error))
        if abs(error) <= good:
            break
        low, high = (max(low, exponent), high) if error < 0 else (low, min(high, exponent))
        slope = 1.0
        if len(attempts) > 1 and exponent != attempts[-2][0]:
            slope = (error - attempts[-2][1]) / (exponent - attempts[-2][0])
        exponent -= min(LONGEST, max(-LONGEST, error / (slope if GENTLE < slope < STEEP else 1.0)))
        gained_little = len(attempts) > 1 and abs(error) > abs(attempts[-2][1]) / 2
        if math.isfinite(high - low) and (gained_little or not low < exponent < high):
            exponent = (low + high) / 2
    return math.exp(min(attempts, key=lambda attempt: abs(attempt[1]))[0])
