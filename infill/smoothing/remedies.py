"""Try one strategy after another until nothing real is lost, before a result is refused.

Each remedy is a whole run. The first result that is sound is taken; if none is, the best of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

from infill.errors import GeometryError, MemoryLimitError, ParameterError
from infill.phasefield.schedule import MIN_STEPS
from infill.sections import Sections
from infill.smoothing.attempt import Attempt, finish_attempt, run_attempt

if TYPE_CHECKING:
    from infill.report_keys import SmoothReport, VerdictKeys
    from infill.result import Result
    from infill.smoothing.request import SmoothInput, SmoothRequest
    from infill.smoothing.stages import SmoothStages

# Seconds of all cores together: a strategy that takes longer than the first is skipped if it would end later than this.
# CPU time, not wall time: the choice must not depend on the load of the machine.
MAX_CPU_SECONDS = 100.0


@dataclass(frozen=True, kw_only=True)
class Strategy:
    """One strategy of smoothing.

    Parameters
    ----------
    name : str
        Its name in the report, such as "refined".
    make : callable
        Returns the data and the request.
    cost : float
        Its time, relative to the first strategy.
    """

    name: str
    make: Callable[[], tuple[SmoothInput, SmoothRequest]]
    cost: float = 1.0


def first_sound(ways: Iterable[Strategy], request: SmoothRequest) -> Result[SmoothStages, SmoothReport]:
    """Run strategies until one loses nothing; return its result, or else the best one.

    Parameters
    ----------
    ways : iterable of Strategy
        The first is the requested one. The others are tried as long as there is time and memory.
    request : SmoothRequest

    Raises
    ------
    GeometryError
        If every strategy loses something, unless broken results are allowed. With `strict`, only the first strategy
        is tried, and a result in which anything broke, fused or vanished is refused.
    """
    begin, first_seconds = time.process_time(), 0.0
    best: Attempt | None = None
    best_name = ""
    tried: list[str] = []
    failed: GeometryError | None = None
    for way in ways:
        if tried and (request.strict or (request.allow_broken and best is not None)):
            break
        if way.cost > 1 and time.process_time() - begin + way.cost * first_seconds > MAX_CPU_SECONDS:
            break
        try:
            attempt = run_attempt(*way.make())
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
        first_seconds = first_seconds or time.process_time() - begin
        if best is not None and (best.sound or (best.told.word != "lost" and len(tried) > 1)):
            break  # a difference in topology is worth one more run, a loss all of them
    if best is None:
        assert failed is not None
        raise GeometryError(f"{failed}{_list_tried(tried[1:])}") from failed
    result, verdict_words = finish_attempt(best)
    reasons = verdict_words.losses if not request.strict else (*verdict_words.losses, *verdict_words.problems)
    if reasons and not request.allow_broken:
        raise GeometryError(f"{'; '.join(reasons)}{_list_tried(tried[1:])}; {_advice(best)}")
    verdict: VerdictKeys = {**result.report["verdict"], "tried": tried, "taken": best_name}
    report = Sections(result.report).replaced(verdict=verdict)
    return replace(result, report=cast("SmoothReport", report))


def _list_tried(strategies: list[str]) -> str:
    """List the strategies tried in vain, as the end of a phrase."""
    return f" (tried in vain: {', '.join(strategies)})" if strategies else ""


def _advice(best: Attempt) -> str:
    """Return advice on a loss: about simplification if only that caused it."""
    request = best.request
    if not best.told.losses and (request.tolerance is not None or request.max_triangles is not None):
        return "give a smaller --tolerance or more --max-triangles, or --allow-broken to have it anyway"
    if request.strict:
        return "leave out --strict, so that remedies are tried, or give finer voxels or fewer steps"
    return "give finer voxels or fewer steps, or --allow-broken to have it anyway"


def fewer_steps(request: SmoothRequest) -> list[int]:
    """Return the smaller numbers of steps to try if the requested number loses something."""
    steps, counts = request.smoothing.steps, []
    while steps > MIN_STEPS:
        steps = max(MIN_STEPS, steps // 2)
        counts.append(steps)
    return counts
