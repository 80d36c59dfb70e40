"""How far corners may move if layers are still to lie on one another, doubled walls to touch, and beads to stay.

Measured on some layers of the print itself: the largest deviation at which the supported and the bonded share of the
infill's length are at least 0.94 of what they are in the slicer's own paths, and its length at least 0.97.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from infill.gcode.sections import Strokes, Tags
from infill.gcode.survey import Survey
from infill.gcode.table import read
from infill.kernels.threads import in_order, thread_count
from infill.paths.contact import Contact, Samples, contact, merged
from infill.paths.corners import Rounded
from infill.paths.rounding import Corners, Rounding
from infill.refilling.batch import Batch, batch_of
from infill.refilling.measuring import Drawing
from infill.refilling.smooth_in_place import lengths, stroke_corners

LEAST_SHARE = 0.94
LEAST_LENGTH = 0.97  # of the infill's length, and so of its filament
AIM = 0.944  # what layers here and there must keep, so that all of them keep the least
# mm; tried from the largest down. Beyond them, legs are what limits an arc.
DEVIATIONS = (math.inf, 0.3, 0.2, 0.15, 0.12, *(round(0.1 - 0.0025 * k, 4) for k in range(33)), 0.01)
LARGEST_DEVIATION, LEAST_LEFT = 0.2, 0.85  # mm, and about what it leaves of support or contact
MANY = 6  # shares; with more, what they tell of the others is not used any longer
ENOUGH = 1000.0  # mm of infill in a layer
NO_DIFFERENCE = 0.002  # of what is kept
LEAST_BONDED = 0.02  # of the length: below this, contact within the layer is by chance


def filled(batch: Batch) -> list[int]:
    """Return layers with infill, without the lowest unless it is the only one: what is below it is not known."""
    lowest = int(batch.marks.layer.min())
    there = np.unique(batch.layer).tolist()
    found: list[int] = [number for number in there if number > lowest] or there[-1:]
    # One is enough where there is much of it.
    return found[-1:] if found and batch.infill.length[batch.layer == found[-1]].sum() > ENOUGH else found


def samples(found: Survey) -> list[Batch]:
    """Return the layers that a survey read."""
    some = [batch_of(read(text, found.begin), Tags()) for text in found.windows]
    return [batch for batch in some if filled(batch)]


def kept_shares(old: Contact, new: Contact) -> tuple[float, float]:
    """Return new over old share of what is supported, and of what is bonded.

    >>> kept_shares(Contact(length=10, supported=10, bonded=4), Contact(length=9, supported=9, bonded=3.6))
    (1.0, 1.0)
    """
    (supported, bonded), (then_supported, then_bonded) = old.shares, new.shares
    return (
        then_supported / supported if supported else 1.0,
        then_bonded / bonded if bonded >= LEAST_BONDED else 1.0,
    )


def kept_length(old: float, new: float) -> float:
    """Return the share of the infill's length that is left, on the scale of the other shares: 0.97 is as 0.94 of those.

    >>> round(kept_length(100.0, 97.0), 9), kept_length(100.0, 101.0)
    (0.94, 1.0)
    """
    lost = 1 - new / old if old else 0.0
    return 1 - max(lost, 0.0) * (1 - LEAST_SHARE) / (1 - LEAST_LENGTH)


def largest_deviation(some: Sequence[Batch], rounding: Rounding, acceleration: float) -> float:
    """Return the largest deviation, mm, that keeps support, contact and length.

    Parameters
    ----------
    some : sequence of Batch
    rounding : Rounding
        Its deviation is not exceeded.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    tried = [_Tried.of(batch, rounding, acceleration) for batch in some]
    threads = thread_count()

    def measured(infill: Callable[[_Tried], Strokes | Rounded]) -> tuple[Contact, float]:
        found = [pair for _, pair in in_order(lambda each: each.measured(infill(each)), tried, threads=threads)]
        return sum((contact for contact, _ in found), Contact()), sum(length for _, length in found)

    hard, old = measured(lambda each: each.batch.infill)

    def share(deviation: float) -> float:
        now = replace(rounding, deviation=deviation)
        contact, new = measured(lambda each: each.corners.rounded(now))
        return min(*kept_shares(hard, contact), kept_length(old, new))

    if share(rounding.deviation) >= AIM:
        return rounding.deviation
    return first_enough([deviation for deviation in DEVIATIONS if deviation < rounding.deviation], share)


def smaller_deviation(deviation: float, kept: float, last: float = 0.0) -> float:
    """Return a deviation, mm, for a print that lost too much of its support or contact; the same if it did not.

    What is lost grows with the deviation: it is lowered by as much as too much was lost, and a little more.

    Parameters
    ----------
    deviation : float, mm
    kept : float
        The lesser share that it left.
    last : float
        The share that the deviation before it left, which was larger. If that made no difference, legs were what
        limited the arcs: it is lowered by half.
    """
    if kept >= LEAST_SHARE:
        return deviation
    factor = (1 - AIM) / (1 - kept)
    if kept - last < NO_DIFFERENCE:
        factor = min(factor, 0.5)
    smaller = min(deviation, LARGEST_DEVIATION) * factor
    return smaller if smaller > DEVIATIONS[-1] / 2 else 0.0


def first_enough(candidates: Sequence[float], share: Callable[[float], float]) -> float:
    """Return the first of some deviations, from the largest down, that leaves at least `AIM`; 0 if none does.

    The share falls with the deviation, by and large: where it should reach the aim is reckoned from the shares that
    are known on both sides.
    """
    low, high = -1, len(candidates)  # that is known to be too much, and to be enough
    known = {low: (LARGEST_DEVIATION, LEAST_LEFT), high: (0.0, 1.0)}
    while high - low > 1:
        (more, less_left), (less, more_left) = known[low], known[high]
        aim = less + (more - less) * (more_left - AIM) / max(more_left - less_left, 1e-9)
        place = next((k for k in range(low + 1, high) if candidates[k] <= aim), high - 1)
        if len(known) > MANY:
            place = (low + high) // 2
        known[place] = candidates[place], share(candidates[place])
        low, high = (low, place) if known[place][1] >= AIM else (place, high)
    # Support does not always fall evenly: a step further may still do.
    if high > 1 and high - 2 not in known and share(candidates[high - 2]) >= AIM:
        return candidates[high - 2]
    return candidates[high] if high < len(candidates) else 0.0


@dataclass(frozen=True, kw_only=True)
class _Tried:
    """Layers that are looked at, with all that does not change with the deviation."""

    batch: Batch
    corners: Corners
    walls: dict[int, Samples]

    @classmethod
    def of(cls, batch: Batch, rounding: Rounding, acceleration: float) -> _Tried:
        return cls(
            batch=batch,
            corners=stroke_corners(batch, rounding.corner, acceleration=acceleration),
            walls={number: batch.others.samples_of(number - 1) for number in filled(batch)},
        )

    def measured(self, infill: Strokes | Rounded) -> tuple[Contact, float]:
        """Return the contact of the layers with some infill, and the length of all of it, mm."""
        drawn = Drawing(points=infill.points, first=infill.first, layer=self.batch.layer)
        total = Contact()
        for number, walls in self.walls.items():
            total += contact(drawn.of(number), merged(drawn.of(number - 1), walls), self.batch.line_width)
        return total, float(lengths(infill.points, infill.first).sum())
