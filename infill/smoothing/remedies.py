"""Try one way to smooth after another until nothing real is lost, before a result is refused.

Each way is a whole run. The first result that is sound is taken; if none is, the best of them. Whether a way is tried
depends on the input and the options alone, never on a clock: the same input gives the same surface on any machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from infill.errors import GeometryError, MemoryLimitError, ParameterError
from infill.smoothing.attempt import (
    Attempt,
    advise_all_triangles,
    estimate_surface_cells,
    finish_attempt,
    remove_specks,
    run_attempt,
)
from infill.smoothing.meshes import voxelise_input
from infill.smoothing.request import MeshOnGrid, SmoothInput, SmoothRequest, Way

if TYPE_CHECKING:
    from infill.reports.smoothing import ReplacedSmoothing, SmoothReport
    from infill.result import Result
    from infill.smoothing.stages import SmoothStages

# Work is counted in steps over cells at the surface. Finding the level, comparing and measuring take as long as 100
# steps: of 42 meshes and scans, a unit took 0.06 to 0.18 µs of one core, and up to 0.36 where components overlap.
OTHER_STEPS = 100
# A way that takes more work than the first is skipped if all ways together would take more than this, about 100 s of
# one core. With the usual 20 steps, refined, that leaves the three finer grids to meshes of up to 190,000 cells at the
# surface, two of them up to 510,000, and one up to 1,300,000; all 42 take the ways that they took within 100 s.
MAX_WORK = 8e8
STRICT_ADVICE = "leave out --strict, so that other ways are tried"


def first_sound(ways: Iterable[Way], request: SmoothRequest) -> Result[SmoothStages, SmoothReport]:
    """Run ways until one loses nothing; return its result, or else the best one.

    Parameters
    ----------
    ways : iterable of Way
        The first is the requested one. The others are tried as long as work and memory allow; those with an option
        only if all others lose something, so that the message can name an option that helps.
    request : SmoothRequest

    Raises
    ------
    GeometryError
        If every way loses something, unless broken results are allowed. With `strict`, only the first way is tried,
        and a result in which anything broke, fused or vanished is refused.
    """
    first_work = total_cost = 0.0
    best: Attempt | None = None
    tried: list[str] = []
    failed: GeometryError | None = None
    all_ways = list(ways)
    taken = all_ways[0]
    for way in all_ways:
        if way.option is not None or (tried and (request.strict or (request.allow_broken and best is not None))):
            break
        total_cost += way.cost
        if way.cost > 1 and total_cost * first_work > MAX_WORK:
            break
        try:
            smooth_input = _input_of(way)
            first_work = first_work or estimate_work(smooth_input, way.request) / way.cost
            attempt = run_attempt(smooth_input, way.request)
        except GeometryError as error:
            failed = failed or error
        except (MemoryLimitError, ParameterError):
            if best is None and failed is None:
                raise
            break
        else:
            if best is None or attempt.rank < best.rank:
                best, taken = attempt, way
        tried.append(way.name)
        if best is not None and (best.is_sound or (best.differences.word != "lost" and len(tried) > 1)):
            break  # a difference in topology is worth one more run, a loss all of them
    remedies = [] if request.strict else [way for way in all_ways if way.option is not None]
    work_left = max(MAX_WORK - total_cost * first_work, first_work)  # as much as was asked for, at least
    if best is None:
        assert failed is not None
        remedy = STRICT_ADVICE if request.strict and len(all_ways) > 1 else _find_remedy(remedies, work_left)
        raise GeometryError(f"{failed}{_list_tried(tried[1:])}{'; ' + remedy if remedy else ''}") from failed
    result, differences = finish_attempt(best, tried, taken.name, _replaced_smoothing(all_ways[0], taken, best))
    reasons = differences.refused(strict=request.strict)
    if reasons and not request.allow_broken:
        advice = _advice(best) or _find_remedy(remedies, work_left)
        anyway = f"{advice}, or give --allow-broken" if advice else "give --allow-broken"
        raise GeometryError(f"{'; '.join(reasons)}{_list_tried(tried[1:])}; {anyway} to have it anyway")
    return result


def _replaced_smoothing(first: Way, taken: Way, best: Attempt) -> ReplacedSmoothing | None:
    """Return the smoothing that was asked for, if another was taken instead, for the report."""
    asked, used = first.request, taken.request
    if (asked.smoothing.steps, asked.radius) == (used.smoothing.steps, used.radius):
        return None
    cell = float(best.smoothed.smooth_input.data.cell_size.min())
    return {"steps": asked.for_cell(cell).smoothing.steps, "radius": asked.radius}


def _input_of(way: Way) -> SmoothInput:
    """Return the input of a way, on a grid."""
    if not isinstance(way.data, MeshOnGrid):
        return way.data
    return voxelise_input(way.data, way.request)


def _find_remedy(remedies: Iterable[Way], work_left: float) -> str | None:
    """Run ways that take an option until one loses nothing; return advice to give it, None if none helps.

    Parameters
    ----------
    remedies : iterable of Way
    work_left : float
        They are tried as long as they take less work than this, in cells at the surface times steps.
    """
    for remedy in remedies:
        try:
            way = remedy if remedy.later is None else remedy.later()
            smooth_input = _input_of(way)
            work_left -= estimate_work(smooth_input, way.request)
            if work_left < 0:
                return None
            if way.request.despeckle and not remove_specks(smooth_input.data, way.request)[1]:
                continue
            attempt = run_attempt(smooth_input, way.request)
            if attempt.differences.losses:
                continue
            _, differences = finish_attempt(attempt, [way.name], way.name)
        except (GeometryError, MemoryLimitError, ParameterError):
            continue
        if not differences.losses:
            specks = "1 speck" if attempt.specks == 1 else f"{attempt.specks:,} specks"
            return f"give {way.option}" + (f", which takes out {specks}" if attempt.specks else "")
    return None


def estimate_work(smooth_input: SmoothInput, request: SmoothRequest) -> float:
    """Estimate the work of a run before it begins: cells at the surface times steps."""
    steps = request.for_cell(float(smooth_input.data.cell_size.min())).total_steps
    return estimate_surface_cells(smooth_input.data) * (OTHER_STEPS + steps)


def _list_tried(ways: list[str]) -> str:
    """List the ways tried in vain, as the end of a phrase."""
    return f" (tried in vain: {'; '.join(ways)})" if ways else ""


def _advice(best: Attempt) -> str | None:
    """Return advice that is certain to help against a loss by simplification or by `strict`; None for others."""
    request = best.smoothed.request
    unsimplified = best.differences.refused(strict=request.strict)
    if not unsimplified and (request.tolerance is not None or request.max_triangles is not None):
        return advise_all_triangles(request)
    return STRICT_ADVICE if request.strict else None
