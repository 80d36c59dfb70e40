"""The solid cells of a chunk, the same that `infill.voxels.segmentation` finds in the whole volume."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.voxels.segmentation import scale_values


@dataclass(frozen=True, kw_only=True)
class SolidRule:
    """The rule by which a cell is solid.

    Parameters
    ----------
    low, high : float, optional
        Solid is low <= value <= high; a side that is None is open.
    labels : tuple of int, optional
        Solid is every cell with one of these values, whatever `low` and `high`.
    phase : bool
        Solid is every cell above 0, whatever else.
    """

    low: float | None = None
    high: float | None = None
    labels: tuple[int, ...] | None = None
    phase: bool = False

    def mark(self, values: NDArray[Any]) -> NDArray[np.bool_]:
        """Mark the solid cells of a part of the volume.

        >>> SolidRule(low=2.5).mark(np.array([2, 3])).tolist()
        [False, True]
        """
        if self.phase:
            return np.asarray(values > 0)
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


@dataclass(frozen=True, kw_only=True)
class GreyScale:
    """The scale of grey values: see `infill.voxels.segmentation.scale_grey_values`.

    Parameters
    ----------
    level : float
        Value at the surface.
    window : float or None
        Difference of values from void to solid; None for a phase field, which is taken as it is.
    """

    level: float = 0.0
    window: float | None = None

    def scale(self, values: NDArray[Any]) -> NDArray[np.float32]:
        """Return data in [-1, 1] for a part of the volume.

        >>> GreyScale(level=50, window=100).scale(np.array([0, 25, 100])).tolist()
        [-1.0, -0.5, 1.0]
        """
        if self.window is None:
            return values.astype(np.float32)
        return scale_values(values, self.level, self.window)
