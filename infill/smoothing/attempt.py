"""Smooth data of any source into a surface, in five stages: see `run_attempt` and `finish_attempt`.

clean       remove specks from the data
smooth      compute the field in bricks
level       find the surface at the level at which every component has its volume, and remove crumbs
judge       compare components, cavities, tunnels and walls before and after, and measure the distance between the
            surface and the input, both ways
deliver     simplify the surface, and write the report
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.errors import GeometryError, ParameterError
from infill.inspection.bricks import TopologyCheck, check_topology, check_topology_by_signs
from infill.inspection.deviation import KEPT, Deviation, total_area
from infill.inspection.sign_changes import SignChanges, are_surfaces_near
from infill.inspection.thickness import thinnest_walls
from infill.inspection.uncertain_places import UncertainPlaces
from infill.isosurfaces.components import data_bits, erase_components, find_components, shell_names
from infill.kernels.compiling import log_compilation
from infill.kernels.second_compiler import await_second_compiler
from infill.kernels.threads import run_together, thread_count
from infill.machine import available_memory, require_memory
from infill.meshes.distance import distances
from infill.meshes.edge_collapse import collapse_edges
from infill.meshes.measuring import measure_surface
from infill.meshes.simplification import SAFE, restore_volume, simplify_surface
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.plain_numbers import plain_argument, plain_number, plain_size
from infill.reports.common import Topology, declare, mesh_keys, report_head, surface_keys
from infill.reports.sections import with_late_sections
from infill.reports.smoothing import Distance, SmoothReport, SolidChanges, SolidMesh, SolidSeconds
from infill.result import Clock, Result
from infill.smoothing.comparing import (
    Differences,
    compare_with_input,
    distance_facts,
    facet_facts,
    find_differences,
    subsample,
    summarise_distances,
    verdict_facts,
    volume_error,
)
from infill.smoothing.levelling import Crumbs, SurfaceAtLevel, describe_cleaning, extract_surface, remove_crumbs
from infill.smoothing.request import SmoothedInput
from infill.smoothing.stages import SmoothStages, place_surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from infill.phasefield.sparse import SparseField
    from infill.reports.common import Level
    from infill.reports.smoothing import Judgement, ReplacedSmoothing, Simplified, SolidWalls
    from infill.smoothing.request import SmoothInput, SmoothRequest
    from infill.surface import Surface
    from infill.volume import Volume

MAX_VOLUME_CHANGE = 0.05  # of the volume: how much simplification may change
BYTES_PER_SURFACE_CELL = 600  # bricks, faces, labels and mesh, for every cell at the surface; a measured peak
BYTES_TO_REFINE = 500  # three filtered fields and the last but one, on top of that
SAMPLED_LAYERS = 16  # layers that are sampled to estimate the surface
FACES_PER_CROSSING = 1.5  # along two of the three axes


@dataclass(frozen=True, kw_only=True, eq=False)
class Attempt:
    """A surface, before it is simplified, and its verdict.

    Parameters
    ----------
    smoothed : SmoothedInput
    surfaced : SurfaceAtLevel
    surface : Surface, mm
        The surface in its place.
    crumbs, specks : Crumbs, int
        Crumbs removed after smoothing, and the number of specks removed before.
    topology : TopologyCheck
    thinnest : (float or None, float or None), mm
        The thinnest walls, in the data and smoothed: see `infill.inspection.thickness.thinnest_walls`.
    deviation : Deviation or None
        Its distance from the input; None if it is sure to be near everywhere, so that it was not measured.
    uncertain : UncertainPlaces or None
        The places that alone may be far from the input; None if that is not known.
    differences : Differences
        The verdict in words.
    clock : Clock
    """

    smoothed: SmoothedInput
    surfaced: SurfaceAtLevel
    surface: Surface
    crumbs: Crumbs
    specks: int
    topology: TopologyCheck
    thinnest: tuple[float | None, float | None]
    deviation: Deviation | None
    uncertain: UncertainPlaces | None
    differences: Differences
    clock: Clock

    @property
    def is_sound(self) -> bool:
        """Whether another attempt could not improve: nothing is lost, broken or fused, and the volume is right."""
        changes, before, after = self.topology.changes, self.smoothed.smooth_input.topology, self.topology.result
        if before is None:
            broken = bool(changes.broken or changes.fused or changes.vanished)
        else:
            broken = after.components != before.components or after.tunnels < before.tunnels
        off = volume_error(self.surfaced, self.smoothed) != 0
        return self.differences.word != "lost" and not broken and not off

    @property
    def rank(self) -> tuple[bool, int, float]:
        """Sort key of attempts: the lowest is the best."""
        area = total_area((*self.deviation.lost, *self.deviation.added) if self.deviation else ())
        differences = self.differences
        return differences.word == "lost", len(differences.losses) + len(differences.problems), area


@log_compilation("the smoother")
def run_attempt(smooth_input: SmoothInput, request: SmoothRequest) -> Attempt:
    """Smooth the data in the requested way and judge the surface, however good it is: the first four stages.

    Raises
    ------
    GeometryError
        If nothing is left, or the surface is not closed.
    MemoryLimitError
    """
    request = request.for_cell(float(smooth_input.data.cell_size.min()))
    clock = Clock(request.progress)
    clock.seconds["voxels"] = smooth_input.seconds
    with clock.stage("smooth", 0.05):
        _require_memory(smooth_input.data, request)
        data, specks = remove_specks(smooth_input.data, request)
        smooth_input = replace(smooth_input, data=data)
        field = _smooth_field(smooth_input, request, clock)
        smoothed = SmoothedInput(smooth_input=smooth_input, request=request, field=field)
    with clock.stage("surface", 0.4):
        raised = extract_surface(smoothed)
    with clock.stage("check", 0.5):
        threads = thread_count(request.threads)
        surface, (flips, surely_near), _ = run_together(
            partial(_measured_surface, raised, data),
            partial(_sign_changes, raised, smoothed),
            partial(getattr, raised.levelled, "shells"),
            threads=threads,
        )
        surfaced, crumbs = remove_crumbs(raised, smoothed)
        if surfaced.levelled.surface is not raised.levelled.surface:
            surface = _measured_surface(surfaced, data)
        if not surface.closed:
            raise GeometryError("the surface is not closed")
        clock.tell("check", 0.6)
        topology, thinnest = run_together(
            partial(_check_topology, surfaced, flips, smoothed),
            partial(_wall_thickness, surfaced, smoothed),
            threads=threads,
        )
        clock.tell("check", 0.65)
        uncertain = None if crumbs.count else _uncertain_places(flips, smoothed)
        is_near = surely_near and not crumbs.count
        deviation = None if is_near else compare_with_input(surface, smoothed, uncertain=uncertain)
    return Attempt(
        smoothed=smoothed,
        surfaced=surfaced,
        surface=surface,
        crumbs=crumbs,
        specks=specks,
        topology=topology,
        thinnest=thinnest,
        deviation=deviation,
        uncertain=uncertain,
        differences=find_differences(topology, deviation, smooth_input, volume_error(surfaced, smoothed)),
        clock=clock,
    )


def remove_specks(data: Volume, request: SmoothRequest) -> tuple[Volume, int]:
    """Remove components up to the requested volume; return the data and the number removed.

    Raises
    ------
    ParameterError
        If no component is larger.
    """
    largest = request.despeckle
    if not largest:
        return data, 0
    field = smooth_bricks(data.values, Smoothing(steps=0), threads=request.threads)
    components = find_components(field, data_bits(field, threads=request.threads))
    small = components.cells * data.cell_volume <= largest
    if small.all():
        raise ParameterError.about(
            "despeckle",
            f"is {plain_number(largest)} mm³ and the largest component has "
            f"{plain_size(components.cells.max() * data.cell_volume, power=3)}; give less",
        )
    if not small.any():
        return data, 0
    return replace(data, values=erase_components(data.values, field, components, small)), int(small.sum())


def estimate_surface_cells(data: Volume) -> float:
    """Estimate the number of cells at the surface of the solid from a few layers."""
    values: NDArray[Any] = data.values
    stride = max(1, values.shape[0] // SAMPLED_LAYERS)
    layers = values[::stride] > 0
    crossings = sum(int(np.count_nonzero(np.diff(layers, axis=axis))) for axis in (1, 2))
    return float(crossings * stride * FACES_PER_CROSSING)


def bytes_per_surface_cell(request: SmoothRequest) -> int:
    """Return the memory that smoothing takes for each cell at the surface, bytes."""
    return BYTES_PER_SURFACE_CELL + (BYTES_TO_REFINE if request.refined else 0)


def _require_memory(data: Volume, request: SmoothRequest) -> None:
    """Raise MemoryLimitError if the surface does not fit into memory."""
    needed = estimate_surface_cells(data) * bytes_per_surface_cell(request)
    allowed = available_memory() if request.max_memory is None else request.max_memory
    # Half as many voxels along each side leave an eighth of the cells of a surface that fills the volume, like noise.
    larger = float(data.cell_size.max()) * 1.1 * (needed / max(allowed or needed, 1)) ** (1 / 3)
    require_memory(
        int(needed), request.max_memory, f"give --voxel {plain_argument(larger, 2)} or more, or --roi for a part of it"
    )


def _smooth_field(smooth_input: SmoothInput, request: SmoothRequest, clock: Clock) -> SparseField:
    """Smooth the data into a field of bricks."""
    values, spacing = smooth_input.data.values, tuple(smooth_input.data.cell_size.tolist())

    def progress(share: float) -> None:
        clock.tell("smooth", 0.05 + 0.3 * share)

    if request.refined:
        return refine_bricks(
            values,
            request.smoothing,
            spacing=spacing,
            exact=smooth_input.mesh_volumes is not None and request.keep_exact,
            threads=request.threads,
            progress=progress,
        )
    return smooth_bricks(values, request.smoothing, spacing=spacing, threads=request.threads, progress=progress)


def _check_topology(surfaced: SurfaceAtLevel, flips: SignChanges, smoothed: SmoothedInput) -> TopologyCheck:
    """Compare the topology before and after: by the cells that changed sign, or else by all cells."""
    return check_topology_by_signs(
        surfaced.levelled, surfaced.components, flips, levels=surfaced.levels, threads=smoothed.threads
    ) or check_topology(
        surfaced.levelled,
        surfaced.components,
        spacing=smoothed.spacing,
        blur=smoothed.request.smoothing.blur,
        levels=surfaced.levels,
        threads=smoothed.threads,
    )


def _measured_surface(surfaced: SurfaceAtLevel, data: Volume) -> Surface:
    """Place the surface and measure it, on this thread alone: other threads work on the topology meanwhile."""
    return measure_surface(place_surface(surfaced.levelled.surface, data), threads=1)


def _sign_changes(raised: SurfaceAtLevel, smoothed: SmoothedInput) -> tuple[SignChanges, bool]:
    """Return the cells that changed sign, and whether the surface is sure to be near the input (only for voxels)."""
    levelled, threads, smooth_input = raised.levelled, smoothed.threads, smoothed.smooth_input
    flips = SignChanges.of(
        levelled.field, raised.components.bits, levelled.height, signs=levelled.signs, threads=threads
    )
    return flips, smooth_input.is_voxels and are_surfaces_near(flips, spacing=smoothed.spacing, threads=threads)


def _uncertain_places(flips: SignChanges, smoothed: SmoothedInput) -> UncertainPlaces | None:
    """Return the places that alone may be far from the input, if the input is the surface of the voxels."""
    smooth_input = smoothed.smooth_input
    return UncertainPlaces.of(flips, smooth_input.data) if smooth_input.is_voxels else None


def _wall_thickness(surfaced: SurfaceAtLevel, smoothed: SmoothedInput) -> tuple[float | None, float | None]:
    """Return the thickness of the thinnest wall, in the data and smoothed, mm."""
    levelled = surfaced.levelled
    return thinnest_walls(levelled.field, levelled.surface, smoothed.spacing, levelled.height)


def finish_attempt(
    best: Attempt, tried: list[str], taken: str, instead_of: ReplacedSmoothing | None = None
) -> tuple[Result[SmoothStages, SmoothReport], Differences]:
    """Simplify the surface of an attempt; return the result and its differences from the input: the fifth stage.

    Parameters
    ----------
    best : Attempt
    tried : list of str
        Names of all ways that were tried, for the report.
    taken : str
        Name of the way of this attempt.
    instead_of : ReplacedSmoothing, optional
        The smoothing that was asked for, if this attempt has another.

    Raises
    ------
    GeometryError
        If simplification would change the volume by more than 5 %, unless broken results are allowed.
    """
    smoothed, clock, surfaced = best.smoothed, best.clock, best.surfaced
    smooth_input, request = smoothed.smooth_input, smoothed.request
    data, topology, deviation, differences = smooth_input.data, best.topology, best.deviation, best.differences
    await_second_compiler()
    with clock.stage("simplify", 0.7):
        surface, simplified, moved = _simplify_result(best.surface, request, clock)
    with clock.stage("measure", 0.92):
        if surface is not best.surface:
            uncertain = None if best.uncertain is None else best.uncertain.after_moving(moved, near=KEPT)
            deviation = compare_with_input(surface, smoothed, uncertain=uncertain)
            differences = find_differences(topology, deviation, smooth_input, volume_error(surfaced, smoothed))
    problems = [*differences.losses, *differences.problems]
    target, simplification = float(surfaced.targets.sum()), {} if simplified is None else {"simplified": simplified}
    report: SmoothReport = {
        **report_head("smooth"),
        **surface_keys(surface),
        "volume": surface.volume,
        "volume_change": surface.volume / target - 1,
        "components": topology.result.components,
        "problems": problems,
        "request": request.facts(),
        "grid": {
            "shape": list(data.values.shape),
            "spacing": data.cell_size.tolist(),
            "origin": list(data.origin),
            "space": data.space,
        },
        "input": {**smooth_input.facts, "despeckled": best.specks},
        "distance": declare(Distance, {}),  # measured when it is first read
        "facets": None,  # so are they
        "isosurface": None,  # and these
        "verdict": {
            **_verdict_facts(differences, deviation, best),
            "tried": tried,
            "taken": taken,
            "instead_of": instead_of,
        },
        "mesh": declare(SolidMesh, {**mesh_keys(surface), **simplification}),
        "solid": {
            "volume": surface.volume,
            "change": surface.volume / target - 1,
            "data": target,
            "level": _level_facts(surfaced, request),
        },
        "topology": declare(Topology, {"data": asdict(topology.data), "result": asdict(topology.result)}),
        "changes": declare(SolidChanges, topology.changes.facts()),
        "walls": _wall_facts(best),
        "seconds": clock.timings(SolidSeconds),
    }
    report = with_late_sections(
        report,
        distance=partial(distance_facts, surface, smoothed),
        facets=partial(facet_facts, surface, smoothed, best.thinnest[0]),
    )
    stages = SmoothStages(data=data, levelled=surfaced.levelled, given=smooth_input.mesh)
    return Result(surfaces={"solid": surface}, report=report, stages=stages), differences


def _verdict_facts(differences: Differences, deviation: Deviation | None, best: Attempt) -> Judgement:
    """Return the verdict with its places and areas, for the report."""
    smoothed, crumbs = best.smoothed, best.crumbs
    cell, cleaned = smoothed.smooth_input.distance_unit, describe_cleaning(crumbs, best.specks, smoothed.request)
    return {**verdict_facts(differences, deviation, cell, cleaned), "crumbs": crumbs.facts()}


def advise_all_triangles(request: SmoothRequest) -> str:
    """Return the advice not to simplify, which is certain to help: the surface was judged before it was simplified."""
    return "give --tolerance 0" + ("" if request.max_triangles is None else ", and no --max-triangles")


def _simplify_result(full: Surface, request: SmoothRequest, clock: Clock) -> tuple[Surface, Simplified | None, float]:
    """Simplify the surface as requested; return it, the changes, None if it stays as it is, and how far it may move.

    The last is in mm: neither surface is further than this from the other, at any place.
    """
    if request.tolerance is None and request.max_triangles is None:
        return full, None, 0.0

    def progress(share: float) -> None:
        clock.tell("simplify", 0.75 + 0.15 * share)

    progress(0.0)
    assert not isinstance(request.tolerance, str)  # `Request.at` has made it a number
    if request.default_tolerance and request.tolerance is not None:
        simplified_surface = collapse_edges(
            full, tolerance=request.tolerance, threads=request.threads, progress=progress
        )
        if simplified_surface is None or simplified_surface is full:
            return full, None, 0.0
    else:
        simplified_surface = simplify_surface(
            full,
            tolerance=request.tolerance,
            triangles=request.max_triangles,
            threads=request.threads,
            progress=progress,
        )
    result = replace(restore_volume(simplified_surface, full.volume), space=full.space)
    moved = math.inf
    if request.tolerance is not None:
        shift = np.asarray(result.vertices) - np.asarray(simplified_surface.vertices)
        moved = request.tolerance / SAFE + float(np.abs(shift).max()) * math.sqrt(3)
    change = result.volume / full.volume - 1
    if abs(change) > MAX_VOLUME_CHANGE and not request.allow_broken:
        raise GeometryError(
            f"simplifying to {len(result.faces):,} triangles would change the volume by {change:+z.0%}; "
            f"{advise_all_triangles(request)}"
        )
    facts: Simplified = {
        "triangles_before": len(full.faces),
        "volume_change": change,
        "shells": shell_names(result)[1],
        "distance": summarise_distances(distances(subsample(full.vertices), result, threads=request.threads)),
    }
    return result, facts, moved


def _level_facts(surfaced: SurfaceAtLevel, request: SmoothRequest) -> Level:
    """Return the levels of phi at which the surface lies, for the report."""
    return {
        "method": "volume" if request.level == "volume" else "fixed",
        "common": surfaced.common,
        "lowest": float(surfaced.levels.min()),
        "highest": float(surfaced.levels.max()),
        "components": len(surfaced.levels),
    }


def _wall_facts(best: Attempt) -> SolidWalls:
    """Return the thickness of the thinnest walls and the places of lost ones, for the report."""
    data_thickness, result_thickness = best.thinnest
    place = best.smoothed.smooth_input.data.place
    return {
        "thinnest": {"data": data_thickness, "result": result_thickness},
        "lost": [{"voxels": piece.voxels, "at": place(piece.at[None])[0].tolist()} for piece in best.topology.lost],
    }
