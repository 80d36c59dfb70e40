"""MetaImage: a text header and the cells, in one file (.mha), or beside it (.mhd).

Source: "MetaIO/Documentation" of ITK.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.detached import DataFile, find_data_file, numbered_names, read_data_files
from infill.imaging.images import CellReader, ImageHeader, read_frame, require_sizes, scale_of
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

LONGEST_LINE = 2**16  # bytes
MOST_LINES = 10_000
TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "long": "i4",  # as the format defines it, on every computer
    "ulong": "u4",
    "long_long": "i8",
    "ulong_long": "u8",
    "float": "f4",
    "double": "f8",
}
# Synonyms; the first one in the header counts.
MATRIX_FIELDS = ("transformmatrix", "rotation", "orientation")
ORIGIN_FIELDS = ("offset", "position", "origin")
DATA_FIELD = "elementdatafile"
LINE = re.compile(r"\s*([^=:]+?)\s*[=:]\s*(.*?)\s*")
# Axes that run from right to left, anterior to posterior and inferior to superior are those of LPS.
TOWARDS = {"R": (0, 1), "L": (0, -1), "A": (1, 1), "P": (1, -1), "I": (2, 1), "S": (2, -1)}
UNKNOWN = {"", "???", "?"}


class _MetaFields(dict[str, str]):
    """The fields of a header by lower-case name."""

    def __missing__(self, name: str) -> str:
        raise ValueError(f"its header lacks {name}")

    def is_true(self, *names: str) -> bool:
        """Tell whether the first of the named fields in the header is true."""
        value = next((self[name] for name in names if name in self), "false").lower()
        if value not in ("true", "false", "1", "0", "yes", "no", "t", "f"):
            raise ValueError(f"{names[0]} is {value[:20]!r}")
        return value[0] in "t1y"


def read_meta_image(path: Path, frame: int | None = None) -> Volume:
    """Read the volume of a file, [x, y, z] in LPS, or one of several, counted from 0."""
    with wrap_reader_errors(path), np.errstate(all="ignore"):  # infinite places are refused
        fields, listed, end = _parse_header(path)
        count = int(fields["ndims"])
        sizes = _integers(fields, "dimsize", count)
        require_sizes(path, sizes)
        channels = int(fields.get("elementnumberofchannels", "1"))
        if channels < 1:
            raise ValueError(f"{channels} channels")
        several = channels > 1
        header = ImageHeader(
            path=path,
            sizes=(channels, *sizes) if several else sizes,
            spatial=tuple(axis + several for axis in range(AXES)),
            affine=_affine(path, fields, count),
            space="LPS",
            what=f"holds {channels} numbers per cell" if several else "",
        )
        return read_frame(header, frame, _cell_reader(path, fields, header, listed, end))


def _parse_header(path: Path) -> tuple[_MetaFields, tuple[str, ...], int]:
    """Parse the header; return its fields, the listed files, and the end of the header."""
    fields = _MetaFields()
    with path.open("rb") as file:
        for _ in range(MOST_LINES):
            line = file.readline(LONGEST_LINE)
            text = line.decode("utf-8", "replace").strip()
            if not text:
                if not line:
                    break
                continue
            match = LINE.fullmatch(text)
            if match is None:
                raise FormatError(f"{path} has a line in its header that is not a field, {text[:40]!r}; save it again")
            fields[match[1].lower()] = match[2]
            if match[1].lower() == DATA_FIELD:
                listed: tuple[str, ...] = ()
                if match[2].split()[:1] == ["LIST"]:
                    listed = tuple(filter(None, (name_line.decode("utf-8", "replace").strip() for name_line in file)))
                if fields.get("objecttype", "image").lower() != "image":
                    raise FormatError(f"{path} holds {fields['objecttype'][:40]!r}; save an image")
                return fields, listed, file.tell()
    raise FormatError(f"{path} has no header of MetaImage that names its data (ElementDataFile); save it again")


# --- place -----------------------------------------------------------------------------------------------


def _affine(path: Path, fields: _MetaFields, count: int) -> NDArray[np.float64]:
    """Return the affine in LPS: row i of the matrix in the file is the direction of axis i."""
    matrix = _agreeing_vector(path, fields, MATRIX_FIELDS, count * count)
    origin = _agreeing_vector(path, fields, ORIGIN_FIELDS, count)
    sizes, gaps = (_floats(fields, name, count) for name in ("elementspacing", "elementsize"))
    if sizes is None and gaps is None:
        warn("%s does not say the size of its cells; 1 mm is taken, unless --spacing gives it", path)
    elif sizes is not None and gaps is not None and not np.allclose(sizes, gaps, rtol=1e-3, atol=0):
        warn(
            "%s states cells of %s mm, %s mm apart (ElementSize, ElementSpacing); they are taken as that large as they "
            "are apart",
            path,
            " x ".join(plain_argument(length) for length in gaps[:AXES]),
            " x ".join(plain_argument(length) for length in sizes[:AXES]),
        )
    spacing = sizes if sizes is not None else gaps if gaps is not None else np.ones(count)
    directions = np.eye(count) if matrix is None else matrix.reshape(count, count).T
    _check_anatomy(path, fields, directions[:AXES, :AXES])
    unit = next((fields[name] for name in ("distanceunits", "elementspacingunits", "units") if fields.get(name)), "mm")
    scale = 1.0 if unit in UNKNOWN else scale_of(path, unit)
    centre = np.zeros(count) if origin is None else origin
    return scale * np.column_stack([directions[:AXES, :AXES] * spacing[:AXES], centre[:AXES]])


def _agreeing_vector(path: Path, fields: _MetaFields, names: tuple[str, ...], count: int) -> NDArray[np.float64] | None:
    """Return the numbers of a field with several names; raise FormatError if two disagree."""
    vectors = [vector for name in names if (vector := _floats(fields, name, count)) is not None]
    if any(not np.allclose(vector, vectors[0]) for vector in vectors):
        conflict = " and ".join(name for name in names if name in fields)
        raise FormatError(f"{path} states two places ({conflict} differ); delete the wrong one from its header")
    return vectors[0] if vectors else None


def _check_anatomy(path: Path, fields: _MetaFields, directions: NDArray[np.float64]) -> None:
    """Warn if the anatomical orientation contradicts the directions, which count."""
    anatomy = fields.get("anatomicalorientation", "").upper()
    if anatomy in UNKNOWN or "?" in anatomy:
        return
    letters = [TOWARDS.get(letter) for letter in anatomy]
    if len(anatomy) >= AXES and all(letters[:AXES]):
        stated_axes = np.zeros((AXES, AXES))
        for axis, letter in enumerate(letters[:AXES]):
            assert letter is not None
            stated_axes[letter[0], axis] = letter[1]
        if ((directions * stated_axes).sum(axis=0) > 0.5).all():  # within 60 degrees
            return
    warn(
        "%s says AnatomicalOrientation = %s, which does not fit its TransformMatrix; the matrix is taken",
        path,
        anatomy[:20],
    )


def _floats(fields: _MetaFields, name: str, count: int) -> NDArray[np.float64] | None:
    """Return `count` numbers of a field; None if it is missing."""
    if name not in fields:
        return None
    numbers = np.array([float(word) for word in fields[name].split()])
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers in {name} where there should be {count}")
    return numbers


def _integers(fields: _MetaFields, name: str, count: int) -> tuple[int, ...]:
    """Return `count` integers of a field."""
    numbers = tuple(int(word) for word in fields[name].split())
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers in {name} where there should be {count}")
    return numbers


# --- cells -----------------------------------------------------------------------------------------------


def _cell_reader(path: Path, fields: _MetaFields, header: ImageHeader, listed: tuple[str, ...], end: int) -> CellReader:
    """Return the function that reads the cells of a file, after checking the header."""
    name = fields["elementtype"].lower().removeprefix("met_").removesuffix("_array")
    if name not in TYPES:
        raise FormatError(f"{path} holds cells of type {name[:40]!r}; save them as integers or floats")
    for key, usual in (("elementtointensityfunctionslope", 1.0), ("elementtointensityfunctionoffset", 0.0)):
        if float(fields.get(key, usual)) != usual:
            raise FormatError(f"{path} scales its values by {key}; save the scaled values")
    if fields.is_true("binarydata") or "binarydata" not in fields:
        encoding = "zlib" if fields.is_true("compresseddata") else "raw"
    else:
        encoding = "text"
    most_first = fields.is_true("binarydatabyteordermsb", "elementbyteordermsb")
    kind = np.dtype(TYPES[name]).newbyteorder(">" if most_first else "<")
    skip = int(fields.get("headersize", "0"))
    if skip < -1 or (skip == -1 and encoding != "raw"):
        raise FormatError(
            f"{path} has a HeaderSize of {skip} before {encoding} data; give 0 or more, or -1 for raw data"
        )
    files = _data_files(path, fields, header, listed)
    is_local = files == [path]
    if is_local and 0 < skip < end:
        raise FormatError(
            f"{path} has a HeaderSize of {skip}, within its own header of {end} bytes; delete that line, or give -1"
        )
    packed = int(fields.get("compresseddatasize", "0")) if encoding == "zlib" else 0
    parts = [
        DataFile(
            path=file,
            begin=max(skip, end if is_local else 0),  # counted from the beginning of the file
            from_end=skip == -1,
            packed_bytes=packed if packed > 0 and len(files) == 1 else None,
        )
        for file in files
    ]
    return lambda low, high: read_data_files(path, parts, kind, header.cells, low, high, encoding=encoding)


def _data_files(path: Path, fields: _MetaFields, header: ImageHeader, listed: tuple[str, ...]) -> list[Path]:
    """Return the files of the cells, in order."""
    data_file = fields[DATA_FIELD]
    words = data_file.split()
    if data_file.lower() == "local":
        return [path]
    if words[:1] == ["LIST"]:
        if not listed:
            raise FormatError(f"{path} lists no files that hold its cells; save it again")
        return [find_data_file(path, name) for name in listed]
    if len(words) > 1 and "%" in words[0]:
        low, high, step = (int(word) for word in (*words[1:4], "1")[:3]) if len(words) > 2 else (int(words[1]), 0, 1)
        if len(words) == 2:
            high = low + header.sizes[-1] - 1
        return [find_data_file(path, name) for name in numbered_names(path, words[0], low, high, step)]
    return [find_data_file(path, data_file)]
