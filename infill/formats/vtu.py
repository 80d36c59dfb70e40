"""VTK's XML format .vtu: a mesh of a simulation, with numbers at its points or in its cells.

Source: "VTK XML file formats", VTK documentation. A number of a cell lies at the mean of its points.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from infill.arrays import Floats
from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.formats.simulated_values import SimulatedValues, choose_array, reduce_components
from infill.imaging.vtk_arrays import TEXT_BYTES, TYPES, VtkCoding, array_values, number_type, read_vtk_xml
from infill.machine import require_memory

SECTIONS = ("PointData", "CellData")
AXES = 3


def read_vtu(path: Path, name: str | None = None) -> SimulatedValues:
    """Read an array of a mesh at its points, or in its cells; `name` chooses one of several.

    Raises
    ------
    FormatError
        If the file is broken, or has no such array.
    """
    with wrap_reader_errors(path):
        grid, coding = read_vtk_xml(path, "UnstructuredGrid", "save an unstructured grid as .vtu")
        pieces = [piece for piece in grid.findall("Piece") if int(piece.get("NumberOfPoints", "0")) > 0]
        if not pieces:
            raise FormatError(f"{path} holds a mesh without a point; save it again")
        arrays = _arrays(pieces[0])
        names = [array.get("Name", "") for _, array in arrays]
        section, array = arrays[choose_array(path, names, name)]
        chosen = array.get("Name", "")
        parts = [_read_piece(piece, coding, section, chosen) for piece in pieces]
        return SimulatedValues(
            points=np.concatenate([points for points, _ in parts]),
            values=reduce_components(path, chosen, np.concatenate([values for _, values in parts])),
        )


def _arrays(piece: ElementTree.Element) -> list[tuple[str, ElementTree.Element]]:
    """Return the arrays of numbers of a piece, each with the name of its section, those at points last."""
    return [
        (section, array)
        for section in reversed(SECTIONS)
        for array in piece.findall(f"{section}/DataArray")
        if array.get("type") in TYPES
    ]


def _read_piece(piece: ElementTree.Element, coding: VtkCoding, section: str, name: str) -> tuple[Floats, Floats]:
    """Return points (N, 3) of a piece, or middles of its cells, and the components of an array there (N, C)."""
    array = next((array for where, array in _arrays(piece) if (where, array.get("Name", "")) == (section, name)), None)
    if array is None:
        raise ValueError(f"a piece without the array {name!r}")
    points = _read_array(piece.find("Points/DataArray"), coding, int(piece.get("NumberOfPoints", "0")), AXES)
    if section == "CellData":
        points = _cell_middles(piece, coding, points)
    return points, _read_array(array, coding, len(points), int(array.get("NumberOfComponents", "1")))


def _cell_middles(piece: ElementTree.Element, coding: VtkCoding, points: Floats) -> Floats:
    """Return the means of the points of each cell, (N, 3)."""
    cells = {array.get("Name"): array for array in piece.findall("Cells/DataArray")}
    count = int(piece.get("NumberOfCells", "0"))
    ends = _read_array(cells.get("offsets"), coding, count, 1)[:, 0].astype(np.int64)
    counts = np.diff(ends, prepend=0)
    if not count or (counts < 1).any():
        raise ValueError("cells without points")
    corners = _read_array(cells.get("connectivity"), coding, int(ends[-1]), 1)[:, 0].astype(np.int64)
    if not 0 <= corners.min() <= corners.max() < len(points):
        raise ValueError(f"cells of points {corners.min()} to {corners.max()}, of {len(points)}")
    sums: Floats = np.add.reduceat(points[corners], ends - counts, axis=0)
    return sums / counts[:, None]


def _read_array(array: ElementTree.Element | None, coding: VtkCoding, count: int, components: int) -> Floats:
    """Return `count` rows of numbers, (count, components)."""
    if array is None:
        raise ValueError("a mesh without its points or cells")
    if count < 0 or components < 1:
        raise ValueError(f"{count} rows of {components} numbers")
    kind = number_type(array.get("type", ""))
    row = components * (8 + kind.itemsize + (TEXT_BYTES if array.get("format") == "ascii" else kind.itemsize))
    require_memory(count * row, None, SMALLER_VOLUME_ADVICE)
    return array_values(array, coding, count * components).astype(np.float64).reshape(count, components)
