"""MeatPack: packs the fifteen most frequent characters of G-code into four bits each.

    0-9  .  E  newline  G  X       two to a byte, the first in the lower half
    half = 15                      this character follows as a whole byte, before the next pair
    255 255 command                251 packing on, 250 off, 249 reset, 247 no spaces (half 11 is E), 246 spaces

After a newline in the lower half the upper half means nothing. With no spaces, the words of a line that starts
with G are packed without blanks before them, and the reader puts those blanks back. Facts from the MeatPack
documentation (https://github.com/scottmudge/OctoPrint-MeatPack) and from what Prusa's tools write and read.

Packed text loses blank lines, blanks at both ends of a command, comments behind a command, several blanks (or
none) before a word of a G line, and without `comments` every comment; `normalise_text` removes these first. Lines that
would still come back changed stand between "off" and "on" unchanged.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Flags
from infill.errors import FormatError

Bytes = NDArray[np.uint8]

SIGNAL = b"\xff\xff"
PACKED, PLAIN, RESET, QUERY, NO_SPACES, SPACES = 251, 250, 249, 248, 247, 246
COMMANDS = (PACKED, PLAIN, RESET, QUERY, NO_SPACES, SPACES)
BEGIN = SIGNAL + bytes([PACKED]) + SIGNAL + bytes([NO_SPACES])
ALPHABET = b"0123456789.E\nGX"
UNPACKED_HALF = 15
CHARACTERS = np.frombuffer(ALPHABET.replace(b"E", b" ") + b"\0" + ALPHABET + b"\0", np.uint8).reshape(2, 16)
NEWLINE, BLANK, SEMICOLON, G = b"\n"[0], b" "[0], b";"[0], b"G"[0]


def _table(characters: bytes) -> Flags:
    """Return a table of 256 flags, True for these characters."""
    table = np.zeros(256, np.bool_)
    table[list(characters)] = True
    return table


HALVES = np.full(256, UNPACKED_HALF, np.uint8)
HALVES[list(ALPHABET)] = np.arange(UNPACKED_HALF)
PADDING = HALVES[NEWLINE] * 17  # two newlines, read as one
WORDS = _table(b"XYZEFIJRGPWHCAS")  # letters before which readers restore a blank
DROPPED = _table(b"XYZEFIJR")  # letters that every reader knows: only their blanks are dropped
BLANKS = _table(b" \t\r\n")
ODD = _table(b'"\xff')
DIGITS = _table(b"0123456789")


def unpack_text(data: bytes) -> bytes:
    r"""Unpack the text of one packed block.

    Raises
    ------
    FormatError
        The block ends within a character, or holds an unknown command.

    Examples
    --------
    >>> unpack_text(pack_text(b"G1 X1.5 Y2\n;TYPE:Internal infill\nM106 S255\n"))
    b'G1 X1.5 Y2\n;TYPE:Internal infill\nM106 S255\n'
    """
    size = len(data)
    if not size:
        return b""
    code = np.frombuffer(data + b"\0\0", np.uint8)
    packing, spaceless, skipped = _read_commands(data)
    low, high = code[:size] & 15, code[:size] >> 4
    line_ends = packing & (low == HALVES[NEWLINE])
    low_whole = packing & (low == UNPACKED_HALF)
    high_whole = packing & (high == UNPACKED_HALF) & ~line_ends
    steps = 1 + low_whole + high_whole + skipped
    heads = _walk_steps(steps)
    if heads[-1] + steps[heads[-1]] > size:
        raise FormatError("MeatPack data ends within a character; it is damaged")
    if np.count_nonzero(skipped[heads]) != np.count_nonzero(skipped):
        raise FormatError("MeatPack data has a command within a character; it is damaged")
    heads = heads[skipped[heads] == 0]
    escapes_low, escapes_high, plain = low_whole[heads], high_whole[heads], ~packing[heads]
    meaning = spaceless[heads]
    text = np.empty((len(heads), 2), np.uint8)
    present = np.ones((len(heads), 2), np.bool_)
    text[:, 0] = np.where(escapes_low, code[heads + 1], CHARACTERS[meaning, low[heads]])
    text[:, 0][plain] = code[heads[plain]]
    text[:, 1] = np.where(escapes_high, code[heads + 1 + escapes_low], CHARACTERS[meaning, high[heads]])
    present[:, 1] = ~(plain | line_ends[heads])
    result, plain = text[present], np.repeat(plain, 2).reshape(-1, 2)[present]
    # An empty line can be padding: readers skip it, so packed text has none.
    empty = ~plain & (result == NEWLINE) & (np.append(np.uint8(0), result[:-1]) == NEWLINE)
    result, plain = result[~empty], plain[~empty]
    if not len(result):
        return b""
    starts, line = _find_lines(result)
    return _insert_blanks(result, ((result[starts] == G) & ~plain[starts])[line]).tobytes()


def pack_text(text: bytes, *, comments: bool = True) -> bytes:
    """Pack text that is `normalise_text` with the same `comments`; the last line ends with a newline.

    libbgcode loses characters of a block that unpacks to more than twice its size. So a G line whose newline
    comes second in its byte is padded with an empty line, as libbgcode does itself, and blanks are left out only
    where the block stays large enough even so.
    """
    if not text:
        return BEGIN
    code = np.frombuffer(text, np.uint8)
    starts, line = _find_lines(code)
    lines = _survey_lines(code, starts)
    plain, moves = (lines.odd | lines.comments)[line], lines.moves[line]
    blanks = (code == BLANK) & DROPPED[np.append(code[1:], np.uint8(0))] & moves
    end = b"" if comments else SIGNAL + bytes([RESET])
    result = _pack_codes(code[~blanks], plain[~blanks], moves[~blanks]) + end
    return result if 2 * len(result) > len(text) + 1 else _pack_codes(code, plain, moves) + end


def _pack_codes(code: Bytes, plain: Flags, moves: Flags) -> bytes:
    """Pack characters in pairs, with commands that switch packing on and off; `plain` marks what stays unpacked."""
    starts, line = _find_lines(code)
    within = np.arange(len(code)) - starts[line]
    after = np.append(code[1:], np.uint8(NEWLINE))
    after[code == NEWLINE] = NEWLINE
    switched = np.diff(plain, prepend=np.False_)

    unit = np.flatnonzero(plain | (within % 2 == 0))
    plain, moves, low_characters, high_characters = plain[unit], moves[unit], code[unit], after[unit]
    low, high = HALVES[low_characters], HALVES[high_characters]
    # Of each unit at most: a command, the byte, the characters that follow it whole, and padding.
    rows = np.empty((len(unit), 7), np.uint8)
    present = np.empty(rows.shape, np.bool_)
    rows[:, :2], rows[:, 2] = SIGNAL[0], np.where(plain, PLAIN, PACKED)
    present[:, :3] = switched[unit, None]
    rows[:, 3], present[:, 3] = np.where(plain, low_characters, high << 4 | low), True
    rows[:, 4], present[:, 4] = low_characters, ~plain & (low == UNPACKED_HALF)
    rows[:, 5], present[:, 5] = high_characters, ~plain & (high == UNPACKED_HALF)
    rows[:, 6], present[:, 6] = PADDING, moves & (low_characters != NEWLINE) & (high_characters == NEWLINE)
    return BEGIN + rows[present].tobytes()


def normalise_text(text: bytes, *, comments: bool = True) -> bytes:
    r"""Remove everything from a text that packing would lose; return the text that comes back.

    Examples
    --------
    >>> normalise_text(b"G1X1  Y2 ; a move\n\n; whole\nGRAB  BOX ; as it is\n")
    b'G1 X1 Y2\n; whole\nGRAB  BOX ; as it is\n'
    """
    if not text:
        return b""
    code = np.frombuffer(text if text.endswith(b"\n") else text + b"\n", np.uint8)
    starts, line = _find_lines(code)
    lines = _survey_lines(code, starts)
    place = np.arange(len(code))
    last_place = np.maximum.reduceat(np.where(_is_ink(code) & (place < lines.remark[line]), place, -1), starts)
    keeps_all = lines.odd | lines.comments if comments else lines.odd
    last_place[keeps_all] = np.append(starts[1:], len(code))[keeps_all] - 1
    first_place = np.where(lines.odd, starts, lines.first)
    keep = (place >= first_place[line]) & (place <= last_place[line]) | (code == NEWLINE) & (last_place >= 0)[line]
    moves, code = lines.moves[line][keep], code[keep]
    doubled = moves & (code == BLANK) & (np.append(code[1:], np.uint8(0)) == BLANK)
    return _insert_blanks(code[~doubled], moves[~doubled]).tobytes()


class _Lines(NamedTuple):
    """Of each line: the place of its first non-blank character, and of its first semicolon."""

    first: NDArray[np.int64]
    remark: NDArray[np.int64]
    comments: Flags  # only a comment
    moves: Flags  # G and a digit: blanks before the words may be dropped
    odd: Flags  # readers would change it: G and no digit, or a string, in which a semicolon need not begin a comment


def _survey_lines(code: Bytes, starts: NDArray[np.int64]) -> _Lines:
    """Find the first character and semicolon of each line, and whether it is a comment, a G command or odd."""
    count = len(code)
    place = np.arange(count)

    def first_flag(flags: Flags) -> NDArray[np.int64]:
        """Return the first marked place of each line, or the number of bytes."""
        return np.minimum.reduceat(np.where(flags, place, count), starts)

    first_place, remark = first_flag(_is_ink(code)), first_flag(code == SEMICOLON)
    padded = np.append(code, np.zeros(2, np.uint8))
    g, digit = padded[first_place] == G, DIGITS[padded[first_place + 1]]
    odd = (g & ~digit) | (first_flag(ODD[code]) < remark)
    return _Lines(first_place, remark, (first_place == remark) & (first_place < count), g & digit & ~odd, odd)


def _is_ink(code: Bytes) -> Flags:
    """Tell for each character whether it is visible."""
    ink: Flags = ~BLANKS[code]
    return ink


def _read_commands(data: bytes) -> tuple[Flags, NDArray[np.int64], NDArray[np.int64]]:
    """Return for each byte whether it is packed, whether half 11 is E (1), and at commands the bytes to skip."""
    size = len(data)
    packing = np.zeros(size, np.bool_)
    spaceless = np.zeros(size, np.int64)
    skipped = np.zeros(size, np.int64)
    on = no_spaces = False
    after = 0
    for match in re.finditer(rb"\xff\xff(.?)", data, re.DOTALL):
        packing[after : match.start()], spaceless[after : match.start()] = on, no_spaces
        command = match[1][0] if match[1] else -1
        if command not in COMMANDS:
            raise FormatError(f"MeatPack data has command {command}, and only 246 to 251 are known; it is damaged")
        on = command == PACKED or (on and command not in (PLAIN, RESET))
        no_spaces = command == NO_SPACES or (no_spaces and command not in (SPACES, RESET))
        skipped[match.start()] = 2
        after = match.end()
    packing[after:], spaceless[after:] = on, no_spaces
    return packing, spaceless, skipped


def _walk_steps(steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """List the places of a walk from place 0, each place holding the step to the next one, by doubling."""
    size = len(steps)
    jump = np.minimum(np.arange(size) + steps, size)
    jump = np.append(jump, size)
    walked = np.zeros(size + 1, np.bool_)
    walked[0] = True
    for _ in range(size.bit_length()):
        walked[jump[walked]] = True
        jump = jump[jump]
    return np.flatnonzero(walked[:size])


def _find_lines(code: Bytes) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the start of each line, and the line of each byte."""
    newline = code == NEWLINE
    starts = np.append(0, np.flatnonzero(newline[:-1]) + 1)
    return starts, np.cumsum(newline) - newline


def _insert_blanks(code: Bytes, moves: Flags) -> Bytes:
    """Put a blank before every word of the moves that lacks one."""
    before = np.append(np.uint8(NEWLINE), code[:-1])
    bare = moves & WORDS[code] & (before != BLANK) & (before != NEWLINE)
    return np.insert(code, np.flatnonzero(bare), np.uint8(BLANK))
