"""Triangles in an order in which most need no vertex named, compiled: each lies across an edge of an earlier one.

The edges around the triangles visited so far are linked to loops, and wait on a stack. Across the edge a → b taken from
the stack lies the triangle b, a, c, and a symbol says what c is (`infill.viewer.compact` lists them). The page,
`page/src/viewer/compact.js`, links the same loops, so that it needs the symbols alone.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

NEW, NEXT, PREVIOUS, BOTH, OLD, BORDER = range(6)  # symbols


@njit(nogil=True, cache=True)
def pair_half_edges(order, keys, starts, twin):
    """Find the opposite of every half-edge that has exactly one.

    Parameters
    ----------
    order : (3 F,) int64
        Half-edges sorted by their key.
    keys : (3 F,) int64
        The same for both directions of an edge.
    starts : (3 F,) int32
        Vertex at which each begins.
    twin : (3 F,) int32
        Of -1; written.
    """
    n = len(order)
    i = 0
    while i < n:
        j = i + 1
        while j < n and keys[order[j]] == keys[order[i]]:
            j += 1
        if j == i + 2 and starts[order[i]] != starts[order[i + 1]]:
            twin[order[i]], twin[order[i + 1]] = order[i + 1], order[i]
        i = j


# Columns of the table of edges: its vertices, the half-edge on its other side or -1, the third vertex of its triangle,
# the edges before and after it in its loop, and whether it still is in one.
BEGIN, END, ACROSS, APEX, BEFORE, AFTER, WAITS = range(7)
# Counters: edges in the table, on the stack, symbols, named vertices, vertices.
EDGES, DEPTH, SYMBOLS, NAMES, VERTICES = range(5)


@njit(nogil=True, cache=True)
def traverse(faces, twin, symbols, named, number, parents):
    """Visit all triangles; return the numbers of symbols, of named vertices, and of vertices.

    Parameters
    ----------
    faces : (F, 3) int32
    twin : (3 F,) int32
        Opposite half-edge, or -1; half-edge 3 f + k begins at corner k of triangle f.
    symbols : (6 F,) uint8
        Written: a symbol for every edge that is taken from the stack.
    named : (3 F,) uint32
        Written: for `OLD`, and the corners of a triangle that has no earlier neighbour, how many vertices ago the
        vertex was new; 0 for a new one.
    number : (V,) int32
        Of -1; written: the order in which vertices were new.
    parents : (V, 4) int32
        Written, in the new order: the vertex, and those from which its place is predicted: a, b, and the vertex on the
        other side of the edge; or -1, the vertex before, and -1.
    """
    table = np.zeros((3 * len(faces) + 3, 7), dtype=np.int32)
    stack = np.empty(len(table), dtype=np.int32)
    latest = np.full(len(number), -1, dtype=np.int32)  # latest edge of a loop that begins at a vertex
    visited = np.zeros(len(faces), dtype=np.uint8)
    counts = np.zeros(5, dtype=np.int64)
    for seed in range(len(faces)):
        if visited[seed]:
            continue
        visited[seed] = 1
        begin_component(faces, twin, seed, table, stack, latest, counts, named, number, parents)
        while counts[DEPTH]:
            counts[DEPTH] -= 1
            edge = stack[counts[DEPTH]]
            if not table[edge, WAITS]:
                continue
            opposite = table[edge, ACROSS]
            if opposite < 0 or visited[opposite // 3]:
                symbols[counts[SYMBOLS]] = BORDER
            else:
                visited[opposite // 3] = 1
                symbols[counts[SYMBOLS]] = cross_edge(
                    faces, twin, edge, table, stack, latest, counts, named, number, parents
                )
            counts[SYMBOLS] += 1
    return counts[SYMBOLS], counts[NAMES], counts[VERTICES]


@njit(nogil=True, cache=True, from_python=False)
def begin_component(faces, twin, seed, table, stack, latest, counts, named, number, parents):
    """Name the corners of a triangle that has no earlier neighbour, and make a loop of its edges."""
    for k in range(3):
        vertex = faces[seed, k]
        if number[vertex] < 0:
            predictor = parents[counts[VERTICES] - 1, 0] if counts[VERTICES] else -1
            number_vertex(vertex, -1, predictor, -1, counts, number, parents)
            named[counts[NAMES]] = 0
        else:
            named[counts[NAMES]] = counts[VERTICES] - number[vertex]
        counts[NAMES] += 1
    edge = counts[EDGES]
    for k in range(3):
        a, b, c = faces[seed, k], faces[seed, (k + 1) % 3], faces[seed, (k + 2) % 3]
        add_edge(a, b, c, twin[3 * seed + k], table, stack, latest, counts)
    for k in range(3):
        link_edges(edge + k, edge + (k + 1) % 3, table)


@njit(nogil=True, cache=True, from_python=False)
def cross_edge(faces, twin, edge, table, stack, latest, counts, named, number, parents):
    """Visit the triangle across an edge of a loop, replace the edge by its others; return the symbol."""
    opposite, a, b = table[edge, ACROSS], table[edge, BEGIN], table[edge, END]
    previous, following = table[edge, BEFORE], table[edge, AFTER]
    k = opposite % 3
    away, back = opposite - k + (k + 1) % 3, opposite - k + (k + 2) % 3  # half-edges a → c and c → b
    c = faces[opposite // 3, (k + 2) % 3]
    meets_following = table[following, WAITS] and table[following, ACROSS] == back
    meets_previous = table[previous, WAITS] and table[previous, ACROSS] == away
    table[edge, WAITS] = 0
    if meets_following or meets_previous:
        start, stop = previous, following
        if meets_following:
            table[following, WAITS] = 0
            stop = table[following, AFTER]
        if meets_previous:
            table[previous, WAITS] = 0
            start = table[previous, BEFORE]
        if meets_following and meets_previous:
            link_edges(start, stop, table)
            return BOTH
        if meets_following:
            new = add_edge(a, c, b, twin[away], table, stack, latest, counts)
        else:
            new = add_edge(c, b, a, twin[back], table, stack, latest, counts)
        link_edges(start, new, table)
        link_edges(new, stop, table)
        return NEXT if meets_following else PREVIOUS
    symbol, leaving = NEW, -1
    if number[c] < 0:
        number_vertex(c, a, b, table[edge, APEX], counts, number, parents)
    else:
        symbol, leaving = OLD, latest[c]
        named[counts[NAMES]] = counts[VERTICES] - number[c]
        counts[NAMES] += 1
    left = add_edge(a, c, b, twin[away], table, stack, latest, counts)
    right = add_edge(c, b, a, twin[back], table, stack, latest, counts)
    if leaving >= 0 and table[leaving, WAITS]:  # the loop is cut in two, or two become one
        link_edges(table[leaving, BEFORE], right, table)
        link_edges(left, leaving, table)
    else:
        link_edges(left, right, table)
    link_edges(previous, left, table)
    link_edges(right, following, table)
    return symbol


@njit(nogil=True, cache=True, from_python=False)
def number_vertex(vertex, a, b, apex, counts, number, parents):
    """Give a new vertex its number, and keep from which others its place is predicted."""
    row = counts[VERTICES]
    parents[row, 0], parents[row, 1], parents[row, 2], parents[row, 3] = vertex, a, b, apex
    number[vertex] = counts[VERTICES]
    counts[VERTICES] += 1


@njit(nogil=True, cache=True, from_python=False)
def add_edge(a, b, apex, across, table, stack, latest, counts):
    """Add an edge to the table and the stack; return its number."""
    edge = counts[EDGES]
    table[edge, BEGIN], table[edge, END] = a, b
    table[edge, ACROSS], table[edge, APEX] = across, apex
    table[edge, WAITS] = 1
    latest[a] = edge
    stack[counts[DEPTH]] = edge
    counts[EDGES] += 1
    counts[DEPTH] += 1
    return edge


@njit(nogil=True, cache=True, from_python=False)
def link_edges(ahead, behind, table):
    """Put an edge of a loop behind another."""
    table[ahead, AFTER] = behind
    table[behind, BEFORE] = ahead
