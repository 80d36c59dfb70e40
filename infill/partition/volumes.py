"""Offsets at which every label of a partition keeps its volume: Newton's method on the dual problem.

Raising the value of a label moves its walls outwards, by as much as the difference of values is flat there. With
A_kl the area of the wall between k and l, and s the slope of the difference, volumes change as

    dV_k = sum_l A_kl (do_k - do_l) / s,

a Laplacian on the graph of neighbours. s is that of two fields with the profile of the interface.
Source of the problem: Jacobs, Merkurjev and Esedoglu, J. Comput. Phys. 354 (2018), which thresholds instead.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import spsolve

from infill.kernels.partition import sample_triangles
from infill.partition.fields import PartitionFields
from infill.partition.junctions import smooth_junctions, take_back_crossings
from infill.partition.walls import OUTSIDE, Shifts, WallGraph, Walls, place_walls, trace_walls

PRECISION = 2e-5  # of a label's volume: rounds end when every label is as near
SHARING_ROUNDS = 5  # with volumes by shares of cells
FREE_ROUNDS, HELD_ROUNDS = 10, 14  # with labels that win and lose cells, and with the winner of every cell held
ROUGH = 3e-3  # of a label's volume: about what volumes by shares of cells are off
NEAR = 5e-4  # of a label's volume: from there on, the winner of every cell is held
LARGEST_STEP = 0.3  # of an offset in one round: values lie between -1 and 1
SAMPLED = 300_000  # triangles from which the areas between pairs are taken, about
TRIANGLES_PER_BRICK = 50  # of walls, for each brick of a label that has values, about
AREA_PARTS = 2.0**32  # of a cell's face, in which areas are counted: sums are exact in any order
# Of what was missing a round before: a label that then has as much too much takes half the step; with jumps, sooner.
TURNED, JUMPED = 0.7, 0.3
MOST_GAIN = 10.0  # of a volume, as a multiple of what was foreseen
MARGINS = 128  # bins of the margin by which a label wins or loses, from -2 to 2
MOST_CELLS = 0.6  # of the cells of a label, in which it wins at first
SMALLEST = 8  # cells of a label that is measured; smaller ones get what they can
SMALL_NEAR = 0.05  # of the volume of a smaller label: as near as NEAR is for the others
SMOOTHING_ROUNDS = 4  # of finding volumes with smooth lines, and taking back shifts by which triangles cross
GONE = 1e-3  # of its volume: a label with less has vanished
HELD_SHARE, ROUNDING = 1e-6, 1e-9  # of areas: holds what is free, and is as good as none
LARGEST_OFFSET = 2.2  # two labels at +1 and -1 change places


@dataclass(frozen=True, kw_only=True, eq=False)
class VolumePartition:
    """Walls between labels, and the offsets that give each its volume.

    Parameters
    ----------
    graph : WallGraph
    walls : Walls
    offsets : (labels,) float64
    rounds : int
        How often volumes were measured.
    crossings : int
        Pairs of triangles that pass through each other.
    """

    graph: WallGraph
    walls: Walls
    offsets: NDArray[np.float64]
    rounds: int
    crossings: int = 0


class HasVolumes(Protocol):
    """Walls whose volumes are known."""

    @property
    def volumes(self) -> NDArray[np.float64]:
        """Of every label, (labels,); that of 0 is the rest of the box. Cells."""


Graph = TypeVar("Graph")
Placed = TypeVar("Placed", bound=HasVolumes)
Moved = TypeVar("Moved")


class WallSource(Protocol[Graph, Placed, Moved]):
    """The questions of the search for offsets to a partition, which may be in memory or in chunks."""

    @property
    def count(self) -> int:
        """Labels, 0 among them."""

    def slope(self) -> float:
        """Return the slope of a field at its surface: see `PartitionFields.slope`."""

    def margins(self, bins: int) -> NDArray[np.int64]:
        """Count cells by their margins: see `PartitionFields.margins`."""

    def shares(self, offsets: NDArray[np.float64], ramp: float) -> tuple[NDArray[np.float64], sparse.csr_array]:
        """Return volumes and their changes: see `PartitionFields.shares`."""

    def extract(
        self, offsets: NDArray[np.float64], *, held: Graph | None = None, shifts: Moved | None = None
    ) -> tuple[Graph, Placed]:
        """Extract the walls between labels; with `held`, those of held winners; with `shifts`, with smooth lines."""

    def areas(self, walls: Placed) -> sparse.csr_array:
        """Return the areas between labels: see `neighbour_areas`."""

    def smooth_lines(self, graph: Graph, walls: Placed) -> Moved:
        """Return shifts by which lines become smooth: see `infill.partition.junctions.smooth_junctions`."""

    def take_back(self, walls: Placed, shifts: Moved) -> tuple[Moved, int]:
        """Take back shifts of crossing triangles: see `infill.partition.junctions.take_back_crossings`."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WholePartition:
    """A partition in memory.

    Parameters
    ----------
    fields : PartitionFields
    scale : (3,) float
        Sides of a cell.
    threads : int, optional
    """

    fields: PartitionFields
    scale: tuple[float, ...]
    threads: int | None

    @property
    def count(self) -> int:
        """Labels, 0 among them."""
        return self.fields.count

    def slope(self) -> float:
        """Return the slope of a field at its surface."""
        return self.fields.slope()

    def margins(self, bins: int) -> NDArray[np.int64]:
        """Count cells by their margins."""
        return self.fields.margins(bins, threads=self.threads)

    def shares(self, offsets: NDArray[np.float64], ramp: float) -> tuple[NDArray[np.float64], sparse.csr_array]:
        """Return volumes and their changes."""
        return self.fields.shares(offsets, ramp, threads=self.threads)

    def extract(
        self, offsets: NDArray[np.float64], *, held: WallGraph | None = None, shifts: Shifts | None = None
    ) -> tuple[WallGraph, Walls]:
        """Extract the walls between labels."""
        graph = held or trace_walls(self.fields.winners(offsets, threads=self.threads), threads=self.threads)
        return graph, place_walls(graph, self.fields, offsets, shifts=shifts, scale=self.scale, threads=self.threads)

    def areas(self, walls: Walls) -> sparse.csr_array:
        """Return the areas between labels."""
        return neighbour_areas(walls, self.count, self.scale, triangle_stride(len(self.fields.values)))

    def smooth_lines(self, graph: WallGraph, walls: Walls) -> Shifts:
        """Return shifts by which lines become smooth."""
        return smooth_junctions(graph, walls, threads=self.threads)

    def take_back(self, walls: Walls, shifts: Shifts) -> tuple[Shifts, int]:
        """Take back shifts of crossing triangles."""
        return take_back_crossings(walls, shifts, self.scale, threads=self.threads)


@dataclass(frozen=True, kw_only=True, eq=False)
class FoundOffsets(Generic[Graph, Placed, Moved]):
    """Offsets that give every label its volume: see `VolumePartition`; with the shifts of points on lines."""

    graph: Graph
    walls: Placed
    shifts: Moved
    offsets: NDArray[np.float64]
    rounds: int
    crossings: int


@dataclass(frozen=True, kw_only=True, eq=False)
class _Round(Generic[Graph, Placed]):
    """Volumes with offsets.

    Parameters
    ----------
    walls : graph and placed walls, or None
        If they were extracted.
    volumes : (labels,) float64
    changes : (labels, labels) sparse float64
        What the label of a row wins from that of a column for a unit of its offset.
    """

    walls: tuple[Graph, Placed] | None
    volumes: NDArray[np.float64]
    changes: sparse.csr_array


@dataclass(frozen=True, kw_only=True, eq=False)
class _Search(Generic[Graph, Placed, Moved]):
    """The search for the offsets at which every label has its volume.

    Parameters
    ----------
    source : WallSource
    targets : (labels,) float64
        Wanted volumes, in cells of `scale`; 0 where none is sought.
    is_measured : (labels,) bool
        Labels whose volume must be right.
    slope : float
        Of the difference of two values at a wall, for a unit of `scale`.
    scale : (3,) float
        Sides of a cell.
    tell_round : callable
        Called after each round.
    """

    source: WallSource[Graph, Placed, Moved]
    targets: NDArray[np.float64]
    is_measured: NDArray[np.bool_]
    slope: float
    scale: tuple[float, ...]
    tell_round: Callable[[], None]

    def measure_shares(self, offsets: NDArray[np.float64]) -> _Round[Graph, Placed]:
        """Measure volumes by shares of cells, which is fast and needs no walls."""
        # Wide enough that every wall has cells on its ramp, whatever its direction.
        ramp = self.slope * max(self.scale)
        volumes, changes = self.source.shares(offsets, ramp)
        size = float(np.prod(self.scale))
        return _Round(walls=None, volumes=volumes * size, changes=sparse.csr_array(changes * size))

    def measure_in_walls(
        self, offsets: NDArray[np.float64], *, held: Graph | None = None, shifts: Moved | None = None
    ) -> _Round[Graph, Placed]:
        """Measure the volumes within walls; see `WallSource.extract`."""
        graph, walls = self.source.extract(offsets, held=held, shifts=shifts)
        changes = self.source.areas(walls) / self.slope
        return _Round(walls=(graph, walls), volumes=walls.volumes, changes=sparse.csr_array(changes))

    def relative_errors(self, missing: NDArray[np.float64], *, with_small: bool) -> NDArray[np.float64]:
        """Return the missing volumes as shares of those of labels; of small labels, so that `SMALL_NEAR` is `NEAR`."""
        is_counted = self.targets > 0 if with_small else self.is_measured
        weights = np.where(self.is_measured, 1.0, NEAR / SMALL_NEAR)[is_counted]
        errors: NDArray[np.float64] = weights * np.abs(missing[is_counted]) / self.targets[is_counted]
        return errors

    def run(
        self,
        measure: Callable[[NDArray[np.float64]], _Round[Graph, Placed]],
        offsets: NDArray[np.float64],
        *,
        rounds: int,
        enough: float,
        jumps: bool = False,
    ) -> tuple[NDArray[np.float64], tuple[Graph, Placed] | None]:
        """Find offsets by Newton's method; return the best and their walls, or None if later ones replaced them.

        Parameters
        ----------
        measure : callable
            Measures the volumes of labels with offsets.
        offsets : (labels,) float64
            To begin with.
        rounds : int
            At most.
        enough : float
            The error, as a share of the volume of a label, at which rounds end.
        jumps : bool
            Whether the volumes of single labels may jump: then the sum of errors counts, until the worst is small; and
            labels too small to be measured count, by `SMALL_NEAR`.
        """
        best, best_score, count = offsets, np.inf, self.source.count
        walls: tuple[Graph, Placed] | None = None
        measured: _Round[Graph, Placed] | None = None
        before, step, largest = np.zeros(count), np.zeros(count), np.full(count, LARGEST_STEP)
        foreseen, gain = np.zeros(count), np.ones(count)
        is_sought = self.targets > 0
        for _ in range(rounds):
            walls = measured = None  # free what was measured before: walls are large
            measured = measure(offsets)
            missing = np.where(is_sought, self.targets - measured.volumes, 0.0)
            off = self.relative_errors(missing, with_small=jumps)
            error = float(off.max(initial=0.0))
            score = 1.0 + float(off.sum()) if jumps and error >= enough else error
            if score < best_score:
                best_score, best, walls = score, offsets, measured.walls
            self.tell_round()
            if error <= enough:
                break
            # Where fields are flatter than the profile, volumes change by more than foreseen.
            is_moved = np.abs(foreseen) > PRECISION * self.targets
            ratio = np.divide(before - missing, foreseen, out=gain.copy(), where=is_moved)
            gain = np.clip(ratio, 1.0, MOST_GAIN)
            turned = (missing * before < 0) & (np.abs(missing) > (JUMPED if jumps else TURNED) * np.abs(before))
            largest = np.where(turned, np.abs(step) / 2, np.minimum(2 * largest, LARGEST_STEP))
            step = solve_steps(measured.changes, missing, is_sought) / gain
            step[is_sought & (measured.volumes < GONE * self.targets)] = LARGEST_STEP  # nothing says how far it is
            step, before = np.clip(step, -largest, largest), missing
            foreseen = measured.changes.sum(axis=1) * step - measured.changes @ step
            offsets = np.clip(offsets + step, -LARGEST_OFFSET, LARGEST_OFFSET)
        return best, walls


def keep_volumes(
    fields: PartitionFields,
    volumes: NDArray[np.floating],
    *,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> VolumePartition:
    """Find the offsets at which every label has its volume, with smooth lines where three labels meet.

    Parameters
    ----------
    fields : PartitionFields
    volumes : (labels,) float
        Wanted, in cells of `scale`; that of 0 is the rest.
    scale : (3,) float
        Sides of a cell; the smallest is 1.
    progress : callable, optional
        Called with the share of rounds done.
    """
    source = WholePartition(fields=fields, scale=scale, threads=threads)
    solution = find_offsets(source, volumes, scale=scale, progress=progress)
    return VolumePartition(
        graph=solution.graph,
        walls=solution.walls,
        offsets=solution.offsets,
        rounds=solution.rounds,
        crossings=solution.crossings,
    )


def find_offsets(
    source: WallSource[Graph, Placed, Moved],
    volumes: NDArray[np.floating],
    *,
    scale: tuple[float, ...],
    progress: Callable[[float], None] | None = None,
) -> FoundOffsets[Graph, Placed, Moved]:
    """Find the offsets at which every label has its volume: see `keep_volumes`."""
    targets = np.array(volumes, dtype=np.float64)
    targets[0] = 0.0
    rounds = 0

    def tell_round() -> None:
        nonlocal rounds
        rounds += 1
        if progress is not None:
            progress(min(1.0, rounds / (SHARING_ROUNDS + FREE_ROUNDS + HELD_ROUNDS)))

    search = _Search(
        source=source,
        targets=targets,
        is_measured=targets >= SMALLEST * np.prod(scale),
        slope=2 * source.slope() / scale[2],
        scale=scale,
        tell_round=tell_round,
    )
    first = first_offsets(source.margins(MARGINS))
    offsets, _ = search.run(search.measure_shares, first, rounds=SHARING_ROUNDS, enough=ROUGH)
    offsets, traced = search.run(search.measure_in_walls, offsets, rounds=FREE_ROUNDS, enough=NEAR, jumps=True)
    graph, walls = traced or source.extract(offsets)
    del traced
    shifts, crossings = source.smooth_lines(graph, walls), 0
    for _ in range(SMOOTHING_ROUNDS):
        del walls
        measure = partial(search.measure_in_walls, held=graph, shifts=shifts)
        offsets, placed = search.run(measure, offsets, rounds=HELD_ROUNDS, enough=PRECISION)
        _, walls = placed or source.extract(offsets, held=graph, shifts=shifts)
        del placed
        remaining, crossings = source.take_back(walls, shifts)
        if remaining is shifts:
            break
        shifts = remaining
    else:
        _, walls = source.extract(offsets, held=graph, shifts=shifts)
    return FoundOffsets(graph=graph, walls=walls, shifts=shifts, offsets=offsets, rounds=rounds, crossings=crossings)


def triangle_stride(bricks: int) -> int:
    """Return how many triangles there are for each of which the area is taken, by the bricks that have values."""
    return max(1, bricks * TRIANGLES_PER_BRICK // SAMPLED)


def first_offsets(margins: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return offsets with which every label wins in most of its given cells, however small it is; 0 for large ones.

    `margins` (labels, n) are those of `WallSource.margins`.
    """
    sums = margins.cumsum(axis=1)
    # The margin that is exceeded in most of the cells of a label: below 0, another label wins there.
    low = (sums < (1 - MOST_CELLS) * sums[:, -1:]).sum(axis=1)
    margin = (low + 0.5) * 4 / MARGINS - 2
    offsets: NDArray[np.float64] = np.maximum(-margin, 0.0)
    offsets[0] = 0.0
    return offsets


def neighbour_areas(walls: Walls, count: int, scale: tuple[float, ...], stride: int | None = None) -> sparse.csr_array:
    """Return the areas between labels, from one of `stride` triangles."""
    if stride is None:
        stride = max(1, len(walls.triangles) // SAMPLED)
    return areas_of_sums(*sum_areas(walls.points, walls.triangles, walls.sides, count, scale, stride), stride, count)


def sum_areas(
    points: NDArray[np.float32],
    triangles: NDArray[np.integer],
    sides: NDArray[np.integer],
    count: int,
    scale: tuple[float, ...],
    stride: int,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sum the areas of one of `stride` triangles in whole numbers; return pairs of labels, (n,), and their sums."""
    if stride > 1:
        room = np.empty(2 * len(triangles) // stride + SAMPLED, dtype=np.int64)
        sample = room[: sample_triangles(points.view(np.uint32), triangles, np.uint64(stride), room)]
        triangles, sides = triangles[sample], sides[sample]
    inner = sides[:, 1] != OUTSIDE
    corners = points[triangles[inner]] * np.array(scale)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    pairs, place = np.unique(sides[inner].astype(np.int64) @ [count, 1], return_inverse=True)
    sums = np.zeros(len(pairs), dtype=np.int64)
    np.add.at(sums, place, np.rint(areas * AREA_PARTS).astype(np.int64))
    return pairs, sums


def areas_of_sums(pairs: NDArray[np.int64], sums: NDArray[np.int64], stride: int, count: int) -> sparse.csr_array:
    """Return the areas between labels from `sum_areas`, in which every pair is there once."""
    graph = sparse.csr_array((sums * (stride / AREA_PARTS), np.divmod(pairs, count)), shape=(count, count))
    return sparse.csr_array(graph + graph.T)


def solve_steps(
    changes: sparse.csr_array, missing: NDArray[np.float64], is_sought: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Solve for the steps of the labels whose volume is sought; those of the others are 0."""
    laplacian = sparse.csr_array(sparse.diags_array(changes.sum(axis=1)) - changes)
    chosen = np.flatnonzero(is_sought)
    matrix = laplacian[chosen][:, chosen]
    diagonal = matrix.diagonal()
    # Without walls to labels whose offset is 0, only the differences count: their mean is held.
    _, component = csgraph.connected_components(matrix, directed=False)
    is_free = np.bincount(component, matrix.sum(axis=1)) <= ROUNDING * np.bincount(component, diagonal)
    mean = np.bincount(component, missing[chosen]) / np.bincount(component)
    matrix = matrix + sparse.diags_array(HELD_SHARE * diagonal + (diagonal == 0) + 1e-12)
    step = np.zeros(len(missing))
    step[chosen] = spsolve(sparse.csc_array(matrix), missing[chosen] - np.where(is_free, mean, 0.0)[component])
    return step
