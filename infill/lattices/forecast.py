"""Forecast of a fill: its sizes, its grid and its memory, and whether there is room for voids at all."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from infill.errors import GeometryError
from infill.interior.interior import (
    added_length,
    compute_interior,
    describe_no_room,
    expected_bytes,
    grid_for_part,
)
from infill.lattices.areas import find_areas
from infill.lattices.modifiers import add_modifiers
from infill.lattices.request import FillSpec, has_bars
from infill.lattices.sizing import choose_sizes, choose_voxel, goes_by_slabs
from infill.lattices.task import FillTask

if TYPE_CHECKING:
    from infill.grid import Grid
    from infill.reports.filling import FillForecast
    from infill.surface import Surface

COARSE_CELLS = 2e5  # of the grid on which the room inside the walls is measured
# Fitted to the peaks of 15 processes that filled 6 parts with one to three patterns: the estimate is 0.7 to 1.5 times
# the peak. The parts: a bracket, 3DBenchy, the carriage of a printer, a tray, a mount and a hinge. Bytes:
PROCESS = 180e6  # interpreter, libraries and compiled loops
PER_FACE = 300  # of the part
# Faces of voids before they are simplified are counted as their area, in sides of cells. Each mm³ has 2 d / w of it
# with walls of a width w at a density d, 4 d / w with bars.
PER_SIDE = 1000
FACES_PER_SIDE = 2
PER_SIDE_JOINED = 1000  # more, where manifold3d cuts and unites the voids of several patterns


@dataclass(frozen=True, kw_only=True)
class PlannedVoids:
    """Planned voids of a whole part with one pattern.

    Parameters
    ----------
    task : FillTask
    cell, width, voxel : float, mm
    grid : Grid
    """

    task: FillTask
    cell: float
    width: float
    voxel: float
    grid: Grid

    @classmethod
    def of(cls, task: FillTask) -> PlannedVoids:
        """Plan the voids of a task; raise GeometryError for sizes that no grid can have."""
        cell, width = choose_sizes(task)
        voxel, request = choose_voxel(task, cell, width), task.request
        further = added_length(request.open_, max(request.walls), request.beyond, voxel)
        grid = grid_for_part(task.part, voxel=voxel, further=further)
        return cls(task=task, cell=cell, width=width, voxel=voxel, grid=grid)

    def expected_bytes(self, room: float, per_side: float) -> float:
        """Estimate the memory of the grid and of the voids in a room, mm³, with so many bytes for each side of a cell.

        Unless the cells of the grid have a requested size, larger ones are taken for voids of too many triangles.
        """
        request = self.task.request
        density = self.width / self.cell if request.density is None else request.density
        faces = 4 if has_bars(request.kind) else 2
        sides = faces * min(density, 1.0) * room / self.width / self.voxel**2
        most = math.inf if request.voxel else request.triangles_left(len(self.task.part.faces)) / FACES_PER_SIDE
        larger = max(1.0, math.sqrt(sides / most))  # times the size of the cells
        grid = expected_bytes(self.grid.shape, request.extra_bytes_per_cell, slabs=goes_by_slabs(self.task))
        return grid / larger**3 + per_side * sides / larger**2


def plan_fill(part: Surface, request: FillSpec, *, threads: int | None = None) -> FillForecast:
    """Return the report of a dry run.

    Raises
    ------
    GeometryError
        If the part is nowhere thicker than two walls, or no grid can be as fine as a wall or cell needs.
    UsageError, ParameterError, patterns.PatternError
        If the pattern of a region cannot be had.
    """
    part, request = add_modifiers(part, request)
    task = FillTask.of(part, request, threads=threads)
    areas = [FillTask.of(part, area.request, threads=threads) for area in find_areas(request)]
    voids, *further = map(PlannedVoids.of, (task, *areas))
    room = measure_room(task)
    grid = voids.grid
    return {
        "request": task.request.facts(),
        "infill": {"cell": voids.cell, "line_width": voids.width},
        "grid": {"shape": list(grid.shape), "spacing": [voids.voxel] * 3, "origin": list(grid.origin), "space": ""},
        "memory": round(_expect_memory([voids, *further], room, len(part.faces))),
    }


def _expect_memory(voids: list[PlannedVoids], room: float, faces: int) -> float:
    """Estimate the memory, bytes, of a process that fills a room, mm³, with one pattern or several."""
    per_side = PER_SIDE + (PER_SIDE_JOINED if len(voids) > 1 else 0)
    return PROCESS + PER_FACE * faces + sum(planned.expected_bytes(room, per_side) for planned in voids)


def measure_room(task: FillTask) -> float:
    """Measure the volume inside the walls on a coarse grid, mm³; raise GeometryError if there surely is none."""
    request, wall = task.request, min(task.request.walls)
    voxel = math.cbrt(float(np.prod(np.maximum(task.extents, task.extents.max() / 1000))) / COARSE_CELLS)

    def volume_inside(thickness: float) -> float | None:
        """Return the volume inside walls of a thickness, mm³; None if there is no room."""
        try:
            return compute_interior(
                task.part,
                wall=thickness,
                voxel=voxel,
                open_=request.open_,
                beyond=request.beyond,
                threads=task.threads,
            ).volume
        except GeometryError as error:
            if error.parameter != "wall":
                raise
            return None

    room = volume_inside(wall)
    # The deepest place lies less than a cell deeper than the coarse grid finds.
    if room is None and wall > voxel and volume_inside(wall - voxel) is None:
        raise GeometryError.about("wall", describe_no_room(task.part, wall))
    return room or 0.0
