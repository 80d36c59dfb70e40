"""Wavefront OBJ: text, without a unit."""

from __future__ import annotations

from typing import BinaryIO

from infill.formats.foreign import read_by_trimesh
from infill.formats.rows import write_rows
from infill.surface import Surface
from infill.version import __version__

read_obj = read_by_trimesh


def write_obj(surface: Surface, file: BinaryIO) -> None:
    """Write Wavefront OBJ."""
    file.write(f"# phasefill {__version__}, millimetres\no infill\n".encode())
    write_rows(file, "v %.9g %.9g %.9g\n", surface.vertices)
    write_rows(file, "f %d %d %d\n", surface.faces, add=1)
