"""Which sections of a layer fill which of its areas: a slicer may print one area in several sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.gcode.bodies import ALIKE, Body
from infill.gcode.sections import Strokes
from infill.paths.contact import sampled
from infill.ragged import picked
from infill.refilling.regions import Region

Places = NDArray[np.intp]

SHARED = 0.02  # of an area's infill may be another section's
LOST = 0.1  # of the infill of sections that share areas may lie outside every area that was found
STEP = 0.5  # mm between the points on infill that are looked up
AROUND = 0.1  # mm around an area that belong to it


@dataclass(frozen=True, kw_only=True)
class Group:
    """Sections of a layer that share areas; most are alone.

    Parameters
    ----------
    areas : dict of int to tuple of int
        By section, the areas that it is to fill: those of which it printed more than the others.
    lengths : dict of int to float
        mm of the slicer's infill in each area.
    lost : float
        Share of it that lies outside every area.
    """

    areas: dict[int, tuple[int, ...]]
    lengths: dict[int, float]
    lost: float


def grouped(region: Region, infill: Strokes, some: Places, section: Places) -> list[Group]:
    """Return the sections of a layer in groups that share areas.

    Parameters
    ----------
    region : Region
        Of the layer.
    infill : Strokes
    some : (S,) int
        The strokes of the layer.
    section : (M,) int
        Of every stroke.
    """
    import shapely

    grown = shapely.buffer(np.array(region.polygons, dtype=object), AROUND)
    shapely.prepare(grown)
    numbers = np.unique(section[some]).tolist()
    held = np.zeros((len(numbers), len(grown)))
    whole, lost = np.zeros((2, len(numbers)))  # mm
    for place, number in enumerate(numbers):
        places, first = picked(infill.first, some[section[some] == number])
        drawn = sampled(infill.points[places], first, STEP)
        inside = np.array([shapely.contains_xy(area, drawn.points[:, 0], drawn.points[:, 1]) for area in grown])
        held[place] = inside @ drawn.weight if len(grown) else 0.0
        whole[place] = drawn.weight.sum()
        lost[place] = drawn.weight[~inside.any(axis=0)].sum() if len(grown) else whole[place]
    # A section that printed next to nothing of an area has no share in it.
    shares = held > SHARED * held.sum(axis=0)
    label = np.arange(len(numbers))
    for area in range(len(grown)):
        together = np.flatnonzero(shares[:, area])
        if len(together):
            label[np.isin(label, label[together])] = label[together[0]]
    groups = []
    for each in np.unique(label):
        areas: dict[int, tuple[int, ...]] = {}
        for place in np.flatnonzero(label == each).tolist():
            own = [area for area in range(len(grown)) if held[:, area].any() and held[:, area].argmax() == place]
            areas[numbers[place]] = tuple(own)
        amount = held[label == each].sum(axis=0)
        lengths = {area: float(amount[area]) for area in np.flatnonzero(amount).tolist()}
        share = float(lost[label == each].sum() / whole[label == each].sum())
        groups.append(Group(areas=areas, lengths=lengths, lost=share))
    return groups


def lengths_of(groups: Sequence[Group]) -> dict[int, float]:
    """Return mm of the slicer's infill by area."""
    held: dict[int, float] = {}
    for group in groups:
        for area, length in group.lengths.items():
            held[area] = held.get(area, 0.0) + length
    return held


def unsure(group: Group, members: Sequence[Body]) -> str:
    """Say why a group of sections cannot be filled anew; nothing if it can.

    Parameters
    ----------
    group : Group
    members : sequence of Body
        Its sections that can be drawn anew.
    """
    if group.lost > LOST:
        return "no sure region"
    if len(members) < len(group.areas):
        return "shares its region with a section that is kept"
    rates = [body.rate for body in members]
    return "lines of different widths" if rates and max(rates) > (1 + ALIKE) * min(rates) else ""
