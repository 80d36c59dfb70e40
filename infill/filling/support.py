"""How far corners may move if layers are still to lie on one another and doubled walls to touch.

Measured on some layers of the print itself: the largest deviation at which the supported and the bonded share of the
infill's length are at least 0.94 of what they are in the slicer's own paths.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from infill.filling.batch import Batch, batch_of
from infill.filling.contact import Contact, contact, merged
from infill.filling.keeping import Rounding, rounded_strokes
from infill.filling.measuring import Drawing
from infill.gcode.sections import Tags
from infill.gcode.survey import Survey
from infill.gcode.table import read

LEAST_SHARE = 0.94
AIM = 0.941  # what layers here and there must keep, so that all of them keep the least
# mm; tried from the largest down. Beyond them, legs are what limits an arc.
DEVIATIONS = (math.inf, 0.3, 0.2, 0.15, 0.12, *(round(0.1 - 0.0025 * k, 4) for k in range(33)), 0.01)
ENOUGH = 1000.0  # mm of infill in a layer
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


def largest_deviation(some: Sequence[Batch], rounding: Rounding, acceleration: float) -> float:
    """Return the largest deviation, mm, that keeps support and contact.

    Parameters
    ----------
    some : sequence of Batch
    rounding : Rounding
        Its deviation is not exceeded.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    hard = _measured(some, None, acceleration)
    candidates = [rounding.deviation, *(deviation for deviation in DEVIATIONS if deviation < rounding.deviation)]

    def enough(place: int) -> bool:
        done = _measured(some, replace(rounding, deviation=candidates[place]), acceleration)
        return min(kept_shares(hard, done)) >= AIM

    if enough(0):
        return candidates[0]
    low, high, tried = 1, len(candidates), set()
    while low < high:
        middle = (low + high) // 2
        tried.add(middle)
        if enough(middle):
            high = middle
        else:
            low = middle + 1
    # Support does not always fall evenly: a step or two further may still do.
    for place in (high - 2, high - 1):
        if place > 0 and place not in tried and enough(place):
            return candidates[place]
    return candidates[high] if high < len(candidates) else 0.0


def _measured(some: Sequence[Batch], rounding: Rounding | None, acceleration: float) -> Contact:
    """Return the contact of the layers that were read, rounded or as they are."""
    total = Contact()
    for batch in some:
        new = batch.infill if rounding is None else rounded_strokes(batch, rounding, acceleration=acceleration)
        infill = Drawing(points=new.points, first=new.first, layer=batch.layer)
        for number in filled(batch):
            below = merged(infill.of(number - 1), batch.others.samples_of(number - 1))
            total += contact(infill.of(number), below, batch.line_width)
    return total
