"""Smooth a volume in chunks: the plain method, with the bits of the whole, for volumes that do not fit into memory.

    smooth all chunks  ─▶  level of the volume  ─▶  crumbs  ─▶  fewer triangles  ─▶  pieces, one by one  ─▶  report

The passes over the chunks are those of `infill.chunks.solving`; their result is judged by whole numbers alone:
volume, components, cavities and tunnels. Distances from the input are not measured.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import ChunkLayout
from infill.chunks.running import open_runner, require_dask
from infill.chunks.solids import SolidRule
from infill.chunks.solving import Solver
from infill.chunks.work import Work, smooth
from infill.kernels.compiling import log_compilation
from infill.lazy.volume import LazyVolume
from infill.meshes.compile_simplification import make_ring
from infill.meshes.edge_collapse import collapse_edges
from infill.phasefield.profile import PLAIN_PROFILE
from infill.smoothing.chunk_plans import check_chunked, plan_chunks
from infill.smoothing.chunked_rule import find_rule, require_some_solid
from infill.smoothing.chunked_simplified import check_tolerance
from infill.smoothing.chunked_surface import WRITING, ChunkedSurface, compare_counts, find_all_crumbs
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold
from infill.smoothing.work_folders import open_work_folder, run_facts

SHARES = {
    "read": (0.0, 0.05),
    "smooth": (0.05, 0.4),
    "join": (0.4, 0.41),
    "surface": (0.41, 0.56),
    "check": (0.56, 0.57),
    "simplify": (0.57, WRITING),
}


@contextlib.contextmanager
def smooth_in_chunks(
    volume: LazyVolume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    side: int | None = None,
    resume: str | os.PathLike[str] | None = None,
) -> Iterator[ChunkedSurface]:
    """Smooth a volume in chunks; yield its surface, whose fields are kept on disk as long as the block lasts.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    threshold, label
        See `infill.smooth_volume`.
    workers, scheduler
        See `infill.chunks.running.open_runner`.
    side : int, optional
        See `plan_chunks`.
    resume : str or Path, optional
        Folder for finished work, from which a run that was interrupted goes on; removed when the block has ended
        without an error.

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
    request = request.for_cell(min(volume.spacing))
    assert not isinstance(request.tolerance, str)  # `for_cell` has made it a number
    check_tolerance(request.tolerance, volume.spacing)
    progress, seconds = request.progress, {"read": 0.0, "smooth": 0.0, "surface": 0.0, "check": 0.0, "simplify": 0.0}

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            begin, end = SHARES[stage]
            progress(stage, begin + share * (end - begin))

    count = workers if workers is not None or scheduler not in (None, "threads", "processes") else request.threads
    choice = {"threshold": threshold, "label": label}
    with (
        open_runner(count, scheduler) as opened,
        open_work_folder(resume, run_facts(volume, request, choice)) as folder,
    ):
        runner = replace(opened, kept=folder.results)
        plan = plan_chunks(volume, request, runner, side=side, size=folder.size)
        folder.begin(plan.layout.size)
        work = Work(
            source=volume.array,
            rule=SolidRule(),
            layout=plan.layout,
            smoothing=request.smoothing,
            spacing=tuple(volume.spacing),
            level=None if isinstance(request.level, str) else request.level,
            scratch=folder.fields,
        )
        with _timed(seconds, "read"):
            rule, used = find_rule(work, runner, threshold, label, partial(tell, "read"))
        solver = Solver(work=_with_rule(work, rule), runner=runner, tell=tell)
        with _timed(seconds, "smooth"):
            _load_kernels(work)
            solver.smooth()
            segmentation = require_some_solid(solver, used)
        with _timed(seconds, "surface"):
            surface, common, levels = solver.find_surface()
        with _timed(seconds, "check"):
            crumbs, marked = find_all_crumbs(solver, surface, request)
            numbering = solver.number_vertices(surface, marked)
            counts = compare_counts(solver, surface.shells, marked)
        assert solver.joined is not None
        to_phase = (lambda level: level) if work.level is not None else PLAIN_PROFILE.phase_level
        chunked = ChunkedSurface(
            volume=volume,
            request=request,
            plan=plan,
            solver=solver,
            surface=surface,
            numbering=numbering,
            crumbs=crumbs,
            counts=counts,
            level=(to_phase(common), np.array([to_phase(float(level)) for level in levels])),
            segmentation=segmentation,
            enclosed=float(surface.shells.volume[~marked].sum()) if marked.any() else surface.volume,
            target=float(solver.joined.cells.sum() * solver.cell_volume),
            seconds=seconds,
            progress=progress,
        )
        chunked.check()
        if request.tolerance is not None:
            with _timed(seconds, "simplify"):
                _load_simplification()
                chunked.simplify(request.tolerance, folder.pieces, partial(tell, "simplify"))
        yield chunked


@contextlib.contextmanager
def _timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Add the time of a block to a stage."""
    begin = time.perf_counter()
    yield
    seconds[stage] += time.perf_counter() - begin


def _with_rule(work: Work, rule: SolidRule) -> Work:
    """Return the work with another rule."""
    return replace(work, rule=rule)


@log_compilation("the smoother")
def _load_kernels(work: Work) -> None:
    """Load the compiled loops before several threads need them at once."""
    corner = np.zeros((6, 6, 6), dtype=bool)
    corner[2:4, 2:4, 2:4] = True
    layout = ChunkLayout(shape=(6, 6, 6), size=(1, 1, 1), steps=1)
    trial = replace(
        work,
        source=_ArrayReader(corner),
        rule=SolidRule(),
        layout=layout,
        smoothing=replace(work.smoothing, steps=1),
        scratch="",
    )
    smooth(trial, next(iter(layout)))


@log_compilation("simplification")
def _load_simplification() -> None:
    """Load its compiled loops before several threads need them at once."""
    ring = make_ring()
    collapse_edges(ring, tolerance=0.01, threads=1, pinned=np.asarray(ring.vertices)[:, 0] < 0)


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
