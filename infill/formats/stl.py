"""STL, binary and text: triangles with separate corners, without a unit."""

from __future__ import annotations

import codecs
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.rows import AT_ONCE
from infill.formats.text_lines import read_plain_text, wide_encoding
from infill.kernels.compiling import log_compilation
from infill.kernels.threads import in_threads, thread_count
from infill.plain_numbers import count_noun
from infill.surface import Surface
from infill.version import __version__

HEAD_BYTES = 84
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
FACET = ("facet normal {0} {0} {0}\n outer loop\n" + 3 * "  vertex {0} {0} {0}\n" + " endloop\nendfacet\n").format(
    "%.9g"
)
NUMBER = rb"\s+([^\s]+)"
LOOP_WORD = re.compile(rb"[\r\n]\s*outer\s+loop\b", re.IGNORECASE)
VERTEX = re.compile(rb"[\r\n]\s*vertex" + 3 * NUMBER, re.IGNORECASE)
VERTEX_WORD = re.compile(rb"[\r\n]\s*vertex\b", re.IGNORECASE)


def read_stl(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer], tuple[str, ...]]:
    """Read vertices, three for each triangle, and faces; return them with a note on trailing bytes.

    Raises
    ------
    FormatError
        If a binary file does not hold the announced triangles, or a text has other facets than triangles.
    """
    data = path.read_bytes()
    notes: tuple[str, ...] = ()
    count = int.from_bytes(data[80:HEAD_BYTES], "little")
    size = HEAD_BYTES + count * RECORD.itemsize
    if count and len(data) >= size and (len(data) == size or not wide_encoding(data)):
        notes = _check_rest(path, count, data[size:])
        corners = np.frombuffer(data, dtype=RECORD, offset=HEAD_BYTES, count=count)["corners"]
    elif wide_encoding(data) or (
        data.removeprefix(codecs.BOM_UTF8).lstrip()[:5].lower() == b"solid" and b"\0" not in data
    ):
        corners = _text_corners(path, read_plain_text(path))
    elif len(data) == HEAD_BYTES and not count:
        corners = np.empty((0, 3, 3), dtype=np.float32)
    else:
        raise FormatError(
            f"{path} is neither text nor a whole binary STL ({len(data)} bytes, {count} triangles announced); "
            "export the mesh again"
        )
    return corners.reshape(-1, 3), np.arange(len(corners) * 3).reshape(-1, 3), notes


def _check_rest(path: Path, count: int, rest: bytes) -> tuple[str, ...]:
    """Return a note on the bytes behind the triangles; raise FormatError if those are triangles.

    Some programs add bytes of their own.
    """
    extra, remainder = divmod(len(rest), RECORD.itemsize)
    announced = int.from_bytes(rest[80:HEAD_BYTES], "little")
    if b"facet" in rest or (announced and len(rest) == HEAD_BYTES + announced * RECORD.itemsize):
        raise FormatError(f"{path} holds a second STL behind its {count} triangles; export each into a file of its own")
    if extra and not remainder:
        raise FormatError(
            f"{path} announces {count} triangles and holds {count + extra}: part of it would be left out; "
            "export the mesh again"
        )
    if not rest.strip(b"\0\t\n\r "):
        return ()
    return (f"left out {count_noun(len(rest), 'byte')} after the last triangle that it announces",)


def _text_corners(path: Path, text: bytes) -> NDArray[np.floating]:
    """Parse the corners of all triangles in a text, (n, 3, 3)."""
    text = b"\n" + text
    matches = VERTEX.findall(text)
    format_error = FormatError(f"{path} holds a vertex that is not three numbers, or is cut off; export the mesh again")
    if len(matches) != len(VERTEX_WORD.findall(text)) or len(matches) % 3:
        raise format_error
    loops = len(LOOP_WORD.findall(text))
    if loops and 3 * loops != len(matches):
        raise FormatError(
            f"{path} holds {loops} facets and {len(matches)} vertices, not three for each; export the mesh again"
        )
    try:
        return np.array(matches, dtype="S").astype(np.float32).reshape(-1, 3, 3)
    except ValueError as error:
        raise format_error from error


def stl_header(triangles: int, space: str) -> bytes:
    """Return the 84 bytes before the triangles."""
    named = f" SPACE={space}" if space else ""  # as 3D Slicer writes and reads it
    text = f"phasefill {__version__} UNITS=mm{named}".encode().ljust(80)
    return text + triangles.to_bytes(4, "little")


def facets_of(surface: Surface) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float32]]]:
    """Yield unit normals (n, 3) and corners (n, 3, 3) of the triangles, in pieces, compiled if there are many."""
    compiled = "numba" in sys.modules and len(surface.faces) > AT_ONCE  # else loading it takes longer
    return _compiled_facets(surface) if compiled else _facets(surface)


def write_stl(surface: Surface, file: BinaryIO) -> None:
    """Write binary STL: 50 bytes per triangle, 32-bit coordinates."""
    file.write(stl_header(len(surface.faces), surface.space))
    for normals, corners in facets_of(surface):
        record = np.zeros(len(corners), dtype=RECORD)
        record["corners"] = corners
        record["normal"] = normals
        file.write(record.view(np.uint8).data)


def write_stl_ascii(surface: Surface, file: BinaryIO) -> None:
    """Write STL as text."""
    file.write(b"solid phasefill\n")
    for normals, corners in _facets(surface):
        numbers = np.concatenate([normals[:, None], corners], axis=1)
        file.write((FACET * len(corners) % tuple(numbers.ravel().tolist())).encode())
    file.write(b"endsolid phasefill\n")


def _facets(surface: Surface) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float32]]]:
    """Yield unit normals (n, 3) and corners (n, 3, 3) of the triangles, in pieces."""
    vertices = surface.vertices.astype(np.float32)
    for low in range(0, len(surface.faces), AT_ONCE):
        corners = vertices[surface.faces[low : low + AT_ONCE]]
        yield _normals(corners), corners


def _compiled_facets(surface: Surface) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float32]]]:
    """Yield the same as `_facets`, to the last bit, by a compiled kernel."""
    from infill.kernels.facets import write_facets

    vertices = surface.vertices.astype(np.float32)
    for low in range(0, len(surface.faces), AT_ONCE):
        faces = np.ascontiguousarray(surface.faces[low : low + AT_ONCE], dtype=np.int32)
        facets = np.empty((len(faces), 12), dtype=np.float32)
        with log_compilation("the STL writer"):
            in_threads(write_facets, vertices, faces, facets, threads=thread_count())
        yield facets[:, :3], facets[:, 3:].reshape(-1, 3, 3)


def _normals(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the unit normals of triangles; zero for degenerate ones."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    unit: NDArray[np.float32] = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0)
    return unit
