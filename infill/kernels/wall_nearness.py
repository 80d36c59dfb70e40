"""Distance of walls under collapse from themselves: watched points move from face to face of their own wall.

Each point of the original walls is watched once for each wall at it, and so are points on edges at which walls bend.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit
from infill.kernels.distances import squared_distance
from infill.kernels.quadrics import normal_and_shape, squared_length

NONE = -1
ALIGNED = 0.985  # cosine of the angle, 10 degrees, up to which the triangles of a wall count as aligned
ALIGNED_SPACING = 8.0  # there, places at which the distance is measured are further apart
MAX_WATCHED = 1 << 14  # points on the faces around an edge: where there are more, it stays
KEEP_SHARE = 0.25  # of a squared tolerance: a point within this of a triangle needs no nearer one
MOST_SAMPLES = 32  # on an edge
ROUNDING = 1 + 1e-9  # of a distance


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def has_corner(triangles, t, w):
    """Return True if a triangle has a corner."""
    return triangles[t, 0] == w or triangles[t, 1] == w or triangles[t, 2] == w


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def reassign_watched(
    u, triangles, pair, fan_v, watched, squared_tolerance, moved, chosen, changed, goes, goes_to, goes_at
):
    """Find for each watched point of the faces at an edge the nearest face of its wall; return their number, or -1.

    -1 stands for a point that would be too far from its wall, or too many points. `goes`, `goes_to` and `goes_at` are
    work space: the numbers, the new faces and the places of these points.
    """
    places, watched_heads, next_watched = watched[0], watched[1], watched[2]
    gone = 0
    for n in range(fan_v[3]):
        if has_corner(triangles, fan_v[0][n], u):
            chosen[changed + gone] = fan_v[0][n]
            gone += 1
    count = 0
    for face in range(changed + gone):
        p, of = watched_heads[chosen[face]], pair[chosen[face]]
        while p != NONE:
            x, y, z = places[p, 0], places[p, 1], places[p, 2]
            best, nearest = math.inf, NONE
            if face < changed:
                best, nearest = squared_distance(x, y, z, moved[face, 0], moved[face, 1], moved[face, 2]), face
            for m in range(changed):
                if best <= KEEP_SHARE * squared_tolerance:
                    break
                if m != face and pair[chosen[m]] == of:
                    squared = squared_distance(x, y, z, moved[m, 0], moved[m, 1], moved[m, 2])
                    if squared < best:
                        best, nearest = squared, m
            if best > squared_tolerance or count == len(goes):
                return NONE
            goes[count], goes_to[count] = p, nearest
            goes_at[count, 0], goes_at[count, 1], goes_at[count, 2] = x, y, z
            count += 1
            p = next_watched[p]
    return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _face_of_star(x, y, z, p, of, watched, squared_tolerance):
    """Return a given face of a wall at a watched point that is near a place; -1 if there is none."""
    point, original, star_start, star, was_pair = watched[3], watched[4], watched[5], watched[6], watched[7]
    v = point[p]
    for n in range(star_start[v], star_start[v + 1]):
        t = star[n]
        if was_pair[t] != of:
            continue
        if squared_distance(x, y, z, original[t, 0], original[t, 1], original[t, 2]) <= squared_tolerance:
            return t
    return NONE


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _find_near_face(x, y, z, last, of, watched, squared_tolerance, pair, chosen, goes, goes_to, goes_at, taken):
    """Return a given face of a wall near a place; -1 if there is none at the watched points that are taken.

    Tried first are the face that was found last, `last`, and those at the nearest point.
    """
    if last != NONE:
        original = watched[4]
        if squared_distance(x, y, z, original[last, 0], original[last, 1], original[last, 2]) <= squared_tolerance:
            return last
    best, nearest = math.inf, NONE
    for n in range(taken):
        squared = (goes_at[n, 0] - x) ** 2 + (goes_at[n, 1] - y) ** 2 + (goes_at[n, 2] - z) ** 2
        if squared < best and pair[chosen[goes_to[n]]] == of:
            best, nearest = squared, goes[n]
    if nearest == NONE:
        return NONE
    t = _face_of_star(x, y, z, nearest, of, watched, squared_tolerance)
    if t != NONE:
        return t
    distance, reach = math.sqrt(squared_tolerance), watched[8]
    for n in range(taken):
        p = goes[n]
        if p == nearest or pair[chosen[goes_to[n]]] != of:
            continue
        farthest = ROUNDING * (reach[p] + distance)  # no face at the point is as near beyond
        if (goes_at[n, 0] - x) ** 2 + (goes_at[n, 1] - y) ** 2 + (goes_at[n, 2] - z) ** 2 > farthest * farthest:
            continue
        t = _face_of_star(x, y, z, p, of, watched, squared_tolerance)
        if t != NONE:
            return t
    return NONE


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def are_faces_near(
    place, moved, changed, pair, chosen, watched, squared_tolerance, spacing, taken, normals, goes, goes_to, goes_at
):
    """Return True if a place, the edges from it and the middles of its faces are near the walls that were given.

    `normals` is work space.
    """
    for m in range(changed):
        normals[m, 0], normals[m, 1], normals[m, 2], _ = normal_and_shape(moved[m, 0], moved[m, 1], moved[m, 2])
    for m in range(changed):
        of = pair[chosen[m]]
        mx, my, mz = normals[m, 0], normals[m, 1], normals[m, 2]
        aligned, is_first = True, True
        for n in range(changed):
            if pair[chosen[n]] == of:
                is_first = is_first and n >= m
                nx, ny, nz = normals[n, 0], normals[n, 1], normals[n, 2]
                same = nx * mx + ny * my + nz * mz
                squares = (nx * nx + ny * ny + nz * nz) * (mx * mx + my * my + mz * mz)
                aligned = aligned and same > 0 and same * same >= ALIGNED**2 * squares
        a, b = moved[m, 1], moved[m, 2]
        apart, last = spacing * ALIGNED_SPACING if aligned else spacing, NONE
        parts = max(2, min(MOST_SAMPLES, math.ceil(math.sqrt(squared_length(place, a)) / apart)))
        for part in range(0 if is_first else 1, parts + 1):
            share = part / parts
            x = place[0] + share * (a[0] - place[0])
            y = place[1] + share * (a[1] - place[1])
            z = place[2] + share * (a[2] - place[2])
            if part == parts:
                x, y, z = (place[0] + a[0] + b[0]) / 3, (place[1] + a[1] + b[1]) / 3, (place[2] + a[2] + b[2]) / 3
            last = _find_near_face(
                x, y, z, last, of, watched, squared_tolerance, pair, chosen, goes, goes_to, goes_at, taken
            )
            if last == NONE:
                return False
    return True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def hand_over(watched_heads, next_watched, chosen, changed, goes, goes_to, taken):
    """Give the watched points to their new faces."""
    for m in range(changed):
        watched_heads[chosen[m]] = NONE
    for m in range(taken):
        p, t = goes[m], chosen[goes_to[m]]
        next_watched[p], watched_heads[t] = watched_heads[t], p
