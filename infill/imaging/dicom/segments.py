"""DICOM segmentations: every frame is a slice of one or all segments; files omit empty frames.

Source: DICOM PS3.3, A.51 and C.8.20.2 (BINARY, FRACTIONAL), A.90 (LABELMAP).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE
from infill.imaging.checked_volume import checked_volume
from infill.imaging.dicom.headers import Image, Segments
from infill.imaging.dicom.pixels import stored_numbers
from infill.imaging.dicom.places import Frame
from infill.imaging.dicom.stacks import STEP_TOLERANCE, Plane, Uneven, place_frames, plane_of, round_length
from infill.imaging.frames import choose_frame
from infill.imaging.label_tables import Segment
from infill.machine import require_memory
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

EMPTY_MARGIN = 2  # empty slices on both sides: omitted frames are empty


@dataclass(frozen=True, kw_only=True)
class SliceGrid:
    """Position of the slices of a segmentation.

    Parameters
    ----------
    slices : tuple of int
        Slice number of each frame.
    count : int
    spacing, origin : (3,) float
        mm
    direction : (3, 3) float
    space : str
    """

    slices: tuple[int, ...]
    count: int
    spacing: tuple[float, ...]
    origin: tuple[float, ...]
    direction: NDArray[np.float64]
    space: str

    def volume(self, path: Path, values: NDArray[Any], *, varied: bool = False) -> Volume:
        """Return values [slice, row, column] as a volume [x, y, z]."""
        place = {"spacing": self.spacing, "origin": self.origin, "direction": self.direction, "space": self.space}
        return checked_volume(path, values.T, varied=varied, **place)


def segment_layers(
    path: Path, images: Sequence[Image]
) -> tuple[tuple[Volume, ...], tuple[Segment, ...], tuple[str, ...]]:
    """Return volumes of segment numbers, the segments, and warnings.

    Overlapping segments lie in separate volumes, and so do those of different files.

    Raises
    ------
    FormatError
        If the slices of a file do not lie in even steps, or two of a segment lie at one place.
    MemoryLimitError
    """
    layers: list[Volume] = []
    segments: list[Segment] = []
    warnings: list[str] = []
    for image in images:
        segment_info = _require_segments(image)
        grid, grid_warnings = _grid(image)
        numbers = stored_numbers(image)
        warnings += [*grid_warnings, *numbers.warnings]
        if segment_info.kind == "FRACTIONAL" and ((numbers.values > 0) & (numbers.values < segment_info.highest)).any():
            warnings.append(f"{image.path} holds shares of cells; cells that lie at least half in a segment are taken")
        layer_of: dict[int, int] = {}
        if segment_info.kind == "LABELMAP":
            arrays = [_label_map(image, grid, numbers.values)]
        else:
            arrays, layer_of = _stack_segments(image, grid, numbers.values, segment_info)
        segments += [
            replace(segment, layer=len(layers) + layer_of.get(segment.value, 0))
            for segment in segment_info.known
            if segment.value
        ]
        layers += [grid.volume(path, array) for array in arrays]
    return tuple(layers), tuple(segments), tuple(warnings)


def segment_volume(path: Path, images: Sequence[Image], frame: int | None) -> tuple[Volume, tuple[str, ...]]:
    """Return the volume of segment numbers that `frame` chooses, or the shares of a lone segment; and warnings."""
    segment_info = _require_segments(images[0])
    numbers = {slice_frame.segment for slice_frame in images[0].frames}
    if len(images) == 1 and segment_info.kind == "FRACTIONAL" and len(numbers) == 1:
        choose_frame(path, frame, 1, what="")
        grid, warnings = _grid(images[0])
        stored = stored_numbers(images[0])
        shares = np.zeros((grid.count, *images[0].frames[0].shape), dtype=np.float32)
        _check_single(images[0], grid)
        for slice_index, page in zip(grid.slices, stored.values, strict=True):
            shares[slice_index] = page / np.float32(segment_info.highest)
        return grid.volume(path, shares, varied=True), (*warnings, *stored.warnings)
    layers, _, warnings = segment_layers(path, images)
    what = f"holds {len(layers)} layers of segments; write all with {{label}} in the name of the output"
    layer = layers[choose_frame(path, frame, len(layers), what=what)]
    return checked_volume(path, np.asarray(layer.values), **_placement(layer)), warnings


def _placement(volume: Volume) -> dict[str, Any]:
    """Return the position of a volume as keywords."""
    return {name: getattr(volume, name) for name in ("spacing", "origin", "direction", "space")}


def _require_segments(image: Image) -> Segments:
    """Return the segments of an image, or raise FormatError for an unknown kind."""
    if image.segments is None or image.segments.kind not in ("BINARY", "FRACTIONAL", "LABELMAP"):
        kind = "no segments" if image.segments is None else f"segments of the type {image.segments.kind!r}"
        raise FormatError(f"{image.path} holds {kind}; save it as BINARY, FRACTIONAL or LABELMAP")
    return image.segments


def _grid(image: Image) -> tuple[SliceGrid, tuple[str, ...]]:
    """Return the grid of the slices of a segmentation, and warnings."""
    if image.photometric not in ("MONOCHROME2", "PALETTE COLOR", "MONOCHROME1", ""):
        raise FormatError(f"{image.path} holds colours ({image.photometric}); save it as a segmentation")
    if image.unplaced:
        raise FormatError(f"{image.path} {image.unplaced}; save it as .seg.nrrd")
    frames, warnings = place_frames(image, None)
    plane = plane_of(frames)
    if isinstance(plane, Uneven) or any(frame.position is None for frame in frames):
        why = plane.why if isinstance(plane, Uneven) else "some have no place"
        raise FormatError(f"{image.path} holds slices that make no volume: {why}; save it as .seg.nrrd")
    places = np.array([frame.position for frame in frames], dtype=np.float64)
    along = places @ plane.direction[:, 2]
    order = np.argsort(along, kind="stable")
    steps = np.diff(along[order])
    widest = float(steps.max()) if len(steps) else 0.0
    gaps = steps[steps > STEP_TOLERANCE * widest]
    if len(gaps) == 0:
        raise FormatError(f"{image.path} is a single slice; give the segmentation of all slices")
    stated = frames[0].between
    for step in dict.fromkeys([abs(stated)] if stated else []) | {float(gaps.min()): None}:
        fit = _fit_slices(places, order, steps, step, plane)
        if fit is not None:
            hints = _warn_if_sparse(image, fit[0], step) or _warn_if_thin(image, frames[0], step)
            return _padded_grid(frames, fit, plane), (*warnings, *hints)
    raise FormatError(
        f"{image.path} has slices away from even steps of {plain_argument(stated or float(gaps.min()), 4)} mm (the "
        f"steps are {plain_argument(float(gaps.min()), 4)} to {plain_argument(widest, 4)} mm, or slices are shifted "
        "sideways); resample it, or save it as .seg.nrrd"
    )


def _fit_slices(
    places: NDArray[np.float64], order: NDArray[np.intp], steps: NDArray[np.float64], step: float, plane: Plane
) -> tuple[NDArray[np.int64], NDArray[np.float64], float] | None:
    """Return the slice number of each frame, the centre of slice 0 and the step, mm; None if the fit is bad."""
    gaps = np.rint(steps / step)
    if (np.abs(steps - gaps * step) > STEP_TOLERANCE * step * np.maximum(gaps, 1)).any() or not gaps.any():
        return None
    slice_number = np.empty(len(places), dtype=np.int64)
    slice_number[order] = np.concatenate([[0], np.cumsum(gaps)]).astype(np.int64)
    normal = plane.direction[:, 2]
    centred = slice_number - slice_number.mean()
    fitted_step = round_length(centred @ (places @ normal) / (centred @ centred))
    start = places.mean(axis=0) - slice_number.mean() * fitted_step * normal
    deviation = np.linalg.norm(start + np.outer(slice_number * fitted_step, normal) - places, axis=1).max()
    return (slice_number, start, fitted_step) if deviation <= STEP_TOLERANCE * fitted_step else None


def _warn_if_sparse(image: Image, slices: NDArray[np.int64], step: float) -> tuple[str, ...]:
    """Return a warning if no two frames are adjacent, so that the solid is one slab for each."""
    gaps = np.diff(np.unique(slices))
    if len(gaps) < 2 or gaps.min() < 2:
        return ()
    return (
        f"{image.path} says that slices are {plain_argument(step)} mm apart and holds none that lie side by side; "
        "those between them are empty",
    )


def _warn_if_thin(image: Image, frame: Frame, step: float) -> tuple[str, ...]:
    """Return a warning if the distance of slices is unknown and larger than their thickness.

    Files omit frames without cells of a segment, so that the even steps of the others may be too long.
    """
    thick = frame.thickness
    if frame.between or not thick or step <= (1 + STEP_TOLERANCE) * thick:
        return ()
    return (
        f"{image.path} does not say how far apart slices are: its frames lie {plain_argument(step)} mm apart and are "
        f"{plain_argument(thick)} mm thick, and {plain_argument(step)} mm are taken; if slices between them are "
        "empty, the solid is too large",
    )


def _padded_grid(
    frames: Sequence[Frame], fit: tuple[NDArray[np.int64], NDArray[np.float64], float], plane: Plane
) -> SliceGrid:
    """Build the grid, with empty slices on both sides."""
    slices, start, step = fit
    spacing = (*plane.pixel, step)
    corner = start - plane.direction @ (np.array(spacing) * (0.5, 0.5, 0.5 + EMPTY_MARGIN))
    return SliceGrid(
        slices=tuple((slices + EMPTY_MARGIN).tolist()),
        count=int(slices.max()) + 1 + 2 * EMPTY_MARGIN,
        spacing=spacing,
        origin=tuple(corner.tolist()),
        direction=plane.direction,
        space=frames[0].space,
    )


def _check_single(image: Image, grid: SliceGrid) -> None:
    """Raise FormatError if two frames of one segment lie at one place."""
    seen: set[tuple[int | None, int]] = set()
    for frame, slice_index in zip(image.frames, grid.slices, strict=True):
        if (frame.segment, slice_index) in seen:
            raise FormatError(
                f"{image.path} holds two frames of segment {frame.segment} at one place; save each volume of it alone"
            )
        seen.add((frame.segment, slice_index))


def _allocate(image: Image, grid: SliceGrid, kind: type[np.integer[Any]]) -> NDArray[Any]:
    """Allocate an array for the slices, or raise MemoryLimitError."""
    shape = (grid.count, *image.frames[0].shape)
    assert len(shape) == AXES
    require_memory(grid.count * shape[1] * shape[2] * np.dtype(kind).itemsize, None, SMALLER_VOLUME_ADVICE)
    return np.zeros(shape, dtype=kind)


def _label_map(image: Image, grid: SliceGrid, stored: NDArray[Any]) -> NDArray[Any]:
    """Return the labels of a label map, with padding as 0."""
    labels = _allocate(image, grid, np.uint8 if image.pixels.allocated <= 8 else np.uint16)
    _check_single(image, grid)
    for slice_index, page in zip(grid.slices, stored, strict=True):
        labels[slice_index] = page
    if image.padding is not None:
        labels[(labels >= image.padding[0]) & (labels <= image.padding[1])] = 0
    return labels


def _stack_segments(
    image: Image, grid: SliceGrid, stored: NDArray[Any], segment_info: Segments
) -> tuple[list[NDArray[Any]], dict[int, int]]:
    """Return as few arrays of segment numbers as overlaps allow, and the array index of each segment."""
    _check_single(image, grid)
    of_segment: dict[int, list[int]] = {}
    for frame in image.frames:
        if frame.segment is None or not 0 < frame.segment < 2**16:
            raise FormatError(f"{image.path} does not say of which segment frame {frame.number} is; save it again")
        of_segment.setdefault(frame.segment, []).append(frame.number)
    kind = np.uint8 if max(of_segment) < 2**8 else np.uint16
    layers: list[NDArray[Any]] = []
    layer_of: dict[int, int] = {}
    for segment, numbers in sorted(of_segment.items()):
        masks = [(grid.slices[k], _mask_inside(stored[k], segment_info)) for k in numbers]
        free = (
            k
            for k, layer in enumerate(layers)
            if not any(layer[slice_index][mask].any() for slice_index, mask in masks)
        )
        layer_index = next(free, len(layers))
        if layer_index == len(layers):
            layers.append(_allocate(image, grid, kind))
        layer_of[segment] = layer_index
        for slice_index, mask in masks:
            layers[layer_index][slice_index][mask] = segment
    return layers, layer_of


def _mask_inside(page: NDArray[Any], segment_info: Segments) -> NDArray[np.bool_]:
    """Return a mask of the cells inside the segment."""
    return page > 0 if segment_info.kind == "BINARY" else 2 * page.astype(np.int64) >= segment_info.highest
