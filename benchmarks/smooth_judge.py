"""What became of a user's mesh, points or scan, judged without infill: distances both ways, topology, volume, losses.

Everything is measured in voxels: coordinates are divided by the size of a cell along each axis.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from benchmarks.smooth_geometry import (
    Nearest,
    Points,
    Topology,
    borders,
    hidden,
    nearest,
    sampled,
    some_vertices,
    united_volume,
)

SAMPLES = 200_000
FAR = 1.5  # voxels: what of the input lies farther from the result is lost
PATCH = 2.0  # voxels: how long a lost piece must be to count by itself
SHARE = 99.9  # percentile that may not be farther than FAR
MOST = 5  # pieces that are told, the longest
STEP = 1e-3  # voxels, to either side of a face
BORDER = 0.5  # voxels: a foot so near to an open border lies on it


@dataclass(frozen=True)
class Distances:
    """How far one surface lies from another, voxels; all but `largest` by area."""

    mean: float
    p95: float
    p999: float
    largest: float


@dataclass(frozen=True)
class Patch:
    """A piece of the input that is far from the result."""

    length: float  # voxels, the diagonal of its box
    depth: float  # voxels, its farthest point
    at: list[float]  # where that is, in the unit of the file


@dataclass(frozen=True)
class Judgement:
    """What became of an input; None where there is nothing to compare."""

    result_to_input: Distances
    input_to_result: Distances
    capped: float  # share of the result over open borders of the input
    hidden: float  # share of the input's area that has solid on both sides
    triangles: tuple[int, int]
    closed: tuple[bool, bool]
    manifold: tuple[bool, bool]
    shells: tuple[int | None, int]
    tunnels: tuple[int | None, int]
    volume: float | None  # of the result over that of the input, less 1
    patches: tuple[Patch, ...]

    @property
    def lost(self) -> bool:
        """Whether something of the input is not in the result."""
        return is_lost(self.input_to_result, self.patches)

    def facts(self) -> dict[str, Any]:
        return asdict(self) | {"lost": self.lost}


def is_lost(distances: Distances, patches: tuple[Patch, ...]) -> bool:
    return distances.p999 > FAR or any(patch.length >= PATCH for patch in patches)


def judge(given: trimesh.Trimesh, result: trimesh.Trimesh, spacing: Points, samples: int = SAMPLES) -> Judgement:
    """Return what became of a mesh: `spacing`, (3,), is the size of a voxel in the unit of both."""
    source, made = in_voxels(given, spacing), in_voxels(result, spacing)
    if not source.is_winding_consistent:
        trimesh.repair.fix_winding(source)
    before, after = Topology(source), Topology(made)
    spread = sampled(source, samples)
    inner = hidden(source, spread, STEP)
    seen, corners = spread.points[~inner], some_vertices(source, samples)
    if inner.any():  # a vertex cannot be told from its own faces: one of hidden faces is left out
        corners = corners[cKDTree(spread.points[inner]).query(corners)[0] > cKDTree(seen).query(corners)[0]]
    onto = nearest(made)
    there = from_points(seen, corners, onto)
    back = sampled(made, samples, seed=1).points
    feet, _ = nearest(source)(back)
    away = np.linalg.norm(feet - back, axis=1)
    caps = np.zeros(len(back), dtype=bool)
    if len(edges := borders(source)):
        far = np.flatnonzero(away > FAR)
        on_border = Nearest(source.vertices, edges)(feet[far])[0]
        caps[far] = np.linalg.norm(on_border - feet[far], axis=1) < BORDER
    density = source.area / samples
    overlapping = inner.mean() > 1e-4
    volume = None
    if before.closed:
        volume = made.volume / (united_volume(source) if overlapping else abs(source.volume)) - 1
    return Judgement(
        result_to_input=distances_of(away[~caps] if not caps.all() else away),
        input_to_result=there.distances,
        capped=float(caps.mean()),
        hidden=float(inner.mean()),
        triangles=(len(source.faces), len(made.faces)),
        closed=(before.closed, after.closed),
        manifold=(before.manifold, after.manifold),
        shells=(before.shells if before.closed else None, after.shells),
        tunnels=(before.tunnels if before.closed and not overlapping else None, after.tunnels),
        volume=volume,
        patches=patches_of(there.points, there.far, np.sqrt(density), spacing),
    )


def judge_points(given: Points, result: trimesh.Trimesh, spacing: Points, samples: int = SAMPLES) -> Judgement:
    """Return what became of points on a surface; the other way, distances are to the nearest point."""
    source, made = given / spacing, in_voxels(result, spacing)
    after = Topology(made)
    there = from_points(source, source[:0], nearest(made))
    tree = cKDTree(source)
    apart = float(np.median(tree.query(source, k=2)[0][:, 1]))
    return Judgement(
        result_to_input=distances_of(tree.query(sampled(made, samples, seed=1).points)[0]),
        input_to_result=there.distances,
        capped=0.0,
        hidden=0.0,
        triangles=(0, len(made.faces)),
        closed=(False, after.closed),
        manifold=(False, after.manifold),
        shells=(None, after.shells),
        tunnels=(None, after.tunnels),
        volume=None,
        patches=patches_of(there.points, there.far, apart, spacing),
    )


def in_voxels(mesh: trimesh.Trimesh, spacing: Points) -> trimesh.Trimesh:
    """Return the mesh in cells of the grid, vertices at the same place merged."""
    return trimesh.Trimesh(vertices=mesh.vertices / np.asarray(spacing), faces=mesh.faces, process=True)


@dataclass(frozen=True)
class There:
    """The way from the input to the result: points, how far each is, and what that comes to."""

    points: Points
    far: NDArray[np.float64]
    distances: Distances


def from_points(seen: Points, corners: Points, onto: Nearest) -> There:
    """Return how far points are; `corners` count for what is largest, and not for what goes by area."""
    points = np.concatenate([seen, corners])
    far = np.linalg.norm(onto(points)[0] - points, axis=1)
    return There(points, far, distances_of(far[: len(seen)], float(far.max())))


def distances_of(far: NDArray[np.float64], largest: float | None = None) -> Distances:
    return Distances(
        mean=float(far.mean()),
        p95=float(np.percentile(far, 95)),
        p999=float(np.percentile(far, SHARE)),
        largest=float(far.max()) if largest is None else largest,
    )


def patches_of(points: Points, far: NDArray[np.float64], apart: float, spacing: Points) -> tuple[Patch, ...]:
    """Return the longest pieces that are far, and the deepest.

    A piece is points whose boxes touch; a box is a voxel, or twice the gap between points if that is more.
    """
    points, far = points[far > FAR], far[far > FAR]
    if not len(points):
        return ()
    boxes, member = np.unique(np.floor(points / max(1.0, 2 * apart)), axis=0, return_inverse=True)
    links = cKDTree(boxes).query_pairs(1.5, p=np.inf, output_type="ndarray")
    label = _labels(len(boxes), links)[member.ravel()]
    found = []
    order = np.argsort(label, kind="stable")
    for inside in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        where = points[inside]
        tip = where[np.argmax(far[inside])] * np.asarray(spacing)
        length = float(np.linalg.norm(np.ptp(where, axis=0)))
        found.append(Patch(length, float(far[inside].max()), [round(float(x), 4) for x in tip]))
    found.sort(key=lambda patch: -patch.length)
    deepest = max(found, key=lambda patch: patch.depth)
    return (*found[:MOST], *([deepest] * (deepest not in found[:MOST])))


def _labels(count: int, links: NDArray[np.integer]) -> NDArray[np.int32]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ones = np.ones(len(links), dtype=np.int8)
    return connected_components(coo_array((ones, (links[:, 0], links[:, 1])), shape=(count, count)), directed=False)[1]
