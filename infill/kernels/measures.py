"""What a surface of many triangles is asked for again and again, compiled: see `infill.surfaces.measuring`."""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit

BLOCK = 4096  # faces whose volumes and areas make one sum, so that sums do not depend on the number of threads
AHEAD, BACK = 1, 2  # which faces along an edge were seen: one from its lower vertex, one from its higher vertex


@njit(nogil=True, cache=True)
def count_sides(faces, counts):
    """Count the sides of faces by their lower vertex; return whether all have two different ones."""
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        if a == b or b == c or c == a:
            return False
        counts[min(a, b)] += 1
        counts[min(b, c)] += 1
        counts[min(c, a)] += 1
    return True


@njit(nogil=True, cache=True)
def match_sides(faces, first, higher, seen, used, thread, threads):
    """Return whether the edges of a share of the vertices have one face that runs along them each way.

    Parameters
    ----------
    faces : (F, 3) int
    first : (V + 1,) int64
        Where the edges of each vertex begin that lead to higher ones, if each has two faces.
    higher : (E,) int32
        Room for their other vertices.
    seen : (E,) int8
        Room for which of their faces were seen: zeros.
    used : (V,) int32
        Room for how many edges of each vertex were found: zeros.
    """
    size = (len(used) + threads - 1) // threads
    low, high = thread * size, min(len(used), (thread + 1) * size)
    for f in range(len(faces)):
        for k in range(3):
            a, b = faces[f, k], faces[f, (k + 1) % 3]
            way = AHEAD
            if a > b:
                a, b, way = b, a, BACK
            if a < low or a >= high:
                continue
            begin, at = first[a], first[a]
            end = begin + used[a]
            while at < end and higher[at] != b:
                at += 1
            if at == end:
                if end == first[a + 1]:
                    return False
                higher[at] = b
                used[a] += 1
            if seen[at] & way:
                return False
            seen[at] |= way
    for a in range(low, high):
        for at in range(first[a], first[a + 1]):
            if seen[at] != AHEAD | BACK:
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
