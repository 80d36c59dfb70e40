"""Lines of G-code as arrays: what each line is, and where the machine stands after it.

Moves are read many at a time with NumPy; the rare lines that change how moves are meant (G90, M82, G92 …) are read one
by one, and cut the batch into stretches in which nothing changes. Units and offsets are those of the file: a position
is what the words say, as the machine is told.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.gcode.numbers import MOST_DIGITS, SEMICOLON, SPACE, TAB, read_numbers

Floats = NDArray[np.float64]

# What a line is. Only the first two are ever drawn; ODD is a line that could not be read for certain.
OTHER, MOVE, ARC, COMMENT, BLANK, ODD = range(6)
NAN = float("nan")
AXES = "XYZ"
WORDS = "XYZEFIJ"
_LETTERS = np.full(256, -1, dtype=np.int8)
for _place, _letter in enumerate(WORDS):
    _LETTERS[ord(_letter)] = _LETTERS[ord(_letter.lower())] = _place
_COMMAND = re.compile(rb"\s*(?:[Nn]\d+\s*)?([A-Za-z])(\d{1,6}(?:\.\d{1,3})?)")
_WORD = re.compile(rb"([A-Za-z])([-+]?(?:\d+\.?\d*|\.\d+))?")


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
class Command:
    """One line that is neither a move nor a comment.

    Parameters
    ----------
    line : int
        Its number in the table.
    code : str
        Such as "M204" or "T0"; for a line that does not begin with one, its first word.
    words : dict
        The numbers by letter, None where a letter has no number; read only for codes that take such words.
    """

    line: int
    code: str
    words: dict[str, float | None]


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
    text = np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8)
    start = np.concatenate([[0], np.flatnonzero(text == ord("\n")) + 1])
    start[-1] = len(data)
    lines = len(start) - 1 if len(data) else 0
    start = start[: lines + 1]
    kind, code, begin, numbered = _kinds(text, start)
    values, given = _words(text, start, kind, begin)
    commands = tuple(_commands(data, start, kind))
    return _replayed(data, start, kind, code, numbered, values, given, commands, state)


def _kinds(
    text: NDArray[np.uint8], start: NDArray[np.int64]
) -> tuple[NDArray[np.uint8], NDArray[np.int8], NDArray[np.int64], NDArray[np.bool_]]:
    """Return the kind of every line, its code, where its words begin, and whether it has a line number."""
    first = start[:-1].copy()
    last = len(text) - 1

    def byte(offset: int = 0) -> NDArray[np.uint8]:
        return text[np.minimum(first + offset, last)]

    blank = byte() <= SPACE
    for _ in range(8):  # indented lines are rare; deeper ones are odd
        inner = (byte() == SPACE) | (byte() == TAB)  # a line end is neither, and the text ends with one
        if not inner.any():
            break
        first += inner
    numbered = (byte() | 0x20) == ord("n")
    if numbered.any():
        numbered &= _is_digit(byte(1))
        first += numbered
        for _ in range(10):
            first += numbered & _is_digit(byte())
        for _ in range(8):
            inner = numbered & ((byte() == SPACE) | (byte() == TAB))
            if not inner.any():
                break
            first += inner
    head = byte()
    kind = np.full(len(first), OTHER, dtype=np.uint8)
    kind[head == SEMICOLON] = COMMENT
    kind[(head == ord("\n")) | (head == ord("\r"))] = BLANK
    kind[blank & ((head == SPACE) | (head == TAB))] = ODD
    one, two = byte(1), byte(2)
    padded = (one == ord("0")) & _is_digit(two)  # G01
    digit = np.where(padded, two, one)
    ends = np.where(padded, byte(3), two)
    plain = ((head | 0x20) == ord("g")) & (digit >= ord("0")) & (digit <= ord("3")) & ~_is_digit(ends)
    plain &= ends != ord(".")
    code = np.where(plain, digit.astype(np.int16) - ord("0"), -1).astype(np.int8)
    kind[plain & (digit <= ord("1"))] = MOVE
    kind[plain & (digit >= ord("2"))] = ARC
    return kind, code, first + 2 + padded, numbered


def _is_digit(byte: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return (byte >= ord("0")) & (byte <= ord("9"))


def _words(
    text: NDArray[np.uint8], start: NDArray[np.int64], kind: NDArray[np.uint8], begin: NDArray[np.int64]
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the numbers of the words X Y Z E F I J of moves and arcs, NaN where there is none; mark ODD lines."""
    lines = len(kind)
    values = np.full((lines, len(WORDS)), np.nan)
    moving = (kind == MOVE) | (kind == ARC)
    if not moving.any():
        return values, np.zeros(values.shape, dtype=bool)
    marks = np.flatnonzero((text == SEMICOLON) | (text == ord("(")) | (text == ord("*")))
    ends = start[1:].copy()  # of the words: where a comment or a checksum begins
    if len(marks):
        of, earliest = np.unique(np.searchsorted(start, marks, side="right") - 1, return_index=True)
        ends[of] = marks[earliest]
    begin = np.minimum(begin, ends)
    # Words begin at a letter; everything in between is digits, signs, points and spaces, or the line is odd.
    other = np.flatnonzero(((text | 0x20) >= ord("a")) | (text == ord("=")) | (text == ord('"')) | (text == ord(":")))
    of = np.searchsorted(start, other, side="right") - 1
    inside = (of < lines) & (other >= begin[np.minimum(of, lines - 1)]) & (other < ends[np.minimum(of, lines - 1)])
    place, line = other[inside], of[inside]
    some = moving[line]
    place, line = place[some], line[some]
    word = _LETTERS[text[place]]
    after = place + 1
    spaced = text[np.minimum(after, len(text) - 1)] == SPACE
    number, good = read_numbers(text, after + spaced)
    known = word >= 0
    strange = np.zeros(lines, dtype=bool)
    strange[line[~known | ~good]] = True
    line, word, number = line[known], word[known], number[known]
    flat = line * len(WORDS) + word
    values.ravel()[flat] = number
    if np.bincount(line, minlength=1).sum() != np.count_nonzero(_present(flat, values.size)):
        again = np.bincount(flat, minlength=values.size).reshape(values.shape)
        strange |= (again > 1).any(axis=1)
    kind[moving & strange] = ODD
    values[kind == ODD] = np.nan
    return values, ~np.isnan(values)


def _present(flat: NDArray[np.int64], size: int) -> NDArray[np.bool_]:
    there = np.zeros(size, dtype=bool)
    there[flat] = True
    return there


def _commands(data: bytes, start: NDArray[np.int64], kind: NDArray[np.uint8]) -> Iterator[Command]:
    for line in np.flatnonzero((kind == OTHER) | (kind == ODD)).tolist():
        text = data[start[line] : min(start[line + 1], start[line] + 4096)]
        found = _COMMAND.match(text)
        if found is None:
            word = text.split(None, 1)
            yield Command(line=line, code=word[0].decode("latin-1") if word else "", words={})
            continue
        letter, number = found[1].decode().upper(), found[2].decode()
        code = letter + (number if "." in number else str(int(number)))
        words = {} if letter == "T" else _numbers(text[found.end() :].split(b";", 1)[0])
        yield Command(line=line, code=code, words=words)


def _numbers(text: bytes) -> dict[str, float | None]:
    """Return the numbers of a command by letter."""
    return {
        found[1].decode().upper(): float(found[2]) if found[2] and len(found[2]) <= MOST_DIGITS else None
        for found in _WORD.finditer(text)
    }


def _replayed(
    data: bytes,
    start: NDArray[np.int64],
    kind: NDArray[np.uint8],
    code: NDArray[np.int8],
    numbered: NDArray[np.bool_],
    values: Floats,
    given: NDArray[np.bool_],
    commands: tuple[Command, ...],
    before: State,
) -> Table:
    """Follow the moves from `before`, stretch by stretch between commands that change how they are meant."""
    lines = len(kind)
    where = {name: np.empty(lines) for name in ("x", "y", "z", "e")}
    extruded = np.zeros(lines)
    relative_e = np.zeros(lines, dtype=bool)
    feed = _held(values[:, 4], before.f)
    state, first = before, 0
    for command in (*commands, None):
        if command is not None and not _changes_moves(command):
            continue
        last = lines if command is None else command.line
        state = _stretch(slice(first, last), values, where, extruded, state)
        relative_e[first:last] = state.relative_e or state.relative
        if command is not None:
            state = _changed(state, command)
            for name in where:
                where[name][last] = getattr(state, name)
            relative_e[last] = state.relative_e or state.relative
            first = last + 1
    after = replace(state, f=float(feed[-1]) if lines else before.f)
    after = replace(after, **_retraction(before, extruded, commands))
    return Table(
        data=data,
        start=start,
        kind=kind,
        code=code,
        numbered=numbered,
        **where,
        f=feed,
        extruded=extruded,
        given=given,
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
