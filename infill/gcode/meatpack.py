"""MeatPack: the fifteen characters that G-code is mostly made of take four bits each.

    0-9  .  E  newline  G  X       two to a byte, the first in the lower half
    half = 15                      this character follows as a whole byte, before the next pair
    255 255 command                251 packing on, 250 off, 249 reset, 247 no spaces (half 11 is E), 246 spaces

After a newline in the lower half the upper half means nothing. With no spaces, the words of a line that starts
with G are packed without blanks before them, and the reader puts those blanks back. Facts from the MeatPack
documentation (https://github.com/scottmudge/OctoPrint-MeatPack) and from what Prusa's tools write and read.

What cannot come back from packed text, so that `normalised` leaves it out first: blank lines, blanks at both
ends of a command, comments behind a command, several blanks (or none) before a word of a G line, and without
`comments` every comment. Lines that would come back changed all the same stand between "off" and "on" as they are.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError

Bytes = NDArray[np.uint8]
Flags = NDArray[np.bool_]

SIGNAL = b"\xff\xff"
PACKED, PLAIN, RESET, QUERY, NO_SPACES, SPACES = 251, 250, 249, 248, 247, 246
COMMANDS = (PACKED, PLAIN, RESET, QUERY, NO_SPACES, SPACES)
BEGIN = SIGNAL + bytes([PACKED]) + SIGNAL + bytes([NO_SPACES])
ALPHABET = b"0123456789.E\nGX"
WHOLE = 15
CHARACTERS = np.frombuffer(ALPHABET.replace(b"E", b" ") + b"\0" + ALPHABET + b"\0", np.uint8).reshape(2, 16)
NEWLINE, BLANK, SEMICOLON, G = b"\n"[0], b" "[0], b";"[0], b"G"[0]


def _table(characters: bytes) -> Flags:
    table = np.zeros(256, np.bool_)
    table[list(characters)] = True
    return table


HALVES = np.full(256, WHOLE, np.uint8)
HALVES[list(ALPHABET)] = np.arange(WHOLE)
PADDING = HALVES[NEWLINE] * 17  # two newlines, read as one
WORDS = _table(b"XYZEFIJRGPWHCAS")  # letters before which readers put a blank back
DROPPED = _table(b"XYZEFIJR")  # those that every reader knows: only their blanks are left out
BLANKS = _table(b" \t\r\n")
ODD = _table(b'"\xff')
DIGITS = _table(b"0123456789")


def unpacked(data: bytes) -> bytes:
    r"""Give back the text of one packed block.

    Raises
    ------
    FormatError
        The block ends within a character, or holds an unknown command.

    Examples
    --------
    >>> unpacked(packed(b"G1 X1.5 Y2\n;TYPE:Internal infill\nM106 S255\n"))
    b'G1 X1.5 Y2\n;TYPE:Internal infill\nM106 S255\n'
    """
    size = len(data)
    if not size:
        return b""
    code = np.frombuffer(data + b"\0\0", np.uint8)
    packing, spaceless, skipped = _commands(data)
    low, high = code[:size] & 15, code[:size] >> 4
    line_ends = packing & (low == HALVES[NEWLINE])
    low_whole = packing & (low == WHOLE)
    high_whole = packing & (high == WHOLE) & ~line_ends
    steps = 1 + low_whole + high_whole + skipped
    heads = _reached(steps)
    if heads[-1] + steps[heads[-1]] > size:
        raise FormatError("MeatPack data ends within a character; it is damaged")
    if np.count_nonzero(skipped[heads]) != np.count_nonzero(skipped):
        raise FormatError("MeatPack data has a command within a character; it is damaged")
    heads = heads[skipped[heads] == 0]
    first, second, plain = low_whole[heads], high_whole[heads], ~packing[heads]
    meaning = spaceless[heads]
    text = np.empty((len(heads), 2), np.uint8)
    there = np.ones((len(heads), 2), np.bool_)
    text[:, 0] = np.where(first, code[heads + 1], CHARACTERS[meaning, low[heads]])
    text[:, 0][plain] = code[heads[plain]]
    text[:, 1] = np.where(second, code[heads + 1 + first], CHARACTERS[meaning, high[heads]])
    there[:, 1] = ~(plain | line_ends[heads])
    result, plain = text[there], np.repeat(plain, 2).reshape(-1, 2)[there]
    # An empty line can be padding: readers skip it, so that packed text has none.
    empty = ~plain & (result == NEWLINE) & (np.append(np.uint8(0), result[:-1]) == NEWLINE)
    result, plain = result[~empty], plain[~empty]
    if not len(result):
        return b""
    starts, line = _lines(result)
    return _spaced(result, ((result[starts] == G) & ~plain[starts])[line]).tobytes()


def packed(text: bytes, *, comments: bool = True) -> bytes:
    """Pack text that is `normalised` with the same `comments`; the last line ends with a newline.

    libbgcode loses characters of a block that unpacks to more than twice its size. So a G line whose newline
    comes second in its byte is padded with an empty line, as libbgcode does itself, and blanks are left out only
    where the block stays large enough even so.
    """
    if not text:
        return BEGIN
    code = np.frombuffer(text, np.uint8)
    starts, line = _lines(code)
    lines = _survey(code, starts)
    plain, moves = (lines.odd | lines.comments)[line], lines.moves[line]
    blanks = (code == BLANK) & DROPPED[np.append(code[1:], np.uint8(0))] & moves
    end = b"" if comments else SIGNAL + bytes([RESET])
    result = _packed(code[~blanks], plain[~blanks], moves[~blanks]) + end
    return result if 2 * len(result) > len(text) + 1 else _packed(code, plain, moves) + end


def _packed(code: Bytes, plain: Flags, moves: Flags) -> bytes:
    starts, line = _lines(code)
    within = np.arange(len(code)) - starts[line]
    after = np.append(code[1:], np.uint8(NEWLINE))
    after[code == NEWLINE] = NEWLINE
    switched = np.diff(plain, prepend=np.False_)

    unit = np.flatnonzero(plain | (within % 2 == 0))
    plain, moves, first, second = plain[unit], moves[unit], code[unit], after[unit]
    low, high = HALVES[first], HALVES[second]
    # Of each unit at most: a command, the byte, the characters that follow it whole, and padding.
    rows = np.empty((len(unit), 7), np.uint8)
    there = np.empty(rows.shape, np.bool_)
    rows[:, :2], rows[:, 2] = SIGNAL[0], np.where(plain, PLAIN, PACKED)
    there[:, :3] = switched[unit, None]
    rows[:, 3], there[:, 3] = np.where(plain, first, high << 4 | low), True
    rows[:, 4], there[:, 4] = first, ~plain & (low == WHOLE)
    rows[:, 5], there[:, 5] = second, ~plain & (high == WHOLE)
    rows[:, 6], there[:, 6] = PADDING, moves & (first != NEWLINE) & (second == NEWLINE)
    return BEGIN + rows[there].tobytes()


def normalised(text: bytes, *, comments: bool = True) -> bytes:
    r"""Leave out of a text what packing would lose: the text that comes back.

    Examples
    --------
    >>> normalised(b"G1X1  Y2 ; a move\n\n; whole\nGRAB  BOX ; as it is\n")
    b'G1 X1 Y2\n; whole\nGRAB  BOX ; as it is\n'
    """
    if not text:
        return b""
    code = np.frombuffer(text if text.endswith(b"\n") else text + b"\n", np.uint8)
    starts, line = _lines(code)
    lines = _survey(code, starts)
    place = np.arange(len(code))
    last = np.maximum.reduceat(np.where(_ink(code) & (place < lines.remark[line]), place, -1), starts)
    whole = lines.odd | lines.comments if comments else lines.odd
    last[whole] = np.append(starts[1:], len(code))[whole] - 1
    first = np.where(lines.odd, starts, lines.first)
    keep = (place >= first[line]) & (place <= last[line]) | (code == NEWLINE) & (last >= 0)[line]
    moves, code = lines.moves[line][keep], code[keep]
    doubled = moves & (code == BLANK) & (np.append(code[1:], np.uint8(0)) == BLANK)
    return _spaced(code[~doubled], moves[~doubled]).tobytes()


class _Lines(NamedTuple):
    """What is on each line: the place of the first character that is no blank, and of the first semicolon."""

    first: NDArray[np.int64]
    remark: NDArray[np.int64]
    comments: Flags  # nothing but a comment
    moves: Flags  # G and a digit: blanks before the words come and go
    odd: Flags  # readers would change it: G and no digit, or a string, in which a semicolon may be no comment


def _survey(code: Bytes, starts: NDArray[np.int64]) -> _Lines:
    count = len(code)
    place = np.arange(count)

    def nearest(flags: Flags) -> NDArray[np.int64]:
        return np.minimum.reduceat(np.where(flags, place, count), starts)

    first, remark = nearest(_ink(code)), nearest(code == SEMICOLON)
    padded = np.append(code, np.zeros(2, np.uint8))
    g, digit = padded[first] == G, DIGITS[padded[first + 1]]
    odd = (g & ~digit) | (nearest(ODD[code]) < remark)
    return _Lines(first, remark, (first == remark) & (first < count), g & digit & ~odd, odd)


def _ink(code: Bytes) -> Flags:
    ink: Flags = ~BLANKS[code]
    return ink


def _commands(data: bytes) -> tuple[Flags, NDArray[np.int64], NDArray[np.int64]]:
    """Tell for each byte whether it is packed, whether half 11 is E (1), and at a command how many bytes to skip."""
    size = len(data)
    packing = np.zeros(size, np.bool_)
    spaceless = np.zeros(size, np.int64)
    skipped = np.zeros(size, np.int64)
    on = no_spaces = False
    after = 0
    for found in re.finditer(rb"\xff\xff(.?)", data, re.DOTALL):
        packing[after : found.start()], spaceless[after : found.start()] = on, no_spaces
        command = found[1][0] if found[1] else -1
        if command not in COMMANDS:
            raise FormatError(f"MeatPack data has command {command}, and only 246 to 251 are known; it is damaged")
        on = command == PACKED or (on and command not in (PLAIN, RESET))
        no_spaces = command == NO_SPACES or (no_spaces and command not in (SPACES, RESET))
        skipped[found.start()] = 2
        after = found.end()
    packing[after:], spaceless[after:] = on, no_spaces
    return packing, spaceless, skipped


def _reached(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Walk from place 0, each place telling the step to the next, by doubling: list the places walked on."""
    size = len(steps)
    jump = np.minimum(np.arange(size) + steps, size)
    jump = np.append(jump, size)
    walked = np.zeros(size + 1, np.bool_)
    walked[0] = True
    for _ in range(size.bit_length()):
        walked[jump[walked]] = True
        jump = jump[jump]
    return np.flatnonzero(walked[:size])


def _lines(code: Bytes) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Tell where each line starts, and which line each byte is on."""
    newline = code == NEWLINE
    starts = np.append(0, np.flatnonzero(newline[:-1]) + 1)
    return starts, np.cumsum(newline) - newline


def _spaced(code: Bytes, moves: Flags) -> Bytes:
    """Put a blank before every word of the lines that are moves, where there is none."""
    before = np.append(np.uint8(NEWLINE), code[:-1])
    bare = moves & WORDS[code] & (before != BLANK) & (before != NEWLINE)
    return np.insert(code, np.flatnonzero(bare), np.uint8(BLANK))
