"""Open a volume by its name, without reading it."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from infill.errors import FormatError, ParameterError
from infill.files.broken import missing_file, require_not_empty
from infill.grid import spacing_of
from infill.imaging.assumed import keep_warnings
from infill.imaging.slices import natural_key
from infill.lazy.hdf5 import open_hdf5
from infill.lazy.mapped import open_nifti, open_npy, open_nrrd, open_tiff
from infill.lazy.names import is_hdf5, is_zarr, name_of
from infill.lazy.volume import LazyVolume
from infill.lazy.zarr_arrays import open_zarr
from infill.volume import AXES

TIFF = (".tif", ".tiff")
SUFFIXES = (".npy", *TIFF, ".nii", ".nrrd", ".nhdr")


def open_volume(
    path: str | os.PathLike[str],
    *,
    array: str | None = None,
    spacing: float | tuple[float, ...] | None = None,
) -> LazyVolume:
    """Open a volume without reading its cells.

    Parameters
    ----------
    path : str or Path
        Zarr by path or URL, OME-Zarr, ``file.h5:/dataset``, .npy, .tif, a folder of .tif, .nii or .nrrd that is not
        compressed.
    array : str, optional
        Name of an array in a group of Zarr or in an HDF5 file.
    spacing : float or (hx, hy, hz), optional
        Cell size, mm, instead of the one of the file.

    Raises
    ------
    FormatError
        If it cannot be opened, or not in parts.
    ParameterError
        If a package is missing, which the message names, or `array` is given for a file without names.
    """
    name = name_of(path)
    with keep_warnings() as assumptions:
        volume = _open(name, array)
    if assumptions:
        volume = replace(volume, warnings=tuple(dict.fromkeys((*volume.warnings, *assumptions))))
    return volume if spacing is None else replace(volume, spacing=spacing_of(spacing, AXES))


def _open(name: str, array: str | None) -> LazyVolume:
    """Open a volume by the reader of its name."""
    if is_hdf5(name):
        return open_hdf5(name, array)
    if is_zarr(name):
        return open_zarr(name, array)
    source = Path(name)
    if array is not None:
        raise ParameterError.about("array", f"is {array!r}, and {name} holds no named arrays; leave it out")
    if source.is_dir():
        files = sorted((file for file in source.iterdir() if file.suffix.lower() in TIFF), key=natural_key)
        if not files:
            raise FormatError(f"{name} holds no .tif, so that no part of it can be read; save it as .npy or Zarr")
        return open_tiff(tuple(files), source)
    if not source.is_file():
        raise FormatError(missing_file(name))
    require_not_empty(source)
    suffix = source.suffix.lower()
    if suffix not in SUFFIXES:
        raise FormatError(
            f"{name} cannot be read in parts; save it as {', '.join(SUFFIXES)} without compression, or as Zarr"
        )
    if suffix in TIFF:
        return open_tiff((source,))
    return {".npy": open_npy, ".nii": open_nifti}.get(suffix, open_nrrd)(source)
