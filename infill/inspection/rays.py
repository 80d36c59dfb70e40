"""Follow rays until they leave the solid, in any number of dimensions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats


def length_inside(
    value: Callable[[Floats], NDArray[np.floating]],
    start: Floats,
    direction: Floats,
    distance: Floats,
    *,
    leeway: int = 0,
) -> Floats:
    """Measure the length of the first stretch of solid along each ray, (N,) mm; infinite if the ray does not leave it.

    Parameters
    ----------
    value : callable
        Maps points (M, d), mm, to values above 0 where they are solid.
    start, direction : (N, d) float64
        Starts of the rays, mm, and unit vectors.
    distance : (n,) float64
        Positions to sample along a ray, mm, rising evenly from less than a step.
    leeway : int
        Number of positions after the first at which a ray may still enter the solid.

    Returns
    -------
    (N,) float64
        The length of the first stretch inside; 0 for rays that do not enter within the leeway, infinite for those
        that have not left at the last position.

    Notes
    -----
    Between two positions the value is taken as linear. A ray that is inside at the first is inside from its start.

    >>> ball = lambda points: 4 - np.linalg.norm(points, axis=1)
    >>> length_inside(ball, np.zeros((1, 2)), np.array([[0.6, 0.8]]), np.arange(0, 8, 0.5)).tolist()
    [4.0]
    """
    points = start[:, None] + distance[:, None] * direction[:, None]
    values = np.asarray(value(points.reshape(-1, start.shape[1]))).reshape(points.shape[:2])
    return first_solid_length(values, distance, leeway=leeway)


def first_solid_length(values: NDArray[np.floating], distance: Floats, *, leeway: int = 0) -> Floats:
    """Measure the first stretch of solid, as `length_inside` does, from the values along the rays, (N, n).

    >>> first_solid_length(np.array([[1.0, 1.0, -1.0], [-1.0, -1.0, -1.0]]), np.arange(3.0)).tolist()
    [1.5, 0.0]
    """
    inside = values > 0
    row, position = np.arange(len(values)), np.arange(len(distance))
    entry = inside.argmax(axis=1)
    left_solid = ~inside & (position > entry[:, None])
    leaving = left_solid.argmax(axis=1)

    def crossing(after: NDArray[np.intp]) -> Floats:
        """Return the distance at which the value is 0 just before a sampled position."""
        before = np.maximum(after - 1, 0)
        value_before, value_after = values[row, before], values[row, after]
        step = np.where(value_before == value_after, 1, value_before - value_after)
        root: Floats = distance[before] + value_before / step * (distance[after] - distance[before])
        return root

    length = crossing(leaving) - np.where(entry > 0, crossing(entry), 0.0)
    length = np.where(left_solid.any(axis=1), length, np.inf)
    return np.where(inside[:, : leeway + 1].any(axis=1), length, 0.0)
