"""Protocol of a family of paths: centre lines over a plane, one layer at a time, that never cross.

Centre lines of two beads that touch are `TOUCH` line widths apart, the spacing of beads with rounded
sides: w − h (1 − π / 4) for a width w and a layer height h, which is 0.905 w for 0.45 and 0.2 mm.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

Path = NDArray[np.float64]  # (N, 2), mm; a closed one ends where it begins
Bounds = tuple[float, float, float, float]

TOUCH = 0.905


class Family(Protocol):
    """Centre lines over a box, at one layer.

    Attributes
    ----------
    name : str
        The name to type on the command line.
    summary : str
        Purpose of the family, in one phrase.
        prismatic : bool
        True if every layer is equal, so that each bead lies on the one below, however it is rounded.
    wide : bool
        True if its corners move outwards where there is room: its lines stand alone, and tear off no other.
    """

    @property
    def name(self) -> str:
        """The name to type on the command line."""
        ...

    @property
    def summary(self) -> str:
        """Purpose of the family, in one phrase."""
        ...

    @property
    def prismatic(self) -> bool:
        """True if every layer is equal."""
        ...

    @property
    def wide(self) -> bool:
        """True if its corners move outwards before rounding."""
        ...

    def strands(
        self, bounds: Bounds, *, cell: float, line_width: float, z: float, layer: int, radius: float
    ) -> list[Path]:
        """Return centre lines that cover a box; they may extend beyond it.

        Parameters
        ----------
        bounds : (x0, y0, x1, y1)
            mm. The position of lines does not depend on the box, so that regions and layers fit each other.
        cell : float
            Size of the pattern, mm; each family documents its meaning.
        line_width : float
            mm. Where the pattern has a wall in common, two lines run `TOUCH` line widths apart.
        z : float
            Height of the layer, mm.
        layer : int
            Its number.
        radius : float
            Upper limit for the rounding of corners, mm. The lines are returned with their corners, but placed so that
            they still touch after rounding; a radius above `largest_radius` counts as that one.

        Returns
        -------
        list of (N, 2) float64, mm
            No line crosses itself or another, before rounding or after it.
        """
        ...

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell, mm, at which beads fill about `density` (0 to 1) of the plane.

        Density is the length of lines times `TOUCH` line widths per area, as slicers count it.
        """
        ...

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return the largest radius of corners, mm, at which lines with a wall in common still touch."""
        ...


@runtime_checkable
class RegionFamily(Protocol):
    """Protocol of a family that follows the outline of the region: its lines need no clipping."""

    def strands_inside(self, region: Polygon | MultiPolygon, *, cell: float, line_width: float) -> list[Path]:
        """Return lines inside `region`, (N, 2) float64 each, mm."""
        ...
