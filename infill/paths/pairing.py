"""Choose the gaps of an outline to walk: as many as possible, the short ones first, so that long open paths result.

Step 1. Greedily: the shortest gap first, unless one of its ends is taken or it would close a loop; supported gaps
        come before all others.
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

EQUAL_LENGTH = 0.02  # mm: gaps that differ by less count as equally long


def choose_gaps(gaps: Gaps, paths: int, *, most: float, overlapping: float, held: Chosen | None = None) -> Chosen:
    """Choose the gaps to walk, (G,) bool.

    Parameters
    ----------
    gaps : Gaps
    paths : int
        Number of paths.
    most : float
        Longer gaps are not walked, mm.
    overlapping : float
        Gaps whose ends are closer than this may close a loop, mm.
    held : (G,) bool, optional
        Gaps that are supported by the layer below.
    """
    possible = gaps.clear & (gaps.length <= most) & (gaps.begin != gaps.end)
    may_close = possible & (gaps.across < overlapping) & (gaps.length < 2 * overlapping)
    walked = np.zeros(len(possible), dtype=bool)
    used_ends: set[int] = set()
    group = list(range(paths))
    order = np.flatnonzero(possible)
    later = np.zeros(len(possible), dtype=bool) if held is None else ~held
    # Equally long gaps keep their order along the ring: on either side of a row of equal paths, all of one side come
    # first.
    length = np.rint(np.where(may_close, gaps.across, gaps.length) / EQUAL_LENGTH)
    order = order[np.lexsort((length[order], (later & ~may_close)[order], ~may_close[order]))]
    begins, ends = gaps.begin.tolist(), gaps.end.tolist()
    for gap in order.tolist():
        begin, end = begins[gap], ends[gap]
        if begin in used_ends or end in used_ends or not (_unite(group, begin, end) or may_close[gap]):
            continue
        used_ends |= {begin, end}
        walked[gap] = True
    for ring in np.unique(gaps.ring):
        _augment(gaps, np.flatnonzero(gaps.ring == ring), possible, may_close, walked, paths)
    return walked


def _augment(gaps: Gaps, ring: NDArray[np.intp], possible: Chosen, free: Chosen, walked: Chosen, paths: int) -> None:
    """Walk one more gap, in `walked`, between each two free ends of a ring, wherever that closes no loop."""
    for start in range(len(ring)):
        if walked[ring[start]] or walked[ring[start - 1]]:
            continue
        gap = np.roll(ring, -start)
        inside = walked[gap]
        # The end before a gap is free if neither gap beside it is walked; so is the end between two that are not.
        is_free_end = ~inside[1:] & ~inside[:-1]
        if not is_free_end.any():
            continue
        run = gap[: int(is_free_end.argmax()) + 1]
        if possible[run[::2]].all():
            walked[run] = ~walked[run]
            if not _is_acyclic(gaps, walked & ~free, paths):
                walked[run] = ~walked[run]


def _is_acyclic(gaps: Gaps, walked: Chosen, paths: int) -> bool:
    """Tell whether walked gaps join paths without a loop."""
    group = list(range(paths))
    return all(
        _unite(group, begin, end)
        for begin, end in zip(gaps.begin[walked].tolist(), gaps.end[walked].tolist(), strict=True)
    )


def _unite(group: list[int], begin: int, end: int) -> bool:
    """Unite the groups of two ends' paths, in `group`; return False if they are already united."""
    begin_root, end_root = _find_root(group, begin // 2), _find_root(group, end // 2)
    group[begin_root] = end_root
    return begin_root != end_root


def _find_root(group: list[int], path: int) -> int:
    """Return the representative of all paths that are joined to `path`."""
    while group[path] != path:
        group[path] = group[group[path]]
        path = group[path]
    return path
