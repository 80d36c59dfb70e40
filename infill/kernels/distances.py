"""Distances of points from triangles: for all cells near some of them, and from single points to the nearest of many.

`lower_to_triangles` visits the cells around each triangle, row by row of its dilated box, and keeps the minimum.

`nearest_triangles` descends a tree of boxes, the nearer box first, and skips boxes further away than the nearest
triangle so far. `least_distance` asks the same tree for the least distance of all points together.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

import numpy as np

from infill.kernels.compiling import njit

STACK_SIZE = 64  # size of the stack of boxes in a tree
THICK = 16  # layers of cells along x that one thread fills at a time
FLAT_TOLERANCE = 1e-12  # of a squared length: shorter edges are points, and lower triangles are lines


@njit(nogil=True, cache=True, error_model="numpy")
def lower_to_triangles(corners, reach, squared, thread, threads):
    """Lower the squared distance of each cell within `reach` of a triangle to that of the nearest triangle.

    Parameters
    ----------
    corners : (F, 3, 3) float64
        Triangles in cells: the centre of cell (0, 0, 0) is the origin.
    reach : float
        Cells further away than this stay unchanged.
    squared : (nx, ny, nz) float32
    thread, threads : int
        This call fills every `threads`-th slab of layers.
    """
    nx, ny, nz = squared.shape
    normal, edges, scale, upright = np.empty(3), np.empty((3, 3)), np.empty(3), np.empty((3, 3))
    for slab in range(thread, (nx + THICK - 1) // THICK, threads):
        begin, end = slab * THICK, min(nx, (slab + 1) * THICK)
        for face in range(len(corners)):
            a, b, c = corners[face, 0], corners[face, 1], corners[face, 2]
            low_x = min(a[0], b[0], c[0]) - reach
            high_x = max(a[0], b[0], c[0]) + reach
            if high_x < begin or low_x > end - 1:
                continue
            low_y = min(a[1], b[1], c[1]) - reach
            high_y = max(a[1], b[1], c[1]) + reach
            low_z = min(a[2], b[2], c[2]) - reach
            high_z = max(a[2], b[2], c[2]) + reach
            ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
            vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
            normal[0], normal[1], normal[2] = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            area = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
            flat = area <= FLAT_TOLERANCE * max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz)
            if not flat:
                normal /= area
            for side in range(3):
                p, q = (a, b) if side == 0 else ((b, c) if side == 1 else (c, a))
                for axis in range(3):
                    edges[side, axis] = q[axis] - p[axis]
                ex, ey, ez = edges[side]
                length = ex * ex + ey * ey + ez * ez
                scale[side] = 1 / length if length > 0 else 0.0
                upright[side, 0] = normal[1] * ez - normal[2] * ey
                upright[side, 1] = normal[2] * ex - normal[0] * ez
                upright[side, 2] = normal[0] * ey - normal[1] * ex
            offset = normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2]
            for x in range(max(begin, math.ceil(low_x)), min(end, math.floor(high_x) + 1)):
                first_y, last_y = _y_range(a, b, c, x - reach, x + reach)
                for y in range(
                    max(0, math.ceil(max(low_y, first_y - reach))), min(ny, math.floor(min(high_y, last_y + reach)) + 1)
                ):
                    bottom, top = low_z, high_z
                    if not flat and abs(normal[2]) > 1e-3:
                        middle = (offset - normal[0] * x - normal[1] * y) / normal[2]
                        room = reach / abs(normal[2])
                        bottom, top = max(bottom, middle - room), min(top, middle + room)
                    begin_z, end_z = max(0, math.ceil(bottom)), min(nz, math.floor(top) + 1)
                    if begin_z < end_z:
                        _lower_row(x, y, begin_z, end_z, a, edges, scale, upright, normal, flat, squared)


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _lower_row(x, y, begin, end, a, edges, scale, upright, normal, flat, squared):
    """Lower the squared distances of a range of cells in a row to that of a triangle, without a branch.

    The distance is that of the plane, where the point lies on the inner side of all three edges, else of the nearest
    edge. All is linear in z except where a foot is clamped to the ends of its edge.

    Parameters
    ----------
    x, y, begin, end : int
        Cells (x, y, begin) to (x, y, end - 1).
    a : (3,) float64
        The first corner.
    edges : (3, 3) float64
        From each corner to the next.
    scale : (3,) float64
        One over the square of their lengths, 0 for an edge without length.
    upright : (3, 3) float64
        Normals of the planes through the edges, upright on the triangle, inwards.
    normal : (3,) float64
        Of length 1.
    flat : bool
        True if the triangle is a line or a point.
    """
    e0x, e0y, e0z = edges[0, 0], edges[0, 1], edges[0, 2]
    e1x, e1y, e1z = edges[1, 0], edges[1, 1], edges[1, 2]
    e2x, e2y, e2z = edges[2, 0], edges[2, 1], edges[2, 2]
    s0, s1, s2 = scale[0], scale[1], scale[2]
    px, py = x - a[0], y - a[1]
    qx, qy = px - e0x, py - e0y  # from the second corner, and below from the third
    rx, ry = qx - e1x, qy - e1y
    along0, along1, along2 = px * e0x + py * e0y, qx * e1x + qy * e1y, rx * e2x + ry * e2y
    in0 = px * upright[0, 0] + py * upright[0, 1]
    in1 = qx * upright[1, 0] + qy * upright[1, 1]
    in2 = rx * upright[2, 0] + ry * upright[2, 1]
    u0, u1, u2 = upright[0, 2], upright[1, 2], upright[2, 2]
    level, rise = px * normal[0] + py * normal[1], normal[2]
    inner_limit = math.inf if flat else 0.0
    row, base = squared[x, y, begin:end], begin - a[2]
    for n in range(len(row)):
        pz = base + n
        qz = pz - e0z
        rz = qz - e1z
        t = (along0 + pz * e0z) * s0
        t = 0.0 if t < 0.0 else (1.0 if t > 1.0 else t)
        dx, dy, dz = px - t * e0x, py - t * e0y, pz - t * e0z
        nearest = dx * dx + dy * dy + dz * dz
        t = (along1 + qz * e1z) * s1
        t = 0.0 if t < 0.0 else (1.0 if t > 1.0 else t)
        dx, dy, dz = qx - t * e1x, qy - t * e1y, qz - t * e1z
        edge_distance = dx * dx + dy * dy + dz * dz
        nearest = edge_distance if edge_distance < nearest else nearest
        t = (along2 + rz * e2z) * s2
        t = 0.0 if t < 0.0 else (1.0 if t > 1.0 else t)
        dx, dy, dz = rx - t * e2x, ry - t * e2y, rz - t * e2z
        edge_distance = dx * dx + dy * dy + dz * dz
        nearest = edge_distance if edge_distance < nearest else nearest
        height = level + pz * rise
        inner = (in0 + pz * u0 >= inner_limit) & (in1 + qz * u1 >= inner_limit) & (in2 + rz * u2 >= inner_limit)
        nearest = np.float32(height * height if inner else nearest)
        row[n] = nearest if nearest < row[n] else row[n]


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _y_range(a, b, c, low, high):
    """Return the lowest and the highest y of the part of a triangle between two values of x."""
    lowest, highest = math.inf, -math.inf
    for edge in range(3):
        p, q = (a, b) if edge == 0 else ((b, c) if edge == 1 else (c, a))
        if p[0] > q[0]:
            p, q = q, p
        if q[0] < low or p[0] > high:
            continue
        along = q[0] - p[0]
        for end in range(2):
            x = max(low, p[0]) if end == 0 else min(high, q[0])
            y = p[1] + (q[1] - p[1]) * ((x - p[0]) / along) if along > 0 else (p[1] if end == 0 else q[1])
            lowest, highest = min(lowest, y), max(highest, y)
    return lowest, highest


@njit(nogil=True, cache=True, error_model="numpy")
def squared_distance(x, y, z, a, b, c):
    """Return the squared distance of a point from a triangle.

    Barycentric coordinates distinguish the regions of the plane of the triangle: see Ericson, Real-Time Collision
    Detection (2005), section 5.1.5.
    """
    abx, aby, abz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    acx, acy, acz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    apx, apy, apz = x - a[0], y - a[1], z - a[2]
    d1 = abx * apx + aby * apy + abz * apz
    d2 = acx * apx + acy * apy + acz * apz
    if d1 <= 0 and d2 <= 0:
        return apx * apx + apy * apy + apz * apz
    bpx, bpy, bpz = x - b[0], y - b[1], z - b[2]
    d3 = abx * bpx + aby * bpy + abz * bpz
    d4 = acx * bpx + acy * bpy + acz * bpz
    if d3 >= 0 and d4 <= d3:
        return bpx * bpx + bpy * bpy + bpz * bpz
    cpx, cpy, cpz = x - c[0], y - c[1], z - c[2]
    d5 = abx * cpx + aby * cpy + abz * cpz
    d6 = acx * cpx + acy * cpy + acz * cpz
    if d6 >= 0 and d5 <= d6:
        return cpx * cpx + cpy * cpy + cpz * cpz
    vc = d1 * d4 - d3 * d2
    if vc <= 0 and d1 >= 0 and d3 <= 0:
        v, w = (d1 / (d1 - d3) if d1 > d3 else 0.0), 0.0
    else:
        vb = d5 * d2 - d1 * d6
        if vb <= 0 and d2 >= 0 and d6 <= 0:
            v, w = 0.0, (d2 / (d2 - d6) if d2 > d6 else 0.0)
        else:
            va = d3 * d6 - d5 * d4
            if va <= 0 and d4 - d3 >= 0 and d5 - d6 >= 0:
                side = (d4 - d3) + (d5 - d6)
                w = (d4 - d3) / side if side > 0 else 0.0
                v = 1 - w
            else:
                total = va + vb + vc
                v, w = (vb / total, vc / total) if total > 0 else (0.0, 0.0)
    qx, qy, qz = apx - v * abx - w * acx, apy - v * aby - w * acy, apz - v * abz - w * acz
    return qx * qx + qy * qy + qz * qz


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _squared_distance_to_box(x, y, z, low, high):
    """Return the squared distance of a point from a box."""
    dx = max(low[0] - x, x - high[0], 0.0)
    dy = max(low[1] - y, y - high[1], 0.0)
    dz = max(low[2] - z, z - high[2], 0.0)
    return dx * dx + dy * dy + dz * dz


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _push_children(x, y, z, box, low, high, best, stack, box_distance, count):
    """Push the children of a box that are nearer than `best`, a squared distance; return the height of the stack."""
    last, next_box = 2 * box + 1, 2 * box + 2
    last_distance = _squared_distance_to_box(x, y, z, low[last], high[last])
    next_distance = _squared_distance_to_box(x, y, z, low[next_box], high[next_box])
    if last_distance < next_distance:  # the nearer one is visited first: it lies on top
        last, next_box, last_distance, next_distance = next_box, last, next_distance, last_distance
    if last_distance < best:
        stack[count], box_distance[count], count = last, last_distance, count + 1
    if next_distance < best:
        stack[count], box_distance[count], count = next_box, next_distance, count + 1
    return count


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def nearest_triangle(x, y, z, guess, corners, low, high, leaf, squared_enough, stack, box_distance):
    """Find the triangle nearest to a point; return its squared distance and its index.

    Parameters
    ----------
    guess : int
        A triangle that is probably near.
    corners, low, high, leaf, squared_enough
        See `nearest_triangles`.
    stack, box_distance : (DEEPEST,) int64, (DEEPEST,) float64
        Work space.
    """
    first_leaf = (len(low) - 1) // 2
    nearest = guess
    best = squared_distance(x, y, z, corners[nearest, 0], corners[nearest, 1], corners[nearest, 2])
    stack[0], box_distance[0], count = 0, 0.0, 1
    while count > 0 and best > squared_enough:
        count -= 1
        if box_distance[count] >= best:
            continue
        box = stack[count]
        if box >= first_leaf:
            begin = (box - first_leaf) * leaf
            for at in range(begin, min(begin + leaf, len(corners))):
                candidate = squared_distance(x, y, z, corners[at, 0], corners[at, 1], corners[at, 2])
                if candidate < best:
                    best, nearest = candidate, at
            continue
        count = _push_children(x, y, z, box, low, high, best, stack, box_distance, count)
    return best, nearest


@njit(nogil=True, cache=True, error_model="numpy")
def nearest_triangles(points, corners, low, high, leaf, squared_enough, squared, face, thread, threads):
    """Find the triangle nearest to every `threads`-th point.

    Parameters
    ----------
    points : (N, 3) float64
    corners : (F, 3, 3) float64
        In the order of the tree's leaves: see `infill.meshes.distance.TriangleTree`.
    low, high : (2 L - 1, 3) float64
        Boxes of the tree: the children of box n are 2 n + 1 and 2 n + 2, the last L are leaves.
    leaf : int
        Triangles in a leaf.
    squared_enough : float
        A squared distance: the first triangle found within it may stand for the nearest.
    squared : (N,) float64, face : (N,) int64
        The results.
    """
    stack, box_distance = np.empty(STACK_SIZE, dtype=np.int64), np.empty(STACK_SIZE)
    # The result of the previous point is a good guess: successive points are often close together.
    nearest = np.int64(0)  # no literal, for which the search would be compiled a second time
    for n in range(thread, len(points), threads):
        x, y, z = points[n]
        squared[n], nearest = nearest_triangle(
            x, y, z, nearest, corners, low, high, leaf, squared_enough, stack, box_distance
        )
        face[n] = nearest


@njit(nogil=True, cache=True, error_model="numpy")
def least_distance(points, corners, low, high, leaf, squared_limit, thread, threads):
    """Find which of every `threads`-th point is nearest to triangles; return its squared distance and its index.

    Of points at the same distance, the first counts. The index is -1 if all are farther away than the limit. Most
    points cost a few boxes, because only those nearer than the nearest point so far matter.

    Parameters
    ----------
    points, corners, low, high, leaf
        See `nearest_triangles`.
    squared_limit : float
        A squared distance.
    """
    stack, box_distance = np.empty(STACK_SIZE, dtype=np.int64), np.empty(STACK_SIZE)
    first_leaf, least, nearest = (len(low) - 1) // 2, squared_limit, -1
    for n in range(thread, len(points), threads):
        x, y, z = points[n]
        best = least
        stack[0], box_distance[0], count = 0, 0.0, 1
        while count > 0:
            count -= 1
            if box_distance[count] >= best:
                continue
            box = stack[count]
            if box >= first_leaf:
                begin = (box - first_leaf) * leaf
                for at in range(begin, min(begin + leaf, len(corners))):
                    best = min(best, squared_distance(x, y, z, corners[at, 0], corners[at, 1], corners[at, 2]))
                continue
            count = _push_children(x, y, z, box, low, high, best, stack, box_distance, count)
        if best < least and (nearest < 0 or math.sqrt(best) < math.sqrt(least)):
            least, nearest = best, n
    return least, nearest


@njit(nogil=True, cache=True, error_model="numpy")
def box_leaves(corners, leaf, low, high):
    """Set the boxes of a tree of triangles: see `infill.meshes.distance.TriangleTree`.

    Parameters
    ----------
    corners : (F, 3, 3) float64
        In the order of the leaves.
    leaf : int
        Triangles in a leaf.
    low, high : (2 L - 1, 3) float64
        Every box is overwritten; one without a triangle is from inf to -inf.
    """
    first_leaf = (len(low) - 1) // 2
    for box in range(first_leaf, len(low)):
        begin = (box - first_leaf) * leaf
        for axis in range(3):
            lowest, highest = np.inf, -np.inf
            for at in range(begin, min(begin + leaf, len(corners))):
                for corner in range(3):
                    lowest = min(lowest, corners[at, corner, axis])
                    highest = max(highest, corners[at, corner, axis])
            low[box, axis], high[box, axis] = lowest, highest
    for box in range(first_leaf - 1, -1, -1):
        for axis in range(3):
            low[box, axis] = min(low[2 * box + 1, axis], low[2 * box + 2, axis])
            high[box, axis] = max(high[2 * box + 1, axis], high[2 * box + 2, axis])


@njit(nogil=True, cache=True, error_model="numpy")
def interleave_bits(points, bits, codes):
    """Set the place of each point (N, 3) on the curve of Morton, with a number of bits for each coordinate."""
    low, side = np.full(3, np.inf), 1e-300
    for axis in range(3):
        highest = -np.inf
        for n in range(len(points)):
            low[axis], highest = min(low[axis], points[n, axis]), max(highest, points[n, axis])
        side = max(side, highest - low[axis])
    scale = ((1 << bits) - 1) / side
    for n in range(len(points)):
        code = np.uint64(0)
        for axis in range(3):
            spread = np.uint64(int((points[n, axis] - low[axis]) * scale))
            spread = (spread | spread << np.uint64(16)) & np.uint64(0x030000FF)
            spread = (spread | spread << np.uint64(8)) & np.uint64(0x0300F00F)
            spread = (spread | spread << np.uint64(4)) & np.uint64(0x030C30C3)
            spread = (spread | spread << np.uint64(2)) & np.uint64(0x09249249)
            code |= spread << np.uint64(axis)
        codes[n] = code


@njit(nogil=True, cache=True, error_model="numpy")
def count_windings(points, corners, sign, windings, thread, threads):
    """Count the windings of triangles (F, 3, 3), with their sign (F,), around every `threads`-th point.

    Triangles above a point count, those that face upwards positively: over a closed surface, the sum is its winding
    number around the point. If an edge shared by two triangles passes exactly over a point, one of them counts.
    """
    for n in range(thread, len(points), threads):
        x, y, z = points[n]
        total = 0
        for f in range(len(corners)):
            ax, bx, cx = corners[f, 0, 0] - x, corners[f, 1, 0] - x, corners[f, 2, 0] - x
            if (ax > 0 and bx > 0 and cx > 0) or (ax <= 0 and bx <= 0 and cx <= 0):
                continue
            ay, by, cy = corners[f, 0, 1] - y, corners[f, 1, 1] - y, corners[f, 2, 1] - y
            if (ay > 0 and by > 0 and cy > 0) or (ay <= 0 and by <= 0 and cy <= 0):
                continue
            around = 0
            around += _axis_crossing(ax, ay, bx, by) + _axis_crossing(bx, by, cx, cy) + _axis_crossing(cx, cy, ax, ay)
            if around == 0:
                continue
            u, v, w = bx * cy - cx * by, cx * ay - ax * cy, ax * by - bx * ay
            area = u + v + w
            if area != 0 and (u * corners[f, 0, 2] + v * corners[f, 1, 2] + w * corners[f, 2, 2]) / area > z:
                total += around * sign[f]
        windings[n] = total


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _axis_crossing(px, py, qx, qy):
    """Return +1 or -1 where an edge passes the positive x axis, upwards or downwards, else 0."""
    if (py > 0) == (qy > 0):
        return 0
    if py > qy:
        return -1 if qx * py - px * qy > 0 else 0
    return 1 if px * qy - qx * py > 0 else 0
