"""The layer below: its beads, which the paths of the next layer follow where they may choose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.paths.contact import sample_paths
from infill.paths.neighbours import BeadIndex, index_beads, project_to_beads
from infill.ragged import concatenate_rows


@dataclass(frozen=True, kw_only=True)
class LayerBelow:
    """Beads of the layer below.

    Parameters
    ----------
    lines, others : BeadIndex
        Its infill, and its other beads.
    reach : float, mm
        Half width of a bead: points within it lie on the bead.
    """

    lines: BeadIndex
    others: BeadIndex
    reach: float

    def holds(self, points: Floats) -> NDArray[np.bool_]:
        """Tell which points, (N, 2), mm, lie on the layer."""
        if not len(points):
            return np.zeros(0, dtype=np.bool_)
        return self._on(self.lines, points) | self._on(self.others, points)

    def _on(self, beads: BeadIndex, points: Floats) -> NDArray[np.bool_]:
        """Tell which points, (N, 2), lie on some beads."""
        is_supported: NDArray[np.bool_] = project_to_beads(points, beads, self.reach)[1] <= self.reach
        return is_supported


def index_layer_below(paths: Sequence[Floats], others: BeadIndex, line_width: float) -> LayerBelow:
    """Index the beads of a layer, to support the next one.

    Parameters
    ----------
    paths : sequence of (N, 2) float64, mm
        Its infill.
    others : BeadIndex
        Its other beads, as a single layer.
    line_width : float, mm

    >>> ground = index_layer_below([np.array([[0.0, 0.0], [10.0, 0.0]])], index_beads(np.array([[5.0, 2.0]])), 0.45)
    >>> ground.holds(np.array([[5.0, 0.2], [5.0, 0.3], [5.0, 1.9]])).tolist()
    [True, False, True]
    """
    samples = sample_paths(*concatenate_rows(list(paths), like=(2,)))
    return LayerBelow(lines=index_beads(samples.points, half=samples.half), others=others, reach=line_width / 2)
