"""The smoothed field of one chunk: the same values as those of the whole volume, to the last bit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk
from infill.isosurfaces.components import Components, data_bits, find_components
from infill.isosurfaces.levels import straighten_profile
from infill.kernels.sparse import BRICK, CELLS
from infill.phasefield.allen_cahn import Smoothing
from infill.phasefield.dense import Data
from infill.phasefield.refining import refine_bricks
from infill.phasefield.sparse import SparseField, brick_states, kept_bricks, smooth_bricks


@dataclass(frozen=True, kw_only=True, eq=False)
class ChunkField:
    """The bricks of a chunk and one brick around them, counted from the first of them.

    Parameters
    ----------
    field : SparseField
        As if the kept bricks were a volume of their own.
    own : (n,) bool
        The bricks of the field that belong to the chunk.
    begun : (n,) bool
        The bricks that were kept before the first step: in their order, components of the whole are numbered.
    """

    field: SparseField
    own: NDArray[np.bool_]
    begun: NDArray[np.bool_]

    def components(self, *, void: bool = False) -> Components:
        """Label the components of the solid cells, or of the void, in the kept bricks."""
        return find_components(self.field, data_bits(self.field, threads=1), void=void)


def smooth_chunk(
    data: NDArray[np.bool_] | NDArray[np.float32],
    chunk: Chunk,
    smoothing: Smoothing,
    spacing: tuple[float, ...],
    *,
    refined: bool,
    straighten: bool,
    threads: int,
) -> ChunkField | None:
    """Smooth the cells that were read for a chunk; return its field, or None if no surface can cross it.

    Parameters
    ----------
    data : (n0, n1, n2) bool, True solid; or float32 in [-1, 1]
        The cells from `chunk.cell_low` to `chunk.cell_high`.
    chunk : Chunk
    smoothing : Smoothing
    spacing : (hx, hy, hz)
    refined : bool
        Whether to refine: see `infill.phasefield.refining.refine_bricks`.
    straighten : bool
        Whether to convert the field to a distance: see `infill.isosurfaces.levels.straighten_profile`.
    threads : int
    """
    sign = uniform_sign(data)
    if sign < 0 or (sign > 0 and not chunk.touches_rim):
        return None
    _, state = brick_states(data, threads)
    begun = kept_bricks(state)
    low, high = (np.array(ends) - chunk.read_low for ends in (chunk.kept_low, chunk.kept_high))
    if refined:
        core = chunk.own_bricks
        smoothed = refine_bricks(data, smoothing, spacing=spacing, core=core, threads=threads)
    else:
        smoothed = smooth_bricks(data, smoothing, spacing=spacing, threads=threads)
    inside = ((smoothed.where >= low) & (smoothed.where < high)).all(axis=1)
    slots = smoothed.slots[tuple(slice(a, b) for a, b in zip(low, high, strict=True))].copy()
    number = np.cumsum(inside, dtype=np.int32) - np.int32(1)
    is_kept = slots >= 0
    slots[is_kept] = number[slots[is_kept]]
    where = np.ascontiguousarray(smoothed.where[inside])
    # The lattice of a volume of its own begins one cell before it.
    bricks, shape = np.array(BRICK), np.array(chunk.shape)
    own_shape = np.minimum(bricks * slots.shape - 1, shape - bricks * np.array(chunk.kept_low))
    along_x, along_y, along_z = (int(count) for count in own_shape)
    field = SparseField(
        shape=(along_x, along_y, along_z),
        slots=slots,
        where=(where - low).astype(np.int32),
        values=smoothed.values[inside],
        data=signs_of(smoothed.data[inside]),
    )
    if straighten:
        field = straighten_profile(field, out=field.values, threads=threads)
    return ChunkField(field=field, own=chunk.owns(field.where), begun=begun[tuple(where.T)])


def uniform_sign(data: NDArray[np.bool_] | NDArray[np.float32]) -> int:
    """Return 1 if data are solid throughout, -1 if they are void throughout, else 0; grey data are neither."""
    if data.max() == (False if data.dtype == bool else -1):
        return -1
    return 1 if data.min() == 1 else 0


def signs_of(data: Data) -> Data:
    """Return data as 1 where they are solid, above 0, and else -1, as int8."""
    return data if data.dtype == np.int8 else _signs(data > 0)


def _signs(bits: NDArray[np.bool_] | NDArray[np.uint8]) -> NDArray[np.int8]:
    """Return 1 for true, -1 for false."""
    return 2 * bits.view(np.int8) - np.int8(1)


def gather_data(chunk_field: ChunkField, chunk: Chunk, data: NDArray[np.float32]) -> ChunkField:
    """Return the data themselves in the bricks of a chunk's field, in place of its values.

    Parameters
    ----------
    chunk_field : ChunkField
    chunk : Chunk
    data : (n0, n1, n2) float32
        The cells from `chunk.cell_low` to `chunk.cell_high`.
    """
    field = chunk_field.field
    shift = np.array(chunk.kept_low) - np.array(chunk.read_low)
    read = replace(field, where=(field.where + shift).astype(np.int32))
    return replace(chunk_field, field=replace(field, values=read.gathered(data, threads=1)))


def pack_field(chunk_field: ChunkField) -> dict[str, NDArray[Any]]:
    """Return the arrays of a field, to keep in a file; the data as bits."""
    field = chunk_field.field
    return {
        "shape": np.array(field.shape),
        "slots": field.slots,
        "where": field.where,
        "values": field.values,
        "data": np.packbits(field.data.reshape(-1, CELLS) > 0, axis=1),
        "own": chunk_field.own,
        "begun": chunk_field.begun,
    }


def unpack_field(arrays: dict[str, NDArray[Any]]) -> ChunkField:
    """Return the field of `pack_field`."""
    along_x, along_y, along_z = arrays["shape"].tolist()
    data = _signs(np.unpackbits(arrays["data"], axis=1, count=CELLS))
    field = SparseField(
        shape=(along_x, along_y, along_z),
        slots=arrays["slots"],
        where=arrays["where"],
        values=arrays["values"],
        data=data.reshape(-1, *BRICK),
    )
    return ChunkField(field=field, own=arrays["own"], begun=arrays["begun"])
