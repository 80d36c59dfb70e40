"""Whether a mesh whose edges are collapsed stays near the mesh it was: points of that one go from triangle to triangle.

Points are the vertices of the mesh as it was given, and some along the edges at which it bends.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.corners import NONE, following, preceding
from infill.kernels.distances import squared_distance
from infill.kernels.quadrics import shape_of, squared_length

PARTS = 64  # at most, of an edge whose distance is looked at
KEPT = 0.25  # of a squared tolerance: a point this near stays with its triangle


@njit(nogil=True, cache=True, error_model="numpy")
def edge_points(vertices, start, twin, height, apart, most, points, owner):
    """Set points along the edges at which the surface bends; return how many there are (count only: no room needed).

    Parameters
    ----------
    vertices, start, twin
        See `infill.kernels.collapsing.collapse`.
    height : float
        An edge bends if without it the surface might move by more than this.
    apart : float
        How far points are from one another at most, unless there are `most` of them on an edge.
    points, owner : (P, 3) float64, (P,) int32
        What is found; with no room, points are counted only.
    """
    count = 0
    for c in range(len(start)):
        d = twin[c]
        if d < c:
            continue
        a, b = vertices[start[c]], vertices[start[following(c)]]
        ox, oy, oz, _ = shape_of(a, b, vertices[start[preceding(c)]])
        nx, ny, nz, _ = shape_of(b, a, vertices[start[preceding(d)]])
        one, two = math.sqrt(ox * ox + oy * oy + oz * oz), math.sqrt(nx * nx + ny * ny + nz * nz)
        length = math.sqrt(squared_length(a, b))
        if length == 0 or one == 0 or two == 0:
            continue
        bend = math.sqrt(max(0.0, 0.5 - 0.5 * (ox * nx + oy * ny + oz * nz) / (one * two)))
        if bend * min(one, two) <= height * length:
            continue
        here = max(1, min(most, int(length / apart)))
        for n in range(here):
            if count < len(points):
                share = (n + 1) / (here + 1)
                for k in range(3):
                    points[count, k] = a[k] + share * (b[k] - a[k])
                owner[count] = c
            count += 1
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def handed_on(first_point, next_point, points, near, moved, chosen, changed, goes, goes_to):
    """Find for each point of some faces, two of which will be gone, which of the others will be nearest.

    Parameters
    ----------
    first_point, next_point : (F,) int32, (P,) int32
        The points of each face, as a chain.
    points : (P, 3) float64
    near : float
        The square of how far they may be away.
    moved : (N, 3, 3) float64
        The faces as they will be.
    chosen : (N + 2,) int32
        Which faces they are, and the two that will be gone.
    changed : int
        N.
    goes, goes_to : (M,) int32
        Are set to the points and the face to which each goes.

    Returns
    -------
    int
        How many points there are; -1 if one will be too far, or if there is no room for them.
    """
    count = 0
    for own in range(changed + 2):
        p = first_point[chosen[own]]
        while p != NONE:
            x, y, z = points[p]
            least, nearest = math.inf, NONE
            if own < changed:
                least, nearest = squared_distance(x, y, z, moved[own, 0], moved[own, 1], moved[own, 2]), own
            if least > KEPT * near:
                for m in range(changed):
                    if m != own:
                        found = squared_distance(x, y, z, moved[m, 0], moved[m, 1], moved[m, 2])
                        if found < least:
                            least, nearest = found, m
            if least > near or count == len(goes):
                return NONE
            goes[count], goes_to[count] = p, chosen[nearest]
            count += 1
            p = next_point[p]
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def _at_point(x, y, z, point, bound, corner, was):
    """Return a corner of a face, as it was given, that is near a place and at a point; -1 if there is none."""
    given, twin, leaving = was
    on_edge = point >= len(leaving)
    first = corner[point]
    at = first
    while True:
        f = 3 * (at // 3)
        if squared_distance(x, y, z, given[f], given[f + 1], given[f + 2]) <= bound:
            return at
        at = twin[at] if on_edge else twin[preceding(at)]
        if at == first:
            return NONE


@njit(nogil=True, cache=True, error_model="numpy")
def _near_given(x, y, z, points, near, goes, count, corner, was):
    """Return a corner of a face, as it was given, that is near a place; -1 if there is none.

    Faces at the point that is nearest to the place are looked at first, then those at all others.
    """
    least, nearest = math.inf, goes[0]
    for n in range(count):
        p = goes[n]
        found = (points[p, 0] - x) ** 2 + (points[p, 1] - y) ** 2 + (points[p, 2] - z) ** 2
        if found < least:
            least, nearest = found, p
    at = _at_point(x, y, z, nearest, near, corner, was)
    n = 0
    while at == NONE and n < count:
        at = _at_point(x, y, z, goes[n], near, corner, was)
        n += 1
    return at


@njit(nogil=True, cache=True, error_model="numpy")
def all_near(place, moved, changed, apart, points, near, goes, count, corner, was):
    """Return whether the new edges are near the surface as it was given, looked at every `apart`, a squared length.

    That suffices: a face between them is flat, and so are what was given and lies on it. `was` holds the places of the
    corners as they were given (3 F, 3), their twins and one corner of each vertex; see `handed_on` for the others.
    """
    given = was[0]
    middle = _near_given(place[0], place[1], place[2], points, near, goes, count, corner, was)
    if middle == NONE:
        return False
    for m in range(changed):
        a, at = moved[m, 1], middle
        parts = max(2, min(PARTS, math.ceil(math.sqrt(squared_length(place, a) / apart))))
        for part in range(1, parts):
            share = part / parts
            x = place[0] + share * (a[0] - place[0])
            y = place[1] + share * (a[1] - place[1])
            z = place[2] + share * (a[2] - place[2])
            f = 3 * (at // 3)
            if squared_distance(x, y, z, given[f], given[f + 1], given[f + 2]) > near:
                at = _near_given(x, y, z, points, near, goes, count, corner, was)
                if at == NONE:
                    return False
    return True
