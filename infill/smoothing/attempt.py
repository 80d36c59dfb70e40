"""One way from data to a surface, in five stages, whatever the data come from: see `attempted`.

cleaned     the data without specks
smoothed    the field in bricks
levelled    the surface at the level at which every component has its volume, without crumbs
judged      what smoothing did: to components, cavities, tunnels and walls, and how far the surface lies from what
            was given, both ways
delivered   the surface in its place, simplified, and the report
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.errors import GeometryError
from infill.inspection.bricks import Verdict, verdict
from infill.inspection.fidelity import Fidelity, Word, fidelity
from infill.inspection.thickness import thinnest_walls
from infill.kernels.compiling import told_of_compiling
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import smooth_bricks
from infill.report import report_of
from infill.result import Clock, Result
from infill.smoothing.cleaning import cleaned, require_room
from infill.smoothing.comparing import differences, kinds_of_places
from infill.smoothing.crumbs import Crumbs, without_crumbs
from infill.smoothing.levelling import Surfaced, levelled
from infill.smoothing.placing import lightened, placed, raw_surface
from infill.smoothing.stages import SmoothStages
from infill.surfaces.distance import distances

if TYPE_CHECKING:
    from infill.phasefield.sparse import SparseField
    from infill.smoothing.request import Given, Request
    from infill.surface import Surface
    from infill.volume import Volume

OFF = 0.01  # of the volume: how far the volume may be off, because of specks that are gone
COMPARED = 5_000  # vertices of the voxels whose distance from the mesh is told


@dataclass(frozen=True, kw_only=True, eq=False)
class Attempt:
    """A result, and what is to be said about it.

    Parameters
    ----------
    result : Result
    word : {"kept", "changed a little", "lost"}
    losses : tuple of str
        What makes it "lost".
    problems : tuple of str
        What broke, fused or vanished, large or small.
    area : float
        Area that was lost, mm².
    apart : bool
        Whether components or holes through the part are fewer or more than they were, or the volume is off: another way
        may mend it.
    """

    result: Result[SmoothStages]
    word: Word
    losses: tuple[str, ...]
    problems: tuple[str, ...]
    area: float
    apart: bool = False

    @property
    def sound(self) -> bool:
        """Whether there is nothing that another attempt might mend."""
        return self.word != "lost" and not self.apart

    @property
    def rank(self) -> tuple[bool, int, float]:
        """The lower, the better."""
        return self.word == "lost", len(self.problems), self.area


@told_of_compiling("the smoother")
def attempted(given: Given, request: Request) -> Attempt:
    """Return one result, however good it is; the way to smooth is known by now.

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
    spacing = tuple(data.cell_size.tolist())
    with clock.stage("surface", 0.4):
        surfaced, crumbs = without_crumbs(levelled(field, given, request), given, request)
        if not surfaced.found.surface.closed:
            raise GeometryError("the surface is not closed; use finer voxels or fewer steps")
    with clock.stage("check", 0.5):
        judged = verdict(
            surfaced.found,
            surfaced.before,
            spacing=spacing,
            blur=request.smoothing.blur,
            levels=surfaced.levels,
            threads=request.threads,
        )
        full = placed(surfaced.found.surface, data)
        surface, simplified = lightened(full, request)
        raw = given.raw or raw_surface(field, data, request.threads)
        found = fidelity(
            raw if given.mesh is None else given.mesh,
            surface,
            cell=given.cell or float(data.cell_size.max()),
            closed=given.reference,
            kinds=kinds_of_places(given, field),
            threads=request.threads,
        )
    with clock.stage("measure", 0.75):
        walls = _walls(judged, surfaced, data)
    told = differences(judged, found, given, off=_off(surfaced, given, request))
    report = report_of(
        product="smooth",
        surface=surface,
        request=request.facts(),
        grid={
            "shape": list(data.values.shape),
            "spacing": list(spacing),
            "origin": list(data.origin),
            "space": data.space,
        },
        solid={"data": float(surfaced.targets.sum()), "level": _level(surfaced, request)},
        data=judged.data,
        result=judged.result,
        changes=judged.changes,
        walls=walls,
        problems=[*told.losses, *told.problems],
        seconds=clock.seconds,
        simplified=simplified,
        input={**given.facts, "despeckled": specks},
        distance=_distance(found, given, raw, request),
        verdict={
            "word": told.word,
            "changes": [*told.losses, *told.problems, *told.remarks, *_remarks(crumbs, specks)],
            "lost": [patch.facts() for patch in found.lost],
            "added": [patch.facts() for patch in found.added],
            "crumbs": {"removed": crumbs.count, "volume": crumbs.volume, "limit": crumbs.limit},
            "tried": [],
        },
    )
    stages = SmoothStages(data=data, levelled=surfaced.found, given=given.mesh)
    return Attempt(
        result=Result(surfaces={"solid": surface}, report=report, stages=stages),
        word=told.word,
        losses=told.losses,
        problems=told.problems,
        area=float(sum(patch.area for patch in (*found.lost, *found.added))),
        apart=_apart(judged, given) or _off(surfaced, given, request) != 0,
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


def _apart(judged: Verdict, given: Given) -> bool:
    """Return whether parts ran together or came apart, or holes of a mesh are closed."""
    changes, was = judged.changes, given.topology
    if was is None:
        return bool(changes.broken or changes.fused or changes.vanished)
    return judged.result.components != was.components or judged.result.tunnels < was.tunnels


def _off(surfaced: Surfaced, given: Given, request: Request) -> float:
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


def _walls(judged: Verdict, surfaced: Surfaced, data: Volume) -> dict[str, Any]:
    """Return how thin the walls are, and which were lost, for the report."""
    found, spacing = surfaced.found, tuple(data.cell_size.tolist())
    before, after = thinnest_walls(found.against, found.surface, spacing, found.height)
    lost = [{"voxels": each.voxels, "at": data.place(each.at[None])[0].tolist()} for each in judged.lost]
    return {"thinnest": {"data": before, "result": after}, "lost": lost}


def _distance(found: Fidelity, given: Given, raw: Surface, request: Request) -> dict[str, Any]:
    """Return how far the result lies from what was given, both ways, and the voxels from a mesh, for the report."""
    facts: dict[str, Any] = {
        "from": "voxels" if given.mesh is None else "mesh",
        "result": found.there.facts(),
        "input": found.back.facts(),
        "thin": found.thin,
        "sheet": found.sheet,
        "hidden": found.hidden,
    }
    if given.reference is not None:
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
