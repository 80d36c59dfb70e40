"""Short segments merged with their neighbours in NumPy: what `infill.kernels.short_segments` does, round by round."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.paths.corners import UNIT, RoundedPaths
from infill.paths.curves import segment_distances
from infill.paths.short_segments import (
    HARDLY_BENT,
    LENGTH_CLASSES,
    MOST_MOVED,
    MOST_SPREAD,
    SCATTER,
    SHORTEST_SEGMENT,
    SPREAD_LENGTH,
)


def merge_plainly(paths: RoundedPaths, wanted: float | Floats = SHORTEST_SEGMENT) -> RoundedPaths:
    """Merge the short segments of paths as `merge_short_segments` does."""
    points, source = paths.points.copy(), paths.source
    owner = np.repeat(np.arange(len(paths.first) - 1), np.diff(paths.first))
    least = np.maximum(np.broadcast_to(wanted, len(points)), SHORTEST_SEGMENT)
    moved = np.zeros(len(points))  # mm, at most, between the segment after each point and the path as it was
    stays = np.zeros(len(points), dtype=bool)  # the segment after a point cannot be merged
    while len(points) > 1:
        chosen = _choose_segments(points, owner, least, stays)
        if not len(chosen):
            break
        at_begin, at_end = _touch_ends(owner, chosen)
        kept, dropped, new, errors = _merge_options(points, chosen, at_begin, at_end)
        merged_errors = errors + np.maximum.reduce(
            [moved[np.maximum(chosen - 1, 0)], moved[chosen], moved[np.minimum(chosen + 1, len(moved) - 1)]]
        )
        must = (np.hypot(*(points[chosen + 1] - points[chosen]).T) < SHORTEST_SEGMENT) & ~(at_begin | at_end)
        done = must | (merged_errors <= MOST_MOVED)
        stays[chosen[~done]] = True
        if not done.any():
            continue
        spread = done & must & (errors > HARDLY_BENT)
        if spread.any():
            spread_errors, wider = _spread_points(points, chosen)
            spread &= spread_errors + merged_errors - errors <= MOST_SPREAD
            merged_errors[spread] += spread_errors[spread] - errors[spread]
        chosen_places, chosen = chosen, chosen[done]
        before = np.maximum(chosen - 1, 0)
        for segment in (before, chosen, chosen + 1):
            moved[segment] = np.maximum(moved[segment], merged_errors[done])
        stays[before] = stays[chosen] = stays[chosen + 1] = False
        merged = done & ~spread
        points[kept[merged]] = new[merged]
        remaining = np.ones(len(points), dtype=bool)
        remaining[dropped[merged]] = False
        if spread.any():
            places = chosen_places[spread]
            points[places], points[places + 1] = wider[0][spread], wider[1][spread]
        points, owner, source, least = points[remaining], owner[remaining], source[remaining], least[remaining]
        # The segment after a point that went is now that after the point before it.
        moved, stays = moved[remaining], stays[remaining]
    first = np.searchsorted(owner, np.arange(len(paths.first)))
    return RoundedPaths(points=points, first=first, source=source, radius=paths.radius)


def _choose_segments(points: Floats, owner: Places, least: Floats, stays: NDArray[np.bool_]) -> Places:
    """Choose short segments, three or more apart, the shortest of each neighbourhood."""
    length = np.hypot(points[1:, 0] - points[:-1, 0], points[1:, 1] - points[:-1, 1])
    inner = owner[1:] == owner[:-1]
    short = np.flatnonzero(inner & ~stays[:-1] & (length < least[:-1] - UNIT / 10))
    short = short[(np.bincount(owner) != 2)[owner[short]]]
    rank = np.full(len(length) + 4, np.inf)  # of each segment, two places further on; only of short ones, which are few
    rank[short + 2] = own = np.floor(length[short] / LENGTH_CLASSES) + (short * SCATTER) % 1
    around = np.minimum.reduce([rank[short + shift] for shift in (0, 1, 3, 4)])
    chosen: Places = short[own < around]
    return chosen


def _touch_ends(owner: Places, chosen: Places) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Tell which segments begin a path, and which end one."""
    last = len(owner) - 1
    begins = (chosen == 0) | (owner[chosen] != owner[chosen - 1])
    return begins, (chosen + 1 == last) | (owner[chosen] != owner[np.minimum(chosen + 2, last)])


def _merge_options(
    points: Floats, chosen: Places, at_begin: NDArray[np.bool_], at_end: NDArray[np.bool_]
) -> tuple[Places, Places, Floats, Floats]:
    """Find the best way to merge each segment AB of some paths; some of them begin or end a path.

    Returns
    -------
    kept, dropped : (C,) int
        Places of the point that stays and of the one that goes.
    new : (C, 2) float64, mm
        Where the point that stays lies then.
    errors : (C,) float64, mm
        Distance of the old points from the new path.
    """
    a, b = points[chosen], points[chosen + 1]
    before, after = points[np.maximum(chosen - 1, 0)], points[np.minimum(chosen + 2, len(points) - 1)]
    middle = np.rint((a + b) / 2 / UNIT) * UNIT
    without_a = np.where(at_begin, np.inf, segment_distances(a, before, b))
    without_b = np.where(at_end, np.inf, segment_distances(b, a, after))
    halfway = np.maximum(segment_distances(a, before, middle), segment_distances(b, middle, after))
    halfway = np.where(at_begin | at_end, np.inf, halfway)
    errors = np.stack([without_a, without_b, halfway])
    best = errors.argmin(axis=0)
    kept = chosen + (best == 0)
    new = np.where((best == 0)[:, None], b, np.where((best == 1)[:, None], a, middle))
    return kept, 2 * chosen + 1 - kept, new, errors.min(axis=0)


def _spread_points(points: Floats, chosen: Places) -> tuple[Floats, tuple[Floats, Floats]]:
    """Move both points of segments apart along their legs; return how far the path moves, mm, and the two points.

    The distance is infinite where a leg is too short.
    """
    last = len(points) - 1
    a, b = points[chosen], points[chosen + 1]
    back, on = points[np.maximum(chosen - 1, 0)] - a, points[np.minimum(chosen + 2, last)] - b
    room = np.minimum(np.hypot(*back.T), np.hypot(*on.T)) - SPREAD_LENGTH
    back /= np.maximum(np.hypot(*back.T), 1e-300)[:, None]
    on /= np.maximum(np.hypot(*on.T), 1e-300)[:, None]
    apart, between = on - back, b - a
    # |between + t apart| = SPREAD_LENGTH
    square, half = (apart**2).sum(axis=1), (apart * between).sum(axis=1)
    under = half**2 + square * (SPREAD_LENGTH**2 - (between**2).sum(axis=1))
    step = (np.sqrt(np.maximum(under, 0.0)) - half) / np.maximum(square, 1e-9)
    new_a, new_b = (np.rint((place + step[:, None] * leg) / UNIT) * UNIT for place, leg in ((a, back), (b, on)))
    errors = np.maximum(segment_distances(a, new_a, new_b), segment_distances(b, new_a, new_b))
    errors[(step > room) | (np.hypot(*(new_b - new_a).T) < SHORTEST_SEGMENT)] = np.inf
    return errors, (new_a, new_b)
