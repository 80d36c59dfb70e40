"""The intermediate surfaces of a fill, for pictures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from PIL import Image

    from infill.interior.opening import Opening
    from infill.lattices.density_map import DensityMap
    from infill.pictures.sections import Cut
    from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class FillStages:
    """The stages of `infill.fill`.

    Parameters
    ----------
    part : Surface, mm
        The part; the result keeps its skin.
    voids : Surface, mm
        The voids taken out of it, facing outwards.
    shown : Surface, mm
        The resulting surface.
    opening : Opening or None
        Where the part has no shell.
    slicer : str, optional
        The slicer that a project is for: see `infill.save_project`.
    cuts : tuple of Cut
        Where a picture is cut open; by default where its inside is seen best.
    density : DensityMap, optional
        The requested density from place to place; None where it is the same.
    """

    part: Surface
    voids: Surface
    shown: Surface
    opening: Opening | None = None
    slicer: str | None = None
    cuts: tuple[Cut, ...] = ()
    density: DensityMap | None = None

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:  # noqa: ARG002 - of all stages
        """Draw cuts that show the inside: in a project, of the infill, as the part is whole."""
        from infill.pictures.cuts import draw_cuts

        return draw_cuts(self.shown, report, part=self.part, given=self.cuts)
