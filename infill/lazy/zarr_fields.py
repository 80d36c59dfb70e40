"""A field as OME-Zarr, written box by box: complete or not at all."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.files.whole_folders import whole_folder
from infill.lazy.volume import LazyVolume
from infill.version import __version__

CHUNK = 128  # cells along a side

Box = tuple[tuple[slice, ...], NDArray[np.float32]]


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

    with whole_folder(path) as partial:
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
