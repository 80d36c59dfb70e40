"""The voids beside walls that change from layer to layer: one on either side, or one around all of them.

Walls between two voids need no cell of the grid in them; around all of them, the grid resolves the walls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Interior
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.bodies import Bodies
from infill.lattices.grading import Grading, LocalWidths
from infill.lattices.voids import FIELD, local_widths

WIDER_LINES = 1.5  # range of line widths for which distances suffice, over the width they were made for

Floats = NDArray[np.float64]


class LinesByLayer(Protocol):
    """Lines in every layer of a space."""

    def lines(self, space: Interior, cell: float) -> list[Floats]:
        """Return the lines in each layer, for cells of a size, mm: (S, 2, 2), in cells from the first centre."""
        ...

    def sides(self, space: Interior, cell: float) -> Iterator[NDArray[np.bool_]]:
        """Yield a mask of the cells (nx, ny) on one side of the lines for each layer; nothing without sides."""
        ...

    def widths(self, density: float) -> float:
        """See `Voids`."""
        ...

    @property
    def two_sided(self) -> bool:
        """True if lines have two sides, and no ends."""
        ...

    @property
    def steepest(self) -> float:
        """Largest distance of a line from that of the layer above, in cells."""
        ...

    def sharpest(self, space: Interior, cell: float) -> float:
        """Return the angle of the sharpest corners between lines, degrees: see `Voids`."""
        ...

    def about(self, middle: Floats) -> Self:
        """See `Anchored`."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class _Distances:
    """Distances of cells from lines along their layer, up to a limit, in cells: negative on one of two sides."""

    space: Interior
    cell: float
    away: FIELD
    reach: float


@dataclass(frozen=True, kw_only=True)
class NonPrismatic:
    """The voids beside walls along lines that change from layer to layer.

    Parameters
    ----------
    layers : LinesByLayer
    threads : int, optional
    grading : Grading, optional
    bodies : Bodies, optional
        Set if the pattern starts over in each component of the part.
    local : LocalWidths, optional
        Widths in the space, once they are computed.
    distances : _Distances, optional
        For a space and a cell, once they are computed.
    """

    layers: LinesByLayer
    threads: int | None = None
    grading: Grading | None = None
    bodies: Bodies | None = None
    local: LocalWidths | None = None
    distances: _Distances | None = None

    def prepare(self, space: Interior, *, cell: float, width: float) -> NonPrismatic:
        """See `Voids`."""
        if self.bodies is not None:
            return replace(self, bodies=self.bodies.prepare(self, space, cell=cell, width=width))
        return replace(self, distances=self._distances(space, cell, width))

    def with_widths(self, local: LocalWidths) -> NonPrismatic:
        """See `Voids`."""
        return replace(self, local=local, bodies=self.bodies and self.bodies.with_widths(local))

    @property
    def around(self) -> bool:
        """True if one void lies around all walls, so that cells of the grid must resolve the walls."""
        return not self.layers.two_sided

    def sharpest(self, space: Interior, *, cell: float, width: float) -> float:
        """See `Voids`."""
        if self.bodies is not None:
            return self.bodies.sharpest(self, space, cell=cell, width=width)
        return self.layers.sharpest(space, cell)

    def about(self, middle: Floats) -> NonPrismatic:
        """Return the same lines, shifted by a vector, mm: see `Anchored`."""
        return replace(self, layers=self.layers.about(middle), bodies=None, distances=None)

    def count(self, space: Interior, *, cell: float, width: float) -> int:
        """Count the fields: one for each side, or one around all walls."""
        if self.bodies is not None:
            return self.bodies.count(self, space, cell=cell, width=width)
        return 1 if self.around else 2

    def into(self, out: FIELD, space: Interior, which: int, *, cell: float, width: float) -> float:
        """See `Voids`."""
        from infill.kernels.layered import from_layers

        if self.bodies is not None:
            return self.bodies.into(self, out, space, which, cell=cell, width=width)
        ratio, step = local_widths(self, space)
        half = width / 2 / space.size
        distances = self._distances(space, cell, width)
        filled = in_threads(
            from_layers,
            space.depth,
            -BAND,
            distances.away,
            distances.reach,
            self.layers.steepest,
            1.0 if which == 0 else -1.0,
            half,
            ratio,
            step,
            out,
            threads=thread_count(self.threads),
        )
        return float(sum(filled))

    def widths(self, density: float) -> float:
        """See `Voids`."""
        return self.layers.widths(density)

    def _distances(self, space: Interior, cell: float, width: float) -> _Distances:
        """Return distances that suffice for walls of a width, mm, where they are widest."""
        from infill.kernels.layered import distances_to_lines

        half = float(local_widths(self, space)[0].max()) * (width / 2 / space.size)
        # Along a layer, cells within the band of a leaning wall are further away by its slope.
        reach = (half + 2 * BAND) * float(np.hypot(1.0, self.layers.steepest))
        known = self.distances
        if known is not None and known.space is space and known.cell == cell and known.reach >= reach:
            return known
        lines = self.layers.lines(space, cell)
        offsets = np.cumsum([0, *map(len, lines)])
        away = np.empty(space.shape, dtype=np.float32)
        reach *= WIDER_LINES
        segments = np.concatenate([np.empty((0, 2, 2)), *lines])
        in_threads(distances_to_lines, segments, offsets, reach, away, threads=thread_count(self.threads))
        for layer, side in enumerate(self.layers.sides(space, cell)):
            away[:, :, layer] *= np.where(side, np.float32(1), np.float32(-1))
        return _Distances(space=space, cell=cell, away=away, reach=reach)
