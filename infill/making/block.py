"""`make`: the paper's four steps, from a pattern to a mesh.

    points  ->  stamps on a grid  ->  smoothing  ->  layers, caps, isosurface

and a report on the result.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.contours.triangulation import extrude_layer
from infill.errors import GeometryError
from infill.inspection.width import WallWidth
from infill.isosurfaces.stacking import extrude_surface
from infill.making.forecast import exact_width
from infill.making.layer import judge_layer, sample_block, stamp_block, suggest_remedies
from infill.making.request import (
    DEFAULT_CELLS,
    Block,
    StampMethod,
    SurfaceMethod,
    check_sides,
    is_stamped,
    plan_block,
    refuse_frame,
    refuse_stamp_options,
)
from infill.making.stages import MakeStages
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth
from infill.reports.common import Topology, declare, mesh_keys, report_head, surface_keys
from infill.reports.making import BlockChanges, BlockSeconds, MakeReport, Width
from infill.result import Clock, Progress, Result
from patterns import Cells, Pattern

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from infill.surface import Surface

WIDTH_TOLERANCE = 0.05  # of the requested width; beyond this, the report has the width of the exact stamp


def make(
    pattern: Pattern | Cells | Path | str | Callable[..., Any],
    *,
    size: float | tuple[float, ...] = (60.0, 60.0),
    height: float | None = None,
    line_width: float | None = None,
    density: float | None = None,
    stamp: StampMethod = "block",
    cells: int | None = None,
    smoothing: Smoothing = Smoothing(),  # noqa: B008 - frozen
    surface: SurfaceMethod | None = None,
    tolerance: float | None = None,
    allow_broken: bool = False,
    max_memory: int | None = None,
    progress: Progress | None = None,
    **parameters: Any,  # noqa: ANN401 - whatever the pattern takes
) -> Result[Any, Any]:
    """Make a block of infill; return a closed mesh and a report.

    Lines that are the same in every layer are stamped and smoothed as in the paper. With a density, and for patterns
    in space, the block is a box that is filled as `infill.fill` fills a part: without a shell, or with a frame that is
    open at the top and bottom.

    Parameters
    ----------
    pattern : Pattern, Cells, Path, str or callable
        A pattern, the name of a registered one, a drawing, "module.py:name", or a function of x, y and z, as for
        `infill.fill`.
    size : float, (x, y) or (x, y, z)
        Size of the block, mm.
    height : float, optional
        Height of the block, mm, if the size does not have it: 6 by default. It costs nothing where lines are stamped.
    line_width : float, optional
        Width of the walls, mm: 0.45 by default. Of two of cell, line width and density, the third follows.
    density : float, optional
        Solid share of the whole block, its frame included, 0.01 to 0.9; 0.2 by default for patterns in space.
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
        tenth of the line width. Every ring keeps its area. 0 keeps the raw isosurface: "grid", unless "prism" is
        requested, which then has the full contour.
    allow_broken : bool
        Return a result in which walls broke or vanished, and say so in the report, instead of raising.
    max_memory : int, optional
        Bytes; by default, whatever memory the machine has free.
    progress : callable, optional
        Called with the name of a stage and the share of work done, 0 to 1, when the stage begins.
    **parameters
        Parameters of the pattern, if it is given by name: cell=8, angle=30 (degrees) … With a density, and in space,
        cell, angle, phase and frame are understood for every pattern.

    Returns
    -------
    Result
        With the surface "block", centred on x = y = 0, on z = 0. The report is `infill.reports.making.MakeReport`, or
        `infill.reports.making.LatticeReport` with a density and for patterns in space.

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

    The report holds lengths in mm, areas in mm², volumes in mm³ and angles in degrees. Its volume change is that of
    the layer in smoothing: the rounding of the rims of the surface "grid", at most half a layer, is not included.

    >>> make("honeycomb", size=20, height=3, cell=5).report["components"]
    1
    >>> abs(make("gyroid", size=(15, 12, 8), density=0.3).report["density"] - 0.3) < 0.005
    True
    """
    if not is_stamped(pattern, density):
        from infill.making.lattice_block import make_lattice, plan_lattice

        given = {
            "stamp": stamp != "block",
            "cells": cells is not None,
            "surface": surface is not None,
            "smoothing": smoothing != Smoothing(),
        }
        refuse_stamp_options(given, density)
        lattice = plan_lattice(
            pattern,
            sides=check_sides(size, height),
            density=density,
            line_width=line_width,
            tolerance=tolerance,
            values=parameters,
        )
        return make_lattice(lattice, max_memory=max_memory, progress=progress)
    refuse_frame(pattern, given=bool(parameters.get("frame")))
    clock = Clock(progress)
    with clock.stage("points", 0.0):
        block = plan_block(
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
        points = sample_block(block)
    return _make_stamped(block, points, clock, cells=cells, allow_broken=allow_broken)


def _make_stamped(
    block: Block, points: NDArray[np.float64], clock: Clock, *, cells: int | None, allow_broken: bool
) -> Result[MakeStages, MakeReport]:
    """Make a block that is drawn once and extruded: stamp, smooth and check its layer."""
    with clock.stage("stamp", 0.1):
        data = stamp_block(block, points)
    with clock.stage("smooth", 0.2):
        smoothed = smooth(data, block.smoothing, spacing=block.grid.spacing)
    with clock.stage("check", 0.3):
        judged = judge_layer(block, data, smoothed)
        layer, width, problems = judged.inspection, judged.width, judged.problems
        exact = _exact_stamp_width(block, width, cells)
        if problems and not allow_broken:
            raise GeometryError(f"{'; '.join(problems)}; {suggest_remedies(block)}")
    with clock.stage("surface", 0.5):
        mesh = _make_surface(block, smoothed)
        if not mesh.closed or mesh.volume <= 0:
            raise GeometryError(f"the surface of {block.pattern.name} is not closed; {suggest_remedies(block)}")
    cells_per_layer = math.prod(block.grid.shape)
    volume = math.prod(block.grid.extents) * block.height
    components = layer.after.components
    widths = declare(Width, {name: _finite(value) for name, value in asdict(width).items()})
    report: MakeReport = {
        **report_head("make"),
        **surface_keys(mesh),
        "volume": mesh.volume,
        "volume_change": layer.area_change,
        "components": components,
        "density": mesh.volume / volume,
        "wall_width": widths,
        "problems": problems,
        "request": block.request_keys(),
        "grid": block.grid_keys(),
        "mesh": {**mesh_keys(mesh), "surface": block.surface, "tolerance": block.tolerance},
        "solid": {
            "volume": mesh.volume,
            "change": layer.area_change,
            "data": layer.area / cells_per_layer * volume,
            "density": mesh.volume / volume,
            "level": {"method": "fixed", "common": 0.0, "lowest": 0.0, "highest": 0.0, "components": components},
        },
        "topology": declare(Topology, {"data": asdict(layer.before), "result": asdict(layer.after)}),
        "changes": declare(BlockChanges, layer.changes.facts()),
        "walls": {"width": widths, "exact": exact},
        "seconds": clock.timings(BlockSeconds),
    }
    stages = MakeStages(points=points, lines=block.lines, grid=block.grid, stamp=data, smoothed=smoothed)
    return Result(surfaces={"block": mesh}, report=report, stages=stages)


def _make_surface(block: Block, smoothed: NDArray[np.floating]) -> Surface:
    """Make the requested surface, "prism" or "grid"."""
    spacing = tuple(block.grid.cell_size.tolist())
    if block.surface == "grid":
        return extrude_surface(smoothed, block.height, spacing, origin=block.origin)
    return extrude_layer(smoothed, block.height, spacing, origin=block.origin, tolerance=block.tolerance)


def _exact_stamp_width(block: Block, width: WallWidth, cells: int | None) -> float | None:
    """Return the wall width of the exact stamp, on a sample; None unless walls are off and it is nearer."""
    error = abs(width.mean - block.line_width)
    if block.stamp == "exact" or not error > WIDTH_TOLERANCE * block.line_width:
        return None
    exact_mean = exact_width(
        block.lines,
        block.grid,
        cells=DEFAULT_CELLS["exact"] if cells is None else cells,
        width=block.line_width,
        smoothing=block.smoothing,
    )
    return exact_mean if exact_mean is not None and abs(exact_mean - block.line_width) < error else None


def _finite(value: float) -> float | None:
    """Replace NaN, which JSON lacks, with None."""
    return None if math.isnan(value) else value
