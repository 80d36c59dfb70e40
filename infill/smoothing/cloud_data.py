"""What is smoothed of points on a surface: the cells that they enclose, and where in those the surface lies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.refining import cut_off, on_profile
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.placing import raw_surface
from infill.smoothing.request import Request
from infill.volume import Volume
from infill.voxels.partial import distances_in_cells
from infill.voxels.point_fields import near_points


def phase_of_points(
    solid: Volume, points: NDArray[np.float64], normals: NDArray[np.float64] | None, request: Request
) -> tuple[Volume, Volume, float]:
    """Return the phase field of the surface through points, which cells are solid by it, and its volume, mm³.

    Parameters
    ----------
    solid : Volume
        Cells that the points enclose, more or less.
    points, normals : (N, 3) float64, mm
        See `infill.voxels.point_fields.near_points`.
    request : Request

    Notes
    -----
    The distances near the points give a surface; all cells get their distance from that one. Its volume is a sum over
    cells that are solid by half a cell more than the distance of their centre, 0 at least and 1 at most: a surface of
    triangles encloses less where the points bend outwards.
    """
    near = replace(solid, values=near_points(solid, points, normals, threads=request.threads))
    found = replace(solid, values=np.asarray(near.values) > 0)
    near = replace(near, values=np.clip(near.values, -1, 1))
    volume = float(np.clip(np.asarray(near.values) + 0.5, 0, 1).sum(dtype=np.float64)) * solid.cell_volume
    field = smooth_bricks(near.values, Smoothing(steps=0), threads=request.threads)
    interface = request.smoothing.interface
    distance = distances_in_cells(
        raw_surface(field, near, request.threads), found, cut_off(interface), several=False, threads=request.threads
    )
    return replace(solid, values=on_profile(distance, interface, threads=request.threads)), found, volume
