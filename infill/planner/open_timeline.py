"""The moves of a file, opened with the limits that it states and those that were given."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, BinaryIO

from infill.errors import UsageError
from infill.gcode.found_limits import FileLimits
from infill.gcode.limits import JUNCTION_DEVIATION, Limits
from infill.gcode.sliced_file import SlicedFile, SlicedText
from infill.planner.timeline import Timeline


@contextlib.contextmanager
def open_timeline(file: SlicedFile, plate: int | None, fixed: Mapping[str, Any]) -> Iterator[Timeline]:
    """Open the moves of a print, with the settings that its file has outside the text.

    Parameters
    ----------
    file : SlicedFile
    plate : int or None
        One of its `parts`.
    fixed : mapping
        As `collect_limits` returns it.
    """
    with file.text(plate) as sliced_text:
        yield make_timeline(sliced_text, fixed=fixed)


def make_timeline(
    sliced_text: SlicedText,
    text: BinaryIO | None = None,
    fixed: Mapping[str, Any] | None = None,
    found: FileLimits | None = None,
) -> Timeline:
    """Return the moves of a print, or of another text in its place, with its settings from outside the text.

    Parameters
    ----------
    sliced_text : SlicedText
    text : binary file, optional
    fixed : mapping, optional
        As `collect_limits` returns it.
    found : FileLimits, optional
        The limits of the file, if already read.
    """
    metadata = {
        name.decode("utf-8", "replace"): value.decode("utf-8", "replace") for name, value in sliced_text.metadata
    }
    timeline = Timeline(text or sliced_text.text, fixed, {**sliced_text.settings, **metadata}, found)
    timeline.found = replace(timeline.found, slicer=timeline.found.slicer or sliced_text.slicer)
    return timeline


def collect_limits(**given: Any) -> dict[str, Any]:  # noqa: ANN401
    """Collect the fields of `Limits` that the arguments of `motion` set.

    >>> collect_limits(square_corner_velocity=8)
    {'square_corner_velocity': 8, 'model': 'klipper'}
    """
    fixed = {name: value for name, value in given.items() if value is not None}
    means = {"square_corner_velocity": "klipper", "minimum_cruise_ratio": "klipper", "junction_deviation": "junction"}
    means["jerk"] = "jerk"
    if fixed.get("model") == JUNCTION_DEVIATION:
        fixed["model"] = "junction"
    meant = {model for name, model in means.items() if name in fixed}
    if "model" not in fixed and len(meant) > 1:
        names = tuple(name for name in means if name in fixed)
        raise UsageError.about(names, f"belong to {len(meant)} models, {', '.join(sorted(meant))}; give model")
    if "model" not in fixed and meant - {"jerk"}:  # two models have jerk: the file decides
        fixed["model"] = meant.pop()
    if "acceleration" in fixed:
        fixed["travel_acceleration"] = fixed["acceleration"]
    if "jerk" in fixed:
        still = Limits().jerk
        fixed["jerk"] = (fixed["jerk"], fixed["jerk"], *still[2:])
    return fixed
