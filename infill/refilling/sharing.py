"""Assign the areas of a layer to its sections: a slicer may print one area in several sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from infill.gcode.infill_sections import SECTION_RATE_VARIATION, InfillSection
from infill.paths.contact import sample_paths
from infill.ragged import select_rows
from infill.refilling.layers import Layer
from infill.refilling.regions import NO_REGION, FreeAreas

IGNORED_SHARE = 0.02  # share of an area's infill up to which another section is ignored
MOST_LOST = 0.1  # share of the infill of a group that may lie outside every area
STEP = 0.5  # mm between the sampled points on infill


@dataclass(frozen=True, kw_only=True)
class SectionGroup:
    """Sections of a layer that share areas; most groups hold a single section.

    Parameters
    ----------
    areas : dict of int to tuple of int
        By section, the areas to fill: those of which it printed more than any other section.
    lengths : dict of int to float
        mm of the slicer's infill in each area.
    lost : float
        Share of it that lies outside every area.
    """

    areas: dict[int, tuple[int, ...]]
    lengths: dict[int, float]
    lost: float

    def refusal_reason(self, members: Sequence[InfillSection]) -> str:
        """Say why the sections cannot be refilled, of which `members` can be redrawn; "" if they can."""
        if self.lost > MOST_LOST:
            return NO_REGION
        if len(members) < len(self.areas):
            return "shares its region with a section that is kept"
        rates = [body.rate for body in members]
        return "lines of different widths" if rates and max(rates) > (1 + SECTION_RATE_VARIATION) * min(rates) else ""


def group_sections(layer: Layer, region: FreeAreas) -> list[SectionGroup]:
    """Group the sections of a layer that share areas of its region."""
    import shapely

    infill, strokes, section = layer.layers.infill, layer.strokes, layer.layers.section
    grown = region.grown_areas
    numbers = np.unique(section[strokes]).tolist()
    area_lengths_mm = np.zeros((len(numbers), len(grown)))
    total, lost = np.zeros((2, len(numbers)))  # mm
    for place, number in enumerate(numbers):
        places, offsets = select_rows(infill.first, strokes[section[strokes] == number])
        drawn = sample_paths(infill.points[places], offsets, STEP)
        inside = np.array([shapely.contains_xy(area, drawn.points[:, 0], drawn.points[:, 1]) for area in grown])
        area_lengths_mm[place] = inside @ drawn.weight if len(grown) else 0.0
        total[place] = drawn.weight.sum()
        lost[place] = drawn.weight[~inside.any(axis=0)].sum() if len(grown) else total[place]
    # A section that printed next to nothing of an area has no share in it.
    shares = area_lengths_mm > IGNORED_SHARE * area_lengths_mm.sum(axis=0)
    label = np.arange(len(numbers))
    for area in range(len(grown)):
        sharing = np.flatnonzero(shares[:, area])
        if len(sharing):
            label[np.isin(label, label[sharing])] = label[sharing[0]]
    groups = []
    for group_label in np.unique(label):
        areas: dict[int, tuple[int, ...]] = {}
        for place in np.flatnonzero(label == group_label).tolist():
            own_areas = [
                area
                for area in range(len(grown))
                if area_lengths_mm[:, area].any() and area_lengths_mm[:, area].argmax() == place
            ]
            areas[numbers[place]] = tuple(own_areas)
        amount = area_lengths_mm[label == group_label].sum(axis=0)
        lengths = {area: float(amount[area]) for area in np.flatnonzero(amount).tolist()}
        share = float(lost[label == group_label].sum() / total[label == group_label].sum())
        groups.append(SectionGroup(areas=areas, lengths=lengths, lost=share))
    return groups
