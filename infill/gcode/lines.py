"""Lines of G-code as arrays: what each line is, and the numbers of its words, many at a time with NumPy."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.checks import FARTHEST
from infill.gcode.numbers import MINUS, MOST_DIGITS, PLUS, POINT, SEMICOLON, SPACE, TAB, read_numbers
from infill.gcode.unusual_moves import may_move, read_move

Floats = NDArray[np.float64]

# What a line is. Only MOVE and ARC are ever drawn; ODD is a line in an unusual spelling: if it can be read, it
# has values like the others, but its text holds more than they tell; if not, it is `unread`.
OTHER, MOVE, ARC, COMMENT, BLANK, ODD = range(6)
WORDS = "XYZEFIJ"
_PLACES = np.array([letter in "XYZIJ" for letter in WORDS] + [False])  # the last of letters that are none of these
_LETTERS = np.full(256, -1, dtype=np.int8)
for _place, _letter in enumerate(WORDS):
    _LETTERS[ord(_letter)] = _LETTERS[ord(_letter.lower())] = _place
_LETTER, _END = 1, 2  # what begins a word, and what ends the words of a line: a comment, a checksum
_SORTS = bytes(
    _END if byte in b";(*" else _LETTER if byte | 0x20 >= ord("a") or byte in b'=":' else 0 for byte in range(256)
)
_LINE_NUMBER = re.compile(rb"\s*(?:[Nn]\d+(?![\d.])\s*)?")
_COMMAND = re.compile(rb"([A-Za-z])(\d{1,6}(?:\.\d{1,3})?)")
_MOVE = re.compile(rb"\s*(?:[Nn]\d+\s*)?[Gg]\s*0*[0-3](?![\d.])")
LONGEST_MOVE = 4096  # bytes of a line that is read one at a time
_REMARKS = re.compile(rb"\s*(?:\([^()]*\)\s*)*(?:\*\s*\d+\s*)?")
_WORD = re.compile(rb"([A-Za-z])[ \t]*([-+]?(?:\d+\.?\d*|\.\d+))?")
_NAME = re.compile(rb"\bNAME\s*=\s*\"?([^\s\";]+)", re.IGNORECASE)
_BEHIND_RETURN = re.compile(rb"\r(?![\r\n])\s*(?:[Nn]\d+\s*)?[GgMmTt]\d")  # another line, as Marlin takes it
_BRACKETS = re.compile(rb"\([^()]*\)")


@dataclass(frozen=True, kw_only=True)
class Command:
    """One line that is neither a move nor a comment.

    Parameters
    ----------
    line : int
        Its number in the table.
    code : str
        Such as "M204" or "T0"; for a line that does not begin with one, its first word in capitals.
    words : dict
        The numbers by letter, None where a letter has no number; read only for codes that take such words.
    name : str
        What Klipper's commands that save and restore a state call it.
    """

    line: int
    code: str
    words: dict[str, float | None]
    name: str = ""


@dataclass(frozen=True, kw_only=True)
class Lines:
    """A batch of lines as they stand, each on its own.

    Parameters
    ----------
    start : (N + 1,) int64
        Where each line begins in the text; the last entry is its length.
    kind : (N,) uint8
        OTHER, MOVE (G0, G1), ARC (G2, G3), COMMENT, BLANK or ODD.
    code : (N,) int8
        0 to 3 for G0 to G3, -1 else.
    numbered : (N,) bool
        The line begins with a line number, N12.
    values : (N, 7) float64
        The numbers of the words X, Y, Z, E, F, I, J of moves and arcs; NaN where there is none.
    given : (N, 7) bool
        Which of these words the line has.
    commands : tuple of Command
        The lines that are OTHER or ODD.
    unread : (N,) bool
        Lines that may move or extrude and could not be read.
    further : dict of int to dict of str to float
        By line, the words K, R, P, A and B of those ODD lines that have one.
    """

    start: NDArray[np.int64]
    kind: NDArray[np.uint8]
    code: NDArray[np.int8]
    numbered: NDArray[np.bool_]
    values: Floats
    given: NDArray[np.bool_]
    commands: tuple[Command, ...]
    unread: NDArray[np.bool_]
    further: dict[int, dict[str, float]]

    def __len__(self) -> int:
        return len(self.kind)


def lines_of(data: bytes) -> Lines:
    r"""Tell what each line of a text is.

    Parameters
    ----------
    data : bytes
        Lines with their line ends; only the last may lack one.

    >>> lines = lines_of(b"M204 S500\nG1 X1 E.5\n; a comment\n")
    >>> lines.kind.tolist(), lines.values[1, [0, 3]].tolist(), lines.commands[0].words
    ([0, 1, 3], [1.0, 0.5], {'S': 500.0})
    """
    text = np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8)
    start = np.concatenate([[0], np.flatnonzero(text == ord("\n")) + 1])
    start[-1] = len(data)
    lines = len(start) - 1 if len(data) else 0
    start = start[: lines + 1]
    kind, code, begin, numbered = _kinds(text, start)
    values, given = _values(text, start, kind, begin)
    unread, further = _unusual(data, start, kind, code, values, given)
    commands = tuple(_commands(data, start, kind))
    for command in commands:
        line = command.line
        if kind[line] == OTHER and may_move(command.code, data[start[line] : start[line + 1]]):
            unread[line] = True
    if data.count(b"\r") > data.count(b"\r\n"):
        inner = [found.start() for found in _BEHIND_RETURN.finditer(data)]
        unread[np.searchsorted(start, inner, side="right") - 1] = True
    return Lines(
        start=start,
        kind=kind,
        code=code,
        numbered=numbered,
        values=values,
        given=given,
        commands=commands,
        unread=unread,
        further=further,
    )


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


def _values(
    text: NDArray[np.uint8], start: NDArray[np.int64], kind: NDArray[np.uint8], begin: NDArray[np.int64]
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the numbers of the words of moves and arcs, NaN where there is none, and where one is; mark ODD lines."""
    lines = len(kind)
    values = np.full((lines, len(WORDS)), np.nan)
    moving = (kind == MOVE) | (kind == ARC)
    if not moving.any():
        return values, np.zeros(values.shape, dtype=bool)
    what = np.frombuffer(text.tobytes().translate(_SORTS), dtype=np.uint8)  # much quicker than an array of places
    marks = np.flatnonzero(what == _END)
    ends, stops = (
        start[1:].copy(),
        start[1:].copy(),
    )  # of the words: where a comment or a checksum begins; a comment alone
    if len(marks):
        for until, some in ((ends, marks), (stops, marks[text[marks] == SEMICOLON])):
            of, earliest = np.unique(np.searchsorted(start, some, side="right") - 1, return_index=True)
            until[of] = some[earliest]
    begin = np.minimum(begin, ends)
    # Words begin at a letter; everything in between is digits, signs, points and spaces, or the line is odd.
    other = np.flatnonzero(what == _LETTER)
    of = np.repeat(np.arange(lines), np.diff(start))[other[: np.searchsorted(other, start[-1])]]
    some = moving[of]
    place, line = other[: len(of)][some], of[some]
    inside = (place >= begin[line]) & (place < ends[line])
    strange = np.zeros(lines, dtype=bool)
    for behind in np.unique(line[(place >= ends[line]) & (place < stops[line])]).tolist():
        strange[behind] = not _REMARKS.fullmatch(text[ends[behind] : stops[behind]].tobytes())
    place, line = place[inside], line[inside]
    word = _LETTERS[text[place]]
    after = place + 1
    spaced = text[np.minimum(after, len(text) - 1)] == SPACE
    number, good = read_numbers(text, after + spaced)
    known = word >= 0
    # An E behind a digit is a word, as Marlin and Klipper take it, unless it looks like an exponent.
    exponent = np.flatnonzero(word == WORDS.index("E"))
    front, back = text[place[exponent] - 1], text[after[exponent]]
    digit = _is_digit(front) | (front == POINT)
    doubtful = digit & ((text[place[exponent]] == ord("e")) | (back == MINUS) | (back == PLUS))
    strange[line[exponent[doubtful]]] = True
    strange[line[~known | ~good]] = True
    strange[line[_PLACES[word] & (np.abs(number) > FARTHEST)]] = True
    flat = line[known] * len(WORDS) + word[known]
    values.ravel()[flat] = number[known]
    given = np.zeros(values.shape, dtype=bool)
    given.ravel()[flat] = True
    if np.count_nonzero(given) != len(flat):  # a word that stands twice
        again = np.bincount(flat, minlength=values.size).reshape(values.shape)
        strange |= (again > 1).any(axis=1)
    odd = moving & strange
    kind[odd] = ODD
    values[odd] = np.nan
    given[odd] = False
    return values, given


def _unusual(
    data: bytes,
    start: NDArray[np.int64],
    kind: NDArray[np.uint8],
    code: NDArray[np.int8],
    values: Floats,
    given: NDArray[np.bool_],
) -> tuple[NDArray[np.bool_], dict[int, dict[str, float]]]:
    """Read ODD lines one by one into `code`, `values` and `given`; return the moves among them that cannot be read.

    Returns
    -------
    unread : (N,) bool
    further : dict of int to dict of str to float
    """
    unread = np.zeros(len(kind), dtype=bool)
    further: dict[int, dict[str, float]] = {}
    lacking = (kind == ARC) & ~(given[:, WORDS.index("I")] | given[:, WORDS.index("J")])
    kind[lacking] = ODD
    values[lacking], given[lacking] = np.nan, False
    for line in np.flatnonzero(kind == ODD).tolist():
        text = data[start[line] : start[line + 1]]
        found = read_move(text) if len(text) <= LONGEST_MOVE else None
        if found is None:
            unread[line] = _MOVE.match(text) is not None
            continue
        code[line], words = found
        for letter, value in words.items():
            if letter in WORDS:
                values[line, WORDS.index(letter)] = value
                given[line, WORDS.index(letter)] = True
            else:
                further.setdefault(line, {})[letter] = value
    return unread, further


def _commands(data: bytes, start: NDArray[np.int64], kind: NDArray[np.uint8]) -> Iterator[Command]:
    for line in np.flatnonzero((kind == OTHER) | (kind == ODD)).tolist():
        text = data[start[line] : min(start[line + 1], start[line] + 4096)]
        number = _LINE_NUMBER.match(text)
        place = number.end() if number else 0
        found = _COMMAND.match(text, place)
        if found is None:
            word = text[place:].split(None, 1)
            code = word[0].decode("latin-1").upper() if word else ""
            label = _NAME.search(word[1]) if code.endswith("_GCODE_STATE") and len(word) > 1 else None
            yield Command(line=line, code=code, words={}, name=label[1].decode("latin-1") if label else "")
            continue
        letter, digits = found[1].decode().upper(), found[2].decode()
        code = letter + (digits if "." in digits else str(int(digits)))
        words = {} if letter == "T" else _numbers(text[found.end() :].split(b";", 1)[0])
        yield Command(line=line, code=code, words=words)


def _numbers(text: bytes) -> dict[str, float | None]:
    """Return the numbers of a command by letter."""
    text = _BRACKETS.sub(b" ", text) if b"(" in text else text
    return {
        found[1].decode().upper(): float(found[2]) if found[2] and len(found[2]) <= MOST_DIGITS else None
        for found in _WORD.finditer(text)
    }
