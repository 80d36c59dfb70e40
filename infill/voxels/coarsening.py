"""Larger cells in the place of those of a scan: each has the mean of what it covers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.checks import length
from infill.errors import ParameterError
from infill.volume import Volume

SLAB = 2**24  # cells averaged at a time
NEAR = 1e-6  # of a cell: how far a voxel may be smaller than those there are, by rounding
FEWEST = 2  # cells along the longest side


def coarser(volume: Volume, voxel: float) -> Volume:
    """Return a volume with cells of about `voxel` mm along each side.

    Parameters
    ----------
    volume : Volume
        Numbers or booleans.
    voxel : float, mm
        No smaller than the shortest side of its cells. Along axes whose cells are larger, they stay as they are.

    Returns
    -------
    Volume
        float32 means, each over the same whole or broken number of cells; the last ones along an axis reach beyond the
        volume, and count what lies in it.

    Raises
    ------
    ParameterError
        If the voxel is smaller than the cells there are, or larger than half of the volume.

    >>> coarser(Volume(values=np.arange(16.0).reshape(4, 2, 2)), 2.0).values.tolist()
    [[[3.5]], [[11.5]]]
    """
    voxel, size = length("voxel", voxel), volume.cell_size
    least, most = float(size.min()), float((size * volume.values.shape).max())
    if voxel < least * (1 - NEAR):
        raise ParameterError(f"voxel is {voxel:g} mm and the volume has {least:g} mm; give no less, or leave it out")
    if voxel > most / FEWEST + NEAR:
        raise ParameterError(
            f"voxel is {voxel:g} mm and the volume {most:g} mm long; give at most {most / FEWEST:g} mm"
        )
    factors = np.maximum(voxel / size, 1.0)
    counts = np.maximum(1, np.ceil(np.array(volume.values.shape) / factors - NEAR)).astype(int)
    values: NDArray[Any] = np.asarray(volume.values)
    found = np.zeros(counts, dtype=np.float64)
    weights = np.zeros(counts[0])
    rows = max(1, SLAB // int(np.prod(values.shape[1:])))
    for start in range(0, len(values), rows):
        part = values[start : start + rows].astype(np.float32)
        for axis in (2, 1):
            part = _means(part, axis, float(factors[axis]), int(counts[axis]))
        for n, layer in enumerate(part, start):
            first, last = n / factors[0], (n + 1) / factors[0]
            for cell in range(int(first + NEAR), min(int(np.ceil(last - NEAR)), int(counts[0]))):
                share = min(last, cell + 1) - max(first, cell)
                found[cell] += share * layer
                weights[cell] += share
    found /= weights[:, None, None]
    return replace(volume, values=found.astype(np.float32), spacing=tuple((size * factors).tolist()))


def _means(values: NDArray[np.float32], axis: int, factor: float, count: int) -> NDArray[np.float32]:
    """Return the means over stretches of `factor` cells along an axis."""
    if factor == 1:
        return values
    along = np.moveaxis(values, axis, -1)
    cells = along.shape[-1]
    sums = np.zeros((*along.shape[:-1], cells + 1))
    np.cumsum(along, axis=-1, out=sums[..., 1:], dtype=np.float64)
    edges = np.minimum(np.arange(count + 1) * factor, cells)
    below = np.minimum(edges.astype(int), cells - 1)
    at = sums[..., below] + (edges - below) * along[..., below]
    found = np.diff(at, axis=-1) / np.diff(edges)
    return np.moveaxis(found.astype(np.float32), -1, axis)
