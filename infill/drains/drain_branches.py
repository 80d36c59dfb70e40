"""Branches: holes from voids that no hole straight down can drain, into voids beside them that are drained."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Integers
from infill.drains.drain_columns import find_crossings
from infill.drains.drain_places import TurnedPart
from infill.drains.holes import DrainNeeds, Hole
from infill.meshes.distance import TriangleTree, nearest_on_triangles
from infill.surface import Surface

MOST_POINTS, LINES, LATTICE = 400, 1600, 40_000  # of a void; lines through a void, and through all
LEVELS = 12  # heights of a line in a void
OVERLAP = 0.15, 0.3  # mm, and share of the radius; the lesser is the reach of a branch into a void
PUSHES = 6  # steps by which points are moved inwards
ASIDE = 0.01  # mm: step of the difference that gives the direction inwards
NEAREST = 12  # places that are tried for each point
LONGER = 1.5  # times the shortest: longer branches wait, as a void in between may be drained by then
RISE = 0.5  # mm of length that a branch is worth for each mm that it begins above the lowest place
ALONG = 0.2  # mm: largest distance between the points at which a branch is measured


@dataclass(frozen=True, kw_only=True, eq=False)
class BranchEnds:
    """Places for the ends of branches, so deep below all skin that the hole around them keeps the wall.

    Parameters
    ----------
    at : (N, 3) float64, mm
    void : (N,) int64
        The void that a ball around each cuts.
    cost : (N,) float64
        mm by which it was moved, plus a part of its height above the lowest place of its void.
    above : (N,) float64
        Height of the lowest place of the ball above that of its void, mm; 0 if it is lower.
    """

    at: Floats
    void: Integers
    cost: Floats
    above: Floats


def find_branches(below: TurnedPart, needs: DrainNeeds, drained: Iterable[int], wanting: Iterable[int]) -> list[Hole]:
    """Find branches, in the turned part, that join voids to drained ones, or to other voids on the way there.

    Parameters
    ----------
    below : TurnedPart
    needs : DrainNeeds
    drained, wanting : iterable of int
        Voids.
    """
    from scipy.spatial import cKDTree

    open_, shut = set(drained), set(wanting)
    if not open_ or not shut:
        return []
    tree = below.skin.whole
    reach = _find_ends(below, needs, open_, shut)
    branches: list[Hole] = []
    while shut:
        goals = np.flatnonzero(np.isin(reach.void, list(open_)))
        starts = np.flatnonzero(np.isin(reach.void, list(shut)))
        if not len(goals) or not len(starts):
            break
        count = min(NEAREST, len(goals))
        nearest = cKDTree(reach.at[goals]).query(reach.at[starts], k=count)
        distance, number = (np.asarray(part).reshape(len(starts), count) for part in nearest)
        cost = distance + reach.cost[starts][:, None] + reach.cost[goals][number]
        best = _find_cheapest(needs, tree, reach, starts, goals[number], cost)
        if not best:
            break
        shortest = min(price for price, _ in best)
        for price, branch in best:
            if price <= LONGER * shortest + needs.diameter:
                branches.append(branch)
                open_.add(branch.void)
                shut.discard(branch.void)
    return branches


def _find_cheapest(
    needs: DrainNeeds, tree: TriangleTree, reach: BranchEnds, starts: Integers, goals: Integers, cost: Floats
) -> list[tuple[float, Hole]]:
    """Find the cheapest branch of every void that keeps the wall; return each with its cost."""
    branches = []
    order = np.argsort(cost, axis=None, kind="stable")
    row, column = np.unravel_index(order, cost.shape)
    void = reach.void[starts[row]]
    for name in np.unique(void).tolist():
        candidates = np.flatnonzero(void == name)[: 3 * NEAREST]
        for index in candidates.tolist():
            start, end = int(starts[row[index]]), int(goals[row[index], column[index]])
            clearance, place = _measure_clearance(tree, reach.at[start], reach.at[end], needs)
            if clearance >= needs.wall:
                axis = reach.at[start] - reach.at[end]
                branch = Hole(
                    kind="branch",
                    at=reach.at[start],
                    to=reach.at[end],
                    way=axis / max(float(np.linalg.norm(axis)), 1e-300),
                    void=name,
                    into=int(reach.void[end]),
                    diameter=needs.diameter,
                    clearance=clearance,
                    near=place,
                    above=float(reach.above[start]),
                )
                branches.append((float(cost[row[index], column[index]]), branch))
                break
    return branches


def _measure_clearance(tree: TriangleTree, start: Floats, end: Floats, needs: DrainNeeds) -> tuple[float, Floats]:
    """Measure the least distance of a branch from all skin, mm, and its place on the axis."""
    length = float(np.linalg.norm(end - start))
    count = math.ceil(length / min(ALONG, needs.radius / 4)) + 1
    points = start + np.linspace(0, 1, count)[:, None] * (end - start)
    distances, _ = tree.nearest(points, threads=needs.threads)
    nearest = int(np.argmin(distances))
    half = length / max(count - 1, 1) / 2
    return math.sqrt(max(float(distances[nearest]) ** 2 - half**2, 0.0)) - needs.radius, points[nearest]


def _find_ends(below: TurnedPart, needs: DrainNeeds, drained: set[int], wanting: set[int]) -> BranchEnds:
    """Find places for the ends of branches: in all voids that want one, and near those in the drained voids."""
    points, void = _sample_voids(below, needs)
    is_wanting = np.isin(void, list(wanting))
    starts = _push_inwards(below, needs, points[is_wanting], void[is_wanting])
    if not len(starts.at):
        return starts
    goals, owner = _find_goals(below, needs, starts, points[~is_wanting], void[~is_wanting], drained)
    ends = _push_inwards(below, needs, goals, owner)
    return BranchEnds(
        at=np.concatenate([starts.at, ends.at]),
        void=np.concatenate([starts.void, ends.void]),
        cost=np.concatenate([starts.cost, ends.cost]),
        above=np.concatenate([starts.above, ends.above]),
    )


def _find_goals(
    below: TurnedPart, needs: DrainNeeds, starts: BranchEnds, points: Floats, void: Integers, drained: set[int]
) -> tuple[Floats, Integers]:
    """Find the points of drained voids nearest to the starts: of the candidates, and of their surfaces."""
    from scipy.spatial import cKDTree

    is_drained = np.isin(void, list(drained))
    points, void = points[is_drained], void[is_drained]
    if len(points):
        _, number = cKDTree(points).query(starts.at, k=min(NEAREST, len(points)))
        selected = np.unique(number)
        points, void = points[selected], void[selected]
    faces = _find_faces_near(below, starts, drained, needs.cell + 2 * (needs.diameter + needs.wall))
    if len(faces):
        surface = Surface(vertices=below.voids.vertices, faces=below.voids.faces[faces])
        _, face = TriangleTree.of(surface).nearest(starts.at, threads=needs.threads)
        corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces[face]]
        points, void = (
            np.concatenate([points, nearest_on_triangles(corners, starts.at)]),
            np.concatenate([void, below.owners[faces[face]]]),
        )
    return points, void


def _find_faces_near(below: TurnedPart, starts: BranchEnds, drained: set[int], distance: float) -> Integers:
    """Find faces of drained voids near the starts of at least one void: within a distance of their own box."""
    faces = np.flatnonzero(np.isin(below.owners, list(drained)))
    low, high = below.boxes[:, faces]
    is_near = np.zeros(len(faces), dtype=bool)
    for name in np.unique(starts.void).tolist():
        places = starts.at[starts.void == name].astype(np.float32)
        lower, upper = places.min(axis=0) - np.float32(distance), places.max(axis=0) + np.float32(distance)
        candidates = np.flatnonzero(~is_near)
        for axis in range(3):
            candidates = candidates[(low[candidates, axis] <= upper[axis]) & (high[candidates, axis] >= lower[axis])]
        is_near[candidates] = True
    return faces[is_near]


def _push_inwards(below: TurnedPart, needs: DrainNeeds, points: Floats, void: Integers) -> BranchEnds:
    """Move points inwards until a hole around them keeps the wall; drop points that leave their void by that."""
    tree, lowest = below.skin.whole, below.lowest
    at, needed = points.copy(), needs.radius + needs.wall
    distance = np.full(len(at), -np.inf)
    for push in range(PUSHES + 1):
        shallow = np.flatnonzero(distance < needed)
        if not len(shallow):
            break
        distance[shallow] = tree.nearest(at[shallow], threads=needs.threads)[0]
        if push == PUSHES:
            break
        shallow = shallow[distance[shallow] < needed]
        slope = np.stack(
            [
                tree.nearest(at[shallow] + ASIDE * step, threads=needs.threads)[0] - distance[shallow]
                for step in np.eye(3)
            ],
            axis=1,
        )
        length = np.linalg.norm(slope, axis=1, keepdims=True)
        inwards = np.divide(slope, length, out=np.zeros_like(slope), where=length > 0)
        at[shallow] += (needed - distance[shallow] + ASIDE / 10)[:, None] * inwards
    moved = np.linalg.norm(at - points, axis=1)
    overlap = min(OVERLAP[0], OVERLAP[1] * needs.radius)
    is_kept = (distance >= needed) & (moved <= needs.radius - overlap)
    at, void, moved = at[is_kept], void[is_kept], moved[is_kept]
    above = np.clip(at[:, 2] - needs.radius - lowest[void], 0, None)
    return BranchEnds(at=at, void=void, cost=moved + RISE * above, above=above)


def _sample_voids(below: TurnedPart, needs: DrainNeeds) -> tuple[Floats, Integers]:
    """Sample points inside voids, and vertices of them, (N, 3) mm; return the void of each too."""
    lattice = below.lattice(needs, LATTICE)
    line, height, up, face = find_crossings(below.voids, lattice)
    void = below.owners[face]
    order = np.argsort(void, kind="stable")  # lines and heights stay in order
    line, height, up, void = line[order], height[order], up[order], void[order]
    lower_crossing = np.flatnonzero((line[1:] == line[:-1]) & (void[1:] == void[:-1]) & (up[:-1] > 0) & (up[1:] < 0))
    lower_crossing = lower_crossing[_pick_evenly(void[lower_crossing], below.count, LINES)]
    low, high = height[lower_crossing], height[lower_crossing + 1]
    places, owner = lattice.places(line[lower_crossing]), void[lower_crossing]
    at = low + np.minimum(needs.radius, (high - low) / 2) + np.arange(LEVELS)[:, None] * needs.radius
    level, segment = np.nonzero(at < high)
    on_lines = np.column_stack([places[segment], at[level, segment]])
    used_vertices = np.flatnonzero(below.names >= 0)
    used_vertices = used_vertices[np.argsort(below.names[used_vertices], kind="stable")]
    used_vertices = used_vertices[_pick_evenly(below.names[used_vertices], below.count, MOST_POINTS)]
    points = np.concatenate([on_lines, np.asarray(below.voids.vertices, dtype=np.float64)[used_vertices]])
    void = np.concatenate([owner[segment], below.names[used_vertices].astype(np.int64)])
    # The corners of a void come last: they are of use only where no line passes through it.
    rank = np.repeat([0, 1], [len(on_lines), len(used_vertices)])
    order = np.lexsort((points[:, 2], rank, void))
    selected = order[_pick_evenly(void[order], below.count, MOST_POINTS)]
    return points[selected], void[selected]


def _pick_evenly(names: NDArray[np.integer], count: int, most: int) -> Integers:
    """Pick up to a number of places of each name, in even steps; names are in rising order.

    >>> _pick_evenly(np.array([0, 0, 0, 0, 0, 1]), 2, 3).tolist()
    [0, 2, 4, 5]
    """
    ends = np.searchsorted(names, np.arange(count + 1))
    chosen = [
        begin + np.unique(np.linspace(0, end - begin - 1, min(most, end - begin)).astype(np.int64))
        for begin, end in pairwise(ends.tolist())
        if end > begin
    ]
    return np.concatenate(chosen) if chosen else np.empty(0, dtype=np.int64)
