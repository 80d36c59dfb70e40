"""Drains: round holes by which powder and resin leave the voids of a part, each with walls around it.

lowest place of every void, straight down  ->  branches for the others  ->  vents  ->  holes taken out of the solid
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_plan import DrainPlan, SealedVoid, plan_drains
from infill.drains.holes import DrainNeeds, Hole
from infill.errors import GeometryError
from infill.isosurfaces.components import shell_names
from infill.lattices.request import FillSpec
from infill.lattices.task import FillTask
from infill.lattices.void_meshes import VoidMeshes
from infill.meshes.shells import select_faces, shell_volumes
from infill.meshes.solids import FINE, coincident_vertices, from_manifold, solid_status, to_manifold
from infill.plain_numbers import count_noun, plain_argument, plain_number, plain_place, plain_size
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

    from infill.reports.filling import FillDrains, UndrainedVoid

SIDES = 32
TURNS = (0.0, 0.037, 0.071, 0.113)  # radians: rotations of the holes, tried in order, so that no two vertices coincide
NO_DRAINS = DrainPlan(holes=())


@dataclass(frozen=True, kw_only=True, eq=False)
class DrainedSolid:
    """A solid with its drains.

    Parameters
    ----------
    solid : Surface, mm
    plan : DrainPlan
        The holes that it has, and the voids that have none.
    pieces : int
        Pieces of infill that were cut loose by the drilling, and are left out.
    failed : bool
        Whether manifold3d rejects the mesh, so that it has no holes.
    """

    solid: Surface
    plan: DrainPlan = NO_DRAINS
    pieces: int = 0
    failed: bool = False

    @property
    def outlets(self) -> list[Hole]:
        """The holes that leave the part."""
        return [hole for hole in self.plan.holes if hole.kind != "branch"]

    def facts(self) -> FillDrains:
        """Return the drains as the report has them."""
        return {
            "count": len(self.outlets),
            "at": [hole.at.tolist() for hole in self.outlets],
            "holes": [
                {
                    "kind": hole.kind,
                    "at": hole.at.tolist(),
                    "to": hole.to.tolist(),
                    "diameter": hole.diameter,
                    "void": hole.void,
                    "into": hole.into,
                    "wall": hole.clearance if np.isfinite(hole.clearance) else None,
                    "above": hole.above,
                }
                for hole in self.plan.holes
            ],
            "undrained": [_as_report(void) for void in self.plan.undrained],
            "unvented": [_as_report(void) for void in self.plan.unvented],
        }


def _as_report(undrained: SealedVoid) -> UndrainedVoid:
    """Return a void without a drain as the report has it."""
    return {"void": undrained.void, "volume": undrained.volume, "at": undrained.at.tolist(), "fits": undrained.fits}


def check_drain_width(request: FillSpec, bounds: NDArray[np.floating]) -> None:
    """Raise an error if drains are too wide for any place of a part.

    Raises
    ------
    GeometryError
    """
    if request.drain is None or request.drain_at:
        return
    width = float(np.ptp(np.asarray(bounds, dtype=np.float64), axis=0)[:2].min())
    room = width - 2 * request.wall
    if request.drain > room:
        fault = f"is {plain_argument(request.drain)} mm, and the part is {plain_argument(width, 4)} mm wide"
        if room <= 0:
            raise GeometryError.about(
                "drain", f"{fault}, no more than two walls of {plain_argument(request.wall)} mm; leave drain out"
            )
        raise GeometryError.about(
            "drain",
            f"{fault}: between walls of {plain_argument(request.wall)} mm there is room for no more than "
            f"{plain_argument(room, 3)}; give a thinner drain or wall",
        )


def drill_drains(task: FillTask, solid: Surface, hollow: VoidMeshes) -> DrainedSolid:
    """Drill the requested drains; return the solid with its plan.

    Parameters
    ----------
    task : FillTask
    solid : Surface, mm
        The part without its voids.
    hollow : VoidMeshes

    Raises
    ------
    GeometryError
        If there cannot be a drain at a requested place.
    """
    request, space = task.request, hollow.space
    if request.drain is None or not hollow.surfaces:
        return DrainedSolid(solid=solid)
    needs = DrainNeeds(diameter=request.drain, wall=request.wall, cell=hollow.cell, threads=task.threads)
    plan = plan_drains(
        space.part, hollow.surface, needs, vent=request.vent, places=request.drain_at, opening=space.opening
    )
    if not plan.holes:
        return DrainedSolid(solid=solid, plan=plan)
    drilled = _drill(solid, plan.holes)
    if drilled is None:
        return DrainedSolid(solid=solid, plan=NO_DRAINS, failed=True)
    united, pieces = _drop_loose(drilled, solid)
    return DrainedSolid(solid=united, plan=plan, pieces=pieces)


def _drill(solid: Surface, holes: tuple[Hole, ...]) -> Surface | None:
    """Drill holes into a solid; return None if manifold3d rejects it."""
    import manifold3d

    manifold, best = to_manifold(solid), None
    if solid_status(manifold) != FINE:
        return None
    for turn in TURNS:
        tools = [_drill_body(hole, turn) for hole in holes]
        cut = manifold - manifold3d.Manifold.batch_boolean(tools, manifold3d.OpType.Add)
        if solid_status(cut) != FINE or cut.is_empty():
            continue
        candidate = from_manifold(cut)
        twins = int(coincident_vertices(candidate).sum())
        if best is None or twins < best[0]:
            best = twins, candidate
        if candidate.closed and not twins:
            break
    return None if best is None else best[1]


def _drill_body(hole: Hole, turn: float) -> manifold3d.Manifold:
    """Make the body to remove for a hole: a cylinder, with round ends for a branch."""
    import manifold3d

    radius = hole.diameter / 2
    if hole.kind == "branch":
        ball = manifold3d.Manifold.sphere(radius, SIDES).rotate((0.0, 0.0, float(np.degrees(turn))))
        return manifold3d.Manifold.batch_hull([ball.translate(tuple(end)) for end in (hole.at, hole.to)])
    start, end = hole.to, hole.at + hole.out * hole.way
    height = float(np.linalg.norm(end - start))
    axis = np.eye(3)[int(np.argmin(np.abs(hole.way)))]
    across = np.cross(hole.way, axis)
    across /= np.linalg.norm(across)
    axes = np.column_stack([across, np.cross(hole.way, across), hole.way, start])
    circle = manifold3d.CrossSection.circle(radius, SIDES).rotate(float(np.degrees(turn)))
    return circle.extrude(height).transform(axes)


def _drop_loose(drilled: Surface, solid: Surface) -> tuple[Surface, int]:
    """Drop the pieces that drilling cut off, the smallest outer shells; return the rest and their count."""
    names, count = shell_names(drilled)
    volume = shell_volumes(drilled, names, count)
    solid_names, solid_count = shell_names(solid)
    if int((volume > 0).sum()) <= (outer := int((shell_volumes(solid, solid_names, solid_count) > 0).sum())):
        return drilled, 0
    loose = np.argsort(-volume, kind="stable")[outer : int((volume > 0).sum())]
    return select_faces(drilled, ~np.isin(names[drilled.faces[:, 0]], loose)), len(loose)


def drain_problems(request: FillSpec, drained: DrainedSolid, closed: list[tuple[float, list[float]]]) -> Iterator[str]:
    """Yield a message for voids that are still sealed, and for drains that do not do what they should.

    Parameters
    ----------
    request : FillSpec
    drained : DrainedSolid
    closed : list of (float, list of float)
        Voids of the finished mesh that are closed: volume, mm³, and lowest point of each.
    """
    if request.drain is None:
        return
    if drained.failed:
        yield "manifold3d rejects the mesh, so no drain was made; make a solid of the part first: 'infill smooth' does"
    undrained = drained.plan.undrained
    if closed:
        volume, at = closed[0]
        message = f"{count_noun(len(closed), 'void')} still sealed"
        if undrained:
            largest = undrained[0]
            volume, at = largest.volume, largest.at.tolist()
        message += f", the largest, of {plain_size(volume, power=3)}, with its lowest place at {plain_place(at)}"
        if undrained and undrained[0].blocked:
            message += (
                ": below it lie other voids or faces too steep for a hole, and no wall beside it has room for a "
                f"branch of {plain_argument(request.drain)} mm; {_advise(undrained)}"
            )
        elif undrained:
            message += (
                f": straight down from it, a hole of {plain_argument(request.drain)} mm leaves less than a wall of "
                f"{plain_argument(request.wall)} mm; {_advise(undrained)}"
            )
        yield message
    if drained.plan.unvented:
        unvented = drained.plan.unvented[0]
        thinner = "" if unvented.fits is None else f"{_advise_thinner(drained.plan.unvented, 'have one')}; or "
        yield (
            f"{count_noun(len(drained.plan.unvented), 'void')} without a vent, the largest, of "
            f"{plain_size(unvented.volume, power=3)}, with its highest place at {plain_place(unvented.at)}: there is "
            f"no way for a hole of {plain_argument(request.drain)} mm up from it; {thinner}leave vent out"
        )
    if narrow := drained.plan.narrow:
        worst, place = narrow[0], drained.plan.beside
        yield (
            f"{count_noun(len(narrow), 'void')} drained only through branches narrower than "
            f"{plain_argument(request.drain)} mm, the largest, of {plain_number(drained.plan.volumes[worst.void])} "
            f"mm³, through one of {plain_argument(worst.diameter)} mm at {plain_place(worst.at)}, where no wider one "
            "was found that "
            "keeps the wall" + ("" if place is None else f"; it has room for a drain at {plain_place(place, 6)}")
        )
    if high := drained.plan.high:
        worst = max(high, key=lambda hole: hole.above)
        lower = drained.plan.lower
        yield (
            f"{count_noun(len(high), 'drain')} with a start more than {plain_argument(request.drain)} mm above the "
            f"lowest place of the void, at most {plain_argument(worst.above, 3)} mm, at {plain_place(worst.at)}: what "
            "lies below runs out only if the part is "
            "tilted" + ("" if lower is None else f"; with drains of {plain_argument(lower)} mm, none does")
        )


def _advise(undrained: tuple[SealedVoid, ...]) -> str:
    """Say how to drain the largest of the voids that are still sealed, if any attempt succeeded."""
    if undrained[0].fits is not None:
        return _advise_thinner(undrained, "drain")
    if undrained[0].place is not None:
        return f"a drain at {plain_place(undrained[0].place, 6)} opens it"
    return "no thinner drain, and none upwards or from a side, has room either; patterns of bars leave fewer voids"


def _advise_thinner(undrained: tuple[SealedVoid, ...], does: str) -> str:
    """Say which diameter gives the largest void its hole, and how many of the other voids."""
    largest = undrained[0]
    who = "all of them" if largest.together == len(undrained) else f"this and {largest.together - 1} of the others"
    return f"with drains of {plain_argument(largest.fits or 0.0)} mm, {who} {does}"


def find_closed_voids(solid: Surface) -> list[tuple[float, list[float]]]:
    """Find the closed voids of a solid: volume, mm³, and lowest point of each, mm, by falling volume.

    >>> import trimesh
    >>> outer, inner = trimesh.creation.box((4, 4, 4)), trimesh.creation.box((2, 2, 2))
    >>> both = trimesh.util.concatenate([outer, trimesh.Trimesh(inner.vertices, inner.faces[:, ::-1])])
    >>> find_closed_voids(Surface(vertices=both.vertices, faces=both.faces))
    [(8.0, [-1.0, -1.0, -1.0])]
    """
    names, count = shell_names(solid)
    vertices = np.asarray(solid.vertices, dtype=np.float64)
    volume = shell_volumes(solid, names, count)
    order = np.lexsort((vertices[:, 2], names))
    lowest = order[np.searchsorted(names[order], np.arange(count))]
    closed = sorted(np.flatnonzero(volume < 0).tolist(), key=lambda shell: volume[shell])
    return [(round(float(-volume[shell]), 9), vertices[lowest[shell]].tolist()) for shell in closed]
