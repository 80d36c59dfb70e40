"""Rows of different lengths laid end to end, some rows at a time: the basis of loops over boxes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray


def spread(
    counts: NDArray[np.integer], most: int | None = None
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Yield (row, place): row i occurs `counts[i]` times, with places 0, 1, 2 … in it.

    Parameters
    ----------
    counts : (N,) int
        Length of each row.
    most : int, optional
        Approximate number of entries to yield at a time; a single row is never split.

    >>> [(row.tolist(), place.tolist()) for row, place in spread(np.array([2, 0, 1]))]
    [([0, 0, 2], [0, 1, 0])]
    """
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        passed = int(ends[begin - 1]) if begin else 0
        end = len(counts) if most is None else int(np.searchsorted(ends, passed + most, side="right"))
        end = max(end, begin + 1)
        some = counts[begin:end]
        row = np.repeat(np.arange(begin, end), some)
        place = np.arange(len(row)) - np.repeat(ends[begin:end] - some - passed, some)
        if len(row):
            yield row, place
        begin = end
