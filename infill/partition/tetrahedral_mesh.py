"""Labels as tetrahedra that meet face to face, for finite elements.

The walls already divide the tetrahedra of all cubes (`infill.partition.tetrahedra`). What each label has of one of
them is divided further, so that tetrahedra on both sides of a face, and on both sides of a wall, agree:

    a wall                     has the triangles of the surfaces
    a face with two labels     one of its parts has four corners, and the diagonal begins at the lower of the two points
                               of the lattice
    a face with three labels   each part has four corners, and the diagonal begins at the point of the lattice

So every part of a label has a lowest point of the lattice, whose own faces are all divided from it: tetrahedra between
it and all other triangles fill the part.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from infill.partition.simplices import axis_places, base_numbers, count_bits
from infill.partition.tetrahedra import (
    LOCAL_EDGES,
    STEPS,
    TETRAHEDRA,
    divide_face,
    divide_tetrahedron,
    growth_strings,
    make_tables,
    pattern_code,
    split_fan,
)
from infill.partition.walls import WallGraph

CORNERS, LOCAL_POINTS = 4, 15  # of a tetrahedron: itself; with its edges, faces and its inside


@dataclass(frozen=True, kw_only=True, eq=False)
class TetrahedralMesh:
    """Tetrahedra of labels, face to face.

    Parameters
    ----------
    points : (P, 3) float64
        In cells of the grid, from its lower corner. The points of the walls come first, as in `Walls`.
    tetrahedra : (T, 4) int64
        Their volume is positive: the first three face the fourth.
    labels : (T,) int32
    wall_points : int
        Number of points of walls.
    lattice : (P - wall_points,) int64
        Number of each other point in the lattice.
    """

    points: NDArray[np.float64]
    tetrahedra: NDArray[np.int64]
    labels: NDArray[np.int32]
    wall_points: int
    lattice: NDArray[np.int64]


@cache
def _part_table() -> dict[int, list[tuple[tuple[int, int, int, int], int]]]:
    """Return the tetrahedra of each way in which the labels of a tetrahedron are alike, by its code.

    Each has four local points (the corners 0 to 3, then edges, faces, inside) and a corner with its label.
    """
    return {pattern_code(labels): _divide(labels) for labels in growth_strings(CORNERS)}


def _divide(labels: tuple[int, ...]) -> list[tuple[tuple[int, int, int, int], int]]:
    """Return the tetrahedra of the parts of a tetrahedron."""
    triangles: dict[int, list[tuple[int, int, int]]] = {label: [] for label in labels}
    for left_out in range(CORNERS):
        chain = [corner for corner in range(CORNERS) if corner != left_out]
        edges = [CORNERS + LOCAL_EDGES.index((chain[a], chain[b])) for a, b in ((0, 1), (0, 2), (1, 2))]
        local = [*chain, *edges, CORNERS + len(LOCAL_EDGES) + left_out]
        for polygon, corner in divide_face(tuple(labels[at] for at in chain)):
            fan = split_fan(tuple(local[point] for point in polygon))
            triangles[labels[chain[corner]]].extend(fan)
    for polygon, behind, before in divide_tetrahedron(labels):
        fan = split_fan(tuple(CORNERS + point for point in polygon))
        triangles[labels[behind]].extend(fan)
        triangles[labels[before]].extend(fan)
    parts = []
    for label, boundary in triangles.items():
        apex = labels.index(label)
        parts += [((*triangle, apex), apex) for triangle in boundary if apex not in triangle]
    return parts


def cut_tetrahedra(graph: WallGraph, points: NDArray[np.floating]) -> TetrahedralMesh:
    """Divide the labels of a partition into tetrahedra; 0 has none.

    Parameters
    ----------
    graph : WallGraph
    points : (P, 3) float
        The points of its walls, in cells.
    """
    labels = np.pad(graph.winners, 1, mode="edge")
    base_at = _base_lattice(graph)
    numbers, lattice = _number_corners(graph, labels, base_at)
    tetrahedra, owners = [], []
    for i in range(labels.shape[0] - 1):
        for corners, owner in _cut_slab(graph, labels, base_at, numbers, i):
            tetrahedra.append(corners)
            owners.append(owner)
    places = np.stack(np.unravel_index(lattice, labels.shape), axis=1)
    return TetrahedralMesh(
        points=np.concatenate([points.astype(np.float64), axis_places(places, graph.winners.shape)]),
        tetrahedra=np.concatenate(tetrahedra),
        labels=np.concatenate(owners).astype(np.int32),
        wall_points=graph.point_count,
        lattice=lattice,
    )


def _cut_slab(
    graph: WallGraph,
    labels: NDArray[np.uint16],
    base_at: NDArray[np.int32],
    numbers: NDArray[np.int64],
    i: int,
) -> list[tuple[NDArray[np.int64], NDArray[np.integer]]]:
    """Return the tetrahedra of a slab of cubes, and their labels."""
    tables, found = make_tables(), []
    _, rows, columns = (count - 1 for count in labels.shape)
    at = {
        step: (
            i + STEPS[step][0],
            slice(STEPS[step][1], rows + STEPS[step][1]),
            slice(STEPS[step][2], columns + STEPS[step][2]),
        )
        for step in range(8)
    }
    bases = np.flatnonzero(np.ones((rows, columns), dtype=bool)).reshape(rows, columns)
    bases = (i * labels.shape[1] + bases // columns) * labels.shape[2] + bases % columns
    strides = np.array([labels.shape[1] * labels.shape[2], labels.shape[2], 1])
    for number, (step_a, step_b) in enumerate(TETRAHEDRA):
        chain = (0, step_a, step_b, 7)
        beside = [labels[at[step]] for step in chain]
        corners = [numbers[at[step]] for step in chain]
        is_turned = np.linalg.det(np.array([STEPS[step] for step in chain[1:]])) < 0
        code = _pattern_codes(beside)
        whole = (code == 0) & (beside[0] != 0)
        nodes = np.stack([corner[whole] for corner in corners], axis=1)
        found.append((_turn(nodes, is_turned), beside[0][whole]))
        for value in np.unique(code[code > 0]):
            chosen = code == value
            local = np.empty((int(chosen.sum()), LOCAL_POINTS), dtype=np.int64)
            local[:, :CORNERS] = np.stack([corner[chosen] for corner in corners], axis=1)
            parts = _part_table()[int(value)]
            used = {point for part, _ in parts for point in part if point >= CORNERS}
            for point in used:
                step, slot = tables.places[number, point - CORNERS]
                bases_of = base_at.ravel()[bases[chosen] + int(STEPS[step] @ strides)]
                before = count_bits(graph.masks[bases_of] & ((1 << slot) - 1))
                local[:, point] = graph.starts[bases_of] + before
            for part, corner in parts:
                owner = beside[corner][chosen]
                nodes = local[:, list(_orient_part(part, number))]
                found.append((nodes[owner != 0], owner[owner != 0]))
    return found


@cache
def _orient_part(part: tuple[int, int, int, int], number: int) -> tuple[int, int, int, int]:
    """Return the points of a tetrahedron in the order in which its volume is positive."""
    chain = np.array([STEPS[step] for step in (0, *TETRAHEDRA[number], 7)], dtype=float)
    places = [*chain, *((chain[a] + chain[b]) / 2 for a, b in LOCAL_EDGES)]
    places += [np.delete(chain, left_out, axis=0).mean(axis=0) for left_out in range(CORNERS)]
    places.append(chain.mean(axis=0))
    a, b, c, d = (places[point] for point in part)
    return part if np.linalg.det([b - a, c - a, d - a]) > 0 else (part[0], part[2], part[1], part[3])


def _turn(nodes: NDArray[np.int64], is_turned: bool) -> NDArray[np.int64]:
    """Return the corners of whole tetrahedra in the order in which their volume is positive."""
    return np.asarray(nodes[:, [0, 2, 1, 3]]) if is_turned else nodes


def _pattern_codes(labels: list[NDArray[np.uint16]]) -> NDArray[np.int64]:
    """Return the codes of tetrahedra by the labels of their corners: see `pattern_code`."""
    a, b, c, d = (label.astype(np.int64) for label in labels)
    second = (b != a).astype(np.int64)
    third = np.where(c == a, 0, np.where(c == b, second, second + 1))
    largest = np.maximum(second, third)
    fourth = np.where(d == a, 0, np.where(d == b, second, np.where(d == c, third, largest + 1)))
    return np.asarray((second * 3 + third) * 4 + fourth)


def _base_lattice(graph: WallGraph) -> NDArray[np.int32]:
    """Return the lattice with the number of the base at each point; -1 where there is none."""
    lattice = np.full(tuple(count + 2 for count in graph.winners.shape), -1, dtype=np.int32)
    lattice.ravel()[base_numbers(graph)] = np.arange(len(graph.bases))
    return lattice


def _number_corners(
    graph: WallGraph, labels: NDArray[np.uint16], base_at: NDArray[np.int32]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the point at each place of the lattice, -1 for label 0, and the places of those that walls lack.

    Walls have the points on the sides of the box.
    """
    inner = np.zeros(labels.shape, dtype=bool)
    inner[1:-1, 1:-1, 1:-1] = labels[1:-1, 1:-1, 1:-1] != 0
    numbers = np.full(labels.shape, -1, dtype=np.int64)
    lattice = np.flatnonzero(inner)
    numbers.ravel()[lattice] = graph.point_count + np.arange(len(lattice))
    on_side = (labels != 0) & ~inner
    numbers[on_side] = graph.starts[base_at[on_side]]
    return numbers, lattice
