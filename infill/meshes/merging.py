"""Convert a mesh to plain arrays, and merge its vertices where that closes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.surface import Surface

if TYPE_CHECKING:
    import trimesh


class WholeMesh(Protocol):
    """A result with all its surfaces as one."""

    @property
    def whole(self) -> Surface:
        """All surfaces, mm."""
        ...


def surface_of(mesh: trimesh.Trimesh | Surface | WholeMesh) -> Surface:
    """Convert a mesh, or a result of phasefill, to plain arrays; raise GeometryError if there is nothing in it."""
    given: Any = getattr(mesh, "whole", mesh)
    if not hasattr(given, "vertices") or not hasattr(given, "faces"):
        raise GeometryError(f"a {type(mesh).__name__} is not a mesh; give a trimesh.Trimesh, a Surface or a path")
    vertices, faces = np.asarray(given.vertices), np.asarray(given.faces)
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise GeometryError("the mesh has no faces, or corners that are not finite numbers; make it again")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise GeometryError("the mesh has faces with corners that do not exist; make it again")
    return given if isinstance(given, Surface) else Surface(vertices=vertices, faces=faces)


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
