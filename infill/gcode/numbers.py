"""Decimal numbers of G-code, many at a time: read from text, and written as text.

A number is an optional sign, digits and at most one point. Its digits are gathered as a whole number and divided by a
power of ten once, so the value is the very float that `float` returns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Places = NDArray[np.intp]

MOST_DIGITS = 15  # a float64 holds them exactly
LONGEST = MOST_DIGITS + 2  # with a sign and a point
POWERS = 10.0 ** np.arange(LONGEST + 1)
SPACE, TAB, NEWLINE, RETURN, SEMICOLON, OPENING, STAR = b" \t\n\r;(*"
ZERO, NINE, POINT, MINUS, PLUS = b"09.-+"


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Lines of text, and where each begins: (N + 1,) int, the last entry being the length."""

    text: bytes
    start: NDArray[np.int64]


def read_numbers(text: Bytes, places: Places) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    r"""Return the numbers that begin at `places` in `text`, and whether each is one.

    Parameters
    ----------
    text : (N,) uint8
        Must end with a line end, so that no number runs over it.
    places : (M,) int
        Where the sign or the first digit stands.

    Returns
    -------
    values : (M,) float64
        NaN where there is no number.
    good : (M,) bool
        False if there is no digit, something strange follows, or there are more digits than a float holds.

    >>> text = np.frombuffer(b"X-1.25 E.5 FNaN\n", dtype=np.uint8)
    >>> values, good = read_numbers(text, np.array([1, 8, 12]))
    >>> values.tolist(), good.tolist()
    ([-1.25, 0.5, nan], [True, True, False])
    """
    last = len(text) - 1
    head = text[np.minimum(places, last)]
    negative = head == MINUS
    at = places + (negative | (head == PLUS))
    digits = np.zeros(len(places), dtype=np.int64)
    number = np.zeros(len(places), dtype=np.int8)  # of digits
    decimals = np.zeros(len(places), dtype=np.int8)
    pointed = np.zeros(len(places), dtype=bool)
    going = np.ones(len(places), dtype=bool)
    good = np.zeros(len(places), dtype=bool)
    for step in range(LONGEST):
        byte = text[np.minimum(at + step, last)]
        digit = (byte - ZERO <= 9) & going  # bytes below 0 wrap around
        point = (byte == POINT) & going & ~pointed
        pointed |= point
        np.multiply(digits, 10, out=digits, where=digit)
        np.add(digits, byte - ZERO, out=digits, where=digit)
        number += digit
        decimals += digit & pointed
        ends = going & ~(digit | point)
        good |= ends & _ends_a_number(byte)
        going &= ~ends
        if not going.any():
            break
    good &= number > 0
    values = digits / POWERS[decimals]
    np.negative(values, where=negative, out=values)
    values[~good] = np.nan
    return values, good


_ENDS = np.zeros(256, dtype=bool)
_ENDS[[SPACE, TAB, NEWLINE, RETURN, SEMICOLON, OPENING, STAR]] = True
_ENDS[list(b"ABCDFGHIJKLMNOPQRSTUVWXYZabcdfghijklmnopqrstuvwxyz")] = True  # no E: 1E5 is no number here


def _ends_a_number(byte: Bytes) -> NDArray[np.bool_]:
    """Return whether a byte may follow a number: a space, a line end, a comment, a checksum, the next word."""
    ends: NDArray[np.bool_] = _ENDS[byte]
    return ends


def write_words(columns: list[tuple[bytes, NDArray[np.float64], int]], head: bytes, tail: bytes) -> Rows:
    r"""Return rows of text, each `head`, a word for every column, and `tail`.

    Parameters
    ----------
    columns : list of (prefix, values, decimals)
        The prefix, such as ``b" X"``, stands before the number. A value that is NaN leaves its word out. Zeros that
        add nothing are left out, as slicers do: ``.5``, ``12``, ``-.031``.
    head, tail : bytes
        Such as ``b"G1"`` and a line end.

    Returns
    -------
    Rows

    >>> write_words([(b" X", np.array([1.5, -0.25]), 3), (b" F", np.array([np.nan, 900]), 0)], b"G1", b"\n").text
    b'G1 X1.5\nG1 X-.25 F900\n'
    """
    rows = len(columns[0][1])
    parts = [_constant(head, rows)]
    for prefix, values, decimals in columns:
        absent = np.isnan(values)
        word = np.concatenate([_constant(prefix, rows), _number(np.where(absent, 0.0, values), decimals)], axis=1)
        word[absent] = 0
        parts.append(word)
    parts.append(_constant(tail, rows))
    wide: Bytes = np.concatenate(parts, axis=1)
    shown = wide != 0
    return Rows(text=wide[shown].tobytes(), start=np.concatenate([[0], np.cumsum(shown.sum(axis=1))]))


def _constant(text: bytes, rows: int) -> Bytes:
    repeated: Bytes = np.broadcast_to(np.frombuffer(text, dtype=np.uint8), (rows, len(text)))
    return repeated


def _number(values: NDArray[np.float64], decimals: int) -> Bytes:
    """Return each value as text in a row of its own, 0 where there is no character."""
    scaled = np.rint(values * 10.0**decimals).astype(np.int64)
    rest = np.abs(scaled)
    wide = len(str(int(rest.max()))) if len(rest) else 1
    places = max(wide, decimals + 1)
    text = np.zeros((len(values), places + 2), dtype=np.uint8)
    shown = np.zeros(len(values), dtype=bool)  # something other than 0 was met, from the right
    column = places + 1
    for place in range(places):
        rest, digit = np.divmod(rest, 10)
        if place == decimals and decimals:
            text[:, column] = np.where(shown, POINT, 0)
            column -= 1
        if place < decimals:
            shown |= digit != 0
            text[:, column] = np.where(shown, digit + ZERO, 0)
        else:
            some = (digit != 0) | (rest != 0)  # a digit, or a 0 with digits before it
            if place == decimals:
                some |= ~shown  # "0" rather than nothing
            text[:, column] = np.where(some, digit + ZERO, 0)
        column -= 1
    text[:, 0] = np.where(scaled < 0, MINUS, 0)
    return text
