"""Fewer triangles by edge collapse: the mesh stays as closed as it was, keeps its volume and moves nowhere far."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.kernels.threads import run_interruptibly, run_together, thread_count
from infill.meshes.distance import TriangleTree, morton_order
from infill.meshes.project_back import crossing_corners, project_back
from infill.surface import Surface

Corners = NDArray[np.int32]

RIDGE_HEIGHT = 0.25  # of the tolerance: edges that rise higher above their neighbours get sample points of their own
SAMPLE_SPACING = 8.0  # tolerances between these points
MOST_EDGE_SAMPLES = 16  # of them on an edge
BLIND_SHARE = 0.15  # of the tolerance, as a mean: edges collapse up to here without any distance being measured
SAMPLED_SHARE = 0.99  # of the tolerance: where samples may lie, so that places between them lie within the tolerance
SWEPT_SHARE = 0.5  # of that bound: edges are swept up to here, without an order
FEW_TRIANGLES = 64  # triangles: a target of no more than these lets the bound alone say where to stop, in every patch
PATCH = 30_000  # triangles, whose data fit into the second cache of a processor
ATTEMPTS = 12
BLOCKED_RADIUS, DOUBLED = (
    1.5,
    4,
)  # sides of triangles: radius that stays fixed around a place that fails; attempts until it doubles


@dataclass(frozen=True, kw_only=True, eq=False)
class CornerTable:
    """A closed mesh by its corners: corner 3 f + k is also the edge of face f from its k-th corner to the next.

    Parameters
    ----------
    vertices : (V, 3) float64, mm
        About their centre; copies of vertices at which several fans of faces meet come last.
    start, twin : (3 F,) int32
        The vertex of each corner, and the same edge of the neighbour, -1 at the border of an open mesh.
    leaving : (V,) int32
        One corner of each vertex.
    name : (V,) int32
        The vertex of the surface that each vertex stands for.
    fixed : (V,) bool
        Vertices that stay: those at which several fans meet, and those of an open mesh at its border, with their
        neighbours.
    into : (W,) int32
        The vertex that each vertex of the original table has become.
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
    def of(cls, surface: Surface, pinned: NDArray[np.bool_] | None = None) -> CornerTable | None:
        """Build the table of a surface; return None if not every edge is shared by exactly two triangles.

        With a mask of vertices (V,) that stay, edges between these may have one triangle alone.
        """
        start = np.array(surface.faces, dtype=np.int32).ravel()
        paired = _pair_and_split(start, len(surface.vertices), is_open=pinned is not None)
        if paired is None:
            return None
        twin, name = paired
        count = len(name)
        stays = np.zeros(count, dtype=bool)
        if pinned is not None:
            corner = np.flatnonzero(twin < 0)
            border = np.zeros(count, dtype=bool)
            border[start[corner]] = border[np.roll(start.reshape(-1, 3), -1, axis=1).ravel()[corner]] = True
            if not pinned[name[border]].all():
                return None
            faces = start.reshape(-1, 3)
            stays[faces[border[faces].any(axis=1)]] = True  # their neighbours: no walk around a vertex meets the border
            stays |= pinned[name]
        leaving = np.full(count, -1, dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        centre = surface.bounds.mean(axis=0).astype(np.float64)
        return cls(
            vertices=np.ascontiguousarray((np.asarray(surface.vertices, dtype=np.float64) - centre)[name]),
            start=start,
            twin=twin,
            leaving=leaving,
            name=name,
            fixed=stays | (np.bincount(name, minlength=len(surface.vertices))[name] > 1),
            into=np.arange(count, dtype=np.int32),
            centre=centre,
        )

    def without_edges(
        self,
        bound: float,
        triangles: int,
        *,
        near: float | None = None,
        order: Integers | None = None,
        threads: int | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> CornerTable:
        """Collapse edges, cheapest first; return the smaller table.

        Parameters
        ----------
        bound : float
            Largest mean squared distance from the planes of the removed triangles, mm².
        triangles : int
            Where to stop.
        near : float, optional
            How far the surface may move, mm: see `watched`. If left out, distances are not checked, and edges are
            collapsed patch by patch first.
        order : (F,) int64, optional
            The faces in an order in which neighbours are mostly close in space, if it is known: see `morton_order`.
        threads : int, optional
            See `infill.kernels.threads.thread_count`.
        progress : callable, optional
            Called with the share of the patches that are done.
        """
        from infill.kernels.collapsing import collapse
        from infill.kernels.quadrics import add_planes

        table, quadric = self, np.zeros((len(self.vertices), 11))
        add_planes(self.vertices, self.start, quadric)
        if near is None and triangles <= FEW_TRIANGLES and math.isfinite(bound):
            table, quadric = _collapse_within_patches(table, quadric, bound, order, threads, progress)
        points, corner = (np.empty((0, 3)), np.empty(0, dtype=np.int32)) if near is None else table.watched_points(near)
        vertices, start, twin = table.vertices.copy(), table.start.copy(), table.twin.copy()
        collapsed_into = np.arange(len(vertices), dtype=np.int32)
        mesh = vertices, start, twin, table.leaving.copy(), table.name, table.fixed, quadric, points, corner
        reach = 0.0 if near is None else near**2
        run_interruptibly(partial(collapse, *mesh, reach, float(bound), triangles, collapsed_into))
        return table.compact(vertices, start, twin, collapsed_into)[0]

    def compact(
        self, vertices: Floats, start: Corners, twin: Corners, targets: Corners
    ) -> tuple[CornerTable, NDArray[np.bool_]]:
        """Drop the faces and vertices that are gone; return the table, and a mask of the vertices that stay.

        Parameters
        ----------
        vertices : (V, 3) float64, mm
        start, twin : (3 F,) int32
            The starts of a removed face are -1.
        targets : (V,) int32
            The vertex that each was collapsed into, which may itself be gone.
        """
        while (targets[targets] != targets).any():
            targets = targets[targets]
        kept_corners = start >= 0
        used_vertices = np.zeros(len(vertices), dtype=bool)
        used_vertices[start[kept_corners]] = True
        rank, place = np.cumsum(used_vertices, dtype=np.int32) - 1, np.cumsum(kept_corners, dtype=np.int32) - 1
        start = rank[start[kept_corners]]
        leaving = np.empty(len(vertices[used_vertices]), dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        fewer = replace(
            self,
            vertices=vertices[used_vertices],
            start=start,
            twin=_renumber(place, twin[kept_corners]),
            leaving=leaving,
            name=self.name[used_vertices],
            fixed=self.fixed[used_vertices],
            into=rank[targets[self.into]],
        )
        return fewer, used_vertices

    def restore(self, original: CornerTable, restored: NDArray[np.bool_]) -> CornerTable | None:
        """Restore some vertices (V,) and the faces around them; return None if the table would no longer be closed."""
        back = restored[self.into]
        rank = np.cumsum(~restored, dtype=np.int32) - 1
        kept_count = int(rank[-1]) + 1
        into = np.where(back, kept_count + np.cumsum(back, dtype=np.int32) - 1, rank[self.into]).astype(np.int32)
        faces = into[original.start].reshape(-1, 3)
        proper = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
        start = np.ascontiguousarray(faces[proper]).ravel()
        count = kept_count + int(back.sum())
        paired = _pair_and_split(start, count, is_open=bool((original.twin < 0).any()))
        if paired is None or len(paired[1]) != count:
            return None
        twin = paired[0]
        borders = int((twin < 0).sum()), int((original.twin < 0).sum())
        if borders[0] != borders[1] or len(start) // 3 - 2 * count != len(original.start) // 3 - 2 * len(
            original.vertices
        ):
            return None
        leaving = np.empty(count, dtype=np.int32)
        leaving[start] = np.arange(len(start), dtype=np.int32)
        return replace(
            self,
            vertices=np.concatenate([self.vertices[~restored], original.vertices[back]]),
            start=start,
            twin=twin,
            leaving=leaving,
            name=np.concatenate([self.name[~restored], original.name[back]]),
            fixed=np.concatenate([self.fixed[~restored], original.fixed[back]]),
            into=into,
        )

    def to_surface(self, surface: Surface) -> Surface:
        """Return the surface of the table, with the frame and number type of the surface that it came from."""
        return self.to_surface_and_pins(surface, None)[0]

    def to_surface_and_pins(
        self, surface: Surface, pinned: NDArray[np.bool_] | None
    ) -> tuple[Surface, NDArray[np.bool_] | None]:
        """Return the surface of the table, and the mask of its pinned vertices.

        Vertices are in the order of those of the surface that it came from, and the pinned ones the same to the bit.
        """
        vertex_names, faces = np.unique(self.name[self.start], return_inverse=True)
        vertices = np.empty((len(vertex_names), 3))
        vertices[np.searchsorted(vertex_names, self.name)] = self.vertices
        vertices += self.centre
        stays = None if pinned is None else pinned[vertex_names]
        if stays is not None:
            vertices[stays] = np.asarray(surface.vertices)[vertex_names[stays]]
        fewer = replace(
            surface,
            vertices=vertices,
            faces=faces.reshape(-1, 3).astype(np.asarray(surface.faces).dtype),
        )
        return fewer, stays

    def watched_points(self, tolerance: float) -> tuple[Floats, Corners]:
        """Return the points that have to stay near, vertices first, and the corner or edge on which each lies."""
        from infill.kernels.nearness import edge_points

        arguments = (
            self.vertices,
            self.start,
            self.twin,
            RIDGE_HEIGHT * tolerance,
            SAMPLE_SPACING * tolerance,
            MOST_EDGE_SAMPLES,
        )
        count = edge_points(*arguments, np.empty((0, 3)), np.empty(0, dtype=np.int32))
        points, edges = np.empty((count, 3)), np.empty(count, dtype=np.int32)
        edge_points(*arguments, points, edges)
        return np.concatenate([self.vertices, points]), np.concatenate([self.leaving, edges])


def _pair_and_split(start: Corners, count: int, *, is_open: bool) -> tuple[Corners, Corners] | None:
    """Pair the edges of faces, and give each fan its own vertex, in place; return twins and names, None if unpaired.

    Parameters
    ----------
    start : (3 F,) int32
    count : int
        Vertices.
    is_open : bool
        Whether an edge may have one face alone.
    """
    from infill.kernels.corners import pair_edges, pair_open_edges, split_fans, split_open_fans

    twin, name = np.empty(len(start), dtype=np.int32), np.empty(max(len(start), count), dtype=np.int32)
    pair, split = (pair_open_edges, split_open_fans) if is_open else (pair_edges, split_fans)
    if not pair(start, count, twin):
        return None
    total = split(start, twin, count, name)
    return twin, name[:total]


def _renumber(place: Corners, twin: Corners) -> Corners:
    """Return the new numbers of twins, -1 at the border of an open mesh."""
    renumbered = place[twin]
    if len(twin) and twin.min() < 0:
        renumbered[twin < 0] = -1
    return renumbered


def _collapse_within_patches(
    table: CornerTable,
    quadric: Floats,
    bound: float,
    order: Integers | None,
    threads: int | None,
    progress: Callable[[float], None] | None,
) -> tuple[CornerTable, Floats]:
    """Collapse edges within patches of the table; return it and the quadrics (V, 11) of its remaining vertices.

    A patch fits into the cache of a processor, and patches are worked on at the same time. Vertices where patches meet
    stay, and so do their neighbours: no patch changes data that another one reads.
    Patches depend on the surface alone: the result is the same with any number of threads.
    """
    count = len(table.start) // 3
    patches = count // PATCH
    if patches < 2:
        return table, quadric
    if order is None:
        order = morton_order(table.vertices[table.start.reshape(-1, 3)].mean(axis=1))
    patch = np.empty(count, dtype=np.int32)
    patch[order] = np.arange(count) * patches // count
    corner_patch = np.repeat(patch, 3)
    seam = np.zeros(len(table.vertices), dtype=bool)
    seam[table.start[corner_patch != corner_patch[table.leaving[table.start]]]] = True
    at_seam = seam[table.start.reshape(-1, 3)].any(axis=1)
    seam[table.start.reshape(-1, 3)[at_seam]] = True
    pinned = replace(table, fixed=table.fixed | seam)
    vertices, start, twin = table.vertices.copy(), table.start.copy(), table.twin.copy()
    collapsed_into = np.arange(len(vertices), dtype=np.int32)
    local = np.empty(count, dtype=np.int32)  # the place of each face in its patch
    tasks = []
    for patch_faces in np.split(order, np.flatnonzero(np.diff(patch[order])) + 1):
        faces = np.sort(patch_faces)
        local[faces] = np.arange(len(faces), dtype=np.int32)
        tasks.append(
            partial(_collapse_patch, pinned, faces, patch, local, bound, vertices, start, twin, quadric, collapsed_into)
        )
    done, lock = 0, Lock()

    def run_and_report(task: Callable[[], None]) -> None:
        """Run a task, and report the progress."""
        nonlocal done
        task()
        with lock:
            done += 1
            if progress is not None:
                progress(done / len(tasks))

    run_together(*(partial(run_and_report, task) for task in tasks), threads=thread_count(threads))
    fewer, used = table.compact(vertices, start, twin, collapsed_into)
    return fewer, quadric[used]


def _progress_between(tell: Callable[[float], None], low: float, high: float) -> Callable[[float], None]:
    """Return a listener that maps the progress of a part, from 0 to 1, onto that of the whole."""
    return lambda share: tell(low + share * (high - low))


def _collapse_patch(
    table: CornerTable,
    faces: NDArray[np.int64],
    patch: NDArray[np.int32],
    local: NDArray[np.int32],
    bound: float,
    vertices: Floats,
    start: Corners,
    twin: Corners,
    quadric: Floats,
    collapsed_into: Corners,
) -> None:
    """Collapse edges within one patch of faces (N,); write the result into the arrays of the table."""
    from infill.kernels.collapsing import collapse, sweep_short_edges

    corners = (3 * faces[:, None] + np.arange(3)).ravel()
    in_patch, rank = np.zeros(len(table.vertices), dtype=bool), np.empty(len(table.vertices), dtype=np.int32)
    in_patch[table.start[corners]] = True
    patch_vertices = np.flatnonzero(in_patch)
    rank[patch_vertices] = np.arange(len(patch_vertices), dtype=np.int32)
    begin = rank[table.start[corners]]
    neighbour = table.twin[corners] // 3
    within = (patch[neighbour] == patch[faces[0]]) & (table.twin[corners] >= 0)
    local_twin = np.where(within, 3 * local[neighbour] + table.twin[corners] % 3, -1).astype(np.int32)
    leaving = np.empty(len(patch_vertices), dtype=np.int32)
    leaving[begin] = np.arange(len(begin), dtype=np.int32)
    points, planes, local_into = (
        table.vertices[patch_vertices],
        quadric[patch_vertices],
        np.arange(len(patch_vertices), dtype=np.int32),
    )
    no_points, fixed = (np.empty((0, 3)), np.empty(0, dtype=np.int32)), table.fixed[patch_vertices]
    mesh = points, begin, local_twin, leaving, table.name[patch_vertices], fixed, planes
    sweep_short_edges(*mesh, SWEPT_SHARE**2 * float(bound), local_into)
    collapse(*mesh, *no_points, 0.0, float(bound), 4, local_into)
    free = ~fixed  # all others may be those of other patches, too
    vertices[patch_vertices[free]], quadric[patch_vertices[free]], collapsed_into[patch_vertices[free]] = (
        points[free],
        planes[free],
        patch_vertices[local_into[free]],
    )
    start[corners] = np.where(begin >= 0, patch_vertices[begin], -1)
    twin[corners] = np.where(local_twin >= 0, corners[local_twin], twin[corners])


def collapse_edges(
    surface: Surface,
    *,
    tolerance: float | None = None,
    triangles: int = 4,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
    pinned: NDArray[np.bool_] | None = None,
    original: Surface | None = None,
) -> Surface | None:
    """Collapse edges, cheapest first; return None if not every edge is shared by two triangles.

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
    progress : callable, optional
        Called with the share done, 0 to 1, as far as it is known: half after the first collapse.
    pinned : (V,) bool, optional
        Vertices that stay, to the last bit, with the triangles between them; in the result they come first, in their
        order. The surface may be open between them. Every vertex has to have triangles.
    original : Surface, mm, optional
        The surface from which distances are measured, if it is another: it reaches further than the vertices that are
        free, and no further than this surface.

    Notes
    -----
    The collapse with the least quadric error (Garland and Heckbert 1997) goes first, to the point that keeps the volume
    (Lindstrom and Turk 1998). An edge collapses only if its ends share no neighbours beyond the two opposite corners
    (the link condition of Dey et al. 1999, so that components, tunnels and cavities stay), if no triangle turns over or
    becomes a sliver, if all points of the original surface on the triangles concerned stay within the tolerance of
    them, handed on from triangle to triangle as Klein et al. (1996) do, and if the new edges stay within the tolerance
    of the surface around these points. Where the surface still goes too far between the points, it gets another vertex:
    see `project_back`. Where that does not help, or triangles pass through each other, the vertices that were collapsed
    around the place come back. Before all this, small triangles collapse as far as their planes allow, by a share of
    the tolerance, without any distance being measured.
    """
    table = CornerTable.of(surface, pinned)
    if table is None:
        return None
    if tolerance is None:
        return _pinned_first(*table.without_edges(math.inf, triangles).to_surface_and_pins(surface, pinned))
    tolerance *= SAMPLED_SHARE
    tell = progress or (lambda _: None)
    target = surface if original is None else original
    tree, aim, samples, fewer = TriangleTree.of(target), triangles, None, table
    for attempt in range(ATTEMPTS):
        if fewer is table:
            low, high = 1 - 0.5**attempt, 1 - 0.5 ** (attempt + 1)
            fewer = table.without_edges(
                (BLIND_SHARE * tolerance) ** 2,
                triangles,
                order=tree.order if original is None else None,
                threads=threads,
                progress=_progress_between(tell, low, (low + high) / 2),
            )
            fewer = fewer.without_edges(tolerance**2, aim, near=tolerance)
        tell(1 - 0.5 ** (attempt + 1))
        candidate, stays = fewer.to_surface_and_pins(surface, pinned)
        places, excess = crossing_corners(candidate, threads, stays), 0
        if not len(places) or attempt == ATTEMPTS - 1:  # the slowest check comes last
            candidate, places, samples = project_back(
                candidate, target, tree, tolerance, known=samples, pinned=stays, threads=threads
            )
            excess = len(candidate.faces) - triangles
            if not len(places) and (excess <= 0 or 3 * aim < len(fewer.start)):
                return _pinned_first(candidate, stays)
        aim -= max(0, excess)
        if not len(places):
            fewer = table
            continue
        reach = BLOCKED_RADIUS * 2 ** (attempt // DOUBLED) * float(np.sqrt(surface.area / len(surface.faces)))
        from scipy.spatial import cKDTree

        distance, _ = cKDTree(places - table.centre).query(table.vertices, distance_upper_bound=reach)
        blocked = np.isfinite(distance)
        table = replace(table, fixed=table.fixed | blocked)
        restored = np.zeros(len(fewer.vertices), dtype=bool)
        restored[fewer.into[blocked]] = True
        fewer = fewer.restore(table, restored) or table
    return _pinned_first(surface, pinned) if len(places) else _pinned_first(candidate, stays)


def _pinned_first(surface: Surface, pinned: NDArray[np.bool_] | None) -> Surface:
    """Put the pinned vertices (P,) of a surface first; others may follow those that the mask is about."""
    if pinned is None:
        return surface
    marked = np.zeros(len(surface.vertices), dtype=bool)
    marked[: len(pinned)] = pinned
    order = np.argsort(~marked, kind="stable")
    rank = np.empty(len(order), dtype=np.asarray(surface.faces).dtype)
    rank[order] = np.arange(len(order))
    return replace(surface, vertices=np.asarray(surface.vertices)[order], faces=rank[surface.faces])
