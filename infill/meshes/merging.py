"""Convert a mesh to plain arrays, and merge its vertices where that closes it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh


def surface_of(mesh: trimesh.Trimesh | Surface) -> Surface:
    """Convert a mesh to plain arrays; raise GeometryError if there is nothing to write or read."""
    if not hasattr(mesh, "vertices") or not hasattr(mesh, "faces"):
        is_path = isinstance(mesh, (str, Path))
        advice = "read the file with infill.read_mesh" if is_path else "give a trimesh.Trimesh or a Surface"
        raise GeometryError(f"a {type(mesh).__name__} is not a mesh; {advice}")
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise GeometryError("the mesh has no faces, or corners that are not finite numbers; make it again")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise GeometryError("the mesh has faces with corners that do not exist; make it again")
    return mesh if isinstance(mesh, Surface) else Surface(vertices=vertices, faces=faces)


def merge_unless_closed(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> Surface:
    """Drop unused vertices; merge equal vertices unless the mesh is closed already."""
    used, index = np.unique(faces, return_inverse=True)
    surface = Surface(vertices=np.asarray(vertices, dtype=np.float64)[used], faces=index.reshape(faces.shape))
    return surface if surface.closed else merge_vertices(surface.vertices, surface.faces)


def merge_vertices(vertices: NDArray[np.floating], faces: NDArray[np.integer]) -> Surface:
    """Merge equal vertices of a mesh."""
    points = vertices + 0.0  # no -0, which equals 0 but has different bits
    order = np.lexsort(points.T)
    is_new = np.concatenate([[True], (points[order][1:] != points[order][:-1]).any(axis=1)])
    number = np.empty(len(points), dtype=np.intp)
    number[order] = np.cumsum(is_new) - 1
    return Surface(vertices=points[order[is_new]].astype(np.float64), faces=number[faces])
