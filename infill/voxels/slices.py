"""Interpolate shapes between thick slices, so that cells become as high as they are wide."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume

THICK = 2.0  # times the width of a cell: slices further apart than this are interpolated
OUTLINE_REACH = 1.01  # half pixels: only pixels next to the outline are this near
SHORTEST = 1e-6  # slices: an end that lies in the middle of one
HALF = 0.5  # of a pixel: more is solid
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
    distance from the outline, and between slices, the mean of both, weighted by nearness. A region that does not
    continue in the next slice ends half-way to it, or where the grey values say, of slices that are partly filled.
    """
    values: NDArray[Any] = np.moveaxis(np.asarray(volume.values), axis, 0)
    size = np.delete(volume.cell_size, axis)
    pixel = float(size.min())
    fine = np.empty((len(values) * count, *values.shape[1:]), dtype=np.float32)
    current = signed_distance(values[0], size)
    fine[:count] = current
    for n in range(1, len(values)):
        following = signed_distance(values[n], size)
        fine[n * count : (n + 1) * count] = following
        ending = find_ending(current, following)
        behind, beyond = (values[m][ending] if 0 <= m < len(values) else None for m in (n - 2, n + 1))
        end = find_ends(behind, values[n - 1][ending], values[n][ending], beyond)
        side = np.sign(current[ending])
        # Cells from the middle of one slice to that of the next, both included where a cell lies there.
        for cell in range((n - 1) * count + count // 2, n * count + (count + 1) // 2):
            place = (cell + 0.5) / count - (n - 0.5)
            if 0 < place < 1:
                fine[cell] = (1 - place) * current + place * following
            is_before = place < end
            distance = np.abs(np.where(is_before, current[ending], following[ending]))
            length = np.where(is_before, end, 1 - end)  # from the middle of the slice to the end
            fine[cell][ending] = side * distance * (end - place) / np.maximum(length, SHORTEST)
        current = following
    fine /= np.float32(REACH * pixel)
    np.clip(fine, -1, 1, out=fine)
    spacing = volume.cell_size.copy()
    spacing[axis] /= count
    return replace(volume, values=np.moveaxis(fine, 0, axis), spacing=tuple(spacing.tolist()))


def find_ending(current: NDArray[np.float32], following: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Mark the regions, solid or void, of one of two slices that do not continue in the other one.

    Parameters
    ----------
    current, following : (n, m) float32
        Distances in a slice and in the next one, above 0 where it is solid.

    Returns
    -------
    (n, m) bool
    """
    from scipy.ndimage import binary_dilation, label

    solid, neighbour = current > 0, following > 0
    ending = np.zeros(current.shape, dtype=np.bool_)
    if (solid == neighbour).all():
        return ending
    # Regions continue, as solid and as void, where they touch what is alike in both slices.
    shared = [binary_dilation(solid & neighbour), binary_dilation(~solid & ~neighbour)]
    for gone in (solid & ~neighbour, neighbour & ~solid):
        regions, count = label(gone)
        touching = [np.bincount(regions[gone & mask], minlength=count + 1) > 0 for mask in shared]
        ending |= gone & ~(touching[0] & touching[1])[regions]
    return ending


def find_ends(
    behind: NDArray[Any] | None, values: NDArray[Any], following: NDArray[Any], beyond: NDArray[Any] | None
) -> NDArray[np.float64]:
    """Return where regions end that one slice has and the next has not: 0 in the middle of the slice, 1 in the next.

    The slices behind and beyond tell how much of a pixel is solid before the end and after it: beside the outline of a
    straight wall, a part of it. What the two slices hold of this is then how far the region reaches.

    Parameters
    ----------
    behind, values, following, beyond : (n,)
        Four slices, booleans or from -1 for empty to 1 for full; the regions end between the second and the third.
        None where the volume ends: full behind what is solid, empty beyond what is void.

    >>> find_ends(None, np.array([True, False]), np.array([False, True]), None).tolist()
    [0.5, 0.5]
    >>> find_ends(None, np.array([1.0, 0.5]), np.array([-0.5, -1.0]), None).tolist()  # a quarter more; a quarter less
    [0.75, 0.25]
    >>> find_ends(np.array([0.5]), np.array([0.5]), np.array([-1.0]), None).tolist()  # a wall fills three quarters
    [0.5]
    """
    if values.dtype == bool:
        return np.full(values.shape, 0.5)
    side = np.where(values > 0, 1, -1)  # as if the second slice were solid
    share, next_share = (1 + side * values) / 2, (1 + side * following) / 2
    before = np.ones_like(share) if behind is None else (1 + side * behind) / 2
    after = np.zeros_like(next_share) if beyond is None else (1 + side * beyond) / 2
    before = np.where(before > HALF, np.maximum(before, share), 1)
    after = np.where(after < HALF, np.minimum(after, next_share), 0)
    ends: NDArray[np.float64] = (share + next_share - before / 2 - 1.5 * after) / np.maximum(before - after, SHORTEST)
    return np.clip(ends, 0, 1)


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
