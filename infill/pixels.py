"""Pixels in a plane, by NumPy alone: components, opening, and values between centres.

SciPy has the same functions in scipy.ndimage, which takes a quarter of the time of a short command to load.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.graph import label_connected


def label_pixels(inside: NDArray[np.bool_]) -> tuple[NDArray[np.int32], int]:
    """Label the components of pixels that touch at a side; return the number of each pixel, and how many there are.

    Components are numbered from 1, in the order of their first pixels; 0 stands for all other pixels.

    Parameters
    ----------
    inside : (nx, ny) bool

    Notes
    -----
    Runs of pixels along rows are united with the runs that they touch in the next row.

    >>> label_pixels(np.array([[True, False, True], [False, False, True]]))[0].tolist()
    [[1, 0, 2], [0, 0, 2]]
    """
    width = inside.shape[1] + 1  # a column more keeps the runs of two rows apart
    flat = np.pad(inside, ((0, 0), (0, 1))).ravel()
    bounds = np.flatnonzero(np.diff(flat, prepend=False, append=False))
    begin, end = bounds[::2], bounds[1::2]
    lowest, highest = np.searchsorted(end, begin + width, side="right"), np.searchsorted(begin, end + width)
    touching = np.maximum(highest - lowest, 0)
    run = np.repeat(np.arange(len(begin)), touching)
    below = np.arange(len(run)) - np.repeat(np.cumsum(touching) - touching - lowest, touching)
    number, count = label_connected(run, below, len(begin))
    labels = np.zeros(len(flat), dtype=np.int32)
    labels[flat] = np.repeat(number + np.int32(1), end - begin)
    return np.ascontiguousarray(labels.reshape(-1, width)[:, :-1]), count


def open_pixels(inside: NDArray[np.bool_], side: int) -> NDArray[np.bool_]:
    """Keep the pixels that lie in a square of `side` pixels, all of them inside.

    >>> open_pixels(np.array([[True, True, False], [True, True, True]]), 2).astype(int).tolist()
    [[1, 1, 0], [1, 1, 0]]
    """
    if min(inside.shape) < side:
        return np.zeros_like(inside)
    opened = inside
    for axis in (0, 1):
        opened = _all_of(opened, side, axis)
    for axis in (0, 1):  # what is in none of the squares is out of their union
        outside = np.pad(~opened, [(side - 1, side - 1) if axis == k else (0, 0) for k in (0, 1)], constant_values=True)
        opened = ~_all_of(outside, side, axis)
    return opened


def _all_of(pixels: NDArray[np.bool_], side: int, axis: int) -> NDArray[np.bool_]:
    """Mark the pixels with which `side` pixels along an axis begin that are all inside; the last ones are left out."""
    count = pixels.shape[axis] - side + 1
    result = np.ones([count if axis == k else length for k, length in enumerate(pixels.shape)], dtype=bool)
    for shift in range(side):
        result &= np.take(pixels, np.arange(shift, shift + count), axis=axis)
    return result


def interpolate_pixels(values: NDArray[np.floating], places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Interpolate between four pixels each; beyond the outermost pixels, values stay the same.

    Parameters
    ----------
    values : (nx, ny) float
    places : (N, 2) float64
        In pixels: the centre of pixel (0, 0) is the origin.

    >>> interpolate_pixels(np.array([[0.0, 1.0], [2.0, 3.0]]), np.array([[0.5, 0.5], [9.0, 0.0]])).tolist()
    [1.5, 2.0]
    """
    corners: list[tuple[Any, ...]] = []
    for place, count in zip(places.T, values.shape, strict=True):
        floor = np.floor(place)
        low, weight = floor.astype(np.intp), 1 - (place - floor)
        corners.append(((low.clip(0, count - 1), weight), ((low + 1).clip(0, count - 1), 1 - weight)))
    result = np.zeros(len(places))
    for i, along in corners[0]:
        for j, across in corners[1]:
            result += values[i, j] * along * across
    return result
