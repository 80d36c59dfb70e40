"""Hilbert's curve: one line that visits the squares of a lattice, each after a neighbour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from infill.errors import ParameterError
from infill.paths.families.protocol import TOUCH, Bounds, Path
from patterns.errors import PatternError
from patterns.hilbert import hilbert_curve


@dataclass(frozen=True, kw_only=True)
class HilbertPaths:
    """The one curve of order 24 about (0, 0), in squares of side `cell`, as far as the box reaches."""

    name: str = "hilbert"
    summary: str = "one line that folds itself through the region, equally stiff in both directions"
    prismatic: bool = True
    wide: bool = True

    def strands(
        self,
        bounds: Bounds,
        *,
        cell: float,
        line_width: float,  # noqa: ARG002 - lines stand alone
        z: float,  # noqa: ARG002 - every layer is equal
        layer: int,  # noqa: ARG002
        radius: float,  # noqa: ARG002 - corners need no room
    ) -> list[Path]:
        """Return the parts of the curve in the box; see `Family`."""
        try:
            return hilbert_curve(np.array(bounds), cell)
        except PatternError as error:
            raise ParameterError.like(error) from error

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the radius at which the arcs of a step meet, mm: of corners taken wide."""
        return cell
