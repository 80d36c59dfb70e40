"""Read points from a file: text in columns, .npy, and the vertices of a .ply."""

from __future__ import annotations

import csv
import itertools
import os
import re
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import require_readable, wrap_reader_errors
from infill.plain_numbers import count_noun, plain_argument

AXES = 3
MOST_COLUMNS = 16  # of a point: a place, a normal, a colour and more; an array with more is a picture
PLY_TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}
PLY_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
PLY_HEAD = 2**16  # bytes within which a header ends
NAMES = ({"x", "points:0", "x coordinate"}, {"y", "points:1", "y coordinate"}, {"z", "points:2", "z coordinate"})
NORMALS = tuple({f"n{axis}", f"normal_{axis}", f"normals:{i}"} for i, axis in enumerate("xyz"))
# Columns are normals if this share of them is as long as 1, to this much: colours are not.
MOST, UNIT = 0.95, 0.01


def read_points(path: str | os.PathLike[str]) -> NDArray[np.float64]:
    """Read the points of a file.

    Parameters
    ----------
    path : str or Path
        .xyz, .txt, .pts or .csv: one point per line, in columns separated by blanks, commas or semicolons; a #
        begins a comment. The first line may name the columns x, y and z; otherwise they are the first three. A first
        line with a single number gives the number of points. .npy: an array (N, 3) or wider. .ply: the vertices,
        text or binary.

    Returns
    -------
    (N, 3) float64
        x, y, z unchanged: none of these files states its unit.

    Raises
    ------
    FormatError
        If the file is missing, its suffix is unknown, or it holds no points or broken ones.
    """
    return read_points_and_normals(path)[0]


def read_points_and_normals(path: str | os.PathLike[str]) -> tuple[NDArray[np.float64], NDArray[np.float64] | None]:
    """Read points (N, 3) and normals (N, 3), or None without normals: see `read_points`.

    Normals are columns named nx, ny and nz, or those after x, y and z if no column has a name, of length 1.
    """
    source = require_readable(path, READERS, "a format of points")
    try:
        points = READERS[source.suffix.lower()](source)
    except OSError as error:
        raise FormatError(f"cannot read {source}: {error.strerror or error}; check the file") from error
    if points.ndim != 2 or points.shape[1] < AXES:
        raise FormatError(f"{source} has the shape {points.shape}; save points as (N, 3)")
    if len(points) == 0:
        raise FormatError(f"{source} holds no points; export them again")
    # Copies, detached from a mapped file and from its other columns.
    coordinates: NDArray[np.float64] = np.array(points[:, :AXES], dtype=np.float64)
    broken = np.flatnonzero(~np.isfinite(coordinates).all(axis=1))
    if broken.size:
        raise FormatError(
            f"{source} holds {count_noun(broken.size, 'point')} with NaN or infinite coordinates, first at number "
            f"{broken[0] + 1}; leave them out"
        )
    normals: NDArray[np.float64] = np.array(points[:, AXES : 2 * AXES], dtype=np.float64)
    return coordinates, normals if _are_normals(normals) else None


def _are_normals(columns: NDArray[np.float64]) -> bool:
    """Tell whether almost all rows have length 1."""
    if columns.shape[1] < AXES:
        return False
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.linalg.norm(columns, axis=1)
        return bool((np.abs(lengths - 1) <= UNIT).mean() >= MOST)


def _wrap_errors(path: Path) -> AbstractContextManager[None]:
    """Turn an exception of NumPy about a broken file into a FormatError."""
    return wrap_reader_errors(path, "is broken or holds no points", "export them again")


# --- text ------------------------------------------------------------------------------------------------


def _read_text(path: Path) -> NDArray[np.floating]:
    """Read points as text, with columns of normals if all lines have them."""
    try:
        return _read_columns(path, normals=True)
    except FormatError:  # the first line may have columns that others lack
        return _read_columns(path, normals=False)


def _read_columns(path: Path, *, normals: bool) -> NDArray[np.floating]:
    """Read x, y and z, and optionally the next columns or the named normals, if the first line has them."""
    # Only comments and names can contain non-ASCII characters; their encoding does not matter.
    with _wrap_errors(path), path.open(encoding="utf-8-sig", errors="replace") as file:
        lines = (line for line in file if line.partition("#")[0].strip(" \t\r\n,;"))
        first_line = next(lines, "")
        separator = _find_separator(first_line)
        columns: tuple[int, ...] = ()
        count = None
        if len(_split_fields(first_line, separator)) == 1 and _is_number(_split_fields(first_line, separator)[0]):
            count = float(first_line.partition("#")[0])
            first_line = next(lines, "")
            separator = _find_separator(first_line)
        elif not all(_is_number(field) for field in _split_fields(first_line, separator)[:AXES]):
            columns = _point_columns(_split_fields(first_line, separator))
            first_line = next(lines, "")
            separator = _find_separator(first_line)
        if not first_line:
            raise FormatError(f"{path} holds no points; export them again")
        columns = columns or tuple(range(min(2 * AXES, max(AXES, len(_split_fields(first_line, separator))))))
        if len(columns) < 2 * AXES or not normals:
            columns = columns[:AXES]
        points = np.loadtxt(
            itertools.chain([first_line], lines),
            usecols=columns,
            ndmin=2,
            comments="#",
            delimiter=separator,
            quotechar='"',
        )
    if count is not None and count != len(points):
        raise FormatError(f"{path} announces {plain_argument(count)} points and holds {len(points)}; export them again")
    return points


def _find_separator(line: str) -> str | None:
    """Return the separator of a line, a semicolon or a comma; None for blanks."""
    return next((mark for mark in ";," if mark in line.partition("#")[0]), None)


def _split_fields(line: str, separator: str | None) -> list[str]:
    """Split a line into fields, without its comment."""
    text = line.partition("#")[0].strip()
    return [field.strip() for field in next(csv.reader([text], delimiter=separator), [])] if separator else text.split()


def _is_number(text: str) -> bool:
    """Tell whether a field is a number."""
    try:
        float(text.strip('"'))
    except ValueError:
        return False
    return True


def _point_columns(names: list[str]) -> tuple[int, ...]:
    """Return the columns of x, y and z, by name or else the first three, then those of named normals.

    Columns are found by name or by its first word ("x_mm", "X [mm]"); else x, y and z are the first three.
    """
    plain = [name.strip("\"' ").lower() for name in names]
    words = [re.split(r"[\s_(\[/]", name)[0] for name in plain]
    normal_columns = _columns_of(plain, NORMALS)
    for candidates in (plain, words):
        if columns := _columns_of(candidates, NAMES):
            return columns + normal_columns
    return tuple(range(AXES)) + normal_columns


def _columns_of(names: list[str], axis_names: tuple[set[str], ...]) -> tuple[int, ...]:
    """Return the columns with names of each axis, or an empty tuple if an axis is missing."""
    places = [next((i for i, name in enumerate(names) if name in axis), None) for axis in axis_names]
    columns = tuple(i for i in places if i is not None)
    return columns if len(columns) == AXES else ()


# --- arrays and meshes -----------------------------------------------------------------------------------


def _read_npy(path: Path) -> NDArray[np.floating]:
    """Memory-map an array of points."""
    with _wrap_errors(path):
        points = npy_format.open_memmap(path, mode="r")
    if points.ndim == 2 and points.shape[1] > MOST_COLUMNS:
        raise FormatError(
            f"{path} holds an array of shape {points.shape}; with two axes it is read as points, N x 3, and a "
            "volume has three: stack the slices"
        )
    if points.dtype.kind not in "iuf":
        raise FormatError(f"{path} holds values of type {points.dtype}; save points as numbers")
    return points


def _read_ply(path: Path) -> NDArray[np.floating]:
    """Read the vertices of a PLY file."""
    with _wrap_errors(path), path.open("rb") as file:
        header, order = _ply_header(path, file)
        for element, count, properties in header:
            if element == "vertex":
                return _ply_vertices(path, file, order, count, properties)
            if any(kind is None for _, kind in properties):
                raise FormatError(f"{path} has {element} lists in front of its vertices; export it with vertices first")
            _ply_rows(file, order, count, properties)
    raise FormatError(f"{path} holds no vertices; export them again")


Properties = list[tuple[str, str | None]]  # name and NumPy type; None for a list


def _ply_header(path: Path, file: BinaryIO) -> tuple[list[tuple[str, int, Properties]], str]:
    """Parse the header; return the elements and the byte order."""
    elements: list[tuple[str, int, Properties]] = []
    order = None
    if file.readline(PLY_HEAD).strip() != b"ply":
        raise FormatError(f"{path} is not a PLY file; export the points again")
    while file.tell() < PLY_HEAD:
        words = file.readline(PLY_HEAD).decode("ascii", errors="replace").split()
        match words:
            case ["end_header"] if order is not None:
                return elements, order
            case ["format", kind, *_] if kind in PLY_ORDERS:
                order = PLY_ORDERS[kind]
            case ["element", name, count]:
                elements.append((name, int(count), []))
            case ["property", "list", _, _, name] if elements:
                elements[-1][2].append((name, None))
            case ["property", kind, name] if elements and kind in PLY_TYPES:
                elements[-1][2].append((name, PLY_TYPES[kind]))
            case ["comment" | "obj_info", *_]:
                pass
            case _:
                break
    raise FormatError(f"{path} has a PLY header that is broken or cut off; export the points again")


def _ply_vertices(path: Path, file: BinaryIO, order: str, count: int, properties: Properties) -> NDArray[np.floating]:
    """Read x, y and z of the vertices, and their normals if the file has them."""
    names = [name for name, _ in properties]
    if not {"x", "y", "z"} <= set(names) or any(kind is None for _, kind in properties):
        raise FormatError(f"{path} has vertices without x, y and z, or with lists; export plain points")
    rows = _ply_rows(file, order, count, properties)
    if len(rows) < count:
        raise FormatError(f"{path} is cut off: it holds {len(rows)} vertices of {count}; export it again")
    column_names = [*"xyz", *(normal for normal in ("nx", "ny", "nz") if {"nx", "ny", "nz"} <= set(names))]
    return np.stack([rows[:, names.index(name)] if not order else rows[name] for name in column_names], axis=1)


def _ply_rows(file: BinaryIO, order: str, count: int, properties: Properties) -> NDArray[Any]:
    """Read the rows of an element: a structured array if binary, columns if text."""
    if count < 0:
        raise ValueError(f"{count} rows")
    if order:
        row = np.dtype([(name, order + kind) for name, kind in properties if kind])
        remaining = os.fstat(file.fileno()).st_size - file.tell()
        data = file.read(min(row.itemsize * count, remaining))
        return np.frombuffer(data[: len(data) // row.itemsize * row.itemsize], dtype=row)
    lines = list(itertools.islice((line for line in file if line.strip()), count))
    return np.loadtxt(lines, ndmin=2, comments=None) if lines else np.empty((0, len(properties)))


READERS: dict[str, Callable[[Path], NDArray[np.floating]]] = {
    ".xyz": _read_text,
    ".txt": _read_text,
    ".pts": _read_text,
    ".csv": _read_text,
    ".npy": _read_npy,
    ".ply": _read_ply,
}
