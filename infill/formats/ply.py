"""PLY: a header of text and rows of numbers, without a unit."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from infill.formats.foreign import read_by_trimesh
from infill.surface import Surface
from infill.version import __version__

FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
read_ply = read_by_trimesh


def write_ply(surface: Surface, file: BinaryIO) -> None:
    """Write binary PLY."""
    file.write(
        "ply\nformat binary_little_endian 1.0\n"
        f"comment phasefill {__version__}, millimetres\n"
        f"element vertex {len(surface.vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(surface.faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
    )
    file.write(surface.vertices.astype("<f4").tobytes())
    faces = np.empty(len(surface.faces), dtype=FACE)
    faces["count"] = 3
    faces["corners"] = surface.faces
    file.write(faces.tobytes())
