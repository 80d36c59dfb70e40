"""The factor at which something that grows with it, about in proportion, is what it should be."""

from __future__ import annotations

import math
from collections.abc import Callable

LONGEST = 0.7  # step, in logarithms
GENTLE, STEEP = 0.2, 5.0  # slopes that a secant may have


def root(off: Callable[[float], float], good: float, tries: int) -> float:
    """Return the factor at which a logarithm is about 0, or the best of those tried.

    Parameters
    ----------
    off : callable
        Takes a factor, and returns the logarithm of what comes of it over what should. It grows with the factor, but
        may jump.
    good : float
        What counts as 0.
    tries : int

    Notes
    -----
    Steps of a secant in logarithms, from a factor of 1; once the root lies between two factors, steps that would leave
    these, and every step that follows one that gained little, go to the middle.

    >>> round(root(lambda times: math.log(times**1.5 / 3), 1e-6, 20), 4)
    2.0801
    """
    at, tried = 0.0, list[tuple[float, float]]()
    low, high = -math.inf, math.inf
    for _ in range(tries):
        now = off(math.exp(at))
        tried.append((at, now))
        if abs(now) <= good:
            break
        low, high = (max(low, at), high) if now < 0 else (low, min(high, at))
        slope = 1.0
        if len(tried) > 1 and at != tried[-2][0]:
            slope = (now - tried[-2][1]) / (at - tried[-2][0])
        at -= min(LONGEST, max(-LONGEST, now / (slope if GENTLE < slope < STEEP else 1.0)))
        little = len(tried) > 1 and abs(now) > abs(tried[-2][1]) / 2
        if math.isfinite(high - low) and (little or not low < at < high):
            at = (low + high) / 2
    return math.exp(min(tried, key=lambda each: abs(each[1]))[0])
