"""STL, PLY, OBJ and tiles, written piece by piece: one piece alone is in memory, and the counts are known before."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.obj import write_obj_faces, write_obj_head, write_obj_vertices
from infill.formats.ply import FACE, ply_header
from infill.formats.stl import RECORD, facets_of, stl_header
from infill.surface import Surface

MOST_VERTICES = 2**31 - 1  # of a PLY, whose faces have 32-bit numbers
MOST_TRIANGLES = 2**32 - 1  # of an STL
TILES = ".precomputed"  # suffix of a folder of tiles for Neuroglancer
TILES_INFO = "info"  # a file that every such folder has
NANOMETRES = 1e6  # in a mm


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshPiece:
    """A piece of a mesh.

    Parameters
    ----------
    surface : Surface, mm
        The piece by itself.
    own : int
        Its first vertices, which no piece before it has.
    faces : (F, 3) int64
        Its triangles by the numbers of vertices in the whole mesh.
    """

    surface: Surface
    own: int
    faces: NDArray[np.int64]


class PieceWriter(Protocol):
    """Writes a mesh into a file, piece by piece, in order."""

    def add(self, piece: MeshPiece) -> None:
        """Write the next piece."""

    def finish(self) -> None:
        """Write the end of the file."""


class StlPieces:
    """Binary STL."""

    def __init__(self, file: BinaryIO, scratch: BinaryIO, vertices: int, triangles: int, space: str) -> None:  # noqa: ARG002
        self.file = file
        file.write(stl_header(triangles, space))

    def add(self, piece: MeshPiece) -> None:
        """Write the triangles of a piece."""
        for normals, corners in facets_of(piece.surface):
            record = np.zeros(len(corners), dtype=RECORD)
            record["corners"], record["normal"] = corners, normals
            self.file.write(record.view(np.uint8).data)

    def finish(self) -> None:
        """Write nothing more."""


class PlyPieces:
    """Binary PLY: all vertices, then all triangles, which wait in a scratch file."""

    def __init__(self, file: BinaryIO, scratch: BinaryIO, vertices: int, triangles: int, space: str) -> None:  # noqa: ARG002
        self.file, self.scratch = file, scratch
        file.write(ply_header(vertices, triangles))

    def add(self, piece: MeshPiece) -> None:
        """Write the vertices of a piece, and keep its triangles."""
        self.file.write(np.asarray(piece.surface.vertices[: piece.own]).astype("<f4").tobytes())
        faces = np.empty(len(piece.faces), dtype=list(FACE))
        faces["count"], faces["corners"] = 3, piece.faces
        self.scratch.write(faces.tobytes())

    def finish(self) -> None:
        """Write the triangles."""
        self.scratch.seek(0)
        shutil.copyfileobj(self.scratch, self.file, 2**20)


class ObjPieces(PlyPieces):
    """Wavefront OBJ: rows of text, vertices first."""

    def __init__(self, file: BinaryIO, scratch: BinaryIO, vertices: int, triangles: int, space: str) -> None:  # noqa: ARG002
        self.file, self.scratch = file, scratch
        write_obj_head(file)

    def add(self, piece: MeshPiece) -> None:
        """Write the vertices of a piece, and keep its triangles."""
        write_obj_vertices(self.file, np.asarray(piece.surface.vertices[: piece.own]))
        write_obj_faces(self.scratch, piece.faces)


PIECE_WRITERS: dict[str, Callable[[BinaryIO, BinaryIO, int, int, str], PieceWriter]] = {
    ".stl": StlPieces,
    ".ply": PlyPieces,
    ".obj": ObjPieces,
}


def check_piece_format(path: Path) -> None:
    """Raise FormatError for a format that is not written piece by piece."""
    if path.suffix.lower() not in PIECE_WRITERS:
        raise FormatError(
            f"{path.name!r} cannot be written piece by piece, as a volume in chunks is; use one of "
            f"{', '.join(PIECE_WRITERS)}, .precomputed for tiles, or .zarr for the field"
        )


def check_piece_size(path: Path, vertices: int, triangles: int) -> None:
    """Raise FormatError if a format cannot count that many vertices or triangles."""
    suffix = path.suffix.lower()
    if (suffix == ".ply" and vertices > MOST_VERTICES) or (suffix == ".stl" and triangles > MOST_TRIANGLES):
        raise FormatError(
            f"{path} would hold {vertices:,} vertices and {triangles:,} triangles, more than {suffix} can count; "
            "use .obj"
        )


class PrecomputedPieces:
    """Fragments of one segment, one for each piece, in the precomputed format of Neuroglancer, of one resolution.

        info          {"@type": "neuroglancer_legacy_mesh"}
        1:0           {"fragments": ["1:0:0", "1:0:1", …]}, the fragments of segment 1
        1:0:0         number of vertices, uint32; vertices, nm, float32; triangles, uint32; all little-endian

    The format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/meshes.md

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
        """Write the list of the fragments, and the kind of the folder."""
        (self.folder / f"{self.segment}:0").write_text(json.dumps({"fragments": self.names}), encoding="utf-8")
        (self.folder / TILES_INFO).write_text(json.dumps({"@type": "neuroglancer_legacy_mesh"}), encoding="utf-8")
