"""Tetrahedra made better: points inside labels move so that the worst tetrahedron around each becomes better.

Points of walls stay, so that surfaces do. Only where a tetrahedron is inside out all the same, since a line on which
labels meet was made smooth, points of walls move towards the middles between points of the lattice: with all of them
there, none is.

Source of the measure: Liu and Joe, BIT 34 (1994), the mean ratio 12 (3 V)^(2/3) / sum of the squares of the edges.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.partition.simplices import middle_points
from infill.partition.tetrahedra import LOCAL_EDGES
from infill.partition.tetrahedral_mesh import TetrahedralMesh
from infill.partition.walls import WallGraph

POOR = 0.3  # mean ratio: tetrahedra below it have their points moved
LEAST = 1e-3  # mean ratio: below it, a tetrahedron counts as inside out
GAIN = 0.01  # mean ratio: a move that gains less is not made
SWEEPS = 5
COLOURS = 8  # of points of the lattice, by whether their numbers are odd
TOWARDS_MIDDLE = (0.3, 0.6, 1.0)  # of the way to the middle of the points around
AWAY = (0.03, 0.1, 0.25)  # cells, away from the opposite face of the worst tetrahedron
MOST_ROUNDS = 8  # of moving points of walls, each with half of the way and a ring more
AT_ONCE = 2_000_000  # tetrahedra that are measured at a time
SLIVER = 0.1  # radius ratio: tetrahedra below it are counted
EVEN = np.array([[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]])  # each corner first, volumes keep their sign


@dataclass(frozen=True, kw_only=True)
class TetrahedralQuality:
    """Shapes of tetrahedra.

    Parameters
    ----------
    smallest_angle : float
        Smallest angle between two faces of a tetrahedron, degrees.
    slivers : float
        Share of tetrahedra whose radius ratio, three times that of the inner sphere over that of the outer one, is
        below 0.1; it is 1 in a regular tetrahedron.
    mean_ratio : float
        Mean of the radius ratios.
    inverted : int
        Number of tetrahedra whose volume is not positive.
    """

    smallest_angle: float
    slivers: float
    mean_ratio: float
    inverted: int


def improve_tetrahedra(
    mesh: TetrahedralMesh, graph: WallGraph, scale: tuple[float, ...] = (1.0, 1.0, 1.0)
) -> tuple[TetrahedralMesh, int]:
    """Move points of tetrahedra so that the worst ones become better, and none is inside out.

    Parameters
    ----------
    mesh : TetrahedralMesh
    graph : WallGraph
        The walls that it was cut from.
    scale : (3,) float
        Sides of a cell.

    Returns
    -------
    mesh : TetrahedralMesh
        With new points.
    moved : int
        Number of points of walls that had to move.
    """
    sides = np.array(scale)
    points = mesh.points * sides
    lattice = np.stack(np.unravel_index(mesh.lattice, tuple(count + 2 for count in graph.winners.shape)), axis=1)
    colours = np.concatenate([np.full(mesh.wall_points, -1), (lattice % 2) @ np.array([1, 2, 4])])
    relax(points, mesh.tetrahedra, colours)
    inverted = _find_inverted(points, mesh.tetrahedra)
    moved = np.zeros(len(points), dtype=bool)
    middles: Floats | None = None
    for ring in range(MOST_ROUNDS):
        if not len(inverted):
            break
        if middles is None:
            middles = np.concatenate([middle_points(graph) * sides, mesh.points[mesh.wall_points :] * sides])
        close = np.zeros(len(points), dtype=bool)
        close[mesh.tetrahedra[inverted]] = True
        for _ in range(ring // 2):
            close[mesh.tetrahedra[close[mesh.tetrahedra].any(axis=1)]] = True
        share = 0.5 if ring < MOST_ROUNDS - 2 else 1.0
        points[close] += share * (middles[close] - points[close])
        moved |= close
        relax(points, mesh.tetrahedra, colours, within=close)
        inverted = _find_inverted(points, mesh.tetrahedra)
    return replace(mesh, points=points / sides), int(moved[: mesh.wall_points].sum())


def relax(
    points: Floats,
    tetrahedra: NDArray[np.int64],
    colours: NDArray[np.integer],
    within: NDArray[np.bool_] | None = None,
) -> None:
    """Move points, in place, so that the worst tetrahedron around each becomes better.

    Parameters
    ----------
    points : (P, 3) float64
    tetrahedra : (T, 4) int64
    colours : (P,) int
        Points of one colour have no tetrahedron in common; those below 0 stay.
    within : (P,) bool, optional
        The points that may lie in a tetrahedron that is poor; by default, all.
    """
    close = tetrahedra if within is None else tetrahedra[within[tetrahedra].any(axis=1)]
    allowed = np.zeros(len(points), dtype=bool)
    allowed[close[mean_ratios(points, close) < POOR]] = True
    allowed &= colours >= 0
    close = tetrahedra[allowed[tetrahedra].any(axis=1)]
    is_active = allowed
    for _ in range(SWEEPS):
        star, owner = _find_stars(close, is_active)
        before = points[allowed]
        for colour in range(COLOURS):
            of_colour = colours[owner] == colour
            if of_colour.any():
                _move_points(points, star[of_colour], owner[of_colour])
        # Only where a point has moved can another move help.
        has_moved = np.zeros(len(points), dtype=bool)
        has_moved[allowed] = (points[allowed] != before).any(axis=1)
        near = close[has_moved[close].any(axis=1)]
        is_active = np.zeros(len(points), dtype=bool)
        is_active[near[mean_ratios(points, near) < POOR]] = True
        is_active &= allowed


def _find_stars(
    tetrahedra: NDArray[np.int64], is_active: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the tetrahedra around active points, each with that point first, and the points, in order."""
    active = is_active[tetrahedra]
    rows, columns = np.nonzero(active)
    owner = tetrahedra[rows, columns]
    order = np.argsort(owner, kind="stable")
    star = np.take_along_axis(tetrahedra[rows[order]], EVEN[columns[order]], axis=1)
    return star, owner[order]


def _move_points(points: Floats, star: NDArray[np.int64], owner: NDArray[np.int64]) -> None:
    """Move points of one colour to the best of their candidates."""
    starts = np.flatnonzero(np.diff(owner, prepend=-1))
    counts = np.diff(starts, append=len(owner))
    centre = points[owner[starts]]
    ring = points[star[:, 1:]]
    middle = np.add.reduceat(ring.mean(axis=1), starts, axis=0) / counts[:, None]
    fixed = _edge_squares(ring)

    def rate_shapes(candidate: Floats) -> Floats:
        """Return the mean ratios of the tetrahedra around points moved to candidates."""
        ratios = _ratios_from(np.repeat(candidate, counts, axis=0), ring, fixed)
        return np.asarray(ratios)

    ratios = rate_shapes(centre)
    best = np.minimum.reduceat(ratios, starts)
    # The first tetrahedron around each point that is as bad as its worst.
    worst = np.flatnonzero(ratios == np.repeat(best, counts))
    worst = worst[np.unique(np.searchsorted(starts, worst, side="right"), return_index=True)[1]]
    a, b, c = ring[worst].swapaxes(0, 1)
    normal = -np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    place = centre.copy()
    candidates = [centre + share * (middle - centre) for share in TOWARDS_MIDDLE]
    candidates += [centre + step * normal for step in AWAY]
    for candidate in candidates:
        rated = np.minimum.reduceat(rate_shapes(candidate), starts)
        better = rated > best + GAIN
        place[better], best[better] = candidate[better], rated[better]
    points[owner[starts]] = place


def _edge_squares(ring: Floats) -> Floats:
    """Return the sum of the squares of the edges of triangles (N, 3, 3)."""
    return np.asarray(sum(((ring[:, i] - ring[:, i - 1]) ** 2).sum(axis=1) for i in range(3)))


def _ratios_from(apex: Floats, ring: Floats, ring_squares: Floats) -> Floats:
    """Return the mean ratios of tetrahedra between points (N, 3) and triangles (N, 3, 3), below 0 if inside out."""
    a, b, c = (ring[:, i] - apex for i in range(3))
    volume = np.einsum("ij,ij->i", np.cross(a, b), c) / 6
    squares = ring_squares + sum((side**2).sum(axis=1) for side in (a, b, c))
    return np.asarray(np.sign(volume) * 12 * np.cbrt(3 * np.abs(volume)) ** 2 / np.maximum(squares, 1e-300))


def mean_ratios(points: Floats, tetrahedra: NDArray[np.int64]) -> Floats:
    """Return the mean ratio of tetrahedra, 1 for a regular one, 0 for a flat one, below 0 for one inside out.

    >>> regular = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> mean_ratios(regular, np.array([[0, 1, 3, 2], [0, 1, 2, 3]])).round(3).tolist()
    [1.0, -1.0]
    """
    ratios = np.empty(len(tetrahedra))
    for begin in range(0, len(tetrahedra), AT_ONCE):
        corners = points[tetrahedra[begin : begin + AT_ONCE]]
        ratios[begin : begin + AT_ONCE] = _ratios_from(corners[:, 0], corners[:, 1:], _edge_squares(corners[:, 1:]))
    return ratios


def _find_inverted(points: Floats, tetrahedra: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the tetrahedra that are inside out, or flat to rounding."""
    return np.flatnonzero(mean_ratios(points, tetrahedra) < LEAST)


def measure_quality(points: Floats, tetrahedra: NDArray[np.int64]) -> TetrahedralQuality:
    """Measure the shapes of tetrahedra.

    Parameters
    ----------
    points : (P, 3) float64, mm
    tetrahedra : (T, 4) int64

    >>> regular = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    >>> quality = measure_quality(regular, np.array([[0, 1, 3, 2]]))
    >>> round(quality.smallest_angle, 3), round(quality.mean_ratio, 6), quality.inverted
    (70.529, 1.0, 0)
    """
    smallest, slivers, total, inverted = np.inf, 0, 0.0, 0
    for begin in range(0, len(tetrahedra), AT_ONCE):
        corners = points[tetrahedra[begin : begin + AT_ONCE]]
        # Normals of the faces opposite each corner, their lengths twice the areas, outwards.
        normals = np.stack([_outward_normals(corners, corner) for corner in range(4)], axis=1)
        areas = np.linalg.norm(normals, axis=2)
        volume = np.einsum("ij,ij->i", normals[:, 0], corners[:, 1] - corners[:, 0]) / 6
        inverted += int((volume <= 0).sum())
        for i, j in LOCAL_EDGES:
            cosine = -np.einsum("ij,ij->i", normals[:, i], normals[:, j]) / np.maximum(
                areas[:, i] * areas[:, j], 1e-300
            )
            smallest = min(smallest, float(np.arccos(np.clip(cosine.max(initial=-1.0), -1, 1))))
        inner = 6 * np.maximum(volume, 0) / np.maximum(areas.sum(axis=1), 1e-300)
        a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
        outer = np.linalg.norm(
            (a**2).sum(axis=1)[:, None] * np.cross(b, c)
            + (b**2).sum(axis=1)[:, None] * np.cross(c, a)
            + (c**2).sum(axis=1)[:, None] * np.cross(a, b),
            axis=1,
        ) / np.maximum(12 * np.abs(volume), 1e-300)
        ratio = 3 * inner / np.maximum(outer, 1e-300)
        slivers += int((ratio < SLIVER).sum())
        total += float(ratio.sum())
    count = max(len(tetrahedra), 1)
    return TetrahedralQuality(
        smallest_angle=float(np.degrees(smallest)), slivers=slivers / count, mean_ratio=total / count, inverted=inverted
    )


def _outward_normals(corners: Floats, corner: int) -> Floats:
    """Return the normals of the faces opposite a corner of tetrahedra (N, 4, 3), twice their areas long, outwards."""
    a, b, c = (corners[:, at] for at in EVEN[corner][1:])
    return np.asarray(np.cross(b - a, c - a))
