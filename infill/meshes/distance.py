"""How far points lie from a surface, exactly: triangles are found by a tree of boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.surface import Surface

Floats = NDArray[np.float64]

LEAF = 4  # triangles in a leaf of the tree
BITS, PLACES = 10, 34  # of each coordinate, for the order of the leaves, and of the place of a triangle


@dataclass(frozen=True, kw_only=True, eq=False)
class Tree:
    """The triangles of a surface in the leaves of a complete binary tree, in the order of a space-filling curve.

    Parameters
    ----------
    corners : (F, 3, 3) float64, mm
        Triangles, `LEAF` to a leaf.
    low, high : (2 L - 1, 3) float64, mm
        Boxes around what a branch holds, the root first; the children of box n are 2 n + 1 and 2 n + 2.
    order : (F,) int64
        Which face of the surface each triangle is.
    """

    corners: Floats
    low: Floats
    high: Floats
    order: NDArray[np.int64]

    @classmethod
    def of(cls, surface: Surface) -> Tree:
        """Return the tree of a surface with at least one triangle.

        Notes
        -----
        Neighbours on the curve of Morton (1966), which interleaves the bits of the coordinates, are near in space.
        """
        vertices, faces = np.asarray(surface.vertices, dtype=np.float64), surface.faces
        middles = vertices[faces[:, 0]]
        middles += vertices[faces[:, 1]]
        middles += vertices[faces[:, 2]]
        middles /= 3
        order = along_curve(middles)
        del middles  # whatever is as long as the faces adds to what is held at a time
        corners = vertices[faces[order]]
        leaves = 1 << max(0, int(np.ceil(np.log2(-(-len(corners) // LEAF)))))
        low, high = np.full((2 * leaves - 1, 3), np.inf), np.full((2 * leaves - 1, 3), -np.inf)
        for box, least in ((low, np.minimum), (high, np.maximum)):
            full, first = len(corners) // LEAF, leaves - 1
            box[first : first + full] = least.reduce(corners[: full * LEAF].reshape(full, 3 * LEAF, 3), axis=1)
            if full * LEAF < len(corners):
                box[first + full] = least.reduce(corners[full * LEAF :].reshape(-1, 3), axis=0)
            while first:
                above = first // 2
                box[above:first] = least(box[first : 2 * first + 1 : 2], box[first + 1 : 2 * first + 1 : 2])
                first = above
        return cls(corners=corners, low=low, high=high, order=order)

    def nearest(
        self, points: NDArray[np.floating], *, enough: float = 0.0, threads: int | None = None
    ) -> tuple[Floats, NDArray[np.int64]]:
        """Return the distance of each point (N, 3) from the nearest triangle, (N,) mm, and the face it belongs to.

        Of triangles that are no further away than `enough`, mm, any may be taken, which is several times faster.
        """
        from infill.kernels.distances import nearest_triangles

        squared, face = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
        given = np.ascontiguousarray(points, dtype=np.float64)
        in_threads(
            nearest_triangles,
            given,
            self.corners,
            self.low,
            self.high,
            LEAF,
            enough**2,
            squared,
            face,
            threads=thread_count(threads),
        )
        return np.sqrt(squared), self.order[face]


def distances(points: NDArray[np.floating], surface: Surface, *, threads: int | None = None) -> Floats:
    """Return the distance of each point from the nearest triangle, (N,) mm.

    Parameters
    ----------
    points : (N, 3) float, mm
    surface : Surface, mm
        With at least one triangle.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    >>> square = Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))
    >>> distances(np.ones((1, 3)), square).round(6).tolist()
    [1.154701]
    """
    return Tree.of(surface).nearest(points, threads=threads)[0]


def along_curve(points: Floats) -> NDArray[np.int64]:
    """Return the order of points (N, 3) on the curve of Morton (1966): those that follow one another are mostly near.

    >>> along_curve(np.array([[0.0, 0, 0], [9, 9, 9], [0, 0, 1]])).tolist()
    [0, 2, 1]
    """
    places = np.arange(len(points), dtype=np.uint64)
    # Sorting numbers is several times as fast as sorting places by them; places of equal numbers stay in order.
    found = np.sort(_interleaved(points) << np.uint64(PLACES) | places)
    return (found & np.uint64((1 << PLACES) - 1)).astype(np.int64)


def _interleaved(points: Floats) -> NDArray[np.uint64]:
    """Return the bits of the coordinates, x, y and z in turn: the place of points on the curve of Morton."""
    low = points.min(axis=0)
    side = max(float(np.ptp(points, axis=0).max()), 1e-300)
    spread = np.zeros(2**BITS, dtype=np.uint64)
    for bit in range(BITS):
        spread |= ((np.arange(2**BITS, dtype=np.uint64) >> np.uint64(bit)) & np.uint64(1)) << np.uint64(3 * bit)
    code = np.zeros(len(points), dtype=np.uint64)
    for axis in range(3):
        cells = ((points[:, axis] - low[axis]) * ((2**BITS - 1) / side)).astype(np.int16)
        code |= spread[cells] << np.uint64(axis)
    return code
