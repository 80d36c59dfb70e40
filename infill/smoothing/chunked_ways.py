"""The ways to smooth a volume in chunks that are tried in turn until nothing is lost: those of a volume in memory.

See `infill.smoothing.remedies` and `infill.smoothing.scans.scan_ways`. Of the ways in memory, one is left out: noisy
data are not refined, which takes longer than the way that was asked for.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from infill.errors import GeometryError
from infill.phasefield.profile import REFINED_PROFILE
from infill.phasefield.schedule import MIN_STEPS
from infill.reports.smoothing import ReplacedSmoothing
from infill.smoothing.chunked_data import ChosenWork
from infill.smoothing.chunked_surface import ChunkedSurface
from infill.smoothing.request import SmoothRequest


@dataclass(frozen=True, kw_only=True)
class ChunkedWay:
    """A way to smooth a volume in chunks.

    Parameters
    ----------
    name : str
        For the report.
    chosen : ChosenWork
    """

    name: str
    chosen: ChosenWork


def list_ways(chosen: ChosenWork, *, is_auto: bool) -> Iterator[ChunkedWay]:
    """Yield the way that was chosen, the same with fewer and fewer steps, and the plain one if the method was open."""
    method, steps = chosen.request.method, chosen.request.smoothing.steps
    yield ChunkedWay(name=method, chosen=chosen)
    fewer = steps
    while fewer > MIN_STEPS:
        fewer = max(MIN_STEPS, fewer // 2)
        smoothing = replace(chosen.request.smoothing, steps=fewer)
        gentler = _with_request(chosen, replace(chosen.request, smoothing=smoothing))
        yield ChunkedWay(name=f"{method}, {fewer} steps", chosen=gentler)
    if is_auto and method != "plain":
        yield ChunkedWay(name="plain", chosen=_with_request(chosen, replace(chosen.request, method="plain")))


def _with_request(chosen: ChosenWork, request: SmoothRequest) -> ChosenWork:
    """Return the work with fewer steps or another method, in the same chunks."""
    layout = replace(chosen.plan.layout, steps=request.smoothing.steps, refined=request.refined)
    level = None if isinstance(request.level, str) else request.level
    work = replace(
        chosen.work,
        layout=layout,
        smoothing=request.smoothing,
        refined=request.refined,
        level=REFINED_PROFILE.distance_level(level) if level is not None and request.refined else level,
    )
    return replace(chosen, request=request, plan=replace(chosen.plan, layout=layout), work=work)


def find_sound_way(ways: Sequence[ChunkedWay], smooth: Callable[[int, ChunkedWay], ChunkedSurface]) -> ChunkedSurface:
    """Smooth in one way after another until nothing is lost; return that surface, or else the best one.

    With `strict` or `allow_broken`, the first way is the only one, unless nothing is left of it.

    Raises
    ------
    GeometryError
        If nothing is left whatever the way, or the best result is refused.
    """
    best: ChunkedSurface | None = None
    taken = ways[0]
    tried: list[str] = []
    failed: GeometryError | None = None
    for number, way in enumerate(ways):
        request = way.chosen.request
        if tried and (request.strict or (request.allow_broken and best is not None)):
            break
        try:
            surface = smooth(number, way)
        except GeometryError as error:
            failed = failed or error
        else:
            worse: ChunkedSurface | None = surface
            if best is None or surface.verdict.rank < best.verdict.rank:
                worse, best, taken = best, surface, way
            if worse is not None:
                shutil.rmtree(worse.solver.work.scratch, ignore_errors=True)  # its fields
        tried.append(way.name)
        if best is not None and (best.verdict.is_sound or (best.verdict.word != "lost" and len(tried) > 1)):
            break
    in_vain = f" (tried in vain: {'; '.join(tried[1:])})" if tried[1:] else ""
    if best is None:
        assert failed is not None
        raise GeometryError(f"{failed}{in_vain}") from failed
    best.tried, best.taken, best.instead_of = tried, taken.name, _replaced_steps(ways[0], taken)
    best.check(in_vain)
    return best


def _replaced_steps(asked: ChunkedWay, taken: ChunkedWay) -> ReplacedSmoothing | None:
    """Return the steps that were asked for if others were taken, for the report."""
    steps = asked.chosen.request.smoothing.steps
    return None if taken.chosen.request.smoothing.steps == steps else {"steps": steps, "radius": None}
