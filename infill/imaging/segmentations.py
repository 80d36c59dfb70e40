"""Segmentations: volumes of label numbers, with the names and colours of the labels."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, ParameterError
from infill.files.broken import wrap_read_errors
from infill.grid import spacing_of
from infill.imaging.arrays import count_npz_axes, map_npy, read_npz_array
from infill.imaging.assumed import keep_warnings, warn
from infill.imaging.dicom.reading import read_dicom_segments
from infill.imaging.frames import choose_frame
from infill.imaging.label_tables import Segment, segments_of_nrrd
from infill.imaging.nifti import count_nifti_frames, read_nifti_frames
from infill.imaging.nrrd import count_nrrd_frames, read_layers
from infill.imaging.volume_files import holds_dicom, read_volume
from infill.plain_numbers import plain_number
from infill.volume import AXES, Volume

NRRD_SUFFIXES = (".nrrd", ".nhdr")
FRAMED = {  # how to count and read the frames of a file
    **dict.fromkeys(NRRD_SUFFIXES, (count_nrrd_frames, read_layers)),
    **dict.fromkeys((".nii", ".nii.gz"), (count_nifti_frames, read_nifti_frames)),
}
SHARE_ERROR = 0.01  # of what adds up to 1
LEAST_SHARE = 0.02  # smaller ones count as none


@dataclass(frozen=True, kw_only=True)
class Segmentation:
    """Volumes of label numbers, and information about the labels.

    Parameters
    ----------
    layers : tuple of Volume
        Integers, 0 outside all labels. Overlapping segments lie in separate layers.
    segments : tuple of Segment
        Known names and colours.
    shares : (labels, nx, ny, nz) float32, optional
        The share of every cell that labels 1, 2 ... of the only layer have, if cells may belong to several.
    """

    layers: tuple[Volume, ...]
    segments: tuple[Segment, ...] = ()
    shares: NDArray[np.float32] | None = None


def segmentation_of_shares(
    shares: NDArray[np.generic],
    **place: Any,  # noqa: ANN401 - of a Volume
) -> Segmentation:
    """Return the segmentation of labels that share cells: partial volumes, or probabilities of a network.

    Parameters
    ----------
    shares : (labels, nx, ny, nz) float
        The share of each label, 0 to 1; the rest of 1 is the space between labels. If nothing is left anywhere, the
        first is that space, as networks write it.
    **place
        Spacing, origin, direction and space of the `infill.Volume`.

    Raises
    ------
    ParameterError
        If these are not shares.

    Notes
    -----
    Shares under 0.02 count as none and over 0.98 as all, since probabilities are never quite 0 or 1.
    """
    if shares.ndim != AXES + 1 or not np.issubdtype(shares.dtype, np.floating):
        raise ParameterError(
            f"shares of labels have the shape {shares.shape} and the type {shares.dtype}; give real numbers with the "
            "axes [label, x, y, z]"
        )
    parts = shares.astype(np.float32)
    low, high = (float(value) for value in (parts.min(initial=0), parts.max(initial=0)))
    total = parts.sum(axis=0)
    most = float(total.max(initial=0))
    if not (low >= -SHARE_ERROR and most <= 1 + SHARE_ERROR):  # also for values that are not finite
        raise ParameterError(
            f"shares of labels go from {plain_number(low)} to {plain_number(high)}, and those of a cell add up to "
            f"{plain_number(most)}; give shares that add up to 1 at most"
        )
    if total.min(initial=1) >= 1 - SHARE_ERROR and len(parts) > 1:
        warn("the shares of all cells add up to 1, so the first is taken as the space between labels")
        parts = parts[1:]
    parts[parts < LEAST_SHARE] = 0
    parts[parts > 1 - LEAST_SHARE] = 1
    rest = 1 - parts.sum(axis=0)
    numbers = np.where(parts.max(axis=0, initial=0) > rest, 1 + parts.argmax(axis=0) if len(parts) else 0, 0)
    volume = Volume(values=numbers.astype(np.uint16), **place)
    return Segmentation(layers=(volume,), shares=parts)


def read_segmentation(
    path: str | os.PathLike[str],
    *,
    array: str | None = None,
    series: str | None = None,
    frame: int | None = None,
    spacing: float | tuple[float, ...] | None = None,
) -> Segmentation:
    """Read the labels of a file or a folder; .seg.nrrd and DICOM segmentations have layers, names and colours.

    Parameters
    ----------
    path : str or Path
    array, series, frame, spacing
        See `infill.read_volume`.

    Raises
    ------
    FormatError
        As `infill.read_volume`, or if the header names a layer that does not exist.
    """
    source = Path(path)
    if array is None and holds_dicom(source, series):
        segmentation = _read_dicom(source, series)
        if segmentation is not None:
            return _with_spacing(segmentation if frame is None else _select_layer(segmentation, source, frame), spacing)
    segments: tuple[Segment, ...] = ()
    if source.suffix.lower() in NRRD_SUFFIXES and source.is_file() and array is None and series is None:
        segments = segments_of_nrrd(source)
    if not segments and frame is None and source.is_file():
        with wrap_read_errors(source):
            shared = _read_shares(source, array)
        if shared is not None:
            return _with_spacing(shared, spacing)
    if not segments or frame is not None:
        volume = read_volume(source, array=array, series=series, frame=frame, spacing=spacing)
        selected = tuple(replace(segment, layer=0) for segment in segments if segment.layer == frame)
        return Segmentation(layers=(volume,), segments=selected)
    with keep_warnings() as assumptions:
        layers = tuple(replace(layer, warnings=(*layer.warnings, *assumptions)) for layer in read_layers(source))
    missing = [segment for segment in segments if not 0 <= segment.layer < len(layers)]
    if missing:
        raise FormatError(
            f"{source} says that {missing[0].name or missing[0].value!r} lies in layer {missing[0].layer} and holds "
            f"{len(layers)} of them, counted from 0; save it again"
        )
    return _with_spacing(Segmentation(layers=layers, segments=segments), spacing)


def _read_shares(source: Path, array: str | None) -> Segmentation | None:
    """Read real numbers from 0 to 1 with four axes: shares of labels; return None for other content."""
    name = source.name.lower()
    count, read = next((readers for ending, readers in FRAMED.items() if name.endswith(ending)), (None, None))
    place: dict[str, Any] = {}
    if name.endswith(".npy"):
        values = map_npy(source)
    elif name.endswith(".npz") and count_npz_axes(source, array) > AXES:
        values, place = read_npz_array(source, array)
    elif count is not None and read is not None and count(source) > 1:
        frames = read(source)
        values = np.stack([frame.values for frame in frames])
        place = {key: getattr(frames[0], key) for key in ("spacing", "origin", "direction", "space")}
    else:
        return None
    if values.ndim != AXES + 1 or values.dtype.kind != "f":
        return None
    try:
        return segmentation_of_shares(values, **place)
    except ParameterError:  # a series of volumes
        return None


def _read_dicom(source: Path, series: str | None) -> Segmentation | None:
    """Read the segments of a DICOM file or folder; return None for other content."""
    with wrap_read_errors(source):
        content = read_dicom_segments(source, series=series)
    return None if content is None else Segmentation(layers=content[0], segments=content[1])


def _select_layer(segmentation: Segmentation, source: Path, frame: int) -> Segmentation:
    """Return one layer of a segmentation, with its segments."""
    layer = choose_frame(source, frame, len(segmentation.layers), what="holds layers of segments")
    segments = tuple(replace(segment, layer=0) for segment in segmentation.segments if segment.layer == layer)
    return Segmentation(layers=(segmentation.layers[layer],), segments=segments)


def _with_spacing(segmentation: Segmentation, spacing: float | tuple[float, ...] | None) -> Segmentation:
    """Return a segmentation with another cell size, if one is given."""
    if spacing is None:
        return segmentation
    size = spacing_of(spacing, AXES)
    return replace(segmentation, layers=tuple(replace(layer, spacing=size) for layer in segmentation.layers))
