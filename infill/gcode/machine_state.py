"""State of the machine between two lines of G-code, and the commands that change the meaning of moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from infill.gcode.lines import GcodeCommand

NAN = float("nan")
AXES = "XYZ"
INCH = 25.4  # mm
DIAMETER = 1.75  # mm of filament, where the file does not say
MAX_DIAMETER, MAX_TOOLS, MAX_SAVED = 20.0, 64, 16  # mm; more is a mistake of the file


@dataclass(frozen=True, kw_only=True)
class MachineState:
    """Position and modes of the machine between two lines.

    Parameters
    ----------
    x, y, z : float
        mm, NaN while unknown.
    e : float
        Value of the extruder's counter, mm of filament, or mm³.
    f : float
        Feed rate in force, mm/min; NaN before the first.
    retracted : float
        mm of filament retracted since the nozzle was last primed; 0 or more.
    firmware_retracted : bool
        A G10 is in force.
    relative, relative_e : bool
        G91 and M83.
    absolute_e : bool
        M82 came after the G91 in force.
    firmware : {"", "klipper", "reprapfirmware"}
        Whose rule of `steps_e` holds; "" for Marlin's.
    inches : bool
        G20.
    tool : int
    plane : int
        Of arcs: 17, 18 or 19.
    volumetric : bool
        E counts mm³, not mm.
    diameters : tuple of float
        mm of filament by tool; further tools have the last one.
    letters : str
        Words that push filament: "E", "AB" as in MakerBot's files, or "" while the file has used neither.
    counters : tuple of float
        Values of A and B.
    lost : str
        The axes, of x and y, whose position the file has not stated since a line that could not be read.
    saved : tuple of (name, relative, relative_e, absolute_e)
        States that SAVE_GCODE_STATE, or M120, has saved.
    """

    x: float = NAN
    y: float = NAN
    z: float = NAN
    e: float = 0.0
    f: float = NAN
    retracted: float = 0.0
    firmware_retracted: bool = False
    relative: bool = False
    relative_e: bool = False
    absolute_e: bool = False
    firmware: str = ""
    inches: bool = False
    tool: int = 0
    plane: int = 17
    volumetric: bool = False
    diameters: tuple[float, ...] = (DIAMETER,)
    letters: str = ""
    counters: tuple[float, float] = (0.0, 0.0)
    lost: str = ""
    saved: tuple[tuple[str, bool, bool, bool], ...] = ()

    @property
    def steps_e(self) -> bool:
        """True if E counts from the last move.

        G91 includes E. M82 after it makes E absolute again in Marlin (its pages of G91 and M82), and not in Klipper,
        where G91 or M83 suffices. RepRapFirmware's E follows M82 and M83 alone.
        """
        if self.firmware == "reprapfirmware":
            return self.relative_e
        return self.relative_e or (self.relative and not (self.absolute_e and self.firmware != "klipper"))

    @property
    def diameter(self) -> float:
        """Diameter of the filament in use, mm."""
        return self.diameters[min(self.tool, len(self.diameters) - 1)]

    @property
    def section(self) -> float:
        """Cross-section of the filament in use, mm²."""
        return math.pi / 4 * self.diameter**2


_MODES = {"G17", "G18", "G19", "G20", "G21", "G28", "G90", "G91", "G92", "M82", "M83", "M120", "M121", "M200"}
_MODES |= {"SAVE_GCODE_STATE", "RESTORE_GCODE_STATE"}


def changes_moves(command: GcodeCommand) -> bool:
    """Tell whether a command changes how later moves are read: units, modes, places or tools."""
    return command.code in _MODES or command.code[:1] == "T"


def apply_mode(state: MachineState, command: GcodeCommand) -> MachineState:
    """Return the state after a command that changes the meaning of moves."""
    match command.code:
        case "G20" | "G21":
            return replace(state, inches=command.code == "G20")
        case "G90" | "G91":
            return replace(state, relative=command.code == "G91", absolute_e=False)
        case "M82" | "M83":
            return replace(state, relative_e=command.code == "M83", absolute_e=command.code == "M82")
        case "G17" | "G18" | "G19":
            return replace(state, plane=int(command.code[1:]))
        case "M200":
            return apply_m200(state, command.words)
        case "SAVE_GCODE_STATE" | "M120":
            remaining = tuple(
                saved_state for saved_state in state.saved if saved_state[0] != command.name or command.code == "M120"
            )
            return replace(
                state,
                saved=(*remaining[-MAX_SAVED:], (command.name, state.relative, state.relative_e, state.absolute_e)),
            )
        case "RESTORE_GCODE_STATE" | "M121":
            return _restore_state(state, command.name, once=command.code == "M121")
        case "G92":
            letters = [letter for letter in "XYZE" if letter in command.words] or list("XYZE")  # without a word, all
            unit = INCH if state.inches else 1.0
            reset: dict[str, Any] = {letter.lower(): (command.words.get(letter) or 0.0) * unit for letter in letters}
            return replace(state, **reset)
        case "G28":
            homed = [letter for letter in AXES if letter in command.words] or list(AXES)
            unknown: dict[str, Any] = dict.fromkeys(map(str.lower, homed), NAN)
            return replace(state, **unknown)
        case _ if command.code[1:].isdigit():
            return replace(state, tool=int(command.code[1:]))
        case _:
            return state


def apply_m200(state: MachineState, words: Mapping[str, float | None]) -> MachineState:
    """Return the state after M200: D, the diameter of the filament of tool T, 0 for E in mm; S, 1 if E is in mm³.

    M200 with limits alone (L) changes nothing.
    """
    volumetric, diameters = state.volumetric, state.diameters
    diameter = words.get("D")
    if diameter is not None:
        diameter *= INCH if state.inches else 1.0
        volumetric = diameter > 0
        if 0 < diameter < MAX_DIAMETER:
            tool = int(words.get("T") or 0) if "T" in words else None
            if tool is None:
                diameters = (diameter,)
            elif 0 <= tool < MAX_TOOLS:
                several = [diameters[min(index, len(diameters) - 1)] for index in range(max(tool + 2, len(diameters)))]
                several[tool] = diameter
                diameters = tuple(several)
    if "S" in words:
        volumetric = bool(words["S"])
    return replace(state, volumetric=volumetric, diameters=diameters)


def _restore_state(state: MachineState, name: str, *, once: bool) -> MachineState:
    """Return the state with the modes that were saved under a name, if any were."""
    for place in reversed(range(len(state.saved))):
        if state.saved[place][0] == name:
            _, relative, relative_e, absolute_e = state.saved[place]
            saved = state.saved[:place] if once else state.saved
            return replace(state, relative=relative, relative_e=relative_e, absolute_e=absolute_e, saved=saved)
    return state


def firmware_retraction(command: GcodeCommand, firmware: str = "") -> bool | None:
    """Return True if a command retracts (G10), False if it primes (G11) by firmware; None for all others.

    Marlin's G10 S1 retracts as far as for a change of tools. With any other word, and with S too in RepRapFirmware,
    G10 sets a temperature, an offset of a tool or an origin.

    Parameters
    ----------
    command : GcodeCommand
    firmware : str
        As in `MachineState`.
    """
    if command.code not in ("G10", "G11") or not set(command.words) <= {"S"}:
        return None
    if "S" in command.words and (firmware == "reprapfirmware" or command.words["S"] not in (None, 0.0, 1.0)):
        return None
    return command.code == "G10"


def sets_counter(command: GcodeCommand) -> bool:
    """Return True if a command only sets the counter of filament."""
    return command.code == "G92" and set(command.words) == {"E"}
