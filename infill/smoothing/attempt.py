"""Smooth data of any source into a surface, in five stages: see `run_attempt` and `finish_attempt`.

clean       remove specks from the data
smooth      compute the field in bricks
level       find the surface at the level at which every component has its volume, and remove crumbs
judge       compare components, cavities, tunnels and walls before and after, and measure the distance between the
            surface and the input, both ways
deliver     place and simplify the surface, and write the report
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from infill.errors import GeometryError
from infill.inspection.bricks import TopologyCheck, check_topology, check_topology_by_signs
from infill.inspection.fidelity import Fidelity, measure_fidelity
from infill.inspection.sign_changes import SignChanges, are_surfaces_near
from infill.inspection.thickness import thinnest_walls
from infill.kernels.compiling import log_compilation
from infill.kernels.threads import run_together, thread_count
from infill.meshes.distance import distances
from infill.meshes.measuring import measure_surface
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.report import report_of
from infill.result import Clock, Result
from infill.sections import Sections
from infill.smoothing.cleaning import remove_specks, require_room
from infill.smoothing.comparing import Differences, find_differences, place_classifier
from infill.smoothing.crumbs import Crumbs, remove_crumbs
from infill.smoothing.levelling import SurfaceAtLevel, extract_surface
from infill.smoothing.placing import place_surface, raw_surface, simplify_result
from infill.smoothing.stages import SmoothStages

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.report_keys import SmoothReport
    from infill.smoothing.request import SmoothInput, SmoothRequest
    from infill.surface import Surface
    from infill.volume import Volume

VOLUME_TOLERANCE = 0.01  # of the volume: deviation that is tolerated, because of specks that are gone
MAX_LISTED_PLACES = 5  # of the places that were lost or added are listed
MAX_COMPARED_VERTICES = 5_000  # vertices of the voxels whose distance from the mesh is reported


@dataclass(frozen=True, kw_only=True, eq=False)
class Attempt:
    """A surface, before it is simplified, and its verdict.

    Parameters
    ----------
    given, request : SmoothInput, SmoothRequest
        The input and the options it was made from; the data have no specks, and lengths are in cells.
    field : SparseField
    surfaced : SurfaceAtLevel
    crumbs, specks : Crumbs, int
        Crumbs removed after smoothing, and the number of specks removed before.
    judged : TopologyCheck
    thinnest : (float or None, float or None), mm
        The thinnest walls, in the data and smoothed: see `infill.inspection.thickness.thinnest_walls`.
    found : Fidelity or None
        Its distance from the input; None if it is sure to be near everywhere, so that it was not measured.
    told : Differences
        The verdict in words.
    full : Surface, mm
        The surface in its place.
    clock : Clock
    """

    given: SmoothInput
    request: SmoothRequest
    field: SparseField
    surfaced: SurfaceAtLevel
    crumbs: Crumbs
    specks: int
    judged: TopologyCheck
    thinnest: tuple[float | None, float | None]
    found: Fidelity | None
    told: Differences
    full: Surface
    clock: Clock

    @property
    def sound(self) -> bool:
        """Whether another attempt could not improve on this one."""
        return self.told.word != "lost" and not self.apart

    @property
    def apart(self) -> bool:
        """Whether parts fused or broke, holes of a mesh closed, or the volume is off."""
        changes, before, after = self.judged.changes, self.given.topology, self.judged.result
        if before is None:
            broken = bool(changes.broken or changes.fused or changes.vanished)
        else:
            broken = after.components != before.components or after.tunnels < before.tunnels
        return broken or volume_error(self.surfaced, self.given, self.request) != 0

    @property
    def rank(self) -> tuple[bool, int, float]:
        """Sort key of attempts: the lowest is the best."""
        patches = (*self.found.lost, *self.found.added) if self.found else ()
        area = float(sum(patch.area for patch in patches))
        return self.told.word == "lost", len(self.told.problems), area


@log_compilation("the smoother")
def run_attempt(smooth_input: SmoothInput, request: SmoothRequest) -> Attempt:
    """Smooth the data in the requested way and judge the surface, however good it is: the first four stages.

    Raises
    ------
    GeometryError
        If nothing is left, or the surface is not closed.
    MemoryLimitError
    """
    request = request.at(float(smooth_input.data.cell_size.min()))
    clock = Clock(request.progress)
    with clock.stage("smooth", 0.05):
        require_room(smooth_input.data, request)
        data, specks = remove_specks(smooth_input.data, request)
        smooth_input = replace(smooth_input, data=data)
        field = _smooth_field(smooth_input, request, clock)
    with clock.stage("surface", 0.4):
        raised = extract_surface(field, smooth_input, request)
    with clock.stage("check", 0.5):
        threads = thread_count(request.threads)
        full, (flips, surely_near), _ = run_together(
            partial(_measured_surface, raised, data),
            partial(_sign_changes, raised, smooth_input, request),
            partial(getattr, raised.found, "shells"),
            threads=threads,
        )
        surfaced, crumbs = remove_crumbs(raised, smooth_input, request)
        if surfaced.found.surface is not raised.found.surface:
            full = _measured_surface(surfaced, data)
        if not full.closed:
            raise GeometryError("the surface is not closed; use finer voxels or fewer steps")
        judged, thinnest = run_together(
            partial(_topology_verdict, surfaced, flips, data, request),
            partial(_wall_thickness, surfaced, data),
            threads=threads,
        )
        deviation = (
            None if surely_near and not crumbs.count else _compare_with_input(full, smooth_input, field, request)
        )
    return Attempt(
        given=smooth_input,
        request=request,
        field=field,
        surfaced=surfaced,
        crumbs=crumbs,
        specks=specks,
        judged=judged,
        thinnest=thinnest,
        found=deviation,
        told=find_differences(judged, deviation, smooth_input, off=volume_error(surfaced, smooth_input, request)),
        full=full,
        clock=clock,
    )


def _topology_verdict(
    surfaced: SurfaceAtLevel, flips: SignChanges, data: Volume, request: SmoothRequest
) -> TopologyCheck:
    """Compare the topology before and after: by the cells that changed sign, or else by all cells."""
    return check_topology_by_signs(
        surfaced.found, surfaced.before, flips, levels=surfaced.levels, threads=request.threads
    ) or check_topology(
        surfaced.found,
        surfaced.before,
        spacing=tuple(data.cell_size.tolist()),
        blur=request.smoothing.blur,
        levels=surfaced.levels,
        threads=request.threads,
    )


def _measured_surface(surfaced: SurfaceAtLevel, data: Volume) -> Surface:
    """Place the surface and measure it, on this thread alone: other threads work on the topology meanwhile."""
    return measure_surface(place_surface(surfaced.found.surface, data), threads=1)


def _sign_changes(
    raised: SurfaceAtLevel, smooth_input: SmoothInput, request: SmoothRequest
) -> tuple[SignChanges, bool]:
    """Return the cells that changed sign, and whether the surface is sure to be near the input (only for voxels)."""
    levelled, spacing = raised.found, tuple(smooth_input.data.cell_size.tolist())
    flips = SignChanges.of(
        levelled.against, raised.before.bits, levelled.height, signs=levelled.signs, threads=request.threads
    )
    of_data = smooth_input.mesh is None and smooth_input.raw is None
    return flips, of_data and are_surfaces_near(flips, spacing=spacing, threads=request.threads)


def _wall_thickness(surfaced: SurfaceAtLevel, data: Volume) -> tuple[float | None, float | None]:
    """Return the thickness of the thinnest wall, in the data and smoothed, mm."""
    levelled = surfaced.found
    return thinnest_walls(levelled.against, levelled.surface, tuple(data.cell_size.tolist()), levelled.height)


def finish_attempt(best: Attempt) -> tuple[Result[SmoothStages, SmoothReport], Differences]:
    """Simplify the surface of an attempt; return the result and its differences from the input: the fifth stage."""
    smooth_input, request, clock, data = best.given, best.request, best.clock, best.given.data
    judged, surfaced, deviation, final_verdict = best.judged, best.surfaced, best.found, best.told
    with clock.stage("measure", 0.75):
        surface, simplified = simplify_result(best.full, request)
        if surface is not best.full:
            deviation = _compare_with_input(surface, smooth_input, best.field, request)
            final_verdict = find_differences(
                judged, deviation, smooth_input, off=volume_error(surfaced, smooth_input, request)
            )
    report = report_of(
        product="smooth",
        surface=surface,
        request=request.facts(),
        grid={
            "shape": list(data.values.shape),
            "spacing": data.cell_size.tolist(),
            "origin": list(data.origin),
            "space": data.space,
        },
        solid={"data": float(surfaced.targets.sum()), "level": _level_facts(surfaced, request)},
        data=judged.data,
        result=judged.result,
        changes=judged.changes,
        walls=_wall_facts(best, data),
        problems=[*final_verdict.losses, *final_verdict.problems],
        seconds=clock.seconds,
        simplified=simplified,
        input={**smooth_input.facts, "despeckled": best.specks},
        distance={},
        verdict={
            "word": final_verdict.word,
            "changes": [
                *final_verdict.losses,
                *final_verdict.problems,
                *final_verdict.remarks,
                *_remarks(best.crumbs, best.specks),
            ],
            "lost": [patch.facts() for patch in deviation.lost[:MAX_LISTED_PLACES]] if deviation else [],
            "added": [patch.facts() for patch in deviation.added[:MAX_LISTED_PLACES]] if deviation else [],
            "crumbs": {"removed": best.crumbs.count, "volume": best.crumbs.volume, "limit": best.crumbs.limit},
            "tried": [],
        },
    )
    report = Sections(report, {"distance": partial(_distance_facts, surface, smooth_input, best.field, request)})
    stages = SmoothStages(data=data, levelled=surfaced.found, given=smooth_input.mesh)
    return Result(surfaces={"solid": surface}, report=cast("SmoothReport", report), stages=stages), final_verdict


def _raw_surface(smooth_input: SmoothInput, field: SparseField, request: SmoothRequest) -> Surface:
    """Return the surface of the input voxels, mm."""
    return smooth_input.raw or raw_surface(field, smooth_input.data, request.threads)


def _compare_with_input(
    surface: Surface, smooth_input: SmoothInput, field: SparseField, request: SmoothRequest, *, exact: bool = False
) -> Fidelity:
    """Measure the distance between a surface and the input, both ways; by default, only where it is large."""
    return measure_fidelity(
        _raw_surface(smooth_input, field, request) if smooth_input.mesh is None else smooth_input.mesh,
        surface,
        cell=smooth_input.cell or float(smooth_input.data.cell_size.max()),
        closed=smooth_input.reference,
        kinds=place_classifier(smooth_input, field, threads=request.threads),
        exact=exact,
        threads=request.threads,
    )


def _smooth_field(smooth_input: SmoothInput, request: SmoothRequest, clock: Clock) -> SparseField:
    """Smooth the data into a field of bricks: the second stage."""
    values, spacing = smooth_input.data.values, tuple(smooth_input.data.cell_size.tolist())

    def progress(share: float) -> None:
        clock.tell("smooth", 0.05 + 0.3 * share)

    if request.refined:
        return refine_bricks(
            values,
            request.smoothing,
            spacing=spacing,
            exact=smooth_input.exact and request.held,
            threads=request.threads,
            progress=progress,
        )
    return smooth_bricks(values, request.smoothing, spacing=spacing, threads=request.threads, progress=progress)


def volume_error(surfaced: SurfaceAtLevel, smooth_input: SmoothInput, request: SmoothRequest) -> float:
    """Return the relative error of the volume; 0 if it is tolerable, or the level was fixed."""
    enclosed = smooth_input.enclosed
    target = float(surfaced.targets.sum()) if enclosed is None else enclosed.total
    error = surfaced.volume / target - 1
    return error if request.level == "volume" and abs(error) > VOLUME_TOLERANCE else 0.0


def _level_facts(surfaced: SurfaceAtLevel, request: SmoothRequest) -> dict[str, Any]:
    """Return the levels of phi at which the surface lies, for the report."""
    return {
        "method": "volume" if request.level == "volume" else "fixed",
        "common": surfaced.common,
        "lowest": float(surfaced.levels.min()),
        "highest": float(surfaced.levels.max()),
        "components": len(surfaced.levels),
    }


def _wall_facts(best: Attempt, data: Volume) -> dict[str, Any]:
    """Return the thickness of the thinnest walls and the places of lost ones, for the report."""
    data_thickness, result_thickness = best.thinnest
    lost = [{"voxels": patch.voxels, "at": data.place(patch.at[None])[0].tolist()} for patch in best.judged.lost]
    return {"thinnest": {"data": data_thickness, "result": result_thickness}, "lost": lost}


def _distance_facts(
    surface: Surface, smooth_input: SmoothInput, field: SparseField, request: SmoothRequest
) -> dict[str, Any]:
    """Return the distances between result and input, both ways, and from voxels to mesh, for the report."""
    deviation = _compare_with_input(surface, smooth_input, field, request, exact=True)
    facts: dict[str, Any] = {
        "from": "voxels" if smooth_input.mesh is None else "mesh",
        "result": deviation.there.facts(),
        "input": deviation.back.facts(),
        "thin": deviation.thin,
        "sheet": deviation.sheet,
        "hidden": deviation.hidden,
    }
    if smooth_input.reference is not None:
        raw = _raw_surface(smooth_input, field, request)
        distances_from_mesh = distances(
            raw.vertices[:: max(1, len(raw.vertices) // MAX_COMPARED_VERTICES)],
            smooth_input.reference,
            threads=request.threads,
        )
        facts["data"] = {
            "mean": float(distances_from_mesh.mean()),
            "rms": float(np.sqrt((distances_from_mesh**2).mean())),
            "max": float(distances_from_mesh.max()),
        }
    return facts


def _remarks(crumbs: Crumbs, specks: int) -> list[str]:
    """Describe crumbs and specks that were removed on purpose, one phrase each."""
    phrases = []
    if crumbs.count:
        phrases.append(
            f"{crumbs.count} crumbs of up to {crumbs.limit:.3g} mm³ taken out, {crumbs.volume:.3g} mm³ in all"
        )
    if specks:
        phrases.append(f"{specks} specks taken out beforehand")
    return phrases
