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
EDGE_BLOCK = 1 << 18  # edges of which the height is measured at once
MOST_IN_TABLE = 4096  # labels whose pairs are numbered by a table
RESTORING_ROUNDS = 20  # of bringing back more points, where triangles would lie on each other or would turn
MOST_TURNED = 0.2  # cosine of the angle by which a triangle may turn
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
    into : (W,) int32
        The point that each point of the original mesh has become.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int32]
    sides: NDArray[np.integer]
    pair: NDArray[np.int32]
    order: NDArray[np.int8]
    flags: NDArray[np.int8]
    quadric: NDArray[np.float64]
    box: NDArray[np.float64]
    into: NDArray[np.int32]

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
            into=np.arange(len(points), dtype=np.int32),
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
        return self._compact(points, triangles, flags, quadric, into)

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
        star_start, star = self._list_stars()
        on_walls, wall_faces = self._list_walls(star_start, star)
        places, on_edges, edge_faces = self._points_on_edges(tolerance)
        point = np.concatenate([on_walls, on_edges])
        face = np.concatenate([wall_faces, edge_faces])
        places = np.concatenate([self.points[on_walls], places])
        heads, after = chain(face, len(self.triangles))
        corners, reach = self.points[self.triangles], np.empty(len(places))
        edge_kernels.measure_reach(places, point, corners, star_start, star, reach)
        return places, heads, after, point, corners, star_start, star, self.pair.copy(), reach

    def points_on_walls(self) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Return the points (N, 3), once for each wall at them, and the pair of each."""
        points, faces = self._list_walls(*self._list_stars())
        return self.points[points], self.pair[faces]

    def _list_stars(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return where the triangles at each point begin, and these triangles."""
        starts, star = np.zeros(len(self.points) + 1, dtype=np.int32), np.empty(self.triangles.size, dtype=np.int32)
        edge_kernels.list_stars(self.triangles, starts, star)
        return starts, star

    def _list_walls(
        self, star_start: NDArray[np.int32], star: NDArray[np.int32]
    ) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return the numbers of points, once for each wall at them, and a triangle of that wall."""
        points, faces = np.empty(len(star), dtype=np.int32), np.empty(len(star), dtype=np.int32)
        count = edge_kernels.list_walls(star_start, star, self.pair, points, faces)
        return points[:count], faces[:count]

    def _points_on_edges(self, tolerance: float) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
        """Set points along the edges at which a wall bends or ends; return them, a point and a face of each edge."""
        starts, ends = edges_of(self.triangles)
        first, second, single = pair_wall_edges(self.triangles, self.pair)
        blocks = [slice(begin, begin + EDGE_BLOCK) for begin in range(0, len(first), EDGE_BLOCK)]
        watched = np.concatenate([*(self._ridges(first[block], second[block], tolerance) for block in blocks), single])
        length = np.linalg.norm(self.points[starts[watched]] - self.points[ends[watched]], axis=1)
        count = np.clip((length / (EDGE_SPACING * tolerance)).astype(np.int64), 1, MOST_ON_EDGE)
        owner = np.repeat(watched, count)
        share = (np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1) / (np.repeat(count, count) + 1)
        at, to = self.points[starts[owner]], self.points[ends[owner]]
        return at + share[:, None] * (to - at), starts[owner], (owner // 3).astype(np.int32)

    def _ridges(self, edges: NDArray[np.int64], twins: NDArray[np.int64], tolerance: float) -> NDArray[np.int64]:
        """Choose the edges at which a wall bends, of pairs (E,) of the same edge in two triangles."""
        normals, twice = [], []
        for half in (edges, twins):
            corners = self.points[self.triangles[half // 3]]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            twice.append(np.linalg.norm(normal, axis=1))
            normals.append(normal / np.maximum(twice[-1], 1e-300)[:, None])
        cosine = (normals[0] * normals[1]).sum(axis=1)
        rise = np.sqrt(np.maximum(0.0, 0.5 - 0.5 * cosine)) * np.minimum(*twice)
        ends = (self.points[self.triangles[edges // 3, (edges + step) % 3]] for step in (0, 1))
        length = np.linalg.norm(np.subtract(*ends), axis=1)
        return np.asarray(edges[rise > RIDGE_HEIGHT * tolerance * length])

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

    def near(self, places: NDArray[np.float64], reach: float) -> NDArray[np.bool_]:
        """Mark the points (P,) around some places (N, 3)."""
        from scipy.spatial import cKDTree

        return np.isfinite(cKDTree(places).query(self.points, distance_upper_bound=reach)[0])

    def fix(self, is_fixed: NDArray[np.bool_]) -> WallMesh:
        """Fix some points (P,)."""
        return replace(self, order=np.where(is_fixed, np.int8(kernels.FIXED), self.order))

    def restore(self, original: WallMesh, is_back: NDArray[np.bool_]) -> tuple[WallMesh, NDArray[np.float64]] | None:
        """Bring back points of the original mesh, and the triangles at them.

        Parameters
        ----------
        original : WallMesh
            The mesh of which this is a simpler form, with W points.
        is_back : (W,) bool
            The points to bring back. Those that became the same point come back with them, and so do those around
            which triangles would lie on each other, or would turn.

        Returns
        -------
        restored : WallMesh
        back : (N, 3) float64
            The points that came back. None instead of both if the walls would be joined in another way than before.
        """
        crowded_before, is_split = self.crowded_points().sum(), np.zeros(len(self.points), dtype=bool)
        for _ in range(RESTORING_ROUNDS):
            is_split[self.into[is_back]] = True
            is_back = is_split[self.into]
            rank = np.cumsum(~is_split, dtype=np.int32) - 1
            into = np.where(is_back, rank[-1] + np.cumsum(is_back, dtype=np.int32), rank[self.into])
            triangles = into[original.triangles]
            kept = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
            restored = replace(
                original,
                points=np.concatenate([self.points[~is_split], original.points[is_back]]),
                triangles=triangles[kept],
                sides=original.sides[kept],
                pair=original.pair[kept],
                order=np.concatenate([self.order[~is_split], original.order[is_back]]),
                flags=np.concatenate([self.flags[~is_split], original.flags[is_back]]),
                quadric=np.concatenate([self.quadric[~is_split], original.quadric[is_back]]),
                into=into,
            )
            is_wrong = restored.turned_points(original.points[original.triangles[kept]], into[is_back])
            if not is_wrong.any():
                is_wrong = restored.crowded_points()
                if is_wrong.sum() <= crowded_before:
                    is_whole = restored.euler_number() == self.euler_number()
                    return (restored, original.points[is_back]) if is_whole else None
            is_back = is_wrong[into]
        return None

    def turned_points(self, before: NDArray[np.float64], new: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Mark the points (P,) of triangles at new points (N,) that face elsewhere than before, (T, 3, 3) corners."""
        is_new = np.zeros(len(self.points), dtype=bool)
        is_new[new] = True
        at_new = is_new[self.triangles]
        chosen = np.flatnonzero(at_new.any(axis=1) & ~at_new.all(axis=1))
        normals = [
            np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            for corners in (before[chosen], self.points[self.triangles[chosen]])
        ]
        lengths = [np.linalg.norm(normal, axis=1) for normal in normals]
        is_turned = (normals[0] * normals[1]).sum(axis=1) <= MOST_TURNED * lengths[0] * lengths[1]
        result = np.zeros(len(self.points), dtype=bool)
        result[self.triangles[chosen[is_turned]]] = True
        return result & ~is_new

    def crowded_points(self) -> NDArray[np.bool_]:
        """Mark the points (P,) of triangles that lie on each other, and of edges with over two triangles of a label."""
        starts, ends = edges_of(self.triangles)
        number, at = self._number_edges()
        behind, before = (np.repeat(side.astype(np.int64), 3) for side in self.sides.T)
        is_inner, labels = before != OUTSIDE, int(self.sides.max(initial=0)) + 1
        uses = np.concatenate([number * labels + behind, number[is_inner] * labels + before[is_inner]])
        use, count = np.unique(uses, return_counts=True)
        crowded = at[use[count > 2] // labels]
        of_triangle = number.reshape(-1, 3)
        two_edges = of_triangle.min(axis=1) * len(at) + of_triangle.max(axis=1)  # no other triangle has both
        _, same, count = np.unique(two_edges, return_inverse=True, return_counts=True)
        is_crowded = np.zeros(len(self.points), dtype=bool)
        is_crowded[starts[crowded]] = is_crowded[ends[crowded]] = True
        is_crowded[self.triangles[count[same] > 1]] = True
        return is_crowded

    def euler_number(self) -> int:
        """Count points - edges + triangles of all walls."""
        return len(self.points) - len(self._number_edges()[1]) + len(self.triangles)

    def _number_edges(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Give edges (3 T,) between the same points the same number; return the numbers, and where each comes first."""
        starts, ends = edges_of(self.triangles)
        keys = np.minimum(starts, ends).astype(np.int64) * len(self.points) + np.maximum(starts, ends)
        _, at, number = np.unique(keys, return_index=True, return_inverse=True)
        return number, at

    def _compact(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32],
        flags: NDArray[np.int8],
        quadric: NDArray[np.float64],
        into: NDArray[np.int32],
    ) -> WallMesh:
        """Return the mesh without dropped triangles, whose first corner is negative, and without unused points."""
        while (into[into] != into).any():
            into = into[into]
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
            into=rank[into[self.into]],
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
