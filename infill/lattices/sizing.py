"""Sizes that a request leaves open: cells of the pattern, its lines, and cells of the grid."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.lattices.drawn_voids import ACROSS_TIE, Prismatic
from infill.lattices.layered import NonPrismatic
from infill.lattices.request import GAP, FillSpec, has_bars
from infill.lattices.task import FillTask
from infill.plain_numbers import plain_argument, plain_size


class Fineness(NamedTuple):
    """Cells of the grid across a wall of the part, along a cell of lines and of bars, across a bar, and in a wall.

    The wall is one of a pattern in space with a density of a fifth.
    """

    across: float
    lines: float
    bars: float
    across_bar: float
    walls: float


BAR_CELL, BRANCHES_CELL = 8.0, 5.0  # mm: bars get their thickness from the density; twigs are this far apart
FINE = Fineness(across=2.5, lines=6.0, bars=14.0, across_bar=4.0, walls=0.9)
LEAST_FINE = Fineness(across=1.5, lines=2.5, bars=9.0, across_bar=3.0, walls=0.58)
SLACK = 1.01
FIFTH = 0.2
ROUNDED_UP = 1.06  # so that a least length of two digits is not less than it
FEWEST, FEWEST_BARE, MOST, MOST_IN_SLABS = 1e6, 3e5, 25e6, 1e8  # cells of the grid in all; bare: without a shell
COARSEST_LINES = 0.3  # mm: corners between lines are rounded on cells no larger than this


def choose_sizes(task: FillTask) -> tuple[float, float]:
    """Choose cell and width, mm: as requested, or as the density requires far from any skin.

    In a part too large for a grid as fine as they need, both are enlarged, unless one of them was requested.
    """
    request, (cell, width) = task.request, _nominal_sizes(task)
    if request.cell is None and request.line_width is None:
        without_wall = replace(task, request=replace(request, wall=math.inf, regions=()))
        times = SLACK * _finest_voxel(task) / coarsest_voxel(without_wall, cell, width)
        return enlarge(request, (cell, width), times)
    shortest, longest = float(task.extents.min()), float(task.extents.max())
    if request.cell is None and request.line_width is not None and width > shortest / 2 and cell > longest:
        raise GeometryError.about(
            "line_width",
            f"is {plain_argument(width)} mm, for which cells are {plain_argument(cell, 3)} mm wide, and the part is "
            f"{plain_size(*task.extents)}; give a line width of {plain_argument(width * longest / cell / 3, 2)} mm or "
            "less, a higher density, or the right unit",
        )
    return cell, width


def enlarge(request: FillSpec, sizes: tuple[float, float], times: float) -> tuple[float, float]:
    """Enlarge cell and width, mm, by a factor if it is more than 1.

    In a project, walls never get a width that slicers fill with two lines and a gap between them.
    """
    times, width = max(1.0, times), sizes[1]
    if request.gaps_in(times * width):
        times = GAP[1] / width
    return sizes[0] * times, width * times


def _nominal_sizes(task: FillTask) -> tuple[float, float]:
    """Return cell and width, mm: as requested, or in the ratio that the density requires far from any skin."""
    request = task.request
    if request.density is None:
        return request.cell or BRANCHES_CELL, request.line_width or request.default_width
    share = task.pattern.widths(request.density)
    if request.line_width is None and request.cell is not None:
        return request.cell, share * request.cell
    if request.line_width is None and "cell" not in request.varied and not request.has_slicer_lines:
        cell = BAR_CELL if has_bars(request.kind) else BRANCHES_CELL
        return cell, share * cell
    width = request.default_width if request.line_width is None else request.line_width
    return width / share, width


def choose_voxel(task: FillTask, cell: float, width: float) -> float:
    """Choose the side of the cells of the grid, mm."""
    request, extents = task.request, task.extents
    if request.voxel is not None:
        return request.voxel
    size = _largest_voxel(task, cell, width, FINE)
    if isinstance(task.pattern, Prismatic):
        size = min(size, COARSEST_LINES)
        if task.pattern.leaves_islands(task.part.bounds, cell=cell, width=width, wall=request.wall):
            size = min(size, width / ACROSS_TIE)
    fewest = FEWEST if request.wall else FEWEST_BARE
    size = min(max(size, _finest_voxel(task)), math.cbrt(_box_volume(extents) / fewest))
    thinnest = min(request.walls)
    if 0 < thinnest < LEAST_FINE.across * size:
        raise GeometryError.about(
            "wall",
            f"is {plain_argument(thinnest)} mm, and the part {plain_size(extents.max(), digits=4)} long: a grid "
            f"as fine as such a wall needs has more than {MOST:,.0f} cells; give a wall of "
            f"{plain_argument(ROUNDED_UP * LEAST_FINE.across * size, 2)} mm, or the right unit",
        )
    if size > (most := coarsest_voxel(task, cell, width)):
        raise GeometryError.about(
            "cell",
            f"is {plain_argument(cell, 3)} mm, and the part {plain_size(extents.max(), digits=4)} long: a grid as "
            f"fine as such cells need has more than {MOST:,.0f} cells; give a cell of {math.ceil(cell * size / most)} "
            "mm, or a lower density",
        )
    return size


def coarsest_voxel(task: FillTask, cell: float, width: float) -> float:
    """Return the largest side of the cells of a grid that still resolves the pattern, mm."""
    return _largest_voxel(task, cell, width, LEAST_FINE) if task.request.voxel is None else task.request.voxel


def _largest_voxel(task: FillTask, cell: float, width: float, fineness: Fineness) -> float:
    """Return the largest side of the cells of a grid that is so fine, mm."""
    request, pattern = task.request, task.pattern
    width *= request.thinnest
    size = (min(request.walls) or math.inf) / fineness.across
    if isinstance(pattern, Prismatic):
        return min(size, pattern.sample.spacing * cell / fineness.lines)
    if has_bars(request.kind):
        return min(size, cell / fineness.bars, width / fineness.across_bar)
    if isinstance(pattern, NonPrismatic) and pattern.around:
        return min(size, width / fineness.across_bar)
    return min(size, pattern.widths(FIFTH) * cell * request.smallest / fineness.walls)


def _box_volume(extents: NDArray[np.floating]) -> float:
    """Return the volume of the box around a part, mm³; a flat one is as thick as a thousandth of its length."""
    return float(math.prod(np.maximum(extents, extents.max() / 1000).tolist()))


def _finest_voxel(task: FillTask) -> float:
    """Return the side of the cells of the finest grid around a part, mm: in slabs, height costs only time."""
    extents = task.extents
    size = math.cbrt(_box_volume(extents) / MOST)
    if not goes_by_slabs(task):
        return size
    low = np.array([*extents[:2], min(extents[2], max(extents[:2]))])
    return max(math.cbrt(_box_volume(low) / MOST), math.cbrt(_box_volume(extents) / MOST_IN_SLABS))


def goes_by_slabs(task: FillTask) -> bool:
    """Tell whether voids may be made slab by slab: upright, of one width, closed, in a part taken as one."""
    request = task.request
    is_plain = request.grading is None and request.align != "body" and request.form == "solid" and request.open_ is None
    return is_plain and request.wall > 0 and len(request.walls) == 1 and isinstance(task.pattern, Prismatic)
