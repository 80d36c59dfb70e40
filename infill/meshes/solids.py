"""Closed surfaces as solids of manifold3d: check, simplify, subtract, intersect and unite them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import reduce
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.graph import label_connected
from infill.meshes.clipped_volume import find_box, volume_in_box
from infill.meshes.hole_filling import open_edges
from infill.meshes.shells import select_faces
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

FINE = "NoError"
LONE_TRIANGLE = np.arange(3, dtype=np.uint32)[None]  # triangle
Place = tuple[float, ...]
# Of the tolerance, tried in turn: where an edge would have four faces, manifold3d makes two edges in one place.
SHARES = (1.0, 0.93, 0.85, 0.75, 0.6)
TWIN_SHIFT = 0.1  # of a tolerance: distance by which such edges are moved apart
MANIFOLD_SHARE = 0.4  # of a tolerance: passed to manifold3d, which measures each step from the one before


def to_manifold(surface: Surface, *, single: bool = False) -> manifold3d.Manifold:
    """Hand a surface to manifold3d, in single or double precision; return its solid, whose status may report an error.

    Open surfaces are not handed over: manifold3d 3.5 ends the process with a segmentation fault on some of them, those
    with an odd number of faces in an unlucky order. A lone triangle, which manifold3d rejects, takes their place.
    """
    import manifold3d

    if surface.edges is None or surface.edges.surplus.any():
        return manifold3d.Manifold(
            manifold3d.Mesh(vert_properties=np.eye(3, dtype=np.float32), tri_verts=LONE_TRIANGLE)
        )
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


def manifold_status(surface: Surface, *, single: bool = False) -> str:
    """Return the verdict of manifold3d: "NoError" if it accepts the surface as a solid."""
    return str(to_manifold(surface, single=single).status().name)


def from_manifold(solid: manifold3d.Manifold) -> Surface:
    """Convert a solid of manifold3d to a surface."""
    mesh = solid.to_mesh64()
    return Surface(vertices=np.array(mesh.vert_properties)[:, :3], faces=np.array(mesh.tri_verts).astype(np.int64))


def simplify_solid(surface: Surface, tolerance: float) -> Surface:
    """Simplify a surface with manifold3d; the result uses some of its vertices and stays within a tolerance, mm.

    It takes a hundredth of the time and memory of `infill.meshes.simplification.simplify_surface`, and leaves more
    triangles. A surface that manifold3d rejects is returned unchanged.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(5)
    >>> few = simplify_solid(Surface(vertices=ball.vertices, faces=ball.faces), 0.05)
    >>> len(few.faces) < len(ball.faces) / 4, few.closed
    (True, True)
    """
    solid = to_manifold(surface)
    if solid_status(solid) != FINE:
        return surface
    for share in (*SHARES, 0.0):
        simplified = surface
        if share:
            simplified = from_manifold(solid.simplify(share * MANIFOLD_SHARE * tolerance))
            simplified = replace(simplified, faces=simplified.faces.astype(surface.faces.dtype), space=surface.space)
        if (twins := coincident_vertices(simplified)).any():
            simplified = _move_inwards(simplified, twins, TWIN_SHIFT * tolerance)
        if simplified.closed and not coincident_vertices(simplified).any():
            return simplified
    return surface


def simplify_open_piece(surface: Surface, tolerance: float) -> Surface:
    """Simplify a surface with open edges as `simplify_solid` does; all open edges stay unchanged.

    Parameters
    ----------
    surface : Surface
        A part of a closed surface that faces outwards: every open edge has one face, and as many of them lead to a
        vertex as away from it.
    tolerance : float
        mm, or whatever the unit of the vertices is.

    Notes
    -----
    Each open edge gets a face that leads to a tip, one tip for each loop. These faces are marked as lying in different
    planes, so that manifold3d removes their vertices only where edges are far shorter than the tolerance; these
    vertices are put back.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(5)
    >>> half = Surface(vertices=ball.vertices, faces=ball.faces[ball.triangles_center[:, 2] > 0])
    >>> few = simplify_open_piece(half, 0.02)
    >>> len(few.faces) < len(half.faces) / 3, len(open_edges(few.faces)) == len(open_edges(half.faces))
    (True, True)
    """
    import manifold3d

    edges = open_edges(surface.faces)
    if not len(edges):
        return simplify_solid(surface, tolerance)
    vertex_count, face_count = len(surface.vertices), len(surface.faces)
    loop, loops = _label_loops(edges)
    (_, _, low), (_, _, high) = surface.bounds
    above = float(high + (high - low) + 1)  # above the whole surface
    middles = np.stack([np.bincount(loop, surface.vertices[edges[:, 0], axis]) for axis in range(2)], axis=1)
    tips = np.column_stack([middles / np.bincount(loop)[:, None], np.full(loops, above)])
    vertices = np.concatenate([np.asarray(surface.vertices, dtype=np.float64), tips])
    lids = np.column_stack([edges[:, ::-1], vertex_count + loop])
    planes = np.concatenate([np.zeros(face_count, dtype=np.uint64), np.arange(1, len(lids) + 1, dtype=np.uint64)])
    solid = manifold3d.Manifold(
        manifold3d.Mesh64(
            vert_properties=np.ascontiguousarray(vertices),
            tri_verts=np.concatenate([surface.faces, lids]).astype(np.uint64),
            face_id=planes,
        )
    )
    if solid_status(solid) != FINE:
        return surface
    for share in SHARES:
        mesh = solid.simplify(share * MANIFOLD_SHARE * tolerance).to_mesh64()
        faces = np.array(mesh.tri_verts).astype(np.int32)[np.array(mesh.face_id) == 0]
        simplified = select_faces(
            Surface(vertices=np.array(mesh.vert_properties)[:, :3], faces=faces, space=surface.space),
            np.ones(len(faces), dtype=bool),
        )
        on_rim = np.zeros(len(simplified.vertices), dtype=bool)
        on_rim[(rim_edges := open_edges(simplified.faces)).ravel()] = True
        if (twins := coincident_vertices(simplified) & ~on_rim).any():
            simplified = _move_inwards(simplified, twins, TWIN_SHIFT * tolerance)
        closed_rim = _with_rim(simplified, rim_edges, vertices[edges])
        if closed_rim is not None and not coincident_vertices(closed_rim).any():
            return closed_rim
    return surface


def _with_rim(surface: Surface, edges: NDArray[np.integer], rim: NDArray[np.floating]) -> Surface | None:
    """Run the open edges (E, 2) of a surface through all points of a rim; return None if they leave the rim.

    Parameters
    ----------
    rim : (R, 2, 3) float64
        Start and end of each original open edge.
    """
    follows = dict(zip(map(tuple, rim[:, 0].tolist()), map(tuple, rim[:, 1].tolist()), strict=True))
    places = list(map(tuple, np.asarray(surface.vertices)[edges].reshape(-1, 3).tolist()))
    if len(follows) < len(rim) or any(place not in follows for place in places):
        return None
    count, faces = len(surface.vertices), surface.faces
    codes = faces.astype(np.int64) * count + np.roll(faces, -1, axis=1)
    restored: list[Place] = []
    cut: list[int] = []
    pieces: list[tuple[int, int, int]] = []
    for (start, end), place, goal in zip(edges.tolist(), places[::2], places[1::2], strict=True):
        points = list(_points_between(follows, place, goal))
        if points:
            ((face, side),) = np.argwhere(codes == start * count + end).tolist()
            line = [start, *range(count + len(restored), count + len(restored) + len(points)), end]
            cut.append(face)
            pieces.extend(
                (start_vertex, end_vertex, int(faces[face, (side + 2) % 3]))
                for start_vertex, end_vertex in pairwise(line)
            )
            restored.extend(points)
    if len(edges) + len(restored) != len(rim) or len(set(cut)) < len(cut):
        return None
    if not restored:
        return surface
    return replace(
        surface,
        vertices=np.concatenate([surface.vertices, np.array(restored)]),
        faces=np.concatenate([np.delete(faces, cut, axis=0), np.array(pieces, dtype=faces.dtype)]),
    )


def _points_between(follows: dict[Place, Place], start: Place, end: Place) -> Iterator[Place]:
    """Yield the points strictly between two points of a loop."""
    point = follows[start]
    while point not in (start, end):
        yield point
        point = follows[point]


def _label_loops(edges: NDArray[np.integer]) -> tuple[NDArray[np.int32], int]:
    """Label the loops of some edges (E, 2); return the loop of each edge, and the number of loops."""
    ends = np.unique(edges, return_inverse=True)[1].reshape(edges.shape)
    names, count = label_connected(ends[:, 0], ends[:, 1], int(ends.max()) + 1)
    return names[ends[:, 0]], count


def coincident_vertices(surface: Surface) -> NDArray[np.bool_]:
    """Mark the vertices (V,) that coincide with another one in single precision, as most files store them.

    >>> corners = np.array([[0.0, 0, 0], [1, 0, 0], [1 + 1e-9, 0, 0]])
    >>> coincident_vertices(Surface(vertices=corners, faces=np.array([[0, 1, 2]]))).tolist()
    [False, True, True]
    """
    points = np.asarray(surface.vertices, dtype=np.float32)
    order = np.lexsort(points.T)
    same = (points[order][1:] == points[order][:-1]).all(axis=1)
    coincident = np.zeros(len(points), dtype=bool)
    coincident[order[1:][same]] = coincident[order[:-1][same]] = True
    return coincident


def _move_inwards(surface: Surface, chosen: NDArray[np.bool_], distance: float) -> Surface:
    """Move some vertices by a distance, mm, against the mean normal of their faces."""
    vertices = np.array(surface.vertices, dtype=np.float64)
    faces = surface.faces[chosen[surface.faces].any(axis=1)]
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal, inwards = np.cross(b - a, c - a), np.zeros_like(vertices)
    for corner in range(3):
        np.subtract.at(inwards, faces[:, corner], normal)
    length = np.linalg.norm(inwards[chosen], axis=1, keepdims=True)
    vertices[chosen] += distance * np.divide(
        inwards[chosen], length, out=np.zeros_like(inwards[chosen]), where=length > 0
    )
    return replace(surface, vertices=vertices)


def solid_status(solid: manifold3d.Manifold) -> str:
    """Return the status that manifold3d reports for a solid: "NoError" if it is valid."""
    return str(solid.status().name)


def subtract(surface: Surface, others: Iterable[Surface]) -> Surface | None:
    """Subtract solids from a closed surface; return None if manifold3d rejects one of them.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> box, corner = (Surface(vertices=mesh.vertices, faces=mesh.faces) for mesh in boxes)
    >>> round(subtract(box, [corner]).volume, 6)
    7.0
    """
    solids = [to_manifold(operand) for operand in (surface, *others)]
    if any(solid_status(solid) != FINE for solid in solids):
        return None
    return from_manifold(reduce(lambda difference, subtrahend: difference - subtrahend, solids))


def shared_volume(surface: Surface, second: Surface) -> float:
    """Return the volume that two closed surfaces both enclose; nan if manifold3d rejects one of them.

    If the second is a box, it is an integral over the first, a tenth of the time that cutting takes.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> round(shared_volume(*(Surface(vertices=mesh.vertices, faces=mesh.faces) for mesh in boxes)), 6)
    1.0
    """
    box = find_box(second)
    if box is not None:
        return volume_in_box(surface, *box) if surface.closed else float("nan")
    first_solid, second_solid = to_manifold(surface), to_manifold(second)
    if solid_status(first_solid) != FINE or solid_status(second_solid) != FINE:
        return float("nan")
    return float((first_solid ^ second_solid).volume())


def unite(surfaces: Iterable[Surface]) -> Surface | None:
    """Unite closed surfaces; return None if manifold3d rejects one of them.

    >>> import trimesh
    >>> boxes = [trimesh.creation.box((2, 2, 2)), trimesh.creation.box((2, 2, 2)).apply_translation((1, 1, 1))]
    >>> both = unite([Surface(vertices=mesh.vertices, faces=mesh.faces) for mesh in boxes])
    >>> both.closed, round(both.volume, 6)
    (True, 15.0)
    """
    solids = [to_manifold(surface) for surface in surfaces]
    if not solids or any(solid_status(solid) != FINE for solid in solids):
        return None
    union_solid = reduce(lambda union, operand: union + operand, solids)
    return from_manifold(union_solid) if solid_status(union_solid) == FINE and not union_solid.is_empty() else None
