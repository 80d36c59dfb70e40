"""Split a mesh into its components, also where they touch, each with the cavities inside it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.arrays import AnyIntegers, Floats
from infill.graph import label_connected
from infill.meshes.hole_filling import component_volumes, fill_holes, open_edges, orient_faces, weld_boundary
from infill.meshes.merging import merge_unless_closed
from infill.meshes.shells import first_vertex_of_shells, select_faces, vertex_components
from infill.meshes.winding import winding_numbers
from infill.surface import Surface

SAMPLES = 9  # faces of a component that are sampled to find the components around it
EQUAL = 1e-6  # radians: faces around an edge closer than this lie on each other


@dataclass(frozen=True, kw_only=True)
class ComponentParts:
    """The components of a mesh.

    Parameters
    ----------
    surfaces : tuple of Surface, mm
        By falling volume; each holds its cavities.
    sheets : int
        Components that enclose nothing, which are left out.
    """

    surfaces: tuple[Surface, ...]
    sheets: int


def split_components(surface: Surface, cell: float) -> ComponentParts:
    """Split a mesh into components with their cavities; drop sheets, keep holes, and close cracks up to 0.01 `cell`.

    Parameters
    ----------
    surface : Surface, mm
        It may be open or inside out.
    cell : float, mm
        Corners of open edges closer together than a hundredth of this are one.

    Notes
    -----
    Components are joined by edges. Where more than two faces share an edge, as where two boxes touch, faces with solid
    between them belong to one component. A component that faces the other way than the outermost one around it is a
    cavity of the smallest component around it. One that faces the same way is a separate part, wherever it lies.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> both = Surface(vertices=np.concatenate([corners, corners + 1]), faces=np.concatenate([faces, faces + 4]))
    >>> [len(part.faces) for part in split_components(both, 0.1).surfaces]
    [4, 4]
    """
    surface = merge_unless_closed(surface.vertices, surface.faces)
    faces: AnyIntegers = surface.faces
    if len(open_edges(faces)):
        faces = orient_faces(weld_boundary(np.asarray(surface.vertices, dtype=np.float64) / cell, faces))
    names, count = edge_components(np.asarray(surface.vertices, dtype=np.float64), faces)
    order = np.argsort(names, kind="stable")
    bounds = np.searchsorted(names[order], np.arange(count + 1))
    open_parts = [_used_part(surface, faces[order[low:high]]) for low, high in pairwise(bounds)]
    closed_parts = [_close_part(part, cell) for part in open_parts]
    volumes = np.array([_signed_volume(part) for part in closed_parts])
    solid = np.flatnonzero(volumes)
    holders = _larger_around([closed_parts[i] for i in solid], volumes[solid])
    owners = _owners(holders, volumes[solid])
    part_volumes = np.bincount(owners, weights=volumes[solid], minlength=len(solid))
    part_order = [i for i in np.argsort(-np.abs(part_volumes), kind="stable").tolist() if owners[i] == i]
    return ComponentParts(
        surfaces=tuple(
            concatenate_surfaces([open_parts[solid[j]] for j in np.flatnonzero(owners == i)]) for i in part_order
        ),
        sheets=count - len(solid),
    )


def drop_pieces(surface: Surface, pieces: Iterable[Surface], threads: int | None = None) -> Surface:
    """Drop outer shells of a surface, given as surfaces of their own, with the shells that lie in them.

    >>> import trimesh
    >>> balls = [trimesh.creation.icosphere(1), trimesh.creation.icosphere(1).apply_translation((5, 0, 0))]
    >>> first, second = (Surface(vertices=ball.vertices, faces=ball.faces) for ball in balls)
    >>> drop_pieces(concatenate_surfaces([first, second]), [second]).bounds[1].round(9).tolist()
    [1.0, 1.0, 1.0]
    """
    for piece in pieces:
        names, _ = vertex_components(surface.faces, len(surface.vertices))
        starts = first_vertex_of_shells(surface)
        vertices = np.asarray(surface.vertices, dtype=np.float64)
        is_dropped = winding_numbers(vertices[starts], piece, threads=threads) > 0
        is_dropped[names[np.flatnonzero((vertices == piece.vertices[0]).all(axis=1))]] = True
        surface = select_faces(surface, ~is_dropped[names[surface.faces[:, 0]]])
    return surface


def concatenate_surfaces(surfaces: list[Surface]) -> Surface:
    """Concatenate several surfaces into one; nothing is merged."""
    if len(surfaces) == 1:
        return surfaces[0]
    begins = np.cumsum([0, *(len(surface.vertices) for surface in surfaces)])
    return Surface(
        vertices=np.concatenate([surface.vertices for surface in surfaces]),
        faces=np.concatenate(
            [surface.faces + surface.faces.dtype.type(begin) for surface, begin in zip(surfaces, begins, strict=False)]
        ),
        space=surfaces[0].space,
    )


def edge_components(vertices: Floats, faces: AnyIntegers) -> tuple[AnyIntegers, int]:
    """Label the components joined by edges, or by solid between faces; return each face's component, and the count.

    Parameters
    ----------
    vertices : (V, 3) float64, mm
    faces : (F, 3) int
    """
    start, end = faces.ravel().astype(np.int64), np.roll(faces, -1, axis=1).ravel().astype(np.int64)
    key = np.minimum(start, end) * (int(faces.max()) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    group_start = np.flatnonzero(np.diff(key[order], prepend=-1))
    counts = np.diff(group_start, append=len(key))
    pairs = group_start[counts == 2]
    start_faces, end_faces = [order[pairs] // 3], [order[pairs + 1] // 3]
    for begin, group_size in zip(group_start[counts > 2].tolist(), counts[counts > 2].tolist(), strict=True):
        sides = order[begin : begin + group_size]
        linked = _link_by_solid(vertices, faces, sides, start[sides] < end[sides])
        start_faces.append(sides[linked[:, 0]] // 3)
        end_faces.append(sides[linked[:, 1]] // 3)
    row, column = np.concatenate(start_faces), np.concatenate(end_faces)
    return label_connected(row, column, len(faces))


def _link_by_solid(vertices: Floats, faces: AnyIntegers, sides: AnyIntegers, ahead: NDArray[np.bool_]) -> AnyIntegers:
    """Link faces around one edge that have solid between; return pairs of positions in `sides`, (n, 2).

    Seen along the edge, solid begins at a face that runs back along it and ends at the next one that runs ahead. All
    faces are linked in a row if the numbers running ahead and back differ.
    """
    all_sides = np.arange(len(sides))
    if ahead.sum() * 2 != len(sides):
        return np.stack([all_sides[:-1], all_sides[1:]], axis=1)
    face, place = np.divmod(sides, 3)
    a, b, apex = (vertices[faces[face, (place + i) % 3]] for i in range(3))
    along = (b - a)[np.argmax(ahead)]
    along = along / max(float(np.linalg.norm(along)), 1e-300)
    outwards = (apex - a) - ((apex - a) @ along)[:, None] * along
    reference = outwards[0] / max(float(np.linalg.norm(outwards[0])), 1e-300)
    angle = np.arctan2(outwards @ np.cross(along, reference), outwards @ reference)
    order = np.argsort(angle, kind="stable")
    gaps = np.diff(angle[order], prepend=angle[order[-1]] - 2 * np.pi)
    begin = int(gaps.argmax())
    order, gaps = np.roll(order, -begin), np.roll(gaps, -begin)
    place = np.cumsum(gaps > EQUAL)
    order = order[np.lexsort((~ahead[order], place))]  # at the same angle, ends come before beginnings
    waiting: list[int] = []
    links: list[tuple[int, int]] = []
    linked: set[int] = set()
    for side in [*order.tolist(), *order.tolist()]:
        if side in linked:
            continue
        if not ahead[side] and side not in waiting:
            waiting.append(side)
        elif ahead[side] and waiting:
            links.append((waiting.pop(), side))
            linked.update(links[-1])
    return np.array(links)


def _used_part(surface: Surface, faces: AnyIntegers) -> Surface:
    """Return some of the faces as a surface, with only the vertices that they use."""
    used, index = np.unique(faces, return_inverse=True)
    return Surface(vertices=surface.vertices[used], faces=index.reshape(faces.shape), space=surface.space)


def _close_part(surface: Surface, cell: float) -> Surface:
    """Put caps on the holes of a component."""
    vertices, faces, _ = fill_holes(np.asarray(surface.vertices, dtype=np.float64) / cell, surface.faces)
    return Surface(vertices=vertices * cell, faces=faces)


def _signed_volume(surface: Surface) -> float:
    """Return the signed volume, 0 for a sheet."""
    return float(component_volumes(np.asarray(surface.vertices), surface.faces)[1].sum())


def _larger_around(closed: list[Surface], volumes: Floats) -> list[list[int]]:
    """List for each component the larger components around it."""
    if not closed:
        return []
    low, high = (np.stack(bounds) for bounds in zip(*(surface.bounds for surface in closed), strict=True))
    holders = []
    for i, surface in enumerate(closed):
        larger = (np.abs(volumes) > abs(volumes[i])) & (low <= low[i]).all(axis=1) & (high >= high[i]).all(axis=1)
        sampled = np.linspace(0, len(surface.faces) - 1, SAMPLES).astype(np.int64)
        points = surface.vertices[surface.faces[sampled]].mean(axis=1)
        holders.append([j for j in np.flatnonzero(larger).tolist() if (winding_numbers(points, closed[j]) != 0).all()])
    return holders


def _owners(holder_lists: list[list[int]], volumes: Floats) -> AnyIntegers:
    """Return the part that each component belongs to: itself, or the component of which it is a cavity."""
    owners = np.arange(len(volumes))
    for i, holders in enumerate(holder_lists):
        outermost = max(holders, key=lambda j: abs(volumes[j]), default=i)
        sign = np.sign(volumes[outermost])
        if np.sign(volumes[i]) != sign:
            owners[i] = min((j for j in holders if np.sign(volumes[j]) == sign), key=lambda j: abs(volumes[j]))
    return owners
