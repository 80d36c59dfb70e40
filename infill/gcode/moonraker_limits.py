"""Answers of Moonraker, Klipper's host on the network, saved as JSON: the objects configfile and toolhead."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from infill.errors import FormatError
from infill.files.excerpts import quote_value
from infill.gcode.klipper_config import Sections, klipper_limits
from infill.gcode.printer_limits import PrinterLimits

QUERY: Final = "/printer/objects/query?configfile&toolhead"
_IN_FORCE: Final = (  # of toolhead, in the words of printer.cfg
    "max_velocity",
    "max_accel",
    "minimum_cruise_ratio",
    "max_accel_to_decel",
    "square_corner_velocity",
)


def read_moonraker(path: Path, text: str, given: Mapping[str, float]) -> PrinterLimits:
    """Read the limits of a printer from an answer of Moonraker.

    What is in force (toolhead) wins over what is configured (configfile).

    Parameters
    ----------
    path : Path
        For messages.
    text : str
    given : mapping
        Limits by the names of `infill.gcode.limit_names.LIMIT_NAMES`, which take the place of those in the answer.

    Raises
    ------
    FormatError
        If it is not JSON, has neither object, or a limit is missing or impossible.
    """
    try:
        answer = json.loads(text)
    except (ValueError, RecursionError):
        raise FormatError(f"{path} is not complete JSON; save the answer to {QUERY} again") from None
    if isinstance(answer, dict) and isinstance(answer.get("error"), dict):
        message = quote_value(answer["error"].get("message", ""))
        raise FormatError(f"{path} is an error of Moonraker, {message}; save the answer to {QUERY}")
    objects = answer
    for layer in ("result", "status"):
        objects = objects.get(layer, objects) if isinstance(objects, dict) else objects
    if not isinstance(objects, dict):
        objects = {}
    configfile = objects.get("configfile")
    written = _sections_of(configfile, "config")
    sections = _sections_of(configfile, "config", "settings")
    toolhead = objects.get("toolhead")
    if isinstance(toolhead, dict):
        in_force = {name: toolhead[name] for name in _IN_FORCE if toolhead.get(name) is not None}
        printer = sections.setdefault("printer", {})
        if {"minimum_cruise_ratio", "max_accel_to_decel"} & set(in_force):
            printer.pop("minimum_cruise_ratio", None)
            printer.pop("max_accel_to_decel", None)
        printer.update(in_force)
    if not sections.get("printer"):
        raise FormatError(
            f"{path} has neither the object configfile nor toolhead of a printer; save the answer to {QUERY}"
        )
    return klipper_limits(sections, str(path), given, written if "printer" in written else None)


def _sections_of(configfile: Any, *parts: str) -> Sections:  # noqa: ANN401 - of JSON
    """Return the sections of the object configfile: as written (config), or as understood, with defaults (settings)."""
    sections: Sections = {}
    for part in parts:
        written = configfile.get(part) if isinstance(configfile, dict) else None
        for name, options in written.items() if isinstance(written, dict) else ():
            if isinstance(options, dict):
                section = sections.setdefault(name.lower(), {})
                section.update({str(option).lower(): value for option, value in options.items()})
    return sections
