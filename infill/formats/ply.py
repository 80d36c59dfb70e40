"""PLY: a header of text and rows of numbers, without a unit."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.excerpts import quote_word
from infill.formats.label_walls import LabelWalls, label_type
from infill.formats.ply_rows import MOST_ROWS, Columns, Element, Property, read_binary_rows, read_text_rows
from infill.meshes.polygons import split_polygons, split_strips
from infill.surface import Surface
from infill.version import __version__

CORNERS = 3  # of a triangle
FACE: tuple[tuple[Any, ...], ...] = (("count", "u1"), ("corners", "<i4", CORNERS))
NAMES = {"i4": "int", "u4": "uint", "f8": "double"}  # of the numbers that are written
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
HEAD = 2**20  # bytes within which a header ends


def read_ply(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64], tuple[str, ...]]:
    """Read vertices and triangles; split polygons and strips, and add a note on trailing bytes.

    Raises
    ------
    FormatError
        If the header is not that of a PLY file, or announced numbers are missing.
    """
    data = path.read_bytes()
    order, elements, begin = _header(path, data)
    rows = (
        read_text_rows(path, data[begin:], elements)
        if not order
        else read_binary_rows(path, data, begin, order, elements)
    )
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
    notes = (f"left out {note} after the last row that it announces",) if note else ()
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
        end = head.find(line_break, place)
        line = head[place : end if end >= 0 else None]
        place += len(line) + len(line_break)
        words = line.decode("utf-8", errors="replace").split()
        match words:
            case ["end_header"] if order is not None and end >= 0:
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


def ply_header(vertices: int, triangles: int, properties: str = "") -> bytes:
    """Return the header of binary PLY; `properties` are lines for the values of faces besides their corners."""
    return (
        "ply\nformat binary_little_endian 1.0\n"
        f"comment phasefill {__version__}, millimetres\n"
        f"element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {triangles}\nproperty list uchar int vertex_indices\n{properties}end_header\n"
    ).encode()


def write_ply(surface: Surface, file: BinaryIO) -> None:
    """Write binary PLY."""
    _write_rows(surface.vertices, surface.faces, {}, file)


def write_ply_walls(walls: LabelWalls, file: BinaryIO) -> None:
    """Write binary PLY whose faces have two more numbers, the labels behind and in front of each; 0 is outside."""
    labels = walls.labels.astype(label_type(walls.labels))
    _write_rows(walls.points, walls.triangles, {"label_back": labels[:, 0], "label_front": labels[:, 1]}, file)


def _write_rows(
    vertices: NDArray[np.floating],
    triangles: NDArray[np.integer],
    numbers: Mapping[str, NDArray[np.generic]],
    file: BinaryIO,
) -> None:
    """Write the header, the vertices, and the triangles, each with its numbers by name."""
    faces = np.empty(len(triangles), dtype=[*FACE, *((name, column.dtype) for name, column in numbers.items())])
    faces["count"], faces["corners"] = CORNERS, triangles
    for name, column in numbers.items():
        faces[name] = column
    properties = "".join(f"property {NAMES[column.dtype.str[1:]]} {name}\n" for name, column in numbers.items())
    file.write(ply_header(len(vertices), len(triangles), properties))
    file.write(vertices.astype("<f4").tobytes())
    file.write(faces.tobytes())
