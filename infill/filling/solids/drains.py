"""Drains: a round hole down from the lowest place of every void, so that powder and resin leave it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from infill.surface import Surface
from infill.surfaces.components import shell_names
from infill.surfaces.shells import shell_volumes
from infill.surfaces.solids import FINE, solid_of, status_of, surface_from

SIDES = 32
LOW = 0.25  # of the diameter: what lies this little above the lowest point of a void is its bottom
UP, DOWN = 0.5, 1.0  # diameters by which a drain reaches into the void, and out of the skin

Floats = NDArray[np.float64]


def bottoms(voids: Surface, diameter: float) -> Floats:
    """Return the middle of the bottom of every void, (N, 3) mm, at the height of its lowest point.

    Parameters
    ----------
    voids : Surface, mm
    diameter : float
        Of a drain, mm: what lies further than this from the lowest point belongs to another hollow.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere(radius=2)
    >>> bottoms(Surface(vertices=ball.vertices + 5.0, faces=ball.faces), 1.0).round(3).tolist()
    [[5.0, 5.0, 3.0]]
    """
    names, count = shell_names(voids)
    vertices = np.asarray(voids.vertices, dtype=np.float64)
    order = np.argsort(names, kind="stable")
    ends = np.searchsorted(names[order], np.arange(count + 1))
    found = np.empty((count, 3))
    for shell in range(count):
        own = vertices[order[ends[shell] : ends[shell + 1]]]
        lowest = own[np.argmin(own[:, 2])]
        near = (own[:, 2] < lowest[2] + LOW * diameter) & (np.linalg.norm(own[:, :2] - lowest[:2], axis=1) < diameter)
        found[shell] = (*own[near, :2].mean(axis=0), lowest[2])
    return found


def falls(part: Surface, points: Floats) -> Floats:
    """Return the height at which each of some points (N, 3) inside a part leaves it, straight down: (N,) mm; or nan."""
    corners = np.asarray(part.vertices, dtype=np.float64)[part.faces]
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = np.full(len(points), np.nan)
    for number, point in enumerate(points):
        over = (low[:, :2] <= point[:2]).all(axis=1) & (high[:, :2] >= point[:2]).all(axis=1) & (low[:, 2] < point[2])
        heights = [height for height in _heights(corners[over], point[:2]) if height < point[2]]
        found[number] = max(heights, default=math.nan)
    return found


def _heights(triangles: Floats, at: Floats) -> Iterator[float]:
    """Yield the heights at which a vertical line passes through triangles (N, 3, 3)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    doubled = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    for one, two, three, area in zip(a, b, c, doubled, strict=True):
        if area == 0:
            continue
        shares = [
            ((q[0] - at[0]) * (r[1] - at[1]) - (q[1] - at[1]) * (r[0] - at[0])) / area
            for q, r in ((two, three), (three, one), (one, two))
        ]
        if min(shares) >= 0:
            yield float(shares[0] * one[2] + shares[1] * two[2] + shares[2] * three[2])


def drained(solid: Surface, part: Surface, voids: Surface, diameter: float) -> tuple[Surface, Floats]:
    """Return a solid with a drain for every void, and where these leave it, (N, 3) mm.

    Parameters
    ----------
    solid : Surface, mm
        The part without its voids.
    part, voids : Surface, mm
    diameter : float
        mm

    Returns
    -------
    Surface
        As it was, if manifold3d does not take it.
    """
    import manifold3d

    from_, whole = bottoms(voids, diameter), solid_of(solid)
    floor = falls(part, from_)
    found = np.isfinite(floor)
    from_, floor = from_[found], floor[found]
    if status_of(whole) != FINE or not len(from_):
        return solid, np.empty((0, 3))
    round_ = manifold3d.CrossSection.circle(diameter / 2, SIDES)
    holes = [
        round_.extrude(top + UP * diameter - (bottom - DOWN * diameter)).translate((x, y, bottom - DOWN * diameter))
        for (x, y, top), bottom in zip(from_.tolist(), floor.tolist(), strict=True)
    ]
    open_ = whole - manifold3d.Manifold.batch_boolean(holes, manifold3d.OpType.Add)
    if status_of(open_) != FINE:
        return solid, np.empty((0, 3))
    return surface_from(open_), np.column_stack([from_[:, :2], floor])


def trapped(solid: Surface) -> list[tuple[float, list[float]]]:
    """Return the voids of a solid that are closed: volume, mm³, and lowest point of each, mm, by falling volume.

    >>> import trimesh
    >>> outer, inner = trimesh.creation.box((4, 4, 4)), trimesh.creation.box((2, 2, 2))
    >>> both = trimesh.util.concatenate([outer, trimesh.Trimesh(inner.vertices, inner.faces[:, ::-1])])
    >>> trapped(Surface(vertices=both.vertices, faces=both.faces))
    [(8.0, [-1.0, -1.0, -1.0])]
    """
    names, count = shell_names(solid)
    vertices = np.asarray(solid.vertices, dtype=np.float64)
    volume = shell_volumes(solid, names, count)
    order = np.lexsort((vertices[:, 2], names))
    first = order[np.searchsorted(names[order], np.arange(count))]
    closed = sorted(np.flatnonzero(volume < 0).tolist(), key=lambda shell: volume[shell])
    return [(round(float(-volume[shell]), 9), vertices[first[shell]].tolist()) for shell in closed]
