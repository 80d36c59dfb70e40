"""The limits of the machine that a file was sliced for, as far as the file tells them, and where each was found.

PrusaSlicer, SuperSlicer, OrcaSlicer and Bambu Studio write their settings as comments ``; name = value``, at the end or
at the top; the first value of a list is that of the normal mode. Commands (M201 to M205, M566, SET_VELOCITY_LIMIT) then
change them on the way. Cura tells nothing but its name; its own estimates take the defaults of its machine definitions.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

from infill.gcode.limits import JERKS, Axes, Limits, Model, commanded, makes_sense
from infill.gcode.table import DIAMETER, MOST_TOOLS

KLIPPER: Final = Limits(model="klipper", feedrate=(300.0, 300.0, 5.0, 50.0))
MARLIN: Final = Limits()  # its factory settings
SMOOTHIE: Final = Limits(model="junction", junction_deviation=0.05)
CURA: Final = Limits(  # of its definition fdmprinter, which its own estimate takes
    model="vector-jerk",
    feedrate=(1e6, 1e6, 1e6, 1e6),
    axis_acceleration=(9000.0, 9000.0, 100.0, 10000.0),
    jerk=(20.0, 20.0, 0.4, 5.0),
    acceleration=4000.0,
    travel_acceleration=4000.0,
    retract_acceleration=4000.0,
)
# What each model works with; nothing is said of the rest.
USED: Final[dict[str, tuple[str, ...]]] = {
    "jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "vector-jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "junction": ("feedrate", "axis_acceleration", "acceleration", "junction_deviation"),
    "klipper": ("feedrate", "axis_acceleration", "acceleration", "square_corner_velocity", "minimum_cruise_ratio"),
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
# What only RepRapFirmware knows, and feed rates that no machine reaches in mm/s.
_BY_MINUTE: Final = re.compile(rb"^(?:M566\b|M203\b[^;\n]*[XY]\s*[3-9]\d{3}|M203\b[^;\n]*[XY]\s*\d{5})", re.MULTILINE)
_UNIT_OF_TIME: Final = {"d": 86400, "h": 3600, "m": 60, "s": 1}


@dataclass(frozen=True, kw_only=True)
class FoundLimits:
    """What a file tells about its machine and itself.

    Parameters
    ----------
    limits : Limits
        In force now.
    sources : mapping of str to str
        Where each limit that the model works with comes from: "settings", "commands", "given" or "assumed".
    fixed : mapping of str to object
        Limits that were given, and that no command changes.
    feedrate_unit : float
        What a number of M203 is in mm/s.
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
        Limits and sources before any command: what Klipper returns to.
    firmware : str
        As `commanded` takes it.
    rule_of_e : str
        As `State.firmware`.
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

    def after(self, code: str, line: bytes) -> FoundLimits:
        """Return what is in force after a command."""
        if code == "RESET_VELOCITY_LIMIT":
            return replace(self, limits=self.start[0], sources=self.start[1])
        limits = commanded(self.limits, code, line, feedrate_unit=self.feedrate_unit, firmware=self.firmware)
        if self.fixed:
            limits = replace(limits, **self.fixed)
        named = _SETS.get(code) or [name for name in self.sources if _says(line, name)]
        sources = {
            name: "commands" if name in named and source != "given" else source for name, source in self.sources.items()
        }
        if limits == self.limits and sources == self.sources:
            return self
        return replace(self, limits=limits, sources=sources)


def found_limits(
    head: bytes, tail: bytes, fixed: Mapping[str, Any] | None = None, settings: Mapping[str, str] | None = None
) -> FoundLimits:
    """Return the limits that the beginning and the end of a file tell.

    Parameters
    ----------
    head, tail : bytes
    fixed : mapping, optional
        Fields of `Limits` that are known better.
    settings : mapping, optional
        What the slicer tells elsewhere.

    Raises
    ------
    ParameterError
        If a limit that was given is out of range.
    """
    fixed = dict(fixed or {})
    settings = dict(settings or {})
    for text in (head, tail):
        settings |= {name.decode(): value.decode("latin-1").strip() for name, value in _SETTING.findall(text)}
    flavour = settings.get("gcode_flavor", "")
    by_minute = flavour in ("reprapfirmware", "sprinter") or (
        (b"M566" in head or b"M203" in head) and _BY_MINUTE.search(head) is not None
    )
    named = _SLICER.search(head)
    slicer = b" ".join(named.groups()).decode("latin-1") if named else ""
    start, found = _start(flavour, head, slicer), {}
    if settings.get("machine_limits_usage") != "ignore":
        found = _from_settings(settings, start)
    model: Model = fixed.get("model") or found.pop("model", start.model)
    if "jerk" in fixed and "model" not in fixed and model not in JERKS:
        model = "jerk"
    limits = replace(start, **{**found, "model": model, **fixed})
    sources = {
        name: "given" if name in fixed else "settings" if name in found else "assumed" for name in USED[limits.model]
    }
    volumetric, diameters = filament_of(head, settings)
    return FoundLimits(
        limits=limits,
        sources=sources,
        start=(limits, sources),
        firmware=flavour if flavour in ("repetier", "smoothie") else "",
        rule_of_e=rule_of_e(head, settings),
        volumetric=volumetric,
        diameters=diameters,
        fixed=fixed,
        feedrate_unit=1 / 60 if by_minute else 1.0,
        slicer=slicer,
        filament_diameter=diameters[0],
        estimate=_estimate(settings, head, tail),
    )


def filament_of(head: bytes, settings: Mapping[str, str]) -> tuple[bool, tuple[float, ...]]:
    """Return whether E counts mm³ before any command says so, and the diameters of the filaments by tool, mm.

    Parameters
    ----------
    head : bytes
        The beginning of the file: Cura names its flavour there, and two of them count mm³.
    settings : mapping
        Of the slicer.

    >>> filament_of(b";FLAVOR:UltiGCode", {}), filament_of(b"", {"filament_diameter": "2.85,1.75"})
    ((True, (1.75,)), (False, (2.85, 1.75)))
    """
    flavour = _FLAVOUR.search(head)
    volumetric = flavour is not None and flavour[1].strip().lower() in _VOLUMETRIC
    if "use_volumetric_e" in settings:
        volumetric = settings["use_volumetric_e"].strip() not in ("0", "", "nil", "false")
    numbers = [_first(text) or DIAMETER for text in settings.get("filament_diameter", "").replace(";", ",").split(",")]
    return volumetric, tuple(numbers[:MOST_TOOLS])


def rule_of_e(head: bytes, settings: Mapping[str, str]) -> str:
    """Return whose rule tells when E counts from the last move, as `infill.gcode.table.State.firmware`.

    >>> rule_of_e(b"", {"gcode_flavor": "klipper"}), rule_of_e(b"", {"gcode_flavor": "marlin2"})
    ('klipper', '')
    """
    flavour = settings.get("gcode_flavor", "")
    if flavour == "klipper" or b"SET_VELOCITY_LIMIT" in head.upper():
        return "klipper"
    return "reprapfirmware" if flavour == "reprapfirmware" else ""


def _says(line: bytes, name: str) -> bool:
    return name in _SAYS and _SAYS[name].search(line.upper()) is not None


def _start(flavour: str, head: bytes, slicer: str) -> Limits:
    """Return what is assumed until the file says more."""
    if flavour == "klipper" or b"SET_VELOCITY_LIMIT" in head.upper():
        return KLIPPER
    if flavour == "smoothie":
        return SMOOTHIE
    return CURA if slicer.startswith("Cura") else MARLIN


def _from_settings(settings: Mapping[str, str], start: Limits) -> dict[str, Any]:
    """Return the fields of `Limits` that a block of settings tells."""
    found: dict[str, Any] = {}
    for field, prefixes in {
        "feedrate": ("machine_max_feedrate", "machine_max_speed"),
        "axis_acceleration": ("machine_max_acceleration",),
        "jerk": ("machine_max_jerk",),
    }.items():
        given = [
            next(
                (
                    _limit(settings.get(f"{prefix}_{axis}"), field)
                    for prefix in prefixes
                    if f"{prefix}_{axis}" in settings
                ),
                None,
            )
            for axis in "xyze"
        ]
        if any(given):
            before: Axes = getattr(start, field)
            found[field] = tuple(value or old for value, old in zip(given, before, strict=True))
    for field, name in {
        "acceleration": "machine_max_acceleration_extruding",
        "travel_acceleration": "machine_max_acceleration_travel",
        "retract_acceleration": "machine_max_acceleration_retracting",
        "junction_deviation": "machine_max_junction_deviation",
        "minimum_feedrate": "machine_min_extruding_rate",
        "minimum_travel_feedrate": "machine_min_travel_rate",
    }.items():
        value = _limit(settings.get(name), field)
        if value:
            found[field] = value
            if field.endswith("acceleration") and start.model != "klipper":
                found[f"highest_{field}"] = value
    if settings.get("gcode_flavor") == "marlin" and "acceleration" in found:  # before 2.0 it has none of travel
        found["travel_acceleration"] = found["highest_travel_acceleration"] = found["acceleration"]
    if "junction_deviation" in found and start.model in JERKS:
        found["model"] = "junction"
    return found


def _first(text: str | None) -> float | None:
    """Return the first number of a list, or None where there is none that could be a limit."""
    try:
        number = float((text or "").split(",")[0])
    except ValueError:
        return None
    return number if 0 <= number < math.inf else None


def _limit(text: str | None, field: str) -> float | None:
    """Return the first number of a list, or None where no machine has that limit."""
    number = _first(text)
    return None if number is None or not makes_sense(number, field) else number


def _estimate(settings: Mapping[str, str], head: bytes, tail: bytes) -> float | None:
    """Return the time that the slicer wrote into the file, s."""
    total = _TOTAL.search(head)
    text = settings.get("estimated printing time (normal mode)", total[1].decode() if total else "")
    parts = re.findall(r"(\d+)\s*([dhms])", text)
    if parts:
        return float(sum(int(number) * _UNIT_OF_TIME[unit] for number, unit in parts))
    found = next((found for pattern in _TIMES if (found := pattern.findall(head + tail))), None)
    return float(found[-1]) if found else None
