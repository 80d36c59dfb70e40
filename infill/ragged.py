"""Rows of different lengths laid end to end: paths among their points, boxes among their cells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

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


def packed(rows: Sequence[NDArray[Any]], *, like: tuple[int, ...] = ()) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Return rows one after another, and where each begins, with the end as one more.

    Parameters
    ----------
    rows : sequence of (N, ...) arrays
    like : tuple of int
        Shape of an entry, for no rows at all.

    >>> packed([np.array([1.0, 2.0]), np.array([3.0])])[1].tolist()
    [0, 2, 3]
    """
    first = np.concatenate([[0], np.cumsum([len(row) for row in rows])]).astype(np.intp)
    return (np.concatenate(rows) if rows else np.empty((0, *like))), first


def parted(values: NDArray[Any], first: NDArray[np.integer]) -> list[NDArray[Any]]:
    """Return the rows that `packed` laid end to end.

    >>> [row.tolist() for row in parted(np.array([1, 2, 3]), np.array([0, 2, 3]))]
    [[1, 2], [3]]
    """
    return [values[low:high] for low, high in zip(first[:-1].tolist(), first[1:].tolist(), strict=True)]


def picked(first: NDArray[np.integer], some: NDArray[np.integer]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the places of the entries of some rows, one row after another, and where each of them begins then.

    >>> [each.tolist() for each in picked(np.array([0, 2, 3, 6]), np.array([0, 2]))]
    [[0, 1, 3, 4, 5], [0, 2, 5]]
    """
    counts = first[some + 1] - first[some]
    begins = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
    return np.arange(begins[-1]) + np.repeat(first[some] - begins[:-1], counts), begins
