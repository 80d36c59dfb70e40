"""Which move of the new print stands for which move of the old one.

Moves are compared by where they end, not by their lines: a script may number lines, change comments, draw arcs in place
of lines or print in another order. Layer by layer, ends that occur once in both prints are anchors if they come in the
same order (patience diff); equal ends beside an anchor follow it. What is left between two anchors is a gap, which is
compared as a path.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.verifying.tolerances import PATH_TOLERANCE, UNIT
from infill.verifying.trace import TraceRows

SPIRAL_SHARE: Final = 0.25  # of the beads: as many changes of height mean a spiral, which has no layers
ALIKE_SHARE: Final = 0.5  # of the moves in a gap of equal counts that must agree, so that these are paired in order
_WIDE: Final = np.int64(1) << 31


@dataclass(frozen=True, kw_only=True)
class Gaps:
    """Stretches of moves without a partner: rows `old` to `old_end` of one print, `new` to `new_end` of the other.

    Parameters
    ----------
    old, old_end, new, new_end : (G,) int64
        Ends are exclusive.
    """

    old: Places
    old_end: Places
    new: Places
    new_end: Places

    def __len__(self) -> int:
        return len(self.old)


@dataclass(frozen=True, kw_only=True)
class Alignment:
    """Moves of two prints in pairs, and what is left.

    Parameters
    ----------
    old, new : (P,) int64
        Rows in pairs, ascending in `old` except where the order of printing changed.
    gaps : Gaps
    missing, added : tuple of (int, int)
        Ranges of rows of layers that only the old print, or only the new one, has.
    """

    old: Places
    new: Places
    gaps: Gaps
    missing: tuple[tuple[int, int], ...]
    added: tuple[tuple[int, int], ...]


def align(old: TraceRows, new: TraceRows) -> Alignment:
    """Pair the moves of two prints."""
    keys = _end_keys(old), _end_keys(new)
    if len(old) == len(new) and np.array_equal(keys[0], keys[1]):
        every = np.arange(len(old))
        pairs, blocks = [(every, every)], [(0, len(old), 0, len(new))]
        missing: list[tuple[int, int]] = []
        added: list[tuple[int, int]] = []
    else:
        blocks, missing, added = _pair_layers(old, new)
        pairs = []
        for a, a_end, b, b_end in blocks:
            in_old, in_new = _align_keys(keys[0][a:a_end], keys[1][b:b_end])
            pairs.append((in_old + a, in_new + b))
    return _collect(old, new, pairs, blocks, missing, added)


def _end_keys(rows: TraceRows) -> Places:
    """Return a number for the end of each move that is equal for equal x and y, to `UNIT`."""
    place = np.rint(np.nan_to_num(rows.end[:, :2], nan=-1e6) / UNIT).astype(np.int64)
    return np.asarray(place[:, 0] * _WIDE + place[:, 1])


def _pair_layers(
    old: TraceRows, new: TraceRows
) -> tuple[list[tuple[int, int, int, int]], list[tuple[int, int]], list[tuple[int, int]]]:
    """Pair the layers of two prints by their tags or, where these differ, by their heights.

    Returns
    -------
    blocks : list of (int, int, int, int)
        Begin and end of each layer in both prints.
    missing, added : list of (int, int)
        Begin and end of the layers that only the old print, or only the new one, has.
    """
    starts = [_tagged_starts(rows) for rows in (old, new)]
    levels = [rows.layer[begin[:-1]] for rows, begin in zip((old, new), starts, strict=True)]
    tagged = len(levels[0]) > 1 and np.array_equal(levels[0], levels[1])
    if not tagged:
        starts = [_height_starts(rows) for rows in (old, new)]
        counts = [(len(begin) - 1) / max(len(rows), 1) for rows, begin in zip((old, new), starts, strict=True)]
        if max(counts) > SPIRAL_SHARE:
            starts = [np.array([0, len(rows)]) for rows in (old, new)]
    ranges = [list(zip(begin[:-1].tolist(), begin[1:].tolist(), strict=True)) for begin in starts]
    places = [[] if tagged else _layer_places(rows, begin) for rows, begin in zip((old, new), starts, strict=True)]
    if tagged or places[0] == places[1]:
        return [(*first, *second) for first, second in zip(*ranges, strict=True)], [], []
    pairs = _pair_places(places[0], places[1])
    taken = [{pair[side] for pair in pairs} for side in (0, 1)]
    missing, added = ([layer for k, layer in enumerate(ranges[side]) if k not in taken[side]] for side in (0, 1))
    return [(*ranges[0][first], *ranges[1][second]) for first, second in pairs], missing, added


def _pair_places(old: list[tuple[int, ...]], new: list[tuple[int, ...]]) -> list[tuple[int, int]]:
    """Pair layers in order by height and place; those in between by height alone, or one by one if they are as many.

    >>> _pair_places([(1, 1, 200), (5, 5, 400), (1, 1, 600)], [(1, 1, 200), (1, 1, 600)])
    [(0, 0), (2, 1)]
    """
    pairs: list[tuple[int, int]] = []
    for word, a, a_end, b, b_end in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if word == "equal" or a_end - a == b_end - b:
            pairs += zip(range(a, a_end), range(b, b_end), strict=True)
            continue
        heights = [place[-1] for place in old[a:a_end]], [place[-1] for place in new[b:b_end]]
        for first, second, count in SequenceMatcher(None, *heights, autojunk=False).get_matching_blocks():
            pairs += zip(range(a + first, a + first + count), range(b + second, b + second + count), strict=True)
    return pairs


def _tagged_starts(rows: TraceRows) -> Places:
    """Return the first row of each tagged layer, and the number of rows."""
    return np.concatenate([[0], np.flatnonzero(np.diff(rows.layer)) + 1, [len(rows)]]).astype(np.int64)


def _height_starts(rows: TraceRows) -> Places:
    """Return the first row of each run of beads at one height, and the number of rows."""
    draws = np.flatnonzero(rows.draws)
    z = np.rint(np.nan_to_num(rows.end[draws, 2]) / UNIT)
    begins = draws[1:][np.diff(z) != 0]
    return np.concatenate([[0], begins, [len(rows)]]).astype(np.int64)


def _layer_places(rows: TraceRows, starts: Places) -> list[tuple[int, ...]]:
    """Return where the first bead of each layer ends: x and y to the millimetre, z in units.

    Objects that are printed one after the other have the same heights in other places.
    """
    draws = np.append(np.flatnonzero(rows.draws), len(rows) - 1)
    first = draws[np.searchsorted(draws[:-1], starts[:-1])]
    place = np.rint(np.nan_to_num(rows.end[first]) / [1.0, 1.0, UNIT]).astype(np.int64)
    return list(map(tuple, place.tolist()))


def _align_keys(old: Places, new: Places) -> tuple[Places, Places]:
    """Pair equal keys of two sequences in order."""
    length = min(len(old), len(new))
    differs = np.flatnonzero(old[:length] != new[:length])
    head = int(differs[0]) if len(differs) else length
    if head == len(old) == len(new):
        return np.arange(head), np.arange(head)
    length -= head
    differs = np.flatnonzero(old[len(old) - length :][::-1] != new[len(new) - length :][::-1])
    tail = int(differs[0]) if len(differs) else length
    inner = (head, len(old) - tail, head, len(new) - tail)
    parts = [(np.arange(head), np.arange(head)), *_align_inner(old, new, inner)]
    parts.append((np.arange(len(old) - tail, len(old)), np.arange(len(new) - tail, len(new))))
    first, second = (np.concatenate(side) for side in zip(*parts, strict=True))
    return first.astype(np.int64), second.astype(np.int64)


def _align_inner(old: Places, new: Places, inner: tuple[int, int, int, int]) -> Iterator[tuple[Places, Places]]:
    """Yield pairs between anchors: keys that occur once in both, in the same order, and equal keys beside them."""
    a, a_end, b, b_end = inner
    anchors = _find_anchors(old[a:a_end], new[b:b_end])
    bounds = [(a - 1, b - 1), *((first + a, second + b) for first, second in anchors), (a_end, b_end)]
    for (before_a, before_b), (after_a, after_b) in pairwise(bounds):
        low_a, low_b = before_a + 1, before_b + 1
        count = min(after_a - low_a, after_b - low_b)
        if count > 0:
            differs = np.flatnonzero(old[low_a : low_a + count] != new[low_b : low_b + count])
            ahead = int(differs[0]) if len(differs) else count
            yield np.arange(low_a, low_a + ahead), np.arange(low_b, low_b + ahead)
            rest = count - ahead
            differs = np.flatnonzero(old[after_a - rest : after_a][::-1] != new[after_b - rest : after_b][::-1])
            back = int(differs[0]) if len(differs) else rest
            yield np.arange(after_a - back, after_a), np.arange(after_b - back, after_b)
        if after_a < a_end:
            yield np.array([after_a]), np.array([after_b])


def _find_anchors(old: Places, new: Places) -> list[tuple[int, int]]:
    """Return the places of keys that occur once in both sequences, as far as they come in the same order."""
    singles = []
    for keys in (old, new):
        values, first, counts = np.unique(keys, return_index=True, return_counts=True)
        singles.append((values[counts == 1], first[counts == 1]))
    _, at_old, at_new = np.intersect1d(singles[0][0], singles[1][0], assume_unique=True, return_indices=True)
    in_old, in_new = singles[0][1][at_old], singles[1][1][at_new]
    order = np.argsort(in_old)
    in_old, in_new = in_old[order], in_new[order]
    kept = longest_rise(in_new.tolist())
    return list(zip(in_old[kept].tolist(), in_new[kept].tolist(), strict=True))


def longest_rise(values: list[int]) -> list[int]:
    """Return the places of a longest ascending subsequence of distinct numbers.

    >>> longest_rise([3, 0, 1, 5, 2])
    [1, 2, 4]
    """
    tops: list[int] = []
    places: list[int] = []
    before: list[int] = []
    for place, value in enumerate(values):
        k = bisect_left(tops, value)
        before.append(places[k - 1] if k else -1)
        if k == len(tops):
            tops.append(value)
            places.append(place)
        else:
            tops[k], places[k] = value, place
    chain = []
    place = places[-1] if places else -1
    while place >= 0:
        chain.append(place)
        place = before[place]
    return chain[::-1]


def _collect(
    old: TraceRows,
    new: TraceRows,
    pairs: list[tuple[Places, Places]],
    blocks: list[tuple[int, int, int, int]],
    missing: list[tuple[int, int]],
    added: list[tuple[int, int]],
) -> Alignment:
    """Find the gaps between pairs; pair the moves of a gap in order where most of their ends agree."""
    kept: list[tuple[Places, Places]] = []
    gaps: list[tuple[int, int, int, int]] = []
    for (first, second), (a, a_end, b, b_end) in zip(pairs, blocks, strict=True):
        joined = np.zeros(len(first), dtype=bool)
        if len(first):
            joined = _starts_agree(old, new, first, second)
        edge_a, edge_b = a, b
        loose = np.flatnonzero(~joined)
        # A bead whose start differs belongs to the gap before it.
        jumps = (np.diff(first, prepend=a - 1) > 1) | (np.diff(second, prepend=b - 1) > 1)
        opens = np.union1d(np.flatnonzero(jumps), loose) if len(first) else np.empty(0, dtype=np.int64)
        dropped = np.zeros(len(first), dtype=bool)
        for k in opens.tolist():
            edge_a, edge_b = (a, b) if k == 0 else (int(first[k - 1]) + 1, int(second[k - 1]) + 1)
            if joined[k]:
                gaps.append((edge_a, int(first[k]), edge_b, int(second[k])))
            elif first[k] > edge_a or second[k] > edge_b:
                dropped[k] = True
                gaps.append((edge_a, int(first[k]) + 1, edge_b, int(second[k]) + 1))
        last_a, last_b = (int(first[-1]) + 1, int(second[-1]) + 1) if len(first) else (a, b)
        if last_a < a_end or last_b < b_end:
            gaps.append((last_a, a_end, last_b, b_end))
        kept.append((first[~dropped], second[~dropped]))
    in_order, rest = _pair_in_order(old, new, gaps)
    kept += in_order
    ends = [np.concatenate(side) if kept else np.empty(0) for side in zip(*kept, strict=True)] or [np.empty(0)] * 2
    columns = np.array(rest, dtype=np.int64).reshape(-1, 4).T
    order = np.argsort(ends[0], kind="stable")
    return Alignment(
        old=ends[0][order].astype(np.int64),
        new=ends[1][order].astype(np.int64),
        gaps=Gaps(old=columns[0], old_end=columns[1], new=columns[2], new_end=columns[3]),
        missing=tuple(missing),
        added=tuple(added),
    )


def _starts_agree(old: TraceRows, new: TraceRows, first: Places, second: Places) -> NDArray[np.bool_]:
    """Return True for pairs that begin at the same place, or of which neither lays filament."""
    distance = distances(old.start[first, :2], new.start[second, :2])
    return np.asarray((distance <= PATH_TOLERANCE) | ~(old.draws[first] | new.draws[second]))


def distances(old: Floats, new: Floats) -> Floats:
    """Return the distances between points; 0 where both are unknown."""
    distance = np.sqrt(((old - new) ** 2).sum(axis=1))
    return np.where(
        np.isnan(distance) & (np.isnan(old) == np.isnan(new)).all(axis=1), 0.0, np.nan_to_num(distance, nan=np.inf)
    )


def _pair_in_order(
    old: TraceRows, new: TraceRows, gaps: list[tuple[int, int, int, int]]
) -> tuple[list[tuple[Places, Places]], list[tuple[int, int, int, int]]]:
    """Pair the moves of gaps with equal counts that agree to the tolerance, if most do; return what is left."""
    pairs, rest = [], []
    for a, a_end, b, b_end in gaps:
        count = a_end - a
        agree = np.zeros(count, dtype=bool)
        if count == b_end - b and count:
            first, second = np.arange(a, a_end), np.arange(b, b_end)
            agree = distances(old.end[first, :2], new.end[second, :2]) <= PATH_TOLERANCE
            agree &= _starts_agree(old, new, first, second)
        if not count or agree.mean() < ALIKE_SHARE:
            rest.append((a, a_end, b, b_end))
            continue
        pairs.append((first[agree], second[agree]))
        edges = np.flatnonzero(np.diff(np.concatenate([[True], agree, [True]])))
        rest += [(a + low, a + high, b + low, b + high) for low, high in edges.reshape(-1, 2).tolist()]
    return pairs, rest
