"""Octagons and squares as touching waves: three a row, along the diagonal.

Three walls meet at every corner. Where one of them is drawn twice, two waves pass a corner, each from one side of the
double wall to one of the single ones. Of every square one slanted side is double, towards the upper right or, in every
second one, towards the lower left, and of the walls between octagons those at its two other corners.
One wave passes along the inside of the squares in one diagonal, another one between two such diagonals of squares, and
the third is the first, turned by half.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.paths.families.family import TOUCH, Bounds, Family, Path, PathSpec
from infill.paths.families.waves import BOND, repeat_line, solve_cell_for_density
from patterns.octagons import HALF_SIDE, SIDES

RIGHT, TOP, UPPER_RIGHT, UPPER_LEFT, LOWER_LEFT, LOWER_RIGHT = range(len(SIDES))
# Walls that a wave passes in one period, as a side of an octagon, the middle of the octagon relative to a square
# whose side to the upper right is double, and the side of the wall on which the wave lies: towards (x, y), or on it.
THROUGH = (
    (LOWER_LEFT, (0.5, 0.5), (-1, -1)),
    (LOWER_RIGHT, (-0.5, 0.5), (0, 0)),
    (TOP, (-0.5, -0.5), (0, 1)),
    (LOWER_LEFT, (-0.5, 0.5), (0, 0)),
    (RIGHT, (-1.5, 0.5), (1, 0)),
    (UPPER_LEFT, (-0.5, 0.5), (0, 0)),
)
BETWEEN = (
    (LOWER_LEFT, (0.5, 0.5), (1, 1)),
    (RIGHT, (-0.5, 0.5), (0, 0)),
    (UPPER_RIGHT, (-0.5, 0.5), (-1, -1)),
    (TOP, (-0.5, 0.5), (0, 0)),
)
SQUARE = (-0.5, 0.5)  # whose side to the upper right is double; that of the next one to the right is on the lower left
ANGLE = 135.0  # degrees, of the waves
LEAST = 3.6  # gaps of touching lines, that an octagon is wide: single walls shrink to nothing


@dataclass(frozen=True, kw_only=True)
class OctagonsPaths(Family):
    """Octagons `cell` wide, one about (0, 0), and the squares between them. A third of the walls is drawn twice."""

    name: str = "octagons"
    summary: str = "octagons and squares, drawn as waves that touch; round cells"

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return three waves a row."""
        diagonal = math.sqrt(2) * self._width(spec.cell, spec.line_width)  # from octagon to octagon, both ways
        paths: list[Path] = []
        for wave in self._waves(spec.cell, spec.line_width):
            paths += repeat_line(wave[:-1], diagonal, diagonal, angle=ANGLE, bounds=bounds)
        return paths

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density."""

        def length_per_area(cell: float) -> float:
            lengths = [np.hypot(*np.diff(wave, axis=0).T).sum() for wave in self._waves(cell, line_width)]
            return float(sum(lengths)) / (2 * self._width(cell, line_width) ** 2)

        return solve_cell_for_density(length_per_area, density, line_width)

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the radius at which the rest of a double wall between right angles still touches, mm."""
        return max(0.0, HALF_SIDE * self._width(cell, line_width) - BOND * line_width / 2)

    def _width(self, cell: float, line_width: float) -> float:
        """Return the distance between opposite sides of an octagon, mm: the cell, or the smallest that can be drawn."""
        return max(cell, LEAST * TOUCH * line_width)

    def _waves(self, cell: float, line_width: float) -> list[Path]:
        """Return one period of each wave and the first corner of the next, (N, 2), turned so that rows are level."""
        from patterns.linework import turn

        width, gap = self._width(cell, line_width), TOUCH * line_width
        waves = [_wave_corners(walls, gap / width) + SQUARE for walls in (THROUGH, BETWEEN)]
        waves.append((0.0, 2 * SQUARE[1]) - waves[0][::-1])  # about the middle between two squares
        level = [turn(wave * width, -ANGLE) for wave in waves]
        diagonal = math.sqrt(2) * width
        return [wave - (wave[0, 0] // diagonal * diagonal, 0.0) for wave in level]


def _wave_corners(walls: tuple[tuple[int, tuple[float, float], tuple[int, int]], ...], gap: float) -> Path:
    """Intersect each wall with the next one; return the corners, and the first of the next period: (N + 1, 2)."""
    sides = np.array(SIDES)
    ends = np.array([sides[side] + middle for side, middle, _ in walls])
    offset_direction = np.array([towards for _, _, towards in walls], dtype=np.float64)
    ends += (offset_direction / np.maximum(np.hypot(*offset_direction.T), 1.0)[:, None] * gap / 2)[:, None]
    ends = np.concatenate([ends, ends[:2] + np.array([-1.0, 1.0])])
    begin, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    between = begin[1:] - begin[:-1]
    cross = along[:-1, 0] * along[1:, 1] - along[:-1, 1] * along[1:, 0]
    share = (between[:, 0] * along[1:, 1] - between[:, 1] * along[1:, 0]) / cross
    corners: Path = begin[:-1] + share[:, None] * along[:-1]
    return corners
