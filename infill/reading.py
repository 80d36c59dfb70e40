"""A mesh from a file, its vertices merged where that is needed to close it."""

from __future__ import annotations

import codecs
import io
import os
import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.export import STL_RECORD
from infill.surface import Surface
from infill.surfaces.merging import closed_or_merged

STL_HEAD = 84
NUMBER = rb"\s+([^\s]+)"
STL_VERTEX = re.compile(rb"[\r\n]\s*vertex" + 3 * NUMBER, re.IGNORECASE)
STL_VERTEX_WORD = re.compile(rb"[\r\n]\s*vertex\b", re.IGNORECASE)
UNITS_3MF = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
IDENTITY = "1 0 0 0 1 0 0 0 1 0 0 0"
# What the readers of trimesh raise for files that hold something else than they should.
BROKEN = (ValueError, LookupError, TypeError, AttributeError, EOFError, struct.error, NotImplementedError)
BROKEN_3MF = (zipfile.BadZipFile, ElementTree.ParseError, EOFError, zlib.error, RuntimeError, LookupError, ValueError)
TEXT_FORMATS = {".obj", ".off"}


def read_mesh(path: str | os.PathLike[str]) -> Surface:
    """Return the triangles of a file.

    Equal vertices are merged, but for a mesh that is closed as it stands: there the file says on purpose
    which of two equal vertices a triangle has. Triangles with two equal corners are kept.

    Parameters
    ----------
    path : str or Path
        .stl (binary or text), .3mf, .obj, .ply, .off or .glb. 3MF says its unit and comes out in
        millimetres; the others say none and are taken as they are.

    Returns
    -------
    Surface

    Raises
    ------
    FormatError
        If there is no such file, its suffix is unknown, or it holds no triangles or broken ones.
    """
    source = readable(path, READERS, "a mesh format")
    try:
        vertices, faces = READERS[source.suffix.lower()](source)
    except OSError as error:
        raise FormatError(f"cannot read {source}: {error.strerror or error}; check the file") from error
    if len(faces) == 0:
        raise FormatError(f"{source} holds no triangles; export the mesh again")
    if not np.isfinite(vertices).all():
        raise FormatError(f"{source} holds coordinates that are not numbers; export the mesh again")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise FormatError(f"{source} has triangles with corners that do not exist; export the mesh again")
    return closed_or_merged(vertices, faces)


def readable(path: str | os.PathLike[str], suffixes: Iterable[str], what: str) -> Path:
    """Return the path of a file that is there and has one of the suffixes, or raise FormatError."""
    source = Path(path)
    if source.suffix.lower() not in suffixes:
        raise FormatError(f"cannot tell {what} from {source.name!r}; use one of {', '.join(suffixes)}")
    if not source.is_file():
        raise FormatError(f"there is no file {source}; check the name")
    return source


def _read_stl(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    data = path.read_bytes()
    count = int.from_bytes(data[80:STL_HEAD], "little")
    if count and len(data) >= STL_HEAD + count * STL_RECORD.itemsize:  # some programs add bytes at the end
        corners = np.frombuffer(data, dtype=STL_RECORD, offset=STL_HEAD, count=count)["corners"]
    elif data.removeprefix(codecs.BOM_UTF8).lstrip()[:5].lower() == b"solid":
        corners = _text_corners(path, data)
    elif len(data) == STL_HEAD and not count:
        corners = np.empty((0, 3, 3), dtype=np.float32)
    else:
        raise FormatError(
            f"{path} is neither text nor a whole binary STL ({len(data)} bytes, {count} triangles announced); "
            "export the mesh again"
        )
    return corners.reshape(-1, 3), np.arange(len(corners) * 3).reshape(-1, 3)


def _text_corners(path: Path, data: bytes) -> NDArray[np.floating]:
    found = STL_VERTEX.findall(data)
    broken = FormatError(f"{path} holds a vertex that is not three numbers, or is cut off; export the mesh again")
    if len(found) != len(STL_VERTEX_WORD.findall(data)) or len(found) % 3:
        raise broken
    try:
        return np.array(found, dtype="S").astype(np.float32).reshape(-1, 3, 3)
    except ValueError as error:
        raise broken from error


def _read_3mf(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Read the build of a 3MF: objects, components and their transforms; core specification."""
    # The standard parser fetches nothing from outside, and what it makes is only counted and multiplied.
    try:
        with zipfile.ZipFile(path) as package:
            models = [name for name in package.namelist() if name.lower().endswith(".model")]
            roots = {f"/{name}": ElementTree.fromstring(package.read(name)) for name in models}  # noqa: S314
            start = _start_part(package)
    except BROKEN_3MF as error:
        raise FormatError(f"{path} is no 3MF file ({error}); export the mesh again") from error
    built = [part for part, each in roots.items() if each.find("{*}build/{*}item") is not None]
    main = start if start in roots else next(iter(built), "")
    root = roots.get(main)
    if root is None or root.find("{*}build") is None:
        raise FormatError(f"{path} has nothing to build in it; export the mesh again")
    objects = {
        (part, each.get("id")): each
        for part, model in roots.items()
        for each in model.findall("{*}resources/{*}object")
    }
    vertices: list[NDArray[np.floating]] = []
    faces: list[NDArray[np.integer]] = []

    def place(part: str, number: str | None, outer: NDArray[np.floating], depth: int = 0) -> None:
        each = objects.get((part, number))
        if each is None or depth > 20:
            raise FormatError(f"{path} refers to an object {number} that it does not hold; export the mesh again")
        corners = [
            [float(v.get(axis, "nan")) for axis in "xyz"] for v in each.iterfind("{*}mesh/{*}vertices/{*}vertex")
        ]
        triangles = [
            [int(t.get(corner, -1)) for corner in ("v1", "v2", "v3")]
            for t in each.iterfind("{*}mesh/{*}triangles/{*}triangle")
        ]
        if triangles:
            if max(map(max, triangles)) >= len(corners) or min(map(min, triangles)) < 0:
                raise FormatError(f"{path} has triangles with corners that do not exist; export the mesh again")
            # A mirrored part would face inwards: its corners are taken in the other order.
            ordered = np.array(triangles)[:, :: -1 if np.linalg.det(outer[:3]) < 0 else 1]
            faces.append(ordered + sum(len(some) for some in vertices))
            vertices.append(np.array(corners) @ outer[:3] + outer[3])
        for component in each.iterfind("{*}components/{*}component"):
            inner = _transform(component.get("transform", IDENTITY))
            joined = np.concatenate([inner[:3] @ outer[:3], inner[3:] @ outer[:3] + outer[3]])
            place(_path(component, part), component.get("objectid"), joined, depth + 1)

    try:
        for item in root.iterfind("{*}build/{*}item"):
            if item.get("printable") == "0":
                continue
            place(_path(item, main), item.get("objectid"), _transform(item.get("transform", IDENTITY)))
    except ValueError as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(f"{path} holds a number that is none ({error}); export the mesh again") from error
    if not faces:
        return np.empty((0, 3)), np.empty((0, 3), dtype=int)
    return np.concatenate(vertices) * UNITS_3MF.get(root.get("unit", "millimeter"), 1.0), np.concatenate(faces)


def _start_part(package: zipfile.ZipFile) -> str:
    """Return the part that the package says to begin with, or nothing."""
    if "_rels/.rels" not in package.namelist():
        return ""
    relations = ElementTree.fromstring(package.read("_rels/.rels"))  # noqa: S314 - as the models
    targets = [each.get("Target", "") for each in relations if each.get("Type", "").endswith("/3dmodel")]
    return "/" + targets[0].lstrip("/") if targets else ""


def _path(element: ElementTree.Element, part: str) -> str:
    """Return the part in which the object of a component or an item stands."""
    return next((value for key, value in element.items() if key.endswith("}path")), part)


def _transform(text: str) -> NDArray[np.float64]:
    """Return the 4 x 3 matrix of a 3MF transform: points are rows, multiplied from the left."""
    return np.array([float(number) for number in text.split()]).reshape(4, 3)


def _read_by_trimesh(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    import trimesh

    try:
        if path.suffix.lower() in TEXT_FORMATS:
            # Only comments and names can hold what is not ASCII; their encoding does not matter.
            text = path.read_bytes().decode("ascii", errors="replace")
            mesh = trimesh.load_mesh(io.StringIO(text), file_type=path.suffix.lower()[1:], process=False)
        else:
            mesh = trimesh.load_mesh(path, process=False)
    except BROKEN as error:
        raise FormatError(f"{path} is broken ({type(error).__name__}: {error}); export the mesh again") from error
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


READERS: dict[str, Callable[[Path], tuple[NDArray[np.floating], NDArray[np.integer]]]] = {
    ".stl": _read_stl,
    ".3mf": _read_3mf,
    ".obj": _read_by_trimesh,
    ".ply": _read_by_trimesh,
    ".off": _read_by_trimesh,
    ".glb": _read_by_trimesh,
}
