"""Triangles in a third of the bytes: most follow from their neighbours, and so do most places of vertices.

`infill.kernels.mesh_traversal` visits the triangles one across an edge of another, and numbers the vertices as they
come. `page/src/viewer/compact.js` reads what is written here:

symbols : (S,) uint8
    For every edge a → b that waits, the last first, what lies across it: 0 the triangle b, a, c with a new vertex c; 1
    the triangle to the end of the next edge of the loop; 2 to the beginning of the edge before; 3 to both, which are
    one; 4 to a vertex that is named; 5 nothing.
named : (N,) uint32 as 4 planes of bytes
    How many vertices ago a named vertex was new, 0 for a new one: for symbol 4, and the three corners of a triangle
    without an earlier neighbour.
places : (V, 3) uint16 as 6 planes of bytes
    Steps from the predicted place of a vertex: a + b minus the vertex on the other side of the edge, or the vertex
    before it for those that are named; modulo 2¹⁶, with 2 n for n and 2 n - 1 for -n.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]


@dataclass(frozen=True, kw_only=True)
class CompactTriangles:
    """Triangles and places as three arrays of bytes, and which vertex each one was.

    Parameters
    ----------
    symbols, named, places : (N,) uint8
    origin : (V,) int32
        Vertices that triangles use, in the order in which they come.
    """

    symbols: Bytes
    named: Bytes
    places: Bytes
    origin: NDArray[np.int32]

    def arrays(self) -> dict[str, Bytes]:
        """Return the arrays that the page reads, by name."""
        return {"symbols": self.symbols, "named": self.named, "places": self.places}


def encode_compact(faces: NDArray[np.integer], steps: NDArray[np.uint16]) -> CompactTriangles:
    """Encode triangles by how they lie on one another; they come in another order, each from another corner.

    Parameters
    ----------
    faces : (F, 3) int
    steps : (V, 3) uint16
        Places of the vertices.
    """
    from infill.kernels.mesh_traversal import traverse

    corners = np.ascontiguousarray(faces, dtype=np.int32)
    symbols = np.empty(6 * len(corners), dtype=np.uint8)
    named = np.empty(3 * len(corners), dtype=np.uint32)
    number = np.full(len(steps), -1, dtype=np.int32)
    parents = np.empty((len(steps), 4), dtype=np.int32)
    symbol_count, named_count, used = traverse(corners, _twins(corners), symbols, named, number, parents)
    return CompactTriangles(
        symbols=symbols[:symbol_count],
        named=split_bytes(named[:named_count, None]),
        places=split_bytes(_residuals(steps.astype(np.int32), parents[:used])),
        origin=parents[:used, 0].copy(),
    )


def _twins(corners: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the opposite of every half-edge, -1 where there is none, or more than one: (3 F,)."""
    from infill.kernels.mesh_traversal import pair_half_edges

    begins, ends = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    keys = np.minimum(begins, ends).astype(np.int64) * (int(corners.max(initial=0)) + 1) + np.maximum(begins, ends)
    twins = np.full(len(keys), -1, dtype=np.int32)
    pair_half_edges(np.argsort(keys, kind="stable"), keys, begins, twins)
    twice = (corners == np.roll(corners, -1, axis=1)).any(axis=1)  # a vertex twice: no neighbours
    twins[np.repeat(twice, 3)] = -1
    twins[(twins >= 0) & np.repeat(twice, 3)[twins]] = -1
    return twins


def _residuals(steps: NDArray[np.int32], parents: NDArray[np.int32]) -> NDArray[np.uint16]:
    """Return the difference of every vertex from its predicted place, the sign in the lowest bit, (V, 3)."""
    vertex, a, b, apex = parents.T
    before = np.where(b[:, None] >= 0, steps[b], 0)
    predicted = np.where(a[:, None] >= 0, steps[a] + before - steps[apex], before)
    return fold_signs(steps[vertex] - predicted)


def fold_signs(differences: NDArray[np.integer]) -> NDArray[np.uint16]:
    """Return differences modulo 2¹⁶ with the sign in the lowest bit.

    >>> fold_signs(np.array([0, 1, -1, 2, -2])).tolist()
    [0, 2, 1, 4, 3]
    """
    short = differences.astype(np.int16).astype(np.int32)
    folded: NDArray[np.uint16] = ((short << 1) ^ (short >> 15)).astype(np.uint16)
    return folded


def split_bytes(numbers: NDArray[np.unsignedinteger]) -> Bytes:
    """Return the bytes of numbers (N, K): the lowest of all first, column by column.

    >>> split_bytes(np.array([[258, 3], [4, 5]], dtype=np.uint16)).tolist()
    [2, 4, 3, 5, 1, 0, 0, 0]
    """
    size = numbers.dtype.itemsize
    little = np.ascontiguousarray(numbers, dtype=numbers.dtype.newbyteorder("<"))
    return np.ascontiguousarray(little.view(np.uint8).reshape(len(numbers), -1, size).transpose(2, 1, 0)).ravel()
