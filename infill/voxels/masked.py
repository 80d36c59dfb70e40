"""Masked cells are void, whatever value lies under the mask."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray


def fill_masked_with_void(values: NDArray[Any], low: float | None, *, chosen: bool) -> NDArray[Any]:
    """Give masked cells a value that no threshold, range or label takes for solid; return a plain array.

    Parameters
    ----------
    values : array or numpy.ma.MaskedArray
        An array without a mask is returned unchanged.
    low : float, optional
        The lowest value that is solid, if there is a threshold or a range.
    chosen : bool
        Whether a threshold, a range or a label selects the solid; else void is False, 0 or -1.

    >>> fill_masked_with_void(np.ma.MaskedArray([3, 5, 9], mask=[False, False, True]), 4.0, chosen=True).tolist()
    [3, 5, 2]
    """
    # Code that made a masked array has loaded the module already; loading it takes 20 ms.
    if "numpy.ma" not in sys.modules or not isinstance(values, np.ma.MaskedArray):
        return np.asarray(values)
    data = np.asarray(values.data)
    masked = np.ma.getmaskarray(values)
    if not masked.any():
        return data
    visible = data[~masked]
    if data.dtype == bool:
        fill: Any = False
    elif not chosen:
        fill = -1 if (visible < 0).any() else 0
    else:
        lowest = float(visible.min()) if visible.size else 0.0
        fill = np.floor(min(lowest, lowest if low is None else low)) - 1
        fill = int(fill) if data.dtype.kind in "iu" else fill
    kind = data.dtype if data.dtype == bool else np.result_type(data.dtype, np.min_scalar_type(fill))
    filled: NDArray[Any] = np.where(masked, np.asarray(fill, dtype=kind), data.astype(kind, copy=False))
    return filled
