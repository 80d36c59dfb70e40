"""Parallel lines, turned by a right angle from layer to layer."""

from __future__ import annotations

from dataclasses import dataclass

from infill.paths.families.protocol import TOUCH, Bounds, Path
from infill.paths.families.waves import Rows, Wave, draw_rows


@dataclass(frozen=True, kw_only=True)
class RectilinearPaths:
    """Lines at 45° in even layers and at 135° in odd ones, `cell` apart: each rests on all those that it crosses."""

    name: str = "rectilinear"
    summary: str = "straight lines, across one another from layer to layer; quick to print"
    prismatic: bool = False
    wide: bool = False

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,  # noqa: ARG002 - lines stand alone
        z: float,  # noqa: ARG002 - the layer's number decides the direction
        layer: int,
        radius: float,  # noqa: ARG002 - there are no corners
    ) -> list[Path]:
        """Return one line per row; see `Family`."""
        line = Wave(period=cell, bottom=cell, top=0, height=0)
        return draw_rows(Rows(waves=[line], pitch=cell, slip=0, angle=(45, 135)[layer % 2]), bounds)

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return half of the distance between lines, mm: the radius of a turn at the wall."""
        return cell / 2
