"""The complex of walls between labels: points, triangles, and the labels on both sides of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.kernels import cutting
from infill.kernels import partition as kernels
from infill.kernels.threads import in_order, in_threads, thread_count
from infill.partition.fields import PartitionFields
from infill.partition.tetrahedra import FACE_SLOT, FACES, STEPS, TETRAHEDRA, TETRAHEDRON_SLOT, make_tables

OUTSIDE = kernels.NONE  # instead of a label: beyond the box
CUTTING = np.array(STEPS), np.array(FACES), np.array(TETRAHEDRA)
SLOTS_AT = np.array([FACE_SLOT, TETRAHEDRON_SLOT])


@dataclass(frozen=True, kw_only=True, eq=False)
class Walls:
    """Triangles that part the labels of a grid from each other; each wall is there once, for both its labels.

    Parameters
    ----------
    points : (P, 3) float32
        In cells of the grid, from its lower corner.
    triangles : (T, 3) int32, int64 from 2³¹ points on
    sides : (T, 2) int32
        The labels behind and before each triangle, which faces the second; `OUTSIDE` beyond the box.
    volumes : (labels,) float64
        Of every label; that of 0 is the rest of the box. Cells.
    """

    points: NDArray[np.float32]
    triangles: NDArray[np.integer]
    sides: NDArray[np.int32]
    volumes: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class WallGraph:
    """Which triangles part the labels, as the winners alone decide; their points may still move.

    Parameters
    ----------
    winners : (n0, n1, n2) uint16
        The label of every cell.
    row_starts : (n0 + 2, n1 + 2, 6) int64
        Bases, points and triangles before each row of the lattice, and before the next.
    bases, masks : (b,) int32
        Bases of points along their rows, and the points that each owns, as bits.
    starts : (b,) int64
        The number of the first of these.
    triangles : (T, 3) int32, int64 from 2³¹ points on
    sides : (T, 2) int32
    """

    winners: NDArray[np.uint16]
    row_starts: NDArray[np.int64]
    bases: NDArray[np.int32]
    masks: NDArray[np.int32]
    starts: NDArray[np.int64]
    triangles: NDArray[np.integer]
    sides: NDArray[np.int32]

    @property
    def point_count(self) -> int:
        """Number of points."""
        return int(self.row_starts[-1, -1, 4])


@dataclass(frozen=True, kw_only=True, eq=False)
class Shifts:
    """Points that do not lie where the values of labels are equal, and by how much.

    Parameters
    ----------
    points : (M,) int64
        Their numbers.
    vectors : (M, 3) float32
        Cells.
    """

    points: NDArray[np.int64]
    vectors: NDArray[np.float32]


def trace_walls(winners: NDArray[np.uint16], *, threads: int | None = None) -> WallGraph:
    """Trace the walls between the labels of cells."""
    count = thread_count(threads)
    tables, shape = make_tables(), winners.shape
    sizes = np.zeros((shape[0] + 2, shape[1] + 2, 3), dtype=np.int64)
    common = winners, *CUTTING
    in_threads(
        kernels.count_rows,
        winners,
        *CUTTING[1:],
        SLOTS_AT,
        tables.counts,
        tables.flat_counts,
        tables.flat_triangles,
        sizes,
        threads=count,
    )
    ends = sizes.reshape(-1, 3).cumsum(axis=0).reshape(sizes.shape)
    row_starts = np.concatenate([ends - sizes, ends], axis=-1)
    base_count, point_count, triangle_count = (int(end) for end in ends.reshape(-1, 3)[-1])
    bases, masks = (np.empty(base_count, dtype=np.int32) for _ in range(2))
    starts = np.empty(base_count, dtype=np.int64)
    in_threads(kernels.fill_rows, winners, *CUTTING[1:], SLOTS_AT, row_starts, bases, masks, starts, threads=count)
    triangles = np.empty((triangle_count, 3), dtype=np.int32 if point_count < 2**31 else np.int64)
    sides = np.empty((triangle_count, 2), dtype=np.int32)
    inner, flat = (
        (tables.places, tables.counts, tables.triangles),
        (tables.flat_places, tables.flat_counts, tables.flat_triangles),
    )
    rows = row_starts, bases, masks, starts
    in_threads(kernels.write_triangles, *common, *inner, *flat, *rows, triangles, sides, threads=count)
    return WallGraph(
        winners=winners,
        row_starts=row_starts,
        bases=bases,
        masks=masks,
        starts=starts,
        triangles=triangles,
        sides=sides,
    )


def place_walls(
    graph: WallGraph,
    fields: PartitionFields,
    offsets: NDArray[np.floating],
    *,
    shifts: Shifts | None = None,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
) -> Walls:
    """Place the points of walls where the values of labels, plus their offsets, are equal.

    Parameters
    ----------
    graph : WallGraph
    fields : PartitionFields
    offsets : (labels,) float
        Added to the values of each label.
    shifts : Shifts, optional
        Added to the places of points.
    scale : (3,) float
        Sides of a cell, in which volumes and areas are measured.
    """
    count = thread_count(threads)
    points = np.empty((graph.point_count, 3), dtype=np.float32)
    rows = graph.row_starts, graph.bases, graph.masks, graph.starts
    added = np.asarray(offsets, dtype=np.float32)
    values = fields.entries, fields.labels, fields.slots, fields.values, added
    in_threads(kernels.place_points, graph.winners, *CUTTING, SLOTS_AT, *rows, *values, points, threads=count)
    if shifts is not None:
        points[shifts.points] += shifts.vectors
    volumes = measure_volumes(graph, points, fields.count, scale=scale, threads=threads)
    return Walls(points=points, triangles=graph.triangles, sides=graph.sides, volumes=volumes)


def measure_volumes(
    graph: WallGraph,
    points: NDArray[np.float32],
    labels: int,
    *,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
) -> NDArray[np.float64]:
    """Measure the volume of every label within points, (labels,) in cells of `scale`; 0 has the rest of the box."""
    count = thread_count(threads)
    sums = np.zeros((count, labels))
    sides = np.array(scale, dtype=np.float64)
    in_threads(kernels.add_volumes, points, graph.triangles, graph.sides, sides, sums, threads=count)
    volumes: NDArray[np.float64] = sums.sum(axis=0) / 6
    volumes[0] = np.prod(np.multiply(graph.winners.shape, scale)) - volumes[1:].sum()
    return volumes


@dataclass(frozen=True, kw_only=True, eq=False)
class CutLabel:
    """The triangles around one label, which face away from it.

    Parameters
    ----------
    label : int
    points : (V,) int64
        Numbers of points in the complex, in order.
    faces : (F, 3) int32, int64 from 2³¹ points on
        Places in `points`.
    """

    label: int
    points: NDArray[np.int64]
    faces: NDArray[np.integer]


def cut_labels(walls: Walls, labels: int, *, threads: int | None = None) -> Iterator[CutLabel]:
    """Yield the walls of labels 1, 2 ... up to but without `labels`; labels without any are left out."""
    count = thread_count(threads)
    starts = np.zeros((labels + 1, 2), dtype=np.int64)
    cutting.count_sides(walls.sides, starts)
    kind = np.int32 if len(walls.triangles) < np.iinfo(np.int32).max else np.int64
    orders = [np.empty(starts[-1, side], dtype=kind) for side in range(2)]
    cutting.sort_sides(walls.sides, starts[:-1].copy(), *orders)
    tables = [np.full(len(walls.points), -1, dtype=walls.triangles.dtype) for _ in range(count)]

    def cut_label(label: int) -> CutLabel:
        """Cut out one label: renumber its points and triangles."""
        behind, before = (order[starts[label, side] : starts[label + 1, side]] for side, order in enumerate(orders))
        faces = np.empty((len(behind) + len(before), 3), dtype=walls.triangles.dtype)
        points = np.empty(3 * len(faces), dtype=np.int64)
        table = tables.pop()  # each thread has one
        points = np.sort(points[: cutting.list_points(walls.triangles, behind, before, table, points)])
        cutting.number_faces(walls.triangles, behind, before, table, points, faces)
        tables.append(table)
        return CutLabel(label=label, points=points, faces=faces)

    for _, piece in in_order(cut_label, range(1, labels), threads=count):
        if len(piece.faces):
            yield piece
