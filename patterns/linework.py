"""Geometry that patterns share: turning, clipping, framing, sampling."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiLineString, MultiPolygon, Polygon

from patterns.declared import format_decimal
from patterns.errors import PatternError


def turn(points: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    """Turn `points` (..., 2) by `angle` degrees, counter-clockwise, about (0, 0).

    >>> turn(np.array([1.0, 0.0]), 90).round(12).tolist()
    [0.0, 1.0]
    """
    cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y = points[..., 0], points[..., 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def to_pattern_coordinates(
    x: NDArray[np.float64], y: NDArray[np.float64], *, angle: float, phase: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the coordinates of points in a pattern turned by `angle` degrees and then shifted by `phase`, mm.

    A level set of these coordinates is the pattern turned and shifted.

    >>> x, y = to_pattern_coordinates(np.array(1.0), np.array(2.0), angle=90, phase=(1.0, 0.0))
    >>> round(float(x), 12), round(float(y), 12)
    (2.0, 0.0)
    """
    position = turn(np.stack(np.broadcast_arrays(x - phase[0], y - phase[1]), axis=-1), -angle)
    return position[..., 0], position[..., 1]


def drop_distant(
    centres: NDArray[np.float64],
    region: Polygon | MultiPolygon,
    *,
    angle: float,
    phase: tuple[float, float],
    reach: float,
) -> NDArray[np.float64]:
    """Drop the cells of a turned lattice that lie farther than `reach` mm from the bounds of `region`.

    The box around a long region, turned with the lattice, is much larger than the region.

    Parameters
    ----------
    centres : (..., 2) float64
        Centres of cells, mm, in the coordinates of the lattice.
    region : Polygon or MultiPolygon
    angle : float
        Degrees by which the lattice is turned.
    phase : (x, y)
        mm by which it is shifted afterwards.
    reach : float
        mm from the centre of a cell to its farthest wall.

    >>> centres = np.array([[0.0, 0.0], [5.0, 0.0]])
    >>> drop_distant(centres, shapely.box(0, 0, 1, 9), angle=90, phase=(0, 0), reach=1).tolist()
    [[0.0, 0.0], [5.0, 0.0]]
    >>> drop_distant(centres, shapely.box(0, 0, 9, 1), angle=90, phase=(0, 0), reach=1).tolist()
    [[0.0, 0.0]]
    """
    low, high = np.reshape(region.bounds, (2, 2))
    positions = turn(centres, angle) + np.array(phase)
    is_near: NDArray[np.bool_] = ((positions >= low - reach) & (positions <= high + reach)).all(axis=-1)
    return centres[is_near]


def clip(lines: Iterable[shapely.Geometry] | NDArray[np.object_], region: Polygon | MultiPolygon) -> MultiLineString:
    """Clip `lines` to `region`; parts that merely touch it in a point are dropped."""
    shapely.prepare(region)
    candidates = np.asarray(lines, dtype=object)
    candidates = candidates[shapely.intersects(candidates, region)]
    inside = shapely.contains(region, candidates)
    cut = shapely.get_parts(shapely.intersection(candidates[~inside], region))
    cut = shapely.get_parts(cut)  # a GeometryCollection is nested once
    parts = np.concatenate([candidates[inside], cut[(shapely.get_type_id(cut) == 1) & (shapely.length(cut) > 0)]])
    return MultiLineString(list(parts))


def join_lines(lines: MultiLineString) -> MultiLineString:
    """Join `lines` that share an end in pairs: clipping also cuts a ring where it begins.

    >>> len(join_lines(MultiLineString([[(0, 0), (1, 0)], [(1, 0), (2, 0)], [(5, 5), (6, 6)]])).geoms)
    2
    """
    return MultiLineString(list(shapely.get_parts(shapely.line_merge(lines))))


def add_frame(lines: MultiLineString, region: Polygon | MultiPolygon) -> MultiLineString:
    """Add the outline of `region` to `lines`."""
    return MultiLineString([*lines.geoms, *shapely.get_parts(shapely.boundary(region))])


def sample_points(lines: MultiLineString, spacing: float) -> NDArray[np.float64]:
    """Return points along `lines`, neighbours at most `spacing` apart: (N, 2) float64, mm.

    >>> sample_points(MultiLineString([[(0, 0), (1, 0)]]), 0.5)[:, 0].tolist()
    [0.0, 0.5, 1.0]
    """
    if not (math.isfinite(spacing) and spacing > 0):
        raise PatternError(f"the spacing of points is {format_decimal(spacing)} mm; it must be a number above 0")
    coordinates: NDArray[np.float64] = shapely.get_coordinates(shapely.segmentize(lines, spacing))
    return coordinates


def bounds_centre(region: Polygon | MultiPolygon) -> NDArray[np.float64]:
    """Return the centre (x, y) of the bounding box of `region`."""
    x0, y0, x1, y1 = region.bounds
    return np.array([(x0 + x1) / 2, (y0 + y1) / 2])


def body_numbers(lines: MultiLineString, *, tolerance: float = 1e-6) -> NDArray[np.intp]:
    """Return, for every line, the number (from 0) of the connected body of lines it belongs to.

    >>> body_numbers(MultiLineString([[(0, 0), (2, 0)], [(1, -1), (1, 1)], [(5, 5), (6, 6)]])).tolist()
    [0, 0, 1]
    """
    parts = np.array(lines.geoms, dtype=object)
    line, touching_line = shapely.STRtree(parts).query(parts, predicate="dwithin", distance=tolerance)
    label = np.arange(len(parts))
    while True:  # each line takes the smallest number it touches, then that line's own
        smallest = label.copy()
        np.minimum.at(smallest, line, label[touching_line])
        smallest = smallest[smallest]
        if np.array_equal(smallest, label):
            break
        label = smallest
    body: NDArray[np.intp] = np.unique(label, return_inverse=True)[1]
    return body
