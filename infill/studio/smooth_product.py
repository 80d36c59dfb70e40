"""Smoothing in the studio: one call of `infill.smooth_mesh` or `infill.smooth_volume`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.options.declaration import by_field, read_options
from infill.smoothing.settings import SmoothSettings, resolve
from infill.studio.changed_places import list_places
from infill.studio.equivalents import Call, join_words, write_command, write_value
from infill.studio.numbers import smooth_draft_numbers, smooth_numbers
from infill.studio.products import Made, Order
from infill.studio.scan_pieces import list_pieces
from infill.studio.smoothing_keywords import shared_keywords
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.volume import Volume

DECLARATION = SmoothSettings
LEFT_OUT: tuple[str, ...] = (
    "as",
    "units",
    "array",
    "series",
    "frame",
    "spacing",
    "roi",
    "each_label",
    "labels",
    "keep_going",
    "together",
    "shell",
    "by_component",
)
CHOICE = ("resolution", "voxel", "threshold", "between", "label", "otsu", "grey", "keep_components")
JUDGEMENTS = ("verdict", "problems")
COARSE_CELLS = 72  # along the longest side
MOST_BEFORE = 1_500_000  # triangles of the surface of voxels that is shown beside the result


def make(order: Order) -> Made:
    """Smooth a part or a scan; coarsely, in larger voxels."""
    from infill.smoothing.sources import smooth_source

    content, options = order.need("part", "scan"), dict(order.options)
    if order.coarse:
        options |= coarse_options(content.data, options)
    settings = resolve(options)
    means: Any = {**settings.options, "max_memory": order.memory, "progress": order.progress}
    result: Any = smooth_source(content.data, **settings.choice, **means)
    surfaces = {"solid": result.surface}
    if content.kind == "scan" and not order.coarse:
        before = result.stages.staircase()
        if len(before.faces) <= MOST_BEFORE:
            surfaces["voxels"] = before
    # What larger voxels lose says nothing about the exact result.
    hidden = JUDGEMENTS if order.coarse else ()
    report = {name: value for name, value in result.report.items() if name not in hidden}
    numbers = smooth_draft_numbers(report) if order.coarse else smooth_numbers(report)
    return Made(
        result=result,
        report=report,
        numbers=list(numbers),
        surfaces=surfaces,
        volume=result.report["volume"],
        more={"pieces": list_pieces(content, settings.choice), "places": list_places(result.report)},
    )


def coarse_options(data: Surface | Volume, options: dict[str, Any]) -> dict[str, Any]:
    """Return options for a quick look: larger voxels, no simplification, and whatever comes of it."""
    quick: dict[str, Any] = {"tolerance": 0.0, "allow_broken": True, "smooth": "plain"}
    if isinstance(data, Surface):
        if "voxel" not in options and int(options.get("resolution", COARSE_CELLS)) >= COARSE_CELLS:
            quick["resolution"] = COARSE_CELLS
        return quick
    longest = float((np.array(data.values.shape) * data.cell_size).max())
    voxel = longest / COARSE_CELLS
    if voxel > 1.5 * float(data.cell_size.max()):
        quick["voxel"] = max(voxel, float(options.get("voxel") or 0.0))
    return quick


def write(made: Made, path: Path) -> None:
    """Write the file of a smoothed solid."""
    made.result.save(path)


def again(order: Order, file: str) -> dict[str, str]:
    """Return the command, the Python and the TOML that make the file of a smoothed solid again."""
    content, options = order.need("part", "scan"), dict(order.options)
    values = by_field(SmoothSettings, read_options("smooth", SmoothSettings, options))
    choice = {name: values.pop(name) for name in CHOICE if name in values}
    between = choice.pop("between", None)
    if between is not None:
        choice["threshold"] = between
    if choice.pop("otsu", False):
        choice["threshold"] = "otsu"
    keywords = {**choice, **shared_keywords(values)}
    call = Call(
        function="smooth_mesh" if content.kind == "part" else "smooth_volume",
        positional=(content.path,),
        keywords=keywords,
        imports=("Smoothing",) if "smoothing" in keywords else (),
        save=f"result.save({write_value(file)})",
    )
    words = write_command("smooth", [content.path], SmoothSettings, options, {})
    return {
        "command": join_words([*words, "-o", file]),
        "python": call.to_python(),
        "toml": resolve(options).to_toml(),
    }
