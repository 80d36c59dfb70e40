"""The phase field of a surface through points: cells that they enclose, and the place of the surface in these."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import cut_off_distance, phase_from_distance
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.placing import raw_surface
from infill.smoothing.request import SmoothRequest
from infill.volume import Volume
from infill.voxels.partial import distances_in_cells
from infill.voxels.point_fields import cell_distances


def phase_field_of_points(
    solid: Volume, points: NDArray[np.float64], normals: NDArray[np.float64] | None, request: SmoothRequest
) -> tuple[Volume, Volume, float]:
    """Return the phase field of the surface through points, the cells that it encloses, and its volume, mm³.

    Parameters
    ----------
    solid : Volume
        Cells that the points enclose, more or less.
    points, normals : (N, 3) float64, mm
        See `infill.voxels.point_fields.cell_distances`.
    request : SmoothRequest

    Notes
    -----
    The distances near the points give a surface; all cells get their distance from it. Its volume is the sum over
    cells of the signed distance of their centre plus half a cell, clipped to 0 and 1: a surface of triangles encloses
    less where the points bend outwards.
    """
    distances = replace(solid, values=cell_distances(solid, points, normals, threads=request.threads))
    inside = replace(solid, values=np.asarray(distances.values) > 0)
    distances = replace(distances, values=np.clip(distances.values, -1, 1))
    volume = float(np.clip(np.asarray(distances.values) + 0.5, 0, 1).sum(dtype=np.float64)) * solid.cell_volume
    field = smooth_bricks(distances.values, Smoothing(steps=0), threads=request.threads)
    interface = request.smoothing.interface
    distance = distances_in_cells(
        raw_surface(field, distances, request.threads),
        inside,
        cut_off_distance(interface),
        several=False,
        threads=request.threads,
    )
    return replace(solid, values=phase_from_distance(distance, interface, threads=request.threads)), inside, volume
