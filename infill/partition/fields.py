"""The phase fields of all labels of a partition, and the label that wins in every cell."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from infill.kernels.sparse import BRICK, CELLS, SOLID_BRICK
from infill.kernels.threads import in_order, in_threads, thread_count
from infill.kernels.winners import INSIDE, choose_winners, count_margins, find_uniform, share_cells
from infill.phasefield.sparse import SparseField

SAMPLED_BRICKS, STEEP = 20_000, 0.9  # where the row crosses the surface about at right angles
SAMPLES = 2**21  # of cells that two labels share, at most, of each thread
GROWTH = 1.5  # of the room for bricks
SMALL = 2**20  # cells of a box: one thread smooths it before others have begun

SmoothLabel = Callable[[NDArray[np.generic], int], SparseField]
LabelData = Callable[[int, tuple[slice, ...]], NDArray[np.generic]]


@dataclass(frozen=True, kw_only=True, eq=False)
class PartitionFields:
    """The fields of all labels, in bricks.

    Parameters
    ----------
    numbers : (n0, n1, n2) uint16
        The given labels, numbered 0, 1 ...; 0 stands for no label.
    count : int
        Labels, 0 among them.
    entries : (m0, m1, m2, 2) int64
        Of each brick of the lattice, its first and its last entry, exclusive.
    labels, slots : (e,) int32
        The label of each entry and the place of its brick in `values`, or `infill.kernels.winners.INSIDE`.
    values : (b, 1024) float32
        Cells of bricks, in [-1, 1].
    """

    numbers: NDArray[np.uint16]
    count: int
    entries: NDArray[np.int64]
    labels: NDArray[np.int32]
    slots: NDArray[np.int32]
    values: NDArray[np.float32]

    def slope(self) -> float:
        """Return the slope of a field at its surface, in units a cell, from the steepest of neighbours on a row."""
        rows = self.values[:: max(1, len(self.values) // SAMPLED_BRICKS)].reshape(-1, BRICK[-1])
        low, high = rows[:, :-1], rows[:, 1:]
        crosses = (low > 0) != (high > 0)
        return float(np.quantile(np.abs(high[crosses] - low[crosses]), STEEP)) if crosses.any() else 1.0

    def margins(self, bins: int, *, threads: int | None = None) -> NDArray[np.int64]:
        """Count the cells of every label by how much it exceeds the highest other one: (labels, bins) from -2 to 2."""
        count = thread_count(threads)
        sums = np.zeros((count, self.count, bins), dtype=np.int64)
        fields = self.entries, self.labels, self.slots, self.values, self.numbers
        in_threads(count_margins, *fields, sums, threads=count)
        return np.asarray(sums.sum(axis=0))

    def shares(
        self, offsets: NDArray[np.floating], ramp: float, *, threads: int | None = None
    ) -> tuple[NDArray[np.float64], sparse.csr_array]:
        """Return the volume of every label, with cells near walls shared, and how it changes with offsets.

        Volumes change without jumps, and need no walls; they are right to about a thousandth.

        Parameters
        ----------
        offsets : (labels,) float
        ramp : float
            The difference of two values from which on a cell is the winner's alone.

        Returns
        -------
        volumes : (labels,) float64
            Cells.
        changes : (labels, labels) sparse float64
            Cells that the label of a row wins from that of a column for a unit of its offset.
        """
        count = thread_count(threads)
        stride = -(-self.numbers.size // SAMPLES)
        sums, pairs = np.zeros((count, self.count)), np.empty((count, SAMPLES), dtype=np.uint32)
        fields = self.entries, self.labels, self.slots, self.values, np.asarray(offsets, dtype=np.float32)
        shared = in_threads(share_cells, *fields, self.numbers, ramp, stride, sums, pairs, threads=count)
        samples = np.concatenate([pairs[thread, : -(-cells // stride)] for thread, cells in enumerate(shared)])
        pair, number = np.unique(samples, return_counts=True)
        ends = (pair >> 16).astype(np.int64), (pair & 0xFFFF).astype(np.int64)
        changes = sparse.csr_array((number * (stride / (2 * ramp)), ends), shape=(self.count, self.count))
        return sums.sum(axis=0), sparse.csr_array(changes + changes.T)

    def winners(self, offsets: NDArray[np.floating], *, threads: int | None = None) -> NDArray[np.uint16]:
        """Return the label with the highest value plus offset in every cell; ties go to the given label."""
        winners = np.empty_like(self.numbers)
        in_threads(
            choose_winners,
            self.entries,
            self.labels,
            self.slots,
            self.values,
            np.asarray(offsets, dtype=np.float32),
            self.numbers,
            winners,
            threads=thread_count(threads),
        )
        return winners


def smooth_fields(
    numbers: NDArray[np.uint16],
    boxes: Sequence[tuple[tuple[int, ...], tuple[int, ...]]],
    smooth: SmoothLabel,
    *,
    data: LabelData | None = None,
    reach: int = 20,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> PartitionFields:
    """Smooth the field of every label by itself, in the part of the grid that it can reach.

    Where only two labels meet, their fields are each other's negative, and the winners are those of the binary
    scheme, to the last bit.

    Parameters
    ----------
    numbers : (n0, n1, n2) uint16
        Labels, numbered 0, 1 ...
    boxes : sequence of (low, high)
        The cells that hold each label, 0 first: from `low` up to but without `high`.
    smooth : callable
        Returns the field of a mask, or of values in [-1, 1], with a number of threads.
    data : callable, optional
        Returns the data of a label in a part of the grid, if they are not the mask of its number.
    reach : int
        Cells around a label beyond which its field is void to the last bit; 20 is enough for an interface of 2 cells.
    progress : callable, optional
        Called with the share of labels done.
    """
    count = thread_count(threads)
    lattice = tuple(math.ceil((cells + 2) / size) for cells, size in zip(numbers.shape, BRICK, strict=True))

    def smooth_one(label: int) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.float32]]:
        """Smooth a label; return the bricks that it reaches, the slot of each, and the values of the kept ones."""
        low, high = _reached_box(boxes[label], numbers.shape, reach)
        box = tuple(map(slice, low, high))
        part = numbers[box] == label if data is None else data(label, box)
        field = smooth(part, 1 if part.size < SMALL else count)
        shift = np.array(low) // BRICK
        values = field.values.reshape(-1, CELLS)
        # Bricks that hold one value to the last bit are not kept.
        uniform = np.empty(len(values), dtype=np.int8)
        find_uniform(values, uniform)
        is_kept = uniform == 0
        inside = np.concatenate([np.argwhere(field.slots == SOLID_BRICK), field.where[uniform == 1]])
        places = np.concatenate([field.where[is_kept].astype(np.int64), inside]) + shift
        kept = values[is_kept]
        slots = np.concatenate([np.arange(len(kept)), np.full(len(inside), INSIDE)]).astype(np.int32)
        return np.ravel_multi_index(tuple(places.T), lattice), slots, kept

    places, labels, slots, start = [], [], [], 0
    values = np.empty((0, CELLS), dtype=np.float32)
    for label, (brick, slot, cells) in in_order(smooth_one, range(len(boxes)), threads=count):
        places.append(brick)
        labels.append(np.full(len(brick), label, dtype=np.int32))
        slots.append(np.where(slot == INSIDE, slot, slot + start).astype(np.int32))
        if start + len(cells) > len(values):
            # Parts that are joined at the end would be there twice.
            larger = np.empty((math.ceil(GROWTH * (start + len(cells))), CELLS), dtype=np.float32)
            larger[:start] = values[:start]
            values = larger
        values[start : start + len(cells)] = cells
        start += len(cells)
        if progress is not None:
            progress((label + 1) / len(boxes))
    place = np.concatenate(places)
    order = np.argsort(place, kind="stable")
    ends = np.searchsorted(place[order], np.arange(math.prod(lattice) + 1))
    return PartitionFields(
        numbers=numbers,
        count=len(boxes),
        entries=np.stack([ends[:-1], ends[1:]], axis=-1).reshape(*lattice, 2),
        labels=np.concatenate(labels)[order],
        slots=np.concatenate(slots)[order],
        values=values[:start],
    )


def _reached_box(
    box: tuple[tuple[int, ...], tuple[int, ...]], shape: tuple[int, ...], reach: int
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the box that a field can reach, with sides between bricks of the whole grid."""
    low = tuple(max(0, (at - reach) // size * size) for at, size in zip(box[0], BRICK, strict=True))
    high = tuple(
        min(count, -(-(at + reach) // size) * size) for at, size, count in zip(box[1], BRICK, shape, strict=True)
    )
    return low, high
