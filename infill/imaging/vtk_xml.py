"""VTK's XML format .vti: an image in pieces. Source: "VTK XML file formats", VTK documentation."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.imaging.assumed import warn
from infill.imaging.frames import choose_frame
from infill.imaging.vtk_arrays import TEXT_BYTES, TYPES, VtkCoding, array_values, number_type, read_vtk_xml
from infill.imaging.vtk_images import Lattice
from infill.machine import require_memory
from infill.volume import AXES, Volume


def read_vti(path: Path, frame: int | None = None) -> Volume:
    """Read the scalars of an image, [x, y, z], or one component of them, counted from 0."""
    with wrap_reader_errors(path):
        image, coding = read_vtk_xml(path, "ImageData", "save an image as .vti")
        return _assemble(path, image, coding, frame)


def _assemble(path: Path, image: ElementTree.Element, coding: VtkCoding, frame: int | None) -> Volume:
    """Assemble the volume from the pieces of an image."""
    extent = _extent(image.get("WholeExtent", ""))
    if image.get("Spacing") is None:
        warn("%s does not say the size of its cells; 1 mm is taken, unless --spacing gives it", path)
    spacing = _numbers(image.get("Spacing", "1 1 1"), AXES)
    direction = _numbers(image.get("Direction", "1 0 0 0 1 0 0 0 1"), AXES * AXES).reshape(AXES, AXES)
    first_point = _numbers(image.get("Origin", "0 0 0"), AXES) + direction @ (spacing * extent[:, 0])
    lattice = Lattice(
        points=tuple((extent[:, 1] - extent[:, 0] + 1).tolist()),
        origin=first_point,
        spacing=spacing,
        direction=direction,
    )
    pieces = [(piece, *_find_scalars(path, piece)) for piece in image.findall("Piece")]
    if not pieces:
        raise FormatError(f"{path} holds an image without a piece; save it again")
    _, array, in_cells = pieces[0]
    shape, kind = lattice.shape(in_cells=in_cells), number_type(array.get("type", ""))
    numbers = int(array.get("NumberOfComponents", "1"))
    component = choose_frame(path, frame, numbers, what=f"holds {numbers} numbers per cell")
    cell_bytes = kind.itemsize + (TEXT_BYTES if array.get("format") == "ascii" else kind.itemsize)
    require_memory(math.prod(shape) * numbers * cell_bytes, None, SMALLER_VOLUME_ADVICE)
    values = np.empty(0)
    covered = 0
    for piece, array, inside in pieces:
        part = _extent(piece.get("Extent", image.get("WholeExtent", "")))
        low = part[:, 0] - extent[:, 0]
        size = np.maximum(1, part[:, 1] - part[:, 0] + (0 if in_cells else 1))
        if inside != in_cells or (low < 0).any() or (low + size > shape).any():
            raise FormatError(f"{path} has pieces that do not fit into it; save it again")
        numbers_of_piece = array_values(array, coding, int(size.prod()) * numbers)
        cells = numbers_of_piece[component::numbers].reshape(size, order="F")
        if len(pieces) == 1 and tuple(size) == shape:
            return lattice.volume(path, cells, in_cells=in_cells)
        if not covered:
            values = np.zeros(shape, dtype=kind)
        values[tuple(slice(begin, begin + count) for begin, count in zip(low, size, strict=True))] = cells
        covered += int(size.prod())
    if covered < math.prod(shape):
        raise FormatError(f"{path} lacks a part of itself: its pieces do not cover it; save it again")
    return lattice.volume(path, values, in_cells=in_cells)


def _find_scalars(path: Path, piece: ElementTree.Element) -> tuple[ElementTree.Element, bool]:
    """Return the scalars of a piece, or else its first array, and whether it belongs to the cells."""
    for section_name in ("PointData", "CellData"):
        section = piece.find(section_name)
        if section is None:
            continue
        arrays = [array for array in section.findall("DataArray") if array.get("type") in TYPES]
        named = [array for array in arrays if array.get("Name") == section.get("Scalars")]
        if arrays:
            return (named or arrays)[0], section_name == "CellData"
    raise FormatError(f"{path} holds no array of numbers; save an image with one number per point")


def _extent(text: str) -> NDArray[np.int64]:
    """Return the first and last point along each axis, (3, 2)."""
    numbers = np.array([int(word) for word in text.split()], dtype=np.int64)
    ranges = numbers.reshape(AXES, 2)
    if (ranges[:, 1] < ranges[:, 0]).any():
        raise ValueError(f"an extent of {text!r}")
    return ranges


def _numbers(text: str, count: int) -> NDArray[np.float64]:
    """Parse exactly `count` numbers."""
    numbers = np.array([float(word) for word in text.split()])
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers in {text!r} where there should be {count}")
    return numbers
