"""The voids beside walls that change from layer to layer: one on either side, or one around all of them.

Walls between two voids need no cell of the grid in them; around all of them, the grid resolves the walls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from infill.interior.interior import BAND, Space
from infill.kernels.threads import in_threads, thread_count
from infill.lattices.bodies import Bodies
from infill.lattices.grading import Grading
from infill.lattices.voids import FIELD, local_widths

WIDER_LINES = 1.5  # than lines may be for which the same distances will do, over those they were made for

Floats = NDArray[np.float64]


class LineLayers(Protocol):
    """Lines in every layer of a space."""

    def lines(self, space: Space, cell: float) -> list[Floats]:
        """Return the lines in each layer, for cells of a size, mm: (S, 2, 2), in cells from the first centre."""
        ...

    def sides(self, space: Space, cell: float) -> Iterator[NDArray[np.bool_]]:
        """Yield for each layer which cells (nx, ny) are on one of two sides of the lines; nothing if there are none."""
        ...

    def widths(self, density: float) -> float:
        """See `Voids`."""
        ...

    @property
    def two_sided(self) -> bool:
        """Whether lines have two sides, and no ends."""
        ...

    @property
    def steepest(self) -> float:
        """How far a line lies from that of the layer above, in cells, at most."""
        ...

    def sharpest(self, space: Space, cell: float) -> float:
        """See `Voids`."""
        ...

    def about(self, middle: Floats) -> Self:
        """See `Anchored`."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class _Away:
    """How far cells lie from lines, along their layer, up to a distance, in cells: below 0 on one of two sides."""

    space: Space  # which this keeps, so that no other gets its number
    away: FIELD
    reach: float


@dataclass(frozen=True, kw_only=True)
class Layered:
    """The voids beside walls along lines that change from layer to layer.

    Parameters
    ----------
    layers : LineLayers
    threads : int, optional
    grading : Grading, optional
    bodies : Bodies, optional
        How it begins anew in each component of the part.
    known : dict
        Distances, for a space and a cell.
    """

    layers: LineLayers
    threads: int | None = None
    grading: Grading | None = None
    bodies: Bodies | None = None
    known: dict[tuple[int, float], _Away] = field(default_factory=dict)

    @property
    def around(self) -> bool:
        """Whether one void lies around all walls, so that cells of the grid must resolve these."""
        return not self.layers.two_sided

    def sharpest(self, space: Space, *, cell: float, width: float) -> float:
        """See `Voids`."""
        if self.bodies is not None:
            return self.bodies.sharpest(self, space, cell=cell, width=width)
        return self.layers.sharpest(space, cell)

    def about(self, middle: Floats) -> Layered:
        """See `Anchored`."""
        return replace(self, layers=self.layers.about(middle), bodies=None, known={})

    def count(self, space: Space, *, cell: float, width: float) -> int:
        """One for each side, or one around all walls."""
        if self.bodies is not None:
            return self.bodies.count(self, space, cell=cell, width=width)
        return 1 if self.around else 2

    def into(self, out: FIELD, space: Space, which: int, *, cell: float, width: float) -> float:
        """See `Voids`."""
        from infill.kernels.layered import from_layers

        if self.bodies is not None:
            return self.bodies.into(self, out, space, which, cell=cell, width=width)
        ratio, step = local_widths(self, space)
        half = width / 2 / space.size
        found = self._away(space, cell, float(ratio.max()) * half)
        filled = in_threads(
            from_layers,
            space.depth,
            -BAND,
            found.away,
            found.reach,
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

    def _away(self, space: Space, cell: float, half: float) -> _Away:
        """Return distances that suffice for walls whose widest half is so wide, in cells."""
        from infill.kernels.layered import beside_lines

        # Along a layer, what lies within the band of a leaning wall is as much further away.
        reach = (half + 2 * BAND) * float(np.hypot(1.0, self.layers.steepest))
        key = id(space), cell
        if key not in self.known or self.known[key].reach < reach:
            self.known.clear()
            lines = self.layers.lines(space, cell)
            first = np.cumsum([0, *map(len, lines)])
            away = np.empty(space.shape, dtype=np.float32)
            reach *= WIDER_LINES
            segments = np.concatenate([np.empty((0, 2, 2)), *lines])
            in_threads(beside_lines, segments, first, reach, away, threads=thread_count(self.threads))
            for layer, one in enumerate(self.layers.sides(space, cell)):
                away[:, :, layer] *= np.where(one, np.float32(1), np.float32(-1))
            self.known[key] = _Away(space=space, away=away, reach=reach)
        return self.known[key]
