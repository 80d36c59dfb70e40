"""The moves of a file, opened with the limits that it states and those that were given."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from infill.errors import UsageError
from infill.files.excerpts import quote_value
from infill.gcode.found_limits import FileLimits
from infill.gcode.given_limits import GivenLimits, parse_macros, read_printer
from infill.gcode.limit_names import parse_limits
from infill.gcode.limits import JUNCTION_DEVIATION, Limits
from infill.gcode.sliced_file import SlicedFile, SlicedText
from infill.planner.timeline import Timeline


@contextlib.contextmanager
def open_timeline(file: SlicedFile, plate: int | None, given: GivenLimits | None = None) -> Iterator[Timeline]:
    """Open the moves of a print, with the settings that its file has outside the text.

    Parameters
    ----------
    file : SlicedFile
    plate : int or None
        One of its `parts`.
    given : GivenLimits, optional
    """
    with file.text(plate) as sliced_text:
        yield make_timeline(sliced_text, given=given)


def make_timeline(
    sliced_text: SlicedText,
    text: BinaryIO | None = None,
    given: GivenLimits | None = None,
    found: FileLimits | None = None,
) -> Timeline:
    """Return the moves of a print, or of another text in its place, with its settings from outside the text.

    Parameters
    ----------
    sliced_text : SlicedText
    text : binary file, optional
    given : GivenLimits, optional
    found : FileLimits, optional
        The limits of the file, if already read.
    """
    metadata = {
        name.decode("utf-8", "replace"): value.decode("utf-8", "replace") for name, value in sliced_text.metadata
    }
    timeline = Timeline(text or sliced_text.text, given, {**sliced_text.settings, **metadata}, found)
    timeline.found = replace(timeline.found, slicer=timeline.found.slicer or sliced_text.slicer)
    return timeline


def collect_given(
    *,
    printer: object = None,
    limits: object = None,
    macros: object = None,
    **fixed: Any,  # noqa: ANN401
) -> GivenLimits:
    """Collect what the arguments of `motion` say of the printer; read its file.

    Parameters
    ----------
    printer : path, optional
        printer.cfg, an answer of Moonraker or of M503.
    limits : mapping, str or sequence of str, optional
        Limits of the printer by name: see `infill.gcode.limit_names.parse_limits`.
    macros : mapping, str or sequence of str, optional
        Times of macros: see `infill.gcode.given_limits.parse_macros`.
    **fixed
        Limits for the entire file: see `collect_limits`.

    Raises
    ------
    ParameterError
        If a name is unknown, or a value is not a possible limit or time.
    FormatError
        If the file of the printer cannot be read.
    """
    values = {} if limits is None else parse_limits("limits", limits)
    seconds = {} if macros is None else parse_macros("macros", macros)
    if printer is not None and not isinstance(printer, str | os.PathLike):
        raise UsageError.about("printer", f"is {quote_value(printer)}; give the name of a file, such as printer.cfg")
    return GivenLimits(
        fixed=collect_limits(**fixed),
        printer=None if printer is None else read_printer(Path(printer), values),
        values=values,
        macro_seconds=seconds,
    )


def collect_limits(**given: Any) -> dict[str, Any]:  # noqa: ANN401
    """Collect the fields of `Limits` that the arguments of `motion` set for the entire file.

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
