"""Moves in an unusual spelling, read one line at a time.

`infill.gcode.lines` reads plain moves many at a time. It passes doubtful ones to this module: several blanks before
a number, remarks in brackets between words, words that a planner may ignore, arcs by radius, extruders called A and
B. A line whose meaning differs between firmwares is not read at all, and callers count it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

from infill.checks import FARTHEST

MAX_COORDINATE: Final = 1e7  # mm, or mm/min: a larger number is a mistake of the file
# Words that RepRapFirmware, Marlin, Klipper and Sailfish accept on a move without changing its path: an endstop (H),
# a laser (S), pins (P, of straight moves), and axes beyond the third.
IGNORED: Final = frozenset("HSUVWCD")
FURTHER_AXES: Final = frozenset("UVWCDAB")
EXTRUDERS: Final = "AB"  # of MakerBot and Sailfish
_HEAD: Final = re.compile(rb"\s*(?:[Nn]\d+\s*)?[Gg]0*([0-3])(?![\d.])")
_REMARK: Final = re.compile(rb"\([^()]*\)")
_NUMBER: Final = rb"[-+]?(?:\d+\.?\d*|\.\d+)"
_WORD: Final = re.compile(rb"\s*([A-Za-z])\s*(%s(?::%s)*)?" % (_NUMBER, _NUMBER))
# An exponent, or a word E? Firmwares disagree.
_EXPONENT: Final = re.compile(rb"[\d.](?:[eE][-+]0\d|[eE]\+\d)")
_SMALL_EXPONENT: Final = re.compile(rb"[\d.]e")
_CHECKSUM: Final = re.compile(rb"\*\s*\d+\s*$")

# Codes that neither move the tool along a path nor change the meaning of paths, or that the machine does by itself
# without stating a path: homing, levelling, dwelling, offsets of tools.
STILL_CODES: Final = frozenset(
    word
    for line in (
        "G4 G10 G11 G17 G18 G19 G20 G21 G28 G29 G29.1 G29.2 G30 G31 G32 G33 G34 G35 G38.2 G38.3 G38.4 G38.5",
        "G39.1 G39.3 G39.4 G40 G49 G53 G54 G60 G61.1 G64 G80 G90 G91 G91.1 G92 G92.1 G92.9 G94 G99 G130",
        "G150.1 G150.2 G150.3 G161 G162 G180 G292 G380 G381 G382 G383 G392 G425",
    )
    for word in line.split()
)
# Codes whose text is free.
_TEXTS: Final = frozenset(
    word
    for line in (
        "M16 M20 M23 M28 M30 M32 M33 M36 M37 M38 M98 M117 M118 M118.1 M291 M300 M486 M550 M551 M552 M559 M560",
        "M587 M588 M589 M701 M702 M862 M862.1 M862.2 M862.3 M862.5 M862.6 M928 M929 M1002",
    )
    for word in line.split()
)
_INNER_MOVE: Final = re.compile(rb"[\s\d][Gg]\s*0*[0-35](?![\d.])")
_AXIS_FIRST: Final = re.compile(
    rb"\s*(?:[Nn]\d+\s*)?(?:[XYZEAB]\s*[-+.\d\[{]|[Gg]\s+0*[0-35]\b|[XYZEAB]\d*=)", re.IGNORECASE
)
# A block that a switch of the machine skips (/), the byte order mark of a text, a remark: some firmwares obey the rest
# of the line, others do not.
_HIDDEN: Final = re.compile(
    rb"\s*(?:[Nn]\d+\s*)?(?:(?:/\d*|\xef\xbb\xbf)\s*(?:[Nn]\d+\s*)?[GMT]\s*\d"
    rb"|(?:\([^()]*\)\s*|[^\sA-Za-z;(]+\s*)+(?:[Nn]\d+\s*)?[Gg]\s*0*[0-35](?![\d.]))",
    re.IGNORECASE,
)
_MOVING_WORDS: Final = frozenset({"FORCE_MOVE", "MANUAL_STEPPER", "MANUAL_STEPPERS"})
_MACRO: Final = re.compile(r"[A-Z_][A-Z_]{2,}[A-Z0-9_]*")
# Klipper's own commands, and those of common plug-ins, that move nothing.
_STILL_MACROS: Final = re.compile(
    r"(?:SET|QUERY|EXCLUDE|BED_MESH|SAVE|RESTORE|RESET|TIMELAPSE|TEMPERATURE|SKEW|PRESSURE|INPUT|STATUS|DUMP|GET|BUZZ"
    r"|TURN_OFF|ACTIVATE|SYNC|UPDATE|CLEAR|PID|RESPOND|HELP|FIRMWARE|ENDLESS|M\d|SDCARD|HOST|DISABLE|ENABLE"
    r"|STOP_GCODE|START_GCODE|END_GCODE|SERVO|LED|PRINT_STATS|DEFINE|ECHO|VAR|GLOBAL|ABORT|BREAK)(?:_.*|$)|IF|ELIF|ELSE|WHILE"
)


def read_move(text: bytes) -> tuple[int, dict[str, float]] | None:
    r"""Read one line as a move or an arc; return None if its meaning is uncertain.

    Parameters
    ----------
    text : bytes
        One line.

    Returns
    -------
    code : int
        0 to 3 for G0 to G3.
    words : dict of str to float
        Of the letters X, Y, Z, E, F, I, J, K, R, P, A and B.

    >>> read_move(b"N12 G1 X  70 (go) Y50 E1:.5 H2*14 ; to the wall")
    (1, {'X': 70.0, 'Y': 50.0, 'E': 1.5})
    >>> read_move(b"G1 X1e-5 Y2"), read_move(b"G1 X{max} Y2")
    (None, None)
    """
    head = _HEAD.match(text)
    if head is None:
        return None
    code = int(head[1])
    body = _CHECKSUM.sub(b"", _REMARK.sub(b" ", text[head.end() :]).split(b";", 1)[0].rstrip()).rstrip()
    mixed = body != body.lower() and _SMALL_EXPONENT.search(body)
    if mixed or _EXPONENT.search(body):
        return None
    words: dict[str, float] = {}
    place = 0
    while place < len(body):
        match = _WORD.match(body, place)
        if match is None:
            return None
        place = match.end()
        letter = match[1].decode().upper()
        value = _read_value(match[2], letter)
        if letter in words or (value is None and letter not in IGNORED):
            return None
        words[letter] = value or 0.0
    if any(abs(words.get(letter, 0.0)) > FARTHEST for letter in "XYZIJKR"):
        return None
    return None if _is_unsure(code, words) else (code, {k: v for k, v in words.items() if k in "XYZEFIJKRPAB"})


def _read_value(number: bytes | None, letter: str) -> float | None:
    """Return the number of a word; of several extruders, which RepRapFirmware separates by colons, the sum."""
    if number is None:
        return None
    parts = [float(part) for part in number.split(b":")]
    if (len(parts) > 1 and letter != "E") or max(map(abs, parts)) > MAX_COORDINATE:
        return None
    return sum(parts)


def _is_unsure(code: int, words: Mapping[str, float]) -> bool:
    """Return True if the words of a move mean something other than a path from the current position."""
    expected = "XYZEFIJKRPAB" if code > 1 else "XYZEFIJPAB"
    if not set(words) <= {*expected, *IGNORED}:
        return True
    if code > 1 and not is_arc(words):
        return True
    moves = {"X", "Y", "Z", "E", "A", "B"} & set(words)
    return code < 2 and not moves and bool(FURTHER_AXES & set(words))


def is_arc(words: Mapping[str, float]) -> bool:
    """Return True if the words define an arc; without a radius, and a centre or an end, firmware draws none.

    >>> is_arc({"X": 5.0, "I": 2.0}), is_arc({"X": 5.0, "I": 0.0, "J": 0.0}), is_arc({"X": 5.0, "R": 0.0})
    (True, False, False)
    """
    return any(words.get(letter) for letter in "IJK") or bool(words.get("R") and {"X", "Y", "Z"} & set(words))


def may_move(code: str, text: bytes) -> bool:
    """Return True if a line other than a plain move could move or extrude along a path that is not planned.

    Parameters
    ----------
    code : str
        As in `infill.gcode.lines.GcodeCommand`.
    text : bytes
        The line.

    >>> may_move("G5", b"G5 X1 Y2 I3 J4 E1"), may_move("M204", b"M204 S500"), may_move("G90", b"G90 G1 X5")
    (True, False, True)
    >>> may_move("/G1", b"/G1 X1"), may_move("/", b"/ N5 M83"), may_move("(GO)", b"(go) G1 X1")
    (True, True, True)
    """
    letter, number = code[:1], code[1:2]
    if letter == "G" and number.isdigit():
        return code not in STILL_CODES or _has_inner_move(text)
    if letter == "M" and number.isdigit():
        return code not in _TEXTS and _has_inner_move(text)
    if code in _MOVING_WORDS:
        return True
    if letter == "T" and number.isdigit():
        return False
    return _AXIS_FIRST.match(text) is not None or _HIDDEN.match(text) is not None


def _has_inner_move(text: bytes) -> bool:
    """Return True if a second command on a line is a move: RepRapFirmware and milling machines obey both."""
    words = _REMARK.sub(b" ", text.split(b";", 1)[0])
    return words.upper().count(b"G") + words.upper().count(b"M") > 1 and _INNER_MOVE.search(words) is not None


def is_macro(code: str) -> bool:
    """Return True if a command is known to the printer alone, and may move: PRINT_START.

    >>> is_macro("PRINT_START"), is_macro("SET_PRESSURE_ADVANCE"), is_macro("M204")
    (True, False, False)
    """
    return _MACRO.fullmatch(code) is not None and _STILL_MACROS.fullmatch(code) is None
