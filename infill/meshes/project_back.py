"""A surface that is meant to lie near another: measured both ways, and bent to it where it does not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.meshes.distance import Tree
from infill.meshes.hausdorff_samples import Watched, level_faces, looked_at, watched
from infill.meshes.intersections import intersecting
from infill.surface import Surface

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

ROUNDS = 12
MANY = 256  # faces: up to as many, it takes longer to see which are level than to look at them
BESIDE = 0.15  # of a triangle: what is nearer to an edge is mended there
CLOSE = 0.05, 0.005  # of a triangle: what is nearer to a corner is mended there, in the first rounds and in the others
FIRST = 3  # rounds: a corner that is moved back and forth by its triangles never comes to rest
# Of the tolerance: how far into each other triangles may reach to be moved apart, and how far apart that is.
SHALLOW, GAP = 1.0, 0.02
LEFT = 0.9  # of the tolerance: how far away what is mended is left, so that little else is bent; less in each round


def mended(
    found: Surface,
    given: Surface,
    tree: Tree,
    tolerance: float,
    *,
    known: Watched | None = None,
    threads: int | None = None,
) -> tuple[Surface, Floats, Watched]:
    """Return a surface that lies near another, with more vertices where it did not, and places where that did not help.

    Nor do any of its triangles pass through each other, unless at these places. Last, what was measured.

    Parameters
    ----------
    found, given : Surface, closed, mm
    tree : Tree
        Of what was given.
    tolerance : float, mm
        How far either may be from the other: measured at vertices and at places between them that are closer together
        than the vertices of what was given.
    known : Watched, optional
        What was measured of another surface with many of the same faces, near the same one.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    The place on each triangle that is furthest from the other surface becomes a vertex on it. Near a corner of the
    triangle, that corner is moved; near an edge, both its triangles are cut in two.
    """
    side = float(np.sqrt(2 * given.area / max(len(given.faces), 1)))
    if known is None:
        seen = watched(Tree.of(found), found, given, side, tolerance, threads=threads)
    else:
        seen = known.handed_to(found, given, side, tolerance, threads)
    taken = np.zeros(len(found.faces), dtype=bool)  # for near, since all around them was level
    for n in range(ROUNDS):
        if n > 0:
            seen = seen.again(found, tolerance, threads)
        changed, owner, points = seen.unsure, seen.owner, seen.points
        missed = np.flatnonzero(seen.away > tolerance)
        taken = np.concatenate([taken, np.zeros(len(found.faces) - len(taken), dtype=bool)])
        taken[changed] = len(changed) > MANY and level_faces(found, tolerance, threads=threads)[changed]
        there = looked_at(tree, found, changed, side, tolerance, sure=taken[changed], threads=threads)
        if n > 0 and not len(missed) and not len(there.points) and taken.any():
            bent = np.flatnonzero(taken & ~level_faces(found, tolerance, threads=threads))
            taken[bent] = False
            there = looked_at(tree, found, bent, side, tolerance, threads=threads)
        if not len(missed) and not len(there.points):
            seen = replace(seen, unsure=np.empty(0, dtype=np.int64))
            crossing = intersecting(np.asarray(found.vertices), found.faces)
            if not len(crossing):
                return found, np.empty((0, 3)), seen
            left = _corners(found, crossing)
            found, changed = _apart(found, crossing, tolerance)
            if not len(changed):
                break
            seen = replace(seen, unsure=changed)
            continue
        faces = np.concatenate([owner[missed], there.face])
        targets = np.concatenate([points[missed], _nearest_on(given, there.owner, there.points)])
        sources = np.concatenate([_nearest_on(found, owner[missed], points[missed]), there.points])
        distance = np.concatenate([seen.away[missed], there.away])
        targets = sources + (1 - LEFT ** (n + 1) * tolerance / distance)[:, None] * (targets - sources)
        worst = np.argsort(-distance, kind="stable")
        worst = worst[np.unique(faces[worst], return_index=True)[1]]
        left = sources[worst]
        found, changed = _bent(found, faces[worst], left, targets[worst], CLOSE[n >= FIRST])
        seen = replace(seen, unsure=changed)
    return found, left, replace(seen, found=found)


def _nearest_on(surface: Surface, face: Whole, places: Floats) -> Floats:
    """Return the point of a face that is nearest to each place."""
    import trimesh.triangles

    if not len(face):
        return np.empty((0, 3))
    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces[face]]
    return np.asarray(trimesh.triangles.closest_point(corners, places))  # type: ignore[no-untyped-call]


def _bent(surface: Surface, face: Whole, sources: Floats, targets: Floats, close: float) -> tuple[Surface, Whole]:
    """Return a surface of which a place on each of some faces is a vertex now and lies elsewhere; and what changed."""
    from infill.kernels.corners import pair

    start = np.array(surface.faces, dtype=np.int32).ravel()
    twin = np.empty(len(start), dtype=np.int32)
    pair(start, len(surface.vertices), twin)
    vertices, faces = [np.asarray(surface.vertices, dtype=np.float64)], surface.faces.copy()
    moved, count, more = vertices[0].copy(), len(surface.vertices), []
    touched = np.zeros(len(faces), dtype=bool)
    shares = _shares(moved[surface.faces[face]], sources)
    order = np.argsort(start, kind="stable")
    begins = np.searchsorted(start[order], np.arange(count + 1))
    for f, share, target in zip(face.tolist(), shares, targets, strict=True):
        small = np.flatnonzero(share < BESIDE)
        if share.max() > 1 - close:
            vertex = surface.faces[f, int(share.argmax())]
            around = order[begins[vertex] : begins[vertex + 1]] // 3  # all fans of them, where several meet
            if not touched[around].any():
                moved[vertex] = target
                touched[around] = True
            continue
        k = int(share.argmin())
        opposite = 3 * f + (k + 1) % 3  # the edge across from the corner with the least share
        other = int(twin[opposite]) // 3 if len(small) else f
        if touched[f] or touched[other]:
            continue
        vertices.append(target[None])
        a, b, c = np.roll(faces[f], -k)
        if len(small):
            d = faces[other][(int(twin[opposite]) + 2) % 3]
            faces[f], faces[other] = (a, b, count), (d, c, count)
            more += [(a, count, c), (d, count, b)]
        else:
            faces[f] = (a, b, count)
            more += [(b, c, count), (c, a, count)]
        touched[f] = touched[other] = True
        count += 1
    vertices[0] = moved
    touched[face] = True
    changed = np.concatenate([np.flatnonzero(touched), len(faces) + np.arange(len(more))])
    added = np.array(more, dtype=faces.dtype).reshape(-1, 3)
    return replace(surface, vertices=np.concatenate(vertices), faces=np.concatenate([faces, added])), changed


def _apart(surface: Surface, pairs: Whole, tolerance: float) -> tuple[Surface, Whole]:
    """Return a surface of which triangles that pass through each other do so less; and what changed.

    Of each pair (N, 2), one corner goes to the other side of the other triangle's plane: the one that is nearest to it
    of those that are alone on their side. Those that reach too far into each other stay.
    """
    vertices = np.array(surface.vertices, dtype=np.float64)
    both = np.concatenate([pairs, pairs[:, ::-1]])
    one, other = vertices[surface.faces[both[:, 0]]], vertices[surface.faces[both[:, 1]]]
    normal = np.cross(other[:, 1] - other[:, 0], other[:, 2] - other[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)
    above = np.einsum("pki,pi->pk", one - other[:, :1], normal)
    alone = np.where((above > 0).sum(axis=1, keepdims=True) == 1, above > 0, above <= 0)
    depth = np.where(alone & (alone.sum(axis=1, keepdims=True) == 1), np.abs(above), np.inf)
    k = depth.argmin(axis=1)
    deep = depth[np.arange(len(both)), k].reshape(2, -1)
    some = np.flatnonzero(deep.min(axis=0) <= SHALLOW * tolerance)
    best = some + len(pairs) * deep[:, some].argmin(axis=0)
    vertex, by = surface.faces[both[best, 0], k[best]], above[best, k[best]]
    by += np.copysign(GAP * tolerance, by)
    moved, first = np.unique(vertex, return_index=True)
    vertices[moved] -= by[first, None] * normal[best[first]]
    return replace(surface, vertices=vertices), np.flatnonzero(np.isin(surface.faces, moved).any(axis=1))


def crossings(surface: Surface) -> Floats:
    """Return the corners (N, 3) of the triangles that pass through each other, mm."""
    return _corners(surface, intersecting(np.asarray(surface.vertices), surface.faces))


def _corners(surface: Surface, faces: Whole) -> Floats:
    corners: Floats = np.asarray(surface.vertices, dtype=np.float64)[surface.faces[np.unique(faces)]].reshape(-1, 3)
    return corners


def _shares(corners: Floats, places: Floats) -> Floats:
    """Return the barycentric coordinates of a place in each triangle, (N, 3)."""
    import trimesh.triangles

    shares = trimesh.triangles.points_to_barycentric(corners, places)  # type: ignore[no-untyped-call]
    return np.nan_to_num(np.asarray(shares, dtype=np.float64), nan=1 / 3)
