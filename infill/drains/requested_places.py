"""Holes at requested places of the skin, and places that do instead of one at which there can be none."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from infill.arrays import Floats
from infill.drains.drain_columns import LineLattice, find_ways
from infill.drains.drain_places import UP, DrainPlaces, DrainTask, TurnedPart
from infill.drains.holes import Hole, Shaft
from infill.errors import GeometryError
from infill.meshes.distance import nearest_on_triangles
from infill.plain_numbers import plain_argument, plain_place

Place = tuple[float, float, float]  # x, y, z, mm

NUDGE = 1e-4, 0.7e-4  # of the diameter: shift of a line, as one through a corner would cross several faces
NARROWER, NARROWEST = (0.75, 0.5, 0.35, 0.25), 0.5  # of the diameter: tried in order for voids without a hole; mm


def make_hole_at(task: DrainTask, place: Place, *, remedies: bool = True) -> Hole:
    """Make the hole at a place of the skin, straight in from there, or raise GeometryError."""
    needs, request = task.needs, f"is {plain_place(place, 6)}"
    point, normal, distance = _nearest_on_skin(np.array(place), task)
    below = task.along(_rotation_down(normal))
    x, y, z = below.rotation @ point
    line = LineLattice(low=np.array([x, y]) + needs.diameter * np.array(NUDGE), step=1.0, shape=(1, 1))
    ways = find_ways(below.part, below.voids, below.names, line)
    at_place = np.flatnonzero(np.abs(ways.skin - z) < needs.radius)
    way = int(at_place[0]) if len(at_place) and below.skin.leaving[ways.face[at_place[0]]] else None
    shaft: Shaft | None = None
    if way is not None:
        for up in UP:  # it reaches less far into the void if it would not keep the wall
            high = min(float(ways.floor[way]) + up * needs.diameter, float(ways.ceiling[way]))
            shaft = below.skin.shaft(ways, way, high, needs)
            if shaft is not None and shaft.clearance >= needs.wall:
                break
    if distance <= needs.radius and way is not None and shaft is not None and shaft.clearance >= needs.wall:
        void = int(ways.void[way])
        hole = Hole.of(shaft, "place", void, diameter=needs.diameter, lowest=0.0).turn_back(below.rotation)
        lowest = float(np.asarray(task.voids.vertices, dtype=np.float64)[task.names == void, 2].min())
        return replace(hole, above=max(0.0, float(below.back(np.array([*shaft.at, shaft.floor]))[2]) - lowest))
    if distance > needs.radius:
        fault = f"{request}, {plain_argument(distance, 3)} mm from the skin of the part"
    elif way is None:
        fault = f"{request}, and no void lies straight behind it"
    elif shaft is None:
        fault = f"{request}, and a hole of {plain_argument(needs.diameter)} mm runs over the edge of the face there"
    else:
        worst = plain_place(below.back(shaft.near))
        fault = (
            f"{request}, and a hole of {plain_argument(needs.diameter)} mm there leaves "
            f"{plain_argument(shaft.clearance, 2)} mm of wall at {worst}, less than the {plain_argument(needs.wall)} "
            "mm requested"
        )
    remedy = _advise_place(task, point, below) if remedies else "leave it out"
    if remedies and shaft is not None:
        widths = narrower_diameters(needs.diameter)
        fits = next(
            (width for width in widths if _is_possible(replace(task.with_diameter(width), opening=None), place)), None
        )
        remedy = remedy if fits is None else f"{remedy}, or give drains of {plain_argument(fits)} mm"
    raise GeometryError.about("drain_at", f"{fault}; {remedy}")


def find_place(task: DrainTask, void: int) -> Place | None:
    """Find a place of the skin, upwards or at a side, from which a hole straight in drains a void, or return None."""
    for way in np.concatenate([np.eye(3)[2:], np.eye(3)[:2], -np.eye(3)[:2]]):
        below = task.along(_rotation_down(way))
        if (shaft := DrainPlaces.of(below, task.needs, void=void).shaft(void, None)) is None:
            continue
        place = _round_place(below.back(shaft.mouth))
        if _is_possible(task, place, void):
            return place
    return None


def _advise_place(task: DrainTask, point: Floats, below: TurnedPart) -> str:
    """Advise what to do in place of an impossible hole: the nearest possible place, seen from the same direction."""
    x, y, z = below.rotation @ point
    shaft = DrainPlaces.of(below, task.needs).nearest(np.array([x, y]), z)
    if shaft is not None:
        place = _round_place(below.back(shaft.mouth))
        if _is_possible(replace(task, opening=None), place):
            return f"give {plain_place(place, 6)}"
    return "leave it out: no place that was tried on that side keeps the wall"


def _is_possible(task: DrainTask, place: Place, void: int | None = None) -> bool:
    """Tell whether a hole at a place is made as requested, into a void if given, and not at an open side."""
    if task.opening is not None and not task.opening.low < place[2] < task.opening.high:
        return False
    try:
        return make_hole_at(task, place, remedies=False).void == void or void is None
    except GeometryError:
        return False


def narrower_diameters(diameter: float) -> list[float]:
    """List the diameters to try instead, mm: the shares `NARROWER` of one, rounded down to 0.1 mm.

    >>> narrower_diameters(3.0), narrower_diameters(0.6)
    ([2.2, 1.5, 1.0, 0.7], [0.5])
    """
    widths = [math.floor(10 * share * diameter + 1e-9) / 10 for share in NARROWER]
    sizes = [width for width in widths if width >= NARROWEST]
    return sizes or ([NARROWEST] if diameter > NARROWEST else [])


def _round_place(place: Floats) -> Place:
    """Round a place as messages give it, mm."""
    x, y, z = (round(coordinate, 2) + 0.0 for coordinate in place.tolist())
    return x, y, z


def _nearest_on_skin(place: Floats, task: DrainTask) -> tuple[Floats, Floats, float]:
    """Find the nearest point of the skin to a place; return it, the normal of its face, and its distance, mm."""
    skin = task.along(np.eye(3)).skin
    distance, face = skin.whole.nearest(place[None], threads=task.needs.threads)
    nearest = nearest_on_triangles(skin.corners[face], place[None])
    return nearest[0], skin.normals[face[0]], float(distance[0])


def _rotation_down(direction: Floats) -> Floats:
    """Compute the rotation that turns a direction straight down.

    >>> _rotation_down(np.array([1.0, 0, 0])).dot([1.0, 0, 0]).round(9).tolist()
    [0.0, 0.0, -1.0]
    """
    axis = np.eye(3)[int(np.argmin(np.abs(direction)))]
    across = np.cross(direction, axis)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(-direction, across), -direction])
