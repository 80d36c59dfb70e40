"""Facts that tell one source of cells from another, so that a resumed run does not go on with another volume."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path

from infill.lazy.dask_arrays import DaskArray
from infill.lazy.hdf5 import Hdf5Array
from infill.lazy.mapped import MappedArray, TiffArray
from infill.lazy.names import is_url
from infill.lazy.volume import BoxArray, LazyArray
from infill.lazy.zarr_arrays import ZarrArray

METADATA = ("zarr.json", ".zarray")
DIGEST = 8  # bytes


def source_facts(array: LazyArray) -> dict[str, str]:
    """Return names and values: path, size and time of a file; shape, type and metadata of a store."""
    facts = {"cells": f"{' x '.join(map(str, array.shape))} of {array.dtype}"}
    if isinstance(array, BoxArray):
        return {**source_facts(array.array), **facts, "box": f"{array.low} to {array.high}"}
    if isinstance(array, ZarrArray):
        return {**facts, "input": _absolute(array.name), "metadata": _metadata(array.name)}
    if isinstance(array, Hdf5Array):
        return {**facts, "input": f"{_absolute(array.path)}:{array.dataset}", **_file_facts([array.path])}
    if isinstance(array, MappedArray):
        return {**facts, "input": _absolute(array.path), **_file_facts([array.path])}
    if isinstance(array, TiffArray):
        first = _absolute(array.files[0])
        return {**facts, "input": f"{len(array.files)} files from {first}", **_file_facts(array.files)}
    if isinstance(array, DaskArray):
        return {**facts, "input": str(array.array.name)}
    return {**facts, "input": type(array).__name__}


def _absolute(name: str) -> str:
    """Return a URL as it is, and a path from the root."""
    return name if is_url(name) else str(Path(name).resolve())


def _file_facts(paths: Iterable[str]) -> dict[str, str]:
    """Return the size of files, and the time at which the last of them changed."""
    stats = [Path(path).stat() for path in paths if Path(path).exists()]
    seconds, rest = divmod(max((stat.st_mtime_ns for stat in stats), default=0), 10**9)
    changed = f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d %H:%M:%S}.{rest:09d} UTC"
    return {"size": f"{sum(stat.st_size for stat in stats)} bytes", "time of change": changed}


def _metadata(name: str) -> str:
    """Return a digest of the metadata of a local store, "" of a URL."""
    if is_url(name):
        return ""
    digest = hashlib.blake2b(digest_size=DIGEST)
    for part in METADATA:
        path = Path(name) / part
        if path.is_file():
            digest.update(path.read_bytes())
    return digest.hexdigest()
