"""NRRD: a text header and the cells, in one file (.nrrd), or beside it (.nhdr).

Source: "Definition of NRRD File Format", Teem.
"""

from __future__ import annotations

import gzip
import logging
import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any, BinaryIO, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.detached import DataFile, find_data_file, numbered_names, read_data_files
from infill.imaging.images import (
    CELL_SIZE_PHRASE,
    TO_LPS,
    CellReader,
    ImageHeader,
    StoredCells,
    read_frame,
    read_frames,
    require_sizes,
    scales_of,
)
from infill.plain_numbers import plain_argument
from infill.version import __version__
from infill.volume import AXES, Volume

LOG = logging.getLogger("infill")
LONGEST_LINE = 2**16  # bytes
MOST_LINES = 100_000
MAGIC = re.compile(rb"NRRD000[1-6]")
TYPES = {
    "i1": ("signed char", "int8", "int8_t"),
    "u1": ("uchar", "unsigned char", "uint8", "uint8_t"),
    "i2": ("short", "short int", "signed short", "signed short int", "int16", "int16_t"),
    "u2": ("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"),
    "i4": ("int", "signed int", "int32", "int32_t"),
    "u4": ("uint", "unsigned int", "uint32", "uint32_t"),
    "i8": ("longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"),
    "u8": ("ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"),
    "f4": ("float",),
    "f8": ("double",),
}
KINDS = {name: kind for kind, names in TYPES.items() for name in names}
ENCODINGS = {
    "raw": "raw",
    "txt": "text",
    "text": "text",
    "ascii": "text",
    "hex": "hex",
    "gz": "gzip",
    "gzip": "gzip",
    "bz2": "bzip2",
    "bzip2": "bzip2",
}
SPACES = {
    "right-anterior-superior": "RAS",
    "ras": "RAS",
    "left-anterior-superior": "LAS",
    "las": "LAS",
    "left-posterior-superior": "LPS",
    "lps": "LPS",
    "scanner-xyz": "",
    "3d-right-handed": "",
}
LEFT_HANDED = "3d-left-handed"
TIME_SUFFIX = "-time"  # a fourth axis of a space
# Kinds of axes of space; all others hold several numbers per cell, or times.
SPATIAL_KINDS = {"domain", "space", "none", "???"}
UNKNOWN = {"none", "???"}
SEGMENTATION_SUFFIXES = (".seg.nrrd", ".seg.nhdr")
SYNONYMS = {
    "datafile": "data file",
    "lineskip": "line skip",
    "byteskip": "byte skip",
    "axismins": "axis mins",
    "axismaxs": "axis maxs",
    "centerings": "centers",
    "blocksize": "block size",
}
VECTOR = re.compile(r"none|\(([^()]*)\)", re.IGNORECASE)
QUOTED_WORD = re.compile(r'"((?:\\.|[^"\\])*)"|(\S+)')
LENGTH_TOLERANCE = 1e-3  # relative: lengths stated twice are rounded

WRITTEN_TYPES = {
    "b1": "uint8",
    "i1": "int8",
    "u1": "uint8",
    "i2": "int16",
    "u2": "uint16",
    "i4": "int32",
    "u4": "uint32",
    "i8": "int64",
    "u8": "uint64",
    "f4": "float",
    "f8": "double",
}
WRITTEN_SPACES = {"LPS": "left-posterior-superior", "RAS": "right-anterior-superior"}


@dataclass(frozen=True, kw_only=True)
class _NrrdFields:
    """The fields of a header by name, the files that it lists, and the position of its end."""

    known: dict[str, str] = field(default_factory=dict)
    files: tuple[str, ...] = ()
    end: int = 0

    def __getitem__(self, name: str) -> str:
        if name not in self.known:
            raise ValueError(f"its header lacks {name!r}")
        return self.known[name]

    def get(self, name: str, default: str = "") -> str:
        """Return the value of a field, or a default."""
        return self.known.get(name, default)


def read_nrrd(path: Path, frame: int | None = None) -> Volume:
    """Read the volume of a file, [x, y, z] with its place in space, or one of several, counted from 0."""
    with wrap_reader_errors(path), np.errstate(all="ignore"):  # infinite places are refused
        header, read = _open_image(path)
        return read_frame(header, frame, read)


def read_layers(path: Path) -> tuple[Volume, ...]:
    """Read all volumes of a file, in order: the layers of a segmentation; they may be empty."""
    with wrap_reader_errors(path), np.errstate(all="ignore"):  # infinite places are refused
        header, read = _open_image(path)
        return read_frames(header, read)


def count_nrrd_frames(path: Path) -> int:
    """Count the volumes of a file from its header."""
    with wrap_reader_errors(path), np.errstate(all="ignore"):
        return _open_image(path)[0].frames


def locate_nrrd(path: Path) -> StoredCells:
    """Return where a file that is not compressed has its cells.

    Raises
    ------
    FormatError
        If it is compressed or text, or its cells lie in several files or behind lines to skip.
    """
    with wrap_reader_errors(path), np.errstate(all="ignore"):  # infinite places are refused
        fields, header = _read_header(path)
        encoding, kind, lines, skipped = _cell_type(path, fields)
        files = _data_files(path, fields)
        if encoding != "raw":
            raise FormatError(
                f"{path} is encoded as {encoding}, so that no part of it can be read; save it raw, or save it as Zarr"
            )
        if len(files) > 1 or lines:
            raise FormatError(f"{path} has its cells in several files or behind lines of text; save it as one .nrrd")
        file, begin = files[0]
        at_end = file.stat().st_size - header.cells * kind.itemsize
        return StoredCells(header=header, path=file, begin=at_end if skipped == -1 else begin + skipped, kind=kind)


def _open_image(path: Path) -> tuple[ImageHeader, CellReader]:
    """Return the header of a file, and the function that reads its cells."""
    fields, header = _read_header(path)
    return header, _cell_reader(path, fields, header)


def _read_header(path: Path) -> tuple[_NrrdFields, ImageHeader]:
    """Return the fields of a file, and the header of its image."""
    fields = _parse_header(path)
    dimension = int(fields["dimension"])
    sizes = tuple(int(word) for word in fields["sizes"].split())
    if len(sizes) != dimension:
        raise ValueError(f"{len(sizes)} sizes for a dimension of {dimension}")
    require_sizes(path, sizes)
    return fields, _place_image(path, fields, sizes)


def _parse_header(path: Path) -> _NrrdFields:
    """Parse the header, up to an empty line or the end of the file."""
    fields: dict[str, str] = {}
    with path.open("rb") as file:
        magic = file.readline(LONGEST_LINE).rstrip()
        if not MAGIC.fullmatch(magic):
            raise FormatError(f"{path} does not begin with NRRD000 and a version; check that it is an NRRD file")
        for line in _lines(path, file):
            if line.startswith("#") or re.match(r"[^:]*:=", line):
                continue
            name, colon, text = line.partition(":")
            if not colon:
                raise FormatError(f"{path} has a line in its header that is not a field, {line[:40]!r}; save it again")
            name = SYNONYMS.get(name.strip().lower(), name.strip().lower())
            fields[name] = text.strip()
            if name == "data file" and fields[name].split()[:1] == ["LIST"]:
                return _NrrdFields(known=fields, files=tuple(filter(None, _lines(path, file))), end=file.tell())
        return _NrrdFields(known=fields, end=file.tell())


def _lines(path: Path, file: BinaryIO) -> Iterator[str]:
    """Yield the lines up to the first empty one, or to the end."""
    for _ in range(MOST_LINES):
        line = file.readline(LONGEST_LINE)
        if len(line) == LONGEST_LINE:
            raise FormatError(f"{path} has a line of over {LONGEST_LINE} bytes in its header; save it again")
        text = line.decode("utf-8", "replace").strip()
        if not text:
            return
        yield text
    raise FormatError(f"{path} has a header of over {MOST_LINES} lines; save it again")


# --- place -----------------------------------------------------------------------------------------------


def _place_image(path: Path, fields: _NrrdFields, sizes: tuple[int, ...]) -> ImageHeader:
    """Find the axes of space and the affine; return the header of the image."""
    kinds = [kind.lower() for kind in fields.get("kinds").split()]
    if kinds and len(kinds) != len(sizes):
        raise ValueError(f"{len(kinds)} kinds for {len(sizes)} axes")
    if "complex" in kinds:
        raise FormatError(f"{path} holds complex numbers; save their magnitude or their phase")
    name = fields.get("space").lower()
    space = SPACES.get(name.removesuffix(TIME_SUFFIX), "")
    if name.removesuffix(TIME_SUFFIX) == LEFT_HANDED:
        raise FormatError(f"{path} lies in a left-handed space, where it would be mirrored; save it in LPS or RAS")
    if name and name.removesuffix(TIME_SUFFIX) not in SPACES:
        raise FormatError(f"{path} lies in a space {name[:40]!r}, which is unknown; save it in LPS or RAS")
    directions = _vectors(fields.get("space directions"))
    if directions:
        if len(directions) != len(sizes):
            raise ValueError(f"{len(directions)} space directions for {len(sizes)} axes")
        spatial, matrix = _affine_of_directions(path, fields, directions)
    else:
        if name or fields.get("space dimension"):
            warn("%s lies in a space and lacks its directions there; the axes of space are taken", path)
        spatial, matrix = _affine_of_spacings(path, fields, sizes, kinds)
    if len(spatial) < AXES:
        shape = tuple(sizes[axis] for axis in spatial)
        require_sizes(path, shape or (1,))
    flip = np.array(TO_LPS.get(space, (1.0, 1.0, 1.0)))
    frame_axes = [axis for axis in range(len(sizes)) if axis not in spatial]
    numbers = math.prod(sizes[axis] for axis in frame_axes)
    in_cells = any(
        axis < max(spatial) or (kinds and kinds[axis] not in {"time", *SPATIAL_KINDS}) for axis in frame_axes
    )
    what = f"holds {numbers} numbers per cell" if in_cells else ""
    if numbers > 1 and path.name.lower().endswith(SEGMENTATION_SUFFIXES):
        what = f"holds {numbers} layers of segments; write all with {{label}} in the name of the output"
    return ImageHeader(
        path=path,
        sizes=sizes,
        spatial=spatial,
        affine=flip[:, None] * matrix,
        space="LPS" if space else "",
        what=what,
    )


def _affine_of_directions(
    path: Path, fields: _NrrdFields, directions: list[NDArray[np.float64] | None]
) -> tuple[tuple[int, ...], NDArray[np.float64]]:
    """Return spatial axes and affine (3, 4), mm, from `space directions`; its numbers are 0 for fewer than 3 axes."""
    axes = [axis for axis, direction in enumerate(directions) if direction is not None]
    matrix = np.array([directions[axis] for axis in axes]).T  # column i: one cell along axis i
    count = matrix.shape[0] if matrix.ndim == 2 else 0
    if count not in (2, AXES, AXES + 1):
        raise ValueError(f"space directions of {count} numbers")
    origin = _vectors(fields.get("space origin"))
    if not origin or origin[0] is None:
        LOG.info("%s does not say where its first cell lies (space origin); it is taken to lie at 0, 0, 0", path)
        centre = np.zeros(count)
    else:
        centre = origin[0]
    if len(centre) != count:
        raise ValueError(f"a space origin of {len(centre)} numbers in a space of {count}")
    units = _split_words(fields.get("space units"))
    if units and len(units) != count:
        raise ValueError(f"{len(units)} space units in a space of {count}")
    if count > AXES:
        spatial = [column for column in range(len(axes)) if matrix[:AXES, column].any() or not matrix[AXES, column]]
        if (matrix[AXES, spatial] != 0).any():
            raise FormatError(f"{path} has an axis along space and time at once; save one volume of it")
        axes, matrix, centre, units = [axes[c] for c in spatial], matrix[:AXES, spatial], centre[:AXES], units[:AXES]
    elif count < AXES:
        return tuple(axes), np.zeros((AXES, AXES + 1))  # a slice, which is refused
    if len(axes) != AXES:
        return tuple(axes[:2]), np.zeros((AXES, AXES + 1))
    scale = _scales(path, units)
    _require_agreeing(path, fields, axes, np.linalg.norm(matrix, axis=0))
    return tuple(axes), scale[:, None] * np.column_stack([matrix, centre])


def _require_agreeing(path: Path, fields: _NrrdFields, axes: list[int], lengths: NDArray[np.float64]) -> None:
    """Raise FormatError if `spacings` contradict `space directions`."""
    stated = [float(word) for word in fields.get("spacings").split()]
    for axis, length in zip(axes, lengths, strict=True):
        size = abs(stated[axis]) if axis < len(stated) else math.nan
        if math.isfinite(size) and not math.isclose(size, length, rel_tol=LENGTH_TOLERANCE):
            raise FormatError(
                f"{path} states two sizes of a cell along axis {axis}, {plain_argument(size)} (spacings) and "
                f"{plain_argument(length)} (space directions); delete the wrong one from its header"
            )


def _affine_of_spacings(
    path: Path, fields: _NrrdFields, sizes: tuple[int, ...], kinds: list[str]
) -> tuple[tuple[int, ...], NDArray[np.float64]]:
    """Return axes and affine from `spacings`, `axis mins` and `axis maxs`; by default 1 and 0."""
    spacings, mins, maxs = (_numbers(fields, name, len(sizes)) for name in ("spacings", "axis mins", "axis maxs"))
    units = _split_words(fields.get("units"))
    if units and len(units) != len(sizes):
        raise ValueError(f"{len(units)} units for {len(sizes)} axes")
    centers = fields.get("centers").lower().split()
    axes = [axis for axis in range(len(sizes)) if not kinds or kinds[axis] in SPATIAL_KINDS]
    if len(axes) > AXES:  # the first three axes with a stated size, else the first three of all
        stated = [axis for axis in axes if math.isfinite(spacings[axis]) or math.isfinite(mins[axis])]
        axes = (stated if len(stated) >= AXES else axes)[:AXES]
    affine = np.zeros((AXES, AXES + 1))
    scales = scales_of(
        path, [units[axis] if units else "" for axis in axes], CELL_SIZE_PHRASE, [f"axis {axis}" for axis in axes]
    )
    unsized = []
    for column, axis in enumerate(axes):
        at_nodes = axis < len(centers) and centers[axis] == "node"
        steps = sizes[axis] - at_nodes
        step = spacings[axis]
        if not math.isfinite(step) and math.isfinite(maxs[axis] - mins[axis]) and steps:
            step = (maxs[axis] - mins[axis]) / steps
        if not math.isfinite(step):
            unsized.append(axis)
            step = 1.0
        centre = mins[axis] if math.isfinite(mins[axis]) else maxs[axis] - step * steps
        centre = centre + (0 if at_nodes else step / 2) if math.isfinite(centre) else 0.0
        scale = scales[column]
        affine[column, column], affine[column, AXES] = scale * step, scale * centre
    if unsized and len(axes) == AXES:
        warn(
            "%s does not say the size of its cells along %s; 1 mm is taken, unless --spacing gives it",
            path,
            "any axis" if len(unsized) == AXES else "axis " + " and ".join(map(str, unsized)),
        )
    return tuple(axes), affine


def _scales(path: Path, units: list[str]) -> NDArray[np.float64]:
    """Return the mm of the unit of each axis."""
    return np.array(scales_of(path, units, "its sizes", [""] * len(units)) or [1.0] * AXES)


def _numbers(fields: _NrrdFields, name: str, count: int) -> list[float]:
    """Return a number for each axis, NaN where the field states none."""
    words = fields.get(name).split()
    if words and len(words) != count:
        raise ValueError(f"{len(words)} {name} for {count} axes")
    return [float(word) if word.lower() not in UNKNOWN else math.nan for word in words] or [math.nan] * count


def _vectors(text: str) -> list[NDArray[np.float64] | None]:
    """Return the vectors of a field, None for `none`."""
    if VECTOR.sub("", text).strip():
        raise ValueError(f"no vectors in {text[:40]!r}")
    vectors = []
    for match in VECTOR.finditer(text):
        numbers = None if match[1] is None else np.array([float(word) for word in match[1].split(",")])
        vectors.append(None if numbers is None or np.isnan(numbers).all() else numbers)
    return vectors


def _split_words(text: str) -> list[str]:
    """Split a list of words, quoted or not; words without meaning become empty."""
    words = [match[1] or match[2] or "" for match in QUOTED_WORD.finditer(text)]
    return ["" if word.strip().lower() in UNKNOWN else word.replace('\\"', '"').strip() for word in words]


# --- cells -----------------------------------------------------------------------------------------------


def _cell_reader(path: Path, fields: _NrrdFields, header: ImageHeader) -> CellReader:
    """Return the function that reads the cells of a file, after checking the header."""
    encoding, kind, lines, skipped = _cell_type(path, fields)
    parts = _data_files(path, fields)
    # Compressed data are skipped once unpacked, plain ones before.
    parts_read = [
        DataFile(path=file, begin=begin, lines=lines, skip=skipped, from_end=skipped == -1) for file, begin in parts
    ]
    return lambda low, high: read_data_files(path, parts_read, kind, header.cells, low, high, encoding=encoding)


def _cell_type(path: Path, fields: _NrrdFields) -> tuple[str, np.dtype[Any], int, int]:
    """Return the encoding and the type of the cells, and the lines and bytes to skip before them."""
    name = fields["type"].lower()
    if name not in KINDS:
        raise FormatError(f"{path} holds cells of type {name[:40]!r}; save them as integers or floats")
    encoding = ENCODINGS.get(fields["encoding"].lower(), "")
    if not encoding:
        raise FormatError(
            f"{path} is encoded as {fields['encoding'][:40]!r}; save it with encoding raw, gzip, bzip2, text or hex"
        )
    kind = np.dtype(KINDS[name])
    endian = fields.get("endian").lower()
    if kind.itemsize > 1 and encoding not in ("text",):
        if endian not in ("little", "big"):
            raise FormatError(f"{path} does not say the order of its bytes (endian: little or big); save it again")
        kind = kind.newbyteorder("<" if endian == "little" else ">")
    lines, skipped = (int(fields.get(key, "0")) for key in ("line skip", "byte skip"))
    if lines < 0 or skipped < -1 or (skipped == -1 and encoding != "raw"):
        raise FormatError(
            f"{path} skips {lines} lines and {skipped} bytes of {encoding} data; give 0 or more, or -1 for raw data"
        )
    return encoding, kind, lines, skipped


def _data_files(path: Path, fields: _NrrdFields) -> list[tuple[Path, int]]:
    """Return the files of the cells, in order, and the position of the data in each."""
    words = fields.get("data file").split()
    if not words:
        return [(path, fields.end)]
    if words[0] == "LIST":
        return [(find_data_file(path, name), 0) for name in fields.files]
    if "%" in words[0] and len(words) >= 4:
        low, high, step = (int(word) for word in words[1:4])
        return [(find_data_file(path, name), 0) for name in numbered_names(path, words[0], low, high, step)]
    return [(find_data_file(path, fields["data file"]), 0)]


# --- writing ---------------------------------------------------------------------------------------------


def write_nrrd(volume: Volume, file: BinaryIO) -> None:
    """Write NRRD: a text header and the values, compressed by gzip; `space origin` is the centre of the first cell.

    Booleans become 0 and 1, and 16-bit floating-point numbers become 32-bit. A space without a name stays
    without one, so that no program reorients its axes.
    """
    kind = _stored_type(volume.values.dtype)
    axes = np.asarray(volume.direction) * volume.cell_size  # column i: one cell along axis i
    centre = np.array(volume.origin) + axes.sum(axis=1) / 2
    named = WRITTEN_SPACES.get(volume.space)
    header = (
        "NRRD0005",
        f"# phasefill {__version__}, millimetres",
        f"type: {WRITTEN_TYPES[kind.str[1:]]}",
        f"dimension: {AXES}",
        f"space: {named}" if named else f"space dimension: {AXES}",
        f"sizes: {' '.join(str(cells) for cells in volume.values.shape)}",
        f"space directions: {' '.join(_format_vector(axis) for axis in axes.T)}",
        f"kinds:{AXES * ' domain'}",
        "endian: little",
        "encoding: gzip",
        f"space origin: {_format_vector(centre)}",
    )
    file.write(("\n".join(header) + "\n\n").encode("ascii"))
    with gzip.GzipFile(filename="", mode="wb", compresslevel=6, fileobj=cast(IO[bytes], file), mtime=0) as packed:
        for k in range(volume.values.shape[2]):  # layer by layer, so that no second copy is held
            packed.write(volume.values[:, :, k].astype(kind).tobytes(order="F"))


def _stored_type(kind: np.dtype[np.generic]) -> np.dtype[np.generic]:
    """Return the type in which NRRD stores numbers of type `kind`, low byte first."""
    if kind.kind == "f":
        return np.dtype("<f4" if kind.itemsize <= 4 else "<f8")
    return np.dtype(np.uint8) if kind.kind == "b" else kind.newbyteorder("<")


def _format_vector(numbers: Iterable[float]) -> str:
    """Format a vector as NRRD writes it."""
    return "(" + ",".join(f"{float(number):.17g}" for number in numbers) + ")"
