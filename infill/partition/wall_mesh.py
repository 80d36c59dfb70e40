"""Walls between labels as a mesh whose edges can be collapsed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.kernels import wall_collapsing as kernels
from infill.kernels import wall_edges as edge_kernels
from infill.kernels.quadrics import add_planes
from infill.kernels.threads import in_threads
from infill.partition.walls import OUTSIDE, WallGraph, Walls

BOUNDS = (1 / 16, 1.0)  # of a bound: edges of low cost go first
SPACING = 1.5  # of the tolerance: between places at which the distance is measured
SLAB = 32  # cells: the least width of a slab
MOST_SLABS = 8
AXES_AND_SHIFTS = (
    (0, 0.0),
    (0, 0.5),
    (1, 0.25),
)  # of slabs; what lies between two of them lies within one the next time
WAYS = len(AXES_AND_SHIFTS)
MOST_SAMPLED = 60_000  # triangles of which the distance is measured afterwards
MOST_PLACES = 150_000  # on them, about
MOST_PARTS = 64  # of a side of a triangle, between places at which its distance is measured
RIDGE_HEIGHT = 0.25  # of the tolerance: edges that rise higher above their neighbours are watched in between
EDGE_SPACING, MOST_ON_EDGE = 4.0, 8  # tolerances between the points watched on an edge, and most of them
MOST_IN_TABLE = 4096  # labels whose pairs are numbered by a table
MOST_SWEEPS, LEAST_SWEPT = 12, 0.1  # with one bound, and the share of points that one takes


Watched = tuple[
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
]


@dataclass(frozen=True, kw_only=True, eq=False)
class WallMesh:
    """Triangles of walls, ready to be collapsed.

    Parameters
    ----------
    points : (P, 3) float64
        In sides of cells.
    triangles : (T, 3) int32
    sides : (T, 2) int
        The lower label is behind the triangle.
    pair : (T,) int32
        A number for the two labels.
    order, flags : (P,) int8
        See `infill.kernels.wall_collapsing`.
    quadric : (P, 11) float64
    box : (2, 3) float64
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    sides: NDArray[np.integer]
    pair: NDArray[np.int32]
    order: NDArray[np.int8]
    flags: NDArray[np.int8]
    quadric: NDArray[np.float64]
    box: NDArray[np.float64]

    @classmethod
    def of(cls, walls: Walls, scale: tuple[float, ...], shape: tuple[int, ...]) -> WallMesh:
        """Prepare walls, with the lower label behind every triangle."""
        box = np.stack([np.zeros(3), np.multiply(shape, scale)])
        points = walls.points.astype(np.float64) * np.array(scale)
        is_turned = (walls.sides[:, 0] > walls.sides[:, 1]) & (walls.sides[:, 1] != OUTSIDE)
        triangles = np.where(is_turned[:, None], walls.triangles[:, ::-1], walls.triangles).astype(np.int32)
        sides = np.where(is_turned[:, None], walls.sides[:, ::-1], walls.sides)
        pair = number_pairs(sides)
        flags, order = np.zeros(len(points), dtype=np.int8), np.empty(len(points), dtype=np.int8)
        for axis in range(3):
            for side, at in enumerate((0, shape[axis])):
                flags |= (walls.points[:, axis] == at).astype(np.int8) << (2 * axis + side)
        kernels.order_points(triangles, pair, *chain_corners(triangles, len(points)), order)
        quadric = np.zeros((len(points), 11))
        add_planes(points, triangles.ravel(), quadric)
        _add_upright_planes(points, triangles, pair, quadric)
        return cls(
            points=points,
            triangles=triangles,
            sides=sides,
            pair=pair,
            order=order,
            flags=flags,
            quadric=quadric,
            box=box,
        )

    def collapse(self, bound: float, tolerance: float | None, threads: int) -> WallMesh:
        """Collapse edges; return the smaller mesh.

        Parameters
        ----------
        bound : float
            Largest mean squared distance from the planes of the removed triangles.
        tolerance : float, optional
            Largest distance of each wall from itself, both ways. If left out, distances are not measured.
        threads : int
        """
        heads, after = chain_corners(self.triangles, len(self.points))
        points, triangles, flags, quadric = (
            self.points.copy(),
            self.triangles.copy(),
            self.flags.copy(),
            self.quadric.copy(),
        )
        into, watched = np.arange(len(points), dtype=np.int32), self.watched(tolerance)
        swept = np.full(len(into), -1, dtype=np.int32)
        number, squared, spacing = 0, (tolerance or 0.0) ** 2, SPACING * (tolerance or 1.0)
        for share in BOUNDS:
            failed = np.full(len(into), -1, dtype=np.int32)
            for _ in range(MOST_SWEEPS):
                slab, members, starts = self._cut_slabs(points, into, number)
                removed = np.zeros(len(starts) - 1, dtype=np.int64)
                mesh = points, triangles, self.pair, heads, after, self.order, flags, slab, quadric, self.box
                limits = share * bound, squared, spacing
                counts = into, swept, failed, number, removed
                in_threads(kernels.sweep_walls, mesh, watched, members, starts, *limits, *counts, threads=threads)
                number += 1
                if removed.sum() < LEAST_SWEPT * len(members) and number % WAYS == 0:
                    break
        return self._compact(points, triangles, flags, quadric)

    def _cut_slabs(
        self, points: NDArray[np.float64], into: NDArray[np.int32], number: int
    ) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int64]]:
        """Cut the points that are left into slabs, in turn two ways across the first axis and one across the second.

        Returns
        -------
        slab : (P,) int32
        members, starts : (Q,) int32, (slabs + 1,) int64
            The points of each slab.
        """
        members = np.flatnonzero(into == np.arange(len(into))).astype(np.int32)
        axis, shift = AXES_AND_SHIFTS[number % WAYS]
        length = float(self.box[1, axis])
        count = int(np.clip(length // SLAB, 1, MOST_SLABS))
        slab = np.zeros(len(points), dtype=np.int32)
        if count > 1:
            slab = np.clip(points[:, axis] * (count / length) + shift, 0, count).astype(np.int32)
        order = np.argsort(slab[members], kind="stable")
        starts = np.searchsorted(slab[members][order], np.arange(count + 2))
        return slab, members[order], starts

    def watched(self, tolerance: float | None) -> Watched:
        """Collect the points that must stay near, once for each wall at them. See `wall_collapsing.sweep_walls`."""
        if tolerance is None:
            none = np.empty(0, dtype=np.int32)
            return np.empty((0, 3)), none, none, none, np.empty((0, 3, 3)), none, none, none, np.empty(0)
        star_start = np.zeros(len(self.points) + 1, dtype=np.int32)
        star, on_walls, wall_faces = (np.empty(3 * len(self.triangles), dtype=np.int32) for _ in range(3))
        edge_kernels.list_stars(self.triangles, star_start, star)
        count = edge_kernels.list_walls(star_start, star, self.pair, on_walls, wall_faces)
        places, on_edges, edge_faces = self._points_on_edges(tolerance)
        point = np.concatenate([on_walls[:count], on_edges])
        face = np.concatenate([wall_faces[:count], edge_faces])
        places = np.concatenate([self.points[on_walls[:count]], places])
        heads, after = chain(face, len(self.triangles))
        corners, reach = self.points[self.triangles], np.empty(len(places))
        edge_kernels.measure_reach(places, point, corners, star_start, star, reach)
        return places, heads, after, point, corners, star_start, star, self.pair.copy(), reach

    def _points_on_edges(self, tolerance: float) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
        """Set points along the edges at which a wall bends or ends; return them, a point and a face of each edge."""
        starts, ends = edges_of(self.triangles)
        face = np.repeat(np.arange(len(self.triangles), dtype=np.int32), 3)
        first, second, single = pair_wall_edges(self.triangles, self.pair)
        corners = self.points[self.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        twice = np.linalg.norm(normals, axis=1)
        normals /= np.maximum(twice, 1e-300)[:, None]
        cosine = (normals[face[first]] * normals[face[second]]).sum(axis=1)
        rise = np.sqrt(np.maximum(0.0, 0.5 - 0.5 * cosine)) * np.minimum(twice[face[first]], twice[face[second]])
        length = np.linalg.norm(self.points[starts] - self.points[ends], axis=1)
        watched = np.concatenate([first[rise > RIDGE_HEIGHT * tolerance * length[first]], single])
        count = np.clip((length[watched] / (EDGE_SPACING * tolerance)).astype(np.int64), 1, MOST_ON_EDGE)
        owner = np.repeat(watched, count)
        share = (np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1) / (np.repeat(count, count) + 1)
        at, to = self.points[starts[owner]], self.points[ends[owner]]
        return at + share[:, None] * (to - at), starts[owner], face[owner]

    def sample(self, spacing: float) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Return places (N, 3) spread over triangles, and the pair of each; of large meshes, a sample."""
        stride = 1 + len(self.triangles) // MOST_SAMPLED
        corners, pair = self.points[self.triangles[::stride]], self.pair[::stride]
        places, pairs = [corners.mean(axis=1), corners[:, 0]], [pair, pair]
        sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1)
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        spacing = max(spacing, float(np.sqrt(area / MOST_PLACES)))
        parts = np.clip(np.ceil(sides / spacing).astype(np.int64), 1, MOST_PARTS)
        for number in np.unique(parts[parts > 1]):
            chosen = parts == number
            shares = [(a, b, number - a - b) for a in range(number + 1) for b in range(number + 1 - a)]
            places.append(np.einsum("sk,tkx->tsx", np.array(shares) / number, corners[chosen]).reshape(-1, 3))
            pairs.append(np.repeat(pair[chosen], len(shares)))
        return np.concatenate(places), np.concatenate(pairs)

    def as_walls(self, graph: WallGraph, scale: tuple[float, ...]) -> tuple[WallGraph, Walls]:
        """Return a graph and walls of the mesh, whose volumes are not measured yet."""
        triangles = self.triangles.astype(np.int64)
        points = (self.points / np.array(scale)).astype(np.float32)
        walls = Walls(points=points, triangles=triangles, sides=self.sides, volumes=np.empty(0))
        return replace(graph, triangles=triangles, sides=self.sides), walls

    def fix_near(self, places: NDArray[np.float64], reach: float) -> WallMesh:
        """Fix the points around some places (N, 3)."""
        from scipy.spatial import cKDTree

        is_near = np.isfinite(cKDTree(places).query(self.points, distance_upper_bound=reach)[0])
        return replace(self, order=np.where(is_near, np.int8(kernels.FIXED), self.order))

    def _compact(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        flags: NDArray[np.int8],
        quadric: NDArray[np.float64],
    ) -> WallMesh:
        """Return the mesh without dropped triangles, whose first corner is negative, and without unused points."""
        kept = triangles[:, 0] >= 0
        used = np.zeros(len(points), dtype=bool)
        used[triangles[kept]] = True
        rank = np.cumsum(used, dtype=np.int32) - 1
        return replace(
            self,
            points=points[used],
            triangles=rank[triangles[kept]],
            sides=self.sides[kept],
            pair=self.pair[kept],
            order=self.order[used],
            flags=flags[used],
            quadric=quadric[used],
        )


def number_pairs(sides: NDArray[np.integer]) -> NDArray[np.int32]:
    """Give a number to the pair of labels of each triangle, (T,), in their order; the outside comes last.

    >>> number_pairs(np.array([[1, 3], [0, 1], [1, OUTSIDE], [0, 1]])).tolist()
    [1, 0, 2, 0]
    """
    labels = int(sides.max(initial=0)) + 1
    keys = sides[:, 0].astype(np.int64) * (labels + 1)
    keys += np.where(sides[:, 1] == OUTSIDE, np.int64(labels), sides[:, 1])
    if labels > MOST_IN_TABLE:
        return np.unique(keys, return_inverse=True)[1].astype(np.int32)
    present = np.zeros(labels * (labels + 1), dtype=bool)
    present[keys] = True
    return np.asarray((np.cumsum(present, dtype=np.int32) - 1)[keys])


def edges_of(triangles: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the starts and ends (3 T,) of the edges of triangles (T, 3)."""
    return triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()


def pair_wall_edges(
    triangles: NDArray[np.int32], pair: NDArray[np.int32]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Pair the edges (3 T,) that two triangles of one wall share.

    Returns
    -------
    first, second : (E,) int64
    single : (S,) int64
        The other edges: there, the wall ends.
    """
    order, is_next = np.empty(triangles.size, dtype=np.int64), np.empty(triangles.size, dtype=bool)
    edge_kernels.sort_edges(triangles, pair, np.zeros(int(triangles.max(initial=0)) + 2, dtype=np.int64), order)
    edge_kernels.match_edges(triangles, pair, order, is_next)
    at = np.flatnonzero(is_next)
    is_next[at + 1] = True
    return order[at], order[at + 1], order[~is_next]


def _add_upright_planes(
    points: NDArray[np.float64], triangles: NDArray[np.int32], pair: NDArray[np.int32], quadric: NDArray[np.float64]
) -> None:
    """Add to the quadrics (P, 11) the planes upright on walls where they end: lines stay where they are."""
    single = pair_wall_edges(triangles, pair)[2]
    starts, ends = (part[single] for part in edges_of(triangles))
    corners = points[triangles[single // 3]]
    along = points[ends] - points[starts]
    upright = np.cross(along, np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    length = np.linalg.norm(upright, axis=1)
    weight = np.where(length > 0, (along**2).sum(axis=1) / 2, 0.0)
    upright /= np.maximum(length, 1e-300)[:, None]
    x, y, z = upright.T
    offset = -(upright * points[starts]).sum(axis=1)
    terms = np.stack([x * x, x * y, x * z, y * y, y * z, z * z, offset * x, offset * y, offset * z, offset**2])
    planes = np.concatenate([terms, np.ones((1, len(single)))]) * weight
    for ends_of_edges in (starts, ends):
        for column, values in enumerate(planes):
            quadric[:, column] += np.bincount(ends_of_edges, values, len(points))


def chain(owner: NDArray[np.integer], count: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Chain the items (N,) of each of `count` owners; return the first of each owner, and the next of each item.

    >>> [part.tolist() for part in chain(np.array([1, 0, 1]), 3)]
    [[1, 0, -1], [2, -1, -1]]
    """
    heads, after = np.full(count, -1, dtype=np.int32), np.empty(len(owner), dtype=np.int32)
    edge_kernels.link_items(np.asarray(owner, dtype=np.int32), heads, after)
    return heads, after


def chain_corners(triangles: NDArray[np.int32], points: int) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Chain the corners of triangles (T, 3) at each point."""
    return chain(triangles.ravel(), points)
