"""The solid cells of a chunk, the same that `infill.voxels.segmentation` finds in the whole volume."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class SolidRule:
    """The rule by which a cell is solid.

    Parameters
    ----------
    low, high : float, optional
        Solid is low <= value <= high; a side that is None is open.
    labels : tuple of int, optional
        Solid is every cell with one of these values, whatever `low` and `high`.
    """

    low: float | None = None
    high: float | None = None
    labels: tuple[int, ...] | None = None

    def mark(self, values: NDArray[Any]) -> NDArray[np.bool_]:
        """Mark the solid cells of a part of the volume.

        >>> SolidRule(low=2.5).mark(np.array([2, 3])).tolist()
        [False, True]
        """
        if self.labels is not None:
            solid = np.zeros(values.shape, dtype=bool)
            for label in self.labels:
                solid |= values == label
            return solid
        if values.dtype == bool and self.low is None and self.high is None:
            return values
        low, high = self.low, self.high
        if values.dtype.kind in "iu":  # compared as whole numbers: nothing is converted
            low = math.ceil(low) if low is not None and math.isfinite(low) else low
            high = math.floor(high) if high is not None and math.isfinite(high) else high
        solid = np.ones(values.shape, dtype=bool) if low is None else np.asarray(values >= low)
        if high is not None:
            solid &= values <= high
        return solid
