"""Count the voids that solid seals: resin and powder stay in them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.meshes.split_components import edge_components
from infill.surface import Surface

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SAMPLES = 5  # faces of a shell above which the others are counted; most of them decide


def count_sealed_voids(surface: Surface) -> int:
    """Count the voids of a closed surface that have no way out.

    Parameters
    ----------
    surface : Surface, mm
        If all of it is inside out, the voids are those of the surface turned.

    Notes
    -----
    A void is a shell that faces inwards and around which other shells wind once: solid lies outside it, and none
    inside. So a solid in a void in a solid leaves one void, a shell that faces outwards within solid leaves none, as
    slicers print the union, and neither does one that faces inwards where there is no solid. Shells are joined by
    edges: those that touch in a vertex are two.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> around, inside = 9 * corners - 4, faces[:, ::-1] + 4
    >>> count_sealed_voids(Surface(vertices=np.concatenate([around, corners]), faces=np.concatenate([faces, inside])))
    1
    """
    vertices = np.asarray(surface.vertices, dtype=np.float64)
    vertices = vertices - vertices.mean(axis=0)
    faces = surface.faces.astype(np.int64, copy=False)
    shell, count = edge_components(vertices, faces)
    if count < 2:
        return 0
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    volume = np.bincount(shell, weights=np.einsum("ij,ij->i", a, np.cross(b, c)), minlength=count)
    way = 1 if volume.sum() >= 0 else -1
    inward = np.flatnonzero(way * volume < 0)
    if len(inward) == 0:
        return 0
    order = np.argsort(shell, kind="stable")
    first, after = np.searchsorted(shell[order], [inward, inward + 1])
    steps = np.linspace(0, 1, SAMPLES + 2)[1:-1]
    chosen = order[first[:, None] + (steps * (after - first)[:, None]).astype(np.int64)]
    around = _winding_of_others(vertices, faces, shell, chosen.ravel()).reshape(chosen.shape)
    return int((np.count_nonzero(way * around == 1, axis=1) * 2 > SAMPLES).sum())


def _winding_of_others(vertices: Floats, faces: Integers, shell: NDArray[np.integer], chosen: Integers) -> Integers:
    """Return how often the shells wind around the middle of some faces, each less its own shell, (N,).

    Triangles above a point count, as in `infill.kernels.distances.wind`: of an edge that passes exactly over a point,
    one of its two triangles has it.
    """
    import shapely

    points = vertices[faces[chosen]].mean(axis=1)
    corners = vertices[faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    near = np.flatnonzero(high[:, 2] > points[:, 2].min())
    tree = shapely.STRtree(shapely.box(low[near, 0], low[near, 1], high[near, 0], high[near, 1]))
    which, triangle = tree.query(shapely.points(points[:, :2]))
    triangle = near[triangle]
    other = (shell[triangle] != shell[chosen[which]]) & (high[triangle, 2] > points[which, 2])
    which, triangle = which[other], triangle[other]
    flat = corners[triangle][:, :, :2] - points[which, None, :2]
    over = corners[triangle][:, :, 2]
    passed = np.zeros(len(which), dtype=np.int64)
    weights = np.empty((len(which), 3))
    for i in range(3):
        (px, py), (qx, qy) = flat[:, i].T, flat[:, (i + 1) % 3].T
        weights[:, (i + 2) % 3] = px * qy - qx * py
        upwards = (qy > 0).astype(np.int64) - (py > 0)
        passed += np.where(upwards * (px * qy - qx * py) > 0, upwards, 0)
    whole = weights.sum(axis=1)
    height = np.divide((weights * over).sum(axis=1), whole, out=np.full(len(which), -np.inf), where=whole != 0)
    found = np.zeros(len(chosen), dtype=np.int64)
    np.add.at(found, which, np.where(height > points[which, 2], passed, 0))
    return found
