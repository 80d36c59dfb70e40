"""Lines of G-code as arrays: the kind of each line, and the numbers of its words, many at a time with NumPy."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.checks import FARTHEST
from infill.gcode.numbers import MAX_DIGITS, MINUS, PLUS, POINT, POWERS, SEMICOLON, SPACE, TAB, read_numbers
from infill.gcode.unusual_moves import may_move, read_move
from infill.kernels.compiling import is_compiler_loaded, log_compilation

# Kinds of lines. Only MOVE and ARC are ever drawn; ODD is a line in an unusual spelling: if it is readable, it
# has values like the others, but its text holds more than they state; if not, it is `unread`.
OTHER, MOVE, ARC, COMMENT, BLANK, ODD = range(6)
WORDS = "XYZEFIJ"
_PLACES = np.array([letter in "XYZIJ" for letter in WORDS] + [False])  # the last of letters that are none of these
_LETTERS = np.full(256, -1, dtype=np.int8)
for _place, _letter in enumerate(WORDS):
    _LETTERS[ord(_letter)] = _LETTERS[ord(_letter.lower())] = _place
_LETTER, _END = 1, 2  # begin of a word, and end of the words of a line: a comment, a checksum
_SORTS = bytes(
    _END if byte in b";(*" else _LETTER if byte | 0x20 >= ord("a") or byte in b'=":' else 0 for byte in range(256)
)
_LINE_NUMBER = re.compile(rb"\s*(?:[Nn]\d+(?![\d.])\s*)?")
_COMMAND = re.compile(rb"([A-Za-z])(\d{1,6}(?:\.\d{1,3})?)")
_MOVE = re.compile(rb"\s*(?:[Nn]\d+\s*)?[Gg]\s*0*[0-3](?![\d.])")
MAX_MOVE_BYTES = 4096  # bytes of a line that is read on its own
_WORDS_END = re.compile(rb"[;(*]")
_REMARKS = re.compile(rb"\s*(?:\([^()]*\)\s*)*(?:\*\s*\d+\s*)?")
_WORD = re.compile(rb"([A-Za-z])[ \t]*([-+]?(?:\d+\.?\d*|\.\d+))?")
_NAME = re.compile(rb"\bNAME\s*=\s*\"?([^\s\";]+)", re.IGNORECASE)
_BEHIND_RETURN = re.compile(rb"\r(?![\r\n])\s*(?:[Nn]\d+\s*)?[GgMmTt]\d")  # a separate line, as in Marlin
_BRACKETS = re.compile(rb"\([^()]*\)")


@dataclass(frozen=True, kw_only=True)
class GcodeCommand:
    """One line other than a move or a comment.

    Parameters
    ----------
    line : int
        Its number in the table.
    code : str
        Such as "M204" or "T0"; for a line that does not begin with one, its first word in capitals.
    words : dict
        The numbers by letter, None where a letter has no number; read only for codes that take such words.
    name : str
        Name of the state, in Klipper's commands that save and restore one.
    """

    line: int
    code: str
    words: dict[str, float | None]
    name: str = ""


@dataclass(frozen=True, kw_only=True)
class ParsedLines:
    """A batch of lines, each without the effect of the others.

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
        Words that the line has.
    commands : tuple of GcodeCommand
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
    commands: tuple[GcodeCommand, ...]
    unread: NDArray[np.bool_]
    further: dict[int, dict[str, float]]

    def __len__(self) -> int:
        return len(self.kind)


def parse_lines(data: bytes) -> ParsedLines:
    r"""Parse each line of a text.

    Parameters
    ----------
    data : bytes
        Lines with their line ends; only the last may lack one.

    >>> lines = parse_lines(b"M204 S500\nG1 X1 E.5\n; a comment\n")
    >>> lines.kind.tolist(), lines.values[1, [0, 3]].tolist(), lines.commands[0].words
    ([0, 1, 3], [1.0, 0.5], {'S': 500.0})
    """
    text = np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8)
    start = np.concatenate([[0], np.flatnonzero(text == ord("\n")) + 1])
    start[-1] = len(data)
    lines = len(start) - 1 if len(data) else 0
    start = start[: lines + 1]
    read = read_compiled_lines if is_compiler_loaded() else read_plain_lines
    kind, code, numbered, values, has_word = read(text, start)
    unread, further = _read_odd_lines(data, start, kind, code, values, has_word)
    commands = tuple(_read_commands(data, start, kind))
    for command in commands:
        line = command.line
        if kind[line] == OTHER and may_move(command.code, data[start[line] : start[line + 1]]):
            unread[line] = True
    returns = data.count(b"\r")
    if returns and returns > data.count(b"\r\n"):
        inner = [match.start() for match in _BEHIND_RETURN.finditer(data)]
        unread[np.searchsorted(start, inner, side="right") - 1] = True
    return ParsedLines(
        start=start,
        kind=kind,
        code=code,
        numbered=numbered,
        values=values,
        given=has_word,
        commands=commands,
        unread=unread,
        further=further,
    )


def fill_missing(values: Floats, by: float) -> Floats:
    """Return values with another one in the place of those that are NaN.

    >>> fill_missing(np.array([1.0, np.nan]), 0.0).tolist()
    [1.0, 0.0]
    """
    return np.where(np.isnan(values), by, values)


def read_plain_lines(
    text: NDArray[np.uint8], start: NDArray[np.int64]
) -> tuple[NDArray[np.uint8], NDArray[np.int8], NDArray[np.bool_], Floats, NDArray[np.bool_]]:
    """Read the lines of a text with NumPy; return `kind`, `code`, `numbered`, `values` and `given` of `ParsedLines`.

    Parameters
    ----------
    text : (B,) uint8
        Ends with a line end.
    start : (N + 1,) int64
    """
    kind, code, begin, numbered = _classify_lines(text, start)
    values, has_word = _read_values(text, start, kind, begin)
    return kind, code, numbered, values, has_word


def read_compiled_lines(
    text: NDArray[np.uint8], start: NDArray[np.int64]
) -> tuple[NDArray[np.uint8], NDArray[np.int8], NDArray[np.bool_], Floats, NDArray[np.bool_]]:
    """Read the lines of a text as `read_plain_lines` does, byte by byte, in compiled code."""
    from infill.kernels.gcode_lines import read_lines

    lines = len(start) - 1
    kind, code = np.zeros(lines, dtype=np.uint8), np.empty(lines, dtype=np.int8)
    values, has_word = np.empty((lines, len(WORDS))), np.zeros((lines, len(WORDS)), dtype=bool)
    numbered, behind = np.zeros(lines, dtype=bool), np.zeros(lines, dtype=bool)
    with log_compilation("the reader of prints"):
        read_lines(
            text, start, _LETTERS, _PLACES[:-1], POWERS, float(FARTHEST), kind, code, numbered, values, has_word, behind
        )
    for line in np.flatnonzero(behind).tolist():
        words = text[start[line] : start[line + 1]].tobytes()
        ends = _WORDS_END.search(words)
        if ends is not None and not _REMARKS.fullmatch(words[ends.start() :].split(b";", 1)[0]):
            kind[line], values[line], has_word[line] = ODD, np.nan, False
    return kind, code, numbered, values, has_word


def _classify_lines(
    text: NDArray[np.uint8], start: NDArray[np.int64]
) -> tuple[NDArray[np.uint8], NDArray[np.int8], NDArray[np.int64], NDArray[np.bool_]]:
    """Return the kind of every line, its code, the begin of its words, and True where it has a line number."""
    begin = start[:-1].copy()
    last_byte = len(text) - 1

    def byte(offset: int = 0) -> NDArray[np.uint8]:
        """Return the byte of each line at an offset from where its text begins."""
        return text[np.minimum(begin + offset, last_byte)]

    blank = byte() <= SPACE
    for _ in range(8):  # indented lines are rare; deeper ones are odd
        inner = (byte() == SPACE) | (byte() == TAB)  # a line end is neither, and the text ends with one
        if not inner.any():
            break
        begin += inner
    numbered = (byte() | 0x20) == ord("n")
    if numbered.any():
        numbered &= _is_digit(byte(1))
        begin += numbered
        for _ in range(10):
            begin += numbered & _is_digit(byte())
        for _ in range(8):
            inner = numbered & ((byte() == SPACE) | (byte() == TAB))
            if not inner.any():
                break
            begin += inner
    head = byte()
    kind = np.full(len(begin), OTHER, dtype=np.uint8)
    kind[head == SEMICOLON] = COMMENT
    kind[(head == ord("\n")) | (head == ord("\r"))] = BLANK
    kind[blank & ((head == SPACE) | (head == TAB))] = ODD
    byte_1, byte_2 = byte(1), byte(2)
    padded = (byte_1 == ord("0")) & _is_digit(byte_2)  # G01
    digit = np.where(padded, byte_2, byte_1)
    ends = np.where(padded, byte(3), byte_2)
    plain = ((head | 0x20) == ord("g")) & (digit >= ord("0")) & (digit <= ord("3")) & ~_is_digit(ends)
    plain &= ends != ord(".")
    code = np.where(plain, digit.astype(np.int16) - ord("0"), -1).astype(np.int8)
    kind[plain & (digit <= ord("1"))] = MOVE
    kind[plain & (digit >= ord("2"))] = ARC
    return kind, code, begin + 2 + padded, numbered


def _is_digit(byte: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Tell for each byte whether it is a digit."""
    return (byte >= ord("0")) & (byte <= ord("9"))


def _read_values(
    text: NDArray[np.uint8], start: NDArray[np.int64], kind: NDArray[np.uint8], begin: NDArray[np.int64]
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the numbers of the words of moves and arcs, NaN if missing, and True for each word; mark ODD lines."""
    lines = len(kind)
    values = np.full((lines, len(WORDS)), np.nan)
    moving = (kind == MOVE) | (kind == ARC)
    if not moving.any():
        return values, np.zeros(values.shape, dtype=bool)
    sorts = np.frombuffer(text.tobytes().translate(_SORTS), dtype=np.uint8)  # much quicker than an array of places
    marks = np.flatnonzero(sorts == _END)
    ends, stops = (
        start[1:].copy(),
        start[1:].copy(),
    )  # of the words: where a comment or a checksum begins; a comment alone
    if len(marks):
        for until, selected in ((ends, marks), (stops, marks[text[marks] == SEMICOLON])):
            of, earliest = np.unique(np.searchsorted(start, selected, side="right") - 1, return_index=True)
            until[of] = selected[earliest]
    begin = np.minimum(begin, ends)
    # Words begin at a letter; everything in between is digits, signs, points and spaces, or the line is odd.
    letters = np.flatnonzero(sorts == _LETTER)
    of = np.repeat(np.arange(lines), np.diff(start))[letters[: np.searchsorted(letters, start[-1])]]
    selected = moving[of]
    place, line = letters[: len(of)][selected], of[selected]
    inside = (place >= begin[line]) & (place < ends[line])
    strange = np.zeros(lines, dtype=bool)
    for behind in np.unique(line[(place >= ends[line]) & (place < stops[line])]).tolist():
        strange[behind] = not _REMARKS.fullmatch(text[ends[behind] : stops[behind]].tobytes())
    place, line = place[inside], line[inside]
    word = _LETTERS[text[place]]
    after = place + 1
    spaced = text[np.minimum(after, len(text) - 1)] == SPACE
    number, good = read_numbers(text, after + spaced)
    is_known = word >= 0
    # An E behind a digit is a word, as Marlin and Klipper take it, unless it looks like an exponent.
    exponent = np.flatnonzero(word == WORDS.index("E"))
    front, back = text[place[exponent] - 1], text[after[exponent]]
    digit = _is_digit(front) | (front == POINT)
    doubtful = digit & ((text[place[exponent]] == ord("e")) | (back == MINUS) | (back == PLUS))
    strange[line[exponent[doubtful]]] = True
    strange[line[~is_known | ~good]] = True
    strange[line[_PLACES[word] & (np.abs(number) > FARTHEST)]] = True
    flat = line[is_known] * len(WORDS) + word[is_known]
    values.ravel()[flat] = number[is_known]
    has_word = np.zeros(values.shape, dtype=bool)
    has_word.ravel()[flat] = True
    if np.count_nonzero(has_word) != len(flat):  # a word that stands twice
        again = np.bincount(flat, minlength=values.size).reshape(values.shape)
        strange |= (again > 1).any(axis=1)
    odd = moving & strange
    kind[odd] = ODD
    values[odd] = np.nan
    has_word[odd] = False
    return values, has_word


def _read_odd_lines(
    data: bytes,
    start: NDArray[np.int64],
    kind: NDArray[np.uint8],
    code: NDArray[np.int8],
    values: Floats,
    has_word: NDArray[np.bool_],
) -> tuple[NDArray[np.bool_], dict[int, dict[str, float]]]:
    """Read ODD lines one by one into `code`, `values` and `given`; return the moves that cannot be read.

    Returns
    -------
    unread : (N,) bool
    further : dict of int to dict of str to float
    """
    unread = np.zeros(len(kind), dtype=bool)
    further: dict[int, dict[str, float]] = {}
    lacking = (kind == ARC) & ~fill_missing(values[:, [WORDS.index("I"), WORDS.index("J")]], 0.0).any(axis=1)
    kind[lacking] = ODD
    values[lacking], has_word[lacking] = np.nan, False
    for line in np.flatnonzero(kind == ODD).tolist():
        text = data[start[line] : start[line + 1]]
        move = read_move(text) if len(text) <= MAX_MOVE_BYTES else None
        if move is None:
            unread[line] = _MOVE.match(text) is not None
            continue
        code[line], words = move
        for letter, value in words.items():
            if letter in WORDS:
                values[line, WORDS.index(letter)] = value
                has_word[line, WORDS.index(letter)] = True
            else:
                further.setdefault(line, {})[letter] = value
    return unread, further


def _read_commands(data: bytes, start: NDArray[np.int64], kind: NDArray[np.uint8]) -> Iterator[GcodeCommand]:
    """Yield the commands on all lines other than plain moves, with their numbers or their name."""
    for line in np.flatnonzero((kind == OTHER) | (kind == ODD)).tolist():
        text = data[start[line] : min(start[line + 1], start[line] + 4096)]
        number = _LINE_NUMBER.match(text)
        place = number.end() if number else 0
        match = _COMMAND.match(text, place)
        if match is None:
            word = text[place:].split(None, 1)
            code = word[0].decode("latin-1").upper() if word else ""
            label = _NAME.search(word[1]) if code.endswith("_GCODE_STATE") and len(word) > 1 else None
            yield GcodeCommand(line=line, code=code, words={}, name=label[1].decode("latin-1") if label else "")
            continue
        letter, digits = match[1].decode().upper(), match[2].decode()
        code = letter + (digits if "." in digits else str(int(digits)))
        words = {} if letter == "T" else _parse_numbers(text[match.end() :].split(b";", 1)[0])
        yield GcodeCommand(line=line, code=code, words=words)


def _parse_numbers(text: bytes) -> dict[str, float | None]:
    """Return the numbers of a command by letter."""
    text = _BRACKETS.sub(b" ", text) if b"(" in text else text
    return {
        match[1].decode().upper(): float(match[2]) if match[2] and len(match[2]) <= MAX_DIGITS else None
        for match in _WORD.finditer(text)
    }
