"""What a user states of a printer beside its file of G-code: limits, and the time that its macros take."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from infill.errors import FormatError, ParameterError, UsageError
from infill.files.excerpts import quote_value
from infill.gcode.klipper_config import read_klipper
from infill.gcode.limit_names import read_assignments
from infill.gcode.marlin_settings import has_marlin_settings, read_marlin
from infill.gcode.moonraker_limits import read_moonraker
from infill.gcode.printer_limits import PrinterLimits, read_printer_text

MAX_SECONDS: Final = 1e6  # of a macro, 11 days
_COMMAND: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*")
_MOVE: Final = re.compile(r"^G[01] [XYZEF]", re.MULTILINE)
_SECTION_LINE: Final = re.compile(r"^\[[^\]\n:]+\]\s*(?:[#;].*)?$", re.MULTILINE)
_AMOUNT: Final = r"(\d+(?:\.\d+)?(?:e\d+)?)"
_DURATION: Final = re.compile(
    rf"(-)?(?:{_AMOUNT}\s*h)?\s*(?:{_AMOUNT}\s*m(?:in)?)?\s*(?:{_AMOUNT}\s*s?)?", re.IGNORECASE
)


@dataclass(frozen=True, kw_only=True)
class GivenLimits:
    """Limits and times that a user gives.

    Parameters
    ----------
    fixed : mapping
        Fields of `infill.gcode.limits.Limits` that hold for the entire file, whatever its commands say.
    printer : PrinterLimits, optional
        Of the printer's own file, with `values` in it.
    values : mapping of str to float
        Limits of the printer by the names of `infill.gcode.limit_names.LIMIT_NAMES`.
    macro_seconds : mapping of str to float
        Time of each call of a macro or another command, s, by its name in capitals.
    """

    fixed: Mapping[str, Any] = field(default_factory=dict)
    printer: PrinterLimits | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    macro_seconds: Mapping[str, float] = field(default_factory=dict)


def read_printer(path: Path, given: Mapping[str, float]) -> PrinterLimits:
    """Read the limits of a printer from Klipper's printer.cfg, an answer of Moonraker, or Marlin's answer to M503.

    Parameters
    ----------
    path : Path
    given : mapping
        Limits by the names of `infill.gcode.limit_names.LIMIT_NAMES`, which take the place of those in the file.

    Raises
    ------
    FormatError
        If the file is none of them, or as their readers do.
    """
    text = read_printer_text(path)
    if text.lstrip().startswith("{"):
        return read_moonraker(path, text, given)
    if _SECTION_LINE.search(text):
        return read_klipper(path, given)
    if _MOVE.search(text):
        raise FormatError(f"{path} is G-code to print; give the printer.cfg of the printer, or its answer to M503")
    if has_marlin_settings(text):
        return read_marlin(path, text, given)
    raise FormatError(
        f"{path} is neither Klipper's printer.cfg, nor Moonraker's answer in JSON, nor Marlin's answer to M503; give "
        "one of them"
    )


def parse_macros(name: str, value: object) -> dict[str, float]:
    """Parse the times of macros, from a mapping or from texts such as ``START_PRINT=45s,END_PRINT=1m 30s``.

    Parameters
    ----------
    name : str
        Of the argument, for messages.
    value : mapping, str or sequence of str

    Returns
    -------
    dict of str to float
        Seconds, by name in capitals.

    Raises
    ------
    UsageError
        If a name is not that of a command, or a time cannot be read.
    ParameterError
        If a name stands twice, or a time is out of range.

    >>> parse_macros("macros", "START_PRINT=45s,end_print=1m 30s"), parse_macros("macros", {"G28": 20})
    ({'START_PRINT': 45.0, 'END_PRINT': 90.0}, {'G28': 20.0})
    """
    seconds: dict[str, float] = {}
    for word, duration in read_assignments(name, value, "START_PRINT=45s"):
        code = word.upper()
        if not _COMMAND.fullmatch(word):
            raise UsageError.about(name, f"has {quote_value(word)}; give the name of a macro, as START_PRINT=45s")
        if code in seconds:
            raise ParameterError.about(name, f"has {code} twice; leave one out")
        seconds[code] = _parse_seconds(name, word, duration)
    return seconds


def _parse_seconds(name: str, word: str, value: object) -> float:
    """Parse a time to seconds: a number, or a text such as 45s, 1m 30s or 1h; errors name the argument and the word."""
    number: float | None = None
    if isinstance(value, int | float) and not isinstance(value, bool):
        number = float(value)
    elif isinstance(value, str) and (match := _DURATION.fullmatch(value.strip())) and any(match.groups()[1:]):
        hours, minutes, seconds = (float(part or 0) for part in match.groups()[1:])
        number = ((hours * 60 + minutes) * 60 + seconds) * (-1 if match[1] else 1)
    problem = f"has {word} = {quote_value(value)}; give a time such as 45s or 1m 30s"
    if number is None:
        raise UsageError.about(name, problem)
    if not 0 <= number <= MAX_SECONDS:
        raise ParameterError.about(name, f"{problem}, up to {MAX_SECONDS:,.0f} s")
    return number
