"""What a block of infill was made from, stage by stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from PIL import Image
    from shapely import MultiLineString

    from infill.grid import Grid
    from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class LatticeStages:
    """The stages of a block that is filled as a part is.

    Parameters
    ----------
    box : Surface, mm
        The block if it were solid.
    """

    box: Surface

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return the block whole and cut open."""
        from infill.pictures.cuts import draw_block

        return draw_block(surface, self.box, report)


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

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return points, stamp, field and mesh side by side."""
        from infill.pictures.four_stages import draw_four_stages

        return draw_four_stages(
            points=self.points,
            grid=self.grid,
            stamp=self.stamp,
            smoothed=self.smoothed,
            surface=surface,
            report=report,
        )
