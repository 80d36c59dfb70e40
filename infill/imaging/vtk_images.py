"""VTK's legacy format .vtk with DATASET STRUCTURED_POINTS: a few lines of text, then numbers.

Values lie on the points of a lattice, or in the cells between them; each point becomes the centre of a cell.
Numbers are text, or binary with the high byte first. Source: "VTK file formats", VTK documentation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.checked_volume import checked_volume
from infill.imaging.frames import choose_frame
from infill.machine import require_memory
from infill.volume import AXES, Volume

TYPES = {
    "bit": "u1",
    "unsigned_char": "u1",
    "char": "i1",
    "signed_char": "i1",
    "unsigned_short": "u2",
    "short": "i2",
    "unsigned_int": "u4",
    "int": "i4",
    "unsigned_long": "u8",
    "long": "i8",
    "vtkidtype": "i8",
    "vtktypeuint64": "u8",
    "vtktypeint64": "i8",
    "share": "f8",
    "float": "f4",
    "double": "f8",
}
LONGEST_LINE = 4096  # bytes of a line of the header
LONGEST_NUMBER = 40  # bytes
TEXT_CHUNK = 2**22  # bytes of text turned into numbers in one go
TEXT_BYTES = 24  # of memory for each byte of such a piece, and for each number: words, then numbers
NUMBERS_PER_VALUE = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}
BYTES, SHARES = "unsigned_char", "share"  # colours: binary, and as text from 0 to 1


@dataclass(frozen=True, kw_only=True)
class Lattice:
    """Positions of the values of an image of VTK.

    Parameters
    ----------
    points : (nx, ny, nz)
        Points along each axis.
    origin : (3,) float64, mm
        The first point.
    spacing : (3,) float64, mm
    direction : (3, 3) float64
        Column i is the direction of axis i.
    """

    points: tuple[int, ...]
    origin: NDArray[np.float64]
    spacing: NDArray[np.float64]
    direction: NDArray[np.float64]

    def shape(self, *, in_cells: bool) -> tuple[int, ...]:
        """Return the number of values along each axis, at the points or in the cells between them."""
        return tuple(max(1, count - 1) for count in self.points) if in_cells else self.points

    def volume(self, path: Path, values: NDArray[Any], *, in_cells: bool) -> Volume:
        """Return values [x, y, z] as a volume in place."""
        back = 0.0 if in_cells else 0.5
        corner = self.origin - self.direction @ (self.spacing * back)
        return checked_volume(
            path,
            values,
            spacing=tuple(self.spacing.tolist()),
            origin=tuple(corner.tolist()),
            direction=self.direction,
        )


@dataclass(frozen=True, kw_only=True)
class _Array:
    """The description of an array: location and type of its values, and numbers per cell."""

    in_cells: bool
    kind: str
    numbers: int


def read_vtk(path: Path, frame: int | None = None) -> Volume:
    """Read the first scalars of a legacy file, [x, y, z], or one component of them, counted from 0."""
    with wrap_reader_errors(path), path.open("rb") as file:
        magic, _, encoding, dataset = (_read_line(file) for _ in range(4))
        if not magic.startswith("# vtk DataFile") or encoding.upper() not in ("ASCII", "BINARY"):
            raise FormatError(f"{path} is not a legacy VTK file; check that it is a .vtk file")
        if dataset.upper().split() != ["DATASET", "STRUCTURED_POINTS"]:
            raise FormatError(f"{path} holds {dataset[:40]!r}, no volume; save an image, DATASET STRUCTURED_POINTS")
        return _read_image(path, file, frame, text=encoding.upper() == "ASCII")


def _read_image(path: Path, file: IO[bytes], frame: int | None, *, text: bool) -> Volume:
    """Find and read the first array of points or cells, from the attributes of the dataset on."""
    attributes: dict[str, list[float]] = {}
    section = ""  # POINT_DATA or CELL_DATA of the following arrays
    while words := _read_words(file):
        key = words[0].upper()
        if key in ("DIMENSIONS", "ORIGIN", "SPACING", "ASPECT_RATIO"):
            attributes[key.replace("ASPECT_RATIO", "SPACING")] = [float(word) for word in words[1:4]]
        elif key in ("POINT_DATA", "CELL_DATA"):
            section = key
        elif key == "METADATA":
            while _read_line(file):
                pass
        elif key == "FIELD":
            for _ in range(_count_at(words, 2)):
                array_words = _read_words(file)
                numbers, count, kind = _count_at(array_words, 1), _count_at(array_words, 2), _word_at(array_words, 3)
                if section:
                    lattice = _lattice(path, attributes)
                    if count == math.prod(lattice.shape(in_cells=section == "CELL_DATA")):
                        description = _Array(in_cells=section == "CELL_DATA", kind=kind, numbers=numbers)
                        return _read_array(path, file, lattice, description, frame, text=text)
                _skip(file, numbers * count, kind, text=text)
        elif key == "SCALARS":
            position, numbers = file.tell(), _count_at(words, 3) if len(words) > 3 else 1
            if not _read_line(file).upper().startswith("LOOKUP_TABLE"):
                file.seek(position)
            description = _Array(in_cells=section == "CELL_DATA", kind=_word_at(words, 2), numbers=numbers)
            return _read_array(path, file, _lattice(path, attributes), description, frame, text=text)
        elif key == "COLOR_SCALARS":  # VTK writes bytes like that
            description = _Array(
                in_cells=section == "CELL_DATA", kind=SHARES if text else BYTES, numbers=_count_at(words, 2)
            )
            return _read_array(path, file, _lattice(path, attributes), description, frame, text=text)
        else:
            shape = _lattice(path, attributes).shape(in_cells=section == "CELL_DATA")
            _skip(file, *_skipped_numbers(path, key, words, math.prod(shape), text=text), text=text)
    raise FormatError(f"{path} holds no scalars; save an image with one number per point")


def _skipped_numbers(path: Path, key: str, words: list[str], cells: int, *, text: bool) -> tuple[int, str]:
    """Return the count and type of the numbers behind a line that is skipped."""
    if key in NUMBERS_PER_VALUE:
        return NUMBERS_PER_VALUE[key] * cells, _word_at(words, 2)
    if key == "LOOKUP_TABLE":
        return _count_at(words, 2) * 4, SHARES if text else BYTES
    raise FormatError(f"{path} holds {key[:40]!r} where its scalars should begin; save it again, as an image")


def _lattice(path: Path, attributes: dict[str, list[float]]) -> Lattice:
    """Return the lattice of the image."""
    points = tuple(int(count) for count in attributes.get("DIMENSIONS", ()))
    if "SPACING" not in attributes:
        warn("%s does not say the size of its cells; 1 mm is taken, unless --spacing gives it", path)
        attributes["SPACING"] = [1.0] * AXES
    origin, spacing = (
        np.array(attributes.get(key, (default,) * AXES)) for key, default in (("ORIGIN", 0.0), ("SPACING", 1.0))
    )
    if len(points) != AXES or min(points) < 1 or origin.shape != (AXES,) or spacing.shape != (AXES,):
        raise FormatError(f"{path} does not say how many points it has along three axes; save it again, as an image")
    return Lattice(points=points, origin=origin, spacing=spacing, direction=np.eye(AXES))


def _read_array(
    path: Path,
    file: IO[bytes],
    lattice: Lattice,
    array: _Array,
    frame: int | None,
    *,
    text: bool,
) -> Volume:
    """Read the array that begins here."""
    shape = lattice.shape(in_cells=array.in_cells)
    component = choose_frame(path, frame, array.numbers, what=f"holds {array.numbers} numbers per cell")
    count = array.numbers * math.prod(shape)
    stored = _stored_type(array.kind)
    require_memory(
        count * stored.itemsize + (TEXT_BYTES * (TEXT_CHUNK + count) if text else 0), None, SMALLER_VOLUME_ADVICE
    )
    values = _read_text(file, count, stored) if text else _read_binary(file, count, array.kind)
    if len(values) < count:
        raise FormatError(f"{path} is cut off: it holds {len(values)} numbers of {count}; copy or save it again")
    if array.kind == SHARES:
        values = np.rint(255 * np.clip(values, 0, 1)).astype(np.uint8)
    return lattice.volume(path, values[component :: array.numbers].reshape(shape, order="F"), in_cells=array.in_cells)


def _read_text(file: IO[bytes], count: int, kind: np.dtype[np.generic]) -> NDArray[Any]:
    """Read up to `count` numbers as text."""
    pieces: list[NDArray[Any]] = [np.empty(0, dtype=kind)]
    remaining = count
    while remaining > 0 and (lines := file.readlines(TEXT_CHUNK)):
        pieces.append(parse_numbers(b"".join(lines).split()[:remaining], kind))
        remaining -= len(pieces[-1])
    return np.concatenate(pieces)


def parse_numbers(words: list[bytes], kind: np.dtype[np.generic]) -> NDArray[Any]:
    """Convert words to numbers of a type; raise ValueError for other words, or beyond the range of the type.

    >>> parse_numbers([b"3", b"250"], np.dtype("u1")).tolist()
    [3, 250]
    """
    if not words:
        return np.empty(0, dtype=kind)
    if max(map(len, words)) > LONGEST_NUMBER:
        raise ValueError(f"{max(words, key=len)[:LONGEST_NUMBER].decode('ascii', 'replace')}… where a number should be")
    widest = np.array(words).astype(np.float64 if kind.kind == "f" else np.uint64 if kind.str[1:] == "u8" else np.int64)
    with np.errstate(over="ignore"):
        converted: NDArray[Any] = widest.astype(kind)
    if kind.kind != "f" and (converted != widest).any():
        raise ValueError(f"a number beyond the range of its type, {kind.name}")
    return converted


def _read_binary(file: IO[bytes], count: int, kind: str) -> NDArray[Any]:
    """Read up to `count` binary numbers, high byte first."""
    stored = _stored_type(kind).newbyteorder(">")
    content = file.read(_byte_count(count, kind))
    if kind.lower() == "bit":
        return np.unpackbits(np.frombuffer(content, dtype=np.uint8))[:count]
    return np.frombuffer(content[: len(content) // stored.itemsize * stored.itemsize], dtype=stored)


def _skip(file: IO[bytes], count: int, kind: str, *, text: bool) -> None:
    """Move past `count` numbers."""
    if not text:
        file.seek(_byte_count(count, kind), 1)
        return
    while count > 0 and (line := file.readline()):
        count -= len(line.split())


def _byte_count(count: int, kind: str) -> int:
    """Return the size of `count` binary numbers."""
    return math.ceil(count / 8) if kind.lower() == "bit" else count * _stored_type(kind).itemsize


def _stored_type(kind: str) -> np.dtype[np.generic]:
    """Return the NumPy type of a VTK type."""
    if kind.lower() not in TYPES:
        raise ValueError(f"numbers of a type {kind[:40]!r}")
    return np.dtype(TYPES[kind.lower()])


def _word_at(words: list[str], place: int) -> str:
    """Return a word of a line, or raise ValueError."""
    if len(words) <= place:
        raise ValueError(f"a line that ends too early: {' '.join(words)[:80]!r}")
    return words[place]


def _count_at(words: list[str], place: int) -> int:
    """Return a count in a line, or raise ValueError."""
    number = int(_word_at(words, place))
    if number < 0:
        raise ValueError(f"a count of {number}")
    return number


def _read_line(file: IO[bytes]) -> str:
    """Read a line."""
    return file.readline(LONGEST_LINE).decode("utf-8", "replace").strip()


def _read_words(file: IO[bytes]) -> list[str]:
    """Return the words of the next line that is not empty; an empty list at the end."""
    while line := file.readline(LONGEST_LINE):
        if words := line.decode("utf-8", "replace").split():
            return words
    return []
