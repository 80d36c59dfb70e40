"""Lines of G-code as arrays: the position of the machine after each of them.

Moves are followed many at a time with NumPy; the rare lines that change the meaning of moves (G90, M82, G92 …) are
read one by one, and cut the batch into stretches of constant modes. Offsets are those of the file: a position is as
stated by the words sent to the machine, in mm. E is in the unit of the file: mm of filament, or mm³.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.gcode.lines import WORDS, GcodeCommand, ParsedLines, parse_lines
from infill.gcode.unusual_moves import EXTRUDERS

Floats = NDArray[np.float64]
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


@dataclass(frozen=True, kw_only=True)
class GcodeTable:
    """A batch of lines, as columns.

    Parameters
    ----------
    data : bytes
        The text itself.
    start : (N + 1,) int64
        Where each line begins in `data`; the last entry is its length.
    kind : (N,) uint8
        OTHER, MOVE (G0, G1), ARC (G2, G3), COMMENT, BLANK or ODD.
    code : (N,) int8
        0 to 3 for G0 to G3, -1 else.
    numbered : (N,) bool
        The line begins with a line number, N12.
    x, y, z : (N,) float64
        Position after the line, NaN while unknown.
    e : (N,) float64
        The extruder's counter after the line, mm.
    f : (N,) float64
        Feed rate in force after the line, mm/min.
    extruded : (N,) float64
        mm of filament that the line pushes; negative retracts.
    given : (N, 7) bool
        The words among X, Y, Z, E, F, I, J that the line has.
    i, j : (N,) float64
        Centre of an arc relative to its start; NaN if not given.
    commands : tuple of GcodeCommand
        The lines that are OTHER or ODD.
    before, after : MachineState
        At the beginning and at the end.
    relative_e : (N,) bool
        True if E is relative on the line.
    plane : (N,) uint8
        17, 18 or 19.
    section : (N,) float64
        Cross-section of the filament in use, mm².
    volumetric : (N,) bool
        True if E counts mm³.
    unread : (N,) bool
        Lines that may move or extrude and could not be read.
    unsure : (N,) bool
        Lines before which x or y is unknown since such a move.
    further : dict of int to dict of str to float
        By line, the words K, R and P of unusual arcs.
    """

    data: bytes
    start: NDArray[np.int64]
    kind: NDArray[np.uint8]
    code: NDArray[np.int8]
    numbered: NDArray[np.bool_]
    x: Floats
    y: Floats
    z: Floats
    e: Floats
    f: Floats
    extruded: Floats
    given: NDArray[np.bool_]
    i: Floats
    j: Floats
    relative_e: NDArray[np.bool_]
    plane: NDArray[np.uint8]
    section: Floats
    volumetric: NDArray[np.bool_]
    unread: NDArray[np.bool_]
    unsure: NDArray[np.bool_]
    further: dict[int, dict[str, float]]
    commands: tuple[GcodeCommand, ...]
    before: MachineState
    after: MachineState

    def __len__(self) -> int:
        return len(self.kind)

    @property
    def moves(self) -> NDArray[np.bool_]:
        """True for lines with a word that moves an axis: X, Y, Z or E."""
        has_word = self.given
        moves_axis: NDArray[np.bool_] = has_word[:, 0] | has_word[:, 1] | has_word[:, 2] | has_word[:, 3]
        return moves_axis

    @property
    def filament(self) -> Floats:
        """Return the mm of filament that each line pushes, (N,), also where E counts mm³."""
        if not self.volumetric.any():
            return self.extruded
        return np.where(self.volumetric, self.extruded / self.section, self.extruded)

    def text(self, first: int, last: int) -> bytes:
        """Return lines `first` to `last` (exclusive) as bytes of the file."""
        return self.data[self.start[first] : self.start[last]]


def read_table(data: bytes, state: MachineState) -> GcodeTable:
    r"""Read a batch of whole lines, beginning in `state`.

    Parameters
    ----------
    data : bytes
        Lines with their line ends; only the last may lack one.
    state : MachineState
        Position and modes of the machine before the first line.

    Returns
    -------
    GcodeTable

    >>> table = read_table(b"M83\nG1 X1 Y2 E.5\nG1 Y3\n", MachineState())
    >>> table.kind.tolist(), table.y.tolist(), table.extruded.tolist()
    ([0, 1, 1], [nan, 2.0, 3.0], [0.0, 0.5, 0.0])
    """
    lines = parse_lines(data)
    return _replay(data, lines, state)


def _replay(data: bytes, lines: ParsedLines, before: MachineState) -> GcodeTable:
    """Follow the moves from `before`, stretch by stretch between commands that change their meaning."""
    before_lettered, commands, lines = _convert_extruders(lines, before)
    values, has_word, further, count = lines.values, lines.given, lines.further, len(lines)
    if before.inches or any(command.code == "G20" for command in commands):
        values, further = _convert_inches(lines, before)
    where = {name: np.empty(count) for name in ("x", "y", "z", "e")}
    extruded = np.zeros(count)
    relative_e = np.zeros(count, dtype=bool)
    volumetric = np.zeros(count, dtype=bool)
    plane = np.empty(count, dtype=np.uint8)
    section = np.empty(count)
    feed = _fill_forward(values[:, 4], before.f)
    state, first_line = before_lettered, 0
    for command in (*commands, None):
        if command is not None and not _changes_moves(command):
            continue
        last_line = count if command is None else command.line
        state = _follow_stretch(slice(first_line, last_line), values, where, extruded, state)
        until = last_line
        if command is not None:
            after = _apply_command(state, command)
            for name in where:
                where[name][last_line] = getattr(after, name)
            relative_e[last_line] = after.steps_e
            until = last_line + 1
        relative_e[first_line:last_line] = state.steps_e
        volumetric[first_line:until], plane[first_line:until], section[first_line:until] = (
            state.volumetric,
            state.plane,
            state.section,
        )
        if command is not None:
            state, first_line = after, last_line + 1
    unsure, lost = _find_unsure(lines, before.lost)
    after = replace(state, f=float(feed[-1]) if count else before.f, lost=lost)
    after = replace(after, **_retraction_state(before, extruded, commands))
    return GcodeTable(
        data=data,
        start=lines.start,
        kind=lines.kind,
        code=lines.code,
        numbered=lines.numbered,
        **where,
        f=feed,
        extruded=extruded,
        given=has_word,
        i=values[:, 5],
        j=values[:, 6],
        relative_e=relative_e,
        plane=plane,
        section=section,
        volumetric=volumetric,
        unread=lines.unread,
        unsure=unsure,
        further=further,
        commands=commands,
        before=before,
        after=after,
    )


def _convert_extruders(
    lines: ParsedLines, state: MachineState
) -> tuple[MachineState, tuple[GcodeCommand, ...], ParsedLines]:
    """Return the state, the commands and the lines, with A and B moved into E where these are the extruders.

    A file whose first word of either kind is an E has A and B as axes, which are left out.
    """
    by_letters = [line for line, words in lines.further.items() if not words.keys().isdisjoint(EXTRUDERS)]
    letters = state.letters
    if not letters:
        letters = "E" if lines.given[:, WORDS.index("E")].any() else EXTRUDERS if by_letters else ""
        state = replace(state, letters=letters)
    if letters != EXTRUDERS:
        return state, lines.commands, lines
    values, has_word = lines.values.copy(), lines.given.copy()
    counters = dict(zip(EXTRUDERS, state.counters, strict=True))
    modes = state
    column = WORDS.index("E")
    changed = list(lines.commands)
    for number, command in enumerate(lines.commands):
        match command.code:
            case "G90" | "G91" | "M82" | "M83":
                modes = _apply_command(modes, command)
            case "G92":
                reset = command.words or dict.fromkeys(EXTRUDERS)  # without a word, all
                counters |= {letter: reset[letter] or 0.0 for letter in EXTRUDERS if letter in reset}
                if not command.words.keys().isdisjoint(EXTRUDERS):
                    changed[number] = replace(command, words={**reset, "E": sum(counters.values())})
        further = lines.further.get(command.line, {})
        pushed = {letter: further[letter] or 0.0 for letter in EXTRUDERS if letter in further}
        if pushed:
            step = modes.steps_e
            counters |= {letter: value + (counters[letter] if step else 0.0) for letter, value in pushed.items()}
            values[command.line, column] = sum(pushed.values()) if step else sum(counters.values())
            has_word[command.line, column] = True
    converted = replace(lines, values=values, given=has_word)
    return replace(state, counters=(counters["A"], counters["B"])), tuple(changed), converted


def _convert_inches(lines: ParsedLines, before: MachineState) -> tuple[Floats, dict[int, dict[str, float]]]:
    """Convert the words of lines to mm, where some are in inches."""
    inches = np.zeros(len(lines), dtype=bool)
    since, on = 0, before.inches
    for command in lines.commands:
        if command.code in ("G20", "G21"):
            inches[since : command.line] = on
            since, on = command.line, command.code == "G20"
    inches[since:] = on
    further = {
        line: {name: value * (INCH if inches[line] and name != "P" else 1.0) for name, value in words.items()}
        for line, words in lines.further.items()
    }
    return np.where(inches[:, None], lines.values * INCH, lines.values), further


def _find_unsure(lines: ParsedLines, lost: str) -> tuple[NDArray[np.bool_], str]:
    """Return the lines before which x or y is unknown since an unreadable move, and the last `State.lost`."""
    count = len(lines)
    unsure = np.zeros(count, dtype=bool)
    unread = np.flatnonzero(lines.unread) + 1
    if not lost and not len(unread):
        return unsure, ""
    still = ""
    for axis, name in enumerate("XY"):
        begins = np.insert(unread, 0, 0) if name in lost else unread
        stated = np.append(np.flatnonzero(lines.given[:, axis]), count)
        ends = stated[np.searchsorted(stated, np.minimum(begins, count))]
        steps = np.bincount(begins, minlength=count + 2) - np.bincount(ends + 1, minlength=count + 2)
        unsure |= np.cumsum(steps)[:count] > 0
        still += name if (ends == count).any() else ""
    return unsure, still


def _follow_stretch(
    lines: slice, values: Floats, where: dict[str, Floats], extruded: Floats, state: MachineState
) -> MachineState:
    """Follow the moves of lines with constant modes; return the state after them."""
    if lines.start >= lines.stop:
        return state
    position: dict[str, Any] = {}
    for axis, name in enumerate("xyz"):
        column = values[lines, axis]
        if state.relative:
            place = getattr(state, name) + np.cumsum(np.nan_to_num(column))
        else:
            place = _fill_forward(column, getattr(state, name))
        where[name][lines] = place
        position[name] = float(place[-1])
    column = values[lines, 3]
    if state.steps_e:
        pushed = np.nan_to_num(column)
        counter = state.e + np.cumsum(pushed)
    else:
        counter = _fill_forward(column, state.e)
        pushed = np.diff(counter, prepend=state.e)
    where["e"][lines] = counter
    extruded[lines] = pushed
    return replace(state, **position, e=float(counter[-1]))


def _fill_forward(values: Floats, before: float) -> Floats:
    """Return each value, or the previous one where it is missing."""
    if not len(values):
        return values.copy()
    at = np.where(np.isnan(values), -1, np.arange(len(values)))
    np.maximum.accumulate(at, out=at)
    return np.where(at < 0, before, values[np.maximum(at, 0)])


_MODES = {"G17", "G18", "G19", "G20", "G21", "G28", "G90", "G91", "G92", "M82", "M83", "M120", "M121", "M200"}
_MODES |= {"SAVE_GCODE_STATE", "RESTORE_GCODE_STATE"}


def _changes_moves(command: GcodeCommand) -> bool:
    """Tell whether a command changes how later moves are read: units, modes, places or tools."""
    return command.code in _MODES or command.code[:1] == "T"


def _apply_command(state: MachineState, command: GcodeCommand) -> MachineState:
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


def _retraction_state(before: MachineState, extruded: Floats, commands: tuple[GcodeCommand, ...]) -> dict[str, Any]:
    """Return the retracted filament at the end, and True if firmware retracted it, as fields of `MachineState`."""
    total = np.cumsum(np.append(-before.retracted, extruded))
    retracted = round(float(max(0.0, total.max()) - total[-1]), 9)
    firmware = before.firmware_retracted
    for command in commands:
        back = firmware_retraction(command, before.firmware)
        firmware = firmware if back is None else back
    return {"retracted": retracted, "firmware_retracted": firmware}
