"""Fewer triangles by edges collapsed into points: as closed as before, with the same volume, and nowhere far away."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import thread_count, together
from infill.meshes.distance import Tree, along_curve
from infill.meshes.project_back import crossings, mended
from infill.surface import Surface

Floats = NDArray[np.float64]
Corners = NDArray[np.int32]

BENDS = 0.25  # of the tolerance: edges that rise higher above their neighbours are followed by points of their own
APART = 8.0  # tolerances between these points
MOST = 16  # of them on an edge
FIRST = 0.1  # of the tolerance, as a mean: as far as edges are collapsed without a look at how far what is left lies
FEW = 64  # triangles: who asks for no more than these leaves it to the bound where to stop, in every patch
PATCH = 30_000  # triangles, with all that is known of them, fit into the second cache of a processor
ATTEMPTS = 12
AROUND, DOUBLED = 1.5, 4  # sides of triangles: what stays as it is around a place that fails; attempts until twice that


@dataclass(frozen=True, kw_only=True, eq=False)
class Table:
    """A closed mesh by its corners: corner 3 f + k is also the edge of face f from its k-th corner to the next.

    Parameters
    ----------
    vertices : (V, 3) float64, mm
        About their centre; copies of vertices at which several fans of faces meet come last.
    start, twin : (3 F,) int32
        The vertex of each corner, and the same edge of the neighbour.
    leaving : (V,) int32
        One corner of each vertex.
    name : (V,) int32
        The vertex of the surface that each is.
    fixed : (V,) bool
        Vertices at which several fans meet.
    into : (W,) int32
        The vertex that each of the vertices has become that the table had at first.
    centre : (3,) float64, mm
    """

    vertices: Floats
    start: Corners
    twin: Corners
    leaving: Corners
    name: NDArray[np.int32]
    fixed: NDArray[np.bool_]
    into: NDArray[np.int32]
    centre: Floats

    @classmethod
    def of(cls, surface: Surface) -> Table | None:
        """Return the table of a surface; None if not every edge is shared by exactly two triangles."""
        from infill.kernels.corners import pair, part_fans

        start = np.array(surface.faces, dtype=np.int32).ravel()
        twin, name = np.empty(len(start), dtype=np.int32), np.empty(len(start), dtype=np.int32)
        if not pair(start, len(surface.vertices), twin):
            return None
        count = part_fans(start, twin, len(surface.vertices), name)
        name = name[:count]
        leaving = np.full(count, -1, dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        centre = surface.bounds.mean(axis=0).astype(np.float64)
        return cls(
            vertices=np.ascontiguousarray((np.asarray(surface.vertices, dtype=np.float64) - centre)[name]),
            start=start,
            twin=twin,
            leaving=leaving,
            name=name,
            fixed=np.bincount(name, minlength=len(surface.vertices))[name] > 1,
            into=np.arange(count, dtype=np.int32),
            centre=centre,
        )

    def without_edges(
        self, bound: float, triangles: int, *, near: float | None = None, threads: int | None = None
    ) -> Table:
        """Return the table with edges collapsed, cheapest first.

        Parameters
        ----------
        bound : float
            Of the mean squared distance from the planes of what is gone, mm².
        triangles : int
            Where to stop.
        near : float, optional
            How far the surface may move, mm: see `watched`. If left out, that is not looked at, and edges are collapsed
            patch by patch first.
        threads : int, optional
            See `infill.kernels.threads.thread_count`.
        """
        from infill.kernels.collapsing import collapse
        from infill.kernels.quadrics import add_planes

        table, quadric = self, np.zeros((len(self.vertices), 11))
        add_planes(self.vertices, self.start, quadric)
        if near is None and triangles <= FEW and math.isfinite(bound):
            table, quadric = _within_patches(table, quadric, bound, threads)
        points, corner = (np.empty((0, 3)), np.empty(0, dtype=np.int32)) if near is None else table.watched(near)
        vertices, start, twin = table.vertices.copy(), table.start.copy(), table.twin.copy()
        into = np.arange(len(vertices), dtype=np.int32)
        collapse(
            vertices,
            start,
            twin,
            table.leaving.copy(),
            table.name,
            table.fixed,
            quadric,
            points,
            corner,
            0.0 if near is None else near**2,
            float(bound),
            triangles,
            into,
        )
        return table.left(vertices, start, twin, into)[0]

    def left(self, vertices: Floats, start: Corners, twin: Corners, into: Corners) -> tuple[Table, NDArray[np.bool_]]:
        """Return the table without the faces and vertices that are gone, and which vertices are not.

        Parameters
        ----------
        vertices : (V, 3) float64, mm
        start, twin : (3 F,) int32
            Of a face that is gone, all starts are -1.
        into : (V,) int32
            The vertex that each was collapsed into, which may be gone too.
        """
        while (into[into] != into).any():
            into = into[into]
        left = start >= 0
        used = np.zeros(len(vertices), dtype=bool)
        used[start[left]] = True
        rank, place = np.cumsum(used, dtype=np.int32) - 1, np.cumsum(left, dtype=np.int32) - 1
        start = rank[start[left]]
        leaving = np.empty(len(vertices[used]), dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        fewer = replace(
            self,
            vertices=vertices[used],
            start=start,
            twin=place[twin[left]],
            leaving=leaving,
            name=self.name[used],
            fixed=self.fixed[used],
            into=rank[into[self.into]],
        )
        return fewer, used

    def unfolded(self, first: Table, these: NDArray[np.bool_]) -> Table | None:
        """Return the table with some vertices (V,) as they were at first; None if it were not as closed as that."""
        from infill.kernels.corners import pair, part_fans

        back = these[self.into]
        rank = np.cumsum(~these, dtype=np.int32) - 1
        kept = int(rank[-1]) + 1
        into = np.where(back, kept + np.cumsum(back, dtype=np.int32) - 1, rank[self.into]).astype(np.int32)
        faces = into[first.start].reshape(-1, 3)
        some = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
        start = np.ascontiguousarray(faces[some]).ravel()
        twin, name = np.empty(len(start), dtype=np.int32), np.empty(len(start), dtype=np.int32)
        count = kept + int(back.sum())
        as_closed = pair(start, count, twin) and part_fans(start, twin, count, name) == count
        if not as_closed or len(start) // 3 - 2 * count != len(first.start) // 3 - 2 * len(first.vertices):
            return None
        leaving = np.empty(count, dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        return replace(
            self,
            vertices=np.concatenate([self.vertices[~these], first.vertices[back]]),
            start=start,
            twin=twin,
            leaving=leaving,
            name=np.concatenate([self.name[~these], first.name[back]]),
            fixed=np.concatenate([self.fixed[~these], first.fixed[back]]),
            into=into,
        )

    def placed_in(self, surface: Surface) -> Surface:
        """Return the surface that the table holds, in the order and the kind of number of the one it was made of."""
        kept, faces = np.unique(self.name[self.start], return_inverse=True)
        vertices = np.empty((len(kept), 3))
        vertices[np.searchsorted(kept, self.name)] = self.vertices
        return replace(
            surface,
            vertices=vertices + self.centre,
            faces=faces.reshape(-1, 3).astype(np.asarray(surface.faces).dtype),
        )

    def watched(self, tolerance: float) -> tuple[Floats, Corners]:
        """Return the points that have to stay near, the vertices first, and the corner or edge where each lies."""
        from infill.kernels.nearness import edge_points

        how = (self.vertices, self.start, self.twin, BENDS * tolerance, APART * tolerance, MOST)
        count = edge_points(*how, np.empty((0, 3)), np.empty(0, dtype=np.int32))
        points, edges = np.empty((count, 3)), np.empty(count, dtype=np.int32)
        edge_points(*how, points, edges)
        return np.concatenate([self.vertices, points]), np.concatenate([self.leaving, edges])


def _within_patches(table: Table, quadric: Floats, bound: float, threads: int | None) -> tuple[Table, Floats]:
    """Return the table with edges collapsed within patches of it, and the quadrics (V, 11) of the vertices it has left.

    A patch fits into a processor's own memory, so that what is collapsed next is at hand; and patches are worked on at
    the same time. Vertices where patches meet, and their neighbours, stay, so no patch changes what another one reads.
    Patches depend on the surface alone: the result is the same with any number of threads.
    """
    count = len(table.start) // 3
    patches = count // PATCH
    if patches < 2:
        return table, quadric
    order = along_curve(table.vertices[table.start.reshape(-1, 3)].mean(axis=1))
    patch = np.empty(count, dtype=np.int32)
    patch[order] = np.arange(count) * patches // count
    of_corner = np.repeat(patch, 3)
    seam = np.zeros(len(table.vertices), dtype=bool)
    seam[table.start[of_corner != of_corner[table.leaving[table.start]]]] = True
    beside = seam[table.start.reshape(-1, 3)].any(axis=1)
    seam[table.start.reshape(-1, 3)[beside]] = True
    kept = replace(table, fixed=table.fixed | seam)
    vertices, start, twin = table.vertices.copy(), table.start.copy(), table.twin.copy()
    into = np.arange(len(vertices), dtype=np.int32)
    local = np.empty(count, dtype=np.int32)  # the place of each face in its patch
    works = []
    for some in np.split(order, np.flatnonzero(np.diff(patch[order])) + 1):
        faces = np.sort(some)
        local[faces] = np.arange(len(faces), dtype=np.int32)
        works.append(partial(_collapse_patch, kept, faces, patch, local, bound, vertices, start, twin, quadric, into))
    together(*works, threads=thread_count(threads))
    fewer, used = table.left(vertices, start, twin, into)
    return fewer, quadric[used]


def _collapse_patch(
    table: Table,
    faces: NDArray[np.int64],
    patch: NDArray[np.int32],
    local: NDArray[np.int32],
    bound: float,
    vertices: Floats,
    start: Corners,
    twin: Corners,
    quadric: Floats,
    into: Corners,
) -> None:
    """Collapse edges within one patch of faces (N,), and set what becomes of them in the arrays of the whole table."""
    from infill.kernels.collapsing import collapse

    corners = (3 * faces[:, None] + np.arange(3)).ravel()
    own, begin = np.unique(table.start[corners], return_inverse=True)
    begin = begin.astype(np.int32)
    beyond = table.twin[corners] // 3
    inside = patch[beyond] == patch[faces[0]]
    other = np.where(inside, 3 * local[beyond] + table.twin[corners] % 3, -1).astype(np.int32)
    leaving = np.empty(len(own), dtype=np.int32)
    leaving[begin] = np.arange(len(begin), dtype=np.int32)
    points, planes, goes = table.vertices[own], quadric[own], np.arange(len(own), dtype=np.int32)
    nothing, fixed = (np.empty((0, 3)), np.empty(0, dtype=np.int32)), table.fixed[own]
    collapse(points, begin, other, leaving, table.name[own], fixed, planes, *nothing, 0.0, float(bound), 4, goes)
    free = ~fixed  # all others may be those of other patches, too
    vertices[own[free]], quadric[own[free]], into[own[free]] = points[free], planes[free], own[goes[free]]
    start[corners] = np.where(begin >= 0, own[begin], -1)
    twin[corners] = np.where(other >= 0, corners[other], twin[corners])


def collapsed(
    surface: Surface, *, tolerance: float | None = None, triangles: int = 4, threads: int | None = None
) -> Surface | None:
    """Return the surface with edges collapsed, cheapest first; None if not every edge is shared by two triangles.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, mm, optional
        Neither surface lies further than this from the other, at any vertex and at places between them that are closer
        together the further away they are: see `infill.meshes.hausdorff_samples`.
    triangles : int
        Where to stop.
    threads : int, optional
        Used to measure distances; see `infill.kernels.threads.thread_count`.

    Notes
    -----
    The collapse with the least quadric error (Garland and Heckbert 1997) goes first, to where it keeps the volume
    (Lindstrom and Turk 1998). One is done only if both ends have no other neighbours in common than the two opposite
    corners (the link condition of Dey et al. 1999, so that components, tunnels and cavities stay), no triangle turns
    over or becomes a sliver, and all points of what was given that lie on the triangles concerned stay within the
    tolerance of them, handed on from triangle to triangle as Klein et al. (1996) do, and the new edges within that of
    what lies around these points. Where the surface still goes too far between the points, it is given another vertex:
    see `mended`; where that does not help, or triangles pass through each other, the vertices that were collapsed into
    those around the place come back. First of all, small triangles go as far as their planes allow, by a tenth of the
    tolerance, without a look at distances.
    """
    from scipy.spatial import cKDTree

    table = Table.of(surface)
    if table is None:
        return None
    if tolerance is None:
        return table.without_edges(math.inf, triangles).placed_in(surface)
    tree, aim, known, fewer = Tree.of(surface), triangles, None, table
    for attempt in range(ATTEMPTS):
        if fewer is table:
            fewer = table.without_edges((FIRST * tolerance) ** 2, triangles, threads=threads)
            fewer = fewer.without_edges(tolerance**2, aim, near=tolerance)
        found = fewer.placed_in(surface)
        places, more = crossings(found), 0
        if not len(places) or attempt == ATTEMPTS - 1:  # what takes longest comes last
            found, places, known = mended(found, surface, tree, tolerance, known=known, threads=threads)
            more = len(found.faces) - triangles
            if not len(places) and (more <= 0 or 3 * aim < len(fewer.start)):
                return found
        aim -= max(0, more)
        if not len(places):
            fewer = table
            continue
        reach = AROUND * 2 ** (attempt // DOUBLED) * float(np.sqrt(surface.area / len(surface.faces)))
        away, _ = cKDTree(places - table.centre).query(table.vertices, distance_upper_bound=reach)
        around = np.isfinite(away)
        table = replace(table, fixed=table.fixed | around)
        these = np.zeros(len(fewer.vertices), dtype=bool)
        these[fewer.into[around]] = True
        fewer = fewer.unfolded(table, these) or table
    return surface if len(places) else found
