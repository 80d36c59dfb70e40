"""Plan smoothing without doing it: the grid, the ways, and expected time and memory.

Time and memory grow with the surface. Its number of triangles before simplification is known beforehand: marching
cubes puts a vertex on every edge of the grid that crosses it, and there are twice as many triangles as vertices. The
time per triangle is measured on a ball, since it depends on the machine, on its load, and on the options.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.grid import Grid
from infill.imaging.dicom.sampling import SampledStack
from infill.imaging.label_tables import Segment
from infill.imaging.segmentations import Segmentation
from infill.kernels.compiling import log_compilation
from infill.machine import require_memory
from infill.meshes.merging import merge_unless_closed
from infill.phasefield.schedule import MIN_STEPS
from infill.reports.common import declare
from infill.reports.smoothing import InputKeys, LabelsForecast, PlannedInput, PlannedLabel, SmoothForecast
from infill.smoothing.attempt import bytes_per_surface_cell
from infill.smoothing.kept_components import keep_in_mesh, keep_in_scan
from infill.smoothing.label_pieces import find_pieces, refuse_shares
from infill.smoothing.label_stages import LabelPiece
from infill.smoothing.meshes import BYTES_PER_CELL as MESH_BYTES_PER_CELL
from infill.smoothing.meshes import MARGIN, mesh_ways
from infill.smoothing.remedies import first_sound
from infill.smoothing.request import AUTO, SmoothInput, SmoothOptions, SmoothRequest, Way
from infill.smoothing.scans import scan_ways, volume_ways
from infill.smoothing.sources import AXES, Source, SourceOptions, split_options
from infill.surface import Surface
from infill.volume import Volume
from infill.voxels.from_mesh import estimate_solid_cells, grid_around
from infill.voxels.from_points import grid_around_points, voxelise_points

TRIANGLES_PER_VERTEX = 2  # triangles
BALL_RADIUS = 16.0  # cells: the radius of the ball on which the time per triangle is measured
LOADING_RADIUS = 5.0  # cells: the radius of the ball that is smoothed first, to load what a run needs
MESH_TIME_SHARE = (
    0.85  # of that time, measured: a triangle of a mesh takes 0.5 to 1.6 times as long, one of a scan 1.0 to 1.2
)
COARSE_RESOLUTION = 60  # voxels along the longest side of the grid on which points are surveyed
BYTES_BEFORE = 300e6  # of the program itself, a measured peak
BYTES_PER_CELL = 6  # of a volume: the mask of solid cells, and the data as 32-bit numbers, besides its own array


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothPlan:
    """The plan of a smoothing run.

    Parameters
    ----------
    request : SmoothRequest
        The options of the first way, with lengths in cells of the grid.
    grid : Grid
    space : str
        Name of the axes: see `infill.Volume`.
    facts : PlannedInput
        The section `input` of the report.
    solid : float
        Cells that are solid; of a mesh and of points, about.
    ways : tuple of str
        Ways that would be tried in turn until nothing is lost; usually the first one suffices.
    triangles : int
        Of the surface before it is simplified, about.
    memory : int
        Bytes, about.
    seconds : float
        Expected time of the first way on this machine, at its present load.
    """

    request: SmoothRequest
    grid: Grid
    space: str
    facts: PlannedInput
    solid: float
    ways: tuple[str, ...]
    triangles: int
    memory: int
    seconds: float

    @property
    def volume(self) -> float:
        """Volume of the cells that are solid, mm³."""
        return self.solid * float(np.prod(self.grid.cell_size))

    def report(self) -> SmoothForecast:
        """Return the plan as plain numbers, with the keys of the report of a run."""
        return {
            "request": self.request.facts(),
            "grid": {
                "shape": list(self.grid.shape),
                "spacing": self.grid.cell_size.tolist(),
                "origin": list(self.grid.origin),
                "space": self.space,
            },
            "input": self.facts,
            "solid": {"data": self.volume},
            "ways": list(self.ways),
            "triangles_before": self.triangles,
            "memory": self.memory,
            "seconds": {"total": self.seconds},
        }


def plan_smoothing(source: Source | SampledStack, *, begin: float, **options: Unpack[SourceOptions]) -> SmoothPlan:
    """Return the plan for `infill.smoothing.sources.smooth_source` with the same arguments.

    Parameters
    ----------
    source : Source or SampledStack
        Of a sample of slices, numbers of cells and triangles are estimates.
    begin : float
        Start of reading the input, by `time.perf_counter`: the plan includes that time.
    **options
        See `SourceOptions`.

    Raises
    ------
    ParameterError
        For options that do not fit the input, or do not determine the solid.
    MemoryLimitError
        If a limit is given and the work needs more.
    """
    sample = source if isinstance(source, SampledStack) else None
    source = source.volume if isinstance(source, SampledStack) else source
    choice, smooth_options = split_options(source, options)
    request = SmoothRequest(**smooth_options)
    source = _keep_chosen(source, choice)
    if isinstance(source, Volume):
        survey = _survey_volume(volume_ways(source, request, **choice), sample)
    elif isinstance(source, Surface):
        survey = _survey_mesh(source, request, choice.get("resolution"), choice.get("voxel"))
    else:
        survey = _survey_points(source[:, :AXES], choice["voxel"], choice.get("shell"), request)
    grid, cell_request = survey.grid, survey.request.for_cell(float(survey.grid.cell_size.min()))
    cells, surface = survey.bytes_per_cell * grid.cells, bytes_per_surface_cell(cell_request) * survey.vertices
    if request.max_memory is not None:
        needed = round(max(cells, surface))
        require_memory(needed, request.max_memory, "give larger voxels, or --roi for a part of a volume")
    _load_smoother(cell_request, grid)
    loaded = time.perf_counter()
    work = survey.share * _seconds_per_triangle(cell_request, grid) * TRIANGLES_PER_VERTEX * survey.vertices
    return SmoothPlan(
        request=cell_request,
        grid=grid,
        space=survey.space,
        facts=survey.facts,
        solid=survey.solid,
        ways=survey.ways,
        triangles=round(TRIANGLES_PER_VERTEX * survey.vertices),
        memory=round(BYTES_BEFORE + cells + surface),
        seconds=loaded - begin + work + survey.seconds,
    )


def _keep_chosen(source: Source, choice: dict[str, Any]) -> Source:
    """Return the source with the chosen components alone; take them, and a threshold to be found, out of the choice."""
    numbers = choice.pop("keep_components", None)
    if numbers is None:
        return source
    if isinstance(source, Surface):
        return keep_in_mesh(source, numbers, resolution=choice.get("resolution"), voxel=choice.get("voxel"))
    assert isinstance(source, Volume)
    source, choice["threshold"] = keep_in_scan(
        source, numbers, threshold=choice.get("threshold"), label=choice.get("label")
    )
    return source


def plan_labels(
    segmentation: Segmentation,
    *,
    begin: float,
    label: int | tuple[int, ...] | None = None,
    table: Iterable[Segment] = (),
    **options: Unpack[SmoothOptions],
) -> LabelsForecast:
    """Return the plan for `infill.smooth_labels` with the same arguments, as plain numbers.

    Parameters
    ----------
    segmentation : Segmentation
    begin : float
        Start of reading it, by `time.perf_counter`.
    label, table, **options
        See `infill.smooth_labels`.

    Raises
    ------
    ParameterError
        If there is no label, or the requested one is missing.
    """
    request = SmoothRequest(**options)
    refuse_shares(segmentation)
    pieces = find_pieces(segmentation, label, tuple(table))
    smallest = min(segmentation.layers, key=lambda volume: float(volume.cell_size.min()))
    grid = Grid(shape=smallest.values.shape, spacing=tuple(smallest.cell_size.tolist()), origin=smallest.origin)
    cell_request = request.for_cell(float(grid.cell_size.min()))
    return forecast_labels(
        pieces,
        [layer.cell_volume for layer in segmentation.layers],
        grid,
        cell_request,
        memory=max(piece.work(cell_request).memory for piece in pieces),
        begin=begin,
    )


def forecast_labels(
    pieces: Sequence[LabelPiece],
    cell_volumes: Sequence[float],
    grid: Grid,
    request: SmoothRequest,
    *,
    memory: int,
    begin: float,
) -> LabelsForecast:
    """Return the plan for labels that are smoothed each by itself.

    Parameters
    ----------
    pieces : sequence of LabelPiece
    cell_volumes : sequence of float, mm³
        Of the layers.
    grid : Grid
        Of the layer with the smallest cells.
    request : SmoothRequest
        For these cells.
    memory : int
        Bytes for the label that takes most.
    begin : float
        Start of reading, by `time.perf_counter`.
    """
    _load_smoother(request, grid)
    loaded = time.perf_counter()
    triangles = sum(piece.triangles for piece in pieces)
    labels: list[PlannedLabel] = [
        {
            **piece.place,
            "data": cell_volumes[piece.segment.layer] * piece.extent.cells,
            "triangles_before": piece.triangles,
        }
        for piece in pieces
    ]
    return {
        "request": request.facts(),
        "labels": labels,
        "memory": round(BYTES_BEFORE + memory),
        "seconds": {"total": loaded - begin + _seconds_per_triangle(request, grid) * triangles},
    }


@dataclass(frozen=True, kw_only=True, eq=False)
class _InputSurvey:
    """Properties of an input that are known before it is smoothed.

    Parameters
    ----------
    request, grid, space, facts, solid, ways
        See `SmoothPlan`; lengths of the request are in mm.
    vertices : float
        Edges of the grid that cross the surface, about.
    bytes_per_cell : int
        Of the grid.
    share : float
        Time per triangle, relative to that of the ball.
    seconds : float
        Time to find the solid cells, if they were not found here.
    """

    request: SmoothRequest
    grid: Grid
    facts: PlannedInput
    solid: float
    vertices: float
    ways: tuple[str, ...]
    space: str = ""
    bytes_per_cell: int = BYTES_PER_CELL
    share: float = 1.0
    seconds: float = 0.0


def _survey_volume(ways: Sequence[Way], sample: SampledStack | None) -> _InputSurvey:
    """Count cells and vertices of a volume for the plan, or estimate them from a sample of its slices."""
    smooth_input = ways[0].data
    assert isinstance(smooth_input, SmoothInput)
    data = smooth_input.data
    solid: float
    vertices: float
    solid, vertices = count_solid_cells(np.asarray(data.values) > 0)
    shape, facts = tuple(data.values.shape), declare(PlannedInput, smooth_input.facts)
    if sample is not None:
        solid, vertices = _scale_sample(np.asarray(data.values) > 0, sample)
        shape = (*shape[:2], shape[2] * sample.count // sample.sampled)
        facts = {**facts, "sampled": sample.sampled, "of": sample.count}
    return _InputSurvey(
        request=ways[0].request,
        grid=Grid(shape=shape, spacing=tuple(data.cell_size.tolist()), origin=data.origin),
        space=data.space,
        facts=facts,
        solid=solid,
        vertices=vertices,
        ways=tuple(way.name for way in ways if way.option is None),
    )


def _scale_sample(solid: NDArray[np.bool_], sample: SampledStack) -> tuple[float, float]:
    """Estimate the solid cells of a volume, and the grid edges that cross their surface, from runs of its slices."""
    cells = along = across = gaps = 0
    runs = np.split(solid, sample.runs, axis=2)
    joint = solid.shape[2] // sample.sampled // 2  # layers at the ends of a run that were interpolated towards others
    for run in runs:
        cells += int(np.count_nonzero(run))
        across += sum(int(np.count_nonzero(np.diff(run, axis=axis))) for axis in (0, 1))
        across += sum(int(np.count_nonzero(run.swapaxes(0, axis)[[0, -1]])) for axis in (0, 1))
        inner = run[:, :, joint : run.shape[2] - joint]
        along, gaps = along + int(np.count_nonzero(np.diff(inner, axis=2))), gaps + inner.shape[2] - 1
    rim = int(np.count_nonzero(solid[:, :, 0])) + int(np.count_nonzero(solid[:, :, -1]))
    times = sample.count / sample.sampled
    return times * cells, times * across + (times * solid.shape[2] - 1) / gaps * along + rim


def _survey_mesh(surface: Surface, request: SmoothRequest, resolution: int | None, voxel: float | None) -> _InputSurvey:
    """Survey a mesh without voxelising it."""
    fixed = resolution is not None or voxel is not None
    ways = mesh_ways(surface, request, resolution=resolution, voxel=voxel, fixed=fixed)
    mesh = merge_unless_closed(surface.vertices, surface.faces)
    grid = grid_around(mesh, voxel=voxel, resolution=resolution, margin=MARGIN)
    return _InputSurvey(
        request=ways[0].request,
        grid=grid,
        facts={"source": "mesh", "triangles": len(surface.faces)},
        solid=estimate_solid_cells(mesh, grid),
        vertices=_crossings_per_area(mesh) / float(grid.cell_size[0]) ** 2,
        ways=tuple(way.name for way in ways if way.option is None),
        bytes_per_cell=MESH_BYTES_PER_CELL,
        share=MESH_TIME_SHARE,
    )


def _survey_points(
    points: NDArray[np.float64], cell: float, shell: float | None, request: SmoothRequest
) -> _InputSurvey:
    """Survey points with large voxels, which is quick."""
    narrow = shell is not None and shell < cell  # raises an error for the requested voxels
    coarsening = 1.0 if narrow else max(1.0, float(np.ptp(points, axis=0).max()) / cell / COARSE_RESOLUTION)
    begin = time.perf_counter()
    coarse_shell = shell if shell is None or narrow else max(shell, coarsening * cell)
    solid = voxelise_points(points, voxel=coarsening * cell, shell=coarse_shell, margin=MARGIN, threads=request.threads)
    seconds = time.perf_counter() - begin
    cells, vertices = count_solid_cells(np.asarray(solid.values))
    phase = shell is None and request.method != "plain"
    facts: InputKeys = {"source": "points", "points": len(points), "shell": shell}
    ways = scan_ways(solid, solid, {"method": "points"}, facts, request, phase=phase)
    return _InputSurvey(
        request=ways[0].request,
        grid=grid_around_points(points, voxel=cell, shell=shell, margin=MARGIN),
        facts=declare(PlannedInput, facts),
        solid=cells * coarsening**3,
        vertices=vertices * coarsening**2,
        ways=tuple(way.name for way in ways if way.option is None),
        seconds=seconds * (coarsening**2 - 1),
    )


@log_compilation("the smoother")
def _load_smoother(request: SmoothRequest, grid: Grid) -> None:
    """Load what a run needs, by smoothing a small ball in a few steps."""
    shortest = replace(request.smoothing, steps=min(request.smoothing.steps, MIN_STEPS))
    _seconds_per_triangle(replace(request, smoothing=shortest), grid, radius=LOADING_RADIUS)


def _seconds_per_triangle(request: SmoothRequest, grid: Grid, *, radius: float = BALL_RADIUS) -> float:
    """Measure the seconds per triangle before simplification, by smoothing a ball of cells of the same size."""
    offsets = np.indices((round(2 * radius) + 2 * MARGIN,) * 3) - (radius + MARGIN - 0.5)
    ball = Volume(values=(offsets**2).sum(axis=0) <= radius**2, spacing=tuple(grid.cell_size.tolist()))
    trial_request = replace(
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
    with contextlib.suppress(GeometryError):  # many steps leave nothing of the ball, and take as long
        first_sound(volume_ways(ball, trial_request), trial_request)
    return (time.perf_counter() - begin) / (TRIANGLES_PER_VERTEX * count_solid_cells(np.asarray(ball.values))[1])


def count_solid_cells(solid: NDArray[np.bool_]) -> tuple[int, int]:
    """Count the solid cells, and the grid edges that cross their surface, including the rim of the grid."""
    inside = sum(int(np.count_nonzero(np.diff(solid, axis=axis))) for axis in range(solid.ndim))
    faces = (solid.swapaxes(0, axis)[[0, -1]] for axis in range(solid.ndim))
    rim = sum(int(np.count_nonzero(face)) for face in faces)
    return int(np.count_nonzero(solid)), inside + rim


def _crossings_per_area(mesh: Surface) -> float:
    """Count crossings of a mesh with lines along the axes, one per mm²: the sum of its projected areas."""
    a, b, c = (np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces[:, i]] for i in range(3))
    return float(np.abs(np.cross(b - a, c - a)).sum()) / 2
