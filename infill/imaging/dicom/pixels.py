"""Numbers of DICOM frames: decompressed, scaled frame by frame, with padding removed."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE
from infill.imaging.dicom.elements import clean_text
from infill.imaging.dicom.headers import Image, Pixels, inflate, wrap_pydicom_errors
from infill.imaging.dicom.places import Frame
from infill.imaging.medical import unpacked_frames
from infill.machine import require_memory
from infill.plain_numbers import plain_argument

INTEGER_TYPES = (np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64)
PLAIN_STORAGE = "1.2.840.10008.5.1.4.1.1.7.3"  # a multi-frame secondary capture, which holds only pixels
EXACT_BITS = 16  # of stored numbers that float32 holds exactly, with some to spare for a scale


@dataclass(frozen=True, kw_only=True)
class FrameValues:
    """Values of frames.

    Parameters
    ----------
    values : (frames, rows, columns) array
    warnings : tuple of str
        Messages of the reader of compressed frames, and notes on omissions.
    """

    values: NDArray[Any]
    warnings: tuple[str, ...] = ()


def require_grey(image: Image) -> None:
    """Raise FormatError for colours."""
    if not image.frames:
        raise FormatError(f"{image.path} holds colours ({image.photometric}); save it as grey values")


def stored_numbers(image: Image) -> FrameValues:
    """Return the stored numbers of all frames, in the order of the file.

    Raises
    ------
    FormatError
        If the frames are broken, or packed in a way that SimpleITK does not know.
    MemoryLimitError
    """
    require_grey(image)
    pixels, shape = image.pixels, (image.count, *image.frames[0].shape)
    if pixels.length is None:
        return _unpack_together([image])[image.path]
    require_memory(2 * math.prod(shape) * max(1, pixels.allocated // 8), None, SMALLER_VOLUME_ADVICE)
    content = np.frombuffer(_read_plain_pixels(image), dtype=np.uint8)
    return FrameValues(values=_numbers_of_bytes(content, pixels, math.prod(shape)).reshape(shape))


def _unpack_together(images: Sequence[Image]) -> dict[Path, FrameValues]:
    """Decompress files with similar frames in one call; return their stored numbers by path."""
    template = images[0]
    path = template.path if len(images) == 1 else template.path.parent
    shape = (sum(image.count for image in images), *template.frames[0].shape)
    require_memory(2 * math.prod(shape) * max(1, template.pixels.allocated // 8), None, SMALLER_VOLUME_ADVICE)
    with tempfile.TemporaryDirectory(prefix="infill-") as folder:
        plain = Path(folder) / "frames.dcm"
        _write_packed_frames(images, plain)
        values, messages = unpacked_frames(plain, path)
    if values.shape != shape:
        raise FormatError(f"{path} holds frames {values.shape} and says {shape}; save it again")
    warnings = tuple(f"{path}: {clean_text(line)} (while unpacking)" for line in messages)
    numbers_of, begin = {}, 0
    for image in images:
        numbers_of[image.path] = FrameValues(values=values[begin : begin + image.count], warnings=warnings)
        begin += image.count
    return numbers_of


def _numbers_of_bytes(content: NDArray[np.uint8], pixels: Pixels, count: int) -> NDArray[Any]:
    """Convert the bytes of a file to numbers: the used bits, with their sign."""
    order = "<" if pixels.little else ">"
    if pixels.allocated <= 8 and not pixels.little and pixels.words:  # bytes were written as words
        content = content[: len(content) // 2 * 2].reshape(-1, 2)[:, ::-1].reshape(-1)
    if pixels.allocated == 1:
        return np.unpackbits(content, count=count, bitorder="little")
    if pixels.real:
        return np.frombuffer(content, dtype=order + pixels.real, count=count).astype(pixels.real)
    size = pixels.allocated // 8
    kind = np.dtype(f"{'i' if pixels.signed else 'u'}{size}")
    numbers: NDArray[Any] = np.frombuffer(content, dtype=f"{order}{kind.kind}{size}", count=count).astype(
        kind, copy=False
    )
    if pixels.stored == pixels.allocated:
        return numbers
    # Unused bits may hold anything, such as an overlay: shift them out, and the sign in.
    return (numbers << (pixels.allocated - 1 - pixels.high)) >> (pixels.allocated - pixels.stored)


def frame_values(images: Sequence[Image], frames: Sequence[Frame]) -> FrameValues:
    """Return the values of frames, in their order: the stored numbers, each scaled by its frame.

    Parameters
    ----------
    images : sequence of Image
        The files that hold them.
    frames : sequence of Frame

    Notes
    -----
    Numbers stay integers if all scales are integers, and become floating-point numbers otherwise. Frames of MONOCHROME1
    are not inverted: only their display is, and the stored numbers are the values. Low padding stays; padding in the
    upper half of the other values would count as solid, and becomes the lowest of them.
    """
    paths = {frame.path for frame in frames}
    by_path = {image.path: image for image in images if image.path in paths}
    dtype = _smallest_type(by_path, frames)
    rows, columns = frames[0].shape
    require_memory(len(frames) * rows * columns * dtype.itemsize, None, SMALLER_VOLUME_ADVICE)
    values = np.empty((len(frames), rows, columns), dtype=dtype)
    padded: list[tuple[int, NDArray[np.bool_]]] = []
    warnings: list[str] = []
    unpacked: dict[Path, FrameValues] = {}
    for path in dict.fromkeys(frame.path for frame in frames):
        image = by_path[path]
        if path not in unpacked and image.pixels.length is None:
            require_grey(image)
            unpacked |= _unpack_together([similar for similar in by_path.values() if _is_packed_alike(image, similar)])
        stored = unpacked.pop(path) if path in unpacked else stored_numbers(image)
        warnings += [line for line in stored.warnings if line not in warnings]
        for k, frame in enumerate(frames):
            if frame.path != path:
                continue
            numbers = stored.values[frame.number]
            if image.padding is not None:
                mask = (numbers >= image.padding[0]) & (numbers <= image.padding[1])
                if mask.any():
                    padded.append((k, mask))
            values[k] = _scale(numbers, image, frame, dtype)
    warnings += _replace_padding(values, padded, frames[0].path)
    return FrameValues(values=values, warnings=tuple(warnings))


def _is_packed_alike(image: Image, reference: Image) -> bool:
    """Tell whether the frames of two files can be decompressed together."""
    if not reference.frames or image.frames[0].shape != reference.frames[0].shape:
        return False
    return replace(image.pixels, begin=0) == replace(reference.pixels, begin=0)


def _scale(numbers: NDArray[Any], image: Image, frame: Frame, dtype: np.dtype[Any]) -> NDArray[Any]:
    """Scale the stored numbers of a frame to values."""
    if image.table is not None:
        first_number, table = image.table
        return table[np.clip(numbers.astype(np.int64) - first_number, 0, len(table) - 1)]
    if frame.slope == 1 and frame.intercept == 0:
        return numbers
    if dtype.kind != "f":
        return numbers.astype(np.int64) * int(frame.slope) + int(frame.intercept)
    return numbers * np.float64(frame.slope) + np.float64(frame.intercept)


def _smallest_type(images: dict[Path, Image], frames: Sequence[Frame]) -> np.dtype[Any]:
    """Return the smallest type that holds the values of all frames."""
    used_images = [images[path] for path in dict.fromkeys(frame.path for frame in frames)]
    if any(image.pixels.real == "f8" for image in used_images):
        return np.dtype(np.float64)
    scales = {(images[frame.path].path, frame.slope, frame.intercept) for frame in frames}
    is_whole = all(slope == int(slope) and intercept == int(intercept) for _, slope, intercept in scales)
    is_whole = is_whole and all(image.table is None or (image.table[1] % 1 == 0).all() for image in used_images)
    if not is_whole or any(image.pixels.real for image in used_images):
        is_exact = all(image.pixels.allocated <= EXACT_BITS or image.pixels.real == "f4" for image in used_images)
        return np.dtype(np.float32 if is_exact else np.float64)
    ends: list[int] = []
    for path, slope, intercept in scales:
        image = images[path]
        if image.table is not None:
            ends += [int(image.table[1].min()), int(image.table[1].max())]
            continue
        bits = image.pixels.stored
        low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if image.pixels.signed else (0, 2**bits - 1)
        ends += [low * int(slope) + int(intercept), high * int(slope) + int(intercept)]
    for dtype in INTEGER_TYPES:
        if np.iinfo(dtype).min <= min(ends) and max(ends) <= np.iinfo(dtype).max:
            return np.dtype(dtype)
    return np.dtype(np.float64)


def _replace_padding(values: NDArray[Any], padded: list[tuple[int, NDArray[np.bool_]]], path: Path) -> tuple[str, ...]:
    """Set padding in the upper half of the values to the lowest value; return a warning if that changed cells."""
    if not padded:
        return ()
    masks = dict(padded)
    real_values = [values[k][~masks[k]] if k in masks else values[k] for k in range(len(values))]
    extremes = [(float(array.min()), float(array.max())) for array in real_values if array.size]
    highest = max(float(values[k][mask].max()) for k, mask in padded)
    lowest = min((low for low, _ in extremes), default=highest)
    if 2 * highest <= lowest + max((high for _, high in extremes), default=highest):
        return ()
    count = sum(int(mask.sum()) for _, mask in padded)
    for k, mask in padded:
        values[k][mask] = lowest
    return (
        f"{path}: {count} cells hold a value for no pixel (up to {plain_argument(highest)}); they are taken as "
        f"{plain_argument(lowest)}",
    )


def _read_plain_pixels(image: Image) -> memoryview:
    """Read the bytes of frames that are not compressed one by one."""
    pixels = image.pixels
    assert pixels.length is not None
    with wrap_pydicom_errors(image.path):
        if pixels.deflated:
            return memoryview(inflate(image.path))[pixels.begin : pixels.begin + pixels.length]
        with image.path.open("rb") as file:
            file.seek(pixels.begin)
            return memoryview(file.read(pixels.length))


def _write_packed_frames(images: Sequence[Image], target: Path) -> None:
    """Write the compressed frames of similar files into one file without any further information.

    So a reader decompresses the stored values in their order, and it is called once for all slices of a folder.
    """
    from pydicom import Dataset, dcmwrite
    from pydicom.dataset import FileMetaDataset
    from pydicom.encaps import encapsulate

    template = images[0]
    packed = [frame for image in images for frame in _packed_frames(image)]
    plain, pixels = Dataset(), template.pixels
    with wrap_pydicom_errors(template.path):
        plain.file_meta = FileMetaDataset()
        plain.file_meta.TransferSyntaxUID = pixels.syntax  # type: ignore[assignment]
        plain.file_meta.MediaStorageSOPClassUID = plain.SOPClassUID = PLAIN_STORAGE  # type: ignore[assignment]
        plain.file_meta.MediaStorageSOPInstanceUID = plain.SOPInstanceUID = "2.25.1"  # type: ignore[assignment]
        plain.Rows, plain.Columns = template.frames[0].shape
        plain.NumberOfFrames = len(packed)
        plain.SamplesPerPixel, plain.PhotometricInterpretation = 1, "MONOCHROME2"
        plain.BitsAllocated, plain.BitsStored, plain.HighBit = pixels.allocated, pixels.stored, pixels.high
        plain.PixelRepresentation = int(pixels.signed)
        plain.PixelData = encapsulate(packed)
        plain["PixelData"].VR = "OB"
        plain["PixelData"].is_undefined_length = True
        dcmwrite(target, plain, enforce_file_format=True)


def _packed_frames(image: Image) -> list[bytes]:
    """Return the compressed frames of a file."""
    from pydicom.encaps import generate_frames

    with wrap_pydicom_errors(image.path), image.path.open("rb") as file:
        file.seek(image.pixels.begin)
        packed = list(generate_frames(file, number_of_frames=image.count))
        if len(packed) != image.count:
            raise ValueError(f"{len(packed)} frames of {image.count}")
        return packed
