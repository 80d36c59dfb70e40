"""The checked request of `make`: the block, its grid, and its cost."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, get_args

import shapely

from infill.checks import check_length, check_range, check_whole_number
from infill.errors import ParameterError, UsageError
from infill.grid import Grid
from infill.isosurfaces.stacking import layer_count
from infill.machine import require_memory
from infill.options.resolve_pattern import instantiate_pattern, resolve_pattern
from infill.phasefield.allen_cahn import Smoothing
from infill.plain_numbers import plain_argument
from patterns import Cells, Pattern, PatternError, parameter_values
from patterns.declared import parameters as declared
from patterns.protocol import draw_lines

if TYPE_CHECKING:
    from shapely import MultiLineString, Polygon

    from infill.reports.common import GridKeys
    from infill.reports.making import BlockRequest, MakePlan

StampMethod = Literal["block", "exact"]
SurfaceMethod = Literal["prism", "grid"]
DEFAULT_TOLERANCE = (
    0.002  # mm: far below the precision of a printer, with less than half the triangles of the full contour
)
MAX_TOLERANCE_SHARE = 0.1  # of the line width: the tolerance at which both sides of a wall could take a fifth of it
LINE_WIDTH, HEIGHT = 0.45, 6.0  # mm
EQUAL = 1e-9  # of a side: cells that miss it by less are not stretched
DEFAULT_CELLS = {"block": 3, "exact": 5}
LINES_PER_CELL = 3  # smallest cell of a pattern in line widths: walls, and a gap as wide as two of them

# Measured on the three designs, on blocks from 60 x 60 mm to a whole print bed.
BYTES_BEFORE = {"prism": 78e6, "grid": 130e6}  # the isosurface takes one library more
BYTES_PER_CELL = {"prism": 60, "grid": 100}
BYTES_PER_TRIANGLE = 70
BYTES_PER_CORNER = 250
CORNERS_PER_CELL = 1.125  # of contours, per cell of their length
CAP_TRIANGLES_PER_CELL = 4  # two on each of the two faces
SIDE_TRIANGLES_PER_CORNER = 4
PRISM_TRIANGLES_PER_CORNER = 4  # two of a wall, and one of each cap
STL_BYTES_PER_TRIANGLE = 50


@dataclass(frozen=True, kw_only=True)
class Block:
    """A checked request for a block of infill.

    Parameters
    ----------
    pattern : Pattern
    grid : Grid
        Two axes, centred on (0, 0), mm.
    height, line_width : float
        mm.
    stamp : {"block", "exact"}
    cells : int
        Grid cells across a line.
    smoothing : Smoothing
    surface : {"prism", "grid"}
    tolerance : float
        mm; 0 for the surface "grid".
    """

    pattern: Pattern
    grid: Grid
    height: float
    line_width: float
    stamp: StampMethod
    cells: int
    smoothing: Smoothing
    surface: SurfaceMethod
    tolerance: float

    @cached_property
    def region(self) -> Polygon:
        """Region of the centre lines: the block, smaller by half a line width on each side, mm."""
        half = self.line_width / 2
        (x, y), (width, depth) = self.grid.origin, self.grid.extents
        return shapely.box(x + half, y + half, x + width - half, y + depth - half)

    @cached_property
    def lines(self) -> MultiLineString:
        """The centre lines of the walls, mm."""
        lines = draw_lines(self.pattern, self.region)
        if lines.is_empty:
            raise PatternError(f"no line of {self.pattern.name} lies in the block; use smaller cells or a larger block")
        return lines

    @property
    def layers(self) -> int:
        """Number of layers, one cell thick each, that the stack represents."""
        return layer_count(self.height, float(self.grid.cell_size.min()))

    @cached_property
    def triangles(self) -> int:
        """Expected number of triangles, accurate to about a quarter; that of a prism is counted on samples."""
        if self.surface == "grid":
            cells = float(shapely.length(self.lines)) * self.line_width / float(self.grid.cell_size.prod())
            return round(CAP_TRIANGLES_PER_CELL * cells + SIDE_TRIANGLES_PER_CORNER * self._corners)
        from infill.making.forecast import estimate_corners

        corners = estimate_corners(
            self.lines,
            self.grid,
            stamp=self.stamp,
            cells=self.cells,
            width=self.line_width,
            smoothing=self.smoothing,
            tolerance=self.tolerance,
        )
        return PRISM_TRIANGLES_PER_CORNER * corners

    @property
    def _corners(self) -> float:
        """Expected number of corners of the contours before they are straightened."""
        return CORNERS_PER_CELL * 2 * float(shapely.length(self.lines)) / float(self.grid.cell_size.min())

    @property
    def stl_bytes(self) -> int:
        """Expected size of a binary STL file."""
        return self.triangles * STL_BYTES_PER_TRIANGLE

    @property
    def grid_memory(self) -> int:
        """Bytes of memory for the program and the grid."""
        return int(BYTES_BEFORE[self.surface]) + BYTES_PER_CELL[self.surface] * self.grid.cells

    @property
    def memory(self) -> int:
        """Bytes of memory the work will need, including the program itself."""
        if self.surface == "grid":
            return self.grid_memory + BYTES_PER_TRIANGLE * self.triangles
        return self.grid_memory + round(BYTES_PER_CORNER * self._corners)

    @property
    def origin(self) -> tuple[float, float, float]:
        """Lower corner of the block, mm."""
        x, y = self.grid.origin
        return x, y, 0.0

    def request_keys(self) -> BlockRequest:
        """Return the section `request` of the report."""
        smoothing = self.smoothing
        return {
            "pattern": self.pattern.name,
            "parameters": parameter_values(self.pattern),
            "size": list(self.grid.extents),
            "height": self.height,
            "line_width": self.line_width,
            "stamp": self.stamp,
            "cells_per_line": self.cells,
            "steps": smoothing.steps,
            "fidelity": smoothing.fidelity,
            "interface": smoothing.interface,
            "alpha": smoothing.alpha,
            "surface": self.surface,
            "tolerance": self.tolerance,
        }

    def grid_keys(self) -> GridKeys:
        """Return the section `grid` of the report: the stack of layers."""
        return {
            "shape": [*self.grid.shape, self.layers],
            "spacing": [*self.grid.cell_size.tolist(), self.height / self.layers],
            "origin": list(self.origin),
            "space": "",
        }

    def facts(self) -> MakePlan:
        """Return the report of a dry run."""
        return {
            "request": self.request_keys(),
            "grid": self.grid_keys(),
            "memory": self.memory,
            "triangles": self.triangles,
            "stl_bytes": self.stl_bytes,
        }

    def require_memory(self, limit: int | None) -> None:
        """Raise MemoryLimitError if the work needs more than `limit` bytes, or more than the machine has free."""
        self.require_grid_memory(limit)
        require_memory(self.memory, limit, self._advice)

    def require_grid_memory(self, limit: int | None) -> None:
        """Check the grid alone: counting triangles requires the lines, which may need much memory themselves."""
        require_memory(self.grid_memory, limit, self._advice)

    @property
    def _advice(self) -> str:
        """Return the size of the grid, and how to make it smaller, as a phrase."""
        cells = " × ".join(str(count) for count in self.grid.shape)
        return f"the grid has {cells} cells: take fewer cells per line, wider lines or a smaller block"


def plan_block(
    pattern: Pattern | Cells | Path | str | Callable[..., Any],
    *,
    size: float | tuple[float, ...],
    height: float | None,
    line_width: float | None,
    stamp: StampMethod,
    cells: int | None,
    smoothing: Smoothing,
    parameters: dict[str, Any],
    surface: SurfaceMethod | None = None,
    tolerance: float | None = None,
) -> Block:
    """Check a request and return it with its grid; the parameters are the same as for `infill.make`."""
    ready_pattern = instantiate_pattern(pattern, parameters)
    width, depth, height = check_sides(size, height)
    line_width = LINE_WIDTH if line_width is None else check_length("line_width", line_width)
    if stamp not in get_args(StampMethod):
        raise UsageError.about("stamp", f"is {stamp!r}; choose block or exact")
    across = check_whole_number("cells", DEFAULT_CELLS[stamp] if cells is None else cells, 1)
    if stamp == "block" and across % 2 == 0:
        raise ParameterError.about(
            "cells",
            f"is {across}, and a block of {across} × {across} cells has no middle cell; use an odd number, "
            "or the exact stamp",
        )
    cell = line_width / across
    counts, spacing = zip(*(_divide_side(side, cell) for side in (width, depth)), strict=True)
    if min(counts) < (1 + LINES_PER_CELL) * across:
        raise ParameterError(
            f"a block of {plain_argument(width)} × {plain_argument(depth)} mm has no room for walls of "
            f"{plain_argument(line_width)} mm; make it at least {plain_argument((1 + LINES_PER_CELL) * line_width)} mm "
            "in x and y"
        )
    smoothing.weights((1.0, 1.0))  # raises above the stability limit
    surface, tolerance = _resolve_surface(surface, tolerance, line_width)
    block = Block(
        pattern=ready_pattern,
        grid=Grid(
            shape=counts,
            spacing=spacing,
            origin=tuple(-count * size / 2 for count, size in zip(counts, spacing, strict=True)),
        ),
        height=height,
        line_width=line_width,
        stamp=stamp,
        cells=across,
        smoothing=smoothing,
        surface=surface,
        tolerance=tolerance,
    )
    apart = ready_pattern.line_spacing(block.region)
    if not math.isfinite(apart) or apart < LINES_PER_CELL * line_width * (1 - 1e-9):
        raise ParameterError(
            f"the lines of {ready_pattern.name} lie {plain_argument(apart, 4)} mm apart, under {LINES_PER_CELL} line "
            f"widths ({plain_argument(LINES_PER_CELL * line_width)} mm); use larger cells or a thinner line"
        )
    return block


def check_sides(size: float | tuple[float, ...], height: float | None) -> tuple[float, float, float]:
    """Check the sides of a block and return x, y and z, mm; the height may be the third number of the size."""
    sides = list(size) if isinstance(size, Iterable) else [size, size]
    if len(sides) not in (2, 3):
        raise ParameterError.about(
            "size", f"has {len(sides)} numbers; give x and y in mm, x, y and z, or one number for a square"
        )
    if len(sides) == 3 and height is not None and height != sides[2]:
        raise UsageError.about(
            "height",
            f"is {plain_argument(height)} mm, and size has {plain_argument(sides[2])} mm for it; give one of them",
        )
    upright = sides[2] if len(sides) == 3 else HEIGHT if height is None else height
    return check_length("size x", sides[0]), check_length("size y", sides[1]), check_length("height", upright)


def _divide_side(side: float, cell: float) -> tuple[int, float]:
    """Divide a side into whole cells of about a size, mm; return their number and their size."""
    count = max(1, round(side / cell))
    return count, cell if math.isclose(count * cell, side, rel_tol=EQUAL) else side / count


def _resolve_surface(
    surface: SurfaceMethod | None, tolerance: float | None, line_width: float
) -> tuple[SurfaceMethod, float]:
    """Check the surface and its tolerance; return both, with a missing one derived from the other."""
    if surface is not None and surface not in get_args(SurfaceMethod):
        raise UsageError.about("surface", f"is {surface!r}; choose prism or grid")
    if tolerance is None:
        return (
            ("grid", 0.0) if surface == "grid" else ("prism", min(DEFAULT_TOLERANCE, MAX_TOLERANCE_SHARE * line_width))
        )
    check_range("tolerance", tolerance, 0.0, math.inf, "mm")
    if surface == "grid" and tolerance > 0:
        raise UsageError.about(
            ("surface", "tolerance"),
            f"exclude each other: grid is the isosurface as it is, and not {plain_argument(tolerance)} mm off; leave "
            "the tolerance out, or take prism",
        )
    if tolerance > MAX_TOLERANCE_SHARE * line_width:
        raise ParameterError.about(
            "tolerance",
            f"is {plain_argument(tolerance)} mm; it must be at most a tenth of the line width, "
            f"{plain_argument(MAX_TOLERANCE_SHARE * line_width)} mm",
        )
    return surface or ("prism" if tolerance > 0 else "grid"), float(tolerance)


def is_stamped(pattern: object, density: float | None) -> bool:
    """Tell whether a block is drawn once and extruded: no density is asked for, and all layers are the same."""
    if density is not None:
        return False
    kind, _ = resolve_pattern(pattern, "make")
    return not isinstance(kind, Cells) and kind.prismatic


def refuse_stamp_options(given: Mapping[str, bool], density: float | None) -> None:
    """Raise UsageError for an option that is given and only serves blocks that are drawn once and extruded."""
    for option, is_given in given.items():
        if is_given:
            reason = "this pattern changes with height" if density is None else "a density is asked for"
            raise UsageError.about(
                option, f"serves blocks that are stamped layer by layer, and {reason}; leave {option} out"
            )


def refuse_frame(pattern: object, *, given: bool) -> None:
    """Raise UsageError for a frame around a pattern that has none unless a density is asked for, such as a drawing."""
    kind, _ = resolve_pattern(pattern, "make")
    if given and "frame" not in declared(kind):
        raise UsageError.about("frame", f"is not for {kind.name} without a density; add a density, such as 20%")
