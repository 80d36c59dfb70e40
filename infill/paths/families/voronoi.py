"""Voronoi cells: every cell a closed line along the inside of its walls, so that all walls are two lines that touch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from infill.paths.families.family import TOUCH, Bounds, Family, Path, PathSpec

if TYPE_CHECKING:
    from numpy.typing import NDArray

EVEN = 2  # relaxation steps, as in `patterns.voronoi` by default
# Measured on 3600 cells of three seeds, to 0.1 % and 0.5 %: the outline of a cell, in cells, and its loss for every mm
# between touching lines, in mm.
OUTLINE, LOST = 3.875, 3.58
FINEST = 7.5  # line widths: the smallest cells, with room inside for more than the bead along the wall
CORNERS_APART = 1e-3  # mm
MITRE = 20.0  # half distances of touching lines, that the corner of a cell may lie away from those of its walls


@dataclass(frozen=True, kw_only=True)
class VoronoiPaths(Family):
    """The cells of `patterns.voronoi`; `cell` is the side of a square as large as one of them on average.

    A cell too small for a bead is left out. Cells are at least `FINEST` line widths large, so that beads fit into most.
    """

    name: str = "voronoi"
    summary: str = "irregular cells, every one a closed loop; no direction is weaker than another"
    seed: int = 0
    corner_share: ClassVar[float] = 0.15  # shortest walls go, cells stay as wide, and long walls touch

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[Path]:
        """Return one closed line a cell."""
        import shapely

        cell = max(spec.cell, FINEST * spec.line_width)
        corners = np.array(bounds, dtype=np.float64).reshape(2, 2) / cell
        low, high = np.floor(corners[0]).tolist(), np.ceil(corners[1]).tolist()
        gap = spec.gap / cell
        cells = _voronoi_cells(tuple(low), tuple(high), self.seed)
        inside = shapely.buffer(cells, -gap / 2, join_style="mitre", mitre_limit=MITRE)
        roomy = inside[~shapely.is_empty(shapely.buffer(inside, -gap / 2))]
        loops = shapely.get_exterior_ring(roomy)
        return [_without_specks(shapely.get_coordinates(loop) * cell) for loop in loops]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density."""
        gap = TOUCH * line_width
        return gap * (OUTLINE + math.sqrt(OUTLINE**2 - 4 * density * LOST)) / (2 * density)


@lru_cache(maxsize=16)
def _voronoi_cells(low: tuple[float, float], high: tuple[float, float], seed: int) -> NDArray[np.object_]:
    """Return the cells that reach into a box, Polygon each, in cells; the same for every layer."""
    import shapely

    from patterns.voronoi import relaxed_seeds

    points = relaxed_seeds(np.array(low), np.array(high), seed=seed, even=EVEN)
    polygons: NDArray[np.object_] = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points)))
    reaches_box: NDArray[np.bool_] = shapely.intersects(polygons, shapely.box(*low, *high))
    return polygons[reaches_box]


def _without_specks(loop: Path) -> Path:
    """Return a closed line without sides shorter than `CORNERS_APART`."""
    corners = loop[:-1][np.hypot(*np.diff(loop, axis=0).T) > CORNERS_APART]
    return np.concatenate([corners, corners[:1]])
