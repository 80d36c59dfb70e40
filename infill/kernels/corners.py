"""A closed mesh as a table of corners, and the collapse of one of its edges.

Corner c = 3 f + k is also the edge of face f from its k-th corner to the next, `start[c]` the vertex there, `twin[c]`
the same edge of the neighbour, in the opposite direction, and `leaving[v]` one corner of each vertex (Rossignac 2001).
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

MAX_CORNERS = 48  # corners at a vertex: collapses that would exceed it are rejected
NO_CORNER = -1


@njit(nogil=True, cache=True, error_model="numpy")
def next_corner(corner):
    """Return the next corner of the same face."""
    return corner - 2 if corner % 3 == 2 else corner + 1


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def previous_corner(corner):
    """Return the previous corner of the same face."""
    return corner + 2 if corner % 3 == 0 else corner - 1


@njit(nogil=True, cache=True, error_model="numpy")
def pair_edges(start, count, twin):
    """Set the twin of each corner; return True if every edge has exactly one.

    Parameters
    ----------
    start : (3 F,) int32
        The vertex of each corner.
    count : int
        Vertices.
    twin : (3 F,) int32
    """
    begin = np.zeros(count + 1, dtype=np.int64)
    for c in range(len(start)):
        begin[start[c] + 1] += 1
    for v in range(count):
        begin[v + 1] += begin[v]
    leaving, filled = np.empty(len(start), dtype=np.int32), begin[:-1].copy()
    for c in range(len(start)):
        leaving[filled[start[c]]] = c
        filled[start[c]] += 1
    for c in range(len(start)):
        a, b = start[c], start[next_corner(c)]
        if a == b:
            return False
        match = -1
        for at in range(begin[b], begin[b + 1]):
            if start[next_corner(leaving[at])] == a:
                if match >= 0:
                    return False
                match = leaving[at]
        if match < 0:
            return False
        twin[c] = match
    return True


@njit(nogil=True, cache=True, error_model="numpy")
def split_fans(start, twin, count, name):
    """Give each additional fan of faces around a vertex a vertex of its own; return the number of vertices.

    Parameters
    ----------
    start, twin : (3 F,) int32
    count : int
        Vertices.
    name : (3 F,) int32
        Set to the vertex of which each vertex is a copy; there are never more vertices than corners.
    """
    seen, is_used = np.zeros(len(start), dtype=np.bool_), np.zeros(count, dtype=np.bool_)
    for v in range(count):
        name[v] = v
    total = count
    for c in range(len(start)):
        if seen[c]:
            continue
        v = start[c]
        fan_vertex = v
        if is_used[v]:
            fan_vertex, name[total], total = total, v, total + 1
        is_used[v] = True
        at = c
        while not seen[at]:
            seen[at] = True
            start[at] = fan_vertex
            at = twin[previous_corner(at)]
    return total


@njit(nogil=True, cache=True, error_model="numpy")
def pair_open_edges(start, count, twin):
    """Set the twin of each corner, -1 at the border of the mesh; return True if no edge has more than one.

    Parameters
    ----------
    start, count, twin
        See `pair_edges`.
    """
    begin = np.zeros(count + 1, dtype=np.int64)
    for c in range(len(start)):
        begin[start[c] + 1] += 1
    for v in range(count):
        begin[v + 1] += begin[v]
    leaving, filled = np.empty(len(start), dtype=np.int32), begin[:-1].copy()
    for c in range(len(start)):
        leaving[filled[start[c]]] = c
        filled[start[c]] += 1
    for c in range(len(start)):
        a, b = start[c], start[next_corner(c)]
        if a == b:
            return False
        match = NO_CORNER
        for at in range(begin[b], begin[b + 1]):
            if start[next_corner(leaving[at])] == a:
                if match >= 0:
                    return False
                match = leaving[at]
        for at in range(begin[a], begin[a + 1]):
            if leaving[at] != c and start[next_corner(leaving[at])] == b:
                return False
        twin[c] = match
    return True


@njit(nogil=True, cache=True, error_model="numpy")
def split_open_fans(start, twin, count, name):
    """Give each additional fan of faces around a vertex a vertex of its own, also where fans end at the border.

    Parameters
    ----------
    start, twin, count, name
        See `split_fans`.
    """
    seen, is_used = np.zeros(len(start), dtype=np.bool_), np.zeros(count, dtype=np.bool_)
    for v in range(count):
        name[v] = v
    total = count
    for c in range(len(start)):
        if seen[c]:
            continue
        first = c
        while twin[first] >= 0 and next_corner(twin[first]) != c:  # back to where the fan begins
            first = next_corner(twin[first])
        v = start[c]
        fan_vertex = v
        if is_used[v]:
            fan_vertex, name[total], total = total, v, total + 1
        is_used[v] = True
        at = first
        while at >= 0 and not seen[at]:
            seen[at] = True
            start[at] = fan_vertex
            at = twin[previous_corner(at)]
    return total


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def corners_of(vertex, twin, leaving, ring):
    """Set the corners of a vertex; return their number, or -1 if there are too many."""
    at, count = leaving[vertex], 0
    while True:
        if count == MAX_CORNERS:
            return -1
        ring[count] = at
        count += 1
        at = twin[previous_corner(at)]
        if at == leaving[vertex]:
            return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _has_three_faces(vertex, twin, leaving):
    """Return True if a vertex has exactly three faces."""
    at = leaving[vertex]
    for _ in range(3):
        at = twin[previous_corner(at)]
    return at == leaving[vertex]


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def can_collapse(c, start, twin, leaving, name, ring, ring_size, end_ring, end_ring_size, marked, step):
    """Return True if the ends of an edge share only the corners opposite to it as neighbours, and have more faces."""
    for n in range(ring_size):
        marked[name[start[next_corner(ring[n])]]] = step
    common = 0
    for n in range(end_ring_size):
        common += marked[name[start[next_corner(end_ring[n])]]] == step
    if common != 2:
        return False
    opposite, beyond = start[previous_corner(c)], start[previous_corner(twin[c])]
    return not _has_three_faces(opposite, twin, leaving) and not _has_three_faces(beyond, twin, leaving)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def collapse_edge(c, start, twin, leaving, end_ring, end_ring_size):
    """Collapse an edge in the table: its end becomes its start, two faces go, and their other edges become twins."""
    u, d = start[c], twin[c]
    for n in range(end_ring_size):
        start[end_ring[n]] = u
    for n in range(2):
        at = c if n == 0 else d
        outer_a, outer_b = twin[next_corner(at)], twin[previous_corner(at)]
        twin[outer_a], twin[outer_b] = outer_b, outer_a
        leaving[start[outer_a]], leaving[start[outer_b]] = outer_a, outer_b
    for n in range(2):
        f = 3 * ((c if n == 0 else d) // 3)
        start[f], start[f + 1], start[f + 2] = NO_CORNER, NO_CORNER, NO_CORNER
