"""How wide walls and bars inside a part have become: measured across, from void to void."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.meshes.distance import Tree
from infill.meshes.measuring import face_areas
from infill.surface import Surface

Floats = NDArray[np.float64]

SAMPLES, FEWEST = 2000, 50  # points, and how many there must be for a median
START, MOST = 0.25, 3.0  # of the width as it was drawn: where the way across is begun, and where it is given up
AWAY = 1.5  # widths from the walls of the part, at least
STEPS = 12  # along it; the last ones are far shorter than what is seen
AT_A_TIME = 100_000  # triangles, about, of which there is a tree


def median_width(
    part: Surface, voids: Surface, *, wall: float, width: float, threads: int | None = None
) -> tuple[float | None, int]:
    """Return the median width of walls, or diameter of bars, between voids, mm, or None, and at how many points.

    From points of the voids, evenly spread, the way straight across to the next void is measured. Points near the walls
    of the part do not count.

    Parameters
    ----------
    part, voids : Surface, mm
        Voids face outwards: into the solid.
    wall : float
        Of the part, mm.
    width : float
        As drawn, mm.
    """
    upto = np.cumsum(face_areas(voids))
    if not upto[-1] > 0:
        return None, 0
    some = np.searchsorted(upto, upto[-1] * np.random.default_rng(0).random(SAMPLES), side="right")
    del upto
    a, b, c = (np.asarray(voids.vertices, dtype=np.float64)[voids.faces[some, corner]] for corner in range(3))
    points, across = (a + b + c) / 3, np.cross(b - a, c - a)
    normals = across / np.linalg.norm(across, axis=1, keepdims=True)
    away, _ = Tree.of(part).nearest(points, threads=threads)
    far = away > wall + AWAY * width
    points, normals = points[far], normals[far]
    if len(points) < FEWEST:
        return None, len(points)
    most = MOST * width
    along = np.full(len(points), START * width)
    for these, tree in _trees_near(points, voids, 2 * most):  # places are `most` from points, and see as far
        for _ in range(STEPS):
            # Nothing is nearer than this: so far the way across is free.
            free, _ = tree.nearest(points[these] + along[these, None] * normals[these], threads=threads)
            along[these] = np.minimum(along[these] + free, most)
    return float(np.median(along)), len(points)


def _trees_near(points: Floats, surface: Surface, reach: float) -> Iterator[tuple[NDArray[np.intp], Tree]]:
    """Yield some points at a time, (n,), and a tree of at least what of a surface lies within a reach of them, mm.

    They follow one another along the longest side of the surface, so that trees do not grow with that.
    """
    axis = int(np.argmax(np.ptp(surface.bounds, axis=0)))
    place, height, faces = points[:, axis], surface.vertices[:, axis], surface.faces
    for these in np.array_split(np.argsort(place), -(-len(faces) // AT_A_TIME)):
        if not len(these):
            continue
        below, above = height < place[these[0]] - reach, height > place[these[-1]] + reach
        near = ~(below[faces].all(axis=1) | above[faces].all(axis=1))
        if near.any():
            yield these, Tree.of(replace(surface, faces=faces[near]))
