"""A closed surface in slabs: pieces between planes of a grid that meet in the same vertices, and their volumes.

3  +--------+      planes lie at centres of cells: a surface of marching cubes meets them in vertices on edges of
   | piece  |      the grid, which the pieces on both sides have, bit for bit, if they come from the same numbers
2  +--------+
   | piece  |
1  +--------+
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.arrays import AnyIntegers, Floats
from infill.errors import GeometryError
from infill.graph import label_connected
from infill.isosurfaces.components import shell_names
from infill.meshes.shells import select_faces, split_into_batches
from infill.meshes.solids import simplify_open_piece
from infill.meshes.split_components import concatenate_surfaces
from infill.surface import Surface

AT_ONCE = 30_000  # triangles simplified at a time, if they belong to several components: this saves memory


@dataclass(frozen=True, kw_only=True, eq=False)
class SlabPiece:
    """The part of a closed surface between two planes.

    Parameters
    ----------
    surface : Surface, in cells
        It is open at the planes; heights are measured from the lower plane.
    high : int
        Height of the upper plane.
    """

    surface: Surface
    high: int

    def rim(self, height: int) -> NDArray[np.intp]:
        """Return the vertices on a plane, in order of x, then of y."""
        points = self.surface.vertices
        vertices = np.flatnonzero(points[:, 2] == height)
        return vertices[np.lexsort((points[vertices, 1], points[vertices, 0]))]


@dataclass(frozen=True, kw_only=True, eq=False)
class SlabShells:
    """The volumes of the components of a piece.

    Parameters
    ----------
    volumes : (N,) float64, cells³
        Volumes of the components closed by lids on the planes.
    low, high : (L,), (H,) int
        Component of each vertex on the planes, in the order of `Piece.rim`.
    """

    volumes: Floats
    low: AnyIntegers
    high: AnyIntegers


def cut_slab_piece(surface: Surface, low: int, high: int) -> SlabPiece | None:
    """Cut out the part of a surface between two layers of cells; return None if it is empty.

    Parameters
    ----------
    surface : Surface, in cells
        The centre of cell (0, 0, 0) is the origin.
    low, high : int
    """
    from infill.kernels.measures import mark_within_heights

    inside = np.empty(len(surface.faces), dtype=bool)
    mark_within_heights(surface.vertices, surface.faces, float(low), float(high), inside)  # a face lies in one cube
    if not inside.any():
        return None
    part = select_faces(surface, inside)
    return SlabPiece(surface=replace(part, vertices=part.vertices - np.array([0, 0, low])), high=high - low)


def measure_slab_shells(piece: SlabPiece) -> SlabShells:
    """Label and measure the components of a piece.

    Notes
    -----
    Volumes are the flow of (x, 0, 0) through the faces: horizontal lids let none of it through.
    """
    from infill.kernels.measures import sum_flows

    names, count = shell_names(piece.surface)
    volumes = np.zeros(count)
    sum_flows(piece.surface.vertices, piece.surface.faces, names, volumes)
    return SlabShells(volumes=volumes, low=names[piece.rim(0)], high=names[piece.rim(piece.high)])


def sum_shell_volumes(slabs: Sequence[SlabShells | None]) -> Floats:
    """Sum the volumes of the components of a surface, (N,) cells³, over all its pieces, from the bottom up.

    Raises
    ------
    GeometryError
        If pieces do not meet.
    """
    nothing = np.empty(0, dtype=np.int64)
    filled_slabs = [
        SlabShells(volumes=np.empty(0), low=nothing, high=nothing) if slab is None else slab for slab in slabs
    ]
    begins = np.cumsum([0, *(len(slab.volumes) for slab in filled_slabs)])
    below, above = [nothing], [nothing]
    for (lower, upper), (begin, next_begin) in zip(pairwise(filled_slabs), pairwise(begins[:-1]), strict=True):
        _require_meeting(len(lower.high) == len(upper.low))
        below.append(lower.high + begin)
        above.append(upper.low + next_begin)
    names, count = label_connected(np.concatenate(below), np.concatenate(above), int(begins[-1]))
    volumes = np.zeros(count)
    np.add.at(volumes, names, np.concatenate([slab.volumes for slab in filled_slabs]))
    return volumes


def stitch_pieces(pieces: Iterable[tuple[int, SlabPiece | None]]) -> Surface:
    """Join pieces of a surface, given from the bottom, each with the height of its lower plane, in cells.

    The pieces are read once, one after another.

    Raises
    ------
    GeometryError
        If pieces do not meet.
    """
    vertices, faces, count = [], [], 0
    upper, below = np.empty(0, dtype=np.int64), np.empty((0, 2))
    for height, piece in pieces:
        if piece is None:
            _require_meeting(not len(upper))
            continue
        points, lower = np.asarray(piece.surface.vertices, dtype=np.float64), piece.rim(0)
        _require_meeting(np.array_equal(points[lower, :2], below))
        is_new = np.ones(len(points), dtype=bool)
        is_new[lower] = False
        number = count + np.cumsum(is_new) - 1
        number[lower] = upper
        faces.append(number[piece.surface.faces].astype(np.int32))
        vertices.append(points[is_new] + np.array([0, 0, height]))
        count += int(is_new.sum())
        rim = piece.rim(piece.high)
        upper, below = number[rim], points[rim, :2]
    _require_meeting(not len(upper))
    all_faces = np.concatenate(faces)
    faces.clear()  # freed, so that the peak is twice the size at most
    return Surface(vertices=np.concatenate(vertices), faces=all_faces)


def _require_meeting(met: bool) -> None:
    """Raise GeometryError unless two pieces meet."""
    if not met:
        raise GeometryError("two pieces of a surface do not meet in the plane between them; give another voxel")


def simplify_piece(piece: SlabPiece, tolerance: float) -> SlabPiece:
    """Simplify a piece within a tolerance, in cells; all vertices on planes stay."""
    simplified = [simplify_open_piece(batch, tolerance) for batch in split_into_batches(piece.surface, AT_ONCE)]
    return replace(piece, surface=concatenate_surfaces(simplified))
