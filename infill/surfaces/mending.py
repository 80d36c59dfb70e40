"""A surface that is meant to lie near another: measured both ways, and bent to it where it does not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.surface import Surface
from infill.surfaces.distance import Tree

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]

ROUNDS = 6
DENSEST = 48  # places along the side of a triangle, at most
FINER, WIDE = 0.2, 2.0  # sides of what is given, and tolerances: how far places on edges are from one another
# Of these sides, how far places on triangles are from one another: nearer if the tolerance is larger than a part of it.
COARSER, LARGE = (0.7, 0.35), 0.3
BESIDE = 0.15  # of a triangle: what is nearer to an edge is mended there
CLOSE = 0.05, 0.005  # of a triangle: what is nearer to a corner is mended there, in the first rounds and in the others
FIRST = 3  # rounds: a corner that is moved back and forth by its triangles never comes to rest
# Places along the side of a triangle of what is given, if its corners are near different triangles; and if one of these
# places is further away than this part of the tolerance.
FEW, MANY, RISKY = 4, 12, 0.6
LEFT = 0.8  # of the tolerance: how far away what is mended is left, so that little else is bent; less in each round


def mended(found: Surface, given: Surface, tolerance: float, *, threads: int | None = None) -> tuple[Surface, Floats]:
    """Return a surface that lies near another, with more vertices where it did not, and places where that did not help.

    Parameters
    ----------
    found, given : Surface, closed, mm
    tolerance : float, mm
        How far either may be from the other: measured at vertices and at places between them that are closer together
        than the vertices of what was given.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    The place on each triangle that is furthest from the other surface becomes a vertex on it. Near a corner of the
    triangle, that corner is moved; near an edge, both its triangles are cut in two.
    """
    tree = Tree.of(given)
    side = float(np.sqrt(2 * given.area / max(len(given.faces), 1)))
    points = _watched(found, given, side, tolerance, threads)
    owner = np.full(len(points), -1)
    changed = np.arange(len(found.faces))
    for n in range(ROUNDS):
        again = np.flatnonzero((owner < 0) | np.isin(owner, changed))
        away, owner[again] = Tree.of(found).nearest(points[again], enough=tolerance, threads=threads)
        missed = again[away > tolerance]
        part = replace(found, faces=found.faces[changed])
        places, face = _looked_at(part, side, tolerance, whole=len(changed) == len(found.faces))
        off, nearest = tree.nearest(places, enough=tolerance, threads=threads)
        beyond = np.flatnonzero(off > tolerance)
        if not len(missed) and not len(beyond):
            return found, np.empty((0, 3))
        faces = np.concatenate([owner[missed], changed[face[beyond]]])
        targets = np.concatenate([points[missed], _nearest_on(given, nearest[beyond], places[beyond])])
        sources = np.concatenate([_nearest_on(found, owner[missed], points[missed]), places[beyond]])
        distance = np.concatenate([away[away > tolerance], off[beyond]])
        targets = sources + (1 - LEFT ** (n + 1) * tolerance / distance)[:, None] * (targets - sources)
        worst = np.argsort(-distance, kind="stable")
        worst = worst[np.unique(faces[worst], return_index=True)[1]]
        found, changed = _bent(found, faces[worst], sources[worst], targets[worst], CLOSE[n >= FIRST])
    return found, sources[worst]


def _watched(found: Surface, given: Surface, side: float, tolerance: float, threads: int | None) -> Floats:
    """Return the points of what was given whose distance is looked at.

    A triangle whose corners are near one and the same triangle is near it everywhere: its corners are enough.
    """
    tree, vertices = Tree.of(found), np.asarray(given.vertices, dtype=np.float64)
    _, owner = tree.nearest(vertices, enough=tolerance, threads=threads)
    apart = replace(given, faces=given.faces[(owner[given.faces] != owner[given.faces[:, :1]]).any(axis=1)])
    places, face = spread(apart, side, least=FEW)
    away, _ = tree.nearest(places, enough=RISKY * tolerance, threads=threads)
    risky = replace(given, faces=apart.faces[np.unique(face[away > RISKY * tolerance])])
    return np.concatenate([vertices, places, spread(risky, side, least=MANY)[0]])


def spread(surface: Surface, side: float, *, least: int) -> tuple[Floats, Whole]:
    """Return points on all triangles, (N, 3) mm, and the face of each.

    They are the corners of equal pieces into which a triangle is cut, as many along each side as the longest is times
    as long as `side`, and `least` or more.
    """
    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    parts = np.clip(np.ceil(longest / side), least, max(least, DENSEST)).astype(np.int64)
    places, faces = [np.empty((0, 3))], [np.empty(0, dtype=np.int64)]
    for n in np.unique(parts):
        these = np.flatnonzero(parts == n)
        i, j = np.divmod(np.arange((n + 1) ** 2), n + 1)
        a, b = i[i + j <= n] / n, j[i + j <= n] / n
        shares = np.stack([a, b, 1 - a - b], axis=1)
        places.append(np.einsum("pk,fkc->fpc", shares, corners[these]).reshape(-1, 3))
        faces.append(np.repeat(these, len(shares)))
    return np.concatenate(places), np.concatenate(faces)


def _looked_at(part: Surface, side: float, tolerance: float, *, whole: bool) -> tuple[Floats, Whole]:
    """Return places on the triangles of a surface that was found, and the face of each.

    Between its edges it is flat, and few places are enough; along its edges they are close together. Of a whole
    surface, each edge is looked at once.
    """
    vertices, apart = np.asarray(part.vertices, dtype=np.float64), min(FINER * side, WIDE * tolerance)
    places, faces = spread(part, COARSER[tolerance > LARGE * side] * side, least=2)
    ends = part.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(part.faces)), 3)
    if whole:  # its two triangles go along an edge in opposite directions
        owner, ends = owner[ends[:, 0] < ends[:, 1]], ends[ends[:, 0] < ends[:, 1]]
    begin, step = vertices[ends[:, 0]], vertices[ends[:, 1]] - vertices[ends[:, 0]]
    parts = np.maximum(np.ceil(np.linalg.norm(step, axis=1) / apart), 1).astype(np.int64)
    which = np.repeat(np.arange(len(ends)), parts - 1)
    first = np.cumsum(parts - 1) - (parts - 1)
    share = (np.arange(len(which)) - first[which] + 1) / parts[which]
    along = begin[which] + share[:, None] * step[which]
    return np.concatenate([places, along]), np.concatenate([faces, owner[which]])


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
    for f, share, target in zip(face.tolist(), shares, targets, strict=True):
        small = np.flatnonzero(share < BESIDE)
        if share.max() > 1 - close:
            vertex = surface.faces[f, int(share.argmax())]
            around = (surface.faces == vertex).any(axis=1)  # all fans of them, where several meet
            if not touched[around].any():
                moved[vertex] = target
                touched |= around
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


def _shares(corners: Floats, places: Floats) -> Floats:
    """Return the barycentric coordinates of a place in each triangle, (N, 3)."""
    import trimesh.triangles

    shares = trimesh.triangles.points_to_barycentric(corners, places)  # type: ignore[no-untyped-call]
    return np.nan_to_num(np.asarray(shares, dtype=np.float64), nan=1 / 3)
