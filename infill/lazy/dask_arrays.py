"""Dask arrays: any of three axes, [x, y, z]."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import InfillError
from infill.lazy.volume import read_error


def is_dask(array: object) -> bool:
    """Tell whether something is a Dask array, without loading Dask."""
    module = sys.modules.get("dask.array")
    return module is not None and isinstance(array, module.Array)


@dataclass(frozen=True)
class DaskArray:
    """A Dask array.

    Parameters
    ----------
    array : dask.array.Array
    """

    array: Any

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis."""
        return tuple(int(count) for count in self.array.shape)

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        kind: np.dtype[Any] = np.dtype(self.array.dtype)
        return kind

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Compute the cells of a box, in the task that asks for it."""
        try:
            return np.ascontiguousarray(self.array[box].compute(scheduler="synchronous"))
        except InfillError:
            raise
        except Exception as error:
            raise read_error("the array", box, error) from error
