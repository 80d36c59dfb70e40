"""The holes of a part: a drain for every void, vents and places on request, and the voids that stay closed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_branches import Branch, find_branches
from infill.drains.drain_clearance import Shaft
from infill.drains.drain_columns import DrainWays, LineLattice, find_ways
from infill.drains.drain_places import TURN_OVER, UP, DrainNeeds, DrainPlaces, TurnedPart
from infill.errors import GeometryError
from infill.interior.opening import Opening
from infill.isosurfaces.components import shell_names
from infill.meshes.distance import TriangleTree
from infill.meshes.shells import shell_volumes
from infill.surface import Surface

Kind = Literal["drain", "vent", "place", "branch"]
Floats = NDArray[np.float64]

DOWN = np.eye(3)
NUDGE = 1e-4, 0.7e-4  # of the diameter: shift of a line, as one through a corner would cross several faces
LEVEL = 0.99  # cosine: directions at a smaller angle count as equal
BRANCHES, NARROWEST = (1.0, 0.5, 0.25), 0.5  # of the diameter, tried in order for narrower voids; mm
NARROWER = 0.75, 0.5, 0.35, 0.25  # of the diameter: tried in order for voids without a hole


@dataclass(frozen=True, kw_only=True, eq=False)
class Hole:
    """A round hole that drains a void.

    Parameters
    ----------
    kind : {"drain", "vent", "place", "branch"}
        Down, up, at a requested place, or into another void.
    at : (3,) float64, mm
        The place where its axis leaves the part; of a branch, where it begins in its void.
    to : (3,) float64, mm
        The place where its axis ends in the void; of a branch, in the other void.
    way : (3,) float64
        The way out along the axis, of length 1.
    out : float
        Length of the hole beyond `at`, mm: to where its rim leaves the part, and a little more. 0 of a branch.
    void : int
        Number of the void, the largest is 0.
    into : int or None
        Of a branch, the other void.
    diameter : float
        mm; that of a branch may be less than requested, where the void is narrower.
    clearance : float
        Least distance from all skin except the face that it leaves through, mm.
    near : (3,) float64, mm
        The place of that distance.
    above : float
        Height of its start above the lowest place of the void, mm; of a vent, below the highest place.
    """

    kind: Kind
    at: Floats
    to: Floats
    way: Floats
    out: float
    void: int
    into: int | None
    diameter: float
    clearance: float
    near: Floats
    above: float


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
    names, volume = _number_by_volume(voids)
    views = _Views(part=part, voids=voids, names=names, count=len(volume))
    wish = _Wish(vent=vent, places=places, opening=opening)
    plan = _plan_holes(views, volume, needs, wish)
    if plan.undrained or plan.unvented or plan.high:
        plan = _add_remedies(plan, views, volume, needs, wish)
    if plan.narrow:
        plan = replace(plan, beside=_find_place(plan.narrow[0].void, views, needs, wish))
    return plan


@dataclass(frozen=True, kw_only=True, eq=False)
class _Views:
    """A part and its voids, seen from several directions."""

    part: Surface
    voids: Surface
    names: NDArray[np.int64]
    count: int
    _seen: dict[bytes, TurnedPart] = field(default_factory=dict)

    def along(self, turned: Floats) -> TurnedPart:
        """Return the part turned, from a cache."""
        key = turned.round(12).tobytes()
        if key not in self._seen:
            self._seen[key] = TurnedPart.of(self.part, self.voids, self.names, self.count, turned)
        return self._seen[key]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Wish:
    """Requested holes besides a drain for each void, and the opening: see `plan_drains`."""

    vent: bool
    places: tuple[tuple[float, float, float], ...]
    opening: Opening | None


def _plan_holes(views: _Views, volume: Floats, needs: DrainNeeds, wish: _Wish) -> DrainPlan:
    """Plan the wished holes, and drains and vents of one diameter; leave voids that have no place without one."""
    names, opening, count = views.names, wish.opening, views.count
    is_open = np.zeros(count, dtype=bool)
    if opening is not None:
        shells, _ = shell_names(views.voids)
        starts = np.unique(shells, return_index=True)[1]
        is_open[names[starts[shells[starts] >= 0]]] = opening.opened(views.voids)
    holes = [_make_hole_at(place, views, needs) for place in wish.places]
    low = needs if opening is None or not math.isfinite(opening.low) else replace(needs, closed_at=opening.low)
    drained = set(np.flatnonzero(is_open).tolist()) | {hole.void for hole in holes}
    drains, undrained = _drain_one_way(
        views.along(DOWN), low, "drain", drained, set(range(count)) - drained, volume, holes
    )
    holes += drains
    unvented: tuple[SealedVoid, ...] = ()
    if wish.vent:
        high = needs if opening is None or not math.isfinite(opening.high) else replace(needs, closed_at=-opening.high)
        shut = {closed.void for closed in undrained}
        wanting = set(range(count)) - shut - set(np.flatnonzero(is_open).tolist())
        # Voids that are open at a side have their vent there.
        opened = set(np.flatnonzero(is_open).tolist())
        vents, unvented = _drain_one_way(views.along(TURN_OVER), high, "vent", opened, wanting, volume, holes)
        holes += vents
    return DrainPlan(
        holes=tuple(holes),
        volumes=tuple(volume.tolist()),
        undrained=undrained,
        unvented=unvented,
        diameter=needs.diameter,
    )


def _add_remedies(plan: DrainPlan, views: _Views, volume: Floats, needs: DrainNeeds, wish: _Wish) -> DrainPlan:
    """Complete a plan with the narrower diameters that give a hole to voids without one."""
    undrained, unvented, lower = list(plan.undrained), list(plan.unvented), None
    for width in _narrower_diameters(needs.diameter):
        if all(void.fits is not None for void in undrained + unvented) and (lower is not None or not plan.high):
            break
        try:
            narrower_plan = _plan_holes(views, volume, replace(needs, diameter=width), wish)
        except GeometryError:
            continue
        lower = width if lower is None and not narrower_plan.high and not narrower_plan.undrained else lower
        shut = {closed.void for closed in narrower_plan.undrained}
        unreached = shut | {closed.void for closed in narrower_plan.unvented}
        undrained, unvented = _record_fits(undrained, width, shut), _record_fits(unvented, width, unreached)
    if undrained and undrained[0].fits is None:
        undrained[0] = replace(undrained[0], place=_find_place(undrained[0].void, views, needs, wish))
    return replace(plan, undrained=tuple(undrained), unvented=tuple(unvented), lower=lower)


def _record_fits(voids: list[SealedVoid], width: float, without: set[int]) -> list[SealedVoid]:
    """Record a width in voids that have a hole of that width, and had none of a wider one."""
    together = sum(void.void not in without for void in voids)
    return [
        replace(void, fits=width, together=together) if void.fits is None and void.void not in without else void
        for void in voids
    ]


def _narrower_diameters(diameter: float) -> list[float]:
    """List the diameters to try instead, mm: the shares `NARROWER` of one, rounded down to 0.1 mm.

    >>> _narrower_diameters(3.0), _narrower_diameters(0.6)
    ([2.2, 1.5, 1.0, 0.7], [0.5])
    """
    widths = [math.floor(10 * share * diameter + 1e-9) / 10 for share in NARROWER]
    sizes = [width for width in widths if width >= NARROWEST]
    return sizes or ([NARROWEST] if diameter > NARROWEST else [])


def _find_place(void: int, views: _Views, needs: DrainNeeds, wish: _Wish) -> tuple[float, float, float] | None:
    """Find a place of the skin, upwards or at a side, from which a hole straight in drains a void, or return None."""
    for way in np.concatenate([DOWN[2:], DOWN[:2], -DOWN[:2]]):
        below = views.along(_rotation_down(way))
        if (shaft := DrainPlaces.of(below, needs, void=void).shaft(void, None)) is None:
            continue
        place = _round_place(below.back(np.array([*shaft.at, shaft.skin])))
        if _is_possible(place, void, views, needs, wish.opening):
            return place
    return None


def _is_possible(
    place: tuple[float, float, float], void: int | None, views: _Views, needs: DrainNeeds, opening: Opening | None
) -> bool:
    """Tell whether a hole at a place is made as requested, into a void if given, and not at an open side."""
    if opening is not None and not opening.low < place[2] < opening.high:
        return False
    try:
        return _make_hole_at(place, views, needs, remedies=False).void == void or void is None
    except GeometryError:
        return False


def _round_place(place: Floats) -> tuple[float, float, float]:
    """Round a place as messages give it, mm."""
    x, y, z = (round(coordinate, 2) + 0.0 for coordinate in place.tolist())
    return x, y, z


def _number_by_volume(voids: Surface) -> tuple[NDArray[np.int64], Floats]:
    """Rank voids by falling volume; return the rank of every vertex's void, and their volumes, mm³."""
    names, count = shell_names(voids)
    volume = shell_volumes(voids, names, count)
    order = np.argsort(-volume, kind="stable")
    rank = np.empty(count, dtype=np.int64)
    rank[order] = np.arange(count)
    return np.where(names >= 0, rank[names], -1), volume[order]


def _drain_one_way(
    below: TurnedPart,
    needs: DrainNeeds,
    kind: Kind,
    drained: set[int],
    wanting: set[int],
    volume: Floats,
    holes: list[Hole],
) -> tuple[list[Hole], tuple[SealedVoid, ...]]:
    """Drain voids one way; return the holes, including branches to drained voids, and the voids that have none."""
    places = DrainPlaces.of(below, needs)
    taken = [(below.turned @ hole.at)[:2] for hole in holes if -(below.turned @ hole.way)[2] > LEVEL]
    new_holes: list[Hole] = []
    drained, remaining = set(drained), sorted(wanting)

    def drill(void: int, apart: bool) -> bool:
        shaft = places.shaft(void, np.array(taken).reshape(-1, 2) if apart else None)
        if shaft is not None:
            taken.append(shaft.at)
            new_holes.append(_make_hole(shaft, below, kind, void, needs.diameter, float(places.lowest[void])))
            drained.add(void)
        return shaft is not None

    remaining = [void for void in remaining if not drill(void, apart=True)]
    branches = find_branches(below, needs, drained, remaining)
    joined = {branch.void for branch in branches}
    # Holes that are near each other leave a thin web between them, which does not show from the side.
    alone = [void for void in remaining if void not in joined]
    without_hole = [void for void in alone if not drill(void, apart=False)]
    for share in BRANCHES[len(without_hole) == len(alone) :]:
        width = share * needs.diameter
        if share == 1 or width >= NARROWEST:
            branches += find_branches(
                below, replace(needs, diameter=width), drained | joined, set(without_hole) - joined
            )
            joined = {branch.void for branch in branches}
    new_holes += [_make_branch(branch, below) for branch in branches]
    missing = [void for void in without_hole if void not in joined]
    return new_holes, tuple(_describe_undrained(void, below, places, float(volume[void])) for void in missing)


def _make_hole(shaft: Shaft, below: TurnedPart, kind: Kind, void: int, diameter: float, lowest: float) -> Hole:
    at = np.array([*shaft.at, shaft.skin])
    to = np.array([*shaft.at, shaft.high])
    return Hole(
        kind=kind,
        at=below.back(at),
        to=below.back(to),
        way=below.back(np.array([0.0, 0.0, -1.0])),
        out=shaft.skin - shaft.low,
        void=void,
        into=None,
        diameter=diameter,
        clearance=shaft.clearance,
        near=below.back(shaft.near),
        above=max(0.0, shaft.floor - lowest),
    )


def _make_branch(branch: Branch, below: TurnedPart) -> Hole:
    start, end = below.back(branch.start), below.back(branch.end)
    length = float(np.linalg.norm(end - start))
    return Hole(
        kind="branch",
        at=start,
        to=end,
        way=(start - end) / length if length > 0 else np.zeros(3),
        out=0.0,
        void=branch.void,
        into=branch.into,
        diameter=branch.diameter,
        clearance=branch.clearance,
        near=below.back(branch.near),
        above=branch.above,
    )


def _describe_undrained(void: int, below: TurnedPart, places: DrainPlaces, volume: float) -> SealedVoid:
    """Describe a void without a hole."""
    vertices = np.asarray(below.voids.vertices, dtype=np.float64)
    corners = np.flatnonzero(below.names == void)
    lowest = vertices[corners[np.argmin(vertices[corners, 2])]]
    return SealedVoid(void=void, volume=volume, at=below.back(lowest), blocked=not len(places.order[void]))


def _make_hole_at(
    place: tuple[float, float, float], views: _Views, needs: DrainNeeds, *, remedies: bool = True
) -> Hole:
    """Make the hole at a place of the skin, straight in from there, or raise GeometryError."""
    request = "is ({:g}, {:g}, {:g})".format(*place)
    point, face, distance = _nearest_on_skin(np.array(place), views.part)
    below = views.along(_rotation_down(_normal(views.part, face)))
    x, y, z = below.turned @ point
    line = LineLattice(low=np.array([x, y]) + needs.diameter * np.array(NUDGE), step=1.0, shape=(1, 1))
    ways = find_ways(below.part, below.voids, below.names, line)
    at_place = np.flatnonzero(np.abs(ways.skin - z) < needs.radius)
    way = int(at_place[0]) if len(at_place) and below.skin.leaving[ways.face[at_place[0]]] else None
    shaft = None if way is None else _measure_shaft(below, ways, way, needs)
    if distance <= needs.radius and way is not None and shaft is not None and shaft.clearance >= needs.wall:
        void = int(ways.void[way])
        upright = np.asarray(views.voids.vertices, dtype=np.float64)[:, 2]
        lowest = float(upright[views.names == void].min())
        hole = _make_hole(shaft, below, "place", void, needs.diameter, 0.0)
        return replace(hole, above=max(0.0, float(below.back(np.array([*shaft.at, shaft.floor]))[2]) - lowest))
    if distance > needs.radius:
        fault = f"{request}, {distance:.3g} mm from the skin of the part"
    elif way is None:
        fault = f"{request}, and no void lies straight behind it"
    elif shaft is None:
        fault = f"{request}, and a hole of {needs.diameter:g} mm runs over the edge of the face there"
    else:
        worst = ", ".join(f"{coordinate:.4g}" for coordinate in below.back(shaft.near))
        fault = (
            f"{request}, and a hole of {needs.diameter:g} mm there leaves {shaft.clearance:.2g} mm of wall at "
            f"({worst}), less than the {needs.wall:g} mm requested"
        )
    remedy = _advise_place(point, below, views, needs) if remedies else "leave it out"
    if remedies and shaft is not None:
        widths = (replace(needs, diameter=width) for width in _narrower_diameters(needs.diameter))
        fits = next(
            (narrower.diameter for narrower in widths if _is_possible(place, None, views, narrower, None)), None
        )
        remedy = remedy if fits is None else f"{remedy}, or give drains of {fits:g} mm"
    raise GeometryError.about("drain_at", f"{fault}; {remedy}")


def _measure_shaft(below: TurnedPart, ways: DrainWays, way: int, needs: DrainNeeds) -> Shaft | None:
    """Measure the hole along a way; it reaches less far into the void if it would not keep the wall."""
    shaft = None
    for up in UP:
        floor, ceiling = float(ways.floor[way]), float(ways.ceiling[way])
        shaft = below.skin.shaft(
            ways.at[way],
            int(ways.face[way]),
            float(ways.skin[way]),
            floor,
            min(floor + up * needs.diameter, ceiling),
            radius=needs.radius,
            wall=needs.wall,
            threads=needs.threads,
        )
        if shaft is not None and shaft.clearance >= needs.wall:
            break
    return shaft


def _advise_place(point: Floats, below: TurnedPart, views: _Views, needs: DrainNeeds) -> str:
    """Advise what to do in place of an impossible hole: the nearest possible place, seen from the same direction."""
    x, y, z = below.turned @ point
    shaft = DrainPlaces.of(below, needs).nearest(np.array([x, y]), z)
    if shaft is not None:
        place = _round_place(below.back(np.array([*shaft.at, shaft.skin])))
        if _is_possible(place, None, views, needs, None):
            return "give ({:g}, {:g}, {:g})".format(*place)
    return "leave it out: no place that was tried on that side keeps the wall"


def _nearest_on_skin(place: Floats, part: Surface) -> tuple[Floats, int, float]:
    """Find the nearest point of the skin to a place; return it, its face, and its distance, mm."""
    from trimesh.triangles import closest_point

    distance, face = TriangleTree.of(part).nearest(place[None])
    corners = np.asarray(part.vertices, dtype=np.float64)[part.faces[face]]
    nearest = closest_point(corners, place[None])  # type: ignore[no-untyped-call]
    return np.asarray(nearest, dtype=np.float64)[0], int(face[0]), float(distance[0])


def _normal(part: Surface, face: int) -> Floats:
    a, b, c = np.asarray(part.vertices, dtype=np.float64)[part.faces[face]]
    normal: Floats = np.cross(b - a, c - a)
    return normal / max(float(np.linalg.norm(normal)), 1e-300)


def _rotation_down(direction: Floats) -> Floats:
    """Compute the rotation that turns a direction straight down.

    >>> _rotation_down(np.array([1.0, 0, 0])).dot([1.0, 0, 0]).round(9).tolist()
    [0.0, 0.0, -1.0]
    """
    axis = np.eye(3)[int(np.argmin(np.abs(direction)))]
    across = np.cross(direction, axis)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(-direction, across), -direction])
