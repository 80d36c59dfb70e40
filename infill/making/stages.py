"""What a block of infill was made from, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from shapely import MultiLineString

    from infill.grid import Grid


@dataclass(frozen=True, kw_only=True, eq=False)
class MakeStages:
    """The stages of `infill.make`.

    Parameters
    ----------
    points : (N, 2) float64, mm
        Points along the lines of the pattern.
    lines : MultiLineString, mm
        The lines.
    grid : Grid
        The grid of one layer.
    stamp, smoothed : (nx, ny) float32
        The layer before and after smoothing, in [-1, 1].
    """

    points: NDArray[np.float64]
    lines: MultiLineString
    grid: Grid
    stamp: NDArray[np.float32]
    smoothed: NDArray[np.floating]
