"""A field as OME-Zarr, written box by box: complete or not at all."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import OutputError
from infill.files.whole_files import wrap_os_errors
from infill.lazy.volume import LazyVolume
from infill.version import __version__

CHUNK = 128  # cells along a side

Box = tuple[tuple[slice, ...], NDArray[np.float32]]


def check_zarr_target(path: Path, *, overwrite: bool) -> None:
    """Raise OutputError if a folder of Zarr cannot be written."""
    if os.path.lexists(path) and not (overwrite and path.is_dir()):
        advice = "give another name, or --force to overwrite it" if path.is_dir() else "give another name"
        raise OutputError(f"{path} exists; {advice}")
    if not path.absolute().parent.is_dir():
        raise OutputError(f"there is no folder {path.parent}; make it first or write elsewhere")


def write_zarr_field(path: Path, volume: LazyVolume, boxes: Iterable[Box]) -> None:
    """Write the boxes of a field on the grid of a volume; the folder takes its place once it is complete.

    Parameters
    ----------
    path : Path
    volume : LazyVolume
        The grid and its place.
    boxes : iterable of (slices, float32 array)
        All cells, each in one box.
    """
    import zarr

    partial = path.absolute().parent / f".{secrets.token_hex(4)}.partial"
    try:
        with wrap_os_errors(path):
            group = zarr.open_group(str(partial), mode="w", attributes=_attributes(volume))
            array = group.create_array(
                "0",
                shape=volume.shape,
                chunks=tuple(min(CHUNK, count) for count in volume.shape),
                dtype="float32",
                fill_value=-1.0,
                dimension_names=("x", "y", "z"),
            )
            for box, values in boxes:
                array[box] = values
            _replace(partial, path)
    finally:
        shutil.rmtree(partial, ignore_errors=True)


def _replace(partial: Path, path: Path) -> None:
    """Move a folder to its place; a folder that is there is kept until then."""
    backup = partial.with_suffix(".kept")
    if path.exists():
        os.replace(path, backup)
    try:
        os.replace(partial, path)
    except OSError as error:
        if backup.exists():
            os.replace(backup, path)
        raise OSError(error.errno or errno.EACCES, error.strerror) from error
    shutil.rmtree(backup, ignore_errors=True)


def _attributes(volume: LazyVolume) -> dict[str, Any]:
    """Return the attributes of OME-Zarr 0.5, with the place of the grid."""
    centre = [float(corner + size / 2) for corner, size in zip(volume.origin, volume.spacing, strict=True)]
    changes = [
        {"type": "scale", "scale": list(map(float, volume.spacing))},
        {"type": "translation", "translation": centre},
    ]
    return {
        "ome": {
            "version": "0.5",
            "multiscales": [
                {
                    "name": "field",
                    "axes": [{"name": axis, "type": "space", "unit": "millimeter"} for axis in "xyz"],
                    "datasets": [{"path": "0", "coordinateTransformations": changes}],
                }
            ],
        },
        "phasefill": {
            "version": __version__,
            "direction": np.asarray(volume.direction).tolist(),
            "space": volume.space,
        },
    }
