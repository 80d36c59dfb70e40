"""Values read from a file, checked."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, ParameterError
from infill.imaging.assumed import warn
from infill.plain_numbers import plain_argument, plain_number, plain_size
from infill.volume import AXES, Volume

MOST_CELLS_AWAY = 1e6  # 32-bit numbers tell an eighth of a cell apart there
FARTHEST_PLACE = 1e12  # mm: squares of distances stay exact enough
COLOUR_CHANNELS = (2, 3, 4)  # numbers per cell of a picture that is not grey


def checked_volume(path: Path, values: NDArray[Any], *, varied: bool = True, **place: Any) -> Volume:  # noqa: ANN401
    """Check values [x, y, z] and return them as a volume; `varied` demands at least two different values."""
    if values.dtype.kind == "c":
        raise FormatError(f"{path} holds complex numbers; save their magnitude or their phase")
    if values.dtype.kind not in "biuf":
        raise FormatError(f"{path} holds values of type {values.dtype}; save numbers or booleans")
    if values.ndim > AXES and values.shape[-1] in COLOUR_CHANNELS:
        raise FormatError(f"{path} holds {values.shape[-1]} numbers per cell, shape {values.shape}; save one as grey")
    if values.ndim != AXES or values.size == 0:
        raise FormatError(f"{path} holds an array of shape {values.shape}; save three axes, with cells")
    if not values.dtype.isnative:
        values = values.astype(values.dtype.newbyteorder("="))
    low, high = values.min().item(), values.max().item()
    if not (math.isfinite(low) and math.isfinite(high)):
        raise FormatError(f"{path} holds cells that are NaN or infinite; fill or cut those cells first")
    if varied and low == high:
        raise FormatError(
            f"{path} holds {plain_argument(low)} in all cells, so no surface; check that it is the right file"
        )
    try:
        volume = Volume(values=values, **place)
    except ParameterError as error:
        raise FormatError(f"{path} has no usable place in space: {error}; resample it, or save it again") from error
    origin = np.asarray(volume.origin)
    opposite = origin + np.asarray(volume.direction) @ (volume.cell_size * values.shape)
    farthest, cell = float(np.abs([origin, opposite]).max()), float(volume.cell_size.min())
    if not farthest <= FARTHEST_PLACE:
        raise FormatError(
            f"{path} lies {plain_size(farthest)} away; the limit is {plain_size(FARTHEST_PLACE, digits=6)}; check "
            "its place and units, or save it again"
        )
    if farthest > MOST_CELLS_AWAY * cell:
        warn(
            "%s lies up to %s mm from the origin: files of 32-bit numbers, such as .stl, lose details of %s mm "
            "there, and its cells are %s mm; check its place and units",
            path,
            plain_number(farthest),
            plain_number(farthest / 2**23, 2),
            plain_number(cell),
        )
    return volume
