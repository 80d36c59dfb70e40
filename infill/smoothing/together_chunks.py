"""Smooth the labels of a volume that is not in memory together: the walls of memory, to the last bit, in chunks.

    find the labels  ─▶  fields of all chunks  ─▶  offsets that give every label its volume  ─▶  walls, joined

The passes over the chunks are those of `infill.chunks.partition_solving`. In memory at the end are the walls alone,
with all their triangles; connections and distances are not compared with the voxels, so that there is no verdict.
"""

from __future__ import annotations

import math
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, BinaryIO, Unpack

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import ChunkLayout
from infill.chunks.partition_parts import HALO, CellLines, PartitionWork
from infill.chunks.partition_solving import ChunkedPartition, MeasuredWalls
from infill.chunks.running import Runner, open_runner, require_dask
from infill.errors import GeometryError, MemoryLimitError, UsageError
from infill.formats.mesh_files import WALL_WRITERS
from infill.formats.parts import hex_colour
from infill.imaging.label_tables import Segment
from infill.kernels.sparse import BRICK
from infill.lazy.volume import LazyVolume
from infill.machine import GIB, available_memory
from infill.partition.volumes import FoundOffsets, find_offsets
from infill.partition.walls import Walls
from infill.phasefield.schedule import Schedule
from infill.plain_numbers import count_noun
from infill.reports.common import report_head
from infill.reports.smoothing import PartedSeconds
from infill.result import Clock, Result
from infill.smoothing.label_pieces import absent_names
from infill.smoothing.label_stages import LabelPiece, field_reach
from infill.smoothing.label_surfaces import LabelSurfaces
from infill.smoothing.lazy_labels import load_smoother, name_lazy_pieces, survey_labels
from infill.smoothing.request import AUTO, SmoothOptions, SmoothRequest
from infill.smoothing.together import NOTHING_LEFT, refuse_unfit, scale_of
from infill.smoothing.together_checks import describe_volume, is_volume_kept
from infill.smoothing.together_plan import expected_seconds, plan_labels_together
from infill.smoothing.together_stages import WallStages

if TYPE_CHECKING:
    from infill.reports.smoothing import LabelsForecast, PartedLabel, PartedReport
    from infill.smoothing.request import SmoothRequest as Request

PLAIN_MARGIN, REFINED_MARGIN = 3, 12  # cells, more than there are steps: averages of refining look as far
BYTES_PER_CELL = 48  # of a chunk with its margin: numbers, fields of several labels and their walls, a measured peak
BYTES_PER_RUN = 3000  # of the walls of a label, joined: 30 triangles, about, and what it takes to sort them
LARGEST, LEAST = 512, 32  # cells along the sides of a chunk
MEMORY_SHARE = 0.5  # of what is free: for all chunks at once


@dataclass(frozen=True, kw_only=True)
class PartitionPlan:
    """How a volume of labels is divided.

    Parameters
    ----------
    layout : ChunkLayout
    workers : int
    memory : int
        Bytes of the chunks that are worked on at once, about, or of the walls at the end.
    read : int
        Cells that are read in one pass, margins included.
    """

    layout: ChunkLayout
    workers: int
    memory: int
    read: int


def smooth_together_in_chunks(
    volume: LazyVolume,
    *,
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    segments: Sequence[Segment] = (),
    workers: int | None = None,
    scheduler: str | None = None,
    size: tuple[int, int, int] | None = None,
    **options: Unpack[SmoothOptions],
) -> Result[WallStages, PartedReport]:
    """Smooth labels together, without having the volume in memory.

    Parameters
    ----------
    volume : LazyVolume
    label, table, **options
        See `infill.smooth_labels`.
    segments : sequence of Segment
        Of the file.
    workers, scheduler
        See `infill.chunks.running.open_runner`.
    size : (3,) int
        Bricks of a chunk, instead of those that memory allows.

    Returns
    -------
    Result
        The surfaces and walls of `infill.smooth_labels` with `together` and without simplification, to the last bit.

    Raises
    ------
    ParameterError, GeometryError
        As `infill.smooth_labels`.
    FormatError
        If cells cannot be read.
    MemoryLimitError
        If the walls will not fit into memory, or a worker ends before its chunk is done.
    """
    request = check_request(SmoothRequest(**options), volume)
    clock = Clock(request.progress)
    with open_runner(*_workers(request, workers, scheduler)) as runner:
        with clock.stage("labels", 0.0):
            survey = survey_labels(volume, runner, request.threads)
            pieces = name_lazy_pieces(volume, survey, segments, label, tuple(table))
            absent = absent_names(segments, pieces) if label is None else []
            plan = plan_partition(volume, pieces, request, runner, size=size)
        offsets, walls = _solve_partition(volume, pieces, request, plan, runner, clock)
    place = volume.place(np.broadcast_to(np.uint8(0), volume.shape))
    with clock.stage("surface", 0.9):
        surfaces = LabelSurfaces.of(walls, place, [piece.name for piece in pieces], threads=request.threads)
    if not surfaces:
        raise GeometryError("no label is left after smoothing; give fewer steps")
    remaining, gone = ([piece for piece in pieces if (piece.name in surfaces) is kept] for kept in (True, False))
    labels = [_label_keys(piece, surfaces, place.cell_volume) for piece in remaining]
    report: PartedReport = {
        **report_head("together"),
        "triangles": len(walls.triangles),
        "closed": all(keys["closed"] for keys in labels),
        "problems": _problems(labels, remaining, gone, offsets.crossings),
        "request": request.facts(),
        "labels": labels,
        "failed": [{**piece.place, "error": NOTHING_LEFT} for piece in gone],
        "absent": absent,
        "rounds": offsets.rounds,
        "chunks": {
            "count": len(plan.layout),
            "cells": [size * side for size, side in zip(plan.layout.size, BRICK, strict=True)],
            "margin": [margin * side for margin, side in zip(plan.layout.margin, BRICK, strict=True)],
            "workers": plan.workers,
        },
        "seconds": clock.timings(PartedSeconds),
    }
    stages = WallStages(
        segments={piece.name: piece.segment for piece in pieces},
        failed={piece.name: NOTHING_LEFT for piece in gone},
        written=walls,
        volume=place,
        values=(0, *(piece.segment.value for piece in pieces)),
    )
    writers: dict[str, Callable[[BinaryIO], None]] = {
        suffix: partial(stages.write_walls, write) for suffix, write in WALL_WRITERS.items()
    }
    colours = {piece.name: piece.segment.colour for piece in remaining if piece.segment.colour is not None}
    return Result(surfaces=surfaces, report=report, stages=stages, colours=colours, writers=writers)


def _solve_partition(
    volume: LazyVolume,
    pieces: Sequence[LabelPiece],
    request: SmoothRequest,
    plan: PartitionPlan,
    runner: Runner,
    clock: Clock,
) -> tuple[FoundOffsets[NDArray[np.float64], MeasuredWalls, CellLines], Walls]:
    """Smooth the fields of all chunks and find the offsets of the labels; return them and the walls, joined."""
    scratch = tempfile.mkdtemp(prefix="infill-together-")
    try:
        load_smoother()
        partition = ChunkedPartition(
            work=make_work(volume, pieces, request, plan, scratch),
            runner=runner,
            tell=lambda share: clock.tell("smooth", 0.05 + 0.4 * share),
        )
        with clock.stage("smooth", 0.05):
            _ = partition.survey
        with clock.stage("volumes", 0.45):
            cells = np.array([0, *(piece.extent.cells for piece in pieces)], dtype=np.float64)
            cells[0] = math.prod(volume.shape) - cells.sum()
            scale = partition.work.scale
            offsets = find_offsets(
                partition,
                cells * float(np.prod(scale)),
                scale=scale,
                progress=lambda share: clock.tell("volumes", 0.45 + 0.4 * share),
            )
        with clock.stage("surface", 0.85):
            return offsets, partition.join(offsets.walls)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def check_request(request: Request, volume: LazyVolume) -> Request:
    """Return the request for the cells of a volume; raise UsageError for options that chunks do not have."""
    refuse_unfit(request)
    if request.tolerance not in (AUTO, None):
        raise UsageError.about("tolerance", "is not for labels together in chunks, which keep all triangles; give 0")
    return replace(request.for_cell(min(volume.spacing)), tolerance=None)


def _workers(request: Request, workers: int | None, scheduler: str | None) -> tuple[int | None, str | None]:
    """Return the number of workers, by default that of threads, and the scheduler, as `open_runner` takes them."""
    is_here = scheduler in (None, "threads", "processes")
    return (request.threads if workers is None and is_here else workers), scheduler


def field_margin(request: Request) -> int:
    """Return how far a chunk has to look for fields to be those of the whole, cells."""
    steps = request.smoothing.steps
    return steps + PLAIN_MARGIN if request.method == "plain" else Schedule.of(steps).last + REFINED_MARGIN


def plan_partition(
    volume: LazyVolume,
    pieces: Sequence[LabelPiece],
    request: Request,
    runner: Runner,
    *,
    size: tuple[int, int, int] | None = None,
) -> PartitionPlan:
    """Divide a volume so that the chunks at work fit into the memory that is allowed, or else free.

    Raises
    ------
    MemoryLimitError
        If the walls at the end do not.
    """
    steps = field_margin(request) + HALO
    allowed = available_memory() if request.max_memory is None else request.max_memory
    walls = BYTES_PER_RUN * sum(piece.extent.runs for piece in pieces)
    if allowed is not None and walls > allowed:
        raise MemoryLimitError(
            f"the walls of all labels need about {walls / GIB:.2f} GiB of memory and {allowed / GIB:.2f} GiB are "
            "allowed; give --each-label, which smooths each by itself, --roi for a part, or a coarser volume"
        )
    share = runner.memory_per_task() if request.max_memory is None else request.max_memory // runner.workers
    memory = int((allowed or 2**32) * MEMORY_SHARE) // runner.workers if share is None else share
    sizes = [_bricks(volume.shape, side) for side in range(LEAST, LARGEST + 1, LEAST)] if size is None else [size]
    layouts = [ChunkLayout(shape=volume.shape, size=bricks, steps=steps) for bricks in dict.fromkeys(sizes)]
    fitting = [layout for layout in layouts if _bytes_of(layout) <= memory] or layouts[:1]
    # Margins are wide: few large chunks take less work than there are workers to share it.
    layout = min(fitting, key=lambda one: math.ceil(len(one) / runner.workers) * _bytes_of(one))
    read = sum(
        math.prod(high - low for low, high in zip(chunk.cell_low, chunk.cell_high, strict=True)) for chunk in layout
    )
    at_once = min(runner.workers, len(layout))
    return PartitionPlan(
        layout=layout, workers=runner.workers, memory=max(walls, at_once * _bytes_of(layout)), read=read
    )


def _bricks(shape: tuple[int, int, int], side: int) -> tuple[int, int, int]:
    """Return the bricks of chunks of about the same size, with sides of up to `side` cells."""
    bricks = []
    for count, size in zip(shape, BRICK, strict=True):
        lattice = math.ceil((count + 2) / size)
        bricks.append(math.ceil(lattice / math.ceil(lattice / max(1, side // size))))
    along_x, along_y, along_z = bricks
    return along_x, along_y, along_z


def _bytes_of(layout: ChunkLayout) -> int:
    """Return the memory that a chunk takes, bytes."""
    sides = (
        min(count, (size + 2 * margin) * side)
        for count, size, margin, side in zip(layout.shape, layout.size, layout.margin, BRICK, strict=True)
    )
    return math.prod(sides) * BYTES_PER_CELL


def make_work(
    volume: LazyVolume, pieces: Sequence[LabelPiece], request: Request, plan: PartitionPlan, scratch: str
) -> PartitionWork:
    """Return the settings that the work on all chunks shares."""
    return PartitionWork(
        source=volume.array,
        values=tuple(piece.segment.value for piece in pieces),
        layout=plan.layout,
        smoothing=request.smoothing,
        plain=request.method == "plain",
        reach=field_reach(request.smoothing.interface),
        spacing=tuple(volume.spacing),
        scale=scale_of(volume.place(np.broadcast_to(np.uint8(0), volume.shape))),
        scratch=scratch,
    )


def _label_keys(piece: LabelPiece, surfaces: LabelSurfaces, cell_volume: float) -> PartedLabel:
    """Return the keys of a label in the report."""
    facts, colour, data = surfaces.measures[piece.name], piece.segment.colour, piece.extent.cells * cell_volume
    return {
        **piece.place,
        "colour": None if colour is None else hex_colour(colour),
        "triangles": facts.triangles,
        "closed": facts.closed,
        "data": data,
        "volume": facts.volume,
        "volume_change": facts.volume / data - 1,
    }


def _problems(
    labels: Sequence[PartedLabel], remaining: Sequence[LabelPiece], gone: Sequence[LabelPiece], crossings: int
) -> list[str]:
    """Return the problems, one phrase each: volumes that changed, open surfaces, labels gone, and crossings."""
    problems = [
        f"{keys['name']}: {describe_volume(keys['volume_change'])}"
        for keys, piece in zip(labels, remaining, strict=True)
        if not is_volume_kept(keys["volume_change"], piece.extent.cells)
    ]
    problems += [f"{keys['name']}: its surface is not closed" for keys in labels if not keys["closed"]]
    problems += [f"{piece.name}: {NOTHING_LEFT}" for piece in gone]
    if crossings:
        problems.append(f"all labels: {count_noun(crossings, 'pair')} of triangles pass through each other")
    return problems


def plan_together_in_chunks(
    volume: LazyVolume,
    *,
    begin: float,
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    segments: Sequence[Segment] = (),
    workers: int | None = None,
    scheduler: str | None = None,
    **options: Unpack[SmoothOptions],
) -> LabelsForecast:
    """Return the plan for `smooth_together_in_chunks` with the same arguments, as plain numbers.

    Parameters
    ----------
    volume : LazyVolume
    begin : float
        Start of opening it, by `time.perf_counter`.
    label, table, segments, workers, scheduler, **options
        See `smooth_together_in_chunks`.
    """
    require_dask()
    request = check_request(SmoothRequest(**options), volume)
    with open_runner(*_workers(request, workers, scheduler)) as runner:
        survey = survey_labels(volume, runner, request.threads)
        pieces = name_lazy_pieces(volume, survey, segments, label, tuple(table))
        plan = plan_partition(volume, pieces, request, runner)
    place, cells = volume.place(np.broadcast_to(np.uint8(0), volume.shape)), math.prod(volume.shape)
    loaded = time.perf_counter()
    # Each pass works on margins as well.
    seconds = plan.read / cells * expected_seconds(cells, pieces, place, request, tetrahedra=False)
    return plan_labels_together(pieces, place, request, memory=plan.memory, seconds=loaded - begin + seconds)
