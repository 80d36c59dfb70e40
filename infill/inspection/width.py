"""Measure the width of the walls, across the lines of the pattern."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import MultiLineString

from infill.arrays import Floats
from infill.errors import ParameterError
from infill.grid import VOID, Grid
from infill.inspection.rays import length_inside
from infill.pixels import interpolate_pixels

MOST_SAMPLES = 4000
# Clearance in line widths of a ray across a wall, and of its foot, from nodes, ends and other lines: nearer to them,
# walls run together. The first clearance that leaves enough places is used; cells of only a few widths need the last.
CLEARANCES = (2.0, 1.5, 1.0, 0.75)
ENOUGH = 0.05  # of all places
STEPS_PER_CELL = 4


@dataclass(frozen=True, kw_only=True)
class WallWidth:
    """Wall width along the lines of a pattern, away from nodes, mm.

    Parameters
    ----------
    requested : float
        Requested line width.
    mean, p5, p95 : float
        Mean, 5th and 95th percentiles over the samples; 0 where a wall is gone. NaN without samples.
    samples : int
        Places measured, evenly spread over the lines.
    """

    requested: float
    mean: float
    p5: float
    p95: float
    samples: int


def wall_width(lines: MultiLineString, layer: NDArray[np.floating], grid: Grid, *, requested: float) -> WallWidth:
    """Measure the distance between the zero crossings on either side of the lines.

    Parameters
    ----------
    lines : MultiLineString, mm
    layer : (nx, ny) array
        Phase field; between cell centres it is bilinear, as it is for marching cubes.
    grid : Grid
        The grid of the layer.
    requested : float
        Line width, mm.

    Notes
    -----
    Places are left out if another line comes within two line widths of the ray across the wall (fewer
    in small cells), because walls run together there and their widths are undefined.
    """
    if tuple(grid.shape) != layer.shape or layer.ndim != 2:
        raise ParameterError(f"the layer has the shape {layer.shape} and the grid {grid.shape}; give the layer's own")
    places, normals = _sample_places(lines, requested)
    for clearance in CLEARANCES:
        reach = clearance * requested
        clear = _mark_clear_places(lines, places, normals, reach)
        if clear.mean() > ENOUGH:
            break
    places, normals = places[clear], normals[clear]
    if len(places) == 0:
        return WallWidth(requested=requested, mean=math.nan, p5=math.nan, p95=math.nan, samples=0)
    chosen = np.unique(np.linspace(0, len(places) - 1, min(MOST_SAMPLES, len(places))).astype(int))
    places, normals = places[chosen], normals[chosen]
    size = float(grid.cell_size.min())
    distance = np.arange(0, reach, size / STEPS_PER_CELL)
    value = _sampler(layer, grid)
    # A wall that continues beyond the reach counts as that wide.
    half_widths = [length_inside(value, places, side * normals, distance).clip(0, distance[-1]) for side in (1, -1)]
    widths = half_widths[0] + half_widths[1]
    p5, p95 = np.percentile(widths, [5, 95])
    return WallWidth(
        requested=requested, mean=float(np.mean(widths)), p5=float(p5), p95=float(p95), samples=len(places)
    )


def _sample_places(lines: MultiLineString, requested: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sample the lines; return the midpoints of short pieces and the unit normals there, (N, 2) each."""
    spacing = max(requested / 2, shapely.length(lines) / (4 * MOST_SAMPLES))
    ends, owner = shapely.get_coordinates(shapely.segmentize(lines.geoms, spacing), return_index=True)
    same_line = owner[1:] == owner[:-1]
    start, end = ends[:-1][same_line], ends[1:][same_line]
    length = np.linalg.norm(end - start, axis=1)
    start, end, length = start[length > 0], end[length > 0], length[length > 0]
    # Curves consist of pieces much shorter than others: sample them in proportion to their length.
    passed = np.floor(np.cumsum(length) / spacing + 0.5)
    chosen = np.diff(passed, prepend=0.0) > 0
    along = (end - start)[chosen] / length[chosen, None]
    return ((start + end) / 2)[chosen], np.stack([-along[:, 1], along[:, 0]], axis=-1)


def _mark_clear_places(
    lines: MultiLineString, places: NDArray[np.float64], normals: NDArray[np.float64], reach: float
) -> NDArray[np.bool_]:
    """Mark the places where the line below is the nearest, on both sides and as far as `reach`."""
    tree = shapely.STRtree(_split_segments(lines))
    clear = np.ones(len(places), dtype=bool)
    for side in (1, -1):
        tips = places + side * reach * normals
        _, distance = tree.query_nearest(shapely.points(tips), all_matches=False, return_distance=True)
        clear &= distance > 0.98 * reach  # a curve bends slightly towards the tip of its own ray
    ends = shapely.points(shapely.get_coordinates(lines.boundary))
    if len(ends):
        _, distance = shapely.STRtree(ends).query_nearest(
            shapely.points(places), all_matches=False, return_distance=True
        )
        clear &= distance > reach
    return clear


def _split_segments(lines: MultiLineString) -> NDArray[np.object_]:
    """Split lines into their straight segments."""
    ends, owner = shapely.get_coordinates(lines.geoms, return_index=True)
    same_line = owner[1:] == owner[:-1]
    return np.asarray(shapely.linestrings(np.stack([ends[:-1][same_line], ends[1:][same_line]], axis=1)))


def _sampler(layer: NDArray[np.floating], grid: Grid) -> Callable[[Floats], Floats]:
    """Return a function giving the bilinear value of a layer at points (N, 2), mm; beyond the layer lies void."""
    field = np.pad(layer, 1, constant_values=VOID)

    def value(points: Floats) -> Floats:
        """Interpolate the layer at points (N, 2), mm."""
        cell = (points - grid.origin) / grid.cell_size + 0.5  # the first cell of the padded field is centred on 0
        return interpolate_pixels(field, cell)

    return value
