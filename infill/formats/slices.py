"""Stacks of images: a multi-page TIFF, or a folder of .tif or .png slices; pages are z, rows y, columns x."""

from __future__ import annotations

import contextlib
import logging
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.broken import SMALLER, checked_volume, one_line, told_broken
from infill.machine import require_memory
from infill.volume import AXES, Volume

SLICES = {".tif", ".tiff", ".png"}
GREY_MODES = {"1", "L", "I", "I;16", "I;16L", "I;16B", "F"}
MILLIMETRES = {
    "nm": 1e-6,
    "µm": 1e-3,
    "μm": 1e-3,
    "um": 1e-3,
    "\\u00b5m": 1e-3,
    "micron": 1e-3,
    "microns": 1e-3,
    "micrometer": 1e-3,
    "mm": 1.0,
    "millimeter": 1.0,
    "cm": 10.0,
    "centimeter": 10.0,
    "inch": 25.4,
    "m": 1e3,
}


@contextlib.contextmanager
def _no_complaints(path: Path) -> Iterator[None]:
    """Raise FormatError for problems that tifffile only logs, such as pages missing from a truncated file."""
    complaints: list[str] = []

    def keep(record: logging.LogRecord) -> bool:
        if record.levelno >= logging.ERROR:
            complaints.append(record.getMessage())
        return False

    logger = logging.getLogger("tifffile")
    logger.addFilter(keep)
    try:
        yield
    finally:
        logger.removeFilter(keep)
    if complaints:
        said = " ".join(complaints[0].split())
        raise FormatError(f"{path} is broken or cut off ({said}); save it again")


def read_tiff(path: Path) -> Volume:
    """Return a stack of pages as a volume, with the cell size written by ImageJ or OME."""
    pages, spacing = _tiff_pages(path)
    return checked_volume(path, pages.T, spacing=spacing)


def _tiff_pages(path: Path) -> tuple[NDArray[Any], tuple[float, ...]]:
    """Return grey pages [(z,) y, x] and the cell size along x, y, z."""
    import tifffile

    with _no_complaints(path), told_broken(path), tifffile.TiffFile(path) as tiff:
        found = tiff.series
        if not found:
            raise FormatError(f"{path} holds no pages; save it again")
        if len(found) > 1:
            shapes = ", ".join(str(each.shape) for each in found[:4])
            raise FormatError(f"{path} holds pages of different kinds, {shapes}; save one stack of equal pages")
        axes, shape = found[0].axes, found[0].shape
        if "S" in axes or "C" in axes:
            raise FormatError(
                f"{path} holds colours or channels (axes {axes}, shape {shape}); save one of them as grey"
            )
        if len(shape) > AXES:
            raise FormatError(f"{path} has {len(shape)} axes ({axes}, shape {shape}); save one stack of it")
        require_memory(found[0].nbytes, None, SMALLER)
        return found[0].asarray(), _tiff_spacing(tiff)


def _tiff_spacing(tiff: Any) -> tuple[float, ...]:  # noqa: ANN401 - tifffile.TiffFile
    """Return the cell size along x, y, z in mm, as written by ImageJ or OME; 1 where it is missing."""
    if tiff.ome_metadata:
        # Only attributes are read, and the standard parser fetches nothing from outside.
        pixels = ElementTree.fromstring(tiff.ome_metadata).find(".//{*}Pixels")  # noqa: S314
        if pixels is None or pixels.get("PhysicalSizeX") is None:
            return (1.0,) * AXES
        sizes = [(pixels.get(f"PhysicalSize{axis}"), pixels.get(f"PhysicalSize{axis}Unit", "µm")) for axis in "XYZ"]
        return tuple(float(size) * MILLIMETRES.get(unit.lower(), 1.0) if size else 1.0 for size, unit in sizes)
    if tiff.imagej_metadata:
        unit = MILLIMETRES.get(str(tiff.imagej_metadata.get("unit", "")).lower(), 1.0)
        values = [getattr(tiff.pages[0].tags.get(name), "value", None) for name in ("XResolution", "YResolution")]
        fractions = [each if isinstance(each, tuple) and len(each) == 2 else (0, 1) for each in values]
        per_cell = [lengths / cells if cells else 1.0 for cells, lengths in fractions]
        return tuple(size * unit for size in (*per_cell, abs(float(tiff.imagej_metadata.get("spacing", 1.0)))))
    return (1.0,) * AXES


def read_slices(folder: Path, names: list[Path]) -> Volume:
    """Return a volume with one file per slice, in the order of the names."""
    pages: NDArray[Any] | None = None
    spacing = (1.0,) * AXES
    for number, name in enumerate(names):
        page, sizes = _read_png(name) if name.suffix.lower() == ".png" else _tiff_pages(name)
        if page.ndim != 2:
            raise FormatError(f"{name} has the shape {page.shape}; a folder of slices holds one grey page per file")
        if pages is None:
            require_memory(page.nbytes * len(names), None, SMALLER)
            pages, spacing = np.empty((len(names), *page.shape), dtype=page.dtype), sizes
        if page.shape != pages.shape[1:] or page.dtype != pages.dtype:
            raise FormatError(
                f"{name} is {page.shape} {page.dtype} and {names[0].name} is {pages.shape[1:]} {pages.dtype}; "
                f"keep only slices of one scan in {folder}"
            )
        pages[number] = page
    assert pages is not None
    return checked_volume(folder, pages.T, spacing=spacing)


def _read_png(path: Path) -> tuple[NDArray[Any], tuple[float, ...]]:
    from PIL import Image

    try:
        with told_broken(path), Image.open(path) as picture:
            if picture.mode not in GREY_MODES:
                raise FormatError(f"{path} is a picture of mode {picture.mode}; save the slices as grey")
            return np.asarray(picture), (1.0,) * AXES
    except Image.DecompressionBombError as error:
        raise FormatError(f"{path} is too large a picture ({one_line(error)}); save the stack as .tif") from error


def natural(path: Path) -> list[tuple[int, str]]:
    """Return a sort key by which slice 9 comes before slice 10."""
    parts = re.split(r"([0-9]+)", path.name.lower())
    return [(int(part), "") if number % 2 else (0, part) for number, part in enumerate(parts)]
