"""Slices further apart than their pixels: the shape between them, so that cells become as high as they are wide."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume

THICK = 2.0  # times the width of a cell: slices further apart than this are interpolated
BESIDE = 1.01  # half pixels: only those next to the outline are this near
REACH = 1.0  # pixels from the outline within which the result is grey


def layers_between(volume: Volume) -> tuple[int, int]:
    """Return the axis of the thickest cells, and how many cells each of them becomes; 1 if they are thick enough."""
    size = volume.cell_size
    axis = int(size.argmax())
    others = float(np.delete(size, axis).max())
    thick = float(size[axis]) / others
    return axis, max(1, round(thick)) if thick > THICK and volume.values.shape[axis] > 1 else 1


def interpolated(volume: Volume, axis: int, count: int) -> Volume:
    """Return a solid with `count` cells in the place of each along an axis.

    Parameters
    ----------
    volume : Volume
        Booleans, or a phase field in [-1, 1].
    axis, count : int

    Returns
    -------
    Volume
        float32 in [-1, 1], above 0 where it is solid.

    Notes
    -----
    Shape-based interpolation (Raya and Udupa, IEEE Transactions on Medical Imaging 9, 1990): in each slice, the signed
    distance from the outline, and between slices, the mean of both, weighted by nearness. What ends between two slices,
    because nothing of it goes on in the next, ends half-way.
    """
    values: NDArray[Any] = np.moveaxis(np.asarray(volume.values), axis, 0)
    size = np.delete(volume.cell_size, axis)
    pixel = float(size.min())
    fine = np.empty((len(values) * count, *values.shape[1:]), dtype=np.float32)
    places = (np.arange(count) + 0.5) / count - 0.5  # of the new cells from the middle of their slice, in slices
    own = signed_distance(values[0], size)
    up, down = own, own
    for n in range(len(values)):
        after = signed_distance(values[n + 1], size) if n + 1 < len(values) else own
        up = _ended(own, after)
        for part, at in enumerate(places):
            fine[n * count + part] = (1 - abs(at)) * own + abs(at) * (up if at > 0 else down)
        own, down = after, _ended(after, own)
    fine /= np.float32(REACH * pixel)
    np.clip(fine, -1, 1, out=fine)
    spacing = volume.cell_size.copy()
    spacing[axis] /= count
    return replace(volume, values=np.moveaxis(fine, 0, axis), spacing=tuple(spacing.tolist()))


def _ended(own: NDArray[np.float32], other: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the distances of a slice beside another one, minus those of that where a region has no part in this."""
    from scipy.ndimage import binary_dilation, label

    found = other
    for sign in (1, -1):
        gone = (sign * own > 0) & (sign * other <= 0)
        regions, count = label(gone)
        if count == 0:
            continue
        # A region goes on where it lies beside what is alike in both slices.
        near = binary_dilation((sign * own > 0) & (sign * other > 0))
        goes_on = np.bincount(regions[near & gone], minlength=count + 1) > 0
        goes_on[0] = True
        found = np.where(goes_on[regions], found, -own)
    return found


def signed_distance(layer: NDArray[Any], size: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return how far pixels lie inside the outline of a slice, mm: half a pixel for those beside it, less if grey."""
    from scipy.ndimage import distance_transform_edt

    solid = layer > 0
    half = float(size.min()) / 2
    reach = float(np.hypot(*(np.array(layer.shape) * size)))
    inside = distance_transform_edt(solid, sampling=size) if not solid.all() else np.full(layer.shape, reach)
    outside = distance_transform_edt(~solid, sampling=size) if solid.any() else np.full(layer.shape, reach)
    found: NDArray[np.float32] = np.where(solid, inside - half, half - outside).astype(np.float32)
    if layer.dtype.kind == "f":  # beside the outline, grey tells where inside a pixel it lies
        beside = (np.abs(found) <= half * BESIDE) & (np.abs(layer) < 1)
        np.multiply(layer, np.float32(half), out=found, where=beside)
    return found
