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
from infill.files.broken import SMALLER, checked_volume, told_broken
from infill.imaging.packed import NOTHING, PADDING
from infill.machine import require_memory
from infill.volume import AXES, Volume

PLACE = {"spacing", "spacing_zyx_mm", "origin", "direction", "space"}  # what an .npz may hold besides its values


def read_npy(path: Path) -> Volume:
    """Return an array [x, y, z], memory-mapped rather than loaded."""
    with told_broken(path):
        values = npy_format.open_memmap(path, mode="r")
        more = path.stat().st_size - values.offset - values.nbytes
        if more > PADDING:
            raise FormatError(f"{path} holds {more} bytes more than its header announces; save one array in it")
        with path.open("rb") as file:
            file.seek(-more, os.SEEK_END)
            if file.read(more).strip(NOTHING):
                raise FormatError(f"{path} holds {more} bytes more than its header announces; save one array in it")
    return checked_volume(path, values)


def read_npz(path: Path, name: str | None = None) -> Volume:
    """Return the only array with three axes, or the one with the given name, placed in space if the file says where."""
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


def _numbers(path: Path, name: str, values: NDArray[Any], shape: tuple[int, ...]) -> NDArray[np.float64]:
    if values.dtype.kind not in "iuf" or values.shape != shape:
        raise FormatError(f"{path} has a {name} of shape {values.shape} {values.dtype}; save {shape} numbers")
    return values.astype(np.float64)


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
        values = np.asarray(npy_format.read_array(file, allow_pickle=False))  # objects could run code
        if file.read(1):  # and the checksum is compared where the end is reached
            raise ValueError(f"{member.filename} holds more than its header announces")
    return values


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
