"""Meshes that trimesh reads: OBJ, PLY, OFF and binary glTF."""

from __future__ import annotations

import io
import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError

# What the readers of trimesh raise for files that hold something else than they should.
BROKEN = (ValueError, LookupError, TypeError, AttributeError, EOFError, struct.error, NotImplementedError)
TEXT_FORMATS = {".obj", ".off"}


def read_by_trimesh(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Return vertices and faces as they stand in the file."""
    import trimesh

    try:
        if path.suffix.lower() in TEXT_FORMATS:
            # Only comments and names can hold what is not ASCII; their encoding does not matter.
            text = path.read_bytes().decode("ascii", errors="replace")
            mesh = trimesh.load_mesh(io.StringIO(text), file_type=path.suffix.lower()[1:], process=False)
        else:
            mesh = trimesh.load_mesh(path, process=False)
    except BROKEN as error:
        raise FormatError(f"{path} is broken ({type(error).__name__}: {error}); export the mesh again") from error
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)
