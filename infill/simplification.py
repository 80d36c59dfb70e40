"""Fewer triangles, with the mesh as closed as before."""

from __future__ import annotations

import numpy as np

from infill.checks import positive, whole
from infill.errors import GeometryError
from infill.surface import Surface

FEWEST = 4
HALVINGS = 12


def simplified(surface: Surface, *, tolerance: float | None = None, triangles: int | None = None) -> Surface:
    """Return a surface of fewer triangles.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, optional
        mm by which the surface may move, about.
    triangles : int, optional
        Most triangles to have; the smallest tolerance that does it is looked for.

    Raises
    ------
    GeometryError
        If the surface cannot be simplified without opening it, or not to so few triangles.

    Notes
    -----
    Edges are collapsed by the manifold library (Apache 2.0), which keeps a closed mesh closed.
    """
    import manifold3d

    # In 64 bits: the mesh is closed by its indices, and vertices that are equal in 32 bits would be merged.
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(
            vert_properties=np.asarray(surface.vertices, dtype=np.float64),
            tri_verts=np.asarray(surface.faces, dtype=np.uint64),
        )
    )
    if solid.status() != manifold3d.Error.NoError:
        raise GeometryError(f"the surface cannot be simplified ({solid.status().name}); leave it as it is")
    if tolerance is not None:
        found = solid.simplify(positive("tolerance", tolerance, "mm"))
    else:
        found = solid
    if triangles is not None and found.num_tri() > whole("the number of triangles", triangles, FEWEST):
        found = _few(solid, triangles, float(np.ptp(surface.vertices, axis=0).max()), tolerance or 0.0)
    if found.num_tri() == 0:
        raise GeometryError("nothing would be left of the surface; use a smaller tolerance or more triangles")
    mesh = found.to_mesh64()
    return Surface(vertices=mesh.vert_properties[:, :3], faces=mesh.tri_verts.astype(np.int64))


def _few(solid, triangles: int, extent: float, least: float):  # type: ignore[no-untyped-def]  # noqa: ANN001, ANN202
    """Return the solid at about the smallest tolerance at which it has no more triangles than allowed."""
    low, high = max(least, extent * 1e-7), extent / 4
    best = None
    for _ in range(HALVINGS):
        middle = float(np.sqrt(low * high))
        found = solid.simplify(middle)
        if found.num_tri() > triangles:
            low = middle
        elif found.num_tri() == 0:
            high = middle
        else:
            best, high = found, middle
            if found.num_tri() > 0.95 * triangles:
                break
    if best is None:
        raise GeometryError(
            f"the surface has {solid.num_tri():,} triangles and cannot have as few as {triangles:,}; allow more"
        )
    return best
