"""Segmentations: volumes of label numbers, with the names and colours of the labels."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

from infill.errors import FormatError
from infill.files.broken import wrap_read_errors
from infill.grid import spacing_of
from infill.imaging.assumed import keep_warnings
from infill.imaging.dicom.reading import read_dicom_segments
from infill.imaging.frames import choose_frame
from infill.imaging.label_tables import Segment, segments_of_nrrd
from infill.imaging.nrrd import read_layers
from infill.imaging.volume_files import holds_dicom, read_volume
from infill.volume import AXES, Volume

NRRD_SUFFIXES = (".nrrd", ".nhdr")


@dataclass(frozen=True, kw_only=True)
class Segmentation:
    """Volumes of label numbers, and information about the labels.

    Parameters
    ----------
    layers : tuple of Volume
        Integers, 0 outside all labels. Overlapping segments lie in separate layers.
    segments : tuple of Segment
        Known names and colours.
    """

    layers: tuple[Volume, ...]
    segments: tuple[Segment, ...] = ()


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
