"""Closed solids of polygons, whose volume and area are known, for the readers of polygons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Solid:
    """Polygons that close a solid, counter-clockwise seen from outside."""

    vertices: np.ndarray
    polygons: list[list[int]]
    volume: float
    area: float

    @property
    def triangles(self) -> int:
        return sum(len(each) - 2 for each in self.polygons)


def prism(ring: list[tuple[float, float]], height: float, *, turn: int = 0) -> Solid:
    """Return a prism over a ring, counter-clockwise; its caps begin at the corner `turn`."""
    n = len(ring)
    points = np.array(ring, dtype=float)
    x, y = points.T
    flat = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    around = float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())
    bottom = [(turn + n - 1 - i) % n for i in range(n)]
    top = [n + (turn + i) % n for i in range(n)]
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    vertices = np.concatenate([np.column_stack([points, np.full(n, z)]) for z in (0.0, height)])
    return Solid(
        vertices=vertices, polygons=[bottom, top, *sides], volume=flat * height, area=2 * flat + around * height
    )


BOX = prism([(0, 0), (20, 0), (20, 30), (0, 30)], 40)
ELL = [(0, 0), (20, 0), (20, 10), (10, 10), (10, 30), (0, 30)]
COMB = [(0.0, 0.0), (90, 0), *((x, y) for k in range(9, 0, -1) for x, y in ((10 * k, 20), (10 * k - 5, 2))), (0, 20)]
STAR = [((20 if k % 2 else 7) * np.cos(k * np.pi / 7), (20 if k % 2 else 7) * np.sin(k * np.pi / 7)) for k in range(14)]
CLIPPED = [(0, 0), (5, 0), (10, 0), (20, 0), (20, 15), (20, 30), (0, 30)]  # corners on straight sides
KEYHOLE = [(0, 0), (30, 0), (30, 30), (0, 30), (0, 0), (10, 10), (10, 20), (20, 20), (20, 10), (10, 10)]
SOLIDS = {
    "box": BOX,
    "pentagon": prism([(np.cos(k * 0.4 * np.pi), np.sin(k * 0.4 * np.pi)) for k in range(5)], 3),
    **{f"ell from {k}": prism(ELL, 5, turn=k) for k in range(6)},
    **{f"comb from {k}": prism(COMB, 5, turn=k) for k in (0, 1, 7)},
    **{f"star from {k}": prism(STAR, 5, turn=k) for k in (0, 1)},
    **{f"corners on sides, from {k}": prism(CLIPPED, 5, turn=k) for k in range(7)},
    "arrow, a quad that is not convex": prism([(0, 0), (20, 10), (0, 20), (7, 10)], 5, turn=0),
    "arrow from its notch": prism([(0, 0), (20, 10), (0, 20), (7, 10)], 5, turn=3),
}


def two_boxes(*, apart: float = 50) -> list[Solid]:
    return [
        BOX,
        Solid(vertices=BOX.vertices + np.array([apart, 0, 0]), polygons=BOX.polygons, volume=BOX.volume, area=BOX.area),
    ]
