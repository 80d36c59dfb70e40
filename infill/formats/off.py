"""OFF of Geomview: text, without a unit."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.ply import require_corners
from infill.formats.text_lines import Lines, blank_comments, number_complaint, read_plain_text
from infill.meshes.polygons import split_polygons
from infill.plain_numbers import count_noun, plain_argument

# Texture coordinates, colours, normals, a fourth coordinate, and any number of coordinates, which come next.
KEYWORD = re.compile(rb"\s*((?:ST)?C?N?4?n?OFF)(?![A-Za-z])", re.IGNORECASE)


def read_off(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read vertices and triangles; split polygons, and leave out normals, colours and texture coordinates.

    Raises
    ------
    FormatError
        If the file is binary, or lacks the numbers that it announces.
    """
    original = path.read_bytes()
    if re.match(rb"\s*\w*OFF[ \t]+BINARY", original, re.IGNORECASE):
        raise FormatError(f"{path} is a binary OFF file; export it as text, or as .ply")
    original = read_plain_text(path)
    text = blank_comments(original)
    keyword = KEYWORD.match(text)
    if keyword and (b"4" in keyword[1] or keyword[1].endswith(b"nOFF")):
        raise FormatError(f"{path} has vertices in more than three dimensions; export it in three")
    if keyword:  # the counts may follow on its line, even without a blank
        text = b" " * keyword.end() + text[keyword.end() :]
    lines = Lines(path=path, original=original, text=text)
    announced = 2 if len(lines) and lines.word_counts[0] == 2 else 3  # some programs leave out the number of edges
    numbers = [_count(lines, number) for number in range(min(announced, len(lines.begins)))]
    if len(numbers) < 2:
        raise FormatError(f"{path} does not say how many vertices and faces it has; export the mesh again")
    vertices, faces = numbers[:2]
    head = int(np.searchsorted(np.cumsum(lines.word_counts), len(numbers)))  # of the lines with a word
    if lines.word_counts[0] > 3 or len(lines) < head + 1 + vertices + faces:
        return _read_words(lines, numbers)
    rows = np.arange(head + 1, head + 1 + vertices + faces)
    return _read_lines(lines, rows[:vertices], rows[vertices:])


def _count(lines: Lines, number: int) -> int:
    """Return a count of vertices, faces or edges."""
    word = lines.word(number)
    if not word.isdigit() or len(word) > 12:
        raise lines.error(number, number_complaint(word, whole=True) or f"{word.decode()!r} is not a count")
    return int(word)


def _read_lines(
    lines: Lines, vertex_rows: NDArray[np.int64], face_rows: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read one vertex or face per line, and leave out the rest of the line."""
    width = lines.word_counts[vertex_rows]
    short = np.flatnonzero(width < 3)
    if len(short):
        count = int(width[short[0]])
        raise lines.error(
            int(lines.first_words[vertex_rows[short[0]]]),
            f"a vertex of {count_noun(count, 'number')}, not three or more",
        )
    values = lines.numbers(vertex_rows, 0, np.float64).astype(np.float64, copy=False)
    begins = np.cumsum(width) - width
    vertices = values[begins[:, None] + np.arange(3)]
    width = lines.word_counts[face_rows]
    face_numbers = lines.numbers(face_rows, 0, np.float64)  # colours may be fractions
    begins = np.cumsum(width) - width
    counts = _to_integers(lines, face_rows, face_numbers[begins])
    short = np.flatnonzero((counts < 0) | (counts > width - 1))
    if len(short):
        stated, available = int(counts[short[0]]), int(width[short[0]]) - 1
        raise lines.error(
            int(lines.first_words[face_rows[short[0]]]),
            f"a face of {count_noun(stated, 'corner')} with {count_noun(available, 'number')}",
        )
    positions = np.repeat(begins + 1 - (np.cumsum(counts) - counts), counts)
    corners = _to_integers(lines, np.repeat(face_rows, counts), face_numbers[positions + np.arange(len(positions))])
    require_corners(lines.path, corners, len(vertices))
    return vertices, split_polygons(vertices, corners, counts)


def _to_integers(lines: Lines, rows: NDArray[np.int64], values: NDArray[np.generic]) -> NDArray[np.int64]:
    """Convert numbers to integers, or raise FormatError."""
    numbers = values.astype(np.float64)
    wrong = np.flatnonzero(~((np.abs(numbers) < 2**53) & (numbers == np.floor(numbers))))
    if len(wrong):
        raise lines.error(
            int(lines.first_words[rows[wrong[0]]]), f"{plain_argument(numbers[wrong[0]])} is not a whole number"
        )
    return numbers.astype(np.int64)


def _read_words(lines: Lines, announced: list[int]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read a file without lines: three numbers per vertex, and only corners behind the count of a face."""
    vertices, faces = announced[:2]
    values = lines.numbers(np.arange(len(lines)), 0, np.float64).astype(np.float64, copy=False)[len(announced) :]
    if len(values) < 3 * vertices + faces:
        raise FormatError(
            f"{lines.path} is cut off: it announces {vertices} vertices and {faces} faces and holds fewer; "
            "export the mesh again"
        )
    points, face_numbers = values[: 3 * vertices].reshape(-1, 3), values[3 * vertices :]
    position, counts, corners = 0, [], []
    for _ in range(faces):
        count = face_numbers[position] if position < len(face_numbers) else -1
        if not 0 <= count <= len(face_numbers) - position - 1 or count != int(count):
            raise FormatError(f"{lines.path} has faces that are cut off or not in lines; export the mesh again")
        counts.append(int(count))
        corners.append(face_numbers[position + 1 : position + 1 + int(count)])
        position += 1 + int(count)
    all_corners = np.concatenate(corners) if corners else np.empty(0)
    if position != len(face_numbers) or not (all_corners == np.floor(all_corners)).all():
        raise FormatError(f"{lines.path} has faces that are not in lines; export the mesh again, a face in each line")
    require_corners(lines.path, all_corners.astype(np.int64), vertices)
    return points, split_polygons(points, all_corners.astype(np.int64), np.array(counts, dtype=np.int64))
