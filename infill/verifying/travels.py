"""Travels through what stands: moves without filament that the old print made over it, and the new one does not."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.plain_numbers import plain_argument
from infill.verifying.comparison import BeadComparison
from infill.verifying.trace import TraceRows
from infill.verifying.violations import ViolationList

LIFT: Final = 0.02  # mm: a smaller one is none
TOUCH: Final = 0.01  # mm above the top of a bead, at which a nozzle still drags over it
COLLISION: Final = 0.05  # mm below the top of what stands
CLEAR: Final = 0.1  # mm at both ends of a travel, where it touches the beads that it joins
LONGER: Final = 1.05  # times the longest travel that the old print makes without a lift


def check_travels(comparison: BeadComparison, changed: NDArray[np.bool_], found: ViolationList) -> None:
    """Add the travels that go through beads without the lift that the old print has there.

    A travel with a partner in the old print must keep its lift where it crosses any bead. One without, such as those
    of `changed` rows, must have a lift where it crosses an unchanged bead, if the old print lifts all travels as long.
    """
    rows = comparison.new.rows
    floors = [_travel_heights(trace.rows) for trace in (comparison.old, comparison.new)]
    travels = ~rows.draws & (rows.length > 2 * CLEAR)
    was = np.full(len(rows), np.nan)
    was[comparison.new_rows[comparison.second]] = floors[0][comparison.old_rows[comparison.first]]
    paired = ~np.isnan(was)
    with np.errstate(invalid="ignore"):
        lowered = travels & paired & (floors[1] < was - LIFT)
    longest, lift = _longest_unlifted(comparison.old.rows, floors[0])
    unlifted = floors[1] <= _bead_heights(rows) + LIFT
    free = travels & ~paired & unlifted & (rows.length > LONGER * longest + CLEAR) & (lift > 0)
    sinks = travels & (lowered | ~paired) & (floors[1] < _highest_so_far(rows) - COLLISION)
    beads = np.flatnonzero(rows.draws)
    for chosen, through_rows, depth, same_layer in (
        (lowered, beads, TOUCH, True),
        (free, beads[~changed[beads]], TOUCH, True),
        (sinks, beads, -COLLISION, False),
    ):
        candidates = np.flatnonzero(chosen)
        hit, through = _find_crossings(rows, candidates, through_rows, floors[1] - depth, same_layer=same_layer)
        hit, through = _without_known(hit, through, found)

        def describe_travel(k: int, hit: Places = hit, through: Places = through) -> str:
            """Describe a travel through a bead, and its old lift."""
            before = was[hit[k]] if paired[hit[k]] else floors[1][hit[k]] + lift
            return (
                f"travels at z {plain_argument(round(float(floors[1][hit[k]]), 3))} mm through the bead of line "
                f"{rows.line[through[k]]}, was lifted to {plain_argument(round(float(before), 3))} mm"
            )

        found.add_runs("travel", hit, describe_travel)


def _without_known(hit: Places, through: Places, found: ViolationList) -> tuple[Places, Places]:
    """Return the crossings of rows that are not reported already."""
    known = found.travels
    fresh = np.array([row not in known for row in hit.tolist()], dtype=bool)
    known.update(hit.tolist())
    return hit[fresh], through[fresh]


def _travel_heights(rows: TraceRows) -> Floats:
    """Return the lower of the heights at which each move begins and ends, mm."""
    return np.asarray(np.fmin(rows.start[:, 2], rows.end[:, 2]))


def _bead_heights(rows: TraceRows) -> Floats:
    """Return for each row the height of the beads before and after it, mm, of which the rise to a layer has the higher.

    NaN before the first bead.
    """
    draws = np.flatnonzero(rows.draws)
    if not len(draws):
        return np.full(len(rows), np.nan)
    after = np.searchsorted(draws, np.arange(len(rows)))
    before, following = (rows.end[draws[np.clip(at, 0, len(draws) - 1)], 2] for at in (after - 1, after))
    return np.where(after == 0, np.nan, np.fmax(before, following))


def _highest_so_far(rows: TraceRows) -> Floats:
    """Return for each row the greatest height of the beads before it, mm."""
    z = np.where(rows.draws, np.nan_to_num(rows.end[:, 2]), 0.0)
    return np.concatenate([[0.0], np.maximum.accumulate(z)[:-1]])[: len(rows)]


def _longest_unlifted(rows: TraceRows, floors: Floats) -> tuple[float, float]:
    """Return the length of the longest travel without a lift, and the median lift of the others; 0 without any."""
    above = floors - _bead_heights(rows)
    travels = ~rows.draws & np.isfinite(above) & (rows.length > 0)
    lifted = travels & (above > LIFT)
    lift = float(np.median(above[lifted])) if lifted.any() else 0.0
    return float(rows.length[travels & ~lifted].max(initial=0.0)), lift


def _find_crossings(
    rows: TraceRows, candidates: Places, draws: Places, floors: Floats, *, same_layer: bool
) -> tuple[Places, Places]:
    """Return the candidates that cross one of some earlier beads whose top reaches their floor, and that bead."""
    import shapely

    hits: list[NDArray[np.int64]] = []
    layers = rows.layer[candidates] if same_layer else np.zeros(len(candidates), dtype=np.int64)
    for layer in np.unique(layers).tolist():
        mine = candidates[layers == layer]
        beads = draws[: np.searchsorted(draws, mine[-1])]
        if same_layer:
            beads = beads[rows.layer[beads] == layer]
        beads = beads[rows.end[beads, 2] >= floors[mine].min()]
        if not len(beads):
            continue
        tree = shapely.STRtree(_lines(rows.start[beads], rows.end[beads]))
        start, end = rows.start[mine, :2], rows.end[mine, :2]
        way = (end - start) / np.linalg.norm(end - start, axis=1)[:, None] * CLEAR
        which, bead = tree.query(_lines(start + way, end - way), predicate="intersects")
        good = (beads[bead] < mine[which]) & (rows.end[beads[bead], 2] >= floors[mine[which]])
        hits.append(np.column_stack([mine[which[good]], beads[bead[good]]]))
    crossing = np.concatenate(hits) if hits else np.empty((0, 2), dtype=np.int64)
    row, place = np.unique(crossing[:, 0], return_index=True)
    return row, crossing[place, 1]


def _lines(start: Floats, end: Floats) -> NDArray[np.object_]:
    """Return lines from each start to its end, in x and y."""
    import shapely

    ends = np.nan_to_num(np.stack([start[:, :2], end[:, :2]], axis=1), nan=-1e6)
    return np.asarray(shapely.linestrings(ends))
