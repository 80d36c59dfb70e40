"""Concentric hearts: nested copies of one outline about one point."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.paths.families.curves import SAGITTA
from infill.paths.families.protocol import TOUCH, Bounds, Path

SMALLEST = 3.0  # line widths that the side of the innermost heart has, at least
FEWEST, MOST = 9, 513  # points on a lobe


@dataclass(frozen=True, kw_only=True)
class ConcentricHeartPaths:
    """Hearts inside one another, `cell` apart at their straight sides and up to twice that at their lobes.

    They lie about `middle`, mm, or else about the middle of the box, turned by `angle` degrees. `middle` should be
    that of the entire part in every layer.
    """

    name: str = "concentric-heart"
    summary: str = "nested hearts; lines that follow an outline and never cross"
    prismatic: bool = True
    wide: bool = False
    middle: tuple[float, float] | None = None
    angle: float = 0.0

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float,  # noqa: ARG002 - every layer is equal
        layer: int,  # noqa: ARG002
        radius: float,  # noqa: ARG002 - lines stand alone
    ) -> list[Path]:
        """Return one closed line per heart; see `Family`."""
        from patterns.heart import heart_outline
        from patterns.linework import turn

        box = np.array(bounds).reshape(2, 2)
        middle = box.mean(axis=0) if self.middle is None else np.array(self.middle)
        # The heart on a square of side s contains the disc of radius s / 2 about the middle of the square.
        count = math.ceil(math.hypot(*np.abs(box - middle).max(axis=0)) / cell) + 1
        sides = cell * (2 * np.arange(count) + 1)
        return [
            turn(side * (heart_outline(_lobe_points(side / 2)) - 0.5), self.angle) + middle
            for side in sides
            if side >= SMALLEST * line_width
        ]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return 0.83 * TOUCH * line_width / density  # as measured in a square, whose corners see straight sides most

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the distance between hearts, mm: larger arcs would leave the tip."""
        return cell


def _lobe_points(radius: float) -> int:
    """Return the number of points, an odd one, on a half circle."""
    exact_count = math.pi / 2 / math.acos(max(0.0, 1 - SAGITTA / radius))
    return min(MOST, max(FEWEST, 2 * math.ceil(exact_count / 2) + 1))
