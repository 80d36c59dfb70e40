"""Exact distances of points from a surface; a tree of boxes finds the triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.kernels.threads import in_threads, thread_count
from infill.surface import Surface

ROUNDING = 1e-12  # of a squared distance: what its root may be off
LEAF = 4  # triangles in a leaf of the tree
BITS, INDEX_BITS = 10, 34  # of each coordinate, for the order of the leaves, and of the place of a triangle


@dataclass(frozen=True, kw_only=True, eq=False)
class TriangleTree:
    """The triangles of a surface in the leaves of a complete binary tree, in the order of a space-filling curve.

    Parameters
    ----------
    corners : (F, 3, 3) float64, mm
        Triangles, `LEAF` to a leaf.
    low, high : (2 L - 1, 3) float64, mm
        Box around each branch, the root first; the children of box n are 2 n + 1 and 2 n + 2.
    order : (F,) int64
        The face of the surface that each triangle is.
    """

    corners: Floats
    low: Floats
    high: Floats
    order: NDArray[np.int64]

    @classmethod
    def of(cls, surface: Surface, *, order: NDArray[np.int64] | None = None) -> TriangleTree:
        """Build the tree of a surface with at least one triangle.

        Parameters
        ----------
        surface : Surface, mm
        order : (F,) int64, optional
            Of the faces, in which neighbours are near in space, if one is better than that of the curve.

        Notes
        -----
        Neighbours on the curve of Morton (1966), which interleaves the bits of the coordinates, are near in space.
        """
        from infill.kernels.distances import box_leaves

        vertices, faces = np.asarray(surface.vertices, dtype=np.float64), surface.faces
        if order is None:
            centroids = vertices[faces[:, 0]]
            centroids += vertices[faces[:, 1]]
            centroids += vertices[faces[:, 2]]
            centroids /= 3
            order = morton_order(centroids)
            del centroids  # freed at once: an array as long as the faces adds to the peak of memory
        corners = vertices[faces[order]]
        leaves = 1 << max(0, int(np.ceil(np.log2(-(-len(corners) // LEAF)))))
        low, high = np.empty((2 * leaves - 1, 3)), np.empty((2 * leaves - 1, 3))
        box_leaves(corners, LEAF, low, high)
        return cls(corners=corners, low=low, high=high, order=order)

    def normals(self) -> Floats:
        """Return the normal of each triangle, (F, 3) of length 1, or 0 where a triangle has no area."""
        doubled: Floats = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        length = np.linalg.norm(doubled, axis=1, keepdims=True)
        normals: Floats = np.divide(doubled, length, out=np.zeros_like(doubled), where=length > 0)
        return normals

    def nearest(
        self, points: NDArray[np.floating], *, enough: float = 0.0, threads: int | None = None
    ) -> tuple[Floats, NDArray[np.int64]]:
        """Return the distance of each point (N, 3) from the nearest triangle, (N,) mm, and the face it belongs to.

        Any triangle within `enough`, mm, may be taken for the nearest, which is several times faster.
        """
        from infill.kernels.distances import nearest_triangles

        squared, triangle = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
        queries = np.ascontiguousarray(points, dtype=np.float64)
        in_threads(
            nearest_triangles,
            queries,
            self.corners,
            self.low,
            self.high,
            LEAF,
            enough**2,
            squared,
            triangle,
            threads=thread_count(threads),
        )
        return np.sqrt(squared), self.order[triangle]

    def least_distance(
        self, points: NDArray[np.floating], limit: float = np.inf, *, threads: int | None = None
    ) -> tuple[float, int]:
        """Return the least distance of points (N, 3) from the triangles, mm, and the index of the nearest point.

        It takes a fraction of the time of `nearest`, whose least distance it is. If no point is nearer than the limit,
        mm, return that and -1.
        """
        from infill.kernels.distances import least_distance

        queries = np.ascontiguousarray(points, dtype=np.float64)
        squared_limit = limit * limit * (1 + ROUNDING)
        candidates = [
            (float(np.sqrt(squared)), number)
            for squared, number in in_threads(
                least_distance,
                queries,
                self.corners,
                self.low,
                self.high,
                LEAF,
                squared_limit,
                threads=thread_count(threads),
            )
            if number >= 0
        ]
        distance, number = min(candidates, default=(limit, -1))
        return (distance, number) if distance < limit else (limit, -1)


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
    return TriangleTree.of(surface).nearest(points, threads=threads)[0]


def barycentric(corners: Floats, points: Floats) -> Floats:
    """Return the barycentric coordinates, (N, 3), of each point's foot on the plane of a triangle (N, 3, 3).

    Not numbers where a triangle has no area.

    >>> barycentric(np.eye(3)[None], np.array([[1.0, 1.0, 0.0]])).round(6).tolist()
    [[0.666667, 0.666667, -0.333333]]
    """
    u, v, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], points - corners[:, 0]
    normal = np.cross(u, v)
    squared = np.einsum("ij,ij->i", normal, normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        second = np.einsum("ij,ij->i", np.cross(w, v), normal) / squared
        third = np.einsum("ij,ij->i", np.cross(u, w), normal) / squared
    return np.column_stack([1 - second - third, second, third])


def nearest_on_triangles(corners: Floats, points: Floats) -> Floats:
    """Return the place on each triangle (N, 3, 3) nearest to each point (N, 3), (N, 3), mm.

    >>> nearest_on_triangles(np.eye(3)[None], np.array([[1.0, 1.0, 0.0]])).tolist()
    [[0.5, 0.5, 0.0]]
    """
    shares = barycentric(corners, points)
    places: Floats = np.einsum("ij,ijk->ik", shares, corners)
    outside = np.flatnonzero(~(shares >= 0).all(axis=1))
    nearest = np.full(len(outside), np.inf)
    for k in range(3):
        begin, along = corners[outside, k], corners[outside, k - 2] - corners[outside, k]
        squared = np.einsum("ij,ij->i", along, along)
        ahead = np.einsum("ij,ij->i", points[outside] - begin, along)
        place = begin + np.clip(ahead / np.where(squared > 0, squared, 1.0), 0, 1)[:, None] * along
        away = np.square(points[outside] - place).sum(axis=1)
        closer = away < nearest
        places[outside[closer]], nearest[closer] = place[closer], away[closer]
    return places


def morton_order(points: Floats) -> NDArray[np.int64]:
    """Return the order of points (N, 3) along the curve of Morton (1966), where neighbours are mostly close in space.

    >>> morton_order(np.array([[0.0, 0, 0], [9, 9, 9], [0, 0, 1]])).tolist()
    [0, 2, 1]
    """
    indices = np.arange(len(points), dtype=np.uint64)
    # Sorting numbers is several times as fast as sorting indices by them; indices of equal numbers stay in order.
    codes = np.sort(_morton_codes(points) << np.uint64(INDEX_BITS) | indices)
    return (codes & np.uint64((1 << INDEX_BITS) - 1)).astype(np.int64)


def _morton_codes(points: Floats) -> NDArray[np.uint64]:
    """Interleave the bits of x, y and z; return the position of each point on the curve of Morton."""
    from infill.kernels.distances import interleave_bits

    codes = np.empty(len(points), dtype=np.uint64)
    interleave_bits(np.ascontiguousarray(points, dtype=np.float64), BITS, codes)
    return codes
