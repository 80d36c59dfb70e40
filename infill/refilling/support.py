"""Limit the moves of corners so that layers still lie on one another, doubled walls touch, and beads keep their length.

Measured on some layers of the print itself: the largest deviation at which the supported and the bonded share of the
infill's length are at least 0.94 of those of the slicer's own paths, and its length at least 0.97.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from infill.arrays import Floats, Places
from infill.gcode.strokes import InfillStrokes
from infill.kernels.threads import in_order, thread_count
from infill.paths.contact import Contact, Samples, concatenate_samples, free_length, layer_contact, sample_paths
from infill.paths.corners import RoundedPaths
from infill.paths.rounding import PathCorners, Rounding
from infill.refilling.layers import LayerPaths, Layers
from infill.refilling.smooth_in_place import path_lengths, stroke_corners
from infill.refilling.widest_gap import GapMemory

LEAST_SHARE = 0.94
LEAST_LENGTH = 0.97  # of the infill's length, and so of its filament
AIM = 0.944  # share that sampled layers must keep, so that all of them keep LEAST_SHARE
# mm; tried from the largest down. Beyond them, the legs limit an arc.
DEVIATIONS = (math.inf, 0.3, 0.2, 0.15, 0.12, *(round(0.1 - 0.0025 * k, 4) for k in range(33)), 0.01)
LARGEST_DEVIATION, LEAST_LEFT = 0.2, 0.85  # mm, and about the share of support or contact that it leaves
BISECT_AFTER = 6  # shares; with more, the search bisects instead of interpolating
NO_DIFFERENCE = 0.002  # of the remaining share
LEAST_BONDED = 0.02  # of the length: below this, contact within the layer is by chance


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


def largest_deviation(samples: Sequence[Layers], rounding: Rounding, acceleration: float) -> float:
    """Find the largest deviation, mm, that keeps support, contact and length.

    Parameters
    ----------
    samples : sequence of Layers
    rounding : Rounding
        Its deviation is not exceeded.
    acceleration : float, mm/s²
        Where the print commands none.
    """
    gaps = GapMemory()
    tried = [_SampledLayers.of(layers, rounding, acceleration, gaps) for layers in samples]
    threads = thread_count()

    def measure_all(infill: Callable[[_SampledLayers], InfillStrokes | RoundedPaths]) -> tuple[Contact, float]:
        results = [pair for _, pair in in_order(lambda sample: sample.measure(infill(sample)), tried, threads=threads)]
        return sum((contact for contact, _ in results), Contact()), sum(length for _, length in results)

    old_contact, old = measure_all(lambda sample: sample.layers.infill)

    def kept_share(deviation: float) -> float:
        """Return the least share that paths rounded by a deviation keep."""
        trial_rounding = replace(rounding, deviation=deviation)
        contact, new = measure_all(lambda sample: sample.rounded(trial_rounding))
        return min(*kept_shares(old_contact, contact), kept_length_share(old, new))

    if kept_share(rounding.deviation) >= AIM:
        return rounding.deviation
    return largest_sufficient([deviation for deviation in DEVIATIONS if deviation < rounding.deviation], kept_share)


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

    layers: Layers
    acceleration: Floats
    corners: PathCorners
    walls: dict[int, Samples]

    @classmethod
    def of(cls, layers: Layers, rounding: Rounding, acceleration: float, gaps: GapMemory) -> _SampledLayers:
        """Find the corners of sampled layers, and the other beads in the layers below."""
        return cls(
            layers=layers,
            acceleration=layers.acceleration(acceleration),
            corners=stroke_corners(layers, rounding, acceleration=acceleration, gaps=gaps),
            walls={layer.number: layers.bead_samples(layer.number - 1) for layer in layers.upper},
        )

    def rounded(self, rounding: Rounding) -> RoundedPaths:
        """Round the corners as a drawing does."""
        return rounding.merge_segments(
            self.corners.rounded(rounding), speed=self.layers.speed, acceleration=self.acceleration
        )

    def measure(self, infill: InfillStrokes | RoundedPaths) -> tuple[Contact, float]:
        """Measure the contact of the layers with some infill, and the length of all of it, mm."""
        drawn = LayerPaths(points=infill.points, first=infill.first, layer=self.layers.layer)
        total = Contact()
        for number, walls in self.walls.items():
            below = concatenate_samples(sample_paths(*drawn.of(number - 1)), walls)
            total += layer_contact(sample_paths(*drawn.of(number)), below, self.layers.line_width)
        return total, float(path_lengths(infill.points, infill.first).sum())


@dataclass(frozen=True, kw_only=True)
class SampledLayer:
    """A drawn layer that supports the next one.

    Parameters
    ----------
    number : int
    before, after : Samples
        All its beads, old and new.
    """

    number: int
    before: Samples
    after: Samples


def measure_layers(
    old: LayerPaths,
    new: LayerPaths,
    walls: Callable[[int], Samples],
    numbers: Places,
    *,
    line_width: float,
    stride: int,
    last: SampledLayer | None,
) -> tuple[Contact, Contact, SampledLayer | None]:
    """Measure the support, contact and hold of the infill of every `stride`-th layer, old and new.

    Parameters
    ----------
    old, new : LayerPaths
        The infill.
    walls : callable
        Samples of all other beads of a layer, by its number.
    numbers : (L,) int, ascending
        Numbers of the layers.
    line_width : float, mm
    stride : int
    last : SampledLayer, optional
        The last one of the previous layers, if needed.

    Returns
    -------
    before, after : Contact
    last : SampledLayer or None
        For the next layers.
    """
    before, after = Contact(), Contact()

    @lru_cache(maxsize=2)  # a layer is measured, and then the next one lies on it
    def layer_samples(number: int) -> tuple[Samples, Samples]:
        return sample_paths(*old.of(number)), sample_paths(*new.of(number))

    def sample_below(number: int) -> SampledLayer:
        """Sample all of the layer of a number, before and after."""
        beads = walls(number)
        old_samples, new_samples = layer_samples(number)
        return SampledLayer(
            number=number, before=concatenate_samples(old_samples, beads), after=concatenate_samples(new_samples, beads)
        )

    layer_set = set(numbers.tolist())
    for number in np.unique(old.layer).tolist():
        if number % stride:
            continue
        if number - 1 in layer_set:
            lower = sample_below(number - 1)
        elif last is not None and last.number == number - 1:
            lower = last
        else:
            continue
        old_samples, new_samples = layer_samples(number)
        beads = walls(number)
        before += _measure_layer(old_samples, lower.before, beads, line_width)
        after += _measure_layer(new_samples, lower.after, beads, line_width)
    final = int(numbers[-1]) if len(numbers) else 0
    return before, after, sample_below(final) if len(numbers) and (final + 1) % stride == 0 else None


def _measure_layer(infill: Samples, below: Samples, walls: Samples, line_width: float) -> Contact:
    """Measure the infill of one layer against everything in the layer below, and the other beads of its own."""
    return replace(layer_contact(infill, below, line_width), free=free_length(infill, walls, line_width))
