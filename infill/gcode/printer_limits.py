"""Limits that a printer itself states, in whatever form its firmware or its host gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

from infill.errors import FormatError
from infill.files.broken import missing_file, require_not_empty, wrap_read_errors
from infill.gcode.limits import Limits, describe_valid, is_valid_limit

Firmware = Literal["klipper", "marlin"]
MAX_BYTES: Final = 16 << 20  # of a file of a printer; real ones have some kB


@dataclass(frozen=True, kw_only=True)
class LimitNote:
    """A stated limit that the plan does not follow, or one that it had to assume.

    Parameters
    ----------
    name : str
        As the printer spells it.
    note : str
        The rest of the sentence.
    """

    name: str
    note: str


@dataclass(frozen=True, kw_only=True)
class LimitMacro:
    """A macro of the printer that sets limits.

    Parameters
    ----------
    lines : tuple of (code, line)
        Its commands that set limits, those of the macros that it calls included.
    unread : str
        The first such command whose effect only the printer knows; then `lines` is empty.
    """

    lines: tuple[tuple[str, bytes], ...] = ()
    unread: str = ""


@dataclass(frozen=True, kw_only=True)
class PrinterLimits:
    """Limits of one printer.

    Parameters
    ----------
    firmware : {"klipper", "marlin"}
    limits : Limits
        In force when a print begins.
    stated : frozenset of str
        Fields of `Limits` that the printer states, or that follow from its statements; the others are assumed.
    notes : tuple of LimitNote
    macros : mapping of str to LimitMacro
        By name, in capitals.
    retraction : tuple of float
        Seconds of a retraction by firmware (G10), and of its end (G11).
    """

    firmware: Firmware
    limits: Limits
    stated: frozenset[str]
    notes: tuple[LimitNote, ...] = ()
    macros: Mapping[str, LimitMacro] = field(default_factory=dict)
    retraction: tuple[float, float] = (0.0, 0.0)


def read_printer_text(path: Path) -> str:
    """Read a text of a printer; raise FormatError if it cannot be read, is empty, or is not text."""
    with wrap_read_errors(path):
        if path.is_dir():
            raise FormatError(f"{path} is a folder; give a file, such as printer.cfg")
        if not path.is_file():
            pipe = f"{path} is a pipe or a device; save its content as a file and give that"
            raise FormatError(pipe if path.exists() else missing_file(path))
        require_not_empty(path)
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise FormatError(
                f"{path} has {size / 2**20:,.0f} MiB, and the limits of a printer take some kB; give printer.cfg, the "
                "answer of Moonraker or of M503"
            )
        data = path.read_bytes()
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):  # as a terminal of Windows saves its output
        return data.decode("utf-16", errors="replace")
    if b"\0" in data:
        raise FormatError(f"{path} is not text; give printer.cfg, the answer of Moonraker or of M503")
    return data.decode("utf-8-sig", errors="replace").replace("\r\n", "\n").replace("\r", "\n")


def read_limit(place: str, field_name: str, value: object, unit: str) -> float:
    """Return a limit that a printer states, as a number.

    Parameters
    ----------
    place : str
        Where it stands, for the message.
    field_name : str
        Field of `Limits` whose bounds it keeps.
    value : object
        A number or its text.
    unit : str

    Raises
    ------
    FormatError
        If it is not a number, or not a possible limit.
    """
    try:
        number = float(value) if isinstance(value, str | int | float) and not isinstance(value, bool) else None
    except (ValueError, OverflowError):
        number = None
    if number is None or not is_valid_limit(number, field_name):
        from infill.files.excerpts import quote_value

        advice = f"{describe_valid(field_name)} {unit}".rstrip()
        raise FormatError(f"{place} is {quote_value(value)}; it must be {advice}")
    return number
