"""Stacks of images: a multi-page TIFF, or a folder of .tif or .png slices; pages are z, rows y, columns x."""

from __future__ import annotations

import contextlib
import logging
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, error_text, wrap_reader_errors
from infill.imaging.assumed import LOG, warn
from infill.imaging.checked_volume import checked_volume
from infill.imaging.images import CELL_SIZE_PHRASE, scales_of
from infill.machine import require_memory
from infill.plain_numbers import plain_argument
from infill.volume import AXES, Volume

SLICE_SUFFIXES = {".tif", ".tiff", ".png"}
UNCOMPRESSED = 1
GREY_MODES = {"1", "L", "I", "I;16", "I;16L", "I;16B", "F"}
# Units of sizes that were not measured: pixels or cells.
CELL_UNITS = {"", "pixel", "pixels", "px", "voxel", "voxels", "unitless", "reference frame", "none", "null", "?"}
RESOLUTIONS = {2: "inch", 3: "cm"}
DEFAULT_DPI = {72, 96}  # per inch: defaults of programs without a real size
DPI_TOLERANCE = 0.01  # of an inch's dots


@contextlib.contextmanager
def _raise_complaints(path: Path) -> Iterator[None]:
    """Raise FormatError for problems that tifffile only logs, such as missing pages of a truncated file."""
    complaints: list[str] = []

    def collect(record: logging.LogRecord) -> bool:
        """Collect the text of an error; let no record through."""
        if record.levelno >= logging.ERROR:
            complaints.append(record.getMessage())
        return False

    logger = logging.getLogger("tifffile")
    logger.addFilter(collect)
    try:
        yield
    finally:
        logger.removeFilter(collect)
    if complaints:
        complaint = " ".join(complaints[0].split())
        raise FormatError(f"{path} is broken or cut off ({complaint}); save it again")


def read_tiff(path: Path) -> Volume:
    """Read a stack of pages as a volume, with the stated cell size."""
    pages, spacing = _read_tiff_pages(path)
    return checked_volume(path, pages.T, spacing=spacing)


def _read_tiff_pages(path: Path, *, with_spacing: bool = True) -> tuple[NDArray[Any], tuple[float, ...]]:
    """Read grey pages [(z,) y, x]; return them and, if asked for, the cell size along x, y, z."""
    import tifffile

    with _raise_complaints(path), wrap_reader_errors(path), tifffile.TiffFile(path) as tiff:
        series = _only_series(path, tiff)
        require_memory(series.nbytes, None, SMALLER_VOLUME_ADVICE)
        _require_whole_pages(path, series)
        return series.asarray(), _tiff_spacing(path, tiff) if with_spacing else ()


@dataclass(frozen=True, kw_only=True)
class TiffStack:
    """The pages of a TIFF, of which none is read yet.

    Parameters
    ----------
    shape : (z, y, x) or (y, x)
    kind : dtype
    spacing : (hx, hy, hz), mm
    begin : int or None
        Position of the first cell, bytes, if all cells follow it without compression.
    """

    shape: tuple[int, ...]
    kind: np.dtype[Any]
    spacing: tuple[float, ...]
    begin: int | None


def locate_tiff(path: Path) -> TiffStack:
    """Return the shape of a stack of grey pages, and where its cells lie if they are not compressed.

    Raises
    ------
    FormatError
        As `read_tiff`.
    """
    import tifffile

    with _raise_complaints(path), wrap_reader_errors(path), tifffile.TiffFile(path) as tiff:
        series = _only_series(path, tiff)
        begin = series.dataoffset if series.keyframe.is_memmappable else None
        kind = np.dtype(f"{tiff.byteorder}{series.dtype.str[1:]}") if begin is not None else np.dtype(series.dtype)
        return TiffStack(shape=tuple(series.shape), kind=kind, spacing=_tiff_spacing(path, tiff), begin=begin)


def read_tiff_pages(path: Path, low: int, high: int) -> NDArray[Any]:
    """Read pages `low` to `high - 1` of a stack, [z, y, x]; the only page of a file without a stack is page 0."""
    import tifffile

    with _raise_complaints(path), wrap_reader_errors(path), tifffile.TiffFile(path) as tiff:
        series = _only_series(path, tiff)
        if len(series.shape) == 2:
            return np.asarray(series.asarray())[None]
        if len(series.pages) == 1:  # one page holds all of the stack, as ImageJ writes it
            return np.asarray(series.asarray()[low:high])
        return np.stack([series.pages[number].asarray() for number in range(low, high)])


def _only_series(path: Path, tiff: Any) -> Any:  # noqa: ANN401 - of tifffile
    """Return the only series of grey pages of a file, checked."""
    series = tiff.series
    if not series:
        raise FormatError(f"{path} holds no pages; save it again")
    if len(series) > 1:
        shapes = ", ".join(str(series_item.shape) for series_item in series[:4])
        raise FormatError(f"{path} holds pages of different kinds, {shapes}; save one stack of equal pages")
    axes, shape = series[0].axes, series[0].shape
    if "S" in axes or "C" in axes:
        raise FormatError(f"{path} holds colours or channels (axes {axes}, shape {shape}); save one of them as grey")
    if len(shape) > AXES:
        raise FormatError(f"{path} has {len(shape)} axes ({axes}, shape {shape}); save one stack of it")
    return series[0]


def _require_whole_pages(path: Path, series: Any) -> None:  # noqa: ANN401 - tifffile.TiffPageSeries
    """Raise FormatError for missing pages or pieces of pages, which tifffile would fill with zeros."""
    for number, page in enumerate(series.pages):
        if page is None:
            raise FormatError(f"{path} lacks page {number} of its series; save it again")
        counts, keyframe = page.databytecounts, page.keyframe
        if not keyframe.nbytes:
            raise FormatError(f"{path} has a page {number} without cells; save it again")
        if not counts or min(counts) <= 0 or min(page.dataoffsets) <= 0:
            raise FormatError(f"{path} lacks a piece of its page {number}; save it again")
        if keyframe.compression == UNCOMPRESSED and not keyframe.is_tiled:
            row_bytes = keyframe.nbytes / keyframe.imagelength
            padded = row_bytes * keyframe.rowsperstrip * len(counts)  # the last strip may be as long as all others
            if not keyframe.nbytes <= sum(counts) <= max(padded, keyframe.nbytes):
                raise FormatError(
                    f"{path} announces {keyframe.nbytes} bytes for page {number} and holds {sum(counts)}; save it again"
                )


def _tiff_spacing(path: Path, tiff: Any) -> tuple[float, ...]:  # noqa: ANN401 - tifffile.TiffFile
    """Return the cell size along x, y, z, mm, by OME, ImageJ or the printing resolution; by default 1."""
    if tiff.ome_metadata:
        return _ome_spacing(path, tiff.ome_metadata)
    page = tiff.pages[0]
    per_cell = [_cell_length(page, name) for name in ("XResolution", "YResolution")]
    unit_code = getattr(page.tags.get("ResolutionUnit"), "value", 0)
    stated = RESOLUTIONS.get(int(unit_code), "") if isinstance(unit_code, int) else ""
    metadata = tiff.imagej_metadata
    if metadata is None:
        if not stated:
            return (1.0,) * AXES
        return _spacing_from_print(path, per_cell, stated)
    unit = str(metadata.get("unit", "")).strip()
    if unit.lower() in CELL_UNITS and stated and not _is_default_resolution(per_cell, stated):
        unit = stated  # as ImageJ itself does
    units = [unit, *(str(metadata.get(f"{axis}unit", unit)) for axis in "yz")]
    depth = metadata.get("spacing")
    sizes = [*per_cell, None if depth is None else _positive_or_none(depth)]
    if unit.lower() in CELL_UNITS and sizes[:2] in ([None, None], [1.0, 1.0]) and sizes[2] in (None, 1.0):
        return (1.0,) * AXES  # nothing was measured
    scales = scales_of(path, units, CELL_SIZE_PHRASE, "xyz")
    missing = [axis for axis, size in zip("xyz", sizes, strict=True) if size is None]
    if missing and (len(tiff.pages) > 1 or int(metadata.get("images", 1)) > 1 or missing != ["z"]):
        warn(
            "%s does not say the size of its cells along %s; 1 %s is taken, as ImageJ does: unless --spacing gives it",
            path,
            " and ".join(missing),
            unit or "mm",
        )
    return tuple(scale * (1.0 if size is None else size) for scale, size in zip(scales, sizes, strict=True))


def _ome_spacing(path: Path, text: str) -> tuple[float, ...]:
    """Return the cell size of OME; an axis without one takes that of another axis."""
    # Only attributes are read, and the standard parser fetches nothing from outside.
    pixels = ElementTree.fromstring(text).find(".//{*}Pixels")  # noqa: S314
    if pixels is None:
        return (1.0,) * AXES
    stated = [_positive_or_none(pixels.get(f"PhysicalSize{axis}")) for axis in "XYZ"]
    units = [
        "" if size is None else pixels.get(f"PhysicalSize{axis}Unit", "µm")
        for axis, size in zip("XYZ", stated, strict=True)
    ]
    scales = scales_of(path, units, CELL_SIZE_PHRASE, "xyz")
    sizes = [None if size is None else size * scale for size, scale in zip(stated, scales, strict=True)]
    return _fill_missing_sizes(path, sizes, (pixels.get("SizeZ") or "1") != "1")


def _spacing_from_print(path: Path, per_cell: list[float | None], unit: str) -> tuple[float, ...]:
    """Return the cell size, mm, from a resolution for printing: z is taken as x, and a default resolution as 1 mm."""
    if _is_default_resolution(per_cell, unit):
        LOG.info(
            "%s has a default resolution in dots per inch, not a real size; cells of 1 mm are assumed, unless "
            "--spacing gives others",
            path,
        )
        return (1.0,) * AXES
    scale = scales_of(path, [unit], CELL_SIZE_PHRASE, "x")[0]
    return _fill_missing_sizes(path, [*(None if size is None else size * scale for size in per_cell), None], True)


def _fill_missing_sizes(path: Path, sizes: list[float | None], has_depth: bool) -> tuple[float, ...]:
    """Replace missing sizes, mm, by another one, with a warning."""
    known_sizes = [size for size in sizes if size is not None]
    if not known_sizes:
        return (1.0,) * AXES
    missing = [axis for axis, size in zip("xyz", sizes, strict=True) if size is None]
    if missing and (has_depth or missing != ["z"]):
        warn(
            "%s does not say the size of its cells along %s; %s mm is taken, as along another axis, unless --spacing "
            "gives it",
            path,
            " and ".join(missing),
            plain_argument(known_sizes[0]),
        )
    return tuple(known_sizes[0] if size is None else size for size in sizes)


def _cell_length(page: Any, name: str) -> float | None:  # noqa: ANN401 - tifffile.TiffPage
    """Return the cell length by a resolution, a fraction of cells per length; None if there is none."""
    fraction = getattr(page.tags.get(name), "value", None)
    if not isinstance(fraction, tuple) or len(fraction) != 2 or not fraction[0]:
        return None
    return float(fraction[1]) / float(fraction[0])


def _is_default_resolution(per_cell: list[float | None], unit: str) -> bool:
    """Tell whether a resolution is a default of programs without a real size."""
    inches = 1.0 if unit == "inch" else 2.54
    return all(
        not size or any(abs(inches / size - dots) < DPI_TOLERANCE * dots for dots in DEFAULT_DPI) for size in per_cell
    )


def _positive_or_none(value: Any) -> float | None:  # noqa: ANN401 - a number or a text
    """Return the absolute value of a number; None for 0 and for anything else."""
    try:
        number = abs(float(value))
    except (TypeError, ValueError):
        return None
    return number if 0 < number < math.inf else None


def read_slices(folder: Path, names: list[Path]) -> Volume:
    """Read a volume with one file per slice, in the order of the names."""
    pages: NDArray[Any] | None = None
    spacing = (1.0,) * AXES
    for number, name in enumerate(names):
        page, sizes = (
            _read_png(name) if name.suffix.lower() == ".png" else _read_tiff_pages(name, with_spacing=number == 0)
        )
        if page.ndim != 2:
            raise FormatError(f"{name} has the shape {page.shape}; a folder of slices holds one grey page per file")
        if pages is None:
            require_memory(page.nbytes * len(names), None, SMALLER_VOLUME_ADVICE)
            pages, spacing = np.empty((len(names), *page.shape), dtype=page.dtype), sizes
        if page.shape != pages.shape[1:] or page.dtype != pages.dtype:
            raise FormatError(
                f"{name} is {page.shape} {page.dtype} and {names[0].name} is {pages.shape[1:]} {pages.dtype}; "
                f"keep only slices of one scan in {folder}",
            )
        pages[number] = page
    assert pages is not None
    return checked_volume(folder, pages.T, spacing=spacing)


def _read_png(path: Path) -> tuple[NDArray[Any], tuple[float, ...]]:
    """Read a grey picture; return its pixels and a cell size of 1."""
    from PIL import Image

    try:
        with wrap_reader_errors(path), Image.open(path) as picture:
            if picture.mode not in GREY_MODES:
                raise FormatError(f"{path} is a picture of mode {picture.mode}; save the slices as grey")
            return np.asarray(picture), (1.0,) * AXES
    except Image.DecompressionBombError as error:
        raise FormatError(f"{path} is too large a picture ({error_text(error)}); save the stack as .tif") from error


def natural_key(path: Path) -> list[tuple[int, str]]:
    """Return a sort key that puts slice 9 before slice 10."""
    parts = re.split(r"([0-9]+)", path.name.lower())
    return [(int(part), "") if number % 2 else (0, part) for number, part in enumerate(parts)]
