"""The volume that grey values enclose at the threshold, between the voxels: a measure beside that of the mask."""

from __future__ import annotations

from typing import TYPE_CHECKING

from infill.smoothing.stages import surface_of_data
from infill.voxels.segmentation import scale_grey_values

if TYPE_CHECKING:
    from infill.reports.smoothing import Isosurface
    from infill.volume import Volume


def compare_with_isosurface(volume: float, scan: Volume, level: float, threads: int | None) -> Isosurface:
    """Compare a volume, mm³, with that inside the isosurface of the unsmoothed grey values.

    Parameters
    ----------
    volume : float
        Of the result, mm³.
    scan : Volume
        Grey values, solid above `level`.
    level : float
    threads : int, optional

    Returns
    -------
    Isosurface
        Its change is None where the isosurface encloses nothing.
    """
    enclosed = surface_of_data(scale_grey_values(scan, level), threads).volume
    return {"volume": enclosed, "change": volume / enclosed - 1 if enclosed > 0 else None}
