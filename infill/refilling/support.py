"""Limit the moves of corners so that layers still lie on one another, doubled walls touch, and beads keep their length.

Measured on some layers of the print itself: the largest deviation at which the supported and the bonded share of the
infill's length are at least 0.94 of those of the slicer's own paths, and its length at least 0.97.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from infill.gcode.sections import InfillStrokes, TagState
from infill.gcode.survey import Survey
from infill.gcode.table import read_table
from infill.kernels.threads import in_order, thread_count
from infill.paths.contact import Contact, Samples, concatenate_samples, layer_contact
from infill.paths.corners import RoundedPaths
from infill.paths.rounding import PathCorners, Rounding
from infill.refilling.batch import Batch, mark_batch
from infill.refilling.measuring import LayerPaths
from infill.refilling.smooth_in_place import path_lengths, stroke_corners

LEAST_SHARE = 0.94
LEAST_LENGTH = 0.97  # of the infill's length, and so of its filament
AIM = 0.944  # share that sampled layers must keep, so that all of them keep LEAST_SHARE
# mm; tried from the largest down. Beyond them, the legs limit an arc.
DEVIATIONS = (math.inf, 0.3, 0.2, 0.15, 0.12, *(round(0.1 - 0.0025 * k, 4) for k in range(33)), 0.01)
LARGEST_DEVIATION, LEAST_LEFT = 0.2, 0.85  # mm, and about the share of support or contact that it leaves
BISECT_AFTER = 6  # shares; with more, the search bisects instead of interpolating
ENOUGH_INFILL = 1000.0  # mm of infill in a layer
NO_DIFFERENCE = 0.002  # of the remaining share
LEAST_BONDED = 0.02  # of the length: below this, contact within the layer is by chance


def layers_with_infill(batch: Batch) -> list[int]:
    """Return layers with infill, without the lowest unless it is the only one: the layer below it is unknown."""
    lowest = int(batch.marks.layer.min())
    layers = np.unique(batch.layer).tolist()
    chosen: list[int] = [number for number in layers if number > lowest] or layers[-1:]
    # A single layer is enough if it holds much infill.
    return chosen[-1:] if chosen and batch.infill.length[batch.layer == chosen[-1]].sum() > ENOUGH_INFILL else chosen


def sample_batches(print_survey: Survey) -> list[Batch]:
    """Read the layers of a survey that hold infill."""
    batches = [mark_batch(read_table(text, print_survey.begin), TagState()) for text in print_survey.windows]
    return [batch for batch in batches if layers_with_infill(batch)]


def kept_shares(old: Contact, new: Contact) -> tuple[float, float]:
    """Compare the supported share, and the bonded share, of new paths with those of old ones.

    >>> kept_shares(Contact(length=10, supported=10, bonded=4), Contact(length=9, supported=9, bonded=3.6))
    (1.0, 1.0)
    """
    (supported, bonded), (then_supported, then_bonded) = old.shares, new.shares
    return (
        then_supported / supported if supported else 1.0,
        then_bonded / bonded if bonded >= LEAST_BONDED else 1.0,
    )


def kept_length_share(old: float, new: float) -> float:
    """Return the share of the infill's length that remains, scaled like the other shares: 0.97 becomes 0.94.

    >>> round(kept_length_share(100.0, 97.0), 9), kept_length_share(100.0, 101.0)
    (0.94, 1.0)
    """
    lost = 1 - new / old if old else 0.0
    return 1 - max(lost, 0.0) * (1 - LEAST_SHARE) / (1 - LEAST_LENGTH)


def largest_deviation(batches: Sequence[Batch], rounding: Rounding, acceleration: float) -> float:
    """Find the largest deviation, mm, that keeps support, contact and length.

    Parameters
    ----------
    batches : sequence of Batch
    rounding : Rounding
        Its deviation is not exceeded.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    tried = [_SampledLayers.of(batch, rounding, acceleration) for batch in batches]
    threads = thread_count()

    def measure_all(infill: Callable[[_SampledLayers], InfillStrokes | RoundedPaths]) -> tuple[Contact, float]:
        results = [pair for _, pair in in_order(lambda layers: layers.measure(infill(layers)), tried, threads=threads)]
        return sum((contact for contact, _ in results), Contact()), sum(length for _, length in results)

    old_contact, old = measure_all(lambda layers: layers.batch.infill)

    def share(deviation: float) -> float:
        trial_rounding = replace(rounding, deviation=deviation)
        contact, new = measure_all(lambda layers: layers.corners.rounded(trial_rounding))
        return min(*kept_shares(old_contact, contact), kept_length_share(old, new))

    if share(rounding.deviation) >= AIM:
        return rounding.deviation
    return largest_sufficient([deviation for deviation in DEVIATIONS if deviation < rounding.deviation], share)


def smaller_deviation(deviation: float, share: float, previous_share: float = 0.0) -> float:
    """Lower a deviation, mm, that keeps too small a share.

    The loss grows with the deviation, so the deviation falls in proportion to the excess loss, and a little more.

    Parameters
    ----------
    deviation : float, mm
    share : float
        The smaller of the shares that it left.
    previous_share : float
        The share that the previous, larger deviation left. Without a difference, the legs limited the arcs: the
        deviation is halved.
    """
    if share >= LEAST_SHARE:
        return deviation
    factor = (1 - AIM) / (1 - share)
    if share - previous_share < NO_DIFFERENCE:
        factor = min(factor, 0.5)
    smaller = min(deviation, LARGEST_DEVIATION) * factor
    return smaller if smaller > DEVIATIONS[-1] / 2 else 0.0


def largest_sufficient(candidates: Sequence[float], share: Callable[[float], float]) -> float:
    """Find the first of some deviations, from the largest down, that leaves at least `AIM`; 0 if none does.

    The share mostly falls with the deviation: the search interpolates between the shares on both sides of the aim.
    """
    low, high = -1, len(candidates)  # a deviation that is too large, and one that is small enough
    shares = {low: (LARGEST_DEVIATION, LEAST_LEFT), high: (0.0, 1.0)}
    while high - low > 1:
        (larger, larger_share), (smaller, smaller_share) = shares[low], shares[high]
        aim = smaller + (larger - smaller) * (smaller_share - AIM) / max(smaller_share - larger_share, 1e-9)
        place = next((k for k in range(low + 1, high) if candidates[k] <= aim), high - 1)
        if len(shares) > BISECT_AFTER:
            place = (low + high) // 2
        shares[place] = candidates[place], share(candidates[place])
        low, high = (low, place) if shares[place][1] >= AIM else (place, high)
    # Support does not always fall evenly: a step further may still do.
    if high > 1 and high - 2 not in shares and share(candidates[high - 2]) >= AIM:
        return candidates[high - 2]
    return candidates[high] if high < len(candidates) else 0.0


@dataclass(frozen=True, kw_only=True)
class _SampledLayers:
    """Sampled layers, with all data that do not change with the deviation."""

    batch: Batch
    corners: PathCorners
    walls: dict[int, Samples]

    @classmethod
    def of(cls, batch: Batch, rounding: Rounding, acceleration: float) -> _SampledLayers:
        return cls(
            batch=batch,
            corners=stroke_corners(batch, rounding.corner, acceleration=acceleration),
            walls={number: batch.others.samples_of(number - 1) for number in layers_with_infill(batch)},
        )

    def measure(self, infill: InfillStrokes | RoundedPaths) -> tuple[Contact, float]:
        """Measure the contact of the layers with some infill, and the length of all of it, mm."""
        drawn = LayerPaths(points=infill.points, first=infill.first, layer=self.batch.layer)
        total = Contact()
        for number, walls in self.walls.items():
            total += layer_contact(
                drawn.of(number), concatenate_samples(drawn.of(number - 1), walls), self.batch.line_width
            )
        return total, float(path_lengths(infill.points, infill.first).sum())
