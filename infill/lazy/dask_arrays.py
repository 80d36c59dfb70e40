"""Dask arrays: any of three axes, [x, y, z]."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import InfillError, ParameterError
from infill.lazy.volume import read_error


def is_dask(array: object) -> bool:
    """Tell whether something is a Dask array, without loading Dask."""
    module = sys.modules.get("dask.array")
    return module is not None and isinstance(array, module.Array)


def require_readable_anywhere(array: Any) -> None:  # noqa: ANN401 - dask.array.Array
    """Raise ParameterError for an array that is persisted on a cluster: its tasks cannot wait for one another."""
    for layer in array.dask.layers.values():
        value = next(iter(getattr(layer, "mapping", {}).values()), None)
        if type(value).__module__.startswith("distributed"):
            raise ParameterError(
                "the array is persisted on a cluster, where tasks cannot read it; leave persist out, or store it"
            )


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

    @property
    def grain(self) -> tuple[int, ...]:
        """Cells of a chunk along each axis."""
        return tuple(int(count) for count in self.array.chunksize)

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Compute the cells of a box, in the task that asks for it."""
        try:
            return np.ascontiguousarray(self.array[box].compute(scheduler="synchronous"))
        except InfillError:
            raise
        except Exception as error:
            raise read_error("the array", box, error) from error
