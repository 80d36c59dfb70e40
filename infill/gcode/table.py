"""Lines of G-code as arrays: the position of the machine after each of them.

Moves are followed many at a time with NumPy; the rare lines that change the meaning of moves (G90, M82, G92 …) are
read one by one, and cut the batch into stretches of constant modes. Offsets are those of the file: a position is as
stated by the words sent to the machine, in mm. E is in the unit of the file: mm of filament, or mm³.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.gcode.lines import WORDS, GcodeCommand, ParsedLines, fill_missing, parse_lines
from infill.gcode.machine_state import INCH, MachineState, apply_mode, changes_moves, firmware_retraction
from infill.gcode.unusual_moves import EXTRUDERS
from infill.kernels.compiling import is_compiler_loaded

OFF_CIRCLE = 0.05  # mm by which the two ends of an arc may differ in their distance from its centre
ACROSS = {17: "z", 18: "y", 19: "x"}  # the axis across the plane of arcs that G17, G18 and G19 select


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
        if command is not None and not changes_moves(command):
            continue
        last_line = count if command is None else command.line
        state = _follow_stretch(slice(first_line, last_line), values, where, extruded, state)
        until = last_line
        if command is not None:
            after = apply_mode(state, command)
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
    lines = _without_unreachable_arcs(lines, further, where, plane, before)
    extruded[lines.unread] = 0.0
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
                modes = apply_mode(modes, command)
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


def _without_unreachable_arcs(
    lines: ParsedLines,
    further: dict[int, dict[str, float]],
    where: dict[str, Floats],
    plane: NDArray[np.uint8],
    before: MachineState,
) -> ParsedLines:
    """Return the lines; arcs by a radius that does not reach their end are unread: firmware does not agree on them."""
    by_radius = [line for line, words in further.items() if "R" in words and lines.code[line] > 1]
    if not by_radius:
        return lines
    unread = lines.unread.copy()
    for line in by_radius:
        names = [name for name in "xyz" if name != ACROSS[int(plane[line])]]
        start = [where[name][line - 1] if line else getattr(before, name) for name in names]
        chord = math.dist(start, [where[name][line] for name in names])
        unread[line] |= chord > 2 * abs(further[line]["R"]) + OFF_CIRCLE
    return replace(lines, unread=unread)


def _find_unsure(lines: ParsedLines, lost: str) -> tuple[NDArray[np.bool_], str]:
    """Return the lines before which x or y is unknown since an unreadable move, and the last `MachineState.lost`."""
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
    """Fill `where` and `extruded` from the `values` of lines with constant modes; return the state after them."""
    if lines.start >= lines.stop:
        return state
    position: dict[str, Any] = {}
    for axis, name in enumerate("xyz"):
        column = values[lines, axis]
        if state.relative:
            place = getattr(state, name) + np.cumsum(fill_missing(column, 0.0))
        else:
            place = _fill_forward(column, getattr(state, name))
        where[name][lines] = place
        position[name] = float(place[-1])
    column = values[lines, 3]
    if state.steps_e:
        pushed = fill_missing(column, 0.0)
        counter = state.e + np.cumsum(pushed)
    else:
        counter = _fill_forward(column, state.e)
        pushed = np.diff(counter, prepend=state.e)
    where["e"][lines] = counter
    extruded[lines] = pushed
    return replace(state, **position, e=float(counter[-1]))


def _fill_forward(values: Floats, before: float) -> Floats:
    """Return each value, or the previous one where it is missing."""
    if is_compiler_loaded():
        from infill.kernels.gcode_lines import fill_forward

        filled = np.empty(len(values))
        fill_forward(values, before, filled)  # compiled when the lines are, if they have to be
        return filled
    return fill_forward_plainly(values, before)


def fill_forward_plainly(values: Floats, before: float) -> Floats:
    """Return each value, or the previous one where it is missing, with NumPy."""
    if not len(values):
        return values.copy()
    at = np.where(np.isnan(values), -1, np.arange(len(values)))
    np.maximum.accumulate(at, out=at)
    return np.where(at < 0, before, values[np.maximum(at, 0)])


def _retraction_state(before: MachineState, extruded: Floats, commands: tuple[GcodeCommand, ...]) -> dict[str, Any]:
    """Return the retracted filament at the end, and True if firmware retracted it, as fields of `MachineState`."""
    total = np.cumsum(np.append(-before.retracted, extruded))
    retracted = round(float(max(0.0, total.max()) - total[-1]), 9)
    firmware = before.firmware_retracted
    for command in commands:
        back = firmware_retraction(command, before.firmware)
        firmware = firmware if back is None else back
    return {"retracted": retracted, "firmware_retracted": firmware}
