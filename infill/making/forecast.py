"""Forecast properties of a block from samples: the same steps on small windows of its grid."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import shapely

from infill.contours.straightening import simplify_contours
from infill.contours.strips import CORNERS
from infill.contours.zero_contours import trace_contours
from infill.grid import Grid
from infill.inspection.width import wall_width
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.methods import smooth
from infill.voxels.stamping import stamp_layer
from patterns.linework import sample_points

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from shapely import MultiLineString

WINDOW = 144  # cells across a sample
WINDOWS = 24
MARGIN = 16  # cells at its edges that are computed but not counted: there the lines are cut off
MOST_STEPS = 200  # of a forecast: walls are round by then, and hardly lose more corners
GOLDEN = (5**0.5 - 1) / 2
SAMPLE_SIDE = 45.0  # line widths: side of the sample on which walls are measured


def smoothed_layer(
    lines: MultiLineString,
    grid: Grid,
    *,
    stamp: Literal["block", "exact"],
    cells: int,
    width: float,
    smoothing: Smoothing,
) -> NDArray[np.floating]:
    """Stamp and smooth lines on a grid, which may be part of that of the block; return the layer.

    Parameters
    ----------
    lines : MultiLineString, mm
    grid : Grid
    stamp, cells, width, smoothing
        As of `infill.make`.
    """
    points = np.empty((0, 2)) if stamp == "exact" else sample_points(lines, min(grid.cell_size) / 2)
    data = stamp_layer(lines, points, grid, method=stamp, block=cells, width=width, outside="clip")
    return smooth(data, smoothing, spacing=grid.spacing)


def estimate_corners(
    lines: MultiLineString,
    grid: Grid,
    *,
    stamp: Literal["block", "exact"],
    cells: int,
    width: float,
    smoothing: Smoothing,
    tolerance: float,
) -> int:
    """Estimate the number of corners of the straightened contours of a block.

    Corners are counted in windows of `WINDOW` cells a side and scaled by the length of the lines; a block with no more
    cells than all windows is made completely.
    """
    corner_count = length = 0.0
    short_smoothing = replace(smoothing, steps=min(smoothing.steps, MOST_STEPS))
    for window in _windows(grid):
        layer = smoothed_layer(
            _lines_near(lines, window, width), window, stamp=stamp, cells=cells, width=width, smoothing=short_smoothing
        )
        if not (layer > 0).any():
            continue
        rings = simplify_contours(
            trace_contours(layer, tuple(window.cell_size.tolist()), origin=window.origin), tolerance
        )
        inner = _shrunk_box(window, 0 if window is grid else MARGIN)
        corner_count += shapely.contains_xy(inner, rings.points).sum() if window is not grid else len(rings.points)
        length += shapely.length(shapely.intersection(lines, inner))
    if not length:
        return 0
    line_length = float(shapely.length(lines))
    corners = corner_count * line_length / length
    # Where the caps are cut into strips: a line of any direction crosses a cut 2 / pi times per step of one along x.
    crossings = 2 * line_length * 2 / math.pi / grid.extents[0]
    return round(corners + (-(-corners // CORNERS) - 1) * crossings)


def exact_width(lines: MultiLineString, grid: Grid, *, cells: int, width: float, smoothing: Smoothing) -> float | None:
    """Return the mean width of exactly stamped walls in the middle of a block, mm.

    None if no wall stands clear of others, or if none would remain.
    """
    spacing = width / cells
    extents = np.array(grid.extents)
    middle = np.array(grid.origin) + extents / 2
    counts = np.maximum(np.round(np.minimum(extents, SAMPLE_SIDE * width) / spacing), 2 * cells).astype(int)
    window = Grid(shape=tuple(counts.tolist()), spacing=spacing, origin=tuple((middle - counts * spacing / 2).tolist()))
    nearby_lines = _lines_near(lines, window, width)
    inside = _as_lines(shapely.intersection(nearby_lines, _shrunk_box(window, cells)))
    if inside.is_empty:
        return None
    layer = smoothed_layer(nearby_lines, window, stamp="exact", cells=cells, width=width, smoothing=smoothing)
    mean = wall_width(inside, layer, window, requested=width).mean
    return mean if mean > 0 else None  # neither NaN nor 0


def _windows(grid: Grid) -> list[Grid]:
    """Return sample windows of a grid, or the grid itself if it has no more cells than all windows."""
    if grid.cells <= WINDOWS * WINDOW**2:
        return [grid]
    shape = np.array(grid.shape)
    sides = np.minimum(shape, WINDOW)
    windows = []
    # A lattice on the golden ratio: evenly spread, and in step with no pattern.
    for number in range(WINDOWS):
        place = (number + 0.5) / WINDOWS, ((number + 1) * GOLDEN) % 1
        low = np.round((shape - sides) * place).astype(int)
        origin = np.array(grid.origin) + low * grid.cell_size
        windows.append(Grid(shape=tuple(sides.tolist()), spacing=grid.spacing, origin=tuple(origin.tolist())))
    return windows


def _shrunk_box(grid: Grid, margin: int) -> shapely.Polygon:
    """Return the box of a grid, smaller by a margin of cells on every side."""
    low = np.array(grid.origin) + margin * grid.cell_size
    high = np.array(grid.origin) + np.array(grid.extents) - margin * grid.cell_size
    return shapely.box(*low, *high)


def _lines_near(lines: MultiLineString, window: Grid, width: float) -> MultiLineString:
    """Return the parts of the lines that can mark cells of a window."""
    return _as_lines(shapely.intersection(lines, shapely.buffer(_shrunk_box(window, 0), width, join_style="mitre")))


def _as_lines(geometry: shapely.Geometry) -> MultiLineString:
    """Return the lines of a geometry, without points where it only touches."""
    parts = shapely.get_parts(geometry)
    return shapely.multilinestrings(parts[shapely.get_type_id(parts) == shapely.GeometryType.LINESTRING])
