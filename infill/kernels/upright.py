"""Crossings of triangles with upright lines through the nodes of a square lattice, line by line and from below.

`count_crossings` counts the crossings of each line, and `list_crossings` then lists them.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit


@njit(from_python=False, nogil=True, cache=True)
def _node_range(nodes, face, axis, node_count):
    """Return the first and last node of a lattice between the corners of a triangle, along an axis."""
    a, b, c = nodes[face[0], axis], nodes[face[1], axis], nodes[face[2], axis]
    return max(math.ceil(min(a, b, c)), 0), min(math.floor(max(a, b, c)), node_count - 1)


@njit(from_python=False, nogil=True, cache=True)
def _side_areas(nodes, face, i, j):
    """Return twice the signed areas of the triangles between a node and the three sides, and their sum."""
    ax, ay = nodes[face[0], 0] - i, nodes[face[0], 1] - j
    bx, by = nodes[face[1], 0] - i, nodes[face[1], 1] - j
    cx, cy = nodes[face[2], 0] - i, nodes[face[2], 1] - j
    area_a, second, third = bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx
    return area_a, second, third, area_a + second + third


@njit(from_python=False, nogil=True, cache=True)
def _is_inside(area_a, area_b, area_c, area):
    """Return True if a node lies within a triangle with an area, or on its rim."""
    if area > 0:
        return area_a >= 0 and area_b >= 0 and area_c >= 0
    return area < 0 and area_a <= 0 and area_b <= 0 and area_c <= 0


@njit(nogil=True, cache=True)
def count_crossings(nodes, faces, nx, ny, counts):
    """Count the crossings of each line.

    Parameters
    ----------
    nodes : (V, 2) float64
        x and y of the vertices in steps of the lattice, from its first node.
    faces : (F, 3) int
    nx, ny : int
        Nodes of the lattice.
    counts : (nx * ny,) int64
        The counts are added to it.
    """
    for face in faces:
        low_i, high_i = _node_range(nodes, face, 0, nx)
        if low_i > high_i:
            continue
        low_j, high_j = _node_range(nodes, face, 1, ny)
        for i in range(low_i, high_i + 1):
            for j in range(low_j, high_j + 1):
                area_a, area_b, area_c, area = _side_areas(nodes, face, i, j)
                if _is_inside(area_a, area_b, area_c, area):
                    counts[i * ny + j] += 1


@njit(nogil=True, cache=True)
def list_crossings(nodes, heights, faces, nx, ny, ends, height, rising, owner):
    """List the crossings of each line by rising height, at one height by face; raise `ends` from begins to ends.

    Parameters
    ----------
    nodes, faces, nx, ny
        As for `count_crossings`.
    heights : (V,) float64, mm
    ends : (nx * ny,) int64
        Begin of the list of each line; raised to its end.
    height : (N,) float64, mm
        Of each crossing.
    rising : (N,) int64
        1 where a line upwards enters the solid, -1 where it leaves it.
    owner : (N,) int64
        The face that is crossed.
    """
    for number in range(len(faces)):
        face = faces[number]
        low_i, high_i = _node_range(nodes, face, 0, nx)
        if low_i > high_i:
            continue
        low_j, high_j = _node_range(nodes, face, 1, ny)
        a, b, c = heights[face[0]], heights[face[1]], heights[face[2]]
        for i in range(low_i, high_i + 1):
            for j in range(low_j, high_j + 1):
                area_a, area_b, area_c, area = _side_areas(nodes, face, i, j)
                if not _is_inside(area_a, area_b, area_c, area):
                    continue
                line = i * ny + j
                place = ends[line]
                height[place] = (area_a * a + area_b * b + area_c * c) / area
                rising[place] = 1 if area < 0 else -1
                owner[place] = number
                ends[line] = place + 1
    begin = 0
    for line in range(nx * ny):
        for place in range(begin + 1, ends[line]):
            level, way, face_there = height[place], rising[place], owner[place]
            back = place
            while back > begin and height[back - 1] > level:
                height[back], rising[back], owner[back] = height[back - 1], rising[back - 1], owner[back - 1]
                back -= 1
            height[back], rising[back], owner[back] = level, way, face_there
        begin = ends[line]
