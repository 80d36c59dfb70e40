r"""Lateral honeycomb: hexagonal tubes along x, stacked. A layer of it consists of straight lines.

Seen from an end of the tubes, every wall is two lines wide::

       \    //   //    \
        \  //     \  //       two leaning walls part,
         ||         ||          and stand upright again where they meet others
         ||         ||
        //  \     //  \
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.paths.families.protocol import TOUCH, Bounds, Path


@dataclass(frozen=True, kw_only=True)
class LateralHoneycombPaths:
    """Two lines a tube; `cell` is the distance between upright walls, in which both lines touch."""

    name: str = "lateral-honeycomb"
    summary: str = "hexagonal tubes on their side, along x; straight lines in every layer"
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
        """Return straight lines, two a tube; see `Family`."""
        from patterns.honeycombs import LateralHoneycomb

        tubes = LateralHoneycomb()
        (normals, _), (period, _) = tubes.faces(), tubes.lattice()
        _, across, up = normals[1]
        # Of a leaning wall, and of a tube with one upright wall, in cells.
        rise, height = across / up / 2, period[2] / 2
        # The tubes of a height have their middles at y = 0, and those of the next one half a cell beside; in between,
        # two lines lean from the upright walls of the lower tubes, by half a cell each.
        part = z / cell / height % 2
        above = (1 - abs(part - 1)) * height - (height - rise) / 2
        offset = float(np.clip(above * up / across, 0, 0.5)) * cell
        half = TOUCH * line_width / 2
        offset = min(max(offset, half), max(cell / 2 - half, half))
        x0, y0, x1, y1 = bounds
        row = np.arange(np.floor(y0 / cell) - 1, np.ceil(y1 / cell) + 1)
        places = np.concatenate([(row + 0.5) * cell - offset, (row + 0.5) * cell + offset])
        return [np.array([[x0 - cell, y], [x1 + cell, y]]) for y in np.sort(places).tolist()]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density, which is the same at every height; see `Family`."""
        return 2 * TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return a quarter of the cell, mm: the radius of a turn at the wall where lines are evenly apart."""
        return cell / 4
