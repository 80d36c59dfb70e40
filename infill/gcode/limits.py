"""Limits of a machine that the planner of its firmware works with, and the commands that change them.

Feed rates are in mm/s, accelerations in mm/s², jerks and corner velocities in mm/s. The order of axes is x, y, z, e.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Final, Literal, get_args

from infill.errors import ParameterError, UsageError
from infill.plain_numbers import plain_argument, plain_number

Model = Literal["jerk", "vector-jerk", "junction", "klipper"]
JERK_MODELS: Final = ("jerk", "vector-jerk")
MODELS: Final[tuple[str, ...]] = get_args(Model)
JUNCTION_DEVIATION: Final = "junction-deviation"  # the model "junction" as firmware calls it
Axes = tuple[float, float, float, float]
# Fields that each model works with; the others are not reported.
FIELDS_BY_MODEL: Final[dict[Model, tuple[str, ...]]] = {
    "jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "vector-jerk": ("feedrate", "axis_acceleration", "acceleration", "jerk"),
    "junction": ("feedrate", "axis_acceleration", "acceleration", "junction_deviation"),
    "klipper": (
        *("feedrate", "axis_acceleration", "acceleration"),
        *("square_corner_velocity", "minimum_cruise_ratio", "corner_extrusion_velocity"),
    ),
}
INFINITE: Final = float("inf")
LIMITING_CODES: Final = frozenset(
    {"M201", "M203", "M204", "M205", "M566", "SET_VELOCITY_LIMIT", "RESET_VELOCITY_LIMIT"}
)
_MAY_BE_ZERO: Final = {
    "corner_extrusion_velocity",
    "jerk",
    "minimum_feedrate",
    "minimum_travel_feedrate",
    "square_corner_velocity",
    "minimum_cruise_ratio",
}
# Commands that a firmware does not know, or takes for something else.
NOT_LIMITING: Final[dict[str, frozenset[str]]] = {
    "repetier": frozenset({"M203", "M204", "M205"}),
    "klipper": frozenset({"M201", "M203", "M205", "M566"}),
}
MIN_LIMIT, MAX_LIMIT = 1e-3, 1e9  # of a limit in mm/s or mm/s²: other values are mistakes of the file
MIN_DEVIATION: Final = 1e-6  # mm
_KLIPPER_WORDS: Final = {  # and the field whose bounds each keeps
    "VELOCITY": "feedrate",
    "ACCEL": "acceleration",
    "ACCEL_TO_DECEL": "acceleration",
    "SQUARE_CORNER_VELOCITY": "square_corner_velocity",
    "MINIMUM_CRUISE_RATIO": "minimum_cruise_ratio",
}
_PAIR: Final = re.compile(rb"([A-Z_]+)\s*=\s*[\"']?\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,2})?)", re.IGNORECASE)
_CODE: Final = re.compile(rb"\s*(?:[Nn]\d+\s*)?[A-Za-z]\d+(?:\.\d+)?")
_REMARK: Final = re.compile(rb"\([^()]*\)|[;*].*", re.DOTALL)


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Limits of a machine, and the model of its corners.

    Parameters
    ----------
    model : {"jerk", "vector-jerk", "junction", "klipper"}
        The bound on the speed at a corner: the jump of each axis' velocity, as PrusaSlicer estimates and Marlin does
        with CLASSIC_JERK; that of x and y together, as CuraEngine estimates and Marlin did until 2016; Marlin's
        junction deviation; Klipper's square corner velocity.
    feedrate, axis_acceleration, jerk : tuple of 4 float
        Of x, y, z, e. The jerk is used by "jerk" and "vector-jerk", by the latter that of x for x and y.
    acceleration, travel_acceleration, retract_acceleration : float
        Along the path: of moves that extrude, of travel moves, and of moves of the extruder alone.
    highest_acceleration, highest_travel_acceleration, highest_retract_acceleration : float
        Highest values that commands can set.
    minimum_feedrate, minimum_travel_feedrate : float
        Lowest feed rates; slower moves are raised to them.
    junction_deviation : float
        mm; used by "junction" only.
    square_corner_velocity, corner_extrusion_velocity, minimum_cruise_ratio : float
        Klipper's square_corner_velocity, its extruder's instantaneous_corner_velocity, and its minimum_cruise_ratio:
        the share of a move from stop to stop that runs at constant speed.

    Raises
    ------
    ParameterError
        If a limit is impossible for a machine, or the model is unknown.
    """

    model: Model = "jerk"
    feedrate: Axes = (300.0, 300.0, 5.0, 25.0)
    axis_acceleration: Axes = (3000.0, 3000.0, 100.0, 10000.0)
    jerk: Axes = (10.0, 10.0, 0.3, 5.0)
    acceleration: float = 3000.0
    travel_acceleration: float = 3000.0
    retract_acceleration: float = 3000.0
    highest_acceleration: float = INFINITE
    highest_travel_acceleration: float = INFINITE
    highest_retract_acceleration: float = INFINITE
    minimum_feedrate: float = 0.0
    minimum_travel_feedrate: float = 0.0
    junction_deviation: float = 0.013
    square_corner_velocity: float = 5.0
    corner_extrusion_velocity: float = 1.0
    minimum_cruise_ratio: float = 0.5

    def __post_init__(self) -> None:
        if self.model not in MODELS:
            raise UsageError.about(
                "model", f"is {self.model!r}; give one of {', '.join(MODELS).replace('junction', JUNCTION_DEVIATION)}"
            )
        for limit in fields(self)[1:]:
            limit_value = getattr(self, limit.name)
            for value in limit_value if isinstance(limit_value, tuple) else (limit_value,):
                if not (
                    is_valid_limit(value, limit.name) or (value == INFINITE and limit.name != "minimum_cruise_ratio")
                ):
                    raise ParameterError.about(
                        limit.name, f"is {plain_argument(value)}; give {describe_valid(limit.name)}"
                    )
        for name in ("acceleration", "travel_acceleration", "retract_acceleration"):
            if getattr(self, name) == INFINITE:
                raise ParameterError.about(name, "is infinite; give a number in mm/s²")


def is_valid_limit(value: float, name: str) -> bool:
    """Return True if a machine may have this limit; name is a field of `Limits`.

    >>> is_valid_limit(1e-300, "acceleration"), is_valid_limit(0.0, "jerk"), is_valid_limit(0.013, "junction_deviation")
    (False, True, True)
    """
    if name == "minimum_cruise_ratio":
        return 0 <= value < 1
    lower = MIN_DEVIATION if name == "junction_deviation" else MIN_LIMIT
    return lower <= value <= MAX_LIMIT or (value == 0 and name in _MAY_BE_ZERO)


def describe_valid(name: str) -> str:
    """Describe the valid numbers of a limit; name is a field of `Limits`."""
    if name == "minimum_cruise_ratio":
        return "a number from 0 and below 1"
    lower = MIN_DEVIATION if name == "junction_deviation" else MIN_LIMIT
    return (
        f"a number from {plain_argument(lower)} to "
        f"{plain_number(MAX_LIMIT, 6)}{', or 0' if name in _MAY_BE_ZERO else ''}"
    )


@lru_cache(maxsize=256)  # slicers switch between a few accelerations, ten thousand times
def apply_command(limits: Limits, code: str, line: bytes, *, feedrate_unit: float = 1.0, firmware: str = "") -> Limits:
    """Return the limits after a line of G-code; the same object if it sets none.

    Parameters
    ----------
    limits : Limits
    code : str
        Such as "M204".
    line : bytes
        The full line.
    feedrate_unit : float
        Value of one unit of M203, mm/s: RepRapFirmware counts in mm/min.
    firmware : str
        "repetier" or "klipper", which ignore some of these commands (`NOT_LIMITING`), or "smoothie", whose M205 X is
        the junction deviation; else "".

    >>> apply_command(Limits(), "M204", b"M204 P900 T1500").acceleration
    900.0
    """
    if code in NOT_LIMITING.get(firmware, ()):
        return limits
    match code:
        case "M205" if firmware == "smoothie":
            return _with_deviation(limits, _parse_words(line).get("X", 0.0))
        case "M201":
            return replace(limits, axis_acceleration=_update_axes(limits.axis_acceleration, _parse_words(line)))
        case "M203":
            return replace(limits, feedrate=_update_axes(limits.feedrate, _parse_words(line), feedrate_unit))
        case "M204":
            return _apply_m204(limits, _parse_words(line))
        case "M205":
            return _apply_m205(limits, _parse_words(line))
        case "M566":
            return replace(limits, jerk=_update_axes(limits.jerk, _parse_words(line), 1 / 60))
        case "SET_VELOCITY_LIMIT":
            return _apply_velocity_limit(limits, line)
        case _:
            return limits


def _parse_words(line: bytes) -> dict[str, float]:
    """Return the numbers of a command by letter, without that of the command itself."""
    text = _REMARK.sub(b"", line)
    code = _CODE.match(text)
    pairs = re.findall(rb"([A-Za-z])\s*([-+]?(?:\d+\.?\d*|\.\d+))", text[code.end() :] if code else b"")
    return {letter.decode().upper(): float(number) for letter, number in pairs}


def _update_axes(before: Axes, words: dict[str, float], unit: float = 1.0) -> Axes:
    """Return limits of x, y, z and e, with those that the words set; impossible values are ignored."""
    x, y, z, e = (
        words[axis] * unit if MIN_LIMIT <= words.get(axis, 0.0) * unit <= MAX_LIMIT else value
        for axis, value in zip("XYZE", before, strict=True)
    )
    return x, y, z, e


def _apply_m204(limits: Limits, words: dict[str, float]) -> Limits:
    """Apply M204: P, R and T, or S for both printing and travel; Klipper takes S, or the lower of P and T."""
    words = {letter: value for letter, value in words.items() if MIN_LIMIT <= value <= MAX_LIMIT}
    if limits.model == "klipper":
        value = words.get("S", min(words["P"], words["T"]) if {"P", "T"} <= set(words) else limits.acceleration)
        return replace(limits, acceleration=value, travel_acceleration=value)
    if "S" in words:  # with S, T is the acceleration of retraction
        requested = {
            "acceleration": words["S"],
            "travel_acceleration": words["S"],
            "retract_acceleration": words.get("T"),
        }
    else:
        names = {"acceleration": "P", "travel_acceleration": "T", "retract_acceleration": "R"}
        requested = {name: words.get(letter) for name, letter in names.items()}
    highest = {name: getattr(limits, f"highest_{name}") for name in requested}
    return replace(limits, **{name: min(value, highest[name]) for name, value in requested.items() if value})


def _apply_m205(limits: Limits, words: dict[str, float]) -> Limits:
    """Apply M205: jerk by axis, where X alone stands for Y too; S and T, the lowest feed rates; J, the deviation."""
    if "X" in words and "Y" not in words:
        words = {**words, "Y": words["X"]}
    changed = replace(
        limits,
        jerk=_update_axes(limits.jerk, words),
        minimum_feedrate=_lowest_feedrate(limits.minimum_feedrate, words.get("S")),
        minimum_travel_feedrate=_lowest_feedrate(limits.minimum_travel_feedrate, words.get("T")),
    )
    return _with_deviation(changed, words.get("J", 0.0))


def _lowest_feedrate(before: float, asked: float | None) -> float:
    """Return a lowest feed rate; a negative one means none."""
    asked = before if asked is None else max(asked, 0.0)
    return asked if is_valid_limit(asked, "minimum_feedrate") else before


def _with_deviation(limits: Limits, deviation: float) -> Limits:
    """Return limits with this junction deviation, if it is possible, else unchanged."""
    sense = is_valid_limit(deviation, "junction_deviation")
    return replace(limits, junction_deviation=deviation) if sense else limits


def _apply_velocity_limit(limits: Limits, line: bytes) -> Limits:
    """Apply Klipper's SET_VELOCITY_LIMIT, as far as its numbers are valid."""
    numbers = {name.upper().decode(): float(value) for name, value in _PAIR.findall(line.split(b";", 1)[0])}
    words = {
        name: numbers[name]
        for name, field in _KLIPPER_WORDS.items()
        if name in numbers and is_valid_limit(numbers[name], field)
    }
    acceleration = words.get("ACCEL", limits.acceleration)
    ratio = words.get("MINIMUM_CRUISE_RATIO", limits.minimum_cruise_ratio)
    if "ACCEL_TO_DECEL" in words:  # until 2024; it is the ratio's complement in mm/s²
        ratio = max(0.0, 1 - words["ACCEL_TO_DECEL"] / acceleration)
    ratio = ratio if ratio < 1 else limits.minimum_cruise_ratio  # 1 by rounding
    speed = words.get("VELOCITY", limits.feedrate[0])
    return replace(
        limits,
        feedrate=(speed, speed, *limits.feedrate[2:]),
        acceleration=acceleration,
        travel_acceleration=acceleration,
        square_corner_velocity=words.get("SQUARE_CORNER_VELOCITY", limits.square_corner_velocity),
        minimum_cruise_ratio=ratio,
    )
