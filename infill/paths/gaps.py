"""Gaps: stretches of a region's outline between neighbouring ends of paths, and their clearance for a bead.

A bead along a gap joins the two paths that end there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.kernels.compiling import log_compilation
from infill.paths.clipping import Pieces
from infill.paths.families.family import Path
from infill.paths.outlines import Numbers, Outline
from infill.paths.point_grid import SEARCHES, sort_into_grid

EXEMPT_LENGTH = 3.5  # line widths along a path within which it may come near itself: joins with corners of 30° and more
EXEMPT_LENGTH_OF_ANCHOR = 2.0  # an anchor has another way to go, or none
STEPS = 4  # samples of the outline per line width


@dataclass(frozen=True, kw_only=True)
class Gaps:
    """Gaps between neighbouring ends, ring by ring and forwards along each.

    Attributes
    ----------
    ring : (G,) int
    begin, end : (G,) int
        The ends beside a gap, numbered 2 · path for where a path begins and 2 · path + 1 for where it ends.
    place, length : (G,) float64
        Where it begins along its ring, and how long it is, mm.
    across : (G,) float64
        Distance between the ends, mm: less than `length` around a corner.
    clear : (G,) bool
        True if a bead fits along the entire gap.
    forwards, backwards : (G,) float64
        How far an anchor may reach from `begin` and from `end`, mm.
    """

    ring: Numbers
    begin: Numbers
    end: Numbers
    place: Floats
    length: Floats
    across: Floats
    clear: NDArray[np.bool_]
    forwards: Floats
    backwards: Floats


def find_gaps(pieces: Pieces, outline: Outline, line_width: float, clear: float) -> Gaps:
    """Find the gaps of all rings, and how far each is clear of paths, by a distance of `clear` mm."""
    ends = np.flatnonzero(pieces.ring.ravel() >= 0)
    ring, place = pieces.ring.ravel()[ends], pieces.place.ravel()[ends]
    order = np.lexsort((place, ring))
    ends, ring, place = ends[order], ring[order], place[order]
    tips = np.array([path[[0, -1]] for path in pieces.paths]).reshape(-1, 2)
    # The gap after the last end of a ring goes on to the first.
    opening = np.flatnonzero(np.append(True, ring[1:] != ring[:-1])[: len(ring)])
    following = np.arange(1, len(ring) + 1)
    closing = np.append(opening[1:], len(ring))[: len(opening)] - 1
    following[closing] = opening
    length = place[following] - place if len(ring) else place
    length[closing] += outline.around[ring[closing]]
    forwards, backwards, is_clear = _measure_clearance(
        pieces, outline, line_width, clear, (ring, place, length, ends, ends[following])
    )
    return Gaps(
        ring=ring,
        begin=ends,
        end=ends[following],
        place=place,
        length=length,
        across=np.hypot(*(tips[ends[following]] - tips[ends]).T),
        clear=is_clear,
        forwards=forwards,
        backwards=backwards,
    )


def _measure_clearance(
    pieces: Pieces,
    outline: Outline,
    line_width: float,
    clear: float,
    gaps: tuple[Numbers, Floats, Floats, Numbers, Numbers],
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Measure the clear length of gaps from their begin and from their end, mm, and tell which are entirely clear."""
    import shapely

    ring, place, length, begin, end = gaps
    forwards, backwards, is_clear = length.copy(), length.copy(), np.ones(len(length), dtype=bool)
    if not len(length):
        return forwards, backwards, is_clear
    reach, exempt = clear, EXEMPT_LENGTH * line_width
    step = line_width / STEPS
    count = np.maximum(1, np.ceil(length / step).astype(np.intp))
    gap = np.repeat(np.arange(len(length)), count)
    within = (np.arange(len(gap)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[gap] * length[gap]
    points = np.empty((len(gap), 2))
    for ring_number in np.unique(ring):
        on_ring = ring[gap] == ring_number
        points[on_ring] = outline.points_at(int(ring_number), (place[gap] + within)[on_ring])

    # The segments of paths within reach, and the way along the path from either end of the gap to them.
    flat = np.concatenate(pieces.paths)
    owner = np.repeat(np.arange(len(pieces.paths)), [len(path) for path in pieces.paths])
    start = np.flatnonzero(owner[1:] == owner[:-1])
    long = np.hypot(*(flat[start + 1] - flat[start]).T)
    along = np.zeros(len(flat))
    along[start + 1] = long
    along = np.cumsum(along)
    along -= along[np.searchsorted(owner, owner)]
    total = np.zeros(len(pieces.paths))
    np.maximum.at(total, owner, along)
    is_near = outline.may_reach(flat[start], flat[start + 1], reach)
    start, long = start[is_near], long[is_near]
    segments = shapely.linestrings(np.stack([flat[start], flat[start + 1]], axis=1))
    sample, segment = shapely.STRtree(segments).query(shapely.points(points), predicate="dwithin", distance=reach)
    from_begin, from_end = within[sample], (length[gap] - within)[sample]
    a, path = flat[start[segment]], owner[start[segment]]
    part = ((points[sample] - a) * (flat[start[segment] + 1] - a)).sum(axis=-1) / np.maximum(long[segment], 1e-12)
    passed = along[start[segment]] + part.clip(0, long[segment])
    walks = [
        np.where(path == tip // 2, np.where(tip % 2 == 0, passed, total[path] - passed) + walked, np.inf)
        for tip, walked in ((begin[gap[sample]], from_begin), (end[gap[sample]], from_end))
    ]
    # A pinched outline is never walked: the other side of the pinch may be.
    tight = find_pinched_points(points, ring[gap], place[gap] + within, outline.around, reach, exempt)
    sample = np.concatenate([sample, tight])
    by_begin, by_end = (np.concatenate([walk, np.full(len(tight), np.inf)]) for walk in walks)
    gap_of = gap[sample]
    blocked = by_begin > EXEMPT_LENGTH_OF_ANCHOR * line_width
    np.minimum.at(forwards, gap_of[blocked], (within[sample] - step)[blocked])
    blocked = by_end > EXEMPT_LENGTH_OF_ANCHOR * line_width
    np.minimum.at(backwards, gap_of[blocked], (length[gap_of] - within[sample] - step)[blocked])
    is_clear[gap_of[np.minimum(by_begin, by_end) > exempt]] = False
    return forwards.clip(min=0), backwards.clip(min=0), is_clear


def find_pinched_points(
    points: Path, ring: Numbers, place: Floats, around: Floats, reach: float, exempt: float
) -> Numbers:
    """Find points on outlines that are close to other points, but far from them along their ring.

    Parameters
    ----------
    points : (N, 2) float64, mm
    ring, place : (N,) int, (N,) float64, mm
        The ring of each, and how far along it lies.
    around : (R,) float64, mm
        Length of each ring.
    reach, exempt : float, mm
        Points are close up to `reach`, and far along a ring beyond `exempt`, or on another one.
    """
    from infill.kernels.point_grids import mark_pinched

    if not len(points):
        return np.empty(0, dtype=np.intp)
    grid, is_pinched = sort_into_grid(points), np.zeros(len(points), dtype=bool)
    with log_compilation(SEARCHES):
        mark_pinched(
            *grid.squares, grid.number, ring[grid.number], place[grid.number], around, reach, exempt, is_pinched
        )
    return np.flatnonzero(is_pinched)
