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
BLANK, LONGEST_BLANK = b"\0\t\n\r ", 2**12  # what may follow the last row, and how much of it


@dataclass(frozen=True, kw_only=True)
class Property:
    """A property of an element.

    Parameters
    ----------
    name : str
    kind : str
        NumPy's name of the type of its numbers, without the order of bytes.
    count : str
        That of the number in front of a list; empty if it is no list.
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
        """Return the list of corners, by its name, or by being the only list of whole numbers."""
        lists = [each for each in self.properties if each.count]
        named = [each for each in lists if each.name.lower() in CORNER_LISTS]
        whole = [each for each in lists if each.kind[0] in "iu"]
        return named[0] if named else whole[0] if len(whole) == 1 else None


Columns = dict[str, NDArray[Any]]  # of a list: its numbers, one row after another, and under "name#" how many a row has


def read_ply(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64], tuple[str, ...]]:
    """Return vertices, triangles, and a note on what follows the last row; polygons and triangle strips are split.

    Raises
    ------
    FormatError
        If the header is not that of a PLY file, or the numbers that it announces are not there.
    """
    data = path.read_bytes()
    order, elements, begin = _header(path, data)
    rows = _text_rows(path, data[begin:], elements) if not order else _binary_rows(path, data, begin, order, elements)
    vertices: NDArray[np.float64] | None = None
    faces: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    strips: list[tuple[NDArray[np.int64], NDArray[np.int64]]] = []
    rest = ""
    for element, columns, left in rows:
        rest = left  # of the last of them
        if element.name == "vertex":
            vertices = _vertices(path, element, columns)
        elif element.name in ("face", "tristrips") and element.rows:
            corners = element.corners()
            if corners is None:
                raise FormatError(f"{path} has a {element.name} without a list vertex_indices; export the mesh again")
            found = (_whole(path, columns[corners.name]), columns[f"{corners.name}#"].astype(np.int64))
            (faces if element.name == "face" else strips).append(found)
    if vertices is None:
        raise FormatError(f"{path} holds no vertices; export the mesh again")
    triangles = [np.empty((0, 3), dtype=np.int64)]
    for flat, counts in faces:
        require_corners(path, flat, len(vertices))
        triangles.append(split_polygons(vertices, flat, counts))
    triangles += [split_strips(flat, counts) for flat, counts in strips]
    notes = (f"{rest} follow the last row that it announces: they are left out",) if rest else ()
    return vertices, np.concatenate(triangles), notes


def require_corners(path: Path, corners: NDArray[np.int64], vertices: int) -> None:
    """Raise FormatError if polygons have corners beyond the vertices of a file that counts them from 0."""
    if len(corners) and (corners.min() < 0 or corners.max() >= vertices):
        wrong = corners[(corners < 0) | (corners >= vertices)][0]
        raise FormatError(
            f"{path} has a face with corner {wrong}, which does not exist: it holds {vertices} vertices, "
            "counted from 0; export the mesh again"
        )


def _header(path: Path, data: bytes) -> tuple[str, list[Element], int]:
    """Return the order of bytes, empty for text, the elements, and where their rows begin."""
    head = data[:HEAD]
    first = min((place for mark in (b"\n", b"\r") if (place := head.find(mark)) >= 0), default=-1)
    if head[:3] != b"ply" or first < 0 or head[3:first].strip():
        raise FormatError(f"{path} is broken or not a .ply file (it does not begin with 'ply'); export the mesh again")
    end = b"\r\n" if head[first : first + 2] == b"\r\n" else head[first : first + 1]
    order, elements, place = None, [], first + len(end)
    while place < len(head):
        line, found, _ = head[place:].partition(end) if len(head) < 4096 else _line(head, place, end)
        place += len(line) + len(end)
        words = line.decode("utf-8", errors="replace").split()
        match words:
            case ["end_header"] if order is not None and found:
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
                shown = quote_word(" ".join(words))
                raise FormatError(
                    f"{path} has a header with the line {shown}, which PLY does not know; export it again"
                )
    raise FormatError(f"{path} has a header that is cut off; export the mesh again")


def _check_names(path: Path, elements: list[Element]) -> None:
    """Raise FormatError if a name stands for two things."""
    names = [[each.name for each in elements], *([each.name for each in element.properties] for element in elements)]
    if any(len(set(some)) < len(some) for some in names):
        raise FormatError(f"{path} has a header in which two elements or properties have one name; export it again")


def _line(head: bytes, place: int, end: bytes) -> tuple[bytes, bytes, bytes]:
    """Return a line, its end if it has one, and nothing."""
    stop = head.find(end, place)
    return (head[place:], b"", b"") if stop < 0 else (head[place:stop], end, b"")


def _vertices(path: Path, element: Element, columns: Columns) -> NDArray[np.float64]:
    names = {each.name.lower(): each.name for each in element.properties if not each.count}
    if not {"x", "y", "z"} <= set(names):
        raise FormatError(f"{path} has vertices without x, y and z; export the mesh again")
    return np.stack([columns[names[axis]] for axis in "xyz"], axis=1).astype(np.float64)


def _whole(path: Path, values: NDArray[Any]) -> NDArray[np.int64]:
    """Return the numbers of corners as integers, which some programs write as fractional numbers."""
    if values.dtype.kind == "f" and not ((np.abs(values) < 2**53) & (values == np.floor(values))).all():
        raise FormatError(f"{path} has faces whose corners are not whole numbers; export the mesh again")
    if values.dtype == np.uint64 and len(values) and values.max() >= 2**63:
        raise FormatError(f"{path} has faces with corners that do not exist; export the mesh again")
    return values.astype(np.int64)


def _cut_off(path: Path, element: Element) -> FormatError:
    return FormatError(
        f"{path} is cut off: it announces {element.rows} of {quote_word(element.name)} and holds fewer; "
        "export the mesh again"
    )


# --- binary ----------------------------------------------------------------------------------------------


def _binary_rows(
    path: Path, data: bytes, place: int, order: str, elements: list[Element]
) -> Iterator[tuple[Element, Columns, str]]:
    """Yield each element with the numbers of its rows, and how much follows them."""
    for element in elements:
        smallest = sum(np.dtype(each.count or each.kind).itemsize for each in element.properties)
        if element.rows * smallest > len(data) - place:
            raise _cut_off(path, element)
        if not any(each.count for each in element.properties):
            columns = _plain_rows(data, place, order, element)
            place += element.rows * smallest
        else:
            alike = _rows_alike(data, place, order, element)
            columns, place = alike if alike else _rows_that_differ(path, data, place, order, element)
        rest = len(data) - place
        is_blank = rest <= LONGEST_BLANK and not data[place:].strip(BLANK)
        yield element, columns, "" if is_blank else f"{rest:,} byte(s)"


def _plain_rows(data: bytes, place: int, order: str, element: Element) -> Columns:
    row = np.dtype([(str(i), order + each.kind) for i, each in enumerate(element.properties)])
    if not row.itemsize:
        return {}
    rows = np.frombuffer(data, dtype=row, count=element.rows, offset=place)
    return {each.name: rows[str(i)] for i, each in enumerate(element.properties)}


def _rows_alike(data: bytes, place: int, order: str, element: Element) -> tuple[Columns, int] | None:
    """Return the numbers of rows whose lists are as long as those of the first, and their end; None if they differ."""
    if element.rows == 0:
        return _no_rows(element), place
    fields: list[tuple[str, Any]] = []
    lengths, at = [], place
    for i, each in enumerate(element.properties):
        kind, length = np.dtype(order + each.kind), 1
        if each.count:
            count = np.dtype(order + each.count)
            if at + count.itemsize > len(data):
                return None
            number = np.frombuffer(data, dtype=count, count=1, offset=at)[0].item()
            if not 0 <= number <= len(data) or number != int(number):
                return None
            length = int(number)
            fields.append((f"{i}#", count))
            at += count.itemsize
        fields.append((f"{i}", (kind, (length,)) if each.count else kind))
        at += length * kind.itemsize
        lengths.append(length)
    row = at - place
    if row * element.rows > len(data) - place:
        return None
    rows = np.frombuffer(data, dtype=np.dtype(fields), count=element.rows, offset=place)
    columns: Columns = {}
    for i, (each, length) in enumerate(zip(element.properties, lengths, strict=True)):
        if each.count:
            if not (rows[f"{i}#"] == length).all():
                return None
            columns[f"{each.name}#"] = np.full(element.rows, length)
            columns[each.name] = rows[f"{i}"].ravel()
        else:
            columns[each.name] = rows[f"{i}"]
    return columns, place + row * element.rows


def _no_rows(element: Element) -> Columns:
    columns: Columns = {each.name: np.empty(0, dtype=each.kind) for each in element.properties}
    return columns | {f"{each.name}#": np.empty(0, dtype=np.int64) for each in element.properties if each.count}


def _rows_that_differ(path: Path, data: bytes, place: int, order: str, element: Element) -> tuple[Columns, int]:
    """Return the numbers of rows whose lists differ in length, and where they end."""
    begins: list[list[int]] = [[] for _ in element.properties]
    lengths: list[list[int]] = [[] for _ in element.properties]
    end = len(data)
    # Bytes to pass, then the list: what lies in front of it takes as much in every row.
    steps = [
        (begin, length, np.dtype(order + each.count) if each.count else None, np.dtype(each.kind).itemsize)
        for begin, length, each in zip(begins, lengths, element.properties, strict=True)
    ]
    byteorder = "big" if order == ">" else "little"
    for _ in range(element.rows):
        for begin, length, count, size in steps:
            number = 1
            if count is not None:
                after = place + count.itemsize
                if count.kind == "f":
                    number = _length(data, place, count)
                else:
                    number = int.from_bytes(data[place:after], byteorder, signed=count.kind == "i")  # type: ignore[arg-type]
                place = after
                if number < 0:
                    raise FormatError(f"{path} has a list of {number} numbers; export the mesh again")
                length.append(number)
            begin.append(place)
            place += number * size
        if place > end:
            raise _cut_off(path, element)
    raw = np.frombuffer(data, dtype=np.uint8)
    columns: Columns = {}
    for begin, length, each in zip(begins, lengths, element.properties, strict=True):
        kind = np.dtype(order + each.kind)
        counts = np.array(length, dtype=np.int64) if each.count else np.ones(element.rows, dtype=np.int64)
        first = np.repeat(np.array(begin, dtype=np.int64) - (np.cumsum(counts) - counts) * kind.itemsize, counts)
        places = first + np.arange(len(first)) * kind.itemsize
        found = raw[places[:, None] + np.arange(kind.itemsize)]
        columns[each.name] = found.reshape(-1).view(kind) if len(found) else np.empty(0, dtype=kind)
        if each.count:
            columns[f"{each.name}#"] = counts
    return columns, place


def _length(data: bytes, place: int, count: np.dtype[Any]) -> int:
    """Return the length of a list that is written as a fractional number."""
    if place + count.itemsize > len(data):
        return 0
    number = float(np.frombuffer(data, dtype=count, count=1, offset=place)[0])
    return int(number) if number == number and abs(number) < MOST_ROWS and number == int(number) else -1


# --- text ------------------------------------------------------------------------------------------------


def _text_rows(path: Path, data: bytes, elements: list[Element]) -> Iterator[tuple[Element, Columns, str]]:
    """Yield each element with the numbers of its rows, and how much follows them."""
    values, count = _words_as_numbers(data)
    line_starts = _line_starts(path, data, sum(element.rows for element in elements))
    place = 0
    for element in elements:
        smallest = len(element.properties)
        if element.rows * smallest > len(values) - place:
            raise _too_few(path, data, element)
        if any(each.count for each in element.properties):
            try:
                columns, starts = _text_lists(path, values, place, element)
            except EOFError:
                raise _too_few(path, data, element) from None
        else:
            table = values[place : place + element.rows * smallest].reshape(element.rows, smallest)
            columns = {each.name: table[:, i] for i, each in enumerate(element.properties)}
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
    """Return which words begin a line, what follows the last one included; None for a text that is not in lines."""
    lines = Lines(path=path, original=data, text=data.replace(b"\r", b"\n") + b"\n")
    if 2 * len(lines) < rows:
        return None
    found = np.zeros(len(lines.begins) + 1, dtype=bool)
    found[lines.first] = found[-1] = True
    return found


def _words_as_numbers(data: bytes) -> tuple[NDArray[np.float64], int]:
    """Return the numbers of a text up to the first word that is not one, and how many words it has."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            values = np.fromstring(data, dtype=np.float64, sep=" ")
            return values, len(values)
        except (DeprecationWarning, ValueError):  # words behind the numbers, or between them
            words = data.split()
    wrong = next((place for place, word in enumerate(words) if number_complaint(word)), len(words))
    values = np.array(words[:wrong], dtype="S").astype(np.float64) if wrong else np.empty(0)
    return values, len(words)


def _too_few(path: Path, data: bytes, element: Element) -> FormatError:
    """Return the error about numbers that end too early: at a word that is none, or at the end of the file."""
    for word in data.split():
        if complaint := number_complaint(word):
            return FormatError(f"{path}: {complaint}; export the mesh again")
    return _cut_off(path, element)


def _text_lists(
    path: Path, values: NDArray[np.float64], place: int, element: Element
) -> tuple[Columns, NDArray[np.int64]]:
    """Return the numbers of rows with lists, and which word each begins with, and what follows the last one."""
    first = [each for each in element.properties if each.count]
    if len(first) == len(element.properties) == 1 and element.rows:  # as most files are
        count = values[place]
        if 0 <= count <= len(values) and count == int(count):
            width = int(count) + 1
            rows = values[place : place + width * element.rows]
            if len(rows) == width * element.rows and (rows[::width] == count).all():
                name = element.properties[0].name
                table = rows.reshape(element.rows, width)
                found = {name: table[:, 1:].ravel(), f"{name}#": np.full(element.rows, int(count))}
                return found, place + width * np.arange(element.rows + 1)
    begins: list[list[int]] = [[] for _ in element.properties]
    lengths: list[list[int]] = [[] for _ in element.properties]
    starts = [place]
    end = len(values)
    for _ in range(element.rows):
        for i, each in enumerate(element.properties):
            number = 1
            if each.count:
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
    for begin, length, each in zip(begins, lengths, element.properties, strict=True):
        counts = np.array(length, dtype=np.int64) if each.count else np.ones(element.rows, dtype=np.int64)
        first_of = np.repeat(np.array(begin, dtype=np.int64) - (np.cumsum(counts) - counts), counts)
        columns[each.name] = values[first_of + np.arange(len(first_of))]
        if each.count:
            columns[f"{each.name}#"] = counts
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
