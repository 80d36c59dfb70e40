"""Limits of the machine that a file was sliced for, as far as the file states them, and the source of each.

PrusaSlicer, SuperSlicer, OrcaSlicer and Bambu Studio write their settings as comments ``; name = value``, at the end or
at the top; the first value of a list is that of the normal mode. Commands (M201 to M205, M566, SET_VELOCITY_LIMIT) then
change them on the way. Cura states only its name; its own estimates use the defaults of its machine definitions.
Limits that the printer itself states take the place of all of these but the commands.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from dataclasses import field as dataclass_field
from typing import Any, Final

from infill.files.excerpts import excerpt
from infill.gcode.ending import find_missing_end
from infill.gcode.given_limits import GivenLimits
from infill.gcode.limit_names import changed_fields, is_used, model_of_limits, set_limits
from infill.gcode.limits import (
    JERK_MODELS,
    JUNCTION_DEVIATION,
    NOT_LIMITING,
    Axes,
    Limits,
    Model,
    apply_command,
    is_valid_limit,
)
from infill.gcode.machine_state import DIAMETER, MAX_TOOLS
from infill.gcode.printer_limits import LimitMacro, LimitNote

KLIPPER: Final = Limits(model="klipper", feedrate=(300.0, 300.0, 5.0, 50.0))
MARLIN: Final = Limits()  # its factory settings
SMOOTHIE: Final = Limits(model="junction", junction_deviation=0.05)
CURA: Final = Limits(  # of its definition fdmprinter, which its own estimate uses
    model="vector-jerk",
    feedrate=(1e6, 1e6, 1e6, 1e6),
    axis_acceleration=(9000.0, 9000.0, 100.0, 10000.0),
    jerk=(20.0, 20.0, 0.4, 5.0),
    acceleration=4000.0,
    travel_acceleration=4000.0,
    retract_acceleration=4000.0,
)
# Fields that each model works with; the others are not reported.
FIELDS_BY_MODEL: Final[dict[str, tuple[str, ...]]] = {
    "jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "vector-jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "junction": ("feedrate", "axis_acceleration", "acceleration", "junction_deviation"),
    "klipper": (
        *("feedrate", "axis_acceleration", "acceleration"),
        *("square_corner_velocity", "minimum_cruise_ratio", "corner_extrusion_velocity"),
    ),
}
# Fields that belong to some of the models only.
_OF_ONE_MODEL: Final[dict[str, str]] = {
    "jerk": "jerk vector-jerk",
    "junction_deviation": "junction",
    "square_corner_velocity": "klipper",
    "minimum_cruise_ratio": "klipper",
    "corner_extrusion_velocity": "klipper",
}
_SETS: Final[dict[str, tuple[str, ...]]] = {
    "M201": ("axis_acceleration",),
    "M203": ("feedrate",),
    "M204": ("acceleration",),
    "M566": ("jerk",),
}
_SAYS: Final = {
    "jerk": re.compile(rb"M205\b[^;]*[XYZE]"),
    "junction_deviation": re.compile(rb"M205\b[^;]*J"),
    "feedrate": re.compile(rb" VELOCITY\s*="),
    "acceleration": re.compile(rb"ACCEL\s*="),
    "square_corner_velocity": re.compile(rb"SQUARE_CORNER_VELOCITY\s*="),
    "minimum_cruise_ratio": re.compile(rb"MINIMUM_CRUISE_RATIO\s*=|ACCEL_TO_DECEL\s*="),
}
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
# Commands of RepRapFirmware alone, and feed rates that no machine reaches in mm/s.
_BY_MINUTE: Final = re.compile(rb"^(?:M566\b|M203\b[^;\n]*[XY]\s*[3-9]\d{3}|M203\b[^;\n]*[XY]\s*\d{5})", re.MULTILINE)
_UNIT_OF_TIME: Final = {"d": 86400, "h": 3600, "m": 60, "s": 1}


@dataclass(frozen=True, kw_only=True)
class FileLimits:
    """Limits and settings of the machine that a file states.

    Parameters
    ----------
    limits : Limits
        In force now.
    sources : mapping of str to str
        Where each limit that the model works with comes from: "settings", "commands", "printer" (its own file),
        "limits" (the user's, in place of the printer's), "given" (for the entire file) or "assumed".
    fixed : mapping of str to object
        Limits that were given, and that commands do not change.
    feedrate_unit : float
        Value of one unit of M203, mm/s.
    slicer : str
        Its name and version, "" if unknown.
    filament_diameter : float
        mm
    estimate : float or None
        The slicer's own estimate, s.
    volumetric : bool
        E counts mm³ from the beginning.
    diameters : tuple of float
        mm, of the filaments by tool, from the beginning.
    start : tuple of Limits and mapping
        Limits and sources before any command: Klipper returns to them.
    firmware : str
        As the argument of `apply_command`.
    rule_of_e : str
        As `MachineState.firmware`.
    missing_end : str
        The line with which the slicer ends a file, if it lacks that; else "".
    notes : tuple of LimitNote
        Limits that were stated or given and are not followed, or are assumed.
    macros : mapping of str to LimitMacro
        Macros of the printer that set limits.
    macro_seconds : mapping of str to float
        As in `GivenLimits`.
    retraction : tuple of float
        As in `PrinterLimits`.
    """

    limits: Limits
    sources: Mapping[str, str]
    fixed: Mapping[str, Any]
    feedrate_unit: float
    slicer: str
    filament_diameter: float
    estimate: float | None
    volumetric: bool
    diameters: tuple[float, ...]
    start: tuple[Limits, Mapping[str, str]]
    firmware: str
    rule_of_e: str = ""
    missing_end: str = ""
    notes: tuple[LimitNote, ...] = ()
    macros: Mapping[str, LimitMacro] = dataclass_field(default_factory=dict)
    macro_seconds: Mapping[str, float] = dataclass_field(default_factory=dict)
    retraction: tuple[float, float] = (0.0, 0.0)

    def after(self, code: str, line: bytes) -> FileLimits:
        """Return the limits in force after a command."""
        if code == "RESET_VELOCITY_LIMIT":
            return replace(self, limits=self.start[0], sources=self.start[1])
        if code in NOT_LIMITING.get(self.firmware, ()):
            ignored = f"in the file is ignored, as {self.firmware.capitalize()} does"
            return self.with_note(LimitNote(name=code, note=ignored))
        limits = apply_command(self.limits, code, line, feedrate_unit=self.feedrate_unit, firmware=self.firmware)
        if self.fixed:
            limits = replace(limits, **self.fixed)
        named = _SETS.get(code) or [name for name in self.sources if _sets_limit(line, name)]
        sources = {
            name: "commands" if name in named and source != "given" else source for name, source in self.sources.items()
        }
        if limits == self.limits and sources == self.sources:
            return self
        return replace(self, limits=limits, sources=sources)

    def after_macro(self, name: str) -> FileLimits:
        """Return the limits in force after a call of one of `macros`."""
        macro, file_limits = self.macros[name], self
        for code, line in macro.lines:
            file_limits = file_limits.after(code, line)
        if macro.unread:
            note = f"sets limits that only the printer can work out, and is not followed: {excerpt(macro.unread)}"
            file_limits = file_limits.with_note(LimitNote(name=f"[gcode_macro {name}]", note=note))
        return file_limits

    def with_note(self, note: LimitNote) -> FileLimits:
        """Return the limits with one more note, or unchanged if they have it."""
        return self if note in self.notes else replace(self, notes=(*self.notes, note))


def read_limits(
    head: bytes, tail: bytes, given: GivenLimits | None = None, settings: Mapping[str, str] | None = None
) -> FileLimits:
    """Read the limits that the beginning and the end of a file state.

    Parameters
    ----------
    head, tail : bytes
    given : GivenLimits, optional
        Limits that override those of the file.
    settings : mapping, optional
        Settings of the slicer from outside the text.

    Raises
    ------
    ParameterError
        If a limit that was given is out of range, or limits belong to two models.
    """
    given = given or GivenLimits()
    missing_end = "" if settings else find_missing_end(_find_slicer(head), tail)
    settings = dict(settings or {})
    for text in (head, tail):
        settings |= {name.decode(): value.decode("latin-1").strip() for name, value in _SETTING.findall(text)}
    flavour = settings.get("gcode_flavor", "")
    by_minute = flavour in ("reprapfirmware", "sprinter") or (
        (b"M566" in head or b"M203" in head) and _BY_MINUTE.search(head) is not None
    )
    slicer = _find_slicer(head)
    limits, sources = _first_limits(_default_limits(flavour, head, slicer), settings, given)
    firmware = flavour if flavour in ("repetier", "smoothie") else ""
    rule_of_e = extrusion_rule(head, settings)
    if given.printer is not None:
        firmware = rule_of_e = "klipper" if given.printer.firmware == "klipper" else ""
    volumetric, diameters = filament_units(head, settings)
    return FileLimits(
        limits=limits,
        sources=sources,
        start=(limits, sources),
        firmware=firmware,
        rule_of_e=rule_of_e,
        volumetric=volumetric,
        diameters=diameters,
        fixed=given.fixed,
        feedrate_unit=1 / 60 if by_minute else 1.0,
        slicer=slicer,
        filament_diameter=diameters[0],
        estimate=_slicer_estimate(settings, head, tail),
        missing_end=missing_end,
        notes=_notes(given, limits.model),
        macros=given.printer.macros if given.printer is not None else {},
        macro_seconds=given.macro_seconds,
        retraction=given.printer.retraction if given.printer is not None else (0.0, 0.0),
    )


def _first_limits(start: Limits, settings: Mapping[str, str], given: GivenLimits) -> tuple[Limits, dict[str, str]]:
    """Return the limits before any command, and the source of each that the model works with.

    Parameters
    ----------
    start : Limits
        To assume until the file states others.
    settings : mapping
        Of the slicer.
    given : GivenLimits
    """
    fixed, stated = given.fixed, dict[str, Any]()
    if given.printer is not None:
        start, origin = given.printer.limits, dict.fromkeys(given.printer.stated, "printer")
    else:
        if settings.get("machine_limits_usage") != "ignore":
            stated = _parse_settings(settings, start)
        origin = dict.fromkeys(stated, "settings")
    model: Model = fixed.get("model") or stated.pop("model", start.model)
    if "jerk" in fixed and "model" not in fixed and model not in JERK_MODELS:
        model = "jerk"
    elif given.printer is None and "model" not in fixed:
        model = model_of_limits(given.values, model)
    used = {name: value for name, value in given.values.items() if is_used(name, model)}
    limits = replace(start, **{**stated, "model": model})
    if given.printer is None:
        limits = set_limits(limits, used)
    origin |= dict.fromkeys(changed_fields(used), "limits") | dict.fromkeys(fixed, "given")
    limits = replace(limits, **fixed)
    return limits, {name: origin.get(name, "assumed") for name in FIELDS_BY_MODEL[limits.model]}


def _notes(given: GivenLimits, model: Model) -> tuple[LimitNote, ...]:
    """Return the notes of the printer, and one for each limit that the model does not use."""
    note = f"is not used: the model of corners is {model.replace('junction', JUNCTION_DEVIATION)}"
    names = [name for name in given.values if not is_used(name, model)]
    printer = given.printer
    if printer is not None:
        unused = [name for name, models in _OF_ONE_MODEL.items() if model not in models.split()]
        names += [name for name in unused if name in printer.stated and name not in names]
    own = () if printer is None else printer.notes
    return (*own, *(LimitNote(name=name, note=note) for name in names))


def _find_slicer(head: bytes) -> str:
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


def _sets_limit(line: bytes, name: str) -> bool:
    """Tell whether a command sets a limit by one of its words; only M205 and SET_VELOCITY_LIMIT are known."""
    return name in _SAYS and _SAYS[name].search(line.upper()) is not None


def _default_limits(flavour: str, head: bytes, slicer: str) -> Limits:
    """Return the limits to assume until the file states others."""
    if flavour == "klipper" or b"SET_VELOCITY_LIMIT" in head.upper():
        return KLIPPER
    if flavour == "smoothie":
        return SMOOTHIE
    return CURA if slicer.startswith("Cura") else MARLIN


def _parse_settings(settings: Mapping[str, str], start: Limits) -> dict[str, Any]:
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


def _slicer_estimate(settings: Mapping[str, str], head: bytes, tail: bytes) -> float | None:
    """Return the slicer's own estimate in the file, s."""
    total = _TOTAL.search(head)
    text = settings.get("estimated printing time (normal mode)", total[1].decode() if total else "")
    parts = re.findall(r"(\d+)\s*([dhms])", text)
    if parts:
        return float(sum(int(number) * _UNIT_OF_TIME[unit] for number, unit in parts))
    times = next((times for pattern in _TIMES if (times := pattern.findall(head + tail))), None)
    return float(times[-1]) if times else None
