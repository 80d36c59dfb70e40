"""Fewer triangles, with the mesh still closed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from infill.checks import positive, whole
from infill.errors import GeometryError
from infill.surface import Surface
from infill.surfaces.distance import distances

FEWEST = 4
PART = 0.2  # of the tolerance, for the manifold library, which moves two or three times as far as it says
SHARES = (0.25, 0.15, 0.1, 0.06)  # of the triangles: as few as fit
SIDE = 100.0  # of the longest side while quadrics are computed
SHIFT = 0.1  # of the mean edge: how far vertices may move so that the volume stays
HALVINGS = 8
COMPARED = 20_000  # vertices whose distance is measured


def simplified(
    surface: Surface, *, tolerance: float | None = None, triangles: int | None = None, threads: int | None = None
) -> Surface:
    """Return the surface with fewer triangles.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, optional
        mm by which the surface may move: none of the vertices checked lies further than this from the result.
    triangles : int, optional
        Maximum number of triangles.
    threads : int, optional
        Used to measure distances; see `infill.kernels.threads.thread_count`.

    Raises
    ------
    GeometryError
        If the surface cannot be simplified without opening it, or not to this few triangles.

    Notes
    -----
    Edges are collapsed by quadric errors (Garland and Heckbert 1997, fast-simplification, MIT), which preserve shape
    and volume best. Where that opens the mesh or changes its Euler number, the manifold library (Apache 2.0)
    collapses them, which keeps it closed but may remove components smaller than the tolerance it needs.
    """
    near = None if tolerance is None else positive("tolerance", tolerance, "mm")
    few = None if triangles is None else whole("the number of triangles", triangles, FEWEST)
    some = surface.vertices[:: max(1, len(surface.vertices) // COMPARED)]

    def fits(found: Surface | None) -> bool:
        return found is not None and (near is None or bool(distances(some, found, threads=threads).max() <= near))

    found = _by_quadrics(surface, few, near, fits)
    if found is None:
        found = _by_collapse(surface, few, near, fits)
    if found is None:
        wanted = [] if few is None else [f"at most {few:,} triangles"]
        wanted += [] if near is None else [f"{near:g} mm of leeway"]
        raise GeometryError(
            f"the surface has {len(surface.faces):,} triangles; it cannot be simplified to {' and '.join(wanted)} "
            "without opening or moving further; allow more"
        )
    return found


def lean(surface: Surface, tolerance: float, *, threads: int | None = None) -> Surface:
    """Return the surface with about as few triangles as a tolerance allows, found by a few tries.

    Parameters
    ----------
    surface : Surface, closed, mm
    tolerance : float, mm
        No vertex lies further than this from the result.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.

    Returns
    -------
    Surface
        Closed, with the same Euler number; the surface itself if none of the tries is good enough.

    Notes
    -----
    The manifold library collapses the shortest edges, which are as good as none, and keeps the mesh closed. Quadric
    errors take it from there, as far as they keep it closed: see `simplified`.
    """
    near = positive("tolerance", tolerance, "mm")
    points = np.asarray(surface.vertices, dtype=np.float64)

    def good(found: Surface | None) -> bool:
        return (
            found is not None
            and found.closed
            and found.euler_number == surface.euler_number
            and float(distances(points, found, threads=threads).max()) <= near
        )

    best = _collapse(surface)(PART * near)
    best = best if best is not None and good(best) else surface
    at = _quadrics(best)
    base = len(best.faces)
    for share in SHARES:
        if len(surface.faces) * share >= base:
            continue  # there are fewer already
        fewer = at(len(surface.faces) * share)
        if not good(fewer):
            break
        assert fewer is not None
        best = fewer
    return best


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


def _by_quadrics(
    surface: Surface, few: int | None, near: float | None, fits: Callable[[Surface | None], bool]
) -> Surface | None:
    """Return the surface with the requested number of triangles or as few as fit; None if it would not stay closed."""
    at = _quadrics(surface)
    if near is None:
        found = surface if few is None or few >= len(surface.faces) else at(few)
        return found if few is None or found is None or len(found.faces) <= few else None
    low, high, best = float(FEWEST), float(len(surface.faces)), None
    for _ in range(HALVINGS):
        middle = float(np.sqrt(low * high))
        found = at(middle)
        if found is not None and fits(found):
            best, high = found, middle
        else:
            low = middle
    if few is not None and best is not None and len(best.faces) > few:
        best = at(few)
        best = best if fits(best) else None
    return best


def _quadrics(surface: Surface) -> Callable[[float], Surface | None]:
    """Return what collapses edges down to a number of triangles by quadric errors; None if it would not stay whole."""
    import fast_simplification

    faces = np.asarray(surface.faces, dtype=np.int32)
    low, high = surface.bounds
    size = float((high - low).max()) / SIDE
    # Its limits are lengths: the same whatever unit the mesh is in.
    vertices = (np.asarray(surface.vertices, dtype=np.float64) - low) / size

    def at(count: float) -> Surface | None:
        points, corners = fast_simplification.simplify(vertices, faces, target_count=int(count))
        found = Surface(vertices=np.asarray(points, dtype=np.float64) * size + low, faces=np.asarray(corners))
        whole_still = found.closed and found.euler_number == surface.euler_number and found.volume > 0
        return found if whole_still else None

    return at


def _by_collapse(
    surface: Surface, few: int | None, near: float | None, fits: Callable[[Surface | None], bool]
) -> Surface | None:
    """Return the surface with short edges collapsed, by the largest tolerance that fits or the least that suffices."""
    at = _collapse(surface)
    extent = float(np.ptp(surface.vertices, axis=0).max())
    low, high, best = extent * 1e-7, near or extent / 4, None
    for _ in range(HALVINGS):
        middle = float(np.sqrt(low * high))
        found = at(middle)
        small = found is not None and (few is None or len(found.faces) <= few)
        if small and fits(found):
            best = found
        if few is not None:  # the smallest tolerance that leaves this few
            low, high = (low, middle) if small or found is None else (middle, high)
        else:  # the largest that fits
            low, high = (middle, high) if fits(found) else (low, middle)
    return best


def _collapse(surface: Surface) -> Callable[[float], Surface | None]:
    """Return what collapses edges shorter than a tolerance by the manifold library; None if nothing would be left."""
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

    def at(tolerance: float) -> Surface | None:
        mesh = solid.simplify(tolerance).to_mesh64()
        if len(mesh.tri_verts) == 0:
            return None
        return Surface(vertices=mesh.vert_properties[:, :3], faces=mesh.tri_verts.astype(np.int64))

    return at
