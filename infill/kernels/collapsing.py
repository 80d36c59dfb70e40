"""Edges collapsed, the cheapest first, in a mesh that stays closed, keeps its volume and stays near the original."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.corners import (
    MAX_CORNERS,
    NO_CORNER,
    can_collapse,
    collapse_edge,
    corners_of,
    next_corner,
    previous_corner,
)
from infill.kernels.nearness import are_edges_near, reassign_points
from infill.kernels.quadrics import best_place, move_into_plane, normal_and_shape, squared_length
from infill.kernels.rows import copy_row

BUCKETS = 96  # of costs, two for each factor of two
UNIT = 72  # the bucket of costs of one unit
SLENDER = 0.02  # shape, 1 for equal sides and 0 for a line: triangles stay better than this or than the worst before
THIN = 0.005  # shape of a triangle whose own normal is unreliable
TURNED = 0.2  # cosine of the angle by which a triangle may turn
SHORT = 1e-3  # of squared tolerance and squared length: among collapses of no cost, short edges go first
# Distance between the sample points of new edges: squared mean edges and squared tolerances.
SAMPLE_SPACING, WIDE = 0.05, 4.0
MAX_HELD_POINTS = 1 << 16  # points on the faces around an edge: where there are more, it stays
MOST_SWEEPS, LEAST_SWEPT = 12, 0.04  # sweeps without an order of edges, and the share of vertices that one takes
MOST_AROUND = 12  # corners at a vertex after such a collapse: no vertex grows at the cost of its neighbours
# Squared cosines, of the planes of a quadric as a mean and of each face: where a place is level to 10 and 14 degrees,
# an edge is furthest from the surface near its middle, so that one sample is enough for it.
ALIGNED_PLANES, ALIGNED_FACES = 0.97, 0.94
RETRY_SHARE = 0.005  # of the triangles: while at least this share is removed, edges that stayed are tried again


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _enqueue(c, bucket, queue, ends):
    """Put an edge at the end of a bucket: `queue` holds the next edge, the previous one and the bucket."""
    tail = ends[bucket, 1]
    queue[c, 0], queue[c, 1], queue[c, 2] = NO_CORNER, tail, bucket
    if tail == NO_CORNER:
        ends[bucket, 0] = c
    else:
        queue[tail, 0] = c
    ends[bucket, 1] = c


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _dequeue(c, queue, ends):
    """Remove an edge from its bucket, if it is in one."""
    bucket = queue[c, 2]
    if bucket == NO_CORNER:
        return
    after, before = queue[c, 0], queue[c, 1]
    if before == NO_CORNER:
        ends[bucket, 0] = after
    else:
        queue[before, 0] = after
    if after == NO_CORNER:
        ends[bucket, 1] = before
    else:
        queue[after, 1] = before
    queue[c, 2] = NO_CORNER


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _update_bucket(c, vertices, start, twin, fixed, quadric, bound, edge, queue, ends, s, place):
    """Put an edge into the bucket of its cost, or into none if it must not be collapsed; return the bucket."""
    c = min(c, twin[c])
    _dequeue(c, queue, ends)
    u, v = start[c], start[next_corner(c)]
    if fixed[u] or fixed[v]:
        return BUCKETS
    cost = best_place(vertices[u], vertices[v], quadric[u], quadric[v], s, place)
    if cost > bound * s[10]:
        return BUCKETS
    squared_bound = bound if math.isfinite(bound) else 1e-4 * edge
    cost += SHORT * squared_bound * squared_length(vertices[u], vertices[v])
    bucket = 0
    if cost > 0:
        bucket = min(BUCKETS - 1, max(0, int(2 * math.log2(cost / (squared_bound * edge)) + UNIT)))
    _enqueue(c, bucket, queue, ends)
    return bucket


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _keep_volume(c, vertices, start, twin, ring, ring_size, end_ring, end_ring_size, s, place):
    """Move the place of the collapsed vertex along the quadric's valley so that the volume stays constant.

    The volume below a ring of faces (p, a, b) is the sum of p (a x b) / 6, linear in p: p must lie in a plane
    (Lindstrom and Turk 1998). Where that plane is undetermined, or further away than the edge is long, the place
    stays unchanged.
    """
    u, v = vertices[start[c]], vertices[start[next_corner(c)]]
    gx, gy, gz, target = 0.0, 0.0, 0.0, 0.0
    for side in range(2):
        for n in range(ring_size if side == 0 else end_ring_size):
            corner = ring[n] if side == 0 else end_ring[n]
            shared = corner // 3 == c // 3 or corner // 3 == twin[c] // 3
            if shared and side == 1:
                continue
            o, a, b = (
                vertices[start[corner]],
                vertices[start[next_corner(corner)]],
                vertices[start[previous_corner(corner)]],
            )
            ax, ay, az = a[0] - u[0], a[1] - u[1], a[2] - u[2]
            bx, by, bz = b[0] - u[0], b[1] - u[1], b[2] - u[2]
            nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
            target += (o[0] - u[0]) * nx + (o[1] - u[1]) * ny + (o[2] - u[2]) * nz
            if not shared:
                gx, gy, gz = gx + nx, gy + ny, gz + nz
    off = target - (gx * (place[0] - u[0]) + gy * (place[1] - u[1]) + gz * (place[2] - u[2]))
    move_into_plane(s, gx, gy, gz, off, squared_length(u, v), place)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _propose_faces(c, vertices, start, twin, ring, ring_size, end_ring, end_ring_size, place, moved, chosen):
    """Write the faces that a collapse would leave to `moved`; return their number, -1 if one turns or is a sliver."""
    worst, sx, sy, sz = 1.0, 0.0, 0.0, 0.0
    for side in range(2):
        for n in range(ring_size if side == 0 else end_ring_size):
            corner = ring[n] if side == 0 else end_ring[n]
            a, b = vertices[start[next_corner(corner)]], vertices[start[previous_corner(corner)]]
            nx, ny, nz, shape = normal_and_shape(vertices[start[corner]], a, b)
            sx, sy, sz, worst = sx + nx, sy + ny, sz + nz, min(worst, shape)
    changed = 0
    for side in range(2):
        for n in range(ring_size if side == 0 else end_ring_size):
            corner = ring[n] if side == 0 else end_ring[n]
            if corner // 3 == c // 3 or corner // 3 == twin[c] // 3:
                continue
            a, b = vertices[start[next_corner(corner)]], vertices[start[previous_corner(corner)]]
            ox, oy, oz, shape = normal_and_shape(vertices[start[corner]], a, b)
            nx, ny, nz, new_shape = normal_and_shape(place, a, b)
            if new_shape < min(SLENDER, worst):
                return -1
            if shape < THIN:
                ox, oy, oz = sx, sy, sz
            same = nx * ox + ny * oy + nz * oz
            squares = (nx * nx + ny * ny + nz * nz) * (ox * ox + oy * oy + oz * oz)
            if not same > 0 or same * same < TURNED**2 * squares:
                return -1
            copy_row(moved[changed, 0], place)
            copy_row(moved[changed, 1], a)
            copy_row(moved[changed, 2], b)
            chosen[changed] = corner // 3
            changed += 1
    return changed


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _are_aligned(moved, changed, s):
    """Return True if `changed` faces (N, 3, 3) and the planes of a quadric all face nearly the same way."""
    mx, my, mz = 0.0, 0.0, 0.0
    for m in range(changed):
        nx, ny, nz, _ = normal_and_shape(moved[m, 0], moved[m, 1], moved[m, 2])
        mx, my, mz = mx + nx, my + ny, mz + nz
    length = math.sqrt(mx * mx + my * my + mz * mz)
    if length == 0:
        return False
    mx, my, mz = mx / length, my / length, mz / length
    along = s[0] * mx * mx + s[3] * my * my + s[5] * mz * mz + 2 * (s[1] * mx * my + s[2] * mx * mz + s[4] * my * mz)
    if along < ALIGNED_PLANES * s[10]:
        return False
    for m in range(changed):
        nx, ny, nz, _ = normal_and_shape(moved[m, 0], moved[m, 1], moved[m, 2])
        same = nx * mx + ny * my + nz * mz
        if not same > 0 or same * same < ALIGNED_FACES * (nx * nx + ny * ny + nz * nz):
            return False
    return True


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _find_shortest_edge(v, vertices, start, fixed, swept, ring, ring_size, sweep):
    """Return the corner whose edge leads from a vertex to its nearest free neighbour; -1 if there is none."""
    best, nearest = math.inf, NO_CORNER
    for n in range(ring_size):
        w = start[next_corner(ring[n])]
        if fixed[w] or swept[w] == sweep:
            continue
        squared = squared_length(vertices[v], vertices[w])
        if squared < best:
            best, nearest = squared, ring[n]
    return nearest


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _sweep_once(mesh, fixed, quadric, bound, into, swept, marked, space, sweep, step):
    """Collapse the shortest edge of vertex after vertex, nowhere twice; return the vertices gone, and the last step."""
    vertices, start, twin, leaving, name = mesh
    s, place, ring, end_ring, moved, chosen = space
    removed = 0
    for u in range(len(vertices)):
        if into[u] != u or fixed[u] or swept[u] == sweep:
            continue
        ring_size = corners_of(u, twin, leaving, ring)
        if ring_size < 0 or ring_size > MOST_AROUND:
            continue
        c = _find_shortest_edge(u, vertices, start, fixed, swept, ring, ring_size, sweep)
        if c == NO_CORNER:
            continue
        v = np.int64(start[next_corner(c)])
        if best_place(vertices[u], vertices[v], quadric[u], quadric[v], s, place) > bound * s[10]:
            continue
        end_ring_size = corners_of(v, twin, leaving, end_ring)
        if end_ring_size < 0 or not 3 <= ring_size + end_ring_size - 4 <= MOST_AROUND:
            continue
        step += 1
        if not can_collapse(c, start, twin, leaving, name, ring, ring_size, end_ring, end_ring_size, marked, step):
            continue
        _keep_volume(c, vertices, start, twin, ring, ring_size, end_ring, end_ring_size, s, place)
        sizes = ring_size, end_ring, end_ring_size
        if _propose_faces(c, vertices, start, twin, ring, *sizes, place, moved, chosen) == NO_CORNER:
            continue
        collapse_edge(c, start, twin, leaving, end_ring, end_ring_size)
        copy_row(quadric[u], s)
        copy_row(vertices[u], place)
        into[v] = u
        removed += 1
        swept[u] = sweep
        for n in range(corners_of(u, twin, leaving, ring)):
            swept[start[next_corner(ring[n])]] = sweep
    return removed, step


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _work_space():
    """Make the arrays for one collapse: a quadric, a place, the corners at both ends, and faces with their numbers."""
    return (
        np.empty(11),
        np.empty(3),
        np.empty(MAX_CORNERS, dtype=np.int32),
        np.empty(MAX_CORNERS, dtype=np.int32),
        np.empty((2 * MAX_CORNERS, 3, 3)),
        np.empty(2 * MAX_CORNERS + 2, dtype=np.int32),
    )


@njit(nogil=True, cache=True, error_model="numpy")
def sweep_short_edges(vertices, start, twin, leaving, name, fixed, quadric, bound, into):
    """Collapse the shortest edge of vertex after vertex, nowhere twice in a sweep; return the number of vertices gone.

    Takes a third of the time of `collapse` for each edge, as no order is kept: for the many triangles of flat places.
    Arguments as for `collapse`, with a bound that all these edges are well within.
    """
    mesh = vertices, start, twin, leaving, name
    swept = np.full(len(vertices), NO_CORNER, dtype=np.int32)
    marked = np.full(name.max() + 1, NO_CORNER, dtype=np.int32)
    space = _work_space()
    step, total = np.int64(0), 0
    for sweep in range(MOST_SWEEPS):
        removed, step = _sweep_once(mesh, fixed, quadric, bound, into, swept, marked, space, sweep, step)
        total += removed
        if removed < LEAST_SWEPT * (len(vertices) - (total - removed)):
            break
    return total


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _collapse_in_order(
    mesh,
    fixed,
    quadric,
    held,
    was,
    squared_tolerance,
    bound,
    sizes,
    queue,
    ends,
    marked,
    failed,
    changed_in,
    space,
    into,
):
    """Collapse edges, cheapest first, as `collapse` does, with all arrays at hand; return the number of faces left."""
    vertices, start, twin, leaving, name = mesh
    points, corner, first_point, next_point = held
    remaining, fewest, edge, squared_spacing = sizes
    s, place, ring, end_ring, moved, chosen, goes, goes_to = space
    bounded = len(points) > 0
    for n in range(len(start)):
        if n < twin[n] and start[n] != NO_CORNER:
            _update_bucket(n, vertices, start, twin, fixed, quadric, bound, edge, queue, ends, s, place)
    before, lowest, step = remaining, 0, 0
    while remaining > fewest:
        while lowest < BUCKETS and ends[lowest, 0] == NO_CORNER:
            lowest += 1
        if lowest == BUCKETS:
            if before - remaining < RETRY_SHARE * remaining:
                break
            before = remaining
            for n in range(len(start)):
                if start[n] != NO_CORNER and n < twin[n]:
                    bucket = _update_bucket(
                        n, vertices, start, twin, fixed, quadric, bound, edge, queue, ends, s, place
                    )
                    lowest = min(lowest, bucket)
            continue
        c = np.int64(ends[lowest, 0])  # of the type of a count: what it calls is compiled once
        _dequeue(c, queue, ends)
        step += 1
        u, v, d = np.int64(start[c]), np.int64(start[next_corner(c)]), twin[c]
        if failed[c] > max(changed_in[u], changed_in[v]):  # all that its collapse depends on is as it was
            continue
        failed[c] = step
        ring_size, end_ring_size = corners_of(u, twin, leaving, ring), corners_of(v, twin, leaving, end_ring)
        if ring_size < 0 or end_ring_size < 0 or not 3 <= ring_size + end_ring_size - 4 <= MAX_CORNERS:
            continue
        if not can_collapse(c, start, twin, leaving, name, ring, ring_size, end_ring, end_ring_size, marked, step):
            continue
        best_place(vertices[u], vertices[v], quadric[u], quadric[v], s, place)
        changed, taken, aligned = NO_CORNER, 0, False
        for attempt in range(3 if bounded else 1):  # where the best place is too far, one of the ends may be near
            if aligned:  # but hardly where all are aligned: there, five of a thousand tries on a ball ended so
                break
            if attempt > 0:
                copy_row(place, vertices[u] if attempt == 1 else vertices[v])
            _keep_volume(c, vertices, start, twin, ring, ring_size, end_ring, end_ring_size, s, place)
            changed = _propose_faces(
                c, vertices, start, twin, ring, ring_size, end_ring, end_ring_size, place, moved, chosen
            )
            if changed == NO_CORNER or not bounded:
                continue
            aligned = _are_aligned(moved, changed, s)
            chosen[changed], chosen[changed + 1] = c // 3, d // 3
            taken = reassign_points(
                first_point, next_point, points, squared_tolerance, moved, chosen, changed, goes, goes_to
            )
            if taken > 0:
                limit = math.inf if aligned else squared_spacing
                if are_edges_near(place, moved, changed, limit, points, squared_tolerance, goes, taken, corner, was):
                    break
            changed = NO_CORNER
        if changed == NO_CORNER:
            continue
        if bounded:
            for n in range(changed):
                first_point[chosen[n]] = NO_CORNER
            for n in range(taken):
                p, f = goes[n], goes_to[n]
                next_point[p], first_point[f] = first_point[f], p
        for n in range(ring_size):
            _dequeue(np.int64(min(ring[n], twin[ring[n]])), queue, ends)
        for n in range(end_ring_size):
            _dequeue(np.int64(min(end_ring[n], twin[end_ring[n]])), queue, ends)
        collapse_edge(c, start, twin, leaving, end_ring, end_ring_size)
        copy_row(quadric[u], s)
        copy_row(vertices[u], place)
        into[v] = u
        remaining -= 2
        changed_in[u] = step
        for n in range(corners_of(u, twin, leaving, ring)):
            changed_in[start[next_corner(ring[n])]] = step
            e = np.int64(ring[n])
            bucket = _update_bucket(e, vertices, start, twin, fixed, quadric, bound, edge, queue, ends, s, place)
            lowest = min(lowest, bucket)
    return remaining


@njit(nogil=True, cache=True, error_model="numpy")
def collapse(
    vertices, start, twin, leaving, name, fixed, quadric, points, corner, squared_tolerance, bound, fewest, into
):
    """Collapse edges, cheapest first, while the mesh stays closed and near; return the number of faces that remain.

    Parameters
    ----------
    vertices : (V, 3) float64
        Changed in place.
    start, twin : (3 F,) int32
        Changed in place: all corners of a removed face become -1, and those of faces that are gone before are.
    leaving : (V,) int32
        One corner of each vertex.
    name : (V,) int32
        Vertices with the same name lie at one place: see `infill.kernels.corners.split_fans`.
    fixed : (V,) bool
        Vertices that stay, with their edges.
    quadric : (V, 11) float64
        See `infill.kernels.quadrics`; summed up in place.
    points : (P, 3) float64
        Of the original mesh, its vertices first, then points along edges; empty if the mesh need not stay near.
    corner : (P,) int32
        The corner of each vertex, and the edge on which each of the others lies.
    squared_tolerance : float
        The square of the largest distance of the mesh from these points, and from the surface around them.
    bound : float
        Largest mean squared distance of a collapse from the planes it replaces; may be infinite.
    fewest : int
        Faces at which to stop.
    into : (V,) int32
        Set for each removed vertex to the one that it was collapsed into, which may be removed too.
    """
    faces, bounded = len(start) // 3, len(points) > 0
    first_point, next_point = np.full(faces, NO_CORNER, dtype=np.int32), np.empty(len(points), dtype=np.int32)
    for p in range(len(points)):
        f = corner[p] // 3
        next_point[p], first_point[f] = first_point[f], p
    original_corners, was_twin, was_leaving = np.empty((0, 3)), twin, leaving
    if bounded:
        original_corners, was_twin, was_leaving = np.empty((len(start), 3)), twin.copy(), leaving.copy()
        for c in range(len(start)):
            copy_row(original_corners[c], vertices[start[c]])
    edge, remaining = 0.0, 0
    for c in range(len(start)):
        if start[c] != NO_CORNER:
            edge += squared_length(vertices[start[c]], vertices[start[next_corner(c)]])
            remaining += 1
    edge, remaining = edge / max(1, remaining), remaining // 3
    squared_spacing = min(SAMPLE_SPACING * edge, WIDE * squared_tolerance)
    queue, ends = np.full((len(start), 3), NO_CORNER, dtype=np.int32), np.full((BUCKETS, 2), NO_CORNER, dtype=np.int32)
    marked = np.full(name.max() + 1, NO_CORNER, dtype=np.int32)
    failed, changed_in = np.full(len(start), NO_CORNER, dtype=np.int32), np.zeros(len(vertices), dtype=np.int32)
    space = *_work_space(), np.empty(MAX_HELD_POINTS, dtype=np.int32), np.empty(MAX_HELD_POINTS, dtype=np.int32)
    mesh = vertices, start, twin, leaving, name
    held = points, corner, first_point, next_point
    was = original_corners, was_twin, was_leaving
    sizes = remaining, fewest, edge, squared_spacing
    return _collapse_in_order(
        mesh,
        fixed,
        quadric,
        held,
        was,
        squared_tolerance,
        bound,
        sizes,
        queue,
        ends,
        marked,
        failed,
        changed_in,
        space,
        into,
    )
