"""How wide walls and bars inside a part have become: measured across, from void to void."""

from __future__ import annotations

import numpy as np

from infill.surface import Surface
from infill.surfaces.distance import Tree

SAMPLES, FEWEST = 2000, 50  # points, and how many there must be for a median
START, MOST = 0.25, 3.0  # of the width as it was drawn: where the way across is begun, and where it is given up
AWAY = 1.5  # widths from the walls of the part, at least
STEPS = 12  # along it; the last ones are far shorter than what is seen


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
    corners = np.asarray(voids.vertices, dtype=np.float64)[voids.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    twice = np.linalg.norm(across, axis=1)
    if not twice.sum() > 0:
        return None, 0
    some = np.random.default_rng(0).choice(len(twice), SAMPLES, p=twice / twice.sum())
    points, normals = corners[some].mean(axis=1), across[some] / twice[some, None]
    away, _ = Tree.of(part).nearest(points, threads=threads)
    far = away > wall + AWAY * width
    points, normals = points[far], normals[far]
    if len(points) < FEWEST:
        return None, len(points)
    tree = Tree.of(voids)
    along = np.full(len(points), START * width)
    for _ in range(STEPS):
        # Nothing is nearer than this: so far the way across is free.
        free, _ = tree.nearest(points + along[:, None] * normals, threads=threads)
        along = np.minimum(along + free, MOST * width)
    return float(np.median(along)), len(points)
