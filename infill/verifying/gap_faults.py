"""Faults of beads without a partner, compared as paths: place, height, filament, speed, settings."""

from __future__ import annotations

from typing import Final

import numpy as np

from infill.arrays import Flags, Floats, Places
from infill.plain_numbers import plain_argument
from infill.verifying.comparison import BeadComparison
from infill.verifying.setting_faults import add_settings, settings_codes
from infill.verifying.tolerances import (
    DEPTH_TOLERANCE,
    FILAMENT_STEP,
    HEIGHT_TOLERANCE,
    PATH_TOLERANCE,
    SPEED_STEP,
    UNIT,
)
from infill.verifying.violations import ViolationList, describe_lengths, describe_place, describe_speeds

POINT_FILAMENT: Final = 0.05  # mm on a bead as short as the tolerance, which may be without a partner
SAME_COURSE: Final = 3 * PATH_TOLERANCE  # mm between two beads that come as far along their gap
GAP_SHARE: Final = 0.06  # of the filament in a gap: fitters of arcs join beads that differ by 5 %
LENGTH_SHARE, LENGTH_STEP = 0.02, 0.3  # of the beads in a gap, and mm, that an arc in place of lines may be longer


def report_gaps(comparison: BeadComparison, speed_limit: float, found: ViolationList) -> None:
    """Compare beads without a partner as paths: place, height, filament, speed, settings."""
    gaps = comparison.gaps
    readable = ~comparison.skipped
    usable = readable[gaps.new_gap] if len(gaps.new) else np.zeros(0, dtype=bool)
    off = (gaps.new_off > PATH_TOLERANCE) & usable
    point = (comparison.b.length[gaps.new] <= PATH_TOLERANCE) & (comparison.b.filament[gaps.new] <= POINT_FILAMENT)
    off &= ~(np.isinf(gaps.new_off) & point)  # a point of a bead, which an arc passes by
    rows, off_by = gaps.new[off], gaps.new_off[off]
    for kind, chosen in (("added", np.isinf(off_by)), ("place", np.isfinite(off_by))):
        places, apart = rows[chosen], off_by[chosen]

        def describe_bead(k: int, kind: str = kind, places: Places = places, apart: Floats = apart) -> str:
            """Describe a bead that is new, or how far it lies from the old ones."""
            text = describe_place(comparison.b.end[places[k]])
            return f"a bead to {text} is new" if kind == "added" else f"{text}, {apart[k]:.2f} mm beside the old bead"

        found.add_runs(kind, comparison.new_rows[places], describe_bead)
    lies = usable & ~off & (gaps.nearest >= 0)
    near, rows = gaps.nearest[lies], gaps.new[lies]
    rise = np.abs(comparison.a.end[near, 2] - comparison.b.end[rows, 2])
    high = np.flatnonzero(np.nan_to_num(rise) > 2 * HEIGHT_TOLERANCE)
    found.add_runs(
        "height",
        comparison.new_rows[rows[high]],
        lambda k: (
            f"z {plain_argument(round(comparison.b.end[rows[high[k]], 2], 4))} mm, was "
            f"{plain_argument(round(comparison.a.end[near[high[k]], 2], 4))} mm"
        ),
        comparison.a.line[near[high]],
    )
    _compare_gap_sums(comparison, found)
    _compare_neighbours(comparison, speed_limit, found, rows)


def _compare_gap_sums(comparison: BeadComparison, found: ViolationList) -> None:
    """Compare the filament of gaps whose beads lie on each other."""
    gaps, count = comparison.gaps, len(comparison.alignment.gaps)
    was = np.bincount(gaps.old_gap, weights=comparison.a.filament[gaps.old], minlength=count)
    lengths = [
        np.bincount(gap, weights=rows.length[chosen], minlength=count)
        for gap, rows, chosen in ((gaps.old_gap, comparison.a, gaps.old), (gaps.new_gap, comparison.b, gaps.new))
    ]
    was = was * np.where(lengths[0] > 0, lengths[1] / np.where(lengths[0] > 0, lengths[0], 1.0), 1.0)
    now = np.bincount(gaps.new_gap, weights=comparison.b.filament[gaps.new], minlength=count)
    beads = np.bincount(gaps.old_gap, minlength=count) + np.bincount(gaps.new_gap, minlength=count)
    lost = np.bincount(gaps.old_gap[gaps.old_off > PATH_TOLERANCE], minlength=count) > 0
    slack = 2 * PATH_TOLERANCE * was / np.where(lengths[1] > 0, lengths[1], 1.0)
    wrong = np.abs(now - was) > GAP_SHARE * was + FILAMENT_STEP * np.sqrt(np.maximum(beads, 1)) + slack
    usable = ~comparison.bad & ~lost & ~comparison.skipped & (now > 0)
    longer = usable & (lengths[1] - lengths[0] > LENGTH_SHARE * lengths[0] + LENGTH_STEP)
    again = np.flatnonzero(longer)
    found.add_runs(
        "added",
        comparison.new_rows[gaps.new[np.searchsorted(gaps.new_gap, again)]],
        lambda k: f"{lengths[1][again[k]]:.1f} mm of beads on each other, was {lengths[0][again[k]]:.1f} mm",
    )
    _compare_gap_courses(comparison, found, usable & ~wrong & ~longer)
    numbers = np.flatnonzero(wrong & usable & ~longer)
    rows = gaps.new[np.searchsorted(gaps.new_gap, numbers)]
    found.add_runs(
        "material",
        comparison.new_rows[rows],
        lambda k: describe_lengths(now[numbers[k]], was[numbers[k]], "of filament"),
        comparison.a.line[gaps.old[np.searchsorted(gaps.old_gap, numbers)]],
    )


def _compare_gap_courses(comparison: BeadComparison, found: ViolationList, usable: Flags) -> None:
    """Compare the filament bead by bead in gaps that follow the same course: one bead may have what another lacks."""
    gaps, count = comparison.gaps, len(comparison.alignment.gaps)
    old, new = comparison.a.at(gaps.old), comparison.b.at(gaps.new)
    if not len(old) or not len(new):
        return
    knots = np.maximum.accumulate(_shares_of_way(old.length, gaps.old_gap, count).ravel())
    begin, end = _shares_of_way(new.length, gaps.new_gap, count).T
    pushed = np.cumsum(old.filament)
    pushed = np.column_stack([pushed - old.filament, pushed]).ravel()
    was = np.interp(end, knots, pushed) - np.interp(begin, knots, pushed)
    aside = np.zeros(len(new))
    for places, at in ((new.start, begin), (new.end, end)):
        course = np.stack([old.start[:, :2], old.end[:, :2]], axis=1).reshape(-1, 2)
        there = np.column_stack([np.interp(at, knots, course[:, axis]) for axis in (0, 1)])
        aside = np.maximum(aside, np.hypot(*(places[:, :2] - there).T))
    both = np.bincount(gaps.old_gap, minlength=count) > 0
    astray = np.bincount(gaps.new_gap, weights=~(aside <= SAME_COURSE), minlength=count) > 0
    slack = 2 * PATH_TOLERANCE * was / np.maximum(new.length, UNIT) + 2 * FILAMENT_STEP
    wrong = np.abs(new.filament - was) > GAP_SHARE * was + slack
    beads = np.flatnonzero(wrong & (usable & both & ~astray)[gaps.new_gap])
    found.add_runs(
        "material",
        comparison.new_rows[gaps.new[beads]],
        lambda k: describe_lengths(new.filament[beads[k]], was[beads[k]], "of filament"),
        comparison.a.line[gaps.nearest[beads]],
    )


def _shares_of_way(length: Floats, gap: Places, count: int) -> Floats:
    """Return where beads begin and end on the way through their gap, (N, 2): twice its number, and a share of it."""
    whole = np.bincount(gap, weights=length, minlength=count)[gap]
    passed = np.cumsum(length)
    before = (passed - length)[np.searchsorted(gap, gap)]  # where the gap begins
    ends = np.column_stack([passed - length - before, passed - before]) / np.maximum(whole, UNIT)[:, None]
    return np.asarray(2.0 * gap[:, None] + np.minimum(ends, 1.0))


def _compare_neighbours(comparison: BeadComparison, speed_limit: float, found: ViolationList, rows: Places) -> None:
    """Compare settings, retraction and speed of unpaired beads with any of the old beads where they lie."""
    new, old = comparison.gaps.neighbours.T
    kept = np.isin(new, rows)
    new, old = new[kept], old[kept]
    if not len(new):
        return
    begins = np.flatnonzero(np.diff(new, prepend=-1))
    fastest = np.maximum.reduceat(np.nan_to_num(comparison.a.feed[old], nan=np.inf), begins)
    owner, partner = new[begins], old[begins]
    now = comparison.b.feed[owner]
    faster = np.flatnonzero(now > fastest * (1 + speed_limit) + SPEED_STEP)
    found.add_runs(
        "speed",
        comparison.new_rows[owner[faster]],
        lambda k: describe_speeds(now[faster[k]], fastest[faster[k]]),
        comparison.a.line[partner[faster]],
    )
    depth = np.abs(comparison.a.retracted[old] - comparison.b.retracted[new])
    deep = np.flatnonzero(np.minimum.reduceat(depth, begins) > DEPTH_TOLERANCE)
    found.add_runs(
        "retraction",
        comparison.new_rows[owner[deep]],
        lambda k: describe_lengths(
            comparison.b.retracted[owner[deep[k]]], comparison.a.retracted[partner[deep[k]]], "retracted"
        ),
        comparison.a.line[partner[deep]],
    )
    codes = settings_codes(comparison.old, comparison.new)
    was = codes[0][comparison.old.settings_at(comparison.a.line[old])]
    now_set = codes[1][comparison.new.settings_at(comparison.b.line[new])]
    alike = np.logical_or.reduceat(was == now_set, begins)
    unlike = np.flatnonzero(~alike)
    add_settings(
        found,
        comparison.old,
        comparison.new,
        (
            comparison.old.settings_at(comparison.a.line[partner[unlike]]),
            comparison.new.settings_at(comparison.b.line[owner[unlike]]),
        ),
        comparison.new_rows[owner[unlike]],
        comparison.a.line[partner[unlike]],
    )
