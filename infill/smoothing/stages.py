"""What a smooth solid was made from, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from infill.surface import Surface
    from infill.surfaces.levels import Levelled
    from infill.volume import Volume


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothStages:
    """The stages of `infill.smooth_volume`, `infill.smooth_mesh` and `infill.smooth_points`.

    Parameters
    ----------
    data : Volume
        What is solid on the grid, and where the grid lies in space.
    levelled : Levelled
        The smoothed field in bricks, the surface in cells of the grid, and the level of each component.
    given : Surface, optional
        The mesh that was given, mm.
    """

    data: Volume
    levelled: Levelled
    given: Surface | None = None
