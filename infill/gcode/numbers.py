"""Decimal numbers of G-code, many at a time: parsed from text, and written as text.

A number is an optional sign, digits and at most one point. Its digits are read as an integer and divided by a
power of ten once, so the value is the same float that `float` returns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Integers, Places
from infill.kernels.compiling import is_compiler_loaded, log_compilation

Bytes = NDArray[np.uint8]

MAX_DIGITS = 15  # a float64 holds them exactly
MAX_CHARACTERS = MAX_DIGITS + 2  # with a sign and a point
POWERS = 10.0 ** np.arange(MAX_CHARACTERS + 1)
SPACE, TAB, NEWLINE, RETURN, SEMICOLON, OPENING, STAR = b" \t\n\r;(*"
ZERO, POINT, MINUS, PLUS = b"0.-+"
WORD = 8  # bytes


def _repeat_byte(byte: int) -> np.uint64:
    """Return a word with the same value in each of its bytes."""
    return np.uint64(int.from_bytes(bytes([byte]) * WORD, "little"))


_ONE, _EIGHT_BITS = np.uint64(1), np.uint64(3)  # a shift by which bytes become bits
_HIGH, _LOW, _ZEROS = _repeat_byte(0x80), _repeat_byte(0x7F), _repeat_byte(ZERO)
_OVER_NINE = _repeat_byte(0x80 - 10)  # added to a byte over 9, it sets the high bit


@dataclass(frozen=True, kw_only=True)
class TextRows:
    """Lines of text, and their starts: (N + 1,) int, the last entry being the length."""

    text: bytes
    start: NDArray[np.int64]


def read_numbers(text: Bytes, places: Places) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    r"""Parse the numbers that begin at `places` in `text`; return the values, and True where a number is valid.

    Parameters
    ----------
    text : (N,) uint8
        Must end with a line end, so that numbers cannot run past it.
    places : (M,) int
        Place of the sign or the first digit.

    Returns
    -------
    values : (M,) float64
        NaN where there is no valid number.
    good : (M,) bool
        False if there is no digit, an unexpected character follows, or there are more digits than a float holds.

    >>> text = np.frombuffer(b"X-1.25 E.5 FNaN\n", dtype=np.uint8)
    >>> values, good = read_numbers(text, np.array([1, 8, 12]))
    >>> values.tolist(), good.tolist()
    ([-1.25, 0.5, nan], [True, True, False])
    """
    end = len(text) - 1
    head = text[np.minimum(places, end)]
    negative = head == MINUS
    at = places + (negative | (head == PLUS))
    digits, number, decimals, is_short = parse_short_numbers(text, at)
    long = np.flatnonzero(~is_short)
    if len(long):
        digits[long], number[long], decimals[long] = parse_long_numbers(text, at[long])
    good = _ENDS[text[np.minimum(at + number + (decimals >= 0), end)]] & (number > 0) & (number <= MAX_DIGITS)
    values = digits / POWERS[np.maximum(decimals, 0)]
    np.negative(values, where=negative, out=values)
    values[~good] = np.nan
    return values, good


def parse_long_numbers(text: Bytes, at: Places) -> tuple[Integers, Integers, Integers]:
    """Parse unsigned numbers, one character after another; return digits as an integer, their count and the decimals.

    A number has at most `MAX_CHARACTERS` characters.

    Returns
    -------
    digits : (M,) int64
        The digits as an integer.
    number : (M,) int64
        Number of digits.
    decimals : (M,) int64
        Number of digits after the point; -1 without a point.
    """
    end = len(text) - 1
    digits = np.zeros(len(at), dtype=np.int64)
    number = np.zeros(len(at), dtype=np.int64)
    decimals = np.full(len(at), -1)
    going = np.ones(len(at), dtype=bool)
    for step in range(MAX_CHARACTERS):
        byte = text[np.minimum(at + step, end)]
        digit = (byte - ZERO <= 9) & going  # bytes below 0 wrap around
        point = (byte == POINT) & going & (decimals < 0)
        np.multiply(digits, 10, out=digits, where=digit)
        np.add(digits, byte - ZERO, out=digits, where=digit)
        number += digit
        decimals += (digit & (decimals >= 0)) | point
        going &= digit | point
        if not going.any():
            break
    return digits, number, decimals


def parse_short_numbers(text: Bytes, at: Places) -> tuple[Integers, Integers, Integers, NDArray[np.bool_]]:
    """Parse unsigned numbers as `parse_long_numbers` does, from eight bytes each; also tell which end within these.

    The bytes are one word of 64 bits, whose lowest byte comes first.

    Returns
    -------
    digits, number, decimals : (M,) int64
    whole : (M,) bool
        The number ends within these eight characters; else the other results are invalid.
    """
    padded = np.zeros(len(text) + 2 * WORD, dtype=np.uint8)
    padded[: len(text)] = text
    # Words begin at any byte: as items without alignment they are copied byte by byte on every machine.
    windows: NDArray[np.void] = np.ndarray((len(text) + WORD,), dtype=f"V{WORD}", buffer=padded, strides=(1,))
    words = windows[np.minimum(at, len(text))].view("<u8").astype(np.uint64, copy=False) ^ _ZEROS
    non_digits = _not_digits(words)
    lowest_bit = non_digits & (~non_digits + _ONE)  # the lowest bit that is set
    before = _byte_index(lowest_bit)
    pointed = ((words >> (before << _EIGHT_BITS)) & np.uint64(0xFF) == POINT ^ ZERO) & (non_digits != 0)
    lower = (lowest_bit >> np.uint64(7)) - _ONE
    words = np.where(pointed, (words & lower) | ((words >> np.uint64(8)) & ~lower), words)
    non_digits = np.where(pointed, _not_digits(words) | np.uint64(0x80 << 56), non_digits)
    number = _byte_index(non_digits & (~non_digits + _ONE))
    is_complete = np.where(pointed, number < WORD - 1, non_digits != 0)
    # Digits end at the end of the word, zeros before them; then pairs, fours and eights of them are combined.
    words = np.where(number > 0, words << ((np.uint64(WORD) - number) % np.uint64(WORD) << _EIGHT_BITS), 0)
    words = (words * np.uint64(10) + (words >> np.uint64(8))) & np.uint64(0x00FF00FF00FF00FF)
    words = (words * np.uint64(100) + (words >> np.uint64(16))) & np.uint64(0x0000FFFF0000FFFF)
    words = (words * np.uint64(10000) + (words >> np.uint64(32))) & np.uint64(0xFFFFFFFF)
    count = number.astype(np.int64)
    decimals = np.where(pointed, count - before.astype(np.int64), -1)
    return words.astype(np.int64), count, decimals, is_complete


def _not_digits(words: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Return words with the high bit set in each byte over 9."""
    marked: NDArray[np.uint64] = (((words & _LOW) + _OVER_NINE) | words) & _HIGH
    return marked


def _byte_index(bit: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Return the index of the byte whose high bit is set."""
    place: NDArray[np.uint64] = (bit >> np.uint64(7)) * np.uint64(0x0001020304050607) >> np.uint64(56)
    return place


_ENDS = np.zeros(256, dtype=bool)
_ENDS[[SPACE, TAB, NEWLINE, RETURN, SEMICOLON, OPENING, STAR]] = True
_ENDS[list(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz")] = True  # E too: numbers have no exponents here


def write_words(
    columns: list[tuple[bytes, NDArray[np.float64], int]], head: bytes, tail: bytes, *, codes: Bytes | None = None
) -> TextRows:
    r"""Write rows of text, each `head`, a word for every column, and `tail`.

    Parameters
    ----------
    columns : list of (prefix, values, decimals)
        The prefix, such as ``b" X"``, stands before the number. A value that is NaN omits its word. Redundant zeros
        are left out, as slicers do: ``.5``, ``12``, ``-.031``.
    head, tail : bytes
        Such as ``b"G1"``, and a line end.
    codes : (N,) uint8, optional
        One character of each row, after the head.

    Returns
    -------
    TextRows

    >>> write_words([(b" X", np.array([1.5, -0.25]), 3), (b" F", np.array([np.nan, 900]), 0)], b"G1", b"\n").text
    b'G1 X1.5\nG1 X-.25 F900\n'
    """
    write = write_compiled_words if is_compiler_loaded() else write_plain_words
    return write(columns, head, tail, codes)


def write_compiled_words(
    columns: Sequence[tuple[bytes, NDArray[np.float64], int]], head: bytes, tail: bytes, codes: Bytes | None
) -> TextRows:
    """Write rows as `write_words` does, in compiled code."""
    from infill.kernels.gcode_words import MOST_CHARACTERS, write_rows

    rows, prefixes = len(columns[0][1]), [prefix for prefix, _, _ in columns]
    longest = len(head) + 1 + len(tail) + sum(len(prefix) + MOST_CHARACTERS for prefix in prefixes)
    text, start = np.empty(rows * longest, dtype=np.uint8), np.empty(rows + 1, dtype=np.int64)
    decimals = np.array([number for _, _, number in columns])
    with log_compilation("the writer of prints"):
        length = write_rows(
            np.array([values for _, values, _ in columns]),
            decimals,
            np.array([10.0**number for number in decimals.tolist()]),
            _bytes_of(b"".join(prefixes)),
            np.append(0, np.cumsum([len(prefix) for prefix in prefixes])),
            _bytes_of(head),
            np.empty(0, dtype=np.uint8) if codes is None else codes,
            _bytes_of(tail),
            text,
            start,
        )
    return TextRows(text=text[:length].tobytes(), start=start)


def _bytes_of(text: bytes) -> Bytes:
    """Return a text as an array of its own."""
    return np.array(list(text), dtype=np.uint8)


def write_plain_words(
    columns: Sequence[tuple[bytes, NDArray[np.float64], int]], head: bytes, tail: bytes, codes: Bytes | None
) -> TextRows:
    """Write rows as `write_words` does, with NumPy."""
    rows = len(columns[0][1])
    parts = [_repeat_text(head, rows)]
    if codes is not None:
        parts.append(codes[:, None])
    for prefix, values, decimals in columns:
        absent = np.isnan(values)
        word = np.concatenate(
            [_repeat_text(prefix, rows), _format_numbers(np.where(absent, 0.0, values), decimals)], axis=1
        )
        word[absent] = 0
        parts.append(word)
    parts.append(_repeat_text(tail, rows))
    wide: Bytes = np.concatenate(parts, axis=1)
    text = wide.tobytes().translate(None, b"\0")
    ends = np.flatnonzero(np.frombuffer(text, dtype=np.uint8) == NEWLINE)
    return TextRows(text=text, start=np.append(0, ends + 1))


def _repeat_text(text: bytes, rows: int) -> Bytes:
    """Return a text as bytes in each of some rows."""
    repeated: Bytes = np.broadcast_to(np.frombuffer(text, dtype=np.uint8), (rows, len(text)))
    return repeated


def _format_numbers(values: NDArray[np.float64], decimals: int) -> Bytes:
    """Write each value as text in a row, 0 in unused columns."""
    scaled = np.rint(values * 10.0**decimals).astype(np.int64)
    rest = np.abs(scaled)
    largest = int(rest.max(initial=0))
    wide = len(str(largest))
    if largest < 1 << 32:
        rest = rest.astype(np.uint32)
    ten = rest.dtype.type(10)
    places = max(wide, decimals + 1)
    text = np.zeros((len(values), places + 2), dtype=np.uint8)
    shown = np.zeros(len(values), dtype=bool)  # a digit other than 0 was met, from the right
    column = places + 1
    for place in range(places):
        tenth = rest // ten  # much quicker than divmod
        digit = (rest - tenth * ten).astype(np.uint8)
        rest = tenth
        if place == decimals and decimals:
            text[:, column] = np.where(shown, POINT, 0)
            column -= 1
        if place < decimals:
            shown |= digit != 0
            text[:, column] = np.where(shown, digit + ZERO, 0)
        else:
            visible = (digit != 0) | (rest != 0)  # a digit, or a 0 with digits before it
            if place == decimals:
                visible |= ~shown  # "0" rather than nothing
            text[:, column] = np.where(visible, digit + ZERO, 0)
        column -= 1
    text[:, 0] = np.where(scaled < 0, MINUS, 0)
    return text


def format_word(value: float, decimals: int = 3) -> bytes:
    """Return a number as G-code has it, without trailing zeros and without "-0".

    >>> format_word(1.5), format_word(-0.0001), format_word(20.0)
    (b'1.5', b'0', b'20')
    """
    text = f"{value:.{decimals}f}".rstrip("0").rstrip(".")
    return text.encode() if text not in ("", "-", "-0") else b"0"
