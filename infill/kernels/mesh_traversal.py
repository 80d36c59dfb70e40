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
    most = 3 * len(faces) + 3
    begin, end = np.empty(most, dtype=np.int32), np.empty(most, dtype=np.int32)  # vertices of an edge of a loop
    across = np.empty(most, dtype=np.int32)  # the half-edge on its other side, or -1
    apex = np.empty(most, dtype=np.int32)  # third vertex of its triangle
    before, after = np.empty(most, dtype=np.int32), np.empty(most, dtype=np.int32)
    waits = np.zeros(most, dtype=np.uint8)
    leaving = np.full(len(number), -1, dtype=np.int32)  # latest edge of a loop that begins at a vertex
    stack = np.empty(most, dtype=np.int32)
    visited = np.zeros(len(faces), dtype=np.uint8)
    edges = depth = written = names = vertices = 0
    for first in range(len(faces)):
        if visited[first]:
            continue
        visited[first] = 1
        for k in range(3):
            v = faces[first, k]
            if number[v] < 0:
                parents[vertices, 0], parents[vertices, 1], parents[vertices, 3] = v, -1, -1
                parents[vertices, 2] = parents[vertices - 1, 0] if vertices else -1
                number[v] = vertices
                vertices += 1
                named[names] = 0
            else:
                named[names] = vertices - number[v]
            names += 1
        for k in range(3):
            begin[edges + k], end[edges + k] = faces[first, k], faces[first, (k + 1) % 3]
            apex[edges + k], across[edges + k] = faces[first, (k + 2) % 3], twin[3 * first + k]
            before[edges + k], after[edges + k] = edges + (k + 2) % 3, edges + (k + 1) % 3
            waits[edges + k] = 1
            leaving[faces[first, k]] = edges + k
            stack[depth] = edges + k
            depth += 1
        edges += 3
        while depth:
            depth -= 1
            g = stack[depth]
            if not waits[g]:
                continue
            h = across[g]
            if h < 0 or visited[h // 3]:
                symbols[written] = BORDER
                written += 1
                continue
            f, k = h // 3, h % 3
            visited[f] = 1
            a, b, c = begin[g], end[g], faces[f, (k + 2) % 3]
            p, n = before[g], after[g]
            closes_next = waits[n] and across[n] == 3 * f + (k + 2) % 3
            closes_previous = waits[p] and across[p] == 3 * f + (k + 1) % 3
            waits[g] = 0
            if closes_next and closes_previous:
                symbols[written] = BOTH
                waits[p] = waits[n] = 0
                before[after[n]], after[before[p]] = before[p], after[n]
            elif closes_next or closes_previous:
                symbols[written] = NEXT if closes_next else PREVIOUS
                waits[n if closes_next else p] = 0
                e = edges
                edges += 1
                begin[e], end[e] = (a, c) if closes_next else (c, b)
                apex[e] = b if closes_next else a
                across[e] = twin[3 * f + (k + 1) % 3] if closes_next else twin[3 * f + (k + 2) % 3]
                before[e], after[e] = (p, after[n]) if closes_next else (before[p], n)
                after[before[e]], before[after[e]] = e, e
                leaving[begin[e]] = e
                waits[e] = 1
                stack[depth] = e
                depth += 1
            else:
                left, right = edges, edges + 1
                edges += 2
                o = -1
                if number[c] < 0:
                    symbols[written] = NEW
                    parents[vertices, 0], parents[vertices, 1] = c, a
                    parents[vertices, 2], parents[vertices, 3] = b, apex[g]
                    number[c] = vertices
                    vertices += 1
                else:
                    symbols[written] = OLD
                    named[names] = vertices - number[c]
                    names += 1
                    o = leaving[c]
                begin[left], end[left], apex[left] = a, c, b
                begin[right], end[right], apex[right] = c, b, a
                across[left], across[right] = twin[3 * f + (k + 1) % 3], twin[3 * f + (k + 2) % 3]
                before[left], after[right] = p, n
                if o >= 0 and waits[o] and o != g:
                    after[left], before[right] = o, before[o]
                    after[before[o]], before[o] = right, left
                else:
                    after[left], before[right] = right, left
                after[p], before[n] = left, right
                leaving[a], leaving[c] = left, right
                waits[left] = waits[right] = 1
                stack[depth], stack[depth + 1] = left, right
                depth += 2
            written += 1
    return written, names, vertices
