"""The holes of a part: a drain for every void, vents and places of one's own if asked for, and what stays closed."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_branches import Branch, find_branches
from infill.drains.drain_clearance import Shaft
from infill.drains.drain_columns import Lattice, Ways, find_ways
from infill.drains.drain_places import TURN_OVER, UP, Below, Needs, Places
from infill.errors import GeometryError
from infill.interior.opening import Opening
from infill.isosurfaces.components import shell_names
from infill.meshes.distance import Tree
from infill.meshes.shells import shell_volumes
from infill.surface import Surface

Kind = Literal["drain", "vent", "place", "branch"]
Floats = NDArray[np.float64]

DOWN = np.eye(3)
NUDGE = 1e-4, 0.7e-4  # of the diameter: a line through a corner of a face would cross several
LEVEL = 0.99  # cosine: ways this near to one another are one
BRANCHES, NARROWEST = (1.0, 0.5, 0.25), 0.5  # of the diameter, tried in turn for voids that are narrower; mm
NARROWER = 0.75, 0.5, 0.35, 0.25  # of the diameter: what is tried in turn for voids without a hole


@dataclass(frozen=True, kw_only=True, eq=False)
class Hole:
    """A round hole that drains a void.

    Parameters
    ----------
    kind : {"drain", "vent", "place", "branch"}
        Down, up, where it was asked for, or into another void.
    at : (3,) float64, mm
        Where its axis leaves the part; of a branch, where it begins in its void.
    to : (3,) float64, mm
        Where its axis ends in the void; of a branch, in the other one.
    way : (3,) float64
        The way out along the axis, of length 1.
    out : float
        How far the hole goes on beyond `at`, mm: where its rim leaves the part, and a little more. 0 of a branch.
    void : int
        Number of the void, the largest is 0.
    into : int or None
        Of a branch, the other void.
    diameter : float
        mm; that of a branch may be less than was asked for, where the void is narrower.
    clearance : float
        Least distance from all skin but the face that it leaves through, mm.
    near : (3,) float64, mm
        Where that is.
    above : float
        How much higher than the lowest place of the void (of a vent: lower than the highest) it begins, mm.
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
class Undrained:
    """A void for which there is no hole.

    Parameters
    ----------
    void : int
        Its number.
    volume : float
        mm³
    at : (3,) float64, mm
        Its lowest place; for a vent that is missing, its highest.
    blocked : bool
        Whether nothing leads straight out of it through solid alone.
    fits : float or None
        The widest diameter of those tried with which the whole plan has a hole for this void, mm.
    together : int
        How many of the voids that are listed with this one have a hole then.
    place : (x, y, z) or None
        Of the largest that no diameter fits: a place of the skin from which a hole straight in drains it, mm.
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
    undrained, unvented : tuple of Undrained
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
    undrained: tuple[Undrained, ...] = ()
    unvented: tuple[Undrained, ...] = ()
    diameter: float = 0.0
    beside: tuple[float, float, float] | None = None
    lower: float | None = None

    @property
    def narrow(self) -> tuple[Hole, ...]:
        """The branches that are narrower than requested, that of the largest void first."""
        return tuple(sorted((each for each in self.holes if each.diameter < self.diameter), key=lambda each: each.void))

    @property
    def high(self) -> tuple[Hole, ...]:
        """The drains that begin more than their diameter above the lowest place of their void."""
        return tuple(each for each in self.holes if each.kind == "drain" and each.above > each.diameter)


def plan_drains(
    part: Surface,
    voids: Surface,
    needs: Needs,
    *,
    vent: bool = False,
    places: tuple[tuple[float, float, float], ...] = (),
    opening: Opening | None = None,
) -> DrainPlan:
    """Find the holes of a part.

    Parameters
    ----------
    part : Surface, mm
    voids : Surface, mm
        Facing outwards from themselves.
    needs : Needs
    vent : bool
        Whether every void also gets a hole up from its highest place.
    places : tuple of (x, y, z), mm
        On the skin, where there are to be holes.
    opening : Opening or None
        Voids that reach out of it need no drain.

    Raises
    ------
    GeometryError
        If there cannot be a hole at one of the places.
    """
    names, volume = _by_volume(voids)
    views = _Views(part=part, voids=voids, names=names, count=len(volume))
    wish = _Wish(vent=vent, places=places, opening=opening)
    plan = _plan(views, volume, needs, wish)
    if plan.undrained or plan.unvented or plan.high:
        plan = _with_remedies(plan, views, volume, needs, wish)
    if plan.narrow:
        plan = replace(plan, beside=_place_for(plan.narrow[0].void, views, needs, wish))
    return plan


@dataclass(frozen=True, kw_only=True, eq=False)
class _Views:
    """A part and its voids as they are seen from several directions."""

    part: Surface
    voids: Surface
    names: NDArray[np.int64]
    count: int
    _seen: dict[bytes, Below] = field(default_factory=dict)

    def along(self, turned: Floats) -> Below:
        """Return the part turned, which is kept."""
        key = turned.round(12).tobytes()
        if key not in self._seen:
            self._seen[key] = Below.of(self.part, self.voids, self.names, self.count, turned)
        return self._seen[key]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Wish:
    """Which holes are requested besides a drain for each void, and the opening: see `plan_drains`."""

    vent: bool
    places: tuple[tuple[float, float, float], ...]
    opening: Opening | None


def _plan(views: _Views, volume: Floats, needs: Needs, wish: _Wish) -> DrainPlan:
    """Return the holes of one diameter, without remedies for voids that have none."""
    names, opening, count = views.names, wish.opening, views.count
    voids_open = np.zeros(count, dtype=bool)
    if opening is not None:
        own, _ = shell_names(views.voids)
        first = np.unique(own, return_index=True)[1]
        voids_open[names[first[own[first] >= 0]]] = opening.opened(views.voids)
    holes = [_hole_at(place, views, needs) for place in wish.places]
    low = needs if opening is None or not math.isfinite(opening.low) else replace(needs, closed_at=opening.low)
    done = set(np.flatnonzero(voids_open).tolist()) | {hole.void for hole in holes}
    found, undrained = _one_way(views.along(DOWN), low, "drain", done, set(range(count)) - done, volume, holes)
    holes += found
    unvented: tuple[Undrained, ...] = ()
    if wish.vent:
        high = needs if opening is None or not math.isfinite(opening.high) else replace(needs, closed_at=-opening.high)
        shut = {each.void for each in undrained}
        wanting = set(range(count)) - shut - set(np.flatnonzero(voids_open).tolist())
        # Voids that are open at a side have their vent there.
        opened = set(np.flatnonzero(voids_open).tolist())
        found, unvented = _one_way(views.along(TURN_OVER), high, "vent", opened, wanting, volume, holes)
        holes += found
    return DrainPlan(
        holes=tuple(holes),
        volumes=tuple(volume.tolist()),
        undrained=undrained,
        unvented=unvented,
        diameter=needs.diameter,
    )


def _with_remedies(plan: DrainPlan, views: _Views, volume: Floats, needs: Needs, wish: _Wish) -> DrainPlan:
    """Return a plan that says, of voids without a hole, which of some narrower diameters gives them one."""
    undrained, unvented, lower = list(plan.undrained), list(plan.unvented), None
    for width in _narrower(needs.diameter):
        if all(each.fits is not None for each in undrained + unvented) and (lower is not None or not plan.high):
            break
        try:
            other = _plan(views, volume, replace(needs, diameter=width), wish)
        except GeometryError:
            continue
        lower = width if lower is None and not other.high and not other.undrained else lower
        shut = {each.void for each in other.undrained}
        dark = shut | {each.void for each in other.unvented}
        undrained, unvented = _fitted(undrained, width, shut), _fitted(unvented, width, dark)
    if undrained and undrained[0].fits is None:
        undrained[0] = replace(undrained[0], place=_place_for(undrained[0].void, views, needs, wish))
    return replace(plan, undrained=tuple(undrained), unvented=tuple(unvented), lower=lower)


def _fitted(voids: list[Undrained], width: float, without: set[int]) -> list[Undrained]:
    """Return voids, of which those that have a hole of a width and had none of a wider one say so."""
    together = sum(each.void not in without for each in voids)
    return [
        replace(each, fits=width, together=together) if each.fits is None and each.void not in without else each
        for each in voids
    ]


def _narrower(diameter: float) -> list[float]:
    """Return the diameters to try in place of one, mm, in steps that a drill has.

    >>> _narrower(3.0), _narrower(0.6)
    ([2.2, 1.5, 1.0, 0.7], [0.5])
    """
    widths = [math.floor(10 * share * diameter + 1e-9) / 10 for share in NARROWER]
    kept = [width for width in widths if width >= NARROWEST]
    return kept or ([NARROWEST] if diameter > NARROWEST else [])


def _place_for(void: int, views: _Views, needs: Needs, wish: _Wish) -> tuple[float, float, float] | None:
    """Return a place of the skin, upwards or at a side, from which a hole straight in drains a void, or None."""
    for way in np.concatenate([DOWN[2:], DOWN[:2], -DOWN[:2]]):
        below = views.along(_turning_down(way))
        if (shaft := Places.of(below, needs, void=void).shaft(void, None)) is None:
            continue
        place = _rounded(below.back(np.array([*shaft.at, shaft.skin])))
        if _stands(place, void, views, needs, wish.opening):
            return place
    return None


def _stands(
    place: tuple[float, float, float], void: int | None, views: _Views, needs: Needs, opening: Opening | None
) -> bool:
    """Return whether a hole at a place is made as requested, into a void if one is given, not at an open side."""
    if opening is not None and not opening.low < place[2] < opening.high:
        return False
    try:
        return _hole_at(place, views, needs, remedies=False).void == void or void is None
    except GeometryError:
        return False


def _rounded(place: Floats) -> tuple[float, float, float]:
    """Return a place as messages give it, mm."""
    x, y, z = (round(each, 2) + 0.0 for each in place.tolist())
    return x, y, z


def _by_volume(voids: Surface) -> tuple[NDArray[np.int64], Floats]:
    """Return the void of every vertex, the largest is 0, and their volumes, mm³."""
    names, count = shell_names(voids)
    volume = shell_volumes(voids, names, count)
    order = np.argsort(-volume, kind="stable")
    rank = np.empty(count, dtype=np.int64)
    rank[order] = np.arange(count)
    return np.where(names >= 0, rank[names], -1), volume[order]


def _one_way(
    below: Below, needs: Needs, kind: Kind, done: set[int], wanting: set[int], volume: Floats, holes: list[Hole]
) -> tuple[list[Hole], tuple[Undrained, ...]]:
    """Return holes one way out of voids, branches to those included, and the voids that have none."""
    places = Places.of(below, needs)
    taken = [(below.turned @ hole.at)[:2] for hole in holes if -(below.turned @ hole.way)[2] > LEVEL]
    found: list[Hole] = []
    done, left = set(done), sorted(wanting)

    def drill(each: int, apart: bool) -> bool:
        shaft = places.shaft(each, np.array(taken).reshape(-1, 2) if apart else None)
        if shaft is not None:
            taken.append(shaft.at)
            found.append(_hole(shaft, below, kind, each, needs.diameter, float(places.lowest[each])))
            done.add(each)
        return shaft is not None

    left = [each for each in left if not drill(each, apart=True)]
    branches = find_branches(below, needs, done, left)
    joined = {branch.void for branch in branches}
    # Holes that are near one another leave a thin web between them, and nothing that is seen from the side.
    alone = [each for each in left if each not in joined]
    still = [each for each in alone if not drill(each, apart=False)]
    for share in BRANCHES[len(still) == len(alone) :]:
        width = share * needs.diameter
        if share == 1 or width >= NARROWEST:
            branches += find_branches(below, replace(needs, diameter=width), done | joined, set(still) - joined)
            joined = {branch.void for branch in branches}
    found += [_branch(each, below) for each in branches]
    missing = [each for each in still if each not in joined]
    return found, tuple(_undrained(each, below, places, float(volume[each])) for each in missing)


def _hole(shaft: Shaft, below: Below, kind: Kind, void: int, diameter: float, lowest: float) -> Hole:
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


def _branch(branch: Branch, below: Below) -> Hole:
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


def _undrained(void: int, below: Below, places: Places, volume: float) -> Undrained:
    """Return a void that has no hole."""
    vertices = np.asarray(below.voids.vertices, dtype=np.float64)
    own = np.flatnonzero(below.names == void)
    lowest = vertices[own[np.argmin(vertices[own, 2])]]
    return Undrained(void=void, volume=volume, at=below.back(lowest), blocked=not len(places.order[void]))


def _hole_at(place: tuple[float, float, float], views: _Views, needs: Needs, *, remedies: bool = True) -> Hole:
    """Return the hole at a place of the skin, straight in from there, or raise GeometryError."""
    asked = "drain_at is ({:g}, {:g}, {:g})".format(*place)
    point, face, away = _on_skin(np.array(place), views.part)
    below = views.along(_turning_down(_normal(views.part, face)))
    x, y, z = below.turned @ point
    line = Lattice(low=np.array([x, y]) + needs.diameter * np.array(NUDGE), step=1.0, shape=(1, 1))
    ways = find_ways(below.part, below.voids, below.names, line)
    mine = np.flatnonzero(np.abs(ways.skin - z) < needs.radius)
    way = int(mine[0]) if len(mine) and below.skin.leaving[ways.face[mine[0]]] else None
    shaft = None if way is None else _shaft_at(below, ways, way, needs)
    if away <= needs.radius and way is not None and shaft is not None and shaft.clearance >= needs.wall:
        void = int(ways.void[way])
        upright = np.asarray(views.voids.vertices, dtype=np.float64)[:, 2]
        lowest = float(upright[views.names == void].min())
        hole = _hole(shaft, below, "place", void, needs.diameter, 0.0)
        return replace(hole, above=max(0.0, float(below.back(np.array([*shaft.at, shaft.floor]))[2]) - lowest))
    if away > needs.radius:
        said = f"{asked}, {away:.3g} mm from the skin of the part"
    elif way is None:
        said = f"{asked}, and no void lies straight behind it"
    elif shaft is None:
        said = f"{asked}, and a hole of {needs.diameter:g} mm runs over the edge of the face there"
    else:
        near = ", ".join(f"{each:.4g}" for each in below.back(shaft.near))
        said = (
            f"{asked}, and a hole of {needs.diameter:g} mm there leaves {shaft.clearance:.2g} mm of wall at ({near}), "
            f"less than the {needs.wall:g} mm requested"
        )
    remedy = _instead(point, below, views, needs) if remedies else "leave it out"
    if remedies and shaft is not None:
        widths = (replace(needs, diameter=width) for width in _narrower(needs.diameter))
        fits = next((each.diameter for each in widths if _stands(place, None, views, each, None)), None)
        remedy = remedy if fits is None else f"{remedy}, or give drains of {fits:g} mm"
    raise GeometryError(f"{said}; {remedy}")


def _shaft_at(below: Below, ways: Ways, way: int, needs: Needs) -> Shaft | None:
    """Return the hole along a way, which reaches less far into the void where it would not keep the wall."""
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


def _instead(point: Floats, below: Below, views: _Views, needs: Needs) -> str:
    """Return what to do in place of a hole that cannot be: the nearest place where one can, seen the same way."""
    x, y, z = below.turned @ point
    shaft = Places.of(below, needs).nearest(np.array([x, y]), z)
    if shaft is not None:
        place = _rounded(below.back(np.array([*shaft.at, shaft.skin])))
        if _stands(place, None, views, needs, None):
            return "give ({:g}, {:g}, {:g})".format(*place)
    return "leave it out: no place that was tried on that side keeps the wall"


def _on_skin(place: Floats, part: Surface) -> tuple[Floats, int, float]:
    """Return the point of the skin that is nearest to a place, its face, and how far it is, mm."""
    from trimesh.triangles import closest_point

    away, face = Tree.of(part).nearest(place[None])
    corners = np.asarray(part.vertices, dtype=np.float64)[part.faces[face]]
    nearest = closest_point(corners, place[None])  # type: ignore[no-untyped-call]
    return np.asarray(nearest, dtype=np.float64)[0], int(face[0]), float(away[0])


def _normal(part: Surface, face: int) -> Floats:
    a, b, c = np.asarray(part.vertices, dtype=np.float64)[part.faces[face]]
    normal: Floats = np.cross(b - a, c - a)
    return normal / max(float(np.linalg.norm(normal)), 1e-300)


def _turning_down(way: Floats) -> Floats:
    """Return the rotation that takes a direction to straight down.

    >>> _turning_down(np.array([1.0, 0, 0])).dot([1.0, 0, 0]).round(9).tolist()
    [0.0, 0.0, -1.0]
    """
    beside = np.eye(3)[int(np.argmin(np.abs(way)))]
    one = np.cross(way, beside)
    one /= np.linalg.norm(one)
    return np.stack([one, np.cross(-way, one), -way])
