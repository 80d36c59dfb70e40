"""What is tried before a result is refused: the next way to smooth, until nothing real is lost.

Each remedy is a whole run. The first result that is sound is taken; if none is, the best of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from infill.errors import GeometryError, MemoryLimitError, ParameterError
from infill.phasefield.schedule import FEWEST
from infill.sections import Sections
from infill.smoothing.attempt import Attempt, attempted, delivered

if TYPE_CHECKING:
    from infill.result import Result
    from infill.smoothing.request import Given, Request
    from infill.smoothing.stages import SmoothStages

# Seconds of all cores together: nothing that takes longer than the first way is begun if it would end later than this.
# Not seconds on the clock: what is tried must not depend on what else the machine does.
PATIENCE = 100.0


@dataclass(frozen=True, kw_only=True)
class Way:
    """A way to smooth.

    Parameters
    ----------
    name : str
        What it does, for the report: "refined".
    make : callable
        Returns the data and the request.
    cost : float
        How long it takes, relative to the first way.
    """

    name: str
    make: Callable[[], tuple[Given, Request]]
    cost: float = 1.0


def best_of(ways: Iterable[Way], request: Request) -> Result[SmoothStages]:
    """Return the result of the first way that loses nothing, or else of the best.

    Parameters
    ----------
    ways : iterable of Way
        The first is the one that was asked for. The others are tried as long as there is time and memory.
    request : Request

    Raises
    ------
    GeometryError
        If something was lost whatever was tried, unless broken results are allowed. With `strict`, only the first way
        is tried, and whatever broke, fused or vanished is refused.
    """
    begin, first = time.process_time(), 0.0
    best: Attempt | None = None
    taken = ""
    tried: list[str] = []
    failed: GeometryError | None = None
    for way in ways:
        if tried and (request.strict or (request.allow_broken and best is not None)):
            break
        if way.cost > 1 and time.process_time() - begin + way.cost * first > PATIENCE:
            break
        try:
            found = attempted(*way.make())
        except GeometryError as error:
            failed = failed or error
        except (MemoryLimitError, ParameterError):
            if best is None and failed is None:
                raise
            break
        else:
            if best is None or found.rank < best.rank:
                best, taken = found, way.name
        tried.append(way.name)
        first = first or time.process_time() - begin
        if best is not None and (best.sound or (best.told.word != "lost" and len(tried) > 1)):
            break  # what is connected differently is worth one more run, what is lost all of them
    if best is None:
        assert failed is not None
        raise GeometryError(f"{failed}{_after(tried[1:])}") from failed
    result, told = delivered(best)
    refused = told.losses if not request.strict else (*told.losses, *told.problems)
    if refused and not request.allow_broken:
        raise GeometryError(f"{'; '.join(refused)}{_after(tried[1:])}; {_advice(best)}")
    verdict = {**result.report["verdict"], "tried": tried, "taken": taken}
    return replace(result, report=Sections(result.report).replaced(verdict=verdict))


def _after(others: list[str]) -> str:
    """Return what was tried in vain, as the end of a phrase."""
    return f" (tried in vain: {', '.join(others)})" if others else ""


def _advice(best: Attempt) -> str:
    """Return what to do about what is lost; simplification comes after all that was tried."""
    request = best.request
    if not best.told.losses and (request.tolerance is not None or request.max_triangles is not None):
        return "give a smaller --tolerance or more --max-triangles, or --allow-broken to have it anyway"
    if request.strict:
        return "leave out --strict, so that remedies are tried, or give finer voxels or fewer steps"
    return "give finer voxels or fewer steps, or --allow-broken to have it anyway"


def fewer_steps(request: Request) -> list[int]:
    """Return the numbers of steps to try when those asked for lose something."""
    steps, found = request.smoothing.steps, []
    while steps > FEWEST:
        steps = max(FEWEST, steps // 2)
        found.append(steps)
    return found
