"""Sample points at which two surfaces are measured against each other: dense enough to be sure, and no denser."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.kernels.threads import in_threads, thread_count
from infill.meshes.distance import LEAF, TriangleTree
from infill.surface import Surface

SURE_EDGES = 3.0  # times as far apart are samples on the edges between aligned faces
FINER, WIDE = 0.2, 2.0  # sides of the original's triangles, and tolerances: spacing of samples on edges
# In sides of the original's triangles: largest spacing of samples on the original, and on the result, whose triangles
# are larger; closer if the tolerance is a large part of a side.
GIVEN, FOUND, LARGE = 0.3, (0.7, 0.35), 0.3
FOLDS = 2.0  # sides of the original's triangles: pieces up to this length lie on few triangles of the result
# Of the tolerance: distances that do not matter, and the smallest spacing of samples.
SURE, SMALL = 0.6, 0.5
CLEAR = 2.5  # tolerances around a face, within which only faces aligned with it may lie
ROOM = 1 << 18  # samples that the arrays hold at a time


@dataclass(frozen=True, kw_only=True, eq=False)
class HausdorffSamples:
    """Samples of the original surface, and their distances from the result.

    Parameters
    ----------
    found : Surface, mm
        The result.
    points : (N, 3) float64, mm
    owner : (N,) int64
        The face of the result near each sample.
    away : (N,) float64, mm
        The distance from that face, which may stand for the nearest one if it is within the tolerance.
    unsure : (M,) int64
        Faces of the result that have changed since.
    """

    found: Surface
    points: Floats
    owner: Integers
    away: Floats
    unsure: Integers

    def remeasure(self, result: Surface, tolerance: float, threads: int | None) -> HausdorffSamples:
        """Measure the samples near changed faces of `result` once more; return all samples."""
        changed = np.zeros(len(result.faces), dtype=bool)
        changed[self.unsure] = True
        stale = np.flatnonzero(changed[self.owner])
        owner, away = self.owner.copy(), self.away.copy()
        # Most samples are near the changed faces: those alone make a small tree.
        changed_tree = TriangleTree.of(replace(result, faces=result.faces[self.unsure]))
        away[stale], part_face = changed_tree.nearest(self.points[stale], enough=tolerance, threads=threads)
        owner[stale] = self.unsure[part_face]
        stale = stale[away[stale] > tolerance]
        if len(stale):
            away[stale], owner[stale] = TriangleTree.of(result).nearest(self.points[stale], threads=threads)
        return replace(self, found=result, owner=owner, away=away)

    def transfer_to(
        self, result: Surface, original: Surface, side: float, tolerance: float, threads: int | None = None
    ) -> HausdorffSamples:
        """Move the samples to another surface that shares many faces; measure those near the other faces once more."""
        same_face = match_faces(result, self.found)
        same_face[np.isin(same_face, self.unsure)] = -1
        new_face = np.full(len(self.found.faces), -1)
        new_face[same_face[same_face >= 0]] = np.flatnonzero(same_face >= 0)
        owner, distance, tree = new_face[self.owner], self.away.copy(), TriangleTree.of(result)
        lost = owner < 0
        distance[lost], owner[lost] = tree.nearest(self.points[lost], enough=tolerance, threads=threads)
        count = len(original.vertices)
        open_part = replace(original, faces=original.faces[lost[:count][original.faces].any(axis=1)])
        added = sample_between_vertices(
            tree,
            open_part,
            owner[:count],
            distance[:count],
            GIVEN * side,
            tolerance,
            folds=FOLDS * side,
            threads=threads,
        )
        return HausdorffSamples(
            found=result,
            points=np.concatenate([self.points, added.points]),
            owner=np.concatenate([owner, added.owner]),
            away=np.concatenate([distance, added.away]),
            unsure=np.flatnonzero(same_face < 0),
        )


def match_faces(surface: Surface, reference: Surface) -> Integers:
    """Find for each face of a surface the face of another with the same corners: (F,), -1 for none.

    >>> square = Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))
    >>> turned = Surface(vertices=np.eye(3)[[2, 0, 1]], faces=np.array([[1, 2, 0], [0, 2, 1]]))
    >>> match_faces(turned, square).tolist()
    [0, 0]
    """
    _, name = np.unique(np.concatenate([surface.vertices, reference.vertices]), axis=0, return_inverse=True)
    name = name.reshape(-1).astype(np.int64)
    corners = np.sort(np.concatenate([name[surface.faces], name[len(surface.vertices) + reference.faces]]), axis=1)
    _, pair = np.unique(corners[:, 0] * len(name) + corners[:, 1], return_inverse=True)
    _, key = np.unique(pair.reshape(-1).astype(np.int64) * len(name) + corners[:, 2], return_inverse=True)
    key = key.reshape(-1)
    face_of_key = np.full(int(key.max(initial=0)) + 1, -1)
    face_of_key[key[len(surface.faces) :]] = np.arange(len(reference.faces))
    return face_of_key[key[: len(surface.faces)]]


def sample_original(
    tree: TriangleTree, result: Surface, original: Surface, side: float, tolerance: float, *, threads: int | None = None
) -> HausdorffSamples:
    """Sample the original surface: its vertices first, then points between those near different faces.

    Parameters
    ----------
    tree, result : TriangleTree, Surface
        The result, from which samples are measured.
    original : Surface, mm
    side : float, mm
        Of the triangles of the original.
    tolerance : float, mm
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    vertices = np.asarray(original.vertices, dtype=np.float64)
    distance, owner = tree.nearest(vertices, enough=tolerance, threads=threads)
    between_samples = sample_between_vertices(
        tree, original, owner, distance, GIVEN * side, tolerance, folds=FOLDS * side, threads=threads
    )
    return HausdorffSamples(
        found=result,
        points=np.concatenate([vertices, between_samples.points]),
        owner=np.concatenate([owner, between_samples.owner]),
        away=np.concatenate([distance, between_samples.away]),
        unsure=np.arange(len(result.faces)),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class FaceSamples:
    """Samples on the faces of one surface, and their distances from another.

    Parameters
    ----------
    points : (N, 3) float64, mm
    face : (N,) int64
        The face on which each sample lies.
    owner : (N,) int64
        The face of the other surface near it.
    away : (N,) float64, mm
        The distance from that face.
    """

    points: Floats
    face: Integers
    owner: Integers
    away: Floats


def sample_between_vertices(
    tree: TriangleTree,
    surface: Surface,
    owner: Integers,
    distance: Floats,
    apart: float,
    tolerance: float,
    *,
    folds: float = 0.0,
    own: TriangleTree | None = None,
    all_places: bool = True,
    threads: int | None = None,
) -> FaceSamples:
    """Sample a surface between its vertices: see `infill.kernels.covering`.

    Parameters
    ----------
    tree : TriangleTree
        Of the other surface.
    surface : Surface, mm
    owner, distance : (V,) int64, (V,) float64
        For each vertex, the face of the other surface near it, and the distance from that face, mm.
    apart : float, mm
        Largest spacing of samples; they are closer where the other surface is nearly too far away.
    tolerance : float, mm
    folds : float, mm
        Length up to which a piece of a face is not sampled where the other surface folds little below it.
    own : TriangleTree, optional
        Of all faces of this surface, if pieces of faces that are aligned as in `aligned_faces` need no samples.
    all_places : bool
        Whether to return samples within the tolerance as well.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    from infill.kernels.covering import sample_faces

    threads = thread_count(threads)
    place = np.empty(len(tree.order), dtype=np.int64)
    place[tree.order] = np.arange(len(tree.order))
    source = np.ascontiguousarray(surface.vertices, dtype=np.float64), surface.faces, place[owner], distance**2
    target = tree.corners, tree.low, tree.high, LEAF
    threshold = -1.0 if all_places else tolerance**2
    sizes = tolerance**2, (SURE * tolerance) ** 2, apart, min(apart, SMALL * tolerance), folds
    no_triangles = np.empty((0, 3, 3)), np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3))
    around = no_triangles if own is None else (own.corners, own.normals(), own.low, own.high)
    begin, capacity = np.arange(threads), ROOM
    parts = [tuple(array[0] for array in _sample_arrays(1, 0))]
    while (begin < len(surface.faces)).any():
        buffers = _sample_arrays(threads, capacity)
        previous = begin.copy()
        counts = in_threads(
            sample_faces,
            *source,
            *target,
            *sizes,
            around,
            CLEAR * tolerance,
            threshold,
            begin,
            *buffers,
            threads=threads,
        )
        parts += [tuple(column[n, : counts[n]].copy() for column in buffers) for n in range(threads)]
        if ((begin == previous) & (previous < len(surface.faces))).any():  # the samples of one face do not fit
            capacity *= 2
    points, face, triangle, squared = (np.concatenate(array) for array in zip(*parts, strict=True))
    return FaceSamples(points=points, face=face.astype(np.int64), owner=tree.order[triangle], away=np.sqrt(squared))


def _sample_arrays(threads: int, capacity: int) -> tuple[Floats, NDArray[np.int32], Integers, Floats]:
    """Allocate the arrays that `infill.kernels.covering.sample_faces` fills."""
    shape = threads, capacity
    return np.empty((*shape, 3)), np.empty(shape, dtype=np.int32), np.empty(shape, dtype=np.int64), np.empty(shape)


def aligned_faces(
    surface: Surface,
    tolerance: float,
    *,
    faces: Integers | None = None,
    tree: TriangleTree | None = None,
    threads: int | None = None,
) -> NDArray[np.bool_]:
    """Mark the faces (N,) around which, within `CLEAR` tolerances, all faces point the same way to 30 degrees.

    If all of another surface lies within the tolerance, mm, of this one, then such a face lies within the tolerance of
    the other: this surface is a single sheet there, and the other surface has to cross its normals close to it.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, mm
        No face within `CLEAR` times this may point elsewhere by more than 30 degrees.
    faces : (N,) int64, optional
        Some faces, instead of all.
    tree : TriangleTree, optional
        Of the surface, if it is known.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    >>> roof = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 4], [4, 4, 4]])
    >>> faces = np.array([[0, 1, 2], [1, 3, 2], [1, 4, 3], [4, 5, 3]])
    >>> aligned_faces(Surface(vertices=roof, faces=faces), 0.1).tolist()
    [False, False, False, False]
    >>> aligned_faces(Surface(vertices=roof * [1, 1, 0.1], faces=faces), 0.1)[:2].tolist()
    [False, False]
    >>> aligned_faces(Surface(vertices=roof, faces=faces[:2]), 0.1).tolist()
    [True, True]
    """
    from infill.kernels.covering import mark_aligned_faces

    tree = tree or TriangleTree.of(surface)
    place = np.empty(len(tree.order), dtype=np.int64)
    place[tree.order] = np.arange(len(tree.order))
    chosen = place if faces is None else place[faces]
    aligned = np.empty(len(chosen), dtype=bool)
    arguments = tree.corners, tree.normals(), tree.low, tree.high, LEAF, CLEAR * tolerance
    in_threads(mark_aligned_faces, *arguments, chosen, aligned, threads=thread_count(threads))
    return aligned


def find_strays(
    tree: TriangleTree,
    result: Surface,
    faces: Integers,
    side: float,
    tolerance: float,
    *,
    sure: NDArray[np.bool_] | None = None,
    own: TriangleTree | None = None,
    threads: int | None = None,
) -> FaceSamples:
    """Sample some faces of a result; return the samples that lie too far from the original.

    A face is flat between its edges, so that few samples are enough there; along the edges they are close together.
    If all faces are given, each edge is sampled once.
    """
    part = replace(result, faces=result.faces[faces])
    vertices = np.asarray(result.vertices, dtype=np.float64)
    used, corner_index = np.unique(part.faces, return_index=True)
    owner, distance = np.zeros(len(vertices), dtype=np.int64), np.zeros(len(vertices))
    distance[used], owner[used] = tree.nearest(vertices[used], enough=tolerance, threads=threads)
    unsure = np.arange(len(faces)) if sure is None else np.flatnonzero(~sure)
    apart, unsure_part = FOUND[tolerance > LARGE * side] * side, replace(part, faces=part.faces[unsure])
    interior = sample_between_vertices(
        tree, unsure_part, owner, distance, apart, tolerance, own=own, all_places=False, threads=threads
    )
    apart_on_edges = min(FINER * side, WIDE * tolerance)
    points, face = _sample_edges(part, unsure, apart_on_edges, all_faces=len(faces) == len(result.faces))
    edge_away, nearest = tree.nearest(points, enough=tolerance, threads=threads)
    far_edge_points, far_vertices = np.flatnonzero(edge_away > tolerance), np.flatnonzero(distance[used] > tolerance)
    return FaceSamples(
        points=np.concatenate([vertices[used[far_vertices]], interior.points, points[far_edge_points]]),
        face=faces[np.concatenate([corner_index[far_vertices] // 3, unsure[interior.face], face[far_edge_points]])],
        owner=np.concatenate([owner[used[far_vertices]], interior.owner, nearest[far_edge_points]]),
        away=np.concatenate([distance[used[far_vertices]], interior.away, edge_away[far_edge_points]]),
    )


def _sample_edges(part: Surface, unsure: Integers, apart: float, *, all_faces: bool) -> tuple[Floats, Integers]:
    """Sample the edges of a surface, each edge once if `all_faces`; return points (N, 3), mm, and a face at each.

    Edges of unsure faces have samples `apart`, mm, and others fewer.
    """
    vertices = np.asarray(part.vertices, dtype=np.float64)
    ends = part.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(part.faces)), 3)
    if all_faces:  # the two triangles of an edge run along it in opposite directions
        owner, ends = owner[ends[:, 0] < ends[:, 1]], ends[ends[:, 0] < ends[:, 1]]
    begin, step = vertices[ends[:, 0]], vertices[ends[:, 1]] - vertices[ends[:, 0]]
    at_unsure = np.zeros(len(vertices), dtype=bool)
    at_unsure[part.faces[unsure]] = True
    spacing = np.where(at_unsure[ends].all(axis=1), apart, SURE_EDGES * apart)
    segments = np.maximum(np.ceil(np.linalg.norm(step, axis=1) / spacing), 1).astype(np.int64)
    edge = np.repeat(np.arange(len(ends)), segments - 1)
    edge_start = np.cumsum(segments - 1) - (segments - 1)
    share = (np.arange(len(edge)) - edge_start[edge] + 1) / segments[edge]
    return begin[edge] + share[:, None] * step[edge], owner[edge]
