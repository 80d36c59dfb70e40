"""Coarsen a scan: each larger cell gets the mean of the cells that it covers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_length
from infill.errors import ParameterError
from infill.plain_numbers import plain_argument
from infill.volume import Volume

SLAB = 2**24  # cells averaged at a time
NEAR = 1e-6  # of a cell: by rounding, a voxel may be this much smaller than the cells
FEWEST = 2  # cells along the longest side


def coarsen(volume: Volume, voxel: float) -> Volume:
    """Average a volume over larger cells of about `voxel` mm along each side.

    Parameters
    ----------
    volume : Volume
        Numbers or booleans.
    voxel : float, mm
        No smaller than the shortest side of its cells. Axes whose cells are larger stay unchanged.

    Returns
    -------
    Volume
        float32 means, each over the same number of cells, which may be a fraction; the last ones along an axis reach
        beyond the volume, and average the cells inside it.

    Raises
    ------
    ParameterError
        If the voxel is smaller than the cells of the volume, or larger than half of the volume.

    >>> coarsen(Volume(values=np.arange(16.0).reshape(4, 2, 2)), 2.0).values.tolist()
    [[[3.5]], [[11.5]]]
    """
    voxel, size = check_length("voxel", voxel), volume.cell_size
    shortest, longest = float(size.min()), float((size * volume.values.shape).max())
    if voxel < shortest * (1 - NEAR):
        raise ParameterError.about(
            "voxel",
            f"is {plain_argument(voxel)} mm and the volume has {plain_argument(shortest)} mm; give no less, or leave "
            "it out",
        )
    if voxel > longest / FEWEST + NEAR:
        raise ParameterError.about(
            "voxel",
            f"is {plain_argument(voxel)} mm and the volume {plain_argument(longest)} mm long; give at most "
            f"{plain_argument(longest / FEWEST)} mm",
        )
    factors = np.maximum(voxel / size, 1.0)
    counts = np.maximum(1, np.ceil(np.array(volume.values.shape) / factors - NEAR)).astype(int)
    values: NDArray[Any] = np.asarray(volume.values)
    means = np.zeros(counts, dtype=np.float64)
    weights = np.zeros(counts[0])
    rows = max(1, SLAB // int(np.prod(values.shape[1:])))
    for start in range(0, len(values), rows):
        part = values[start : start + rows].astype(np.float32)
        for axis in (2, 1):
            part = _means(part, axis, float(factors[axis]), int(counts[axis]))
        for n, layer in enumerate(part, start):
            begin, end = n / factors[0], (n + 1) / factors[0]
            for cell in range(int(begin + NEAR), min(int(np.ceil(end - NEAR)), int(counts[0]))):
                share = min(end, cell + 1) - max(begin, cell)
                means[cell] += share * layer
                weights[cell] += share
    means /= weights[:, None, None]
    return replace(volume, values=means.astype(np.float32), spacing=tuple((size * factors).tolist()))


def _means(values: NDArray[np.float32], axis: int, factor: float, count: int) -> NDArray[np.float32]:
    """Average over stretches of `factor` cells along an axis."""
    if factor == 1:
        return values
    along = np.moveaxis(values, axis, -1)
    cells = along.shape[-1]
    sums = np.zeros((*along.shape[:-1], cells + 1))
    np.cumsum(along, axis=-1, out=sums[..., 1:], dtype=np.float64)
    edges = np.minimum(np.arange(count + 1) * factor, cells)
    below = np.minimum(edges.astype(int), cells - 1)
    integral = sums[..., below] + (edges - below) * along[..., below]
    means = np.diff(integral, axis=-1) / np.diff(edges)
    return np.moveaxis(means.astype(np.float32), -1, axis)
