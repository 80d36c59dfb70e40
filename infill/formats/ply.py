"""PLY: a header of text and rows of numbers, without a unit."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.excerpts import quote_word
from infill.formats.text_lines import Lines, number_complaint
from infill.meshes.polygons import split_polygons, split_strips
from infill.surface import Surface
from infill.version import __version__

FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "long": "i8",
    "ulong": "u8",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "int64": "i8",
    "uint64": "u8",
    "float32": "f4",
    "float64": "f8",
}
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
CORNER_LISTS = ("vertex_indices", "vertex_index", "vertex_indexes")
HEAD = 2**20  # bytes within which a header ends
MOST_ROWS = 2**40
BLANK, LONGEST_BLANK = b"\0\t\n\r ", 2**12  # harmless bytes behind the last row, and their largest number


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


Columns = dict[str, NDArray[Any]]  # of a list: its numbers, row after row, and under "name#" the length in each row


def read_ply(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64], tuple[str, ...]]:
    """Read vertices and triangles; split polygons and strips, and add a note on trailing bytes.

    Raises
    ------
    FormatError
        If the header is not that of a PLY file, or announced numbers are missing.
    """
    data = path.read_bytes()
    order, elements, begin = _header(path, data)
    rows = _text_rows(path, data[begin:], elements) if not order else _binary_rows(path, data, begin, order, elements)
    vertices: NDArray[np.float64] | None = None
    faces: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    strips: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    note = ""
    for element, columns, trailing in rows:
        note = trailing  # of the last of them
        if element.name == "vertex":
            vertices = _vertices(path, element, columns)
        elif element.name in ("face", "tristrips") and element.rows:
            corners = element.corners()
            if corners is None:
                raise FormatError(f"{path} has a {element.name} without a list vertex_indices; export the mesh again")
            polygons = (_to_integers(path, columns[corners.name]), columns[f"{corners.name}#"].astype(np.int64))
            (faces if element.name == "face" else strips).append(polygons)
    if vertices is None:
        raise FormatError(f"{path} holds no vertices; export the mesh again")
    triangles = [np.empty((0, 3), dtype=np.int64)]
    for flat, counts in faces:
        require_corners(path, flat, len(vertices))
        triangles.append(split_polygons(vertices, flat, counts))
    triangles += [split_strips(flat, counts) for flat, counts in strips]
    notes = (f"{note} follow the last row that it announces: they are left out",) if note else ()
    return vertices, np.concatenate(triangles), notes


def require_corners(path: Path, corners: NDArray[np.int64], vertices: int) -> None:
    """Raise FormatError if polygons have corners beyond the number of vertices, counted from 0."""
    if len(corners) and (corners.min() < 0 or corners.max() >= vertices):
        wrong = corners[(corners < 0) | (corners >= vertices)][0]
        raise FormatError(
            f"{path} has a face with corner {wrong}, which does not exist: it holds {vertices} vertices, "
            "counted from 0; export the mesh again"
        )


def _header(path: Path, data: bytes) -> tuple[str, list[Element], int]:
    """Return the byte order, empty for text, the elements, and the position of their rows."""
    head = data[:HEAD]
    line_end = min((place for mark in (b"\n", b"\r") if (place := head.find(mark)) >= 0), default=-1)
    if head[:3] != b"ply" or line_end < 0 or head[3:line_end].strip():
        raise FormatError(f"{path} is broken or not a .ply file (it does not begin with 'ply'); export the mesh again")
    line_break = b"\r\n" if head[line_end : line_end + 2] == b"\r\n" else head[line_end : line_end + 1]
    order, elements, place = None, [], line_end + len(line_break)
    while place < len(head):
        line, terminator, _ = (
            head[place:].partition(line_break) if len(head) < 4096 else _partition_line(head, place, line_break)
        )
        place += len(line) + len(line_break)
        words = line.decode("utf-8", errors="replace").split()
        match words:
            case ["end_header"] if order is not None and terminator:
                _check_names(path, elements)
                return order, elements, place
            case ["format", kind, *_] if kind in ORDERS:
                order = ORDERS[kind]
            case ["element", name, rows] if rows.isascii() and rows.isdigit() and int(rows) < MOST_ROWS:
                elements.append(Element(name=name, rows=int(rows)))
            case ["property", "list", count, kind, name] if elements and count in TYPES and kind in TYPES:
                elements[-1].properties.append(Property(name=name, kind=TYPES[kind], count=TYPES[count]))
            case ["property", kind, name] if elements and kind in TYPES:
                elements[-1].properties.append(Property(name=name, kind=TYPES[kind]))
            case ["comment" | "obj_info", *_] | []:
                pass
            case _:
                quoted_line = quote_word(" ".join(words))
                raise FormatError(
                    f"{path} has a header with the line {quoted_line}, which PLY does not know; export it again"
                )
    raise FormatError(f"{path} has a header that is cut off; export the mesh again")


def _check_names(path: Path, elements: list[Element]) -> None:
    """Raise FormatError if two elements or properties share a name."""
    names = [
        [element.name for element in elements],
        *([prop.name for prop in element.properties] for element in elements),
    ]
    if any(len(set(group)) < len(group) for group in names):
        raise FormatError(f"{path} has a header in which two elements or properties have one name; export it again")


def _partition_line(head: bytes, place: int, end: bytes) -> tuple[bytes, bytes, bytes]:
    """Partition the text from `place` at the first `end`, as bytes.partition does, but leave the rest empty."""
    position = head.find(end, place)
    return (head[place:], b"", b"") if position < 0 else (head[place:position], end, b"")


def _vertices(path: Path, element: Element, columns: Columns) -> NDArray[np.float64]:
    """Return x, y and z of the vertices, (V, 3)."""
    names = {prop.name.lower(): prop.name for prop in element.properties if not prop.count}
    if not {"x", "y", "z"} <= set(names):
        raise FormatError(f"{path} has vertices without x, y and z; export the mesh again")
    return np.stack([columns[names[axis]] for axis in "xyz"], axis=1).astype(np.float64)


def _to_integers(path: Path, values: NDArray[Any]) -> NDArray[np.int64]:
    """Convert corners to integers; some programs write them as fractional numbers."""
    if values.dtype.kind == "f" and not ((np.abs(values) < 2**53) & (values == np.floor(values))).all():
        raise FormatError(f"{path} has faces whose corners are not whole numbers; export the mesh again")
    if values.dtype == np.uint64 and len(values) and values.max() >= 2**63:
        raise FormatError(f"{path} has faces with corners that do not exist; export the mesh again")
    return values.astype(np.int64)


def _cut_off_error(path: Path, element: Element) -> FormatError:
    """Return the error for a file that ends too early."""
    return FormatError(
        f"{path} is cut off: it announces {element.rows} of {quote_word(element.name)} and holds fewer; "
        "export the mesh again"
    )


# --- binary ----------------------------------------------------------------------------------------------


def _binary_rows(
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
        yield element, columns, "" if is_blank else f"{remaining:,} byte(s)"


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


# --- text ------------------------------------------------------------------------------------------------


def _text_rows(path: Path, data: bytes, elements: list[Element]) -> Iterator[tuple[Element, Columns, str]]:
    """Yield each element, the numbers of its rows, and a description of the words behind them."""
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
                f"{path} announces {smallest} number(s) or lists for each {quote_word(element.name)}, and row {row} "
                "does not begin or end with a line; export the mesh again"
            )
        place = int(starts[-1])
        yield element, columns, f"{count - place:,} word(s)" if count > place else ""


def _line_starts(path: Path, data: bytes, rows: int) -> NDArray[np.bool_] | None:
    """Return a mask of the words that begin a line, and True for the end; None for a text without lines."""
    lines = Lines(path=path, original=data, text=data.replace(b"\r", b"\n") + b"\n")
    if 2 * len(lines) < rows:
        return None
    is_start = np.zeros(len(lines.begins) + 1, dtype=bool)
    is_start[lines.first] = is_start[-1] = True
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
                    raise FormatError(f"{path} has a list of {written:g} numbers; export the mesh again")
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


def write_ply(surface: Surface, file: BinaryIO) -> None:
    """Write binary PLY."""
    file.write(
        "ply\nformat binary_little_endian 1.0\n"
        f"comment phasefill {__version__}, millimetres\n"
        f"element vertex {len(surface.vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(surface.faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
    )
    file.write(surface.vertices.astype("<f4").tobytes())
    faces = np.empty(len(surface.faces), dtype=FACE)
    faces["count"] = 3
    faces["corners"] = surface.faces
    file.write(faces.tobytes())
