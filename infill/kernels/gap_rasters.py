"""Gaps between beads on a raster: regions, the largest distances in them, and the area of a hull.

`scipy.ndimage` and `scipy.spatial`, with which tests compare, take longer to load than this takes for a print.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201, ANN202
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import numpy as np

from infill.kernels.compiling import njit
from infill.kernels.disjoint_sets import join, root


@njit(nogil=True, cache=True, error_model="numpy")
def label_regions(free, region):
    """Label the regions of free pixels, which touch by their sides, from 1 on; return how many there are.

    Parameters
    ----------
    free : (X, Y) bool
    region : (X, Y) int64
        Written; 0 where a pixel is not free.
    """
    rows, columns = free.shape
    parent = np.empty(rows * columns, dtype=np.int64)
    for x in range(rows):
        for y in range(columns):
            pixel = x * columns + y
            parent[pixel] = pixel
            if free[x, y]:
                if x > 0 and free[x - 1, y]:
                    join(parent, pixel, pixel - columns)
                if y > 0 and free[x, y - 1]:
                    join(parent, pixel, pixel - 1)
    count = 0
    for x in range(rows):
        for y in range(columns):
            region[x, y] = 0
            if free[x, y]:
                pixel = x * columns + y
                root_pixel = root(parent, pixel)  # which comes before all others of its region
                if root_pixel == pixel:
                    count += 1
                    region[x, y] = count
                else:
                    region[x, y] = region[root_pixel // columns, root_pixel % columns]
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def find_largest_squares(taken, region, largest):
    """Find the largest squared distance from a pixel of each region to the nearest taken one.

    The nearest one in each column comes first; then, in each row, the lower envelope of the parabolas that rise from
    them (Meijster, Roerdink and Hesselink 2000), in whole numbers.

    Parameters
    ----------
    taken : (X, Y) bool
        At least one.
    region : (X, Y) int64
        From 0 on.
    largest : (R,) int64
        Written, pixels²; zeros on entry.
    """
    rows, columns = taken.shape
    away = rows + columns  # farther than any
    height = np.empty((rows, columns), dtype=np.int64)
    for y in range(columns):
        height[0, y] = 0 if taken[0, y] else away
    for x in range(1, rows):
        for y in range(columns):
            height[x, y] = 0 if taken[x, y] else height[x - 1, y] + 1
    for x in range(rows - 2, -1, -1):
        for y in range(columns):
            height[x, y] = min(height[x, y], height[x + 1, y] + 1)
    foot, begin = np.empty(columns, dtype=np.int64), np.empty(columns, dtype=np.int64)
    for x in range(rows):
        top = 0
        foot[0] = begin[0] = 0
        for y in range(1, columns):
            squared_height = height[x, y] * height[x, y]
            while top >= 0:
                there, at = foot[top], begin[top]
                if (at - there) ** 2 + height[x, there] ** 2 <= (at - y) ** 2 + squared_height:
                    break
                top -= 1
            if top < 0:
                top, foot[0], begin[0] = 0, y, 0
                continue
            there = foot[top]
            lower = (y * y - there * there + squared_height - height[x, there] ** 2) // (2 * (y - there)) + 1
            if lower < columns:
                top += 1
                foot[top], begin[top] = y, lower
        for y in range(columns - 1, -1, -1):
            there = foot[top]
            square = (y - there) ** 2 + height[x, there] ** 2
            if square > largest[region[x, y]]:
                largest[region[x, y]] = square
            if y == begin[top]:
                top -= 1


@njit(from_python=False, nogil=True, cache=True, error_model="numpy")
def _cross(points, a, b, c):
    """Return the cross product of AB and AC."""
    return (points[b, 0] - points[a, 0]) * (points[c, 1] - points[a, 1]) - (points[b, 1] - points[a, 1]) * (
        points[c, 0] - points[a, 0]
    )


@njit(nogil=True, cache=True, error_model="numpy")
def find_hull_area(points):
    """Return the area of the convex hull of points, (N, 2), sorted by x, and where that is equal by y."""
    count = len(points)
    hull = np.empty(2 * count + 2, dtype=np.int64)
    corners = 0
    for k in range(count):
        while corners > 1 and _cross(points, hull[corners - 2], hull[corners - 1], k) <= 0:
            corners -= 1
        hull[corners] = k
        corners += 1
    lower = corners + 1
    for k in range(count - 2, -1, -1):
        while corners >= lower and _cross(points, hull[corners - 2], hull[corners - 1], k) <= 0:
            corners -= 1
        hull[corners] = k
        corners += 1
    area = 0.0
    for k in range(1, corners - 2):
        area += _cross(points, hull[0], hull[k], hull[k + 1]) / 2
    return area
