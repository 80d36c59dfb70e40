"""Families of paths whose cells change from place to place: drawn alike in a plane of their own, and stretched.

::

    plane of the pattern, (u, v)          bed, (x, y)
    |  |  |  |  |  |  |            |    |   |  |  |  | | |
    |  |  |  |  |  |  |    --->    |    |   |  |  |  | | |
    |  |  |  |  |  |  |            |    |   |  |  |  | | |

The map between the planes is smooth and turns nowhere inside out, so no line crosses another. Beads that touch lie on
one another in the plane of the pattern, and move apart on the bed, across their lines, so that they touch there too.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.paths.families.family import STRETCHED_TOUCH, Bounds, Family, NominalStrand, Path, PathSpec
from infill.paths.plane_splines import PlaneMap, pattern_bounds
from infill.ragged import concatenate_rows, split_rows

LONGEST_LEG = 0.5  # cells: longer legs of a line are divided before they are stretched
MOST_BEND = 0.006  # mm between a stretched leg and its chord; legs that bend more are divided
MOST_PIECES = 16  # of such a leg
SADDLE_ROOM = 1.1  # times the distance of touching beads that lines of a surface keep, in cells of the smallest size
LEAST_SPACING = 0.98  # line widths between joins along walls and other lines; 0.95 after rounding
MARGIN = 1.0  # cells around a box, in which lines are still drawn


@dataclass(frozen=True, kw_only=True)
class StretchedFamily(Family):
    """The lines of another family, of which `cell` is the nominal one, in the plane of a map.

    Parameters
    ----------
    family : Family
    plane_map : PlaneMap
    rise : float
        Share of the height that the pattern rises: less than 1, so that lines move by no more from layer to layer
        where cells are largest.
    """

    family: Family
    plane_map: PlaneMap
    rise: float = 1.0
    least_spacing: ClassVar[float] = LEAST_SPACING

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the stretched lines near the box."""
        plane_map, margin = self.plane_map, MARGIN * spec.cell
        x0, y0, x1, y1 = bounds
        around = (x0 - margin, y0 - margin, x1 + margin, y1 + margin)
        # Lines of a surface keep their distance where cells are smallest; touching beads move apart later.
        wider = 1.0 if self.family.touches else SADDLE_ROOM * plane_map.largest_scale
        inner = replace(spec, z=self.rise * spec.z, line_width=wider * spec.line_width)
        strands = self.family.nominal_strands(pattern_bounds(plane_map.forward, around), inner)
        return stretch_strands(
            strands, plane_map, around, leg=LONGEST_LEG * spec.cell, half_gap=STRETCHED_TOUCH * spec.line_width / 2
        )

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the nominal cell of the family for a density."""
        return self.family.cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius of the family where cells have their largest size."""
        return self.family.largest_radius(cell, line_width) / self.least_scale

    @cached_property
    def least_scale(self) -> float:
        """The least number of cells in a length over that of the nominal cell."""
        return float(np.sqrt(np.linalg.det(self.plane_map.slopes).min()))

    def radii_at(self, points: Floats, cell: float, line_width: float) -> Floats:
        """Return the largest radius of corners, mm, at points on the bed, (N, 2): (N,)."""
        return self.family.largest_radius(cell, line_width) / np.maximum(self.plane_map.scale_at(points), 1e-9)


@dataclass(frozen=True, kw_only=True)
class SteppedFamily(Family):
    """A family whose cells change in steps of height as well.

    Parameters
    ----------
    family : Family
        The one whose cells change.
    families : sequence of Family
        From the lowest step to the highest, with cells that change from place to place.
    tops, middles : sequence of float, mm
        Where each step ends, the last one at infinity, and the middle of its layers.
    """

    family: Family
    families: Sequence[Family]
    tops: Sequence[float]
    middles: Sequence[float]
    least_spacing: ClassVar[float] = LEAST_SPACING

    def at(self, z: float) -> Family:
        """Return the family at a height, mm."""
        return self.families[int(np.searchsorted(self.tops, z))]

    def middle_of(self, z: float) -> float:
        """Return the middle of the step at a height, mm."""
        return self.middles[int(np.searchsorted(self.tops, z))]

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the lines at the height of the layer."""
        return self.at(spec.z).strands(bounds, spec)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the nominal cell of the families for a density."""
        return self.family.cell_for(density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius at the nominal cell."""
        return self.family.largest_radius(cell, line_width)


def step_family(
    family: Family, families: Sequence[Family], tops: Sequence[float], middles: Sequence[float]
) -> SteppedFamily:
    """Return a family whose cells follow another map in every step of height."""
    return SteppedFamily(
        name=family.name,
        summary=family.summary,
        prismatic=False,
        wide=family.wide,
        family=family,
        families=tuple(families),
        tops=tuple(tops),
        middles=tuple(middles),
    )


def stretch_family(family: Family, plane_map: PlaneMap, rise: float) -> StretchedFamily:
    """Return a family whose cells follow a map."""
    return StretchedFamily(
        name=family.name,
        summary=family.summary,
        prismatic=family.prismatic,
        wide=family.wide,
        family=family,
        plane_map=plane_map,
        rise=rise,
    )


def stretch_strands(
    strands: Sequence[NominalStrand], plane_map: PlaneMap, around: Bounds, *, leg: float, half_gap: float
) -> list[Path]:
    """Stretch strands onto the bed, as far as they lie in a box.

    Parameters
    ----------
    strands : sequence of NominalStrand
        In the plane of the pattern.
    plane_map : PlaneMap
    around : (x0, y0, x1, y1)
        mm. Strands are cut a little outside of it.
    leg : float, mm
        Longest leg of a line that is stretched as one.
    half_gap : float, mm
        Half the distance of beads that touch.
    """
    if not strands:
        return []
    points, first = concatenate_rows([strand.points for strand in strands], like=(2,))
    sides = np.concatenate([strand.sides for strand in strands])
    across = np.repeat(np.stack([strand.across for strand in strands]), np.diff(first), axis=0)
    is_leg = _legs(len(points), first)
    length = np.append(np.hypot(*np.diff(points, axis=0).T), 0.0)
    points, sides, across, first = _divide(
        points, sides, across, first, np.where(is_leg, np.maximum(np.ceil(length / leg), 1), 1).astype(np.intp)
    )
    points, sides, across, first = _keep_near(points, sides, across, first, plane_map, around)
    if not len(points):
        return []
    is_leg = _legs(len(points), first)
    bed = plane_map.inverse.at(points)
    middle = plane_map.inverse.at((points[:-1] + points[1:]) / 2)
    bend = np.append(np.hypot(*(middle - (bed[:-1] + bed[1:]) / 2).T), 0.0)
    pieces = np.clip(np.ceil(np.sqrt(bend / MOST_BEND)), 1, MOST_PIECES)
    pieces = np.where(is_leg, pieces, 1).astype(np.intp)
    if pieces.max() > 1:
        points, sides, across, first = _divide(points, sides, across, first, pieces)
        bed = plane_map.inverse.at(points)
    if sides.any():
        normal = np.einsum("ni,nij->nj", across, plane_map.slopes_at(bed))
        bed = bed + (half_gap * sides / np.hypot(*normal.T))[:, None] * normal
    return split_rows(bed, first)


def _legs(count: int, first: Places) -> NDArray[np.bool_]:
    """Tell which points begin a leg of their path."""
    is_leg = np.ones(count, dtype=bool)
    is_leg[first[1:][np.diff(first) > 0] - 1] = False
    return is_leg


def _divide(
    points: Floats, sides: Floats, across: Floats, first: Places, pieces: Places
) -> tuple[Floats, Floats, Floats, Places]:
    """Divide the leg after each point into equal pieces."""
    begins = np.concatenate([[0], np.cumsum(pieces)])
    source = np.repeat(np.arange(len(points)), pieces)
    share = (np.arange(len(source)) - begins[source]) / pieces[source]
    after = np.minimum(source + 1, len(points) - 1)
    divided = points[source] + share[:, None] * (points[after] - points[source])
    return divided, sides[source] + share * (sides[after] - sides[source]), across[source], begins[first]


def _keep_near(
    points: Floats, sides: Floats, across: Floats, first: Places, plane_map: PlaneMap, around: Bounds
) -> tuple[Floats, Floats, Floats, Places]:
    """Keep the legs of which an end lies in a box on the bed; each run of them is a path."""
    inside = plane_map.inverse.holds(points)
    bed = plane_map.inverse.at(points)
    x0, y0, x1, y1 = around
    near = inside & (bed >= (x0, y0)).all(axis=1) & (bed <= (x1, y1)).all(axis=1)
    # A loop is kept as a whole: cut in two, it would have an end in the middle.
    last = first[1:] - 1
    loops = (points[first[:-1]] == points[last]).all(axis=1)
    near_loops = loops & np.logical_or.reduceat(near, first[:-1])
    near |= inside & np.repeat(near_loops, np.diff(first))
    is_leg = _legs(len(points), first)[:-1]
    legs = is_leg & (near[:-1] | near[1:]) & inside[:-1] & inside[1:]
    keep = np.zeros(len(points), dtype=bool)
    keep[:-1] |= legs
    keep[1:] |= legs
    # A path ends where the leg to the next point is left out.
    ends = keep & ~np.append(legs, False)
    number = np.cumsum(keep)
    return points[keep], sides[keep], across[keep], np.concatenate([[0], number[ends]]).astype(np.intp)


def line_angles(strands: Sequence[NominalStrand], bounds: Bounds) -> tuple[Floats, Floats]:
    """Return the directions of the legs whose middles lie in a box, radians, and their lengths, mm: (K,) each."""
    x0, y0, x1, y1 = bounds
    angles, lengths = [], []
    for strand in strands:
        step, middle = np.diff(strand.points, axis=0), (strand.points[:-1] + strand.points[1:]) / 2
        inside = ((middle >= (x0, y0)) & (middle <= (x1, y1))).all(axis=1)
        angles.append(np.arctan2(step[inside, 1], step[inside, 0]))
        lengths.append(np.hypot(*step[inside].T))
    return np.concatenate(angles), np.concatenate(lengths)


def scaled_length(strands: Sequence[NominalStrand], bounds: Bounds, scale: float, half_gap: float) -> float:
    """Return the length per area, 1/mm, of strands in a box, all of whose cells are divided by `scale`."""
    x0, y0, x1, y1 = bounds
    total = 0.0
    for strand in strands:
        middle = (strand.points[:-1] + strand.points[1:]) / 2
        inside = ((middle >= (x0, y0)) & (middle <= (x1, y1))).all(axis=1)
        line = strand.points / scale + half_gap * strand.sides[:, None] * strand.across
        total += float(np.hypot(*np.diff(line, axis=0)[inside].T).sum())
    return total * scale**2 / ((x1 - x0) * (y1 - y0))


def equal_normals(angles: Floats, lengths: Floats, count: int) -> Floats:
    """Return directions across lines, each for an equal share of their length, (count, 2)."""
    across = (angles + math.pi / 2) % math.pi
    order = np.argsort(across, kind="stable")
    share = np.cumsum(lengths[order])
    places = np.searchsorted(share, (np.arange(count) + 0.5) / count * share[-1])
    normal = across[order][np.minimum(places, len(order) - 1)]
    return np.stack([np.cos(normal), np.sin(normal)], axis=-1)
