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

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import spsolve

from infill.partition.fields import PartitionFields
from infill.partition.junctions import smooth_junctions, take_back_crossings
from infill.partition.walls import OUTSIDE, Shifts, WallGraph, Walls, place_walls, trace_walls

PRECISION = 2e-5  # of a label's volume: rounds end when every label is as near
SHARING_ROUNDS = 5  # with volumes by shares of cells
FREE_ROUNDS, HELD_ROUNDS = 10, 14  # with labels that win and lose cells, and with the winner of every cell held
ROUGH = 3e-3  # of a label's volume: about what volumes by shares of cells are off
NEAR = 5e-4  # of a label's volume: from there on, the winner of every cell is held
LARGEST_STEP = 0.3  # of an offset in one round: values lie between -1 and 1
SAMPLED = 300_000  # triangles from which the areas between pairs are taken
# Of what was missing a round before: a label that then has as much too much takes half the step; with jumps, sooner.
TURNED, JUMPED = 0.7, 0.3
MOST_GAIN = 10.0  # of a volume, as a multiple of what was foreseen
MARGINS = 128  # bins of the margin by which a label wins or loses, from -2 to 2
MOST_CELLS = 0.6  # of the cells of a label, in which it wins at first
SMALLEST = 8  # cells of a label that is measured; smaller ones get what they can
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


@dataclass(frozen=True, kw_only=True, eq=False)
class _Round:
    """Volumes with offsets.

    Parameters
    ----------
    walls : WallGraph and Walls, or None
        If they were extracted.
    volumes : (labels,) float64
    changes : (labels, labels) sparse float64
        What the label of a row wins from that of a column for a unit of its offset.
    """

    walls: tuple[WallGraph, Walls] | None
    volumes: NDArray[np.float64]
    changes: sparse.csr_array


@dataclass(frozen=True, kw_only=True, eq=False)
class _Search:
    """The search for the offsets at which every label has its volume.

    Parameters
    ----------
    fields : PartitionFields
    targets : (labels,) float64
        Wanted volumes, in cells of `scale`; 0 where none is sought.
    is_measured : (labels,) bool
        Labels whose volume must be right.
    slope : float
        Of the difference of two values at a wall, for a unit of `scale`.
    scale : (3,) float
        Sides of a cell.
    threads : int, optional
    tell_round : callable
        Called after each round.
    """

    fields: PartitionFields
    targets: NDArray[np.float64]
    is_measured: NDArray[np.bool_]
    slope: float
    scale: tuple[float, ...]
    threads: int | None
    tell_round: Callable[[], None]

    def measure_shares(self, offsets: NDArray[np.float64]) -> _Round:
        """Measure volumes by shares of cells, which is fast and needs no walls."""
        # Wide enough that every wall has cells on its ramp, whatever its direction.
        ramp = self.slope * max(self.scale)
        volumes, changes = self.fields.shares(offsets, ramp, threads=self.threads)
        size = float(np.prod(self.scale))
        return _Round(walls=None, volumes=volumes * size, changes=sparse.csr_array(changes * size))

    def extract(
        self, offsets: NDArray[np.float64], *, held: WallGraph | None = None, shifts: Shifts | None = None
    ) -> tuple[WallGraph, Walls]:
        """Extract the walls between labels.

        Parameters
        ----------
        offsets : (labels,) float64
        held : WallGraph, optional
            The walls of held winners, with which volumes change without jumps.
        shifts : Shifts, optional
            Which make lines smooth.
        """
        graph = held or trace_walls(self.fields.winners(offsets, threads=self.threads), threads=self.threads)
        walls = place_walls(graph, self.fields, offsets, shifts=shifts, scale=self.scale, threads=self.threads)
        return graph, walls

    def measure_in_walls(
        self, offsets: NDArray[np.float64], *, held: WallGraph | None = None, shifts: Shifts | None = None
    ) -> _Round:
        """Measure the volumes within walls; see `extract`."""
        graph, walls = self.extract(offsets, held=held, shifts=shifts)
        changes = neighbour_areas(walls, self.fields.count, self.scale) / self.slope
        return _Round(walls=(graph, walls), volumes=walls.volumes, changes=sparse.csr_array(changes))

    def run(
        self,
        measure: Callable[[NDArray[np.float64]], _Round],
        offsets: NDArray[np.float64],
        *,
        rounds: int,
        enough: float,
        jumps: bool = False,
    ) -> tuple[NDArray[np.float64], tuple[WallGraph, Walls] | None]:
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
            Whether the volumes of single labels may jump: then the sum of errors counts, until the worst is small.
        """
        best, best_score, count = offsets, np.inf, self.fields.count
        walls: tuple[WallGraph, Walls] | None = None
        measured: _Round | None = None
        before, step, largest = np.zeros(count), np.zeros(count), np.full(count, LARGEST_STEP)
        foreseen, gain = np.zeros(count), np.ones(count)
        is_sought = self.targets > 0
        for _ in range(rounds):
            walls = measured = None  # free what was measured before: walls are large
            measured = measure(offsets)
            missing = np.where(is_sought, self.targets - measured.volumes, 0.0)
            off = np.abs(missing[self.is_measured]) / self.targets[self.is_measured]
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
    targets = np.array(volumes, dtype=np.float64)
    targets[0] = 0.0
    rounds = 0

    def tell_round() -> None:
        nonlocal rounds
        rounds += 1
        if progress is not None:
            progress(min(1.0, rounds / (SHARING_ROUNDS + FREE_ROUNDS + HELD_ROUNDS)))

    search = _Search(
        fields=fields,
        targets=targets,
        is_measured=targets >= SMALLEST * np.prod(scale),
        slope=2 * fields.slope() / scale[2],
        scale=scale,
        threads=threads,
        tell_round=tell_round,
    )
    offsets, _ = search.run(
        search.measure_shares, first_offsets(fields, threads=threads), rounds=SHARING_ROUNDS, enough=ROUGH
    )
    offsets, traced = search.run(search.measure_in_walls, offsets, rounds=FREE_ROUNDS, enough=NEAR, jumps=True)
    graph, walls = traced or search.extract(offsets)
    del traced
    shifts, crossings = smooth_junctions(graph, walls, threads=threads), 0
    for _ in range(SMOOTHING_ROUNDS):
        del walls
        measure = partial(search.measure_in_walls, held=graph, shifts=shifts)
        offsets, placed = search.run(measure, offsets, rounds=HELD_ROUNDS, enough=PRECISION)
        _, walls = placed or search.extract(offsets, held=graph, shifts=shifts)
        del placed
        remaining, crossings = take_back_crossings(walls, shifts, scale, threads=threads)
        if remaining is shifts:
            break
        shifts = remaining
    else:
        _, walls = search.extract(offsets, held=graph, shifts=shifts)
    return VolumePartition(graph=graph, walls=walls, offsets=offsets, rounds=rounds, crossings=crossings)


def first_offsets(fields: PartitionFields, *, threads: int | None = None) -> NDArray[np.float64]:
    """Return offsets with which every label wins in most of its given cells, however small it is; 0 for large ones."""
    margins = fields.margins(MARGINS, threads=threads)
    sums = margins.cumsum(axis=1)
    # The margin that is exceeded in most of the cells of a label: below 0, another label wins there.
    low = (sums < (1 - MOST_CELLS) * sums[:, -1:]).sum(axis=1)
    margin = (low + 0.5) * 4 / MARGINS - 2
    offsets: NDArray[np.float64] = np.maximum(-margin, 0.0)
    offsets[0] = 0.0
    return offsets


def neighbour_areas(walls: Walls, count: int, scale: tuple[float, ...]) -> sparse.csr_array:
    """Return the areas between labels, from a sample of the triangles."""
    stride = max(1, len(walls.triangles) // SAMPLED)
    sides = walls.sides[::stride]
    inner = sides[:, 1] != OUTSIDE
    corners = walls.points[walls.triangles[::stride][inner]] * np.array(scale)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    a, b = sides[inner].T
    graph = sparse.csr_array((areas * stride, (a, b)), shape=(count, count))
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
