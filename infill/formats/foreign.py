"""Meshes that trimesh reads: OBJ, PLY and OFF."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.formats.broken import told_broken

TEXT_FORMATS = {".obj", ".off"}


def read_by_trimesh(path: Path) -> tuple[NDArray[np.floating], NDArray[np.integer]]:
    """Return vertices and faces as they are in the file."""
    import trimesh

    with told_broken(path, "is broken", "export the mesh again"):
        if path.suffix.lower() in TEXT_FORMATS:
            # Only comments and names can contain non-ASCII characters; their encoding does not matter.
            text = path.read_bytes().decode("ascii", errors="replace")
            mesh = trimesh.load_mesh(io.StringIO(text), file_type=path.suffix.lower()[1:], process=False)
        else:
            mesh = trimesh.load_mesh(path, process=False)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)
