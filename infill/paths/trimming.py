"""Shorten paths whose free ends come too near to other paths, or to themselves.

Where a region is narrow, lines leave it and come back at once: ends lie in front of one another, or beside a line.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from infill.arrays import Floats
from infill.paths.families.family import Path

FARTHEST = 3.0  # line widths of a path that are cut off at most: more would be a line beside a line
STEPS = 16  # points per line width at which an end is tested
EXEMPT = 3.5  # line widths along a path within which it may come near itself


def trim_ends(
    paths: Sequence[Path],
    free: Sequence[tuple[bool, ...]],
    spacing: float,
    line_width: float,
    *,
    share: float = 1.0,
) -> list[Path]:
    """Shorten free ends until they keep their distance from other lines; return all paths.

    An end stays where shortening it by `FARTHEST` line widths would not help.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
    free : sequence of pairs of bool
        Whether each path may be shortened where it begins, and where it ends.
    spacing : float, mm
        Distance between lines, at least.
    line_width : float, mm
    share : float
        Of a path, that may be cut off at each end: 0.5 where short paths lie between two lines.
    """
    trimmed = list(paths)
    for number, sides in enumerate(free):
        for at_end, is_free in enumerate(sides):
            if is_free:
                path = trimmed[number][::-1] if at_end else trimmed[number]
                cut = _trim_begin(path, number, trimmed, spacing, line_width, share)
                if cut is not path:
                    trimmed[number] = cut[::-1] if at_end else cut
    return trimmed


def _trim_begin(
    path: Path, number: int, paths: Sequence[Path], spacing: float, line_width: float, share: float
) -> Path:
    """Shorten a path at its beginning."""
    passed = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    reach = min(FARTHEST * line_width, share * float(passed[-1]))
    places = np.linspace(0.0, reach, max(2, int(STEPS * reach / line_width)))
    points = np.stack([np.interp(places, passed, path[:, axis]) for axis in (0, 1)], axis=-1)
    low, high = points.min(axis=0) - spacing, points.max(axis=0) + spacing
    near = np.zeros(len(places), dtype=bool)
    for neighbour_number, neighbour in enumerate(paths):
        if (neighbour.max(axis=0) < low).any() or (neighbour.min(axis=0) > high).any():
            continue
        begin, finish = neighbour[:-1], neighbour[1:]
        if neighbour_number == number:
            begin, finish = path[:-1], path[1:]
        inside = (np.maximum(begin, finish) >= low).all(axis=1) & (np.minimum(begin, finish) <= high).all(axis=1)
        if not inside.any():
            continue
        distance, along = _measure_distances(points, begin[inside], finish[inside])
        if neighbour_number == number:
            along += passed[:-1][inside]
            distance[np.abs(along - places[:, None]) < EXEMPT * line_width] = np.inf
        near |= (distance < spacing).any(axis=1)
    if not near.any() or near[-1]:
        return path
    place = float(places[int(np.flatnonzero(near)[-1]) + 1])
    kept = passed > place
    return np.concatenate([points[np.searchsorted(places, place)][None], path[kept]])


def _measure_distances(points: Floats, begin: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Return the distances of points (P, 2) from segments (S, 2), and where along each the nearest place is: (P, S)."""
    step = end - begin
    length = np.maximum(np.hypot(*step.T), 1e-12)
    along = (((points[:, None] - begin) * step).sum(axis=-1) / length).clip(0.0, length)
    nearest = begin + (along / length)[..., None] * step
    return np.hypot(*np.moveaxis(points[:, None] - nearest, -1, 0)), along
