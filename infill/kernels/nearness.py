"""Distance of a mesh under edge collapse from the original: points of the original move from triangle to triangle.

Points are the vertices of the original mesh, and some along the edges at which it bends.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.corners import NO_CORNER, next_corner, previous_corner
from infill.kernels.distances import squared_distance
from infill.kernels.quadrics import normal_and_shape, squared_length

MAX_SAMPLES = 64  # largest number of samples on an edge
KEEP_SHARE = 0.25  # of a squared tolerance: a point within this of a triangle needs no nearer one


@njit(nogil=True, cache=True, error_model="numpy")
def edge_points(vertices, start, twin, height, apart, max_points, points, owner):
    """Set points along the edges at which the surface bends; return their number (without room, only count).

    Parameters
    ----------
    vertices, start, twin
        See `infill.kernels.collapsing.collapse`.
    height : float
        An edge bends if the surface without it might move by more than this.
    apart : float
        Largest distance between points, unless an edge has `max_points` of them.
    points, owner : (P, 3) float64, (P,) int32
        The results; without room, points are only counted.
    """
    count = 0
    for c in range(len(start)):
        d = twin[c]
        if d < c:
            continue
        a, b = vertices[start[c]], vertices[start[next_corner(c)]]
        ox, oy, oz, _ = normal_and_shape(a, b, vertices[start[previous_corner(c)]])
        nx, ny, nz, _ = normal_and_shape(b, a, vertices[start[previous_corner(d)]])
        length_a, length_b = math.sqrt(ox * ox + oy * oy + oz * oz), math.sqrt(nx * nx + ny * ny + nz * nz)
        length = math.sqrt(squared_length(a, b))
        if length == 0 or length_a == 0 or length_b == 0:
            continue
        bend = math.sqrt(max(0.0, 0.5 - 0.5 * (ox * nx + oy * ny + oz * nz) / (length_a * length_b)))
        if bend * min(length_a, length_b) <= height * length:
            continue
        count_here = max(1, min(max_points, int(length / apart)))
        for n in range(count_here):
            if count < len(points):
                share = (n + 1) / (count_here + 1)
                for k in range(3):
                    points[count, k] = a[k] + share * (b[k] - a[k])
                owner[count] = c
            count += 1
    return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def reassign_points(first_point, next_point, points, squared_tolerance, moved, chosen, changed, goes, goes_to):
    """Find for each point of some faces, two of which will go, one of the others: the nearest, or one that is near.

    Parameters
    ----------
    first_point, next_point : (F,) int32, (P,) int32
        The points of each face, as a chain.
    points : (P, 3) float64
    squared_tolerance : float
        The square of the largest allowed distance.
    moved : (N, 3, 3) float64
        The faces after the collapse.
    chosen : (N + 2,) int32
        Indices of these faces, and of the two that go.
    changed : int
        N.
    goes, goes_to : (M,) int32
        Set to the points and the new face of each.

    Returns
    -------
    int
        Number of points; -1 if one would be too far, or if there is not enough room.
    """
    count = 0
    for face in range(changed + 2):
        p = first_point[chosen[face]]
        while p != NO_CORNER:
            x, y, z = points[p]
            best, nearest = math.inf, NO_CORNER
            if face < changed:
                best, nearest = squared_distance(x, y, z, moved[face, 0], moved[face, 1], moved[face, 2]), face
            if best > KEEP_SHARE * squared_tolerance:
                for m in range(changed):
                    if best <= KEEP_SHARE * squared_tolerance:
                        break
                    if m != face:
                        squared = squared_distance(x, y, z, moved[m, 0], moved[m, 1], moved[m, 2])
                        if squared < best:
                            best, nearest = squared, m
            if best > squared_tolerance or count == len(goes):
                return NO_CORNER
            goes[count], goes_to[count] = p, chosen[nearest]
            count += 1
            p = next_point[p]
    return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _find_near_corner_at(x, y, z, point, squared_tolerance, corner, was):
    """Return a corner at a point whose original face is near a place; -1 if there is none."""
    original_corners, twin, leaving = was
    on_edge = point >= len(leaving)
    begin = corner[point]
    at = begin
    while True:
        f = 3 * (at // 3)
        if (
            squared_distance(x, y, z, original_corners[f], original_corners[f + 1], original_corners[f + 2])
            <= squared_tolerance
        ):
            return at
        at = twin[at] if on_edge else twin[previous_corner(at)]
        if at == begin:
            return NO_CORNER


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _find_near_corner(x, y, z, points, squared_tolerance, goes, count, corner, was):
    """Return a corner, at one of some points, whose original face is near a place; -1 if there is none.

    Faces at the point nearest to the place are tried first, then those at all other points.
    """
    best, nearest = math.inf, goes[0]
    for n in range(count):
        p = goes[n]
        squared = (points[p, 0] - x) ** 2 + (points[p, 1] - y) ** 2 + (points[p, 2] - z) ** 2
        if squared < best:
            best, nearest = squared, p
    at = _find_near_corner_at(x, y, z, nearest, squared_tolerance, corner, was)
    n = 0
    while at == NO_CORNER and n < count:
        at = _find_near_corner_at(x, y, z, goes[n], squared_tolerance, corner, was)
        n += 1
    return at


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def are_edges_near(place, moved, changed, squared_spacing, points, squared_tolerance, goes, count, corner, was):
    """Return True if samples on the new edges, no further apart than a squared spacing, are near the original surface.

    That suffices: a face between them is flat, and so is the original that lies on it. `was` holds the original
    corners (3 F, 3), their twins and one corner of each vertex; see `reassign_points` for the others.
    """
    original_corners = was[0]
    middle = _find_near_corner(place[0], place[1], place[2], points, squared_tolerance, goes, count, corner, was)
    if middle == NO_CORNER:
        return False
    for m in range(changed):
        a, at = moved[m, 1], middle
        parts = max(2, min(MAX_SAMPLES, math.ceil(math.sqrt(squared_length(place, a) / squared_spacing))))
        for part in range(1, parts):
            share = part / parts
            x = place[0] + share * (a[0] - place[0])
            y = place[1] + share * (a[1] - place[1])
            z = place[2] + share * (a[2] - place[2])
            f = 3 * (at // 3)
            if (
                squared_distance(x, y, z, original_corners[f], original_corners[f + 1], original_corners[f + 2])
                > squared_tolerance
            ):
                at = _find_near_corner(x, y, z, points, squared_tolerance, goes, count, corner, was)
                if at == NO_CORNER:
                    return False
    return True
