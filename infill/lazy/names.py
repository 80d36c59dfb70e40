"""Tell kinds of volumes by their names, without loading a package."""

from __future__ import annotations

import os
import re
from pathlib import Path

MARKS = ("zarr.json", ".zarray", ".zgroup")
HDF5 = re.compile(r"(?P<file>.*\.(?:h5|hdf5|hdf|he5|nxs))(?::(?P<dataset>.*))?", re.IGNORECASE)
SCHEME = re.compile(r"^([A-Za-z][A-Za-z0-9]+):/(?!/)")


def name_of(path: str | os.PathLike[str]) -> str:
    """Return the name of a source; a URL gets back the stroke that a path has lost.

    >>> name_of(Path("s3://bucket/a.zarr"))
    's3://bucket/a.zarr'
    """
    return SCHEME.sub(r"\1://", os.fspath(path))


def is_url(name: str) -> bool:
    """Tell whether a name is a URL.

    >>> is_url("s3://bucket/a.zarr"), is_url("a.zarr"), is_url("C:/a.zarr")
    (True, False, False)
    """
    scheme, mark, _ = name.partition("://")
    return bool(mark) and len(scheme) > 1 and scheme.isalnum()


def is_zarr(name: str) -> bool:
    """Tell by the name, or by the contents of a folder, whether it is Zarr, or an array in one."""
    if is_url(name):
        return True
    path = Path(name)
    return any(part.lower().endswith(".zarr") for part in path.parts) or (
        path.is_dir() and any((path / mark).is_file() for mark in MARKS)
    )


def is_hdf5(name: str) -> bool:
    """Tell by its name whether something is HDF5.

    >>> is_hdf5("a.h5:/scan/volume"), is_hdf5("a.hdf5"), is_hdf5("a.npy")
    (True, True, False)
    """
    return HDF5.fullmatch(name) is not None


def is_lazy(path: str | os.PathLike[str]) -> bool:
    """Tell whether a source is one that only this room reads: Zarr, HDF5 or a URL."""
    name = name_of(path)
    return is_url(name) or is_hdf5(name) or is_zarr(name)
