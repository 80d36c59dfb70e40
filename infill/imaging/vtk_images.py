"""VTK's legacy format .vtk, of which DATASET STRUCTURED_POINTS is a volume: a few lines of text, then numbers.

Values lie on the points of a lattice, or in the cells between them; each point becomes the centre of a cell of ours.
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
from infill.files.broken import SMALLER, checked_volume, told_broken
from infill.imaging.assumed import warn
from infill.imaging.frames import chosen
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
AT_ONCE = 2**22  # bytes of text turned into numbers in one go
TEXT_BYTES = 24  # of memory for each byte of such a piece, and for each number: words, then numbers
SIZES = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9}
BYTES, SHARES = "unsigned_char", "share"  # colours: binary, and as text from 0 to 1


@dataclass(frozen=True, kw_only=True)
class Lattice:
    """Where the values of an image of VTK lie.

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
        """Return how many values there are along each axis, at the points or in the cells between them."""
        return tuple(max(1, count - 1) for count in self.points) if in_cells else self.points

    def volume(self, path: Path, values: NDArray[Any], *, in_cells: bool) -> Volume:
        """Return values [x, y, z] as a volume in its place."""
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
    """What a file says before an array: where its values lie, their type, and how many there are per cell."""

    in_cells: bool
    kind: str
    numbers: int


def read_vtk(path: Path, frame: int | None = None) -> Volume:
    """Return the first scalars of a legacy file, [x, y, z], or one component of them, counted from 0."""
    with told_broken(path), path.open("rb") as file:
        first, _, form, dataset = (_line(file) for _ in range(4))
        if not first.startswith("# vtk DataFile") or form.upper() not in ("ASCII", "BINARY"):
            raise FormatError(f"{path} is no legacy file of VTK; check that it is a .vtk file")
        if dataset.upper().split() != ["DATASET", "STRUCTURED_POINTS"]:
            raise FormatError(f"{path} holds {dataset[:40]!r}, no volume; save an image, DATASET STRUCTURED_POINTS")
        return _image(path, file, frame, text=form.upper() == "ASCII")


def _image(path: Path, file: IO[bytes], frame: int | None, *, text: bool) -> Volume:
    """Return the first array of the points or the cells, read from where the attributes of the dataset begin."""
    known: dict[str, list[float]] = {}
    of = ""  # points or cells: what the arrays that follow belong to
    while words := _words(file):
        key = words[0].upper()
        if key in ("DIMENSIONS", "ORIGIN", "SPACING", "ASPECT_RATIO"):
            known[key.replace("ASPECT_RATIO", "SPACING")] = [float(word) for word in words[1:4]]
        elif key in ("POINT_DATA", "CELL_DATA"):
            of = key
        elif key == "METADATA":
            while _line(file):
                pass
        elif key == "FIELD":
            for _ in range(_count(words, 2)):
                array = _words(file)
                numbers, count, kind = _count(array, 1), _count(array, 2), _word(array, 3)
                if of:
                    lattice = _lattice(path, known)
                    if count == math.prod(lattice.shape(in_cells=of == "CELL_DATA")):
                        found = _Array(in_cells=of == "CELL_DATA", kind=kind, numbers=numbers)
                        return _volume(path, file, lattice, found, frame, text=text)
                _skip(file, numbers * count, kind, text=text)
        elif key == "SCALARS":
            at, numbers = file.tell(), _count(words, 3) if len(words) > 3 else 1
            if not _line(file).upper().startswith("LOOKUP_TABLE"):
                file.seek(at)
            found = _Array(in_cells=of == "CELL_DATA", kind=_word(words, 2), numbers=numbers)
            return _volume(path, file, _lattice(path, known), found, frame, text=text)
        elif key == "COLOR_SCALARS":  # what VTK makes of bytes
            found = _Array(in_cells=of == "CELL_DATA", kind=SHARES if text else BYTES, numbers=_count(words, 2))
            return _volume(path, file, _lattice(path, known), found, frame, text=text)
        else:
            shape = _lattice(path, known).shape(in_cells=of == "CELL_DATA")
            _skip(file, *_extent(path, key, words, math.prod(shape), text=text), text=text)
    raise FormatError(f"{path} holds no scalars; save an image with one number per point")


def _extent(path: Path, key: str, words: list[str], cells: int, *, text: bool) -> tuple[int, str]:
    """Return how many numbers of which type follow a line that is of no use here."""
    if key in SIZES:
        return SIZES[key] * cells, _word(words, 2)
    if key == "LOOKUP_TABLE":
        return _count(words, 2) * 4, SHARES if text else BYTES
    raise FormatError(f"{path} holds {key[:40]!r} where its scalars should begin; save it again, as an image")


def _lattice(path: Path, known: dict[str, list[float]]) -> Lattice:
    points = tuple(int(count) for count in known.get("DIMENSIONS", ()))
    if "SPACING" not in known:
        warn("%s does not say the size of its cells; 1 mm is taken, unless --spacing gives it", path)
        known["SPACING"] = [1.0] * AXES
    origin, spacing = (np.array(known.get(key, (d,) * AXES)) for key, d in (("ORIGIN", 0.0), ("SPACING", 1.0)))
    if len(points) != AXES or min(points) < 1 or origin.shape != (AXES,) or spacing.shape != (AXES,):
        raise FormatError(f"{path} does not say how many points it has along three axes; save it again, as an image")
    return Lattice(points=points, origin=origin, spacing=spacing, direction=np.eye(AXES))


def _volume(
    path: Path,
    file: IO[bytes],
    lattice: Lattice,
    array: _Array,
    frame: int | None,
    *,
    text: bool,
) -> Volume:
    """Return the array that begins here."""
    shape = lattice.shape(in_cells=array.in_cells)
    at = chosen(path, frame, array.numbers, what=f"holds {array.numbers} numbers per cell")
    count = array.numbers * math.prod(shape)
    stored = _stored(array.kind)
    require_memory(count * stored.itemsize + (TEXT_BYTES * (AT_ONCE + count) if text else 0), None, SMALLER)
    values = _text(file, count, stored) if text else _binary(file, count, array.kind)
    if len(values) < count:
        raise FormatError(f"{path} is cut off: it holds {len(values)} numbers of {count}; copy or save it again")
    if array.kind == SHARES:
        values = np.rint(255 * np.clip(values, 0, 1)).astype(np.uint8)
    return lattice.volume(path, values[at :: array.numbers].reshape(shape, order="F"), in_cells=array.in_cells)


def _text(file: IO[bytes], count: int, kind: np.dtype[np.generic]) -> NDArray[Any]:
    """Return up to so many numbers of a text."""
    found: list[NDArray[Any]] = [np.empty(0, dtype=kind)]
    left = count
    while left > 0 and (lines := file.readlines(AT_ONCE)):
        found.append(numbers_in(b"".join(lines).split()[:left], kind))
        left -= len(found[-1])
    return np.concatenate(found)


def numbers_in(words: list[bytes], kind: np.dtype[np.generic]) -> NDArray[Any]:
    """Return words as numbers of a type, or raise ValueError for one that is none, or beyond its range.

    >>> numbers_in([b"3", b"250"], np.dtype("u1")).tolist()
    [3, 250]
    """
    if not words:
        return np.empty(0, dtype=kind)
    if max(map(len, words)) > LONGEST_NUMBER:
        raise ValueError(f"{max(words, key=len)[:LONGEST_NUMBER].decode('ascii', 'replace')}… where a number should be")
    wide = np.array(words).astype(np.float64 if kind.kind == "f" else np.uint64 if kind.str[1:] == "u8" else np.int64)
    with np.errstate(over="ignore"):
        found: NDArray[Any] = wide.astype(kind)
    if kind.kind != "f" and (found != wide).any():
        raise ValueError(f"a number beyond the range of its type, {kind.name}")
    return found


def _binary(file: IO[bytes], count: int, kind: str) -> NDArray[Any]:
    """Return up to so many numbers with the high byte first."""
    stored = _stored(kind).newbyteorder(">")
    held = file.read(_bytes_of(count, kind))
    if kind.lower() == "bit":
        return np.unpackbits(np.frombuffer(held, dtype=np.uint8))[:count]
    return np.frombuffer(held[: len(held) // stored.itemsize * stored.itemsize], dtype=stored)


def _skip(file: IO[bytes], count: int, kind: str, *, text: bool) -> None:
    """Move past numbers."""
    if not text:
        file.seek(_bytes_of(count, kind), 1)
        return
    while count > 0 and (line := file.readline()):
        count -= len(line.split())


def _bytes_of(count: int, kind: str) -> int:
    return math.ceil(count / 8) if kind.lower() == "bit" else count * _stored(kind).itemsize


def _stored(kind: str) -> np.dtype[np.generic]:
    if kind.lower() not in TYPES:
        raise ValueError(f"numbers of a type {kind[:40]!r}")
    return np.dtype(TYPES[kind.lower()])


def _word(words: list[str], place: int) -> str:
    if len(words) <= place:
        raise ValueError(f"a line that ends too early: {' '.join(words)[:80]!r}")
    return words[place]


def _count(words: list[str], place: int) -> int:
    number = int(_word(words, place))
    if number < 0:
        raise ValueError(f"a count of {number}")
    return number


def _line(file: IO[bytes]) -> str:
    return file.readline(LONGEST_LINE).decode("utf-8", "replace").strip()


def _words(file: IO[bytes]) -> list[str]:
    """Return the words of the next line that has any; none at the end."""
    while line := file.readline(LONGEST_LINE):
        if words := line.decode("utf-8", "replace").split():
            return words
    return []
