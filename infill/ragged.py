"""Rows of different lengths laid end to end, such as the points of several paths."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


def expand_rows(
    counts: NDArray[np.integer], most: int | None = None
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Yield (row, place) arrays: row i occurs `counts[i]` times, with places 0, 1, 2 … in it.

    Parameters
    ----------
    counts : (N,) int
        Length of each row.
    most : int, optional
        Approximate number of entries to yield at a time; a single row is never split.

    >>> [(row.tolist(), place.tolist()) for row, place in expand_rows(np.array([2, 0, 1]))]
    [([0, 0, 2], [0, 1, 0])]
    """
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        done = int(ends[begin - 1]) if begin else 0
        end = len(counts) if most is None else int(np.searchsorted(ends, done + most, side="right"))
        end = max(end, begin + 1)
        lengths = counts[begin:end]
        row = np.repeat(np.arange(begin, end), lengths)
        place = np.arange(len(row)) - np.repeat(ends[begin:end] - lengths - done, lengths)
        if len(row):
            yield row, place
        begin = end


def concatenate_rows(
    rows: Sequence[NDArray[Any]], *, like: tuple[int, ...] = ()
) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """Concatenate rows; return the entries and the offsets of the rows, including the end of the last one.

    Parameters
    ----------
    rows : sequence of (N, ...) arrays
    like : tuple of int
        Shape of an entry, used if there are no rows.

    >>> concatenate_rows([np.array([1.0, 2.0]), np.array([3.0])])[1].tolist()
    [0, 2, 3]
    """
    offsets = np.concatenate([[0], np.cumsum([len(row) for row in rows])]).astype(np.intp)
    return (np.concatenate(rows) if rows else np.empty((0, *like))), offsets


def split_rows(values: NDArray[Any], offsets: NDArray[np.integer]) -> list[NDArray[Any]]:
    """Split entries into rows at their offsets: the inverse of `concatenate_rows`.

    >>> [row.tolist() for row in split_rows(np.array([1, 2, 3]), np.array([0, 2, 3]))]
    [[1, 2], [3]]
    """
    return [values[low:high] for low, high in zip(offsets[:-1].tolist(), offsets[1:].tolist(), strict=True)]


def select_rows(offsets: NDArray[np.integer], rows: NDArray[np.integer]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices of the entries of selected rows, row after row, and the offsets of these rows.

    >>> [array.tolist() for array in select_rows(np.array([0, 2, 3, 6]), np.array([0, 2]))]
    [[0, 1, 3, 4, 5], [0, 2, 5]]
    """
    counts = offsets[rows + 1] - offsets[rows]
    begins = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
    return np.arange(begins[-1]) + np.repeat(offsets[rows] - begins[:-1], counts), begins
