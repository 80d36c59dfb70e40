"""``infill smooth --dry-run``: what would be done, and what it would take."""

from __future__ import annotations

import time
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from infill.cli.console import as_bytes, log_said, print_json, table
from infill.machine import available_memory

if TYPE_CHECKING:
    from infill.smoothing.plan import Plan
    from infill.smoothing.request import Options
    from infill.smoothing.settings import SmoothSettings

MINUTE = 60  # seconds; longer times are told in minutes


def foresee(
    source: Path, settings: SmoothSettings, options: Options, files: Iterable[Path], *, as_json: bool, quiet: bool
) -> None:
    """Print what would be done with a file or folder."""
    from infill.smoothing.plan import planned
    from infill.smoothing.sources import read_source

    begin = time.perf_counter()
    with log_said(shown=not quiet):
        plan = planned(read_source(source, **settings.reading), begin=begin, **settings.choice, **options)
    names = [str(path) for path in files]
    if as_json:
        print_json({**plan.report(), "files": names})
    else:
        typer.echo(_described(plan, names, str(source)))


def _described(plan: Plan, files: list[str], name: str) -> str:
    grid, request, facts = plan.grid, plan.request, plan.facts
    cells = " x ".join(map(str, grid.shape))
    how = "" if request.refined else f", fidelity {request.smoothing.fidelity:g}"
    free = available_memory()
    share = f"{plan.solid / grid.cells:.1%} of {grid.cells:,}"
    about = "" if facts["source"] == "volume" else "about "
    rows = {
        "input": _source(facts),
        "grid": f"{cells} voxels of {' x '.join(f'{side:.4g}' for side in grid.cell_size)} mm",
        "solid": f"{about}{plan.solid:,.0f} voxels, {share}, {plan.volume:.6g} mm³",
        "method": f"{plan.ways[0]}: {request.smoothing.steps} steps{how}",
        "triangles": f"about {plan.triangles:,}, before it is simplified",
        "memory": f"about {as_bytes(plan.memory)}"
        + (f", and {as_bytes(free)} is free" if free is not None and free < plan.memory else ""),
        "time": f"about {_span(plan.seconds)} on this machine, as busy as it is",
    }
    if plan.ways[1:]:
        rows["if something is lost"] = f"it tries in turn: {'; '.join(plan.ways[1:])}"
    if files:
        rows["would write"] = ", ".join(files)
    return table(rows, title=f"{name}: nothing is written (--dry-run)")


def _source(facts: Any) -> str:  # noqa: ANN401 - the section `input` of a report
    """Return what was read, and how it is decided what is solid."""
    if facts["source"] == "points":
        return f"{facts['points']:,} points, " + (
            "the solid inside them" if facts["shell"] is None else f"a wall of {facts['shell']:g} mm along them"
        )
    if facts["source"] == "mesh":
        return f"mesh of {facts['triangles']:,} triangles"
    used = facts["segmentation"]
    ends = [f"{word} {used[key]:g}" for word, key in (("from", "low"), ("up to", "high")) if used.get(key) is not None]
    chosen = [f"label {', '.join(map(str, used['label']))}"] if "label" in used else ends
    low, high = used["values"]
    return " ".join([f"volume of values from {low:g} to {high:g}, solid by", used["method"], *chosen])


def _span(seconds: float) -> str:
    """Return a time to two digits.

    >>> _span(0.8432), _span(37.2), _span(412.0)
    ('0.84 s', '37 s', '6.9 minutes')
    """
    return f"{seconds:.2g} s" if seconds < MINUTE else f"{seconds / MINUTE:.2g} minutes"
