"""Loops of `infill.partition.walls`, compiled: the triangles and points of each label."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.lanes import count_ones

WORD = 32  # bits of a word: each stands for a point


@njit(nogil=True, cache=True)
def count_sides(sides, starts):
    """Count the triangles before those of each label.

    Parameters
    ----------
    sides : (T, 2) int32
        Labels behind and before each triangle; negative ones are left out.
    starts : (labels + 1, 2) int64
        Of 0; written: how many triangles lie before, or behind, labels that come first.
    """
    for t in range(len(sides)):
        for side in range(2):
            if sides[t, side] >= 0:
                starts[sides[t, side] + 1, side] += 1
    for label in range(1, len(starts)):
        for side in range(2):
            starts[label, side] += starts[label - 1, side]


@njit(nogil=True, cache=True)
def sort_sides(sides, cursor, behind, before):
    """Write the triangles in the order of the label behind them, and of that before them; `cursor` is changed."""
    for t in range(len(sides)):
        label = sides[t, 0]
        if label >= 0:
            behind[cursor[label, 0]] = t
            cursor[label, 0] += 1
        label = sides[t, 1]
        if label >= 0:
            before[cursor[label, 1]] = t
            cursor[label, 1] += 1


@njit(nogil=True, cache=True)
def find_ends(triangles, behind, before):
    """Return the lowest and the highest point of triangles.

    Parameters
    ----------
    triangles : (T, 3) int
    behind, before : (N,), (M,) int
        Numbers of triangles, one at least.
    """
    low = high = triangles[behind[0] if len(behind) else before[0], 0]
    for n in range(len(behind) + len(before)):
        t = behind[n] if n < len(behind) else before[n - len(behind)]
        for side in range(3):
            low, high = min(low, triangles[t, side]), max(high, triangles[t, side])
    return low, high


@njit(nogil=True, cache=True)
def mark_points(triangles, behind, before, low, words, starts):
    """Mark the points of triangles, one bit for each; return their number.

    Parameters
    ----------
    triangles, behind, before
        As for `find_ends`.
    low : int
        The point of the first bit.
    words : (W,) uint32
        Of 0; written.
    starts : (W,) int32
        Written: the points before those of each word.
    """
    for n in range(len(behind) + len(before)):
        t = behind[n] if n < len(behind) else before[n - len(behind)]
        for side in range(3):
            place = triangles[t, side] - low
            words[place // WORD] |= np.uint32(1) << np.uint32(place % WORD)
    count = 0
    for word in range(len(words)):
        starts[word] = count
        count += count_ones(np.int64(words[word]))
    return count


@njit(nogil=True, cache=True)
def list_points(words, low, points):
    """List the points that are marked, in order: points (K,) int64."""
    count = 0
    for word in range(len(words)):
        bits, point = words[word], low + word * WORD
        while bits:
            if bits & np.uint32(1):
                points[count] = point
                count += 1
            bits >>= np.uint32(1)
            point += 1


@njit(inline="always", cache=True)
def rank_of(place, words, starts):
    """Return the number of marked points before a place."""
    below = (np.int64(1) << (place % WORD)) - 1
    return starts[place // WORD] + count_ones(np.int64(words[place // WORD]) & below)


@njit(nogil=True, cache=True)
def number_faces(triangles, behind, before, low, words, starts, faces):
    """Write triangles with the ranks of their corners among marked points; those before a label are turned round."""
    for n in range(len(behind)):
        for side in range(3):
            faces[n, side] = rank_of(triangles[behind[n], side] - low, words, starts)
    for n in range(len(before)):
        for side in range(3):
            faces[len(behind) + n, side] = rank_of(triangles[before[n], 2 - side] - low, words, starts)
