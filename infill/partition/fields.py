"""The phase fields of all labels of a partition, and the label that wins in every cell."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from infill.kernels.sparse import BRICK, CELLS, SOLID_BRICK
from infill.kernels.threads import in_order, in_threads, thread_count
from infill.kernels.winners import INSIDE, PARTS, choose_winners, count_margins, find_uniform, share_cells
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.profile import PLAIN_PROFILE, REFINED_PROFILE
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import SparseField, smooth_bricks

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
    corner : (3,) int
        The first cell, if this is a part of a grid.
    whole : (3,) int, optional
        Cells of the whole grid.
    own : (2, 3) int, optional
        The first brick that counts, and the one after the last; by default, all do.
    """

    numbers: NDArray[np.uint16]
    count: int
    entries: NDArray[np.int64]
    labels: NDArray[np.int32]
    slots: NDArray[np.int32]
    values: NDArray[np.float32]
    corner: tuple[int, ...] = (0, 0, 0)
    whole: tuple[int, ...] | None = None
    own: NDArray[np.int64] | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells of the whole grid."""
        return self.numbers.shape if self.whole is None else self.whole

    @property
    def place(self) -> NDArray[np.int64]:
        """The first cell, and the cells of the whole grid, (2, 3)."""
        return np.array([self.corner, self.shape], dtype=np.int64)

    @property
    def bricks(self) -> NDArray[np.int64]:
        """The first brick that counts, and the one after the last, (2, 3)."""
        return np.array([(0, 0, 0), self.entries.shape[:3]], dtype=np.int64) if self.own is None else self.own

    def own_slots(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the bricks that count and have values: their label and place, (n, 4), and their slots, (n,)."""
        counts = (self.entries[..., 1] - self.entries[..., 0]).ravel()
        place = np.stack(np.unravel_index(np.repeat(np.arange(len(counts)), counts), self.entries.shape[:3]), axis=1)
        low, high = self.bricks
        chosen = (self.slots != INSIDE) & ((place >= low) & (place < high)).all(axis=1)
        first = np.array(self.corner) // BRICK
        return np.column_stack([self.labels[chosen], place[chosen] + first]), self.slots[chosen].astype(np.int64)

    def rises(self, stride: int) -> NDArray[np.float32]:
        """Return the differences of neighbours on rows across surfaces, of one of `stride` bricks."""
        names, slots = self.own_slots()
        if stride > 1:
            slots = slots[hash_names(names) % np.uint64(stride) == 0]
        rows = self.values[slots].reshape(-1, BRICK[-1])
        low, high = rows[:, :-1], rows[:, 1:]
        crosses = (low > 0) != (high > 0)
        return np.asarray(np.abs(high[crosses] - low[crosses]))

    def slope(self) -> float:
        """Return the slope of a field at its surface, in units a cell: see `slope_of`."""
        return slope_of(self.rises(brick_stride(len(self.values))))

    def margins(self, bins: int, *, threads: int | None = None) -> NDArray[np.int64]:
        """Count the cells of every label by how much it exceeds the highest other one: (labels, bins) from -2 to 2."""
        count = thread_count(threads)
        sums = np.zeros((count, self.count, bins), dtype=np.int64)
        fields = self.entries, self.labels, self.slots, self.values, self.numbers
        in_threads(count_margins, *fields, self.bricks, sums, threads=count)
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
        return volumes_of_shares(*self.count_shares(offsets, ramp, threads=threads), ramp, self.shape)

    def count_shares(
        self, offsets: NDArray[np.floating], ramp: float, *, threads: int | None = None
    ) -> tuple[NDArray[np.int64], NDArray[np.uint32], NDArray[np.int64]]:
        """Count the parts of cells that labels have, (labels,), the pairs that share samples of cells, and these."""
        count = thread_count(threads)
        sums, pairs = np.zeros((count, self.count), dtype=np.int64), np.empty((count, SAMPLES), dtype=np.uint32)
        fields = self.entries, self.labels, self.slots, self.values, np.asarray(offsets, dtype=np.float32)
        within = self.numbers, self.bricks, self.place[0], ramp, np.uint64(share_stride(self.shape))
        samples = in_threads(share_cells, *fields, *within, sums, pairs, threads=count)
        listed = np.concatenate([pairs[thread, :number] for thread, number in enumerate(samples)])
        return sums.sum(axis=0), *np.unique(listed, return_counts=True)

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


def smooth_to_distance(
    data: NDArray[np.generic], smoothing: Smoothing, *, spacing: tuple[float, ...], plain: bool, threads: int
) -> SparseField:
    """Smooth the cells of a label to distances from its surface, which change evenly, as walls of labels assume."""
    smoother, profile = (smooth_bricks, PLAIN_PROFILE) if plain else (refine_bricks, REFINED_PROFILE)
    field = smoother(data, smoothing, spacing=spacing, threads=threads)
    return replace(field, values=profile.distance(field.values, out=field.values, threads=threads))


def hash_names(names: NDArray[np.int64]) -> NDArray[np.uint64]:
    """Return numbers that depend on whole numbers (n, k) alone, and not evenly."""
    number = np.zeros(len(names), dtype=np.uint64)
    for column in names.T:
        number = (number ^ column.astype(np.uint64)) * np.uint64(0x9E3779B97F4A7C15)
        number ^= number >> np.uint64(29)
    return number


def brick_stride(bricks: int) -> int:
    """Return how many bricks there are for each from which the slope is taken."""
    return max(1, bricks // SAMPLED_BRICKS)


def slope_of(rises: NDArray[np.float32]) -> float:
    """Return the slope of fields at their surfaces from differences of neighbours: the steepest, across the row."""
    return float(np.quantile(rises, STEEP)) if len(rises) else 1.0


def share_stride(shape: tuple[int, ...]) -> int:
    """Return how many shared cells there are for each that is a sample, at least."""
    return -(-math.prod(shape) // SAMPLES)


def volumes_of_shares(
    sums: NDArray[np.int64],
    pairs: NDArray[np.uint32],
    samples: NDArray[np.int64],
    ramp: float,
    shape: tuple[int, ...],
) -> tuple[NDArray[np.float64], sparse.csr_array]:
    """Return the volumes, and how they change, from `PartitionFields.count_shares`: see `PartitionFields.shares`."""
    ends = (pairs >> 16).astype(np.int64), (pairs & 0xFFFF).astype(np.int64)
    each = share_stride(shape) / (2 * ramp)
    changes = sparse.csr_array((samples * each, ends), shape=(len(sums), len(sums)))
    return sums / PARTS, sparse.csr_array(changes + changes.T)


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
        kept_values = values[is_kept]
        slots = np.concatenate([np.arange(len(kept_values)), np.full(len(inside), INSIDE)]).astype(np.int32)
        return np.ravel_multi_index(tuple(places.T), lattice), slots, kept_values

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
