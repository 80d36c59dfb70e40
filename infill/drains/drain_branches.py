"""Holes from voids that no hole straight down can drain into voids beside them that are drained."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.drains.drain_columns import cross
from infill.drains.drain_places import Below, Needs
from infill.meshes.distance import Tree
from infill.surface import Surface

MOST_POINTS, LINES, LATTICE = 400, 1600, 40_000  # of a void; lines through a void, and through all
LEVELS = 12  # heights of a line in a void
OVERLAP = 0.15, 0.3  # mm, and of the radius, the lesser: by which a branch reaches into a void
PUSHES = 6  # steps by which points are moved inwards
ASIDE = 0.01  # mm: for the way inwards
NEAREST = 12  # places that are tried for each point
LONGER = 1.5  # times the shortest: branches that are longer wait, as a void between may be drained by then
RISE = 0.5  # of a mm of length for each mm that a branch begins above the lowest place
ALONG = 0.2  # mm, or less: between the points at which a branch is measured

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Branch:
    """A hole with round ends from a void into another.

    Parameters
    ----------
    start, end : (3,) float64, mm
        Of its axis.
    void, into : int
    diameter : float, mm
    clearance : float
        Least distance of the hole from the skin, mm.
    near : (3,) float64, mm
        Where on the axis that is.
    above : float
        How much higher than the lowest place of its void it begins, mm.
    """

    start: Floats
    end: Floats
    void: int
    into: int
    diameter: float
    clearance: float
    near: Floats
    above: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Reach:
    """Places for the ends of branches, so deep below all skin that the hole around them keeps the wall.

    Parameters
    ----------
    at : (N, 3) float64, mm
    void : (N,) int64
        The void that a ball around each cuts.
    cost : (N,) float64
        mm by which it was moved, and by which it is above the lowest place of its void, in part.
    above : (N,) float64
        How far the lowest place of the ball is above that of its void, mm; 0 if it is not.
    """

    at: Floats
    void: Integers
    cost: Floats
    above: Floats


def find_branches(below: Below, needs: Needs, drained: Iterable[int], wanting: Iterable[int]) -> list[Branch]:
    """Find branches by which voids are joined to drained ones, or to one another on the way there.

    Parameters
    ----------
    below : Below
    needs : Needs
    drained, wanting : iterable of int
        Voids.
    """
    from scipy.spatial import cKDTree

    open_, shut = set(drained), set(wanting)
    if not open_ or not shut:
        return []
    tree = below.skin.whole
    reach = _reach(below, needs, open_, shut)
    found: list[Branch] = []
    while shut:
        goals = np.flatnonzero(np.isin(reach.void, list(open_)))
        starts = np.flatnonzero(np.isin(reach.void, list(shut)))
        if not len(goals) or not len(starts):
            break
        count = min(NEAREST, len(goals))
        away, number = cKDTree(reach.at[goals]).query(reach.at[starts], k=count)
        away, number = away.reshape(len(starts), count), number.reshape(len(starts), count)
        cost = away + reach.cost[starts][:, None] + reach.cost[goals][number]
        best = _best(needs, tree, reach, starts, goals[number], cost)
        if not best:
            break
        shortest = min(price for price, _ in best)
        for price, branch in best:
            if price <= LONGER * shortest + needs.diameter:
                found.append(branch)
                open_.add(branch.void)
                shut.discard(branch.void)
    return found


def _best(
    needs: Needs, tree: Tree, reach: Reach, starts: Integers, goals: Integers, cost: Floats
) -> list[tuple[float, Branch]]:
    """Return the cheapest branch of every void that keeps the wall, with its cost."""
    found = []
    order = np.argsort(cost, axis=None, kind="stable")
    row, column = np.unravel_index(order, cost.shape)
    void = reach.void[starts[row]]
    for each in np.unique(void).tolist():
        own = np.flatnonzero(void == each)[: 3 * NEAREST]
        for index in own.tolist():
            start, end = int(starts[row[index]]), int(goals[row[index], column[index]])
            clearance, near = _clearance(tree, reach.at[start], reach.at[end], needs)
            if clearance >= needs.wall:
                branch = Branch(
                    start=reach.at[start],
                    end=reach.at[end],
                    void=each,
                    into=int(reach.void[end]),
                    diameter=needs.diameter,
                    clearance=clearance,
                    near=near,
                    above=float(reach.above[start]),
                )
                found.append((float(cost[row[index], column[index]]), branch))
                break
    return found


def _clearance(tree: Tree, start: Floats, end: Floats, needs: Needs) -> tuple[float, Floats]:
    """Return how far a branch stays from all skin, mm, and where on its axis that is."""
    length = float(np.linalg.norm(end - start))
    count = math.ceil(length / min(ALONG, needs.radius / 4)) + 1
    points = start + np.linspace(0, 1, count)[:, None] * (end - start)
    away, _ = tree.nearest(points, threads=needs.threads)
    nearest = int(np.argmin(away))
    half = length / max(count - 1, 1) / 2
    return math.sqrt(max(float(away[nearest]) ** 2 - half**2, 0.0)) - needs.radius, points[nearest]


def _reach(below: Below, needs: Needs, drained: set[int], wanting: set[int]) -> Reach:
    """Return places for the ends of branches: in all voids that want one, and near those in the drained ones."""
    points, void = _points_inside(below, needs)
    want = np.isin(void, list(wanting))
    starts = _deep_enough(below, needs, points[want], void[want])
    if not len(starts.at):
        return starts
    goals, owner = _points_near(below, needs, starts, points[~want], void[~want], drained)
    ends = _deep_enough(below, needs, goals, owner)
    return Reach(
        at=np.concatenate([starts.at, ends.at]),
        void=np.concatenate([starts.void, ends.void]),
        cost=np.concatenate([starts.cost, ends.cost]),
        above=np.concatenate([starts.above, ends.above]),
    )


def _points_near(
    below: Below, needs: Needs, starts: Reach, points: Floats, void: Integers, drained: set[int]
) -> tuple[Floats, Integers]:
    """Return the points of drained voids that are nearest to some starts: of those given, and of their surfaces."""
    from scipy.spatial import cKDTree
    from trimesh.triangles import closest_point

    own = np.isin(void, list(drained))
    points, void = points[own], void[own]
    if len(points):
        _, number = cKDTree(points).query(starts.at, k=min(NEAREST, len(points)))
        near = np.unique(number)
        points, void = points[near], void[near]
    faces = _faces_near(below, starts, drained, needs.cell + 2 * (needs.diameter + needs.wall))
    if len(faces):
        surface = Surface(vertices=below.voids.vertices, faces=below.voids.faces[faces])
        _, face = Tree.of(surface).nearest(starts.at, threads=needs.threads)
        corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces[face]]
        nearest = np.asarray(closest_point(corners, starts.at), dtype=np.float64)  # type: ignore[no-untyped-call]
        points, void = np.concatenate([points, nearest]), np.concatenate([void, below.owners[faces[face]]])
    return points, void


def _faces_near(below: Below, starts: Reach, drained: set[int], far: float) -> Integers:
    """Return the faces of drained voids that come within a distance of the box of the starts of some void."""
    faces = np.flatnonzero(np.isin(below.owners, list(drained)))
    low, high = below.boxes[:, faces]
    near = np.zeros(len(faces), dtype=bool)
    for each in np.unique(starts.void).tolist():
        own = starts.at[starts.void == each].astype(np.float32)
        least, most = own.min(axis=0) - np.float32(far), own.max(axis=0) + np.float32(far)
        some = np.flatnonzero(~near)
        for axis in range(3):
            some = some[(low[some, axis] <= most[axis]) & (high[some, axis] >= least[axis])]
        near[some] = True
    return faces[near]


def _deep_enough(below: Below, needs: Needs, points: Floats, void: Integers) -> Reach:
    """Move points inwards until a hole around them keeps the wall; leave out those that leave their void by that."""
    tree, lowest = below.skin.whole, below.lowest
    at, deep = points.copy(), needs.radius + needs.wall
    away = np.full(len(at), -np.inf)
    for push in range(PUSHES + 1):
        short = np.flatnonzero(away < deep)
        if not len(short):
            break
        away[short] = tree.nearest(at[short], threads=needs.threads)[0]
        if push == PUSHES:
            break
        short = short[away[short] < deep]
        slope = np.stack(
            [tree.nearest(at[short] + ASIDE * step, threads=needs.threads)[0] - away[short] for step in np.eye(3)],
            axis=1,
        )
        length = np.linalg.norm(slope, axis=1, keepdims=True)
        inwards = np.divide(slope, length, out=np.zeros_like(slope), where=length > 0)
        at[short] += (deep - away[short] + ASIDE / 10)[:, None] * inwards
    moved = np.linalg.norm(at - points, axis=1)
    overlap = min(OVERLAP[0], OVERLAP[1] * needs.radius)
    kept = (away >= deep) & (moved <= needs.radius - overlap)
    at, void, moved = at[kept], void[kept], moved[kept]
    above = np.clip(at[:, 2] - needs.radius - lowest[void], 0, None)
    return Reach(at=at, void=void, cost=moved + RISE * above, above=above)


def _points_inside(below: Below, needs: Needs) -> tuple[Floats, Integers]:
    """Return points in voids, (N, 3) mm, and which void each is in."""
    lattice = below.lattice(needs, LATTICE)
    line, height, up, face = cross(below.voids, lattice)
    void = below.owners[face]
    order = np.argsort(void, kind="stable")  # lines and heights stay in order
    line, height, up, void = line[order], height[order], up[order], void[order]
    first = np.flatnonzero((line[1:] == line[:-1]) & (void[1:] == void[:-1]) & (up[:-1] > 0) & (up[1:] < 0))
    first = first[_evenly(void[first], below.count, LINES)]
    low, high = height[first], height[first + 1]
    places, owner = lattice.places(line[first]), void[first]
    at = low + np.minimum(needs.radius, (high - low) / 2) + np.arange(LEVELS)[:, None] * needs.radius
    level, segment = np.nonzero(at < high)
    inside = np.column_stack([places[segment], at[level, segment]])
    corners = np.flatnonzero(below.names >= 0)
    corners = corners[np.argsort(below.names[corners], kind="stable")]
    corners = corners[_evenly(below.names[corners], below.count, MOST_POINTS)]
    points = np.concatenate([inside, np.asarray(below.voids.vertices, dtype=np.float64)[corners]])
    void = np.concatenate([owner[segment], below.names[corners].astype(np.int64)])
    # The corners of a void come last: they are of use only where no line passes through it.
    rank = np.repeat([0, 1], [len(inside), len(corners)])
    order = np.lexsort((points[:, 2], rank, void))
    kept = order[_evenly(void[order], below.count, MOST_POINTS)]
    return points[kept], void[kept]


def _evenly(names: NDArray[np.integer], count: int, most: int) -> Integers:
    """Return up to so many places of each name, in even steps, of names in rising order.

    >>> _evenly(np.array([0, 0, 0, 0, 0, 1]), 2, 3).tolist()
    [0, 2, 4, 5]
    """
    ends = np.searchsorted(names, np.arange(count + 1))
    chosen = [
        begin + np.unique(np.linspace(0, end - begin - 1, min(most, end - begin)).astype(np.int64))
        for begin, end in pairwise(ends.tolist())
        if end > begin
    ]
    return np.concatenate(chosen) if chosen else np.empty(0, dtype=np.int64)
