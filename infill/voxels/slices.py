"""Interpolate shapes between thick slices, so that cells become as high as they are wide."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume

THICK = 2.0  # times the width of a cell: slices further apart than this are interpolated
OUTLINE_REACH = 1.01  # half pixels: only pixels next to the outline are this near
REACH = 1.0  # pixels from the outline within which the result is grey


def plan_sublayers(volume: Volume) -> tuple[int, int]:
    """Return the axis of the thickest cells, and the number of cells that replaces each; 1 if they are thin enough."""
    size = volume.cell_size
    axis = int(size.argmax())
    widest = float(np.delete(size, axis).max())
    ratio = float(size[axis]) / widest
    return axis, max(1, round(ratio)) if ratio > THICK and volume.values.shape[axis] > 1 else 1


def interpolate_slices(volume: Volume, axis: int, count: int) -> Volume:
    """Interpolate a solid to `count` cells for each along an axis; return a field in [-1, 1], solid above 0.

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
    distance from the outline, and between slices, the mean of both, weighted by nearness. A region that does
    not continue in the next slice ends half-way to it, whatever its grey values are: the pole of a ball lies up to
    half a slice inside or outside of its place.
    """
    values: NDArray[Any] = np.moveaxis(np.asarray(volume.values), axis, 0)
    size = np.delete(volume.cell_size, axis)
    pixel = float(size.min())
    fine = np.empty((len(values) * count, *values.shape[1:]), dtype=np.float32)
    places = (np.arange(count) + 0.5) / count - 0.5  # of the new cells from the middle of their slice, in slices
    current = signed_distance(values[0], size)
    up, down = current, current
    for n in range(len(values)):
        following = signed_distance(values[n + 1], size) if n + 1 < len(values) else current
        up = _end_half_way(current, following)
        for sublayer, place in enumerate(places):
            fine[n * count + sublayer] = (1 - abs(place)) * current + abs(place) * (up if place > 0 else down)
        current, down = following, _end_half_way(following, current)
    fine /= np.float32(REACH * pixel)
    np.clip(fine, -1, 1, out=fine)
    spacing = volume.cell_size.copy()
    spacing[axis] /= count
    return replace(volume, values=np.moveaxis(fine, 0, axis), spacing=tuple(spacing.tolist()))


def _end_half_way(current: NDArray[np.float32], neighbour: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the distances of the next slice; regions of this slice that do not continue get minus their distances."""
    from scipy.ndimage import binary_dilation, label

    ended = neighbour
    for sign in (1, -1):
        gone = (sign * current > 0) & (sign * neighbour <= 0)
        regions, count = label(gone)
        if count == 0:
            continue
        # A region continues where it touches a region that is alike in both slices.
        touching = binary_dilation((sign * current > 0) & (sign * neighbour > 0))
        continues = np.bincount(regions[touching & gone], minlength=count + 1) > 0
        continues[0] = True
        ended = np.where(continues[regions], ended, -current)
    return ended


def signed_distance(layer: NDArray[Any], size: NDArray[np.float64]) -> NDArray[np.float32]:
    """Measure how far pixels lie inside the outline of a slice, mm: half a pixel for those next to it, less if grey."""
    from scipy.ndimage import distance_transform_edt

    solid = layer > 0
    half = float(size.min()) / 2
    reach = float(np.hypot(*(np.array(layer.shape) * size)))
    inside = distance_transform_edt(solid, sampling=size) if not solid.all() else np.full(layer.shape, reach)
    outside = distance_transform_edt(~solid, sampling=size) if solid.any() else np.full(layer.shape, reach)
    distance: NDArray[np.float32] = np.where(solid, inside - half, half - outside).astype(np.float32)
    if layer.dtype.kind == "f":  # beside the outline, grey tells where inside a pixel it lies
        at_outline = (np.abs(distance) <= half * OUTLINE_REACH) & (np.abs(layer) < 1)
        np.multiply(layer, np.float32(half), out=distance, where=at_outline)
    return distance
