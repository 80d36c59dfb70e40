r"""Families of plain rows: lines, zigzags whose crests touch, and honeycombs of three kinds.

Honeycomb in three dimensions: in units of half a cell, the octahedra |x|, |y|, |z| <= 1, |x| + |y| + |z| <= 3/2 about
the points of a body-centred lattice fill space. At a height |z| <= 1/2 the section is of squares that stand on a
corner, with half a diagonal d = 1/2 + |z|, and of straight walls between their corners. A pair of waves passes above
and below every row of squares and touches along the straight walls. Half a cell higher the rows run across; both
directions draw the same squares there, so that each layer lies on the one below.

Lateral honeycomb: hexagonal tubes along x, stacked. Seen from an end of the tubes, every wall is two lines wide::

       \    //   //    \
        \  //     \  //       two leaning walls part,
         ||         ||          and stand upright again where they meet others
         ||         ||
        //  \     //  \
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from infill.paths.families.family import Bounds, Family, Path, PathSpec
from infill.paths.families.waves import Rows, Wave, WaveFamily, crest_length, draw_rows

TURN = math.radians(45)  # of a zigzag, at each end of a crest
TURN_OF_FLAT = math.radians(60)  # of a honeycomb
SECTIONS = 24  # in which the mean over heights is taken


@dataclass(frozen=True, kw_only=True)
class RectilinearPaths(Family):
    """Lines at 45° in even layers and at 135° in odd ones, `cell` apart: each rests on all those that it crosses."""

    name: str = "rectilinear"
    summary: str = "straight lines, across one another from layer to layer; quick to print"
    prismatic: bool = False
    corner_share: ClassVar[float] = 0.5  # of a turn at the wall
    stretches: ClassVar[bool] = True

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one line per row."""
        line = Wave(period=spec.cell, bottom=spec.cell, top=0, height=0)
        return draw_rows(Rows(waves=[line], pitch=spec.cell, slip=0, angle=(45, 135)[spec.layer % 2]), bounds)


@dataclass(frozen=True, kw_only=True)
class Zigzags(WaveFamily):
    """Flanks at 45° to the rows, which run at `angle` degrees; `cell` is the distance between parallel flanks.

    >>> rows = Zigzags(name="zigzag", summary="").rows(PathSpec(cell=4.0, line_width=0.45, radius=1.0))
    >>> round(rows.waves[0].height, 3), round(rows.pitch, 3)
    (2.828, 3.236)
    """

    angle: float = 0.0
    corner_share: ClassVar[float] = 0.3  # cells stay nearly square; crests touch at any radius
    stretches: ClassVar[bool] = True
    touches: ClassVar[bool] = True

    def rows(self, spec: PathSpec) -> Rows:
        """Return the rows of zigzags."""
        height = spec.cell / math.sqrt(2)
        crest = crest_length(spec.line_width, self.radius_of(spec), TURN)
        wave = Wave(period=2 * (height + crest), bottom=crest, top=crest, height=height)
        return Rows(waves=[wave], pitch=height + spec.gap, slip=wave.period / 2, angle=self.angle)


ZIGZAG = Zigzags(name="zigzag", summary="the paper's crossing strokes, resolved into zigzags that touch")
GRID = Zigzags(name="grid", summary="squares; every crossing resolved, so that no bead runs over another", angle=45.0)


@dataclass(frozen=True, kw_only=True)
class HoneycombPaths(WaveFamily):
    """Touching waves, every second one mirrored: hexagons with single walls across the rows and double ones along them.

    `cell` is the distance between the walls along the rows. Flats are `flats` times as long as flanks, and what
    rounding takes from them: at any radius, about flats / (1 + flats) of the lines touches a neighbour.

    >>> rows = HoneycombPaths().rows(PathSpec(cell=6.0, line_width=0.45))
    >>> round(rows.pitch, 3), round(rows.waves[0].top, 3)
    (3.407, 3.464)
    """

    name: str = "honeycomb"
    summary: str = "hexagons drawn as touching waves; stiff from above, equally soft from all sides"
    flats: float = 1.0
    corner_share: ClassVar[float] = 0.5  # where the arcs of a flank meet; flanks alone are the limit
    stretches: ClassVar[bool] = True
    touches: ClassVar[bool] = True

    def rows(self, spec: PathSpec) -> Rows:
        """Return the rows of waves."""
        side, height = spec.cell / math.sqrt(3), spec.cell / 2
        flat = self.flats * side + 2 * self.radius_of(spec) * math.tan(TURN_OF_FLAT / 2)
        wave = Wave(period=2 * flat + side, bottom=flat, top=flat, height=height)
        return Rows(waves=[wave], pitch=height + spec.gap, slip=wave.period / 2)


@dataclass(frozen=True, kw_only=True)
class Honeycomb3DPaths(WaveFamily):
    """Truncated octahedra; `cell` is the distance between neighbours side by side, and of equal layers.

    >>> low, high = Honeycomb3DPaths().rows(PathSpec(cell=8.0, line_width=0.45)).waves
    >>> round(high.height, 3), round(high.bottom, 3), round(high.base - low.base - low.height, 3)
    (1.796, 4.407, 0.407)
    """

    name: str = "honeycomb-3d"
    summary: str = "truncated octahedra; closed cells that are stiff in height as well"
    prismatic: bool = False
    corner_share: ClassVar[float] = 0.25  # half of the shortest flank: where its arcs meet in the lowest section

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return two waves a row."""
        if not _runs_along_y(spec):
            return draw_rows(self.rows(spec), bounds)
        x0, y0, x1, y1 = bounds
        return [path[:, ::-1] for path in draw_rows(self.rows(spec), (y0, x0, y1, x1))]

    def rows(self, spec: PathSpec) -> Rows:
        """Return the rows of waves, as if they ran along x."""
        cell, gap = spec.cell, spec.gap
        part = 2 * spec.z / cell % 1
        half = 0.5 + min(part, 1 - part)
        height = half * (cell / 2 - gap)
        wall = cell - 2 * height
        place = cell / 2 if _runs_along_y(spec) else 0.0
        high = Wave(period=cell, bottom=wall, top=0, height=height, base=place + gap / 2, shift=place)
        low = Wave(
            period=cell, bottom=0, top=wall, height=height, base=place - gap / 2 - height, shift=place + cell / 2
        )
        return Rows(waves=[low, high], pitch=cell, slip=0)

    def heights(self, cell: float) -> list[float]:
        """Return the heights of the sections of half a cell, mm."""
        return [cell / 2 * part / SECTIONS for part in range(SECTIONS)]


def _runs_along_y(spec: PathSpec) -> bool:
    """Tell whether rows run along y."""
    return math.floor(2 * spec.z / spec.cell + 0.5) % 2 == 1


@dataclass(frozen=True, kw_only=True)
class LateralHoneycombPaths(Family):
    """Straight lines, two a tube; `cell` is the distance between upright walls, in which both lines touch."""

    name: str = "lateral-honeycomb"
    summary: str = "hexagonal tubes on their side, along x; straight lines in every layer"
    prismatic: bool = False
    length_in_cell: ClassVar[float] = 2.0  # at every height
    corner_share: ClassVar[float] = 0.25  # of a turn at the wall where lines are evenly apart

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return the lines of the layer."""
        from patterns.honeycombs import LateralHoneycomb

        cell, half = spec.cell, spec.gap / 2
        tubes = LateralHoneycomb()
        (normals, _), (period, _) = tubes.faces(), tubes.lattice()
        _, across, up = normals[1]
        # Of a leaning wall, and of a tube with one upright wall, in cells.
        rise, height = across / up / 2, period[2] / 2
        # The tubes of a height have their middles at y = 0, and those of the next one half a cell beside; in between,
        # two lines lean from the upright walls of the lower tubes, by half a cell each.
        part = spec.z / cell / height % 2
        above = (1 - abs(part - 1)) * height - (height - rise) / 2
        offset = float(np.clip(above * up / across, 0, 0.5)) * cell
        offset = min(max(offset, half), max(cell / 2 - half, half))
        x0, y0, x1, y1 = bounds
        row = np.arange(np.floor(y0 / cell) - 1, np.ceil(y1 / cell) + 1)
        places = np.concatenate([(row + 0.5) * cell - offset, (row + 0.5) * cell + offset])
        return [np.array([[x0 - cell, y], [x1 + cell, y]]) for y in np.sort(places).tolist()]
