"""Project a surface back to another: measure both ways, and bend the surface to the other where it is too far."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.meshes.distance import TriangleTree, barycentric, nearest_on_triangles
from infill.meshes.hausdorff_samples import HausdorffSamples, aligned_faces, find_strays, sample_original
from infill.meshes.intersections import intersecting_pairs
from infill.surface import Surface

Mask = NDArray[np.bool_]

ROUNDS = 12
NEAR_EDGE = 0.15  # of a triangle: a place nearer to an edge than this is mended on the edge
NEAR_CORNER = 0.05, 0.005  # of a triangle: a place nearer to a corner is mended there; in the first rounds, and later
FIRST_ROUNDS = 3  # rounds: a corner that is moved back and forth by its triangles never comes to rest
# Of the tolerance: the depth up to which crossing triangles are moved apart, and the gap left between them.
SHALLOW, GAP = 1.0, 0.02
TARGET_SHARE = (
    0.9  # of the tolerance: distance at which a mended place is left, so that little else bends; less in each round
)


def project_back(
    candidate: Surface,
    original: Surface,
    tree: TriangleTree,
    tolerance: float,
    *,
    known: HausdorffSamples | None = None,
    pinned: Mask | None = None,
    threads: int | None = None,
) -> tuple[Surface, Floats, HausdorffSamples]:
    """Bend a surface until it lies near another, adding vertices; return it, the places that failed, and the samples.

    Its triangles do not pass through each other, except at the places that failed.

    Parameters
    ----------
    candidate, original : Surface, closed, mm
    tree : TriangleTree
        Of the given surface.
    tolerance : float, mm
        Largest distance of either surface from the other, measured at vertices and at points between them that are
        closer together than the vertices of the given surface.
    known : HausdorffSamples, optional
        Samples measured for a surface that shares many faces and lies near the same given one.
    pinned : (V,) bool, optional
        Vertices of the candidate that stay, with the triangles between them, which are not looked at.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Notes
    -----
    The place on each triangle that is furthest from the other surface becomes a vertex on it. Near a corner of the
    triangle, that corner is moved; near an edge, both its triangles are cut in two.
    """
    side = float(np.sqrt(2 * original.area / max(len(original.faces), 1)))
    if known is None:
        samples = sample_original(TriangleTree.of(candidate), candidate, original, side, tolerance, threads=threads)
    else:
        samples = known.transfer_to(candidate, original, side, tolerance, threads)
    bent_vertices = np.empty(0, dtype=np.int64)
    assumed_near = np.zeros(len(candidate.faces), dtype=bool)  # faces with all faces around them aligned
    for n in range(ROUNDS):
        if n > 0:
            samples = samples.remeasure(candidate, tolerance, threads)
        still = find_pinned_faces(candidate, pinned)
        changed, owner, points = samples.unsure, samples.owner, samples.points
        missed = np.flatnonzero(samples.away > tolerance)
        if still is not None:
            changed, missed = changed[~still[changed]], missed[~still[owner[missed]]]
        assumed_near = np.concatenate([assumed_near, np.zeros(len(candidate.faces) - len(assumed_near), dtype=bool)])
        own = TriangleTree.of(candidate)
        assumed_near[changed] = aligned_faces(candidate, tolerance, faces=changed, tree=own, threads=threads)
        strays = find_strays(
            tree, candidate, changed, side, tolerance, sure=assumed_near[changed], own=own, threads=threads
        )
        if n > 0:
            bent_vertices = np.union1d(bent_vertices, candidate.faces[changed])
        if not len(missed) and not len(strays.points):
            samples = replace(samples, unsure=np.empty(0, dtype=np.int64))
            crossing = _drop_pinned(intersecting_pairs(candidate, tree=own, threads=threads), still)
            if len(crossing):
                failed = _corners_of_faces(candidate, crossing)
                candidate, changed = _push_apart(candidate, crossing, tolerance, pinned)
                if not len(changed):
                    break
                samples = replace(samples, unsure=changed)
                continue
            if n == 0:
                return candidate, np.empty((0, 3)), samples
            beside = np.isin(candidate.faces, bent_vertices).any(axis=1)  # pieces of them were aligned before
            bent = np.flatnonzero(assumed_near | beside)
            bent = bent if still is None else bent[~still[bent]]
            bent = bent[~aligned_faces(candidate, tolerance, faces=bent, tree=own, threads=threads)]
            assumed_near[bent] = False
            strays = find_strays(tree, candidate, bent, side, tolerance, own=own, threads=threads)
            if not len(strays.points):
                return candidate, np.empty((0, 3)), samples
        faces = np.concatenate([owner[missed], strays.face])
        targets = np.concatenate([points[missed], _project_to_faces(original, strays.owner, strays.points)])
        sources = np.concatenate([_project_to_faces(candidate, owner[missed], points[missed]), strays.points])
        distance = np.concatenate([samples.away[missed], strays.away])
        targets = sources + (1 - TARGET_SHARE ** (n + 1) * tolerance / distance)[:, None] * (targets - sources)
        worst = _worst_of_each(faces, distance)
        failed = sources[worst]
        candidate, changed = _bend_to_targets(
            candidate, faces[worst], failed, targets[worst], NEAR_CORNER[n >= FIRST_ROUNDS], pinned
        )
        samples = replace(samples, unsure=changed)
    return candidate, failed, replace(samples, found=candidate)


def _worst_of_each(faces: Integers, distance: Floats) -> Integers:
    """Find the place of each face (N,) that is furthest away; return their indices, the furthest first.

    Each bend keeps its neighbours as they are: in another order, a near place next to the furthest one might win.

    >>> _worst_of_each(np.array([7, 7, 3, 5]), np.array([1.0, 4.0, 2.0, 3.0])).tolist()
    [1, 3, 2]
    """
    worst = np.argsort(-distance, kind="stable")
    one_of_each: Integers = worst[np.sort(np.unique(faces[worst], return_index=True)[1])]
    return one_of_each


def _project_to_faces(surface: Surface, faces: Integers, places: Floats) -> Floats:
    """Project each place onto its face; return the nearest points."""
    return nearest_on_triangles(np.asarray(surface.vertices, dtype=np.float64)[surface.faces[faces]], places)


def find_pinned_faces(surface: Surface, pinned: Mask | None) -> Mask | None:
    """Mark the faces (F,) whose corners are all pinned, (V,) or fewer; None without pinned vertices."""
    return None if pinned is None else _pad(pinned, len(surface.vertices))[surface.faces].all(axis=1)


def _pad(pinned: Mask, count: int) -> Mask:
    """Return a mask of vertices with those that came later, which are not pinned."""
    return np.concatenate([pinned, np.zeros(count - len(pinned), dtype=bool)])


def _drop_pinned(pairs: Integers, still: Mask | None) -> Integers:
    """Return the pairs (N, 2) of faces of which at least one is not pinned."""
    return pairs if still is None else pairs[~still[pairs].all(axis=1)]


def _bend_to_targets(
    surface: Surface, face: Integers, sources: Floats, targets: Floats, close: float, pinned: Mask | None = None
) -> tuple[Surface, Integers]:
    """Turn a place on each of some faces into a vertex and move it; return the surface and the faces that changed."""
    from infill.kernels.corners import pair_edges, pair_open_edges

    start = np.array(surface.faces, dtype=np.int32).ravel()
    twin = np.empty(len(start), dtype=np.int32)
    (pair_edges if pinned is None else pair_open_edges)(start, len(surface.vertices), twin)
    stays = None if pinned is None else _pad(pinned, len(surface.vertices))
    vertices, faces = [np.asarray(surface.vertices, dtype=np.float64)], surface.faces.copy()
    moved, count, new_faces = vertices[0].copy(), len(surface.vertices), []
    touched = np.zeros(len(faces), dtype=bool)
    shares = np.nan_to_num(barycentric(moved[surface.faces[face]], sources), nan=1 / 3)
    order = np.argsort(start, kind="stable")
    fan_start = np.searchsorted(start[order], np.arange(count + 1))
    for index, share, target in zip(face.tolist(), shares, targets, strict=True):
        small_shares = np.flatnonzero(share < NEAR_EDGE)
        if share.max() > 1 - close:
            vertex = surface.faces[index, int(share.argmax())]
            if stays is not None and stays[vertex]:
                continue
            fan_faces = order[fan_start[vertex] : fan_start[vertex + 1]] // 3  # of all fans, where several meet
            if not touched[fan_faces].any():
                moved[vertex] = target
                touched[fan_faces] = True
            continue
        k = int(share.argmin())
        opposite = 3 * index + (k + 1) % 3  # the edge across from the corner with the least share
        if stays is not None and len(small_shares) and stays[np.delete(surface.faces[index], k)].all():
            continue  # the neighbour is pinned, or there is none
        neighbour = int(twin[opposite]) // 3 if len(small_shares) else index
        if touched[index] or touched[neighbour]:
            continue
        vertices.append(target[None])
        a, b, c = np.roll(faces[index], -k)
        if len(small_shares):
            d = faces[neighbour][(int(twin[opposite]) + 2) % 3]
            faces[index], faces[neighbour] = (a, b, count), (d, c, count)
            new_faces += [(a, count, c), (d, count, b)]
        else:
            faces[index] = (a, b, count)
            new_faces += [(b, c, count), (c, a, count)]
        touched[index] = touched[neighbour] = True
        count += 1
    vertices[0] = moved
    touched[face] = True
    changed = np.concatenate([np.flatnonzero(touched), len(faces) + np.arange(len(new_faces))])
    appended = np.array(new_faces, dtype=faces.dtype).reshape(-1, 3)
    return replace(surface, vertices=np.concatenate(vertices), faces=np.concatenate([faces, appended])), changed


def _push_apart(
    surface: Surface, pairs: Integers, tolerance: float, pinned: Mask | None = None
) -> tuple[Surface, Integers]:
    """Push crossing triangles apart; return the surface and the faces that changed.

    Of each pair (N, 2), one corner goes to the other side of the other triangle's plane: of the corners alone on their
    side, the one nearest to the plane. Triangles that reach too far into each other stay.
    """
    vertices = np.array(surface.vertices, dtype=np.float64)
    ordered_pairs = np.concatenate([pairs, pairs[:, ::-1]])
    triangles, targets = vertices[surface.faces[ordered_pairs[:, 0]]], vertices[surface.faces[ordered_pairs[:, 1]]]
    normal = np.cross(targets[:, 1] - targets[:, 0], targets[:, 2] - targets[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)
    above = np.einsum("pki,pi->pk", triangles - targets[:, :1], normal)
    alone = np.where((above > 0).sum(axis=1, keepdims=True) == 1, above > 0, above <= 0)
    depth = np.where(alone & (alone.sum(axis=1, keepdims=True) == 1), np.abs(above), np.inf)
    k = depth.argmin(axis=1)
    deep = depth[np.arange(len(ordered_pairs)), k].reshape(2, -1)
    shallow = np.flatnonzero(deep.min(axis=0) <= SHALLOW * tolerance)
    best = shallow + len(pairs) * deep[:, shallow].argmin(axis=0)
    vertex, shift = surface.faces[ordered_pairs[best, 0], k[best]], above[best, k[best]]
    shift += np.copysign(GAP * tolerance, shift)
    if pinned is not None:
        free = ~_pad(pinned, len(vertices))[vertex]
        vertex, shift, best = vertex[free], shift[free], best[free]
    moved, pair_index = np.unique(vertex, return_index=True)
    vertices[moved] -= shift[pair_index, None] * normal[best[pair_index]]
    return replace(surface, vertices=vertices), np.flatnonzero(np.isin(surface.faces, moved).any(axis=1))


def crossing_corners(surface: Surface, threads: int | None = None, pinned: Mask | None = None) -> Floats:
    """Return the corners (N, 3) of the triangles that pass through each other, mm; not of two that are both pinned."""
    pairs = _drop_pinned(intersecting_pairs(surface, threads=threads), find_pinned_faces(surface, pinned))
    return _corners_of_faces(surface, pairs)


def _corners_of_faces(surface: Surface, faces: Integers) -> Floats:
    """Return the corners of some faces, three rows for each distinct face, mm."""
    corners: Floats = np.asarray(surface.vertices, dtype=np.float64)[surface.faces[np.unique(faces)]].reshape(-1, 3)
    return corners
