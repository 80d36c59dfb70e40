"""What the commands of a print have set on the machine: temperatures, fans, accelerations, pressure advance, tool."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

from infill.gcode.dialect import object_of, tool_of
from infill.gcode.lines import GcodeCommand
from infill.gcode.machine_state import firmware_retraction
from infill.plain_numbers import plain_argument

Value = float | str
Settings = tuple[tuple[str, Value], ...]
FIRMWARE: Final = "firmware retraction"
# The kind of violation, and the unit, of each setting by the first word of its name.
_KINDS: Final[dict[str, tuple[str, str]]] = {
    "nozzle": ("temperature", "°C"),
    "bed": ("temperature", "°C"),
    "chamber": ("temperature", "°C"),
    "heater": ("temperature", "°C"),
    "fan": ("fan", "%"),
    "acceleration": ("acceleration", "mm/s²"),
    "travel": ("acceleration", "mm/s²"),
    "retract": ("acceleration", "mm/s²"),
    "axis": ("acceleration", "mm/s²"),
    "jerk": ("acceleration", "mm/s"),
    "axis-speed": ("acceleration", ""),
    "limit": ("acceleration", ""),
    "pressure": ("pressure advance", ""),
    "flow": ("material", "%"),
    "speed": ("speed", "%"),
    "tool": ("tool", ""),
    "object": ("object", ""),
    "firmware": ("retraction", ""),
}
# Where a file has not set them, these are in force.
_DEFAULTS: Final[dict[str, Value]] = {"fan": 0.0, "flow": 100.0, "speed": 100.0, "object": "", "firmware": "off"}
_TEMPERATURES: Final = {"M104": "nozzle", "M109": "nozzle", "M140": "bed", "M190": "bed"}
_TEMPERATURES_OF_CHAMBER: Final = ("M141", "M191")
_BY_AXIS: Final = {"M201": "axis acceleration", "M203": "axis-speed", "M205": "jerk", "M566": "jerk"}
_KLIPPER_LIMITS: Final = {"ACCEL": ("acceleration", "travel acceleration")}
_PAIR: Final = re.compile(r"([A-Za-z_]+)\s*=\s*[\"']?([^\s\"']+)")
_FULL_FAN: Final = 255.0
_LINE_NUMBER: Final = re.compile(rb"^\s*[Nn]\d+\s*|\*\s*\d+\s*$")
# Commands that set nothing on the machine that outlasts them, or whose effect is followed elsewhere.
_WAITS: Final = ("M109", "M190", "M191")
_FOLLOWED: Final = frozenset(
    word
    for line in (
        "G4 G10 G11 G17 G18 G19 G20 G21 G90 G91 G92 M82 M83 M200 M120 M121 M73 M117 M118 M105 M110 M155 M31 M400 M70",
        "M115 M27 SAVE_GCODE_STATE RESTORE_GCODE_STATE EXCLUDE_OBJECT_START EXCLUDE_OBJECT_END M486 M624 M625",
    )
    for word in line.split()
)


@dataclass(kw_only=True)
class SettingsHistory:
    """The settings of a machine, line after line.

    Parameters
    ----------
    lines : list of int
        Lines, counted from 1 in the file, from which on `numbers` hold; ascending.
    numbers : list of int
        Place in `known` of the settings after each of these lines.
    known : dict of Settings to int
        Every combination that occurs, with its number.
    since : dict of str to list of int
        By name of a setting, the lines that set it.
    others : list of (line, text)
        Commands that are neither moves nor followed as settings: macros, pauses, homing.
    """

    lines: list[int] = field(default_factory=lambda: [0])
    numbers: list[int] = field(default_factory=lambda: [0])
    known: dict[Settings, int] = field(default_factory=lambda: {(): 0})
    since: dict[str, list[int]] = field(default_factory=dict)
    others: list[tuple[int, str]] = field(default_factory=list)
    _values: dict[str, Value] = field(default_factory=dict)
    _tool: str = "T0"

    def follow(self, command: GcodeCommand, text: bytes, line: int, firmware: str) -> None:
        """Apply a command of a line, counted from 1; `firmware` as in `MachineState`."""
        changes = dict(self._read(command, text, firmware))
        for name in changes:
            self.since.setdefault(name, []).append(line)
        if command.code in _WAITS:
            self.others.append((line, f"{command.code}, the wait for a temperature,"))
        if not changes:
            if (
                command.code
                and command.code not in (*_FOLLOWED, *_WAITS)
                and not firmware_retraction(command, firmware)
            ):
                self.others.append((line, plain_command(text)))
            return
        if all(self._values.get(name) == value for name, value in changes.items()):
            return
        self._values |= changes
        settings = tuple(sorted(self._values.items()))
        self.lines.append(line)
        self.numbers.append(self.known.setdefault(settings, len(self.known)))

    def _read(self, command: GcodeCommand, text: bytes, firmware: str) -> Iterator[tuple[str, Value]]:
        """Yield what a command sets, by name."""
        code, words = command.code, command.words
        text = plain_command(text).encode("latin-1")  # without a line number
        tool = tool_of(code, words, text)
        if tool:
            self._tool = tool
            yield "tool", tool
        elif code in _TEMPERATURES or code in _TEMPERATURES_OF_CHAMBER or code == "M568":
            yield from self._read_temperature(code, words)
        elif code in ("M106", "M107"):
            index = words.get("P") or 0.0
            speed = 0.0 if code == "M107" else words.get("S", _FULL_FAN)
            yield f"fan {plain_argument(index)}", round((speed or 0.0) / _FULL_FAN * 100, 1)
        elif code == "M204":
            yield from _read_m204(words)
        elif code in _BY_AXIS:
            yield from (
                (f"{_BY_AXIS[code]} {letter.lower()}", value) for letter, value in words.items() if value is not None
            )
        elif code in ("M900", "M572"):
            value = words.get("K") if code == "M900" else words.get("S")
            if value is not None:
                yield f"pressure advance {self._tool}", value
        elif code in ("M220", "M221") and words.get("S") is not None:
            yield "speed factor" if code == "M220" else f"flow {self._tool}", words["S"] or 0.0
        elif (back := firmware_retraction(command, firmware)) is not None:
            yield FIRMWARE, "on" if back else "off"
        elif code in ("M624", "M625"):
            yield "object", plain_command(text)[4:].strip()
        elif (marker := object_of(code, text)) is not None and marker[0] != "name":
            yield "object", marker[1]
        elif code.startswith("SET_") or code == "TURN_OFF_HEATERS":
            yield from _read_klipper(code, text, self._tool)

    def _read_temperature(self, code: str, words: Mapping[str, float | None]) -> Iterator[tuple[str, Value]]:
        """Yield the temperature that a command sets; R waits for cooling as well."""
        value = words.get("S", words.get("R"))
        if value is None:
            return
        heater = "chamber" if code in _TEMPERATURES_OF_CHAMBER else _TEMPERATURES.get(code, "nozzle")
        tool = words.get("T", words.get("P") if code == "M568" else None)
        yield (
            heater if heater != "nozzle" else f"nozzle {self._tool if tool is None else f'T{plain_argument(tool)}'}",
            value,
        )


def _read_m204(words: Mapping[str, float | None]) -> Iterator[tuple[str, Value]]:
    """Yield the accelerations that M204 sets: P, T and R, or S for both printing and travel."""
    for letters, name in (("PS", "acceleration"), ("TS", "travel acceleration"), ("R", "retract acceleration")):
        value = next((words[letter] for letter in letters if words.get(letter)), None)
        if value is not None:
            yield name, value


def _read_klipper(code: str, text: bytes, tool: str) -> Iterator[tuple[str, Value]]:
    """Yield what one of Klipper's commands sets."""
    pairs = {name.upper(): value for name, value in _PAIR.findall(plain_command(text))}
    numbers: dict[str, Value] = {name: _as_number(value) for name, value in pairs.items()}
    match code:
        case "SET_VELOCITY_LIMIT":
            for name, value in numbers.items():
                yield from ((target, value) for target in _KLIPPER_LIMITS.get(name, (f"limit {name}",)))
        case "SET_PRESSURE_ADVANCE":
            extruder = pairs.get("EXTRUDER", tool)
            for name in ("ADVANCE", "SMOOTH_TIME"):
                if name in numbers:
                    yield f"pressure advance {extruder}{'' if name == 'ADVANCE' else ' smooth time'}", numbers[name]
        case "SET_FAN_SPEED":
            speed = numbers.get("SPEED", 0.0)
            yield f"fan {pairs.get('FAN', '')}", round(speed * 100, 1) if isinstance(speed, float) else speed
        case "SET_HEATER_TEMPERATURE":
            yield f"heater {pairs.get('HEATER', '')}", numbers.get("TARGET", 0.0)
        case _:
            return


def _as_number(text: str) -> Value:
    """Return the number of a text, or the text itself."""
    try:
        return float(text)
    except ValueError:
        return text


def plain_command(text: bytes) -> str:
    r"""Return a command without its comment, line number and checksum, and with single blanks.

    >>> plain_command(b"N12 M104  S210 ; heat\n"), plain_command(b"M104 S210*33\n")
    ('M104 S210', 'M104 S210')
    """
    words = text.partition(b";")[0].strip()
    return " ".join(_LINE_NUMBER.sub(b"", words).decode("latin-1").split())


def kind_of_setting(name: str) -> str:
    """Return the kind of violation that a setting belongs to.

    >>> kind_of_setting("nozzle T0"), kind_of_setting("travel acceleration")
    ('temperature', 'acceleration')
    """
    return _KINDS[name.split()[0]][0]


def differing_settings(old: Settings, new: Settings) -> Iterator[tuple[str, str]]:
    """Compare settings; yield the name and a description of each that differs.

    >>> list(differing_settings((("nozzle T0", 210.0),), (("nozzle T0", 215.0),)))
    [('nozzle T0', 'nozzle 215 °C, was 210 °C')]
    """
    before, after = dict(old), dict(new)
    for name in sorted({*before, *after}):
        first = name.split()[0]
        was, now = (values.get(name, _DEFAULTS.get(first)) for values in (before, after))
        if was == now or (was is None and first == "tool" and now == "T0"):
            continue
        unit = _KINDS[first][1]
        shown = name.removesuffix(" T0").removesuffix(" 0")  # of a machine with one tool and one fan
        yield name, f"{shown} {_describe(now, unit)}, was {_describe(was, unit)}"


def _describe(value: Value | None, unit: str) -> str:
    """Write the value of a setting with its unit."""
    if value is None:
        return "not set"
    text = value if isinstance(value, str) else plain_argument(value)
    return f"{text or 'none'} {unit}".strip() if text else "none"
