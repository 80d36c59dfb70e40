"""Lines parallel to the outline of the region, one inside another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import cell_parameter

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon

ARC = 16  # chords in a quarter of the circle about a corner


@dataclass(frozen=True, kw_only=True)
class Concentric(Pattern):
    """Closed lines at (k + 1/2) `cell` from the outline of the region.

    There is about 1 / `cell` mm of line per square millimetre. Where the region is narrower than a cell, there is none.
    """

    name: ClassVar[str] = "concentric"
    summary: ClassVar[str] = "lines that follow the outline of the region"
    follows: ClassVar[bool] = True

    cell: float = cell_parameter()

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the outlines of the insets, the largest first."""
        import numpy as np
        import shapely

        rings = [shapely.get_rings(shapely.get_parts(inner)) for inner in insets(region, self.cell)]
        return shapely.MultiLineString(list(np.concatenate([np.empty(0, dtype=object), *rings])))

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between neighbouring lines, mm."""
        return self.cell


def insets(region: Polygon | MultiPolygon, cell: float) -> Iterator[Polygon | MultiPolygon]:
    """Yield what lies further than (k + 1/2) `cell` inside the outline of a region, k = 0, 1, ...

    >>> from shapely import box
    >>> [inner.bounds for inner in insets(box(0, 0, 9, 4), 2.0)]
    [(1.0, 1.0, 8.0, 3.0)]
    """
    inner = region.buffer(-cell / 2, quad_segs=ARC)
    while not inner.is_empty:
        yield inner
        inner = inner.buffer(-cell, quad_segs=ARC)
