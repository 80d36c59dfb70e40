"""Insets of the region, one inside another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from infill.paths.families.protocol import TOUCH, Bounds, Path
from patterns.concentric import ARC, insets

if TYPE_CHECKING:
    from shapely import MultiPolygon, Polygon

SIMPLER = 0.002  # mm


@dataclass(frozen=True, kw_only=True)
class ConcentricPaths:
    """Closed lines at (k + 1/2) `cell` from the outline; where two sides of one would overlap, it draws back."""

    name: str = "concentric"
    summary: str = "lines that follow the outline of the region"
    prismatic: bool = True
    wide: bool = False

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
        """Return the insets of the box; see `Family`."""
        from shapely import box

        return self.strands_inside(box(*bounds), cell=cell, line_width=line_width)

    def strands_inside(self, region: Polygon | MultiPolygon, *, cell: float, line_width: float) -> list[Path]:
        """Return the insets of the region; see `RegionFamily`."""
        import shapely

        paths: list[Path] = []
        for inner in insets(region, cell / 2, cell):
            open_area = shapely.simplify(_without_necks(inner, TOUCH * line_width / 2), SIMPLER)
            paths.extend(shapely.get_coordinates(ring) for ring in shapely.get_rings(shapely.get_parts(open_area)))
        return paths

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the distance between lines, mm: larger arcs would leave the corners empty."""
        return cell


def _without_necks(inner: Polygon | MultiPolygon, half: float) -> Polygon | MultiPolygon:
    """Cut the necks out of an area, so that it holds discs of radius `half` everywhere.

    The ends at a neck are as far apart as the neck is wide.
    """
    opened = inner.buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)
    necks = opened.buffer(half, quad_segs=ARC).buffer(-half, quad_segs=ARC).difference(opened)
    if necks.area < (half / 8) ** 2:  # of fillets between chords of arcs, not of a neck
        return opened
    return opened.difference(necks.buffer(half)).buffer(-half, quad_segs=ARC).buffer(half, quad_segs=ARC)
