"""Sizes that a request leaves open: cells of the pattern, its lines, and cells of the grid."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.lattices.drawn_voids import Prismatic
from infill.lattices.layered import NonPrismatic
from infill.lattices.request import GAP, FillSpec, has_bars
from infill.lattices.voids import Voids

BAR_CELL, BRANCHES_CELL = 8.0, 5.0  # mm: bars get their thickness from the density; twigs are this far apart
# Cells of the grid: in a wall of a pattern with a density of a fifth, and along a cell of lines and of bars; across a
# wall of the part and a bar; in all.
FINE, FINE_LINES, FINE_BARS = 0.9, 6.0, 14.0
ACROSS, ACROSS_BAR = 2.5, 4.0
LEAST_FINE, LEAST_FINE_LINES, LEAST_FINE_BARS = 0.58, 2.5, 9.0
LEAST_ACROSS, LEAST_ACROSS_BAR = 1.5, 3.0
SLACK = 1.01
FIFTH = 0.2
FEWEST, MOST, MOST_IN_SLABS = 1e6, 25e6, 1e8
COARSEST_LINES = 0.3  # mm: corners between lines are rounded on cells no larger than this


def choose_sizes(request: FillSpec, voids: Voids, extents: NDArray[np.floating]) -> tuple[float, float]:
    """Return cell and width, mm: as requested, or as the density requires far from any skin.

    In a part too large for a grid as fine as they need, both are enlarged, unless one of them was requested.
    """
    cell, width = _nominal_sizes(request, voids)
    if request.cell is None and request.line_width is None:
        finest = _finest_voxel(extents, slabs=goes_by_slabs(request, voids))
        times = SLACK * finest / coarsest_voxel(replace(request, wall=math.inf), voids, cell, width)
        return enlarge(request, (cell, width), times)
    return cell, width


def enlarge(request: FillSpec, sizes: tuple[float, float], times: float) -> tuple[float, float]:
    """Enlarge cell and width, mm, by a factor if it is more than 1.

    In a project, walls never get a width that slicers fill with two lines and a gap between them.
    """
    times, width = max(1.0, times), sizes[1]
    if request.gaps_in(times * width):
        times = GAP[1] / width
    return sizes[0] * times, width * times


def _nominal_sizes(request: FillSpec, voids: Voids) -> tuple[float, float]:
    if request.density is None:
        return request.cell or BRANCHES_CELL, request.line_width or request.default_width
    share = voids.widths(request.density)
    if request.line_width is None and request.cell is not None:
        return request.cell, share * request.cell
    if request.line_width is None and "cell" not in request.varied and not request.lined:
        cell = BAR_CELL if has_bars(request.kind) else BRANCHES_CELL
        return cell, share * cell
    width = request.default_width if request.line_width is None else request.line_width
    return width / share, width


def resolve_voxel(request: FillSpec, bounds: NDArray[np.floating]) -> FillSpec:
    """Replace the resolution of a request by the side of its cells, mm, for a part within bounds (2, 3), mm."""
    if request.resolution is None:
        return request
    return replace(request, voxel=float(np.ptp(bounds, axis=0).max()) / request.resolution)


def choose_voxel(request: FillSpec, voids: Voids, extents: NDArray[np.floating], cell: float, width: float) -> float:
    """Return the side of the cells of the grid, mm."""
    if request.voxel is not None:
        return request.voxel
    width *= request.thinnest
    size = request.wall / ACROSS
    if isinstance(voids, Prismatic):
        size = min(size, voids.sample.apart * cell / FINE_LINES, COARSEST_LINES)
    elif has_bars(request.kind):
        size = min(size, cell / FINE_BARS, width / ACROSS_BAR)
    elif isinstance(voids, NonPrismatic) and voids.around:
        size = min(size, width / ACROSS_BAR)
    else:
        size = min(size, voids.widths(FIFTH) * cell * request.smallest / FINE)
    size = min(
        max(size, _finest_voxel(extents, slabs=goes_by_slabs(request, voids))), math.cbrt(_box_volume(extents) / FEWEST)
    )
    if size > request.wall / LEAST_ACROSS:
        raise GeometryError.about(
            "wall",
            f"is {request.wall:g} mm, and the part {extents.max():.4g} mm long: a grid as fine as such a wall "
            f"needs has more than {MOST:,.0f} cells; give a wall of {LEAST_ACROSS * size:.2g} mm, or the right unit",
        )
    if size > (most := coarsest_voxel(request, voids, cell, width / request.thinnest)):
        raise GeometryError.about(
            "cell",
            f"is {cell:.3g} mm, and the part {extents.max():.4g} mm long: a grid as fine as such cells need has "
            f"more than {MOST:,.0f} cells; give a cell of {math.ceil(cell * size / most)} mm, or a lower density",
        )
    return size


def _box_volume(extents: NDArray[np.floating]) -> float:
    """Return the volume of the box around a part, mm³; a flat one is as thick as a thousandth of its length."""
    return float(math.prod(np.maximum(extents, extents.max() / 1000).tolist()))


def _finest_voxel(extents: NDArray[np.floating], *, slabs: bool) -> float:
    """Return the side of the cells of the finest grid around a part, mm: in slabs, height costs only time."""
    size = math.cbrt(_box_volume(extents) / MOST)
    if not slabs:
        return size
    low = np.array([*extents[:2], min(extents[2], max(extents[:2]))])
    return max(math.cbrt(_box_volume(low) / MOST), math.cbrt(_box_volume(extents) / MOST_IN_SLABS))


def coarsest_voxel(request: FillSpec, voids: Voids, cell: float, width: float) -> float:
    """Return the largest side of the cells of a grid that still resolves the pattern, mm."""
    if request.voxel is not None:
        return request.voxel
    width *= request.thinnest
    size = request.wall / LEAST_ACROSS
    if isinstance(voids, Prismatic):
        return min(size, voids.sample.apart * cell / LEAST_FINE_LINES)
    if has_bars(request.kind):
        return min(size, cell / LEAST_FINE_BARS, width / LEAST_ACROSS_BAR)
    if isinstance(voids, NonPrismatic) and voids.around:
        return min(size, width / LEAST_ACROSS_BAR)
    return min(size, voids.widths(FIFTH) * cell * request.smallest / LEAST_FINE)


def goes_by_slabs(request: FillSpec, voids: Voids) -> bool:
    """Tell whether voids may be made slab by slab: upright, of one width, closed, in a part taken as one."""
    upright = isinstance(voids, Prismatic) and voids.grading is None and voids.bodies is None
    return upright and request.form == "solid" and request.open_ is None
