"""Edges collapsed in walls between labels, where more than two triangles may share an edge.

Points have an order: inside a wall (0), on a line where walls meet (1), or where lines meet (2). A point is collapsed
along an edge into one of its own order or a higher one; points of a line, along the line alone. An edge is collapsed
only if the walls stay what they are to each other: both ends share no neighbours but those of the triangles at the
edge, and no triangle twice (the link condition; Dey, Edelsbrunner, Guha and Nekhayev 1999).

Triangles lie in slabs, one thread for each; those that reach into two slabs stay.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.crossings import does_edge_pierce
from infill.kernels.quadrics import best_place, evaluate_quadric, move_into_plane, normal_and_shape, squared_length
from infill.kernels.rows import copy_row
from infill.kernels.wall_nearness import MAX_WATCHED, NONE, are_faces_near, hand_over, has_corner, reassign_watched

WALL, LINE, FIXED = 0, 1, 2
MOST_FACES = 64  # at a point
MOST_AROUND = 16  # faces at a point after a collapse
ATTEMPTS = 3  # neighbours that are tried for each point in a sweep
SLENDER = 0.02  # shape, 1 for equal sides and 0 for a line: triangles stay better than this or than the worst before
THIN = 0.005  # shape of a triangle whose own normal is unreliable
TURNED = 0.2  # cosine of the angle by which a triangle may turn


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _faces_of(v, triangles, heads, after, faces):
    """Write the triangles at a point, and forget those that are gone; return their number, -1 if there are too many."""
    count, before, c = 0, NONE, heads[v]
    while c != NONE:
        following = after[c]
        if triangles[c // 3, 0] == NONE:
            if before == NONE:
                heads[v] = following
            else:
                after[before] = following
        else:
            if count == len(faces):
                return NONE
            faces[count] = c // 3
            count += 1
            before = c
        c = following
    return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _neighbours_of(v, triangles, pair, faces, count, ring, uses):
    """Write the neighbours of a point, and how often each is used, negative on a line; return their number."""
    size = 0
    for n in range(count):
        t = faces[n]
        for k in range(3):
            w = triangles[t, k]
            if w == v:
                continue
            at = 0
            while at < size and ring[at, 0] != w:
                at += 1
            if at == size:
                ring[at, 0], ring[at, 1], uses[at] = w, pair[t], 1
                size += 1
            else:
                uses[at] += 1
                if ring[at, 1] != pair[t]:
                    ring[at, 1] = NONE
    for at in range(size):
        if uses[at] != 2 or ring[at, 1] == NONE:
            uses[at] = -uses[at]
    return size


@njit(nogil=True, cache=True, error_model="numpy")
def order_points(triangles, pair, heads, after, order):
    """Set the order of every point: 0 inside a wall, 1 on a line, 2 where lines meet or walls touch.

    Parameters
    ----------
    triangles : (T, 3) int32
    pair : (T,) int32
        A number for the two labels of each triangle.
    heads, after : (P,) int32, (3 T,) int32
        The corners at each point, as a chain.
    order : (P,) int8
    """
    faces, ring, uses = np.empty(MOST_FACES, np.int32), np.empty((2 * MOST_FACES, 2), np.int32), np.empty(128, np.int32)
    root = np.empty(2 * MOST_FACES, np.int32)
    for v in range(len(heads)):
        count = _faces_of(v, triangles, heads, after, faces)
        order[v] = FIXED
        if count <= 0:
            continue
        size = _neighbours_of(v, triangles, pair, faces, count, ring, uses)
        lines = 0
        for at in range(size):
            root[at] = at
            lines += uses[at] < 0
        parts = size
        for n in range(count):
            a, b = NONE, NONE
            for at in range(size):
                for k in range(3):
                    if triangles[faces[n], k] == ring[at, 0]:
                        a, b = at, a
            while root[a] != a:
                a = root[a]
            while root[b] != b:
                b = root[b]
            if a != b:
                root[a] = b
                parts -= 1
        if parts == 1 and lines == 0:
            order[v] = WALL
        elif parts == 1 and lines == 2:
            order[v] = LINE


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_link_whole(u, v, triangles, order, fan_u, fan_v, shared):
    """Return True if the edge u-v may go: see the module. `fan_u` are the faces, ring, uses and their numbers."""
    _, ring_u, uses_u, count_u, size_u = fan_u
    faces_v, ring_v, uses_v, count_v, size_v = fan_v
    common = 0
    for n in range(size_u):
        w = ring_u[n, 0]
        if w == v:
            continue
        for m in range(size_v):
            if ring_v[m, 0] == w:
                common += 1
                if order[u] >= LINE and uses_u[n] < 0 and uses_v[m] < 0:
                    return False
    if common != shared:
        return False
    faces_u = fan_u[0]
    for m in range(count_v):
        t = faces_v[m]
        if has_corner(triangles, t, u):
            continue
        for n in range(count_u):
            other, same = faces_u[n], 0
            for k in range(3):
                w = triangles[t, k]
                same += w != v and has_corner(triangles, other, w)
            if same == 2:
                return False
    return True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _side_place(flags, lower, upper, place):
    """Move a place onto the sides of the box that are flagged, two bits an axis."""
    for axis in range(3):
        if flags >> (2 * axis) & 1:
            place[axis] = lower[axis]
        elif flags >> (2 * axis + 1) & 1:
            place[axis] = upper[axis]


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _place_of(u, v, points, order, flags, quadric, box, s, place):
    """Set the place to which an edge u-v would collapse; return the quadric's value there, inf if it must not."""
    low, high = flags[u] & flags[v], flags[u] | flags[v]
    if order[v] > order[u] or order[v] == FIXED:
        if high != flags[v]:
            return math.inf
        for k in range(11):
            s[k] = quadric[u, k] + quadric[v, k]
        copy_row(place, points[v])
        return evaluate_quadric(s, place[0], place[1], place[2])
    if high not in (flags[u], flags[v]):
        return math.inf
    cost = best_place(points[u], points[v], quadric[u], quadric[v], s, place)
    if high:
        if low != high:
            copy_row(place, points[u] if high == flags[u] else points[v])
        _side_place(high, box[0], box[1], place)
        cost = evaluate_quadric(s, place[0], place[1], place[2])
    return cost


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _keep_volume(u, v, points, triangles, fan_u, fan_v, s, place):
    """Move a place along the quadric's valley so that both sides of the wall keep their volume (Lindstrom, Turk)."""
    origin = points[u]
    gx, gy, gz, target = 0.0, 0.0, 0.0, 0.0
    for side in range(2):
        faces, count, centre = (fan_u[0], fan_u[3], u) if side == 0 else (fan_v[0], fan_v[3], v)
        for n in range(count):
            t = faces[n]
            shared = has_corner(triangles, t, v if side == 0 else u)
            if shared and side == 1:
                continue
            k = 0 if triangles[t, 0] == centre else 1 if triangles[t, 1] == centre else 2
            a, b = points[triangles[t, (k + 1) % 3]], points[triangles[t, (k + 2) % 3]]
            ax, ay, az = a[0] - origin[0], a[1] - origin[1], a[2] - origin[2]
            bx, by, bz = b[0] - origin[0], b[1] - origin[1], b[2] - origin[2]
            nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
            o = points[centre]
            target += (o[0] - origin[0]) * nx + (o[1] - origin[1]) * ny + (o[2] - origin[2]) * nz
            if not shared:
                gx, gy, gz = gx + nx, gy + ny, gz + nz
    off = target - (gx * (place[0] - origin[0]) + gy * (place[1] - origin[1]) + gz * (place[2] - origin[2]))
    move_into_plane(s, gx, gy, gz, off, squared_length(points[u], points[v]), place)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _choose_place(u, v, mesh, fan_u, fan_v, s, place):
    """Set the place to which an edge collapses: inside a wall, both its sides keep their volume."""
    points, triangles, _, _, _, order, flags, _, quadric, box = mesh
    _place_of(u, v, points, order, flags, quadric, box, s, place)
    if order[u] == WALL and order[v] == WALL and flags[u] == 0 and flags[v] == 0:
        _keep_volume(u, v, points, triangles, fan_u, fan_v, s, place)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _propose_faces(u, v, points, triangles, fan_u, fan_v, place, moved, chosen):
    """Write the faces that a collapse leaves, from the place on; return their number, -1 if one turns or is thin."""
    worst = 1.0
    for side in range(2):
        faces, count = (fan_u[0], fan_u[3]) if side == 0 else (fan_v[0], fan_v[3])
        for n in range(count):
            t = faces[n]
            _, _, _, shape = normal_and_shape(points[triangles[t, 0]], points[triangles[t, 1]], points[triangles[t, 2]])
            worst = min(worst, shape)
    changed = 0
    for side in range(2):
        faces, count, centre, other = (fan_u[0], fan_u[3], u, v) if side == 0 else (fan_v[0], fan_v[3], v, u)
        for n in range(count):
            t = faces[n]
            if has_corner(triangles, t, other):
                continue
            k = 0 if triangles[t, 0] == centre else 1 if triangles[t, 1] == centre else 2
            a, b = points[triangles[t, (k + 1) % 3]], points[triangles[t, (k + 2) % 3]]
            ox, oy, oz, shape = normal_and_shape(points[centre], a, b)
            nx, ny, nz, new_shape = normal_and_shape(place, a, b)
            if new_shape < min(SLENDER, worst):
                return NONE
            if shape >= THIN:
                same = nx * ox + ny * oy + nz * oz
                squares = (nx * nx + ny * ny + nz * nz) * (ox * ox + oy * oy + oz * oz)
                if not same > 0 or same * same < TURNED**2 * squares:
                    return NONE
            copy_row(moved[changed, 0], place)
            copy_row(moved[changed, 1], a)
            copy_row(moved[changed, 2], b)
            chosen[changed] = t
            changed += 1
    return changed


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _ends_of(corners, axis):
    """Return the lowest and the highest coordinate of a triangle along an axis."""
    a, b, c = corners[0, axis], corners[1, axis], corners[2, axis]
    return min(a, b, c), max(a, b, c)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_clear(u, v, mesh, fan_u, fan_v, moved, changed, chosen, around, corners, bounds, normal, height):
    """Return True if no face that a collapse would leave passes through a face at one of the neighbours.

    `around`, `corners`, `bounds`, `normal` and `height` are work space.
    """
    points, triangles, _, heads, after, _, _, _, _, _ = mesh
    for m in range(changed):
        for axis in range(3):
            bounds[m, 0, axis] = min(moved[m, 0, axis], moved[m, 1, axis], moved[m, 2, axis])
            bounds[m, 1, axis] = max(moved[m, 0, axis], moved[m, 1, axis], moved[m, 2, axis])
    for side in range(2):
        ring, size = (fan_u[1], fan_u[4]) if side == 0 else (fan_v[1], fan_v[4])
        for at in range(size):
            w = np.int64(ring[at, 0])
            if w in (u, v):
                continue
            for n in range(_faces_of(w, triangles, heads, after, around)):
                t = around[n]
                if has_corner(triangles, t, u) or has_corner(triangles, t, v):
                    continue
                for k in range(3):
                    copy_row(corners[k], points[triangles[t, k]])
                low_x, high_x = _ends_of(corners, 0)
                low_y, high_y = _ends_of(corners, 1)
                low_z, high_z = _ends_of(corners, 2)
                for m in range(changed):
                    if low_x > bounds[m, 1, 0] or high_x < bounds[m, 0, 0]:
                        continue
                    if low_y > bounds[m, 1, 1] or high_y < bounds[m, 0, 1]:
                        continue
                    if low_z > bounds[m, 1, 2] or high_z < bounds[m, 0, 2]:
                        continue
                    shares = False
                    for k in range(3):
                        x = triangles[chosen[m], k]
                        shares = shares or (x != u and x != v and has_corner(triangles, t, x))
                    if shares:
                        continue
                    if does_edge_pierce(moved[m], corners, normal, height):
                        return False
                    if does_edge_pierce(corners, moved[m], normal, height):
                        return False
    return True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _choose_neighbour(u, mesh, fan_u, bound, swept, failed, sweep, tried, s, place):
    """Return the nearest neighbour into which a point may be collapsed, of those not tried; -1 if there is none."""
    points, _, _, _, _, order, flags, _, quadric, box = mesh
    _, ring, uses, _, size = fan_u
    best, nearest = math.inf, NONE
    for n in range(size):
        v = ring[n, 0]
        if tried[n] or order[v] < order[u] or (order[u] == LINE and uses[n] > 0):
            continue
        if swept[v] == sweep:
            failed[u] = NONE
            continue
        squared = squared_length(points[u], points[v])
        if squared >= best:
            continue
        if _place_of(u, v, points, order, flags, quadric, box, s, place) > bound * s[10]:
            tried[n] = True
            continue
        best, nearest = squared, n
    return nearest


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _is_in_slab(faces, count, triangles, slab, number):
    """Return True if all corners of triangles lie in a slab."""
    for n in range(count):
        for k in range(3):
            if slab[triangles[faces[n], k]] != number:
                return False
    return True


@njit(nogil=True, cache=True, error_model="numpy")
def sweep_walls(
    mesh,
    watched,
    members,
    starts,
    bound,
    squared_tolerance,
    spacing,
    into,
    swept,
    failed,
    sweep,
    removed,
    thread,
    threads,
):
    """Collapse one edge for each point of each slab, and nowhere twice; count the points gone.

    Parameters
    ----------
    mesh : tuple
        points (P, 3) float64, triangles (T, 3) int32, pair (T,) int32, heads (P,) int32, after (3 T,) int32, order
        (P,) int8, flags (P,) int8 (the sides of the box on which a point lies), slab (P,) int32, quadric (P, 11)
        float64, and the box (2, 3) float64. Changed in place: triangles that are gone have corners -1.
    watched : tuple
        What must stay near: places (H, 3) float64, watched_heads (T,) int32, next_watched (H,) int32, point (H,) int32,
        original corners (T, 3, 3) float64, star_start (P + 1,) int32, star (3 T,) int32 and the pairs (T,) of the
        original, and reach (H,) float64, see `infill.kernels.wall_edges.measure_reach`. Without places, nothing is
        watched.
    members, starts : (P,) int32, (slabs + 1,) int64
        The points of each slab.
    bound : float
        Largest mean squared distance of a collapse from the planes it replaces.
    squared_tolerance, spacing : float
        The square of the largest distance, and the distance between the places where it is measured.
    into, swept, failed : (P,) int32
        The point that each was collapsed into; the last sweeps that changed a point, and that found no way for it.
    removed : (slabs,) int64
    """
    points, triangles, pair, heads, after, order, _, slab, quadric, _ = mesh
    s, place, sides = np.empty(11), np.empty(3), 2 * MOST_FACES
    faces_u, faces_v = np.empty(MOST_FACES, np.int32), np.empty(MOST_FACES, np.int32)
    ring_u, ring_v = np.empty((sides, 2), np.int32), np.empty((sides, 2), np.int32)
    uses_u, uses_v = np.empty(sides, np.int32), np.empty(sides, np.int32)
    tried, moved, chosen = np.empty(sides, np.bool_), np.empty((sides, 3, 3)), np.empty(2 * sides, np.int32)
    going = np.empty(MAX_WATCHED, np.int32), np.empty(MAX_WATCHED, np.int32), np.empty((MAX_WATCHED, 3))
    normals = np.empty((sides, 3))
    around, crossing_space = np.empty(MOST_FACES, np.int32), (
        np.empty((3, 3)), np.empty((sides, 2, 3)), np.empty(3), np.empty(3)
    )  # fmt: skip
    for number in range(thread, len(starts) - 1, threads):
        for member in range(starts[number], starts[number + 1]):
            u = np.int64(members[member])
            if into[u] != u or order[u] == FIXED or swept[u] == sweep or failed[u] > swept[u]:
                continue
            count_u = _faces_of(u, triangles, heads, after, faces_u)
            if count_u <= 0 or not _is_in_slab(faces_u, count_u, triangles, slab, number):
                continue
            size_u = _neighbours_of(u, triangles, pair, faces_u, count_u, ring_u, uses_u)
            fan_u = faces_u, ring_u, uses_u, count_u, size_u
            tried[:size_u] = False
            failed[u] = sweep
            for _ in range(ATTEMPTS):
                n = _choose_neighbour(u, mesh, fan_u, bound, swept, failed, sweep, tried, s, place)
                if n == NONE:
                    break
                tried[n] = True
                v, shared = np.int64(ring_u[n, 0]), abs(uses_u[n])
                count_v = _faces_of(v, triangles, heads, after, faces_v)
                if count_v <= 0 or not 3 <= count_u + count_v - 2 * shared <= MOST_AROUND:
                    continue
                if not _is_in_slab(faces_v, count_v, triangles, slab, number):
                    failed[u] = NONE
                    continue
                size_v = _neighbours_of(v, triangles, pair, faces_v, count_v, ring_v, uses_v)
                fan_v = faces_v, ring_v, uses_v, count_v, size_v
                if not _is_link_whole(u, v, triangles, order, fan_u, fan_v, shared):
                    continue
                _choose_place(u, v, mesh, fan_u, fan_v, s, place)
                changed = _propose_faces(u, v, points, triangles, fan_u, fan_v, place, moved, chosen)
                if changed == NONE:
                    continue
                taken = 0
                if len(watched[0]):
                    taken = reassign_watched(
                        u, triangles, pair, fan_v, watched, squared_tolerance, moved, chosen, changed, *going
                    )
                    if taken == NONE or not are_faces_near(
                        place, moved, changed, pair, chosen, watched, squared_tolerance, spacing, taken, normals, *going
                    ):
                        continue
                    if not _is_clear(u, v, mesh, fan_u, fan_v, moved, changed, chosen, around, *crossing_space):
                        continue
                    hand_over(watched[1], watched[2], chosen, changed, going[0], going[1], taken)
                copy_row(quadric[v], s)
                copy_row(points[v], place)
                _collapse(u, v, mesh, faces_u, count_u, faces_v, into, swept, sweep)
                removed[number] += 1
                break


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _collapse(u, v, mesh, faces_u, count_u, faces_v, into, swept, sweep):
    """Give the triangles of point u to v, and drop those with both; `faces_v` is work space."""
    _, triangles, _, heads, after, _, flags, _, _, _ = mesh
    for n in range(count_u):
        t = faces_u[n]
        if has_corner(triangles, t, v):
            triangles[t, 0], triangles[t, 1], triangles[t, 2] = NONE, NONE, NONE
        else:
            for k in range(3):
                if triangles[t, k] == u:
                    triangles[t, k] = v
    last = heads[u]
    while after[last] != NONE:
        last = after[last]
    after[last], heads[v], heads[u] = heads[v], heads[u], NONE
    flags[v] |= flags[u]
    into[u] = v
    for m in range(_faces_of(v, triangles, heads, after, faces_v)):
        for k in range(3):
            swept[triangles[faces_v[m], k]] = sweep
