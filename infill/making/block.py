"""`make`: the paper's four steps, from a pattern to a mesh.

    points  ->  stamps on a grid  ->  smoothing  ->  layers, caps, isosurface

and a report on the result.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import shapely

from infill.contours.prisms import prism
from infill.contours.straightening import straightened
from infill.contours.zero_contours import contours
from infill.errors import GeometryError
from infill.inspection.changes import Changes
from infill.inspection.layers import Regions, changes, regions, solid_area
from infill.inspection.width import WallWidth, wall_width
from infill.isosurfaces.stacking import extruded
from infill.making.forecast import exact_width
from infill.making.request import DEFAULT_CELLS, Block, StampMethod, SurfaceMethod, plan
from infill.making.stages import MakeStages
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth
from infill.report import report_of
from infill.result import Clock, Progress, Result
from infill.voxels.stamping import stamp as stamp_points
from infill.voxels.stamping import stamp_lines
from patterns import Pattern
from patterns.linework import bodies, sample

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely import MultiLineString

    from infill.report_keys import MakeReport
    from infill.surface import Surface

THINNEST = 0.6  # of the requested width, at the 5th percentile; below this, a wall counts as lost
OFF = 0.05  # of the requested width; beyond this, the report tells what the exact stamp would give
MOST_PINHOLES = 0.02  # of the void in holes; acute angles alone do not explain more than this
POINTS_PER_CELL = 2  # neighbouring stamps overlap
ADVICE = "use more cells per line, fewer steps or more fidelity (or --allow-broken, to have it anyway)"


def make(
    pattern: Pattern | str,
    *,
    size: float | tuple[float, float] = (60.0, 60.0),
    height: float = 6.0,
    line_width: float = 0.45,
    stamp: StampMethod = "block",
    cells: int | None = None,
    smoothing: Smoothing = Smoothing(),  # noqa: B008 - frozen
    surface: SurfaceMethod | None = None,
    tolerance: float | None = None,
    allow_broken: bool = False,
    max_memory: int | None = None,
    progress: Progress | None = None,
    **parameters: Any,  # noqa: ANN401 - whatever the pattern takes
) -> Result[MakeStages, MakeReport]:
    """Return a block of infill: a closed mesh and a report.

    Parameters
    ----------
    pattern : Pattern or str
        A pattern, or the name of a registered one.
    size : float or (x, y)
        Size of the block, mm, rounded to whole cells.
    height : float
        Height of the block, mm. It costs nothing.
    line_width : float
        Width of the walls, mm.
    stamp : {"block", "exact"}
        "block" is the paper's: `cells` x `cells` around every point, up to 41 % wide on diagonals.
        "exact" keeps the width in every direction.
    cells : int, optional
        Grid cells across a line: 3 for "block" (odd), 5 for "exact".
    smoothing : Smoothing
        The paper takes 10 steps for patterns.
    surface : {"prism", "grid"}, optional
        "prism", the default: vertical walls along the contour of the smoothed layer, between flat caps.
        "grid" is the paper's: the isosurface of the stacked layers as it is, with rounded rims.
    tolerance : float, optional
        How far the contour of a prism may lie from the isosurface's at mid height, mm: 0.002 by default, and at most a
        tenth of the line width. Every ring keeps its area. 0 keeps the raw isosurface: "grid", unless "prism" is asked
        for, which then has the whole contour.
    allow_broken : bool
        Return a result in which walls broke or vanished, and say so in the report, instead of raising.
    max_memory : int, optional
        Bytes; by default, whatever memory the machine has free.
    progress : callable, optional
        Called with the name of a stage and the share of work done, 0 to 1, when the stage begins.
    **parameters
        Parameters of the pattern, if it is given by name: cell=8, angle=30 (degrees) …

    Returns
    -------
    Result
        The block is centred on x = y = 0 and stands on z = 0.

    Raises
    ------
    ParameterError, patterns.PatternError
        If a number is out of range.
    MemoryLimitError
        If memory will not suffice; raised before anything is computed.
    GeometryError
        If a wall broke, ran into another, vanished, or is thinner than 60 % of the requested width at the 5th
        percentile.

    Notes
    -----
    Source: Wang et al. 2020, section 3.4.

    The report holds lengths in mm, areas in mm², volumes in mm³ and angles in degrees. Its volume change is
    how much smoothing changed the layer: the rounding of the rims of the surface "grid", at most half a layer, is not
    included.

    >>> make("honeycomb", size=20, height=3, cell=5).report["components"]
    1
    """
    clock = Clock(progress)
    with clock.stage("points", 0.0):
        block = plan(
            pattern,
            size=size,
            height=height,
            line_width=line_width,
            stamp=stamp,
            cells=cells,
            smoothing=smoothing,
            parameters=parameters,
            surface=surface,
            tolerance=tolerance,
        )
        block.require_memory(max_memory)
        points = _points(block)
    with clock.stage("stamp", 0.1):
        if block.stamp == "exact":
            data = stamp_lines(block.lines, block.grid, width=block.line_width)
        else:
            data = stamp_points(points, block.grid, block=block.cells)
    with clock.stage("smooth", 0.2):
        smoothed = smooth(data, block.smoothing, spacing=block.grid.spacing)
    with clock.stage("check", 0.3):
        before, after = regions(data), regions(smoothed)
        found = changes(before, after, line_cells=block.cells)
        area = solid_area(data)
        volume_change = solid_area(smoothed) / area - 1
        width = wall_width(block.lines, smoothed, block.grid, requested=block.line_width)
        exact = _exact(block, width, cells)
        problems = list(_problems(found, width, _fused_lines(block.lines, before, block.line_width)))
        if problems and not allow_broken:
            raise GeometryError(f"{'; '.join(problems)}; {ADVICE}")
    with clock.stage("surface", 0.5):
        mesh = _surface(block, smoothed)
        if not mesh.closed or mesh.volume <= 0:
            raise GeometryError(f"the surface of {block.pattern.name} is not closed; {ADVICE}")
    cells_per_layer = math.prod(block.grid.shape)
    layer = math.prod(block.grid.extents) * block.height
    components = after.topology.components
    report = report_of(
        product="make",
        surface=mesh,
        request=block.asked(),
        grid=block.laid_out(),
        solid={
            "data": area / cells_per_layer * layer,
            "change": volume_change,
            "density": mesh.volume / layer,
            "level": {"method": "fixed", "common": 0.0, "lowest": 0.0, "highest": 0.0, "components": components},
        },
        data=before.topology.extruded,
        result=after.topology.extruded,
        changes=found,
        walls={
            "width": {name: _finite(value) for name, value in asdict(width).items()},
            "exact": exact,
        },
        problems=problems,
        mesh={"surface": block.surface, "tolerance": block.tolerance},
        seconds=clock.seconds,
    )
    stages = MakeStages(points=points, lines=block.lines, grid=block.grid, stamp=data, smoothed=smoothed)
    return Result(surfaces={"block": mesh}, report=cast("MakeReport", report), stages=stages)


def _surface(block: Block, smoothed: NDArray[np.floating]) -> Surface:
    """Return the surface that was asked for."""
    spacing = tuple(block.grid.cell_size.tolist())
    if block.surface == "grid":
        return extruded(smoothed, block.height, spacing, origin=block.origin)
    contour = contours(smoothed, spacing, origin=block.origin)
    return prism(straightened(contour, block.tolerance), block.height)


def _exact(block: Block, width: WallWidth, cells: int | None) -> float | None:
    """Return the width that the exact stamp would give, on a sample; None unless walls are off and that is nearer."""
    off = abs(width.mean - block.line_width)
    if block.stamp == "exact" or not off > OFF * block.line_width:
        return None
    found = exact_width(
        block.lines,
        block.grid,
        cells=DEFAULT_CELLS["exact"] if cells is None else cells,
        width=block.line_width,
        smoothing=block.smoothing,
    )
    return found if found is not None and abs(found - block.line_width) < off else None


def _points(block: Block) -> NDArray[np.float64]:
    """Return points along the lines, from the pattern's own `points` if it has one; lines are drawn only once."""
    spacing = min(block.grid.cell_size) / POINTS_PER_CELL
    own = type(block.pattern).points is not Pattern.points
    return block.pattern.points(block.region, spacing) if own else sample(block.lines, spacing)


def _fused_lines(lines: MultiLineString, before: Regions, line_width: float) -> int:
    """Return how many bodies of lines the stamp fused; scraps no longer than three line widths do not count."""
    number = bodies(lines)
    length = np.bincount(number, weights=shapely.length(np.array(lines.geoms, dtype=object)))
    return max(0, int((length > 3 * line_width).sum()) - before.topology.components)


def _problems(found: Changes, width: WallWidth, fused_lines: int) -> Iterator[str]:
    """Describe what is wrong with the walls, one phrase per problem."""
    if fused_lines:
        yield f"{fused_lines} separate line(s) of the pattern run together at this line width: use larger cells"
    for count, what in (
        (found.broken + found.voids_joined + found.walls_pierced, "wall(s) broke"),
        (found.vanished, "part(s) vanished"),
        (found.appeared, "part(s) appeared from nowhere"),
        (found.fused + found.voids_cut, "gap(s) between walls closed up"),
        (found.voids_closed, "hole(s) closed"),
    ):
        if count:
            yield f"{count} {what} in smoothing"
    if found.pinhole_share and found.pinhole_share > MOST_PINHOLES:
        yield (
            f"{found.pinholes} hole(s) narrower than a line, {found.pinhole_share:.0%} of all void, closed in "
            "smoothing: use larger cells or a thinner line"
        )
    if width.p5 < THINNEST * width.requested:
        yield (
            f"the walls are {width.p5:.3g} mm thin at the 5th percentile, under {THINNEST:.0%} of the "
            f"{width.requested:g} mm asked for"
        )


def _finite(value: float) -> float | None:
    """Return None for NaN, which JSON does not have."""
    return None if math.isnan(value) else value
