"""Contours with fewer corners: the same area, the same topology, and nowhere further away than a tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.contours.zero_contours import Contours

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Complexes = NDArray[np.complex128]
Flags = NDArray[np.bool_]

# Of the tolerance, how far a chord may lie from the corners that it replaces before its ends are moved. A circle lies
# up to s outside its chords; moved so that the area is kept, they lie s / 3 inside it and their ends 2 s / 3 outside.
BEFORE = 1.5
FRAIL = 2.0  # a ring with less area than this times tolerance and length keeps all its corners


def straightened(contours: Contours, tolerance: float) -> Contours:
    """Return the contours with fewer corners.

    Parameters
    ----------
    contours : Contours
        Simple rings that do not touch.
    tolerance : float, mm
        No ring lies further than this from the one that it replaces, nor that one from it. At 0 nothing changes.

    Returns
    -------
    Contours
        As many rings, in the same order, simple and without touching. Every ring has the area it had, but for rounding.

    Notes
    -----
    Corners are chosen by halving chords at the corner furthest from them (Ramer 1972, Douglas and Peucker 1973), all
    chords at once. Chords of a convex curve lie inside it, so the corners that are left are moved outwards by as much
    as keeps the area: a corner by (a + b) / l, where a and b are the areas between the chords beside it and what they
    replace, and l is the distance between its neighbours. Chords that then lie too far away are halved again.

    Where chords cross, or pass a ring so thin that they might pass on its wrong side, the original corners come
    back. A ring of width w can only change sides with a chord if w is at most twice the tolerance: it is then `FRAIL`.
    """
    if tolerance <= 0:
        return contours
    rings = _begun_at_an_end(contours)
    frail = np.abs(rings.areas) <= FRAIL * tolerance * rings.lengths
    kept = frail[rings.ring]
    kept[rings.first[:-1]] = True
    kept[_furthest_from_first(rings)] = True
    _halve(rings, kept, BEFORE * tolerance)
    while True:
        chords = _fitted(rings, kept, tolerance)
        tangled = _tangled(chords, frail, tolerance)
        short = tangled[np.diff(np.flatnonzero(np.append(kept, True)))[tangled] > 1]
        if len(short) == 0:
            return chords
        kept |= np.isin(np.cumsum(kept) - 1, short)


def _begun_at_an_end(contours: Contours) -> Contours:
    """Return the same rings, each begun at its lowest x, where the contour is convex."""
    first = contours.first[:-1]
    ring, x = contours.ring, contours.points[:, 0]
    lowest = np.flatnonzero(x == np.minimum.reduceat(x, first)[ring])
    begin = lowest[np.searchsorted(lowest, first)]
    counts = np.diff(contours.first)
    place = np.arange(len(x)) - first[ring]
    order = first[ring] + (place + (begin - first)[ring]) % counts[ring]
    return replace(contours, points=contours.points[order])


def _furthest_from_first(rings: Contours) -> Indices:
    """Return the corner of each ring that is furthest from its first."""
    first, ring = rings.first[:-1], rings.ring
    x, y = (rings.points - rings.points[first][ring]).T
    distance = np.hypot(x, y)
    furthest = np.flatnonzero(distance == np.maximum.reduceat(distance, first)[ring])
    return furthest[np.searchsorted(furthest, first)]


def _halve(rings: Contours, kept: Flags, most: float) -> None:
    """Keep more corners, in place, until all others lie no further than `most` from their chord."""
    points = _complex(rings.points)
    where = np.arange(len(points))  # corners on chords that are not yet near enough
    while len(where):
        begins = np.flatnonzero(kept[where])
        counts = np.diff(begins, append=len(where))
        corner = where[begins]
        start, end = (np.repeat(points[each], counts) for each in (corner, _next_kept(rings, kept)[corner]))
        distance = _distances(points[where], start, end)
        far = np.maximum.reduceat(distance, begins)
        split = far > most
        kept[where[_first_of(distance == np.repeat(far, counts), begins)[split]]] = True
        where = where[np.repeat(split, counts)]


def _complex(points: Floats) -> Complexes:
    """Return points (N, 2) as x + iy, for which arithmetic is fast."""
    return np.ascontiguousarray(points).view(np.complex128)[:, 0]


def _next_kept(rings: Contours, kept: Flags) -> Indices:
    """Return the kept corner that follows each kept corner in its ring; anything for corners that are not kept."""
    at = np.flatnonzero(kept)
    following = np.zeros(len(kept), dtype=np.intp)
    following[at] = np.append(at[1:], 0)
    begins = rings.first[:-1]
    following[at[np.append(np.searchsorted(at, begins[1:]), len(at)) - 1]] = begins
    return following


def _first_of(flags: Flags, begins: Indices) -> Indices:
    """Return the first place that is marked at or after each beginning."""
    marked = np.flatnonzero(flags)
    return marked[np.searchsorted(marked, begins)]


def _distances(points: Complexes, start: Complexes, end: Complexes) -> Floats:
    """Return how far each point (N,) is from its segment."""
    along, away = end - start, points - start
    squared = along.real**2 + along.imag**2
    share = (along.real * away.real + along.imag * away.imag) / np.where(squared > 0, squared, 1)
    return np.asarray(np.abs(away - along * share.clip(0, 1)))


def _fitted(rings: Contours, kept: Flags, tolerance: float) -> Contours:
    """Return the chords with their ends moved so that every area is kept; keep more corners, in place, where needed."""
    points, areas = _complex(rings.points), rings.areas
    while True:
        at = np.flatnonzero(kept)
        counts = np.diff(at, append=len(kept))
        chords = Contours(points=rings.points[at], first=np.searchsorted(at, rings.first).astype(np.intp))
        ahead = chords.ahead
        moved = _with_areas(chords, areas, _left_out(rings, chords, at, counts))
        start = _complex(moved.points)
        distance = _distances(points, np.repeat(start, counts), np.repeat(start[ahead], counts))
        strayed = np.abs(start - points[at]) > tolerance
        split = (np.maximum.reduceat(distance, at) > tolerance) | strayed | strayed[ahead]
        split &= counts > 1
        if not split.any():
            return moved
        # At the corner furthest from the chord as it was, since an end that has strayed is further from anything.
        distance = _distances(points, np.repeat(points[at], counts), np.repeat(points[at][ahead], counts))
        distance[at] = -1
        far = np.maximum.reduceat(distance, at)
        kept[_first_of(distance == np.repeat(far, counts), at)[split]] = True


def _left_out(rings: Contours, chords: Contours, at: Indices, counts: Indices) -> Floats:
    """Return the area between each chord and what it replaces, positive on its right."""
    points, start = _complex(rings.points), np.repeat(_complex(chords.points), counts)
    here, there = points - start, points[rings.ahead] - start
    return np.asarray(np.add.reduceat(here.real * there.imag - here.imag * there.real, at) / 2)


def _with_areas(chords: Contours, areas: Floats, left_out: Floats) -> Contours:
    """Return the chords with their ends moved so that each ring has its area."""
    ahead = chords.ahead
    back = np.empty_like(ahead)
    back[ahead] = np.arange(len(ahead))
    points, owing = chords.points, left_out + left_out[back]
    for _ in range(2):
        across = points[ahead] - points[back]
        squared = np.maximum(np.einsum("ij,ij->i", across, across), np.finfo(float).tiny)
        right = np.stack([across[:, 1], -across[:, 0]], axis=1) / squared[:, None]
        moved = replace(chords, points=points + owing[:, None] * right)
        # Neighbours that move together miss the area by a product of both ways: what is missing is shared by all.
        points = moved.points
        owing = np.repeat((areas - moved.areas) / np.diff(chords.first), np.diff(chords.first)) * 2
    return moved


def _tangled(chords: Contours, frail: Flags, tolerance: float) -> Indices:
    """Return the chords that cross others, or pass a frail ring so near that it might have changed sides."""
    ahead = chords.ahead
    lines = shapely.linestrings(np.stack([chords.points, chords.points[ahead]], axis=1))
    tree = shapely.STRtree(lines)
    one, other = tree.query(lines)  # by their boxes: most of the pairs are neighbours, which need no closer look
    apart = (one < other) & (ahead[one] != other) & (ahead[other] != one)
    one, other = one[apart], other[apart]
    crossed = shapely.intersects(lines[one], lines[other])
    found = [one[crossed], other[crossed]]
    thin = frail[chords.ring]
    if thin.any():
        near, chord = tree.query(shapely.points(chords.points[thin]), predicate="dwithin", distance=4 * tolerance)
        found.append(chord[chords.ring[chord] != chords.ring[thin][near]])
    return np.unique(np.concatenate(found))
