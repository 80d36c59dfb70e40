"""The boxes in which the surface of a volume in chunks is simplified, round after round.

    parts      chunks, cut where they are long: each part is simplified, and the vertices at its border stay
    faces      boxes around the planes between two parts, in which these vertices go, too
    edges      boxes around the lines where planes along two axes cross
    corners    boxes around the points where planes along all three axes cross

Boxes of one round do not overlap, and each reaches beyond what the round before left. Lengths are in cells, from the
centre of the first cell. Planes closer together than boxes are wide share a box.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk, ChunkLayout
from infill.kernels.sparse import BRICK

PART = 144  # cells: longest side of a part
REACH = 8.3  # cells on both sides of a plane; its double and triple are no whole numbers, where faces might lie
ROOM = 6  # reaches between planes that have boxes of their own
ORIGINAL, AROUND = 2.0, 5.0  # cells around a box: within which the original and the simplified surface are looked at
FARTHEST = 1.0  # cells: tolerance for which these suffice

Span = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Box:
    """A box in which faces may change.

    Parameters
    ----------
    low, high : (3,) float
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    def holds(self, points: NDArray[np.float64], margin: float = 0.0) -> NDArray[np.bool_]:
        """Tell which points (..., 3) lie in the box and a margin around it; each point is in one box of a round."""
        inside = (points > np.array(self.low) - margin) & (points <= np.array(self.high) + margin)
        return np.asarray(inside.all(axis=-1))

    def meets(self, low: NDArray[np.float64], high: NDArray[np.float64], margin: float) -> NDArray[np.bool_]:
        """Tell which boxes, from low to high (..., 3), meet the box and a margin around it."""
        apart = (high < np.array(self.low) - margin) | (low > np.array(self.high) + margin)
        return np.asarray(~apart.any(axis=-1))


@dataclass(frozen=True, kw_only=True)
class SeamPlan:
    """The parts of a volume, and the boxes around their borders.

    Parameters
    ----------
    layout : ChunkLayout
    """

    layout: ChunkLayout

    @cached_property
    def planes(self) -> tuple[tuple[float, ...], ...]:
        """The planes between parts along each axis, cells."""
        planes = []
        for axis, size in enumerate(BRICK):
            bricks, lattice = self.layout.size[axis], self.layout.lattice[axis]
            cuts = {
                low + round(n * (min(bricks, lattice - low)) / parts)
                for low in range(0, lattice, bricks)
                for parts in [max(1, math.ceil(min(bricks, lattice - low) * size / PART))]
                for n in range(parts)
            } - {0}
            planes.append(tuple(float(cut * size - 1) for cut in sorted(cuts)))
        return tuple(planes)

    @cached_property
    def reach(self) -> float:
        """Cells by which boxes of the first round reach beyond planes."""
        gaps = [b - a for planes in self.planes for a, b in pairwise(planes)]
        return min(REACH, float(np.median(gaps)) / ROOM - 0.03) if gaps else REACH

    @cached_property
    def clusters(self) -> tuple[tuple[Span, ...], ...]:
        """The planes along each axis, those that are close together as one."""
        spans = []
        for planes in self.planes:
            joined: list[Span] = []
            for plane in planes:
                if joined and plane - joined[-1][1] < ROOM * self.reach:
                    joined[-1] = joined[-1][0], plane
                else:
                    joined.append((plane, plane))
            spans.append(tuple(joined))
        return tuple(spans)

    def rounds(self) -> Iterator[list[Box]]:
        """Yield the boxes of each round."""
        for count in (1, 2, 3):
            width = count * self.reach
            choices = []
            for spans in self.clusters:
                ends = [-math.inf, *(end for span in spans for end in (span[0] - width, span[1] + width)), math.inf]
                choices.append([(n % 2, ends[n], ends[n + 1]) for n in range(len(ends) - 1)])
            boxes = []
            for x, y, z in product(*choices):
                if x[0] + y[0] + z[0] == count:
                    boxes.append(Box(low=(x[1], y[1], z[1]), high=(x[2], y[2], z[2])))
            yield boxes

    def near_seams(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell which points (N, 3), cells, lie in the box of a round and the margin for the original around it."""
        distance = np.full(points.shape, math.inf)
        for axis, spans in enumerate(self.clusters):
            for low, high in spans:
                x = points[:, axis]
                distance[:, axis] = np.minimum(distance[:, axis], np.maximum(low - x, x - high))
        near = np.zeros(len(points), dtype=bool)
        for count in (1, 2, 3):
            near |= (distance <= count * self.reach + ORIGINAL).sum(axis=1) >= count
        return near

    def parts_of(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the part that holds each point (N, 3), cells, as one number."""
        number = np.zeros(len(points), dtype=np.int64)
        for axis, planes in enumerate(self.planes):
            number = number * (len(planes) + 1) + np.searchsorted(np.array(planes), points[:, axis], side="right")
        return number

    def box_of(self, chunk: Chunk) -> Box:
        """Return the box of the cubes of a chunk."""
        low, high = (np.array(ends) * np.array(BRICK) - 1.0 for ends in (chunk.low, chunk.high))
        return Box(low=tuple(low.tolist()), high=tuple(high.tolist()))
