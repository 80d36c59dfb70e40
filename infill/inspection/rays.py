"""Rays followed until they leave the solid, in any number of dimensions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def way_inside(
    value: Callable[[Floats], NDArray[np.floating]],
    start: Floats,
    direction: Floats,
    distance: Floats,
    *,
    leeway: int = 0,
) -> Floats:
    """Return the length of solid along rays, (N,) mm.

    Parameters
    ----------
    value : callable
        Maps points (M, d), mm, to values above 0 where they are solid.
    start, direction : (N, d) float64
        Where the rays begin, mm, and unit vectors.
    distance : (n,) float64
        Positions to sample along a ray, mm, rising evenly from less than a step.
    leeway : int
        How many of those positions after the first a ray may still enter the solid.

    Returns
    -------
    (N,) float64
        The length of the first stretch inside; 0 for rays that do not enter within the leeway, infinite for those
        that have not left at the last position.

    Notes
    -----
    Between two positions the value is taken as linear. A ray that is inside at the first is inside from its start.

    >>> ball = lambda points: 4 - np.linalg.norm(points, axis=1)
    >>> way_inside(ball, np.zeros((1, 2)), np.array([[0.6, 0.8]]), np.arange(0, 8, 0.5)).tolist()
    [4.0]
    """
    points = start[:, None] + distance[:, None] * direction[:, None]
    values = np.asarray(value(points.reshape(-1, start.shape[1]))).reshape(points.shape[:2])
    return first_stretch(values, distance, leeway=leeway)


def first_stretch(values: NDArray[np.floating], distance: Floats, *, leeway: int = 0) -> Floats:
    """Return what `way_inside` does, given the values at all positions along the rays, (N, n).

    >>> first_stretch(np.array([[1.0, 1.0, -1.0], [-1.0, -1.0, -1.0]]), np.arange(3.0)).tolist()
    [1.5, 0.0]
    """
    inside = values > 0
    row, place = np.arange(len(values)), np.arange(len(distance))
    first = inside.argmax(axis=1)
    out = ~inside & (place > first[:, None])
    last = out.argmax(axis=1)

    def crossing(after: NDArray[np.intp]) -> Floats:
        """Return where the value is 0 just before a sampled position."""
        before = np.maximum(after - 1, 0)
        here, there = values[row, before], values[row, after]
        step = np.where(here == there, 1, here - there)
        found: Floats = distance[before] + here / step * (distance[after] - distance[before])
        return found

    length = crossing(last) - np.where(first > 0, crossing(first), 0.0)
    length = np.where(out.any(axis=1), length, np.inf)
    return np.where(inside[:, : leeway + 1].any(axis=1), length, 0.0)
