"""How deep below the walls the cells of a grid lie: as one array, or packed in slabs, of which few are looked at."""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from infill.volume import Volume

WHOLE = 12_000_000  # cells: spaces with fewer are kept as one array, which takes less time
SLAB, LEAST_LAYERS = 4_000_000, 24  # cells of a slab, and layers at least: with thinner ones, more are beside them
QUICKLY = 1  # of the levels of zlib
AT_ONCE = 1_000_000  # bytes that are unpacked
BITS = 8  # in a byte

Field = NDArray[np.float32]


@dataclass(frozen=True, kw_only=True, eq=False)
class Layers:
    """A field of numbers over a grid, from the bottom to the top.

    Parameters
    ----------
    shape : (nx, ny, nz)
        Cells of the grid.
    slabs : tuple of (nx, ny, n) float32 or of bytes
        One array of all layers; or packed, slabs of one thickness but for the last, and one object if they are alike.
    thick : int
        Layers of a slab.
    """

    shape: tuple[int, int, int]
    slabs: tuple[Field, ...] | tuple[bytes, ...]
    thick: int

    @classmethod
    def of(cls, whole: Field) -> Layers:
        """Return a field (nx, ny, nz) as it is."""
        nx, ny, nz = whole.shape
        return cls(shape=(nx, ny, nz), slabs=(whole,), thick=nz)

    @classmethod
    def packed(cls, slabs: Iterable[Field]) -> Layers:
        """Return a field given in slabs (nx, ny, n) from the bottom, of one thickness but for the last."""
        known: dict[bytes, bytes] = {}
        found, thickness = [], []
        for slab in slabs:
            few = _packed(slab)
            found.append(known.setdefault(few, few))
            thickness.append(slab.shape[2])
            nx, ny = slab.shape[:2]
        return cls(shape=(nx, ny, sum(thickness)), slabs=tuple(found), thick=thickness[0])

    @property
    def in_slabs(self) -> bool:
        """Whether it is packed."""
        return isinstance(self.slabs[0], bytes)

    def bounds(self) -> list[tuple[int, int]]:
        """Return the first layer of each slab, and the first one above it."""
        return list(pairwise([*range(0, self.shape[2], self.thick), self.shape[2]]))

    def each(self) -> Iterator[tuple[int, Field]]:
        """Yield the slabs (nx, ny, n), each with the number of its first layer."""
        for number, (low, _) in enumerate(self.bounds()):
            yield low, self._slab(number)

    def between(self, low: int, high: int) -> Field:
        """Return the layers from one up to, not including, another: (nx, ny, high - low)."""
        first, last = low // self.thick, (high - 1) // self.thick
        if first == last:
            begin = first * self.thick
            return np.ascontiguousarray(self._slab(first)[:, :, low - begin : high - begin])
        found = np.empty((*self.shape[:2], high - low), dtype=np.float32)
        for number in range(first, last + 1):
            begin = number * self.thick
            start, end = max(low, begin), min(high, begin + self.thick)
            found[:, :, start - low : end - low] = self._slab(number)[:, :, start - begin : end - begin]
        return found

    def alike(self, low: int, high: int) -> tuple[object, ...]:
        """Return what is equal for layers that are: they need not be looked at again."""
        first, last = low // self.thick, (high - 1) // self.thick
        return (low - first * self.thick, high - low, *(id(each) for each in self.slabs[first : last + 1]))

    def _slab(self, number: int) -> Field:
        slab = self.slabs[number]
        if not isinstance(slab, bytes):
            return slab
        nx, ny, nz = self.shape
        thick = min(self.thick, nz - number * self.thick)
        return _unpacked(slab, (nx, ny, thick))


def _packed(slab: Field) -> bytes:
    """Return a slab in few bytes: from layer to layer, the bits of numbers change by much the same."""
    steps = np.diff(np.ascontiguousarray(slab, dtype=np.float32).view(np.uint32), axis=2, prepend=np.uint32(0))
    return zlib.compress(steps.data, QUICKLY)


def _unpacked(few: bytes, shape: tuple[int, int, int]) -> Field:
    """Return the slab that was packed, bit for bit."""
    numbers, unpacking, begin = np.empty(shape, dtype=np.uint32), zlib.decompressobj(), 0
    room = numbers.reshape(-1).view(np.uint8)
    while begin < len(room):
        some = np.frombuffer(unpacking.decompress(few, AT_ONCE), dtype=np.uint8)
        room[begin : begin + len(some)] = some
        begin, few = begin + len(some), unpacking.unconsumed_tail
    np.cumsum(numbers, axis=2, dtype=np.uint32, out=numbers)
    return numbers.view(np.float32)


def in_slabs(cells: Volume) -> Iterator[Volume]:
    """Yield a volume of booleans whose cells have equal sides in slabs, from the bottom.

    A bit is kept for each cell, and nothing of the volume if nobody else has it.
    """
    size, (nx, ny, nz) = float(cells.cell_size[0]), cells.values.shape
    thick = max(LEAST_LAYERS, math.ceil(SLAB / (nx * ny)))
    x, y, z = cells.origin
    bits = np.packbits(cells.values.astype(np.bool_, copy=False), axis=2)
    few = replace(cells, values=cells.values[:1, :1, :1].copy())
    del cells
    for low in range(0, nz, thick):
        first, high = low // BITS, min(low + thick, nz)
        some = np.unpackbits(bits[:, :, first : -(-high // BITS)], axis=2).view(np.bool_)
        some = some[:, :, low - first * BITS : high - first * BITS]
        yield replace(few, values=some, origin=(x, y, z + low * size))
