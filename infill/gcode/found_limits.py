"""Limits of the machine that a file was sliced for, as far as the file states them, and the source of each.

PrusaSlicer, SuperSlicer, OrcaSlicer and Bambu Studio write their settings as comments ``; name = value``, at the end or
at the top; the first value of a list is that of the normal mode. Commands (M201 to M205, M566, SET_VELOCITY_LIMIT) then
change them on the way. Cura states only its name; its own estimates use the defaults of its machine definitions.
Limits that the printer itself states take the place of all of these but the commands.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from dataclasses import field as dataclass_field
from typing import Any, Final

from infill.files.excerpts import excerpt
from infill.gcode.ending import find_missing_end
from infill.gcode.given_limits import GivenLimits
from infill.gcode.limit_names import MODEL_OF_FIELD, changed_fields, is_used, model_of_limits, set_limits
from infill.gcode.limits import (
    FIELDS_BY_MODEL,
    JERK_MODELS,
    JUNCTION_DEVIATION,
    NOT_LIMITING,
    Limits,
    Model,
    apply_command,
)
from infill.gcode.printer_limits import LimitMacro, LimitNote
from infill.gcode.slicer_settings import (
    extrusion_rule,
    filament_units,
    find_slicer,
    parse_limits_of_settings,
    read_settings,
    slicer_estimate,
)

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

# Commands of RepRapFirmware alone, and feed rates that no machine reaches in mm/s.
_BY_MINUTE: Final = re.compile(rb"^(?:M566\b|M203\b[^;\n]*[XY]\s*[3-9]\d{3}|M203\b[^;\n]*[XY]\s*\d{5})", re.MULTILINE)


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
        changed = replace(self, limits=limits, sources=sources)
        for name in named:
            if self.sources.get(name) == "limits" and getattr(limits, name, None) != getattr(self.limits, name, None):
                note = f"was given with --limits, and {code} in the file sets another"
                changed = changed.with_note(LimitNote(name=name, note=note))
        return changed

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
    slicer = find_slicer(head)
    missing_end = "" if settings else find_missing_end(slicer, tail)
    settings = dict(settings or {})
    settings |= read_settings(head, tail)
    flavour = settings.get("gcode_flavor", "")
    by_minute = flavour in ("reprapfirmware", "sprinter") or (
        (b"M566" in head or b"M203" in head) and _BY_MINUTE.search(head) is not None
    )
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
        estimate=slicer_estimate(settings, head, tail),
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
            stated = parse_limits_of_settings(settings, start)
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
        unused = [field for field in MODEL_OF_FIELD if field not in FIELDS_BY_MODEL[model]]
        names += [name for name in unused if name in printer.stated and name not in names]
    own = () if printer is None else printer.notes
    return (*own, *(LimitNote(name=name, note=note) for name in names))


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
