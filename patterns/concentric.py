"""Lines parallel to the outline of the region, one inside another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.protocol import Pattern
from patterns.shared import cell_parameter, frame_parameter

if TYPE_CHECKING:
    from shapely import MultiLineString, MultiPolygon, Polygon

ARC = 16  # chords in a quarter of the circle about a corner


@dataclass(frozen=True, kw_only=True)
class Concentric(Pattern):
    """Closed lines at k `cell` from the outline of the region, which is the frame; without one, at (k + 1/2) `cell`.

    There is about 1 / `cell` mm of line per square millimetre, and none where the region is narrower than a cell.
    """

    name: ClassVar[str] = "concentric"
    summary: ClassVar[str] = "lines parallel to the outline, one inside another"
    paths: ClassVar[bool] = True
    follows: ClassVar[bool] = True

    cell: float = cell_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the outlines of the insets, the largest first, and the frame."""
        import shapely

        from patterns.linework import add_frame

        first_distance = self.cell if self.frame else self.cell / 2
        rings = [shapely.get_rings(shapely.get_parts(inner)) for inner in insets(region, first_distance, self.cell)]
        lines = shapely.MultiLineString([ring for level in rings for ring in level])
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the distance between neighbouring lines, mm."""
        return self.cell


def insets(region: Polygon | MultiPolygon, first: float, cell: float) -> Iterator[Polygon | MultiPolygon]:
    """Yield the parts of a region further than `first` + k `cell` inside its outline, k = 0, 1, ...

    >>> from shapely import box
    >>> [inner.bounds for inner in insets(box(0, 0, 9, 7), 1.0, 2.0)]
    [(1.0, 1.0, 8.0, 6.0), (3.0, 3.0, 6.0, 4.0)]
    """
    inner = region.buffer(-first, quad_segs=ARC)
    while not inner.is_empty:
        yield inner
        inner = inner.buffer(-cell, quad_segs=ARC)
