r"""Quarter cubic: sections of tetrahedra with every crossing resolved, drawn as two waves a row that touch.

The planes of `patterns.QuarterCubic` are cut at one height in lines u = x + y and v = x - y. Those along u lie
in pairs about fixed middles, those along v as well: as z rises, lines of a pair part until they meet those of the
next pairs, and come back. A wave climbs along one line of v and comes down along one of u, turn by turn; flats at
every corner touch the waves above and below::

         /\                  of each pair of u, one line is climbed along and the other
        /  \    __/\         on the way back, so that a wave has four flanks a period
    \__/    \  /    \__/
             \/
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from infill.paths.families.family import Bounds, Family, Path, PathSpec
from infill.paths.families.waves import crest_length, repeat_line, solve_cell_for_density

TURN = math.radians(45)  # at each end of a flat
FLATS = 4  # of a wave in one period
SAME = 1e-6  # mm: corners nearer than that are one


@dataclass(frozen=True, kw_only=True)
class QuarterCubicPaths(Family):
    """Tetrahedra, with and without corners; `cell` is the period in x, y and z, before flats and touching are added.

    Planes are `cell` / √3 apart.
    """

    name: str = "quarter-cubic"
    summary: str = "tetrahedra, with and without corners; very stiff for its weight, in height as well"
    prismatic: bool = False
    corner_share: ClassVar[float] = 0.1  # cells keep their shape; flats touch at any radius

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return two waves a row."""
        cell, gap = spec.cell, spec.gap
        crest, period, pitch = self._sizes(spec)
        (middle_u, half_u), (middle_v, half_v) = (_line_pair(spec.z / cell, sign) for sign in (1, -1))
        # Places are those of planes, plus the room for flats along a row, and for touching waves across it: the
        # pairs keep their middles.
        x = (middle_u + middle_v) / 2 * period
        y = (middle_u - middle_v) / 2 * 2 * pitch
        u, v = half_u * cell, half_v * cell
        climb_end = np.array([-(u + v) / 2 - crest, (v - u) / 2])
        top = np.array([(u - v) / 2, (u + v) / 2])
        down = np.array([(u + v) / 2 + crest, (u - v) / 2])
        tail = np.array([cell / 2 - (u - v) / 2 + 2 * crest, cell / 2 - (u + v) / 2])
        upper = np.array([climb_end, top, down, tail]) + np.array([0.0, gap / 2])
        # A half turn about the middle of both pairs puts the wave above on the one below.
        lower = -upper[[2, 1, 0, 3]]
        lower[3, 0] += period
        ends = np.array([[-crest / 2, 0.0], [crest / 2, 0.0]])
        paths: list[Path] = []
        for wave in (upper, lower):
            corners = (wave[:, None] + ends).reshape(-1, 2)
            before = np.concatenate([corners[-1:] - (period, 0.0), corners[:-1]])
            is_distinct = np.hypot(*(corners - before).T) > SAME  # where lines of pairs meet, two flats are one
            paths += repeat_line(
                corners[is_distinct] + (0.0, y), period, pitch, shift=x, slip=period / 2, bounds=bounds
            )
        return paths

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, which is the same at every height."""

        def length_per_area(cell: float) -> float:
            crest, period, pitch = self._sizes(PathSpec(cell=cell, line_width=line_width))
            return 2 * (math.sqrt(2) * cell + FLATS * crest) / (period * pitch)

        return solve_cell_for_density(length_per_area, density, line_width)

    def _sizes(self, spec: PathSpec) -> tuple[float, float, float]:
        """Return the length of a flat, the period and the pitch of rows, mm."""
        crest = crest_length(spec.line_width, min(spec.radius, self.largest_radius(spec.cell, spec.line_width)), TURN)
        return crest, spec.cell + FLATS * crest, spec.cell / 2 + 2 * spec.gap


def _line_pair(z: float, sign: int) -> tuple[float, float]:
    """Return middle and half difference of x + y (x - y for sign -1), in cells, of the two lines at height z."""
    from patterns.planes import QuarterCubic

    normals, offsets = QuarterCubic().families()
    # A plane n . p + offset = 0 cuts the height z in x + sign y = -(n_z z + offset) n_x, modulo 1.
    along = normals[:, 0] * normals[:, 1] == sign
    place = -(normals[along, 2] * z + offsets[along])[0] * normals[along, 0][0]
    middle = (offsets[along] @ -normals[along, 0]) / 2 % 0.5
    half = place - middle
    return float(middle), float(abs((half + 0.5) % 1 - 0.5))
