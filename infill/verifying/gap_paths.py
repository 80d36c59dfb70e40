"""Beads without a partner, compared as paths: whether new beads lie on old ones, and old ones under new ones.

This is how an arc passes in place of the lines that it was made from, and how a bead passes that is printed in another
order or direction.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from infill.arrays import Floats, Places
from infill.paths.curves import segment_distances
from infill.ragged import expand_rows
from infill.verifying.alignment import Alignment
from infill.verifying.tolerances import PATH_TOLERANCE, UNIT
from infill.verifying.trace import TraceRows

MOST_AT_ONCE: Final = 1 << 18  # distances that are computed at a time
LARGE_GAP: Final = 1 << 18  # distances in a gap; beads of larger ones are found by a tree
NEAR: Final = 2 * PATH_TOLERANCE  # mm beyond the nearest old bead within which others count as its neighbours
_PRIMES: Final = np.array([73856093, 19349663, 83492791, 49979687, 15485863], dtype=np.int64)


@dataclass(frozen=True, kw_only=True)
class GapBeads:
    """Beads of the gaps of an alignment.

    Parameters
    ----------
    old, new : (A,) and (B,) int64
        Rows that lay filament, ascending.
    old_gap, new_gap : (A,) and (B,) int64
        Their gaps.
    old_off, new_off : (A,) and (B,) float64
        Greatest distance of their ends and middle from the beads of the other print in the gap, mm; infinite where it
        has none.
    nearest : (B,) int64
        Row of the old bead nearest to the middle of each new bead; -1 where there is none.
    neighbours : (K, 2) int64
        New and old rows whose beads lie together, ascending by the new row.
    """

    old: Places
    new: Places
    old_gap: Places
    new_gap: Places
    old_off: Floats
    new_off: Floats
    nearest: Places
    neighbours: Places


def pair_reordered(old: TraceRows, new: TraceRows, alignment: Alignment) -> tuple[Places, Places]:
    """Pair beads of gaps that have the same ends in the same layer, in whatever order or direction they are printed."""
    gaps = alignment.gaps
    in_old, _ = _rows_of(old, gaps.old, gaps.old_end)
    in_new, _ = _rows_of(new, gaps.new, gaps.new_end)
    firsts, seconds = [], []
    for flip in (False, True):
        keys = []
        for rows, chosen, reverse in ((old, in_old, False), (new, in_new, flip)):
            keys.append(_bead_keys(rows.at(chosen), reverse=reverse))
        values_old, first_old, counts_old = np.unique(keys[0], return_index=True, return_counts=True)
        values_new, first_new, counts_new = np.unique(keys[1], return_index=True, return_counts=True)
        _, at_old, at_new = np.intersect1d(values_old, values_new, assume_unique=True, return_indices=True)
        single = (counts_old[at_old] == 1) & (counts_new[at_new] == 1)
        picked_old, picked_new = first_old[at_old[single]], first_new[at_new[single]]
        firsts.append(in_old[picked_old])
        seconds.append(in_new[picked_new])
        in_old, in_new = np.delete(in_old, picked_old), np.delete(in_new, picked_new)
    return np.concatenate(firsts), np.concatenate(seconds)


def _bead_keys(rows: TraceRows, *, reverse: bool) -> Places:
    """Return a number for each bead that is equal for equal ends and heights."""
    start, end = (rows.end, rows.start) if reverse else (rows.start, rows.end)
    columns = np.column_stack([start[:, :2], end])
    return np.asarray((np.rint(np.nan_to_num(columns) / UNIT).astype(np.int64) * _PRIMES).sum(axis=1))


def _rows_of(rows: TraceRows, begin: Places, end: Places) -> tuple[Places, Places]:
    """Return the rows of some ranges that lay filament, and their ranges."""
    counts = end - begin
    if not len(counts) or not counts.sum():
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    gap, place = next(expand_rows(counts))
    row = begin[gap] + place
    draws = rows.draws[row]
    return row[draws], gap[draws]


def compare_gaps(old: TraceRows, new: TraceRows, alignment: Alignment, paired: tuple[Places, Places]) -> GapBeads:
    """Measure the beads of the gaps against each other, without those that are `paired` already."""
    gaps = alignment.gaps
    in_old, old_gap = _rows_of(old, gaps.old, gaps.old_end)
    in_new, new_gap = _rows_of(new, gaps.new, gaps.new_end)
    keep_old, keep_new = ~np.isin(in_old, paired[0]), ~np.isin(in_new, paired[1])
    in_old, old_gap, in_new, new_gap = in_old[keep_old], old_gap[keep_old], in_new[keep_new], new_gap[keep_new]
    beads = old.at(in_old), new.at(in_new)
    bounds = [np.searchsorted(gap, np.arange(len(gaps) + 1)) for gap in (old_gap, new_gap)]
    old_off, _, _ = _distances_to(beads[0], old_gap, beads[1], bounds[1])
    new_off, nearest, neighbours = _distances_to(beads[1], new_gap, beads[0], bounds[0])
    return GapBeads(
        old=in_old,
        new=in_new,
        old_gap=old_gap,
        new_gap=new_gap,
        old_off=old_off,
        new_off=new_off,
        nearest=np.where(nearest < 0, -1, in_old[np.maximum(nearest, 0)] if len(in_old) else -1),
        neighbours=np.column_stack([in_new[neighbours[:, 0]], in_old[neighbours[:, 1]]]),
    )


def _distances_to(beads: TraceRows, gap: Places, others: TraceRows, bounds: Places) -> tuple[Floats, Places, Places]:
    """Measure beads against the others of their gap.

    Returns
    -------
    off : (N,) float64
        Greatest distance of the ends and the middle of each bead, mm.
    nearest : (N,) int64
        The other bead nearest to its middle.
    neighbours : (K, 2) int64
        Beads and other beads near its middle.
    """
    off, nearest = np.full(len(beads), np.inf), np.full(len(beads), -1)
    neighbours = [np.empty((0, 2), dtype=np.int64)]
    sizes = np.diff(bounds)
    large = np.flatnonzero(np.bincount(gap, minlength=len(sizes)) * sizes > LARGE_GAP)
    counts = sizes[gap] if len(beads) else np.empty(0, dtype=np.int64)
    for number in large.tolist():
        inside = np.flatnonzero(gap == number)
        off[inside], nearest[inside] = _measure_large_gap(beads.at(inside), others, slice(*bounds[number : number + 2]))
        neighbours.append(np.column_stack([inside, nearest[inside]]))
        counts[inside] = 0
    middle = (beads.start + beads.end)[:, :2] / 2
    for bead, place in expand_rows(counts, MOST_AT_ONCE):
        other = bounds[gap[bead]] + place
        opens = np.flatnonzero(np.diff(bead, prepend=-1))
        owner = bead[opens]
        start, end = others.start[other, :2], others.end[other, :2]
        worst = np.zeros(len(owner))
        for point in (beads.start[:, :2], beads.end[:, :2], middle):
            distance = segment_distances(point[bead], start, end)
            worst = np.maximum(worst, np.minimum.reduceat(distance, opens))
        off[owner] = worst
        least = np.repeat(np.minimum.reduceat(distance, opens), np.diff(np.append(opens, len(bead))))  # of the middle
        near = np.flatnonzero(distance <= least + NEAR)
        neighbours.append(np.column_stack([bead[near], other[near]]))
        best = np.flatnonzero(distance == least)
        nearest[bead[best[::-1]]] = other[best[::-1]]
    return off, nearest, np.concatenate(neighbours)


def _measure_large_gap(beads: TraceRows, others: TraceRows, inside: slice) -> tuple[Floats, Places]:
    """Return the greatest distance of each bead from the nearest of many others, and that one for its middle."""
    import shapely

    ends = np.nan_to_num(np.stack([others.start[inside, :2], others.end[inside, :2]], axis=1))
    tree = shapely.STRtree(shapely.linestrings(ends))
    worst = np.zeros(len(beads))
    nearest = np.empty(len(beads), dtype=np.int64)
    for point in (beads.start[:, :2], beads.end[:, :2], (beads.start + beads.end)[:, :2] / 2):
        nearest = tree.nearest(shapely.points(np.nan_to_num(point)))
        worst = np.maximum(worst, segment_distances(point, ends[nearest, 0], ends[nearest, 1]))
    return worst, nearest + inside.start
