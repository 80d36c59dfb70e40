"""The holes of a part: a drain for every void, vents and places of one's own if asked for, and what stays closed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.filling.solids.drain_branches import Branch, find_branches
from infill.filling.solids.drain_clearance import Shaft
from infill.filling.solids.drain_columns import Lattice, find_ways
from infill.filling.solids.drain_places import TURN_OVER, UP, Below, Needs, Places
from infill.filling.solids.opening import Opening
from infill.surface import Surface
from infill.surfaces.components import shell_names
from infill.surfaces.distance import Tree
from infill.surfaces.shells import shell_volumes

Kind = Literal["drain", "vent", "place", "branch"]
Floats = NDArray[np.float64]

DOWN = np.eye(3)
NUDGE = 1e-4, 0.7e-4  # of the diameter: a line through a corner of a face would cross several
LEVEL = 0.99  # cosine: ways this near to one another are one
BRANCHES, NARROWEST = (1.0, 0.5, 0.25), 0.5  # of the diameter, tried in turn for voids that are narrower; mm
NARROWER, TRIES = 0.9, 6  # of the width of a drain that might fit, and how often one is tried


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
        The diameter of a hole that would keep the wall there, mm, if one was found.
    """

    void: int
    volume: float
    at: Floats
    blocked: bool
    fits: float | None


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
    """

    holes: tuple[Hole, ...]
    volumes: tuple[float, ...] = ()
    undrained: tuple[Undrained, ...] = ()
    unvented: tuple[Undrained, ...] = ()


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
    count = len(volume)
    voids_open = np.zeros(count, dtype=bool)
    if opening is not None:
        own, _ = shell_names(voids)
        first = np.unique(own, return_index=True)[1]
        voids_open[names[first[own[first] >= 0]]] = opening.opened(voids)
    holes = [_hole_at(place, part, voids, names, count, needs) for place in places]
    down = Below.of(part, voids, names, count, DOWN)
    low = needs if opening is None or not math.isfinite(opening.low) else replace(needs, closed_at=opening.low)
    done = set(np.flatnonzero(voids_open).tolist()) | {hole.void for hole in holes}
    found, undrained = _one_way(down, low, "drain", done, set(range(count)) - done, volume, holes)
    holes += found
    unvented: tuple[Undrained, ...] = ()
    if vent:
        up = Below.of(part, voids, names, count, TURN_OVER)
        high = needs if opening is None or not math.isfinite(opening.high) else replace(needs, closed_at=-opening.high)
        shut = {each.void for each in undrained}
        wanting = set(range(count)) - shut - set(np.flatnonzero(voids_open).tolist())
        # Voids that are open at a side have their vent there.
        found, unvented = _one_way(up, high, "vent", set(np.flatnonzero(voids_open).tolist()), wanting, volume, holes)
        holes += found
    return DrainPlan(holes=tuple(holes), volumes=tuple(volume.tolist()), undrained=undrained, unvented=unvented)


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
    return found, tuple(
        _undrained(each, below, places, float(volume[each]), tried=not number) for number, each in enumerate(missing)
    )


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


def _undrained(void: int, below: Below, places: Places, volume: float, *, tried: bool) -> Undrained:
    """Return a void that has no hole, and if it is to be tried, the diameter of one that it could have."""
    vertices = np.asarray(below.voids.vertices, dtype=np.float64)
    own = np.flatnonzero(below.names == void)
    lowest = vertices[own[np.argmin(vertices[own, 2])]]
    return Undrained(
        void=void,
        volume=volume,
        at=below.back(lowest),
        blocked=not len(places.order[void]),
        fits=_fitting(void, below, places) if tried else None,
    )


def _fitting(void: int, below: Below, places: Places) -> float | None:
    """Return the diameter of a hole that a void could have, mm, or None if none was found."""
    widest = places.widest(void)
    if widest is None:
        return None
    width = min(widest, places.needs.diameter) * NARROWER
    for _ in range(TRIES):
        if width < 0.1:
            return None
        rounded = float(f"{math.floor(width * 10) / 10:.1f}")
        narrow = Places.of(below, replace(places.needs, diameter=rounded))
        if narrow.shaft(void, None) is not None:
            return rounded
        width *= NARROWER**2
    return None


def _hole_at(
    place: tuple[float, float, float],
    part: Surface,
    voids: Surface,
    names: NDArray[np.int64],
    count: int,
    needs: Needs,
) -> Hole:
    """Return the hole at a place of the skin, straight in from there, or raise GeometryError."""
    asked = "drain_at is ({:g}, {:g}, {:g})".format(*place)
    point, face, away = _on_skin(np.array(place), part)
    if away > needs.radius:
        there = ", ".join(f"{each:.4g}" for each in point)
        raise GeometryError(f"{asked}, {away:.3g} mm from the skin of the part; give a place on it, such as {there}")
    way = _normal(part, face)
    below = Below.of(part, voids, names, count, _turning_down(way))
    x, y, z = below.turned @ point
    line = Lattice(low=np.array([x, y]) + needs.diameter * np.array(NUDGE), step=1.0, shape=(1, 1))
    ways = find_ways(below.part, below.voids, names, line)
    mine = np.flatnonzero(np.abs(ways.skin - z) < needs.radius)
    if not len(mine) or not below.skin.leaving[ways.face[mine[0]]]:
        raise GeometryError(
            f"{asked}, and no void lies straight behind it; give a place of the outer skin with a void behind it"
        )
    way_in = int(mine[0])
    shaft = None
    for up in UP:
        shaft = below.skin.shaft(
            ways.at[way_in],
            int(ways.face[way_in]),
            float(ways.skin[way_in]),
            float(ways.floor[way_in]),
            min(float(ways.floor[way_in]) + up * needs.diameter, float(ways.ceiling[way_in])),
            radius=needs.radius,
            wall=needs.wall,
            threads=needs.threads,
        )
        if shaft is not None and shaft.clearance >= needs.wall:
            break
    if shaft is None:
        raise GeometryError(
            f"{asked}, and a hole of {needs.diameter:g} mm runs over the edge of the face there; move it further onto "
            "the face, or give a thinner drain"
        )
    if shaft.clearance < needs.wall:
        near = ", ".join(f"{each:.4g}" for each in below.back(shaft.near))
        raise GeometryError(
            f"{asked}, and a hole of {needs.diameter:g} mm there leaves {shaft.clearance:.2g} mm of wall at ({near}), "
            f"less than the {needs.wall:g} mm asked for; move it away from there, or give a thinner drain"
        )
    void = int(ways.void[way_in])
    lowest = float(np.asarray(voids.vertices, dtype=np.float64)[names == void, 2].min())
    hole = _hole(shaft, below, "place", void, needs.diameter, 0.0)
    return replace(hole, above=max(0.0, float(below.back(np.array([*shaft.at, shaft.floor]))[2]) - lowest))


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
