"""Edges and corners of walls in order, compiled: by their points, and by the two labels of their triangles."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.quadrics import squared_length


@njit(nogil=True, cache=True)
def link_items(owner, heads, after):
    """Chain the items of each owner, in order.

    Parameters
    ----------
    owner : (N,) int32
    heads : (owners,) int32
        Of -1; written: the first item of each.
    after : (N,) int32
        Written: the next item of the same owner, -1 behind the last.
    """
    for item in range(len(owner) - 1, -1, -1):
        after[item], heads[owner[item]] = heads[owner[item]], item


@njit(nogil=True, cache=True)
def sort_edges(triangles, pair, starts, order):
    """Sort the edges of triangles by their lower point, their higher point, the pair of labels, and their number.

    Parameters
    ----------
    triangles : (T, 3) int32
    pair : (T,) int32
    starts : (P + 1,) int64
        Of 0; written: where the edges of each lower point begin.
    order : (3 T,) int64
        Written: numbers of edges; edge 3 t + k runs from corner k of triangle t to the next.
    """
    for t in range(len(triangles)):
        for k in range(3):
            starts[min(triangles[t, k], triangles[t, (k + 1) % 3]) + 1] += 1
    for point in range(1, len(starts)):
        starts[point] += starts[point - 1]
    cursor = starts.copy()
    for t in range(len(triangles)):
        for k in range(3):
            a, b = triangles[t, k], triangles[t, (k + 1) % 3]
            low, high = min(a, b), max(a, b)
            at = cursor[low]
            cursor[low] += 1
            while at > starts[low]:
                other, side = order[at - 1] // 3, order[at - 1] % 3
                end = max(triangles[other, side], triangles[other, (side + 1) % 3])
                if end < high or (end == high and pair[other] <= pair[t]):
                    break
                order[at] = order[at - 1]
                at -= 1
            order[at] = 3 * t + k


@njit(nogil=True, cache=True)
def match_edges(triangles, pair, order, is_next):
    """Mark the edges in `order`, (3 T,), whose next one has the same points and the same pair: is_next (3 T,) bool."""
    for at in range(len(order)):
        is_next[at] = False
        if at + 1 < len(order):
            t, k, u, m = order[at] // 3, order[at] % 3, order[at + 1] // 3, order[at + 1] % 3
            a, b, c, d = triangles[t, k], triangles[t, (k + 1) % 3], triangles[u, m], triangles[u, (m + 1) % 3]
            is_next[at] = min(a, b) == min(c, d) and max(a, b) == max(c, d) and pair[t] == pair[u]


@njit(nogil=True, cache=True)
def list_stars(triangles, starts, star):
    """List the triangles at every point, in order.

    Parameters
    ----------
    triangles : (T, 3) int32
    starts : (P + 1,) int32
        Of 0; written: where those of each point begin.
    star : (3 T,) int32
        Written.
    """
    for t in range(len(triangles)):
        for k in range(3):
            starts[triangles[t, k]] += 1
    for point in range(1, len(starts)):
        starts[point] += starts[point - 1]
    for t in range(len(triangles) - 1, -1, -1):
        for k in range(2, -1, -1):
            starts[triangles[t, k]] -= 1
            star[starts[triangles[t, k]]] = t


@njit(nogil=True, cache=True)
def list_walls(starts, star, pair, points, faces):
    """List every point once for each of the walls at it, in the order of their pairs; return the number.

    Parameters
    ----------
    starts, star : (P + 1,), (3 T,) int32
        See `list_stars`.
    pair : (T,) int32
    points, faces : (N,) int32
        Written: the points, and the first triangle of the wall at each.
    """
    count = 0
    for point in range(len(starts) - 1):
        begin = count
        for at in range(starts[point], starts[point + 1]):
            t, place = star[at], count
            while place > begin and pair[faces[place - 1]] > pair[t]:
                place -= 1
            if place > begin and pair[faces[place - 1]] == pair[t]:
                continue
            for n in range(count, place, -1):
                faces[n] = faces[n - 1]
            faces[place], points[count] = t, point
            count += 1
    return count


@njit(nogil=True, cache=True)
def measure_reach(places, point, corners, starts, star, reach):
    """Measure how far the triangles at points reach from places beside them.

    Parameters
    ----------
    places : (H, 3) float64
    point : (H,) int32
        The point of each place.
    corners : (T, 3, 3) float64
    starts, star : (P + 1,), (3 T,) int32
        See `list_stars`.
    reach : (H,) float64
        Written: the largest distance from a place to a corner of one of the triangles at its point.
    """
    for n in range(len(places)):
        largest = 0.0
        for at in range(starts[point[n]], starts[point[n] + 1]):
            for k in range(3):
                largest = max(largest, squared_length(places[n], corners[star[at], k]))
        reach[n] = math.sqrt(largest)
