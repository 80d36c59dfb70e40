"""Closed surfaces as solids of manifold3d: what it says of them, with fewer triangles, and united."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import reduce
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.meshes.hole_filling import open_edges
from infill.meshes.shells import with_faces
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

FINE = "NoError"
LONE = np.arange(3, dtype=np.uint32)[None]  # triangle
Place = tuple[float, ...]
# Of what is asked of it, tried in turn: where an edge would have four faces, manifold3d makes two edges in one place.
SHARES = (1.0, 0.93, 0.85, 0.75, 0.6)
ASIDE = 0.1  # of a tolerance: how far such edges are moved apart
MOVED = 0.4  # of a tolerance: what is asked of manifold3d, which measures each step from the one before


def solid_of(surface: Surface, *, single: bool = False) -> manifold3d.Manifold:
    """Hand a surface to manifold3d, in single or double precision; return its solid, whose status may be a refusal.

    Open surfaces are not handed over: manifold3d 3.5 ends the process with a segmentation fault on some of them, those
    with an odd number of faces in an unlucky order. A lone triangle, which it refuses, takes their place.
    """
    import manifold3d

    if surface.edges is None or surface.edges.surplus.any():
        return manifold3d.Manifold(manifold3d.Mesh(vert_properties=np.eye(3, dtype=np.float32), tri_verts=LONE))
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

    It takes a hundredth of the time and memory of `infill.meshes.simplification.simplified`, and leaves more
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
    for share in (*SHARES, 0.0):
        few = surface
        if share:
            few = surface_from(solid.simplify(share * MOVED * tolerance))
            few = replace(few, faces=few.faces.astype(surface.faces.dtype), space=surface.space)
        if (twins := in_one_place(few)).any():
            few = _moved_inwards(few, twins, ASIDE * tolerance)
        if few.closed and not in_one_place(few).any():
            return few
    return surface


def shortened_between(surface: Surface, tolerance: float) -> Surface:
    """Return what `shortened` does of a surface with open edges, all of which stay as they are.

    Parameters
    ----------
    surface : Surface
        A part of a closed one that faces outwards: every open edge has one face, and as many lead to a vertex as away.
    tolerance : float
        mm, or whatever the unit of the vertices is.

    Notes
    -----
    Open edges get a face each that leads to a point, one for each loop. As manifold3d is told that no two of those are
    of one plane, it takes their vertices only where edges are far shorter than the tolerance; these are put back.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(5)
    >>> half = Surface(vertices=ball.vertices, faces=ball.faces[ball.triangles_center[:, 2] > 0])
    >>> few = shortened_between(half, 0.02)
    >>> len(few.faces) < len(half.faces) / 3, len(open_edges(few.faces)) == len(open_edges(half.faces))
    (True, True)
    """
    import manifold3d

    edges = open_edges(surface.faces)
    if not len(edges):
        return shortened(surface, tolerance)
    many, given = len(surface.vertices), len(surface.faces)
    loop, loops = _loops(edges)
    (_, _, low), (_, _, high) = surface.bounds
    above = float(high + (high - low) + 1)  # where nothing else is
    middles = np.stack([np.bincount(loop, surface.vertices[edges[:, 0], axis]) for axis in range(2)], axis=1)
    tips = np.column_stack([middles / np.bincount(loop)[:, None], np.full(loops, above)])
    vertices = np.concatenate([np.asarray(surface.vertices, dtype=np.float64), tips])
    lids = np.column_stack([edges[:, ::-1], many + loop])
    planes = np.concatenate([np.zeros(given, dtype=np.uint64), np.arange(1, len(lids) + 1, dtype=np.uint64)])
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(
            vert_properties=np.ascontiguousarray(vertices),
            tri_verts=np.concatenate([surface.faces, lids]).astype(np.uint64),
            face_id=planes,
        )
    )
    if status_of(solid) != FINE:
        return surface
    for share in SHARES:
        mesh = solid.simplify(share * MOVED * tolerance).to_mesh64()
        faces = np.array(mesh.tri_verts).astype(np.int32)[np.array(mesh.face_id) == 0]
        few = with_faces(
            Surface(vertices=np.array(mesh.vert_properties)[:, :3], faces=faces, space=surface.space),
            np.ones(len(faces), dtype=bool),
        )
        held = np.zeros(len(few.vertices), dtype=bool)
        held[(now := open_edges(few.faces)).ravel()] = True
        if (twins := in_one_place(few) & ~held).any():
            few = _moved_inwards(few, twins, ASIDE * tolerance)
        whole = _with_rim(few, now, vertices[edges])
        if whole is not None and not in_one_place(whole).any():
            return whole
    return surface


def _with_rim(surface: Surface, edges: NDArray[np.integer], rim: NDArray[np.floating]) -> Surface | None:
    """Return a surface whose open edges (E, 2) run through all points of a rim, or None if they leave it.

    Parameters
    ----------
    rim : (R, 2, 3) float64
        From where to where each edge leads that was there before.
    """
    follows = dict(zip(map(tuple, rim[:, 0].tolist()), map(tuple, rim[:, 1].tolist()), strict=True))
    places = list(map(tuple, np.asarray(surface.vertices)[edges].reshape(-1, 3).tolist()))
    if len(follows) < len(rim) or any(place not in follows for place in places):
        return None
    count, faces = len(surface.vertices), surface.faces
    codes = faces.astype(np.int64) * count + np.roll(faces, -1, axis=1)
    gone: list[Place] = []
    cut: list[int] = []
    pieces: list[tuple[int, int, int]] = []
    for (start, end), place, last in zip(edges.tolist(), places[::2], places[1::2], strict=True):
        between = list(_between(follows, place, last))
        if between:
            ((face, side),) = np.argwhere(codes == start * count + end).tolist()
            line = [start, *range(count + len(gone), count + len(gone) + len(between)), end]
            cut.append(face)
            pieces.extend((one, other, int(faces[face, (side + 2) % 3])) for one, other in pairwise(line))
            gone.extend(between)
    if len(edges) + len(gone) != len(rim) or len(set(cut)) < len(cut):
        return None
    if not gone:
        return surface
    return replace(
        surface,
        vertices=np.concatenate([surface.vertices, np.array(gone)]),
        faces=np.concatenate([np.delete(faces, cut, axis=0), np.array(pieces, dtype=faces.dtype)]),
    )


def _between(follows: dict[Place, Place], start: Place, end: Place) -> Iterator[Place]:
    """Yield what lies between two places of a loop."""
    at = follows[start]
    while at not in (start, end):
        yield at
        at = follows[at]


def _loops(edges: NDArray[np.integer]) -> tuple[NDArray[np.int32], int]:
    """Return the loop of each of some edges (E, 2), and how many loops there are."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ends = np.unique(edges, return_inverse=True)[1].reshape(edges.shape)
    graph = coo_array((np.ones(len(edges), dtype=np.int8), tuple(ends.T)), shape=(int(ends.max()) + 1,) * 2)
    count, names = connected_components(graph, directed=False)
    return names[ends[:, 0]], int(count)


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
