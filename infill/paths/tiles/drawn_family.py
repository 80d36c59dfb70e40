"""A drawing as a family of paths: a tile that is repeated, smoothed by the paper's equation."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from infill.checks import check_length, check_positive, check_range
from infill.drawing import Bounds, Drawing
from infill.errors import GeometryError
from infill.paths.families.family import Family, PathSpec
from infill.paths.tiles.borders import TOUCH, find_borders
from infill.paths.tiles.nodes import tile_grid
from infill.paths.tiles.strands import Strand, repeat_strands, tile_strands
from infill.paths.tiles.two_colours import two_colour_field
from infill.plain_numbers import plain_argument

CELL_STEP = 1.04  # between the cells whose fields are computed
CELL_CORRECTIONS = 2  # corrections of the first guess of the cell: lines are doubled, rounded and left out
LEAST_BLUR = 0.45  # of a line width: corners get about its radius, and necks of a cell or two heal
BLUR_PER_RADIUS = 0.7  # mm that a right angle is blurred for a radius of 1 mm
LARGEST_RADIUS = 0.1  # of the smaller side of a tile
MOST_LINES = 4.0  # line widths: rounder corners look no better, and smoothing time grows with the fourth power


@dataclass(frozen=True, kw_only=True, eq=False)
class DrawnFamily(Family):
    """A drawing that is repeated in both directions; `cell` is the width of its tile, mm.

    Parameters
    ----------
    name : str
        Of the file.
    drawing : Drawing
        Its lines, with the tile as the page.
    """

    drawing: Drawing
    summary: str = "a drawing, repeated"

    @property
    def width(self) -> float:
        """The width of the tile as drawn, mm."""
        x0, _, x1, _ = self.tile
        return x1 - x0

    @property
    def tile(self) -> Bounds:
        """The box that is repeated, mm."""
        assert self.drawing.page is not None
        return self.drawing.page

    def strands(self, bounds: Bounds, spec: PathSpec) -> list[NDArray[np.float64]]:
        """Return paths that cover a box: no two cross, and those of open or branching lines run on both sides of them.

        Parameters
        ----------
        bounds : (x0, y0, x1, y1)
            mm.
        spec : PathSpec
            Its radius is about that which a right angle gets, up to `largest_radius`. Small outlines get less.

        Raises
        ------
        GeometryError
            If nothing is left of the drawing at this size, or the tile is too large for the line width.
        """
        cell, line_width = check_length("cell", spec.cell), check_length("line_width", spec.line_width)
        strands, size = _scaled_strands(self, cell, line_width, spec.radius)
        return repeat_strands(strands, size, bounds)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the width of the tile at which the paths fill about `density` of the plane."""
        check_range("density", density, 1e-4, 1)
        check_positive("line_width", line_width, "mm")
        _, y0, _, y1 = self.tile
        drawn_length = sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in self.drawing.lines)
        cell = TOUCH * line_width * float(drawn_length) / (y1 - y0) / density
        for _ in range(CELL_CORRECTIONS):
            strands, size = _scaled_strands(self, cell, line_width, 0.0)
            path_length = sum(np.hypot(*np.diff(strand.points, axis=0).T).sum() for strand in strands)
            cell *= TOUCH * line_width * float(path_length) / (size[0] * size[1]) / density
        return cell

    def largest_radius(self, cell: float, line_width: float) -> float:
        """Return a tenth of the smaller side of the tile, and at most four line widths, mm.

        Beyond a tenth, little would be left of the drawing.
        """
        x0, y0, x1, y1 = self.tile
        return min(LARGEST_RADIUS * cell * min(1.0, (y1 - y0) / (x1 - x0)), MOST_LINES * line_width)


def _scaled_strands(
    family: DrawnFamily, cell: float, line_width: float, radius: float
) -> tuple[list[Strand], tuple[float, float]]:
    """Return the strands of a tile and its size, mm, scaled from the nearest of some fixed cells.

    The topology of the paths changes with the cell, and each time their length jumps. Scaled by a fiftieth at most,
    beads keep their distance well enough, and a search for a cell sees lengths that change smoothly.
    """
    fixed = CELL_STEP ** round(math.log(cell, CELL_STEP))
    limited_radius = min(check_range("radius", radius, 0, math.inf, "mm"), family.largest_radius(fixed, line_width))
    strands, (width, height) = _strands(family.name, family.drawing, fixed, line_width, limited_radius)
    scale = cell / fixed
    return [replace(strand, points=strand.points * scale) for strand in strands], (width * scale, height * scale)


@lru_cache(maxsize=16)
def _strands(
    name: str, drawing: Drawing, cell: float, line_width: float, radius: float
) -> tuple[list[Strand], tuple[float, float]]:
    """Compute the strands of a tile and its size, mm; one field serves every layer and region."""
    assert drawing.page is not None
    x0, y0, x1, y1 = drawing.page
    factor = cell / (x1 - x0)
    size = cell, (y1 - y0) * factor
    lines = [(line - (x0, y0)) * factor for line in drawing.lines]
    blur = max(LEAST_BLUR * line_width, BLUR_PER_RADIUS * radius)
    grid = tile_grid(size, line_width=line_width, blur=blur)
    field = two_colour_field(find_borders(lines, size, line_width=line_width), grid, line_width=line_width, blur=blur)
    strands = tile_strands(field, grid)
    if not strands:
        raise GeometryError(
            f"nothing is left of {name} in tiles of {plain_argument(size[0], 4)} × {plain_argument(size[1], 4)} mm "
            f"with lines of {plain_argument(line_width)} mm; make the cell larger"
        )
    return strands, size
