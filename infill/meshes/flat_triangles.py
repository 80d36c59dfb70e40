"""Triangles without an area, whose three corners lie on one line: the edge they share with a neighbour is flipped."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.surface import Surface

FLAT = 1e-12  # a triangle of less than this share of its longest side squared has no area
MOST_ROUNDS = 10  # of flips: flat triangles side by side take one each


def find_flat_triangles(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Mark the triangles (F, 3) without an area.

    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]])
    >>> find_flat_triangles(points, np.array([[0, 1, 2], [0, 1, 3]])).tolist()
    [True, False]
    """
    a, b, c = (np.asarray(vertices, dtype=np.float64)[faces[:, corner]] for corner in range(3))
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    longest = np.max([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return np.asarray(doubled <= FLAT * longest)


def flip_flat_triangles(surface: Surface, *, unless_in: Surface | None = None) -> Surface:
    """Flip the longest edge of triangles without an area, so that none is left where the mesh allows it.

    The middle corner of such a triangle lies on the edge, and so the shape stays as it is. A triangle counts as flat
    too if its corners come to lie on one line as STL rounds them, to single precision.

    Parameters
    ----------
    surface : Surface
        Closed, every edge shared by two triangles.
    unless_in : Surface, optional
        If this surface, such as a skin that stays as it was, has triangles without an area, nothing is changed.

    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [1, -1, 0], [1, 0, 1]])
    >>> faces = np.array([[0, 2, 1], [2, 0, 3], [0, 1, 4], [1, 2, 4], [3, 0, 4], [2, 3, 4]])
    >>> flip_flat_triangles(Surface(vertices=points, faces=faces)).faces[:2].tolist()
    [[0, 3, 1], [3, 2, 1]]
    """
    faces = np.asarray(surface.faces)
    flat = _is_flat(surface.vertices, faces)
    if not flat.any() or (unless_in is not None and _is_flat(unless_in.vertices, np.asarray(unless_in.faces)).any()):
        return surface
    for _ in range(MOST_ROUNDS):
        flipped = _flip(surface.vertices, faces, flat)
        if flipped is None:
            break
        changed = (flipped != faces).any(axis=1)
        faces = flipped
        flat[changed] = _is_flat(surface.vertices, faces[changed])
        if not flat.any():
            break
    return replace(surface, faces=faces)


def _is_flat(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Mark flat triangles, at full precision or at that of STL."""
    return find_flat_triangles(vertices, faces) | find_flat_triangles(vertices.astype(np.float32), faces)


def _flip(
    vertices: NDArray[np.floating], faces: NDArray[np.integer], flat: NDArray[np.bool_]
) -> NDArray[np.integer] | None:
    """Flip as many of the flat triangles as are independent of each other; return None if none can be."""
    corner_of_flat = np.zeros(len(vertices), dtype=bool)
    corner_of_flat[faces[flat]] = True
    near = np.flatnonzero(corner_of_flat[faces].any(axis=1))  # all faces that share a corner with a flat one
    number, corners = np.flatnonzero(flat), faces[flat]
    places = np.asarray(vertices, dtype=np.float64)[corners]
    longest = ((places - np.roll(places, -1, axis=1)) ** 2).sum(axis=2).argmax(axis=1)
    a, b, c = (corners[np.arange(len(corners)), (longest + step) % 3] for step in range(3))
    count = np.int64(len(vertices))
    starts, ends = faces[near], np.roll(faces[near], -1, axis=1)
    directed = (starts * count + ends).ravel()
    order = np.argsort(directed, kind="stable")
    keys = directed[order]
    at = np.minimum(np.searchsorted(keys, b * count + a), len(keys) - 1)
    neighbour, side = np.divmod(order[at], 3)
    neighbour = near[neighbour]
    d = faces[neighbour, (side + 2) % 3]
    new_edge = np.minimum(c, d) * count + np.maximum(c, d)
    old_edges = np.minimum(starts, ends) * count + np.maximum(starts, ends)
    possible = (keys[at] == b * count + a) & ~np.isin(new_edge, old_edges) & (c != d)
    flipped_a, flipped_b = np.stack([a, d, c], axis=1), np.stack([d, b, c], axis=1)
    possible &= ~(_is_flat(vertices, flipped_a) | _is_flat(vertices, flipped_b))
    taken: set[int] = set()
    for index in np.flatnonzero(possible).tolist():
        used = {int(number[index]), int(neighbour[index]), -1 - int(new_edge[index])}
        if used & taken:
            possible[index] = False
        taken |= used
    if not possible.any():
        return None
    flipped = faces.copy()
    flipped[number[possible]] = flipped_a[possible]
    flipped[neighbour[possible]] = flipped_b[possible]
    return flipped
