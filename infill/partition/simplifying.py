"""Walls between labels with fewer triangles: each wall stays near itself, and its two labels keep sharing it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from infill.kernels.threads import thread_count
from infill.kernels.wall_collapsing import FIXED
from infill.meshes.distance import TriangleTree, morton_order
from infill.meshes.intersections import intersecting_pairs
from infill.partition.junctions import on_side
from infill.partition.volumes import PRECISION, VolumePartition, neighbour_areas, solve_steps
from infill.partition.wall_mesh import WallMesh
from infill.partition.walls import OUTSIDE, WallGraph, Walls, measure_volumes
from infill.surface import Surface

BLIND_SHARE = 0.05  # of the tolerance, as a mean: edges collapse up to here without any distance being measured
SAMPLED_SHARE = 0.8  # of the tolerance: where samples may lie, so that places between them lie within the tolerance
NEAR_SIDES = 1.5  # sides of cells: around a place that fails, points this near are fixed
AROUND = 6.0  # sides of cells: around points that came back, distances are measured again
FEW_FAILED = 0.05  # of the points: so many come back, rather than that all is done again
MOST_MORE = 1.1  # times as many triangles: with more come back, all is done again. On flat walls, all may come back
# Each time that all is done again, with a smaller share of the tolerance: a large one may be too much.
ATTEMPTS, REPAIRS, LESS = 10, 8, 0.8
RESTORING_ROUNDS = 6  # of moving walls; each leaves about a tenth
PRECISE = 5e-5  # of the volume of every label
SIDES_APART = 0.35  # sides of cells: between places at which the distance of triangles is measured
SURE = 0.99  # of the tolerance: places between those that are measured may lie further away


def simplify_partition(
    partition: VolumePartition, tolerance: float, *, scale: tuple[float, ...], threads: int | None = None
) -> VolumePartition:
    """Simplify the walls of a partition to fewer triangles; every label keeps its volume.

    Parameters
    ----------
    partition : VolumePartition
    tolerance : float
        Largest distance of each wall from itself, both ways, in cells of `scale`.
    scale : (3,) float
        Sides of a cell.

    Notes
    -----
    Where a wall goes too far, or triangles pass through each other, the points around the place come back. Where that
    does not help, or the places are many, these points are fixed, and all is done again with a smaller tolerance. In
    the end, the walls stay as they were.
    """
    if not len(partition.walls.triangles):
        return partition
    count = thread_count(threads)
    shape, volumes = partition.graph.winners.shape, partition.walls.volumes
    is_cut = np.isin(np.arange(len(volumes)), partition.walls.sides)
    targets = np.where(is_cut & (np.arange(len(volumes)) > 0), volumes, 0.0)
    original = WallMesh.of(partition.walls, scale, shape)
    fixed, attempts = original.order == FIXED, 0
    fewer: WallMesh | None = None
    back: NDArray[np.float64] | None = None
    while fewer is not None or attempts < ATTEMPTS:
        if fewer is None:
            leeway, repairs = tolerance * LESS**attempts, 0
            attempts += 1
            fewer = original.fix(fixed).collapse((BLIND_SHARE * leeway) ** 2, None, count)
            fewer = fewer.collapse((SAMPLED_SHARE * leeway) ** 2, SAMPLED_SHARE * leeway, count)
        graph, walls = fewer.as_walls(partition.graph, scale)
        walls = restore_volumes(graph, walls, targets, scale=scale, threads=count)
        fewer = replace(fewer, points=walls.points.astype(np.float64) * np.array(scale))
        far = find_far(original, fewer, tolerance, scale, count, around=back)
        crossing = intersecting_pairs(Surface(vertices=fewer.points, faces=fewer.triangles), threads=count)
        is_kept = np.abs(walls.volumes - targets)[targets > 0] <= PRECISE * targets[targets > 0]
        # Crossings of the walls that came in cannot be fixed here.
        if not len(far) and is_kept.all() and len(crossing) <= partition.crossings:
            return replace(partition, graph=graph, walls=walls, crossings=len(crossing))
        places = np.concatenate([far, fewer.points[fewer.triangles[np.unique(crossing)]].reshape(-1, 3)])
        is_failed = np.zeros(len(fixed), dtype=bool)
        if len(places):
            is_failed = original.near(places, NEAR_SIDES * float(np.mean(scale)))
            fixed |= is_failed
        is_local = is_kept.all() and is_failed.mean() < FEW_FAILED and repairs < REPAIRS
        repairs += 1
        mended = fewer.restore(original, is_failed) if is_local else None
        most = MOST_MORE * len(fewer.triangles)
        fewer, back = mended if mended and len(mended[0].triangles) <= most else (None, None)
    return partition


def restore_volumes(
    graph: WallGraph,
    walls: Walls,
    targets: NDArray[np.float64],
    *,
    scale: tuple[float, ...],
    threads: int | None = None,
) -> Walls:
    """Move walls along their normals until every label has its volume.

    The wall between k and l moves by m_k - m_l, and the moves m solve the same equation as offsets do.

    Parameters
    ----------
    graph, walls : WallGraph, Walls
    targets : (labels,) float64
        Volumes, 0 for labels whose volume is not sought.
    scale : (3,) float
        Sides of a cell.
    """
    volumes_within = partial(measure_volumes, graph, labels=len(targets), scale=scale, threads=threads)
    walls = replace(walls, volumes=volumes_within(walls.points))
    sides, is_sought = np.array(scale), targets > 0
    fixed, inner = on_side(walls.points, graph.winners.shape), walls.sides[:, 1] != OUTSIDE
    triangles, (behind, before) = walls.triangles[inner], walls.sides[inner].T
    best, best_error = walls, np.inf
    for _ in range(RESTORING_ROUNDS):
        missing = np.where(is_sought, targets - walls.volumes, 0.0)
        error = float(np.max(np.abs(missing[is_sought]) / targets[is_sought], initial=0.0))
        if error < best_error:
            best, best_error = walls, error
        if error <= PRECISION:
            break
        moves = solve_steps(neighbour_areas(walls, len(targets), scale), missing, is_sought)
        corners = (walls.points * sides)[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area, along = np.linalg.norm(normals, axis=1), normals * (moves[behind] - moves[before])[:, None]
        total, shift = np.zeros(len(fixed)), np.zeros(fixed.shape)
        for corner in triangles.T:
            total += np.bincount(corner, area, len(fixed))
            shift += np.stack([np.bincount(corner, part, len(fixed)) for part in along.T], axis=1)
        shift /= np.maximum(total, 1e-300)[:, None] * sides
        points = walls.points + np.where(fixed, 0.0, shift).astype(np.float32)
        walls = replace(walls, points=points, volumes=volumes_within(points))
    return best


def find_far(
    original: WallMesh,
    fewer: WallMesh,
    tolerance: float,
    scale: tuple[float, ...],
    threads: int,
    *,
    around: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Return places (N, 3) on walls that lie too far from the same wall of the other mesh.

    All points of the original are measured, and places spread over triangles of both; with `around`, (M, 3), only those
    near some places.
    """
    from scipy.spatial import cKDTree

    across = int(np.ceil(np.cbrt(original.pair.max(initial=0) + 1)))
    step = 2 * float(original.box[1].max())

    def spread(places: NDArray[np.float64], pair: NDArray[np.int32]) -> NDArray[np.float64]:
        """Move every wall to a place of its own, so that the nearest triangle is one of the same wall."""
        return places + step * np.stack([pair % across, pair // across % across, pair // across**2], axis=-1)

    far: list[NDArray[np.float64]] = []
    for mesh, other in ((original, fewer), (fewer, original)):
        corners = other.points[other.triangles]
        order = _order_by_wall(corners.mean(axis=1), other.pair)
        corners = spread(corners, other.pair[:, None])
        faces = np.arange(3 * len(corners)).reshape(-1, 3)
        tree = TriangleTree.of(Surface(vertices=corners.reshape(-1, 3), faces=faces), order=order)
        places, pair = mesh.sample(SIDES_APART * float(np.mean(scale)))
        if mesh is original:
            points, pair_of_points = mesh.points_on_walls()
            places, pair = np.concatenate([places, points]), np.concatenate([pair, pair_of_points])
        if around is not None:
            is_near = np.isfinite(cKDTree(around).query(places, distance_upper_bound=AROUND * float(np.mean(scale)))[0])
            places, pair = places[is_near], pair[is_near]
        order, is_far = _order_by_wall(places, pair), np.empty(len(places), dtype=bool)
        distance = tree.nearest(spread(places[order], pair[order]), enough=SURE * tolerance, threads=threads)[0]
        is_far[order] = distance > SURE * tolerance
        far.append(places[is_far])
    return np.concatenate(far)


def _order_by_wall(places: NDArray[np.float64], pair: NDArray[np.int32]) -> NDArray[np.int64]:
    """Return the order of places (N, 3) wall by wall, with neighbours near each other in each."""
    order = morton_order(places)
    # Numbers of 16 bits are sorted faster.
    walls = pair.astype(np.uint16) if pair.max(initial=0) <= np.iinfo(np.uint16).max else pair
    return np.asarray(order[np.argsort(walls[order], kind="stable")])
