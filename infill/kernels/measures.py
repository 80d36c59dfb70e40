"""What a surface of many triangles is asked for again and again, compiled: see `infill.meshes.measuring`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

BLOCK = 4096  # faces whose volumes and areas make one sum, so that sums do not depend on the number of threads
AHEAD, BACK = 1, 2  # which faces along an edge were seen: one from its lower vertex, one from its higher vertex


@njit(nogil=True, cache=True)
def begin_edges(faces, first):
    """Set where the edges of each vertex begin that lead to higher ones, if each has two faces: (V + 1,), zeros so far.

    Return whether they may: no face has a vertex twice, and no vertex an odd number of sides.
    """
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        if a == b or b == c or c == a:
            return False
        first[min(a, b) + 1] += 1
        first[min(b, c) + 1] += 1
        first[min(c, a) + 1] += 1
    count = 0
    for v in range(1, len(first)):
        if first[v] % 2:
            return False
        count += first[v] // 2
        first[v] = count
    return True


@njit(nogil=True, cache=True)
def match_sides(faces, first, higher, thread, threads):
    """Return whether the edges of a share of the vertices have one face that runs along them each way.

    Parameters
    ----------
    faces : (F, 3) int
    first : (V + 1,) int
        See `begin_edges`.
    higher : (E,) int
        Room for their other vertices, times four, and which of their faces were seen: -1 so far.
    """
    size = (len(first) - 1 + threads - 1) // threads
    low, high = thread * size, min(len(first) - 1, (thread + 1) * size)
    for f in range(len(faces)):
        for k in range(3):
            start, end = faces[f, k], faces[f, (k + 1) % 3]
            a, b, way = min(start, end), max(start, end), AHEAD + (start > end)
            if a < low or a >= high:
                continue
            at, last = first[a], first[a + 1]
            while at < last and higher[at] >= 0 and higher[at] >> 2 != b:
                at += 1
            if at == last:
                return False
            if higher[at] < 0:
                higher[at] = b << 2 | way
            elif higher[at] & way:
                return False
            else:
                higher[at] |= way
    for a in range(low, high):
        for at in range(first[a], first[a + 1]):
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
def within_heights(vertices, faces, low, high, found):
    """Set which faces (F,) have the middle of their lowest and their highest place between two heights."""
    for f in range(len(faces)):
        a, b, c = vertices[faces[f, 0], 2], vertices[faces[f, 1], 2], vertices[faces[f, 2], 2]
        middle = (min(a, b, c) + max(a, b, c)) / 2
        found[f] = low <= middle < high
