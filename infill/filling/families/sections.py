"""Sections of surfaces that are given by a formula alone: sampled over one period, followed, and repeated.

At some heights sheets of such a surface meet in saddles, where its section crosses itself. A layer near such a height
takes the nearest one at which lines are still `TOUCH` line widths apart everywhere.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from infill.filling.families.protocol import TOUCH, Bounds, Path
from infill.filling.families.waves import cell_of
from infill.filling.tile_nodes import TileGrid
from infill.filling.tile_paths import Strand, repeated, tile_strands

Floats = NDArray[np.float64]

HEIGHTS = 960  # sections of a period: from one to the next, lengths change by a hundredth at most
COARSE = 4  # of them, from one to the next that is tried where lines would come too near
NODES = 160  # of a period, along x and y: a saddle is missed by less than a thousandth of it
PAD = 2
STEP = 0.008  # of a period, between points by which spacings are judged
REACH = 0.3  # of a period: lines that far apart are far enough for any line width
BACK = (
    2.0  # a line comes back to itself where the way along it is so many times as long as across: more than on a circle
)
SURE = 1.01  # of the spacing of beads that touch
MEAN_OF = 48  # sections by which the mean length over heights is taken
SIZE, RATIO = 8.0, 2.0  # mm: a period for which sections are cut into chords, and of those the ratio


@dataclass(frozen=True, kw_only=True)
class Sections:
    """A minimal surface of `patterns.tpms`; `cell` is its period. Loops that would be a blot are left out.

    Periods at which lines would come too near at every height are drawn as the smallest at which they do not.

    Parameters
    ----------
    widest : float
        How far apart lines are, in periods, at the height at which they are farthest apart, or a little less.
    """

    name: str
    summary: str
    widest: float
    prismatic: bool = False
    wide: bool = False

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float,
        layer: int,  # noqa: ARG002 - the height says it
        radius: float,  # noqa: ARG002 - there are no corners
    ) -> list[Path]:
        """Return the section at the height, or near it; see `Family`."""
        gap = TOUCH * line_width
        period = self._period(cell, line_width)
        found = self._section(z / period, gap / period)
        size = SIZE * RATIO ** round(math.log(period / SIZE, RATIO))
        strands = [
            Strand(points=strand.points * (period / size), tiles=strand.tiles)
            for strand in cut(self.name, found, size)
            if strand.tiles != (0, 0) or _length(strand.points) * period / size > math.pi * gap
        ]
        return repeated(strands, (period, period), bounds)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, in the mean over heights; see `Family`."""

        def length_per_area(cell: float) -> float:
            period = self._period(cell, line_width)
            gap = TOUCH * line_width / period
            lengths = [
                sum(_length(strand.points) for strand in cut(self.name, self._section(part / MEAN_OF, gap), SIZE))
                / SIZE
                for part in range(MEAN_OF)
            ]
            return sum(lengths) / MEAN_OF / period

        return cell_of(length_per_area, density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return infinity: the curves have no corners, and no wall in common."""
        return math.inf

    def _period(self, cell: float, line_width: float) -> float:
        return max(cell, SURE * TOUCH * line_width / self.widest)

    def drawn_at(self, z: float, *, cell: float, line_width: float) -> float:
        """Return the height, mm, of the section that is drawn at a height: modulo the period, and near it."""
        period = self._period(cell, line_width)
        return self._section(z / period, TOUCH * line_width / period) * period / HEIGHTS

    def _section(self, height: float, gap: float) -> int:
        """Return the number of the section nearest to a height in which lines are `gap` apart; both in periods."""
        exact, middle = round(height * HEIGHTS) % HEIGHTS, round(height * HEIGHTS / COARSE) * COARSE
        if spacing(self.name, exact) >= SURE * gap:
            return exact
        for away in range(0, HEIGHTS // 2 + 1, COARSE):
            for near in (middle + away, middle - away):
                if spacing(self.name, near % HEIGHTS) >= SURE * gap:
                    return near % HEIGHTS
        raise AssertionError(f"lines of {self.name} are nowhere {gap:g} periods apart")


@lru_cache(maxsize=512)
def cut(name: str, height: int, size: float) -> tuple[Strand, ...]:
    """Return the lines of a surface at one of the heights, for a period of `size` mm; each once."""
    from patterns.tpms import TPMS

    value = {each.name: each for each in TPMS}[name].value
    grid = TileGrid(size=(size, size), shape=(NODES, NODES), pad=PAD)
    x, y = ((grid.first[axis] + np.arange(grid.nodes[axis]) * grid.spacing[axis]) / size for axis in (0, 1))
    x, y = np.meshgrid(x * math.tau, y * math.tau, indexing="ij")
    field = value(x, y, np.full(grid.nodes, math.tau * height / HEIGHTS))
    return tuple(tile_strands(field, grid))


@lru_cache(maxsize=8 * HEIGHTS)
def spacing(name: str, height: int) -> float:
    """Return how near lines of a surface at one of the heights come to each other, in periods; `REACH` at most."""
    from scipy.spatial import cKDTree

    points, owners, places, rounds = [], [], [], []
    for number, strand in enumerate(cut(name, height, SIZE)):
        line = strand.points / SIZE
        passed = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        place = np.linspace(0, passed[-1], math.ceil(passed[-1] / STEP), endpoint=False)
        points.append(np.stack([np.interp(place, passed, axis) for axis in line.T], axis=-1))
        places.append(place)
        owners.append(np.full(len(place), number))
        rounds.append(np.full(len(place), passed[-1]))
    point, owner, place, around = (np.concatenate(each) for each in (points, owners, places, rounds))
    tree = cKDTree(np.mod(point, 1.0) % 1.0, boxsize=1.0)
    one, other = tree.query_pairs(REACH, output_type="ndarray").T
    across = point[one] - point[other]
    away = np.hypot(*(across - np.round(across)).T)
    along = np.abs(place[one] - place[other])
    along = np.minimum(along, around[one] - along)
    return float(away[(owner[one] != owner[other]) | (along > BACK * away)].min(initial=REACH))


def _length(line: Path) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


FISCHER_KOCH_S = Sections(
    name="fischer-koch-s", summary="curves around winding channels that change with height", widest=0.23
)
LIDINOID = Sections(name="lidinoid", summary="curves around winding channels, close to one another", widest=0.13)
NEOVIUS = Sections(name="neovius", summary="loops around chambers with twelve openings", widest=0.16)
I_WP = Sections(name="i-wp", summary="loops around chambers that are joined along the diagonals", widest=0.28)
