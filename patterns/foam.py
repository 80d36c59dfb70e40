"""Foam: bars along the edges of Voronoi cells around seeds scattered at random, repeated in space."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.declared import check_parameters, parameter
from patterns.scattering import scattered
from patterns.shared import seed_parameter
from patterns.unit_cells import Bars

Floats = NDArray[np.float64]

ALONG = 3  # cells along a period
NEAR, WIDER = 1.8, 1.2  # cells: seeds that are looked at first, and how many times as far the next time
FINE = 12  # points along a cell, by which cells are evened out
ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class Foam(Bars):
    """Bars along the edges of Voronoi cells, 27 to a period of 3 cells, evened out by Lloyd's method.

    Source: Lloyd, "Least squares quantization in PCM", IEEE Trans. Inf. Theory 28 (1982) 129-137.
    """

    edges: tuple[()] = ()
    cells: int = ALONG
    seed: int = seed_parameter()
    even: int = parameter(3, "how often cells are evened out", unit="", low=0, high=20, whole=True)

    def __post_init__(self) -> None:
        """Check the parameters."""
        check_parameters(self)

    def axes(self) -> Floats:
        """Return the edges of the Voronoi cells: (E, 2, 3), in periods."""
        seeds = scattered(np.zeros(3, dtype=np.int64), np.full(3, ALONG), self.seed)
        for _ in range(self.even):
            seeds = evened(seeds, ALONG)
        return voronoi_edges(seeds, ALONG) / ALONG


def evened(seeds: Floats, period: int) -> Floats:
    """Return the centroids of the Voronoi cells of seeds (N, 3) that repeat with a period along each axis."""
    line = (np.arange(FINE * period) + 0.5) / FINE
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    nearest, which = np.full(len(points), np.inf), np.zeros(len(points), dtype=np.intp)
    for number, seed in enumerate(seeds):
        away = (_shortest(points - seed, period) ** 2).sum(axis=1)
        which[away < nearest] = number
        nearest = np.minimum(nearest, away)
    off = _shortest(points - seeds[which], period)
    count = np.bincount(which, minlength=len(seeds))
    moved = np.stack([np.bincount(which, weights=each, minlength=len(seeds)) for each in off.T], axis=-1)
    found: Floats = (seeds + moved / count[:, None]) % period
    return found


def _shortest(off: Floats, period: int) -> Floats:
    found: Floats = off - period * np.round(off / period)
    return found


def voronoi_edges(seeds: Floats, period: int) -> Floats:
    """Return the edges of the Voronoi cells of seeds (N, 3) that repeat with a period along each axis, each edge once.

    A vertex is as far from four seeds as from no other; two vertices with three seeds in common end an edge.

    Returns
    -------
    (E, 2, 3) float64
        With one end, or both, beyond the period where they cross its border.
    """
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)), dtype=np.float64) * period
    images = (seeds[None] + shifts[:, None]).reshape(-1, 3)
    number = np.tile(np.arange(len(seeds)), len(shifts))
    found: list[Floats] = []
    for own, seed in enumerate(seeds):
        around, vertices = _cell(images - seed)
        ends: dict[tuple[int, int], list[Floats]] = {}
        for three, vertex in zip(around.tolist(), vertices, strict=True):
            for pair in itertools.combinations(three, 2):
                # An edge is seen from its three seeds: it is taken at that of the lowest number.
                if own < min(number[pair[0]], number[pair[1]]):
                    ends.setdefault(pair, []).append(vertex + seed)
        found.extend(np.array(each) for each in ends.values())
    return np.array(found)


def _cell(off: Floats) -> tuple[NDArray[np.intp], Floats]:
    """Return the vertices (V, 3) of the Voronoi cell around 0 among points (N, 3), and the three points (V, 3) of each.

    Points that are further than twice its furthest vertex have no say, so few are looked at first.
    """
    away = np.linalg.norm(off, axis=1)
    reach = NEAR
    while True:
        near = np.flatnonzero((away > 0) & (away < reach))
        three = np.array(list(itertools.combinations(range(len(near)), 3)))
        planes = off[near][three]
        sure = np.abs(np.linalg.det(planes)) > ROUNDING
        three, planes = three[sure], planes[sure]
        # As far from 0 as from three others: off . x = |off|² / 2 for each.
        vertices = np.linalg.solve(planes, (planes**2).sum(axis=2)[..., None] / 2)[..., 0]
        free = (vertices @ off[near].T - away[near] ** 2 / 2 <= ROUNDING).all(axis=1)
        three, vertices = near[three[free]], vertices[free]
        if _closed(three) and np.linalg.norm(vertices, axis=1).max() <= reach / 2:
            return three, vertices
        reach *= WIDER


def _closed(three: NDArray[np.intp]) -> bool:
    """Return whether every edge, which two of three points make, has two ends."""
    pairs = np.sort(np.concatenate([three[:, [0, 1]], three[:, [0, 2]], three[:, [1, 2]]]), axis=1)
    return len(pairs) > 0 and bool((np.unique(pairs, axis=0, return_counts=True)[1] == 2).all())
