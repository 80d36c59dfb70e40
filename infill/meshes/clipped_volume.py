"""The volume of the part of a closed surface that lies in an upright box, without cutting the surface."""

from __future__ import annotations

import math

import numpy as np

from infill.arrays import Floats
from infill.surface import Surface


def find_box(surface: Surface) -> Floats | None:
    """Return the lower and the upper corner of a surface, (2, 3) mm, if it is a box along the axes; else None.

    Notes
    -----
    Faces that all lie in the sides of a box cover each of its points equally often, if together they are closed. So
    they are the box if they enclose its volume.

    >>> import trimesh
    >>> box, ball = trimesh.creation.box((1, 2, 3)), trimesh.creation.icosphere()
    >>> find_box(Surface(vertices=box.vertices, faces=box.faces)).tolist()
    [[-0.5, -1.0, -1.5], [0.5, 1.0, 1.5]]
    >>> find_box(Surface(vertices=ball.vertices, faces=ball.faces))
    """
    bounds = surface.bounds
    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    in_a_side = np.logical_or.reduce([(corners == end).all(axis=1).any(axis=1) for end in bounds])
    if not in_a_side.all() or not surface.closed:
        return None
    is_box = math.isclose(surface.volume, math.prod((bounds[1] - bounds[0]).tolist()), rel_tol=1e-9)
    return bounds if is_box else None


def volume_in_box(surface: Surface, low: Floats, high: Floats) -> float:
    """Compute the volume that a closed surface encloses in a box along the axes, mm³.

    Parameters
    ----------
    surface : Surface
    low, high : (3,) float64, mm
        Corners of the box; where they are infinite, it has no such side.

    Notes
    -----
    By the divergence of (0, 0, z), where z is clipped to the heights of the box, and nothing counts that does not lie
    above or below it.

    >>> import trimesh
    >>> ball = trimesh.creation.icosphere()
    >>> whole = Surface(vertices=ball.vertices, faces=ball.faces)
    >>> bool(np.isclose(volume_in_box(whole, np.zeros(3), np.full(3, np.inf)), ball.volume / 8))
    True
    """
    vertices, faces = np.asarray(surface.vertices, dtype=np.float64), surface.faces
    across = [
        (axis, float(side[axis]), way)
        for axis in (0, 1)
        for side, way in ((low, 1.0), (high, -1.0))
        if math.isfinite(side[axis])
    ]
    is_inside = np.ones(len(vertices), dtype=bool)
    for axis, place, way in across:
        is_inside &= way * (vertices[:, axis] - place) > 0
    is_whole = is_inside[faces].all(axis=1)
    x, y, z = (column[faces[is_whole]] for column in vertices.T)
    if across:  # few triangles reach a side
        corners = vertices[faces[~is_whole]]
        for axis, place, way in across:
            corners = _clip(corners, axis, place, way)
        x, y, z = (
            np.concatenate([column, cut]) for column, cut in zip((x, y, z), corners.transpose(2, 0, 1), strict=True)
        )
    if not len(z):
        return 0.0
    (ax, bx, cx), (ay, by, cy) = x.T, y.T
    shadow = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
    height = z.mean(axis=1) - z.mean()
    for place, way in ((low[2], 1.0), (high[2], -1.0)):
        if math.isfinite(place):
            beyond = way * (place - z)
            reaches = (beyond > 0).any(axis=1)
            height[reaches] += way * mean_positive_part(beyond[reaches])
    return float(shadow @ height)


def _clip(corners: Floats, axis: int, place: float, way: float) -> Floats:
    """Cut triangles (N, 3, 3) off at a plane across an axis, mm; keep what lies beyond it, `way` 1 upwards or -1 down.

    A triangle with two corners beyond the plane leaves two.
    """
    depth = way * (corners[:, :, axis] - place)
    is_beyond = depth > 0
    count = is_beyond.sum(axis=1)
    parts = [corners[count == 3]]
    for beyond in (1, 2):
        chosen = count == beyond
        # Turned so that the corner that is alone on its side of the plane comes to the front.
        lone = np.argmax(is_beyond[chosen] == (beyond == 1), axis=1)
        turn = (lone[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(corners[chosen], turn[:, :, None], axis=1).swapaxes(0, 1)
        d, e, f = np.take_along_axis(depth[chosen], turn, axis=1).T
        on_ab, on_ac = (a + (d / (d - end_depth))[:, None] * (end - a) for end, end_depth in ((b, e), (c, f)))
        triangles = [(a, on_ab, on_ac)] if beyond == 1 else [(on_ab, b, c), (on_ab, c, on_ac)]
        parts += [np.stack(triangle, axis=1) for triangle in triangles]
    return np.concatenate(parts)


def mean_positive_part(values: Floats) -> Floats:
    """Return the mean over triangles of the positive part of a linear function, from its values at corners (N, 3).

    >>> mean_positive_part(np.array([[1.0, 2, 3], [-1, -2, -3], [-1, -1, 1]])).round(4).tolist()
    [2.0, 0.0, 0.0833]
    """
    a, b, c = np.sort(values, axis=1).T
    mean = np.where(a >= 0, (a + b + c) / 3, 0.0)
    one_above, two_above = (a < 0) & (b <= 0) & (c > 0), (a < 0) & (b > 0)
    mean[one_above] = c[one_above] ** 3 / (3 * (c[one_above] - a[one_above]) * (c[one_above] - b[one_above]))
    mean[two_above] = (a[two_above] + b[two_above] + c[two_above]) / 3 - a[two_above] ** 3 / (
        3 * (b[two_above] - a[two_above]) * (c[two_above] - a[two_above])
    )
    return mean
