"""The smoothed field of one chunk: the same values as those of the whole volume, to the last bit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.chunks.layout import Chunk
from infill.isosurfaces.components import Components, data_bits, find_components
from infill.isosurfaces.levels import straighten_profile
from infill.kernels.sparse import BRICK, CELLS
from infill.phasefield.allen_cahn import Smoothing
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
    solid: NDArray[np.bool_],
    chunk: Chunk,
    smoothing: Smoothing,
    spacing: tuple[float, ...],
    *,
    straighten: bool,
    threads: int,
) -> ChunkField | None:
    """Smooth the cells that were read for a chunk; return its field, or None if no surface can cross it.

    Parameters
    ----------
    solid : (n0, n1, n2) bool
        The cells from `chunk.cell_low` to `chunk.cell_high`.
    chunk : Chunk
    smoothing : Smoothing
    spacing : (hx, hy, hz)
    straighten : bool
        Whether to convert the field to a distance: see `infill.isosurfaces.levels.straighten_profile`.
    threads : int
    """
    if not solid.any() or (solid.all() and not chunk.touches_rim):
        return None
    _, state = brick_states(solid, threads)
    begun = kept_bricks(state)
    smoothed = smooth_bricks(solid, smoothing, spacing=spacing, threads=threads)
    low, high = (np.array(ends) - chunk.read_low for ends in (chunk.kept_low, chunk.kept_high))
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
        data=smoothed.data[inside],
    )
    if straighten:
        field = straighten_profile(field, out=field.values, threads=threads)
    return ChunkField(field=field, own=chunk.owns(field.where), begun=begun[tuple(where.T)])


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
    data = np.where(np.unpackbits(arrays["data"], axis=1, count=CELLS), 1, -1).astype(np.int8)
    field = SparseField(
        shape=(along_x, along_y, along_z),
        slots=arrays["slots"],
        where=arrays["where"],
        values=arrays["values"],
        data=data.reshape(-1, *BRICK),
    )
    return ChunkField(field=field, own=arrays["own"], begun=arrays["begun"])
