"""Sums over the triangles of a surface that are needed often, compiled: see `infill.meshes.measuring`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

BLOCK = 4096  # faces whose volumes and areas make one sum, so that sums do not depend on the number of threads
AHEAD, BACK = 1, 2  # faces seen along an edge: one from its lower vertex, one from its higher vertex


@njit(nogil=True, cache=True)
def find_edge_starts(faces, edge_start):
    """Write where the edges of each vertex to higher ones begin, (V + 1,) of zeros; return False if that cannot be.

    It cannot if not all edges have two faces, as where a face has a vertex twice, or a vertex an odd number of sides to
    higher ones. True does not prove that they have: see `match_sides`.
    """
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        if a == b or b == c or c == a:
            return False
        edge_start[min(a, b) + 1] += 1
        edge_start[min(b, c) + 1] += 1
        edge_start[min(c, a) + 1] += 1
    count = 0
    for v in range(1, len(edge_start)):
        if edge_start[v] % 2:
            return False
        count += edge_start[v] // 2
        edge_start[v] = count
    return True


@njit(nogil=True, cache=True)
def match_sides(faces, edge_start, higher, thread, threads):
    """Return True if the edges of a share of the vertices have one face in each direction.

    Parameters
    ----------
    faces : (F, 3) int
    edge_start : (V + 1,) int
        See `find_edge_starts`.
    higher : (E,) int
        Work space for their other vertices, times four, and the faces seen: initially -1.
    """
    size = (len(edge_start) - 1 + threads - 1) // threads
    low, high = thread * size, min(len(edge_start) - 1, (thread + 1) * size)
    for f in range(len(faces)):
        for k in range(3):
            start, end = faces[f, k], faces[f, (k + 1) % 3]
            a, b, way = min(start, end), max(start, end), AHEAD + (start > end)
            if a < low or a >= high:
                continue
            at, stop = edge_start[a], edge_start[a + 1]
            while at < stop and higher[at] >= 0 and higher[at] >> 2 != b:
                at += 1
            if at == stop:
                return False
            if higher[at] < 0:
                higher[at] = b << 2 | way
            elif higher[at] & way:
                return False
            else:
                higher[at] |= way
    for a in range(low, high):
        for at in range(edge_start[a], edge_start[a + 1]):
            if higher[at] & 3 != AHEAD | BACK:
                return False
    return True


@njit(nogil=True, cache=True)
def sum_up(vertices, faces, middle, sums, thread, threads):
    """Set six times the volume, from the middle, and twice the area of every block of faces, (n, 2)."""
    for block in range(thread, len(sums), threads):
        volume = area = 0.0
        for f in range(block * BLOCK, min(len(faces), (block + 1) * BLOCK)):
            i, j, k = faces[f]
            ax, ay, az = vertices[i, 0] - middle[0], vertices[i, 1] - middle[1], vertices[i, 2] - middle[2]
            bx, by, bz = (
                vertices[j, 0] - vertices[i, 0],
                vertices[j, 1] - vertices[i, 1],
                vertices[j, 2] - vertices[i, 2],
            )
            cx, cy, cz = (
                vertices[k, 0] - vertices[i, 0],
                vertices[k, 1] - vertices[i, 1],
                vertices[k, 2] - vertices[i, 2],
            )
            nx, ny, nz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
            volume += ax * nx + ay * ny + az * nz
            area += np.sqrt(nx * nx + ny * ny + nz * nz)
        sums[block, 0] = volume
        sums[block, 1] = area


@njit(nogil=True, cache=True)
def sum_shells(vertices, faces, names, middle, sums):
    """Add six times the volume between each face and the middle to the sum of its shell, (n,)."""
    for f in range(len(faces)):
        i, j, k = faces[f]
        ax, ay, az = vertices[i, 0] - middle[0], vertices[i, 1] - middle[1], vertices[i, 2] - middle[2]
        bx, by, bz = vertices[j, 0] - middle[0], vertices[j, 1] - middle[1], vertices[j, 2] - middle[2]
        cx, cy, cz = vertices[k, 0] - middle[0], vertices[k, 1] - middle[1], vertices[k, 2] - middle[2]
        sums[names[i]] += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)


@njit(nogil=True, cache=True)
def sum_flows(vertices, faces, names, sums):
    """Add the flow of (x, 0, 0) through each face to the sum of its shell, (n,): the volume, where lids lie level."""
    for f in range(len(faces)):
        i, j, k = faces[f]
        by, bz = vertices[j, 1] - vertices[i, 1], vertices[j, 2] - vertices[i, 2]
        cy, cz = vertices[k, 1] - vertices[i, 1], vertices[k, 2] - vertices[i, 2]
        sums[names[i]] += (vertices[i, 0] + vertices[j, 0] + vertices[k, 0]) * (by * cz - bz * cy) / 6


@njit(nogil=True, cache=True)
def mark_within_heights(vertices, faces, low, high, is_within):
    """Mark the faces (F,) whose mean of lowest and highest place lies between two heights."""
    for f in range(len(faces)):
        a, b, c = vertices[faces[f, 0], 2], vertices[faces[f, 1], 2], vertices[faces[f, 2], 2]
        middle = (min(a, b, c) + max(a, b, c)) / 2
        is_within[f] = low <= middle < high


@njit(nogil=True, cache=True)
def measure_areas(vertices, faces, areas):
    """Set the area of each face (F, 3)."""
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ux, uy, uz = vertices[b, 0] - vertices[a, 0], vertices[b, 1] - vertices[a, 1], vertices[b, 2] - vertices[a, 2]
        vx, vy, vz = vertices[c, 0] - vertices[a, 0], vertices[c, 1] - vertices[a, 1], vertices[c, 2] - vertices[a, 2]
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        areas[f] = np.sqrt(nx * nx + ny * ny + nz * nz) / 2


@njit(nogil=True, cache=True)
def spread_points(vertices, faces, areas, step, shares, points, face):
    """Spread points evenly over the area of a surface.

    Parameters
    ----------
    vertices, faces : (V, 3) float64, (F, 3) int
    areas : (F,) float64
    step : float
        Area that each point stands for.
    shares : (2,) float64
        The place of a point in its face moves on by these shares of two sides from point to point.
    points, face : (N, 3) float64, (N,) int64
        The results.
    """
    at, upto = 0, areas[0] if len(areas) else 0.0
    for n in range(len(points)):
        aim = (n + 0.5) * step
        while upto < aim and at < len(areas) - 1:
            at += 1
            upto += areas[at]
        u, v = n * shares[0] % 1, n * shares[1] % 1
        if u + v > 1:
            u, v = 1 - u, 1 - v
        i, j, k = faces[at, 0], faces[at, 1], faces[at, 2]
        for axis in range(3):
            start = vertices[i, axis]
            points[n, axis] = start + u * (vertices[j, axis] - start) + v * (vertices[k, axis] - start)
        face[n] = at


@njit(nogil=True, cache=True)
def find_first_corners(faces, corner):
    """Set the first corner at each vertex, numbered 3 f + k, in (V,) of -1; return the number of vertices with one."""
    count = 0
    for f in range(len(faces)):
        for k in range(3):
            if corner[faces[f, k]] < 0:
                corner[faces[f, k]] = 3 * f + k
                count += 1
    return count
