"""Hints before a mesh is smoothed by way of voxels: a mesh filter may serve better."""

from __future__ import annotations

import logging

import numpy as np

from infill.surface import Surface
from infill.voxels.from_mesh import VoxelisedMesh

LOG = logging.getLogger("infill")
DENSE = 2  # voxels: a mesh whose edges are longer in the mean has no detail to keep


def hint_at_filters(surface: Surface, voxelised: VoxelisedMesh) -> None:
    """Log a hint to "infill" if a filter of the mesh itself may stay nearer to it than voxels.

    That is so for a closed mesh of one component, without overlaps, whose edges are shorter than two voxels in the
    mean: filters move the corners of such a mesh, while voxels take its noise for its shape.

    Parameters
    ----------
    surface : Surface, mm
        The input mesh.
    voxelised : VoxelisedMesh
        The cells inside it.
    """
    edge_length, cell_size = mean_edge_length(surface), float(voxelised.volume.cell_size.max())
    if edge_length >= DENSE * cell_size or voxelised.several or voxelised.repairs.holes:
        return
    LOG.info(
        "hint: the mesh is closed, and its edges (%.3g mm in the mean) are short for voxels of %.3g mm; if it is a "
        "noisy scan, a filter of the mesh itself, such as Taubin's or Humphrey's in trimesh, keeps its triangles and "
        "may be nearer",
        edge_length,
        cell_size,
    )


def mean_edge_length(surface: Surface) -> float:
    """Return the mean edge length over all faces, mm.

    >>> round(mean_edge_length(Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))), 6)
    1.414214
    """
    corners = np.asarray(surface.vertices, dtype=np.float64)[surface.faces]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())
