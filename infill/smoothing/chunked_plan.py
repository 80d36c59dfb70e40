"""The cost of smoothing a volume in chunks, from a few of its chunks."""

from __future__ import annotations

import pickle
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from infill.chunks.layout import Chunk
from infill.chunks.level_parts import LevelTask, try_level
from infill.chunks.running import open_runner, require_dask
from infill.chunks.seams import SeamPlan
from infill.chunks.simplifying import Fragment, simplify_fragment, split_faces
from infill.chunks.tasks import ChunkTriangles, make_part, smooth
from infill.chunks.work import Work
from infill.lazy.volume import LazyVolume
from infill.reports.smoothing import ChunksForecast
from infill.smoothing.chunk_changes import compare_chunk
from infill.smoothing.chunk_plans import check_chunked
from infill.smoothing.chunked_data import choose_work
from infill.smoothing.chunked_simplified import check_tolerance
from infill.smoothing.comparing import THICK
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold

SAMPLES = 3  # chunks that are smoothed
SEAMS = 1.3  # times that of the parts: simplification, with the boxes around seams
SEAM_TASKS = 3  # for each chunk: boxes around faces, edges and corners
LEVEL_PASSES = 3  # over the chunks, to find the level of one component; of many components, up to sixteen
JOINING = 4e-7  # seconds for each byte of results, on the one machine that joins them: measured
FLEETS = (1, 10, 100)  # workers for which hours are told


@dataclass(frozen=True, kw_only=True)
class ChunkCost:
    """The cost of one chunk.

    Parameters
    ----------
    crossed : bool
        Whether a surface may cross it.
    seconds : float
        Of one core.
    results : int
        Bytes that its tasks send back, except triangles.
    triangles : int
        Before they are simplified.
    """

    crossed: bool
    seconds: float
    results: int = 0
    triangles: int = 0


def plan_chunked(
    volume: LazyVolume,
    request: SmoothRequest,
    *,
    threshold: Threshold = None,
    label: int | Sequence[int] | None = None,
    grey: bool | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
) -> ChunksForecast:
    """Return the plan of `infill.smoothing.chunked.smooth_in_chunks` with the same arguments, as plain numbers.

    Some chunks are smoothed, evenly spaced, so that time and triangles are estimates of those of all.
    """
    check_chunked(request)
    require_dask()
    tolerance = request.for_cell(min(volume.spacing)).tolerance
    assert not isinstance(tolerance, str)  # `for_cell` has made it a number
    check_tolerance(tolerance, volume.spacing)
    with open_runner(workers if workers is not None or scheduler else request.threads, scheduler) as runner:
        chosen = choose_work(volume, request, runner, lambda _: None, threshold=threshold, label=label, grey=grey)
    request, plan = chosen.request, chosen.plan
    chunks = list(plan.layout)
    numbers = np.linspace(0, len(chunks) - 1, SAMPLES + 2).astype(int)[1:-1].tolist()
    samples = [chunks[number] for number in dict.fromkeys(numbers)]
    with tempfile.TemporaryDirectory(prefix="infill-plan-") as scratch:
        work = replace(chosen.work, scratch=scratch)
        measure_cost(replace(work, scratch=""), samples[0], tolerance)  # loads what a run needs
        costs = [measure_cost(work, chunk, tolerance) for chunk in samples]
    times = len(chunks) / len(samples)
    crossed = sum(cost.crossed for cost in costs) / len(samples)
    seconds = times * sum(cost.seconds for cost in costs)
    joining = JOINING * times * sum(cost.results for cost in costs)
    passes = LEVEL_PASSES + 2 + (0 if tolerance is None else 1 + SEAM_TASKS)  # with the verdict and the writing
    return {
        "request": request.facts(),
        "grid": {
            "shape": list(volume.shape),
            "spacing": list(volume.spacing),
            "origin": list(volume.origin),
            "space": volume.space,
        },
        "chunks": len(chunks),
        "crossed": crossed,
        "read": plan.read,
        "sent": round(times * sum(cost.results for cost in costs)),
        "tasks": round(len(chunks) * (1 + crossed * passes)),
        "triangles": round(times * sum(cost.triangles for cost in costs)),
        "memory": plan.memory,
        "memory_per_worker": plan.memory // min(plan.workers, len(chunks)),
        "hours": [
            {"workers": fleet, "hours": (seconds / min(fleet, len(chunks)) + joining) / 3600} for fleet in FLEETS
        ],
        "seconds": {"total": seconds / min(plan.workers, len(chunks)) + joining},
    }


def measure_cost(work: Work, chunk: Chunk, tolerance: float | None) -> ChunkCost:
    """Measure the cost of a chunk by doing each of its tasks once."""
    begin = time.perf_counter()
    smoothed = smooth(work, chunk)
    if smoothed.start is None:
        return ChunkCost(crossed=False, seconds=time.perf_counter() - begin, results=_size_of(smoothed))
    task, nothing = LevelTask(level=work.level or 0.0), np.zeros(0, dtype=bool)
    times = [time.perf_counter()]
    level = try_level(work, chunk, task)
    if not level.complete:  # cubes whose signs do not decide their triangles take a second pass
        task = replace(task, first_cubes=np.zeros(len(level.cubes.bricks), dtype=np.int64))
        level = try_level(work, chunk, task)
    times.append(time.perf_counter())
    compared = compare_chunk(work, chunk, task, nothing, THICK)
    part = make_part(work, chunk, task, nothing)
    times.append(time.perf_counter())
    simplifying = 0.0 if tolerance is None else _simplifying_time(work, chunk, part, tolerance)
    return ChunkCost(
        crossed=True,
        seconds=times[0] - begin + LEVEL_PASSES * (times[1] - times[0]) + times[2] - times[1] + simplifying,
        results=_size_of(smoothed) + LEVEL_PASSES * _size_of(level) + _size_of(compared),
        triangles=len(part.faces),
    )


def _size_of(result: object) -> int:
    """Return the bytes of a result as it is sent."""
    return len(pickle.dumps(result, protocol=pickle.HIGHEST_PROTOCOL))


def _simplifying_time(work: Work, chunk: Chunk, part: ChunkTriangles, tolerance: float) -> float:
    """Return the seconds that simplification takes for a chunk, by one of its parts."""
    points = np.concatenate([part.vertices, part.corners])
    whole = Fragment(numbers=np.arange(len(points)), points=points, faces=part.faces.astype(np.int32))
    number = split_faces(whole, chunk, SeamPlan(layout=work.layout), work.spacing)
    names, counts = np.unique(number, return_counts=True)
    if not len(names):
        return 0.0
    fragment = whole.select(number == names[np.argsort(counts)[len(counts) // 2]])
    begin = time.perf_counter()
    simplify_fragment(fragment, fragment.border, None, tolerance, len(points))
    return SEAMS * (time.perf_counter() - begin) * len(whole.faces) / len(fragment.faces)
