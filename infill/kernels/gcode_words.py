"""Rows of words written as text: the specification is `write_plain_words` of `infill.gcode.numbers`, in NumPy."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

ZERO, POINT, MINUS = 48, 46, 45
TEN = np.uint64(10)
MOST_CHARACTERS = 22  # of a number of 64 bits, with a sign and a point


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _write_number(value, decimals, scale, text, place, digits):
    """Write a number without redundant zeros; return the place behind it."""
    scaled = np.int64(np.rint(value * scale))
    if scaled < 0:
        text[place] = MINUS
        place += 1
    rest, count = np.uint64(abs(scaled)), 0  # without a sign: division by a constant is a product then
    while rest > 0 or count < decimals:
        tenth = rest // TEN
        digits[count] = rest - TEN * tenth
        rest = tenth
        count += 1
    lowest = 0
    while lowest < decimals and digits[lowest] == 0:
        lowest += 1
    if count == decimals and lowest == decimals:
        text[place] = ZERO
        return place + 1
    for k in range(count - 1, lowest - 1, -1):
        if k == decimals - 1:
            text[place] = POINT
            place += 1
        text[place] = ZERO + digits[k]
        place += 1
    return place


@njit(nogil=True, cache=True, error_model="numpy")
def write_rows(values, decimals, scales, prefixes, prefix_begins, head, codes, tail, text, start):
    """Write rows of words; return the length of the text.

    Parameters
    ----------
    values : (C, N) float64
        A column for each word; NaN where a row has none.
    decimals, scales : (C,) int64 and float64
        Decimals, and ten to their power.
    prefixes, prefix_begins : (P,) uint8, (C + 1,) int64
        What stands before the numbers of each column.
    head, tail : uint8
        What each row begins and ends with.
    codes : (N,) uint8
        One character of each row, after the head; none if it is empty.
    text : (T,) uint8
        Written; long enough.
    start : (N + 1,) int64
        Written: where each row begins.
    """
    place = 0
    digits = np.empty(MOST_CHARACTERS, dtype=np.int64)
    for row in range(values.shape[1]):
        start[row] = place
        for byte in head:
            text[place] = byte
            place += 1
        if len(codes):
            text[place] = codes[row]
            place += 1
        for column in range(len(values)):
            value = values[column, row]
            if value == value:  # not NaN
                for k in range(prefix_begins[column], prefix_begins[column + 1]):
                    text[place] = prefixes[k]
                    place += 1
                place = _write_number(value, decimals[column], scales[column], text, place, digits)
        for byte in tail:
            text[place] = byte
            place += 1
    start[values.shape[1]] = place
    return place
