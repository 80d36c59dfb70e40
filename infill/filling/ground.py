"""What the paths of a layer lie on, so that those of the next layer run above them where they may choose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.filling.contact import sampled
from infill.filling.surroundings import Walls, foot, walls_of
from infill.ragged import packed

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Ground:
    """The infill of the layer below.

    Parameters
    ----------
    lines : Walls
    reach : float, mm
        How far from a centre line a point still lies on its bead.
    """

    lines: Walls
    reach: float

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """Return which points, (N, 2), mm, lie on it."""
        if not len(points):
            return np.zeros(0, dtype=np.bool_)
        held: NDArray[np.bool_] = foot(points, self.lines)[1] <= self.reach
        return held


def ground_of(paths: Sequence[Floats], line_width: float) -> Ground | None:
    """Return what some paths are to the next layer; None without any.

    >>> ground = ground_of([np.array([[0.0, 0.0], [10.0, 0.0]])], 0.45)
    >>> ground.holds(np.array([[5.0, 0.2], [5.0, 0.3]])).tolist()
    [True, False]
    """
    if not paths:
        return None
    some = sampled(*packed(list(paths)))
    return Ground(lines=walls_of(some.points, half=some.half), reach=line_width / 2)
