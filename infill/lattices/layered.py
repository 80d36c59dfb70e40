"""Walls that change from layer to layer: a void on either side of them, or one around all of them.

Walls between two voids need no cell of the grid in them; around all of them, the grid resolves the walls.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property, partial

import numpy as np
import shapely
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.interior.interior import BAND, Interior
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.branching import BranchLines
from infill.lattices.fillets import sharpest_angle
from infill.lattices.line_sample import SAMPLE, LineSample, centred_square, corner_angles, line_segments
from infill.lattices.voids import Layout, VoidFields
from patterns.protocol import LEVEL_SET, LevelSet, Pattern, draw_lines, gives, with_cell

LOOKED_AT = 8  # heights at which corners are looked at
STEEPEST = 1.75  # slope of a wall, 60 degrees: lines that move by more from layer to layer belong to another wall
WIDER_LINES = 1.5  # range of line widths for which distances suffice, over the width they were made for


@dataclass(frozen=True, kw_only=True, eq=False)
class _Distances:
    """Distances of cells from lines along their layer, up to a limit, in cells: negative on one of two sides."""

    away: NDArray[np.float32]
    reach: float
    find_sharpest: Callable[[], float]


@dataclass(frozen=True, kw_only=True)
class NonPrismatic:
    """Walls along lines that change from layer to layer.

    Parameters
    ----------
    layers : LayerLines or BranchLines
    """

    layers: LayerLines | BranchLines

    @property
    def around(self) -> bool:
        """True if one void lies around all walls, so that cells of the grid must resolve the walls."""
        return isinstance(self.layers, BranchLines) or LEVEL_SET not in gives(self.layers.pattern)

    def widths(self, density: float) -> float:
        """Return the width of lines, in cells, that gives a density far from any skin."""
        return self.layers.widths(density)

    def draw(self, layout: Layout, known: VoidFields | None = None) -> VoidFields:
        """Draw a field for each side, or one around all walls."""
        from infill.kernels.layered import from_layers

        layers, (ratio, step) = self.layers, layout.ratio
        # Along a layer, cells within the band of a leaning wall are further away by its slope.
        reach = (float(ratio.max()) * layout.half + 2 * BAND) * float(np.hypot(1.0, layers.steepest))
        distances = layout.basis_of(known)
        if not (isinstance(distances, _Distances) and distances.reach >= reach):
            distances = self._measure(layout, WIDER_LINES * reach)
        walls, signs = (-BAND, distances.away, distances.reach, layers.steepest), (1.0,) if self.around else (1.0, -1.0)
        return VoidFields(
            layout=layout,
            kernels=tuple((from_layers, (*walls, sign, layout.half, ratio, step)) for sign in signs),
            find_sharpest=distances.find_sharpest,
            basis=distances,
        )

    def _measure(self, layout: Layout, reach: float) -> _Distances:
        """Measure how far each cell lies from the lines of its layer, in cells up to `reach`; negative on one side."""
        from infill.kernels.layered import distances_to_lines

        space, lines = layout.space, self.layers.lines(layout.space, layout.cell)
        away = np.empty(space.shape, dtype=np.float32)
        segments = np.concatenate([np.empty((0, 2, 2)), *lines])
        offsets = np.cumsum([0, *map(len, lines)])
        in_threads(distances_to_lines, segments, offsets, reach, away, threads=thread_count(layout.threads))
        sides = () if isinstance(self.layers, BranchLines) else self.layers.sides(space, layout.cell)
        for layer, side in enumerate(sides):
            away[:, :, layer] *= np.where(side, np.float32(1), np.float32(-1))
        return _Distances(
            away=away, reach=reach, find_sharpest=cache(partial(self.layers.sharpest, space, layout.cell))
        )


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
    def steepest(self) -> float:
        """Largest distance of a line from that of the layer above, in cells."""
        return STEEPEST

    def sharpest(self, space: Interior, cell: float) -> float:
        """Find the angle of the sharpest corners, degrees, in a few cells at several heights inside the walls."""
        pattern, heights = with_cell(self.pattern, cell), self._heights(space)[(space.depth > 0).any(axis=(0, 1))]
        region = centred_square(SAMPLE / 2 * cell)
        sampled = np.linspace(heights[0], heights[-1], min(LOOKED_AT, len(heights)))
        angles = [corner_angles(draw_lines(pattern, region, float(z)), region, cell=cell) for z in sampled]
        return sharpest_angle(np.concatenate(angles))

    def widths(self, density: float) -> float:
        """Return the width of lines, in cells, that gives a density far from any skin, as measured at one height."""
        return self.sample.widths(density)

    def lines(self, space: Interior, cell: float) -> list[Floats]:
        """Draw the lines in each layer, for cells of a size, mm: (S, 2, 2), in cells from the first centre."""
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
        """Yield a mask of the cells (nx, ny) on one side of the lines for each layer; nothing without sides."""
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
