"""Cross: Sierpinski's curve, one line around a tree of crosses."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from infill.errors import ParameterError
from infill.paths.families.protocol import TOUCH, Bounds, Path
from patterns.cross import ORIGIN, SIDE, curve_steps

MARGIN = 2  # octagons, beyond the box, whose steps are drawn


@dataclass(frozen=True, kw_only=True)
class CrossPaths:
    """The one curve of order 24 about (0, 0), with steps `cell` long: lines are nowhere nearer to one another."""

    name: str = "cross"
    summary: str = "one line around a tree of crosses; soft in every direction"
    prismatic: bool = True
    wide: bool = True

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,  # noqa: ARG002 - lines stand alone
        z: float,  # noqa: ARG002 - every layer is equal
        layer: int,  # noqa: ARG002
        radius: float,  # noqa: ARG002 - corners need no room
    ) -> list[Path]:
        """Return the parts of the curve in the box; see `Family`."""
        import shapely

        pitch = cell / SIDE
        corners = np.array(bounds, dtype=np.float64).reshape(2, 2) / pitch
        low, high = np.floor(corners[0]) - MARGIN, np.ceil(corners[1]) + MARGIN
        if max(-low.min(), high.max()) > ORIGIN:
            raise ParameterError(f"the cell is {cell:g} mm; the curve reaches {ORIGIN} octagons: give a larger one")
        merged = shapely.line_merge(shapely.multilinestrings(curve_steps(low, high)))
        return [shapely.get_coordinates(part) * pitch for part in shapely.get_parts(merged)]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`: each octagon has four steps."""
        return 4 * SIDE**2 * TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which the arcs of a step that turns by 45° at both ends meet, mm."""
        return cell / 2 / math.tan(math.pi / 8)
