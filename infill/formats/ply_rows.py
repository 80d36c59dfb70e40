"""Rows of numbers in a PLY file, binary or text, as its header announces them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.excerpts import quote_word
from infill.formats.text_lines import Lines, number_complaint
from infill.plain_numbers import count_noun, plain_argument

CORNER_LISTS = ("vertex_indices", "vertex_index", "vertex_indexes")
MOST_ROWS = 2**40
BLANK, LONGEST_BLANK = b"\0\t\n\r ", 2**12  # harmless bytes behind the last row, and their largest number
Columns = dict[str, NDArray[Any]]  # of a list: its numbers, row after row, and under "name#" the length in each row


@dataclass(frozen=True, kw_only=True)
class Property:
    """A property of an element.

    Parameters
    ----------
    name : str
    kind : str
        NumPy's name of the type of its numbers, without the order of bytes.
    count : str
        NumPy's name of the type of the number in front of a list; empty for a single number.
    """

    name: str
    kind: str
    count: str = ""


@dataclass(frozen=True, kw_only=True)
class Element:
    """A kind of rows, such as vertices.

    Parameters
    ----------
    name : str
    rows : int
    properties : list of Property
    """

    name: str
    rows: int
    properties: list[Property] = field(default_factory=list)

    def corners(self) -> Property | None:
        """Return the list of corners: the list of that name, or the only list of integers."""
        lists = [prop for prop in self.properties if prop.count]
        named = [prop for prop in lists if prop.name.lower() in CORNER_LISTS]
        integer_lists = [prop for prop in lists if prop.kind[0] in "iu"]
        return named[0] if named else integer_lists[0] if len(integer_lists) == 1 else None


def _cut_off_error(path: Path, element: Element) -> FormatError:
    """Return the error for a file that ends too early."""
    return FormatError(
        f"{path} is cut off: it announces {element.rows} of {quote_word(element.name)} and holds fewer; "
        "export the mesh again"
    )


def read_binary_rows(
    path: Path, data: bytes, place: int, order: str, elements: list[Element]
) -> Iterator[tuple[Element, Columns, str]]:
    """Yield each element, the numbers of its rows, and a description of the bytes behind them."""
    for element in elements:
        smallest = sum(np.dtype(prop.count or prop.kind).itemsize for prop in element.properties)
        if element.rows * smallest > len(data) - place:
            raise _cut_off_error(path, element)
        if not any(prop.count for prop in element.properties):
            columns = _plain_rows(data, place, order, element)
            place += element.rows * smallest
        else:
            uniform = _uniform_rows(data, place, order, element)
            columns, place = uniform if uniform else _varying_rows(path, data, place, order, element)
        remaining = len(data) - place
        is_blank = remaining <= LONGEST_BLANK and not data[place:].strip(BLANK)
        yield element, columns, "" if is_blank else count_noun(remaining, "byte")


def _plain_rows(data: bytes, place: int, order: str, element: Element) -> Columns:
    """Return the numbers of rows without lists."""
    row = np.dtype([(str(i), order + prop.kind) for i, prop in enumerate(element.properties)])
    if not row.itemsize:
        return {}
    rows = np.frombuffer(data, dtype=row, count=element.rows, offset=place)
    return {prop.name: rows[str(i)] for i, prop in enumerate(element.properties)}


def _uniform_rows(data: bytes, place: int, order: str, element: Element) -> tuple[Columns, int] | None:
    """Return the numbers of rows with lists of equal length, and their end; None if lengths differ."""
    if element.rows == 0:
        return _empty_columns(element), place
    fields: list[tuple[str, Any]] = []
    lengths, position = [], place
    for i, prop in enumerate(element.properties):
        kind, length = np.dtype(order + prop.kind), 1
        if prop.count:
            count = np.dtype(order + prop.count)
            if position + count.itemsize > len(data):
                return None
            number = np.frombuffer(data, dtype=count, count=1, offset=position)[0].item()
            if not 0 <= number <= len(data) or number != int(number):
                return None
            length = int(number)
            fields.append((f"{i}#", count))
            position += count.itemsize
        fields.append((f"{i}", (kind, (length,)) if prop.count else kind))
        position += length * kind.itemsize
        lengths.append(length)
    row = position - place
    if row * element.rows > len(data) - place:
        return None
    rows = np.frombuffer(data, dtype=np.dtype(fields), count=element.rows, offset=place)
    columns: Columns = {}
    for i, (prop, length) in enumerate(zip(element.properties, lengths, strict=True)):
        if prop.count:
            if not (rows[f"{i}#"] == length).all():
                return None
            columns[f"{prop.name}#"] = np.full(element.rows, length)
            columns[prop.name] = rows[f"{i}"].ravel()
        else:
            columns[prop.name] = rows[f"{i}"]
    return columns, place + row * element.rows


def _empty_columns(element: Element) -> Columns:
    """Return the columns of an element without rows."""
    columns: Columns = {prop.name: np.empty(0, dtype=prop.kind) for prop in element.properties}
    return columns | {f"{prop.name}#": np.empty(0, dtype=np.int64) for prop in element.properties if prop.count}


def _varying_rows(path: Path, data: bytes, place: int, order: str, element: Element) -> tuple[Columns, int]:
    """Return the numbers of rows with lists of various lengths, and their end."""
    begins: list[list[int]] = [[] for _ in element.properties]
    lengths: list[list[int]] = [[] for _ in element.properties]
    end = len(data)
    # Size of the length, then size of the items of each list.
    steps = [
        (begin, length, np.dtype(order + prop.count) if prop.count else None, np.dtype(prop.kind).itemsize)
        for begin, length, prop in zip(begins, lengths, element.properties, strict=True)
    ]
    byteorder = "big" if order == ">" else "little"
    for _ in range(element.rows):
        for begin, length, count, size in steps:
            number = 1
            if count is not None:
                stop = place + count.itemsize
                if count.kind == "f":
                    number = _length(data, place, count)
                else:
                    number = int.from_bytes(data[place:stop], byteorder, signed=count.kind == "i")  # type: ignore[arg-type]
                place = stop
                if number < 0:
                    raise FormatError(f"{path} has a list of {number} numbers; export the mesh again")
                length.append(number)
            begin.append(place)
            place += number * size
        if place > end:
            raise _cut_off_error(path, element)
    raw = np.frombuffer(data, dtype=np.uint8)
    columns: Columns = {}
    for begin, length, prop in zip(begins, lengths, element.properties, strict=True):
        kind = np.dtype(order + prop.kind)
        counts = np.array(length, dtype=np.int64) if prop.count else np.ones(element.rows, dtype=np.int64)
        starts = np.repeat(np.array(begin, dtype=np.int64) - (np.cumsum(counts) - counts) * kind.itemsize, counts)
        places = starts + np.arange(len(starts)) * kind.itemsize
        item_bytes = raw[places[:, None] + np.arange(kind.itemsize)]
        columns[prop.name] = item_bytes.reshape(-1).view(kind) if len(item_bytes) else np.empty(0, dtype=kind)
        if prop.count:
            columns[f"{prop.name}#"] = counts
    return columns, place


def _length(data: bytes, place: int, count: np.dtype[Any]) -> int:
    """Return the length of a list that is a fractional number in the file."""
    if place + count.itemsize > len(data):
        return 0
    number = float(np.frombuffer(data, dtype=count, count=1, offset=place)[0])
    return int(number) if number == number and abs(number) < MOST_ROWS and number == int(number) else -1


def read_text_rows(path: Path, data: bytes, elements: list[Element]) -> Iterator[tuple[Element, Columns, str]]:
    """Yield each element, the numbers of its rows, and the number of words after them as text, '' if none."""
    values, count = _words_as_numbers(data)
    line_starts = _line_starts(path, data, sum(element.rows for element in elements))
    place = 0
    for element in elements:
        smallest = len(element.properties)
        if element.rows * smallest > len(values) - place:
            raise _missing_number_error(path, data, element)
        if any(prop.count for prop in element.properties):
            try:
                columns, starts = _text_lists(path, values, place, element)
            except EOFError:
                raise _missing_number_error(path, data, element) from None
        else:
            table = values[place : place + element.rows * smallest].reshape(element.rows, smallest)
            columns = {prop.name: table[:, i] for i, prop in enumerate(element.properties)}
            starts = place + np.arange(min(element.rows, len(values)) + 1) * smallest
        if line_starts is not None and smallest and not line_starts[starts].all():
            row = int(np.argmin(line_starts[starts]))
            raise FormatError(
                f"{path} announces {count_noun(smallest, 'number')} or lists for each {quote_word(element.name)}, and "
                f"row {row} does not begin or end with a line; export the mesh again"
            )
        place = int(starts[-1])
        yield element, columns, count_noun(count - place, "word") if count > place else ""


def _line_starts(path: Path, data: bytes, rows: int) -> NDArray[np.bool_] | None:
    """Return a mask of the words that begin a line, and True for the end; None for a text without lines."""
    lines = Lines(path=path, original=data, text=data.replace(b"\r", b"\n") + b"\n")
    if 2 * len(lines) < rows:
        return None
    is_start = np.zeros(len(lines.begins) + 1, dtype=bool)
    is_start[lines.first_words] = is_start[-1] = True
    return is_start


def _words_as_numbers(data: bytes) -> tuple[NDArray[np.float64], int]:
    """Return the numbers of a text up to the first other word, and the number of its words."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            values = np.fromstring(data, dtype=np.float64, sep=" ")
            return values, len(values)
        except (DeprecationWarning, ValueError):  # words behind the numbers, or between them
            words = data.split()
    bad_place = next((place for place, word in enumerate(words) if number_complaint(word)), len(words))
    values = np.array(words[:bad_place], dtype="S").astype(np.float64) if bad_place else np.empty(0)
    return values, len(words)


def _missing_number_error(path: Path, data: bytes, element: Element) -> FormatError:
    """Return the error about a missing number: a word of another kind, or the end of the file."""
    for word in data.split():
        if complaint := number_complaint(word):
            return FormatError(f"{path}: {complaint}; export the mesh again")
    return _cut_off_error(path, element)


def _text_lists(
    path: Path, values: NDArray[np.float64], place: int, element: Element
) -> tuple[Columns, NDArray[np.int64]]:
    """Return the numbers of rows with lists, the first word of each row, and the word behind the last one."""
    list_properties = [prop for prop in element.properties if prop.count]
    if len(list_properties) == len(element.properties) == 1 and element.rows:  # as most files are
        count = values[place]
        if 0 <= count <= len(values) and count == int(count):
            width = int(count) + 1
            rows = values[place : place + width * element.rows]
            if len(rows) == width * element.rows and (rows[::width] == count).all():
                name = element.properties[0].name
                table = rows.reshape(element.rows, width)
                columns_found = {name: table[:, 1:].ravel(), f"{name}#": np.full(element.rows, int(count))}
                return columns_found, place + width * np.arange(element.rows + 1)
    begins: list[list[int]] = [[] for _ in element.properties]
    lengths: list[list[int]] = [[] for _ in element.properties]
    starts = [place]
    end = len(values)
    for _ in range(element.rows):
        for i, prop in enumerate(element.properties):
            number = 1
            if prop.count:
                if place >= end:
                    raise EOFError
                written = float(values[place])
                if not (0 <= written < MOST_ROWS) or written != int(written):
                    raise FormatError(f"{path} has a list of {plain_argument(written)} numbers; export the mesh again")
                number = int(written)
                place += 1
                lengths[i].append(number)
            begins[i].append(place)
            place += number
        if place > end:
            raise EOFError
        starts.append(place)
    columns: Columns = {}
    for begin, length, prop in zip(begins, lengths, element.properties, strict=True):
        counts = np.array(length, dtype=np.int64) if prop.count else np.ones(element.rows, dtype=np.int64)
        first_numbers = np.repeat(np.array(begin, dtype=np.int64) - (np.cumsum(counts) - counts), counts)
        columns[prop.name] = values[first_numbers + np.arange(len(first_numbers))]
        if prop.count:
            columns[f"{prop.name}#"] = counts
    return columns, np.array(starts, dtype=np.int64)
