"""Extrude contours into a solid: vertical walls between two flat caps."""

from __future__ import annotations

import numpy as np

from infill.contours.strips import cut_strips
from infill.contours.triangulation import triangulate_rings
from infill.contours.zero_contours import Contours
from infill.surface import Surface


def extrude_contours(contours: Contours, height: float, *, base: float = 0.0) -> Surface:
    """Extrude contours from z = `base` to `base` + `height`, mm; return the solid inside them.

    Every edge of a contour becomes a rectangle of two triangles; both caps have the same triangles. Long contours get
    additional corners, where the caps are cut into strips: see `infill.contours.strips`.

    Raises
    ------
    GeometryError
        If the caps cannot be filled.

    >>> square = Contours(points=np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), first=np.array([0, 4]))
    >>> cube = extrude_contours(square, 1)
    >>> len(cube.faces), cube.closed, cube.volume
    (12, True, 1.0)
    """
    pieces = cut_strips(contours)
    rings = pieces.contours
    cap = pieces.order[triangulate_rings(Contours(points=rings.points[pieces.order], first=pieces.first))]
    count, ahead = len(rings.points), rings.ahead
    corner = np.arange(count)
    walls = [[corner, ahead, ahead + count], [corner, ahead + count, corner + count]]
    faces = [cap[:, ::-1], cap + count, *(np.stack(wall, axis=1) for wall in walls)]
    vertices = np.empty((2 * count, 3))
    vertices[:count, :2] = vertices[count:, :2] = rings.points
    vertices[:count, 2], vertices[count:, 2] = base, base + height
    return Surface(vertices=vertices, faces=np.concatenate(faces).astype(np.int32))
