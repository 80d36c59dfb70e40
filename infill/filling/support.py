"""How far corners may move if layers are still to lie on one another and doubled walls to touch.

Measured on some layers of the print itself: the largest deviation at which the supported and the bonded share of the
infill's length are at least 0.94 of what they are in the slicer's own paths.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import STEP, Contact
from infill.filling.keeping import Rounding, contact_of, first_moves, layer_of, line_width, rounded_strokes
from infill.filling.surroundings import beads
from infill.gcode.sections import Marks, Strokes, Tags, marked, strokes
from infill.gcode.survey import Survey
from infill.gcode.table import Table, read

Floats = NDArray[np.float64]

LEAST_SHARE = 0.94
AIM = 0.945  # what layers here and there must keep, so that all of them keep the least
# mm; tried from the largest down. Beyond them, legs are what limits an arc.
DEVIATIONS = (math.inf, 0.3, 0.2, 0.15, 0.12, 0.1, 0.085, 0.075, *(0.07 - 0.005 * k for k in range(11)), 0.01)
LEAST_BONDED = 0.02  # of the length: below this, contact within the layer is by chance


@dataclass(frozen=True, kw_only=True)
class Sample:
    """Some layers of a print, read."""

    table: Table
    marks: Marks
    infill: Strokes

    @cached_property
    def walls(self) -> dict[int, Floats]:
        """Points on everything but the infill, by layer."""
        layers = {number for pair in self.pairs for number in pair}
        others = beads(self.table, self.marks, self.infill)
        return {number: others.of(number, STEP) for number in layers}

    @cached_property
    def pairs(self) -> list[tuple[int, int]]:
        """Layers with infill whose lower neighbour has infill too."""
        layer = self.marks.layer[first_moves(self.infill)]
        there = np.unique(layer).tolist()
        return [(number - 1, number) for number in there if number - 1 in there]


def samples(found: Survey) -> list[Sample]:
    """Return the layers that a survey read."""
    some = []
    for text in found.windows:
        table = read(text, found.begin)
        marks = marked(table, Tags())
        some.append(Sample(table=table, marks=marks, infill=strokes(table, marks)))
    return [sample for sample in some if sample.pairs]


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


def largest_deviation(some: list[Sample], rounding: Rounding, acceleration: float) -> tuple[float, Contact, Contact]:
    """Return the largest deviation, mm, that keeps support and contact, and both as measured, before and after.

    Parameters
    ----------
    some : list of Sample
    rounding : Rounding
        Its deviation is not exceeded.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    hard = _measured(some, None, acceleration)
    candidates = [rounding.deviation, *(deviation for deviation in DEVIATIONS if deviation < rounding.deviation)]

    def measured(place: int) -> tuple[bool, Contact]:
        done = _measured(some, replace(rounding, deviation=candidates[place]), acceleration)
        return min(kept_shares(hard, done)) >= AIM, done

    enough, found = measured(0)
    if enough:
        return candidates[0], hard, found
    best, contact = 0.0, hard
    low, high, tried = 1, len(candidates), set()
    while low < high:
        middle = (low + high) // 2
        tried.add(middle)
        enough, found = measured(middle)
        if enough:
            best, contact, high = candidates[middle], found, middle
        else:
            low = middle + 1
    # Support does not always fall evenly: a step or two further may still do.
    for place in (high - 2, high - 1):
        if place > 0 and place not in tried:
            enough, found = measured(place)
            if enough:
                return candidates[place], hard, found
    return best, hard, contact


def _measured(some: list[Sample], rounding: Rounding | None, acceleration: float) -> Contact:
    """Return the contact of the upper layers of all pairs, rounded or as they are."""
    total = Contact()
    for sample in some:
        points, first = sample.infill.points, sample.infill.first
        if rounding is not None:
            new = rounded_strokes(sample.table, sample.marks, sample.infill, rounding, acceleration=acceleration)
            points, first = new.points, new.first
        width = float(np.median(line_width(sample.marks, first_moves(sample.infill))))
        layers = {
            number: layer_of(sample.marks, sample.infill, sample.walls[number], points, first, number)
            for pair in sample.pairs
            for number in pair
        }
        for below, above in sample.pairs:
            total += contact_of(layers[above], layers[below], width)
    return total
