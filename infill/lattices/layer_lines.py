"""Lines of a pattern that change with height, layer by layer of a grid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.interior.interior import BAND, Interior
from infill.lattices.fillets import sharpest_angle
from infill.lattices.line_sample import SAMPLE, LineSample, centred_square, corner_angles, line_segments
from patterns.protocol import LEVEL_SET, LevelSet, Pattern, draw_lines, gives, with_cell

LOOKED_AT = 8  # heights at which corners are looked at
STEEPEST = 1.75  # slope of a wall, 60 degrees: lines that move by more from layer to layer belong to another wall

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LayerLines:
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

    @cached_property
    def sample(self) -> LineSample:
        """A sample of the lines at one height, far from any skin."""
        return LineSample(pattern=self.pattern)

    @property
    def two_sided(self) -> bool:
        """True if a level set gives the side of the lines on which a point lies."""
        return LEVEL_SET in gives(self.pattern)

    @property
    def steepest(self) -> float:
        """See `LinesByLayer`."""
        return STEEPEST

    def sharpest(self, space: Interior, cell: float) -> float:
        """See `Voids`: corners of a few cells at several heights inside the walls."""
        pattern, heights = with_cell(self.pattern, cell), self._heights(space)[(space.depth > 0).any(axis=(0, 1))]
        region = centred_square(SAMPLE / 2 * cell)
        sampled = np.linspace(heights[0], heights[-1], min(LOOKED_AT, len(heights)))
        angles = [corner_angles(draw_lines(pattern, region, float(z)), region, cell=cell) for z in sampled]
        return sharpest_angle(np.concatenate(angles))

    def widths(self, density: float) -> float:
        """See `Voids`: those of one height."""
        return self.sample.widths(density)

    def about(self, middle: Floats) -> LayerLines:
        """See `Anchored`."""
        return replace(self, anchor=middle + self.anchor)

    def lines(self, space: Interior, cell: float) -> list[Floats]:
        """See `LinesByLayer`."""
        pattern, start = with_cell(self.pattern, cell), space.origin[:2] - self.anchor[:2]
        depth, segments = space.depth, []
        for layer, z in enumerate(self._heights(space)):
            used = np.argwhere(depth[:, :, layer] > -BAND)
            if not len(used):
                segments.append(np.empty((0, 2, 2)))
                continue
            low, high = (start + space.size * end for end in (used.min(axis=0), used.max(axis=0)))
            lines = draw_lines(pattern, shapely.box(*(low - cell), *(high + cell)), float(z))
            segments.append(line_segments(shapely.get_parts(lines), start, space.size))
        return segments

    def sides(self, space: Interior, cell: float) -> Iterator[NDArray[np.bool_]]:
        """See `LinesByLayer`."""
        pattern = with_cell(self.pattern, cell)
        if not isinstance(pattern, LevelSet):
            return
        nx, ny, _ = space.shape
        x, y = (space.origin[i] - self.anchor[i] + space.size * np.arange(n) for i, n in enumerate((nx, ny)))
        across, along = np.meshgrid(x, y, indexing="ij")
        for z in self._heights(space):
            yield pattern.level_set(across, along, np.full_like(across, z)) > 0

    def _heights(self, space: Interior) -> Floats:
        """Return the heights of the middles of layers in the pattern, mm."""
        heights: Floats = space.origin[2] - self.anchor[2] + space.size * np.arange(space.shape[2])
        return heights
