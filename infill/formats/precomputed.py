"""Meshes for Neuroglancer: a folder of fragments in its precomputed format, of one resolution ("legacy").

    info          {"@type": "neuroglancer_legacy_mesh"}
    1:0           {"fragments": ["1:0:0", "1:0:1", …]}, the fragments of segment 1
    1:0:0         number of vertices, uint32; vertices, nm, float32; triangles, uint32; all little-endian

The format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/meshes.md
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from infill.formats.mesh_pieces import MeshPiece

SUFFIX = ".precomputed"
INFO = "info"
NANOMETRES = 1e6  # in a mm


class PrecomputedPieces:
    """Fragments of one segment, one for each piece.

    Parameters
    ----------
    folder : Path
        It is made.
    segment : int
    """

    def __init__(self, folder: Path, segment: int = 1) -> None:
        self.folder, self.segment = folder, segment
        self.names: list[str] = []
        folder.mkdir()

    def add(self, piece: MeshPiece) -> None:
        """Write a piece with all its vertices: those that another piece has too are the same there, to the bit."""
        points = (np.asarray(piece.surface.vertices, dtype=np.float64) * NANOMETRES).astype("<f4")
        name = f"{self.segment}:0:{len(self.names)}"
        with (self.folder / name).open("xb") as file:
            file.write(np.array([len(points)], dtype="<u4").tobytes())
            file.write(points.tobytes())
            file.write(np.asarray(piece.surface.faces).astype("<u4").tobytes())
        self.names.append(name)

    def finish(self) -> None:
        """Write the list of the fragments, and what the folder is."""
        (self.folder / f"{self.segment}:0").write_text(json.dumps({"fragments": self.names}), encoding="utf-8")
        (self.folder / INFO).write_text(json.dumps({"@type": "neuroglancer_legacy_mesh"}), encoding="utf-8")
