"""Count the voids that solid seals off: resin and powder stay in them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.meshes.split_components import edge_components
from infill.surface import Surface

SAMPLES = 5  # faces of a shell at which the windings of other shells are counted; the majority decides


def count_sealed_voids(surface: Surface) -> int:
    """Count the voids of a closed surface that have no way out.

    Parameters
    ----------
    surface : Surface, mm
        If all of it is inside out, the voids are those of the surface turned.

    Notes
    -----
    A void is a shell that faces inwards and around which other shells wind once: solid lies outside it, and none
    inside. So a solid in a void in a solid leaves one void. A shell that faces outwards within solid leaves none, as
    slicers print the union, and so does a shell that faces inwards outside all solid. Shells are joined by edges:
    two that touch in a vertex are separate.

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
    orientation = 1 if volume.sum() >= 0 else -1
    inward = np.flatnonzero(orientation * volume < 0)
    if len(inward) == 0:
        return 0
    order = np.argsort(shell, kind="stable")
    begin, end = np.searchsorted(shell[order], [inward, inward + 1])
    steps = np.linspace(0, 1, SAMPLES + 2)[1:-1]
    sampled = order[begin[:, None] + (steps * (end - begin)[:, None]).astype(np.int64)]
    windings = _winding_of_others(vertices, faces, shell, sampled.ravel()).reshape(sampled.shape)
    return int((np.count_nonzero(orientation * windings == 1, axis=1) * 2 > SAMPLES).sum())


def _winding_of_others(vertices: Floats, faces: Integers, shell: NDArray[np.integer], chosen: Integers) -> Integers:
    """Count the windings of all other shells around the centroids of some faces, (N,).

    Triangles above a point count, as in `count_windings` of the kernels: where an edge passes exactly over a point, one
    of its two triangles counts.
    """
    import shapely

    points = vertices[faces[chosen]].mean(axis=1)
    corners = vertices[faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    above = np.flatnonzero(high[:, 2] > points[:, 2].min())
    tree = shapely.STRtree(shapely.box(low[above, 0], low[above, 1], high[above, 0], high[above, 1]))
    sample, triangle = tree.query(shapely.points(points[:, :2]))
    triangle = above[triangle]
    counts = (shell[triangle] != shell[chosen[sample]]) & (high[triangle, 2] > points[sample, 2])
    sample, triangle = sample[counts], triangle[counts]
    flat = corners[triangle][:, :, :2] - points[sample, None, :2]
    heights = corners[triangle][:, :, 2]
    passed = np.zeros(len(sample), dtype=np.int64)
    weights = np.empty((len(sample), 3))
    for i in range(3):
        (px, py), (qx, qy) = flat[:, i].T, flat[:, (i + 1) % 3].T
        weights[:, (i + 2) % 3] = px * qy - qx * py
        upwards = (qy > 0).astype(np.int64) - (py > 0)
        passed += np.where(upwards * (px * qy - qx * py) > 0, upwards, 0)
    doubled_area = weights.sum(axis=1)
    height = np.divide(
        (weights * heights).sum(axis=1), doubled_area, out=np.full(len(sample), -np.inf), where=doubled_area != 0
    )
    windings = np.zeros(len(chosen), dtype=np.int64)
    np.add.at(windings, sample, np.where(height > points[sample, 2], passed, 0))
    return windings
