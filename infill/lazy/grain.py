"""Boxes in which a lazy array is best read whole: as its cells lie together where they are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from infill.lazy.volume import LazyArray

Box = tuple[tuple[int, int, int], tuple[int, int, int]]


def grain_of(array: LazyArray) -> tuple[int, ...]:
    """Return the sides of the boxes of cells that are read at once, whatever is asked for: chunks, pages or layers."""
    sides = getattr(array, "grain", None) or (64, 64, array.shape[2])
    return tuple(max(1, min(side, count)) for side, count in zip(sides, array.shape, strict=True))


def whole_boxes(array: LazyArray, most: int) -> Iterator[Box]:
    """Yield boxes (low, high) that make up an array, of up to `most` cells, of whole grains where these are smaller.

    They are as long as possible along z, then y, then x: rows along z are seldom divided.
    """
    sides = list(grain_of(array))
    for axis in (0, 1):  # grains larger than that are read in parts
        sides[axis] = max(1, min(sides[axis], most // max(1, math.prod(sides) // sides[axis])))
    sides[2] = max(1, min(sides[2], most // (sides[0] * sides[1])))
    for axis in (2, 1, 0):
        times = max(1, most // math.prod(sides))
        sides[axis] = min(array.shape[axis], sides[axis] * times)
    for low in product(*(range(0, count, side) for count, side in zip(array.shape, sides, strict=True))):
        high = tuple(min(begin + side, count) for begin, side, count in zip(low, sides, array.shape, strict=True))
        yield low, high  # type: ignore[misc]
