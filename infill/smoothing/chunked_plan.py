"""The cost of smoothing a volume in chunks, from a few of its chunks."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from infill.chunks.layout import Chunk
from infill.chunks.running import open_runner, require_dask
from infill.chunks.seams import SeamPlan
from infill.chunks.simplifying import Fragment, simplify_fragment, split_faces
from infill.chunks.work import ChunkTriangles, LevelTask, Work, make_part, smooth
from infill.lazy.volume import LazyVolume
from infill.phasefield.schedule import MIN_STEPS
from infill.reports.smoothing import ChunksForecast
from infill.smoothing.chunk_plans import check_chunked
from infill.smoothing.chunked_data import choose_work
from infill.smoothing.chunked_simplified import check_tolerance
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold

SAMPLES = 3  # chunks that are smoothed
SEAMS = 1.3  # times that of the parts: what simplification takes with the boxes around seams
PASSES = 2.0  # passes over the pieces that find the level and write, in the time of the one that makes pieces


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
    request, plan, work = chosen.request, chosen.plan, chosen.work
    chunks = list(plan.layout)
    numbers = np.linspace(0, len(chunks) - 1, SAMPLES + 2).astype(int)[1:-1].tolist()
    samples = [chunks[number] for number in dict.fromkeys(numbers)]
    fewest = MIN_STEPS if work.refined else 1
    smooth(replace(work, smoothing=replace(work.smoothing, steps=fewest)), samples[0])  # loads what a run needs
    seconds, triangles, crossed = 0.0, 0, 0
    for chunk in samples:
        begin = time.perf_counter()
        smoothed = smooth(work, chunk)
        between = time.perf_counter()
        if smoothed.start is not None:
            crossed += 1
            smoothing = between - begin
            part = make_part(work, chunk, LevelTask(level=work.level or 0.0), np.zeros(0, dtype=bool))
            triangles += len(part.faces)
            # Without a kept field, the piece was made by smoothing once more.
            seconds += smoothing + PASSES * max(0.0, time.perf_counter() - between - smoothing / 2)
            if tolerance is not None:
                seconds += _simplifying_time(work, chunk, part, tolerance)
        else:
            seconds += between - begin
    times = len(chunks) / len(samples)
    return {
        "request": request.facts(),
        "grid": {
            "shape": list(volume.shape),
            "spacing": list(volume.spacing),
            "origin": list(volume.origin),
            "space": volume.space,
        },
        "chunks": len(chunks),
        "crossed": crossed / len(samples),
        "read": plan.read,
        "triangles": round(triangles * times),
        "memory": plan.memory,
        "seconds": {"total": seconds * times / min(plan.workers, len(chunks))},
    }
