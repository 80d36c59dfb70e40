"""Try one way to smooth after another until nothing real is lost, before a result is refused.

Each way is a whole run. The first result that is sound is taken; if none is, the best of them. Whether a way is tried
depends on the input and the options alone, never on a clock: the same input gives the same surface on any machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from infill.errors import GeometryError, MemoryLimitError, ParameterError
from infill.smoothing.attempt import Attempt, estimate_surface_cells, finish_attempt, run_attempt
from infill.smoothing.meshes import voxelise_input
from infill.smoothing.request import MeshOnGrid, SmoothInput, SmoothRequest, Way

if TYPE_CHECKING:
    from infill.reports.smoothing import SmoothReport
    from infill.result import Result
    from infill.smoothing.stages import SmoothStages

# Work is counted in steps over cells at the surface. Finding the level, comparing and measuring take as long as 100
# steps: of 42 meshes and scans, a unit took 0.06 to 0.18 µs of one core, and up to 0.36 where components overlap.
OTHER_STEPS = 100
# A way that takes more work than the first is skipped if all ways together would take more than this, about 100 s of
# one core. With the usual 20 steps, refined, that leaves the three finer grids to meshes of up to 190,000 cells at the
# surface, two of them up to 510,000, and one up to 1,300,000; all 42 take the ways that they took within 100 s.
MAX_WORK = 8e8


def first_sound(ways: Iterable[Way], request: SmoothRequest) -> Result[SmoothStages, SmoothReport]:
    """Run ways until one loses nothing; return its result, or else the best one.

    Parameters
    ----------
    ways : iterable of Way
        The first is the requested one. The others are tried as long as work and memory allow.
    request : SmoothRequest

    Raises
    ------
    GeometryError
        If every way loses something, unless broken results are allowed. With `strict`, only the first way is tried,
        and a result in which anything broke, fused or vanished is refused.
    """
    first_work = total_cost = 0.0
    best: Attempt | None = None
    best_name = ""
    tried: list[str] = []
    failed: GeometryError | None = None
    for way in ways:
        if tried and (request.strict or (request.allow_broken and best is not None)):
            break
        total_cost += way.cost
        if way.cost > 1 and total_cost * first_work > MAX_WORK:
            break
        try:
            smooth_input = voxelise_input(way.data, way.request) if isinstance(way.data, MeshOnGrid) else way.data
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
                best, best_name = attempt, way.name
        tried.append(way.name)
        if best is not None and (best.is_sound or (best.differences.word != "lost" and len(tried) > 1)):
            break  # a difference in topology is worth one more run, a loss all of them
    if best is None:
        assert failed is not None
        raise GeometryError(f"{failed}{_list_tried(tried[1:])}") from failed
    result, differences = finish_attempt(best, tried, best_name)
    reasons = differences.losses if not request.strict else (*differences.losses, *differences.problems)
    if reasons and not request.allow_broken:
        raise GeometryError(f"{'; '.join(reasons)}{_list_tried(tried[1:])}; {_advice(best)}")
    return result


def estimate_work(smooth_input: SmoothInput, request: SmoothRequest) -> float:
    """Estimate the work of a run before it begins: cells at the surface times steps."""
    steps = request.at(float(smooth_input.data.cell_size.min())).total_steps
    return estimate_surface_cells(smooth_input.data) * (OTHER_STEPS + steps)


def _list_tried(ways: list[str]) -> str:
    """List the ways tried in vain, as the end of a phrase."""
    return f" (tried in vain: {', '.join(ways)})" if ways else ""


def _advice(best: Attempt) -> str:
    """Return advice on a loss: about simplification if only that caused it."""
    request = best.smoothed.request
    if not best.differences.losses and (request.tolerance is not None or request.max_triangles is not None):
        return "give a smaller --tolerance or more --max-triangles, or --allow-broken to have it anyway"
    if request.strict:
        return "leave out --strict, so that remedies are tried, or give finer voxels or fewer steps"
    return "give finer voxels or fewer steps, or --allow-broken to have it anyway"
