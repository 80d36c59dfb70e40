"""DICOM: a file of several frames, or a folder of files, as a volume or as segments, ordered by position."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from infill.errors import FormatError
from infill.imaging.checked_volume import checked_volume
from infill.imaging.dicom.headers import Image, is_dicom, read_image, require_pydicom
from infill.imaging.dicom.pixels import frame_values, require_grey
from infill.imaging.dicom.places import Frame
from infill.imaging.dicom.segments import segment_layers, segment_volume
from infill.imaging.dicom.stacks import SOURCE_FILES, STORED_ORDER, Stack, place_frames, split_into_stacks
from infill.imaging.frames import choose_frame
from infill.imaging.label_tables import Segment
from infill.volume import Volume

LOG = logging.getLogger("infill")
MOST_WARNINGS = 5  # of one file
HEAD_BYTES = 1024  # bytes that contain the storage class
STORAGE_CLASS = b"\x02\x00\x02\x00UI"  # tag (0002,0002), little-endian like the rest of that header


@dataclass(frozen=True, kw_only=True)
class DicomSource:
    """The files of one series.

    Parameters
    ----------
    path : Path
        The file or the folder, for messages.
    images : tuple of Image
    """

    path: Path
    images: tuple[Image, ...]

    @property
    def is_segmentation(self) -> bool:
        """True if all files are segmentations."""
        return all(image.segments is not None for image in self.images)


def read_dicom(
    path: Path,
    frame: int | None = None,
    *,
    series: str | None = None,
    spacing: tuple[float, ...] | None = None,
) -> Volume:
    """Read the volume of a file or of a series in a folder, or one of several volumes.

    Parameters
    ----------
    path : Path
    frame : int, optional
        Index of the volume, counted from 0, if there are several.
    series : str, optional
        UID of the series, if a folder holds several.
    spacing : (hx, hy, hz), optional
        Cell size, mm, for files that do not state it.

    Raises
    ------
    FormatError, MemoryLimitError, ParameterError
        See `infill.read_volume`.
    """
    source = _read_source(path, series)
    if source.is_segmentation:
        return _with_warnings(*segment_volume(path, source.images, frame))
    frames, warnings = _frames_of_source(source, spacing)
    if len(frames) == 1 or (all(image.count == 1 for image in source.images) and len(source.images) == 1):
        rows, columns = frames[0].shape
        raise FormatError(
            f"{path} is a single slice, {columns} x {rows} x 1 cells; give the folder of all slices, or a volume"
        )
    volumes = split_into_stacks(path, frames)
    sizes = sorted({len(stack.frames) for stack in volumes.stacks})
    counts = f"{sizes[0]}" if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    what = f"holds {len(volumes.stacks)} volumes of {counts} slices, told apart by {volumes.apart}"
    chosen_index = choose_frame(path, frame, len(volumes.stacks), what=what)
    if volumes.apart in (STORED_ORDER, SOURCE_FILES):
        warnings = (*warnings, f"{path}: frame {chosen_index} differs from the others by {volumes.apart}")
    stack = volumes.stacks[chosen_index]
    numbers = frame_values(source.images, stack.frames)
    volume = checked_volume(path, numbers.values.T, **_placement(stack))
    return _with_warnings(volume, (*warnings, *numbers.warnings))


def read_dicom_segments(
    path: Path, *, series: str | None = None
) -> tuple[tuple[Volume, ...], tuple[Segment, ...]] | None:
    """Read the layers and segments of a segmentation; return None for other files and series."""
    source = _read_source(path, series)
    if not source.is_segmentation:
        return None
    layers, segments, warnings = segment_layers(path, source.images)
    return tuple(_with_warnings(layer, warnings, logged=k > 0) for k, layer in enumerate(layers)), segments


def _with_warnings(volume: Volume, warnings: Sequence[str], *, logged: bool = False) -> Volume:
    """Log the first few warnings, and return a volume with these, in place of its own, for the report."""
    shown = tuple(warnings[:MOST_WARNINGS])
    if len(warnings) > MOST_WARNINGS:
        shown = (*shown, f"and {len(warnings) - MOST_WARNINGS} more warnings like these")
    if not logged:
        for line in shown:
            LOG.warning("%s", line)
    return replace(volume, warnings=shown)


def _placement(stack: Stack) -> dict[str, Any]:
    """Return the position of a stack as keywords of `Volume`."""
    return {
        "spacing": stack.spacing,
        "origin": stack.origin,
        "direction": stack.direction,
        "space": stack.frames[0].space,
    }


def _frames_of_source(source: DicomSource, spacing: tuple[float, ...] | None) -> tuple[list[Frame], tuple[str, ...]]:
    """Return the frames of all files with their positions, and warnings about assumptions."""
    frames: list[Frame] = []
    warnings: list[str] = []
    is_slices = len(source.images) > 1 and all(image.count == 1 for image in source.images)
    for image in source.images:
        require_grey(image)
        placed, assumptions = place_frames(image, spacing)
        frames += placed
        warnings += assumptions
    if is_slices and any(frame.position is None or frame.axes is None for frame in frames):
        raise FormatError(f"{source.path} holds slices that do not say where they lie; save the stack as a volume")
    return frames, tuple(warnings)


# --- which files -----------------------------------------------------------------------------------------------


def _read_source(path: Path, series: str | None) -> DicomSource:
    """Read the headers of a file, or of one series in a folder."""
    if not path.is_dir():
        require_pydicom(path.suffix or "DICOM")
        image = read_image(path)
        if image is None:
            raise FormatError(f"{path} holds no pixels; give a file of several slices, or the folder of all slices")
        return DicomSource(path=path, images=(image,))
    require_pydicom("a DICOM folder")
    series_images = _series_of_folder(path)
    if not series_images:
        raise FormatError(f"{path} holds no DICOM series and no .tif or .png slices; give the folder with the slices")
    counts = {uid: sum(image.count for image in images) for uid, images in series_images.items()}
    listed = ", ".join(f"{uid} ({count} slices)" for uid, count in counts.items())
    if series is None and len(series_images) > 1:
        raise FormatError(
            f"{path} holds {len(series_images)} DICOM series, {listed}; "
            f"choose one: --series {next(iter(series_images))}"
        )
    if series is not None and series not in series_images:
        raise FormatError(f"{path} holds no DICOM series {series!r}; it holds {listed}")
    images = series_images[next(iter(series_images)) if series is None else series]
    return DicomSource(path=path, images=tuple(sorted(images, key=lambda image: (image.order, image.path.name))))


def _series_of_folder(folder: Path) -> dict[str, list[Image]]:
    """Return the images in a folder by the UID of their series.

    Reports, plans and other objects without pixels may lie beside them. An unreadable file of the same storage class
    as the images is an error: it is a slice, and without it a part of the volume would be missing.
    """
    images_of: dict[str, list[Image]] = {}
    failed: dict[Path, FormatError | None] = {}
    for path in sorted(entry for entry in folder.iterdir() if entry.is_file()):
        try:
            image = _read_slice(path)
        except FormatError as error:
            failed[path] = error
            continue
        if image is None:
            failed[path] = None
        else:
            images_of.setdefault(image.series, []).append(image)
    storage_classes = {storage_class(image.path) for images in images_of.values() for image in images} - {b""}
    for path, cause in failed.items():
        if storage_class(path) in storage_classes:
            raise FormatError(
                f"{path} is broken or cut off, and its slice would be missing; copy the folder again"
            ) from cause
    return dict(sorted(images_of.items()))


def _read_slice(path: Path) -> Image | None:
    """Return the image in a file of a folder, or None for other files, which may lie there too."""
    if is_dicom(path):
        return read_image(path)
    try:  # some programs leave out the preamble
        image = read_image(path)
    except FormatError:
        return None
    return image if image is not None and image.storage.startswith(UID_ROOT) else None


UID_ROOT = "1.2.840.10008."  # of the UIDs that DICOM defines


def storage_class(path: Path) -> bytes:
    """Return the UID of the kind of a DICOM file, such as CT slices or a report; empty for other files."""
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    tag_position = head.find(STORAGE_CLASS)
    if head[128:132] != b"DICM" or tag_position < 0:
        return b""
    value_position = tag_position + len(STORAGE_CLASS) + 2
    return head[
        value_position : value_position + int.from_bytes(head[value_position - 2 : value_position], "little")
    ].rstrip(b"\0")
