"""``infill smooth --dry-run``: the plan, and the expected time and memory."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from infill.cli.console import format_bytes, format_table, print_json, print_log
from infill.errors import InfillError
from infill.machine import available_memory
from infill.plain_numbers import plain_argument, plain_number, plain_size

if TYPE_CHECKING:
    from infill.reports.smoothing import PlannedInput, ReplacedSmoothing, SolidRequest
    from infill.smoothing.plan import SmoothPlan
    from infill.smoothing.request import SmoothOptions
    from infill.smoothing.settings import SmoothSettings

MINUTE, HOUR = 60, 3600  # seconds


def show_smooth_plan(
    source: Path, settings: SmoothSettings, options: SmoothOptions, files: Iterable[Path], *, as_json: bool, quiet: bool
) -> None:
    """Print the plan of smoothing a file or folder."""
    from infill.smoothing.plan import plan_smoothing
    from infill.smoothing.sources import name_labels, read_source, sample_source

    begin = time.perf_counter()
    with print_log(shown=not quiet), name_labels(source, **settings.reading):
        plan = None
        if settings.choice.get("voxel") is None and (sample := sample_source(source, **settings.reading)):
            with contextlib.suppress(InfillError):  # nothing solid in the sample, say: all slices decide
                plan = plan_smoothing(sample, begin=begin, **settings.choice, **options)
        if plan is None:
            plan = plan_smoothing(read_source(source, **settings.reading), begin=begin, **settings.choice, **options)
    names = [str(path) for path in files]
    if as_json:
        print_json({**plan.report(), "files": names})
    else:
        typer.echo(_plan_table(plan, names, str(source)))


def _plan_table(plan: SmoothPlan, files: list[str], name: str) -> str:
    """Return the plan as a table of text: grid, method, triangles, memory, time and files."""
    grid, request, facts = plan.grid, plan.request, plan.facts
    cells = " x ".join(map(str, grid.shape))
    fidelity = "" if request.refined else f", fidelity {plain_number(request.smoothing.fidelity, 6)}"
    free_memory = available_memory()
    share = f"{plan.solid / grid.cells:.1%} of {grid.cells:,}"
    about_word = "" if facts["source"] == "volume" and "sampled" not in facts else "about "
    rows = {
        "input": _source_text(facts),
        **(
            {"estimate": f"from {facts['sampled']} of {facts['of']} slices, as if the others were like them"}
            if "sampled" in facts
            else {}
        ),
        "grid": f"{cells} voxels of {plain_size(*grid.cell_size, digits=4)}",
        "solid": f"{about_word}{plan.solid:,.0f} voxels, {share}, {plain_size(plan.volume, digits=6, power=3)}",
        "method": f"{plan.ways[0]}: {format_steps(request.facts())}{fidelity}",
        "triangles": f"about {plan.triangles:,}, before it is simplified",
        "memory": f"about {format_bytes(plan.memory)}"
        + (
            f", and {format_bytes(free_memory)} is free"
            if free_memory is not None and free_memory < plan.memory
            else ""
        ),
        "time": f"about {format_span(plan.seconds)} on this machine, as busy as it is",
    }
    if plan.ways[1:]:
        flag = " (--resolution)" if facts["source"] == "mesh" else ""
        rows["if something is lost"] = f"it tries in turn: {'; '.join(plan.ways[1:])}{flag}"
    if files:
        rows["would write"] = ", ".join(files)
    return format_table(rows, title=f"{name}: nothing is written (--dry-run)")


def format_steps(request: SolidRequest) -> str:
    """Write how many steps a run takes, in the words of the plan and of the summary."""
    return f"{request['steps']} steps{', refined' if request['refine'] else ''}"


def format_replaced(asked: ReplacedSmoothing | None) -> str:
    """Describe the smoothing that was asked for, if another was taken instead."""
    if asked is None:
        return ""
    radius = "" if asked["radius"] is None else f" of --smooth-radius {plain_argument(asked['radius'])}"
    return f", instead of the {asked['steps']}{radius}, with which more changed"


def _source_text(facts: PlannedInput) -> str:
    """Describe the input, and the choice of its solid."""
    if facts["source"] == "points":
        return f"{facts['points']:,} points, " + (
            "the solid inside them"
            if facts["shell"] is None
            else f"a wall of {plain_size(facts['shell'], digits=6)} along them"
        )
    if facts["source"] == "mesh":
        return f"mesh of {facts['triangles']:,} triangles"
    segmentation = facts["segmentation"]
    bounds = [
        f"{word} {plain_number(value, 6)}"
        for word, value in (("from", segmentation.get("low")), ("up to", segmentation.get("high")))
        if value is not None
    ]
    choice = [f"label {', '.join(map(str, segmentation['label']))}"] if "label" in segmentation else bounds
    low, high = segmentation["values"]
    return " ".join(
        [
            f"volume of values from {plain_number(low, 6)} to {plain_number(high, 6)}, solid by",
            segmentation["method"],
            *choice,
        ]
    )


def format_span(seconds: float) -> str:
    """Format a time to two digits.

    >>> format_span(0.8432), format_span(37.2), format_span(412.0), format_span(47400.0)
    ('0.84 s', '37 s', '6.9 minutes', '13 hours')
    """
    if seconds < MINUTE:
        return f"{plain_number(seconds, 2)} s"
    if seconds < 2 * HOUR:
        return f"{plain_number(seconds / MINUTE, 2)} minutes"
    return f"{plain_number(seconds / HOUR, 2)} hours"
