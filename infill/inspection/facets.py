"""Flat facets of a coarse mesh that its smoothed surface still has, and the smoothing that would round them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.meshes.distance import TriangleTree
from infill.surface import Surface

if TYPE_CHECKING:
    from infill.reports.smoothing import FlatFacetKeys

SAMPLES = 1000  # facets, evenly by area
NARROWEST = 2.0  # cells: narrower triangles are not seen as facets
BENDS = (math.radians(3.0), math.radians(45.0))  # between facets of a curved surface; a larger bend is a sharp edge
NEAR_CORNER = 0.6  # of the way from the middle of a facet to a corner, where a smooth surface has turned by 0.6 bends
FLAT = 0.3  # of a bend: half of that
LEAST_SHARE = 0.5  # of the surface
RADIUS = 0.35  # of the width of a facet, measured: a quarter leaves facets, a half takes details
WALL_PER_RADIUS = 2.1  # walls as thick stay: 5 cells, where 20 steps, a radius of 2.4 cells, remove those of 3
MOST_CELLS = 2.5  # in a radius: finer cells make refinement keep the edges between facets, as it does with any edge


@dataclass(frozen=True, kw_only=True)
class FlatFacets:
    """Facets of a mesh that are as flat in the result as they were.

    Parameters
    ----------
    share : float
        Their share of the surface of the mesh.
    width : float, mm
        Half of their area has this width or less.
    radius : float, mm
        Radius of smoothing that rounds them.
    voxel : float, mm
        Size of the cells for that radius: with finer ones, the edges between facets are kept.
    """

    share: float
    width: float
    radius: float
    voxel: float

    def facts(self) -> FlatFacetKeys:
        """Return the numbers by name, for the report."""
        return {"share": self.share, "width": self.width, "radius": self.radius, "voxel": self.voxel}


def find_flat_facets(mesh: Surface, result: Surface, *, cell: float, threads: int | None = None) -> FlatFacets | None:
    """Find the facets of a mesh that its smoothed surface still has; return None if that is less than half of it.

    A facet is a triangle that meets a neighbour at 3 to 45 degrees. It is still flat if the result, near the corners of
    the facet, has turned by less than 0.3 of that angle: on a smooth surface through the same corners it turns by 0.6.

    Parameters
    ----------
    mesh, result : Surface, mm
    cell : float, mm
        Size of the cells on which the mesh was smoothed; facets narrower than two of them do not count.
    threads : int, optional
        See `infill.kernels.threads.thread_count`.
    """
    corners = np.asarray(mesh.vertices, dtype=np.float64)[mesh.faces]
    normals, areas = _unit_normals(corners)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    widths = 2 * areas / np.maximum(longest, np.finfo(float).tiny)
    picked = _pick_evenly(areas)
    if np.median(widths[picked]) < NARROWEST * cell:
        return None
    bends = _facet_bends(mesh.faces, normals)[picked]
    middles = corners[picked].mean(axis=1, keepdims=True)
    points = middles + NEAR_CORNER * (corners[picked] - middles)
    nearest = TriangleTree.of(result).nearest(points.reshape(-1, 3), threads=threads)[1]
    found = _unit_normals(np.asarray(result.vertices, dtype=np.float64)[result.faces[nearest]])[0].reshape(-1, 3, 3)
    cosines = np.abs(np.einsum("nkd,nd->nk", found, normals[picked]))  # the mesh may be inside out
    turned = np.arccos(np.clip(cosines, 0.0, 1.0)).max(axis=1)
    flat = (bends > 0) & (turned < FLAT * bends) & (widths[picked] >= NARROWEST * cell)
    share = float(flat.mean())
    if share < LEAST_SHARE:
        return None
    width = float(np.median(widths[picked][flat]))
    radius = RADIUS * width
    return FlatFacets(share=share, width=width, radius=radius, voxel=max(cell, radius / MOST_CELLS))


def _unit_normals(corners: Floats) -> tuple[Floats, Floats]:
    """Return the unit normals of triangles (N, 3, 3), 0 where there is no area, and their areas, mm²."""
    products = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(products, axis=1)
    return products / np.maximum(doubled, np.finfo(float).tiny)[:, None], doubled / 2


def _pick_evenly(areas: Floats) -> NDArray[np.intp]:
    """Return the triangles at equal steps of the area, each as often as its area is worth."""
    upto = np.cumsum(areas)
    steps = (np.arange(SAMPLES) + 0.5) / SAMPLES * upto[-1]
    picked: NDArray[np.intp] = np.searchsorted(upto, steps).clip(max=len(areas) - 1)
    return picked


def _facet_bends(faces: NDArray[np.integer], normals: Floats) -> Floats:
    """Return the largest bend, radians, from each face to a neighbour, of those within `BENDS`; 0 without one."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    order = np.lexsort(edges.T)
    shared = (edges[order[1:]] == edges[order[:-1]]).all(axis=1)
    one, other = order[1:][shared] // 3, order[:-1][shared] // 3
    angles = np.arccos(np.clip(np.einsum("ij,ij->i", normals[one], normals[other]), -1.0, 1.0))
    angles[(angles < BENDS[0]) | (angles > BENDS[1])] = 0.0
    bends = np.zeros(len(faces))
    for face in (one, other):
        np.maximum.at(bends, face, angles)
    return bends
