"""The chunks of a volume: boxes of whole bricks, each with the margin that its steps reach.

    lattice      | brick | brick | brick | brick | brick | brick |     of the whole volume
    chunk                        |#######|#######|                     the bricks it owns
    cells read           |...............................|             owned ones and a margin
    cells kept               |.......|#######|#######|.......|         owned ones and a brick around them

A brick owns the cubes whose lowest corner lies in it, and the edges of the grid that begin in its cells. So every
triangle and every vertex of the whole surface belongs to one chunk.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.kernels.sparse import BRICK
from infill.phasefield.refining import refined_reach

LEAST_MARGIN = 2  # bricks: labels reach into the brick beside the chunk, which therefore has to be whole

Place = tuple[int, int, int]


@dataclass(frozen=True, kw_only=True)
class Chunk:
    """A box of whole bricks.

    Parameters
    ----------
    number : int
        In the order of the layout.
    low, high : (3,) int
        Its bricks, on the lattice of the whole volume: from `low` up to but without `high`.
    kept_low, kept_high : (3,) int
        The same with one brick around it.
    read_low, read_high : (3,) int
        The same with the margin.
    cell_low, cell_high : (3,) int
        The cells that are read.
    lattice : (3,) int
        Bricks of the whole volume.
    shape : (3,) int
        Cells of the whole volume.
    """

    number: int
    low: Place
    high: Place
    kept_low: Place
    kept_high: Place
    read_low: Place
    read_high: Place
    cell_low: Place
    cell_high: Place
    lattice: Place
    shape: Place

    @property
    def touches_rim(self) -> bool:
        """Whether its cubes reach beyond the grid, where the surface closes."""
        return any(
            low == 0 or high == count for low, high, count in zip(self.low, self.high, self.lattice, strict=True)
        )

    @property
    def own_cells(self) -> tuple[slice, ...]:
        """The cells of the grid in its own bricks, counted from the first that is read."""
        return tuple(
            slice(max(low * size - 1, 0) - along_x, min(high * size - 1, count) - along_x)
            for low, high, size, count, along_x in zip(
                self.low, self.high, BRICK, self.shape, self.cell_low, strict=True
            )
        )

    @property
    def own_bricks(self) -> tuple[Place, Place]:
        """The first of its own bricks, and the end of them, counted from the first that is read."""
        first = np.array(self.read_low)
        return _as_place(np.array(self.low) - first), _as_place(np.array(self.high) - first)

    @property
    def has_cells(self) -> bool:
        """Whether it holds cells of the grid, not only the void beyond it, in which the surface closes."""
        return all(part.stop > part.start for part in self.own_cells)

    def widened(self, cells: int) -> Chunk:
        """Return a chunk for which as many cells more are read on each side, in whole bricks."""
        more = -(-cells // np.array(BRICK))
        lattice = np.array(self.lattice)
        low, high = np.maximum(self.read_low - more, 0), np.minimum(self.read_high + more, lattice)
        cell_low, cell_high = _cells_of(low, high, lattice, self.shape)
        return replace(self, read_low=_as_place(low), read_high=_as_place(high), cell_low=cell_low, cell_high=cell_high)

    def owns(self, places: NDArray[np.integer]) -> NDArray[np.bool_]:
        """Tell which bricks (N, 3), counted from the first that is kept, are its own."""
        own_places = places + np.array(self.kept_low)
        own: NDArray[np.bool_] = ((own_places >= self.low) & (own_places < self.high)).all(axis=1)
        return own


@dataclass(frozen=True, kw_only=True)
class ChunkLayout:
    """The division of a volume into chunks.

    Parameters
    ----------
    shape : (nx, ny, nz)
        Cells of the volume.
    size : (3,) int
        Bricks of a chunk along each axis; those at the upper ends may have fewer.
    steps : int
        Steps of smoothing, each of which reaches one cell.
    refined : bool
        Whether the field is refined: see `infill.phasefield.refining.refined_reach`.

    >>> [chunk.own_cells for chunk in ChunkLayout(shape=(20, 6, 14), size=(2, 1, 1), steps=3)][1]
    (slice(15, 20, None), slice(0, 6, None), slice(0, 14, None))
    """

    shape: Place
    size: Place
    steps: int
    refined: bool = False

    @property
    def lattice(self) -> Place:
        """Bricks of the whole volume."""
        along_x, along_y, along_z = (
            math.ceil((count + 2) / size) for count, size in zip(self.shape, BRICK, strict=True)
        )
        return along_x, along_y, along_z

    @property
    def counts(self) -> Place:
        """Chunks along each axis."""
        along_x, along_y, along_z = (
            math.ceil(bricks / size) for bricks, size in zip(self.lattice, self.size, strict=True)
        )
        return along_x, along_y, along_z

    @property
    def margin(self) -> Place:
        """Bricks read beside a chunk: all cells whose values can reach its cubes."""
        return margin_bricks(self.steps, refined=self.refined)

    def __len__(self) -> int:
        """Return the number of chunks."""
        return math.prod(self.counts)

    def __iter__(self) -> Iterator[Chunk]:
        """Yield all chunks, the last axis fastest."""
        for number, place in enumerate(product(*map(range, self.counts))):
            yield self._chunk(number, place)

    def _chunk(self, number: int, place: Sequence[int]) -> Chunk:
        """Return the chunk at a place among the chunks."""
        lattice = np.array(self.lattice)
        low = np.array(place) * self.size
        high = np.minimum(low + self.size, lattice)
        read_low, read_high = np.maximum(low - self.margin, 0), np.minimum(high + self.margin, lattice)
        cell_low, cell_high = _cells_of(read_low, read_high, lattice, self.shape)
        return Chunk(
            number=number,
            low=_as_place(low),
            high=_as_place(high),
            kept_low=_as_place(np.maximum(low - 1, 0)),
            kept_high=_as_place(np.minimum(high + 1, lattice)),
            read_low=_as_place(read_low),
            read_high=_as_place(read_high),
            cell_low=cell_low,
            cell_high=cell_high,
            lattice=self.lattice,
            shape=self.shape,
        )


def margin_bricks(steps: int, *, refined: bool) -> Place:
    """Return the bricks to read beside a chunk along each axis, for a number of steps.

    The outermost cell of the part that is read, next to which the grid seems to end, is wrong after one step, and the
    cells of a brick at the end of the part lack one or two: hence one more cell, and two more above.
    """
    reach = refined_reach(steps) if refined else steps + 2
    along_x, along_y, along_z = (max(LEAST_MARGIN, math.ceil((reach + 1) / size)) for size in BRICK)
    return along_x, along_y, along_z


def _cells_of(
    read_low: NDArray[Any], read_high: NDArray[Any], lattice: NDArray[Any], shape: Place
) -> tuple[Place, Place]:
    """Return the cells to read for bricks: cut there, the lattice of the part begins and ends with the same bricks."""
    bricks = np.array(BRICK)
    ends = np.where(read_high == lattice, np.array(shape), read_high * bricks - 2)
    return _as_place(read_low * bricks), _as_place(ends)


def _as_place(numbers: NDArray[Any]) -> Place:
    """Return three whole numbers as a tuple."""
    along_x, along_y, along_z = (int(number) for number in numbers)
    return along_x, along_y, along_z
