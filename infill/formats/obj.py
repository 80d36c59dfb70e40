"""Wavefront OBJ: text, without a unit."""

from __future__ import annotations

import re
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.excerpts import quote_word
from infill.formats.rows import write_rows
from infill.formats.text_lines import Lines, are_separators, blank_breaks, blank_comments, read_plain_text
from infill.meshes.polygons import CORNERS, split_polygons
from infill.plain_numbers import count_noun
from infill.surface import Surface
from infill.version import __version__

SURFACES = {b"surf", b"bzp", b"bsp"}  # smooth surfaces instead of polygons
KNOWN = frozenset(  # statements of the format that say nothing of its triangles
    b"vt vn vp l p curv curv2 deg bmat step cstype parm trim hole scrv sp end con g s mg o bevel c_interp d_interp lod "
    b"usemtl mtllib shadow_obj trace_obj ctech stech maplib usemap".split()
)
MOST_NAMED = 3  # unknown statements, in a note
# A statement of the format, or an addition of some program: two letters or more.
STATEMENT = re.compile(rb"[a-z][a-z_]\w*|[goslp]", re.IGNORECASE)


def read_obj(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64], tuple[str, ...]]:
    """Read vertices and triangles, and notes of statements that the format does not have; polygons are split.

    Parameters
    ----------
    path : Path
        Lines, points, curves, normals, colours and names are left out. A negative corner -k is the k-th vertex before
        the line in which it stands.

    Raises
    ------
    FormatError
        For free-form surfaces, a line that cannot be read, and a corner that does not exist.
    """
    original = read_plain_text(path)
    lines = Lines(path=path, original=original, text=blank_breaks(blank_comments(original)))
    if len(lines) == 0:
        raise FormatError(f"{path} holds no vertices; export the mesh again")
    letter1, letter2, letter3 = (lines.key_bytes(place) for place in range(3))
    has_one_letter, has_two_letters = are_separators(letter2), are_separators(letter3)
    is_vertex = (letter1 == ord("v")) & has_one_letter
    is_face = (letter1 == ord("f")) & (has_one_letter | ((letter2 == ord("o")) & has_two_letters))
    is_vertex_attribute = (letter1 == ord("v")) & ((letter2 == ord("n")) | (letter2 == ord("t"))) & has_two_letters
    notes = _check_statements(lines, np.flatnonzero(~(is_vertex | is_face | is_vertex_attribute)))
    vertex_rows, face_rows = np.flatnonzero(is_vertex), np.flatnonzero(is_face)
    vertices = _vertices(lines, vertex_rows)
    corners, counts = _corners(lines, vertex_rows, face_rows)
    return vertices, split_polygons(vertices, corners, counts), notes


def _check_statements(lines: Lines, rows: NDArray[np.int64]) -> tuple[str, ...]:
    """Return notes of unknown statements; raise FormatError for surfaces, and for lines of another format."""
    unknown: dict[bytes, int] = {}
    for number in lines.first_words[rows].tolist():
        word = lines.word(number)
        if word.lower() in SURFACES:
            raise lines.error(
                number, f"{quote_word(word)} is a free-form surface", "convert it to polygons before the export"
            )
        if word.lower() == b"call":
            raise lines.error(number, "'call' takes in another file", "export everything into one file")
        if not STATEMENT.fullmatch(word):
            raise lines.error(number, f"{quote_word(word)} begins no line of an OBJ file")
        if word.lower() not in KNOWN:
            unknown[word] = unknown.get(word, 0) + 1
    if not unknown:
        return ()
    names = ", ".join(map(quote_word, list(unknown)[:MOST_NAMED])) + (" …" if len(unknown) > MOST_NAMED else "")
    return (f"left out {count_noun(sum(unknown.values()), 'line')} starting with {names}: OBJ has no such lines",)


def _vertices(lines: Lines, rows: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return x, y and z of all vertices, (V, 3), without weights and colours."""
    numbers = lines.word_counts[rows] - 1
    short = np.flatnonzero(numbers < 3)
    if len(short):
        count = int(numbers[short[0]])
        raise lines.error(
            int(lines.first_words[rows[short[0]]]), f"a vertex of {count_noun(count, 'number')}, not three or more"
        )
    values = lines.numbers(rows, 1, np.float64).astype(np.float64, copy=False)
    if len(numbers) and (numbers == numbers[0]).all():
        return values.reshape(-1, int(numbers[0]))[:, :3].copy()
    begins = np.cumsum(numbers) - numbers
    return np.asarray(values[begins[:, None] + np.arange(3)])


def _corners(
    lines: Lines, vertex_rows: NDArray[np.int64], rows: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the corners of all polygons counted from 0, (C,), and the number of each, (P,)."""
    counts = lines.word_counts[rows] - 1
    short = np.flatnonzero(counts < CORNERS)
    if len(short):
        count = int(counts[short[0]])
        raise lines.error(
            int(lines.first_words[rows[short[0]]]), f"a face of {count_noun(count, 'corner')}, not three or more"
        )
    corners = lines.numbers(rows, 1, np.int64, slashes=True).astype(np.int64, copy=False)
    total = len(vertex_rows)
    if len(corners) and (corners.min() < 1 or corners.max() > total):
        before = np.repeat(np.searchsorted(vertex_rows, rows), counts)
        resolved = np.where(corners < 0, corners + before, corners - 1)
        wrong = np.flatnonzero((corners == 0) | (resolved < 0) | (resolved >= total))
        if len(wrong):
            row = int(np.searchsorted(np.cumsum(counts), wrong[0], side="right"))
            corner = int(corners[wrong[0]])
            reason = f"corner {corner} does not exist: the file holds {total} vertices"
            if corner < 0:
                reason = f"corner {corner} does not exist: {int(before[wrong[0]])} vertices stand before this line"
            raise lines.error(int(lines.first_words[rows[row]]), reason)
        return resolved, counts
    return corners - 1, counts


def write_obj(surface: Surface, file: BinaryIO) -> None:
    """Write Wavefront OBJ."""
    write_obj_head(file)
    write_obj_vertices(file, surface.vertices)
    write_obj_faces(file, surface.faces)


def write_obj_head(file: BinaryIO) -> None:
    """Write the first lines."""
    file.write(f"# phasefill {__version__}, millimetres\no infill\n".encode())


def write_obj_vertices(file: BinaryIO, vertices: NDArray[np.floating]) -> None:
    """Write a line for each vertex (V, 3)."""
    write_rows(file, "v %.9g %.9g %.9g\n", vertices)


def write_obj_faces(file: BinaryIO, faces: NDArray[np.integer]) -> None:
    """Write a line for each triangle (F, 3), by the numbers of its vertices."""
    write_rows(file, "f %d %d %d\n", faces, add=1)
