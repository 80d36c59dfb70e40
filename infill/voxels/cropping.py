"""Cut a part out of a volume: by cells, or by a box in space."""

from __future__ import annotations

import logging
import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

LOG = logging.getLogger("infill")
SKEW = 1e-3  # of a cell: how far from a cell's edge an axis of the grid may end before the grid counts as turned
ROUNDING = 1e-6  # of a cell: a centre that lies this close to the box lies in it

Box = tuple[float, ...]


def cut_cells(volume: Volume, low: tuple[int, ...], high: tuple[int, ...]) -> Volume:
    """Cut out the cells from `low` up to but without `high`, in the same place; nothing is copied.

    >>> cut_cells(Volume(values=np.arange(8).reshape(2, 2, 2), spacing=0.5), (1, 0, 0), (2, 2, 2)).origin
    (0.5, 0.0, 0.0)
    """
    cells = tuple(slice(begin, end) for begin, end in zip(low, high, strict=True))
    corner = volume.place((np.array([low]) * volume.cell_size).astype(np.float64))[0]
    return replace(volume, values=volume.values[cells], origin=tuple(corner.tolist()))


def crop(volume: Volume, roi: Box, *, varied: bool = True) -> Volume:
    """Cut out the part of a volume that lies in a box.

    Parameters
    ----------
    volume : Volume
    roi : (x0, x1, y0, y1, z0, z1), mm
        The box, in the space of the volume: LPS for medical images.
    varied : bool
        Whether the part must hold more than one value, as the data of a single volume must.

    Returns
    -------
    Volume
        The cells with their centre in the box. If the axes of the grid are turned against those of space, the
        smallest part of the grid that holds these cells, and others with them; a warning is logged.

    Raises
    ------
    ParameterError
        If the box has a side that is not above 0, holds no cell, or the same value in all of them.

    >>> crop(Volume(values=np.arange(64.0).reshape(4, 4, 4)), (1, 3, 0, 4, 0, 2)).values.shape
    (2, 4, 2)
    """
    low, high = cells_in_box(volume, roi)
    cropped_volume = cut_cells(volume, low, high)
    lowest, highest = cropped_volume.values.min().item(), cropped_volume.values.max().item()
    if varied and lowest == highest:
        raise ParameterError.about(
            "roi", f"holds {plain_argument(lowest)} in all cells, so no surface; make it larger, or move it"
        )
    return cropped_volume


def cells_in_box(volume: Volume, roi: Box) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the first cells of a volume with their centre in a box, and those after the last: see `crop`."""
    ends = _box_ends(roi)
    direction, size = np.asarray(volume.direction), volume.cell_size
    corners = np.array([[ends[axis, side >> axis & 1] for axis in range(AXES)] for side in range(2**AXES)])
    along = (corners - np.array(volume.origin)) @ direction / size - 0.5  # in cells, counted from their centres
    count = np.array(volume.values.shape)
    low = np.ceil(np.clip(along.min(axis=0) - ROUNDING, 0, count)).astype(int)
    high = np.floor(np.clip(along.max(axis=0) + ROUNDING, -1, count - 1)).astype(int) + 1
    if (low >= high).any():
        raise ParameterError.about(
            "roi", f"is {_format_ends(ends)} and holds no cell of the volume, {_describe_extent(volume)}; move the box"
        )
    turned = np.abs(direction).max(axis=0)
    if (np.sqrt(np.clip(1 - turned**2, 0, 1)) * count > SKEW * count.max()).any():
        angle = math.degrees(math.acos(min(1.0, float(turned.min()))))
        LOG.warning(
            "the grid is turned by %s degrees, so that more of it is kept than lies in the roi",
            plain_argument(angle, 3),
        )
    return tuple(low.tolist()), tuple(high.tolist())


def _box_ends(roi: Box) -> NDArray[np.float64]:
    """Check the box; return it as (3, 2)."""
    numbers = np.array(roi, dtype=np.float64)
    if numbers.shape != (2 * AXES,) or not np.isfinite(numbers).all():
        raise ParameterError.about("roi", f"is {roi}; give six finite numbers: X0,X1,Y0,Y1,Z0,Z1")
    ends = numbers.reshape(AXES, 2)
    for name, (low, high) in zip("xyz", ends.tolist(), strict=True):
        if low >= high:
            raise ParameterError.about(
                "roi",
                f"goes from {plain_argument(low)} to {plain_argument(high)} mm in {name}; give the lower end first",
            )
    return ends


def _describe_extent(volume: Volume) -> str:
    """Describe the extent of a volume, for a message."""
    size = volume.cell_size * volume.values.shape
    corners = [[size[axis] * (side >> axis & 1) for axis in range(AXES)] for side in range(2**AXES)]
    placed = volume.place(np.array(corners, dtype=np.float64))
    space = f" {volume.space}" if volume.space else ""
    return f"which reaches {_format_ends(np.stack([placed.min(axis=0), placed.max(axis=0)], axis=1))} mm{space}"


def _format_ends(ends: NDArray[np.float64]) -> str:
    """Format the ends of a box, for a message."""
    return ", ".join(f"{plain_argument(low)} to {plain_argument(high)}" for low, high in ends.tolist())
