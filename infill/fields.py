"""A volume to a file and back: NumPy's .npy and .npz, which need no other package, and NRRD, which is only written.

`infill.scans.read_volume` reads these and all others.
"""

from __future__ import annotations

import contextlib
import gzip
import math
import os
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import IO, Any, BinaryIO, cast
from xml.etree import ElementTree

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from infill.errors import FormatError, InfillError, ParameterError
from infill.machine import require_memory
from infill.output import whole_file
from infill.version import __version__
from infill.volume import AXES, Volume

SMALLER = "cut the volume to the part that matters, or halve its resolution"
# What the readers of NumPy, tifffile and Pillow raise for files that hold something else than they should.
BROKEN = (
    ValueError, LookupError, TypeError, AttributeError, ArithmeticError, EOFError, RuntimeError, MemoryError,
    SyntaxError, AssertionError, struct.error, zlib.error, tokenize.TokenError, zipfile.BadZipFile,
    ElementTree.ParseError,
)  # fmt: skip
COLOURS = (2, 3, 4)  # numbers per cell of a picture that is not grey
PLACE = {"spacing", "spacing_zyx_mm", "origin", "direction", "space"}  # what an .npz may hold beside its values
NRRD_TYPES = {
    "b1": "uint8", "i1": "int8", "u1": "uint8", "i2": "int16", "u2": "uint16", "i4": "int32", "u4": "uint32",
    "i8": "int64", "u8": "uint64", "f4": "float", "f8": "double",
}  # fmt: skip
NRRD_SPACES = {"LPS": "left-posterior-superior", "RAS": "right-anterior-superior"}


# --- writing ---------------------------------------------------------------------------------------------


def write_field(volume: Volume, path: str | os.PathLike[str]) -> Path:
    """Write a volume; an existing file is replaced once the new one is complete.

    Parameters
    ----------
    volume : Volume
        Values [x, y, z], and where they lie in mm.
    path : str or Path
        .npz (arrays `values`, `spacing`, `origin`, `direction` and `space`) or .nrrd.

    Returns
    -------
    Path

    Raises
    ------
    FormatError
        For an unknown suffix.
    OutputError
        If the file cannot be written.
    """
    target = Path(path)
    write = field_writer(target)
    with whole_file(target) as file:
        write(volume, file)
    return target


def field_writer(path: Path) -> Callable[[Volume, BinaryIO], None]:
    """Return the function that writes the format of `path`, or raise FormatError."""
    suffix = path.suffix.lower()
    if suffix not in FIELD_WRITERS:
        given = f"the suffix {path.suffix!r}" if suffix else f"{path.name!r}, which has no suffix"
        raise FormatError(f"cannot tell a format of volumes from {given}; use one of {', '.join(FIELD_WRITERS)}")
    return FIELD_WRITERS[suffix]


def write_npz(volume: Volume, file: BinaryIO) -> None:
    """Write a compressed .npz: the values, and where they lie; `origin` is the lower corner of the first cell."""
    np.savez_compressed(
        file,
        values=volume.values,
        spacing=volume.cell_size,
        origin=np.array(volume.origin),
        direction=np.asarray(volume.direction),
        space=np.array(volume.space),
    )


def write_nrrd(volume: Volume, file: BinaryIO) -> None:
    """Write NRRD: a header of text and the values, packed by gzip; `space origin` is the centre of the first cell.

    Booleans become 0 and 1, and numbers of 16 bits after the point get 32. A space without a name stays
    without one, so that no program turns its axes. Source: "Definition of NRRD File Format", Teem.
    """
    kind = _stored(volume.values.dtype)
    axes = np.asarray(volume.direction) * volume.cell_size  # column i: one cell along axis i
    centre = np.array(volume.origin) + axes.sum(axis=1) / 2
    space = f"space: {NRRD_SPACES[volume.space]}" if volume.space in NRRD_SPACES else f"space dimension: {AXES}"
    header = (
        "NRRD0005",
        f"# phasefill {__version__}, millimetres",
        f"type: {NRRD_TYPES[kind.str[1:]]}",
        f"dimension: {AXES}",
        space,
        f"sizes: {' '.join(str(cells) for cells in volume.values.shape)}",
        f"space directions: {' '.join(_vector(axis) for axis in axes.T)}",
        f"kinds:{AXES * ' domain'}",
        "endian: little",
        "encoding: gzip",
        f"space origin: {_vector(centre)}",
    )
    file.write(("\n".join(header) + "\n\n").encode("ascii"))
    with gzip.GzipFile(filename="", mode="wb", compresslevel=6, fileobj=cast(IO[bytes], file), mtime=0) as packed:
        for k in range(volume.values.shape[2]):  # layer by layer, so that no second copy is held
            packed.write(volume.values[:, :, k].astype(kind).tobytes(order="F"))


def _stored(kind: np.dtype[np.generic]) -> np.dtype[np.generic]:
    """Return the type in which NRRD holds numbers of type `kind`, low byte first."""
    if kind.kind == "f":
        return np.dtype("<f4" if kind.itemsize <= 4 else "<f8")
    return np.dtype(np.uint8) if kind.kind == "b" else kind.newbyteorder("<")


def _vector(numbers: Iterable[float]) -> str:
    return "(" + ",".join(f"{float(number):.17g}" for number in numbers) + ")"


FIELD_WRITERS: dict[str, Callable[[Volume, BinaryIO], None]] = {".npz": write_npz, ".nrrd": write_nrrd}


# --- what all readers have in common ---------------------------------------------------------------------


def checked_volume(path: Path, values: NDArray[Any], **place: Any) -> Volume:  # noqa: ANN401 - hands on
    """Return the checked volume of values [x, y, z]."""
    if values.dtype.kind == "c":
        raise FormatError(f"{path} holds complex numbers; save their magnitude or their phase")
    if values.dtype.kind not in "biuf":
        raise FormatError(f"{path} holds values of type {values.dtype}; save numbers or booleans")
    if values.ndim > AXES and values.shape[-1] in COLOURS:
        raise FormatError(f"{path} holds {values.shape[-1]} numbers per cell, shape {values.shape}; save one as grey")
    if values.ndim != AXES or values.size == 0:
        raise FormatError(f"{path} holds an array of shape {values.shape}; save three axes, with cells")
    if not values.dtype.isnative:
        values = values.astype(values.dtype.newbyteorder("="))
    low, high = values.min().item(), values.max().item()
    if not (math.isfinite(low) and math.isfinite(high)):
        raise FormatError(f"{path} holds cells that are NaN or infinite; fill or cut those cells first")
    if low == high:
        raise FormatError(f"{path} holds {low:g} in all cells, so no surface; check that it is the right file")
    try:
        return Volume(values=values, **place)
    except ParameterError as error:
        raise FormatError(f"{path} has no usable place in space: {error}; resample it, or save it again") from error


@contextlib.contextmanager
def told_broken(path: Path) -> Iterator[None]:
    """Turn what a reader says of a broken file into an error of ours."""
    try:
        yield
    except InfillError:
        raise
    except BROKEN as error:
        raise FormatError(f"{path} is broken or no {path.suffix} file ({one_line(error)}); save it again") from error


def one_line(error: Exception) -> str:
    """Return what an error says, in one line that is not too long."""
    words = " ".join(str(error).split()) or type(error).__name__
    return words if len(words) <= 200 else words[:200] + "…"


def _numbers(path: Path, name: str, values: NDArray[Any], shape: tuple[int, ...]) -> NDArray[np.float64]:
    if values.dtype.kind not in "iuf" or values.shape != shape:
        raise FormatError(f"{path} has a {name} of shape {values.shape} {values.dtype}; save {shape} numbers")
    return values.astype(np.float64)


# --- reading ---------------------------------------------------------------------------------------------


def read_npy(path: Path) -> Volume:
    """Return an array [x, y, z], mapped and not loaded."""
    with told_broken(path):
        values = npy_format.open_memmap(path, mode="r")
    return checked_volume(path, values)


def read_npz(path: Path, name: str | None = None) -> Volume:
    """Return the one array with three axes, or the one of that name, with its place if the file says it."""
    with told_broken(path), zipfile.ZipFile(path) as archive:
        members = {member.filename.removesuffix(".npy"): member for member in archive.infolist()}
        volumes = [key for key, member in members.items() if _axes(archive, member) >= AXES and key not in PLACE]
        if name is not None and name not in members:
            raise FormatError(f"{path} holds no array {name!r}; it holds {', '.join(members) or 'none'}")
        if name is None and len(volumes) != 1:
            found = f"{len(volumes)} arrays with three axes ({', '.join(volumes)})" if volumes else "no volume"
            advice = f"choose one: --array {volumes[0]}" if volumes else "save an array [x, y, z]"
            raise FormatError(f"{path} holds {found}; {advice}")
        values = _member(archive, members[name or volumes[0]])
        place = {key: _member(archive, members[key]) for key in PLACE & set(members)}
    if {"spacing", "spacing_zyx_mm"} <= set(place):
        raise FormatError(f"{path} holds both spacing and spacing_zyx_mm; keep the one in the order of the axes")
    known: dict[str, Any] = {}
    if "spacing_zyx_mm" in place:
        known["spacing"] = tuple(_numbers(path, "spacing_zyx_mm", place["spacing_zyx_mm"], (AXES,))[::-1].tolist())
        values = values.T
    elif "spacing" in place:
        each = place["spacing"]
        known["spacing"] = _numbers(path, "spacing", each, (AXES,) if each.ndim else ()).tolist()
    if "origin" in place:
        known["origin"] = tuple(_numbers(path, "origin", place["origin"], (AXES,)).tolist())
    if "direction" in place:
        known["direction"] = _numbers(path, "direction", place["direction"], (AXES, AXES))
    if "space" in place:
        known["space"] = str(place["space"])
    return checked_volume(path, values, **known)


def _axes(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> int:
    """Return how many axes an array has, from its header alone."""
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{member.filename} is packed in an unusual way")
    with archive.open(member) as file:
        version = npy_format.read_magic(file)
        header = npy_format.read_array_header_1_0 if version == (1, 0) else npy_format.read_array_header_2_0
        return len(header(file)[0])


def _member(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> NDArray[Any]:
    require_memory(member.file_size, None, SMALLER)
    with archive.open(member) as file:
        return np.asarray(npy_format.read_array(file, allow_pickle=False))  # objects could run code
