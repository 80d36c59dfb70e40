"""Fewer triangles, with the mesh still closed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from infill.checks import check_positive, check_whole_number
from infill.errors import GeometryError
from infill.meshes.edge_collapse import collapse_edges
from infill.plain_numbers import plain_argument
from infill.surface import Surface

FEWEST = 4
SAFE = 0.87  # of the tolerance: between samples, distances are up to a seventh larger
SHIFT = 0.1  # of the mean edge: farthest that vertices may move to keep the volume


def simplify_surface(
    surface: Surface,
    *,
    tolerance: float | None = None,
    triangles: int | None = None,
    threads: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Surface:
    """Simplify a surface to fewer triangles.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, optional
        mm by which the surface may move: neither surface lies further than this from the other.
    triangles : int, optional
        Maximum number of triangles.
    threads : int, optional
        Used to measure distances; see `infill.kernels.threads.thread_count`.
    progress : callable, optional
        See `infill.meshes.edge_collapse.collapse_edges`.

    Raises
    ------
    GeometryError
        If the surface is not closed, or cannot be simplified this far without opening it.

    See Also
    --------
    infill.meshes.edge_collapse.collapsed : The method.
    """
    leeway_mm = None if tolerance is None else check_positive("tolerance", tolerance, "mm")
    limit = FEWEST if triangles is None else check_whole_number("max_triangles", triangles, FEWEST)
    result = collapse_edges(
        surface,
        tolerance=None if leeway_mm is None else SAFE * leeway_mm,
        triangles=limit,
        threads=threads,
        progress=progress,
    )
    if result is None:
        raise GeometryError(
            "the surface cannot be simplified: not every edge is shared by exactly two triangles; leave it as it is"
        )
    if triangles is not None and len(result.faces) > limit:
        leeway = "" if leeway_mm is None else f" and {plain_argument(leeway_mm)} mm of leeway"
        raise GeometryError(
            f"the surface has {len(surface.faces):,} triangles; it cannot be simplified to at most {limit:,} triangles"
            f"{leeway}, only to {len(result.faces):,}; allow more"
        )
    return result


def restore_volume(surface: Surface, volume: float) -> Surface:
    """Move all vertices equally far along their normals to restore a volume, mm³; change nothing if that is too far.

    If the vertices would have to move further than a tenth of the mean edge, the surface is returned unchanged.

    >>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> solid = Surface(vertices=points, faces=np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> round(restore_volume(solid, 0.167).volume, 3)
    0.167
    """
    points = np.asarray(surface.vertices, dtype=np.float64)
    corners = points[surface.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    area = float(np.linalg.norm(normals, axis=1).sum())
    farthest = SHIFT * float(np.sqrt(area / max(len(surface.faces), 1)))
    vertex_normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(vertex_normals, surface.faces[:, corner], normals)
    vertex_normals /= np.maximum(np.linalg.norm(vertex_normals, axis=1, keepdims=True), 1e-300)
    moved = surface
    for _ in range(2):
        step = (volume - moved.volume) / area
        if abs(step) > farthest:
            return surface
        moved = replace(moved, vertices=np.asarray(moved.vertices, dtype=np.float64) + step * vertex_normals)
    return moved
