"""NIfTI-1 and NIfTI-2 in one file: .nii, plain or packed by gzip.

A header of fixed length, then the cells, x fastest. The header gives their place up to three times: by a matrix
(sform), by a quaternion (qform), and by cell sizes alone; a code tells whether each of the first two counts. Space is
RAS; here it becomes LPS. Sources: nifti1.h and nifti2.h of the NIfTI data format working group.
"""

from __future__ import annotations

import gzip
import logging
import math
import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import error_text, wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.images import CellReader, ImageHeader, StoredCells, read_frame, read_frames, require_sizes
from infill.imaging.packed import cut_off_error, read_bytes
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

Content = TypeVar("Content")
LOG = logging.getLogger("infill")
MAGIC_OF_GZIP = b"\x1f\x8b"
TYPES = {
    2: "u1",
    4: "i2",
    8: "i4",
    16: "f4",
    64: "f8",
    256: "i1",
    512: "u2",
    768: "u4",
    1024: "i8",
    1280: "u8",
}
COMPLEX = {32, 1792, 2048}
COLOURS = {128: 3, 2304: 4}
MILLIMETRES = {1: 1000.0, 2: 1.0, 3: 1e-3}
LENGTH_BITS = 7  # of the units; the others are those of time
CODES = range(6)  # of the methods to place a volume: 0 for an unused one
# Tolerance between two places that are rounded to 32 bits: share of a cell.
AGREEMENT_TOLERANCE = 1e-2
QUATERNION_TOLERANCE = 1e-4  # by how much the squares of a quaternion's parts may exceed 1


@dataclass(frozen=True, kw_only=True)
class _HeaderLayout:
    """Positions of the fields in a header of one version."""

    size: int
    first: int
    dim: str
    fields: dict[str, tuple[str, int]]


NIFTI_1 = _HeaderLayout(
    size=348,
    first=352,
    dim="8h",
    fields={
        "magic": ("4s", 344),
        "dim": ("8h", 40),
        "datatype": ("h", 70),
        "bitpix": ("h", 72),
        "pixdim": ("8f", 76),
        "vox_offset": ("f", 108),
        "slope": ("2f", 112),
        "units": ("B", 123),
        "qform_code": ("h", 252),
        "sform_code": ("h", 254),
        "quaternion": ("6f", 256),
        "sform": ("12f", 280),
    },
)
NIFTI_2 = _HeaderLayout(
    size=540,
    first=544,
    dim="8q",
    fields={
        "magic": ("8s", 4),
        "dim": ("8q", 16),
        "datatype": ("h", 12),
        "bitpix": ("h", 14),
        "pixdim": ("8d", 104),
        "vox_offset": ("q", 168),
        "slope": ("2d", 176),
        "units": ("i", 500),
        "qform_code": ("i", 344),
        "sform_code": ("i", 348),
        "quaternion": ("6d", 352),
        "sform": ("12d", 400),
    },
)
LAYOUTS = {NIFTI_1.size: NIFTI_1, NIFTI_2.size: NIFTI_2}


class _NiftiHeader:
    """The fields of a header, by name."""

    def __init__(self, form: _HeaderLayout, order: str, content: bytes) -> None:
        self.form, self.order, self.held = form, order, content

    def numbers(self, name: str) -> tuple[Any, ...]:
        """Return the numbers of a field."""
        kind, at = self.form.fields[name]
        return struct.unpack_from(self.order + kind, self.held, at)

    def number(self, name: str) -> Any:  # noqa: ANN401 - a number or bytes
        """Return the only number of a field."""
        return self.numbers(name)[0]


def read_nifti(path: Path, frame: int | None = None) -> Volume:
    """Read the volume of a file, [x, y, z] in LPS, or one of several, counted from 0."""
    return _read_image(path, lambda image, read_cells: read_frame(image, frame, read_cells))


def read_nifti_frames(path: Path) -> tuple[Volume, ...]:
    """Read all volumes of a file, [x, y, z] in LPS."""
    return _read_image(path, read_frames)


def count_nifti_frames(path: Path) -> int:
    """Count the volumes of a file from its header."""
    return _read_image(path, lambda image, _: image.frames)


def _read_image(path: Path, read: Callable[[ImageHeader, CellReader], Content]) -> Content:
    """Parse the header of a file; return the result of a function of it and of a reader of its cells."""
    with wrap_reader_errors(path), np.errstate(all="ignore"), path.open("rb") as file:  # infinite places are refused
        packed = file.read(2) == MAGIC_OF_GZIP
        file.seek(0)
        header = _parse_header(path, _read_head(path, file, packed=packed))
        sizes = _sizes(path, header)
        image = ImageHeader(
            path=path, sizes=sizes, spatial=tuple(range(AXES)), affine=_affine(path, header, sizes), space="LPS"
        )
        kind = _kind(path, header)
        begin = _first_cell(path, header)

        def read_cells(low: int, high: int) -> NDArray[Any]:
            """Read cells `low` to `high - 1`."""
            file.seek(0)
            size = kind.itemsize
            content = read_bytes(
                str(path),
                file,
                (high - low) * size,
                packing="gzip" if packed else "",
                skip=begin + low * size,
                total=begin + image.cells * size,
            )
            return _scaled(path, content.view(kind), header)

        return read(image, read_cells)


def locate_nifti(path: Path) -> StoredCells:
    """Return where a file that is not compressed has its cells, of the values themselves.

    Raises
    ------
    FormatError
        If it is compressed, or its cells are scaled to values.
    """
    with wrap_reader_errors(path), np.errstate(all="ignore"), path.open("rb") as file:
        if file.read(2) == MAGIC_OF_GZIP:
            raise FormatError(f"{path} is compressed, so that no part of it can be read; unpack it, or save it as Zarr")
        file.seek(0)
        header = _parse_header(path, _read_head(path, file, packed=False))
        slope, intercept = header.numbers("slope")
        if math.isfinite(slope) and slope != 0 and (slope, intercept) != (1, 0):
            raise FormatError(
                f"{path} scales its cells by {plain_argument(slope)} to values; save the values themselves, or Zarr"
            )
        sizes = _sizes(path, header)
        image = ImageHeader(
            path=path, sizes=sizes, spatial=tuple(range(AXES)), affine=_affine(path, header, sizes), space="LPS"
        )
        return StoredCells(header=image, path=path, begin=_first_cell(path, header), kind=_kind(path, header))


def _read_head(path: Path, file: BinaryIO, *, packed: bool) -> bytes:
    """Read the first bytes, up to the length of the longest header."""
    if not packed:
        return file.read(NIFTI_2.size)
    try:
        with gzip.GzipFile(fileobj=file) as unpacked:
            return _read_start(cast(BinaryIO, unpacked), NIFTI_2.size)
    except (OSError, zlib.error) as error:
        raise FormatError(
            f"{path} is damaged: it does not unpack ({error_text(error)}); copy or save it again"
        ) from error


def _read_start(file: BinaryIO, count: int) -> bytes:
    """Read up to `count` bytes, also before a truncated end."""
    content = b""
    try:
        while len(content) < count and (byte := file.read(1)):
            content += byte
    except EOFError:
        pass
    return content


def _parse_header(path: Path, content: bytes) -> _NiftiHeader:
    """Parse the header of either version and byte order."""
    for order in "<>":
        form = LAYOUTS.get(struct.unpack(f"{order}i", content[:4])[0]) if len(content) >= 4 else None
        if form is None:
            continue
        if len(content) < form.size:
            raise cut_off_error(str(path), len(content), form.size, "bytes of its header")
        header = _NiftiHeader(form, order, content)
        magic = header.number("magic")[:4]
        if magic in (b"ni1\0", b"ni2\0"):
            raise FormatError(f"{path} is the header of a pair of files; save both as one .nii")
        if magic not in (b"n+1\0", b"n+2\0"):
            raise FormatError(f"{path} has no mark of NIfTI in its header (it may be Analyze 7.5); save it as .nii")
        return header
    raise FormatError(f"{path} does not begin with a header of NIfTI; check that it is a .nii file")


def _sizes(path: Path, header: _NiftiHeader) -> tuple[int, ...]:
    """Return the cells along each axis."""
    axes, *sizes = header.numbers("dim")
    if not 1 <= axes <= len(sizes):
        raise FormatError(f"{path} has {axes} axes, and NIfTI 1 to 7; save it again")
    # Axes beyond space may be given as 0 where there is nothing along them.
    shape = tuple(max(1, size) if axis >= AXES else size for axis, size in enumerate(sizes[:axes]))
    require_sizes(path, shape)
    return shape


def _kind(path: Path, header: _NiftiHeader) -> np.dtype[Any]:
    """Return the type of the cells."""
    code = header.number("datatype")
    if code in COMPLEX:
        raise FormatError(f"{path} holds complex numbers; save their magnitude or their phase")
    if code in COLOURS:
        raise FormatError(f"{path} holds {COLOURS[code]} numbers per cell, a colour; save one as grey")
    if code not in TYPES:
        raise FormatError(f"{path} holds cells of type {code}; save them as integers or floats of up to 64 bits")
    kind = np.dtype(TYPES[code]).newbyteorder("<" if header.order == "<" else ">")
    if header.number("bitpix") not in (0, 8 * kind.itemsize):
        raise FormatError(
            f"{path} states cells of {header.number('bitpix')} bits and a type of {8 * kind.itemsize}; save it again"
        )
    return kind


def _first_cell(path: Path, header: _NiftiHeader) -> int:
    """Return the position of the first cell, bytes."""
    begin = header.number("vox_offset")
    if begin == 0:  # some programs leave it out
        return header.form.first
    if not header.form.first <= begin < 2**62 or begin != int(begin):
        raise FormatError(
            f"{path} says that its cells begin at byte {plain_argument(begin)}, within its header; save it again"
        )
    return int(begin)


def _scaled(path: Path, cells: NDArray[Any], header: _NiftiHeader) -> NDArray[Any]:
    """Scale cells to values: slope * cell + intercept, unless the slope is 0 or not finite."""
    slope, intercept = header.numbers("slope")
    if not math.isfinite(slope) or slope == 0 or (slope == 1 and intercept == 0):
        return cells
    if not math.isfinite(intercept):
        raise FormatError(f"{path} adds {intercept} to its values (scl_inter); save it again")
    # 24 bits hold all cells of 16 bits.
    exact = cells.dtype.itemsize <= 2 or cells.dtype.str[1:] == "f4"
    values: NDArray[np.floating[Any]] = cells.astype(np.float32 if exact else np.float64)
    np.multiply(values, slope, out=values)
    np.add(values, intercept, out=values)
    return values


# --- place -----------------------------------------------------------------------------------------------


def _affine(path: Path, header: _NiftiHeader, sizes: tuple[int, ...]) -> NDArray[np.float64]:
    """Return the affine, mm in LPS: the sform if its code is not 0, else the qform, else the sizes alone.

    If neither counts, the axes lead left, anterior and superior from a volume around the origin, as in Analyze.
    """
    unit = header.number("units") & LENGTH_BITS
    if unit == 0:
        warn("%s does not say its unit of length; it is taken as mm, unless --spacing gives it", path)
    elif unit not in MILLIMETRES:
        warn("%s has an unknown unit of length (code %d); it is taken as mm, unless --spacing gives it", path, unit)
    scale = MILLIMETRES.get(unit, 1.0)
    steps = np.abs(np.array(header.numbers("pixdim")[1 : AXES + 1], dtype=np.float64))
    codes = {name: header.number(f"{name}_code") for name in ("sform", "qform")}
    for name, code in codes.items():
        if code not in CODES:
            warn("%s has an unknown %s code, %d", path, name, code)
    by_matrix = np.array(header.numbers("sform"), dtype=np.float64).reshape(AXES, AXES + 1)
    by_quaternion = _affine_of_quaternion(path, header, steps) if codes["qform"] else None
    if codes["sform"]:
        _warn_if_sizes_differ(path, by_matrix, steps)
        if (
            by_quaternion is not None
            and (distance := _corner_distance(by_matrix, by_quaternion, sizes)) > AGREEMENT_TOLERANCE
        ):
            warn(
                "%s states two places, up to %s cells apart: by its sform (code %d), which is taken, and by its "
                "qform (code %d)",
                path,
                plain_argument(distance, 3),
                codes["sform"],
                codes["qform"],
            )
        affine = by_matrix
    elif by_quaternion is not None:
        affine = by_quaternion
    else:
        warn(
            "%s does not say which way its axes lead (both codes are 0); left, anterior and superior are taken, "
            "so that it may be mirrored",
            path,
        )
        affine = np.column_stack([np.diag((-1, 1, 1) * steps), np.zeros(AXES)])
        affine[:, AXES] = -affine[:, :AXES] @ ((np.array(sizes[:AXES]) - 1) / 2)
    return np.array([[-scale], [-scale], [scale]]) * affine


def _affine_of_quaternion(path: Path, header: _NiftiHeader, steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the affine of the qform; formulas of nifti1.h, "QUATERNION REPRESENTATION OF ROTATION MATRIX"."""
    b, c, d, *offset = (float(number) for number in header.numbers("quaternion"))
    squared_real = 1 - (b * b + c * c + d * d)
    if not squared_real > -QUATERNION_TOLERANCE:
        raise FormatError(
            f"{path} has a quaternion that is not a rotation ({plain_argument(b, 4)}, {plain_argument(c, 4)}, "
            f"{plain_argument(d, 4)}); save it again"
        )
    if squared_real < 1e-7:  # a half turn, rounded
        length = math.sqrt(b * b + c * c + d * d)
        a, b, c, d = 0.0, b / length, c / length, d / length
    else:
        a = math.sqrt(squared_real)
    rotation = np.array(
        [
            [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c],
        ]
    )
    if header.numbers("pixdim")[0] < 0:
        rotation[:, 2] *= -1
    return np.column_stack([rotation * steps, offset])


def _warn_if_sizes_differ(path: Path, affine: NDArray[np.float64], steps: NDArray[np.float64]) -> None:
    """Warn if the stated cell sizes differ from those of the matrix, which counts."""
    lengths = np.linalg.norm(affine[:, :AXES], axis=0)
    if not np.allclose(lengths, steps, rtol=AGREEMENT_TOLERANCE, atol=0):
        warn(
            "%s states cells of %s (pixdim) and %s (sform), of which the latter are taken",
            path,
            " x ".join(plain_argument(size) for size in steps),
            " x ".join(plain_argument(size) for size in lengths),
        )


def _corner_distance(affine: NDArray[np.float64], reference: NDArray[np.float64], sizes: tuple[int, ...]) -> float:
    """Return the largest distance of two affines at the corners of a volume, in smallest cells."""
    last_cell = np.array(sizes[:AXES], dtype=np.float64) - 1
    corners = np.array(np.meshgrid(*((0.0, end) for end in last_cell), indexing="ij")).reshape(AXES, -1)
    differences = (affine - reference) @ np.vstack([corners, np.ones(corners.shape[1])])
    cell = float(np.linalg.norm(affine[:, :AXES], axis=0).min())
    return float(np.linalg.norm(differences, axis=0).max()) / cell if cell > 0 else math.inf
