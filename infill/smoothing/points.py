"""Smooth points: the cells that they enclose, and the place of the surface within these."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.errors import GeometryError, ParameterError
from infill.inspection.deviation import LOST
from infill.meshes.distance import distances
from infill.plain_numbers import plain_argument, plain_place
from infill.smoothing.comparing import summarise_distances
from infill.smoothing.meshes import MARGIN
from infill.smoothing.request import SmoothRequest, Way
from infill.smoothing.scans import scan_ways
from infill.smoothing.stages import surface_of_data
from infill.volume import Volume
from infill.voxels.from_points import voxelise_points
from infill.voxels.partial import phase_field_of_mesh
from infill.voxels.point_fields import cell_distances

if TYPE_CHECKING:
    from infill.reports.smoothing import InputKeys, PointDistances, SmoothReport, VerdictKeys
    from infill.result import Result
    from infill.smoothing.stages import SmoothStages

NEIGHBOURS = 6  # of a point on a surface: if all of them are as far away as it is, it is no outlier


def points_ways(
    points: NDArray[np.float64], request: SmoothRequest, *, voxel: float, shell: float | None, normals: ArrayLike | None
) -> list[Way]:
    """Voxelise a cloud of points, and list the ways to smooth it, the preferred one first.

    Parameters
    ----------
    points : (N, 3) float64, mm
    request : SmoothRequest
    voxel, shell, normals
        See `infill.smooth_points`.

    Raises
    ------
    ParameterError
        If there is not one normal for each point, or they are given for a shell.
    """
    checked_normals = None if normals is None else _check_normals(normals, points, shell)
    scan = solid = voxelise_points(
        points, voxel=voxel, shell=shell, margin=MARGIN, max_memory=request.max_memory, threads=request.threads
    )
    volume, phase = None, shell is None and request.method != "plain"
    if phase:
        scan, solid, volume = _phase_field(solid, points, checked_normals, request)
    facts: InputKeys = {
        "source": "points",
        "points": len(points),
        "shell": shell,
        "normals": normals is not None,
    }
    return scan_ways(scan, solid, {"method": "points"}, facts, request, phase=phase, volume=volume)


def _check_normals(normals: ArrayLike, points: NDArray[np.float64], shell: float | None) -> NDArray[np.float64]:
    """Check normals and return them as an array, with zeros where they are not finite."""
    if shell is not None:
        raise ParameterError("a shell lies on both sides of the points and takes no normals; leave one of them out")
    array = np.asarray(normals, dtype=np.float64)
    if array.shape != points.shape:
        raise ParameterError(f"the normals have the shape {array.shape} and the points {points.shape}; give one each")
    return np.where(np.isfinite(array).all(axis=1, keepdims=True), array, 0.0)


def _phase_field(
    solid: Volume, points: NDArray[np.float64], normals: NDArray[np.float64] | None, request: SmoothRequest
) -> tuple[Volume, Volume, float]:
    """Return the phase field of the surface through points, the cells that it encloses, and its volume, mm³.

    The distances near the points give a surface; all cells get their distance from it. Its volume is the sum over
    cells of the signed distance of their centre plus half a cell, clipped to 0 and 1: a surface of triangles encloses
    less where the points bend outwards.
    """
    threads, interface = request.threads, request.smoothing.interface
    place = replace(solid, values=cell_distances(solid, points, normals, threads=threads))
    inside = replace(solid, values=np.asarray(place.values) > 0)
    place = replace(place, values=np.clip(place.values, -1, 1))
    volume = float(np.clip(np.asarray(place.values) + 0.5, 0, 1).sum(dtype=np.float64)) * solid.cell_volume
    surface = surface_of_data(place, threads)
    return phase_field_of_mesh(surface, inside, interface, several=False, threads=threads), inside, volume


def compare_with_points(
    result: Result[SmoothStages, SmoothReport], cloud: NDArray[np.float64], voxel: float, request: SmoothRequest
) -> Result[SmoothStages, SmoothReport]:
    """Add the distances of the points from the surface to the report, and to the verdict; return the result.

    Parameters
    ----------
    result : Result
        Its surface should run through the points.
    cloud : (N, 3) float64, mm
    voxel : float, mm
        Points further than two of these from the surface are reported; they are lost if all their neighbours are too.
    request : SmoothRequest

    Raises
    ------
    GeometryError
        If points are lost, unless broken results are allowed.
    """
    distance = distances(cloud, result.surface, threads=request.threads)
    far_points = np.flatnonzero(distance > LOST * voxel)
    facts: PointDistances = {
        **summarise_distances(distance),
        "p95": float(np.quantile(distance, 0.95)),
        "at": cloud[int(distance.argmax())].tolist(),
        "far": len(far_points),
        "lost": 0,
    }
    verdict: VerdictKeys = {**result.report["verdict"]}
    if len(far_points):
        from scipy.spatial import cKDTree

        _, neighbours = cKDTree(cloud).query(cloud[far_points], k=min(NEIGHBOURS + 1, len(cloud)))
        lost = (distance[neighbours] > LOST * voxel).all(axis=1)
        facts["lost"] = int(lost.sum())
        phrase = (
            f"{len(far_points):,} of {len(cloud):,} points lie over {plain_argument(LOST)} voxels from the surface, up "
            f"to {plain_argument(facts['max'], 3)} mm, at {plain_place(facts['at'])}"
        )
        if lost.any() and not request.allow_broken:
            raise GeometryError(
                f"{phrase}: what they lie on is too narrow for points this far apart; give more points, --shell for a "
                "narrow volume around them, or --allow-broken to have it anyway"
            )
        word = "lost" if lost.any() or verdict["word"] == "lost" else "changed a little"
        verdict = {**verdict, "word": word, "changes": [*verdict["changes"], phrase]}
    report: SmoothReport = {
        **result.report,
        "verdict": verdict,
        "distance": {**result.report["distance"], "points": facts},
    }
    if facts["lost"]:
        report["problems"] = [*report["problems"], phrase]
    return replace(result, report=report)
