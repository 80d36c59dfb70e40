"""DICOM: a file of several frames, or a folder of files, as a volume or as segments; places decide, not the order."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from infill.errors import FormatError
from infill.files.broken import checked_volume
from infill.imaging.dicom_files import Frame, Image, is_dicom, read_image, require_pydicom
from infill.imaging.dicom_frames import FILES, STORED_ORDER, Stack, placed_frames, stacks_of
from infill.imaging.dicom_pixels import require_grey, values_of
from infill.imaging.dicom_segments import segment_layers, segment_volume
from infill.imaging.frames import chosen
from infill.imaging.label_tables import Segment
from infill.volume import Volume

LOG = logging.getLogger("infill")
MOST_WARNINGS = 5  # of one file
HEAD = 1024  # bytes that contain the storage class
STORAGE_CLASS = b"\x02\x00\x02\x00UI"  # tag (0002,0002), little-endian like the rest of that header


@dataclass(frozen=True, kw_only=True)
class Source:
    """The files of one series.

    Parameters
    ----------
    path : Path
        The file or the folder that was given, for messages.
    images : tuple of Image
    """

    path: Path
    images: tuple[Image, ...]

    @property
    def is_segmentation(self) -> bool:
        """Whether all files are segmentations."""
        return all(image.segments is not None for image in self.images)


def read_dicom(
    path: Path,
    frame: int | None = None,
    *,
    series: str | None = None,
    spacing: tuple[float, ...] | None = None,
) -> Volume:
    """Return the volume that a file or a series in a folder holds, or one of several.

    Parameters
    ----------
    path : Path
    frame : int, optional
        Which of several volumes, counted from 0.
    series : str, optional
        UID of the series, if a folder holds several.
    spacing : (hx, hy, hz), optional
        Size of a cell, mm, for files that say none.

    Raises
    ------
    FormatError, MemoryLimitError, ParameterError
        See `infill.read_volume`.
    """
    source = _source(path, series)
    if source.is_segmentation:
        return _with_warnings(*segment_volume(path, source.images, frame))
    frames, warnings = _placed(source, spacing)
    if len(frames) == 1 or (all(each.count == 1 for each in source.images) and len(source.images) == 1):
        rows, columns = frames[0].shape
        raise FormatError(
            f"{path} is a single slice, {columns} x {rows} x 1 cells; give the folder of all slices, or a volume"
        )
    found = stacks_of(path, frames)
    sizes = sorted({len(stack.frames) for stack in found.stacks})
    counts = f"{sizes[0]}" if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    what = f"holds {len(found.stacks)} volumes of {counts} slices, told apart by {found.apart}"
    at = chosen(path, frame, len(found.stacks), what=what)
    if found.apart in (STORED_ORDER, FILES):
        warnings = (*warnings, f"{path}: frame {at} is told from the others by {found.apart}")
    stack = found.stacks[at]
    numbers = values_of(source.images, stack.frames)
    volume = checked_volume(path, numbers.values.T, **_place(stack))
    return _with_warnings(volume, (*warnings, *numbers.warnings))


def read_dicom_segments(
    path: Path, *, series: str | None = None
) -> tuple[tuple[Volume, ...], tuple[Segment, ...]] | None:
    """Return the layers of a segmentation and its segments; None if the file or the series is none."""
    source = _source(path, series)
    if not source.is_segmentation:
        return None
    layers, segments, warnings = segment_layers(path, source.images)
    return tuple(_with_warnings(layer, warnings, again=k > 0) for k, layer in enumerate(layers)), segments


def _with_warnings(volume: Volume, warnings: Sequence[str], *, again: bool = False) -> Volume:
    """Log warnings, and return a volume that carries them to the report."""
    told = tuple(warnings[:MOST_WARNINGS])
    if len(warnings) > MOST_WARNINGS:
        told = (*told, f"and {len(warnings) - MOST_WARNINGS} more warnings like these")
    if not again:
        for line in told:
            LOG.warning("%s", line)
    return replace(volume, warnings=told)


def _place(stack: Stack) -> dict[str, Any]:
    return {
        "spacing": stack.spacing,
        "origin": stack.origin,
        "direction": stack.direction,
        "space": stack.frames[0].space,
    }


def _placed(source: Source, spacing: tuple[float, ...] | None) -> tuple[list[Frame], tuple[str, ...]]:
    """Return the frames of all files with their places, and what had to be assumed."""
    frames: list[Frame] = []
    warnings: list[str] = []
    single = len(source.images) > 1 and all(image.count == 1 for image in source.images)
    for image in source.images:
        require_grey(image)
        found, said = placed_frames(image, spacing)
        frames += found
        warnings += said
    if single and any(frame.position is None or frame.axes is None for frame in frames):
        raise FormatError(f"{source.path} holds slices that do not say where they lie; save the stack as a volume")
    return frames, tuple(warnings)


# --- which files -----------------------------------------------------------------------------------------------


def _source(path: Path, series: str | None) -> Source:
    if not path.is_dir():
        require_pydicom(path.suffix or "DICOM")
        image = read_image(path)
        if image is None:
            raise FormatError(f"{path} holds no pixels; give a file of several slices, or the folder of all slices")
        return Source(path=path, images=(image,))
    require_pydicom("a DICOM folder")
    found = _series(path)
    if not found:
        raise FormatError(f"{path} holds no DICOM series and no .tif or .png slices; give the folder with the slices")
    counts = {uid: sum(image.count for image in images) for uid, images in found.items()}
    listed = ", ".join(f"{uid} ({count} slices)" for uid, count in counts.items())
    if series is None and len(found) > 1:
        raise FormatError(f"{path} holds {len(found)} DICOM series, {listed}; choose one: --series {next(iter(found))}")
    if series is not None and series not in found:
        raise FormatError(f"{path} holds no DICOM series {series!r}; it holds {listed}")
    images = found[next(iter(found)) if series is None else series]
    return Source(path=path, images=tuple(sorted(images, key=lambda image: (image.order, image.path.name))))


def _series(folder: Path) -> dict[str, list[Image]]:
    """Return the images in a folder by the UID of their series.

    Reports, plans and other objects without pixels may lie beside them. A file that cannot be read and is of the same
    kind as others is one of the slices: without it, a part of the volume would be missing.
    """
    found: dict[str, list[Image]] = {}
    failed: dict[Path, FormatError | None] = {}
    for path in sorted(each for each in folder.iterdir() if each.is_file()):
        try:
            image = _slice(path)
        except FormatError as error:
            failed[path] = error
            continue
        if image is None:
            failed[path] = None
        else:
            found.setdefault(image.series, []).append(image)
    kinds = {storage_class(image.path) for images in found.values() for image in images} - {b""}
    for path, reason in failed.items():
        if storage_class(path) in kinds:
            raise FormatError(
                f"{path} is broken or cut off, and its slice would be missing; copy the folder again"
            ) from reason
    return dict(sorted(found.items()))


def _slice(path: Path) -> Image | None:
    """Return the image in a file of a folder; None for anything else, which may lie there too."""
    if is_dicom(path):
        return read_image(path)
    try:  # some programs leave out the preamble
        image = read_image(path)
    except FormatError:
        return None
    return image if image is not None and image.storage.startswith(UID_ROOT) else None


UID_ROOT = "1.2.840.10008."  # of what DICOM itself names


def storage_class(path: Path) -> bytes:
    """Return the UID that says what a DICOM file holds, such as CT slices or a report; empty for other files."""
    with path.open("rb") as file:
        head = file.read(HEAD)
    at = head.find(STORAGE_CLASS)
    if head[128:132] != b"DICM" or at < 0:
        return b""
    begin = at + len(STORAGE_CLASS) + 2
    return head[begin : begin + int.from_bytes(head[begin - 2 : begin], "little")].rstrip(b"\0")
