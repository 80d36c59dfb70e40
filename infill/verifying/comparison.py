"""The moves of two prints in pairs, outside the features that may change."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Places
from infill.verifying.alignment import Alignment, align, distances
from infill.verifying.gap_paths import GapBeads, compare_gaps, pair_reordered
from infill.verifying.tolerances import PATH_TOLERANCE
from infill.verifying.trace import Trace, TraceRows


@dataclass(frozen=True, kw_only=True)
class BeadComparison:
    """Two prints and their moves in pairs.

    Parameters
    ----------
    old, new : Trace
    a, b : TraceRows
        Rows of the old and of the new print that are compared: all but those of features that may change.
    old_rows, new_rows : (N,) and (M,) int64
        Their places in the prints.
    alignment : Alignment
        Of `a` and `b`.
    gaps : GapBeads
        Beads without a partner, as paths.
    first, second : (P,) int64
        Rows of `a` and `b` in pairs: those in order first, then beads that are printed in another order.
    skipped : (G,) bool
        Gaps that cannot be compared, for a line in them that cannot be read.
    bad : (G,) bool
        Gaps with new beads that do not lie on old ones.
    """

    old: Trace
    new: Trace
    a: TraceRows
    b: TraceRows
    old_rows: Places
    new_rows: Places
    alignment: Alignment
    gaps: GapBeads
    first: Places
    second: Places
    skipped: NDArray[np.bool_]
    bad: NDArray[np.bool_]

    @property
    def both_draw(self) -> NDArray[np.bool_]:
        """True for pairs of beads."""
        return np.asarray(self.a.draws[self.first] & self.b.draws[self.second])

    @property
    def has_partner(self) -> NDArray[np.bool_]:
        """True for rows of `a` that the new print has, or that lay no filament, (N,)."""
        has = ~self.a.draws
        has[self.first] = True
        has[self.gaps.old[self.gaps.old_off <= PATH_TOLERANCE]] = True
        return has

    @property
    def lengths(self) -> tuple[float, float]:
        """Length of the old beads that are compared, and of those that the new print has in the same place, mm."""
        a, b = self.a, self.b
        near = distances(a.end[self.first, :2], b.end[self.second, :2]) <= PATH_TOLERANCE
        near[len(self.alignment.old) :] = True  # in another order, and perhaps in the other direction
        agrees = np.zeros(len(a), dtype=bool)
        agrees[self.first[near & b.draws[self.second]]] = True
        agrees[self.gaps.old[self.gaps.old_off <= PATH_TOLERANCE]] = True
        length = np.nan_to_num(a.length)
        return float(length[a.draws].sum()), float(length[a.draws & agrees].sum())

    def new_line_after(self, row: int) -> int:
        """Return the line of the new print that follows its last move before a row of `a`."""
        paired = self.alignment.old
        place = int(np.searchsorted(paired, row))
        if place < len(paired):
            before = int(self.alignment.new[place - 1]) + 1 if place else 0
            return int(self.b.line[min(before, int(self.alignment.new[place]))])
        return self.new.lines


def compare_beads(old: Trace, new: Trace, changed: Collection[str]) -> BeadComparison:
    """Pair the moves of two prints, without those of the features in `changed`."""
    old_rows, new_rows = (np.flatnonzero(~is_changed(trace, changed)) for trace in (old, new))
    a, b = (
        trace.rows if len(rows) == len(trace.rows) else trace.rows.at(rows)
        for trace, rows in ((old, old_rows), (new, new_rows))
    )
    alignment = align(a, b)
    reordered = pair_reordered(a, b, alignment)
    gaps = compare_gaps(a, b, alignment, reordered)
    skipped = _find_unread_gaps((old, new), (a, b), alignment)
    bad = np.zeros(len(skipped), dtype=bool)
    bad[gaps.new_gap[gaps.new_off > PATH_TOLERANCE]] = True
    return BeadComparison(
        old=old,
        new=new,
        a=a,
        b=b,
        old_rows=old_rows,
        new_rows=new_rows,
        alignment=alignment,
        gaps=gaps,
        first=np.concatenate([alignment.old, reordered[0]]),
        second=np.concatenate([alignment.new, reordered[1]]),
        skipped=skipped,
        bad=bad & ~skipped,
    )


def is_changed(trace: Trace, changed: Collection[str]) -> NDArray[np.bool_]:
    """Return True for the rows of features that the post-processor is meant to change."""
    return np.asarray(np.array([role in changed for role in trace.roles], dtype=bool)[trace.rows.role])


def _find_unread_gaps(
    traces: tuple[Trace, Trace], rows: tuple[TraceRows, TraceRows], alignment: Alignment
) -> NDArray[np.bool_]:
    """Return the gaps in which either print has a line that cannot be read."""
    gaps = alignment.gaps
    unread = np.zeros(len(gaps), dtype=bool)
    ranges = (gaps.old, gaps.old_end), (gaps.new, gaps.new_end)
    for trace, compared, (begin, end) in zip(traces, rows, ranges, strict=True):
        lines = np.array([line for line, _ in trace.unread])
        if not len(lines) or not len(compared):
            continue
        low = np.where(begin > 0, compared.line[np.maximum(begin - 1, 0)], 0)
        high = np.where(end < len(compared), compared.line[np.minimum(end, len(compared) - 1)], trace.lines + 1)
        unread |= np.searchsorted(lines, high) > np.searchsorted(lines, low)
    return unread
