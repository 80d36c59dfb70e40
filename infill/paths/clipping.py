"""Paths cut at the outline of a region, each on its own: a union would also cut paths where they touch each other.

Step 1. Intersect the segments of paths with the edges of the outline: exact predicates choose the pairs, floating
        point gives the coordinates.
Step 2. Each run of a path from one cut to the next lies on one side; the middle of its longest piece tells the side.
Step 3. Consecutive runs inside form one path: the outline only touches it there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.paths.families.family import Path
from infill.paths.outlines import Numbers, Outline

SAME = 1e-9  # mm: a cut this close to a corner is at the corner


@dataclass(frozen=True, kw_only=True)
class Pieces:
    """Paths inside a region.

    Attributes
    ----------
    paths : list of (N, 2) float64
        mm, in the order and direction of the paths that they were cut from.
    ring : (P, 2) int
        The ring on which each begins and ends; −1 for an end inside the region, and for closed paths.
    place : (P, 2) float64
        How far along that ring, mm.
    """

    paths: list[Path]
    ring: Numbers
    place: Floats


def clip(paths: Sequence[Path], outline: Outline) -> Pieces:
    """Return the parts of `paths` inside a region.

    >>> from shapely import box
    >>> from infill.paths.outlines import outline_of
    >>> pieces = clip([np.array([[-1.0, 1.0], [5.0, 1.0]])], outline_of(box(0, 0, 3, 2)))
    >>> pieces.paths[0].tolist(), pieces.place.tolist()
    ([[0.0, 1.0], [3.0, 1.0]], [[6.0, 1.0]])
    """
    paths = [path for path in paths if len(path) > 1]
    inside: list[Path] = []
    ends: list[tuple[int, int]] = []
    ring, place = np.zeros(0, dtype=np.intp), np.zeros(0)
    if paths:
        points, owner, ring, place = _cut(paths, outline)
        for run in _runs_inside(points, owner, ring >= 0, outline):
            path = points[run[0]] if len(run) == 1 else np.concatenate([points[part] for part in run])
            inside.append(path)
            ends.append((run[0].start, run[-1].stop - 1))
    end_points = np.array(ends, dtype=np.intp).reshape(-1, 2)
    ring, place = ring[end_points], place[end_points]
    closed = np.array([is_closed(path) for path in inside], dtype=bool)
    ring[closed], place[closed] = -1, np.nan
    return Pieces(paths=inside, ring=ring, place=place)


def is_closed(path: Path) -> bool:
    """Tell whether a path ends where it begins."""
    return len(path) > 2 and bool((path[0] == path[-1]).all())


def _cut(paths: Sequence[Path], outline: Outline) -> tuple[Path, Numbers, Numbers, Floats]:
    """Cut paths at the outline; return all points in order, the path, ring (or −1) and place of each."""
    import shapely

    points = np.concatenate(paths)
    owner = np.repeat(np.arange(len(paths)), [len(path) for path in paths])
    start = np.flatnonzero(owner[1:] == owner[:-1])
    start = start[outline.may_reach(points[start], points[start + 1])]
    edges = shapely.linestrings(np.stack([outline.begin, outline.end], axis=1))
    segments = shapely.linestrings(np.stack([points[start], points[start + 1]], axis=1))
    edge, segment = shapely.STRtree(segments).query(edges, predicate="intersects")
    a, along = points[start[segment]], points[start[segment] + 1] - points[start[segment]]
    b, side = outline.begin[edge], outline.end[edge] - outline.begin[edge]
    cross = _cross(along, side)
    # On parallel ones every corner of the outline is the end of two edges: the one at this end is enough.
    parallel = np.abs(cross) <= 1e-14 * np.hypot(*along.T) * np.hypot(*side.T)
    divisor = np.where(parallel, (along**2).sum(axis=-1), cross)
    divisor[divisor == 0] = 1.0  # a path that stands still
    fraction_along = np.where(parallel, ((b - a) * along).sum(axis=-1), _cross(b - a, side)) / divisor
    cut = a + fraction_along.clip(0, 1)[:, None] * along
    length = np.hypot(*side.T)
    place = outline.place[edge] + (((cut - b) * side).sum(axis=-1) / length).clip(0, length)

    key = np.concatenate([np.arange(len(points), dtype=np.float64), start[segment].astype(np.float64)])
    sort_fraction = np.concatenate([np.zeros(len(points)), fraction_along.clip(0, 1)])
    order = np.lexsort((sort_fraction, key))
    merged_points = np.concatenate([points, cut])[order]
    path_of = np.concatenate([owner, owner[start[segment]]])[order]
    ring = np.concatenate([np.full(len(points), -1), outline.ring[edge]])[order]
    places = np.concatenate([np.full(len(points), np.nan), place])[order]
    # Cuts at a corner, and two cuts at a corner of the outline, become one.
    repeats = np.zeros(len(merged_points), dtype=bool)
    repeats[1:] = (np.abs(np.diff(merged_points, axis=0)).max(axis=-1) <= SAME) & (path_of[1:] == path_of[:-1])
    if repeats.any():
        group = np.cumsum(~repeats) - 1
        unique_points = np.flatnonzero(~repeats)
        cuts = np.flatnonzero(ring >= 0)
        ring_of, place_of = np.full(len(unique_points), -1), np.full(len(unique_points), np.nan)
        ring_of[group[cuts]], place_of[group[cuts]] = ring[cuts], places[cuts]
        joined = merged_points[unique_points]
        corners = np.flatnonzero(order < len(points))  # a corner stays where it is, so that closed paths stay closed
        joined[group[corners]] = merged_points[corners]
        merged_points, path_of, ring, places = joined, path_of[unique_points], ring_of, place_of
    # Rounding may find the outline at one end of a closed path alone.
    first, last = _ends(path_of)
    closed = (merged_points[first] == merged_points[last]).all(axis=-1)
    for cut_end, missed in ((first[closed], last[closed]), (last[closed], first[closed])):
        missed, cut_end = missed[ring[missed] < 0], cut_end[ring[missed] < 0]
        ring[missed], places[missed] = ring[cut_end], places[cut_end]
    return merged_points, path_of, ring, places


def _ends(owner: Numbers) -> tuple[Numbers, Numbers]:
    """Return the first and the last point of every path."""
    changes = np.flatnonzero(owner[1:] != owner[:-1])
    return np.append(0, changes + 1), np.append(changes, len(owner) - 1)


def _runs_inside(points: Path, owner: Numbers, cut: NDArray[np.bool_], outline: Outline) -> list[list[slice]]:
    """Find the runs of points inside the region: one slice each, or two for a closed path whose ends lie inside."""
    import shapely

    path_starts, path_ends = _ends(owner)
    is_first, is_last = np.zeros((2, len(owner)), dtype=bool)
    is_first[path_starts] = is_last[path_ends] = True
    begin = np.flatnonzero((is_first | cut) & ~is_last)
    if not len(begin):
        return []
    path = np.searchsorted(path_ends, begin)
    end = np.minimum(np.append(begin[1:], len(points)), path_ends[path])
    longest = _longest(np.where(is_last[:-1], 0.0, np.hypot(*np.diff(points, axis=0).T)), begin)
    inside = shapely.contains_xy(outline.region, (points[longest] + points[longest + 1]) / 2)
    begin, end, path = begin[inside], end[inside], path[inside]
    # A run that begins where another ends continues it.
    opens = np.append(True, begin[1:] != end[:-1])[: len(begin)]
    begin, end, path = begin[opens], end[np.append(opens[1:], True)[: len(end)]], path[opens]
    closed = (points[path_starts] == points[path_ends]).all(axis=-1)[path]
    runs: list[list[slice]] = []
    opening: dict[int, int] = {}
    for start, stop, number, ring in zip(begin.tolist(), end.tolist(), path.tolist(), closed.tolist(), strict=True):
        if ring and start != path_starts[number] and stop == path_ends[number] and number in opening:
            runs[opening[number]].insert(0, slice(start, stop))
        else:
            if ring and start == path_starts[number]:
                opening[number] = len(runs)
            runs.append([slice(start, stop + 1)])
    return runs


def _longest(piece: Floats, begin: Numbers) -> Numbers:
    """Find the longest piece of each run; a run begins where the one before it ends."""
    run = np.zeros(len(piece), dtype=np.intp)
    run[begin[1:]] = 1
    run = np.cumsum(run)
    order = np.lexsort((piece, run))
    longest: Numbers = order[np.append(np.flatnonzero(np.diff(run)), len(piece) - 1)]
    return longest


def _cross(a: Path, b: Path) -> Floats:
    """Return the cross product of vectors in the plane, (N, 2) each."""
    product: Floats = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return product
