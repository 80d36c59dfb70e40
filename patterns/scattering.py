"""Reproducible random points: they depend on a seed and their place, not on the order of calls."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

INCREMENT, FIRST_FACTOR, SECOND_FACTOR = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB  # of splitmix64


def scatter_points(low: NDArray[np.int64], high: NDArray[np.int64], seed: int) -> NDArray[np.float64]:
    """Return a point in each unit square, or cube, between two corners: (N, 2) or (N, 3).

    Parameters
    ----------
    low, high : (2,) or (3,) int64
    seed : int
        A square always has the same point for the same seed.

    >>> corner = np.array([3, 4])
    >>> bool((scatter_points(corner, corner + 1, 7)[0] == scatter_points(corner - 2, corner + 1, 7)[-1]).all())
    True
    """
    squares = np.stack(np.meshgrid(*map(np.arange, low, high), indexing="ij"), axis=-1).reshape(-1, len(low))
    hashed = splitmix64(np.full(len(squares), seed, dtype=np.uint64))
    for coordinate in squares.T:
        hashed = splitmix64(hashed + coordinate.astype(np.uint64))
    shares = np.stack([splitmix64(hashed + np.uint64(axis)) for axis in range(len(low))], axis=-1) / 2.0**64
    points: NDArray[np.float64] = squares + shares
    return points


def splitmix64(numbers: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Hash each number to a pseudorandom one: splitmix64.

    Source: Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.

    >>> splitmix64(np.zeros(1, dtype=np.uint64)).tolist()
    [16294208416658607535]
    """
    out = numbers + np.uint64(INCREMENT)
    out = (out ^ (out >> np.uint64(30))) * np.uint64(FIRST_FACTOR)
    out = (out ^ (out >> np.uint64(27))) * np.uint64(SECOND_FACTOR)
    return out ^ (out >> np.uint64(31))
