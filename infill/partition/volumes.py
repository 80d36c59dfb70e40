"""Offsets at which every label of a partition keeps its volume: Newton's method on the dual problem.

Raising the value of a label moves its walls outwards, by as much as the difference of values is flat there. With
A_kl the area of the wall between k and l, and s the slope of the difference, volumes change as

    dV_k = sum_l A_kl (do_k - do_l) / s,

a Laplacian on the graph of neighbours. s is that of two fields with the profile of the interface.
Source of the problem: Jacobs, Merkurjev and Esedoglu, J. Comput. Phys. 354 (2018), which thresholds instead.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve

from infill.partition.fields import PartitionFields
from infill.partition.junctions import on_side, smooth_junctions, take_back_crossings
from infill.partition.walls import OUTSIDE, WallGraph, Walls, measure_volumes, place_walls, trace_walls

PRECISION = 2e-5  # of a label's volume: rounds end when every label is as near
FREE_ROUNDS, MOST_ROUNDS = 10, 24  # in the first ones, labels may win and lose cells
NEAR = 5e-4  # of a label's volume: from there on, the winner of every cell is held
LARGEST_STEP = 0.3  # of an offset in one round: values lie between -1 and 1
SAMPLED = 300_000  # triangles from which the areas between pairs are taken
TURNED = 0.3  # of what was missing a round before: a label that then has as much too much takes half the step
MARGINS = 128  # bins of the margin by which a label wins or loses, from -2 to 2
MOST_CELLS = 0.6  # of the cells of a label, in which it wins at first
SMALLEST = 8  # cells of a label that is measured; smaller ones get what they can
SMOOTHING_ROUNDS = 4  # of restoring volumes, and taking back moves by which triangles cross
RESTORING_ROUNDS = 6  # of moving walls; each leaves about a tenth
GONE = 1e-3  # of its volume: a label with less has vanished
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
        How often the walls were extracted.
    crossings : int
        Pairs of triangles that pass through each other.
    """

    graph: WallGraph
    walls: Walls
    offsets: NDArray[np.float64]
    rounds: int
    crossings: int = 0


def keep_volumes(
    fields: PartitionFields,
    volumes: NDArray[np.floating],
    *,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> VolumePartition:
    """Find the offsets at which every label has its volume.

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
    targets = np.asarray(volumes, dtype=np.float64)
    offsets = first_offsets(fields, threads=threads)
    is_sought = targets > 0
    is_sought[0] = False
    slope = 2 * fields.slope() / scale[2]  # of the difference of two values
    best: VolumePartition | None = None
    frozen: WallGraph | None = None
    best_score = np.inf
    is_measured = is_sought & (targets >= SMALLEST * np.prod(scale))
    before, step = np.zeros(fields.count), np.zeros(fields.count)
    largest = np.full(fields.count, LARGEST_STEP)
    for number in range(MOST_ROUNDS):
        if best is not None and frozen is None and (number >= FREE_ROUNDS or best_score < NEAR):
            # With the winners held, volumes change without jumps.
            offsets, frozen = best.offsets.copy(), best.graph
            largest, before = np.full(fields.count, LARGEST_STEP), np.zeros(fields.count)
        graph = frozen or trace_walls(fields.winners(offsets, threads=threads), threads=threads)
        walls = place_walls(graph, fields, offsets, scale=scale, threads=threads)
        missing = np.where(is_sought, targets - walls.volumes, 0.0)
        off = np.abs(missing) / np.maximum(targets, 1e-300)
        error = float(off[is_measured].max(initial=0.0))
        # At first the sum counts, since single labels jump; then the worst label.
        score = error if frozen is not None or error < NEAR else 1.0 + float(off[is_measured].sum())
        if best is None or score < best_score:
            best_score, best = (
                score,
                VolumePartition(graph=graph, walls=walls, offsets=offsets.copy(), rounds=number + 1),
            )
        if progress is not None:
            progress((number + 1) / MOST_ROUNDS)
        if error <= PRECISION:
            break
        turned = (missing * before < 0) & (np.abs(missing) > TURNED * np.abs(before))
        largest = np.where(turned, np.abs(step) / 2, largest)
        step = _solve(_neighbour_areas(walls, fields.count, scale), missing, is_sought) * slope
        gone = is_sought & (walls.volumes < GONE * targets)
        step[gone] = LARGEST_STEP  # where nothing is, nothing says how far it is
        step, before = np.clip(step, -largest, largest), missing
        offsets = np.clip(offsets + step, -LARGEST_OFFSET, LARGEST_OFFSET)
    assert best is not None
    return _smooth_lines(best, np.where(is_measured, targets, 0.0), scale, threads)


def _smooth_lines(
    partition: VolumePartition, targets: NDArray[np.float64], scale: tuple[float, ...], threads: int | None
) -> VolumePartition:
    """Make the lines smooth on which three labels meet, without crossings and with every volume (0: not sought)."""
    graph, jagged = partition.graph, partition.walls
    points, crossings = smooth_junctions(graph, jagged), 0
    volumes_within = partial(measure_volumes, graph, labels=len(targets), scale=scale, threads=threads)
    walls = replace(jagged, points=points, volumes=volumes_within(points))
    for _ in range(SMOOTHING_ROUNDS if points is not jagged.points else 0):
        walls = restore_volumes(graph, walls, targets, scale=scale, threads=threads)
        points, crossings = take_back_crossings(jagged, walls.points, scale, threads=threads)
        if np.array_equal(points, walls.points):
            break
        walls = replace(walls, points=points, volumes=volumes_within(points))
    return replace(partition, walls=walls, crossings=crossings)


def restore_volumes(
    graph: WallGraph,
    walls: Walls,
    targets: NDArray[np.float64],
    *,
    scale: tuple[float, ...],
    threads: int | None = None,
) -> Walls:
    """Move walls along their normals until every label has its volume.

    The wall between k and l moves by m_k - m_l, and the moves m solve the same equation as offsets do.

    Parameters
    ----------
    graph, walls : WallGraph, Walls
    targets : (labels,) float64
        Volumes, 0 for labels whose volume is not sought.
    scale : (3,) float
        Sides of a cell.
    """
    volumes_within = partial(measure_volumes, graph, labels=len(targets), scale=scale, threads=threads)
    walls = replace(walls, volumes=volumes_within(walls.points))
    sides, is_sought = np.array(scale), targets > 0
    fixed, inner = on_side(walls.points, graph.winners.shape), walls.sides[:, 1] != OUTSIDE
    triangles, (behind, before) = walls.triangles[inner], walls.sides[inner].T
    best, best_error = walls, np.inf
    for _ in range(RESTORING_ROUNDS):
        missing = np.where(is_sought, targets - walls.volumes, 0.0)
        error = float(np.max(np.abs(missing[is_sought]) / targets[is_sought], initial=0.0))
        if error < best_error:
            best, best_error = walls, error
        if error <= PRECISION:
            break
        moves = _solve(_neighbour_areas(walls, len(targets), scale), missing, is_sought)
        corners = (walls.points * sides)[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area, along = np.linalg.norm(normals, axis=1), normals * (moves[behind] - moves[before])[:, None]
        total, shift = np.zeros(len(fixed)), np.zeros(fixed.shape)
        for corner in triangles.T:
            total += np.bincount(corner, area, len(fixed))
            shift += np.stack([np.bincount(corner, part, len(fixed)) for part in along.T], axis=1)
        shift /= np.maximum(total, 1e-300)[:, None] * sides
        points = walls.points + np.where(fixed, 0.0, shift).astype(np.float32)
        walls = replace(walls, points=points, volumes=volumes_within(points))
    return best


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


def _neighbour_areas(walls: Walls, count: int, scale: tuple[float, ...]) -> sparse.csr_array:
    """Return the Laplacian of the areas between labels, from a sample of the triangles; each row sums to 0."""
    stride = max(1, len(walls.triangles) // SAMPLED)
    sides = walls.sides[::stride]
    inner = sides[:, 1] != OUTSIDE
    corners = walls.points[walls.triangles[::stride][inner]] * np.array(scale)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    a, b = sides[inner].T
    graph = sparse.csr_array((areas * stride, (a, b)), shape=(count, count))
    graph = graph + graph.T
    return sparse.csr_array(sparse.diags_array(graph.sum(axis=1)) - graph)


def _solve(
    laplacian: sparse.csr_array, missing: NDArray[np.float64], is_sought: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Solve for the offsets of the labels whose volume is sought, those of the others 0."""
    chosen = np.flatnonzero(is_sought)
    matrix = laplacian[chosen][:, chosen]
    diagonal = matrix.diagonal()
    # Without label 0 beside them, only the differences count: a small share of each area holds them near 0.
    matrix = matrix + sparse.diags_array(1e-6 * diagonal + (diagonal == 0) + 1e-12)
    step = np.zeros(len(missing))
    step[chosen] = spsolve(sparse.csc_array(matrix), missing[chosen])
    return step
