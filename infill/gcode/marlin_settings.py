"""Marlin's answer to M503, as a serial console shows it: lines such as ``echo:  M203 X300.00 Y300.00 Z5.00 E25.00``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Final

from infill.errors import FormatError
from infill.files.excerpts import quote_value
from infill.gcode.limit_names import is_used, set_limits
from infill.gcode.limits import Limits, apply_command, is_valid_limit
from infill.gcode.printer_limits import LimitNote, PrinterLimits
from infill.plain_numbers import plain_argument

# A line of the answer, after whatever a console puts before it: "Recv: ", "echo:", "[time] ", "10. ".
_LINE: Final = re.compile(r"(?:^|[\s:>\]\)|])((M\d{2,3}|G2[01])(?:\s+[A-Z][-+]?\d*\.?\d*)*)\s*(?:;.*)?$", re.IGNORECASE)
_HEADING: Final = re.compile(r"(normal|stealth|silent)\b.*:\s*$", re.IGNORECASE)
_LIMITING: Final = ("M201", "M203", "M204", "M205")
_WORD: Final = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))", re.IGNORECASE)
_STATED_BY: Final = {"M201": ("axis_acceleration",), "M203": ("feedrate",)}
_STATED_BY_M204: Final = {
    "P": ("acceleration",),
    "T": ("travel_acceleration",),
    "R": ("retract_acceleration",),
    "S": ("acceleration", "travel_acceleration"),
}
_NOT_FOLLOWED: Final = {
    "M900": "(linear advance) does not change when moves begin and end",
    "M593": "(input shaping) does not change when moves begin and end",
    "M207": "is not followed: G10 and G11 take no time in the plan",
}
MARLIN: Final = Limits()


def has_marlin_settings(text: str) -> bool:
    """Tell whether a text has a line of an answer to M503."""
    return any(_LINE.search(line.rstrip()) for line in text.split("\n"))


def read_marlin(path: Path, text: str, given: Mapping[str, float]) -> PrinterLimits:
    """Read the limits of a printer from Marlin's answer to M503.

    Parameters
    ----------
    path : Path
        For messages.
    text : str
        Of a console; other lines are skipped. Of several answers, the last counts.
    given : mapping
        Limits by the names of `infill.gcode.limit_names.LIMIT_NAMES`, which take the place of those in the answer.

    Raises
    ------
    FormatError
        If it states no limits, a limit is not a possible number, its lengths are inches, or it is of RepRapFirmware.
    """
    limits, stated, notes = MARLIN, set[str](), dict[str, LimitNote]()
    silent = False
    for row in text.split("\n"):
        if heading := _HEADING.search(row.strip()):
            silent = heading[1].lower() != "normal"
            continue
        match = _LINE.search(row.rstrip())
        if match is None:
            silent = False
            continue
        line, code = match[1], match[2].upper()
        words = {letter.upper(): float(number) for letter, number in _WORD.findall(line[len(code) :])}
        if code == "G20":
            raise FormatError(f"{path} states inches (G20); send G21 to the printer, then M503, and save the answer")
        if code == "M566":
            raise FormatError(
                f"{path} is of RepRapFirmware (M566), which counts in mm/min; give its limits by name, as "
                "--limits jerk=8"
            )
        if code in _NOT_FOLLOWED:
            notes[code] = LimitNote(name=code, note=_NOT_FOLLOWED[code])
        if code not in _LIMITING:
            continue
        if silent:
            notes["silent"] = LimitNote(name=f"{code} of the silent mode", note="is not followed: the normal mode is")
        elif words.get("T", 0) > 0 and code in ("M201", "M203"):
            notes["tools"] = LimitNote(
                name=f"{code} T{plain_argument(words['T'])}", note="is not followed: all tools are planned as T0"
            )
        else:
            _check_words(path, line, code, words)
            limits = _apply(limits, code, line, words)
            stated |= _stated_by(code, words)
            if "B" in words or "Q" in words:
                notes["segment"] = LimitNote(
                    name=f"M205 {'B' if 'B' in words else 'Q'}",
                    note="(least time of a segment) is not followed: it acts when the buffer runs empty",
                )
    if not stated:
        raise FormatError(
            f"{path} states no limits (M201, M203, M204, M205); send M503 to the printer and save its whole answer"
        )
    lacking = {"feedrate": "M203", "axis_acceleration": "M201", "acceleration": "M204"}
    for field, code in lacking.items():
        if field not in stated:
            notes[code] = LimitNote(name=code, note="is not in the answer; Marlin's factory values are assumed")
    limits = set_limits(limits, {name: value for name, value in given.items() if is_used(name, limits.model)})
    return PrinterLimits(firmware="marlin", limits=limits, stated=frozenset(stated), notes=tuple(notes.values()))


def _check_words(path: Path, line: str, code: str, words: Mapping[str, float]) -> None:
    """Raise FormatError for a number that no machine has as a limit."""
    kinds = {"M201": "axis_acceleration", "M203": "feedrate", "M204": "acceleration"}
    kind_of = dict.fromkeys("XYZE", kinds.get(code, "jerk"))
    if code == "M204":
        kind_of = dict.fromkeys("SPTR", "acceleration")
    for letter, field in kind_of.items():
        if letter in words and not is_valid_limit(words[letter], field):
            raise FormatError(f"{path}: {quote_value(line)} has no possible {letter}; send M503 again")


def _apply(limits: Limits, code: str, line: str, words: Mapping[str, float]) -> Limits:
    """Return the limits after a line of the answer; a junction deviation or a jerk decides the model."""
    changed = apply_command(limits, code, line.upper().encode())
    if code == "M205" and words.get("J", 0) > 0:
        return replace(changed, model="junction")
    if code == "M205" and "X" in words:
        return replace(changed, model="jerk")
    return changed


def _stated_by(code: str, words: Mapping[str, float]) -> set[str]:
    """Return the fields of `Limits` that a line of the answer states."""
    if code == "M204":
        stated = {field for letter in words for field in _STATED_BY_M204.get(letter, ())}
        return stated | ({"retract_acceleration"} if {"S", "T"} <= set(words) else set())
    if code != "M205":
        return set(_STATED_BY[code])
    letters = {"X": "jerk", "J": "junction_deviation", "S": "minimum_feedrate", "T": "minimum_travel_feedrate"}
    return {field for letter, field in letters.items() if letter in words} & {field.name for field in fields(Limits)}
