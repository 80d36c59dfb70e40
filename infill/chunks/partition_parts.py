"""The work on one chunk of a partition: plain functions of plain data, which any thread, process or machine may run.

    survey_part ─▶ bricks, margins      count_part_shares ─▶ volumes by cells      place_part ─▶ triangles to write
    list_rises  ─▶ slope of fields      measure_part ─▶ volumes in walls           cross_part ─▶ points to move back

The fields of a chunk are those of the whole volume, to the last bit, in its own bricks and in a halo around them, since
they are smoothed with a margin as far as their steps reach. A triangle belongs to the chunk that owns the cube in
which it was cut; its points have names that say where in the whole lattice they lie.
"""

from __future__ import annotations

import contextlib
import math
import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk, ChunkLayout
from infill.chunks.work import FREE_SPACE, CellReader
from infill.kernels.partition import name_points
from infill.kernels.sparse import BRICK
from infill.partition.fields import PartitionFields, smooth_fields, smooth_to_distance
from infill.partition.junctions import find_crossings_beside, mark_crossing, smooth_junctions
from infill.partition.volumes import sum_areas
from infill.partition.walls import Shifts, WallGraph, Walls, place_wall_points, sum_volumes, trace_walls
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.sparse import SparseField

# Lines become smooth in ten rounds, each of which looks one cell further, beside points two rings away; triangles
# that pass through others lie within some cells of these.
HALO = 24  # cells
SLOTS = 32  # of points in a cube: more than there are

Names = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class PartitionWork:
    """The settings that all chunks of a partition share.

    Parameters
    ----------
    source : CellReader
    values : tuple of int
        The labels numbered 1, 2 ...; all other cells have number 0.
    layout : ChunkLayout
        Its steps are those that fields reach, and the halo.
    smoothing : Smoothing
    plain : bool
        Whether fields are plain, not refined.
    reach : int
        See `infill.partition.fields.smooth_fields`.
    spacing : (hx, hy, hz), mm
    scale : (3,) float
        Sides of a cell; the smallest is 1.
    scratch : str
        Folder in which fields are kept; "" for none.
    """

    source: CellReader
    values: tuple[int, ...]
    layout: ChunkLayout
    smoothing: Smoothing
    plain: bool
    reach: int
    spacing: tuple[float, ...]
    scale: tuple[float, ...]
    scratch: str = ""

    @property
    def count(self) -> int:
        """Labels, 0 among them."""
        return len(self.values) + 1

    def number(self, cells: NDArray[Any]) -> NDArray[np.uint16]:
        """Return the numbers of labels in cells."""
        order = np.argsort(self.values)
        values_there = np.array(self.values)[order]
        present, place = np.unique(cells, return_inverse=True)
        at = np.searchsorted(values_there, present).clip(max=len(values_there) - 1)
        numbers = np.where(values_there[at] == present, order[at] + 1, 0).astype(np.uint16)
        return np.ascontiguousarray(numbers[place.reshape(cells.shape)])


@dataclass(frozen=True, kw_only=True, eq=False)
class CellLines:
    """The shifts of points by which lines where labels meet become smooth.

    Parameters
    ----------
    offsets : (labels,) float64
        Of the walls that they were made for.
    taken : (t,) int64
        Names of the points whose shift was taken back.
    """

    offsets: NDArray[np.float64]
    taken: Names


@dataclass(frozen=True, kw_only=True, eq=False)
class WallTask:
    """Where the walls of a chunk lie.

    Parameters
    ----------
    held, offsets : (labels,) float64
        Offsets that decide which label wins in a cell, and those that place walls.
    lines : CellLines or None
    """

    held: NDArray[np.float64]
    offsets: NDArray[np.float64]
    lines: CellLines | None


@dataclass(frozen=True, kw_only=True, eq=False)
class PartSurvey:
    """The fields of a chunk in numbers: its own bricks that have values, and margins (labels, bins)."""

    bricks: int
    margins: NDArray[np.int64]


def survey_part(work: PartitionWork, chunk: Chunk, bins: int) -> PartSurvey:
    """Smooth and keep the fields of a chunk; count its bricks and margins."""
    fields = open_part(work, chunk)
    names, _ = fields.own_slots()
    return PartSurvey(bricks=len(names), margins=fields.margins(bins, threads=1))


def list_rises(work: PartitionWork, chunk: Chunk, stride: int) -> NDArray[np.float32]:
    """List rises across surfaces: see `PartitionFields.rises`."""
    return open_part(work, chunk).rises(stride)


def count_part_shares(
    work: PartitionWork, chunk: Chunk, offsets: NDArray[np.float64], ramp: float
) -> tuple[NDArray[np.int64], NDArray[np.uint32], NDArray[np.int64]]:
    """Count the shares that labels have of the cells of a chunk: see `PartitionFields.count_shares`."""
    return open_part(work, chunk).count_shares(offsets, ramp, threads=1)


def measure_part(
    work: PartitionWork, chunk: Chunk, task: WallTask, stride: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Sum the volumes of labels within the walls of a chunk, and the areas between pairs of them."""
    part = _cut(work, chunk, task)
    triangles, sides = part.graph.triangles[part.own], part.graph.sides[part.own]
    sums = sum_volumes(part.points, triangles, sides, work.count, scale=work.scale, threads=1)
    return sums, *sum_areas(part.points, triangles, sides, work.count, work.scale, stride)


def cross_part(work: PartitionWork, chunk: Chunk, task: WallTask, taken: Sequence[Names]) -> tuple[int, Names]:
    """Find triangles that pass through others; return their pairs, and the own points whose shifts are taken back.

    Parameters
    ----------
    work, chunk : PartitionWork, Chunk
    task : WallTask
        With lines.
    taken : sequence of names
        The points whose shifts were taken back before, in each round.
    """
    part = _cut(work, chunk, task)
    assert part.shifts is not None
    shifts, points = part.shifts, part.points
    changed = shifts.points
    for names in taken:
        is_taken = np.isin(part.names[shifts.points], names)
        changed = shifts.points[is_taken]
        points[changed] -= shifts.vectors[is_taken]
        shifts = Shifts(points=shifts.points[~is_taken], vectors=shifts.vectors[~is_taken])
    pairs = find_crossings_beside(points, part.graph.triangles, changed, work.scale, threads=1)
    if not len(pairs):
        return 0, np.empty(0, dtype=np.int64)
    moved = shifts.points[mark_crossing(part.graph.triangles, pairs, len(points), threads=1)[shifts.points]]
    return int(part.own[pairs[:, 0]].sum()), part.names[moved[part.is_own_point(moved, chunk)]]


@dataclass(frozen=True, kw_only=True, eq=False)
class PartWalls:
    """The walls of a chunk.

    Parameters
    ----------
    names : (P,) int64
        Of their points, in order.
    points : (P, 3) float32, cells
    triangles : (T, 3) int32
    sides : (T, 2) int
    cubes : (T,) int64
        The cube of the whole lattice in which each triangle was cut, in order.
    """

    names: Names
    points: NDArray[np.float32]
    triangles: NDArray[np.integer]
    sides: NDArray[np.integer]
    cubes: Names


def place_part(work: PartitionWork, chunk: Chunk, task: WallTask) -> PartWalls:
    """Place the walls of a chunk."""
    part = _cut(work, chunk, task)
    triangles = part.graph.triangles[part.own]
    used = np.zeros(len(part.points), dtype=bool)
    used[triangles] = True
    number = np.cumsum(used, dtype=np.int32) - np.int32(1)
    return PartWalls(
        names=part.names[used],
        points=part.points[used],
        triangles=number[triangles],
        sides=part.graph.sides[part.own],
        cubes=_name(part.cubes[part.own], work.layout.shape),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Part:
    """The walls of a chunk with its halo, and which triangles are its own."""

    graph: WallGraph
    points: NDArray[np.float32]
    names: Names
    bases: NDArray[np.int64]
    cubes: NDArray[np.int64]
    own: NDArray[np.bool_]
    shifts: Shifts | None

    def is_own_point(self, points: NDArray[np.int64], chunk: Chunk) -> NDArray[np.bool_]:
        """Tell which points the bases of a chunk own."""
        return _is_own(self.bases[points], chunk)


def _is_own(bases: NDArray[np.int64], chunk: Chunk) -> NDArray[np.bool_]:
    """Tell which places of the whole lattice (N, 3) lie in the bricks of a chunk."""
    bricks = np.array(BRICK)
    is_inside = (bases >= bricks * chunk.low) & (bases < bricks * chunk.high)
    return np.asarray(is_inside.all(axis=1))


def _name(places: NDArray[np.int64], shape: tuple[int, ...]) -> Names:
    """Return numbers for places of the whole lattice (N, 3), in their order."""
    _, along_y, along_z = (count + 2 for count in shape)
    names: Names = (places[:, 0] * along_y + places[:, 1]) * along_z + places[:, 2]
    return names


def _cut(work: PartitionWork, chunk: Chunk, task: WallTask) -> _Part:
    """Trace and place the walls of a chunk and its halo."""
    fields = open_part(work, chunk)
    graph = trace_walls(fields.winners(task.held, threads=1), threads=1)
    bases, slots = point_places(graph, fields.corner)
    names = _name(bases, work.layout.shape) * SLOTS + slots
    # Of the corners between which the points of a triangle lie, the lowest is the base of its cube.
    cubes = np.stack([along[graph.triangles].min(axis=1) for along in bases.T], axis=1)
    shifts = None
    if task.lines is not None:
        shifts = _open_shifts(work, chunk, fields, graph, task.lines)
        stays = ~np.isin(names[shifts.points], task.lines.taken)
        shifts = Shifts(points=shifts.points[stays], vectors=shifts.vectors[stays])
    points = place_wall_points(graph, fields, task.offsets, shifts=shifts, threads=1)
    return _Part(
        graph=graph, points=points, names=names, bases=bases, cubes=cubes, own=_is_own(cubes, chunk), shifts=shifts
    )


def point_places(graph: WallGraph, corner: tuple[int, ...]) -> tuple[NDArray[np.int64], NDArray[np.int8]]:
    """Return the base of every point in the whole lattice, (P, 3), and its slot there, (P,)."""
    counts = graph.row_starts[..., 3] - graph.row_starts[..., 0]
    row = np.repeat(np.arange(counts.size), counts.ravel())
    starts = np.append(graph.starts, graph.point_count).astype(np.int64)
    per_base = starts[1:] - starts[:-1]
    place = np.column_stack([row // counts.shape[1], row % counts.shape[1], graph.bases])
    slots = np.empty(graph.point_count, dtype=np.int8)
    name_points(graph.masks, graph.starts, slots)
    return np.repeat(place, per_base, axis=0) + np.array(corner, dtype=np.int64), slots


def _open_shifts(
    work: PartitionWork, chunk: Chunk, fields: PartitionFields, graph: WallGraph, lines: CellLines
) -> Shifts:
    """Return the shifts of a chunk: kept, or computed again."""
    path = _path(work, chunk, "lines")
    if path is not None:
        with contextlib.suppress(OSError, KeyError), np.load(path) as arrays:
            if np.array_equal(arrays["offsets"], lines.offsets):
                return Shifts(points=arrays["points"], vectors=arrays["vectors"])
    points = place_wall_points(graph, fields, lines.offsets, threads=1)
    walls = Walls(points=points, triangles=graph.triangles, sides=graph.sides, volumes=np.empty(0))
    shifts = smooth_junctions(graph, walls, shape=work.layout.shape, threads=1)
    _keep(path, offsets=lines.offsets, points=shifts.points, vectors=shifts.vectors)
    return shifts


def open_part(work: PartitionWork, chunk: Chunk) -> PartitionFields:
    """Return the fields of a chunk and its halo: kept, or computed again."""
    path = _path(work, chunk, "fields")
    low, high = _kept_bricks(chunk)
    place: dict[str, Any] = {
        "count": work.count,
        "corner": tuple((low * BRICK).tolist()),
        "whole": work.layout.shape,
        "own": np.array([chunk.low, chunk.high]) - low,
    }
    if path is not None:
        with contextlib.suppress(OSError, KeyError), np.load(path) as arrays:
            place |= {name: arrays[name] for name in arrays.files}
            return PartitionFields(**place)
    fields = _smooth_part(work, chunk, low, high)
    _keep(path, **fields)
    place |= fields
    return PartitionFields(**place)


def _kept_bricks(chunk: Chunk) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the first brick of a chunk with its halo, and the one after the last."""
    halo = np.array([math.ceil(HALO / size) for size in BRICK])
    return np.maximum(np.array(chunk.low) - halo, 0), np.minimum(np.array(chunk.high) + halo, chunk.lattice)


def _smooth_part(
    work: PartitionWork, chunk: Chunk, low: NDArray[np.int64], high: NDArray[np.int64]
) -> dict[str, NDArray[Any]]:
    """Smooth the labels in the cells of a chunk; return the arrays of `PartitionFields` in some of its bricks."""
    numbers = work.number(work.source.read(tuple(map(slice, chunk.cell_low, chunk.cell_high))))
    present, place = np.unique(numbers, return_inverse=True)
    compact: NDArray[np.uint16] = np.asarray(place, dtype=np.uint16).reshape(numbers.shape)

    def smooth(data: NDArray[np.generic], threads: int) -> SparseField:
        return smooth_to_distance(data, work.smoothing, spacing=work.spacing, plain=work.plain, threads=threads)

    boxes = [_box_of(compact == number) for number in range(len(present))]
    whole = smooth_fields(compact, boxes, smooth, reach=work.reach, threads=1)
    first, end = low - chunk.read_low, high - chunk.read_low
    entries = whole.entries[tuple(map(slice, first, end))]
    counts = (entries[..., 1] - entries[..., 0]).ravel()
    ends = counts.cumsum()
    chosen = np.repeat(entries[..., 0].ravel() - (ends - counts), counts) + np.arange(counts.sum())
    slots = whole.slots[chosen]
    has_values = slots >= 0
    values = whole.values[slots[has_values]]
    slots[has_values] = np.arange(len(values), dtype=np.int32)
    shape = np.array(chunk.shape)
    begin = low * BRICK
    until = np.where(high == chunk.lattice, shape, high * BRICK - 2)
    inside = tuple(slice(a - c, b - c) for a, b, c in zip(begin, until, chunk.cell_low, strict=True))
    return {
        "numbers": np.ascontiguousarray(numbers[inside]),
        "entries": np.stack([ends - counts, ends], axis=-1).reshape(entries.shape),
        "labels": present[whole.labels[chosen]].astype(np.int32),
        "slots": slots,
        "values": values,
    }


def _box_of(cells: NDArray[np.bool_]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the lowest corner and the highest, exclusive, of marked cells."""
    places = [np.flatnonzero(cells.any(axis=tuple({0, 1, 2} - {axis}))) for axis in range(3)]
    return tuple(int(place[0]) for place in places), tuple(int(place[-1]) + 1 for place in places)


def _path(work: PartitionWork, chunk: Chunk, kind: str) -> Path | None:
    """Return a file of a chunk in the scratch folder; None without one, as on another machine."""
    return Path(work.scratch, f"{chunk.number}.{kind}") if work.scratch and Path(work.scratch).is_dir() else None


def _keep(path: Path | None, **arrays: NDArray[Any]) -> None:
    """Keep arrays in the scratch folder, if there is room for them."""
    if path is None:
        return
    part = path.with_name(f"{path.name}.{os.getpid()}")
    with contextlib.suppress(OSError):
        space = shutil.disk_usage(path.parent)
        if space.free - sum(array.nbytes for array in arrays.values()) < FREE_SPACE * space.total:
            return
        try:
            with part.open("wb") as file:
                np.savez(file, **arrays)  # type: ignore[arg-type]
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
