"""Smooth every label of a volume that is not in memory, each by itself, in the part of it where it lies.

    find the labels, box by box  ─▶  read the part of each label and smooth it  ─▶  keep surface and report on disk

The surface of a label is that of the volume in memory, to the last bit: it is smoothed in the same way, in the same
part. Several labels are smoothed at a time, as memory allows: by threads of this process, or by tasks of Dask.
"""

from __future__ import annotations

import contextlib
import math
import pickle
import shutil
import tempfile
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack, cast
from weakref import WeakValueDictionary, finalize

import numpy as np

from infill.chunks.running import Runner, current_client, open_runner
from infill.errors import InfillError, MemoryLimitError, UsageError
from infill.files.whole_files import wrap_os_errors
from infill.grid import Grid
from infill.imaging.label_tables import Segment
from infill.kernels.compiling import log_compilation
from infill.kernels.threads import in_order, thread_count
from infill.lazy.volume import LazyArray, LazyVolume, whole_boxes
from infill.machine import GIB, available_memory
from infill.result import Clock, Result
from infill.smoothing.chunk_plans import check_chunked
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.job import smooth_volume
from infill.smoothing.kept_reports import PackedSolid, late_report, pack_report
from infill.smoothing.label_pieces import (
    absent_names,
    box_of,
    labels_result,
    name_pieces,
    smooth_box,
    split_outcomes,
    title_of,
)
from infill.smoothing.label_runs import LabelWork, run_labels
from infill.smoothing.label_stages import LabelPiece, LabelStages
from infill.smoothing.plan import forecast_labels
from infill.smoothing.request import SmoothOptions, SmoothRequest
from infill.surface import Surface
from infill.voxels.label_survey import LabelSurvey, join_surveys, survey_box

if TYPE_CHECKING:
    from infill.reports.smoothing import Distance, LabelsForecast, LabelsReport, SmoothReport
    from infill.result import Progress

MOST_SURVEYED = 2**24  # cells that are looked at in one go
BYTES_PER_CELL = 6  # of the part where a label lies: its mask, and its data as 32-bit numbers, besides the labels
AT_ONCE = 8  # labels for each worker of a cluster, whose surfaces come back together


@dataclass(frozen=True, kw_only=True)
class StoredLabel:
    """A label that was smoothed, in three files.

    Parameters
    ----------
    base : str
        The path of each without its suffix.
    has_solid : bool
        Whether distances are measured from the solid that is kept; otherwise they are in the report.
    """

    base: str
    has_solid: bool

    @property
    def surface(self) -> Path:
        """File of the surface."""
        return Path(f"{self.base}.surface")

    @property
    def report(self) -> Path:
        """File of the report."""
        return Path(f"{self.base}.report")

    @property
    def solid(self) -> Path:
        """File of the solid from which distances are measured."""
        return Path(f"{self.base}.solid")


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothedLabel:
    """A label that was smoothed.

    Parameters
    ----------
    value : int
    surface : Surface
    known : SmoothReport
        The report without distances.
    solid : PackedSolid, optional
        From which to measure them.
    """

    value: int
    surface: Surface
    known: SmoothReport
    solid: PackedSolid | None


class KeptFolder:
    """A temporary folder that is removed when nobody holds it any more, or the process ends.

    Attributes
    ----------
    name : str
    """

    def __init__(self) -> None:
        self.name = tempfile.mkdtemp(prefix="infill-labels-")
        self.remove = finalize(self, shutil.rmtree, self.name, ignore_errors=True)


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelTask:
    """How to smooth the labels of a volume.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
    options : SmoothOptions
        Those of the request, without a listener.
    folder : str
        Where surfaces and reports are kept.
    """

    volume: LazyVolume
    request: SmoothRequest
    options: SmoothOptions
    folder: str

    def cut(self, piece: LabelPiece) -> LazyVolume:
        """Return the part of the volume in which a label is smoothed."""
        return self.volume.cut(*box_of(piece, self.request, self.volume.shape))

    def work(self, piece: LabelPiece) -> LabelWork:
        """Estimate the work of a label, with the part of the volume that is read for it."""
        work, cells = piece.work(self.request), math.prod(self.cut(piece).shape)
        per_cell = self.volume.array.dtype.itemsize + BYTES_PER_CELL
        return LabelWork(cells=work.cells, memory=work.memory + cells * per_cell)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class StoredSurfaces(Mapping[str, Surface]):
    """Surfaces by the names of labels, kept as files; they are in memory no longer than someone uses them.

    Parameters
    ----------
    labels : mapping of str to StoredLabel
    folder : KeptFolder
    """

    labels: Mapping[str, StoredLabel]
    folder: KeptFolder
    _used: WeakValueDictionary[str, Surface] = field(default_factory=WeakValueDictionary, init=False)

    def __getitem__(self, name: str) -> Surface:
        """Return the surface of a label; it is the same object as long as it is in use."""
        surface = self._used.get(name)
        if surface is None:
            surface = _load(self.labels[name].surface)
            self._used[name] = surface
        return surface

    def __contains__(self, name: object) -> bool:
        """Tell whether a label has a surface, without reading it."""
        return name in self.labels

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        return iter(self.labels)

    def __len__(self) -> int:
        """Return the number of surfaces."""
        return len(self.labels)

    def __repr__(self) -> str:
        """Return the names."""
        return f"StoredSurfaces({', '.join(self)})"

    def report(self, name: str, request: SmoothRequest) -> SmoothReport:
        """Return the report of a label, whose distances are measured when they are first read."""
        stored = self.labels[name]
        known: SmoothReport = _load(stored.report)
        return late_report(known, partial(self._measure, name, request)) if stored.has_solid else known

    def _measure(self, name: str, request: SmoothRequest) -> Distance:
        """Measure the distances between the surface of a label and its voxels."""
        solid: PackedSolid = _load(self.labels[name].solid)
        return solid.distance(self[name], request)


def smooth_lazy_labels(
    volume: LazyVolume,
    *,
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    segments: Sequence[Segment] = (),
    keep_going: bool = False,
    workers: int | None = None,
    scheduler: str | None = None,
    most: int = MOST_SURVEYED,
    **options: Unpack[SmoothOptions],
) -> Result[LabelStages, LabelsReport]:
    """Smooth every label of a volume by itself, without having all of it in memory.

    Parameters
    ----------
    volume : LazyVolume
    label, table, keep_going, **options
        See `infill.smooth_labels`.
    segments : sequence of Segment
        Of the file.
    workers, scheduler
        See `infill.chunks.running.open_runner`; without both, threads of this process, or the current client of Dask.
    most : int
        Cells that are looked at in one go.

    Returns
    -------
    Result
        As that of `infill.smooth_labels`; its surfaces are read from a temporary folder when they are asked for.

    Raises
    ------
    ParameterError, GeometryError, MemoryLimitError
        As `infill.smooth_labels`.
    FormatError
        If cells cannot be read.
    """
    request = SmoothRequest(**options)
    clock = Clock(request.progress)
    with open_label_runner(workers, scheduler) as runner:
        with clock.stage("labels", 0.0):
            survey = survey_labels(volume, runner, request.threads, most=most)
            pieces = name_lazy_pieces(volume, survey, segments, label, tuple(table))
            absent = absent_names(segments, pieces) if label is None else []
        folder = KeptFolder()
        task = LabelTask(
            volume=volume,
            request=replace(request, progress=None),
            options={**options, "progress": None},
            folder=folder.name,
        )
        with clock.stage("smooth", 0.0):
            large = _find_large(task, pieces, _allowed_memory(request, runner), keep_going=keep_going)
            outcomes = _smooth_others(task, pieces, large, runner, request, stop=not keep_going)
    if large and (keep_going or not any(isinstance(outcome, InfillError) for outcome in outcomes)):
        with clock.stage("smooth", 1.0):
            for number, refusal in large.items():
                chunked = partial(_smooth_in_chunks, task, pieces[number], workers, scheduler)
                outcomes[number] = refusal or chunked()
    stored, failed = split_outcomes(pieces, outcomes, keep_going=keep_going)
    surfaces = StoredSurfaces(labels=stored, folder=folder)
    reports = {name: surfaces.report(name, request) for name in stored}
    return labels_result(pieces, surfaces, reports, failed, absent, request, clock)


def plan_lazy_labels(
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
    """Return the plan for `smooth_lazy_labels` with the same arguments, as plain numbers.

    Parameters
    ----------
    volume : LazyVolume
    begin : float
        Start of opening it, by `time.perf_counter`.
    label, table, segments, workers, scheduler, **options
        See `smooth_lazy_labels`.
    """
    request = SmoothRequest(**options)
    with open_label_runner(workers, scheduler) as runner:
        survey = survey_labels(volume, runner, request.threads)
        pieces = name_lazy_pieces(volume, survey, segments, label, tuple(table))
        allowed = _allowed_memory(request, runner)
    task = LabelTask(volume=volume, request=request, options={**options, "progress": None}, folder="")
    _find_large(task, pieces, allowed, keep_going=False)
    grid = Grid(shape=volume.shape, spacing=volume.spacing, origin=volume.origin)
    return forecast_labels(
        pieces,
        [math.prod(volume.spacing)],
        grid,
        request.for_cell(min(volume.spacing)),
        memory=max(task.work(piece).memory for piece in pieces),
        begin=begin,
    )


@contextlib.contextmanager
def open_label_runner(workers: int | None, scheduler: str | None) -> Iterator[Runner | None]:
    """Yield the runner of tasks that is asked for, or of the current client; None for threads of this process."""
    if workers is None and scheduler is None and current_client() is None:
        yield None
    else:
        with open_runner(workers, scheduler) as runner:
            yield runner


def survey_labels(
    volume: LazyVolume, runner: Runner | None, threads: int | None, *, most: int = MOST_SURVEYED
) -> LabelSurvey:
    """Find the labels of a volume, box by box: see `infill.voxels.label_survey`."""
    boxes = list(whole_boxes(volume.array, most))
    survey_box(np.zeros((1, 1, 1), dtype=np.uint8), (0, 0, 0))  # loads the kernel, before several threads need it
    if runner is not None:
        return join_surveys(runner.run(_survey, volume.array, boxes))
    joined: LabelSurvey | None = None
    for _, survey in in_order(lambda box: _survey(volume.array, *box), boxes, threads=thread_count(threads)):
        joined = survey if joined is None else join_surveys([joined, survey])
    assert joined is not None  # a volume has cells
    return joined


def _survey(array: LazyArray, low: tuple[int, ...], high: tuple[int, ...]) -> LabelSurvey:
    """Survey a box of an array."""
    overlap = low[2] > 0
    first = (*low[:2], low[2] - overlap)
    return survey_box(array.read(tuple(map(slice, first, high))), low, overlap=overlap)


def name_lazy_pieces(
    volume: LazyVolume,
    survey: LabelSurvey,
    segments: Sequence[Segment],
    label: int | tuple[int, ...] | None,
    table: tuple[Segment, ...],
) -> list[LabelPiece]:
    """Return the labels to smooth: see `infill.smoothing.labels.name_pieces`."""
    rows = volume.shape[0] * volume.shape[1]
    return name_pieces([survey.extents], lambda: survey.is_label_map(rows), segments, label, table)


def _allowed_memory(request: SmoothRequest, runner: Runner | None) -> int | None:
    """Return the bytes that one label may take, and all labels of this machine at the same time."""
    share = None if runner is None else runner.memory_per_task()
    if request.max_memory is None:
        return available_memory() if share is None else share
    return request.max_memory


def _find_large(
    task: LabelTask, pieces: Sequence[LabelPiece], allowed: int | None, *, keep_going: bool
) -> dict[int, MemoryLimitError | None]:
    """Find the labels that do not fit into memory, by their place; with an error for those not smoothed in chunks.

    Raises
    ------
    MemoryLimitError
        The first of these errors, with the name of the label, unless `keep_going`.
    """
    large: dict[int, MemoryLimitError | None] = {}
    for number, piece in enumerate(pieces):
        needed = task.work(piece).memory
        if allowed is None or needed <= allowed:
            continue
        large[number] = None
        try:
            check_chunked(task.request)
        except UsageError as refusal:
            error = large[number] = MemoryLimitError(
                f"its part of the volume, {' x '.join(map(str, task.cut(piece).shape))} voxels, needs about "
                f"{needed / GIB:.2f} GiB of memory and {allowed / GIB:.2f} GiB are allowed; it would be smoothed in "
                f"chunks, but {refusal}, or take a coarser level of the volume"
            )
            if not keep_going:
                raise error.within(title_of(piece)) from None
    return large


def _smooth_others(
    task: LabelTask,
    pieces: Sequence[LabelPiece],
    large: Container[int],
    runner: Runner | None,
    request: SmoothRequest,
    *,
    stop: bool,
) -> list[StoredLabel | InfillError | None]:
    """Smooth the labels that fit into memory; return the outcome of each, None for the others."""
    numbers = [number for number in range(len(pieces)) if number not in large]
    outcomes: list[StoredLabel | InfillError | None] = [None] * len(pieces)
    works = [task.work(pieces[number]) for number in numbers]
    if runner is None:

        def smooth_one(number: int, threads: int, progress: Progress | None) -> StoredLabel | InfillError:
            return _stored(task, smooth_label(task, pieces[numbers[number]], threads, progress))

        results = run_labels(
            smooth_one,
            works,
            stop_early=stop,
            threads=request.threads,
            max_memory=request.max_memory,
            progress=request.progress,
        )
        for number, outcome in zip(numbers, results, strict=True):
            outcomes[number] = outcome
        return outcomes
    allowed = None if runner.client is not None else _allowed_memory(request, runner)
    load_smoother()
    finished = 0
    for part, at_once in split_by_memory(works, runner.workers, allowed):
        share = partial(_tell, request.progress, finished / len(works), len(part) / len(works))
        chosen = [numbers[at] for at in part]
        made = replace(runner, workers=at_once).run(smooth_label, task, [(pieces[number],) for number in chosen], share)
        for number, smoothed in zip(chosen, made, strict=True):
            outcomes[number] = _stored(task, smoothed)
        finished += len(part)
        if stop and any(isinstance(outcomes[number], InfillError) for number in chosen):
            break
    return outcomes


def _tell(progress: Progress | None, begin: float, more: float, share: float) -> None:
    """Report the progress of a part of the labels."""
    if progress is not None:
        progress("smooth", begin + more * share)


def split_by_memory(works: Sequence[LabelWork], workers: int, allowed: int | None) -> Iterator[tuple[list[int], int]]:
    """Yield parts of the labels, the largest first, and how many of each may be smoothed at the same time.

    >>> works = [LabelWork(cells=n, memory=n) for n in (1, 9, 6, 1, 5)]
    >>> list(split_by_memory(works, 2, 10))
    [([1], 1), ([2], 1), ([4, 0, 3], 2)]
    """
    order = sorted(range(len(works)), key=lambda number: -works[number].memory)
    begin = 0
    while begin < len(order):
        largest = works[order[begin]].memory
        at_once = workers if allowed is None else max(1, min(workers, allowed // max(1, largest)))
        # As many at once as there are workers: then a pool of them does no more either.
        count = at_once if at_once < workers else AT_ONCE * workers
        yield order[begin : begin + count], at_once
        begin += count


def smooth_label(
    task: LabelTask, piece: LabelPiece, threads: int = 1, progress: Progress | None = None
) -> StoredLabel | SmoothedLabel | InfillError:
    """Smooth one label in its part of the volume; return where it is kept, itself on another machine, or its error."""
    box = task.cut(piece)
    options: SmoothOptions = {**task.options, "threads": threads, "progress": progress}
    try:
        cells = box.array.read(tuple(slice(0, count) for count in box.shape))
        result = smooth_box(box.place(cells), piece, options)
        known, solid = pack_report(result)
        smoothed = SmoothedLabel(value=piece.segment.value, surface=result.surface, known=known, solid=solid)
        return _store(task.folder, smoothed) if Path(task.folder).is_dir() else smoothed
    except InfillError as error:
        return error


def _smooth_in_chunks(
    task: LabelTask, piece: LabelPiece, workers: int | None, scheduler: str | None
) -> StoredLabel | InfillError:
    """Smooth a label that does not fit into memory in chunks."""
    try:
        with smooth_in_chunks(
            task.cut(piece), task.request, label=piece.segment.value, workers=workers, scheduler=scheduler
        ) as chunked:
            surface, report = chunked.whole(), chunked.report()
        known = cast("SmoothReport", report)
        return _store(task.folder, SmoothedLabel(value=piece.segment.value, surface=surface, known=known, solid=None))
    except InfillError as error:
        return error


def _stored(task: LabelTask, outcome: StoredLabel | SmoothedLabel | InfillError) -> StoredLabel | InfillError:
    """Keep what has come from another machine."""
    return _store(task.folder, outcome) if isinstance(outcome, SmoothedLabel) else outcome


def _store(folder: str, smoothed: SmoothedLabel) -> StoredLabel:
    """Keep a label in a folder."""
    stored = StoredLabel(base=str(Path(folder, str(smoothed.value))), has_solid=smoothed.solid is not None)
    for path, content in (
        (stored.surface, smoothed.surface),
        (stored.report, smoothed.known),
        (stored.solid, smoothed.solid),
    ):
        with wrap_os_errors(path), path.open("wb") as file:
            pickle.dump(content, file, protocol=pickle.HIGHEST_PROTOCOL)
    return stored


def _load(path: Path) -> Any:  # noqa: ANN401 - what was kept
    """Return what this program has kept in its own folder."""
    with wrap_os_errors(path), path.open("rb") as file:
        return pickle.load(file)  # noqa: S301 - of this run


@log_compilation("the smoother")
def load_smoother() -> None:
    """Load the compiled loops before several threads need them at once."""
    cells = np.zeros((12, 12, 12), dtype=bool)
    cells[3:9, 3:9, 3:9] = True
    with contextlib.suppress(InfillError):
        smooth_volume(cells, threads=1)
