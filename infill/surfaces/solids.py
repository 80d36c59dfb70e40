"""Closed surfaces as solids of manifold3d: what it says of them, with fewer triangles, and united."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

FINE = "NoError"
# Of what is asked of it, tried in turn: where an edge would have four faces, manifold3d makes two edges in one place.
SHARES = (1.0, 0.93, 0.85, 0.75, 0.6)
ASIDE = 0.1  # of a tolerance: how far such edges are moved apart
MOVED = 0.4  # of a tolerance: what is asked of manifold3d, which measures each step from the one before


def solid_of(surface: Surface, *, single: bool = False) -> manifold3d.Manifold:
    """Return the surface as manifold3d has it, in single or double precision; it may be none, as its status says."""
    import manifold3d

    if single:
        return manifold3d.Manifold(
            manifold3d.Mesh(
                vert_properties=np.ascontiguousarray(surface.vertices, dtype=np.float32),
                tri_verts=np.ascontiguousarray(surface.faces, dtype=np.uint32),
            )
        )
    return manifold3d.Manifold(
        manifold3d.Mesh64(
            vert_properties=np.ascontiguousarray(surface.vertices, dtype=np.float64),
            tri_verts=np.ascontiguousarray(surface.faces, dtype=np.uint64),
        )
    )


def status(surface: Surface, *, single: bool = False) -> str:
    """Return the verdict of manifold3d: "NoError" if it takes the surface as a solid."""
    return str(solid_of(surface, single=single).status().name)


def surface_from(solid: manifold3d.Manifold) -> Surface:
    """Return a solid of manifold3d as plain arrays."""
    mesh = solid.to_mesh64()
    return Surface(vertices=np.array(mesh.vert_properties)[:, :3], faces=np.array(mesh.tri_verts).astype(np.int64))


def shortened(surface: Surface, tolerance: float) -> Surface:
    """Return a surface with fewer triangles, from some of its vertices, that lies within a tolerance, mm, of it.

    It takes a hundredth of the time and memory of `infill.surfaces.simplification.simplified`, and leaves more
    triangles. A surface that manifold3d does not take is returned as it is.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(5)
    >>> few = shortened(Surface(vertices=ball.vertices, faces=ball.faces), 0.05)
    >>> len(few.faces) < len(ball.faces) / 4, few.closed
    (True, True)
    """
    solid = solid_of(surface)
    if status_of(solid) != FINE:
        return surface
    for share in SHARES:
        few = replace(surface_from(solid.simplify(share * MOVED * tolerance)), space=surface.space)
        if (twins := in_one_place(few)).any():
            few = _moved_inwards(few, twins, ASIDE * tolerance)
        if few.closed and not in_one_place(few).any():
            return few
    return surface


def in_one_place(surface: Surface) -> NDArray[np.bool_]:
    """Return which vertices are where another one is in single precision, as most files have them: (V,).

    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [1 + 1e-9, 0, 0]])
    >>> in_one_place(Surface(vertices=corners, faces=np.array([[0, 1, 2]]))).tolist()
    [False, True, True]
    """
    points = np.asarray(surface.vertices, dtype=np.float32)
    order = np.lexsort(points.T)
    same = (points[order][1:] == points[order][:-1]).all(axis=1)
    found = np.zeros(len(points), dtype=bool)
    found[order[1:][same]] = found[order[:-1][same]] = True
    return found


def _moved_inwards(surface: Surface, some: NDArray[np.bool_], far: float) -> Surface:
    """Return a surface with some vertices moved against the mean normal of their faces, mm."""
    vertices = np.array(surface.vertices, dtype=np.float64)
    faces = surface.faces[some[surface.faces].any(axis=1)]
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal, inwards = np.cross(b - a, c - a), np.zeros_like(vertices)
    for corner in range(3):
        np.subtract.at(inwards, faces[:, corner], normal)
    length = np.linalg.norm(inwards[some], axis=1, keepdims=True)
    vertices[some] += far * np.divide(inwards[some], length, out=np.zeros_like(inwards[some]), where=length > 0)
    return replace(surface, vertices=vertices)


def status_of(solid: manifold3d.Manifold) -> str:
    """Return whether it is one: "NoError" if so."""
    return str(solid.status().name)


def without(surface: Surface, others: Iterable[Surface]) -> Surface | None:
    """Return a closed surface without what others enclose, or None if manifold3d does not take one of them.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> one, other = (Surface(vertices=each.vertices, faces=each.faces) for each in boxes)
    >>> round(without(one, [other]).volume, 6)
    7.0
    """
    solids = [solid_of(each) for each in (surface, *others)]
    if any(status_of(each) != FINE for each in solids):
        return None
    return surface_from(reduce(lambda one, other: one - other, solids))


def volume_within(surface: Surface, other: Surface) -> float:
    """Return the volume that two closed surfaces both enclose; nan if manifold3d does not take one of them.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> round(volume_within(*(Surface(vertices=each.vertices, faces=each.faces) for each in boxes)), 6)
    1.0
    """
    one, two = solid_of(surface), solid_of(other)
    if status_of(one) != FINE or status_of(two) != FINE:
        return float("nan")
    return float((one ^ two).volume())


def united(surfaces: Iterable[Surface]) -> Surface | None:
    """Return the union of closed surfaces, or None if manifold3d does not take one of them.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> both = united([Surface(vertices=each.vertices, faces=each.faces) for each in boxes])
    >>> both.closed, round(both.volume, 6)
    (True, 15.0)
    """
    solids = [solid_of(each) for each in surfaces]
    if not solids or any(status_of(each) != FINE for each in solids):
        return None
    whole = reduce(lambda one, other: one + other, solids)
    return surface_from(whole) if status_of(whole) == FINE and not whole.is_empty() else None
