"""Depths of the cells of a grid below the walls: as one array, or packed in slabs, of which few are open at once."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeVar

import numpy as np

from infill.arrays import Field
from infill.volume import Volume

WHOLE = 12_000_000  # cells: spaces with fewer are kept as one array, which takes less time
SLAB, LEAST_LAYERS = (
    4_000_000,
    24,
)  # cells of a slab, and least number of layers: thinner slabs have more layers beside them
QUICKLY = 1  # fastest level of zlib
AT_ONCE = 1_000_000  # bytes that are unpacked at a time
BITS = 8  # in a byte

Outcome = TypeVar("Outcome")


@dataclass(frozen=True, kw_only=True, eq=False)
class LayerStack:
    """Numbers at the cells of a grid, layer by layer from the bottom to the top.

    Parameters
    ----------
    shape : (nx, ny, nz)
        Cells of the grid.
    slabs : tuple of (nx, ny, n) float32 or of bytes
        One array of all layers; or packed slabs of one thickness, except the last; equal slabs are one object.
    thick : int
        Number of layers in a slab.
    """

    shape: tuple[int, int, int]
    slabs: tuple[Field, ...] | tuple[bytes, ...]
    thick: int

    @classmethod
    def of(cls, whole: Field) -> LayerStack:
        """Wrap a field (nx, ny, nz) without copying it."""
        nx, ny, nz = whole.shape
        return cls(shape=(nx, ny, nz), slabs=(whole,), thick=nz)

    @classmethod
    def packed(cls, slabs: Iterable[Field]) -> LayerStack:
        """Pack a field that comes in slabs (nx, ny, n) from the bottom, of one thickness except the last."""
        unique: dict[bytes, bytes] = {}
        packed_slabs, thickness = [], []
        for slab in slabs:
            packed_slab = _pack(slab)
            packed_slabs.append(unique.setdefault(packed_slab, packed_slab))
            thickness.append(slab.shape[2])
            nx, ny = slab.shape[:2]
        return cls(shape=(nx, ny, sum(thickness)), slabs=tuple(packed_slabs), thick=thickness[0])

    @property
    def in_slabs(self) -> bool:
        """True if packed."""
        return isinstance(self.slabs[0], bytes)

    def bounds(self) -> list[tuple[int, int]]:
        """Return the first layer of each slab, and the first layer above it."""
        return list(pairwise([*range(0, self.shape[2], self.thick), self.shape[2]]))

    def read_slabs(self) -> Iterator[tuple[int, Field]]:
        """Yield the slabs (nx, ny, n), each with the number of its first layer."""
        for number, (low, _) in enumerate(self.bounds()):
            yield low, self._read_slab(number)

    def read_layers(self, low: int, high: int) -> Field:
        """Return the layers from `low` up to, not including, `high`: (nx, ny, high - low)."""
        low_slab, high_slab = low // self.thick, (high - 1) // self.thick
        if low_slab == high_slab:
            begin = low_slab * self.thick
            return np.ascontiguousarray(self._read_slab(low_slab)[:, :, low - begin : high - begin])
        layers = np.empty((*self.shape[:2], high - low), dtype=np.float32)
        for number in range(low_slab, high_slab + 1):
            begin = number * self.thick
            start, end = max(low, begin), min(high, begin + self.thick)
            layers[:, :, start - low : end - low] = self._read_slab(number)[:, :, start - begin : end - begin]
        return layers

    def map_slabs(
        self, function: Callable[[Field, int, int], Outcome], *, below: int = 0, above: int = 0
    ) -> list[tuple[int, Outcome]]:
        """Apply a function to each slab with some layers beside it, once for all that are alike.

        Parameters
        ----------
        function : callable
            Takes layers (nx, ny, n), and the numbers of the first layer of the slab in them and of the first above it.
        below, above : int
            Number of layers beside the slab.

        Returns
        -------
        list of (int, outcome)
            With the number of the first layer of each slab.
        """
        outcomes: dict[tuple[object, ...], Outcome] = {}
        results = []
        for low, high in self.bounds():
            first, last = max(0, low - below), min(self.shape[2], high + above)
            key = (low - first, high - first, *self.layer_key(first, last))
            if key not in outcomes:
                outcomes[key] = function(self.read_layers(first, last), low - first, high - first)
            results.append((low, outcomes[key]))
        return results

    def layer_key(self, low: int, high: int) -> tuple[object, ...]:
        """Return a key that is equal for equal layers, so that these are computed once."""
        low_slab, high_slab = low // self.thick, (high - 1) // self.thick
        return (low - low_slab * self.thick, high - low, *(id(slab) for slab in self.slabs[low_slab : high_slab + 1]))

    def _read_slab(self, number: int) -> Field:
        """Return a slab by its number, unpacked: (nx, ny, n)."""
        slab = self.slabs[number]
        if not isinstance(slab, bytes):
            return slab
        nx, ny, nz = self.shape
        thick = min(self.thick, nz - number * self.thick)
        return _unpack(slab, (nx, ny, thick))


def _pack(slab: Field) -> bytes:
    """Compress a slab: from layer to layer, the bits of numbers change by similar steps."""
    steps = np.diff(np.ascontiguousarray(slab, dtype=np.float32).view(np.uint32), axis=2, prepend=np.uint32(0))
    return zlib.compress(steps.data, QUICKLY)


def _unpack(packed: bytes, shape: tuple[int, int, int]) -> Field:
    """Decompress a slab, bit for bit."""
    numbers, unpacking, begin = np.empty(shape, dtype=np.uint32), zlib.decompressobj(), 0
    buffer = numbers.reshape(-1).view(np.uint8)
    while begin < len(buffer):
        chunk = np.frombuffer(unpacking.decompress(packed, AT_ONCE), dtype=np.uint8)
        buffer[begin : begin + len(chunk)] = chunk
        begin, packed = begin + len(chunk), unpacking.unconsumed_tail
    np.cumsum(numbers, axis=2, dtype=np.uint32, out=numbers)
    return numbers.view(np.float32)


def split_into_slabs(cells: Volume) -> Iterator[Volume]:
    """Yield a volume of booleans, whose cells have equal sides, in slabs from the bottom.

    Only a bit is kept for each cell, so that the volume can be freed if the caller drops it.
    """
    size, (nx, ny, nz) = float(cells.cell_size[0]), cells.values.shape
    thick = max(LEAST_LAYERS, math.ceil(SLAB / (nx * ny)))
    x, y, z = cells.origin
    bits = np.packbits(cells.values.astype(np.bool_, copy=False), axis=2)
    template = replace(cells, values=cells.values[:1, :1, :1].copy())
    del cells
    for low in range(0, nz, thick):
        low_byte, high = low // BITS, min(low + thick, nz)
        values = np.unpackbits(bits[:, :, low_byte : -(-high // BITS)], axis=2).view(np.bool_)
        values = values[:, :, low - low_byte * BITS : high - low_byte * BITS]
        yield replace(template, values=values, origin=(x, y, z + low * size))
