"""A mesh in parts: its components, also where they touch, each with the cavities inside it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.meshes.hole_filling import agreeing, capped, components, open_edges, welded
from infill.meshes.merging import closed_or_merged
from infill.meshes.winding import winding
from infill.surface import Surface

Floats = NDArray[np.float64]
Integers = NDArray[np.integer]

SAMPLES = 9  # faces of a component by which it is told what that lies in
EQUAL = 1e-6  # radians: faces around an edge that lie on each other


@dataclass(frozen=True, kw_only=True)
class Parts:
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


def parted(surface: Surface, cell: float) -> Parts:
    """Return the components of a mesh, each with its cavities.

    Parameters
    ----------
    surface : Surface, mm
        It may be open or inside out.
    cell : float, mm
        Corners of open edges closer together than a hundredth of this are one.

    Notes
    -----
    Components are joined by edges. Where more than two faces share one, as where two boxes touch, those are of one
    component that have solid between them. A component that faces the other way than the outermost one around it is
    a cavity of the smallest that it lies in. One that faces the same way is a part of its own, wherever it lies.

    >>> corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> both = Surface(vertices=np.concatenate([corners, corners + 1]), faces=np.concatenate([faces, faces + 4]))
    >>> [len(each.faces) for each in parted(both, 0.1).surfaces]
    [4, 4]
    """
    surface = closed_or_merged(surface.vertices, surface.faces)
    faces: Integers = surface.faces
    if len(open_edges(faces)):
        faces = agreeing(welded(np.asarray(surface.vertices, dtype=np.float64) / cell, faces))
    names, count = edge_components(np.asarray(surface.vertices, dtype=np.float64), faces)
    order = np.argsort(names, kind="stable")
    bounds = np.searchsorted(names[order], np.arange(count + 1))
    every = [_alone(surface, faces[order[low:high]]) for low, high in pairwise(bounds)]
    closed = [_closed(each, cell) for each in every]
    volumes = np.array([_volume(each) for each in closed])
    solid = np.flatnonzero(volumes)
    within = _holders([closed[i] for i in solid], volumes[solid])
    owners = _owners(within, volumes[solid])
    whole = np.bincount(owners, weights=volumes[solid], minlength=len(solid))
    found = [i for i in np.argsort(-np.abs(whole), kind="stable").tolist() if owners[i] == i]
    return Parts(
        surfaces=tuple(joined([every[solid[j]] for j in np.flatnonzero(owners == i)]) for i in found),
        sheets=count - len(solid),
    )


def joined(surfaces: list[Surface]) -> Surface:
    """Return several surfaces as one, one after the other; nothing is merged."""
    if len(surfaces) == 1:
        return surfaces[0]
    begins = np.cumsum([0, *(len(each.vertices) for each in surfaces)])
    return Surface(
        vertices=np.concatenate([each.vertices for each in surfaces]),
        faces=np.concatenate(
            [each.faces + each.faces.dtype.type(begin) for each, begin in zip(surfaces, begins, strict=False)]
        ),
        space=surfaces[0].space,
    )


def edge_components(vertices: Floats, faces: Integers) -> tuple[Integers, int]:
    """Return the component of every face, joined by edges and by the solid between faces, and how many there are.

    Parameters
    ----------
    vertices : (V, 3) float64, mm
    faces : (F, 3) int
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    start, end = faces.ravel().astype(np.int64), np.roll(faces, -1, axis=1).ravel().astype(np.int64)
    key = np.minimum(start, end) * (int(faces.max()) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    counts = np.diff(first, append=len(key))
    pairs = first[counts == 2]
    one, other = [order[pairs] // 3], [order[pairs + 1] // 3]
    for begin, many in zip(first[counts > 2].tolist(), counts[counts > 2].tolist(), strict=True):
        sides = order[begin : begin + many]
        linked = _by_solid(vertices, faces, sides, start[sides] < end[sides])
        one.append(sides[linked[:, 0]] // 3)
        other.append(sides[linked[:, 1]] // 3)
    row, column = np.concatenate(one), np.concatenate(other)
    graph = coo_array((np.ones(len(row), dtype=np.int8), (row, column)), shape=(len(faces),) * 2)
    count, names = connected_components(graph, directed=False)
    return names, int(count)


def _by_solid(vertices: Floats, faces: Integers, sides: Integers, ahead: NDArray[np.bool_]) -> Integers:
    """Return which of the faces around one edge have solid between them, (n, 2).

    Seen along the edge, solid begins at a face that runs back along it and ends at the next one that runs ahead. All
    faces are linked in a row if as many do not run ahead as back.
    """
    every = np.arange(len(sides))
    if ahead.sum() * 2 != len(sides):
        return np.stack([every[:-1], every[1:]], axis=1)
    face, place = np.divmod(sides, 3)
    a, b, apex = (vertices[faces[face, (place + i) % 3]] for i in range(3))
    along = (b - a)[np.argmax(ahead)]
    along = along / max(float(np.linalg.norm(along)), 1e-300)
    away = (apex - a) - ((apex - a) @ along)[:, None] * along
    right = away[0] / max(float(np.linalg.norm(away[0])), 1e-300)
    angle = np.arctan2(away @ np.cross(along, right), away @ right)
    order = np.argsort(angle, kind="stable")
    gaps = np.diff(angle[order], prepend=angle[order[-1]] - 2 * np.pi)
    begin = int(gaps.argmax())
    order, gaps = np.roll(order, -begin), np.roll(gaps, -begin)
    place = np.cumsum(gaps > EQUAL)
    order = order[np.lexsort((~ahead[order], place))]  # what ends comes before what begins in the same place
    waiting: list[int] = []
    found: list[tuple[int, int]] = []
    taken: set[int] = set()
    for each in [*order.tolist(), *order.tolist()]:
        if each in taken:
            continue
        if not ahead[each] and each not in waiting:
            waiting.append(each)
        elif ahead[each] and waiting:
            found.append((waiting.pop(), each))
            taken.update(found[-1])
    return np.array(found)


def _alone(surface: Surface, faces: Integers) -> Surface:
    """Return some of the faces with the vertices that they use."""
    used, index = np.unique(faces, return_inverse=True)
    return Surface(vertices=surface.vertices[used], faces=index.reshape(faces.shape), space=surface.space)


def _closed(surface: Surface, cell: float) -> Surface:
    """Return a component with caps on its holes."""
    vertices, faces, _ = capped(np.asarray(surface.vertices, dtype=np.float64) / cell, surface.faces)
    return Surface(vertices=vertices * cell, faces=faces)


def _volume(surface: Surface) -> float:
    """Return the signed volume, 0 for a sheet."""
    return float(components(np.asarray(surface.vertices), surface.faces)[1].sum())


def _holders(closed: list[Surface], volumes: Floats) -> list[list[int]]:
    """Return which larger components each lies in."""
    if not closed:
        return []
    low, high = (np.stack(each) for each in zip(*(surface.bounds for surface in closed), strict=True))
    found = []
    for i, surface in enumerate(closed):
        larger = (np.abs(volumes) > abs(volumes[i])) & (low <= low[i]).all(axis=1) & (high >= high[i]).all(axis=1)
        some = np.linspace(0, len(surface.faces) - 1, SAMPLES).astype(np.int64)
        points = surface.vertices[surface.faces[some]].mean(axis=1)
        found.append([j for j in np.flatnonzero(larger).tolist() if (winding(points, closed[j]) != 0).all()])
    return found


def _owners(within: list[list[int]], volumes: Floats) -> Integers:
    """Return for each component the one that it belongs to: itself, or the one of which it is a cavity."""
    owners = np.arange(len(volumes))
    for i, holders in enumerate(within):
        outermost = max(holders, key=lambda j: abs(volumes[j]), default=i)
        way = np.sign(volumes[outermost])
        if np.sign(volumes[i]) != way:
            owners[i] = min((j for j in holders if np.sign(volumes[j]) == way), key=lambda j: abs(volumes[j]))
    return owners
