"""How a volume is divided into chunks, and the options that it does not have then."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from infill.chunks.layout import ChunkLayout
from infill.chunks.running import Runner
from infill.chunks.sizing import ChunkMemory
from infill.errors import ParameterError, UsageError
from infill.kernels.sparse import BRICK
from infill.lazy.volume import LazyVolume
from infill.machine import available_memory
from infill.plain_numbers import plain_argument, plain_size
from infill.smoothing.request import SmoothRequest
from infill.voxels.slices import plan_sublayers

LEAST_CHUNKS = 2  # for each worker, so that none is idle
FEWEST_CELLS = 128  # along a side: smaller chunks are mostly margin
LARGEST_CELLS = 512  # along a side
MOST_SPECK_CELLS = 128  # which is also how far beside a chunk cells are read to find specks
MEMORY_SHARE = 0.5  # of what is free: for all chunks at once


@dataclass(frozen=True, kw_only=True)
class ChunkPlan:
    """How a volume is divided.

    Parameters
    ----------
    layout : ChunkLayout
    workers : int
    memory : int
        Bytes of all chunks that are worked on at once, about, at most.
    read : int
        Bytes of cells that are read in one pass, margins included.
    """

    layout: ChunkLayout
    workers: int
    memory: int
    read: int


def check_chunked(request: SmoothRequest, **options: Any) -> None:  # noqa: ANN401 - options of smooth_volume
    """Raise an error for options that a volume in chunks does not have.

    Parameters
    ----------
    request : SmoothRequest
    **options
        Further options by name; those that are None or False are not given.
    """
    if request.max_triangles is not None:
        raise UsageError.about("max_triangles", "is not for a volume in chunks; give a tolerance instead")
    for name, value in options.items():
        if value is not None and value is not False:
            raise UsageError.about(name, "is not for a volume in chunks; leave it out")


def suits_chunks(request: SmoothRequest, **options: Any) -> bool:  # noqa: ANN401 - options of smooth_volume
    """Tell whether a volume in chunks has all these options: see `check_chunked`."""
    try:
        check_chunked(request, **options)
    except ParameterError:
        return False
    return True


def check_speck_size(request: SmoothRequest, cell_volume: float) -> None:
    """Raise ParameterError for specks so large that chunks would have to read too many cells beside them."""
    largest = MOST_SPECK_CELLS * cell_volume
    if request.despeckle > largest:
        raise ParameterError.about(
            "despeckle",
            f"is {plain_argument(request.despeckle)} mm³, and a volume in chunks takes out specks of up to "
            f"{MOST_SPECK_CELLS} voxels; give at most {plain_argument(largest)}",
        )


def plan_chunks(
    volume: LazyVolume,
    request: SmoothRequest,
    runner: Runner,
    *,
    grey: bool = False,
    side: int | None = None,
    size: tuple[int, int, int] | None = None,
) -> ChunkPlan:
    """Divide a volume so that the chunks at work fit into the memory that is allowed, or else free.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    runner : Runner
    grey : bool
        Whether grey values are smoothed.
    side : int, optional
        Cells along the longest side of a chunk, instead.
    size : (3,) int, optional
        Bricks of a chunk, those of a run that is resumed.
    """
    require_thin(volume)
    steps, refined, item = request.smoothing.steps, request.refined, volume.array.dtype.itemsize
    needs = ChunkMemory(
        shape=volume.shape,
        steps=steps,
        item=item,
        refined=refined,
        grey=grey,
        speck_cells=math.ceil(request.despeckle / volume.cell_volume),
    )
    share = runner.memory_per_task() if request.max_memory is None else request.max_memory // runner.workers
    memory = int((available_memory() or 2**32) * MEMORY_SHARE) // runner.workers if share is None else share
    resumed, largest = size, side or LARGEST_CELLS
    size = needs.size_within(memory, largest)
    layout = ChunkLayout(shape=volume.shape, size=size, steps=steps, refined=refined)
    while side is None and len(layout) < LEAST_CHUNKS * runner.workers and largest > FEWEST_CELLS:
        largest -= BRICK[2] * 2
        size = needs.size_within(memory, largest)
        layout = ChunkLayout(shape=volume.shape, size=size, steps=steps, refined=refined)
    if resumed is not None:
        size, layout = resumed, ChunkLayout(shape=volume.shape, size=resumed, steps=steps, refined=refined)
    at_once = min(runner.workers, len(layout))
    needed = at_once * needs.of_chunk(size)
    if resumed is not None and request.max_memory is not None and needed > request.max_memory:
        mebibytes = math.ceil(needed / 2**20)
        raise ParameterError.about(
            "max_memory",
            f"is {request.max_memory / 2**20:.0f} MiB, and the chunks of the run that is resumed may take {mebibytes}; "
            f"give {mebibytes}M, or fewer workers",
        )
    read = item * sum(
        math.prod(high - low for low, high in zip(chunk.cell_low, chunk.cell_high, strict=True))
        for chunk in (chunk.widened(needs.speck_cells) for chunk in layout)
    )
    return ChunkPlan(
        layout=layout,
        workers=runner.workers,
        memory=needed,
        read=read,
    )


def require_thin(volume: LazyVolume) -> None:
    """Raise ParameterError for slices so thick that they would be interpolated."""
    whole = volume.place(np.broadcast_to(np.uint8(0), volume.shape))
    axis, count = plan_sublayers(whole)
    if count > 1:
        sizes = plain_size(*volume.spacing, digits=4)
        raise ParameterError(
            f"{volume.name} has slices {count} times as thick as its cells are wide ({sizes}), which would be "
            f"interpolated, and are not in chunks; resample axis {'xyz'[axis]}, or smooth it in memory"
        )
