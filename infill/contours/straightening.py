"""Simplify contours to fewer corners: the area and the topology stay, and nothing moves further than a tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.arrays import Flags, Floats
from infill.contours.zero_contours import Contours

Indices = NDArray[np.intp]
Complexes = NDArray[np.complex128]

# Of the tolerance, how far a chord may lie from the corners that it replaces before its ends are moved. A circle lies
# up to s outside its chords; moved so that the area is kept, they lie s / 3 inside it and their ends 2 s / 3 outside.
BEFORE = 1.5
FRAIL = 2.0  # a ring with less area than this times tolerance and length keeps all its corners


def simplify_contours(contours: Contours, tolerance: float) -> Contours:
    """Simplify contours to fewer corners.

    Parameters
    ----------
    contours : Contours
        Simple rings that do not touch.
    tolerance : float, mm
        No ring lies further than this from the one that it replaces, nor that one from it. At 0 nothing changes.

    Returns
    -------
    Contours
        As many rings, in the same order, simple and without touching. Every ring keeps its area, to rounding.

    Notes
    -----
    Corners are chosen by halving chords at the corner furthest from them (Ramer 1972, Douglas and Peucker 1973), all
    chords at once. Chords of a convex curve lie inside it, so the remaining corners move outwards until the area is the
    same: a corner by (a + b) / l, where a and b are the areas between the chords beside it and the curves that they
    replace, and l is the distance between its neighbours. Chords that then lie too far away are halved again.

    Where chords cross, or pass a ring so thin that they might pass on its wrong side, the original corners come
    back. A ring of width w can only change sides with a chord if w is at most twice the tolerance: it is then `FRAIL`.
    """
    if tolerance <= 0:
        return contours
    rings = _start_at_lowest_x(contours)
    frail = np.abs(rings.areas) <= FRAIL * tolerance * rings.lengths
    is_corner = frail[rings.ring]
    is_corner[rings.first[:-1]] = True
    is_corner[_furthest_corners(rings)] = True
    _halve(rings, is_corner, BEFORE * tolerance)
    while True:
        chords = _fit_chords(rings, is_corner, tolerance)
        tangled = _tangled_chords(chords, frail, tolerance)
        short = tangled[np.diff(np.flatnonzero(np.append(is_corner, True)))[tangled] > 1]
        if len(short) == 0:
            return chords
        is_corner |= np.isin(np.cumsum(is_corner) - 1, short)


def _start_at_lowest_x(contours: Contours) -> Contours:
    """Start each ring at its corner of lowest x, where the contour is convex."""
    ring_start = contours.first[:-1]
    ring, x = contours.ring, contours.points[:, 0]
    lowest = np.flatnonzero(x == np.minimum.reduceat(x, ring_start)[ring])
    begin = lowest[np.searchsorted(lowest, ring_start)]
    counts = np.diff(contours.first)
    place = np.arange(len(x)) - ring_start[ring]
    order = ring_start[ring] + (place + (begin - ring_start)[ring]) % counts[ring]
    return replace(contours, points=contours.points[order])


def _furthest_corners(rings: Contours) -> Indices:
    """Return the corner of each ring that is furthest from its first corner."""
    ring_start, ring = rings.first[:-1], rings.ring
    x, y = (rings.points - rings.points[ring_start][ring]).T
    distance = np.hypot(x, y)
    furthest = np.flatnonzero(distance == np.maximum.reduceat(distance, ring_start)[ring])
    return furthest[np.searchsorted(furthest, ring_start)]


def _halve(rings: Contours, is_corner: Flags, limit: float) -> None:
    """Keep more corners, in place, until all others lie no further than `limit` from their chord."""
    points = _complex(rings.points)
    open_corners = np.arange(len(points))  # corners on chords that are not yet near enough
    while len(open_corners):
        begins = np.flatnonzero(is_corner[open_corners])
        counts = np.diff(begins, append=len(open_corners))
        corner = open_corners[begins]
        start, end = (
            np.repeat(points[corners], counts) for corners in (corner, _following_corner(rings, is_corner)[corner])
        )
        distance = _segment_distances(points[open_corners], start, end)
        largest = np.maximum.reduceat(distance, begins)
        split = largest > limit
        is_corner[open_corners[_first_marked(distance == np.repeat(largest, counts), begins)[split]]] = True
        open_corners = open_corners[np.repeat(split, counts)]


def _complex(points: Floats) -> Complexes:
    """Return points (N, 2) as x + iy, for which arithmetic is fast."""
    return np.ascontiguousarray(points).view(np.complex128)[:, 0]


def _following_corner(rings: Contours, is_corner: Flags) -> Indices:
    """Return the next kept corner of the same ring, (N,), 0 for dropped ones; the first of every ring must be kept."""
    corners = np.flatnonzero(is_corner)
    following = np.zeros(len(is_corner), dtype=np.intp)
    following[corners] = np.append(corners[1:], 0)
    begins = rings.first[:-1]
    following[corners[np.append(np.searchsorted(corners, begins[1:]), len(corners)) - 1]] = begins
    return following


def _first_marked(flags: Flags, begins: Indices) -> Indices:
    """Return the first marked position at or after each beginning; raise IndexError if there is none."""
    marked = np.flatnonzero(flags)
    return marked[np.searchsorted(marked, begins)]


def _segment_distances(points: Complexes, start: Complexes, end: Complexes) -> Floats:
    """Return the distance of each point (N,) from its segment, both given as complex numbers."""
    along, offset = end - start, points - start
    squared = along.real**2 + along.imag**2
    share = (along.real * offset.real + along.imag * offset.imag) / np.where(squared > 0, squared, 1)
    return np.asarray(np.abs(offset - along * share.clip(0, 1)))


def _fit_chords(rings: Contours, is_corner: Flags, tolerance: float) -> Contours:
    """Move the ends of chords so that every area stays; if chords lie too far away, mark more in `is_corner`."""
    points, areas = _complex(rings.points), rings.areas
    while True:
        corner = np.flatnonzero(is_corner)
        counts = np.diff(corner, append=len(is_corner))
        chords = Contours(points=rings.points[corner], first=np.searchsorted(corner, rings.first).astype(np.intp))
        ahead = chords.ahead
        moved = _restore_areas(chords, areas, _replaced_areas(rings, chords, corner, counts))
        start = _complex(moved.points)
        distance = _segment_distances(points, np.repeat(start, counts), np.repeat(start[ahead], counts))
        strayed = np.abs(start - points[corner]) > tolerance
        split = (np.maximum.reduceat(distance, corner) > tolerance) | strayed | strayed[ahead]
        split &= counts > 1
        if not split.any():
            return moved
        # At the corner furthest from the unmoved chord, since an end that has strayed is far from everything.
        distance = _segment_distances(
            points, np.repeat(points[corner], counts), np.repeat(points[corner][ahead], counts)
        )
        distance[corner] = -1
        largest = np.maximum.reduceat(distance, corner)
        is_corner[_first_marked(distance == np.repeat(largest, counts), corner)[split]] = True


def _replaced_areas(rings: Contours, chords: Contours, corner: Indices, counts: Indices) -> Floats:
    """Return the area between each chord and the corners that it replaces, positive on its right."""
    points, start = _complex(rings.points), np.repeat(_complex(chords.points), counts)
    offset, next_offset = points - start, points[rings.ahead] - start
    return np.asarray(np.add.reduceat(offset.real * next_offset.imag - offset.imag * next_offset.real, corner) / 2)


def _restore_areas(chords: Contours, areas: Floats, left_out: Floats) -> Contours:
    """Move the ends of chords so that each ring has its area."""
    ahead = chords.ahead
    back = np.empty_like(ahead)
    back[ahead] = np.arange(len(ahead))
    points, missing = chords.points, left_out + left_out[back]
    for _ in range(2):
        span = points[ahead] - points[back]
        squared = np.maximum(np.einsum("ij,ij->i", span, span), np.finfo(float).tiny)
        right = np.stack([span[:, 1], -span[:, 0]], axis=1) / squared[:, None]
        moved = replace(chords, points=points + missing[:, None] * right)
        # Neighbours that move together miss the area by the product of both moves: all corners share the rest.
        points = moved.points
        missing = np.repeat((areas - moved.areas) / np.diff(chords.first), np.diff(chords.first)) * 2
    return moved


def _tangled_chords(chords: Contours, frail: Flags, tolerance: float) -> Indices:
    """Return the chords that cross others, or pass a frail ring so closely that it might have changed sides."""
    ahead = chords.ahead
    lines = shapely.linestrings(np.stack([chords.points, chords.points[ahead]], axis=1))
    tree = shapely.STRtree(lines)
    chord_a, chord_b = tree.query(lines)  # by their boxes: most of these pairs are neighbours, and are skipped
    apart = (chord_a < chord_b) & (ahead[chord_a] != chord_b) & (ahead[chord_b] != chord_a)
    chord_a, chord_b = chord_a[apart], chord_b[apart]
    crossed = shapely.intersects(lines[chord_a], lines[chord_b])
    tangled = [chord_a[crossed], chord_b[crossed]]
    thin = frail[chords.ring]
    if thin.any():
        point, chord = tree.query(shapely.points(chords.points[thin]), predicate="dwithin", distance=4 * tolerance)
        tangled.append(chord[chords.ring[chord] != chords.ring[thin][point]])
    return np.unique(np.concatenate(tangled))
