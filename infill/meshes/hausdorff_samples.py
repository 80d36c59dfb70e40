"""Places at which two surfaces are measured against each other: dense enough to be sure, and no denser."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import in_threads, thread_count
from infill.meshes.distance import LEAF, Tree
from infill.surface import Surface

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

FINER, WIDE = 0.2, 2.0  # sides of what is given, and tolerances: how far places on edges are from one another
# Sides of what is given: how far places on it are apart at most, and places on what was found, whose triangles
# are larger: closer if the tolerance is a large part of that.
GIVEN, FOUND, LARGE = 0.3, (0.7, 0.35), 0.3
# Of the tolerance: distances that do not matter, and how close places come to one another.
SURE, SMALL = 0.6, 0.5
CLEAR = 2.5  # tolerances around a face in which nothing but what is level with it may lie
ROOM = 1 << 18  # places for which there is room at a time


@dataclass(frozen=True, kw_only=True, eq=False)
class Watched:
    """Places on a surface, and how far each lies from another surface.

    Parameters
    ----------
    found : Surface, mm
        The other one.
    points : (N, 3) float64, mm
    owner : (N,) int64
        The face of the other surface that each is near.
    away : (N,) float64, mm
        Its distance from that face, which may stand for the nearest if it is within the tolerance.
    unsure : (M,) int64
        Faces of the other surface that were changed since.
    """

    found: Surface
    points: Floats
    owner: Whole
    away: Floats
    unsure: Whole

    def again(self, found: Surface, tolerance: float, threads: int | None) -> Watched:
        """Return the same places, those near faces that were changed measured again; `found` has those and new ones."""
        other = np.zeros(len(found.faces), dtype=bool)
        other[self.unsure] = True
        these = np.flatnonzero(other[self.owner])
        owner, away = self.owner.copy(), self.away.copy()
        # Most of them are near the changed faces: those alone make a small tree.
        part = Tree.of(replace(found, faces=found.faces[self.unsure]))
        away[these], near = part.nearest(self.points[these], enough=tolerance, threads=threads)
        owner[these] = self.unsure[near]
        these = these[away[these] > tolerance]
        if len(these):
            away[these], owner[these] = Tree.of(found).nearest(self.points[these], threads=threads)
        return replace(self, found=found, owner=owner, away=away)

    def handed_to(
        self, found: Surface, given: Surface, side: float, tolerance: float, threads: int | None = None
    ) -> Watched:
        """Return places for another surface that has many of the same faces: those near others are looked for anew."""
        known = same_faces(found, self.found)
        known[np.isin(known, self.unsure)] = -1
        now = np.full(len(self.found.faces), -1)
        now[known[known >= 0]] = np.flatnonzero(known >= 0)
        owner, away, tree = now[self.owner], self.away.copy(), Tree.of(found)
        lost = owner < 0
        away[lost], owner[lost] = tree.nearest(self.points[lost], enough=tolerance, threads=threads)
        count = len(given.vertices)
        near = replace(given, faces=given.faces[lost[:count][given.faces].any(axis=1)])
        more = between(tree, near, owner[:count], away[:count], GIVEN * side, tolerance, threads=threads)
        return Watched(
            found=found,
            points=np.concatenate([self.points, more.points]),
            owner=np.concatenate([owner, more.owner]),
            away=np.concatenate([away, more.away]),
            unsure=np.flatnonzero(known < 0),
        )


def same_faces(one: Surface, other: Surface) -> Whole:
    """Return for each face of a surface which face of another has the same corners, (F,), or -1.

    >>> square = Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))
    >>> turned = Surface(vertices=np.eye(3)[[2, 0, 1]], faces=np.array([[1, 2, 0], [0, 2, 1]]))
    >>> same_faces(turned, square).tolist()
    [0, 0]
    """
    _, name = np.unique(np.concatenate([one.vertices, other.vertices]), axis=0, return_inverse=True)
    name = name.reshape(-1).astype(np.int64)
    corners = np.sort(np.concatenate([name[one.faces], name[len(one.vertices) + other.faces]]), axis=1)
    _, pair = np.unique(corners[:, 0] * len(name) + corners[:, 1], return_inverse=True)
    _, key = np.unique(pair.reshape(-1).astype(np.int64) * len(name) + corners[:, 2], return_inverse=True)
    key = key.reshape(-1)
    found = np.full(int(key.max(initial=0)) + 1, -1)
    found[key[len(one.faces) :]] = np.arange(len(other.faces))
    return found[key[: len(one.faces)]]


def watched(
    tree: Tree, found: Surface, given: Surface, side: float, tolerance: float, *, threads: int | None = None
) -> Watched:
    """Return places on what was given: its vertices first, and more where those are near different faces.

    Parameters
    ----------
    tree, found : Tree, Surface
        What they are measured from.
    given : Surface, mm
    side : float, mm
        Of the triangles of what was given.
    tolerance : float, mm
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    vertices = np.asarray(given.vertices, dtype=np.float64)
    away, owner = tree.nearest(vertices, enough=tolerance, threads=threads)
    more = between(tree, given, owner, away, GIVEN * side, tolerance, threads=threads)
    return Watched(
        found=found,
        points=np.concatenate([vertices, more.points]),
        owner=np.concatenate([owner, more.owner]),
        away=np.concatenate([away, more.away]),
        unsure=np.arange(len(found.faces)),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Places:
    """Places on the faces of one surface, and how far each lies from another.

    Parameters
    ----------
    points : (N, 3) float64, mm
    face : (N,) int64
        On which face each lies.
    owner : (N,) int64
        The face of the other surface that it is near.
    away : (N,) float64, mm
        Its distance from that.
    """

    points: Floats
    face: Whole
    owner: Whole
    away: Floats


def between(
    tree: Tree,
    surface: Surface,
    owner: Whole,
    away: Floats,
    apart: float,
    tolerance: float,
    *,
    all_places: bool = True,
    threads: int | None = None,
) -> Places:
    """Return places between the vertices of a surface: see `infill.kernels.covering`.

    Parameters
    ----------
    tree : Tree
        Of the other surface.
    surface : Surface, mm
    owner, away : (V,) int64, (V,) float64
        For each vertex, the face of the other surface that it is near, and its distance from that, mm.
    apart : float, mm
        How far places are from one another at most; they are closer where what they are near is nearly too far away.
    tolerance : float, mm
    all_places : bool
        Whether to return places that are within the tolerance as well.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    from infill.kernels.covering import cover

    threads = thread_count(threads)
    place = np.empty(len(tree.order), dtype=np.int64)
    place[tree.order] = np.arange(len(tree.order))
    mesh = np.ascontiguousarray(surface.vertices, dtype=np.float64), surface.faces, place[owner], away**2
    other = tree.corners, tree.low, tree.high, LEAF
    kept = -1.0 if all_places else tolerance**2
    sizes = tolerance**2, (SURE * tolerance) ** 2, apart, min(apart, SMALL * tolerance)
    begin, room = np.arange(threads), ROOM
    parts = [tuple(each[0] for each in _room(1, 0))]
    while (begin < len(surface.faces)).any():
        filled = _room(threads, room)
        before = begin.copy()
        counts = in_threads(cover, *mesh, *other, *sizes, kept, begin, *filled, threads=threads)
        parts += [tuple(each[n, : counts[n]].copy() for each in filled) for n in range(threads)]
        if ((begin == before) & (before < len(surface.faces))).any():  # the places of one face do not fit
            room *= 2
    points, face, near, off = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Places(points=points, face=face.astype(np.int64), owner=tree.order[near], away=np.sqrt(off))


def _room(threads: int, room: int) -> tuple[Floats, NDArray[np.int32], Whole, Floats]:
    """Return arrays for what `infill.kernels.covering.cover` finds."""
    shape = threads, room
    return np.empty((*shape, 3)), np.empty(shape, dtype=np.int32), np.empty(shape, dtype=np.int64), np.empty(shape)


def level_faces(surface: Surface, tolerance: float, *, threads: int | None = None) -> NDArray[np.bool_]:
    """Return which faces (F,) have nothing near that does not face nearly where they face.

    If all of another surface lies within the tolerance, mm, of this one, such a face lies within it of the other: this
    surface is a single sheet there, and the other, which can only pass its normals close to it, has to pass them.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, mm
        Nothing within `CLEAR` times this may face elsewhere, by more than 30 degrees.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    >>> roof = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 4], [4, 4, 4]])
    >>> faces = np.array([[0, 1, 2], [1, 3, 2], [1, 4, 3], [4, 5, 3]])
    >>> level_faces(Surface(vertices=roof, faces=faces), 0.1).tolist()
    [False, False, False, False]
    >>> level_faces(Surface(vertices=roof * [1, 1, 0.1], faces=faces), 0.1)[:2].tolist()
    [False, False]
    >>> level_faces(Surface(vertices=roof, faces=faces[:2]), 0.1).tolist()
    [True, True]
    """
    from infill.kernels.covering import level_around

    tree, level = Tree.of(surface), np.empty(len(surface.faces), dtype=bool)
    across = np.cross(tree.corners[:, 1] - tree.corners[:, 0], tree.corners[:, 2] - tree.corners[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    normals = np.divide(across, length, out=np.zeros_like(across), where=length > 0)
    given = tree.corners, normals, tree.low, tree.high, LEAF, CLEAR * tolerance
    in_threads(level_around, *given, level, threads=thread_count(threads))
    found = np.empty_like(level)
    found[tree.order] = level
    return found


def looked_at(
    tree: Tree,
    found: Surface,
    faces: Whole,
    side: float,
    tolerance: float,
    *,
    sure: NDArray[np.bool_] | None = None,
    threads: int | None = None,
) -> Places:
    """Return places on some faces of a surface that was found which are too far from what was given.

    Between its edges it is flat, and few places are enough; along its edges they are close together. Of a whole
    surface, each edge is looked at once.

    """
    part = replace(found, faces=found.faces[faces])
    vertices = np.asarray(found.vertices, dtype=np.float64)
    used, first = np.unique(part.faces, return_index=True)
    owner, away = np.zeros(len(vertices), dtype=np.int64), np.zeros(len(vertices))
    away[used], owner[used] = tree.nearest(vertices[used], enough=tolerance, threads=threads)
    those = np.arange(len(faces)) if sure is None else np.flatnonzero(~sure)
    apart, flat = FOUND[tolerance > LARGE * side] * side, replace(part, faces=part.faces[those])
    inside = between(tree, flat, owner, away, apart, tolerance, all_places=False, threads=threads)
    points, face = _along_edges(part, min(FINER * side, WIDE * tolerance), whole=len(faces) == len(found.faces))
    off, nearest = tree.nearest(points, enough=tolerance, threads=threads)
    far, corner = np.flatnonzero(off > tolerance), np.flatnonzero(away[used] > tolerance)
    return Places(
        points=np.concatenate([vertices[used[corner]], inside.points, points[far]]),
        face=faces[np.concatenate([first[corner] // 3, those[inside.face], face[far]])],
        owner=np.concatenate([owner[used[corner]], inside.owner, nearest[far]]),
        away=np.concatenate([away[used[corner]], inside.away, off[far]]),
    )


def _along_edges(part: Surface, apart: float, *, whole: bool) -> tuple[Floats, Whole]:
    """Return places along the edges of a surface, (N, 3) mm, and a face at each; of a whole one, each edge once."""
    vertices = np.asarray(part.vertices, dtype=np.float64)
    ends = part.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(part.faces)), 3)
    if whole:  # its two triangles go along an edge in opposite directions
        owner, ends = owner[ends[:, 0] < ends[:, 1]], ends[ends[:, 0] < ends[:, 1]]
    begin, step = vertices[ends[:, 0]], vertices[ends[:, 1]] - vertices[ends[:, 0]]
    parts = np.maximum(np.ceil(np.linalg.norm(step, axis=1) / apart), 1).astype(np.int64)
    which = np.repeat(np.arange(len(ends)), parts - 1)
    first = np.cumsum(parts - 1) - (parts - 1)
    share = (np.arange(len(which)) - first[which] + 1) / parts[which]
    return begin[which] + share[:, None] * step[which], owner[which]
