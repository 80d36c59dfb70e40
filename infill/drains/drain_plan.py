"""The holes of a part: a drain for every void, vents and places on request, and the voids that stay sealed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.drains.drain_branches import find_branches
from infill.drains.drain_places import TURN_OVER, DrainPlaces, DrainTask, TurnedPart
from infill.drains.holes import DrainNeeds, Hole, Kind
from infill.drains.requested_places import find_place, make_hole_at, narrower_diameters
from infill.errors import GeometryError
from infill.interior.opening import Opening
from infill.isosurfaces.components import shell_names
from infill.meshes.shells import shell_volumes
from infill.surface import Surface

DOWN = np.eye(3)
LEVEL = 0.99  # cosine: directions at a smaller angle count as equal
BRANCHES, NARROWEST_BRANCH = (1.0, 0.5, 0.25), 0.5  # of the diameter, tried in order for narrower voids; mm


@dataclass(frozen=True, kw_only=True, eq=False)
class SealedVoid:
    """A void without a hole.

    Parameters
    ----------
    void : int
        Its number.
    volume : float
        mm³
    at : (3,) float64, mm
        Its lowest place; for a vent that is missing, its highest.
    blocked : bool
        True if no line leads straight out of it through solid alone.
    fits : float or None
        The widest diameter of those tried with which the whole plan has a hole for this void, mm.
    together : int
        Number of voids in the same list that have a hole then.
    place : (x, y, z) or None
        Of the largest void that no diameter fits: a place of the skin from which a hole straight in drains it, mm.
    """

    void: int
    volume: float
    at: Floats
    blocked: bool
    fits: float | None = None
    together: int = 0
    place: tuple[float, float, float] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainPlan:
    """The holes of a part, and the voids that have none.

    Parameters
    ----------
    holes : tuple of Hole
    volumes : tuple of float
        Of the voids, mm³, the largest first.
    undrained, unvented : tuple of SealedVoid
        By falling volume.
    diameter : float
        As requested, mm.
    beside : (x, y, z) or None
        A place of the skin from which a hole straight in, as wide as requested, drains the largest void that has only
        narrower branches, mm.
    lower : float or None
        The widest diameter of those tried with which every drain begins within it of the lowest place, mm.
    """

    holes: tuple[Hole, ...]
    volumes: tuple[float, ...] = ()
    undrained: tuple[SealedVoid, ...] = ()
    unvented: tuple[SealedVoid, ...] = ()
    diameter: float = 0.0
    beside: tuple[float, float, float] | None = None
    lower: float | None = None

    @property
    def narrow(self) -> tuple[Hole, ...]:
        """The branches that are narrower than requested, the branch of the largest void first."""
        return tuple(sorted((hole for hole in self.holes if hole.diameter < self.diameter), key=lambda hole: hole.void))

    @property
    def high(self) -> tuple[Hole, ...]:
        """The drains that begin more than their diameter above the lowest place of their void."""
        return tuple(hole for hole in self.holes if hole.kind == "drain" and hole.above > hole.diameter)


def plan_drains(
    part: Surface,
    voids: Surface,
    needs: DrainNeeds,
    *,
    vent: bool = False,
    places: tuple[tuple[float, float, float], ...] = (),
    opening: Opening | None = None,
) -> DrainPlan:
    """Plan the holes of a part.

    Parameters
    ----------
    part : Surface, mm
    voids : Surface, mm
        Facing outwards from themselves.
    needs : DrainNeeds
    vent : bool
        True if every void also gets a hole up from its highest place.
    places : tuple of (x, y, z), mm
        Requested places of holes on the skin.
    opening : Opening or None
        Sides of the part that are open; voids that reach out of them need no drain.

    Raises
    ------
    GeometryError
        If a hole cannot be made at one of the places.
    """
    names, volumes = _number_by_volume(voids)
    task = DrainTask(
        part=part, voids=voids, names=names, volumes=volumes, needs=needs, vent=vent, places=places, opening=opening
    )
    plan = _plan_holes(task)
    if plan.undrained or plan.unvented or plan.high:
        plan = _add_remedies(plan, task)
    if plan.narrow:
        plan = replace(plan, beside=find_place(task, plan.narrow[0].void))
    return plan


def _number_by_volume(voids: Surface) -> tuple[NDArray[np.int64], tuple[float, ...]]:
    """Rank voids by falling volume; return the rank of every vertex's void, and their volumes, mm³."""
    names, count = shell_names(voids)
    volume = shell_volumes(voids, names, count)
    order = np.argsort(-volume, kind="stable")
    rank = np.empty(count, dtype=np.int64)
    rank[order] = np.arange(count)
    return np.where(names >= 0, rank[names], -1), tuple(volume[order].tolist())


def _plan_holes(task: DrainTask) -> DrainPlan:
    """Plan the wished holes, and drains and vents of one diameter; leave voids that have no place without one."""
    needs, opening, opened = task.needs, task.opening, task.opened
    voids = set(range(len(task.volumes)))
    holes = [make_hole_at(task, place) for place in task.places]
    low = needs if opening is None or not math.isfinite(opening.low) else replace(needs, closed_at=opening.low)
    drained = opened | {hole.void for hole in holes}
    drains, undrained = _drain_one_way(task, task.along(DOWN), low, "drain", drained, voids - drained, holes)
    holes += drains
    unvented: tuple[SealedVoid, ...] = ()
    if task.vent:
        high = needs if opening is None or not math.isfinite(opening.high) else replace(needs, closed_at=-opening.high)
        # Voids that are open at a side have their vent there.
        wanting = voids - {sealed.void for sealed in undrained} - opened
        vents, unvented = _drain_one_way(task, task.along(TURN_OVER), high, "vent", opened, wanting, holes)
        holes += vents
    return DrainPlan(
        holes=tuple(holes), volumes=task.volumes, undrained=undrained, unvented=unvented, diameter=needs.diameter
    )


def _add_remedies(plan: DrainPlan, task: DrainTask) -> DrainPlan:
    """Complete a plan with the narrower diameters that give a hole to voids without one."""
    undrained, unvented, lower = list(plan.undrained), list(plan.unvented), None
    for width in narrower_diameters(plan.diameter):
        if all(void.fits is not None for void in undrained + unvented) and (lower is not None or not plan.high):
            break
        try:
            narrower_plan = _plan_holes(task.with_diameter(width))
        except GeometryError:
            continue
        lower = width if lower is None and not narrower_plan.high and not narrower_plan.undrained else lower
        shut = {sealed.void for sealed in narrower_plan.undrained}
        unreached = shut | {sealed.void for sealed in narrower_plan.unvented}
        undrained, unvented = _record_fits(undrained, width, shut), _record_fits(unvented, width, unreached)
    if undrained and undrained[0].fits is None:
        undrained[0] = replace(undrained[0], place=find_place(task, undrained[0].void))
    return replace(plan, undrained=tuple(undrained), unvented=tuple(unvented), lower=lower)


def _record_fits(voids: list[SealedVoid], width: float, without: set[int]) -> list[SealedVoid]:
    """Record a width in voids that have a hole of that width, and had none of a wider one."""
    together = sum(void.void not in without for void in voids)
    return [
        replace(void, fits=width, together=together) if void.fits is None and void.void not in without else void
        for void in voids
    ]


def _drain_one_way(
    task: DrainTask,
    below: TurnedPart,
    needs: DrainNeeds,
    kind: Kind,
    drained: set[int],
    wanting: set[int],
    holes: list[Hole],
) -> tuple[list[Hole], tuple[SealedVoid, ...]]:
    """Drain voids one way; return the holes, including branches to drained voids, and the voids that have none."""
    places = DrainPlaces.of(below, needs)
    taken = [(below.rotation @ hole.at)[:2] for hole in holes if -(below.rotation @ hole.way)[2] > LEVEL]
    new_holes: list[Hole] = []
    drained = set(drained)

    def drill(void: int, apart: bool) -> bool:
        """Drill a void at its best place, off other holes if `apart`; return False if there is none."""
        shaft = places.shaft(void, np.array(taken).reshape(-1, 2) if apart else None)
        if shaft is not None:
            taken.append(shaft.at)
            lowest = float(below.lowest[void])
            new_holes.append(Hole.of(shaft, kind, void, diameter=needs.diameter, lowest=lowest))
            drained.add(void)
        return shaft is not None

    remaining = [void for void in sorted(wanting) if not drill(void, apart=True)]
    branches = find_branches(below, needs, drained, remaining)
    joined = {branch.void for branch in branches}
    # Holes that are near each other leave a thin web between them, which does not show from the side.
    alone = [void for void in remaining if void not in joined]
    without_hole = [void for void in alone if not drill(void, apart=False)]
    for share in BRANCHES[len(without_hole) == len(alone) :]:
        width = share * needs.diameter
        if share == 1 or width >= NARROWEST_BRANCH:
            branches += find_branches(
                below, replace(needs, diameter=width), drained | joined, set(without_hole) - joined
            )
            joined = {branch.void for branch in branches}
    sealed = []
    for void in without_hole:
        if void not in joined:
            corners = np.asarray(below.voids.vertices, dtype=np.float64)[below.names == void]
            at, is_blocked = below.back(corners[np.argmin(corners[:, 2])]), not len(places.order[void])
            sealed.append(SealedVoid(void=void, volume=task.volumes[void], at=at, blocked=is_blocked))
    return [hole.turn_back(below.rotation) for hole in new_holes + branches], tuple(sealed)
