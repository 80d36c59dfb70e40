"""A segmentation: volumes whose cells hold numbers, and what those numbers mean."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

from infill.errors import FormatError
from infill.formats.label_tables import Segment, segments_of_nrrd
from infill.formats.nrrd import read_layers
from infill.formats.volume_files import read_volume
from infill.volume import Volume

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
    path: str | os.PathLike[str], *, array: str | None = None, series: str | None = None, frame: int | None = None
) -> Segmentation:
    """Return the labels of a file or a folder: with all layers, names and colours if 3D Slicer saved it as .seg.nrrd.

    Parameters
    ----------
    path : str or Path
    array, series, frame
        See `infill.read_volume`.

    Raises
    ------
    FormatError
        As `infill.read_volume`; and if the header names a layer that is not there.
    """
    source = Path(path)
    if source.suffix.lower() not in NRRD or not source.is_file() or array is not None or series is not None:
        return Segmentation(layers=(read_volume(source, array=array, series=series, frame=frame),))
    segments = segments_of_nrrd(source)
    if not segments:
        return Segmentation(layers=(read_volume(source, frame=frame),))
    if frame is not None:
        layer = read_volume(source, frame=frame)
        return Segmentation(
            layers=(layer,), segments=tuple(replace(each, layer=0) for each in segments if each.layer == frame)
        )
    layers = read_layers(source)
    missing = [each for each in segments if not 0 <= each.layer < len(layers)]
    if missing:
        raise FormatError(
            f"{source} says that {missing[0].name or missing[0].value!r} lies in layer {missing[0].layer} and holds "
            f"{len(layers)} of them, counted from 0; save it again"
        )
    return Segmentation(layers=layers, segments=segments)
