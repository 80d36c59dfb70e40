"""How the cells of a grid are cut into tetrahedra, and how labels at their corners divide each: tables for kernels.

Every cube between eight cell centres is cut into six tetrahedra along its diagonal (Kuhn 1960): their corners are the
base of the cube and chains of steps from it, base, base + d1, base + d2, base + 7, where the bits of a step are its
axes (x 1, y 2, z 4) and each step contains the one before. Faces and edges of tetrahedra are shorter chains, so that
each has one base: it owns the point that lies in it. The cutting is the same everywhere.

A tetrahedron whose corners have several labels is divided by points: one in each edge with two labels, one in each
face with three, one inside if all four differ. Walls between labels i and j run from the point of each edge i-j to
those of the faces and the inside next to it:

    two labels      a triangle or a quadrilateral of edge points
    three labels    corners p and q alike: the line between the points of the faces prs and qrs, where three walls meet
    four labels     six walls around the point inside

Seen from one label alone, the walls are those of marching tetrahedra with two labels: so the surface of every label
is closed and a manifold, whatever the data.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

STEPS = tuple(np.array([[d & 1, d >> 1 & 1, d >> 2 & 1] for d in range(8)]))
FACES = tuple((step_a, step_b) for step_b in range(1, 8) for step_a in range(1, step_b) if step_a & step_b == step_a)
TETRAHEDRA = tuple((step_a, step_a | step_b) for step_a in (1, 2, 4) for step_b in (1, 2, 4) if step_a != step_b)
# Slots of the points that a base owns: itself, edges by their step, faces, tetrahedra.
EDGE_SLOT, FACE_SLOT, TETRAHEDRON_SLOT, SLOTS = 0, 8, 20, 26
LOCAL_EDGES = tuple(combinations(range(4), 2))
MOST_TRIANGLES = 12  # of the walls in a tetrahedron
PATTERNS, FLAT_PATTERNS = 24, 6  # codes of labels at four corners, and at three
MOST_FLAT = 6  # triangles of a face on the side of the box


@dataclass(frozen=True, kw_only=True, eq=False)
class Tables:
    """Tables of all tetrahedra, and of the triangles on the sides of the box.

    Parameters
    ----------
    places : (6, 11, 2) int64
        For the six edges, the four faces and the inside of each tetrahedron: the step from the base of the cube to the
        base that owns the point, and its slot there.
    corners : (6, 4) int64
        Steps to the corners.
    counts : (6, PATTERNS) int64
        Triangles of each tetrahedron by the code of its labels.
    triangles : (6, PATTERNS, 12, 5) int64
        Of each triangle: three numbers of points, and the corners whose labels lie behind and before it.
    flat_places : (12, 7, 2) int64
        Of each face: its three corners, its edges 01, 02, 12, and its inside, as `places`.
    flat_counts : (12, FLAT_PATTERNS) int64
    flat_triangles : (12, FLAT_PATTERNS, 6, 4) int64
        Triangles of a face on the side of the box, by the code of its labels: three points, and the corner whose label
        has it. They face towards the higher end of the axis across.
    """

    places: NDArray[np.int64]
    corners: NDArray[np.int64]
    counts: NDArray[np.int64]
    triangles: NDArray[np.int64]
    flat_places: NDArray[np.int64]
    flat_counts: NDArray[np.int64]
    flat_triangles: NDArray[np.int64]


def pattern_code(labels: tuple[int, ...]) -> int:
    """Return the code of which labels of a simplex are alike.

    >>> pattern_code((7, 7, 7, 7)), pattern_code((3, 5, 3, 9)), pattern_code((1, 2, 3, 4))
    (0, 14, 23)
    """
    kinds = [labels.index(label) for label in labels]
    seen = sorted(set(kinds))
    ranks = [seen.index(kind) for kind in kinds]
    code = 0
    for corner, rank in enumerate(ranks[1:], 2):
        code = code * corner + rank
    return code


@cache
def make_tables() -> Tables:
    """Return the tables, made once."""
    places = np.zeros((6, 11, 2), dtype=np.int64)
    corners = np.zeros((6, 4), dtype=np.int64)
    counts = np.zeros((6, PATTERNS), dtype=np.int64)
    triangles = np.zeros((6, PATTERNS, MOST_TRIANGLES, 5), dtype=np.int64)
    for number, (step_a, step_b) in enumerate(TETRAHEDRA):
        chain = (0, step_a, step_b, 7)
        corners[number] = chain
        for edge, (a, b) in enumerate(LOCAL_EDGES):
            places[number, edge] = chain[a], EDGE_SLOT + (chain[a] ^ chain[b])
        for left_out in range(4):
            a, b, c = (chain[corner] for corner in range(4) if corner != left_out)
            places[number, 6 + left_out] = a, FACE_SLOT + FACES.index((a ^ b, a ^ c))
        places[number, 10] = 0, TETRAHEDRON_SLOT + number
        positions = _positions([STEPS[step] for step in chain])
        for labels in growth_strings(4):
            code = pattern_code(labels)
            walls = divide_tetrahedron(labels)
            for polygon, behind, before in walls:
                for triangle in split_fan(polygon):
                    across = STEPS[chain[before]] - STEPS[chain[behind]]
                    oriented = _orient(triangle, positions, across)
                    triangles[number, code, counts[number, code]] = (*oriented, behind, before)
                    counts[number, code] += 1
    return Tables(places=places, corners=corners, counts=counts, triangles=triangles, **_flat_tables())


def _flat_tables() -> dict[str, NDArray[np.int64]]:
    """Return the tables of faces on the sides of the box."""
    places = np.zeros((12, 7, 2), dtype=np.int64)
    counts = np.zeros((12, FLAT_PATTERNS), dtype=np.int64)
    triangles = np.zeros((12, FLAT_PATTERNS, MOST_FLAT, 4), dtype=np.int64)
    for number, (step_a, step_b) in enumerate(FACES):
        chain = (0, step_a, step_b)
        for corner in range(3):
            places[number, corner] = chain[corner], 0
        for edge, (a, b) in enumerate(((0, 1), (0, 2), (1, 2)), 3):
            places[number, edge] = chain[a], EDGE_SLOT + (chain[a] ^ chain[b])
        places[number, 6] = 0, FACE_SLOT + number
        if step_b == 7:  # a diagonal face, which lies on no side
            continue
        a, b, c = (STEPS[step].astype(float) for step in chain)
        positions = np.array([a, b, c, (a + b) / 2, (a + c) / 2, (b + c) / 2, (a + b + c) / 3])
        across = (1 - STEPS[step_b]).astype(float)
        for labels in growth_strings(3):
            code = pattern_code(labels)
            for polygon, corner in divide_face(labels):
                for triangle in split_fan(polygon):
                    oriented = _orient(triangle, positions, across)
                    triangles[number, code, counts[number, code]] = (*oriented, corner)
                    counts[number, code] += 1
    return {"flat_places": places, "flat_counts": counts, "flat_triangles": triangles}


def growth_strings(count: int) -> list[tuple[int, ...]]:
    """Return all ways in which labels of corners can be alike, each label numbered where it occurs first."""
    strings: list[tuple[int, ...]] = [(0,)]
    for _ in range(count - 1):
        strings = [(*string, label) for string in strings for label in range(max(string) + 2)]
    return strings


def _positions(corners: list[NDArray[np.int64]]) -> NDArray[np.float64]:
    """Return the middles of the edges, the faces and the inside of a tetrahedron, (11, 3)."""
    points = [(corners[a] + corners[b]) / 2 for a, b in LOCAL_EDGES]
    points += [np.delete(corners, left_out, axis=0).mean(axis=0) for left_out in range(4)]
    return np.array([*points, np.mean(corners, axis=0)], dtype=np.float64)


def _edge(a: int, b: int) -> int:
    """Return the number of an edge of a tetrahedron."""
    return LOCAL_EDGES.index((min(a, b), max(a, b)))


def divide_tetrahedron(labels: tuple[int, ...]) -> list[tuple[tuple[int, ...], int, int]]:
    """Return the walls in a tetrahedron: a polygon of points, and a corner on each side."""
    groups: dict[int, list[int]] = {}
    for corner, label in enumerate(labels):
        groups.setdefault(label, []).append(corner)
    parts = sorted(groups.values(), key=len)
    if len(parts) == 1:
        return []
    if len(parts) == 2 and len(parts[0]) == 1:
        single, rest = parts[0][0], parts[1]
        return [(tuple(_edge(single, corner_b) for corner_b in rest), single, rest[0])]
    if len(parts) == 2:
        (a, b), (c, d) = parts
        return [((_edge(a, c), _edge(a, d), _edge(b, d), _edge(b, c)), a, c)]
    if len(parts) == 3:
        (r,), (s,), (p, q) = parts
        at_p, at_q = 6 + q, 6 + p  # the faces without q, and without p
        return [
            ((_edge(r, s), at_p, at_q), r, s),
            ((_edge(p, r), _edge(q, r), at_q, at_p), p, r),
            ((_edge(p, s), _edge(q, s), at_q, at_p), p, s),
        ]
    walls: list[tuple[tuple[int, ...], int, int]] = []
    for a, b in LOCAL_EDGES:
        c, d = (corner for corner in range(4) if corner not in (a, b))
        walls.append(((_edge(a, b), 6 + c, 10, 6 + d), a, b))
    return walls


def divide_face(labels: tuple[int, ...]) -> list[tuple[tuple[int, ...], int]]:
    """Return the parts of a face: a polygon of points that begins at its lowest corner, and a corner with its label."""
    between = {(0, 1): 3, (0, 2): 4, (1, 2): 5}

    def edge(a: int, b: int) -> int:
        return between[min(a, b), max(a, b)]

    if len(set(labels)) == 1:
        return [((0, 1, 2), 0)]
    if len(set(labels)) == 2:
        single = next(corner for corner in range(3) if labels.count(labels[corner]) == 1)
        a, b = (corner for corner in range(3) if corner != single)
        return [((single, edge(single, a), edge(single, b)), single), ((a, b, edge(single, b), edge(single, a)), a)]
    parts: list[tuple[tuple[int, ...], int]] = []
    for corner in range(3):
        a, b = (corner_b for corner_b in range(3) if corner_b != corner)
        parts.append(((corner, edge(corner, a), 6, edge(corner, b)), corner))
    return parts


def split_fan(polygon: tuple[int, ...]) -> list[tuple[int, int, int]]:
    """Return the triangles of a polygon, all from its first point."""
    return [(polygon[0], polygon[at], polygon[at + 1]) for at in range(1, len(polygon) - 1)]


def _orient(
    triangle: tuple[int, int, int], positions: NDArray[np.float64], across: NDArray[np.float64]
) -> tuple[int, int, int]:
    """Return a triangle of points so that it faces along a direction."""
    a, b, c = (positions[point] for point in triangle)
    return triangle if np.dot(np.cross(b - a, c - a), across) > 0 else (triangle[0], triangle[2], triangle[1])
