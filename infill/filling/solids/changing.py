"""Lines of a pattern that are others at every height, layer by layer of a grid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.filling.solids.drawn_voids import Drawn, sized
from infill.filling.solids.space import BAND, Space
from patterns.protocol import LEVEL_SET, LevelSet, Pattern, gives, lines_of

STEEPEST = 1.75  # of a wall, which is 60 degrees: what moves by more from layer to layer is another one

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Changing:
    """The lines of a pattern in every layer of a space.

    Parameters
    ----------
    pattern : Pattern
        Its cell does not matter.
    anchor : (3,) float64
        The point of the part that is (0, 0, 0) of the pattern, mm.
    """

    pattern: Pattern
    anchor: Floats

    @property
    def two_sided(self) -> bool:
        """Whether a level set says on which side of the lines a point lies."""
        return LEVEL_SET in gives(self.pattern)

    @property
    def steepest(self) -> float:
        """See `LineLayers`."""
        return STEEPEST

    @property
    def sharpest(self) -> float:
        """See `Voids`: that of one height."""
        return self._drawn.sharpest

    def widths(self, density: float) -> float:
        """See `Voids`: those of one height."""
        return self._drawn.widths(density)

    def about(self, middle: Floats) -> Changing:
        """See `Anchored`."""
        return replace(self, anchor=middle + self.anchor)

    def lines(self, space: Space, cell: float) -> list[Floats]:
        """See `LineLayers`."""
        pattern, start = sized(self.pattern, cell), space.origin[:2] - self.anchor[:2]
        found = []
        for layer, z in enumerate(self._heights(space)):
            used = np.argwhere(space.depth[:, :, layer] > -BAND)
            if not len(used):
                found.append(np.empty((0, 2, 2)))
                continue
            low, high = (start + space.size * end for end in (used.min(axis=0), used.max(axis=0)))
            lines = lines_of(pattern, shapely.box(*(low - cell), *(high + cell)), float(z))
            points, line = shapely.get_coordinates(shapely.get_parts(lines), return_index=True)
            points = (points - start) / space.size
            joined = np.flatnonzero(line[1:] == line[:-1])
            found.append(np.stack([points[joined], points[joined + 1]], axis=1))
        return found

    def sides(self, space: Space, cell: float) -> Iterator[NDArray[np.bool_]] | None:
        """See `LineLayers`."""
        pattern = sized(self.pattern, cell)
        return self._sides(pattern, space) if isinstance(pattern, LevelSet) else None

    def _sides(self, pattern: LevelSet, space: Space) -> Iterator[NDArray[np.bool_]]:
        nx, ny, _ = space.shape
        x, y = (space.origin[i] - self.anchor[i] + space.size * np.arange(n) for i, n in enumerate((nx, ny)))
        across, along = np.meshgrid(x, y, indexing="ij")
        for z in self._heights(space):
            yield pattern.level_set(across, along, np.full_like(across, z)) > 0

    def _heights(self, space: Space) -> Floats:
        """Return how high the middles of layers lie in the pattern, mm."""
        found: Floats = space.origin[2] - self.anchor[2] + space.size * np.arange(space.shape[2])
        return found

    @property
    def _drawn(self) -> Drawn:
        return Drawn(pattern=self.pattern, anchor=self.anchor, share=0.0)
