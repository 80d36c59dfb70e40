"""The complex of walls between labels: points, triangles, and the labels on both sides of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.kernels import cutting, wall_points
from infill.kernels import partition as kernels
from infill.kernels.threads import in_order, in_threads, thread_count
from infill.partition.fields import PartitionFields
from infill.partition.tetrahedra import FACE_SLOT, FACES, STEPS, TETRAHEDRA, TETRAHEDRON_SLOT, make_tables

OUTSIDE = kernels.NONE  # instead of a label: beyond the box
CUTTING = np.array(STEPS), np.array(FACES), np.array(TETRAHEDRA)
MOST_INT16 = np.iinfo(np.int16).max  # of a label
SLOTS_AT = np.array([FACE_SLOT, TETRAHEDRON_SLOT])


@dataclass(frozen=True, kw_only=True, eq=False)
class Walls:
    """Triangles that part the labels of a grid from each other; each wall is there once, for both its labels.

    Parameters
    ----------
    points : (P, 3) float32
        In cells of the grid, from its lower corner.
    triangles : (T, 3) int32, int64 from 2³¹ points on
    sides : (T, 2) int16, int32 from 2¹⁵ labels on
        The labels behind and before each triangle, which faces the second; `OUTSIDE` beyond the box.
    volumes : (labels,) float64
        Of every label; that of 0 is the rest of the box. Cells.
    """

    points: NDArray[np.float32]
    triangles: NDArray[np.integer]
    sides: NDArray[np.integer]
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
    starts : (b,) int32, int64 from 2³¹ points on
        The number of the first of these.
    triangles : (T, 3) int32, int64 from 2³¹ points on
    sides : (T, 2) int16, int32 from 2¹⁵ labels on
    """

    winners: NDArray[np.uint16]
    row_starts: NDArray[np.int64]
    bases: NDArray[np.int32]
    masks: NDArray[np.int32]
    starts: NDArray[np.integer]
    triangles: NDArray[np.integer]
    sides: NDArray[np.integer]

    @property
    def rows(self) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.int32], NDArray[np.integer]]:
        """Where the points of rows are, as kernels take it."""
        return self.row_starts, self.bases, self.masks, self.starts

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
    starts: NDArray[np.integer] = np.empty(base_count, dtype=np.int32 if point_count < 2**31 else np.int64)
    in_threads(kernels.fill_rows, winners, *CUTTING[1:], SLOTS_AT, row_starts, bases, masks, starts, threads=count)
    triangles = np.empty((triangle_count, 3), dtype=np.int32 if point_count < 2**31 else np.int64)
    sides = np.empty((triangle_count, 2), dtype=np.int16 if winners.max(initial=0) <= MOST_INT16 else np.int32)
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
    points = place_wall_points(graph, fields, offsets, shifts=shifts, threads=threads)
    volumes = measure_volumes(graph, points, fields.count, scale=scale, threads=threads)
    return Walls(points=points, triangles=graph.triangles, sides=graph.sides, volumes=volumes)


def place_wall_points(
    graph: WallGraph,
    fields: PartitionFields,
    offsets: NDArray[np.floating],
    *,
    shifts: Shifts | None = None,
    threads: int | None = None,
) -> NDArray[np.float32]:
    """Return the places of the points of walls, (P, 3) in cells of the whole grid: see `place_walls`."""
    points = np.empty((graph.point_count, 3), dtype=np.float32)
    added = np.asarray(offsets, dtype=np.float32)
    values = fields.entries, fields.labels, fields.slots, fields.values, added, fields.place
    count = thread_count(threads)
    in_threads(kernels.place_points, graph.winners, *CUTTING, SLOTS_AT, *graph.rows, *values, points, threads=count)
    if shifts is not None:
        points[shifts.points] += shifts.vectors
    return points


def measure_volumes(
    graph: WallGraph,
    points: NDArray[np.float32],
    labels: int,
    *,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
) -> NDArray[np.float64]:
    """Measure the volume of every label within points, (labels,) in cells of `scale`; 0 has the rest of the box."""
    sums = sum_volumes(points, graph.triangles, graph.sides, labels, scale=scale, threads=threads)
    return volumes_of_sums(sums, graph.winners.shape, scale)


def sum_volumes(
    points: NDArray[np.float32],
    triangles: NDArray[np.integer],
    sides: NDArray[np.integer],
    labels: int,
    *,
    scale: tuple[float, ...] = (1.0, 1.0, 1.0),
    threads: int | None = None,
) -> NDArray[np.int64]:
    """Sum six times the volume of every label in whole numbers, (labels, 2), which parts of walls add up to."""
    count = thread_count(threads)
    sums = np.zeros((count, labels, 2), dtype=np.int64)
    lengths = np.array(scale, dtype=np.float64)
    in_threads(kernels.add_volumes, points, triangles, sides, lengths, sums, threads=count)
    return np.asarray(sums.sum(axis=0))


def volumes_of_sums(sums: NDArray[np.int64], shape: tuple[int, ...], scale: tuple[float, ...]) -> NDArray[np.float64]:
    """Return the volume of every label from `sum_volumes`, (labels,) in cells of `scale`; 0 has the rest of the box."""
    volumes: NDArray[np.float64] = (sums[:, 0] + sums[:, 1] / kernels.LOW) / (6 * kernels.HIGH)
    volumes[0] = np.prod(np.multiply(shape, scale)) - volumes[1:].sum()
    return volumes


def count_parts(
    winners: NDArray[np.uint16], labels: int, *, threads: int | None = None
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Count the points and the triangles of every label, (labels,) each, without tracing its walls."""
    count, tables = thread_count(threads), make_tables()
    points, triangles = (np.zeros((count, labels), dtype=np.int64) for _ in range(2))
    of_cubes = winners, *CUTTING[1:], SLOTS_AT, tables.counts, tables.triangles
    of_sides = tables.flat_counts, tables.flat_triangles
    in_threads(wall_points.count_parts, *of_cubes, *of_sides, points, triangles, threads=count)
    return points.sum(axis=0), triangles.sum(axis=0)


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


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelCutter:
    """Cuts the walls of single labels out of those of all.

    Parameters
    ----------
    triangles : (T, 3) int
    starts : (labels + 1, 2) int64
        Where those of each label begin in `behind` and `before`.
    behind, before : (N,), (M,) int
        The triangles by the label behind them, and by that before them.
    """

    triangles: NDArray[np.integer]
    starts: NDArray[np.int64]
    behind: NDArray[np.integer]
    before: NDArray[np.integer]

    @classmethod
    def of(cls, triangles: NDArray[np.integer], sides: NDArray[np.integer], labels: int) -> LabelCutter:
        """Sort triangles (T, 3) by the labels on both sides, (T, 2), of which there are `labels`, 0 among them."""
        starts = np.zeros((labels + 1, 2), dtype=np.int64)
        cutting.count_sides(sides, starts)
        kind = np.int32 if len(triangles) < np.iinfo(np.int32).max else np.int64
        behind, before = (np.empty(starts[-1, side], dtype=kind) for side in range(2))
        cutting.sort_sides(sides, starts[:-1].copy(), behind, before)
        return cls(triangles=triangles, starts=starts, behind=behind, before=before)

    def cut(self, label: int) -> CutLabel:
        """Cut out the walls of a label."""
        behind, before = (
            order[self.starts[label, side] : self.starts[label + 1, side]]
            for side, order in enumerate((self.behind, self.before))
        )
        return cut_triangles(self.triangles, behind, before, label)


def cut_triangles(
    triangles: NDArray[np.integer], behind: NDArray[np.integer], before: NDArray[np.integer], label: int
) -> CutLabel:
    """Cut out the triangles that have a label behind them, (N,), and those that have it before them, (M,)."""
    faces = np.empty((len(behind) + len(before), 3), dtype=triangles.dtype)
    if not len(faces):
        return CutLabel(label=label, points=np.empty(0, dtype=np.int64), faces=faces)
    low, high = cutting.find_ends(triangles, behind, before)
    words = np.zeros((high - low) // cutting.WORD + 1, dtype=np.uint32)
    starts = np.empty(len(words), dtype=np.int32)
    points = np.empty(cutting.mark_points(triangles, behind, before, low, words, starts), dtype=np.int64)
    cutting.list_points(words, low, points)
    cutting.number_faces(triangles, behind, before, low, words, starts, faces)
    return CutLabel(label=label, points=points, faces=faces)


def cut_labels(walls: Walls, labels: int, *, threads: int | None = None) -> Iterator[CutLabel]:
    """Yield the walls of labels 1, 2 ... up to but without `labels`; labels without any are left out."""
    cutter = LabelCutter.of(walls.triangles, walls.sides, labels)
    for _, piece in in_order(cutter.cut, range(1, labels), threads=thread_count(threads)):
        if len(piece.faces):
            yield piece
