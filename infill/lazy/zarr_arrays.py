"""Zarr, versions 2 and 3, by path or URL, and the levels of OME-Zarr."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, ParameterError
from infill.imaging.assumed import keep_warnings, warn
from infill.imaging.images import CELL_SIZE_PHRASE, scales_of
from infill.lazy.names import MARKS, is_url, is_zarr
from infill.lazy.volume import EXTRA, LazyVolume, read_error, require_volume
from infill.volume import AXES

MOST_NAMED = 8
MOST_CHUNKS_COUNTED = 100_000


@dataclass(frozen=True)
class ZarrArray:
    """An array of Zarr.

    Parameters
    ----------
    name : str
        Path or URL.
    stored : tuple of int
        Cells along the stored axes.
    axes : (3,) int
        The stored axis that is x, y and z; the others have one cell.
    kind : str
        Type of the cells.
    """

    name: str
    stored: tuple[int, ...]
    axes: tuple[int, ...]
    kind: str

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along x, y and z."""
        return tuple(self.stored[axis] for axis in self.axes)

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return np.dtype(self.kind)

    @property
    def grain(self) -> tuple[int, ...]:
        """Cells of a chunk along x, y and z."""
        chunks = _open_array(self.name).chunks
        return tuple(int(chunks[axis]) for axis in self.axes)

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""
        stored_box: list[Any] = [0] * len(self.stored)
        for part, axis in zip(box, self.axes, strict=True):
            stored_box[axis] = part
        try:
            cells = np.asarray(_open_array(self.name)[tuple(stored_box)])
        except Exception as error:
            raise read_error(self.name, box, error) from error
        order = np.argsort(np.argsort(self.axes))  # the axes that are left, in their stored order
        return np.ascontiguousarray(cells.transpose(order), dtype=self.dtype)


def _open_array(name: str) -> Any:  # noqa: ANN401 - zarr.Array
    """Open an array once in every process, and again when it was written again."""
    path = Path(name).absolute()
    stamps = [] if is_url(name) else [(path / mark).stat() for mark in MARKS if (path / mark).is_file()]
    state = tuple((stamp.st_ino, stamp.st_mtime_ns, stamp.st_size) for stamp in stamps)
    return _open_once(name if is_url(name) else str(path), state)


@lru_cache(maxsize=8)
def _open_once(name: str, state: tuple[tuple[int, ...], ...]) -> Any:  # noqa: ANN401, ARG001 - zarr.Array
    """Open an array in a certain state."""
    import zarr

    return zarr.open_array(name, mode="r")


def _open(name: str) -> Any:  # noqa: ANN401 - zarr.Array or zarr.Group
    """Open an array or a group, or raise FormatError."""
    if find_spec("zarr") is None:
        raise ParameterError(f"reading {name} needs the extra scale: {EXTRA}")
    import zarr

    if not is_url(name) and not Path(name).exists():
        raise FormatError(f"there is no {name}; check the name")
    try:
        return zarr.open(name, mode="r")
    except ImportError as error:  # of a kind of URL
        raise ParameterError(f"reading {name} needs another package: {error}") from error
    except Exception as error:
        text = " ".join(str(error).split())[:200] or type(error).__name__
        raise FormatError(f"{name} is broken or not Zarr ({text}); check its name, or save it again") from error


def open_zarr(name: str, array: str | None = None) -> LazyVolume:
    """Open an array of Zarr, [x, y, z], or a level of OME-Zarr, by its axes.

    Parameters
    ----------
    name : str
        Path or URL of an array, or of a group. Of a multiscale, the group is its finest level; ``big.zarr/2`` is
        another one.
    array : str, optional
        Name of the array in a group.
    """
    opened = _open(name)
    if array is not None:
        if not hasattr(opened, "members"):
            raise ParameterError.about("array", f"is {array!r}, and {name} is an array itself; leave it out")
        name = f"{name.rstrip('/')}/{array}"
        opened = _open(name)
    with keep_warnings() as assumptions:
        if hasattr(opened, "members"):
            scales = _multiscale(opened.attrs)
            level = None if scales is None else str(scales["datasets"][0]["path"])
            level = _only_array(name, opened) if level is None else level
            array_name, group, inside = f"{name.rstrip('/')}/{level}", opened, level
            volume = _describe(array_name, _open(array_name), _multiscale(group.attrs), inside)
        else:
            parent, _, inside = name.rstrip("/").rpartition("/")
            volume = _describe(name, opened, _parent_multiscale(parent), inside)
    return volume if not assumptions else LazyVolume(**{**vars(volume), "warnings": tuple(assumptions)})


def _multiscale(attributes: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """Return the first multiscale of a group, as OME-Zarr 0.4 or 0.5 has it."""
    metadata = attributes.get("ome", attributes)
    listed = metadata.get("multiscales") if isinstance(metadata, Mapping) else None
    return listed[0] if isinstance(listed, list) and listed and isinstance(listed[0], Mapping) else None


def _parent_multiscale(parent: str) -> Mapping[str, Any] | None:
    """Return the multiscale of the group that holds an array, if there is one."""
    import zarr

    if not parent or not is_zarr(parent):
        return None
    try:
        group = zarr.open(parent, mode="r")
    except (OSError, ValueError, KeyError, TypeError):  # no group, or one of another form
        return None
    return _multiscale(group.attrs) if hasattr(group, "members") else None


def _only_array(name: str, group: Any) -> str:  # noqa: ANN401 - zarr.Group
    """Return the name of the only array with three axes in a group."""
    names = sorted(key for key, array in group.arrays() if array.ndim >= AXES)
    if len(names) != 1:
        content = f"{len(names)} arrays ({', '.join(names[:MOST_NAMED])})" if names else "no array with three axes"
        advice = f"give one: {name.rstrip('/')}/{names[0]}" if names else "give the folder of an array"
        raise FormatError(f"{name} holds {content}; {advice}")
    return str(names[0])


def _describe(name: str, array: Any, scales: Mapping[str, Any] | None, inside: str) -> LazyVolume:  # noqa: ANN401
    """Return the volume of an array, placed by the multiscale that lists it."""
    stored, kind = tuple(int(count) for count in array.shape), np.dtype(array.dtype)
    entry = None
    if scales is not None:
        entry = next((dataset for dataset in scales.get("datasets", []) if str(dataset.get("path")) == inside), None)
    if scales is None or entry is None:
        require_volume(name, stored, kind)
        _tell_of_missing(name, array)
        return LazyVolume(array=ZarrArray(name, stored, (0, 1, 2), kind.str), name=name)
    axes, words = _axes(name, scales, stored)
    steps = np.array(scales_of(Path(name), words, CELL_SIZE_PHRASE, "xyz"))
    scale, shift = np.ones(len(stored)), np.zeros(len(stored))
    is_placed = False
    for change in (*entry.get("coordinateTransformations", ()), *scales.get("coordinateTransformations", ())):
        if "scale" in change:
            scale, shift = (
                scale * np.array(change["scale"], dtype=float),
                shift * np.array(change["scale"], dtype=float),
            )
        if "translation" in change:
            is_placed = True
            shift = shift + np.array(change["translation"], dtype=float)
    chosen = list(axes)
    spacing, centre = scale[chosen] * steps, shift[chosen] * steps
    if not (np.isfinite(spacing).all() and (spacing > 0).all() and np.isfinite(centre).all()):
        raise FormatError(f"{name} has cells of {spacing.tolist()} mm; save it again with sizes above 0")
    require_volume(name, tuple(stored[axis] for axis in axes), kind)
    _tell_of_missing(name, array)
    corner = centre - spacing / 2 if is_placed else np.zeros(AXES)
    return LazyVolume(
        array=ZarrArray(name, stored, axes, kind.str),
        spacing=tuple(spacing.tolist()),
        origin=tuple(corner.tolist()),
        name=name,
    )


def _axes(name: str, scales: Mapping[str, Any], stored: Sequence[int]) -> tuple[tuple[int, ...], list[str]]:
    """Return the stored axes that are x, y and z, and their units; the others have one cell."""
    listed = scales.get("axes") or [{"name": axis} for axis in "tczyx"[-len(stored) :]]
    axes = [entry if isinstance(entry, Mapping) else {"name": entry} for entry in listed]
    names = [str(entry.get("name", "")).lower() for entry in axes]
    if len(names) != len(stored) or not set("xyz") <= set(names):
        raise FormatError(
            f"{name} has the axes {', '.join(names)}, shape {tuple(stored)}; give an image with x, y and z"
        )
    for axis, count in zip(names, stored, strict=True):
        if axis not in "xyz" and count != 1:
            raise FormatError(
                f"{name} has {count} cells along its axis {axis}; save one of them as an image of its own"
            )
    return tuple(names.index(axis) for axis in "xyz"), [str(axes[names.index(axis)].get("unit", "")) for axis in "xyz"]


def _tell_of_missing(name: str, array: Any) -> None:  # noqa: ANN401 - zarr.Array
    """Warn if chunks are missing, which Zarr reads as the fill value."""
    if is_url(name) or math.prod(array.cdata_shape) > MOST_CHUNKS_COUNTED:
        return
    try:
        missing = array.nchunks - array.nchunks_initialized
    except (OSError, ValueError, NotImplementedError):  # a store that cannot list
        return
    if missing > 0:
        warn(
            "%s lacks %d of its %d chunks, which Zarr reads as %s; check that it was copied whole",
            name,
            missing,
            array.nchunks,
            array.fill_value,
        )
