"""The layer below: its beads, which the paths of the next layer follow where they may choose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.paths.contact import sampled
from infill.paths.neighbours import Walls, foot, walls_of
from infill.ragged import packed

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Ground:
    """Beads of the layer below.

    Parameters
    ----------
    lines, others : Walls
        Its infill, and its other beads.
    reach : float, mm
        Half width of a bead: points within it lie on the bead.
    """

    lines: Walls
    others: Walls
    reach: float

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """Tell which points, (N, 2), mm, lie on the layer."""
        if not len(points):
            return np.zeros(0, dtype=np.bool_)
        return self._on(self.lines, points) | self._on(self.others, points)

    def _on(self, beads: Walls, points: Floats) -> NDArray[np.bool_]:
        is_supported: NDArray[np.bool_] = foot(points, beads)[1] <= self.reach
        return is_supported


def ground_of(paths: Sequence[Floats], others: Walls, line_width: float) -> Ground:
    """Index the beads of a layer, to support the next one.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
        Its infill.
    others : Walls
        Its other beads, as a single layer.
    line_width : float, mm

    >>> ground = ground_of([np.array([[0.0, 0.0], [10.0, 0.0]])], walls_of(np.array([[5.0, 2.0]])), 0.45)
    >>> ground.holds(np.array([[5.0, 0.2], [5.0, 0.3], [5.0, 1.9]])).tolist()
    [True, False, True]
    """
    samples = sampled(*packed(list(paths), like=(2,)))
    return Ground(lines=walls_of(samples.points, half=samples.half), others=others, reach=line_width / 2)
