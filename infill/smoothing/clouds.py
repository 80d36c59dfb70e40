"""Compare a result with the points it was made from: the voxels do not show what a shell around them filled."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import GeometryError
from infill.inspection.fidelity import LOST
from infill.meshes.distance import distances
from infill.smoothing.placing import summarise_distances

if TYPE_CHECKING:
    from infill.report_keys import PointDistances, SmoothReport, VerdictKeys
    from infill.result import Result
    from infill.smoothing.request import SmoothRequest
    from infill.smoothing.stages import SmoothStages

NEIGHBOURS = 6  # of a point on a surface: if all of them are as far away as it is, it is no outlier


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
            f"{len(far_points):,} of {len(cloud):,} points lie over {LOST:g} voxels from the surface, up to "
            f"{facts['max']:.3g} mm, at ({', '.join(f'{part:.4g}' for part in facts['at'])})"
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
