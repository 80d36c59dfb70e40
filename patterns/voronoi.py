"""Voronoi cells of random seeds, which do not depend on the place and size of the region."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.declared import parameter
from patterns.protocol import Pattern
from patterns.shared import angle_parameter, cell_parameter, frame_parameter, phase_parameter, seed_parameter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString, MultiPolygon, Polygon

SEED_MARGIN, MARGIN_PER_STEP = (
    4,
    3,
)  # cells around a region in which seeds have an effect, and more for every Lloyd step


@dataclass(frozen=True, kw_only=True)
class Voronoi(Pattern):
    """Voronoi cells in a frame, one for every square of `cell` mm, evened out by Lloyd's method.

    Source: Lloyd, "Least squares quantization in PCM", IEEE Trans. Inf. Theory 28 (1982) 129-137.
    """

    name: ClassVar[str] = "voronoi"
    summary: ClassVar[str] = "irregular cells; no direction is weaker than another"
    paths: ClassVar[bool] = True

    cell: float = cell_parameter(8.0)
    seed: int = seed_parameter()
    even: int = parameter(2, "how often cells are evened out", unit="", low=0, high=20, whole=True)
    angle: float = angle_parameter()
    phase: tuple[float, float] = phase_parameter()
    frame: bool = frame_parameter(default=True)

    def lines(self, region: Polygon | MultiPolygon, z: float = 0.0) -> MultiLineString:  # noqa: ARG002 - prismatic
        """Return the borders of the cells, and the frame."""
        import numpy as np
        import shapely

        from patterns.linework import add_frame, clip, turn

        corners = turn(shapely.get_coordinates(shapely.envelope(region)) - self.phase, -self.angle) / self.cell
        points = relaxed_seeds(
            np.floor(corners.min(axis=0)), np.ceil(corners.max(axis=0)), seed=self.seed, even=self.even
        )
        borders = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points), only_edges=True))
        placed_borders = shapely.transform(
            borders, lambda ends: turn(ends * self.cell, self.angle) + np.array(self.phase)
        )
        lines = clip(placed_borders, region)
        return add_frame(lines, region) if self.frame else lines

    def line_spacing(self, region: Polygon | MultiPolygon) -> float:  # noqa: ARG002 - the same everywhere
        """Return the side of a square with the mean area of a cell, mm."""
        return self.cell


def relaxed_seeds(low: NDArray[np.float64], high: NDArray[np.float64], *, seed: int, even: int) -> NDArray[np.float64]:
    """Return random points, one for every unit square, after Lloyd steps: (N, 2), from `low` to `high` and beyond.

    Parameters
    ----------
    low, high : (2,) float64
        Whole numbers. The cells of points up to one square beyond do not depend on them.
    seed, even : int
        Seed of the pattern, and number of Lloyd steps, which move points to the centroid of their cell.
    """
    import shapely

    from patterns.scattering import scatter_points

    margin = SEED_MARGIN + MARGIN_PER_STEP * even
    low, high = low - margin, high + margin
    points = scatter_points(low.astype("int64"), high.astype("int64"), seed)
    for _ in range(even):
        cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points)))
        # Cells on the rim reach to the box; every step drops them, far outside of the visible part.
        points = shapely.get_coordinates(shapely.centroid(cells))
        points = points[((points > low) & (points < high)).all(axis=1)]
    return points
