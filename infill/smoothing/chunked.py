"""Smooth a volume in chunks, with the bits of the whole, for volumes that do not fit into memory.

    method  ─▶  smooth all chunks  ─▶  level of the volume  ─▶  crumbs  ─▶  pieces, one after another  ─▶  report

The passes over the chunks are those of `infill.chunks.solving`; their result is judged by whole numbers alone:
volume, components, cavities and tunnels. Distances from the input are not measured.
"""

from __future__ import annotations

import contextlib
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import ChunkLayout
from infill.chunks.running import open_runner, require_dask
from infill.chunks.solids import GreyScale, SolidRule
from infill.chunks.solving import Solver
from infill.chunks.work import Work, smooth
from infill.kernels.compiling import log_compilation
from infill.lazy.volume import LazyVolume
from infill.phasefield.profile import PLAIN_PROFILE, REFINED_PROFILE
from infill.phasefield.schedule import MIN_STEPS
from infill.smoothing.chunk_plans import check_chunked
from infill.smoothing.chunked_data import choose_work
from infill.smoothing.chunked_rule import count_specks, require_some_solid
from infill.smoothing.chunked_surface import ChunkedSurface, compare_counts, find_all_crumbs
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold

SHARES = {"read": (0.0, 0.1), "smooth": (0.1, 0.6), "join": (0.6, 0.62), "surface": (0.62, 0.8), "check": (0.8, 0.82)}


@contextlib.contextmanager
def smooth_in_chunks(
    volume: LazyVolume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    side: int | None = None,
) -> Iterator[ChunkedSurface]:
    """Smooth a volume in chunks; yield its surface, whose fields are kept on disk as long as the block lasts.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    threshold, label, grey
        See `infill.smooth_volume`.
    workers, scheduler
        See `infill.chunks.running.open_runner`.
    side : int, optional
        See `plan_chunks`.

    Raises
    ------
    ParameterError
        For options that a volume in chunks does not have, or that do not determine the solid.
    GeometryError
        If nothing is left, or the volume is off by a tenth.
    FormatError
        If cells cannot be read.
    MemoryLimitError
        If a worker ends before its chunk is done.
    """
    check_chunked(request)
    require_dask()
    progress, seconds = request.progress, {"read": 0.0, "smooth": 0.0, "surface": 0.0, "check": 0.0}

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            begin, end = SHARES[stage]
            progress(stage, begin + share * (end - begin))

    count = workers if workers is not None or scheduler not in (None, "threads", "processes") else request.threads
    with open_runner(count, scheduler) as runner, _scratch_folder() as scratch:
        with _timed(seconds, "read"), log_compilation("the smoother"):
            chosen = choose_work(
                volume,
                request,
                runner,
                partial(tell, "read"),
                threshold=threshold,
                label=label,
                grey=grey,
                side=side,
                scratch=scratch,
            )
        request, work = chosen.request, chosen.work
        solver = Solver(work=work, runner=runner, tell=tell)
        with _timed(seconds, "smooth"):
            _load_kernels(work)
            solver.smooth()
            segmentation = require_some_solid(solver, chosen.used)
            specks = count_specks(solver)
        with _timed(seconds, "surface"):
            surface, common, levels = solver.find_surface()
        with _timed(seconds, "check"):
            crumbs, marked = find_all_crumbs(solver, surface, request)
            numbering = solver.number_vertices(surface, marked)
            counts = compare_counts(solver, surface.shells, marked)
        to_phase = _phase_level(request)
        chunked = ChunkedSurface(
            volume=volume,
            request=request,
            plan=chosen.plan,
            solver=solver,
            surface=surface,
            numbering=numbering,
            crumbs=crumbs,
            counts=counts,
            level=(to_phase(common), np.array([to_phase(float(level)) for level in levels])),
            segmentation=segmentation,
            noise=chosen.noise,
            grey=chosen.grey,
            specks=specks,
            enclosed=float(surface.shells.volume[~marked].sum()) if marked.any() else surface.volume,
            target=float(solver.targets.sum()),
            seconds=seconds,
            progress=progress,
        )
        chunked.check()
        yield chunked


@contextlib.contextmanager
def _scratch_folder() -> Iterator[str]:
    """Yield a folder for fields, which is gone afterwards."""
    folder = tempfile.mkdtemp(prefix="infill-chunks-")
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def _timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Add the time of a block to a stage."""
    begin = time.perf_counter()
    yield
    seconds[stage] += time.perf_counter() - begin


def _phase_level(request: SmoothRequest) -> Callable[[float], float]:
    """Return what converts a level of the field to one of phi."""
    if not isinstance(request.level, str):
        fixed = request.level
        return lambda _: fixed
    return (REFINED_PROFILE if request.refined else PLAIN_PROFILE).phase_level


@log_compilation("the smoother")
def _load_kernels(work: Work) -> None:
    """Load the compiled loops before several threads need them at once."""
    corner = np.zeros((6, 6, 6), dtype=bool)
    corner[2:4, 2:4, 2:4] = True
    steps = MIN_STEPS if work.refined else 1
    layout = ChunkLayout(shape=(6, 6, 6), size=(1, 1, 1), steps=steps, refined=work.refined)
    trial = replace(
        work,
        source=_ArrayReader(corner),
        rule=SolidRule(),
        grey=None if work.grey is None else GreyScale(level=0.5, window=1.0),
        layout=layout,
        smoothing=replace(work.smoothing, steps=steps),
        despeckle=0.0,
        scratch="",
    )
    smooth(trial, next(iter(layout)))


@dataclass(frozen=True)
class _ArrayReader:
    """An array in memory as a source of cells."""

    array: NDArray[Any]

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return self.array.dtype

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Return the cells of a box."""
        return self.array[box]
