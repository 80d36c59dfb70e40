"""One way from data to a surface, in five stages, whatever the data come from: see `attempted` and `delivered`.

cleaned     the data without specks
smoothed    the field in bricks
levelled    the surface at the level at which every component has its volume, without crumbs
judged      what smoothing did: to components, cavities, tunnels and walls, and how far the surface lies from what
            was given, both ways
delivered   the surface in its place, simplified, and the report
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from infill.errors import GeometryError
from infill.inspection.bricks import Verdict, verdict, verdict_by_flips
from infill.inspection.fidelity import Fidelity, fidelity
from infill.inspection.sign_changes import Flips, near_each_other
from infill.inspection.thickness import thinnest_walls
from infill.kernels.compiling import told_of_compiling
from infill.kernels.threads import thread_count, together
from infill.meshes.distance import distances
from infill.meshes.measuring import with_measures
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.report import report_of
from infill.result import Clock, Result
from infill.sections import Sections
from infill.smoothing.cleaning import cleaned, require_room
from infill.smoothing.comparing import Differences, differences, kinds_of_places
from infill.smoothing.crumbs import Crumbs, without_crumbs
from infill.smoothing.levelling import Surfaced, levelled
from infill.smoothing.placing import lightened, placed, raw_surface
from infill.smoothing.stages import SmoothStages

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.report_keys import SmoothReport
    from infill.smoothing.request import Given, Request
    from infill.surface import Surface
    from infill.volume import Volume

OFF = 0.01  # of the volume: how far the volume may be off, because of specks that are gone
NAMED = 5  # of the places that were lost or added are listed
COMPARED = 5_000  # vertices of the voxels whose distance from the mesh is told


@dataclass(frozen=True, kw_only=True, eq=False)
class Attempt:
    """A surface, before it is simplified, and what is to be said about it.

    Parameters
    ----------
    given, request : Given, Request
        Of which it was made; the data without specks, and lengths in cells.
    field : SparseField
    surfaced : Surfaced
    crumbs, specks : Crumbs, int
        What was taken out afterwards and beforehand.
    judged : Verdict
    thinnest : (float or None, float or None), mm
        The thinnest walls, in the data and smoothed: see `infill.inspection.thickness.thinnest_walls`.
    found : Fidelity or None
        How far it lies from what was given; None if it is sure to be near everywhere, and nobody measured it.
    told : Differences
    full : Surface, mm
        The surface in its place.
    clock : Clock
    """

    given: Given
    request: Request
    field: SparseField
    surfaced: Surfaced
    crumbs: Crumbs
    specks: int
    judged: Verdict
    thinnest: tuple[float | None, float | None]
    found: Fidelity | None
    told: Differences
    full: Surface
    clock: Clock

    @property
    def sound(self) -> bool:
        """Whether there is nothing that another attempt might mend."""
        return self.told.word != "lost" and not self.apart

    @property
    def apart(self) -> bool:
        """Whether parts ran together or came apart, holes of a mesh closed, or the volume is off."""
        changes, was, now = self.judged.changes, self.given.topology, self.judged.result
        if was is None:
            broken = bool(changes.broken or changes.fused or changes.vanished)
        else:
            broken = now.components != was.components or now.tunnels < was.tunnels
        return broken or off_by(self.surfaced, self.given, self.request) != 0

    @property
    def rank(self) -> tuple[bool, int, float]:
        """The lower, the better."""
        patches = (*self.found.lost, *self.found.added) if self.found else ()
        area = float(sum(patch.area for patch in patches))
        return self.told.word == "lost", len(self.told.problems), area


@told_of_compiling("the smoother")
def attempted(given: Given, request: Request) -> Attempt:
    """Return one result, however good it is; the way to smooth is known by now. The first four stages.

    Raises
    ------
    GeometryError
        If nothing is left, or the surface is not closed.
    MemoryLimitError
    """
    request = request.at(float(given.data.cell_size.min()))
    clock = Clock(request.progress)
    with clock.stage("smooth", 0.05):
        require_room(given.data, request)
        data, specks = cleaned(given.data, request)
        given = replace(given, data=data)
        field = _smoothed(given, request, clock)
    with clock.stage("surface", 0.4):
        raised = levelled(field, given, request)
    with clock.stage("check", 0.5):
        threads = thread_count(request.threads)
        full, (flips, near), _ = together(
            partial(_whole, raised, data),
            partial(_changed, raised, given, request),
            partial(getattr, raised.found, "shells"),
            threads=threads,
        )
        surfaced, crumbs = without_crumbs(raised, given, request)
        if surfaced.found.surface is not raised.found.surface:
            full = _whole(surfaced, data)
        if not full.closed:
            raise GeometryError("the surface is not closed; use finer voxels or fewer steps")
        judged, thinnest = together(
            partial(_judged, surfaced, flips, data, request), partial(_thinnest, surfaced, data), threads=threads
        )
        found = None if near and not crumbs.count else _compared(full, given, field, request)
    return Attempt(
        given=given,
        request=request,
        field=field,
        surfaced=surfaced,
        crumbs=crumbs,
        specks=specks,
        judged=judged,
        thinnest=thinnest,
        found=found,
        told=differences(judged, found, given, off=off_by(surfaced, given, request)),
        full=full,
        clock=clock,
    )


def _judged(surfaced: Surfaced, flips: Flips, data: Volume, request: Request) -> Verdict:
    """Return how the solid is connected before and after: by the cells that changed sign, or else by all of them."""
    return verdict_by_flips(
        surfaced.found, surfaced.before, flips, levels=surfaced.levels, threads=request.threads
    ) or verdict(
        surfaced.found,
        surfaced.before,
        spacing=tuple(data.cell_size.tolist()),
        blur=request.smoothing.blur,
        levels=surfaced.levels,
        threads=request.threads,
    )


def _whole(surfaced: Surfaced, data: Volume) -> Surface:
    """Return the surface in its place, measured, on this thread: others see what has changed meanwhile."""
    return with_measures(placed(surfaced.found.surface, data), threads=1)


def _changed(raised: Surfaced, given: Given, request: Request) -> tuple[Flips, bool]:
    """Return the cells that changed sign, and whether the surface is sure to be near what was given: the data."""
    found, spacing = raised.found, tuple(given.data.cell_size.tolist())
    flips = Flips.of(found.against, raised.before.bits, found.height, signs=found.signs, threads=request.threads)
    of_data = given.mesh is None and given.raw is None
    return flips, of_data and near_each_other(flips, spacing=spacing, threads=request.threads)


def _thinnest(surfaced: Surfaced, data: Volume) -> tuple[float | None, float | None]:
    """Return how thin the walls are, in the data and smoothed, mm."""
    found = surfaced.found
    return thinnest_walls(found.against, found.surface, tuple(data.cell_size.tolist()), found.height)


def delivered(best: Attempt) -> tuple[Result[SmoothStages, SmoothReport], Differences]:
    """Return the result of an attempt, simplified, and what is to be said of what is delivered: the fifth stage."""
    given, request, clock, data = best.given, best.request, best.clock, best.given.data
    judged, surfaced, found, told = best.judged, best.surfaced, best.found, best.told
    with clock.stage("measure", 0.75):
        surface, simplified = lightened(best.full, request)
        if surface is not best.full:
            found = _compared(surface, given, best.field, request)
            told = differences(judged, found, given, off=off_by(surfaced, given, request))
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
        solid={"data": float(surfaced.targets.sum()), "level": _level(surfaced, request)},
        data=judged.data,
        result=judged.result,
        changes=judged.changes,
        walls=_walls(best, data),
        problems=[*told.losses, *told.problems],
        seconds=clock.seconds,
        simplified=simplified,
        input={**given.facts, "despeckled": best.specks},
        distance={},
        verdict={
            "word": told.word,
            "changes": [*told.losses, *told.problems, *told.remarks, *_remarks(best.crumbs, best.specks)],
            "lost": [patch.facts() for patch in found.lost[:NAMED]] if found else [],
            "added": [patch.facts() for patch in found.added[:NAMED]] if found else [],
            "crumbs": {"removed": best.crumbs.count, "volume": best.crumbs.volume, "limit": best.crumbs.limit},
            "tried": [],
        },
    )
    report = Sections(report, {"distance": partial(_distance, surface, given, best.field, request)})
    stages = SmoothStages(data=data, levelled=surfaced.found, given=given.mesh)
    return Result(surfaces={"solid": surface}, report=cast("SmoothReport", report), stages=stages), told


def _raw(given: Given, field: SparseField, request: Request) -> Surface:
    """Return the surface of the voxels that were given, mm."""
    return given.raw or raw_surface(field, given.data, request.threads)


def _compared(surface: Surface, given: Given, field: SparseField, request: Request, *, exact: bool = False) -> Fidelity:
    """Return how far a surface lies from what was given, both ways; by default, only where that is far."""
    return fidelity(
        _raw(given, field, request) if given.mesh is None else given.mesh,
        surface,
        cell=given.cell or float(given.data.cell_size.max()),
        closed=given.reference,
        kinds=kinds_of_places(given, field, threads=request.threads),
        exact=exact,
        threads=request.threads,
    )


def _smoothed(given: Given, request: Request, clock: Clock) -> SparseField:
    """Return the field in bricks: the second stage."""
    values, spacing = given.data.values, tuple(given.data.cell_size.tolist())

    def progress(share: float) -> None:
        clock.tell("smooth", 0.05 + 0.3 * share)

    if request.refined:
        return refine_bricks(
            values,
            request.smoothing,
            spacing=spacing,
            exact=given.exact and request.held,
            threads=request.threads,
            progress=progress,
        )
    return smooth_bricks(values, request.smoothing, spacing=spacing, threads=request.threads, progress=progress)


def off_by(surfaced: Surfaced, given: Given, request: Request) -> float:
    """Return by which part of itself the volume is off, where a level was to keep it."""
    held = given.enclosed
    wanted = float(surfaced.targets.sum()) if held is None else held.total
    off = surfaced.volume / wanted - 1
    return off if request.level == "volume" and abs(off) > OFF else 0.0


def _level(surfaced: Surfaced, request: Request) -> dict[str, Any]:
    """Return the levels of phi at which the surface lies, for the report."""
    return {
        "method": "volume" if request.level == "volume" else "fixed",
        "common": surfaced.common,
        "lowest": float(surfaced.levels.min()),
        "highest": float(surfaced.levels.max()),
        "components": len(surfaced.levels),
    }


def _walls(best: Attempt, data: Volume) -> dict[str, Any]:
    """Return how thin the walls are, and which were lost, for the report."""
    before, after = best.thinnest
    lost = [{"voxels": each.voxels, "at": data.place(each.at[None])[0].tolist()} for each in best.judged.lost]
    return {"thinnest": {"data": before, "result": after}, "lost": lost}


def _distance(surface: Surface, given: Given, field: SparseField, request: Request) -> dict[str, Any]:
    """Return how far the result lies from what was given, both ways, and the voxels from a mesh, for the report."""
    found = _compared(surface, given, field, request, exact=True)
    facts: dict[str, Any] = {
        "from": "voxels" if given.mesh is None else "mesh",
        "result": found.there.facts(),
        "input": found.back.facts(),
        "thin": found.thin,
        "sheet": found.sheet,
        "hidden": found.hidden,
    }
    if given.reference is not None:
        raw = _raw(given, field, request)
        away = distances(
            raw.vertices[:: max(1, len(raw.vertices) // COMPARED)], given.reference, threads=request.threads
        )
        facts["data"] = {
            "mean": float(away.mean()),
            "rms": float(np.sqrt((away**2).mean())),
            "max": float(away.max()),
        }
    return facts


def _remarks(crumbs: Crumbs, specks: int) -> list[str]:
    """Return what was taken out on purpose, one phrase each."""
    said = []
    if crumbs.count:
        said.append(f"{crumbs.count} crumbs of up to {crumbs.limit:.3g} mm³ taken out, {crumbs.volume:.3g} mm³ in all")
    if specks:
        said.append(f"{specks} specks taken out beforehand")
    return said
