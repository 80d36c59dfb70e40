"""Cross hatch: walls alternately along y and along x, as waves that grow until they change to the other direction."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.paths.families.curves import Floats, repeat_curves
from infill.paths.families.level_sets import ALONG_X, ALONG_Y
from infill.paths.families.protocol import TOUCH, Bounds, Path

STRETCHED = 2.0  # in height: waves grow by less than a bead from layer to layer
HEIGHTS = 64  # of a quarter of a period, in which the mean over heights is taken
PLACES = 256  # along a wave


@dataclass(frozen=True, kw_only=True)
class CrossHatchPaths:
    """The surface of `patterns.hatch`; `cell` is its period in x and y, with two walls; upwards it is twice that.

    With weights a of cos x and b of cos y, where b is larger, cos y = -a / b cos x. Where both are the same, waves
    would meet: they stay `TOUCH` line widths apart.
    """

    name: str = "cross-hatch"
    summary: str = "walls alternately along y and along x, and waves where they change over"
    prismatic: bool = False
    wide: bool = False

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,
        z: float,
        layer: int,  # noqa: ARG002 - the height decides
        radius: float,  # noqa: ARG002 - there are no corners
    ) -> list[Path]:
        """Return one wave a wall; see `Family`."""
        unit = cell / math.tau
        share, along_x = _weight_ratio(z / unit / STRETCHED)
        share = min(share, math.cos(min(math.pi / 2, TOUCH * line_width / unit / 2)))

        def swing(angle: Floats) -> Floats:
            return np.arccos(-share * np.cos(angle))

        return repeat_curves([swing, lambda angle: -swing(angle)], unit, bounds, ALONG_X if along_x else ALONG_Y)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, in the mean over heights; see `Family`."""
        angle = np.linspace(0, math.tau, PLACES + 1)
        lengths = []
        for part in range(HEIGHTS):
            share, _ = _weight_ratio(math.pi / 2 * (part + 0.5) / HEIGHTS)
            lengths.append(np.hypot(np.diff(angle), np.diff(np.arccos(-share * np.cos(angle)))).sum() / math.tau)
        return 2 * float(np.mean(lengths)) * TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return infinity: the curves have no corners, and no wall in common."""
        return math.inf


def _weight_ratio(z: float) -> tuple[float, bool]:
    """Return the smaller weight over the larger one at height `z`, radians, and True if the walls run along x."""
    from patterns.hatch import cross_hatch

    place, zero = np.array([0.0, math.pi / 2]), np.array([math.pi / 2, 0.0])
    of_x, of_y = cross_hatch(place, zero, np.full(2, z)).tolist()
    return min(of_x, of_y) / max(of_x, of_y), of_y > of_x
