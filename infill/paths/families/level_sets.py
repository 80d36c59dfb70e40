"""Triply periodic minimal surfaces at the height of a layer, solved for one coordinate: curves without a grid.

At some heights two sheets of such a surface meet in saddles, where its section crosses itself. A layer near such
a height takes the nearest one at which lines are still `TOUCH` line widths apart there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from infill.arrays import Floats
from infill.paths.families.curves import chord_parameters, repeat_curves, repeat_loop
from infill.paths.families.family import TOUCH, Bounds, Family, Path, PathSpec

# Neighbouring waves of a gyroid climb where they come nearest: the ratio of their distance along an axis to their
# distance. Measured on sections from 2.5 to 10 mm: at most 1.31.
ASLANT = 1.31
ALONG_X, ALONG_Y = np.eye(2), np.eye(2)[::-1]
STRETCHED = 2.0  # in height: waves grow by less than a bead from layer to layer
HEIGHTS = 64  # of a quarter of a period, in which the mean over heights is taken
PLACES = 256  # along a wave
DIAGONAL = np.array([[1.0, 1.0], [1.0, -1.0]]) / math.sqrt(2)


@dataclass(frozen=True, kw_only=True)
class GyroidPaths(Family):
    """sin x cos y + sin y cos z + sin z cos x = 0; `cell` is the period.

    Solved for y, y = atan2(cos z, sin x) ± acos(−sin z cos x / √(sin² x + cos² z)), where |cos z| > |sin z|; for x
    at the other heights.
    """

    name: str = "gyroid"
    summary: str = "smooth waves that turn with height; equally stiff in every direction"
    prismatic: bool = False
    length_in_cell: ClassVar[float] = 2.45
    stretches: ClassVar[bool] = True

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return two waves a period."""
        unit = spec.cell / math.tau
        sine, cosine = _keep_from_saddles(spec.z / unit, ASLANT * TOUCH * spec.line_width / unit)
        along_x = abs(cosine) > abs(sine)

        def middle(angle: Floats) -> Floats:
            """Return the middle of the two waves at angles, radians."""
            return np.arctan2(cosine, np.sin(angle)) if along_x else np.arctan2(np.cos(angle) * side, abs(sine))

        def swing(angle: Floats) -> Floats:
            """Return the offset of a wave from the middle at angles, radians."""
            if along_x:
                return np.arccos(-sine * np.cos(angle) / np.hypot(np.sin(angle), cosine))
            return np.arccos(-side * cosine * np.sin(angle) / np.hypot(np.cos(angle), sine))

        side = math.copysign(1.0, sine)
        curves = [lambda angle: middle(angle) + swing(angle), lambda angle: middle(angle) - swing(angle)]
        return repeat_curves(curves, unit, bounds, ALONG_X if along_x else ALONG_Y)


@dataclass(frozen=True, kw_only=True)
class SchwarzPPaths(Family):
    """cos x + cos y + cos z = 0; `cell` is the period.

    With c = |cos z|, every loop is cos x = c/2 + (1 − c/2) cos t, cos y = c/2 − (1 − c/2) cos t about its middle.
    """

    name: str = "schwarz-p"
    summary: str = "smooth tubes along three axes; every one a closed loop"
    prismatic: bool = False
    length_in_cell: ClassVar[float] = 1.88
    stretches: ClassVar[bool] = True

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one closed loop a period."""
        unit = spec.cell / math.tau
        cosine = math.cos(spec.z / unit)
        smallest = 1 - math.cos(min(math.pi / 2, spec.gap / unit / 2))
        half = max(abs(cosine), smallest) / 2

        def quarter(angle: Floats) -> Path:
            """Return points of a quarter of the loop at angles, mm."""
            swing = (1 - half) * np.cos(angle)
            return unit * np.arccos(np.clip(half + np.stack([swing, -swing], axis=-1), -1, 1))

        points = quarter(chord_parameters(quarter, math.pi))
        reversed_points = points[::-1]
        loop = np.concatenate(
            [points, (reversed_points * [1, -1])[1:], (points * [-1, -1])[1:], (reversed_points * [-1, 1])[1:]], axis=0
        )
        return repeat_loop(loop + (spec.cell / 2 if cosine > 0 else 0.0), spec.cell, bounds)


@dataclass(frozen=True, kw_only=True)
class SchwarzDPaths(Family):
    """cos z sin(x + y) + sin z cos(x − y) = 0; `cell` is the period."""

    name: str = "schwarz-d"
    summary: str = "smooth waves at 45 degrees that turn with height, as atoms in diamond are bound"
    prismatic: bool = False
    length_in_cell: ClassVar[float] = 3.04
    stretches: ClassVar[bool] = True

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return two waves a period."""
        unit = spec.cell / math.tau / math.sqrt(2)
        sine, cosine = _keep_from_saddles(spec.z * math.tau / spec.cell, spec.gap / unit)
        if abs(cosine) > abs(sine):  # x + y by x − y

            def swing(angle: Floats) -> Floats:
                return np.arcsin(sine / cosine * np.cos(angle))

            return repeat_curves(
                [lambda angle: -swing(angle), lambda angle: math.pi + swing(angle)], unit, bounds, DIAGONAL[::-1]
            )

        def reach(angle: Floats) -> Floats:
            return np.arccos(-cosine / sine * np.sin(angle))

        return repeat_curves([reach, lambda angle: -reach(angle)], unit, bounds, DIAGONAL)


@dataclass(frozen=True, kw_only=True)
class CrossHatchPaths(Family):
    """The surface of `patterns.hatch`; `cell` is its period in x and y, with two walls; upwards it is twice that.

    With weights a of cos x and b of cos y, where b is larger, cos y = -a / b cos x. Where both are the same, waves
    would meet: they stay `TOUCH` line widths apart.
    """

    name: str = "cross-hatch"
    summary: str = "walls alternately along y and along x, and waves where they change over"
    prismatic: bool = False

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one wave a wall."""
        unit = spec.cell / math.tau
        share, along_x = _weight_ratio(spec.z / unit / STRETCHED)
        share = min(share, math.cos(min(math.pi / 2, spec.gap / unit / 2)))

        def swing(angle: Floats) -> Floats:
            return np.arccos(-share * np.cos(angle))

        return repeat_curves([swing, lambda angle: -swing(angle)], unit, bounds, ALONG_X if along_x else ALONG_Y)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, in the mean over heights."""
        angle = np.linspace(0, math.tau, PLACES + 1)
        lengths = []
        for part in range(HEIGHTS):
            share, _ = _weight_ratio(math.pi / 2 * (part + 0.5) / HEIGHTS)
            lengths.append(np.hypot(np.diff(angle), np.diff(np.arccos(-share * np.cos(angle)))).sum() / math.tau)
        return 2 * float(np.mean(lengths)) * TOUCH * line_width / density


def _weight_ratio(z: float) -> tuple[float, bool]:
    """Return the smaller weight over the larger one at height `z`, radians, and True if the walls run along x."""
    from patterns.hatch import cross_hatch

    place, zero = np.array([0.0, math.pi / 2]), np.array([math.pi / 2, 0.0])
    of_x, of_y = cross_hatch(place, zero, np.full(2, z)).tolist()
    return min(of_x, of_y) / max(of_x, of_y), of_y > of_x


def _keep_from_saddles(angle: float, gap: float) -> tuple[float, float]:
    """Move an angle away from the odd multiples of 45°, where lines would meet; return its sine and cosine.

    Lines are 2 acos(t) apart there, for the smaller t of |tan| and |cot|: at least `gap` if t <= cos(gap / 2).
    """
    nearest = math.floor(angle / (math.pi / 2) + 0.5) * math.pi / 2
    limit = math.atan(math.cos(min(gap / 2, math.pi / 2)))
    clamped = nearest + max(-limit, min(limit, angle - nearest))
    return math.sin(clamped), math.cos(clamped)
