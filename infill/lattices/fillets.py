"""The angles of the corners between walls, and the time in which curvature rounds them to a radius."""

from __future__ import annotations

from functools import cache

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.arrays import Floats
from patterns.unit_cells import Bars, Cellular, Planes

# Curvature of a corner of a void at its tip, times sqrt(2 t): of the solution of curve shortening that begins as this
# angle and stays itself, the larger the longer.
DEGREES = (45.0, 50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 90.0)
TIPS = (1.4976, 1.3727, 1.2632, 1.166, 1.0785, 0.9992, 0.9265, 0.8593, 0.7969, 0.7386)
# Share of the radius that a grid of that many cells per radius costs, wherever corners lie on it.
COARSE, CELLS = 0.16, 4.0
BLUNT = 1.7  # cells: on a grid coarser than this beside the radius, corners are rounder than asked for anyway
GRID = 0.05 / 30  # share of the radius that a coarse grid costs, per degree that a corner is sharper than a right angle
THINNER = 0.1  # of a bar, which curvature may take for corners sharper than right angles
FEW = 0.02  # of the corners may be sharper
STRAIGHT = 150.0  # degrees: wider angles are not corners
EQUAL = 1e-6  # of a cell: ends of bars that are nearer than this coincide


def tip_curvature(degrees: float) -> float:
    """Return the curvature of the tip of a corner of a void, times sqrt(2 t), clamped to 45 and 90 degrees.

    >>> tip_curvature(90), tip_curvature(120), round(tip_curvature(60) / tip_curvature(90), 2)
    (0.7386, 0.7386, 1.58)
    """
    return float(np.interp(degrees, DEGREES, TIPS))


def rounding_time(radius: float, degrees: float, bar: float | None = None, *, cell: float = 0.0) -> float:
    """Return the time in which curvature rounds corners to a radius.

    Parameters
    ----------
    radius : float
    degrees : float
        Of the corners; sharper ones count as 45.
    bar : float, optional
        Diameter of bars, which curvature makes thinner: for corners that are sharper than right angles, no more than a
        tenth is taken from it.
    cell : float
        Of the grid, on which corners stay sharper for a while: by the square of its share in the radius. 0 for none.

    Returns
    -------
    float
        In squares of the unit of the lengths.

    >>> round(rounding_time(1.0, 90.0), 4), rounding_time(1.0, 60.0) > 2.4 * rounding_time(1.0, 90.0)
    (0.2728, True)
    >>> rounding_time(1.0, 60.0, bar=1.0) == rounding_time(1.0, 90.0)
    True
    >>> rounding_time(1.0, 15.0) == rounding_time(1.0, 45.0)
    True
    """
    degrees = min(max(degrees, DEGREES[0]), 90.0)
    enlarged = 1 + COARSE * min(1.0, (CELLS * cell / radius) ** 2) if radius >= BLUNT * cell > 0 else 1.0
    right = (tip_curvature(90.0) * radius * enlarged) ** 2 / 2
    sharp = (tip_curvature(degrees) * radius * (enlarged + GRID * (90.0 - degrees))) ** 2 / 2
    if bar is None:
        return sharp
    # The square of the radius of a cylinder falls by twice the time.
    return max(right, min(sharp, (1 - (1 - THINNER) ** 2) * (bar / 2) ** 2 / 2))


def sharpest_angle(angles: Floats) -> float:
    """Return the sharpest angle, degrees, except for a few outliers; at most the right angle of the walls of a part."""
    return min(90.0, float(np.quantile(angles, FEW))) if len(angles) else 90.0


@cache
def corner_angle_between_walls(pattern: Cellular) -> float:
    """Return the angle of the sharpest corners of voids in a pattern in space, degrees.

    >>> from patterns import PATTERNS
    >>> names = "cubic", "quarter-cubic", "octet", "kelvin", "gyroid"
    >>> [round(corner_angle_between_walls(PATTERNS[name]()), 1) for name in names]
    [90.0, 70.5, 60.0, 90.0, 90.0]
    """
    if isinstance(pattern, Planes):
        normals = pattern.families()[0]
        unit = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        i, j = np.triu_indices(len(unit), 1)
        return sharpest_angle(np.degrees(np.arccos(np.clip(np.abs((unit[i] * unit[j]).sum(axis=1)), 0, 1))))
    if not isinstance(pattern, Bars):
        return 90.0  # without corners of their own
    return sharpest_angle(_angles_between_bars(pattern))


def _angles_between_bars(pattern: Bars) -> Floats:
    """Return the angles between all pairs of bars that meet at a node, degrees."""
    axes = pattern.axes()
    ends = np.concatenate([axes[:, 0], axes[:, 1]])
    directions = np.concatenate([axes[:, 1] - axes[:, 0], axes[:, 0] - axes[:, 1]])
    directions = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    places = np.round(ends % pattern.cells / EQUAL).astype(np.int64) % round(pattern.cells / EQUAL)
    node = np.unique(places, axis=0, return_inverse=True)[1].ravel()
    angles_at_nodes = []
    for number in range(int(node.max()) + 1):
        at_node = directions[node == number]
        i, j = np.triu_indices(len(at_node), 1)
        angles_at_nodes.append(np.degrees(np.arccos(np.clip((at_node[i] * at_node[j]).sum(axis=1), -1, 1))))
    angles = np.concatenate(angles_at_nodes)
    return angles[angles > 1.0]  # the same bar, from two periods


def find_polygon_corners(polygons: NDArray[np.object_]) -> tuple[Floats, Floats]:
    """Find the corners of polygons and of their holes: places, (N, 2), and inside angles, degrees.

    >>> places, angles = find_polygon_corners(np.array([shapely.box(0, 0, 2, 1)]))
    >>> places.tolist(), angles.round(6).tolist()
    ([[2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.0]], [90.0, 90.0, 90.0, 90.0])
    """
    rings, polygon = shapely.get_rings(shapely.remove_repeated_points(polygons), return_index=True)
    if not len(rings):
        return np.empty((0, 2)), np.empty(0)
    hole = np.diff(polygon, prepend=-1) == 0
    points, ring = shapely.get_coordinates(rings, return_index=True)
    begins = np.flatnonzero(np.diff(ring, prepend=-1))
    ends = np.append(begins[1:], len(points)) - 1  # the first point again
    number = np.arange(len(points))
    before = number - 1
    before[begins] = ends - 1
    back, on = (points[index] - points for index in (before, np.minimum(number + 1, len(points) - 1)))
    turn = on[:, 0] * back[:, 1] - on[:, 1] * back[:, 0]
    angle = np.degrees(np.arctan2(turn, (back * on).sum(axis=1))) % 360
    angle = np.where((shapely.is_ccw(rings) != hole)[ring], angle, 360 - angle)
    is_corner = angle < STRAIGHT
    is_corner[ends] = False
    return points[is_corner], angle[is_corner]
