"""Spirals: one line, in to the middle of the part and out again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from infill.paths.families.protocol import TOUCH, Bounds, Path

if TYPE_CHECKING:
    from patterns.spirals import Spiral


@dataclass(frozen=True, kw_only=True)
class Spirals:
    """A spiral of `patterns.spirals`, its turns `cell` apart.

    It lies about `middle`, mm, or else about the middle of the box, turned by `angle` degrees. `middle` should be
    that of the entire part in every layer. The spiral itself goes from its middle as far as the box reaches.
    """

    name: str
    summary: str
    prismatic: bool = True
    wide: bool = False
    middle: tuple[float, float] | None = None
    angle: float = 0.0

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
        """Return the spiral; see `Family`."""
        from patterns.linework import turn

        box = np.array(bounds, dtype=np.float64).reshape(2, 2)
        middle = box.mean(axis=0) if self.middle is None else np.array(self.middle)
        reach = float(np.hypot(*np.abs(box - middle).max(axis=0))) / cell
        return [turn(self._pattern().drawn(reach) * cell, self.angle) + middle]

    def cell_for(self, density: float, line_width: float) -> float:
        """Return the cell for a density; see `Family`."""
        return TOUCH * line_width / density

    def largest_radius(self, cell: float, line_width: float) -> float:  # noqa: ARG002
        """Return the distance between turns, mm: larger arcs would take the tips off the stars."""
        return cell

    def _pattern(self) -> Spiral:
        from patterns.spirals import ArchimedeanChords, OctagramSpiral

        kinds: tuple[type[Spiral], ...] = (ArchimedeanChords, OctagramSpiral)
        return {kind.name: kind for kind in kinds}[self.name]()


ARCHIMEDEAN_CHORDS = Spirals(
    name="archimedean-chords", summary="a round spiral about the middle of the part; one line without a corner"
)
OCTAGRAM_SPIRAL = Spirals(
    name="octagram-spiral", summary="a spiral of eight-pointed stars: walls in four directions, in one line", wide=True
)
