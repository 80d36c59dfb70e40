"""Which gaps of an outline are walked: as many as possible, the short ones first, so that long open paths result.

Step 1. Greedily: the shortest gap first, unless one of its ends is taken or it would close a loop; gaps that would lie
        on something before all others.
Step 2. Where two free ends of a ring have only walked pairs between them, walk the gaps beside those instead: ::

        o   o---o   o---o   o      two gaps walked, two ends free
        o---o   o---o   o---o      three gaps walked

A gap so short that beads from its ends would overlap is walked even if that closes a loop.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.paths.gaps import Gaps

Chosen = NDArray[np.bool_]

ALIKE = 0.02  # mm: gaps that differ by less are as long as one another


def walked_gaps(gaps: Gaps, paths: int, *, most: float, overlapping: float, held: Chosen | None = None) -> Chosen:
    """Return which gaps are walked, (G,) bool.

    Parameters
    ----------
    gaps : Gaps
    paths : int
        How many paths there are.
    most : float
        Longer gaps are not walked, mm.
    overlapping : float
        Gaps whose ends are nearer than this may close a loop, mm.
    held : (G,) bool, optional
        Gaps along which there is something below.
    """
    possible = gaps.clear & (gaps.length <= most) & (gaps.begin != gaps.end)
    free = possible & (gaps.across < overlapping) & (gaps.length < 2 * overlapping)
    walked = np.zeros(len(possible), dtype=bool)
    taken: set[int] = set()
    group = list(range(paths))
    order = np.flatnonzero(possible)
    later = np.zeros(len(possible), dtype=bool) if held is None else ~held
    # Of gaps as long as one another, those that follow one another along the ring: on either side of a row of equal
    # paths, all of one side come first.
    length = np.rint(np.where(free, gaps.across, gaps.length) / ALIKE)
    order = order[np.lexsort((length[order], (later & ~free)[order], ~free[order]))]
    begins, ends = gaps.begin.tolist(), gaps.end.tolist()
    for gap in order.tolist():
        begin, end = begins[gap], ends[gap]
        if begin in taken or end in taken or not (_unite(group, begin, end) or free[gap]):
            continue
        taken |= {begin, end}
        walked[gap] = True
    for ring in np.unique(gaps.ring):
        _augment(gaps, np.flatnonzero(gaps.ring == ring), possible, free, walked, paths)
    return walked


def _augment(gaps: Gaps, ring: NDArray[np.intp], possible: Chosen, free: Chosen, walked: Chosen, paths: int) -> None:
    """Walk one gap more in `walked`, between each two free ends of a ring, wherever that closes no loop."""
    for first in range(len(ring)):
        gap = np.roll(ring, -first)
        inside = walked[gap]
        # The end before a gap is free if neither gap beside it is walked; so is the end between two that are not.
        both = ~inside[1:] & ~inside[:-1]
        if inside[0] or inside[-1] or not both.any():
            continue
        run = gap[: int(both.argmax()) + 1]
        if possible[run[::2]].all():
            walked[run] = ~walked[run]
            if not _acyclic(gaps, walked & ~free, paths):
                walked[run] = ~walked[run]


def _acyclic(gaps: Gaps, walked: Chosen, paths: int) -> bool:
    """Return whether walked gaps join paths without a loop."""
    group = list(range(paths))
    return all(
        _unite(group, begin, end)
        for begin, end in zip(gaps.begin[walked].tolist(), gaps.end[walked].tolist(), strict=True)
    )


def _unite(group: list[int], begin: int, end: int) -> bool:
    """Unite the groups of two ends' paths, in `group`; return False if they are one already."""
    one, other = _root(group, begin // 2), _root(group, end // 2)
    group[one] = other
    return one != other


def _root(group: list[int], path: int) -> int:
    """Return the path that stands for all that are joined to `path`."""
    while group[path] != path:
        group[path] = group[group[path]]
        path = group[path]
    return path
