"""A segmentation: volumes whose cells hold numbers, and what those numbers mean."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

from infill.errors import FormatError
from infill.files.broken import told_unreadable
from infill.grid import spacing_of
from infill.imaging.assumed import keep_warnings
from infill.imaging.dicom import read_dicom_segments
from infill.imaging.frames import chosen
from infill.imaging.label_tables import Segment, segments_of_nrrd
from infill.imaging.nrrd import read_layers
from infill.imaging.volume_files import holds_dicom, read_volume
from infill.volume import AXES, Volume

NRRD = (".nrrd", ".nhdr")


@dataclass(frozen=True, kw_only=True)
class Segmentation:
    """Volumes of labels, and what is known about the labels.

    Parameters
    ----------
    layers : tuple of Volume
        Whole numbers, 0 where no label is. Segments that overlap lie in layers of their own.
    segments : tuple of Segment
        Names and colours, as far as they are known.
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
    """Return the labels of a file or a folder: of .seg.nrrd and of DICOM segmentations, with layers, names and colours.

    Parameters
    ----------
    path : str or Path
    array, series, frame, spacing
        See `infill.read_volume`.

    Raises
    ------
    FormatError
        As `infill.read_volume`; and if the header names a layer that is not there.
    """
    source = Path(path)
    if array is None and holds_dicom(source, series):
        found = _read_dicom(source, series)
        if found is not None:
            return _sized(found if frame is None else _layer(found, source, frame), spacing)
    segments: tuple[Segment, ...] = ()
    if source.suffix.lower() in NRRD and source.is_file() and array is None and series is None:
        segments = segments_of_nrrd(source)
    if not segments or frame is not None:
        volume = read_volume(source, array=array, series=series, frame=frame, spacing=spacing)
        own = tuple(replace(each, layer=0) for each in segments if each.layer == frame)
        return Segmentation(layers=(volume,), segments=own)
    with keep_warnings() as kept:
        layers = tuple(replace(layer, warnings=(*layer.warnings, *kept)) for layer in read_layers(source))
    missing = [each for each in segments if not 0 <= each.layer < len(layers)]
    if missing:
        raise FormatError(
            f"{source} says that {missing[0].name or missing[0].value!r} lies in layer {missing[0].layer} and holds "
            f"{len(layers)} of them, counted from 0; save it again"
        )
    return _sized(Segmentation(layers=layers, segments=segments), spacing)


def _read_dicom(source: Path, series: str | None) -> Segmentation | None:
    """Return the segments of a DICOM file or folder; None if it holds other things."""
    with told_unreadable(source):
        found = read_dicom_segments(source, series=series)
    return None if found is None else Segmentation(layers=found[0], segments=found[1])


def _layer(segmentation: Segmentation, source: Path, frame: int) -> Segmentation:
    """Return one layer of a segmentation, and its segments."""
    at = chosen(source, frame, len(segmentation.layers), what="holds layers of segments")
    segments = tuple(replace(each, layer=0) for each in segmentation.segments if each.layer == at)
    return Segmentation(layers=(segmentation.layers[at],), segments=segments)


def _sized(segmentation: Segmentation, spacing: float | tuple[float, ...] | None) -> Segmentation:
    """Return a segmentation with another cell size, if one is given."""
    if spacing is None:
        return segmentation
    size = spacing_of(spacing, AXES)
    return replace(segmentation, layers=tuple(replace(layer, spacing=size) for layer in segmentation.layers))
