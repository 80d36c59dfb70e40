"""Fill rings with well-shaped triangles, without adding corners, and build prisms on them."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.contours.straightening import simplify_contours
from infill.contours.strips import cut_strips
from infill.contours.zero_contours import Contours, trace_contours
from infill.errors import GeometryError
from infill.surface import Surface

Indices = NDArray[np.intp]

UNFILLED = "the outline cannot be filled with triangles; smooth less, or use walls of more cells"


def triangulate_rings(rings: Contours) -> Indices:
    """Fill the solid inside rings with counter-clockwise triangles, (T, 3) indices of corners.

    Parameters
    ----------
    rings : Contours
        Around solid counter-clockwise, around holes clockwise. Rings around different pieces may share sides.

    Raises
    ------
    GeometryError
        If the triangles would not fill the solid.

    Notes
    -----
    GEOS finds the constrained Delaunay triangulation of every piece: of all triangulations without further corners it
    has the largest smallest angle. The time grows with the square of a piece's corners.

    >>> square = Contours(points=np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), first=np.array([0, 4]))
    >>> len(triangulate_rings(square))
    2
    """
    areas = rings.areas
    try:
        coordinates = shapely.get_coordinates(shapely.constrained_delaunay_triangles(_polygons(rings, areas)))
    except shapely.GEOSException as error:
        raise GeometryError(UNFILLED) from error
    triangles = _point_indices(rings.points, coordinates.reshape(-1, 4, 2)[:, :3])
    a, b, c = (rings.points[triangles[:, i]] for i in range(3))
    doubled = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    triangles = np.where(doubled[:, None] > 0, triangles, triangles[:, ::-1])
    # A piece of n corners and h holes has n + 2 h - 2 triangles.
    expected = len(rings.points) + 2 * int((areas < 0).sum()) - 2 * int((areas > 0).sum())
    if len(triangles) != expected or not np.isclose(np.abs(doubled).sum() / 2, areas.sum(), rtol=1e-9):
        raise GeometryError(UNFILLED)
    return triangles


def _polygons(rings: Contours, areas: Floats) -> NDArray[np.object_]:
    """Build the polygons of the rings: every hole lies in the smallest shell around it."""
    counts = np.diff(rings.first)
    closed = np.insert(np.arange(len(rings.points)), rings.first[1:], rings.first[:-1])
    lines = shapely.linearrings(rings.points[closed], indices=np.repeat(np.arange(len(counts)), counts + 1))
    shells, holes = np.flatnonzero(areas > 0), np.flatnonzero(areas < 0)
    if len(holes) == 0:
        return np.asarray(shapely.polygons(lines))
    shells = shells[np.argsort(areas[shells], kind="stable")]
    tree = shapely.STRtree(shapely.polygons(lines[shells]))
    inner, outer = tree.query(shapely.points(rings.points[rings.first[holes]]), predicate="within")
    owner = np.full(len(holes), len(shells))
    np.minimum.at(owner, inner, outer)
    if (owner == len(shells)).any():
        raise GeometryError("a hole lies outside the solid; smooth less, or use walls of more cells")
    piece = np.concatenate([np.arange(len(shells)), owner])
    order = np.argsort(piece, kind="stable")  # the shell comes first
    return np.asarray(shapely.polygons(lines[np.concatenate([shells, holes])[order]], indices=piece[order]))


def _point_indices(points: Floats, corners: Floats) -> Indices:
    """Look up corners (..., 2) among points (N, 2); return one index for each, any where several points coincide."""
    key, sought = points @ (1, 1j), corners @ (1, 1j)
    order = np.argsort(key)
    return np.asarray(order[np.searchsorted(key, sought, sorter=order)])


def extrude_layer(
    layer: NDArray[np.floating],
    height: float,
    spacing: tuple[float, ...],
    *,
    origin: tuple[float, ...],
    tolerance: float,
) -> Surface:
    """Extrude the contours of {layer > 0}, simplified within a tolerance, mm: see `trace_contours`."""
    contours = trace_contours(layer, spacing, origin=origin)
    return extrude_contours(simplify_contours(contours, tolerance), height)


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
