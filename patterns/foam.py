"""Foam: bars along the edges of Voronoi cells around seeds scattered at random, repeated in space."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.declared import parameter
from patterns.scattering import scatter_points
from patterns.shared import seed_parameter
from patterns.unit_cells import Bars

Floats = NDArray[np.float64]

CELLS_PER_PERIOD = 3  # cells along a period
NEAR, WIDER = 1.8, 1.2  # cells: distance of the seeds that are tried first, and its factor for every next try
SAMPLES_PER_CELL = 12  # sample points along a cell for centroids
ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class VoronoiFoam(Bars):
    """Bars along the edges of Voronoi cells, 27 to a period of 3 cells, evened out by Lloyd's method.

    Source: Lloyd, "Least squares quantization in PCM", IEEE Trans. Inf. Theory 28 (1982) 129-137.
    """

    name: str = "voronoi-foam"
    summary: str = "irregular cells, as in sponge and bone; no direction is weaker than another"
    edges: tuple[()] = ()
    cells: int = CELLS_PER_PERIOD
    seed: int = seed_parameter()
    even: int = parameter(3, "how often cells are evened out", unit="", low=0, high=20, whole=True)

    def axes(self) -> Floats:
        """Return the edges of the Voronoi cells: (E, 2, 3), in periods."""
        seeds = scatter_points(np.zeros(3, dtype=np.int64), np.full(3, CELLS_PER_PERIOD), self.seed)
        for _ in range(self.even):
            seeds = voronoi_centroids(seeds, CELLS_PER_PERIOD)
        return voronoi_edges(seeds, CELLS_PER_PERIOD) / CELLS_PER_PERIOD


def voronoi_centroids(seeds: Floats, period: int) -> Floats:
    """Return the centroids of the Voronoi cells of seeds (N, 3) that repeat with a period along each axis."""
    line = (np.arange(SAMPLES_PER_CELL * period) + 0.5) / SAMPLES_PER_CELL
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    nearest, nearest_seed = np.full(len(points), np.inf), np.zeros(len(points), dtype=np.intp)
    for number, seed in enumerate(seeds):
        squared_distance = (_wrap(points - seed, period) ** 2).sum(axis=1)
        nearest_seed[squared_distance < nearest] = number
        nearest = np.minimum(nearest, squared_distance)
    offset = _wrap(points - seeds[nearest_seed], period)
    count = np.bincount(nearest_seed, minlength=len(seeds))
    shift = np.stack(
        [np.bincount(nearest_seed, weights=component, minlength=len(seeds)) for component in offset.T], axis=-1
    )
    centroids: Floats = (seeds + shift / count[:, None]) % period
    return centroids


def _wrap(offset: Floats, period: int) -> Floats:
    """Return offsets between cells of a periodic grid as the shortest ones."""
    wrapped: Floats = offset - period * np.round(offset / period)
    return wrapped


def voronoi_edges(seeds: Floats, period: int) -> Floats:
    """Return the edges of the Voronoi cells of seeds (N, 3) that repeat with a period along each axis, each edge once.

    A vertex is equally far from its four nearest seeds; two vertices with three seeds in common end an edge.

    Returns
    -------
    (E, 2, 3) float64
        One end, or both, lies beyond the period where an edge crosses its border.
    """
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), dtype=np.float64) * period
    images = (seeds[None] + shifts[:, None]).reshape(-1, 3)
    number = np.tile(np.arange(len(seeds)), len(shifts))
    edges: list[Floats] = []
    for seed_number, seed in enumerate(seeds):
        neighbours, vertices = _cell(images - seed)
        ends: dict[tuple[int, int], list[Floats]] = {}
        for triple, vertex in zip(neighbours.tolist(), vertices, strict=True):
            for pair in itertools.combinations(triple, 2):
                # Three seeds see the same edge: the seed with the lowest number keeps it.
                if seed_number < min(number[pair[0]], number[pair[1]]):
                    ends.setdefault(pair, []).append(vertex + seed)
        edges.extend(np.array(end_points) for end_points in ends.values())
    return np.array(edges)


def _cell(offsets: Floats) -> tuple[NDArray[np.intp], Floats]:
    """Return the vertices (V, 3) of the Voronoi cell around 0 among points (N, 3), and the three points (V, 3) of each.

    Points further than twice the furthest vertex have no effect, so the nearest are tried first.
    """
    distance = np.linalg.norm(offsets, axis=1)
    reach = NEAR
    while True:
        nearby = np.flatnonzero((distance > 0) & (distance < reach))
        triples = np.array(list(itertools.combinations(range(len(nearby)), 3)))
        planes = offsets[nearby][triples]
        is_independent = np.abs(np.linalg.det(planes)) > ROUNDING
        triples, planes = triples[is_independent], planes[is_independent]
        # As far from 0 as from three others: off . x = |off|² / 2 for each.
        vertices = np.linalg.solve(planes, (planes**2).sum(axis=2)[..., None] / 2)[..., 0]
        is_vertex = (vertices @ offsets[nearby].T - distance[nearby] ** 2 / 2 <= ROUNDING).all(axis=1)
        triples, vertices = nearby[triples[is_vertex]], vertices[is_vertex]
        if _is_closed(triples) and np.linalg.norm(vertices, axis=1).max() <= reach / 2:
            return triples, vertices
        reach *= WIDER


def _is_closed(triples: NDArray[np.intp]) -> bool:
    """Tell whether every edge, which is a pair of a triple of points, has two ends."""
    pairs = np.sort(np.concatenate([triples[:, [0, 1]], triples[:, [0, 2]], triples[:, [1, 2]]]), axis=1)
    return len(pairs) > 0 and bool((np.unique(pairs, axis=0, return_counts=True)[1] == 2).all())
