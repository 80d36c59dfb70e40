"""Drains: round holes by which powder and resin leave the voids of a part, each with walls around it.

lowest place of every void, straight down  ->  branches for the others  ->  vents  ->  holes taken out of the solid
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_places import Needs
from infill.drains.drain_plan import DrainPlan, Hole, Undrained, plan_drains
from infill.errors import GeometryError
from infill.interior.hollow import Hollow
from infill.isosurfaces.components import shell_names
from infill.lattices.request import Request
from infill.meshes.shells import shell_volumes, with_faces
from infill.meshes.solids import FINE, in_one_place, solid_of, status_of, surface_from
from infill.surface import Surface

if TYPE_CHECKING:
    import manifold3d

SIDES = 32
TURNS = (0.0, 0.037, 0.071, 0.113)  # radians: holes are turned so that no two vertices are in one place; tried in turn
NOWHERE = DrainPlan(holes=())

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Drained:
    """A solid with its drains.

    Parameters
    ----------
    solid : Surface, mm
    plan : DrainPlan
        The holes that it has, and the voids that have none.
    pieces : int
        Pieces of infill that hung on nothing else than what was drilled away, which are left out.
    failed : bool
        Whether manifold3d rejects the mesh, so that it has no holes.
    """

    solid: Surface
    plan: DrainPlan = NOWHERE
    pieces: int = 0
    failed: bool = False

    @property
    def outlets(self) -> list[Hole]:
        """The holes that leave the part."""
        return [hole for hole in self.plan.holes if hole.kind != "branch"]

    def facts(self) -> dict[str, Any]:
        """Return what the report says of the drains."""
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
            "undrained": [_left(each) for each in self.plan.undrained],
            "unvented": [_left(each) for each in self.plan.unvented],
        }


def _left(each: Undrained) -> dict[str, Any]:
    return {"void": each.void, "volume": each.volume, "at": each.at.tolist(), "fits": each.fits}


def check_width(request: Request, bounds: NDArray[np.floating]) -> None:
    """Raise an error if drains are too wide for any place of a part.

    Raises
    ------
    GeometryError
    """
    if request.drain is None or request.drain_at:
        return
    width = float(np.ptp(np.asarray(bounds, dtype=np.float64), axis=0)[:2].min())
    most = width - 2 * request.wall
    if request.drain > most:
        given = f"drain is {request.drain:g} mm, and the part is {width:.4g} mm wide"
        if most <= 0:
            raise GeometryError(f"{given}, no more than two walls of {request.wall:g} mm; leave drain out")
        raise GeometryError(
            f"{given}: between walls of {request.wall:g} mm there is room for no more than {most:.3g}; give a thinner "
            "drain or wall"
        )


def drain(solid: Surface, hollow: Hollow, request: Request, *, threads: int | None = None) -> Drained:
    """Drill the drains that were asked for.

    Parameters
    ----------
    solid : Surface, mm
        The part without its voids.
    hollow : Hollow
    request : Request
    threads : int, optional

    Raises
    ------
    GeometryError
        If there cannot be a drain at a place that was asked for.
    """
    if request.drain is None or not hollow.surfaces:
        return Drained(solid=solid)
    space = hollow.space
    needs = Needs(diameter=request.drain, wall=request.wall, cell=hollow.cell, threads=threads)
    plan = plan_drains(
        space.part, hollow.surface, needs, vent=request.vent, places=request.drain_at, opening=space.opening
    )
    if not plan.holes:
        return Drained(solid=solid, plan=plan)
    found = _drilled(solid, plan.holes)
    if found is None:
        return Drained(solid=solid, plan=NOWHERE, failed=True)
    whole, pieces = _without_loose(found, solid)
    return Drained(solid=whole, plan=plan, pieces=pieces)


def _drilled(solid: Surface, holes: tuple[Hole, ...]) -> Surface | None:
    """Return a solid without holes, or None if manifold3d rejects it."""
    import manifold3d

    whole, best = solid_of(solid), None
    if status_of(whole) != FINE:
        return None
    for turn in TURNS:
        tools = [_tool(hole, turn) for hole in holes]
        cut = whole - manifold3d.Manifold.batch_boolean(tools, manifold3d.OpType.Add)
        if status_of(cut) != FINE or cut.is_empty():
            continue
        found = surface_from(cut)
        twins = int(in_one_place(found).sum())
        if best is None or twins < best[0]:
            best = twins, found
        if found.closed and not twins:
            break
    return None if best is None else best[1]


def _tool(hole: Hole, turn: float) -> manifold3d.Manifold:
    """Return what a hole takes away: a cylinder, or for a branch a cylinder with round ends."""
    import manifold3d

    radius = hole.diameter / 2
    if hole.kind == "branch":
        ball = manifold3d.Manifold.sphere(radius, SIDES).rotate((0.0, 0.0, float(np.degrees(turn))))
        return manifold3d.Manifold.batch_hull([ball.translate(tuple(end)) for end in (hole.at, hole.to)])
    start, end = hole.to, hole.at + hole.out * hole.way
    height = float(np.linalg.norm(end - start))
    beside = np.eye(3)[int(np.argmin(np.abs(hole.way)))]
    one = np.cross(hole.way, beside)
    one /= np.linalg.norm(one)
    axes = np.column_stack([one, np.cross(hole.way, one), hole.way, start])
    round_ = manifold3d.CrossSection.circle(radius, SIDES).rotate(float(np.degrees(turn)))
    return round_.extrude(height).transform(axes)


def _without_loose(found: Surface, solid: Surface) -> tuple[Surface, int]:
    """Return a solid without the pieces that drilling cut off, the smallest outer shells, and how many these were."""
    names, count = shell_names(found)
    volume = shell_volumes(found, names, count)
    own, shells = shell_names(solid)
    if int((volume > 0).sum()) <= (outer := int((shell_volumes(solid, own, shells) > 0).sum())):
        return found, 0
    loose = np.argsort(-volume, kind="stable")[outer : int((volume > 0).sum())]
    return with_faces(found, ~np.isin(names[found.faces[:, 0]], loose)), len(loose)


def told_of_drains(request: Request, drained: Drained, closed: list[tuple[float, list[float]]]) -> Iterator[str]:
    """Say which voids are still closed, and which drains do not do what they should.

    Parameters
    ----------
    request : Request
    drained : Drained
    closed : list of (float, list of float)
        Voids of the finished mesh that are closed: volume, mm³, and lowest point of each.
    """
    if request.drain is None:
        return
    if drained.failed:
        yield "manifold3d rejects the mesh, so no drain was made; make a solid of the part first: 'infill smooth' does"
    left = drained.plan.undrained
    if closed:
        volume, at = closed[0]
        said = f"{len(closed)} void(s) are still closed"
        if left:
            first = left[0]
            volume, at = first.volume, first.at.tolist()
        said += f", the largest, of {volume:.3g} mm³, with its lowest place at ({_words(at)})"
        if left and left[0].blocked:
            said += (
                ": below it lie other voids or faces too steep for a hole, and no wall beside it has room for a branch "
                f"of {request.drain:g} mm; {_remedy(left)}"
            )
        elif left:
            said += (
                f": straight down from it, a hole of {request.drain:g} mm leaves less than a wall of {request.wall:g} "
                f"mm; {_remedy(left)}"
            )
        yield said
    if drained.plan.unvented:
        first = drained.plan.unvented[0]
        thinner = "" if first.fits is None else f"{_thinner(drained.plan.unvented, 'have one')}; or "
        yield (
            f"{len(drained.plan.unvented)} void(s) have no vent, the largest, of {first.volume:.3g} mm³, with its "
            f"highest place at ({_words(first.at.tolist())}): there is no way for a hole of {request.drain:g} mm up "
            f"from it; {thinner}leave vent out"
        )
    if narrow := drained.plan.narrow:
        worst, place = narrow[0], drained.plan.beside
        yield (
            f"{len(narrow)} void(s) drain through branches narrower than {request.drain:g} mm, the largest, of "
            f"{drained.plan.volumes[worst.void]:.3g} mm³, through one of {worst.diameter:g} mm at "
            f"({_words(worst.at.tolist())}), where no wider one was found that keeps the wall"
            + ("" if place is None else "; it has room for a drain at ({:g}, {:g}, {:g})".format(*place))
        )
    if high := drained.plan.high:
        worst = max(high, key=lambda hole: hole.above)
        lower = drained.plan.lower
        yield (
            f"{len(high)} drain(s) begin more than {request.drain:g} mm above the lowest place of their void, at most "
            f"{worst.above:.3g} mm, at ({_words(worst.at.tolist())}): what lies below runs out only if the part is "
            "tilted" + ("" if lower is None else f"; with drains of {lower:g} mm, none does")
        )


def _remedy(left: tuple[Undrained, ...]) -> str:
    """Return what drains the largest of the voids that are still closed, if anything that was tried does."""
    if left[0].fits is not None:
        return _thinner(left, "drain")
    if left[0].place is not None:
        return "a drain at ({:g}, {:g}, {:g}) opens it".format(*left[0].place)
    return "no thinner drain, and none upwards or from a side, has room either; patterns of bars leave fewer voids"


def _thinner(left: tuple[Undrained, ...], does: str) -> str:
    """Return with which diameter the largest of some voids gets its hole, and how many of the others do."""
    first = left[0]
    who = "all of them" if first.together == len(left) else f"this and {first.together - 1} of the others"
    return f"with drains of {first.fits:g} mm, {who} {does}"


def _words(place: list[float]) -> str:
    return ", ".join(f"{each:.4g}" for each in place)


def trapped(solid: Surface) -> list[tuple[float, list[float]]]:
    """Return the voids of a solid that are closed: volume, mm³, and lowest point of each, mm, by falling volume.

    >>> import trimesh
    >>> outer, inner = trimesh.creation.box((4, 4, 4)), trimesh.creation.box((2, 2, 2))
    >>> both = trimesh.util.concatenate([outer, trimesh.Trimesh(inner.vertices, inner.faces[:, ::-1])])
    >>> trapped(Surface(vertices=both.vertices, faces=both.faces))
    [(8.0, [-1.0, -1.0, -1.0])]
    """
    names, count = shell_names(solid)
    vertices = np.asarray(solid.vertices, dtype=np.float64)
    volume = shell_volumes(solid, names, count)
    order = np.lexsort((vertices[:, 2], names))
    first = order[np.searchsorted(names[order], np.arange(count))]
    closed = sorted(np.flatnonzero(volume < 0).tolist(), key=lambda shell: volume[shell])
    return [(round(float(-volume[shell]), 9), vertices[first[shell]].tolist()) for shell in closed]
