"""Fewer triangles, with the mesh still closed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from infill.checks import positive, whole
from infill.errors import GeometryError
from infill.meshes.edge_collapse import collapsed
from infill.surface import Surface

FEWEST = 4
SAFE = 0.87  # of the tolerance: between the places at which distances are measured, they are up to a seventh larger
SHIFT = 0.1  # of the mean edge: how far vertices may move so that the volume stays


def simplified(
    surface: Surface, *, tolerance: float | None = None, triangles: int | None = None, threads: int | None = None
) -> Surface:
    """Return the surface with fewer triangles.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, optional
        mm by which the surface may move: neither surface lies further than this from the other.
    triangles : int, optional
        Maximum number of triangles.
    threads : int, optional
        Used to measure distances; see `infill.kernels.threads.thread_count`.

    Raises
    ------
    GeometryError
        If the surface is not closed, or cannot be simplified to this few triangles without opening it.

    See Also
    --------
    infill.meshes.edge_collapse.collapsed : How it is done.
    """
    near = None if tolerance is None else positive("tolerance", tolerance, "mm")
    few = FEWEST if triangles is None else whole("max_triangles", triangles, FEWEST)
    found = collapsed(surface, tolerance=None if near is None else SAFE * near, triangles=few, threads=threads)
    if found is None:
        raise GeometryError(
            "the surface cannot be simplified: not every edge is shared by exactly two triangles; leave it as it is"
        )
    if triangles is not None and len(found.faces) > few:
        leeway = "" if near is None else f" and {near:g} mm of leeway"
        raise GeometryError(
            f"the surface has {len(surface.faces):,} triangles; it cannot be simplified to at most {few:,} triangles"
            f"{leeway}, only to {len(found.faces):,}; allow more"
        )
    return found


def with_volume(surface: Surface, volume: float) -> Surface:
    """Return the surface with its vertices moved along their normals, all equally far, so that it has a volume, mm³.

    If it would have to move further than a tenth of its mean edge, it is returned as it is.

    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> solid = Surface(vertices=points, faces=np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> round(with_volume(solid, 0.167).volume, 3)
    0.167
    """
    points = np.asarray(surface.vertices, dtype=np.float64)
    corners = points[surface.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    area = float(np.linalg.norm(normals, axis=1).sum())
    farthest = SHIFT * float(np.sqrt(area / max(len(surface.faces), 1)))
    own = np.zeros_like(points)
    for corner in range(3):
        np.add.at(own, surface.faces[:, corner], normals)
    own /= np.maximum(np.linalg.norm(own, axis=1, keepdims=True), 1e-300)
    moved = surface
    for _ in range(2):
        by = (volume - moved.volume) / area
        if abs(by) > farthest:
            return surface
        moved = replace(moved, vertices=np.asarray(moved.vertices, dtype=np.float64) + by * own)
    return moved
