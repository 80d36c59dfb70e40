"""DICOM segmentations: every frame is a slice of one segment, or of all of them; frames without a cell are left out.

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
from infill.files.broken import SMALLER, checked_volume
from infill.imaging.dicom_files import Frame, Image, Segments
from infill.imaging.dicom_frames import UNEVEN, Plane, Uneven, placed_frames, plane_of, rounded
from infill.imaging.dicom_pixels import stored_numbers
from infill.imaging.frames import chosen
from infill.imaging.label_tables import Segment
from infill.machine import require_memory
from infill.volume import AXES, Volume

AROUND = 2  # empty slices on both sides: frames that are left out hold nothing


@dataclass(frozen=True, kw_only=True)
class Grid:
    """Where the slices of a segmentation lie.

    Parameters
    ----------
    slices : tuple of int
        Which slice each frame is.
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
    """Return volumes of segment numbers, the segments, and what there is to warn of.

    Segments that overlap lie in volumes of their own, and so do those of different files.

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
        known = _segments(image)
        grid, said = _grid(image)
        numbers = stored_numbers(image)
        warnings += [*said, *numbers.warnings]
        if known.kind == "FRACTIONAL" and ((numbers.values > 0) & (numbers.values < known.highest)).any():
            warnings.append(f"{image.path} holds shares of cells; cells that lie at least half in a segment are taken")
        where: dict[int, int] = {}
        if known.kind == "LABELMAP":
            arrays = [_label_map(image, grid, numbers.values)]
        else:
            arrays, where = _layers(image, grid, numbers.values, known)
        segments += [replace(each, layer=len(layers) + where.get(each.value, 0)) for each in known.known if each.value]
        layers += [grid.volume(path, each) for each in arrays]
    return tuple(layers), tuple(segments), tuple(warnings)


def segment_volume(path: Path, images: Sequence[Image], frame: int | None) -> tuple[Volume, tuple[str, ...]]:
    """Return one layer of segment numbers, or how much of each cell lies in the only segment, and what to warn of."""
    first = _segments(images[0])
    numbers = {each.segment for each in images[0].frames}
    if len(images) == 1 and first.kind == "FRACTIONAL" and len(numbers) == 1:
        chosen(path, frame, 1, what="")
        grid, warnings = _grid(images[0])
        stored = stored_numbers(images[0])
        shares = np.zeros((grid.count, *images[0].frames[0].shape), dtype=np.float32)
        _check_single(images[0], grid)
        for at, page in zip(grid.slices, stored.values, strict=True):
            shares[at] = page / np.float32(first.highest)
        return grid.volume(path, shares, varied=True), (*warnings, *stored.warnings)
    layers, _, warnings = segment_layers(path, images)
    what = f"holds {len(layers)} layers of segments; write all with {{label}} in the name of the output"
    layer = layers[chosen(path, frame, len(layers), what=what)]
    return checked_volume(path, np.asarray(layer.values), **_place_of(layer)), warnings


def _place_of(volume: Volume) -> dict[str, Any]:
    return {name: getattr(volume, name) for name in ("spacing", "origin", "direction", "space")}


def _segments(image: Image) -> Segments:
    if image.segments is None or image.segments.kind not in ("BINARY", "FRACTIONAL", "LABELMAP"):
        kind = "no segments" if image.segments is None else f"segments of the type {image.segments.kind!r}"
        raise FormatError(f"{image.path} holds {kind}; save it as BINARY, FRACTIONAL or LABELMAP")
    return image.segments


def _grid(image: Image) -> tuple[Grid, tuple[str, ...]]:
    """Return where the frames of a segmentation lie, and what there is to warn of."""
    if image.photometric not in ("MONOCHROME2", "PALETTE COLOR", "MONOCHROME1", ""):
        raise FormatError(f"{image.path} holds colours ({image.photometric}); save it as a segmentation")
    if image.unplaced:
        raise FormatError(f"{image.path} {image.unplaced}; save it as .seg.nrrd")
    frames, warnings = placed_frames(image, None)
    plane = plane_of(frames)
    if isinstance(plane, Uneven) or any(frame.position is None for frame in frames):
        why = plane.why if isinstance(plane, Uneven) else "some have no place"
        raise FormatError(f"{image.path} holds slices that make no volume: {why}; save it as .seg.nrrd")
    places = np.array([frame.position for frame in frames], dtype=np.float64)
    along = places @ plane.direction[:, 2]
    order = np.argsort(along, kind="stable")
    steps = np.diff(along[order])
    largest = float(steps.max()) if len(steps) else 0.0
    apart = steps[steps > UNEVEN * largest]
    if len(apart) == 0:
        raise FormatError(f"{image.path} is a single slice; give the segmentation of all slices")
    stated = frames[0].between
    for step in dict.fromkeys([abs(stated)] if stated else []) | {float(apart.min()): None}:
        found = _slices(places, order, steps, step, plane)
        if found is not None:
            said = _sparse(image, found[0], step) or _thin(image, frames[0], step)
            return _padded(frames, found, plane), (*warnings, *said)
    raise FormatError(
        f"{image.path} has slices away from even steps of {stated or float(apart.min()):.4g} mm (the steps are "
        f"{float(apart.min()):.4g} to {largest:.4g} mm, or slices are shifted sideways); resample it, or save it as "
        ".seg.nrrd"
    )


def _slices(
    places: NDArray[np.float64], order: NDArray[np.intp], steps: NDArray[np.float64], step: float, plane: Plane
) -> tuple[NDArray[np.int64], NDArray[np.float64], float] | None:
    """Return which slice each frame is, the centre of slice 0 and the step, mm; None if that fits the places badly."""
    whole = np.rint(steps / step)
    if (np.abs(steps - whole * step) > UNEVEN * step * np.maximum(whole, 1)).any() or not whole.any():
        return None
    number = np.empty(len(places), dtype=np.int64)
    number[order] = np.concatenate([[0], np.cumsum(whole)]).astype(np.int64)
    normal = plane.direction[:, 2]
    spread = number - number.mean()
    fitted = rounded(spread @ (places @ normal) / (spread @ spread))
    first = places.mean(axis=0) - number.mean() * fitted * normal
    off = np.linalg.norm(first + np.outer(number * fitted, normal) - places, axis=1).max()
    return (number, first, fitted) if off <= UNEVEN * fitted else None


def _sparse(image: Image, slices: NDArray[np.int64], step: float) -> tuple[str, ...]:
    """Return a warning if no two frames lie side by side, so that the solid is one slab for each."""
    apart = np.diff(np.unique(slices))
    if len(apart) < 2 or apart.min() < 2:
        return ()
    return (
        f"{image.path} says that slices are {step:g} mm apart and holds none that lie side by side; those between them "
        "are empty",
    )


def _thin(image: Image, frame: Frame, step: float) -> tuple[str, ...]:
    """Return a warning if nothing says how far apart slices are, and they lie further apart than they are thick.

    Frames without a cell of a segment are left out of files, so that the even steps of the others may be too long.
    """
    thick = frame.thickness
    if frame.between or not thick or step <= (1 + UNEVEN) * thick:
        return ()
    return (
        f"{image.path} does not say how far apart slices are: its frames lie {step:g} mm apart and are {thick:g} mm "
        f"thick, and {step:g} mm are taken; if slices between them are empty, the solid is too large",
    )


def _padded(frames: Sequence[Frame], found: tuple[NDArray[np.int64], NDArray[np.float64], float], plane: Plane) -> Grid:
    slices, first, step = found
    spacing = (*plane.pixel, step)
    corner = first - plane.direction @ (np.array(spacing) * (0.5, 0.5, 0.5 + AROUND))
    return Grid(
        slices=tuple((slices + AROUND).tolist()),
        count=int(slices.max()) + 1 + 2 * AROUND,
        spacing=spacing,
        origin=tuple(corner.tolist()),
        direction=plane.direction,
        space=frames[0].space,
    )


def _check_single(image: Image, grid: Grid) -> None:
    """Raise FormatError if two frames of one segment lie at one place."""
    taken: set[tuple[int | None, int]] = set()
    for frame, at in zip(image.frames, grid.slices, strict=True):
        if (frame.segment, at) in taken:
            raise FormatError(
                f"{image.path} holds two frames of segment {frame.segment} at one place; save each volume of it alone"
            )
        taken.add((frame.segment, at))


def _require_room(image: Image, grid: Grid, kind: type[np.integer[Any]]) -> NDArray[Any]:
    shape = (grid.count, *image.frames[0].shape)
    assert len(shape) == AXES
    require_memory(grid.count * shape[1] * shape[2] * np.dtype(kind).itemsize, None, SMALLER)
    return np.zeros(shape, dtype=kind)


def _label_map(image: Image, grid: Grid, stored: NDArray[Any]) -> NDArray[Any]:
    labels = _require_room(image, grid, np.uint8 if image.pixels.allocated <= 8 else np.uint16)
    _check_single(image, grid)
    for at, page in zip(grid.slices, stored, strict=True):
        labels[at] = page
    if image.padding is not None:
        labels[(labels >= image.padding[0]) & (labels <= image.padding[1])] = 0
    return labels


def _layers(
    image: Image, grid: Grid, stored: NDArray[Any], known: Segments
) -> tuple[list[NDArray[Any]], dict[int, int]]:
    """Return arrays of segment numbers, as few as hold segments that overlap, and in which each segment lies."""
    _check_single(image, grid)
    of_segment: dict[int, list[int]] = {}
    for frame in image.frames:
        if frame.segment is None or not 0 < frame.segment < 2**16:
            raise FormatError(f"{image.path} does not say of which segment frame {frame.number} is; save it again")
        of_segment.setdefault(frame.segment, []).append(frame.number)
    kind = np.uint8 if max(of_segment) < 2**8 else np.uint16
    layers: list[NDArray[Any]] = []
    where: dict[int, int] = {}
    for segment, numbers in sorted(of_segment.items()):
        masks = [(grid.slices[k], _inside(stored[k], known)) for k in numbers]
        free = (k for k, layer in enumerate(layers) if not any(layer[at][mask].any() for at, mask in masks))
        number = next(free, len(layers))
        if number == len(layers):
            layers.append(_require_room(image, grid, kind))
        where[segment] = number
        for at, mask in masks:
            layers[number][at][mask] = segment
    return layers, where


def _inside(page: NDArray[Any], known: Segments) -> NDArray[np.bool_]:
    return page > 0 if known.kind == "BINARY" else 2 * page.astype(np.int64) >= known.highest
