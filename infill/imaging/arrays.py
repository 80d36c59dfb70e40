"""NumPy's .npy and .npz, which need no other package."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.imaging.checked_volume import checked_volume
from infill.imaging.packed import BLANK_BYTES, MOST_PADDING
from infill.machine import require_memory
from infill.volume import AXES, Volume

PLACE = {"spacing", "spacing_zyx_mm", "origin", "direction", "space"}  # optional members of an .npz besides its values


def read_npy(path: Path) -> Volume:
    """Memory-map an array [x, y, z]."""
    return checked_volume(path, map_npy(path))


def map_npy(path: Path) -> NDArray[Any]:
    """Memory-map the array of a file, of any number of axes."""
    with wrap_reader_errors(path):
        values = npy_format.open_memmap(path, mode="r")
        surplus = path.stat().st_size - values.offset - values.nbytes
        if surplus > MOST_PADDING:
            raise FormatError(f"{path} holds {surplus} bytes more than its header announces; save one array in it")
        with path.open("rb") as file:
            file.seek(-surplus, os.SEEK_END)
            if file.read(surplus).strip(BLANK_BYTES):
                raise FormatError(f"{path} holds {surplus} bytes more than its header announces; save one array in it")
    return values


def read_npz(path: Path, name: str | None = None) -> Volume:
    """Read the only array with three axes, or the named one, with its place in space if the file has one."""
    values, placement = read_npz_array(path, name)
    return checked_volume(path, values, **placement)


def read_npz_array(path: Path, name: str | None = None) -> tuple[NDArray[Any], dict[str, Any]]:
    """Read the only array with three or more axes, or the named one; return it, and its place as `Volume` takes it."""
    with wrap_reader_errors(path), zipfile.ZipFile(path) as archive:
        members = _members(archive)
        values = _read_member(archive, members[_choose_array(path, archive, name)])
        place = {key: _read_member(archive, members[key]) for key in PLACE & set(members)}
    if {"spacing", "spacing_zyx_mm"} <= set(place):
        raise FormatError(f"{path} holds both spacing and spacing_zyx_mm; keep the one in the order of the axes")
    placement: dict[str, Any] = {}
    if "spacing_zyx_mm" in place:
        placement["spacing"] = tuple(
            _check_numbers(path, "spacing_zyx_mm", place["spacing_zyx_mm"], (AXES,))[::-1].tolist()
        )
        values = values.transpose(*range(values.ndim - AXES), *range(values.ndim)[: -AXES - 1 : -1])
    elif "spacing" in place:
        spacing = place["spacing"]
        placement["spacing"] = _check_numbers(path, "spacing", spacing, (AXES,) if spacing.ndim else ()).tolist()
    if "origin" in place:
        placement["origin"] = tuple(_check_numbers(path, "origin", place["origin"], (AXES,)).tolist())
    if "direction" in place:
        placement["direction"] = _check_numbers(path, "direction", place["direction"], (AXES, AXES))
    if "space" in place:
        placement["space"] = str(place["space"])
    return values, placement


def count_npz_axes(path: Path, name: str | None = None) -> int:
    """Count the axes of the array that `read_npz_array` would read."""
    with wrap_reader_errors(path), zipfile.ZipFile(path) as archive:
        return _axes(archive, _members(archive)[_choose_array(path, archive, name)])


def _members(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Return the arrays of an archive by their names."""
    return {member.filename.removesuffix(".npy"): member for member in archive.infolist()}


def _choose_array(path: Path, archive: zipfile.ZipFile, name: str | None) -> str:
    """Return the name of the only array with three or more axes, or the given name if it is there."""
    members = _members(archive)
    volumes = [key for key, member in members.items() if _axes(archive, member) >= AXES and key not in PLACE]
    if name is not None and name not in members:
        raise FormatError(f"{path} holds no array {name!r}; it holds {', '.join(members) or 'none'}")
    if name is None and len(volumes) != 1:
        content = f"{len(volumes)} arrays with three axes ({', '.join(volumes)})" if volumes else "no volume"
        advice = f"choose one: --array {volumes[0]}" if volumes else "save an array [x, y, z]"
        raise FormatError(f"{path} holds {content}; {advice}")
    return name or volumes[0]


def _check_numbers(path: Path, name: str, values: NDArray[Any], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Check the shape of an array of numbers and return it as float64."""
    if values.dtype.kind not in "iuf" or values.shape != shape:
        raise FormatError(f"{path} has a {name} of shape {values.shape} {values.dtype}; save {shape} numbers")
    return values.astype(np.float64)


def _axes(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> int:
    """Return the number of axes of an array, from its header alone."""
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{member.filename} is packed in an unusual way")
    with archive.open(member) as file:
        version = npy_format.read_magic(file)
        header = npy_format.read_array_header_1_0 if version == (1, 0) else npy_format.read_array_header_2_0
        return len(header(file)[0])


def _read_member(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> NDArray[Any]:
    """Read one array of an archive, and check that nothing follows it."""
    require_memory(member.file_size, None, SMALLER_VOLUME_ADVICE)
    with archive.open(member) as file:
        values = np.asarray(npy_format.read_array(file, allow_pickle=False))  # objects could run code
        if file.read(1):  # zipfile compares the checksum at the end
            raise ValueError(f"{member.filename} holds more than its header announces")
    return values


def write_npz(volume: Volume, file: BinaryIO) -> None:
    """Write a compressed .npz of the values and their place; `origin` is the lower corner of the first cell."""
    np.savez_compressed(
        file,
        values=volume.values,
        spacing=volume.cell_size,
        origin=np.array(volume.origin),
        direction=np.asarray(volume.direction),
        space=np.array(volume.space),
    )
