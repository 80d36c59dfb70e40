"""What a sliced file says of its slicer: settings, name, units of filament, limits of the machine, and its estimate."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, Final

from infill.gcode.limits import JERK_MODELS, Axes, Limits, is_valid_limit
from infill.gcode.machine_state import DIAMETER, MAX_TOOLS

_SETTING: Final = re.compile(rb"^; ?([a-z_0-9 ()]+?) = ([^\r\n]*)", re.MULTILINE)
_TIMES: Final = (  # Cura's engine counts up; its header is a placeholder until the program around it fills it
    re.compile(rb"^;TIME_ELAPSED:(\d+(?:\.\d+)?)", re.MULTILINE),
    re.compile(rb"^;TIME:(\d+(?:\.\d+)?)", re.MULTILINE),
)
_TOTAL: Final = re.compile(rb"total estimated time: ([0-9dhms ]+)")
_SLICER: Final = re.compile(
    rb"^; ?(?:generated (?:by|with)|Generated with)?[ :]*(\w+(?:Slicer|Studio|SteamEngine)) ?v?([\d.]+\S*)",
    re.MULTILINE,
)
_FLAVOUR: Final = re.compile(rb"^;FLAVOR:([^\r\n]*)", re.MULTILINE)
_VOLUMETRIC: Final = {
    b"ultigcode",
    b"marlin(volumetric)",
    b"marlin (volumetric)",
    b"reprap (volumetric)",
    b"reprap(volumetric)",
}
_UNIT_OF_TIME: Final = {"d": 86400, "h": 3600, "m": 60, "s": 1}


def read_settings(*texts: bytes) -> dict[str, str]:
    """Read the settings that stand in texts of a file as comments ``; name = value``; later ones count."""
    return {name.decode(): value.decode("latin-1").strip() for text in texts for name, value in _SETTING.findall(text)}


def find_slicer(head: bytes) -> str:
    """Return the name and version of the slicer, "" if the beginning of the file does not state it."""
    named = _SLICER.search(head)
    return b" ".join(named.groups()).decode("latin-1") if named else ""


def filament_units(head: bytes, settings: Mapping[str, str]) -> tuple[bool, tuple[float, ...]]:
    """Return True if E counts mm³ before any command, and the diameters of the filaments by tool, mm.

    Parameters
    ----------
    head : bytes
        The beginning of the file: Cura names its flavour there, and two of them count mm³.
    settings : mapping
        Of the slicer.

    >>> filament_units(b";FLAVOR:UltiGCode", {}), filament_units(b"", {"filament_diameter": "2.85,1.75"})
    ((True, (1.75,)), (False, (2.85, 1.75)))
    """
    flavour = _FLAVOUR.search(head)
    volumetric = flavour is not None and flavour[1].strip().lower() in _VOLUMETRIC
    if "use_volumetric_e" in settings:
        volumetric = settings["use_volumetric_e"].strip() not in ("0", "", "nil", "false")
    numbers = [
        _first_number(text) or DIAMETER for text in settings.get("filament_diameter", "").replace(";", ",").split(",")
    ]
    return volumetric, tuple(numbers[:MAX_TOOLS])


def extrusion_rule(head: bytes, settings: Mapping[str, str]) -> str:
    """Return klipper or reprapfirmware if its own rule makes E relative, else "": see `MachineState.firmware`.

    >>> extrusion_rule(b"", {"gcode_flavor": "klipper"}), extrusion_rule(b"", {"gcode_flavor": "marlin2"})
    ('klipper', '')
    """
    flavour = settings.get("gcode_flavor", "")
    if flavour == "klipper" or b"SET_VELOCITY_LIMIT" in head.upper():
        return "klipper"
    return "reprapfirmware" if flavour == "reprapfirmware" else ""


def parse_limits_of_settings(settings: Mapping[str, str], start: Limits) -> dict[str, Any]:
    """Return the fields of `Limits` that a block of settings states."""
    stated: dict[str, Any] = {}
    for field, prefixes in {
        "feedrate": ("machine_max_feedrate", "machine_max_speed"),
        "axis_acceleration": ("machine_max_acceleration",),
        "jerk": ("machine_max_jerk",),
    }.items():
        values = [
            next(
                (
                    _first_limit(settings.get(f"{prefix}_{axis}"), field)
                    for prefix in prefixes
                    if f"{prefix}_{axis}" in settings
                ),
                None,
            )
            for axis in "xyze"
        ]
        if any(values):
            before: Axes = getattr(start, field)
            stated[field] = tuple(value or old for value, old in zip(values, before, strict=True))
    for field, name in {
        "acceleration": "machine_max_acceleration_extruding",
        "travel_acceleration": "machine_max_acceleration_travel",
        "retract_acceleration": "machine_max_acceleration_retracting",
        "junction_deviation": "machine_max_junction_deviation",
        "minimum_feedrate": "machine_min_extruding_rate",
        "minimum_travel_feedrate": "machine_min_travel_rate",
    }.items():
        value = _first_limit(settings.get(name), field)
        if value:
            stated[field] = value
            if field.endswith("acceleration") and start.model != "klipper":
                stated[f"highest_{field}"] = value
    if settings.get("gcode_flavor") == "marlin" and "acceleration" in stated:  # before 2.0 it has none of travel
        stated["travel_acceleration"] = stated["highest_travel_acceleration"] = stated["acceleration"]
    if "junction_deviation" in stated and start.model in JERK_MODELS:
        stated["model"] = "junction"
    return stated


def _first_number(text: str | None) -> float | None:
    """Return the first number of a list; None if it is missing, unreadable, negative or infinite."""
    try:
        number = float((text or "").split(",")[0])
    except ValueError:
        return None
    return number if 0 <= number < math.inf else None


def _first_limit(text: str | None, field: str) -> float | None:
    """Return the first number of a list, or None if no machine has that limit."""
    number = _first_number(text)
    return None if number is None or not is_valid_limit(number, field) else number


def slicer_estimate(settings: Mapping[str, str], head: bytes, tail: bytes) -> float | None:
    """Return the slicer's own estimate in the file, s."""
    total = _TOTAL.search(head)
    text = settings.get("estimated printing time (normal mode)", total[1].decode() if total else "")
    parts = re.findall(r"(\d+)\s*([dhms])", text)
    if parts:
        return float(sum(int(number) * _UNIT_OF_TIME[unit] for number, unit in parts))
    times = next((times for pattern in _TIMES if (times := pattern.findall(head + tail))), None)
    return float(times[-1]) if times else None
