"""The numbers in the frames of DICOM files: unpacked, scaled frame by frame, padding taken out."""

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
from infill.files.broken import SMALLER
from infill.imaging.dicom_files import Frame, Image, Pixels, plain_bytes, printable, write_packed_frames
from infill.imaging.medical import unpacked_frames
from infill.machine import require_memory

WHOLE = (np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64)
EXACT_BITS = 16  # of stored numbers that float32 holds exactly, with some to spare for a scale


@dataclass(frozen=True, kw_only=True)
class Numbers:
    """Values of frames.

    Parameters
    ----------
    values : (frames, rows, columns) array
    warnings : tuple of str
        What the reader of packed frames said, and what was left out.
    """

    values: NDArray[Any]
    warnings: tuple[str, ...] = ()


def require_grey(image: Image) -> None:
    """Raise FormatError for colours."""
    if not image.frames:
        raise FormatError(f"{image.path} holds colours ({image.photometric}); save it as grey values")


def stored_numbers(image: Image) -> Numbers:
    """Return the numbers of all frames as they are stored, in the order of the file.

    Raises
    ------
    FormatError
        If the frames are broken, or packed in a way that SimpleITK does not know.
    MemoryLimitError
    """
    require_grey(image)
    pixels, shape = image.pixels, (image.count, *image.frames[0].shape)
    if pixels.length is None:
        return _unpacked_together([image])[image.path]
    require_memory(2 * math.prod(shape) * max(1, pixels.allocated // 8), None, SMALLER)
    held = np.frombuffer(plain_bytes(image), dtype=np.uint8)
    return Numbers(values=_of_bytes(held, pixels, math.prod(shape)).reshape(shape))


def _unpacked_together(images: Sequence[Image]) -> dict[Path, Numbers]:
    """Return the stored numbers of files whose frames are packed one by one, and in the same way."""
    first = images[0]
    path = first.path if len(images) == 1 else first.path.parent
    shape = (sum(image.count for image in images), *first.frames[0].shape)
    require_memory(2 * math.prod(shape) * max(1, first.pixels.allocated // 8), None, SMALLER)
    with tempfile.TemporaryDirectory(prefix="infill-") as folder:
        plain = Path(folder) / "frames.dcm"
        write_packed_frames(images, plain)
        values, said = unpacked_frames(plain, path)
    if values.shape != shape:
        raise FormatError(f"{path} holds frames {values.shape} and says {shape}; save it again")
    warnings = tuple(f"{path}: {printable(line)} (while unpacking)" for line in said)
    found, begin = {}, 0
    for image in images:
        found[image.path] = Numbers(values=values[begin : begin + image.count], warnings=warnings)
        begin += image.count
    return found


def _of_bytes(held: NDArray[np.uint8], pixels: Pixels, count: int) -> NDArray[Any]:
    """Return the numbers in the bytes of a file: of the bits that are used, with their sign."""
    order = "<" if pixels.little else ">"
    if pixels.allocated <= 8 and not pixels.little and pixels.words:  # bytes were written as words
        held = held[: len(held) // 2 * 2].reshape(-1, 2)[:, ::-1].reshape(-1)
    if pixels.allocated == 1:
        return np.unpackbits(held, count=count, bitorder="little")
    if pixels.real:
        return np.frombuffer(held, dtype=order + pixels.real, count=count).astype(pixels.real)
    size = pixels.allocated // 8
    kind = np.dtype(f"{'i' if pixels.signed else 'u'}{size}")
    numbers: NDArray[Any] = np.frombuffer(held, dtype=f"{order}{kind.kind}{size}", count=count).astype(kind, copy=False)
    if pixels.stored == pixels.allocated:
        return numbers
    # Bits that are not used may hold anything, such as an overlay: push them out, and the sign in.
    return (numbers << (pixels.allocated - 1 - pixels.high)) >> (pixels.allocated - pixels.stored)


def values_of(images: Sequence[Image], frames: Sequence[Frame]) -> Numbers:
    """Return the values of frames, in their order: the numbers that are stored, each scaled as its frame says.

    Parameters
    ----------
    images : sequence of Image
        The files that hold them.
    frames : sequence of Frame

    Notes
    -----
    Numbers stay whole if all scales are, and become floating-point numbers otherwise. Frames of MONOCHROME1 are not
    turned into their negative: that is how they are shown, and their values are what is stored. Padding stays where it
    lies low; in the upper half of the other values it would count as solid, and becomes the least of them.
    """
    wanted = {frame.path for frame in frames}
    by_path = {image.path: image for image in images if image.path in wanted}
    kind = _kind(by_path, frames)
    rows, columns = frames[0].shape
    require_memory(len(frames) * rows * columns * kind.itemsize, None, SMALLER)
    found = np.empty((len(frames), rows, columns), dtype=kind)
    padded: list[tuple[int, NDArray[np.bool_]]] = []
    warnings: list[str] = []
    unpacked: dict[Path, Numbers] = {}
    for path in dict.fromkeys(frame.path for frame in frames):
        image = by_path[path]
        if path not in unpacked and image.pixels.length is None:
            require_grey(image)
            unpacked |= _unpacked_together([each for each in by_path.values() if _is_packed_alike(image, each)])
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
            found[k] = _scaled(numbers, image, frame, kind)
    warnings += _without_padding(found, padded, frames[0].path)
    return Numbers(values=found, warnings=tuple(warnings))


def _is_packed_alike(one: Image, other: Image) -> bool:
    """Return whether the frames of two files can be unpacked together."""
    if not other.frames or one.frames[0].shape != other.frames[0].shape:
        return False
    return replace(one.pixels, begin=0) == replace(other.pixels, begin=0)


def _scaled(numbers: NDArray[Any], image: Image, frame: Frame, kind: np.dtype[Any]) -> NDArray[Any]:
    if image.table is not None:
        first, table = image.table
        return table[np.clip(numbers.astype(np.int64) - first, 0, len(table) - 1)]
    if frame.slope == 1 and frame.intercept == 0:
        return numbers
    if kind.kind != "f":
        return numbers.astype(np.int64) * int(frame.slope) + int(frame.intercept)
    return numbers * np.float64(frame.slope) + np.float64(frame.intercept)


def _kind(images: dict[Path, Image], frames: Sequence[Frame]) -> np.dtype[Any]:
    """Return the smallest type that holds the values of all frames."""
    used = [images[path] for path in dict.fromkeys(frame.path for frame in frames)]
    if any(image.pixels.real == "f8" for image in used):
        return np.dtype(np.float64)
    scales = {(images[frame.path].path, frame.slope, frame.intercept) for frame in frames}
    whole = all(slope == int(slope) and intercept == int(intercept) for _, slope, intercept in scales)
    whole = whole and all(image.table is None or (image.table[1] % 1 == 0).all() for image in used)
    if not whole or any(image.pixels.real for image in used):
        fine = all(image.pixels.allocated <= EXACT_BITS or image.pixels.real == "f4" for image in used)
        return np.dtype(np.float32 if fine else np.float64)
    ends: list[int] = []
    for path, slope, intercept in scales:
        image = images[path]
        if image.table is not None:
            ends += [int(image.table[1].min()), int(image.table[1].max())]
            continue
        bits = image.pixels.stored
        low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if image.pixels.signed else (0, 2**bits - 1)
        ends += [low * int(slope) + int(intercept), high * int(slope) + int(intercept)]
    for each in WHOLE:
        if np.iinfo(each).min <= min(ends) and max(ends) <= np.iinfo(each).max:
            return np.dtype(each)
    return np.dtype(np.float64)


def _without_padding(values: NDArray[Any], padded: list[tuple[int, NDArray[np.bool_]]], path: Path) -> tuple[str, ...]:
    """Set padding to the least of the other values, if it lies in their upper half; return what there is to say."""
    if not padded:
        return ()
    masks = dict(padded)
    others = [values[k][~masks[k]] if k in masks else values[k] for k in range(len(values))]
    ends = [(float(each.min()), float(each.max())) for each in others if each.size]
    highest = max(float(values[k][mask].max()) for k, mask in padded)
    least = min((low for low, _ in ends), default=highest)
    if 2 * highest <= least + max((high for _, high in ends), default=highest):
        return ()
    count = sum(int(mask.sum()) for _, mask in padded)
    for k, mask in padded:
        values[k][mask] = least
    return (f"{path}: {count} cells hold a value for no pixel (up to {highest:g}); they are taken as {least:g}",)
