"""Lines of G-code read byte by byte: the specification is `read_plain_lines` of `infill.gcode.lines`, in NumPy."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

from infill.kernels.compiling import njit

SPACE, TAB, NEWLINE, RETURN, SEMICOLON, OPENING, STAR = 32, 9, 10, 13, 59, 40, 42
ZERO, NINE, POINT, MINUS, PLUS, DOUBLE_QUOTE, COLON, EQUALS = 48, 57, 46, 45, 43, 34, 58, 61
SMALL_A, SMALL_E, SMALL_G, SMALL_N, SMALL_Z, LOWER = 97, 101, 103, 110, 122, 0x20
MOST_BLANKS, MOST_NUMBER_DIGITS = 8, 10  # before the command of a line, and of a line number
MAX_DIGITS, MAX_CHARACTERS = 15, 17


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_digit(byte):
    """Tell whether a byte is a digit."""
    return ZERO <= byte <= NINE


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_letter(byte):
    """Tell whether a word begins at a byte, as far as its last bits tell: any other sign in its place is odd."""
    return byte | LOWER >= SMALL_A or byte in (EQUALS, DOUBLE_QUOTE, COLON)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _ends_number(byte):
    """Tell whether a number may end before a byte."""
    return byte in (SPACE, NEWLINE, TAB, RETURN, SEMICOLON, OPENING, STAR) or SMALL_A <= byte | LOWER <= SMALL_Z


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _skip_blanks(text, place, final):
    """Return the first place after some spaces and tabs, of which there are few."""
    for _ in range(MOST_BLANKS):
        byte = text[min(place, final)]
        if byte != SPACE and byte != TAB:
            break
        place += 1
    return place


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _read_number(text, place, final, powers):
    """Return the number that begins at a place, and True if it is valid."""
    head = text[min(place, final)]
    negative = head == MINUS
    if negative or head == PLUS:
        place += 1
    digits, number, decimals = 0, 0, -1
    for _ in range(MAX_CHARACTERS):
        byte = text[min(place, final)]
        if _is_digit(byte):
            digits = 10 * digits + (byte - ZERO)
            number += 1
            if decimals >= 0:
                decimals += 1
        elif byte == POINT and decimals < 0:
            decimals = 0
        else:
            break
        place += 1
    if not 0 < number <= MAX_DIGITS or not _ends_number(text[min(place, final)]):
        return 0.0, False
    value = float(digits) / powers[max(decimals, 0)]
    return (-value if negative else value), True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _read_words(text, place, stop, letters, places, powers, farthest, values, present):
    """Read the words of a line from a place on; return the place behind them, and whether one is odd."""
    final, odd = len(text) - 1, False
    while place < stop:
        byte = text[place]
        if byte in (SEMICOLON, OPENING, STAR):
            break
        if not _is_letter(byte):
            place += 1
            continue
        column, begin = letters[byte], place + 1
        number, good = _read_number(text, begin + (text[min(begin, final)] == SPACE), final, powers)
        if column < 0 or not good:
            odd = True
        if column >= 0:
            odd = odd or present[column] or (places[column] and abs(number) > farthest)
            present[column] = True
            values[column] = number
            if byte | LOWER == SMALL_E:
                # An E behind a digit is a word, as Marlin and Klipper take it, unless it looks like an exponent.
                front, back = text[place - 1], text[min(begin, final)]
                if _is_digit(front) or front == POINT:
                    odd = odd or byte == SMALL_E or back in (MINUS, PLUS)
        place = begin
    return place, odd


@njit(nogil=True, cache=True, error_model="numpy")
def read_lines(text, start, letters, places, powers, farthest, kind, code, numbered, values, present, behind):
    """Read the kind of every line, and the words of moves and arcs.

    Parameters
    ----------
    text : (B,) uint8
        Ends with a line end.
    start : (N + 1,) int64
    letters : (256,) int8
        Column of the word that begins with each byte, -1 for others.
    places : (7,) bool
        Columns of words that are places, at most `farthest` from 0.
    powers : (18,) float64
        Of ten.
    kind, code, numbered, values, present
        Written: as in `ParsedLines`; zeros on entry. A move that is odd has neither numbers nor words.
    behind : (N,) bool
        Written: the line has more than a comment behind its words, such as remarks in brackets.
    """
    final = len(text) - 1
    columns = values.shape[1]
    for line in range(len(kind)):
        begins_at, stop = start[line], start[line + 1]
        for column in range(columns):
            values[line, column] = float("nan")
        code[line] = -1
        blank = text[begins_at] <= SPACE
        place = _skip_blanks(text, begins_at, final)
        if text[min(place, final)] | LOWER == SMALL_N and _is_digit(text[min(place + 1, final)]):
            numbered[line] = True
            place += 1
            for _ in range(MOST_NUMBER_DIGITS):
                if not _is_digit(text[min(place, final)]):
                    break
                place += 1
            place = _skip_blanks(text, place, final)
        head = text[min(place, final)]
        if head | LOWER == SMALL_G:
            digit, place = text[min(place + 1, final)], place + 2
            ends = text[min(place, final)]
            if digit == ZERO and _is_digit(ends):  # G01
                digit, place = ends, place + 1
                ends = text[min(place, final)]
            if not ZERO <= digit <= ZERO + 3 or _is_digit(ends) or ends == POINT:
                continue
            code[line] = digit - ZERO
        else:
            if head == SEMICOLON:
                kind[line] = 3
            elif head in (NEWLINE, RETURN):
                kind[line] = 4
            elif blank and (head in (SPACE, TAB)):
                kind[line] = 5
            continue
        place, odd = _read_words(text, place, stop, letters, places, powers, farthest, values[line], present[line])
        while place < stop and text[place] != SEMICOLON:
            if _is_letter(text[place]):
                behind[line] = True
                break
            place += 1
        kind[line] = 1 if code[line] <= 1 else 2
        if odd:
            kind[line] = 5
            for column in range(columns):
                values[line, column] = float("nan")
                present[line, column] = False


@njit(nogil=True, cache=True, error_model="numpy")
def fill_forward(values, before, filled):
    """Write each value, or the previous one where it is NaN, and the one before the first, to `filled`."""
    for k in range(len(values)):
        if values[k] == values[k]:
            before = values[k]
        filled[k] = before
