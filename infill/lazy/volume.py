"""A volume that stays where it is, and reads a box of cells when it is asked for one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.errors import FormatError, MemoryLimitError
from infill.machine import require_memory
from infill.volume import AXES, Volume
from infill.voxels.cropping import cells_in_box, cut_cells

BYTES_PER_CELL = 5  # besides the cells themselves: the mask of solid cells, and grey values as 32-bit numbers
EXTRA = "pip install dask distributed fsspec h5py zarr"
ADVICE = "give --workers N, which works in chunks, or a coarser level of it"
TOGETHER_ADVICE = "give --workers N, which smooths labels together in chunks, or a coarser level of it"

Box = tuple[tuple[int, int, int], tuple[int, int, int]]  # low, and high


class LazyArray(Protocol):
    """Three axes of numbers, [x, y, z], that can be sent to other processes."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""


@dataclass(frozen=True, kw_only=True)
class LazyVolume:
    """An array that is not read yet, and its place in space.

    Parameters
    ----------
    array : LazyArray
    spacing, origin, direction, space
        As in `infill.Volume`.
    name : str
        Where it is, for messages.
    warnings : tuple of str
        Assumptions of the reader, a line each.
    """

    array: LazyArray
    spacing: tuple[float, ...] = (1.0, 1.0, 1.0)
    origin: tuple[float, ...] = (0.0, 0.0, 0.0)
    direction: ArrayLike = field(default_factory=lambda: np.eye(AXES))
    space: str = ""
    name: str = "the array"
    warnings: tuple[str, ...] = ()

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells along each axis."""
        along_x, along_y, along_z = self.array.shape
        return along_x, along_y, along_z

    @property
    def cell_volume(self) -> float:
        """Volume of a cell, mm³."""
        return float(np.prod(np.array(self.spacing)))

    def require_room(self, limit: int | None = None, advice: str = ADVICE) -> None:
        """Raise MemoryLimitError if the cells and what is made of them need more bytes than a limit, or are free."""
        cells = int(np.prod(np.array(self.shape, dtype=np.float64)))
        require_memory(cells * (self.array.dtype.itemsize + BYTES_PER_CELL), limit, advice)

    def load(self, limit: int | None = None, advice: str = ADVICE) -> Volume:
        """Read all cells; raise MemoryLimitError with advice if they do not fit into memory, or a limit, bytes."""
        self.require_room(limit, advice)
        values = self.array.read(tuple(slice(0, count) for count in self.shape))
        return self.place(values)

    def crop(self, roi: tuple[float, ...]) -> LazyVolume:
        """Return the part of the volume in a box: see `infill.voxels.cropping.crop`; no cell is read."""
        whole = self.place(np.broadcast_to(np.uint8(0), self.shape))
        return self.cut(*cells_in_box(whole, roi))

    def cut(self, low: tuple[int, ...], high: tuple[int, ...]) -> LazyVolume:
        """Return the cells from `low` up to but without `high`, in the same place; no cell is read."""
        corner = cut_cells(self.place(np.broadcast_to(np.uint8(0), self.shape)), low, high).origin
        return replace(self, array=BoxArray(self.array, low, high), origin=corner)

    def place(self, values: NDArray[Any]) -> Volume:
        """Return values on the grid of this volume, in its place."""
        return Volume(
            values=values,
            spacing=self.spacing,
            origin=self.origin,
            direction=self.direction,
            space=self.space,
            warnings=self.warnings,
        )


@dataclass(frozen=True)
class BoxArray:
    """A box of another array.

    Parameters
    ----------
    array : LazyArray
    low, high : (3,) int
        From which cell, up to but without which.
    """

    array: LazyArray
    low: tuple[int, ...]
    high: tuple[int, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Cells along each axis."""
        return tuple(end - begin for begin, end in zip(self.low, self.high, strict=True))

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return self.array.dtype

    @property
    def grain(self) -> tuple[int, ...] | None:
        """Cells of a chunk of the other array."""
        return getattr(self.array, "grain", None)

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""
        return self.array.read(
            tuple(slice(part.start + along_x, part.stop + along_x) for part, along_x in zip(box, self.low, strict=True))
        )


def require_volume(name: str, shape: tuple[int, ...], kind: np.dtype[Any]) -> None:
    """Raise FormatError unless an array has three axes with cells, and real numbers or booleans."""
    if len(shape) != AXES or 0 in shape:
        raise FormatError(f"{name} holds an array of shape {shape}; give one with three axes, with cells")
    if kind.kind not in "biuf":
        raise FormatError(f"{name} holds values of type {kind}; save numbers or booleans")


def read_error(name: str, box: tuple[slice, ...], error: Exception) -> FormatError | MemoryLimitError:
    """Return the error for cells that cannot be read."""
    cells = ", ".join(f"{part.start} to {part.stop - 1}" for part in box)
    if isinstance(error, MemoryError):
        return MemoryLimitError(f"{name} needs more memory for its cells {cells} than there is; {ADVICE}")
    text = " ".join(str(error).split())[:200] or type(error).__name__
    return FormatError(f"{name} is damaged: its cells {cells} cannot be read ({text}); copy or save it again")


def grain_of(array: LazyArray) -> tuple[int, ...]:
    """Return the sides of the boxes of cells that are read at once, whatever is asked for: chunks, pages or layers."""
    sides = getattr(array, "grain", None) or (64, 64, array.shape[2])
    return tuple(max(1, min(side, count)) for side, count in zip(sides, array.shape, strict=True))


def whole_boxes(array: LazyArray, most: int) -> Iterator[Box]:
    """Yield boxes (low, high) that make up an array, of up to `most` cells, of whole grains where these are smaller.

    They are as long as possible along z, then y, then x: rows along z are seldom divided.
    """
    sides = list(grain_of(array))
    for axis in (0, 1):  # grains larger than that are read in parts
        sides[axis] = max(1, min(sides[axis], most // max(1, math.prod(sides) // sides[axis])))
    sides[2] = max(1, min(sides[2], most // (sides[0] * sides[1])))
    for axis in (2, 1, 0):
        times = max(1, most // math.prod(sides))
        sides[axis] = min(array.shape[axis], sides[axis] * times)
    for low in product(*(range(0, count, side) for count, side in zip(array.shape, sides, strict=True))):
        high = tuple(min(begin + side, count) for begin, side, count in zip(low, sides, array.shape, strict=True))
        yield low, high  # type: ignore[misc]
