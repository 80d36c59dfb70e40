"""A closed surface in slabs: pieces between planes of a grid, which meet in the same vertices, and what they enclose.

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

from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.meshes.shells import in_batches, with_faces
from infill.meshes.solids import shortened_between
from infill.meshes.split_components import joined
from infill.surface import Surface

Floats = NDArray[np.float64]
Integers = NDArray[np.integer]

AT_ONCE = 30_000  # triangles that are simplified at a time, if they are of several components: so much less memory


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """What lies of a closed surface between two planes.

    Parameters
    ----------
    surface : Surface, in cells
        It is open at the planes; heights are those above the lower one.
    high : int
        Height of the upper plane.
    """

    surface: Surface
    high: int

    def rim(self, height: int) -> NDArray[np.intp]:
        """Return the vertices on a plane, in order of x, then of y."""
        points = self.surface.vertices
        found = np.flatnonzero(points[:, 2] == height)
        return found[np.lexsort((points[found, 1], points[found, 0]))]


@dataclass(frozen=True, kw_only=True, eq=False)
class Shells:
    """What the components of a piece enclose.

    Parameters
    ----------
    volumes : (N,) float64, cells³
        As if lids lay on the planes.
    low, high : (L,), (H,) int
        To which component the vertices on the planes belong, in the order of `Piece.rim`.
    """

    volumes: Floats
    low: Integers
    high: Integers


def piece_between(surface: Surface, low: int, high: int) -> Piece | None:
    """Return what lies of the surface of a field between two layers of cells, or None if nothing does.

    Parameters
    ----------
    surface : Surface, in cells
        The centre of cell (0, 0, 0) is the origin.
    low, high : int
    """
    from infill.kernels.measures import within_heights

    kept = np.empty(len(surface.faces), dtype=bool)
    within_heights(surface.vertices, surface.faces, float(low), float(high), kept)  # a face lies in one cube
    if not kept.any():
        return None
    some = with_faces(surface, kept)
    return Piece(surface=replace(some, vertices=some.vertices - np.array([0, 0, low])), high=high - low)


def shells_of(piece: Piece) -> Shells:
    """Return the components of a piece.

    Notes
    -----
    Volumes are the flow of (x, 0, 0) through the faces: none of that goes through lids that lie level.
    """
    from infill.kernels.measures import sum_flows

    names, count = shell_names(piece.surface)
    volumes = np.zeros(count)
    sum_flows(piece.surface.vertices, piece.surface.faces, names, volumes)
    return Shells(volumes=volumes, low=names[piece.rim(0)], high=names[piece.rim(piece.high)])


def volumes_of(slabs: Sequence[Shells | None]) -> Floats:
    """Return what the components of a surface enclose, (N,) cells³, from those of all of its pieces, from the bottom.

    Raises
    ------
    GeometryError
        If pieces do not meet.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    nothing = np.empty(0, dtype=np.int64)
    every = [Shells(volumes=np.empty(0), low=nothing, high=nothing) if each is None else each for each in slabs]
    begins = np.cumsum([0, *(len(each.volumes) for each in every)])
    below, above = [nothing], [nothing]
    for (one, other), (begin, then) in zip(pairwise(every), pairwise(begins[:-1]), strict=True):
        _require_meeting(len(one.high) == len(other.low))
        below.append(one.high + begin)
        above.append(other.low + then)
    rows, columns = np.concatenate(below), np.concatenate(above)
    graph = coo_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(int(begins[-1]),) * 2)
    count, names = connected_components(graph, directed=False)
    volumes = np.zeros(count)
    np.add.at(volumes, names, np.concatenate([each.volumes for each in every]))
    return volumes


def stitched(pieces: Iterable[tuple[int, Piece | None]]) -> Surface:
    """Return the surface of which pieces are given from the bottom, each with the height of its lower plane, in cells.

    Each piece is looked at once.

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
        own = np.ones(len(points), dtype=bool)
        own[lower] = False
        number = count + np.cumsum(own) - 1
        number[lower] = upper
        faces.append(number[piece.surface.faces].astype(np.int32))
        vertices.append(points[own] + np.array([0, 0, height]))
        count += int(own.sum())
        rim = piece.rim(piece.high)
        upper, below = number[rim], points[rim, :2]
    _require_meeting(not len(upper))
    whole = np.concatenate(faces)
    faces.clear()  # so that no more than twice as much is held at a time
    return Surface(vertices=np.concatenate(vertices), faces=whole)


def _require_meeting(met: bool) -> None:
    if not met:
        raise GeometryError("two pieces of a surface do not meet in the plane between them; give another voxel")


def few_of(piece: Piece, tolerance: float) -> Piece:
    """Return a piece with fewer triangles, within a tolerance, in cells, of which all vertices on planes are left."""
    few = [shortened_between(batch, tolerance) for batch in in_batches(piece.surface, AT_ONCE)]
    return replace(piece, surface=joined(few))
