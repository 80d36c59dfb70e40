"""What smoothing would do, without doing it: the grid, the method, what would be tried, and what it would take.

Time and memory grow with the surface. How many triangles it has before it is simplified is known beforehand: marching
cubes puts a vertex on every edge of the grid that crosses it, and there are twice as many triangles as vertices. What a
triangle takes is measured on a ball, since it depends on the machine, on what else that does, and on the options.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Unpack, cast

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.grid import Grid
from infill.kernels.compiling import told_of_compiling
from infill.machine import require_memory
from infill.meshes.merging import closed_or_merged
from infill.phasefield.schedule import FEWEST
from infill.smoothing.cleaning import BYTES_PER_SURFACE_CELL, BYTES_TO_REFINE
from infill.smoothing.meshes import BYTES_PER_CELL as MESH_BYTES_PER_CELL
from infill.smoothing.meshes import MARGIN, ways_of_mesh
from infill.smoothing.remedies import Way, best_of
from infill.smoothing.request import AUTO, Request
from infill.smoothing.scans import ways_of_scan, ways_of_volume
from infill.smoothing.sources import AXES, Source, check_fitting, threshold_of, voxel_of_points
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.from_mesh import enclosed_cells, grid_around
from infill.voxels.from_points import grid_around_points, voxelise_points

if TYPE_CHECKING:
    from infill.smoothing.request import Method, Options

PER_VERTEX = 2  # triangles
BALL = 16.0  # cells: the radius of the ball on which it is measured how long a triangle takes
MESHES = 0.85  # of that: a triangle of a mesh takes 0.5 to 1.6 times as long, one of a scan 1.0 to 1.2 times; measured
COARSE = 60  # voxels along the longest side: points are looked at with as many
BYTES_BEFORE = 300e6  # of the program itself, a measured peak
BYTES_PER_CELL = 6  # of a volume: which cells are solid, and the data as 32-bit numbers, beside what was read


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """What smoothing would do.

    Parameters
    ----------
    request : Request
        The first way to smooth, with lengths in cells of the grid.
    grid : Grid
    space : str
        Name of the axes: see `infill.Volume`.
    facts : mapping
        What is known about the input, as the report has it.
    solid : float
        Cells that are solid; of a mesh and of points, about.
    ways : tuple of str
        Ways to smooth that would be tried in turn until nothing is lost; the first one is expected to do.
    triangles : int
        Of the surface before it is simplified, about.
    memory : int
        Bytes, about.
    seconds : float
        That the first way takes, about: on this machine, as busy as it is.
    """

    request: Request
    grid: Grid
    space: str
    facts: Mapping[str, Any]
    solid: float
    ways: tuple[str, ...]
    triangles: int
    memory: int
    seconds: float

    @property
    def volume(self) -> float:
        """Volume of the cells that are solid, mm³."""
        return self.solid * float(np.prod(self.grid.cell_size))

    def report(self) -> dict[str, Any]:
        """Return the plan as plain numbers, by the names that the report of a run has for them: see docs/report.md."""
        return {
            "request": self.request.facts(),
            "grid": {
                "shape": list(self.grid.shape),
                "spacing": self.grid.cell_size.tolist(),
                "origin": list(self.grid.origin),
                "space": self.space,
            },
            "input": dict(self.facts),
            "solid": {"data": self.volume},
            "ways": list(self.ways),
            "triangles_before": self.triangles,
            "memory": self.memory,
            "seconds": {"total": self.seconds},
        }


def planned(
    source: Source,
    *,
    begin: float,
    resolution: int | None = None,
    voxel: float | None = None,
    shell: float | None = None,
    threshold: float | None = None,
    between: tuple[float, ...] | None = None,
    label: tuple[int, ...] | None = None,
    otsu: bool = False,
    grey: bool = False,
    by_component: bool = False,
    **options: Unpack[Options],
) -> Plan:
    """Return what `infill.smoothing.sources.smooth_source` would do with the same arguments.

    Parameters
    ----------
    begin : float
        When reading the input began, by `time.perf_counter`: a run takes that time as well.

    Raises
    ------
    ParameterError
        For options that do not fit the input, or do not say what is solid.
    MemoryLimitError
        If a limit is given and the work needs more.
    """
    check_fitting(
        source,
        resolution=resolution is not None,
        voxel=voxel is not None,
        shell=shell is not None,
        threshold=threshold is not None,
        between=between is not None,
        label=label is not None,
        otsu=otsu,
        grey=grey,
        by_component=by_component,
    )
    request = Request(**options)
    if isinstance(source, Volume):
        chosen = threshold_of(threshold, between, otsu=otsu)
        found = _of_volume(ways_of_volume(source, request, threshold=chosen, label=label, grey=grey, voxel=voxel))
    elif isinstance(source, Surface):
        found = _of_mesh(source, request, resolution, voxel)
    else:
        points = source[:, :AXES]
        found = _of_points(points, voxel_of_points(points, resolution, voxel), shell, request)
    grid, asked = found.grid, found.request.at(float(found.grid.cell_size.min()))
    each = BYTES_PER_SURFACE_CELL + (BYTES_TO_REFINE if asked.refined else 0)
    cells, surface = found.bytes_per_cell * grid.cells, each * found.vertices
    if request.max_memory is not None:
        needed = round(max(cells, surface))
        require_memory(needed, request.max_memory, "give larger voxels, or --roi for a part of a volume")
    few = replace(asked.smoothing, steps=min(asked.smoothing.steps, FEWEST))
    _trial(replace(asked, smoothing=few), grid)  # which loads what a run has to load
    loaded = time.perf_counter()
    work = found.share * _trial(asked, grid) * PER_VERTEX * found.vertices
    return Plan(
        request=asked,
        grid=grid,
        space=found.space,
        facts=found.facts,
        solid=found.solid,
        ways=found.ways,
        triangles=round(PER_VERTEX * found.vertices),
        memory=round(BYTES_BEFORE + cells + surface),
        seconds=loaded - begin + work + found.seconds,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Found:
    """What is known of an input before it is smoothed.

    Parameters
    ----------
    request, grid, space, facts, solid, ways
        See `Plan`; lengths of the request are in mm.
    vertices : float
        Edges of the grid that cross the surface, about.
    bytes_per_cell : int
        Of the grid.
    share : float
        How long a triangle takes, relative to one of the ball.
    seconds : float
        That it takes to find what is solid, if that was not done here.
    """

    request: Request
    grid: Grid
    facts: Mapping[str, Any]
    solid: float
    vertices: float
    ways: tuple[str, ...]
    space: str = ""
    bytes_per_cell: int = BYTES_PER_CELL
    share: float = 1.0
    seconds: float = 0.0


def _of_volume(ways: Iterator[Way]) -> _Found:
    first = next(ways)
    given, asked = first.make()
    data = given.data
    solid, vertices = _counted(np.asarray(data.values) > 0)
    return _Found(
        request=asked,
        grid=Grid(shape=data.values.shape, spacing=tuple(data.cell_size.tolist()), origin=data.origin),
        space=data.space,
        facts=given.facts,
        solid=solid,
        vertices=vertices,
        ways=(first.name, *(way.name for way in ways)),
    )


def _of_mesh(surface: Surface, request: Request, resolution: int | None, voxel: float | None) -> _Found:
    """Return what is known of a mesh: nothing of it is looked at cell by cell."""
    fixed = resolution is not None or voxel is not None
    ways = [way.name for way in ways_of_mesh(surface, request, resolution=resolution, voxel=voxel, fixed=fixed)]
    mesh = closed_or_merged(surface.vertices, surface.faces)
    grid = grid_around(mesh, voxel=voxel, resolution=resolution, margin=MARGIN)
    return _Found(
        request=replace(request, method=cast("Method", ways[0]), refine=None),
        grid=grid,
        facts={"source": "mesh", "triangles": len(surface.faces)},
        solid=enclosed_cells(mesh, grid),
        vertices=_crossed(mesh) / float(grid.cell_size[0]) ** 2,
        ways=tuple(ways),
        bytes_per_cell=MESH_BYTES_PER_CELL,
        share=MESHES,
    )


def _of_points(points: NDArray[np.float64], cell: float, shell: float | None, request: Request) -> _Found:
    """Return what is known of points, looked at with voxels so large that it is quickly done."""
    narrow = shell is not None and shell < cell  # an error, of the voxels that were asked for
    times = 1.0 if narrow else max(1.0, float(np.ptp(points, axis=0).max()) / cell / COARSE)
    begin = time.perf_counter()
    wide = shell if shell is None or narrow else max(shell, times * cell)
    solid = voxelise_points(points, voxel=times * cell, shell=wide, margin=MARGIN, threads=request.threads)
    took = time.perf_counter() - begin
    cells, vertices = _counted(np.asarray(solid.values))
    phase = shell is None and request.method != "plain"
    ways = ways_of_scan(solid, solid, {"method": "points"}, {}, request, grey=False, phase=phase)
    first = next(ways)
    return _Found(
        request=first.make()[1],
        grid=grid_around_points(points, voxel=cell, shell=shell, margin=MARGIN),
        facts={"source": "points", "points": len(points), "shell": shell},
        solid=cells * times**3,
        vertices=vertices * times**2,
        ways=(first.name, *(way.name for way in ways)),
        seconds=took * (times**2 - 1),
    )


@told_of_compiling("the smoother")
def _trial(request: Request, grid: Grid) -> float:
    """Return how many seconds a triangle takes: of a ball of cells of the same size, smoothed in the same way."""
    far = np.indices((round(2 * BALL) + 2 * MARGIN,) * 3) - (BALL + MARGIN - 0.5)
    ball = Volume(values=(far**2).sum(axis=0) <= BALL**2, spacing=tuple(grid.cell_size.tolist()))
    asked = replace(
        request,
        method="refine" if request.refined else "plain",
        despeckle=0.0,
        allow_broken=True,
        strict=True,
        tolerance=AUTO if request.tolerance is None and request.max_triangles is not None else request.tolerance,
        max_triangles=None,
        progress=None,
    )
    begin = time.perf_counter()
    with contextlib.suppress(GeometryError):  # nothing is left of it after many steps, which took as long
        best_of(ways_of_volume(ball, asked), asked)
    return (time.perf_counter() - begin) / (PER_VERTEX * _counted(np.asarray(ball.values))[1])


def _counted(solid: NDArray[np.bool_]) -> tuple[int, int]:
    """Return how many cells are solid, and how many edges of the grid cross their surface, at its rim too."""
    inside = sum(int(np.count_nonzero(np.diff(solid, axis=axis))) for axis in range(solid.ndim))
    rim = sum(int(np.count_nonzero(solid.take((0, -1), axis))) for axis in range(solid.ndim))
    return int(np.count_nonzero(solid)), inside + rim


def _crossed(mesh: Surface) -> float:
    """Return how many lines along the axes, one a square mm, cross the surface of a mesh: its projected areas."""
    a, b, c = (np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces[:, i]] for i in range(3))
    return float(np.abs(np.cross(b - a, c - a)).sum()) / 2
