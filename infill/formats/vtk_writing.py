"""VTK's XML files, written: meshes of triangles (.vtp) and of tetrahedra (.vtu), their numbers appended as bytes.

Source: "VTK XML file formats", VTK documentation. Every array has a head: its number of bytes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, BinaryIO
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from infill.formats.label_walls import LabelTetrahedra, LabelWalls, label_type
from infill.version import __version__

TYPES = {"i": "Int", "u": "UInt", "f": "Float"}
TOPOLOGY = ("Polys", "Cells")  # sections of cells, whose arrays are lists of numbers
TETRAHEDRON = 10  # VTK's number of this type of cell
Arrays = Mapping[str, NDArray[Any]]


def write_vtp(walls: LabelWalls, file: BinaryIO) -> None:
    """Write walls as PolyData; the labels are the array BoundaryLabels of the cells, as vtkSurfaceNets3D calls it."""
    count, corners = walls.triangles.shape
    write_vtk_xml(
        file,
        "PolyData",
        {"NumberOfPoints": len(walls.points), "NumberOfPolys": count},
        {
            "Points": {"Points": walls.points.astype(np.float32)},
            "Polys": {
                "connectivity": walls.triangles.astype(np.int64),
                "offsets": np.arange(1, count + 1, dtype=np.int64) * corners,
            },
            "CellData": {"BoundaryLabels": walls.labels.astype(label_type(walls.labels))},
        },
    )


def write_vtu(mesh: LabelTetrahedra, file: BinaryIO) -> None:
    """Write tetrahedra as an UnstructuredGrid; the label of each is the array Label of the cells."""
    count, corners = mesh.tetrahedra.shape
    write_vtk_xml(
        file,
        "UnstructuredGrid",
        {"NumberOfPoints": len(mesh.points), "NumberOfCells": count},
        {
            "Points": {"Points": mesh.points},
            "Cells": {
                "connectivity": mesh.tetrahedra.astype(np.int64),
                "offsets": np.arange(1, count + 1, dtype=np.int64) * corners,
                "types": np.full(count, TETRAHEDRON, dtype=np.uint8),
            },
            "CellData": {"Label": mesh.labels.astype(label_type(mesh.labels))},
        },
    )


def write_vtk_xml(file: BinaryIO, kind: str, counts: Mapping[str, int], sections: Mapping[str, Arrays]) -> None:
    """Write a file of VTK with one piece.

    Parameters
    ----------
    file : binary file
    kind : str
        Name of the data, such as PolyData.
    counts : mapping of str to int
        Attributes of the piece.
    sections : mapping of str to arrays by name
        An array of two axes has as many components as columns.
    """
    elements, blocks, at = [], [], 0
    for section, arrays in sections.items():
        elements.append(f"<{section}>")
        for name, array in arrays.items():
            code = TYPES[array.dtype.kind]
            components = f'NumberOfComponents="{array.shape[1]}" ' if section not in TOPOLOGY and array.ndim > 1 else ""
            elements.append(
                f'<DataArray type="{code}{8 * array.dtype.itemsize}" Name={quoteattr(name)} '
                f'{components}format="appended" offset="{at}"/>'
            )
            data = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))
            blocks.append(data)
            at += 8 + data.nbytes
        elements.append(f"</{section}>")
    attributes = " ".join(f'{name}="{count}"' for name, count in counts.items())
    described = "\n".join(elements)
    file.write(
        f'<?xml version="1.0"?>\n<!-- phasefill {__version__}, millimetres -->\n'
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f"<{kind}><Piece {attributes}>\n{described}\n</Piece></{kind}>\n"
        '<AppendedData encoding="raw">_'.encode()
    )
    for data in blocks:
        file.write(np.array(data.nbytes, dtype="<u8").tobytes())
        file.write(data.tobytes())
    file.write(b"\n</AppendedData>\n</VTKFile>\n")
