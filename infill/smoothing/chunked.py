"""Smooth a volume in chunks, with the bits of the whole, for volumes that do not fit into memory.

    method  ─▶  smooth all chunks  ─▶  level  ─▶  crumbs  ─▶  verdict  ─▶  fewer triangles  ─▶  pieces  ─▶  report

The passes over the chunks are those of `infill.chunks.solving`; their result is judged by `chunked_verdict`.
"""

from __future__ import annotations

import contextlib
import os
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
from infill.chunks.tasks import smooth
from infill.chunks.work import Work
from infill.kernels.compiling import log_compilation
from infill.lazy.volume import LazyVolume
from infill.meshes.compile_simplification import make_ring
from infill.meshes.edge_collapse import collapse_edges
from infill.phasefield.profile import PLAIN_PROFILE, REFINED_PROFILE
from infill.phasefield.schedule import MIN_STEPS
from infill.reports.smoothing import SegmentationKeys
from infill.smoothing.chunk_plans import check_chunked
from infill.smoothing.chunked_data import ChosenWork, choose_work
from infill.smoothing.chunked_rule import count_specks, require_some_solid
from infill.smoothing.chunked_simplified import check_tolerance
from infill.smoothing.chunked_surface import WRITING, ChunkedSurface, find_all_crumbs
from infill.smoothing.chunked_verdict import judge_chunks
from infill.smoothing.chunked_ways import ChunkedWay, find_sound_way, list_ways
from infill.smoothing.comparing import intolerable_error
from infill.smoothing.request import AUTO, SmoothInput, SmoothRequest
from infill.smoothing.scans import Threshold
from infill.smoothing.work_folders import open_work_folder, run_facts

SHARES = {
    "read": (0.0, 0.05),
    "smooth": (0.05, 0.4),
    "join": (0.4, 0.41),
    "surface": (0.41, 0.52),
    "check": (0.52, 0.6),
    "simplify": (0.6, WRITING),
}


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
    resume: str | os.PathLike[str] | None = None,
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
    resume : str or Path, optional
        Folder for finished work, from which a run that was interrupted goes on; removed when the block has ended
        without an error.

    Raises
    ------
    ParameterError
        For options that a volume in chunks does not have, or that do not determine the solid.
    GeometryError
        If nothing is left, or something is lost in every way that was tried.
    FormatError
        If cells cannot be read.
    MemoryLimitError
        If a worker ends before its chunk is done.
    """
    check_chunked(request)
    require_dask()
    tolerance = request.for_cell(min(volume.spacing)).tolerance
    assert not isinstance(tolerance, str)  # `for_cell` has made it a number
    check_tolerance(tolerance, volume.spacing)
    progress, seconds = request.progress, {"read": 0.0, "smooth": 0.0, "surface": 0.0, "check": 0.0, "simplify": 0.0}

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            begin, end = SHARES[stage]
            progress(stage, begin + share * (end - begin))

    count = workers if workers is not None or scheduler not in (None, "threads", "processes") else request.threads
    choice = {"threshold": threshold, "label": label, "grey": grey}
    with (
        open_runner(count, scheduler) as opened,
        open_work_folder(resume, run_facts(volume, request, choice)) as folder,
    ):
        runner = replace(opened, kept=folder.results)
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
                size=folder.size,
                scratch=folder.fields,
            )
        folder.begin(chosen.plan.layout.size)
        ways = list(list_ways(chosen, is_auto=request.method == AUTO))

        def smooth_way(number: int, way: ChunkedWay) -> ChunkedSurface:
            work = replace(way.chosen.work, scratch=folder.fields_of(number))
            solver = Solver(work=work, runner=runner, tell=tell)
            return _find_surface(solver, replace(way.chosen, work=work), volume, seconds)

        chunked = find_sound_way(ways, smooth_way)
        if tolerance is not None:
            with _timed(seconds, "simplify"):
                _load_simplification()
                chunked.simplify(tolerance, folder.pieces, partial(tell, "simplify"))
        yield chunked


def _find_surface(solver: Solver, chosen: ChosenWork, volume: LazyVolume, seconds: dict[str, float]) -> ChunkedSurface:
    """Smooth the chunks, find their surface, without crumbs, and judge it."""
    request = chosen.request
    with _timed(seconds, "smooth"):
        _load_kernels(solver.work)
        solver.smooth()
        segmentation = require_some_solid(solver, chosen.used)
        specks = count_specks(solver)
    with _timed(seconds, "surface"):
        surface, common, levels = solver.find_surface()
    to_phase = _phase_level(request)
    phase_levels = np.array([to_phase(float(level)) for level in levels])
    target = float(solver.targets.sum())
    with _timed(seconds, "check"):
        crumbs, marked = find_all_crumbs(solver, surface, request)
        numbering = solver.number_vertices(surface, marked)
        enclosed = float(surface.shells.volume[~marked].sum()) if marked.any() else surface.volume
        verdict = judge_chunks(
            solver,
            surface,
            marked,
            smooth_input=_input_without_values(volume, segmentation, chosen.noise),
            levels=phase_levels,
            volume_error=intolerable_error(enclosed / target - 1, request),
        )
    return ChunkedSurface(
        volume=volume,
        request=request,
        plan=chosen.plan,
        solver=solver,
        surface=surface,
        numbering=numbering,
        crumbs=crumbs,
        verdict=verdict,
        level=(to_phase(common), phase_levels),
        segmentation=segmentation,
        noise=chosen.noise,
        grey=chosen.grey,
        specks=specks,
        enclosed=enclosed,
        target=target,
        seconds=seconds,
        progress=request.progress,
    )


def _input_without_values(volume: LazyVolume, segmentation: SegmentationKeys, noise: float) -> SmoothInput:
    """Return the input of a verdict: the place of the cells in space, and the facts about them."""
    nothing = volume.place(np.broadcast_to(np.False_, volume.shape))
    return SmoothInput(data=nothing, facts={"source": "volume", "segmentation": segmentation, "noise": noise})


@contextlib.contextmanager
def _timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Add the time of a block to a stage."""
    begin = time.perf_counter()
    yield
    seconds[stage] += time.perf_counter() - begin


def _phase_level(request: SmoothRequest) -> Callable[[float], float]:
    """Return the function that converts a level of the field to one of phi."""
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
