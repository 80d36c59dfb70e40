"""Widths of the walls and bars inside a part, measured across from void to void."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.meshes.distance import TriangleTree
from infill.meshes.measuring import face_areas
from infill.surface import Surface

Floats = NDArray[np.float64]

SAMPLES, FEWEST = 2000, 50  # points, and the least number of them for a median
START, MOST = 0.25, 3.0  # of the width as drawn: where the search across begins, and where it is given up
AWAY = 1.5  # widths from the walls of the part, at least
STEPS = 12  # of the search; the final ones are far too short to matter
AT_A_TIME = 100_000  # triangles in a tree, roughly


def median_width(
    part: Surface, voids: Surface, *, wall: float, width: float, threads: int | None = None
) -> tuple[float | None, int]:
    """Measure the median width of walls, or diameter of bars, between voids, mm; return it and the number of points.

    From points spread evenly over the voids, the distance straight across to the next void is measured. Points near the
    walls of the part do not count. The width is None if there are too few points.

    Parameters
    ----------
    part, voids : Surface, mm
        Voids face outwards: into the solid.
    wall : float
        Of the part, mm.
    width : float
        As drawn, mm.
    """
    areas = np.cumsum(face_areas(voids))
    if not areas[-1] > 0:
        return None, 0
    sampled = np.searchsorted(areas, areas[-1] * np.random.default_rng(0).random(SAMPLES), side="right")
    del areas
    a, b, c = (np.asarray(voids.vertices, dtype=np.float64)[voids.faces[sampled, corner]] for corner in range(3))
    points, across = (a + b + c) / 3, np.cross(b - a, c - a)
    normals = across / np.linalg.norm(across, axis=1, keepdims=True)
    distance, _ = TriangleTree.of(part).nearest(points, threads=threads)
    is_inside = distance > wall + AWAY * width
    points, normals = points[is_inside], normals[is_inside]
    if len(points) < FEWEST:
        return None, len(points)
    longest = MOST * width
    along = np.full(len(points), START * width)
    for batch, tree in _trees_near(
        points, voids, 2 * longest
    ):  # queries lie up to `longest` from points, and reach as far
        for _ in range(STEPS):
            # No void is nearer than this, so the way across is free up to there.
            free, _ = tree.nearest(points[batch] + along[batch, None] * normals[batch], threads=threads)
            along[batch] = np.minimum(along[batch] + free, longest)
    return float(np.median(along)), len(points)


def _trees_near(points: Floats, surface: Surface, reach: float) -> Iterator[tuple[NDArray[np.intp], TriangleTree]]:
    """Yield batches of points, (n,), each with a tree of at least the faces within a reach of them, mm.

    Batches follow each other along the longest side of the surface, so that trees do not grow with its length.
    """
    axis = int(np.argmax(np.ptp(surface.bounds, axis=0)))
    place, height, faces = points[:, axis], surface.vertices[:, axis], surface.faces
    for batch in np.array_split(np.argsort(place), -(-len(faces) // AT_A_TIME)):
        if not len(batch):
            continue
        below, above = height < place[batch[0]] - reach, height > place[batch[-1]] + reach
        is_near = ~(below[faces].all(axis=1) | above[faces].all(axis=1))
        if is_near.any():
            yield batch, TriangleTree.of(replace(surface, faces=faces[is_near]))
