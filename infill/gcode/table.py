"""Lines of G-code as arrays: where the machine stands after each of them.

Moves are followed many at a time with NumPy; the rare lines that change how moves are meant (G90, M82, G92 …) are taken
one by one, and cut the batch into stretches in which nothing changes. Units and offsets are those of the file: a
position is what the words say, as the machine is told.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.gcode.lines import Command, Lines, lines_of

Floats = NDArray[np.float64]
NAN = float("nan")
AXES = "XYZ"


@dataclass(frozen=True, kw_only=True)
class State:
    """Where the machine stands between two lines, and how it takes the next move.

    Parameters
    ----------
    x, y, z : float
        mm (or inches, see `inches`), NaN while unknown.
    e : float
        What the extruder's counter shows, mm of filament.
    f : float
        Feed rate in force, mm/min; NaN before the first.
    retracted : float
        mm of filament drawn back since the nozzle was last primed; 0 or more.
    firmware_retracted : bool
        A G10 is in force.
    relative, relative_e : bool
        G91 and M83.
    inches : bool
        G20.
    tool : int
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
    inches: bool = False
    tool: int = 0


@dataclass(frozen=True, kw_only=True)
class Table:
    """A batch of lines, line by line.

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
        mm of filament that the line pushes; negative draws back.
    given : (N, 7) bool
        Which of the words X, Y, Z, E, F, I, J the line has.
    i, j : (N,) float64
        Centre of an arc relative to its start; NaN if not given.
    commands : tuple of Command
        The lines that are OTHER.
    before, after : State
        At the beginning and at the end.
    relative_e : (N,) bool
        Whether E is relative on the line.
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
    commands: tuple[Command, ...]
    before: State
    after: State

    def __len__(self) -> int:
        return len(self.kind)

    @property
    def moves(self) -> NDArray[np.bool_]:
        """Whether each line has a word that moves something: X, Y, Z or E."""
        given = self.given
        something: NDArray[np.bool_] = given[:, 0] | given[:, 1] | given[:, 2] | given[:, 3]
        return something

    def text(self, first: int, last: int) -> bytes:
        """Return lines `first` to `last` (exclusive) as they stand in the file."""
        return self.data[self.start[first] : self.start[last]]


def read(data: bytes, state: State) -> Table:
    r"""Read a batch of whole lines, beginning in `state`.

    Parameters
    ----------
    data : bytes
        Lines with their line ends; only the last may lack one.
    state : State
        Where the machine stands before the first line.

    Returns
    -------
    Table

    >>> table = read(b"M83\nG1 X1 Y2 E.5\nG1 Y3\n", State())
    >>> table.kind.tolist(), table.y.tolist(), table.extruded.tolist()
    ([0, 1, 1], [nan, 2.0, 3.0], [0.0, 0.5, 0.0])
    """
    lines = lines_of(data)
    return _replayed(data, lines, state)


def _replayed(data: bytes, lines: Lines, before: State) -> Table:
    """Follow the moves from `before`, stretch by stretch between commands that change how they are meant."""
    values, commands, count = lines.values, lines.commands, len(lines)
    where = {name: np.empty(count) for name in ("x", "y", "z", "e")}
    extruded = np.zeros(count)
    relative_e = np.zeros(count, dtype=bool)
    feed = _held(values[:, 4], before.f)
    state, first = before, 0
    for command in (*commands, None):
        if command is not None and not _changes_moves(command):
            continue
        last = count if command is None else command.line
        state = _stretch(slice(first, last), values, where, extruded, state)
        relative_e[first:last] = state.relative_e or state.relative
        if command is not None:
            state = _changed(state, command)
            for name in where:
                where[name][last] = getattr(state, name)
            relative_e[last] = state.relative_e or state.relative
            first = last + 1
    after = replace(state, f=float(feed[-1]) if count else before.f)
    after = replace(after, **_retraction(before, extruded, commands))
    return Table(
        data=data,
        start=lines.start,
        kind=lines.kind,
        code=lines.code,
        numbered=lines.numbered,
        **where,
        f=feed,
        extruded=extruded,
        given=lines.given,
        i=values[:, 5],
        j=values[:, 6],
        relative_e=relative_e,
        commands=commands,
        before=before,
        after=after,
    )


def _stretch(lines: slice, values: Floats, where: dict[str, Floats], extruded: Floats, state: State) -> State:
    """Follow the moves of some lines in which nothing else changes, and return the state after them."""
    if lines.start >= lines.stop:
        return state
    now: dict[str, Any] = {}
    for axis, name in enumerate("xyz"):
        column = values[lines, axis]
        if state.relative:
            place = getattr(state, name) + np.cumsum(np.nan_to_num(column))
        else:
            place = _held(column, getattr(state, name))
        where[name][lines] = place
        now[name] = float(place[-1])
    column = values[lines, 3]
    if state.relative_e or state.relative:
        pushed = np.nan_to_num(column)
        counter = state.e + np.cumsum(pushed)
    else:
        counter = _held(column, state.e)
        pushed = np.diff(counter, prepend=state.e)
    where["e"][lines] = counter
    extruded[lines] = pushed
    return replace(state, **now, e=float(counter[-1]))


def _held(values: Floats, before: float) -> Floats:
    """Return each value, or the last one before it where there is none."""
    if not len(values):
        return values.copy()
    at = np.where(np.isnan(values), -1, np.arange(len(values)))
    np.maximum.accumulate(at, out=at)
    return np.where(at < 0, before, values[np.maximum(at, 0)])


_MODES = {"G20", "G21", "G28", "G90", "G91", "G92", "M82", "M83"}


def _changes_moves(command: Command) -> bool:
    return command.code in _MODES or command.code[:1] == "T"


def _changed(state: State, command: Command) -> State:
    """Return the state after a command that changes how moves are meant."""
    match command.code:
        case "G20" | "G21":
            return replace(state, inches=command.code == "G20")
        case "G90" | "G91":
            return replace(state, relative=command.code == "G91")
        case "M82" | "M83":
            return replace(state, relative_e=command.code == "M83")
        case "G92":
            named = [letter for letter in "XYZE" if letter in command.words] or list("XYZE")  # without a word, all
            reset: dict[str, Any] = {letter.lower(): command.words.get(letter) or 0.0 for letter in named}
            return replace(state, **reset)
        case "G28":
            homed = [letter for letter in AXES if letter in command.words] or list(AXES)
            unknown: dict[str, Any] = dict.fromkeys(map(str.lower, homed), NAN)
            return replace(state, **unknown)
        case _ if command.code[1:].isdigit():
            return replace(state, tool=int(command.code[1:]))
        case _:
            return state


def _retraction(before: State, extruded: Floats, commands: tuple[Command, ...]) -> dict[str, Any]:
    """Return how far the filament is drawn back at the end, and whether by firmware."""
    total = np.cumsum(np.append(-before.retracted, extruded))
    retracted = round(float(max(0.0, total.max()) - total[-1]), 9)
    firmware = before.firmware_retracted
    for command in commands:
        if command.code in ("G10", "G11") and not {"S", "P", "L"} & set(command.words):
            firmware = command.code == "G10"
    return {"retracted": retracted, "firmware_retracted": firmware}
